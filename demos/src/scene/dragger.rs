//! Hands of a scene: each holds a point of a body and leads it along a path in time.

use super::checks::{At, LARGEST};
use super::raw::RawDragger;
use super::types::{Body, MAX_DURATION};
use pliant::elastic::{TomlError, did_you_mean};
use pliant::math::Vec3;

/// A hand that follows a script.
#[derive(Clone, Debug, PartialEq)]
pub struct Dragger {
    /// Index of the body that it holds.
    pub body: usize,
    /// What it pulls.
    pub pulls: Pulls,
    /// Where it holds the body, in its mesh.
    pub point: Vec3,
    /// Times in seconds, rising, and where the point is wanted then: of a body in the world, of skin as an offset from
    /// where it would be by itself. At least two. It takes hold at the first time and lets go at the last.
    pub keys: Vec<(f32, Vec3)>,
}

/// What a dragger pulls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pulls {
    /// The rigid body, by a critically damped spring.
    Body {
        /// Natural frequency in hertz, positive.
        frequency: f32,
        /// True: the body does not turn while it is held.
        steady: bool,
    },
    /// The skin alone.
    Skin {
        /// Radius of influence in metres, positive.
        radius: f32,
    },
}

impl Dragger {
    /// Where the point is wanted at `time` seconds: still at each key and smooth between them. `None` while nothing is
    /// held.
    pub fn goal_at(&self, time: f32) -> Option<Vec3> {
        let pair = self.keys.windows(2).find(|pair| (pair[0].0..=pair[1].0).contains(&time))?;
        let [(start, from), (end, to)] = [pair[0], pair[1]];
        let s = (time - start) / (end - start);
        Some(from.lerp(to, s * s * s * (10.0 + s * (6.0 * s - 15.0))))
    }
}

pub(super) fn dragger(at: &At, raw: &RawDragger, bodies: &[Body]) -> Result<Dragger, TomlError> {
    let names = bodies.iter().map(|b| b.name.as_str());
    let Some(body) = names.clone().position(|name| name == raw.body) else {
        return Err(at.error("body", format!("is no body's name: `{}`{}", raw.body, did_you_mean(&raw.body, names))));
    };
    let pulls = match raw.pulls.as_str() {
        "body" if raw.radius.is_some() => {
            return Err(at.error("radius", "is no key where a body is pulled; remove it"));
        }
        "body" => Pulls::Body {
            frequency: at.above_zero("frequency", raw.frequency.unwrap_or(FREQUENCY), 1000.0)?,
            steady: raw.steady.unwrap_or(false),
        },
        "skin" if raw.frequency.is_some() => {
            return Err(at.error("frequency", "is no key where skin is pulled; remove it"));
        }
        "skin" if raw.steady.is_some() => {
            return Err(at.error("steady", "is no key where skin is pulled; remove it"));
        }
        "skin" => match raw.radius {
            Some(radius) => Pulls::Skin { radius: at.above_zero("radius", radius, LARGEST)? },
            None => return Err(at.error("radius", "is missing: skin is pulled within a radius")),
        },
        other => {
            let hint = did_you_mean(other, ["body", "skin"]);
            return Err(at.error("pulls", format!("must be `body` or `skin` and is `{other}`{hint}")));
        }
    };
    Ok(Dragger { body, pulls, point: at.finite("point", raw.point)?, keys: keys(at, &raw.keys)? })
}

/// Natural frequency of the pull at a body where the file gives none, in hertz.
const FREQUENCY: f32 = 3.0;

fn keys(at: &At, raw: &[[f32; 4]]) -> Result<Vec<(f32, Vec3)>, TomlError> {
    if raw.len() < 2 {
        return Err(at.error("keys", "must be at least two: [[time, x, y, z], …]"));
    }
    let mut keys: Vec<(f32, Vec3)> = Vec::with_capacity(raw.len());
    for &[time, x, y, z] in raw {
        let time = at.between("keys", time, 0.0, MAX_DURATION)?;
        if keys.last().is_some_and(|&(before, _)| time <= before) {
            return Err(at.error("keys", "must have times that rise"));
        }
        keys.push((time, at.finite("keys", [x, y, z])?));
    }
    Ok(keys)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Scene, load_scene};
    use std::fs;

    /// Lines are counted in the table below.
    const GOOD: &str = r#"name = "hands"
