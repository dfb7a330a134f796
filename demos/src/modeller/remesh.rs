//! Even triangles of a wished size: long edges are split, short ones collapsed, edges flipped
//! towards six neighbours per vertex and fatter triangles, vertices relaxed on the surface.

use glam::Vec3;

use super::field::Field;
use super::mend::mend;
use super::mesh::Mesh;
use super::relax::relax;
use super::surgery::Surgery;

/// Edges longer than this times the wished length are split.
const LONG: f32 = 1.34;
/// Edges shorter than this times the wished length are collapsed.
const SHORT: f32 = 0.75;
/// Between long and short the edges end a little shorter than wished, so more is wished.
const SHORTFALL: f32 = 1.025;

/// Remeshes until the count of triangles is within about two percent of `count`. `fineness` is the
/// wished edge length at a point, up to a factor common to all points.
pub fn remesh_to_count(mesh: Mesh, field: &impl Field, fineness: &impl Fn(Vec3) -> f32, count: usize) -> Mesh {
    let mut mesh = mesh;
    let mut factor = first_factor(&mesh, fineness, count);
    for attempt in 0..8 {
        let rounds = if attempt == 0 { 8 } else { 4 };
        mesh = remesh(mesh, field, &|p| fineness(p) * factor, rounds);
        let ratio = mesh.triangles.len() as f32 / count as f32;
        if (ratio - 1.0).abs() < 0.022 {
            break;
        }
        factor *= ratio.powf(0.75);
    }
    polish(mesh, field, &|p| fineness(p) * factor)
}

/// Splits, collapses, flips and relaxes, `rounds` times.
fn remesh(mesh: Mesh, field: &impl Field, wished: &impl Fn(Vec3) -> f32, rounds: usize) -> Mesh {
    let mut mesh = mesh;
    for _ in 0..rounds {
        mesh = split_long_edges(&mesh, wished);
        mesh = collapse_short_edges(&mesh, wished);
        mesh = flip_towards_six(&mesh);
        relax(&mut mesh, field, wished, 2);
        mesh = mend(mesh, field, wished);
    }
    mesh
}

/// The last rounds change no count any more, only the shapes of the triangles.
fn polish(mesh: Mesh, field: &impl Field, wished: &impl Fn(Vec3) -> f32) -> Mesh {
    let mut mesh = mesh;
    for _ in 0..5 {
        mesh = flip_towards_fat(&mesh);
        relax(&mut mesh, field, wished, 3);
        mesh = mend(mesh, field, wished);
    }
    mesh
}

/// The factor on `fineness` that an even covering of the surface by `count` triangles needs.
fn first_factor(mesh: &Mesh, fineness: &impl Fn(Vec3) -> f32, count: usize) -> f32 {
    let units: f32 = mesh
        .triangles
        .iter()
        .map(|&t| {
            let [a, b, c] = mesh.corners(t);
            (b - a).cross(c - a).length() * 0.5 / fineness((a + b + c) / 3.0).powi(2)
        })
        .sum();
    SHORTFALL * (units / count as f32 * 4.0 / 3.0f32.sqrt()).sqrt()
}

/// The edges by length over wished length.
fn relative_lengths(mesh: &Mesh, wished: &impl Fn(Vec3) -> f32) -> Vec<(f32, (u32, u32))> {
    let relative = |&(a, b): &(u32, u32)| {
        let [pa, pb] = [a, b].map(|v| mesh.positions[v as usize]);
        pa.distance(pb) / wished((pa + pb) * 0.5)
    };
    let edges = mesh.edges();
    let mut lengths: Vec<_> = edges.iter().map(|e| (relative(e), *e)).collect();
    lengths.sort_by(|a, b| a.0.total_cmp(&b.0));
    lengths
}

/// Splits what is too long, the longest first.
fn split_long_edges(mesh: &Mesh, wished: &impl Fn(Vec3) -> f32) -> Mesh {
    let mut surgery = Surgery::on(mesh);
    for (relative, (a, b)) in relative_lengths(mesh, wished).into_iter().rev() {
        if relative < LONG {
            break;
        }
        let middle = (surgery.position(a) + surgery.position(b)) * 0.5;
        surgery.split(a, b, middle);
    }
    surgery.finish()
}

/// Collapses what is too short, the shortest first.
fn collapse_short_edges(mesh: &Mesh, wished: &impl Fn(Vec3) -> f32) -> Mesh {
    let mut surgery = Surgery::on(mesh);
    for (relative, (a, b)) in relative_lengths(mesh, wished) {
        if relative > SHORT {
            break;
        }
        let (pa, pb) = (surgery.position(a), surgery.position(b));
        let middle = (pa + pb) * 0.5;
        // An end may have moved by an earlier collapse.
        if pa.distance(pb) <= SHORT * wished(middle) {
            let longest = LONG * wished(middle);
            let _merged = surgery.collapse(a, b, middle, longest)
                || surgery.collapse(a, b, pa, longest)
                || surgery.collapse(a, b, pb, longest);
        }
    }
    surgery.finish()
}

/// Flips the edges whose flip brings the four vertices nearer to six neighbours each.
fn flip_towards_six(mesh: &Mesh) -> Mesh {
    let mut surgery = Surgery::on(mesh);
    for (a, b) in mesh.edges() {
        let Some([c, d]) = surgery.opposite(a, b) else {
            continue;
        };
        let excess = |v: u32, change: i32| (surgery.valence(v) + change - 6).pow(2);
        let before = excess(a, 0) + excess(b, 0) + excess(c, 0) + excess(d, 0);
        let after = excess(a, -1) + excess(b, -1) + excess(c, 1) + excess(d, 1);
        if after < before {
            surgery.flip(a, b);
        }
    }
    surgery.finish()
}

/// Flips the edges whose flip widens the smallest angle of the two triangles.
fn flip_towards_fat(mesh: &Mesh) -> Mesh {
    let mut surgery = Surgery::on(mesh);
    for (a, b) in mesh.edges() {
        let Some([c, d]) = surgery.opposite(a, b) else {
            continue;
        };
        let [pa, pb, pc, pd] = [a, b, c, d].map(|v| surgery.position(v));
        let before = slimness(pa, pb, pc).max(slimness(pb, pa, pd));
        let after = slimness(pc, pa, pd).max(slimness(pd, pb, pc));
        if after < before - 0.02 {
            surgery.flip(a, b);
        }
    }
    surgery.finish()
}

/// The cosine of the smallest angle: the larger, the slimmer.
fn slimness(a: Vec3, b: Vec3, c: Vec3) -> f32 {
    let cosine = |p: Vec3, q: Vec3, r: Vec3| (q - p).normalize().dot((r - p).normalize());
    cosine(a, b, c).max(cosine(b, c, a)).max(cosine(c, a, b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modeller::quality::Quality;
    use crate::modeller::surface::mesh_of;

    #[test]
    fn a_remeshed_sphere_is_even_and_closed_and_has_the_wished_count() {
        let sphere = |p: Vec3| p.length() - 1.0;
        let nets = mesh_of(&sphere, Vec3::splat(-1.3), Vec3::splat(1.3), 0.1);
        let mesh = remesh_to_count(nets, &sphere, &|_| 1.0, 1500);
        assert!(mesh.is_closed());
        assert_eq!(mesh.euler_characteristic(), 2);
        assert!(mesh.triangles.len().abs_diff(1500) <= 40);
        let quality = Quality::of(&mesh);
        assert!(quality.smallest_angle > 30.0, "{quality:?}");
    }
}
