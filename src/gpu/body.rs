//! One deformed body on the device: its palette and the buffers that a renderer binds.

use super::error::GpuError;
use super::palette_bytes::{Row, pack};
use super::skin::GpuSkin;
use crate::elastic::Palette;
use crate::math::Vec3;

/// Output buffers and palette of one body.
///
/// Positions (w = 1) and normals (w = 0) are one `vec4<f32>` a vertex, in the world. Both buffers may be used as
/// `STORAGE`, `VERTEX` and `COPY_SRC`.
#[derive(Debug)]
pub struct GpuBody {
    positions: wgpu::Buffer,
    normals: wgpu::Buffer,
    vertices: u32,
    palette: wgpu::Buffer,
    palette_bytes: u64,
    rows: Vec<Row>,
    binding: Option<(wgpu::Buffer, wgpu::BindGroup)>,
}

/// The palette buffer is first made for this many bytes, and doubled when it gets too small.
const FIRST_PALETTE: u64 = 4096;

impl GpuBody {
    /// Buffers for a body that wears `skin`; they are filled by the first [`super::DeformPipeline::encode`].
    pub fn new(device: &wgpu::Device, skin: &GpuSkin) -> Self {
        let output = |label| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: u64::from(skin.vertices) * 16,
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            })
        };
        Self {
            positions: output("pliant positions"),
            normals: output("pliant normals"),
            vertices: skin.vertices,
            palette: palette_buffer(device, FIRST_PALETTE),
            palette_bytes: 0,
            rows: Vec::new(),
            binding: None,
        }
    }

    /// Deformed positions, one `vec4<f32>` a vertex.
    pub fn positions(&self) -> &wgpu::Buffer {
        &self.positions
    }

    /// Deformed unit normals, one `vec4<f32>` a vertex.
    pub fn normals(&self) -> &wgpu::Buffer {
        &self.normals
    }

    /// The number of vertices.
    pub fn vertices(&self) -> u32 {
        self.vertices
    }

    /// Bytes that the last palette took: all that was uploaded for that frame.
    pub fn palette_bytes(&self) -> u64 {
        self.palette_bytes
    }

    /// Packs and uploads `palette`, and makes the buffer larger where it has to.
    pub(super) fn upload(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        skin: &GpuSkin,
        palette: &Palette,
    ) -> Result<(), GpuError> {
        if self.vertices != skin.vertices {
            return Err(GpuError::OtherSkin { body: self.vertices, skin: skin.vertices });
        }
        if palette.segments.len() < skin.segments {
            return Err(GpuError::MissingSegments { needed: skin.segments, given: palette.segments.len() });
        }
        let origin = palette.segments.first().map_or(Vec3::ZERO, |entry| entry.motion.transform_point(skin.centre));
        pack(palette, skin.epsilon, origin, &mut self.rows);
        let bytes: &[u8] = bytemuck::cast_slice(&self.rows);
        let size = bytes.len() as u64;
        let limits = device.limits();
        let limit = limits.max_buffer_size.min(limits.max_storage_buffer_binding_size);
        if size > limit {
            return Err(GpuError::PaletteTooLarge { bytes: size, limit });
        }
        if size > self.palette.size() {
            self.palette = palette_buffer(device, size.next_power_of_two().min(limit));
            self.binding = None;
        }
        queue.write_buffer(&self.palette, 0, bytes);
        self.palette_bytes = size;
        Ok(())
    }

    /// The bind group for this body and `skin`, made anew only when one of the buffers has changed.
    pub(super) fn bind_group(
        &mut self,
        device: &wgpu::Device,
        layout: &wgpu::BindGroupLayout,
        skin: &GpuSkin,
    ) -> wgpu::BindGroup {
        if let Some((rest, group)) = &self.binding
            && *rest == skin.rest
        {
            return group.clone();
        }
        let buffers = [&skin.rest, &self.palette, &self.positions, &self.normals];
        let mut binding = 0..;
        let entries = buffers.map(|buffer| wgpu::BindGroupEntry {
            binding: binding.next().unwrap_or_default(),
            resource: buffer.as_entire_binding(),
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("pliant deformation"),
            layout,
            entries: &entries,
        });
        self.binding = Some((skin.rest.clone(), group.clone()));
        group
    }
}

fn palette_buffer(device: &wgpu::Device, size: u64) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("pliant palette"),
        size,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}
