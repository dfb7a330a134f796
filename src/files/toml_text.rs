//! A TOML file with its text at hand, so that every fault in it is told with file, line and a hint.

use serde::de::DeserializeOwned;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use toml::de::{DeTable, DeValue};

/// Larger files are refused before they are read: 16 MiB.
pub const MAX_TOML_BYTES: u64 = 16 << 20;

/// Why a TOML file cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum TomlError {
    /// The file cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The path names a folder or something else that is not a file.
    #[error("{}: this is not a file (a folder?)", path.display())]
    NotAFile {
        /// The path.
        path: PathBuf,
    },
    /// The file is over [`MAX_TOML_BYTES`].
    #[error("{}: the file has {bytes} bytes, more than the {MAX_TOML_BYTES} that are read; is this the right file?", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Its size.
        bytes: u64,
    },
    /// Syntax, a wrong type, an unknown or missing key, or bytes that are not text.
    #[error("{}:{line}: {message}", path.display())]
    At {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// What is wrong, with a hint.
        message: String,
    },
}

/// A step on the way to a value in a TOML file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TomlKey<'a> {
    /// A key of a table.
    Name(&'a str),
    /// A place in an array, from 0.
    Index(usize),
}

impl<'a> From<&'a str> for TomlKey<'a> {
    fn from(name: &'a str) -> Self {
        Self::Name(name)
    }
}

impl From<usize> for TomlKey<'_> {
    fn from(index: usize) -> Self {
        Self::Index(index)
    }
}

/// The text of a TOML file and where it came from.
#[derive(Clone, Debug)]
pub struct TomlText {
    path: PathBuf,
    text: String,
}

impl TomlText {
    /// Reads a file.
    ///
    /// # Errors
    /// A missing or unreadable file, a folder, a file over [`MAX_TOML_BYTES`], text that is not UTF-8 (with its line).
    pub fn read(path: impl AsRef<Path>) -> Result<Self, TomlError> {
        let path = path.as_ref();
        let unreadable = |source| TomlError::Unreadable { path: path.into(), source };
        let metadata = fs::metadata(path).map_err(unreadable)?;
        if !metadata.is_file() {
            return Err(TomlError::NotAFile { path: path.into() });
        }
        if metadata.len() > MAX_TOML_BYTES {
            return Err(TomlError::TooLarge { path: path.into(), bytes: metadata.len() });
        }
        match String::from_utf8(fs::read(path).map_err(unreadable)?) {
            Ok(text) => Ok(Self::new(path, text)),
            Err(e) => {
                let line = 1 + e.as_bytes()[..e.utf8_error().valid_up_to()].iter().filter(|b| **b == b'\n').count();
                let message = "the text is not UTF-8; save the file as UTF-8".into();
                Err(TomlError::At { path: path.into(), line, message })
            }
        }
    }

    /// Takes a text that is at hand as if it had been read from `path`.
    pub fn new(path: impl Into<PathBuf>, text: impl Into<String>) -> Self {
        let text: String = text.into();
        // The mark is blanked instead of removed: places in the text stay the same.
        let text = text.strip_prefix('\u{feff}').map_or(text.clone(), |t| format!("   {t}"));
        Self { path: path.into(), text }
    }

    /// The file's path as it was given.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// A path in this file, relative to the file's folder.
    pub fn resolve(&self, relative: impl AsRef<Path>) -> PathBuf {
        self.path.parent().unwrap_or(Path::new("")).join(relative)
    }

    /// Reads the text into a type, for which unknown keys should be denied.
    ///
    /// # Errors
    /// Syntax errors, wrong types, unknown and missing keys: with their line, and for a misspelt key the nearest one.
    pub fn parse<T: DeserializeOwned>(&self) -> Result<T, TomlError> {
        toml::from_str(&self.text).map_err(|e| TomlError::At {
            path: self.path.clone(),
            line: self.line_at(e.span().map_or(0, |s| s.start)),
            message: friendly(e.message()),
        })
    }

    /// The line (from 1) of the value that `keys` lead to, or of the last of them that there is; 1 for none.
    pub fn line_of(&self, keys: &[TomlKey]) -> usize {
        self.span_of(keys).map_or(1, |span| self.line_at(span.start))
    }

