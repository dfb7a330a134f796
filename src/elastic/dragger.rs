//! Draggers (figure 12): points of the skin that are held and led about; let go, they swing back.

use super::drag_stage::DragField;
use super::palette::Palette;
use super::rig::{ElasticRig, MAX_INFLUENCES, SkinWeights};
use crate::field::SpringField;
use crate::math::{Pose, Vec3};
use crate::spring::{MassSpringSet, SpringCoefficients};

/// Names a dragger of one body. Handles are never used again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct DraggerHandle(pub(super) u64);

/// A point of the skin at rest and the segments that move it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grip {
    /// The point in the rest pose of the mesh.
    pub point: Vec3,
    /// Its index-weight pairs; they sum to 1.
    pub skin: SkinWeights,
}

impl Grip {
    /// A vertex of the skin; `None` where there is no such vertex.
    pub fn on_vertex(rig: &ElasticRig, vertex: usize) -> Option<Self> {
        Some(Self { point: *rig.mesh.positions.get(vertex)?, skin: *rig.weights.get(vertex)? })
    }

    /// The vertex of the skin at rest that is nearest to `point`; `None` for a skin without vertices.
    pub fn nearest(rig: &ElasticRig, point: Vec3) -> Option<Self> {
        let away = |v: &usize| rig.mesh.positions[*v].distance_squared(point);
        let vertex = (0..rig.mesh.positions.len()).min_by(|a, b| away(a).total_cmp(&away(b)))?;
        Self::on_vertex(rig, vertex)
    }

    /// A point of a segment, on the skin or under it, that this segment alone moves.
    pub fn of_segment(segment: u16, point: Vec3) -> Self {
        Self { point, skin: SkinWeights { segments: [segment, 0, 0, 0], weights: [1.0, 0.0, 0.0, 0.0] } }
    }
}

/// How a dragger takes hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DraggerStart {
    /// What it holds.
    pub grip: Grip,
    /// Radius of influence in metres, positive and finite: what is farther from the way of the held point stays.
    pub radius: f32,
    /// Where the held point is wanted, in the world. Begin with [`super::ElasticBody::grip_position`]: a goal farther
    /// away is reached in one step.
    pub goal: Vec3,
    /// How the skin swings back when it is let go.
    pub release: SpringCoefficients,
}

/// The swing back where nothing else is asked for.
pub const DEFAULT_RELEASE: SpringCoefficients = SpringCoefficients::new(4.0, 0.15);

/// Why a dragger was not added.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum DraggerError {
    /// The radius is of no use.
    #[error("the radius of a dragger must be finite and above 0 and is {0}")]
    Radius(f32),
    /// The release is no oscillator.
    #[error("the release needs a frequency above 0 and a damping ratio of at least 0, both finite, not {0:?}")]
    Release(SpringCoefficients),
    /// A point is not finite.
    #[error("a dragger's point and goal must be finite")]
    NotFinite,
    /// A weight is wrong or names a segment that the rig has not.
    #[error("the weights of a dragger's grip must sum to 1 over segments that the rig has")]
    Weights,
}

impl DraggerStart {
    /// Takes hold of `grip` where it is (`position` in the world) within `radius` metres.
    pub fn new(grip: Grip, radius: f32, position: Vec3) -> Self {
        Self { grip, radius, goal: position, release: DEFAULT_RELEASE }
    }

    pub(super) fn check(&self, segments: usize) -> Result<(), DraggerError> {
        let SkinWeights { segments: named, weights } = self.grip.skin;
        let sound = |k: usize| weights[k] >= 0.0 && (weights[k] == 0.0 || usize::from(named[k]) < segments);
        // Weights that were rounded sum to 1 within a few bits.
        let whole = (weights.iter().sum::<f32>() - 1.0).abs() < 1.0e-4;
        if !(self.radius.is_finite() && self.radius > 0.0) {
            Err(DraggerError::Radius(self.radius))
        } else if !self.release.is_valid() {
            Err(DraggerError::Release(self.release))
        } else if !(self.grip.point.is_finite() && self.goal.is_finite()) {
            Err(DraggerError::NotFinite)
        } else if !(whole && (0..MAX_INFLUENCES).all(sound)) {
            Err(DraggerError::Weights)
        } else {
            Ok(())
        }
    }
}

