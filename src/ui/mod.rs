//! Panels for [egui]: settings and figures of a [`DeformationWorld`](crate::world::DeformationWorld) and of a
//! [`ProcDefWorld`](crate::world::ProcDefWorld), to put into any window.

mod charts;
mod figures;
mod motion;
mod procdef_figures;
mod settings;

pub use charts::charts;
pub use figures::figures;
pub use motion::motion;
pub use procdef_figures::procdef_figures;
pub use settings::settings;
