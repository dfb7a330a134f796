//! Reading the shape of an obstacle: which keys each kind has, and what they may be.

use super::checks::{At, LARGEST};
use super::raw::{RawShape, Triple};
use super::shape_types::{Member, ObstacleShape, Points, VoxelSource};
use pliant::elastic::{TomlError, did_you_mean};
use pliant::math::Vec3;
use std::path::Path;

/// A kind of shape, the keys that it needs, and those that it may have.
type Kind = (&'static str, &'static [&'static str], &'static [&'static str]);

const KINDS: [Kind; 15] = [
    ("ball", &["radius"], &[]),
    ("cuboid", &["half_extents"], &["rounding"]),
    ("capsule", &["half_height", "radius"], &[]),
    ("cylinder", &["half_height", "radius"], &["rounding"]),
    ("cone", &["half_height", "radius"], &["rounding"]),
    ("ring", &["radius", "thickness"], &[]),
    ("half_space", &[], &["normal"]),
    ("triangle", &["points"], &["rounding"]),
    ("polyline", &["points"], &[]),
    ("hull", &[], &["points", "file", "scale", "rounding"]),
    ("mesh", &["file"], &["scale", "max_parts"]),
    ("triangle_mesh", &["file"], &["scale", "one_sided"]),
    ("heightfield", &["heights", "size"], &[]),
    ("voxels", &["voxel_size"], &["cells", "file", "scale"]),
    ("compound", &["shapes"], &[]),
];

/// Most convex parts of a mesh: more take minutes to find and do not look better.
const MAX_PARTS: u32 = 1024;

pub(super) fn shape(at: &At, raw: &RawShape) -> Result<ObstacleShape, TomlError> {
    for (key, given) in [("position", raw.position.is_some()), ("rotation_degrees", raw.rotation_degrees.is_some())] {
        if given {
            return Err(at.error(key, "is a key of the obstacle, or of a member of a compound; remove it"));
        }
    }
    shape_of(at, raw)
}

fn shape_of(at: &At, raw: &RawShape) -> Result<ObstacleShape, TomlError> {
    let kind = raw.kind.as_str();
    check_keys(at, raw)?;
    let length = |key, value: Option<f32>| at.above_zero(key, value.unwrap_or(1.0), LARGEST);
    let radius = length("radius", raw.radius)?;
    let half_height = length("half_height", raw.half_height)?;
    let scale = length("scale", raw.scale)?;
    let rounding = at.between("rounding", raw.rounding.unwrap_or(0.0), 0.0, LARGEST)?;
    let file = || at.file("file", raw.file.as_deref().unwrap_or(Path::new("")));
    Ok(match kind {
        "ball" => ObstacleShape::Ball { radius },
        "capsule" => ObstacleShape::Capsule { half_height, radius },
        "cylinder" => ObstacleShape::Cylinder { half_height, radius, rounding },
        "cone" => ObstacleShape::Cone { half_height, radius, rounding },
        "ring" => ObstacleShape::Ring { radius, thickness: length("thickness", raw.thickness)? },
        "cuboid" => {
            let sides = raw.half_extents.unwrap_or([1.0; 3]);
            sides.iter().try_for_each(|s| at.above_zero("half_extents", *s, LARGEST).map(drop))?;
            ObstacleShape::Cuboid { half_extents: Vec3::from(sides), rounding }
        }
        "half_space" => {
            let normal = at.finite("normal", raw.normal.unwrap_or([0.0, 1.0, 0.0]))?;
            let Some(normal) = normal.try_normalize() else { return Err(at.error("normal", "has no length")) };
            ObstacleShape::HalfSpace { normal }
        }
        "triangle" => match points(at, raw, 3)?[..] {
            [a, b, c] => ObstacleShape::Triangle { corners: [a, b, c], rounding },
            _ => return Err(at.error("points", "must be three for a triangle")),
        },
        "polyline" => ObstacleShape::Polyline { points: points(at, raw, 2)? },
        "hull" => {
            let points = match either(at, kind, ["points", "file"], [raw.points.is_some(), raw.file.is_some()])? {
                0 => Points::List(points(at, raw, 4)?),
                _ => Points::File { file: file()?, scale },
            };
            ObstacleShape::Hull { points, rounding }
        }
        "triangle_mesh" => {
            ObstacleShape::TriangleMesh { file: file()?, scale, one_sided: raw.one_sided.unwrap_or(false) }
        }
        "heightfield" => heightfield(at, raw)?,
        "voxels" => {
            let source = match either(at, kind, ["cells", "file"], [raw.cells.is_some(), raw.file.is_some()])? {
                0 => VoxelSource::Cells(cells(at, raw)?),
                _ => VoxelSource::Filled { file: file()?, scale },
            };
            ObstacleShape::Voxels { voxel_size: length("voxel_size", raw.voxel_size)?, source }
        }
        "compound" => {
            let shapes = raw.shapes.as_deref().unwrap_or_default();
            if shapes.is_empty() {
                return Err(at.error("shapes", "is empty; a compound needs members"));
            }
            let members = shapes.iter().enumerate().map(|(i, raw)| member(&at.item("shapes", i), raw));
            ObstacleShape::Compound { members: members.collect::<Result<_, _>>()? }
        }
        _ => {
            if raw.max_parts.is_some_and(|parts| !(1..=MAX_PARTS).contains(&parts)) {
                return Err(at.error("max_parts", format!("must be at least 1 and at most {MAX_PARTS}")));
            }
            ObstacleShape::Mesh { file: file()?, scale, max_parts: raw.max_parts }
        }
    })
}

/// Every key that the kind needs is there, and no other.
fn check_keys(at: &At, raw: &RawShape) -> Result<(), TomlError> {
    let kind = raw.kind.as_str();
    let Some((_, needed, allowed)) = KINDS.iter().find(|known| known.0 == kind) else {
        let hint = did_you_mean(kind, KINDS.map(|known| known.0));
        return Err(at.error("kind", format!("is no known shape: `{kind}`{hint}")));
    };
    for (key, is_given) in raw.given() {
        if needed.contains(&key) && !is_given {
            return Err(at.error(key, format!("is missing: a {kind} needs it")));
        }
        if is_given && !needed.contains(&key) && !allowed.contains(&key) {
            return Err(at.error(key, format!("is no key of a {kind}; remove it")));
        }
    }
    Ok(())
}

/// Which of two keys is given: exactly one must be.
fn either(at: &At, kind: &str, keys: [&str; 2], given: [bool; 2]) -> Result<usize, TomlError> {
    let [one, other] = keys;
    match given {
        [true, true] => Err(at.error(other, format!("is given beside `{one}`: a {kind} has one of them"))),
        [false, false] => Err(at.error(one, format!("is missing: a {kind} needs it, or `{other}`"))),
        [first, _] => Ok(usize::from(!first)),
    }
}

fn points(at: &At, raw: &RawShape, least: usize) -> Result<Vec<Vec3>, TomlError> {
    let raw: &[Triple] = raw.points.as_deref().unwrap_or_default();
    if raw.len() < least {
        return Err(at.error("points", format!("needs at least {least} points and has {}", raw.len())));
    }
    raw.iter().map(|p| at.finite("points", *p)).collect()
}

fn heightfield(at: &At, raw: &RawShape) -> Result<ObstacleShape, TomlError> {
    let rows = raw.heights.clone().unwrap_or_default();
    let columns = rows.first().map_or(0, Vec::len);
    if rows.len() < 2 || columns < 2 {
        return Err(at.error("heights", "needs at least two rows of at least two heights"));
    }
    if let Some(row) = rows.iter().position(|row| row.len() != columns) {
        let message = format!("has {columns} heights in its first row and {} in row {row}", rows[row].len());
        return Err(at.error("heights", message));
    }
    for height in rows.iter().flatten() {
        at.between("heights", *height, -LARGEST, LARGEST)?;
    }
    let size = raw.size.unwrap_or([1.0; 2]);
    size.iter().try_for_each(|s| at.above_zero("size", *s, LARGEST).map(drop))?;
    Ok(ObstacleShape::HeightField { heights: rows, size })
}

/// Farthest voxel of a list along each axis.
const FARTHEST_CELL: i32 = 1 << 15;

fn cells(at: &At, raw: &RawShape) -> Result<Vec<[i32; 3]>, TomlError> {
    let cells = raw.cells.clone().unwrap_or_default();
    if cells.is_empty() {
        return Err(at.error("cells", "is empty; voxels need at least one"));
    }
    if cells.iter().flatten().any(|c| c.abs() > FARTHEST_CELL) {
        return Err(at.error("cells", format!("must lie from -{FARTHEST_CELL} to {FARTHEST_CELL}")));
    }
    Ok(cells)
}

fn member(at: &At, raw: &RawShape) -> Result<Member, TomlError> {
    let nested = ["compound", "mesh", "ring", "triangle_mesh", "heightfield", "voxels", "polyline"];
    if nested.contains(&raw.kind.as_str()) {
        return Err(
            at.error("kind", format!("is `{}`, which has parts of its own: give it an obstacle of its own", raw.kind))
        );
    }
    let (position, rotation) = (raw.position.unwrap_or_default(), raw.rotation_degrees.unwrap_or_default());
    Ok(Member { pose: at.pose(position, rotation)?, shape: shape_of(at, raw)? })
}

#[cfg(test)]
#[path = "shape_tests.rs"]
mod tests;
