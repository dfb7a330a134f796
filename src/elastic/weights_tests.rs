//! Tests of weights from bones on swept tubes.

use super::*;
use crate::math::Quat;

/// A closed tube of round cross-section along points in the plane z = 0.
fn tube(path: &[Vec3], radius: f32, around: u32) -> TriangleMesh {
    let n = path.len();
    let mut p = Vec::new();
    for (k, centre) in path.iter().enumerate() {
        let along = (path[(k + 1).min(n - 1)] - path[k.saturating_sub(1)]).normalize();
        let side = along.cross(Vec3::Z);
        for j in 0..around {
            let phi = std::f32::consts::TAU * j as f32 / around as f32;
            p.push(*centre + radius * (side * phi.cos() + Vec3::Z * phi.sin()));
        }
    }
    let at = |k: usize, j: u32| k as u32 * around + j % around;
    let (low, high) = (p.len() as u32, p.len() as u32 + 1);
    p.extend([path[0], path[n - 1]]);
    let mut t = Vec::new();
    for j in 0..around {
        t.push([low, at(0, j), at(0, j + 1)]);
        t.push([high, at(n - 1, j + 1), at(n - 1, j)]);
        for k in 0..n - 1 {
            t.push([at(k, j), at(k + 1, j), at(k, j + 1)]);
            t.push([at(k, j + 1), at(k + 1, j), at(k + 1, j + 1)]);
        }
    }
    TriangleMesh::from_triangles(p, t).unwrap()
}

/// Two legs of radius 0.1 side by side with a gap of a centimetre, joined by a bend at the top.
fn legs() -> TriangleMesh {
    let mut path: Vec<Vec3> = (0..60).map(|k| Vec3::new(-0.105, k as f32 / 60.0, 0.0)).collect();
    for k in 0..=20 {
        let phi = std::f32::consts::PI * (1.0 - k as f32 / 20.0);
        path.push(Vec3::new(0.105 * phi.cos(), 1.0 + 0.105 * phi.sin(), 0.0));
    }
    path.extend((0..60).rev().map(|k| Vec3::new(0.105, k as f32 / 60.0, 0.0)));
    tube(&path, 0.1, 16)
}

/// Left leg, right leg, hip; the legs' bones lie `shift` off their middle, away from each other.
fn leg_bones(shift: f32) -> [[Vec3; 2]; 3] {
    let leg = |x: f32| [Vec3::new(x, 0.0, 0.0), Vec3::new(x, 0.9, 0.0)];
    [leg(-0.105 - shift), leg(0.105 + shift), [Vec3::new(-0.1, 1.05, 0.0), Vec3::new(0.1, 1.05, 0.0)]]
}

fn weight_of(w: &SkinWeights, segment: u16) -> f32 {
    (0..MAX_INFLUENCES).filter(|&k| w.segments[k] == segment).map(|k| w.weights[k]).sum()
}

fn weights(mesh: &TriangleMesh, bones: &[[Vec3; 2]]) -> Vec<SkinWeights> {
    compute_weights(mesh, bones, &WeightOptions::default()).unwrap()
}

#[test]
fn weights_are_not_negative_and_sum_to_one_and_most_are_a_single_one() {
    let w = weights(&legs(), &leg_bones(0.0));
    for w in &w {
        assert!(w.weights.iter().all(|x| (0.0..=1.0).contains(x)));
        assert!((w.weights.iter().sum::<f32>() - 1.0).abs() < 1e-6);
    }
    let single = w.iter().filter(|w| w.weights[0] == 1.0).count();
    assert!(single * 10 > w.len() * 7, "{single} of {}", w.len());
    assert!(single < w.len());
}

#[test]
fn legs_that_nearly_touch_get_nothing_from_each_other() {
    // With the bones off the middle, the inner side of each leg is nearer to the other's bone than to its own.
    for shift in [0.0, 0.04, 0.08] {
        let mesh = legs();
        for (p, w) in mesh.positions.iter().zip(weights(&mesh, &leg_bones(shift))) {
            if p.y < 0.9 {
                let other = if p.x < 0.0 { 1 } else { 0 };
                assert_eq!(weight_of(&w, other), 0.0, "{shift} {p} {w:?}");
            }
            if p.y < 0.6 {
                assert_eq!(w.weights[0], 1.0, "{shift} {p} {w:?}");
            }
        }
    }
}

#[test]
fn weights_change_smoothly_along_the_surface() {
    for (mesh, bones) in [
        (legs(), leg_bones(0.0).to_vec()),
        (
            tube(&(0..=80).map(|k| Vec3::X * (k as f32 / 40.0)).collect::<Vec<_>>(), 0.15, 20),
            vec![[Vec3::ZERO, Vec3::X], [Vec3::X, Vec3::X * 2.0]],
        ),
    ] {
        let w = weights(&mesh, &bones);
        let width = mesh
            .positions
            .iter()
            .flat_map(|p| bones.iter().map(|b| distance_to_bone(*p, b).1))
            .filter(|d| *d > 0.05)
            .fold(f64::MAX, f64::min);
        for t in &mesh.triangles {
            for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
                let length = f64::from(mesh.positions[a as usize].distance(mesh.positions[b as usize]));
                for s in 0..bones.len() as u16 {
                    let step = f64::from(weight_of(&w[a as usize], s) - weight_of(&w[b as usize], s)).abs();
                    assert!(step <= length / width + 1e-3, "{step} over {length} of {width}");
                }
            }
        }
    }
}

