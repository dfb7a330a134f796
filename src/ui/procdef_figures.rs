//! What the last step did to the bodies that move by themselves, in figures.

use egui::{Grid, Ui};

use crate::coupling::procdef::ParticleFault;
use crate::world::{ProcDefTimes, ProcDefWorld};

/// A table of the last step: milliseconds by stage, bodies, signals under way, contacts. `rapier_ms` is what rapier took and
/// `times` what the bodies took, over all substeps.
pub fn procdef_figures(ui: &mut Ui, world: &ProcDefWorld, rapier_ms: f32, times: ProcDefTimes) {
    let report = world.report();
    Grid::new("pliant procdef figures").num_columns(2).striped(true).show(ui, |ui| {
        let mut row = |name: &str, value: String| {
            ui.label(name);
            ui.monospace(value);
            ui.end_row();
        };
        for (name, time) in [
            ("rapier", rapier_ms),
            ("charts and matching", times.drive),
            ("touch", times.contact),
            ("particles", times.exchange),
        ] {
            row(name, format!("{time:7.2} ms"));
        }
        let stimuli: usize =
            world.iter().filter_map(|(handle, _)| world.motion(handle)).map(|motion| motion.stimuli().len()).sum();
        row("bodies", format!("{:7}", report.bodies.len()));
        row("signals", format!("{stimuli:7}"));
        row("on the ground", format!("{:7}", report.bodies.iter().map(|(_, body)| body.on_ground).sum::<usize>()));
    });
    for (index, (_, body)) in report.bodies.iter().enumerate() {
        if let Some(fault) = body.frozen {
            ui.colored_label(ui.visuals().warn_fg_color, format!("body {index} is left to rapier: {}", reason(fault)));
        }
    }
}

fn reason(fault: ParticleFault) -> &'static str {
    match fault {
        ParticleFault::Removed => "its particles were removed",
        ParticleFault::Disabled => "its particles are disabled",
        ParticleFault::Changed => "it has another number of particles",
        ParticleFault::NotFinite => "a number is not finite",
    }
}
