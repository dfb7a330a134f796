//! The panel's part for bodies that move by themselves: which of them, its motion and charts, what is painted, where it is cut.

use std::sync::Arc;

use egui::{ComboBox, Slider, Ui};
use pliant::ui;
use pliant::world::ProcDefHandle;

use super::fields::Field;
use super::overlays::Shown;
use super::section::Cut;
use crate::simulation::{Simulation, SoftKind};

/// What is chosen in the panel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoftPanel {
    /// Index of the soft actor whose motion is shown.
    pub chosen: usize,
    /// Whether changes go to all of its kind.
    all: bool,
}

impl Default for SoftPanel {
    fn default() -> Self {
        Self { chosen: 0, all: true }
    }
}

impl SoftPanel {
    /// Settings, charts and figures.
    pub fn show(&mut self, panel: &mut Ui, simulation: &mut Simulation, shown: &mut Shown) {
        self.chosen = self.chosen.min(simulation.soft_actors.len().saturating_sub(1));
        let Some(kind) = simulation.soft_actors.get(self.chosen).map(|actor| actor.kind.clone()) else { return };
        if simulation.soft_actors.len() > 1 {
            self.choose(panel, simulation);
        }
        view(panel, &kind, shown);
        panel.separator();
        let handles = self.handles(simulation);
        ui::motion(panel, &mut simulation.creatures, &handles);
        panel.separator();
        panel.strong(format!("After {:.2} s", simulation.time()));
        ui::procdef_figures(panel, &simulation.creatures, simulation.rigid_ms, simulation.soft_times);
    }

    fn choose(&mut self, panel: &mut Ui, simulation: &Simulation) {
        panel.horizontal(|panel| {
            let name = |index: usize| simulation.soft_actors.get(index).map(|a| a.name.clone()).unwrap_or_default();
            ComboBox::from_id_salt("soft body").selected_text(name(self.chosen)).show_ui(panel, |panel| {
                for index in 0..simulation.soft_actors.len() {
                    panel.selectable_value(&mut self.chosen, index, name(index));
                }
            });
            panel.checkbox(&mut self.all, "and all of its kind");
        });
    }

    /// The chosen body first, then those that changes go to as well.
    fn handles(&self, simulation: &Simulation) -> Vec<ProcDefHandle> {
        let actors = &simulation.soft_actors;
        let Some(chosen) = actors.get(self.chosen) else { return Vec::new() };
        let others = actors
            .iter()
            .enumerate()
            .filter(|(index, actor)| self.all && *index != self.chosen && Arc::ptr_eq(&actor.kind, &chosen.kind));
        std::iter::once(chosen.handle).chain(others.map(|(_, actor)| actor.handle)).collect()
    }
}

/// What is painted, and where the bodies are cut open.
fn view(panel: &mut Ui, kind: &SoftKind, shown: &mut Shown) {
    let name = Field::ALL.iter().find(|(field, _)| *field == shown.field).map_or("", |(_, name)| name);
    panel.horizontal(|panel| {
        panel.label("show");
        ComboBox::from_id_salt("field").selected_text(name).show_ui(panel, |panel| {
            for (field, name) in Field::ALL {
                panel.selectable_value(&mut shown.field, field, name);
            }
        });
        panel.checkbox(&mut shown.wireframe, "wireframe");
    });
    let mut axis = shown.cut.map(|cut| cut.axis);
    panel.horizontal(|panel| {
        panel.label("cut");
        panel.selectable_value(&mut axis, None, "no");
        for (index, name) in ["x", "y", "z"].into_iter().enumerate() {
            panel.selectable_value(&mut axis, Some(index), name);
        }
    });
    let bounds = pliant::mesh::measure::bounding_box(&kind.model.rig.mesh().positions);
    shown.cut = axis.map(|axis| {
        let (low, high) = (bounds.mins[axis], bounds.maxs[axis]);
        let old = shown.cut.filter(|cut| cut.axis == axis).map_or(0.5 * (low + high), |cut| cut.at);
        let mut at = old;
        panel.add(Slider::new(&mut at, low..=high).text("m"));
        Cut { axis, at }
    });
}
