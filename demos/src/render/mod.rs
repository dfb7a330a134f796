//! Drawing, on a screen or into a picture. Knows nothing of physics.
//!
//! The one who draws keeps meshes in a [`Renderer`] and hands it a [`Frame`] for each picture: a camera, a sun, and a
//! list of items, each a mesh at a place in a material. The passes of a picture: the sun's depth map (`shadow`), a
//! small depth image and the ambient occlusion from it (`occlusion`), everything visible (`surface`, `wire`,
//! `overlay`) at four samples a pixel in linear light, and the fold of that light into screen colours (`tone`).

pub mod device;
pub mod frame;
pub mod material;
pub mod mesh;
pub mod overlay;
pub mod paint;
pub mod picture;
pub mod renderer;
pub mod shapes;

mod list;
mod occlusion;
mod overlay_pass;
mod pipeline;
mod shaders;
mod shadow;
mod surface;
mod targets;
mod tone;
mod uniforms;
mod wire;

#[cfg(test)]
mod tests;

pub use device::{Gpu, GpuError};
pub use frame::{Camera, Frame, Ground, Item, Region, Sky, Sun};
pub use material::Material;
pub use mesh::{MeshData, MeshId};
pub use overlay::Overlay;
pub use paint::Paint;
pub use picture::Picture;
pub use renderer::Renderer;
