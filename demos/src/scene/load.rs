//! Reading a scene file: every fault is told with the file, the line and the key.

use super::checks::{At, LARGEST};
use super::dragger::dragger;
use super::raw::{RawBody, RawObstacle, RawPath, RawScene, RawShape, RawSpin};
use super::types::{Body, Camera, MAX_DT, MAX_DURATION, Obstacle, ObstaclePath, ObstacleShape, PathKind, Scene, Spin};
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
    let mut names = HashMap::new();
    for (i, b) in bodies.iter().enumerate() {
        if let Some(first) = names.insert(b.name.as_str(), i) {
            let message = format!("`{}` is the name of body {first} too; names must differ", b.name);
            return Err(at.item("body", i).error("name", message));
        }
    }
    Ok(Scene {
        duration: at.above_zero("duration", raw.duration, MAX_DURATION)?,
        dt: at.above_zero("dt", raw.dt, MAX_DT)?,
        gravity: at.finite("gravity", raw.gravity)?,
        softness: raw.softness.map(|s| at.above_zero("softness", s, 10.0)).transpose()?,
        camera: camera(&at, &raw)?,
        obstacles: raw
            .obstacle
            .iter()
            .enumerate()
            .map(|(i, o)| obstacle(&at.item("obstacle", i), o))
            .collect::<Result<_, _>>()?,
        draggers: raw
            .dragger
            .iter()
            .enumerate()
            .map(|(i, d)| dragger(&at.item("dragger", i), d, &bodies))
            .collect::<Result<_, _>>()?,
        bodies,
        name: raw.name,
    })
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
        colour: at.colour(raw.colour)?,
    })
}

fn obstacle(at: &At, raw: &RawObstacle) -> Result<Obstacle, TomlError> {
    Ok(Obstacle {
        name: raw.name.clone(),
        shape: shape(&at.table("shape"), &raw.shape)?,
        pose: at.pose(raw.position, raw.rotation_degrees)?,
        friction: raw.friction.map(|f| at.between("friction", f, 0.0, f32::MAX)).transpose()?,
        colour: at.colour(raw.colour)?,
        opacity: at.between("opacity", raw.opacity.unwrap_or(1.0), 0.0, 1.0)?,
        path: raw.path.as_ref().map(|p| path(&at.table("path"), p)).transpose()?,
        spin: raw.spin.as_ref().map(|s| spin(&at.table("spin"), s)).transpose()?,
    })
}

/// The keys of each kind of shape, the needed ones first and how many they are.
const SHAPES: [(&str, &[&str], usize); 7] = [
    ("ball", &["radius"], 1),
    ("cuboid", &["half_extents"], 1),
    ("capsule", &["half_height", "radius"], 2),
    ("cylinder", &["half_height", "radius"], 2),
    ("cone", &["half_height", "radius"], 2),
    ("mesh", &["file", "scale", "max_parts"], 1),
    ("ring", &["radius", "thickness"], 2),
];

fn shape(at: &At, raw: &RawShape) -> Result<ObstacleShape, TomlError> {
    let kind = raw.kind.as_str();
    let Some((_, keys, needed)) = SHAPES.iter().find(|s| s.0 == kind) else {
        let hint = did_you_mean(kind, SHAPES.map(|s| s.0));
        return Err(at.error("kind", format!("is no known shape: `{kind}`{hint}")));
    };
    let given = [
        ("radius", raw.radius.is_some()),
        ("half_height", raw.half_height.is_some()),
        ("half_extents", raw.half_extents.is_some()),
        ("file", raw.file.is_some()),
        ("scale", raw.scale.is_some()),
        ("max_parts", raw.max_parts.is_some()),
        ("thickness", raw.thickness.is_some()),
    ];
    for (key, is_given) in given {
        match keys.iter().position(|k| *k == key) {
            None if is_given => return Err(at.error(key, format!("is no key of a {kind}; remove it"))),
            Some(place) if place < *needed && !is_given => {
                return Err(at.error(key, format!("is missing: a {kind} needs it")));
            }
            _ => {}
        }
    }
    let length = |key, value: Option<f32>| at.above_zero(key, value.unwrap_or(1.0), LARGEST);
    let radius = length("radius", raw.radius)?;
    let half_height = length("half_height", raw.half_height)?;
    Ok(match kind {
        "ball" => ObstacleShape::Ball { radius },
        "capsule" => ObstacleShape::Capsule { half_height, radius },
        "cylinder" => ObstacleShape::Cylinder { half_height, radius },
        "cone" => ObstacleShape::Cone { half_height, radius },
        "ring" => ObstacleShape::Ring { radius, thickness: length("thickness", raw.thickness)? },
        "cuboid" => {
            let sides = raw.half_extents.unwrap_or([1.0; 3]);
            sides.iter().try_for_each(|s| at.above_zero("half_extents", *s, LARGEST).map(drop))?;
            ObstacleShape::Cuboid { half_extents: Vec3::from(sides) }
        }
        _ => {
            if raw.max_parts.is_some_and(|parts| !(1..=MAX_PARTS).contains(&parts)) {
                return Err(at.error("max_parts", format!("must be at least 1 and at most {MAX_PARTS}")));
            }
            let file = at.file("file", raw.file.as_deref().unwrap_or(Path::new("")))?;
            ObstacleShape::Mesh { file, scale: length("scale", raw.scale)?, max_parts: raw.max_parts }
        }
    })
}

/// Most convex parts of a mesh: more take minutes to find and do not look better.
const MAX_PARTS: u32 = 1024;

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
