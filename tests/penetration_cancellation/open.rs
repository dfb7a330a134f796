//! What does not hold yet: the shares of random poses in which a limit may fail, and the arrangements that do.
//!
//! Each share is twice what 40 poses measured, and at least one pose in forty: it may only become smaller. The worst figures
//! of these poses stand in `docs/penetration.md`.

use crate::kinds::Kind;

/// The share of poses of a kind in which a limit may fail, and the share that may take more than four passes.
pub fn open_share(body: &str, kind: Kind) -> (f32, f32) {
    let find = |(name, known, ..): &&(&str, Kind, f32, f32)| *name == body && *known == kind;
    OPEN.iter().find(find).map_or((LEAST, LEAST), |(_, _, bad, many)| (bad.max(LEAST), many.max(LEAST)))
}

/// One pose in forty.
const LEAST: f32 = 0.026;

const OPEN: &[(&str, Kind, f32, f32)] = &[];

/// Arrangements that are known not to hold.
pub fn is_open(body: &str, arrangement: &str) -> bool {
    OPEN_ARRANGEMENTS.iter().any(|(name, start)| *name == body && arrangement.starts_with(start))
}

const OPEN_ARRANGEMENTS: &[(&str, &str)] = &[];
