//! How a cycle begins: smoothly from rest, where it would else jump into its middle.

/// The part of its strength, from 0 to 1, that a cycle has `age` seconds after its body was made: `3u² - 2u³` with
/// `u = age / rise`. All of it where `rise` is no time above 0.
pub(super) fn risen(age: f64, rise: f32) -> f32 {
    if !(rise > 0.0 && rise.is_finite()) {
        return 1.0;
    }
    let u = (age / f64::from(rise)).clamp(0.0, 1.0);
    (u * u * (3.0 - 2.0 * u)) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rise_goes_from_nothing_to_all_without_a_kink_and_is_none_without_a_time() {
        assert_eq!([0.0, 0.25, 0.5, 7.0].map(|age| risen(age, 0.5)), [0.0, 0.5, 1.0, 1.0]);
        let slope = |age: f64| (risen(age + 1e-3, 0.5) - risen(age - 1e-3, 0.5)) / 2e-3;
        assert!(slope(1e-3) < 0.03 && slope(0.499) < 0.03 && slope(0.25) > 2.9);
        assert!([0.0, -1.0, f32::NAN, f32::INFINITY].iter().all(|rise| risen(0.0, *rise) == 1.0));
    }
}
