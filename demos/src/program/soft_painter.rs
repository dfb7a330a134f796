//! Bodies that move by themselves, their rigid things and the water, as items of a picture.

use std::sync::Arc;

use glam::{Mat4, Vec3};

use super::creases::creased;
use super::looks;
use super::moment::SoftMoment;
use super::overlays::Shown;
use super::section::Cut;
use super::soft_skin::{SoftLook, SoftSkin};
use super::water;
use crate::render::{Camera, Item, Material, MeshId, Overlay, Renderer};
use crate::simulation::{Simulation, SoftKind};

/// Colour of the edges of triangles.
const WIRE: [f32; 4] = [0.02, 0.02, 0.03, 0.55];

/// Faces of rigid things that meet at more than this angle have an edge between them, in degrees.
const CREASE: f32 = 50.0;

/// The rigid things of a body.
type Things = Vec<(MeshId, Material)>;

/// Draws the bodies of one simulation that move by themselves.
pub struct SoftPainter {
    cut: Option<Cut>,
    skins: Vec<SoftSkin>,
    /// For each body its rigid things.
    things: Vec<Things>,
    water: Vec<(MeshId, Mat4)>,
}

impl SoftPainter {
    /// Makes the meshes.
    pub fn new(renderer: &mut Renderer, simulation: &Simulation, cut: Option<Cut>) -> Self {
        let mut looks: Vec<(Arc<SoftKind>, Arc<SoftLook>)> = Vec::new();
        let (mut skins, mut things) = (Vec::new(), Vec::new());
        let mut meshes: Vec<(Arc<SoftKind>, Things)> = Vec::new();
        for (actor, body) in simulation.soft_actors.iter().zip(&simulation.scene.soft_bodies) {
            let known = looks.iter().find(|(kind, _)| cut.is_none() && Arc::ptr_eq(kind, &actor.kind));
            let look = known
                .map(|(_, look)| look.clone())
                .unwrap_or_else(|| Arc::new(SoftLook::new(&actor.kind, cut, &body.pose, simulation.scene.camera.eye)));
            skins.push(SoftSkin::new(renderer, &look));
            looks.push((actor.kind.clone(), look));
            let known = meshes.iter().find(|(kind, _)| Arc::ptr_eq(kind, &actor.kind)).map(|(_, known)| known.clone());
            let made = known.unwrap_or_else(|| self::things(renderer, &actor.kind));
            meshes.push((actor.kind.clone(), made.clone()));
            things.push(made);
        }
        let water = water::boxes(renderer, &simulation.scene);
        Self { cut, skins, things, water }
    }

    /// The items at the place `alpha` between two moments; what is drawn over them is added to the overlay.
    pub fn items(
        &mut self,
        renderer: &mut Renderer,
        simulation: &Simulation,
        moments: [&[SoftMoment]; 2],
        alpha: f32,
        (camera, shown, overlay): (&Camera, &Shown, &mut Overlay),
    ) -> Vec<Item> {
        if shown.cut != self.cut {
            self.skins.iter().for_each(|skin| renderer.remove_mesh(skin.mesh()));
            *self = Self::new(renderer, simulation, shown.cut);
        }
        let mut items = Vec::new();
        let [from, to] = moments;
        for (index, actor) in simulation.soft_actors.iter().enumerate() {
            let (Some(skin), Some(from), Some(to)) = (self.skins.get_mut(index), from.get(index), to.get(index)) else {
                continue;
            };
            if let Some(mesh) = skin.show(renderer, [from, to], alpha, shown.field, overlay) {
                let mut item = Item::new(mesh, Mat4::IDENTITY, looks::soft_body(actor));
                if item.material.alpha < 1.0 {
                    skin.sort(renderer, camera.eye);
                }
                item.wire = shown.wireframe.then_some(WIRE);
                items.push(item);
            }
            let things = self.things[index].iter().zip(from.things.iter().zip(&to.things));
            for ((mesh, material), poses) in things {
                if let (Some(from), Some(to)) = poses {
                    items.push(Item::new(*mesh, from.lerp(to, alpha).to_mat4(), *material));
                }
            }
        }
        let glass = |&(mesh, place)| Item { casts_shadow: false, ..Item::new(mesh, place, water::material()) };
        items.extend(self.water.iter().map(glass));
        items
    }
}

/// The rigid things of a kind.
fn things(renderer: &mut Renderer, kind: &SoftKind) -> Things {
    let things = kind.things.iter().map(|thing| {
        let mesh = creased(&thing.mesh.positions, &thing.mesh.triangles, CREASE);
        let colour = thing.colour.map_or(Vec3::new(0.45, 0.30, 0.16), Vec3::from);
        (renderer.add_mesh(&mesh), Material { roughness: 0.35, clearcoat: 0.7, ..Material::plain(colour) })
    });
    things.collect()
}