/// One dragger and its state.
///
/// The state is that of a mass-spring set whose anchor follows the segments, without their own springs: while the point
/// is held its free mass is led, and let go it swings back by the exact solution of the oscillator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dragger {
    pub(super) start: DraggerStart,
    /// Where the point is wanted; none once it is let go.
    goal: Option<Vec3>,
    state: MassSpringSet,
    /// The free mass one step ago, and how long that step took.
    before: (Vec3, f32),
    /// The held point without and with the drag, as far as the certificate lets it.
    shown: [Vec3; 2],
}

impl Dragger {
    pub(super) fn new(start: DraggerStart, motions: &[Pose], palette: &Palette) -> Self {
        let anchor = carried(&start.grip, motions);
        let p = palette.spring(start.grip.point, &start.grip.skin);
        let state = MassSpringSet::at_rest(anchor);
        Self { start, goal: Some(start.goal), state, before: (anchor, 0.0), shown: [p, p] }
    }

    /// What it holds.
    pub fn grip(&self) -> &Grip {
        &self.start.grip
    }

    /// Radius of influence in metres.
    pub fn radius(&self) -> f32 {
        self.start.radius
    }

    /// Where the point is wanted; `None` while it swings back.
    pub fn goal(&self) -> Option<Vec3> {
        self.goal
    }

    /// Where the held point would be without draggers, and where the last step put it.
    pub fn ends(&self) -> [Vec3; 2] {
        self.shown
    }

    pub(super) fn lead(&mut self, goal: Vec3) {
        self.goal = Some(goal);
    }

    pub(super) fn let_go(&mut self) {
        self.goal = None;
        // A hand that jumped away just now does not fling the skin farther than a radius.
        let fastest = self.start.release.angular_frequency() * self.start.radius;
        self.state.velocity = self.state.velocity.clamp_length_max(fastest);
    }

    /// Teleports with the body; what swung is at rest.
    pub(super) fn place(&mut self, motions: &[Pose]) {
        self.state = MassSpringSet::at_rest(carried(&self.start.grip, motions));
        self.before = (self.state.q, 0.0);
    }

    /// One step of `h` seconds. False when nothing is left of it.
    pub(super) fn step(&mut self, motions: &[Pose], h: f32) -> bool {
        let anchor = carried(&self.start.grip, motions);
        self.before = (self.state.q, h);
        if self.goal.is_some() {
            // The free mass follows when the goal is compared with the skin, in `field`.
            self.state = MassSpringSet { p: anchor, q: anchor + self.state.displacement(), ..self.state };
            return anchor.is_finite();
        }
        let limit = self.state.displacement().length() + self.start.radius;
        let anchor_velocity = if h > 0.0 { (anchor - self.state.p) / h } else { Vec3::ZERO };
        self.state = self.state.stepped(anchor, h, self.start.release, Vec3::ZERO, limit);
        let turning = (self.state.velocity - anchor_velocity) / self.start.release.angular_frequency();
        let swing = self.state.displacement().length_squared() + turning.length_squared();
        let still = STILL * self.start.radius;
        self.state.is_finite() && swing > still * still
    }

    /// The field of this frame over the springs' deformation; the same however often it is asked for.
    pub(super) fn field(&mut self, palette: &Palette) -> DragField {
        let grip = &self.start.grip;
        let p = palette.spring(grip.point, &grip.skin);
        if let Some(goal) = self.goal {
            let (before, h) = self.before;
            self.state.q = self.state.p + (goal - p);
            self.state.velocity = if h > 0.0 { (self.state.q - before) / h } else { Vec3::ZERO };
        }
        let q = p + self.state.displacement();
        DragField::new(SpringField { p, q, radius: self.start.radius }, &grip.skin)
    }

    pub(super) fn show(&mut self, p: Vec3, q: Vec3) {
        self.shown = [p, q];
    }
}

/// The grip as the segments carry it, without springs.
fn carried(grip: &Grip, motions: &[Pose]) -> Vec3 {
    let moved = |k: usize| {
        let motion = motions.get(usize::from(grip.skin.segments[k])).copied().unwrap_or_default();
        motion.transform_point(grip.point) * grip.skin.weights[k]
    };
    (0..MAX_INFLUENCES).filter(|&k| grip.skin.weights[k] > 0.0).map(moved).sum()
}

/// A swing of less than this times the radius is over.
const STILL: f32 = 1.0e-5;
