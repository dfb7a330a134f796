//! A body that moves by itself: its state, where it wants to go, and a step of it alone.

use std::sync::Arc;

use glam::Mat3;
use wide::f32x4;

use super::global_solve::Factor;
use super::matching::Matching;
use super::open_cells::Ahead;
use super::rigid::{damp, keep_linear_momentum, keep_momentum, vec3, wide};
use super::settings::wave_distance;
use super::{GroundPlane, ProcDefRig, ProcDefSettings, Stiffness};
use crate::math::{Pose, Vec3};

/// The state of one body.
///
/// A world with contacts reads [`ProcDefBody::pulls`] each step, adds `(g - x) / h` to the velocities (equation 8) and moves
/// the vertices itself. [`ProcDefBody::step`] does all of it for a body alone.
#[derive(Clone, Debug)]
pub struct ProcDefBody {
    rig: Arc<ProcDefRig>,
    /// How it is simulated; may be changed between steps.
    pub settings: ProcDefSettings,
    positions: Vec<Vec3>,
    velocities: Vec<Vec3>,
    pulls: Vec<Vec3>,
    matching: Matching,
    /// The current shape in the order of the regions, relative to the origin of the step.
    shape: Vec<f32x4>,
    factor: Option<(f32, Arc<Factor>)>,
    /// Positions and target volumes while volumes are kept.
    projected: Vec<f32x4>,
    volumes: Vec<f32>,
    /// How far its vertices are pushed so that cells stay open.
    pushes: Vec<f32x4>,
}

impl ProcDefBody {
    /// A body at rest, its mesh's origin at the pose.
    pub fn new(rig: Arc<ProcDefRig>, pose: &Pose) -> Self {
        let positions: Vec<Vec3> = rig.mesh().positions.iter().map(|&x| *pose * x).collect();
        let mut matching = Matching::new(&rig.regions);
        matching.set_rotations(pose.rotation);
        Self {
            settings: ProcDefSettings::default(),
            velocities: vec![Vec3::ZERO; positions.len()],
            pulls: vec![Vec3::ZERO; positions.len()],
            shape: vec![f32x4::ZERO; positions.len()],
            positions,
            matching,
            factor: None,
            projected: Vec::new(),
            volumes: Vec::new(),
            pushes: Vec::new(),
            rig,
        }
    }

    /// What it shares with others of its kind.
    pub fn rig(&self) -> &Arc<ProcDefRig> {
        &self.rig
    }

    /// Position of each vertex of the mesh, in metres.
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// The positions, to be set from outside.
    pub fn positions_mut(&mut self) -> &mut [Vec3] {
        &mut self.positions
    }

    /// Velocity of each vertex, in m/s.
    pub fn velocities(&self) -> &[Vec3] {
        &self.velocities
    }

    /// The velocities, to be set from outside.
    pub fn velocities_mut(&mut self) -> &mut [Vec3] {
        &mut self.velocities
    }

    /// Where each vertex should go in this step of `h` seconds, for its current positions: `g - x`, in metres.
    ///
    /// `local` is the deformation `T` of each vertex's region, one a vertex of the mesh; with any other length, and where it is
    /// not finite, there is none. Linear and angular momentum are kept: `Σ m (g - x) = 0` and `Σ m x × (g - x) = 0` up to
    /// rounding. Where positions are not finite the goals are not either; this never panics.
    pub fn pulls(&mut self, local: &[Mat3], h: f32) -> &[Vec3] {
        let rig = Arc::clone(&self.rig);
        let regions = &rig.regions;
        let origin = self.positions.get(regions.vertex[0] as usize).copied().unwrap_or(Vec3::ZERO);
        for (x, &v) in self.shape.iter_mut().zip(&regions.vertex) {
            *x = wide(self.positions[v as usize] - origin);
        }
        self.matching.set_local(regions, local);
        let exact = match self.settings.stiffness {
            Stiffness::Iterations(n) => {
                self.iterate(&rig, n.max(1));
                n <= 1
            }
            Stiffness::Solve(stiffness) => {
                self.solve(&rig, wave_distance(stiffness, h) * rig.size());
                false
            }
        };
        if exact {
            keep_linear_momentum(&regions.mass, &mut self.matching.goals);
        } else {
            keep_momentum(&regions.mass, &self.shape, &mut self.matching.goals);
        }
        for (&d, &v) in self.matching.goals.iter().zip(&regions.vertex) {
            self.pulls[v as usize] = vec3(d);
        }
        &self.pulls
    }

    /// The paper's iteration: each pass matches the goals of the one before.
    fn iterate(&mut self, rig: &ProcDefRig, passes: u32) {
        self.matching.match_regions(&rig.regions, &self.shape);
        self.matching.blend(&rig.regions);
        for _ in 1..passes {
            self.matching.match_goals(&rig.regions);
            self.matching.blend(&rig.regions);
        }
        self.matching.subtract(&self.shape);
    }

    /// One pass of matching and the global solve, for waves that run `distance` metres in the step.
    fn solve(&mut self, rig: &ProcDefRig, distance: f32) {
        if self.factor.as_ref().is_none_or(|(d, _)| *d != distance) {
            self.factor = rig.factor(distance).map(|factor| (distance, factor));
        }
        self.matching.match_regions(&rig.regions, &self.shape);
        match &self.factor {
            Some((_, factor)) => {
                self.matching.solve(&rig.stiffening, factor, &rig.regions, &self.shape);
            }
            None => {
                self.matching.blend(&rig.regions);
                self.matching.subtract(&self.shape);
            }
        }
    }

