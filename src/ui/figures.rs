//! What the last step did, in figures.

use egui::{Grid, Ui};

use crate::world::{BodyReport, DeformationWorld, Frozen};

/// A table of the last step: milliseconds by stage, and the worst of all bodies for volume, depths, gap, passes and
/// steps. `rigid_ms` is what the rigid step took, if the caller measured it.
pub fn figures(ui: &mut Ui, world: &DeformationWorld, rigid_ms: Option<f32>) {
    let report = world.report();
    let times = report.times;
    Grid::new("pliant figures")
        .num_columns(2)
        .striped(true)
        .show(ui, |ui| {
            let mut row = |name: &str, value: String| {
                ui.label(name);
                ui.monospace(value);
                ui.end_row();
            };
            let mut stage = |name: &str, time: f32| row(name, format!("{time:7.2} ms"));
            if let Some(rigid) = rigid_ms {
                stage("rigid bodies", rigid);
            }
            stage("springs", times.springs);
            stage("contact", times.contact);
            stage("deformation", times.deform);
            stage("measuring", times.measure);
            let bodies = || report.bodies.iter().map(|(_, body)| body);
            let most = |of: fn(&BodyReport) -> f32| bodies().map(of).fold(0.0, f32::max);
            let share = |value: f32| format!("{:7.3} %", 100.0 * value);
            row("volume error", share(most(|body| (body.volume_ratio - 1.0).abs())));
            row("depth before", share(most(|body| body.penetration.max_depth_before)));
            row("depth after", share(most(|body| body.penetration.max_depth_after)));
            row("gap", share(most(|body| body.penetration.max_gap)));
            row("vertices inside", format!("{:7}", bodies().map(|body| body.penetration.vertices_inside).sum::<u32>()));
            row("passes", format!("{:7}", bodies().map(|body| body.passes).max().unwrap_or(0)));
            row("steps", format!("{:7}", bodies().map(|body| body.steps).max().unwrap_or(0)));
        })
        .response
        .on_hover_text("Depths and gaps as shares of the body's size");
    for (index, (_, body)) in report.bodies.iter().enumerate() {
        if let Some(frozen) = body.frozen {
            ui.colored_label(ui.visuals().warn_fg_color, format!("body {index} stands still: {}", reason(frozen)));
        }
    }
    for (_, error) in &report.refused {
        ui.colored_label(ui.visuals().warn_fg_color, error.to_string());
    }
}

fn reason(frozen: Frozen) -> &'static str {
    match frozen {
        Frozen::ParentRemoved => "one of its rigid bodies was removed",
        Frozen::ParentDisabled => "one of its rigid bodies is disabled",
        Frozen::NotFinite => "a number is not finite",
    }
}
