//! All that is drawn of a scene after one step, so that pictures can lie between two steps.

use pliant::elastic::Palette;
use pliant::math::{Pose, Vec3};
use pliant::spring::MassSpringSet;

use crate::simulation::Simulation;

/// A scene after one step.
#[derive(Clone, Debug, Default)]
pub struct Moment {
    /// Number of the step.
    pub step: u64,
    /// Elastic bodies, in the order of the actors.
    pub bodies: Vec<BodyMoment>,
    /// Poses of the obstacles.
    pub obstacles: Vec<Pose>,
}

/// An elastic body after one step.
#[derive(Clone, Debug, Default)]
pub struct BodyMoment {
    /// What the compute pass deforms by.
    pub palette: Palette,
    /// What the processor deformed.
    pub positions: Vec<Vec3>,
    /// Its mass-spring sets.
    pub sets: Vec<MassSpringSet>,
    /// Its draggers: each held point without draggers, and where it is.
    pub drags: Vec<[Vec3; 2]>,
}

impl Moment {
    /// The scene as it is now.
    pub fn of(simulation: &Simulation) -> Self {
        let body = |handle| {
            let body = simulation.deformation.get(handle)?;
            let (positions, sets) = (body.positions().to_vec(), body.sets().to_vec());
            let drags = body.draggers().filter(|(_, d)| d.goal().is_some()).map(|(_, d)| d.ends()).collect();
            Some(BodyMoment { palette: body.palette().clone(), positions, sets, drags })
        };
        Self {
            step: simulation.frame,
            bodies: simulation.actors.iter().map(|actor| body(actor.handle).unwrap_or_default()).collect(),
            obstacles: simulation.obstacle_poses(),
        }
    }
}
