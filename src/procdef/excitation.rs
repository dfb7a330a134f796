//! The excitation of a vertex as one number, and as the colour in which it is drawn.

/// The excitation of a vertex from the logarithm of its primary rate and `ln A`: -1 is full contraction, 1 full expansion.
pub fn excitation(log_rate: f32, bound: f32) -> f32 {
    if bound > 0.0 { (log_rate / bound).clamp(-1.0, 1.0) } else { 0.0 }
}

/// The colour of an excitation over a base colour, linear RGB in [0, 1]: red for contraction, light blue for expansion
/// (figure 5 and later).
pub fn excitation_colour(excitation: f32, base: [f32; 3]) -> [f32; 3] {
    const CONTRACTED: [f32; 3] = [0.85, 0.03, 0.02];
    const EXPANDED: [f32; 3] = [0.25, 0.75, 0.95];
    let end = if excitation < 0.0 { CONTRACTED } else { EXPANDED };
    let share = excitation.abs().min(1.0);
    std::array::from_fn(|k| base[k] + share * (end[k] - base[k]))
}
