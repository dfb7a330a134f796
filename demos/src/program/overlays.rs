//! What is felt but not seen, drawn over the picture: springs, their reach, rigid shapes and collision parts.

use glam::{Mat4, Vec3};
use pliant::elastic::{ElasticRig, SegmentShape};

use super::fields::Field;
use super::moment::{BodyMoment, Moment};
use super::section::Cut;
use crate::render::Overlay;
use crate::scene::ObstacleShape;
use crate::simulation::{ObstacleBody, Simulation};

const SPRING: [f32; 4] = [0.85, 0.05, 0.04, 1.0];
const REACH: [f32; 4] = [0.85, 0.25, 0.05, 0.5];
const RIGID: [f32; 4] = [0.03, 0.20, 0.75, 0.9];
const PART: [f32; 4] = [0.02, 0.42, 0.22, 0.8];
const PULL: [f32; 4] = [0.9, 0.5, 0.0, 1.0];

/// Which of it is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shown {
    /// Anchors and free masses of the mass-spring sets.
    pub springs: bool,
    /// Their spheres of influence.
    pub reach: bool,
    /// Rigid shapes of the segments.
    pub rigid: bool,
    /// Convex parts of the obstacles.
    pub parts: bool,
    /// Edges of the bodies' triangles.
    pub wireframe: bool,
    /// What is painted on bodies that move by themselves.
    pub field: Field,
    /// Where they are cut open.
    pub cut: Option<Cut>,
}

impl Shown {
    /// Whether something inside of the bodies is drawn, which are see-through then.
    pub fn inside(&self) -> bool {
        self.springs || self.reach || self.rigid
    }
}

/// The overlay at the place `alpha` between two moments.
pub fn overlay(simulation: &Simulation, shown: &Shown, moments: [&Moment; 2], alpha: f32) -> Overlay {
    let mut overlay = Overlay::default();
    let [from, to] = moments;
    for (actor, (from, to)) in simulation.actors.iter().zip(from.bodies.iter().zip(&to.bodies)) {
        let Some(body) = simulation.deformation.get(actor.handle) else { continue };
        if from.drags.len() == to.drags.len() {
            for (from, to) in from.drags.iter().zip(&to.drags) {
                let [p, q] = [0, 1].map(|end| from[end].lerp(to[end], alpha));
                overlay.spring(p, q, 0.03, PULL);
            }
        }
        if shown.springs || shown.reach {
            add_springs(&mut overlay, shown, body.rig(), [from, to], alpha);
        }
        if shown.rigid {
            add_rigid(&mut overlay, body.rig(), [from, to], alpha);
        }
    }
    if shown.parts {
        for (obstacle, (from, to)) in simulation.obstacles.iter().zip(from.obstacles.iter().zip(&to.obstacles)) {
            add_parts(&mut overlay, obstacle, from.lerp(to, alpha).to_mat4());
        }
    }
    if let Some((point, goal)) = simulation.grabbed() {
        overlay.spring(point, goal, 0.04, PULL);
    }
    overlay
}

fn add_springs(overlay: &mut Overlay, shown: &Shown, rig: &ElasticRig, moments: [&BodyMoment; 2], alpha: f32) {
    let [from, to] = moments;
    for (set, (from, to)) in rig.sets.iter().zip(from.sets.iter().zip(&to.sets)) {
        let (p, q) = (from.p.lerp(to.p, alpha), from.q.lerp(to.q, alpha));
        if shown.springs {
            overlay.spring(p, q, (0.08 * set.radius).min(0.05), SPRING);
        }
        if shown.reach {
            overlay.sphere(Mat4::from_translation(p), set.radius, REACH);
        }
    }
}

fn add_rigid(overlay: &mut Overlay, rig: &ElasticRig, moments: [&BodyMoment; 2], alpha: f32) {
    let [from, to] = moments.map(|moment| &moment.palette.segments);
    for ((segment, rest), (from, to)) in rig.segments.iter().zip(&rig.rest_poses).zip(from.iter().zip(to)) {
        let pose = (from.motion * *rest).lerp(&(to.motion * *rest), alpha);
        let transform = pose.to_mat4();
        let half = 0.5 * segment.bone[0].distance(segment.bone[1]);
        match segment.shape {
            SegmentShape::Ball { radius } => overlay.sphere(transform, radius, RIGID),
            SegmentShape::Capsule { radius } => {
                let end = Vec3::Z * (half - radius).max(0.0);
                let [a, b] = [-end, end].map(|p| transform.transform_point3(p));
                overlay.capsule(a, b, radius, RIGID);
            }
            SegmentShape::Cuboid { half_extents } => overlay.cuboid(transform, half_extents, RIGID),
        }
    }
}

fn add_parts(overlay: &mut Overlay, obstacle: &ObstacleBody, transform: Mat4) {
    let ends = |half: f32| [-half, half].map(|y| transform.transform_point3(Vec3::Y * y));
    match &obstacle.obstacle.shape {
        ObstacleShape::Ball { radius } => overlay.sphere(transform, *radius, PART),
        ObstacleShape::Cuboid { half_extents, rounding: 0.0 } => overlay.cuboid(transform, *half_extents, PART),
        ObstacleShape::Capsule { half_height, radius } => {
            let [a, b] = ends(*half_height);
            overlay.capsule(a, b, *radius, PART);
        }
        ObstacleShape::Cylinder { half_height, radius, rounding: 0.0 } => {
            let [a, b] = ends(*half_height);
            overlay.cylinder(a, b, *radius, PART);
        }
        _ => {
            for part in &obstacle.parts {
                overlay.triangles(transform * part.pose.to_mat4(), &part.positions, &part.triangles, PART);
            }
        }
    }
}
