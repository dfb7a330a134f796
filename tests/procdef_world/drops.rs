//! A rigid ball against every body that is shipped: in space it hits the body and the momentum of both is kept, on the ground it is
//! dropped on it and bounces or comes to rest, and neither gets into the other.

use crate::scene::{Scene, model};
use pliant::math::Vec3;
use pliant::procdef::{ContactKind, ProcDefModel};
use pliant::world::ProcDefHandle;
use rapier3d::parry::query::PointQuery;
use rapier3d::parry::shape::TriMesh;
use rapier3d::prelude::*;
use rapier3d::utils::AngularInertiaOps;

/// Every mesh that is shipped, by a rig of it.
const BODIES: [&str; 8] =
    ["jellyfish", "small_jellyfish", "worm", "short_worm", "bending_bar", "snail", "heart", "bowel"];

/// How deep a ball is in a body, in metres; negative for a gap. Right also where its centre is inside. A body whose vertices meet
/// it is as deep as they are: the faces between them are not looked at.
fn depth(scene: &Scene, handle: ProcDefHandle, ball: RigidBodyHandle, radius: f32) -> f32 {
    let kind = scene.bodies.model(handle).expect("a model");
    let boundary = &kind.boundary;
    let positions = scene.body(handle).positions();
    let centre = scene.physics.bodies[ball].translation();
    if kind.contacts == ContactKind::Vertices {
        let nearest = positions.iter().map(|x| x.distance(centre)).fold(f32::MAX, f32::min);
        return radius - nearest;
    }
    let surface = TriMesh::new(positions.to_vec(), boundary.clone()).expect("a surface");
    let distance = surface.project_local_point(centre, false).point.distance(centre);
    radius + if is_inside(centre, boundary, positions) { distance } else { -distance }
}

/// Whether a surface goes around a point, by its solid angle.
fn is_inside(x: Vec3, triangles: &[[u32; 3]], positions: &[Vec3]) -> bool {
    let angle = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| positions[v as usize] - x);
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        2.0 * a.dot(b.cross(c)).atan2(la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb)
    };
    triangles.iter().map(angle).sum::<f32>() > 2.0 * std::f32::consts::PI
}

fn ball(scene: &mut Scene, centre: Vec3, radius: f32, density: f32, velocity: Vec3) -> RigidBodyHandle {
    let body = RigidBodyBuilder::dynamic().translation(centre).linvel(velocity);
    scene.physics.insert(body, ColliderBuilder::ball(radius).density(density).friction(0.5)).0
}

/// The momentum of a body with what is attached to it and of a ball, and the angular momentum about the origin.
fn momentum(scene: &Scene, handle: ProcDefHandle, ball: RigidBodyHandle) -> [glam::DVec3; 2] {
    let link = scene.bodies.link(handle).expect("a link");
    let mut sums = [glam::DVec3::ZERO; 2];
    for p in scene.physics.soft_bodies[link.soft_body].particles() {
        let part = p.velocity().as_dvec3() * f64::from(p.mass());
        sums = [sums[0] + part, sums[1] + p.position().as_dvec3().cross(part)];
    }
    for &rigid in link.attachments.iter().flatten().chain([&ball]) {
        let rigid = &scene.physics.bodies[rigid];
        let part = rigid.linvel().as_dvec3() * f64::from(rigid.mass());
        let spin = rigid.mass_properties().effective_world_inv_inertia.inverse() * rigid.angvel();
        sums = [sums[0] + part, sums[1] + rigid.center_of_mass().as_dvec3().cross(part) + spin.as_dvec3()];
    }
    sums
}

