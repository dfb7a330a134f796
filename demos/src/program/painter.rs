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
use super::surfaces;
use crate::render::{Frame, Ground, Item, Material, MeshId, Region, Renderer, Sun};
use crate::simulation::Simulation;

/// Colour of the edges of triangles.
const WIRE: [f32; 4] = [0.02, 0.02, 0.03, 0.55];

/// Draws one simulation with the meshes of one renderer.
pub struct Painter {
    passes: Option<Passes>,
    trouble: Option<String>,
    skins: Vec<Option<(Skin, Arc<ElasticRig>)>>,
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

    /// The place `alpha` between two moments of a simulation; 1 is the later one.
    pub fn frame(
        &mut self,
        renderer: &mut Renderer,
        simulation: &Simulation,
        moments: [&Moment; 2],
        alpha: f32,
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
                items.push(Item::new(*mesh, from.lerp(to, alpha).to_mat4(), *material));
            }
        }
        Frame {
            camera: looks::camera(&simulation.scene.camera),
            sun: Sun::default(),
            ground: self.ground,
            region: self.region,
            items,
            overlay: overlays::overlay(simulation, &self.shown, moments, alpha),
            fog: looks::fog(&simulation.scene, &self.region),
            ..Frame::default()
        }
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
