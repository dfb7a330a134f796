//! Checks of single values of a scene file, each complaint with the value's line.

use glam::EulerRot;
use pliant::elastic::{TomlError, TomlKey, TomlText};
use pliant::math::{Pose, Quat, Vec3};
use std::path::{Path, PathBuf};

/// Largest number of a scene: beyond, coordinates have too few digits left for a skin.
pub(super) const LARGEST: f32 = 1.0e5;

/// A table of the file: the text and the way to the table.
#[derive(Clone)]
pub(super) struct At<'a> {
    text: &'a TomlText,
    keys: Vec<TomlKey<'a>>,
}

impl<'a> At<'a> {
    pub fn root(text: &'a TomlText) -> Self {
        Self { text, keys: Vec::new() }
    }

    /// The table under `key`.
    pub fn table(&self, key: &'a str) -> Self {
        Self { text: self.text, keys: [&self.keys[..], &[key.into()]].concat() }
    }

    /// The table with number `index` of the array under `key`.
    pub fn item(&self, key: &'a str, index: usize) -> Self {
        Self { text: self.text, keys: [&self.keys[..], &[key.into(), index.into()]].concat() }
    }

    /// A complaint about the value under `key`: with the names of the table and the key before it.
    pub fn error(&self, key: &str, message: impl AsRef<str>) -> TomlError {
        let mut place = String::new();
        for k in &self.keys {
            match k {
                TomlKey::Name(name) if place.is_empty() => place = (*name).into(),
                TomlKey::Name(name) => place = format!("{place}, {name}"),
                TomlKey::Index(index) => place = format!("{place} {index}"),
            }
        }
        let place = if place.is_empty() { place } else { place + ": " };
        let keys = [&self.keys[..], &[key.into()]].concat();
        self.text.error(&keys, format!("{place}`{key}` {}", message.as_ref()))
    }

    pub fn above_zero(&self, key: &str, value: f32, most: f32) -> Result<f32, TomlError> {
        if value > 0.0 && value <= most {
            return Ok(value);
        }
        let range =
            if most == f32::MAX { "a finite number above 0".into() } else { format!("above 0 and at most {most}") };
        Err(self.error(key, format!("must be {range} and is {value}")))
    }

    pub fn between(&self, key: &str, value: f32, least: f32, most: f32) -> Result<f32, TomlError> {
        if (least..=most).contains(&value) {
            return Ok(value);
        }
        let range = if most == f32::MAX {
            format!("a finite number of at least {least}")
        } else {
            format!("from {least} to {most}")
        };
        Err(self.error(key, format!("must be {range} and is {value}")))
    }

    pub fn finite(&self, key: &str, value: [f32; 3]) -> Result<Vec3, TomlError> {
        let v = Vec3::from(value);
        if !v.is_finite() {
            return Err(self.error(key, "must be finite numbers"));
        }
        if v.abs().max_element() > LARGEST {
            return Err(self.error(key, format!("must be numbers of at most {LARGEST}")));
        }
        Ok(v)
    }

    /// A pose from `position` and XYZ Euler angles `rotation_degrees`.
    pub fn pose(&self, position: [f32; 3], rotation: [f32; 3]) -> Result<Pose, TomlError> {
        let at = self.finite("position", position)?;
        let [x, y, z] = self.finite("rotation_degrees", rotation)?.to_array().map(f32::to_radians);
        Ok(Pose::from_parts(at, Quat::from_euler(EulerRot::XYZ, x, y, z)))
    }

    pub fn colour(&self, colour: Option<[f32; 3]>) -> Result<Option<[f32; 3]>, TomlError> {
        if colour.iter().flatten().all(|c| (0.0..=1.0).contains(c)) {
            return Ok(colour);
        }
        Err(self.error("colour", "must be red, green and blue from 0 to 1"))
    }

    /// A file named relative to the scene's folder, which must exist.
    pub fn file(&self, key: &str, file: &Path) -> Result<PathBuf, TomlError> {
        let path = self.text.resolve(file);
        match path.metadata() {
            Ok(m) if m.is_file() => Ok(path),
            Ok(_) => Err(self.error(key, format!("is not a file (a folder?): {}", path.display()))),
            Err(e) => Err(self.error(key, format!("cannot be opened: {}: {e}", path.display()))),
        }
    }
}
