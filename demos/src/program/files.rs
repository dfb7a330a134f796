//! The files of a run: surfaces once, and in each frame vertices, obstacles' places and measurements.

use std::path::Path;

use anyhow::anyhow;
use pliant::math::Pose;
use pliant::procdef::DeformedSkin;

use crate::output::{
    ConvexPart, METRICS_HEADER, MetricsRow, MetricsWriter, ObstacleWriter, Pc2Writer, SOFT_METRICS_HEADER,
    SoftMetricsRow, body_file_names, write_body_mesh, write_obstacle_parts,
};
use crate::simulation::{Simulation, SoftActor};

/// All tables and caches of a run, open.
pub struct Files {
    caches: Vec<Pc2Writer>,
    soft_caches: Vec<Pc2Writer>,
    obstacles: ObstacleWriter,
    metrics: MetricsWriter,
    /// Where there are bodies that move by themselves.
    soft_metrics: Option<MetricsWriter>,
    /// What each written part belongs to, and its pose in it.
    parts: Vec<(Owner, Pose)>,
    deformed: DeformedSkin,
}

/// What moves a part.
#[derive(Clone, Copy)]
enum Owner {
    /// An obstacle.
    Obstacle(usize),
    /// A rigid thing of a soft actor.
    Thing(usize, usize),
}

impl Files {
    /// Makes the folder, writes the surfaces and opens everything else, so that a folder that cannot be written is told
    /// before anything is simulated.
    pub fn create(folder: &Path, simulation: &Simulation) -> anyhow::Result<Self> {
        std::fs::create_dir_all(folder).map_err(|e| match folder.is_file() {
            true => anyhow!("{}: this is a file, and a folder is needed for the output", folder.display()),
            false => anyhow!("{}: the output folder cannot be made: {e}", folder.display()),
        })?;
        let elastic = simulation.actors.iter().map(|a| a.name.as_str());
        let names = body_file_names(elastic.chain(simulation.soft_actors.iter().map(|a| a.name.as_str())));
        let mut caches = Vec::new();
        for (actor, name) in simulation.actors.iter().zip(&names) {
            let Some(body) = simulation.deformation.get(actor.handle) else { continue };
            write_body_mesh(folder, name, &body.rig().mesh)?;
            caches.push(Pc2Writer::create(folder.join(format!("{name}.pc2")), body.positions().len(), 0.0, 1.0)?);
        }
        let mut soft_caches = Vec::new();
        for (actor, name) in simulation.soft_actors.iter().zip(names.iter().skip(simulation.actors.len())) {
            let skin = actor.kind.skin.skin();
            write_body_mesh(folder, name, skin)?;
            soft_caches.push(Pc2Writer::create(folder.join(format!("{name}.pc2")), skin.vertex_count(), 0.0, 1.0)?);
        }
        let (mut parts, mut shown) = (Vec::new(), Vec::new());
        for (index, obstacle) in simulation.obstacles.iter().enumerate() {
            for part in &obstacle.parts {
                parts.push((Owner::Obstacle(index), part.pose));
                shown.push(ConvexPart { vertices: part.positions.clone(), triangles: part.triangles.clone() });
            }
        }
        for (index, actor) in simulation.soft_actors.iter().enumerate() {
            for (number, thing) in actor.kind.things.iter().enumerate() {
                parts.push((Owner::Thing(index, number), Pose::IDENTITY));
                let (vertices, triangles) = (thing.mesh.positions.clone(), thing.mesh.triangles.clone());
                shown.push(ConvexPart { vertices, triangles });
            }
        }
        write_obstacle_parts(folder.join("obstacles.obj"), &shown)?;
        let soft_metrics = (!simulation.soft_actors.is_empty())
            .then(|| MetricsWriter::create(folder.join("soft_bodies.csv"), SOFT_METRICS_HEADER));
        Ok(Self {
            caches,
            soft_caches,
            obstacles: ObstacleWriter::create(folder.join("obstacles.csv"))?,
            metrics: MetricsWriter::create(folder.join("metrics.csv"), METRICS_HEADER)?,
            soft_metrics: soft_metrics.transpose()?,
            parts,
            deformed: DeformedSkin::default(),
        })
    }

    /// Appends the state after a step.
    pub fn write(&mut self, frame: usize, simulation: &Simulation, crossings: &[usize]) -> anyhow::Result<()> {
        let poses = simulation.obstacle_poses();
        let things: Vec<_> = simulation.soft_actors.iter().map(|actor| simulation.thing_poses(actor)).collect();
        for (part, (owner, local)) in self.parts.iter().enumerate() {
            let pose = match *owner {
                Owner::Obstacle(obstacle) => poses[obstacle],
                Owner::Thing(actor, thing) => things[actor].get(thing).copied().flatten().unwrap_or(Pose::IDENTITY),
            };
            self.obstacles.write(frame, part, &(pose * *local))?;
        }
        self.write_soft(frame, simulation, crossings)?;
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
                max_pair_depth: report.max_pair_depth,
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

    /// Appends the bodies that move by themselves.
    fn write_soft(&mut self, frame: usize, simulation: &Simulation, crossings: &[usize]) -> anyhow::Result<()> {
        for ((actor, cache), &crossings) in simulation.soft_actors.iter().zip(&mut self.soft_caches).zip(crossings) {
            let Some(body) = simulation.creatures.get(actor.handle) else { continue };
            actor.kind.skin.deform(body.positions(), &mut self.deformed)?;
            cache.write_frame(&self.deformed.positions)?;
            if let Some(table) = &mut self.soft_metrics {
                table.write(&soft_row(frame, simulation, actor, crossings))?;
            }
        }
        Ok(())
    }

    /// Puts all files in their places.
    pub fn finish(self) -> anyhow::Result<()> {
        for cache in self.caches.into_iter().chain(self.soft_caches) {
            cache.finish()?;
        }
        self.obstacles.finish()?;
        self.soft_metrics.map_or(Ok(()), MetricsWriter::finish)?;
        Ok(self.metrics.finish()?)
    }
}

fn soft_row(frame: usize, simulation: &Simulation, actor: &SoftActor, crossings: usize) -> SoftMetricsRow {
    let (figures, report, times) =
        (simulation.soft_figures(actor), simulation.soft_report(actor), simulation.soft_times);
    SoftMetricsRow {
        frame,
        body: actor.name.clone(),
        x: figures.centre.x,
        y: figures.centre.y,
        z: figures.centre.z,
        volume_ratio: figures.volume_ratio,
        inverted: figures.inverted,
        crossings,
        held: report.held,
        contraction: figures.excitation[0],
        expansion: figures.excitation[1],
        stimuli: figures.stimuli,
        felt: report.felt,
        on_ground: report.on_ground,
        frozen: usize::from(report.frozen.is_some()),
        ms_rapier: simulation.rigid_ms.into(),
        ms_exchange: times.exchange.into(),
        ms_contact: times.contact.into(),
        ms_drive: times.drive.into(),
    }
}
