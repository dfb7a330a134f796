//! What may be changed of a body at any time: how stiff it is and how it is damped.

use crate::math::Vec3;

/// How far a force on one vertex is felt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stiffness {
    /// The paper's: so many passes of matching, each a pass over all regions. 0 counts as 1. What it means depends on the mesh
    /// and on the time step.
    Iterations(u32),
    /// A stiffness from 0 to 1 (clamped) by the global solve: the same for any mesh of the same body and for any time step.
    /// It stands for the speed of elastic waves, see [`wave_speed`].
    Solve(f32),
}

/// How a body is simulated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProcDefSettings {
    /// How stiff it is; two passes of matching unless it is set.
    pub stiffness: Stiffness,
    /// How fast motion that is not rigid dies away, in 1/s: after a second `exp(-damping)` of it is left. 0 or more; 5 unless
    /// it is set.
    pub damping: f32,
    /// Whether the cells are kept at their volume, times the determinant of their local deformation. Off unless it is set.
    pub keep_volume: bool,
    /// The part of its volume, times the determinant of its local deformation, below which no cell is let by the body itself, from
    /// 0 to 1: cells stay right side out. 0 unless it is set, and then cells are not looked at. What presses the body from
    /// outside comes after it.
    pub least_volume: f32,
}

impl Default for ProcDefSettings {
    fn default() -> Self {
        Self { stiffness: Stiffness::Iterations(2), damping: 5.0, keep_volume: false, least_volume: 0.0 }
    }
}

/// The speed of elastic waves for a stiffness from 0 to 1, in body sizes a second: `10 s / (1 - s)`.
///
/// A body of size 0.5 m and stiffness 0.5 has waves of 5 m/s. With Young's modulus `E = ρ c²` that is a jelly of
/// 25 kPa at the density of water; 0.9 is rubber, 0.1 hardly holds its shape. A bar of length `L` that stands on its end is
/// shortened by `g L² / 2c²`.
pub fn wave_speed(stiffness: f32) -> f32 {
    let s = stiffness.clamp(0.0, 1.0);
    // NaN is clamped to NaN and counts as soft.
    if s.is_nan() { 0.0 } else { 10.0 * s / (1.0 - s) }
}

/// Waves run at most so many sizes of the body in a step: beyond, the goals are those of a rigid body to a ten-thousandth,
/// and the factor would lose digits.
const FARTHEST_WAVE: f32 = 30.0;

/// How far waves run in a step of `h` seconds in the global solve, in body sizes, for a stiffness from 0 to 1.
///
/// A swing of the frequency `ω` is stepped by (8) and (9) with the right period when its goal lies `α = 4 sin²(ω h / 2)` of
/// the way back, and a global solve for the distance `d` goes `α = λ / (1 + λ)` of it, `λ = (k d)²`. Both are made equal for the
/// slowest stretching of a body that is two sizes long, `k = π/2`. Bodies that would swing faster than once in six steps
/// are as stiff as they can be.
pub(super) fn wave_distance(stiffness: f32, h: f32) -> f32 {
    use std::f32::consts::{FRAC_PI_2, FRAC_PI_3};
    let angle = wave_speed(stiffness) * h * FRAC_PI_2;
    if angle >= FRAC_PI_3 {
        return FARTHEST_WAVE;
    }
    let part = 4.0 * (angle / 2.0).sin().powi(2);
    ((part / (1.0 - part)).sqrt() / FRAC_PI_2).min(FARTHEST_WAVE)
}

/// A half-space that bodies stand on when they are stepped alone, without rapier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundPlane {
    /// Unit normal, pointing out of the ground.
    pub normal: Vec3,
    /// The ground is where `normal . x < offset`, in metres.
    pub offset: f32,
    /// Coulomb coefficient, 0 or more.
    pub friction: f32,
}
