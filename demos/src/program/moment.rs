//! All that is drawn of a scene after one step, so that pictures can lie between two steps.

use pliant::elastic::Palette;
use pliant::math::{Pose, Vec3};
use pliant::spring::MassSpringSet;

use crate::simulation::{Simulation, SoftActor};

/// A scene after one step.
#[derive(Clone, Debug, Default)]
pub struct Moment {
    /// Number of the step.
    pub step: u64,
    /// Elastic bodies, in the order of the actors.
    pub bodies: Vec<BodyMoment>,
    /// Poses of the obstacles.
    pub obstacles: Vec<Pose>,
    /// Bodies that move by themselves, in the order of the soft actors.
    pub soft: Vec<SoftMoment>,
}

/// A body that moves by itself, after one step.
#[derive(Clone, Debug, Default)]
pub struct SoftMoment {
    /// The vertices of its cells.
    pub positions: Vec<Vec3>,
    /// The excitation of each of them.
    pub excitations: Vec<f32>,
    /// Where its rigid things are; none for one that there is not.
    pub things: Vec<Option<Pose>>,
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
            soft: simulation.soft_actors.iter().map(|actor| SoftMoment::of(simulation, actor)).collect(),
        }
    }
}

impl SoftMoment {
    fn of(simulation: &Simulation, actor: &SoftActor) -> Self {
        let mut excitations = Vec::new();
        simulation.creatures.excitations_into(actor.handle, &mut excitations);
        Self {
            positions: simulation.creatures.get(actor.handle).map(|b| b.positions().to_vec()).unwrap_or_default(),
            excitations,
            things: simulation.thing_poses(actor),
        }
    }
}
