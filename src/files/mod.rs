//! What files that are written by hand have in common: TOML whose faults are told with file, line and a hint.

mod toml_text;

pub use toml_text::{MAX_TOML_BYTES, TomlError, TomlKey, TomlText, did_you_mean};
