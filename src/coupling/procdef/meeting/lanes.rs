//! Eight things at once: vectors of lanes.

use wide::f32x8;

use crate::math::Vec3;

/// Things of a pack, and packs of a group.
pub const LANES: usize = 8;

/// The same vector in all lanes.
#[inline]
pub fn splat(x: Vec3) -> [f32x8; 3] {
    x.to_array().map(f32x8::splat)
}

/// One over what is positive, else 0.
#[inline]
pub fn or_none(x: f32x8) -> f32x8 {
    x.simd_gt(f32x8::ZERO).bitselect(f32x8::ONE / x, f32x8::ZERO)
}

/// How far the vertices of eight triangles or edges may go; nothing where `moves` is empty.
pub fn farthest<const N: usize>(things: &[[u32; N]], moves: &[f32]) -> f32x8 {
    let of =
        |thing: &[u32; N]| thing.iter().map(|&v| moves.get(v as usize).copied().unwrap_or(0.0)).fold(0.0, f32::max);
    f32x8::new(std::array::from_fn(|i| of(&things[i])))
}

/// The vector of one lane.
#[inline]
pub fn vector(v: [f32x8; 3], lane: usize) -> Vec3 {
    Vec3::from(v.map(|x| x.to_array()[lane]))
}

/// `a - b`.
#[inline]
pub fn minus(a: [f32x8; 3], b: [f32x8; 3]) -> [f32x8; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// The inner product.
#[inline]
pub fn dot(a: [f32x8; 3], b: [f32x8; 3]) -> f32x8 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
