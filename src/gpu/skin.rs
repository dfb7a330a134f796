//! The rest data of a skin on the device: uploaded once, shared by all bodies that wear it.

use wgpu::util::DeviceExt;

use super::error::GpuError;
use crate::elastic::{ElasticRig, SkinWeights, tangent_epsilon};
use crate::math::Vec3;

/// Rest positions, normals and weights of a skin in one storage buffer.
#[derive(Clone, Debug)]
pub struct GpuSkin {
    pub(super) rest: wgpu::Buffer,
    pub(super) vertices: u32,
    pub(super) epsilon: f32,
    pub(super) centre: Vec3,
    pub(super) segments: usize,
}

/// Bytes of one vertex in the rest buffer: position and two segments, normal and two segments, four weights.
const REST_VERTEX: u64 = 48;

impl GpuSkin {
    /// Uploads the rest data of `rig`.
    ///
    /// # Errors
    /// See [`GpuSkin::from_parts`].
    pub fn new(device: &wgpu::Device, rig: &ElasticRig) -> Result<Self, GpuError> {
        Self::from_parts(device, &rig.mesh.positions, &rig.mesh.normals, &rig.weights)
    }

    /// Uploads positions, unit normals and index-weight pairs, one of each for every vertex.
    ///
    /// # Errors
    /// [`GpuError`] where the numbers differ or are zero, or the device's buffers are too small.
    pub fn from_parts(
        device: &wgpu::Device,
        positions: &[Vec3],
        normals: &[Vec3],
        weights: &[SkinWeights],
    ) -> Result<Self, GpuError> {
        let vertices = checked_length(positions.len(), normals.len(), weights.len(), &device.limits())?;
        let rows: Vec<[[u32; 4]; 3]> = positions
            .iter()
            .zip(normals)
            .zip(weights)
            .map(|((x, n), skin)| {
                let pair = |k: usize| u32::from(skin.segments[k]) | u32::from(skin.segments[k + 1]) << 16;
                [
                    [x.x.to_bits(), x.y.to_bits(), x.z.to_bits(), pair(0)],
                    [n.x.to_bits(), n.y.to_bits(), n.z.to_bits(), pair(2)],
                    skin.weights.map(f32::to_bits),
                ]
            })
            .collect();
        let rest = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("pliant rest vertices"),
            contents: bytemuck::cast_slice(&rows),
            usage: wgpu::BufferUsages::STORAGE,
        });
        Ok(Self {
            rest,
            vertices,
            epsilon: tangent_epsilon(positions),
            centre: positions.iter().sum::<Vec3>() / vertices as f32,
            segments: weights.iter().map(segments_needed).max().unwrap_or(0),
        })
    }

    /// The number of vertices.
    pub fn vertices(&self) -> u32 {
        self.vertices
    }

    /// The step of the tangent points in metres, see [`crate::elastic::TANGENT_STEP`].
    pub fn epsilon(&self) -> f32 {
        self.epsilon
    }
}

/// One more than the largest segment index that has a weight.
fn segments_needed(skin: &SkinWeights) -> usize {
    let used = skin.segments.iter().zip(skin.weights).filter(|(_, weight)| *weight > 0.0);
    used.map(|(&segment, _)| usize::from(segment) + 1).max().unwrap_or(0)
}

/// The number of vertices, where the lengths agree and the device has room for them.
fn checked_length(positions: usize, normals: usize, weights: usize, limits: &wgpu::Limits) -> Result<u32, GpuError> {
    if positions != normals || positions != weights {
        return Err(GpuError::LengthMismatch { positions, normals, weights });
    }
    if positions == 0 {
        return Err(GpuError::NoVertices);
    }
    let limit = max_vertices(limits);
    match u32::try_from(positions) {
        Ok(vertices) if u64::from(vertices) <= limit => Ok(vertices),
        _ => Err(GpuError::TooManyVertices { vertices: positions, limit }),
    }
}

/// The largest body that a device with these limits can deform.
fn max_vertices(limits: &wgpu::Limits) -> u64 {
    let bytes = limits.max_buffer_size.min(limits.max_storage_buffer_binding_size);
    (bytes / REST_VERTEX).min(u64::from(u32::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_body_that_just_fits_is_taken_and_one_more_vertex_is_refused() {
        let limits = wgpu::Limits { max_storage_buffer_binding_size: 48 * 1000 + 47, ..wgpu::Limits::default() };
        assert_eq!(checked_length(1000, 1000, 1000, &limits), Ok(1000));
        let refused = checked_length(1001, 1001, 1001, &limits);
        assert_eq!(refused, Err(GpuError::TooManyVertices { vertices: 1001, limit: 1000 }));
    }

    #[test]
    fn the_default_limits_allow_two_million_vertices() {
        assert!(max_vertices(&wgpu::Limits::default()) > 2_000_000);
    }

    #[test]
    fn a_mesh_without_vertices_or_with_missing_normals_is_refused() {
        let limits = wgpu::Limits::default();
        assert_eq!(checked_length(0, 0, 0, &limits), Err(GpuError::NoVertices));
        let expected = GpuError::LengthMismatch { positions: 3, normals: 2, weights: 3 };
        assert_eq!(checked_length(3, 2, 3, &limits), Err(expected));
    }
}
