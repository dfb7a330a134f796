//! Reading bodies that move by themselves and crowds of them, water, cues and attachments.

use super::checks::{At, LARGEST};
use super::random::Random;
use super::raw_soft::{RawAttachment, RawCrowd, RawCue, RawSoftBody, RawWater};
use super::soft_types::{Attachment, Cue, SoftBody, Water};
use super::types::{MAX_DURATION, Obstacle};
use pliant::elastic::{TomlError, did_you_mean};
use pliant::math::{Pose, Quat, Vec3};
use pliant::procdef::{GroundDescription, Stiffness};

/// Most bodies of one crowd.
const MOST: u32 = 10_000;

/// Largest pace of a clock, forwards and backwards.
const FASTEST: f32 = 1000.0;

/// What is known by name: each table with the soft bodies that it stands for.
pub(super) struct Groups(Vec<(String, Vec<usize>)>);

/// All soft bodies of the tables, crowds spread out, and which table each belongs to.
pub(super) fn soft_bodies(root: &At, raw: &[RawSoftBody]) -> Result<(Vec<SoftBody>, Groups), TomlError> {
    let (mut bodies, mut groups) = (Vec::new(), Vec::new());
    for (index, raw) in raw.iter().enumerate() {
        let at = root.item("soft_body", index);
        let first = soft_body(&at, raw)?;
        let from = bodies.len();
        match &raw.crowd {
            Some(crowd) => bodies.extend(self::crowd(&at.table("crowd"), crowd, &first)?),
            None => bodies.push(first),
        }
        groups.push((raw.name.clone(), (from..bodies.len()).collect()));
    }
    Ok((bodies, Groups(groups)))
}

fn soft_body(at: &At, raw: &RawSoftBody) -> Result<SoftBody, TomlError> {
    if raw.name.trim().is_empty() {
        return Err(at.error("name", "is empty; every body needs a name"));
    }
    let stiffness = match (raw.stiffness, raw.iterations) {
        (Some(_), Some(_)) => return Err(at.error("iterations", "is given beside `stiffness`; one of them is enough")),
        (Some(stiffness), None) => Some(Stiffness::Solve(at.between("stiffness", stiffness, 0.0, 1.0)?)),
        (None, Some(n)) if !(1..=64).contains(&n) => {
            return Err(at.error("iterations", format!("must be from 1 to 64 and is {n}")));
        }
        (None, n) => n.map(Stiffness::Iterations),
    };
    Ok(SoftBody {
        name: raw.name.clone(),
        rig: at.file("rig", &raw.rig)?,
        pose: at.pose(raw.position, raw.rotation_degrees)?,
        velocity: at.finite("velocity", raw.velocity)?,
        clock: at.between("clock", raw.clock, -LARGEST, LARGEST)?,
        pace: at.between("pace", raw.pace.unwrap_or(1.0), -FASTEST, FASTEST)?,
        strength: at.between("strength", raw.strength.unwrap_or(1.0), 0.0, 1.0)?,
        rise: raw.rise.map(|rise| at.between("rise", rise, 0.0, LARGEST)).transpose()?,
        stiffness,
        ground: raw.ground.map(|g| ground(&at.table("ground"), g)).transpose()?,
        colour: at.colour(raw.colour)?,
        opacity: at.between("opacity", raw.opacity.unwrap_or(1.0), 0.0, 1.0)?,
    })
}

fn ground(at: &At, raw: GroundDescription) -> Result<GroundDescription, TomlError> {
    if at.finite("direction", raw.direction)? == Vec3::ZERO {
        return Err(at.error("direction", "has no length"));
    }
    for (key, value) in [("forward", raw.forward), ("backward", raw.backward), ("sideways", raw.sideways)] {
        at.between(key, value, 0.0, f32::MAX)?;
    }
    Ok(raw)
}

