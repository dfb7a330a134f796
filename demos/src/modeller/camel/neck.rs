//! The neck: thick where it leaves the chest, first forward and down, then up in an S.

use crate::modeller::tube::Tube;

/// How smoothly the neck flows into the chest.
pub const REACH: f32 = 0.12;

/// The neck as a tube, a little narrower than deep.
pub fn neck() -> Tube {
    Tube::through(&[
        [0.42, 1.42, 0.0, 0.24],
        [0.66, 1.32, 0.0, 0.185],
        [0.88, 1.285, 0.0, 0.15],
        [1.06, 1.36, 0.0, 0.13],
        [1.17, 1.53, 0.0, 0.113],
        [1.215, 1.73, 0.0, 0.10],
        [1.25, 1.90, 0.0, 0.09],
        [1.31, 1.99, 0.0, 0.08],
    ])
    .flattened(0.82)
}
