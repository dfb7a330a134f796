//! Bodies that move by themselves, their rigid things and the water, as items of a picture.

use std::sync::Arc;

use glam::{Mat4, Vec3};

use super::creases::creased;
use super::device_skin::SkinPasses;
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
    /// What deforms skins on the device, if it is so wished.
    passes: Option<Arc<SkinPasses>>,
    skins: Vec<SoftSkin>,
    /// For each body its rigid things.
    things: Vec<Things>,
    water: Vec<(MeshId, Mat4)>,
}

impl SoftPainter {
    /// Makes the meshes; with `compute`, skins are deformed on the device.
    pub fn new(renderer: &mut Renderer, simulation: &Simulation, compute: bool) -> Self {
        let wished = compute && !simulation.soft_actors.is_empty();
        let passes = wished.then(|| Arc::new(SkinPasses::new(renderer.device())));
        Self::with(renderer, simulation, None, passes)
    }

    fn with(
        renderer: &mut Renderer,
        simulation: &Simulation,
        cut: Option<Cut>,
        passes: Option<Arc<SkinPasses>>,
    ) -> Self {
        let mut looks: Vec<(Arc<SoftKind>, Arc<SoftLook>)> = Vec::new();
        let (mut skins, mut things) = (Vec::new(), Vec::new());
        let mut meshes: Vec<(Arc<SoftKind>, Things)> = Vec::new();
        for (actor, body) in simulation.soft_actors.iter().zip(&simulation.scene.soft_bodies) {
            let known = looks.iter().find(|(kind, _)| cut.is_none() && Arc::ptr_eq(kind, &actor.kind));
            let look = known.map(|(_, look)| look.clone()).unwrap_or_else(|| {
                let look = SoftLook::new(&actor.kind, cut, &body.pose, simulation.scene.camera.eye);
                Arc::new(if passes.is_some() { look.on(renderer.device()) } else { look })
            });
            // What one sees through is sorted in memory.
            let wanted = passes.as_ref().filter(|_| looks::soft_body(actor).alpha >= 1.0);
            skins.push(SoftSkin::new(renderer, &look, wanted));
            looks.push((actor.kind.clone(), look));
            let known = meshes.iter().find(|(kind, _)| Arc::ptr_eq(kind, &actor.kind)).map(|(_, known)| known.clone());
            let made = known.unwrap_or_else(|| self::things(renderer, &actor.kind));
            meshes.push((actor.kind.clone(), made.clone()));
            things.push(made);
        }
        let water = water::boxes(renderer, &simulation.scene);
        Self { cut, passes, skins, things, water }
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
            *self = Self::with(renderer, simulation, shown.cut, self.passes.take());
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

#[cfg(test)]
mod tests {
    use super::super::fields::Field;
    use super::super::moment::Moment;
    use super::super::painter::Painter;
    use super::super::{choose, looks};
    use super::*;
    use crate::render::device::tests::device_or_skip;
    use crate::render::{Picture, picture};
    use image::RgbaImage;

    const SIZE: [u32; 2] = [200, 160];

    fn difference(a: &RgbaImage, b: &RgbaImage) -> f64 {
        let sum: u64 = a.as_raw().iter().zip(b.as_raw()).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
        sum as f64 / a.as_raw().len() as f64
    }

    /// Pixels whose first part is far above the third, and the other way round.
    fn red_and_blue(image: &RgbaImage) -> [usize; 2] {
        let count = |a: usize, b: usize| image.pixels().filter(|p| i32::from(p[a]) > i32::from(p[b]) + 60).count();
        [count(0, 2), count(2, 0)]
    }

    #[test]
    fn fields_and_cuts_are_seen_and_go_away_again() {
        let Some(gpu) = device_or_skip("fields_and_cuts_are_seen_and_go_away_again") else { return };
        let mut simulation = choose::simulation("bending-bar", 0).unwrap();
        (0..60).for_each(|_| simulation.step());
        let now = Moment::of(&simulation);
        let mut renderer = Renderer::new(&gpu.device, &gpu.queue, picture::FORMAT, SIZE);
        let mut painter = Painter::new(&mut renderer, &simulation, false);
        let target = Picture::new(&gpu.device, SIZE);
        let camera = looks::camera(&simulation.scene.camera);
        let mut take = |field, cut| {
            (painter.shown.field, painter.shown.cut) = (field, cut);
            let frame = painter.frame(&mut renderer, &simulation, [&now, &now], 1.0, camera);
            target.take(&mut renderer, &frame).unwrap()
        };
        let plain = take(Field::Plain, None);
        let [red, blue] = red_and_blue(&plain);
        assert!(red + blue < 10, "the bar is grey: {red} {blue}");
        // A quarter of its cycle: the upper side is expanded, the lower one contracted.
        let [red, _] = red_and_blue(&take(Field::Excitation, None));
        assert!(red > 50, "{red}");
        let [red, blue] = red_and_blue(&take(Field::Amplitude, None));
        assert!(red > 200 && blue > 200, "{red} {blue}");
        let directions = difference(&plain, &take(Field::Directions, None));
        assert!(directions > 0.3, "{directions}");
        let cut = difference(&plain, &take(Field::Plain, Some(Cut { axis: 0, at: 0.0 })));
        assert!(cut > 1.0, "half of the bar is gone: {cut}");
        let again = difference(&plain, &take(Field::Plain, None));
        assert!(again == 0.0, "{again}");
    }

    #[test]
    fn skins_that_are_deformed_on_the_device_look_like_those_from_memory() {
        let Some(gpu) = device_or_skip("skins_that_are_deformed_on_the_device_look_like_those_from_memory") else {
            return;
        };
        for scene in ["worm-crawl", "bending-bar"] {
            let mut simulation = choose::simulation(scene, 0).unwrap();
            (0..40).for_each(|_| simulation.step());
            let now = Moment::of(&simulation);
            let take = |compute, field| {
                let mut renderer = Renderer::new(&gpu.device, &gpu.queue, picture::FORMAT, SIZE);
                let mut painter = Painter::new(&mut renderer, &simulation, compute);
                painter.shown.field = field;
                let target = Picture::new(&gpu.device, SIZE);
                let camera = looks::camera(&simulation.scene.camera);
                let frame = painter.frame(&mut renderer, &simulation, [&now, &now], 1.0, camera);
                target.take(&mut renderer, &frame).unwrap()
            };
            for field in [Field::Plain, Field::Excitation] {
                let apart = difference(&take(true, field), &take(false, field));
                assert!(apart < 0.05, "{scene}: {apart} of 255 in the mean");
            }
            let painted = difference(&take(true, Field::Plain), &take(true, Field::Excitation));
            assert!(painted > 0.2, "{scene}: the paint is seen, {painted}");
        }
    }

    #[test]
    fn a_translucent_body_is_drawn_from_far_to_near() {
        let Some(gpu) = device_or_skip("a_translucent_body_is_drawn_from_far_to_near") else { return };
        let simulation = choose::simulation("jellyfish", 0).unwrap();
        let now = Moment::of(&simulation);
        let mut renderer = Renderer::new(&gpu.device, &gpu.queue, picture::FORMAT, SIZE);
        let look =
            Arc::new(SoftLook::new(&simulation.soft_actors[0].kind, None, &pliant::math::Pose::IDENTITY, Vec3::Z));
        let mut skin = SoftSkin::new(&mut renderer, &look, None);
        skin.show(&renderer, [&now.soft[0], &now.soft[0]], 1.0, Field::Plain, &mut Overlay::default()).unwrap();
        for eye in [Vec3::Z * 5.0, Vec3::new(-4.0, 2.0, 0.0)] {
            let away: Vec<f32> = skin.sort(&renderer, eye).iter().map(|(away, _)| *away).collect();
            assert!(away.len() > 10_000 && away.windows(2).all(|pair| pair[0] >= pair[1]));
        }
    }
}
