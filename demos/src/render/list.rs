//! The order of drawing: solid items by mesh, so that equal meshes go in one call; translucent ones from far to near.

use std::ops::Range;

use super::frame::{Frame, Item};
use super::mesh::{MeshId, Meshes};
use super::uniforms::Instance;

/// Shadows of what is fainter than this would be more grain than shadow.
const FAINTEST_CASTER: f32 = 0.2;

/// Neighbouring instances of one mesh.
pub struct Batch {
    mesh: MeshId,
    instances: Range<u32>,
    casts_shadow: bool,
    wire: bool,
}

impl Batch {
    /// Draws with positions alone.
    pub fn draw_positions(&self, pass: &mut wgpu::RenderPass<'_>, meshes: &Meshes) {
        let Some(mesh) = meshes.drawable(self.mesh) else { return };
        pass.set_vertex_buffer(0, mesh.positions.slice(..));
        pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..mesh.index_count, 0, self.instances.clone());
    }

    /// Draws with positions and normals.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, meshes: &Meshes) {
        let Some(mesh) = meshes.drawable(self.mesh) else { return };
        pass.set_vertex_buffer(1, mesh.normals.slice(..));
        self.draw_positions(pass, meshes);
    }

    /// Draws triangles whose corners the shader pulls.
    pub fn draw_wire(&self, pass: &mut wgpu::RenderPass<'_>, meshes: &Meshes) {
        let Some(mesh) = meshes.drawable(self.mesh) else { return };
        pass.set_bind_group(1, &mesh.wire, &[]);
        pass.draw(0..mesh.index_count, self.instances.clone());
    }
}

/// The items of a frame, sorted.
pub struct DrawList {
    /// For the device, in the order of the batches.
    pub instances: Vec<Instance>,
    /// Solid items.
    pub solid: Vec<Batch>,
    /// Translucent items, one a batch, far to near.
    pub translucent: Vec<Batch>,
}

impl DrawList {
    /// Sorts the items of a frame.
    pub fn new(frame: &Frame, meshes: &Meshes) -> Self {
        let (mut solid, translucent): (Vec<&Item>, Vec<&Item>) =
            frame.items.iter().partition(|item| item.material.alpha >= 1.0);
        solid.sort_by_key(|item| (item.mesh, item.casts_shadow, item.wire.is_some()));
        let distance = |item: &Item| {
            let centre = meshes.get(item.mesh).map(|mesh| mesh.centre).unwrap_or_default();
            item.transform.transform_point3(centre).distance_squared(frame.camera.eye)
        };
        let mut translucent: Vec<_> = translucent.into_iter().map(|item| (distance(item), item)).collect();
        translucent.sort_by(|a, b| b.0.total_cmp(&a.0));

        let mut list = Self { instances: Vec::new(), solid: Vec::new(), translucent: Vec::new() };
        for item in solid {
            let batch = list.add(item);
            match list.solid.last_mut() {
                Some(last) if last.same_kind(&batch) => last.instances.end = batch.instances.end,
                _ => list.solid.push(batch),
            }
        }
        for (_, item) in translucent {
            let batch = list.add(item);
            list.translucent.push(batch);
        }
        list
    }

    fn add(&mut self, item: &Item) -> Batch {
        let at = self.instances.len() as u32;
        self.instances.push(item.into());
        Batch {
            mesh: item.mesh,
            instances: at..at + 1,
            casts_shadow: item.casts_shadow && item.material.alpha > FAINTEST_CASTER,
            wire: item.wire.is_some(),
        }
    }

    /// What casts shadows.
    pub fn casters(&self) -> impl Iterator<Item = &Batch> {
        self.solid.iter().chain(&self.translucent).filter(|batch| batch.casts_shadow)
    }

    /// What shows its edges.
    pub fn wires(&self) -> impl Iterator<Item = &Batch> {
        self.solid.iter().chain(&self.translucent).filter(|batch| batch.wire)
    }
}

impl Batch {
    fn same_kind(&self, other: &Self) -> bool {
        (self.mesh, self.casts_shadow, self.wire) == (other.mesh, other.casts_shadow, other.wire)
    }
}
