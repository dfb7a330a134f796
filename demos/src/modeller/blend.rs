//! Smooth versions of union and difference: where two surfaces are nearer to each other than
//! `reach` they flow into one another, elsewhere nothing changes.

/// Smooth union: the minimum, rounded by a quadratic fillet.
pub fn unite(a: f32, b: f32, reach: f32) -> f32 {
    let overlap = (reach - (a - b).abs()).max(0.0) / reach;
    a.min(b) - overlap * overlap * reach * 0.25
}

/// Smooth intersection: the maximum, rounded likewise.
pub fn intersect(a: f32, b: f32, reach: f32) -> f32 {
    -unite(-a, -b, reach)
}

/// Smooth difference: `body` without `tool`.
pub fn carve(body: f32, tool: f32, reach: f32) -> f32 {
    intersect(body, -tool, reach)
}

/// Exponential union of many surfaces, which does not depend on their order.
pub fn unite_all(distances: &[f32], reach: f32) -> f32 {
    let nearest = distances.iter().copied().fold(f32::INFINITY, f32::min);
    let sum: f32 = distances.iter().map(|d| ((nearest - d) / reach).exp()).sum();
    nearest - reach * sum.ln()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn far_surfaces_unite_without_a_fillet() {
        assert_eq!(unite(0.1, 0.9, 0.2), 0.1);
        assert_eq!(carve(-0.1, 0.9, 0.2), -0.1);
    }

    #[test]
    fn near_surfaces_flow_together() {
        assert!(unite(0.1, 0.1, 0.2) < 0.1);
        assert!(unite_all(&[0.1, 0.1, 0.1], 0.05) < 0.1);
    }

    #[test]
    fn the_exponential_union_forgets_the_order() {
        let one = unite_all(&[0.1, 0.2, 0.15], 0.05);
        let other = unite_all(&[0.15, 0.1, 0.2], 0.05);
        assert!((one - other).abs() < 1e-6);
    }
}