/// The bodies of a crowd: columns along x and z about the first body's place, layer upon layer, one shifted ahead, the next back.
fn crowd(at: &At, raw: &RawCrowd, first: &SoftBody) -> Result<Vec<SoftBody>, TomlError> {
    if !(1..=MOST).contains(&raw.count) {
        return Err(at.error("count", format!("must be from 1 to {MOST} and is {}", raw.count)));
    }
    let [wide, deep] = raw.columns;
    if wide == 0 || deep == 0 || wide.saturating_mul(deep) > MOST {
        return Err(at.error("columns", format!("must be two numbers of at least 1, together at most {MOST}")));
    }
    let spacing = at.finite("spacing", raw.spacing)?;
    let scatter = at.between("scatter", raw.scatter, 0.0, 1.0)?;
    let turn = at.between("turn_degrees", raw.turn_degrees, -360.0, 360.0)?.to_radians();
    let tilt = at.between("tilt_degrees", raw.tilt_degrees, 0.0, 180.0)?.to_radians();
    let later = at.between("clock", raw.clock, -LARGEST, LARGEST)?;
    let mut random = Random(u64::from(raw.count));
    let member = |i: u32| {
        let layer = i / (wide * deep);
        let shift = if layer % 2 == 1 { 0.25 } else { -0.25 };
        let middle = |columns: u32| 0.5 * (columns as f32 - 1.0);
        let place = Vec3::new(
            (i % wide) as f32 - middle(wide) + shift,
            layer as f32,
            (i / wide % deep) as f32 - middle(deep) + shift,
        );
        let place = (place + random.point() * (0.5 * scatter)) * spacing;
        let lean = Vec3::new(random.next(), 0.0, random.next()) * tilt;
        let rotation = Quat::from_scaled_axis(lean) * Quat::from_rotation_y(turn * i as f32) * first.pose.rotation;
        SoftBody {
            name: format!("{} {}", first.name, i + 1),
            pose: Pose::from_parts(first.pose.translation + place, rotation),
            clock: first.clock + later * i as f32,
            ..first.clone()
        }
    };
    Ok((0..raw.count).map(member).collect())
}

impl Groups {
    /// All names with the table that they belong to: of bodies, and of crowds as a whole.
    pub fn names<'a>(&'a self, bodies: &'a [SoftBody]) -> impl Iterator<Item = (usize, &'a str)> {
        self.0.iter().enumerate().flat_map(move |(table, (group, all))| {
            let members = all.iter().map(|&body| bodies[body].name.as_str());
            let whole = (all.iter().all(|&body| bodies[body].name != *group)).then_some(group.as_str());
            members.chain(whole).map(move |name| (table, name))
        })
    }

    /// The soft bodies that a name stands for: one body, or all of a crowd.
    fn find(&self, at: &At, name: &str, bodies: &[SoftBody]) -> Result<Vec<usize>, TomlError> {
        if let Some((_, all)) = self.0.iter().find(|(group, _)| group == name) {
            return Ok(all.clone());
        }
        if let Some(one) = bodies.iter().position(|body| body.name == name) {
            return Ok(vec![one]);
        }
        let hint = did_you_mean(name, self.0.iter().map(|(group, _)| group.as_str()));
        Err(at.error("body", format!("is no soft body's name: `{name}`{hint}")))
    }

    pub fn cue(&self, at: &At, raw: &RawCue, bodies: &[SoftBody]) -> Result<Cue, TomlError> {
        if raw.touch.is_none() && raw.pace.is_none() && raw.strength.is_none() {
            return Err(at.error("time", "says when, and nothing says what: give `touch`, `pace` or `strength`"));
        }
        Ok(Cue {
            bodies: self.find(at, &raw.body, bodies)?,
            time: at.between("time", raw.time, 0.0, MAX_DURATION)?,
            touch: raw.touch.map(|point| at.finite("touch", point)).transpose()?,
            pace: raw.pace.map(|pace| at.between("pace", pace, -FASTEST, FASTEST)).transpose()?,
            strength: raw.strength.map(|s| at.between("strength", s, 0.0, 1.0)).transpose()?,
        })
    }

    pub fn attachment(
        &self,
        at: &At,
        raw: &RawAttachment,
        bodies: &[SoftBody],
        obstacles: &[Obstacle],
    ) -> Result<Attachment, TomlError> {
        let named = |name: &String| {
            let names = || obstacles.iter().filter_map(|o| o.name.as_deref());
            let found = obstacles.iter().position(|o| o.name.as_ref() == Some(name));
            let hint = || did_you_mean(name, names());
            found.ok_or_else(|| at.error("obstacle", format!("is no obstacle's name: `{name}`{}", hint())))
        };
        Ok(Attachment {
            bodies: self.find(at, &raw.body, bodies)?,
            centre: at.finite("centre", raw.centre)?,
            radius: at.above_zero("radius", raw.radius, LARGEST)?,
            obstacle: raw.obstacle.as_ref().map(named).transpose()?,
        })
    }
}

/// A box of water; without corners it is everywhere.
pub(super) fn water(at: &At, raw: &RawWater) -> Result<Water, TomlError> {
    let min = at.finite("min", raw.min.unwrap_or([-LARGEST; 3]))?;
    let max = at.finite("max", raw.max.unwrap_or([LARGEST; 3]))?;
    if !max.cmpgt(min).all() {
        return Err(at.error("max", "must be above `min` in all three directions"));
    }
    Ok(Water { min, max, flow: at.finite("flow", raw.flow)? })
}

#[cfg(test)]
#[path = "soft_tests.rs"]
mod tests;