    fn span_of(&self, keys: &[TomlKey]) -> Option<Range<usize>> {
        let root = DeTable::parse(&self.text).ok()?;
        let mut span = None;
        let mut here: Option<&DeValue> = None;
        for key in keys {
            let next = match (*key, here) {
                (TomlKey::Name(name), None) => root.get_ref().get(name),
                (TomlKey::Name(name), Some(value)) => value.as_table().and_then(|t| t.get(name)),
                (TomlKey::Index(index), Some(value)) => value.as_array().and_then(|a| a.get(index)),
                (TomlKey::Index(_), None) => None,
            };
            let Some(next) = next else { break };
            span = Some(next.span());
            here = Some(next.get_ref());
        }
        span
    }

    fn line_at(&self, byte: usize) -> usize {
        1 + self.text.as_bytes()[..byte.min(self.text.len())].iter().filter(|b| **b == b'\n').count()
    }

    /// An error at the value that `keys` lead to.
    pub fn error(&self, keys: &[TomlKey], message: impl Into<String>) -> TomlError {
        TomlError::At { path: self.path.clone(), line: self.line_of(keys), message: message.into() }
    }
}

/// The parser's message in words that help: unknown keys with the nearest known one.
fn friendly(message: &str) -> String {
    let names: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    match names[..] {
        [unknown, ref known @ ..] if message.starts_with("unknown field") => {
            format!("unknown key `{unknown}`{}", did_you_mean(unknown, known.iter().copied()))
        }
        [missing, ..] if message.starts_with("missing field") => format!("the key `{missing}` is missing here"),
        _ => message.trim().replace('\n', " "),
    }
}

/// Longer words are not compared: that takes time and space with the product of the lengths.
const MAX_WORD: usize = 64;

/// `, did you mean X?` for the candidate nearest to `word`, or a list of the candidates when none is near.
pub fn did_you_mean<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> String {
    if word.chars().nth(MAX_WORD).is_some() {
        return String::new();
    }
    let candidates: Vec<&str> = candidates.into_iter().filter(|c| c.chars().nth(MAX_WORD).is_none()).collect();
    let nearest =
        candidates.iter().map(|c| (strsim::damerau_levenshtein(&word.to_lowercase(), &c.to_lowercase()), *c)).min();
    match nearest {
        Some((distance, name)) if distance <= 1 + name.chars().count() / 3 => format!(", did you mean `{name}`?"),
        Some(_) if candidates.len() <= 24 => format!("; there are: {}", candidates.join(", ")),
        _ => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_deep_in_the_file_is_found_with_its_line() {
        let text =
            TomlText::new("a.toml", "x = 1\n[[part]]\nname = \"a\"\n\n[[part]]\nname = \"b\"\nshape = { kind = 1 }\n");
        assert_eq!(text.line_of(&["x".into()]), 1);
        assert_eq!(text.line_of(&["part".into(), 1.into(), "name".into()]), 6);
        assert_eq!(text.line_of(&["part".into(), 1.into(), "shape".into(), "kind".into()]), 7);
        assert_eq!(text.line_of(&["part".into(), 1.into(), "none".into()]), 5);
        assert_eq!(text.line_of(&["none".into()]), 1);
    }

    #[test]
    fn paths_and_bytes_that_are_no_text_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let error = |path: &Path| TomlText::read(path).unwrap_err().to_string();
        assert!(error(folder.path()).contains("not a file"));
        assert!(error(&folder.path().join("no.toml")).contains("no.toml: cannot be read"));
        let file = folder.path().join("bytes.toml");
        fs::write(&file, b"a = 1\nb = \"\xff\"").unwrap();
        assert!(error(&file).contains("bytes.toml:2: the text is not UTF-8"));
        fs::File::create(&file).unwrap().set_len(MAX_TOML_BYTES + 1).unwrap();
        assert!(error(&file).contains("more than"));
    }

    #[test]
    fn a_misspelt_word_gets_the_nearest_and_a_foreign_one_the_list() {
        assert_eq!(did_you_mean("dencity", ["mass", "density"]), ", did you mean `density`?");
        assert_eq!(did_you_mean("zzz", ["mass", "density"]), "; there are: mass, density");
        assert_eq!(did_you_mean("zzz", []), "");
        assert_eq!(did_you_mean(&"z".repeat(1 << 24), ["mass"]), "");
    }
}
