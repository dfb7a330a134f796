//! The player in the window: scenes to choose from, the hand that grabs, the panel of settings and figures.

use std::sync::Arc;

use glam::Vec3;
use pliant::ui;
use pliant::world::{ProcDefHandle, ProcDefWorld};

use super::args::RunArgs;
use super::moment::Moment;
use super::overlays::Shown;
use super::painter::Painter;
use super::soft_panel::SoftPanel;
use super::{choose, looks};
use crate::render::{Camera, Frame, Renderer};
use crate::scene::scene_names;
use crate::simulation::{BuildError, Simulation, SoftActor, Take};
use crate::window::Stage;

/// How far grabbed skin takes its surroundings along at first, in sizes of the body.
const FIRST_REACH: f32 = 0.6;

/// Plays one scene at a time.
pub struct Player {
    names: Vec<String>,
    current: usize,
    seed: u64,
    simulation: Simulation,
    /// After the last step but one, and after the last.
    moments: [Moment; 2],
    painter: Option<Painter>,
    compute: bool,
    shown: Shown,
    trouble: Option<String>,
    /// Whether the pointer pulls the skin rather than the body under it, and within how many sizes of the body.
    pulls_skin: bool,
    reach: f32,
    soft: SoftPanel,
}

impl Player {
    /// Opens a scene by path or name; the scenes that come with the program can be chosen besides.
    pub fn open(run: &RunArgs) -> anyhow::Result<Self> {
        let simulation = choose::simulation(&run.scene, run.seed)?;
        let mut names = scene_names();
        let current = names.iter().position(|name| *name == run.scene).unwrap_or_else(|| {
            names.insert(0, run.scene.clone());
            0
        });
        let now = Moment::of(&simulation);
        Ok(Self {
            names,
            current,
            seed: run.seed,
            simulation,
            moments: [now.clone(), now],
            painter: None,
            compute: !run.cpu,
            shown: Shown { field: run.show, cut: run.cut, ..Shown::default() },
            trouble: None,
            pulls_skin: false,
            reach: FIRST_REACH,
            soft: SoftPanel::default(),
        })
    }

    fn begin(&mut self, simulation: Simulation) {
        let now = Moment::of(&simulation);
        self.moments = [now.clone(), now];
        self.simulation = simulation;
        self.painter = None;
        self.trouble = None;
    }

    /// The scene from its beginning, with the settings that the panel has now.
    fn again(&self) -> Result<Simulation, BuildError> {
        let old = &self.simulation;
        let mut new = Simulation::new(old.scene.clone(), self.seed)?;
        new.deformation.settings = old.deformation.settings;
        for (before, after) in old.actors.iter().zip(&new.actors) {
            let settings = old.deformation.get(before.handle).map(|body| body.settings);
            if let (Some(settings), Some(body)) = (settings, new.deformation.get_mut(after.handle)) {
                body.settings = settings;
            }
        }
        for (before, after) in old.soft_actors.iter().zip(&new.soft_actors) {
            keep_motion(&old.creatures, before, &mut new.creatures, after.handle);
        }
        Ok(new)
    }
}

/// Gives a body the settings and charts that it had before a restart.
fn keep_motion(old: &ProcDefWorld, before: &SoftActor, new: &mut ProcDefWorld, after: ProcDefHandle) {
    if let (Some(body), Some(again)) = (old.get(before.handle), new.get_mut(after)) {
        again.settings = body.settings;
    }
    // What was never edited is still that of its kind.
    let edited = old.model(before.handle).filter(|model| !Arc::ptr_eq(&model.motion, &before.kind.model.motion));
    if let Some(model) = edited {
        new.edit(after, |rig| {
            // They were set once before, so that they can be set again.
            let _ = rig.set_cyclic(model.motion.cyclic().cloned());
            let _ = rig.set_response(model.motion.response().cloned());
        });
    }
}

impl Stage for Player {
    fn scene_names(&self) -> Vec<String> {
        self.names.clone()
    }

    fn current_scene(&self) -> usize {
        self.current
    }

    fn load_scene(&mut self, index: usize) -> Result<(), String> {
        let name = self.names.get(index).ok_or("there is no such scene")?;
        let simulation = choose::simulation(name, self.seed).map_err(|error| error.to_string())?;
        self.begin(simulation);
        self.current = index;
        Ok(())
    }

    fn restart(&mut self) {
        match self.again() {
            Ok(simulation) => self.begin(simulation),
            Err(error) => self.trouble = Some(error.to_string()),
        }
    }

    fn dt(&self) -> f32 {
        self.simulation.scene.dt
    }

    fn step(&mut self) {
        self.simulation.step();
        self.moments.swap(0, 1);
        self.moments[1] = Moment::of(&self.simulation);
    }

    fn camera(&self) -> Camera {
        looks::camera(&self.simulation.scene.camera)
    }

    fn frame(&mut self, renderer: &mut Renderer, alpha: f32, camera: Camera) -> Frame {
        let painter = self.painter.get_or_insert_with(|| {
            renderer.clear_meshes();
            Painter::new(renderer, &self.simulation, self.compute)
        });
        painter.shown = self.shown;
        let [before, now] = &self.moments;
        let frame = painter.frame(renderer, &self.simulation, [before, now], alpha, camera);
        if let Some(trouble) = painter.trouble() {
            self.trouble = Some(trouble.into());
        }
        frame
    }

