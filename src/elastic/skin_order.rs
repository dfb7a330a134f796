//! The order in which a skin is deformed in batches: vertices that the same segment moves stand together.

use super::rig::{MAX_INFLUENCES, SkinWeights};
use crate::field::LANES;

/// Batches of vertices and of index-weight pairs. The last of each is filled up by repeating its last member.
#[derive(Clone, Debug, PartialEq)]
pub struct SkinOrder {
    /// All vertices, sorted by their heaviest segments.
    pub vertices: Vec<[u32; LANES]>,
    /// All vertices that a segment moves, segment by segment.
    pub pairs: Vec<PairBatch>,
    /// Where in the concatenated pairs the `k`-th influence of each vertex stands; `u32::MAX` where it has none.
    pub slots: Vec<[u32; MAX_INFLUENCES]>,
}

/// Up to eight vertices that the same segment moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairBatch {
    /// The segment.
    pub segment: u16,
    /// The vertices.
    pub vertices: [u32; LANES],
}

impl SkinOrder {
    /// The order of a skin with these weights and `segments` segments.
    pub fn new(weights: &[SkinWeights], segments: usize) -> Self {
        let mut sorted: Vec<u32> = (0..weights.len() as u32).collect();
        sorted.sort_by_key(|&v| weights[v as usize].heaviest());
        let mut pairs = Vec::new();
        let mut slots = vec![[u32::MAX; MAX_INFLUENCES]; weights.len()];
        for segment in 0..segments as u16 {
            let moves = |skin: &SkinWeights| {
                (0..MAX_INFLUENCES).find(|&k| skin.weights[k] > 0.0 && skin.segments[k] == segment)
            };
            let members: Vec<(u32, usize)> =
                (0..weights.len()).filter_map(|v| Some((v as u32, moves(&weights[v])?))).collect();
            for (i, &(v, k)) in members.iter().enumerate() {
                slots[v as usize][k] = ((pairs.len() + i / LANES) * LANES + i % LANES) as u32;
            }
            let members: Vec<u32> = members.into_iter().map(|(v, _)| v).collect();
            pairs.extend(batches(&members).map(|vertices| PairBatch { segment, vertices }));
        }
        Self { vertices: batches(&sorted).collect(), pairs, slots }
    }
}

fn batches(members: &[u32]) -> impl Iterator<Item = [u32; LANES]> + '_ {
    members.chunks(LANES).map(|chunk| std::array::from_fn(|i| chunk[i.min(chunk.len() - 1)]))
}