#[test]
fn the_momentum_of_a_ball_and_every_body_that_it_hits_in_space_is_kept() {
    for name in BODIES {
        let kind = model(name);
        let radius = radius(&kind);
        let mut scene = Scene::new(0.0, 2);
        let handle = scene.insert(&kind, Vec3::ZERO);
        let side = kind.rig.mesh().positions.iter().copied().max_by(|a, b| a.z.total_cmp(&b.z)).expect("vertices");
        let ball = ball(&mut scene, side + Vec3::Z * (radius + 0.15), radius, 1000.0, Vec3::Z * -3.0);
        let before = momentum(&scene, handle, ball);
        let (mut deepest, mut hit) = (f32::MIN, false);
        for _ in 0..60 {
            scene.run(1.0 / 60.0);
            deepest = deepest.max(depth(&scene, handle, ball, radius));
            hit |= (scene.physics.bodies[ball].linvel() - Vec3::Z * -3.0).length() > 0.3;
        }
        let after = momentum(&scene, handle, ball);
        let error = after[0].distance(before[0]) / before[0].length();
        // Beside the ball's own momentum at a distance of the body's size.
        let turning = after[1].distance(before[1]) / (before[0].length() * f64::from(kind.rig.size()));
        println!("{name}: momentum {error:e}, angular {turning:e}, depth {deepest} m, hit {hit}");
    }
}

/// A ball that is not small beside the triangles of a body whose vertices meet it: it would slip in between them.
fn radius(kind: &ProcDefModel) -> f32 {
    if kind.contacts == ContactKind::Vertices { 2.0 * kind.boundary_edge() } else { 0.12 }
}

#[test]
fn a_ball_that_is_dropped_on_every_body_bounces_or_rests_and_does_not_get_into_it() {
    for name in BODIES {
        let kind = model(name);
        let radius = radius(&kind);
        let mut scene = Scene::new(9.81, 4);
        scene.floor();
        if kind.water.is_some() {
            scene.ocean();
        }
        let handle = scene.insert_on_floor(&kind);
        scene.bodies.motion_mut(handle).expect("a motion").strength = 0.0;
        scene.run(1.0);
        // Above its middle; a snail's is under its shell, and it is hit on its neck.
        let rest = &kind.rig.mesh().positions;
        let middle = if name == "snail" { 0.55 } else { 0.0 };
        let near = |v: &usize| (rest[*v].x - middle).hypot(rest[*v].z) < 0.2;
        let positions = scene.body(handle).positions();
        let top = (0..rest.len()).filter(near).max_by(|&a, &b| positions[a].y.total_cmp(&positions[b].y));
        let top = positions[top.expect("vertices")];
        let ball = ball(&mut scene, top + Vec3::Y * (radius + 0.3), radius, 300.0, Vec3::ZERO);
        scene.physics.bodies[ball].set_enabled_translations(false, true, false, true);
        let (mut deepest, mut end, mut slowest, mut fall, mut touched) = (f32::MIN, f32::MIN, f32::MIN, 0f32, None);
        for frame in 0..240 {
            scene.run(1.0 / 60.0);
            let gap = -depth(&scene, handle, ball, radius);
            let speed = scene.physics.bodies[ball].linvel().y;
            if name == "jellyfish" && frame % 3 == 0 { let e: f32 = { let b = scene.body(handle); b.velocities().iter().zip(b.rig().masses()).map(|(v, m)| 0.5 * m * v.length_squared()).sum() };
               println!("{frame}: gap {gap} v {speed} y {} body v {} at {} kinetic {e} low {}", scene.physics.bodies[ball].translation().y, scene.momentum(handle).y / 235.0, scene.centre(handle), scene.body(handle).positions().iter().map(|x| x.y).fold(9.0f32, f32::min)); }
            deepest = deepest.max(-gap);
            if gap < 0.02 {
                touched.get_or_insert(frame);
            }
            match touched {
                None => fall = fall.max(-speed),
                Some(since) => slowest = if frame < since + 30 { slowest.max(speed) } else { slowest },
            }
            end = if frame >= 210 { end.max(-gap) } else { end };
        }
        let speed = scene.physics.bodies[ball].linvel().y;
        let height = scene.physics.bodies[ball].translation().y;
        println!("{name}: radius {radius}, touch {touched:?} at {fall}, deepest {deepest} m, at the end {end} m, {slowest} m/s after the touch, {speed} m/s at the end, height {height}");
    }
}