#[test]
fn the_border_of_a_straight_tube_lies_in_the_middle_and_is_symmetric() {
    let mesh = tube(&(0..=80).map(|k| Vec3::X * (k as f32 / 40.0)).collect::<Vec<_>>(), 0.15, 20);
    let w = weights(&mesh, &[[Vec3::ZERO, Vec3::X], [Vec3::X, Vec3::X * 2.0]]);
    for (p, w) in mesh.positions.iter().zip(&w) {
        let first = weight_of(w, 0);
        if (p.x - 1.0).abs() < 1e-4 {
            assert!((first - 0.5).abs() < 0.01, "{p} {first}");
        }
        if p.x < 0.84 {
            assert_eq!(first, 1.0);
        }
        if p.x > 1.16 {
            assert_eq!(first, 0.0);
        }
    }
}

#[test]
fn turning_and_moving_everything_does_not_change_the_weights() {
    let mesh = legs();
    let turn = Quat::from_axis_angle(Vec3::new(1.0, 2.0, -0.5).normalize(), 1.1);
    let place = |p: Vec3| turn * p + Vec3::new(0.3, -0.2, 0.7);
    let there = mesh.positions.iter().map(|p| place(*p)).collect();
    let moved = TriangleMesh::from_triangles(there, mesh.triangles.clone()).unwrap();
    let bones = leg_bones(0.02);
    for (a, b) in weights(&mesh, &bones).iter().zip(&weights(&moved, &bones.map(|b| b.map(place)))) {
        for s in 0..3 {
            assert!((weight_of(a, s) - weight_of(b, s)).abs() < 2e-3, "{a:?} {b:?}");
        }
    }
}

#[test]
fn seams_share_their_weights_and_two_runs_agree() {
    let mut mesh = legs();
    let n = mesh.positions.len() as u32;
    let t = mesh.triangles.len() / 2;
    for k in 0..3 {
        let old = mesh.triangles[t][k];
        mesh.positions.push(mesh.positions[old as usize]);
        mesh.triangles[t][k] = n + k as u32;
    }
    let split = TriangleMesh::from_triangles(mesh.positions, mesh.triangles).unwrap();
    let w = weights(&split, &leg_bones(0.0));
    assert!(split.welded.iter().enumerate().filter(|(v, w)| **w as usize != *v).count() == 3);
    assert!(split.welded.iter().enumerate().all(|(v, &p)| w[v] == w[p as usize]));
    assert_eq!(w, weights(&split, &leg_bones(0.0)));
    let plain = weights(&legs(), &leg_bones(0.0));
    assert_eq!(w[..n as usize], plain[..]);
}

#[test]
fn clothes_on_a_body_have_regions_of_their_own() {
    let path: Vec<Vec3> = (0..=40).map(|k| Vec3::X * (k as f32 / 20.0)).collect();
    let (body, coat) = (tube(&path, 0.1, 12), tube(&path, 0.13, 12));
    let n = body.positions.len() as u32;
    let mut p = body.positions.clone();
    p.extend(&coat.positions);
    let mut t = body.triangles.clone();
    t.extend(coat.triangles.iter().map(|t| t.map(|i| i + n)));
    let both = TriangleMesh::from_triangles(p, t).unwrap();
    let w = weights(&both, &[[Vec3::ZERO, Vec3::X], [Vec3::X, Vec3::X * 2.0]]);
    assert!((0..both.positions.len()).all(|v| weight_of(&w[v], 1) == 1.0 || both.positions[v].x < 1.2));
    assert!((0..both.positions.len()).all(|v| weight_of(&w[v], 0) == 1.0 || both.positions[v].x > 0.8));
}

#[test]
fn hard_borders_one_bone_and_points_on_a_bone_work() {
    let mesh = legs();
    let hard = WeightOptions { blend: 0.0, ..WeightOptions::default() };
    let w = compute_weights(&mesh, &leg_bones(0.0), &hard).unwrap();
    assert!(w.iter().all(|w| w.weights[0] == 1.0));
    assert!(weights(&mesh, &[[Vec3::ZERO; 2]]).iter().all(|w| w.weights[0] == 1.0 && w.segments[0] == 0));
    let on = mesh.positions[5];
    let w = weights(&mesh, &[[on, on], [Vec3::ZERO, Vec3::Y], [on, on]]);
    assert!(w.iter().all(|w| (w.weights.iter().sum::<f32>() - 1.0).abs() < 1e-6));
}

#[test]
fn bad_input_is_refused_with_the_bone_at_fault() {
    let mesh = legs();
    let error = |bones: &[[Vec3; 2]], options: WeightOptions| compute_weights(&mesh, bones, &options).unwrap_err();
    let plain = WeightOptions::default;
    assert_eq!(error(&[], plain()), WeightsError::NoBones);
    assert_eq!(error(&[[Vec3::ZERO; 2], [Vec3::NAN, Vec3::X]], plain()), WeightsError::BoneNotFinite(1));
    assert_eq!(error(&vec![[Vec3::ZERO; 2]; 65536], plain()), WeightsError::TooManyBones(65536));
    let radii = |radii: Vec<f32>| WeightOptions { radii, ..plain() };
    assert!(matches!(
        error(&[[Vec3::ZERO; 2]], radii(vec![1.0; 2])),
        WeightsError::RadiiMismatch { given: 2, bones: 1 }
    ));
    assert!(matches!(error(&[[Vec3::ZERO; 2]], radii(vec![-1.0])), WeightsError::BadRadius { bone: 0, .. }));
    assert_eq!(error(&[[Vec3::ZERO; 2]], WeightOptions { blend: 11.0, ..plain() }), WeightsError::BadBlend(11.0));
    let mut torn = legs();
    torn.welded.pop();
    assert!(matches!(compute_weights(&torn, &leg_bones(0.0), &plain()), Err(WeightsError::BadMesh(_))));
}
