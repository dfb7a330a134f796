//! The deformation of the skin as one compute pass (sections 5.3 and 5.4 of the paper).
//!
//! The rest data of a skin is uploaded once ([`GpuSkin`]); a frame uploads the palette, a few kilobytes, and dispatches
//! one pass that writes positions and normals into the buffers of a [`GpuBody`]. Nothing is read back. Device, queue and
//! encoder are the caller's, and any renderer can bind the buffers.
//!
//! Skins that are embedded in the cells of bodies that move by themselves are deformed in two passes ([`EmbedPipeline`]); a frame
//! uploads the positions of the body's vertices.
//!
//! The shaders are the twins of [`crate::field`] and [`crate::elastic`], function by function.

mod body;
mod embed_pipeline;
mod embedded_skin;
mod error;
mod palette_bytes;
mod pipeline;
mod shaders;
mod skin;

pub use body::GpuBody;
pub use embed_pipeline::EmbedPipeline;
pub use embedded_skin::{GpuEmbeddedBody, GpuEmbeddedSkin};
pub use error::GpuError;
pub use pipeline::DeformPipeline;
pub use shaders::{deform_shader, embed_shaders};
pub use skin::GpuSkin;
