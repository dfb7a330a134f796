//! Elastic foundation: the repelling impulse in proportion to the depth of penetration (section 6.3).
//!
//! Points of the skin that have gone into a part are springs and dampers with Coulomb friction. All of them are solved
//! together, implicitly, on private copies of the velocities, in a few substeps; only the change of velocity is written
//! to rapier. Implicit springs are stable for any stiffness, and they never pull.

use rapier3d::dynamics::{RigidBodyHandle, RigidBodySet};

use super::velocities::Velocities;
use crate::math::Vec3;

/// A point of the skin inside an obstacle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundationPoint {
    /// The segment's rigid body.
    pub body: RigidBodyHandle,
    /// The obstacle's rigid body, if it has one.
    pub other: Option<RigidBodyHandle>,
    /// Where the point is.
    pub position: Vec3,
    /// Way out of the obstacle.
    pub normal: Vec3,
    /// Depth along the way out, in metres, positive.
    pub depth: f32,
    /// Stiffness in N/m: this point's share of the contact's.
    pub stiffness: f32,
    /// Damping in N s/m: this point's share.
    pub damping: f32,
    /// Friction coefficient.
    pub friction: f32,
    /// Fastest speed along the normal at which the spring may send the point out, in m/s: what it came in with. A stiff
    /// spring that finds itself deep after one long step would otherwise make energy out of nothing.
    pub release: f32,
}

/// Substeps and sweeps of the implicit solve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FoundationSettings {
    /// Substeps of one step: more lower the depth and the numerical damping.
    pub substeps: u32,
    /// Gauss-Seidel sweeps a substep.
    pub sweeps: u32,
}

impl Default for FoundationSettings {
    fn default() -> Self {
        Self { substeps: 4, sweeps: 8 }
    }
}

/// Shares a body's contact stiffness and damping among the points of all its contacts, in proportion to their depth, so
/// that a point that just touches adds nothing and nothing jumps when points come and go.
///
/// Contacts that push the same way share; contacts that push across each other do not. So a floor of many tiles is as soft
/// as one of a single box, and a body in a corner rests on each wall with the full stiffness.
pub fn share(contacts: &mut [Vec<FoundationPoint>], stiffness: f32, damping: f32) {
    let sums: Vec<(Vec3, f32)> = contacts
        .iter()
        .map(|points| (points.first().map_or(Vec3::ZERO, |p| p.normal), points.iter().map(|p| p.depth).sum()))
        .collect();
    for (points, (normal, _)) in contacts.iter_mut().zip(&sums) {
        let total: f32 = sums.iter().map(|(other, sum)| normal.dot(*other).max(0.0) * sum).sum();
        for point in points {
            let share = point.depth / total;
            point.stiffness = stiffness * share;
            point.damping = damping * share;
        }
    }
}

struct Row {
    a: usize,
    b: Option<usize>,
    depth: f32,
    /// Inverse of the effective mass along the normal.
    response: f32,
    /// Upper bound of the inverse of the effective mass across it.
    slide_response: f32,
    pressure: f32,
    grip: Vec3,
}

/// Pushes the bodies out over the next `dt` seconds: changes their velocities in `bodies`.
pub fn push_back(
    points: &[FoundationPoint],
    gravity: Vec3,
    dt: f32,
    settings: FoundationSettings,
    bodies: &mut RigidBodySet,
) {
    if points.is_empty() || dt <= 0.0 {
        return;
    }
    let mut velocities = Velocities::default();
    let mut rows = Vec::with_capacity(points.len());
    for point in points {
        if sleeps(point, bodies) {
            continue;
        }
        let Some(a) = velocities.index(point.body, bodies) else { continue };
        let b = point.other.and_then(|other| velocities.index(other, bodies));
        rows.push((point, row(point, a, b, &velocities)));
    }
    let substeps = settings.substeps.max(1);
    let h = dt / substeps as f32;
    for _ in 0..substeps {
        velocities.accelerate(gravity, h);
        for (_, row) in &mut rows {
            row.pressure = 0.0;
            row.grip = Vec3::ZERO;
        }
        for _ in 0..settings.sweeps.max(1) {
            for (point, row) in &mut rows {
                press(point, row, h, &mut velocities);
                rub(point, row, &mut velocities);
            }
        }
        for (point, row) in &mut rows {
            row.depth -= h * relative_velocity(point, row, &velocities).dot(point.normal);
        }
    }
    velocities.write(gravity, dt, bodies);
}

/// A body that rapier has put to sleep on an obstacle that does not move stays asleep.
fn sleeps(point: &FoundationPoint, bodies: &RigidBodySet) -> bool {
    let still = |handle: RigidBodyHandle| {
        bodies.get(handle).is_none_or(|body| body.is_sleeping() || body.is_fixed() || !body.is_moving())
    };
    bodies.get(point.body).is_none_or(|body| body.is_sleeping()) && point.other.is_none_or(still)
}

fn row(point: &FoundationPoint, a: usize, b: Option<usize>, velocities: &Velocities) -> Row {
    let response = |n: Vec3| {
        velocities.get(a).response(point.position, n) + b.map_or(0.0, |b| velocities.get(b).response(point.position, n))
    };
    let (t1, t2) = point.normal.any_orthonormal_pair();
    Row {
        a,
        b,
        depth: point.depth,
        response: response(point.normal),
        slide_response: response(t1) + response(t2),
        pressure: 0.0,
        grip: Vec3::ZERO,
    }
}

fn relative_velocity(point: &FoundationPoint, row: &Row, velocities: &Velocities) -> Vec3 {
    velocities.get(row.a).at(point.position) - row.b.map_or(Vec3::ZERO, |b| velocities.get(b).at(point.position))
}

fn apply(point: &FoundationPoint, row: &Row, impulse: Vec3, velocities: &mut Velocities) {
    velocities.get_mut(row.a).push(point.position, impulse);
    if let Some(b) = row.b {
        velocities.get_mut(b).push(point.position, -impulse);
    }
}

/// Implicit spring and damper: `λ = h k (d − h v) − h c v` with the velocity `v` after the impulse; it never pulls.
fn press(point: &FoundationPoint, row: &mut Row, h: f32, velocities: &mut Velocities) {
    let v = relative_velocity(point, row, velocities).dot(point.normal);
    let softness = h * (h * point.stiffness + point.damping);
    let change = (h * point.stiffness * row.depth - softness * v - row.pressure) / (1.0 + softness * row.response);
    let room = (point.release - v).max(0.0) / row.response.max(f32::MIN_POSITIVE);
    let pressure = (row.pressure + change.min(room)).max(0.0);
    let impulse = pressure - row.pressure;
    row.pressure = pressure;
    apply(point, row, point.normal * impulse, velocities);
}

/// Coulomb friction: stops the sliding as far as the pressure allows.
fn rub(point: &FoundationPoint, row: &mut Row, velocities: &mut Velocities) {
    if row.slide_response <= 0.0 {
        return;
    }
    let v = relative_velocity(point, row, velocities);
    let slide = v - point.normal * v.dot(point.normal);
    let grip = (row.grip - slide / row.slide_response).clamp_length_max(point.friction * row.pressure);
    let impulse = grip - row.grip;
    row.grip = grip;
    apply(point, row, impulse, velocities);
}
