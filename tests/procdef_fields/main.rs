//! The fields, charts and stimuli of bodies that move by themselves.

mod charts;
mod geodesic;
mod layers;
mod meshes;
mod motion;
mod orientation;
mod painting;
mod rig_files;
mod trigger;
