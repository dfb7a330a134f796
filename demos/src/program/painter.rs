//! From a simulation to what a renderer draws.
//!
//! Bodies are deformed by the compute pass in the buffers that are drawn, or uploaded from memory where the device
//! refuses or it is so wished. Pictures lie anywhere between two steps: vertices, obstacles and overlays are mixed.

use std::sync::Arc;

use glam::Mat4;
use pliant::elastic::ElasticRig;

use super::compute_skin::{ComputeSkin, Passes};
use super::looks;
use super::memory_skin::MemorySkin;
use super::moment::Moment;
use super::overlays::{self, Shown};
use super::soft_painter::SoftPainter;
use super::surfaces;
use super::water;
use crate::render::{Camera, Frame, Ground, Item, Material, MeshId, Region, Renderer};
use crate::simulation::Simulation;

/// Colour of the edges of triangles.
const WIRE: [f32; 4] = [0.02, 0.02, 0.03, 0.55];

/// Glass fainter than this casts no shadow: it would be more grain than shadow.
const FAINTEST_CASTER: f32 = 0.3;

/// Draws one simulation with the meshes of one renderer.
pub struct Painter {
    passes: Option<Passes>,
    trouble: Option<String>,
    skins: Vec<Option<(Skin, Arc<ElasticRig>)>>,
    soft: SoftPainter,
    obstacles: Vec<Option<(MeshId, Material)>>,
    ground: Option<Ground>,
    region: Region,
    /// What is drawn besides the surfaces.
    pub shown: Shown,
}

enum Skin {
    Compute(Box<ComputeSkin>),
    Memory(Box<MemorySkin>),
}

impl Painter {
    /// Makes the meshes of a simulation; with `compute`, bodies are deformed on the device.
    pub fn new(renderer: &mut Renderer, simulation: &Simulation, compute: bool) -> Self {
        let grounds = simulation.obstacles.iter().map(|o| looks::ground(&o.obstacle));
        let first = grounds.clone().position(|g| g.is_some());
        let ground = grounds.flatten().next();
        let obstacles = simulation.obstacles.iter().enumerate().map(|(index, obstacle)| {
            (Some(index) != first)
                .then(|| (renderer.add_mesh(&surfaces::surface(obstacle)), looks::obstacle(&obstacle.obstacle)))
        });
        let obstacles = obstacles.collect();
        let mut painter = Self {
            passes: compute.then(|| Passes::new(renderer.device())),
            trouble: None,
            skins: Vec::new(),
            soft: SoftPainter::new(renderer, simulation, compute),
            obstacles,
            region: looks::region(simulation, ground.as_ref()),
            ground,
            shown: Shown::default(),
        };
        for actor in &simulation.actors {
            let rig = simulation.deformation.get(actor.handle).map(|body| body.rig().clone());
            let skin = rig.and_then(|rig| Some((painter.skin(renderer, &rig)?, rig)));
            painter.skins.push(skin);
        }
        painter
    }

    /// Why bodies are not deformed on the device although they should be.
    pub fn trouble(&self) -> Option<&str> {
        self.trouble.as_deref()
    }

    fn skin(&mut self, renderer: &mut Renderer, rig: &ElasticRig) -> Option<Skin> {
        if let Some(passes) = &self.passes {
            match ComputeSkin::new(renderer, passes, rig) {
                Ok(skin) => return Some(Skin::Compute(Box::new(skin))),
                Err(error) => self.trouble = Some(error.to_string()),
            }
        }
        self.memory(renderer, rig)
    }

    fn memory(&mut self, renderer: &mut Renderer, rig: &ElasticRig) -> Option<Skin> {
        let made = MemorySkin::new(renderer, rig).map_err(|error| self.trouble = Some(error.to_string()));
        made.ok().map(|skin| Skin::Memory(Box::new(skin)))
    }

