//! Penetration cancellation: passes of hugging fields that push the skin out until it touches (section 4).
//!
//! One pass: gather the contacts of the deformed skin, choose their gauge points together, solve for their strengths so
//! that each ends touching, then carry the whole skin along. Passes are concatenated until nothing is left.

use super::contact::Proximity;
use super::obstacle::ObstaclePart;
use super::penetrations::{Contact, find_contacts, find_piercings};
use super::strength::solve_pass;
use crate::elastic::ElasticBody;

/// Tolerances and limits of the cancellation; lengths as fractions of the body's size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CancelSettings {
    /// Softness `s`: fields fade out over `s` times the segment's size. `None` takes the rig's.
    pub softness: Option<f32>,
    /// Depth that may be left over.
    pub depth_tolerance: f32,
    /// Gap that may be left at a contact.
    pub gap_tolerance: f32,
    /// Most passes.
    pub max_passes: u32,
    /// Most rounds of the solve for the strengths in each pass.
    pub max_rounds: u32,
    /// Most integration steps of a pass; a field whose bound asks for more is weakened and the next pass goes on.
    pub max_steps: u32,
    /// Where the fields are placed.
    pub placement: Placement,
}

/// Where collision fields are placed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Placement {
    /// Fields hug the part, gauge points and strengths are solved for.
    #[default]
    Hugging,
    /// The paper's literal placement (section 4.2): bounding sphere of the part, direction along the line of centres,
    /// one pass, plain sum. For comparison.
    Literal,
}

impl Default for CancelSettings {
    fn default() -> Self {
        Self {
            softness: None,
            depth_tolerance: 5.0e-4,
            gap_tolerance: 2.0e-3,
            max_passes: 8,
            max_rounds: 6,
            max_steps: 64,
            placement: Placement::Hugging,
        }
    }
}

/// What the cancellation of one body did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CancelReport {
    /// The contacts as they were before the first pass.
    pub contacts: Vec<Contact>,
    /// Number of passes.
    pub passes: u32,
}

/// Cancels the penetration of `body` into `parts`: adds passes to its palette and carries its skin along.
///
/// `size` is the body's size, the unit of the tolerances.
pub fn cancel(
    body: &mut ElasticBody,
    parts: &[ObstaclePart],
    near: &[Proximity],
    size: f32,
    settings: &CancelSettings,
) -> CancelReport {
    let mut report = CancelReport::default();
    let tolerance = settings.depth_tolerance * size;
    let softness = settings.softness.unwrap_or(body.rig().softness);
    while report.passes < settings.max_passes {
        let mut contacts = find_contacts(body, parts, near, tolerance);
        if report.passes > 0 {
            contacts.extend(find_piercings(body, parts, near, tolerance));
        }
        if contacts.is_empty() && report.passes == 0 {
            contacts = find_piercings(body, parts, near, tolerance);
        }
        if contacts.is_empty() {
            break;
        }
        // What two passes leave over is small and wedged: it is pushed out on the nearest way, by narrower fields.
        let narrow = (report.passes + 1).saturating_sub(WIDE_PASSES);
        let reach = (softness * if narrow > 0 { 0.5 } else { 1.0 }).clamp(LEAST_SOFTNESS, MOST_SOFTNESS);
        if narrow > 0 {
            contacts =
                contacts.into_iter().map(|c| if c.pierced { c } else { c.by_the_nearest_way(body, parts) }).collect();
        }
        let pass = match settings.placement {
            Placement::Hugging => solve_pass(body, parts, near, &contacts, reach, size, settings),
            Placement::Literal => super::literal::place(body, parts, near, softness),
        };
        report.passes += 1;
        if std::env::var("DEBUG").is_ok() {
            for (c, f) in contacts.iter().zip(&pass.fields) {
                println!(
                    "  pass {} seg {} part {} n {:.2} depth {:.4} points {} r {:.3} pierced {} d {:.4} steps {}",
                    report.passes,
                    c.near.segment,
                    c.near.part,
                    c.near.normal,
                    c.depth(),
                    c.points.len(),
                    c.radius,
                    c.pierced,
                    f.field.displacement().length(),
                    pass.steps
                );
            }
        }
        if report.passes == 1 {
            report.contacts = contacts;
        }
        body.deform_collision(pass);
        if settings.placement == Placement::Literal {
            break;
        }
    }
    report
}

/// Softness outside of these bounds is taken as the bound.
const LEAST_SOFTNESS: f32 = 0.05;
const MOST_SOFTNESS: f32 = 10.0;

/// Passes with fields of full width.
const WIDE_PASSES: u32 = 1;
