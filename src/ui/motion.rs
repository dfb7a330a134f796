//! The motion of a body that moves by itself: its pace, its stiffness, its charts; all can be changed while it moves.

use egui::{ComboBox, Slider, Ui};

use super::charts::charts;
use crate::procdef::{ChartInterpolation, DeformationCharts, Motion, MotionRig, Stiffness, VolumeMode};
use crate::world::{ProcDefHandle, ProcDefWorld};

/// Controls of a body's motion. What is changed is changed in all of `handles`, which must have the same mesh; the first is
/// shown.
pub fn motion(ui: &mut Ui, world: &mut ProcDefWorld, handles: &[ProcDefHandle]) {
    let Some(&first) = handles.first() else { return };
    let Some(rig) = world.model(first).map(|model| model.motion.clone()) else { return };
    pace(ui, world, handles);
    settings(ui, world, handles);
    let Some(now) = world.motion(first).cloned() else { return };
    cycle(ui, world, handles, &rig, &now);
    answer(ui, world, handles, &rig, &now);
}

/// The clock and the strength of the cycle.
fn pace(ui: &mut Ui, world: &mut ProcDefWorld, handles: &[ProcDefHandle]) {
    let Some((mut pace, mut strength)) = world.motion(handles[0]).map(|m| (m.pace, m.strength)) else { return };
    let faster = ui.add(Slider::new(&mut pace, -2.0..=2.0).text("pace")).on_hover_text("Negative runs backwards");
    let stronger = ui
        .add(Slider::new(&mut strength, 0.0..=1.0).text("strength"))
        .on_hover_text("Exponent on the rates of the cycle");
    for motion in [faster.changed() || stronger.changed()].iter().filter(|c| **c).flat_map(|_| handles) {
        if let Some(motion) = world.motion_mut(*motion) {
            (motion.pace, motion.strength) = (pace, strength);
        }
    }
}

/// How the body is simulated.
fn settings(ui: &mut Ui, world: &mut ProcDefWorld, handles: &[ProcDefHandle]) {
    let Some(old) = world.get(handles[0]).map(|body| body.settings) else { return };
    let mut new = old;
    ui.horizontal(|ui| {
        let solves = matches!(new.stiffness, Stiffness::Solve(_));
        ui.label("stiffness by");
        if ui.selectable_label(!solves, "passes").on_hover_text("The paper's iteration").clicked() {
            new.stiffness = Stiffness::Iterations(2);
        }
        if ui.selectable_label(solves, "solve").on_hover_text("The global solve").clicked() {
            new.stiffness = Stiffness::Solve(0.5);
        }
    });
    match &mut new.stiffness {
        Stiffness::Iterations(passes) => ui.add(Slider::new(passes, 1..=64).logarithmic(true).text("passes")),
        Stiffness::Solve(stiffness) => ui.add(Slider::new(stiffness, 0.0..=1.0).text("stiffness")),
    };
    ui.add(Slider::new(&mut new.damping, 0.0..=20.0).text("damping")).on_hover_text("Of all that is not rigid, in 1/s");
    ui.checkbox(&mut new.keep_volume, "keep the volume of cells");
    if new != old {
        for handle in handles {
            if let Some(body) = world.get_mut(*handle) {
                body.settings = new;
            }
        }
    }
}

fn cycle(ui: &mut Ui, world: &mut ProcDefWorld, handles: &[ProcDefHandle], rig: &MotionRig, now: &Motion) {
    let Some(old) = rig.cyclic() else { return };
    let mut new = old.clone();
    ui.separator();
    ui.strong("Cycle");
    let phase = (now.clock / f64::from(old.charts.cycle)).rem_euclid(1.0) as f32;
    let mut changed = edit(ui, "cycle", &mut new.charts, Some(phase));
    if new.speed.is_finite() {
        let backwards = new.speed < 0.0;
        let mut speed = new.speed.abs();
        let text = "phase shifts a second";
        if ui.add(Slider::new(&mut speed, 0.05..=20.0).logarithmic(true).text(text)).changed() {
            new.speed = if backwards { -speed } else { speed };
            changed = true;
        }
    }
    if changed {
        for handle in handles {
            // Charts and speeds of the panel are in range; what is not leaves the old ones.
            world.edit(*handle, |rig| {
                let _ = rig.set_cyclic(Some(new.clone()));
            });
        }
    }
}

fn answer(ui: &mut Ui, world: &mut ProcDefWorld, handles: &[ProcDefHandle], rig: &MotionRig, now: &Motion) {
    let Some(old) = rig.response() else { return };
    let mut new = old.clone();
    ui.separator();
    ui.collapsing("Answer to touches", |ui| {
        let since = now.stimuli().last().map(|stimulus| (stimulus.elapsed / f64::from(old.charts.cycle)) as f32);
        let mut changed = edit(ui, "answer", &mut new.charts, since.filter(|phase| *phase < 1.0));
        let speed = Slider::new(&mut new.speed, 0.05..=20.0).logarithmic(true).text("lengths a second");
        changed |= ui.add(speed).changed();
        let damping = Slider::new(&mut new.damping, 1.0..=20.0).logarithmic(true).text("damping");
        changed |= ui.add(damping).on_hover_text("Over one length the amplitude falls to one over this").changed();
        if changed {
            for handle in handles {
                world.edit(*handle, |rig| {
                    let _ = rig.set_response(Some(new.clone()));
                });
            }
        }
    });
}

