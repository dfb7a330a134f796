//! The settings that are worth a slider.

use egui::{Slider, Ui};

use crate::coupling::Placement;
use crate::world::DeformationWorld;

/// Softness that the slider starts from where the rig's own was used before.
const FIRST_SOFTNESS: f32 = 1.2;

/// Controls of a world's settings: stiffness, softness, deformation on or off, and where collision fields are placed.
/// They act from the next step on.
pub fn settings(ui: &mut Ui, world: &mut DeformationWorld) {
    let handles: Vec<_> = world.iter().map(|(handle, _)| handle).collect();
    let mut enabled = world.iter().all(|(_, body)| body.settings.enabled);
    if ui.checkbox(&mut enabled, "elastic deformation").changed() {
        for handle in handles {
            if let Some(body) = world.get_mut(handle) {
                body.settings.enabled = enabled;
            }
        }
    }
    let settings = &mut world.settings;
    ui.add(Slider::new(&mut settings.stiffness, 0.1..=10.0).logarithmic(true).text("stiffness"))
        .on_hover_text("Factor on the stiffness of all contacts");
    softness(ui, &mut settings.cancel.softness);
    ui.horizontal(|ui| {
        ui.label("fields");
        ui.selectable_value(&mut settings.cancel.placement, Placement::Hugging, "hugging")
            .on_hover_text("Collision fields that hug each convex part");
        ui.selectable_value(&mut settings.cancel.placement, Placement::Literal, "literal")
            .on_hover_text("The paper's placement on bounding spheres, for comparison");
    });
}

fn softness(ui: &mut Ui, softness: &mut Option<f32>) {
    let mut own = softness.is_none();
    if ui.checkbox(&mut own, "softness of the rig").changed() {
        *softness = (!own).then_some(FIRST_SOFTNESS);
    }
    let mut value = softness.unwrap_or(FIRST_SOFTNESS);
    let slider = Slider::new(&mut value, 0.2..=4.0).text("softness");
    if ui.add_enabled(!own, slider).on_hover_text("How far a dent spreads, in sizes of the segment").changed() {
        *softness = Some(value);
    }
}