duration = 1.0
camera = { eye = [0, 2, 8], target = [0, 1, 0] }
[[body]]
name = "head"
rig = "scene.toml"
[[dragger]]
body = "head"
pulls = "body"
frequency = 2.0
steady = true
keys = [[0, 0, 1, 0], [2, 1, 1, 0]]
[[dragger]]
body = "head"
pulls = "skin"
point = [0.4, 0, 0]
radius = 0.3
keys = [[0.5, 0, 0, 0], [1, 0.5, 0, 0]]
"#;

    fn load(text: &str) -> Result<Scene, TomlError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.toml");
        fs::write(&path, text).unwrap();
        load_scene(path)
    }

    #[test]
    fn both_kinds_of_draggers_are_read() {
        let draggers = load(GOOD).unwrap().draggers;
        assert_eq!(draggers[0].pulls, Pulls::Body { frequency: 2.0, steady: true });
        assert_eq!((draggers[1].pulls, draggers[1].point), (Pulls::Skin { radius: 0.3 }, Vec3::X * 0.4));
        assert_eq!(draggers[1].keys, [(0.5, Vec3::ZERO), (1.0, Vec3::X * 0.5)]);
    }

    #[test]
    fn bad_draggers_are_refused_with_their_line_and_a_hint() {
        let table: &[(&str, &str, usize, &str)] = &[
            ("frequency = 2.0", "frequenzy = 2.0", 10, "did you mean `frequency`?"),
            ("frequency = 2.0", "frequency = 0", 10, "dragger 0: `frequency` must be above 0"),
            ("frequency = 2.0", "radius = 2.0", 10, "`radius` is no key where a body is pulled"),
            ("body = \"head\"\npulls = \"body\"", "body = \"haed\"\npulls = \"body\"", 8, "did you mean `head`?"),
            ("pulls = \"body\"", "pulls = \"bodies\"", 9, "must be `body` or `skin`"),
            ("[[0, 0, 1, 0], [2, 1, 1, 0]]", "[[0, 0, 1, 0]]", 12, "at least two"),
            ("[2, 1, 1, 0]", "[0, 1, 1, 0]", 12, "times that rise"),
            ("[2, 1, 1, 0]", "[2, nan, 1, 0]", 12, "finite"),
            ("[2, 1, 1, 0]", "[-2, 1, 1, 0]", 12, "from 0 to"),
            ("point = [0.4, 0, 0]", "point = [inf, 0, 0]", 16, "dragger 1: `point`"),
            ("radius = 0.3", "radius = -0.3", 17, "`radius`"),
            ("radius = 0.3", "", 13, "`radius` is missing"),
            ("radius = 0.3", "radius = 0.3\nsteady = true", 18, "`steady` is no key where skin is pulled"),
            ("radius = 0.3", "radius = 0.3\nfrequency = 1", 18, "`frequency` is no key where skin is pulled"),
        ];
        for (from, to, line, words) in table {
            assert!(GOOD.contains(from), "{from}");
            let message = load(&GOOD.replacen(from, to, 1)).map(drop).expect_err(to).to_string();
            assert!(message.contains(&format!("scene.toml:{line}: ")) && message.contains(words), "{to}: {message}");
        }
    }

    #[test]
    fn the_goal_passes_the_keys_and_stands_still_there() {
        let keys = vec![(1.0, Vec3::ZERO), (2.0, Vec3::X), (4.0, Vec3::Y)];
        let dragger = Dragger { body: 0, pulls: Pulls::Skin { radius: 1.0 }, point: Vec3::ZERO, keys };
        assert_eq!((dragger.goal_at(0.99), dragger.goal_at(4.01)), (None, None), "nothing is held");
        for &(time, place) in &dragger.keys {
            assert_eq!(dragger.goal_at(time), Some(place));
        }
        let goal = |time| dragger.goal_at(time).unwrap();
        assert!(goal(1.99).distance(Vec3::X) < 1e-4 && goal(2.01).distance(Vec3::X) < 1e-4);
        assert!((goal(1.5) - Vec3::X * 0.5).length() < 1e-6);
    }
}
