//! A scene at work: rapier moves it, pliant deforms it. Knows nothing of drawing.

mod build;
mod grab;
mod obstacle;
mod pull;
mod ring;
mod running;
mod scripted;
mod shape;
mod shown_part;
mod soft;
mod soft_figures;
mod soft_hand;

pub use build::BuildError;
pub use grab::{Hit, Take};
pub use obstacle::ObstacleBody;
pub use ring::ring_surface;
pub use running::{Actor, Simulation};
pub use shown_part::ShownPart;
pub use soft::{AttachedThing, SoftActor, SoftKind};
pub use soft_figures::SoftFigures;
pub use soft_hand::SoftHit;
