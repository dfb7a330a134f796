//! Meshes on the device. Positions and normals lie in two tight buffers of four floats a vertex (the fourth of a
//! normal is its vertex's paint, bit by bit), whether they never
//! change, are written anew for each picture, or are filled by a compute pass that owns them.

use glam::{Vec3, Vec4};
use wgpu::util::DeviceExt;

use super::paint::Paint;

/// Names a mesh of a renderer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MeshId(pub(crate) u32);

/// A mesh in memory. Corners of a triangle run counterclockwise seen from outside.
#[derive(Clone, Debug, Default)]
pub struct MeshData {
    /// One for each vertex.
    pub positions: Vec<Vec3>,
    /// One for each vertex, of length one.
    pub normals: Vec<Vec3>,
    /// Three for each triangle.
    pub indices: Vec<u32>,
}

impl MeshData {
    /// Normals as the mean of the faces around each vertex, weighted by area.
    pub fn with_smooth_normals(positions: Vec<Vec3>, indices: Vec<u32>) -> Self {
        let mut normals = vec![Vec3::ZERO; positions.len()];
        for triangle in indices.chunks_exact(3) {
            let [a, b, c] = [triangle[0] as usize, triangle[1] as usize, triangle[2] as usize];
            let area = (positions[b] - positions[a]).cross(positions[c] - positions[a]);
            for corner in [a, b, c] {
                normals[corner] += area;
            }
        }
        for normal in &mut normals {
            *normal = normal.normalize_or(Vec3::Y);
        }
        Self { positions, normals, indices }
    }
}

/// How the buffers of positions and normals must be usable.
pub const VERTEX_USAGE: wgpu::BufferUsages =
    wgpu::BufferUsages::VERTEX.union(wgpu::BufferUsages::STORAGE).union(wgpu::BufferUsages::COPY_DST);

pub(crate) struct Mesh {
    pub positions: wgpu::Buffer,
    pub normals: wgpu::Buffer,
    pub indices: wgpu::Buffer,
    pub index_count: u32,
    pub centre: Vec3,
    pub wire: wgpu::BindGroup,
}

/// All meshes of a renderer.
pub(crate) struct Meshes {
    all: Vec<Option<Mesh>>,
    pub wire_layout: wgpu::BindGroupLayout,
}

impl Meshes {
    pub fn new(device: &wgpu::Device) -> Self {
        let wire_layout = super::pipeline::layout(
            device,
            "wire",
            &[
                super::pipeline::storage(wgpu::ShaderStages::VERTEX),
                super::pipeline::storage(wgpu::ShaderStages::VERTEX),
            ],
        );
        Self { all: Vec::new(), wire_layout }
    }

    pub fn get(&self, id: MeshId) -> Option<&Mesh> {
        self.all.get(id.0 as usize)?.as_ref()
    }

    /// The mesh, if there is anything to draw.
    pub fn drawable(&self, id: MeshId) -> Option<&Mesh> {
        self.get(id).filter(|mesh| mesh.index_count > 0)
    }

    pub fn remove(&mut self, id: MeshId) {
        if let Some(slot) = self.all.get_mut(id.0 as usize) {
            *slot = None;
        }
    }

    pub fn clear(&mut self) {
        self.all.iter_mut().for_each(|slot| *slot = None);
    }

    /// Copies a mesh to the device.
    pub fn add(&mut self, device: &wgpu::Device, data: &MeshData) -> MeshId {
        let vertices = |label, values: &[Vec3], w: f32| {
            let padded: Vec<[f32; 4]> = values.iter().map(|v| v.extend(w).to_array()).collect();
            let padded = if padded.is_empty() { vec![[0.0; 4]] } else { padded };
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some(label),
                contents: bytemuck::cast_slice(&padded),
                usage: VERTEX_USAGE,
            })
        };
        let positions = vertices("positions", &data.positions, 1.0);
        let normals = vertices("normals", &data.normals, 0.0);
        let (low, high) = data
            .positions
            .iter()
            .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
        self.insert(device, positions, normals, &data.indices, 0.5 * (low + high))
    }

    /// Takes buffers that somebody else fills.
    pub fn add_shared(
        &mut self,
        device: &wgpu::Device,
        positions: wgpu::Buffer,
        normals: wgpu::Buffer,
        indices: &[u32],
    ) -> MeshId {
        self.insert(device, positions, normals, indices, Vec3::ZERO)
    }

    fn insert(
        &mut self,
        device: &wgpu::Device,
        positions: wgpu::Buffer,
        normals: wgpu::Buffer,
        indices: &[u32],
        centre: Vec3,
    ) -> MeshId {
        // Devices know no empty buffers.
        let index_count = indices.len() as u32;
        let indices = if indices.is_empty() { &[0; 3] } else { indices };
        let indices = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("indices"),
            contents: bytemuck::cast_slice(indices),
            usage: wgpu::BufferUsages::INDEX | wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        });
        let wire = super::pipeline::group(
            device,
            &self.wire_layout,
            &[positions.as_entire_binding(), indices.as_entire_binding()],
        );
        let mesh = Mesh { positions, normals, indices, index_count, centre, wire };
        let free = self.all.iter().position(Option::is_none).unwrap_or(self.all.len());
        if free == self.all.len() {
            self.all.push(None);
        }
        self.all[free] = Some(mesh);
        MeshId(free as u32)
    }

    /// Writes vertices anew; there must not be more of them than the mesh has.
    pub fn write(&self, queue: &wgpu::Queue, id: MeshId, positions: &[Vec4], normals: &[Vec4]) {
        let Some(mesh) = self.get(id) else { return };
        for (buffer, values) in [(&mesh.positions, positions), (&mesh.normals, normals)] {
            let raw: Vec<[f32; 4]> = values.iter().map(|v| v.to_array()).collect();
            fill(queue, buffer, bytemuck::cast_slice(&raw));
        }
    }

    /// Writes the corners of triangles anew; there must not be more of them than the mesh has.
    pub fn write_indices(&self, queue: &wgpu::Queue, id: MeshId, indices: &[u32]) {
        let Some(mesh) = self.get(id) else { return };
        fill(queue, &mesh.indices, bytemuck::cast_slice(indices));
    }

    /// Writes vertices and their paint anew; there must not be more of them than the mesh has.
    pub fn write_painted(
        &self,
        queue: &wgpu::Queue,
        id: MeshId,
        positions: &[Vec3],
        normals: &[Vec3],
        paint: &[Paint],
    ) {
        let Some(mesh) = self.get(id) else { return };
        let raw: Vec<[f32; 4]> = positions.iter().map(|p| p.extend(1.0).to_array()).collect();
        fill(queue, &mesh.positions, bytemuck::cast_slice(&raw));
        let raw: Vec<[u32; 4]> = normals
            .iter()
            .zip(paint)
            .map(|(n, paint)| {
                let [x, y, z] = n.to_array().map(f32::to_bits);
                [x, y, z, paint.0]
            })
            .collect();
        fill(queue, &mesh.normals, bytemuck::cast_slice(&raw));
    }
}

fn fill(queue: &wgpu::Queue, buffer: &wgpu::Buffer, bytes: &[u8]) {
    assert!(bytes.len() as u64 <= buffer.size(), "more vertices than the mesh has");
    queue.write_buffer(buffer, 0, bytes);
}
