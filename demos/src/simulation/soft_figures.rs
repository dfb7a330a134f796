//! What there is to measure of a body that moves by itself.

use pliant::math::Vec3;

use super::running::Simulation;
use super::soft::SoftActor;

/// Figures of one body after a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SoftFigures {
    /// Centre of mass in metres.
    pub centre: Vec3,
    /// Volume of the cells as a part of that at rest; cells that are inside out count as negative.
    pub volume_ratio: f64,
    /// Cells that are inside out.
    pub inverted: usize,
    /// Least and largest excitation of all vertices, in [-1, 1].
    pub excitation: [f32; 2],
    /// Signals of stimuli under way.
    pub stimuli: usize,
}

impl Simulation {
    /// How many edges of each soft actor go through the boundary of another; 0 for one that is gone.
    pub fn soft_crossings(&self) -> Vec<usize> {
        if self.soft_actors.len() < 2 {
            return vec![0; self.soft_actors.len()];
        }
        let counts: std::collections::BTreeMap<_, _> = self.creatures.crossings().into_iter().collect();
        self.soft_actors.iter().map(|actor| counts.get(&actor.handle).copied().unwrap_or(0)).collect()
    }

    /// The figures of a body that moves by itself; those of nothing if it is gone.
    pub fn soft_figures(&self, actor: &SoftActor) -> SoftFigures {
        let Some(body) = self.creatures.get(actor.handle) else { return SoftFigures::default() };
        let (mesh, masses) = (body.rig().mesh(), body.rig().masses());
        let moment: glam::DVec3 = body.positions().iter().zip(masses).map(|(x, m)| x.as_dvec3() * f64::from(*m)).sum();
        let volumes = mesh.volumes_at(body.positions());
        let mut excitations = Vec::new();
        self.creatures.excitations_into(actor.handle, &mut excitations);
        let range = excitations.iter().fold([0.0f32; 2], |[low, high], e| [low.min(*e), high.max(*e)]);
        SoftFigures {
            centre: (moment / masses.iter().map(|m| f64::from(*m)).sum::<f64>()).as_vec3(),
            volume_ratio: volumes.iter().sum::<f64>() / mesh.volume(),
            inverted: volumes.iter().filter(|volume| **volume < 0.0).count(),
            excitation: range,
            stimuli: self.creatures.motion(actor.handle).map_or(0, |motion| motion.stimuli().len()),
        }
    }
}