    fn grab(&mut self, origin: Vec3, direction: Vec3, other: bool) -> bool {
        let take = if self.pulls_skin == other { Take::Body } else { Take::Skin(self.reach) };
        self.simulation.grab(origin, direction, take)
    }

    fn drag(&mut self, origin: Vec3, direction: Vec3) {
        self.simulation.drag(origin, direction);
    }

    fn release(&mut self) {
        self.simulation.release();
    }

    fn touch(&mut self, origin: Vec3, direction: Vec3) {
        if let Some(actor) = self.simulation.touch(origin, direction) {
            self.soft.chosen = actor;
        }
    }

    fn panel(&mut self, panel: &mut egui::Ui) {
        if let Some(trouble) = &self.trouble {
            panel.colored_label(panel.visuals().error_fg_color, trouble);
        }
        if !self.simulation.soft_actors.is_empty() {
            self.soft.show(panel, &mut self.simulation, &mut self.shown);
        }
        if self.simulation.actors.is_empty() && !self.simulation.soft_actors.is_empty() {
            return;
        }
        ui::settings(panel, &mut self.simulation.deformation);
        panel.horizontal(|panel| {
            panel.label("grab");
            panel.selectable_value(&mut self.pulls_skin, false, "bodies").on_hover_text("Control: the skin");
            panel.selectable_value(&mut self.pulls_skin, true, "skin").on_hover_text("Control: the bodies");
        });
        panel
            .add(egui::Slider::new(&mut self.reach, 0.1..=1.5).text("reach"))
            .on_hover_text("How far grabbed skin takes its surroundings along, in sizes of the body");
        panel.separator();
        panel.strong("Show");
        for (value, text) in [
            (&mut self.shown.springs, "mass-spring sets"),
            (&mut self.shown.reach, "spheres of influence"),
            (&mut self.shown.rigid, "rigid shapes"),
            (&mut self.shown.parts, "collision parts"),
            (&mut self.shown.wireframe, "wireframe"),
        ] {
            panel.checkbox(value, text);
        }
        if panel.checkbox(&mut self.compute, "deform on the device").changed() {
            self.painter = None;
        }
        panel.separator();
        let (time, rigid) = (self.simulation.time(), self.simulation.rigid_ms);
        panel.strong(format!("After {time:.2} s"));
        ui::figures(panel, &self.simulation.deformation, Some(rigid));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_restart_returns_to_the_start_and_keeps_the_settings() {
        let mut player = Player::open(&RunArgs::of("tower")).unwrap();
        let start = player.moments[1].bodies[0].positions.clone();
        (0..3).for_each(|_| player.step());
        assert_eq!((player.moments[0].step, player.moments[1].step), (2, 3));
        player.simulation.deformation.settings.stiffness = 3.0;
        let handle = player.simulation.actors[0].handle;
        player.simulation.deformation.get_mut(handle).unwrap().settings.enabled = false;
        player.restart();
        assert!(player.moments.iter().all(|moment| moment.step == 0 && moment.bodies[0].positions == start));
        assert_eq!(player.simulation.deformation.settings.stiffness, 3.0);
        let handle = player.simulation.actors[0].handle;
        assert!(!player.simulation.deformation.get(handle).unwrap().settings.enabled);
    }

    #[test]
    fn a_restart_keeps_edited_charts_and_settings_of_soft_bodies() {
        let mut player = Player::open(&RunArgs::of("bending-bar")).unwrap();
        let handle = player.simulation.soft_actors[0].handle;
        (0..3).for_each(|_| player.step());
        player.simulation.creatures.get_mut(handle).unwrap().settings.damping = 7.0;
        player.simulation.creatures.edit(handle, |rig| {
            let mut cyclic = rig.cyclic().unwrap().clone();
            cyclic.charts.cycle = 1.25;
            rig.set_cyclic(Some(cyclic)).unwrap();
        });
        player.restart();
        let handle = player.simulation.soft_actors[0].handle;
        let model = player.simulation.creatures.model(handle).unwrap();
        assert_eq!(model.motion.cyclic().unwrap().charts.cycle, 1.25);
        assert_eq!(player.simulation.creatures.get(handle).unwrap().settings.damping, 7.0);
        assert_eq!(player.moments[1].soft[0].positions, player.moments[0].soft[0].positions);
        assert_eq!(player.moments[1].step, 0);
    }

    #[test]
    fn a_scene_that_cannot_be_loaded_is_told_and_the_old_one_goes_on() {
        let mut player = Player::open(&RunArgs::of("tower")).unwrap();
        player.names.push("nowhere".into());
        let (current, broken) = (player.current_scene(), player.names.len() - 1);
        assert!(player.load_scene(broken).unwrap_err().contains("`nowhere`"));
        assert_eq!(player.current_scene(), current);
        player.step();
        assert!(player.load_scene(current).is_ok() && player.moments[1].step == 0);
        assert!(Player::open(&RunArgs::of("nowhere")).is_err());
    }
}
