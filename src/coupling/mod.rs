//! Between rapier and the elastic bodies: ragdolls, obstacles, repelling impulses, penetration cancellation.
//!
//! Rapier's sets are borrowed for a call; nothing of them is kept.

mod at_once;
mod attempt;
mod cancel;
mod cancel_memory;
mod closing;
mod coherence;
mod common_way;
mod contact;
mod continued;
mod find_contacts;
mod gauge;
mod grade;
mod guards;
mod joined;
mod literal;
mod magnitude;
mod obstacle;
mod pairs;
mod penetrations;
mod piercing;
mod probes;
pub mod procdef;
mod skin_point;
mod strength;

pub use cancel::{CancelReport, CancelSettings, Placement, cancel, cancel_further, cancel_with_memory};
pub use cancel_memory::CancelMemory;
pub use coherence::{CoherenceMemory, SMOOTH, SkinsMet, TimeCoherence};
pub use common_way::share_ways_out;
pub use contact::{Proximity, moved_axis, penetration, way_out};
pub use find_contacts::{find_contacts, find_piercings};
pub use folds::count_folds;
pub use gauge::{Bar, gauge_point};
pub use guards::find_guards;
pub use magnitude::complementarity;
pub use obstacle::{
    DEFAULT_THICKNESS, LocalPart, ObstacleError, ObstaclePart, OuterFace, PartCache, PartId, PartSource, convex_parts,
    decompose, decompose_cached,
};
pub use pairs::{
    HeightMap, Interface, Overlap, OverlapPoint, SegmentPair, SegmentRef, SkinSide, Widening, interface_part, pairs_of,
    segment_bounds, self_pairs,
};
pub use penetrations::{Contact, Penetration};
pub use piercing::{deepest_on_triangle, pierced};
pub use skin_point::SkinPoint;
mod folds;
mod foundation;
mod measure;
mod ragdoll;

pub use foundation::{
    Approach, ContactKeys, ContactMaterial, ElasticSide, FoundationContact, FoundationMemory, FoundationPoint,
    FoundationSettings, PairApproaches, PairPoint, StepSize, pair_contacts, push_back, remember_pair_contacts,
    remember_skin_contacts, skin_contacts,
};
pub use measure::{INSIDE, PIERCED, PIERCING_RESOLUTION, PenetrationFigures, measure};
pub use ragdoll::{CORE_FRACTION, Ragdoll, RagdollStart, core_shape, elastic_joint, segment_shape};
mod surroundings;
mod watched;
mod ways;
pub use surroundings::{ContactMemories, ContactMemory, obstacles_near, proximities, remember_leaders};
