//! What is measured of a cancelled body.

use pliant::coupling::{
    CancelReport, CancelSettings, Contact, cancel, deepest_on_triangle, deepest_piercing, signed_depth,
};
use pliant::mesh::measure::signed_volume;

use crate::poses::Case;

/// Lengths as fractions of the body's size.
#[derive(Clone, Copy, Debug, Default)]
pub struct Figures {
    /// Deepest vertex.
    pub depth: f32,
    /// Deepest point of a triangle.
    pub piercing: f32,
    /// Widest gap left at a contact.
    pub gap: f32,
    pub inside: u32,
    pub passes: u32,
    /// Volume over the volume before, less 1.
    pub volume: f32,
    /// Triangles turned over against the flow.
    pub folded: u32,
}

pub fn cancelled(case: &mut Case, settings: &CancelSettings) -> (Figures, CancelReport) {
    let triangles = case.body.rig().mesh.triangles.clone();
    let before = signed_volume(case.body.positions(), &triangles);
    let report = cancel(&mut case.body, &case.parts, &case.near, case.size, settings);
    let x = case.body.positions();
    let mut figures = Figures { passes: report.passes, ..Figures::default() };
    for &x in x {
        let depth = case.parts.iter().map(|part| signed_depth(part, x)).fold(0.0, f32::max) / case.size;
        figures.depth = figures.depth.max(depth);
        figures.inside += u32::from(depth > 1e-3);
    }
    figures.piercing = case.parts.iter().map(|part| deepest_piercing(&case.body, part)).fold(0.0, f32::max) / case.size;
    figures.gap = gaps(case, &report).into_iter().fold(0.0, f32::max) / case.size;
    figures.volume = (signed_volume(x, &triangles) / before) as f32 - 1.0;
    figures.folded = folded(case);
    (figures, report)
}

fn folded(case: &Case) -> u32 {
    let body = &case.body;
    let epsilon = 1e-4 * case.size;
    let rig = body.rig();
    let mut count = 0;
    for t in &rig.mesh.triangles {
        let corner = t.map(|v| body.positions()[v as usize]);
        let normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalize_or_zero();
        let all_against = t.iter().all(|&v| {
            let v = v as usize;
            let (_, carried) =
                body.palette().deform_with_normal(rig.mesh.positions[v], rig.mesh.normals[v], &rig.weights[v], epsilon);
            carried.dot(normal) < 0.0
        });
        count += u32::from(all_against);
    }
    count
}

/// How far the skin is from the part at each contact. Contacts of several segments with one part that push the same way
/// count together: the deepest decides how far they are carried.
fn gaps(case: &Case, report: &CancelReport) -> Vec<f32> {
    let x = case.body.positions();
    let triangles = &case.body.rig().mesh.triangles;
    let gap = |contact: &Contact| {
        let mut member = vec![false; x.len()];
        for (v, _) in contact.points.iter().flat_map(|p| p.point.corners()) {
            member[v] = true;
        }
        let part = &case.parts[contact.near.part].placed;
        let touching = triangles.iter().filter(|t| t.iter().any(|&v| member[v as usize]));
        touching.map(|t| deepest_on_triangle(part, t.map(|v| x[v as usize])).1).fold(f32::INFINITY, f32::min)
    };
    let own: Vec<f32> = report.contacts.iter().map(gap).collect();
    let together = |a: &Contact, b: &Contact| a.near.part == b.near.part && a.near.normal.dot(b.near.normal) > 0.5;
    let all = report.contacts.iter().map(|a| {
        let others = report.contacts.iter().zip(&own).filter(|(b, _)| together(a, b));
        others.map(|(_, gap)| *gap).fold(f32::INFINITY, f32::min)
    });
    all.collect()
}
