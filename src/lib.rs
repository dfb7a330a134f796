//! **pliant** makes rigid worlds look alive: skin and fat that jiggle, ragdolls that squash through obstacles.
//!
//! Rapier moves rigid bodies; pliant reads them after each step, simulates a handful of mass-spring sets, builds
//! divergence-free vector fields from them and carries every vertex of the visible skin along the path lines of those
//! fields. What a rigid body penetrates is pushed back by a repelling impulse, and what is left of the penetration is
//! cancelled on the visible surface.
//!
//! Modules, each importing only from those to its right:
//! `ui`, `gpu` → [`world`] → [`coupling`] → [`elastic`], [`procdef`] → [`spring`], [`field`], [`mesh`], [`files`] → [`math`].

pub mod coupling;
pub mod elastic;
pub mod field;
pub mod files;
#[cfg(feature = "gpu")]
pub mod gpu;
pub mod math;
pub mod mesh;
pub mod procdef;
pub mod spring;
#[cfg(feature = "ui")]
pub mod ui;
pub mod world;

/// The README's code is compiled and run with the documentation's tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
