//! Step counts that guarantee that nothing self-intersects.

/// A field that knows a bound on its Jacobian.
pub trait Lipschitz {
    /// An upper bound of `|∇field|` (spectral norm) over space and time.
    fn lipschitz(&self) -> f32;
}

/// The smallest number of steps, at least `least`, with which a flow over `[0, 1]` is certified to be injective.
///
/// One explicit step `x + h f(x)` is injective where `h · Lip(f) < 1`; the Lipschitz bounds of summed fields add up.
/// A midpoint step evaluates at a half step, and is injective where `h L (1 + h L / 2) < 1`, that is `h L < 0.73`;
/// the margin here (`h L ≤ 0.7`) covers both.
pub fn certified_steps(lipschitz_sum: f32, least: u32) -> u32 {
    let needed = (lipschitz_sum / CERTIFIED_STEP).ceil();
    if needed.is_finite() { least.max(needed.min(1.0e6) as u32) } else { u32::MAX }
}

/// Largest `h · Lip` for which one midpoint (or Euler) step is taken as injective.
const CERTIFIED_STEP: f32 = 0.7;
