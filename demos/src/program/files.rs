//! The files of a run: surfaces once, and in each frame vertices, obstacles' places and measurements.

use std::path::Path;

use anyhow::anyhow;
use pliant::math::Pose;

use crate::output::{
    ConvexPart, MetricsRow, MetricsWriter, ObstacleWriter, Pc2Writer, body_file_names, write_body_mesh,
    write_obstacle_parts,
};
use crate::simulation::Simulation;

/// All tables and caches of a run, open.
pub struct Files {
    caches: Vec<Pc2Writer>,
    obstacles: ObstacleWriter,
    metrics: MetricsWriter,
    /// Obstacle and pose in it of each convex part.
    parts: Vec<(usize, Pose)>,
}

impl Files {
    /// Makes the folder, writes the surfaces and opens everything else, so that a folder that cannot be written is told
    /// before anything is simulated.
    pub fn create(folder: &Path, simulation: &Simulation) -> anyhow::Result<Self> {
        std::fs::create_dir_all(folder).map_err(|e| match folder.is_file() {
            true => anyhow!("{}: this is a file, and a folder is needed for the output", folder.display()),
            false => anyhow!("{}: the output folder cannot be made: {e}", folder.display()),
        })?;
        let names = body_file_names(simulation.actors.iter().map(|a| a.name.as_str()));
        let mut caches = Vec::new();
        for (actor, name) in simulation.actors.iter().zip(&names) {
            let Some(body) = simulation.deformation.get(actor.handle) else { continue };
            write_body_mesh(folder, name, &body.rig().mesh)?;
            caches.push(Pc2Writer::create(folder.join(format!("{name}.pc2")), body.positions().len(), 0.0, 1.0)?);
        }
        let (mut parts, mut shown) = (Vec::new(), Vec::new());
        for (index, obstacle) in simulation.obstacles.iter().enumerate() {
            for part in &obstacle.parts {
                parts.push((index, part.pose));
                shown.push(ConvexPart { vertices: part.positions.clone(), triangles: part.triangles.clone() });
            }
        }
        write_obstacle_parts(folder.join("obstacles.obj"), &shown)?;
        Ok(Self {
            caches,
            obstacles: ObstacleWriter::create(folder.join("obstacles.csv"))?,
            metrics: MetricsWriter::create(folder.join("metrics.csv"))?,
            parts,
        })
    }

    /// Appends the state after a step.
    pub fn write(&mut self, frame: usize, simulation: &Simulation) -> anyhow::Result<()> {
        let poses = simulation.obstacle_poses();
        for (part, (obstacle, local)) in self.parts.iter().enumerate() {
            self.obstacles.write(frame, part, &(poses[*obstacle] * *local))?;
        }
        let bodies = simulation.actors.iter().filter_map(|a| Some((a, simulation.deformation.get(a.handle)?)));
        for ((actor, body), cache) in bodies.zip(&mut self.caches) {
            cache.write_frame(body.positions())?;
            let (report, times) = (simulation.report(actor), simulation.times());
            self.metrics.write(&MetricsRow {
                frame,
                body: actor.name.clone(),
                volume_ratio: report.volume_ratio.into(),
                max_depth_before: report.penetration.max_depth_before,
                max_depth_after: report.penetration.max_depth_after,
                max_piercing: report.penetration.max_piercing,
                max_gap: report.penetration.max_gap,
                vertices_inside: report.penetration.vertices_inside as usize,
                time_coherence: report.penetration.coherence.ratio,
                passes: report.passes as usize,
                steps: report.steps as usize,
                ms_rigid: simulation.rigid_ms.into(),
                ms_springs: times.springs.into(),
                ms_contact: times.contact.into(),
                ms_deform: times.deform.into(),
            })?;
        }
        Ok(())
    }

    /// Puts all files in their places.
    pub fn finish(self) -> anyhow::Result<()> {
        for cache in self.caches {
            cache.finish()?;
        }
        self.obstacles.finish()?;
        Ok(self.metrics.finish()?)
    }
}
