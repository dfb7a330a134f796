//! Panels for [egui]: settings and figures of a [`DeformationWorld`](crate::world::DeformationWorld), to put into any
//! window.

mod figures;
mod settings;

pub use figures::figures;
pub use settings::settings;
