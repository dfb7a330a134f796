//! The embedded skin of a body on the device: rest data that is uploaded once, and the buffers of one body.

use wgpu::util::DeviceExt;

use super::error::GpuError;
use crate::math::Vec3;
use crate::procdef::EmbeddedSkin;

/// The rest data of an embedded skin, shared by all bodies that wear it.
#[derive(Clone, Debug)]
pub struct GpuEmbeddedSkin {
    pub(super) body: wgpu::Buffer,
    pub(super) skin: wgpu::Buffer,
    pub(super) body_vertices: u32,
    pub(super) skin_vertices: u32,
}

/// The buffers of one body with an embedded skin.
///
/// Positions (w = 1) and normals (w = 0) of the skin are one `vec4<f32>` a vertex, in the world. Both buffers may be used as
/// `STORAGE`, `VERTEX` and `COPY_SRC`.
#[derive(Clone, Debug)]
pub struct GpuEmbeddedBody {
    pub(super) uploaded: wgpu::Buffer,
    pub(super) moved: wgpu::Buffer,
    positions: wgpu::Buffer,
    normals: wgpu::Buffer,
    skin: GpuEmbeddedSkin,
    pub(super) groups: Option<[wgpu::BindGroup; 2]>,
    rows: Vec<[f32; 4]>,
}

impl GpuEmbeddedSkin {
    /// Uploads the rest data of a skin.
    ///
    /// # Errors
    /// [`GpuError`] where the skin has no vertices, or the device's buffers are too small.
    pub fn new(device: &wgpu::Device, skin: &EmbeddedSkin) -> Result<Self, GpuError> {
        let vertices = skin.bindings().len();
        if vertices == 0 {
            return Err(GpuError::NoVertices);
        }
        let body_rows = body_rows(skin);
        let normals = &skin.skin().normals;
        let skin_rows: Vec<[u32; 4]> = skin
            .bindings()
            .iter()
            .zip(normals)
            .flat_map(|(binding, n)| {
                let normal = [n.x, n.y, n.z, 0.0].map(f32::to_bits);
                [binding.vertices, binding.weights.map(f32::to_bits), normal]
            })
            .collect();
        let limits = device.limits();
        let bytes = limits.max_buffer_size.min(limits.max_storage_buffer_binding_size);
        // The largest buffers: three rows a vertex of the skin, four a vertex of the body, and the body's rest data.
        let rows = skin_rows.len().max(body_rows.len()).max(4 * skin.inverse_volumes.len());
        if rows as u64 * 16 > bytes || u32::try_from(rows).is_err() {
            return Err(GpuError::TooManyVertices { vertices, limit: bytes / 48 });
        }
        let buffer = |label, rows: &[[u32; 4]]| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some(label),
                contents: bytemuck::cast_slice(rows),
                usage: wgpu::BufferUsages::STORAGE,
            })
        };
        Ok(Self {
            body: buffer("pliant cells", &body_rows),
            skin: buffer("pliant embedded skin", &skin_rows),
            body_vertices: skin.inverse_volumes.len() as u32,
            skin_vertices: vertices as u32,
        })
    }

    /// The number of vertices of the skin.
    pub fn vertices(&self) -> u32 {
        self.skin_vertices
    }
}

/// The body's rest data as `vertex_gradients.wgsl` reads it.
fn body_rows(skin: &EmbeddedSkin) -> Vec<[u32; 4]> {
    let count = skin.inverse_volumes.len();
    let mut lists: Vec<Vec<u32>> = vec![Vec::new(); count];
    for (number, cell) in (0u32..).zip(&skin.cells) {
        cell.vertices.iter().for_each(|&v| lists[v as usize].push(number));
    }
    let first_cell = 1 + count as u32;
    let first_list = first_cell + 4 * skin.cells.len() as u32;
    let mut rows = vec![[count as u32, first_cell, first_list, 0]];
    let mut start = 0;
    for (list, inverse_volume) in lists.iter().zip(&skin.inverse_volumes) {
        let end = start + list.len() as u32;
        rows.push([start, end, inverse_volume.to_bits(), 0]);
        start = end;
    }
    for cell in &skin.cells {
        rows.push(cell.vertices);
        for (k, column) in cell.inverse.to_cols_array_2d().into_iter().enumerate() {
            let [x, y, z] = column.map(f32::to_bits);
            rows.push([x, y, z, if k == 0 { cell.volume.to_bits() } else { 0 }]);
        }
    }
    let entries: Vec<u32> = lists.concat();
    rows.extend(entries.chunks(4).map(|four| std::array::from_fn(|k| four.get(k).copied().unwrap_or_default())));
    rows
}

impl GpuEmbeddedBody {
    /// Buffers for a body that wears `skin`; they are filled by the first [`super::EmbedPipeline::encode`].
    pub fn new(device: &wgpu::Device, skin: &GpuEmbeddedSkin) -> Self {
        let buffer = |label, rows: u32, usage| {
            let usage = usage | wgpu::BufferUsages::STORAGE;
            let size = u64::from(rows) * 16;
            device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
        };
        let output = wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_SRC;
        Self {
            uploaded: buffer("pliant body positions", skin.body_vertices, wgpu::BufferUsages::COPY_DST),
            moved: buffer("pliant body gradients", 4 * skin.body_vertices, wgpu::BufferUsages::empty()),
            positions: buffer("pliant positions", skin.skin_vertices, output),
            normals: buffer("pliant normals", skin.skin_vertices, output),
            skin: skin.clone(),
            groups: None,
            rows: Vec::new(),
        }
    }

    /// Deformed positions of the skin, one `vec4<f32>` a vertex.
    pub fn positions(&self) -> &wgpu::Buffer {
        &self.positions
    }

    /// Deformed unit normals of the skin, one `vec4<f32>` a vertex.
    pub fn normals(&self) -> &wgpu::Buffer {
        &self.normals
    }

    /// What it wears.
    pub fn skin(&self) -> &GpuEmbeddedSkin {
        &self.skin
    }

    /// Uploads the positions of the body's vertices.
    pub(super) fn upload(&mut self, queue: &wgpu::Queue, positions: &[Vec3]) -> Result<(), GpuError> {
        let needed = self.skin.body_vertices as usize;
        if positions.len() != needed {
            return Err(GpuError::BodyVertices { needed, given: positions.len() });
        }
        self.rows.clear();
        self.rows.extend(positions.iter().map(|x| [x.x, x.y, x.z, 1.0]));
        queue.write_buffer(&self.uploaded, 0, bytemuck::cast_slice(&self.rows));
        Ok(())
    }
}