    /// The place `alpha` between two moments of a simulation, 1 is the later one, as `camera` sees it.
    pub fn frame(
        &mut self,
        renderer: &mut Renderer,
        simulation: &Simulation,
        moments: [&Moment; 2],
        alpha: f32,
        camera: Camera,
    ) -> Frame {
        let mut items = Vec::new();
        for (index, actor) in simulation.actors.iter().enumerate() {
            let Some(mesh) = self.show(renderer, index, moments, alpha) else { continue };
            let mut item = Item::new(mesh, Mat4::IDENTITY, looks::body(actor));
            item.wire = self.shown.wireframe.then_some(WIRE);
            if self.shown.inside() {
                item.material = item.material.with_alpha(0.55);
            }
            items.push(item);
        }
        let [from, to] = moments.map(|moment| &moment.obstacles);
        for ((obstacle, from), to) in self.obstacles.iter().zip(from).zip(to) {
            if let Some((mesh, material)) = obstacle {
                let item = Item::new(*mesh, from.lerp(to, alpha).to_mat4(), *material);
                items.push(Item { casts_shadow: material.alpha >= FAINTEST_CASTER, ..item });
            }
        }
        let mut overlay = overlays::overlay(simulation, &self.shown, moments, alpha);
        let soft = moments.map(|moment| &moment.soft[..]);
        items.extend(self.soft.items(renderer, simulation, soft, alpha, (&camera, &self.shown, &mut overlay)));
        let mut frame = Frame {
            camera,
            sun: looks::sun(&simulation.scene.camera),
            ground: self.ground,
            region: self.region,
            items,
            overlay,
            fog: looks::fog(&simulation.scene, &self.region),
            ..Frame::default()
        };
        if water::is_diving(&simulation.scene) {
            water::dive(&mut frame);
        }
        frame
    }

    /// Brings a body's mesh up to date. A device that refuses gets vertices from memory from then on.
    fn show(&mut self, renderer: &mut Renderer, index: usize, moments: [&Moment; 2], alpha: f32) -> Option<MeshId> {
        let bodies = moments.map(|moment| moment.bodies.get(index));
        let [Some(from), Some(to)] = bodies else { return None };
        if let (Some((Skin::Compute(skin), rig)), Some(passes)) = (self.skins.get_mut(index)?.as_mut(), &self.passes) {
            match skin.show(renderer, passes, [(moments[0].step, from), (moments[1].step, to)], alpha) {
                Ok(mesh) => return Some(mesh),
                Err(error) => {
                    let rig = rig.clone();
                    self.trouble = Some(error.to_string());
                    self.skins[index] = self.memory(renderer, &rig).map(|skin| (skin, rig));
                }
            }
        }
        match self.skins.get_mut(index)?.as_mut()? {
            (Skin::Memory(skin), _) => skin.show(renderer, [from, to], alpha).ok(),
            (Skin::Compute(_), _) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::choose;
    use crate::render::device::tests::device_or_skip;
    use crate::render::{Picture, picture};

    const SIZE: [u32; 2] = [200, 240];

    #[test]
    fn between_two_steps_both_ways_of_deforming_draw_the_same() {
        let Some(gpu) = device_or_skip("between_two_steps_both_ways_of_deforming_draw_the_same") else { return };
        let mut simulation = choose::simulation("tower", 0).unwrap();
        let mut moments = [Moment::of(&simulation), Moment::of(&simulation)];
        for _ in 0..45 {
            simulation.step();
            moments.swap(0, 1);
            moments[1] = Moment::of(&simulation);
        }
        let middle = moments[1].bodies[0].positions[0];
        let pictures = [true, false].map(|compute| {
            let mut renderer = Renderer::new(&gpu.device, &gpu.queue, picture::FORMAT, SIZE);
            let mut painter = Painter::new(&mut renderer, &simulation, compute);
            let target = Picture::new(&gpu.device, SIZE);
            [0.0, 0.3, 1.0].map(|alpha| {
                let eye = middle + glam::Vec3::new(1.0, 0.5, 3.5);
                let camera = Camera { eye, target: middle, ..looks::camera(&simulation.scene.camera) };
                let frame = painter.frame(&mut renderer, &simulation, [&moments[0], &moments[1]], alpha, camera);
                assert_eq!(painter.trouble(), None);
                target.take(&mut renderer, &frame).unwrap()
            })
        });
        let difference = |a: &image::RgbaImage, b: &image::RgbaImage| {
            let sum: u64 = a.as_raw().iter().zip(b.as_raw()).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
            sum as f64 / a.as_raw().len() as f64
        };
        let [device, memory] = &pictures;
        let moved = difference(&memory[0], &memory[2]);
        assert!(moved > 1.0, "the camel falls: {moved}");
        for (device, memory) in device.iter().zip(memory) {
            let apart = difference(device, memory);
            assert!(apart < 0.1 * moved, "{apart} of {moved}");
        }
        let early = difference(&device[0], &device[1]);
        let late = difference(&device[1], &device[2]);
        assert!(0.0 < early && early < late, "at 0.3 the earlier step is nearer: {early}, {late}");
    }
}