/// The charts with what belongs to all three.
fn edit(ui: &mut Ui, name: &str, of: &mut DeformationCharts, phase: Option<f32>) -> bool {
    let mut changed = ui
        .push_id(name, |ui| {
            let changed = charts(ui, of, phase);
            let modes = [
                (VolumeMode::Both, "volume kept by both others"),
                (VolumeMode::Secondary, "volume kept by the secondary"),
                (VolumeMode::Free, "all three free"),
            ];
            let shown = modes.iter().find(|(mode, _)| *mode == of.volume).map_or("", |(_, text)| text);
            let before = of.volume;
            ComboBox::from_id_salt("volume").width(ui.available_width()).selected_text(shown).show_ui(ui, |ui| {
                for (mode, text) in modes {
                    ui.selectable_value(&mut of.volume, mode, text);
                }
            });
            changed || before != of.volume
        })
        .inner;
    let mut smooth = of.charts[0].interpolation == ChartInterpolation::Smooth;
    if ui.checkbox(&mut smooth, "smooth").changed() {
        let interpolation = if smooth { ChartInterpolation::Smooth } else { ChartInterpolation::Linear };
        of.charts.iter_mut().for_each(|chart| chart.interpolation = interpolation);
        changed = true;
    }
    changed |= ui.add(Slider::new(&mut of.cycle, 0.2..=10.0).logarithmic(true).text("seconds a cycle")).changed();
    changed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coupling::procdef::ProcDefStart;
    use crate::math::{Pose, Vec3};
    use crate::mesh::TetrahedralMesh;
    use crate::procdef::{CyclicMotion, MotionFields, OrientationField, ProcDefModel, ProcDefRigBuilder};
    use egui::{Event, Modifiers, PointerButton, Pos2, RawInput, Rect, vec2};
    use rapier3d::pipeline::PhysicsWorld;
    use std::sync::Arc;

    /// A body of one cell whose cycle does nothing yet.
    fn body() -> Arc<ProcDefModel> {
        let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let mesh = TetrahedralMesh::new(corners, vec![[0, 1, 2, 3]]).unwrap();
        let fields =
            MotionFields { orientation: OrientationField::axes(4), amplitude: vec![1.0; 4], phase: vec![0.0; 4] };
        let cyclic = CyclicMotion { charts: DeformationCharts::default(), speed: 1.0, rise: 0.25 };
        let motion = MotionRig::new(&mesh, fields, Some(cyclic), None).unwrap();
        Arc::new(ProcDefModel::new(Arc::new(ProcDefRigBuilder::new(mesh).build().unwrap()), Arc::new(motion)))
    }

    fn press(at: Pos2, pressed: bool) -> Event {
        Event::PointerButton { pos: at, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE }
    }

    /// Two bodies in a world, and a window with the panel of the first.
    struct Window {
        physics: PhysicsWorld,
        world: ProcDefWorld,
        handles: [ProcDefHandle; 2],
        context: egui::Context,
    }

    impl Window {
        fn new() -> Self {
            let (mut physics, mut world) = (PhysicsWorld::new(), ProcDefWorld::new());
            let kind = body();
            let handles = [0.0, 5.0].map(|x| {
                let start = ProcDefStart { pose: Pose::from_translation(Vec3::X * x), ..ProcDefStart::default() };
                world.insert(kind.clone(), &start, &mut physics)
            });
            Self { physics, world, handles, context: egui::Context::default() }
        }

        /// One step of the bodies and one round of the window with an event.
        fn round(&mut self, event: Event) {
            self.world.advance(&mut self.physics, 1);
            let screen = Rect::from_min_size(Pos2::ZERO, vec2(300.0, 900.0));
            let input = RawInput { screen_rect: Some(screen), events: vec![event], ..RawInput::default() };
            let (world, shown) = (&mut self.world, self.handles[0]);
            let mut output = self.context.run_ui(input, |ui| motion(ui, world, &[shown]));
            output.textures_delta.clear();
        }

        /// Drags upwards from a place.
        fn drag_up(&mut self, at: Pos2) {
            let to = at - vec2(0.0, 20.0);
            for event in [Event::PointerMoved(at), press(at, true), Event::PointerMoved(to), press(to, false)] {
                self.round(event);
            }
        }

        /// The primary rate at the beginning of a body's cycle.
        fn rate(&self, body: usize) -> f32 {
            self.world.model(self.handles[body]).unwrap().motion.cyclic().unwrap().charts.at(0.0)[0]
        }

        /// The length of an edge of a body along x.
        fn length(&self, body: usize) -> f32 {
            let x = self.world.get(self.handles[body]).unwrap().positions();
            x[0].distance(x[1])
        }
    }

    #[test]
    fn a_point_that_is_dragged_in_the_panel_changes_the_body_while_it_moves_and_no_other() {
        // The chart's only point is at the left, somewhere below the sliders.
        let found = (4..80).map(|k| Pos2::new(12.0, 8.0 * k as f32)).find_map(|at| {
            let mut window = Window::new();
            window.drag_up(at);
            (window.rate(0) != 1.0).then_some(window)
        });
        let mut window = found.expect("the chart is in the panel");
        assert!(window.rate(0) > 1.2 && window.rate(1) == 1.0, "{} {}", window.rate(0), window.rate(1));
        let rise = window.world.model(window.handles[0]).unwrap().motion.cyclic().unwrap().rise;
        assert_eq!(rise, 0.25, "what is not in the panel stays");
        for _ in 0..60 {
            window.world.advance(&mut window.physics, 1);
        }
        assert!(window.length(0) > window.length(1) + 0.05, "{} {}", window.length(0), window.length(1));
    }
}
