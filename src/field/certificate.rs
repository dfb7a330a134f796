//! Step counts that guarantee that nothing self-intersects.

/// A field that knows a bound on its Jacobian.
pub trait Lipschitz {
    /// An upper bound of `|∇field|` (spectral norm) over space and time.
    fn lipschitz(&self) -> f32;
}

/// The smallest number of steps, at least `least`, with which a flow over `[0, 1]` is certified to be injective.
///
/// A step `x + h g(x)` is injective where `h · Lip(g) < 1`; the Lipschitz bounds of summed fields add up. With
/// `z = h · Lip(f)` the increment of an Euler step has the bound `z`, that of a midpoint step `z + z²/2` and that of a
/// Runge-Kutta step `z + z²/2 + z³/6 + z⁴/24`: below 1 for `z` up to 1, 0.732 and 0.694. The margin here (`z ≤ 0.69`)
/// covers all three.
pub fn certified_steps(lipschitz_sum: f32, least: u32) -> u32 {
    let needed = (lipschitz_sum / CERTIFIED_STEP).ceil();
    if needed.is_finite() { least.max(needed as u32) } else { u32::MAX }
}

/// Largest `h · Lip` for which one step of every [`super::Integrator`] is injective.
const CERTIFIED_STEP: f32 = 0.69;

/// Steps of the default rule for a sum of fields with this Lipschitz bound: `usual` for strong fields, more where the
/// certificate asks for them, and fewer for weak ones, whose path lines are nearly straight.
///
/// The error of a rule falls with a power of `h · Lip`; with `h · Lip ≤ 0.35` a weak field in few steps is more exact
/// than a strong one in the usual number (`|q − p| = r_o` in six midpoint steps has `h · Lip = 0.51`).
pub fn usual_steps(lipschitz_sum: f32, usual: u32) -> u32 {
    let accurate = (lipschitz_sum / ACCURATE_STEP).ceil().clamp(1.0, 1.0e6) as u32;
    certified_steps(lipschitz_sum, accurate.min(usual))
}

const ACCURATE_STEP: f32 = 0.35;
