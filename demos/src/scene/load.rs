//! Reading a scene file: every fault is told with the file, the line and the key.

use super::checks::{At, LARGEST};
use super::dragger::dragger;
use super::raw::{RawBody, RawObstacle, RawPath, RawScene, RawSpin};
use super::shape::shape;
use super::shape_types::ObstacleShape;
use super::soft::{self, Groups};
use super::soft_types::SoftBody;
use super::types::{
    Body, Camera, Dynamic, MAX_DT, MAX_DURATION, MAX_SUBSTEPS, Obstacle, ObstacleMass, ObstaclePath, PathKind, Scene,
    Spin,
};
use pliant::elastic::{TomlError, TomlText, did_you_mean};
use pliant::math::Vec3;
use std::collections::HashMap;
use std::path::Path;

/// Reads a scene file. Rigs and meshes that it names, relative to its folder, must exist; they are not read.
///
/// # Errors
/// A file that cannot be read; with the line at fault: syntax, unknown or missing keys, numbers that are not finite or
/// out of their range, two bodies of one name, files that do not exist.
pub fn load_scene(path: impl AsRef<Path>) -> Result<Scene, TomlError> {
    let text = TomlText::read(path)?;
    let raw: RawScene = text.parse()?;
    let at = At::root(&text);
    if raw.name.trim().is_empty() {
        return Err(at.error("name", "is empty; every scene needs a name"));
    }
    let bodies: Vec<Body> =
        raw.body.iter().enumerate().map(|(i, b)| body(&at.item("body", i), b)).collect::<Result<_, _>>()?;
    let (soft_bodies, groups) = soft::soft_bodies(&at, &raw.soft_body)?;
    names_differ(&at, &bodies, &soft_bodies, &groups)?;
    let obstacles: Vec<Obstacle> =
        raw.obstacle.iter().enumerate().map(|(i, o)| obstacle(&at.item("obstacle", i), o)).collect::<Result<_, _>>()?;
    if !(1..=MAX_SUBSTEPS).contains(&raw.substeps) {
        return Err(at.error("substeps", format!("must be from 1 to {MAX_SUBSTEPS} and is {}", raw.substeps)));
    }
    Ok(Scene {
        duration: at.above_zero("duration", raw.duration, MAX_DURATION)?,
        dt: at.above_zero("dt", raw.dt, MAX_DT)?,
        gravity: at.finite("gravity", raw.gravity)?,
        softness: raw.softness.map(|s| at.above_zero("softness", s, 10.0)).transpose()?,
        camera: camera(&at, &raw)?,
        substeps: raw.substeps,
        draggers: raw
            .dragger
            .iter()
            .enumerate()
            .map(|(i, d)| dragger(&at.item("dragger", i), d, &bodies))
            .collect::<Result<_, _>>()?,
        water: raw
            .water
            .iter()
            .enumerate()
            .map(|(i, w)| soft::water(&at.item("water", i), w))
            .collect::<Result<_, _>>()?,
        cues: raw
            .cue
            .iter()
            .enumerate()
            .map(|(i, c)| groups.cue(&at.item("cue", i), c, &soft_bodies))
            .collect::<Result<_, _>>()?,
        attachments: raw
            .attachment
            .iter()
            .enumerate()
            .map(|(i, a)| groups.attachment(&at.item("attachment", i), a, &soft_bodies, &obstacles))
            .collect::<Result<_, _>>()?,
        bodies,
        soft_bodies,
        obstacles,
        name: raw.name,
    })
}

/// Refuses two bodies of one name, whatever they are. A crowd's own name is one too.
fn names_differ(at: &At, bodies: &[Body], soft_bodies: &[SoftBody], groups: &Groups) -> Result<(), TomlError> {
    let mut names: HashMap<&str, String> = HashMap::new();
    let elastic = bodies.iter().enumerate().map(|(i, body)| ("body", i, body.name.as_str()));
    let soft = groups.names(soft_bodies).map(|(i, name)| ("soft_body", i, name));
    for (table, i, name) in elastic.chain(soft) {
        if let Some(first) = names.insert(name, format!("{} {i}", table.replace('_', " "))) {
            let message = format!("`{name}` is the name of {first} too; names must differ");
            return Err(at.item(table, i).error("name", message));
        }
    }
    Ok(())
}

fn camera(root: &At, raw: &RawScene) -> Result<Camera, TomlError> {
    let at = root.table("camera");
    let eye = at.finite("eye", raw.camera.eye)?;
    let target = at.finite("target", raw.camera.target)?;
    if eye.distance(target) < 1e-6 {
        return Err(at.error("target", "is where the eye is; the camera has no direction"));
    }
    Ok(Camera { eye, target, fov_degrees: at.between("fov_degrees", raw.camera.fov_degrees, 1.0, 179.0)? })
}