    /// Changes the velocities as the body wants to move in a step of `h` seconds: pulls by equation (8), damping, volumes if they
    /// are kept. What moves the vertices by them is not done here: a world with contacts does it, see [`crate::world`].
    /// Without a time, as for `h = 0`, nothing is changed.
    pub fn drive(&mut self, local: &[Mat3], h: f32) {
        if !(h > 0.0 && h.is_finite()) {
            return;
        }
        self.pulls(local, h);
        for (v, &pull) in self.velocities.iter_mut().zip(&self.pulls) {
            *v += pull / h;
        }
        let kept = (-self.settings.damping.max(0.0) * h).exp();
        if kept < 1.0 {
            damp(self.rig.masses(), &self.positions, &mut self.velocities, kept);
        }
        if self.settings.keep_volume {
            self.keep_volume(local, h, None);
        }
    }

    /// One step of `h` seconds of the body alone: equations (8) and (9), damping, gravity in m/s² and, if given, a plane.
    pub fn step(&mut self, local: &[Mat3], h: f32, gravity: Vec3, plane: Option<&GroundPlane>) {
        if !(h > 0.0 && h.is_finite()) {
            return;
        }
        self.pulls(local, h);
        for (v, &pull) in self.velocities.iter_mut().zip(&self.pulls) {
            *v += pull / h + gravity * h;
        }
        let kept = (-self.settings.damping.max(0.0) * h).exp();
        if kept < 1.0 {
            damp(self.rig.masses(), &self.positions, &mut self.velocities, kept);
        }
        self.hold_open(local, h);
        if let Some(plane) = plane {
            self.stop_at(plane, h);
        }
        if self.settings.keep_volume {
            self.keep_volume(local, h, plane);
        }
        for (x, &v) in self.positions.iter_mut().zip(&self.velocities) {
            *x += v * h;
        }
    }

    /// Changes the velocities so that no vertex ends the step below the plane, with friction.
    fn stop_at(&mut self, plane: &GroundPlane, h: f32) {
        for (v, &x) in self.velocities.iter_mut().zip(&self.positions) {
            let height = plane.normal.dot(x) - plane.offset;
            let normal = v.dot(plane.normal);
            let push = -height / h - normal;
            if push > 0.0 {
                let along = *v - plane.normal * normal;
                let stopped = along.clamp_length_max(plane.friction.max(0.0) * push);
                *v += plane.normal * push - stopped;
            }
        }
    }

    /// Changes the velocities so that after `h` seconds of them every cell has its volume at rest, times the determinant of its
    /// local deformation, as nearly as some tens of sweeps bring it; see [`ProcDefSettings::keep_volume`]. Linear momentum is
    /// kept unless there is a plane.
    ///
    /// [`ProcDefBody::step`] calls it; a world with contacts calls it after it has added the pulls.
    pub fn keep_volume(&mut self, local: &[Mat3], h: f32, plane: Option<&GroundPlane>) {
        let rig = Arc::clone(&self.rig);
        let regions = &rig.regions;
        let ahead = |v: u32| wide(self.positions[v as usize] + self.velocities[v as usize] * h);
        for (x, &v) in self.shape.iter_mut().zip(&regions.vertex) {
            *x = ahead(v);
        }
        self.projected.clone_from(&self.shape);
        rig.cells.targets(regions, local, &mut self.volumes);
        rig.cells.project(&mut self.projected, &self.volumes, plane);
        for ((y, x), &v) in self.projected.iter().zip(&self.shape).zip(&regions.vertex) {
            self.velocities[v as usize] += vec3(*y - *x) / h;
        }
    }

    /// Changes the velocities so that after `h` seconds of them no cell has less than a part of its volume; see
    /// [`ProcDefSettings::least_volume`]. Linear momentum is kept.
    ///
    /// [`ProcDefBody::step`] calls it; a world with contacts calls it after all else that changes the velocities.
    pub fn hold_open(&mut self, local: &[Mat3], h: f32) {
        let least = self.settings.least_volume.min(1.0);
        if !(least > 0.0 && h > 0.0 && h.is_finite()) {
            return;
        }
        let rig = Arc::clone(&self.rig);
        let regions = &rig.regions;
        let origin = self.positions.get(regions.vertex[0] as usize).copied().unwrap_or(Vec3::ZERO);
        self.projected.clear();
        for (x, &v) in self.shape.iter_mut().zip(&regions.vertex) {
            *x = wide(self.positions[v as usize] - origin);
            self.projected.push(*x + wide(self.velocities[v as usize] * h));
        }
        self.pushes.clear();
        self.pushes.resize(self.shape.len(), f32x4::ZERO);
        let mut way = Ahead {
            now: &self.shape,
            ahead: &mut self.projected,
            pushes: &mut self.pushes,
            inverse_mass: &rig.cells.inverse_mass,
        };
        if rig.cells.hold_open(regions, local, least, &mut way) {
            for (&push, &v) in self.pushes.iter().zip(&regions.vertex) {
                self.velocities[v as usize] += vec3(push) / h;
            }
        }
    }
}
