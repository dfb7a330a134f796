//! The bodies of a row, and the world that they are put into.

use std::path::Path;
use std::sync::Arc;

use anyhow::{Context, Result};
use pliant::math::Vec3;
use pliant::procdef::{ProcDefModel, Stiffness, load_motion_rig};
use rapier3d::prelude::*;

use super::rows::Row;

/// The kind of body of a row: its rig, with the row's number of iterations unless the rig's own stiffness is asked for.
pub fn model(row: &Row, rig_stiffness: bool) -> Result<Arc<ProcDefModel>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/rigs");
    let file = load_motion_rig(folder.join(format!("{}.toml", row.rig)))?;
    let mut model = ProcDefModel::from_file(&file).with_context(|| format!("rig {}", row.rig))?;
    if !rig_stiffness {
        model.settings.stiffness = Stiffness::Iterations(row.iterations);
    }
    Ok(Arc::new(model))
}

/// Where the bodies start: in layers, a tenth of their size apart, each layer shifted so that bodies lie on several others.
pub fn places(row: &Row, model: &ProcDefModel) -> Vec<Vec3> {
    let positions = &model.rig.mesh().positions;
    let low = positions.iter().copied().fold(Vec3::MAX, Vec3::min);
    let size = positions.iter().copied().fold(Vec3::MIN, Vec3::max) - low;
    let wide = if row.bodies == 1 { 1 } else { f64::from(row.bodies).cbrt().ceil() as u32 };
    let place = |i: u32| {
        let [x, y, z] = [i % wide, i / (wide * wide), i / wide % wide].map(|k| k as f32 * 1.1);
        Vec3::new(x + 0.3 * y, y, z + 0.2 * y) * size - Vec3::Y * (low.y - 0.02)
    };
    (0..row.bodies).map(place).collect()
}

/// Where the clock of each body starts, in seconds: no two move alike.
pub fn clock(index: usize) -> f64 {
    0.37 * index as f64
}

/// Rapier's world of a row, without the bodies.
pub fn physics(row: &Row, dt: f32) -> PhysicsWorld {
    let mut physics = PhysicsWorld::new();
    physics.integration_parameters.dt = dt;
    physics.gravity = if row.water { Vec3::ZERO } else { Vec3::Y * -9.81 };
    if !row.water {
        let floor = ColliderBuilder::cuboid(50.0, 1.0, 50.0).friction(1.0);
        physics.insert(RigidBodyBuilder::fixed().translation(Vec3::Y * -1.0), floor);
    }
    physics
}