fn body(at: &At, raw: &RawBody) -> Result<Body, TomlError> {
    if raw.name.trim().is_empty() {
        return Err(at.error("name", "is empty; every body needs a name"));
    }
    Ok(Body {
        name: raw.name.clone(),
        rig: at.file("rig", &raw.rig)?,
        pose: at.pose(raw.position, raw.rotation_degrees)?,
        velocity: at.finite("velocity", raw.velocity)?,
        angular_velocity: at.finite("angular_velocity", raw.angular_velocity)?,
        held: raw.held,
        colour: at.colour(raw.colour)?,
    })
}

fn obstacle(at: &At, raw: &RawObstacle) -> Result<Obstacle, TomlError> {
    let shape = shape(&at.table("shape"), &raw.shape)?;
    Ok(Obstacle {
        name: raw.name.clone(),
        dynamic: dynamic(at, raw, &shape)?,
        shape,
        pose: at.pose(raw.position, raw.rotation_degrees)?,
        friction: raw.friction.map(|f| at.between("friction", f, 0.0, f32::MAX)).transpose()?,
        restitution: raw.restitution.map(|r| at.between("restitution", r, 0.0, 1.0)).transpose()?,
        colour: at.colour(raw.colour)?,
        opacity: at.between("opacity", raw.opacity.unwrap_or(1.0), 0.0, 1.0)?,
        path: raw.path.as_ref().map(|p| path(&at.table("path"), p)).transpose()?,
        spin: raw.spin.as_ref().map(|s| spin(&at.table("spin"), s)).transpose()?,
    })
}

/// The mass and motion of an obstacle that rapier moves, if it does.
fn dynamic(at: &At, raw: &RawObstacle, shape: &ObstacleShape) -> Result<Option<Dynamic>, TomlError> {
    let keys = [
        ("mass", raw.mass.is_some()),
        ("density", raw.density.is_some()),
        ("velocity", raw.velocity.is_some()),
        ("angular_velocity", raw.angular_velocity.is_some()),
        ("linear_damping", raw.linear_damping.is_some()),
        ("angular_damping", raw.angular_damping.is_some()),
    ];
    if !raw.dynamic {
        return match keys.into_iter().find(|(_, given)| *given) {
            Some((key, _)) => Err(at.error(key, "is a key of dynamic obstacles; add `dynamic = true` or remove it")),
            None => Ok(None),
        };
    }
    for (key, given) in [("path", raw.path.is_some()), ("spin", raw.spin.is_some())] {
        if given {
            return Err(at.error(key, "is given for a dynamic obstacle, which rapier moves; remove one of them"));
        }
    }
    if !shape.has_volume() {
        return Err(at.error("dynamic", "is given for a shape without a volume, which has no mass"));
    }
    let mass = match (raw.mass, raw.density) {
        (Some(_), Some(_)) => return Err(at.error("density", "is given beside `mass`; one of them is enough")),
        (Some(mass), None) => ObstacleMass::Mass(at.above_zero("mass", mass, f32::MAX)?),
        (None, density) => ObstacleMass::Density(at.above_zero("density", density.unwrap_or(DENSITY), f32::MAX)?),
    };
    Ok(Some(Dynamic {
        mass,
        velocity: at.finite("velocity", raw.velocity.unwrap_or_default())?,
        angular_velocity: at.finite("angular_velocity", raw.angular_velocity.unwrap_or_default())?,
        linear_damping: at.between("linear_damping", raw.linear_damping.unwrap_or(0.0), 0.0, f32::MAX)?,
        angular_damping: at.between("angular_damping", raw.angular_damping.unwrap_or(0.0), 0.0, f32::MAX)?,
    }))
}

/// Density of a dynamic obstacle where the file gives none, in kg/m³: that of light wood.
const DENSITY: f32 = 500.0;

fn path(at: &At, raw: &RawPath) -> Result<ObstaclePath, TomlError> {
    if raw.points.len() < 2 {
        return Err(at.error("points", "needs at least two points"));
    }
    let kind = match raw.kind.as_str() {
        "loop" => PathKind::Loop,
        "ping-pong" => PathKind::PingPong,
        kind => {
            let hint = did_you_mean(kind, ["loop", "ping-pong"]);
            return Err(at.error("kind", format!("is no known kind of path: `{kind}`{hint}")));
        }
    };
    Ok(ObstaclePath {
        points: raw.points.iter().map(|p| at.finite("points", *p)).collect::<Result<_, _>>()?,
        period: at.above_zero("period", raw.period, LARGEST)?,
        kind,
    })
}

fn spin(at: &At, raw: &RawSpin) -> Result<Spin, TomlError> {
    let axis = at.finite("axis", raw.axis)?.as_dvec3().normalize_or_zero().as_vec3();
    if axis == Vec3::ZERO {
        return Err(at.error("axis", "has no length"));
    }
    if !raw.degrees_per_second.is_finite() {
        return Err(at.error("degrees_per_second", "must be a finite number"));
    }
    Ok(Spin { axis, degrees_per_second: raw.degrees_per_second })
}

#[cfg(test)]
#[path = "load_tests.rs"]
mod tests;
