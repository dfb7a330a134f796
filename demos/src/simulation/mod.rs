//! A scene at work: rapier moves it, pliant deforms it. Knows nothing of drawing.

mod build;
mod grab;
mod obstacle;
mod pull;
mod ring;
mod running;
mod scripted;
mod shape;
mod soft;
mod soft_hand;
mod shown_part;

pub use build::BuildError;
pub use grab::{Hit, Take};
pub use obstacle::ObstacleBody;
pub use ring::ring_surface;
pub use soft::{AttachedThing, SoftActor, SoftKind};
pub use soft_hand::SoftHit;
pub use running::{Actor, Simulation};
pub use shown_part::ShownPart;
