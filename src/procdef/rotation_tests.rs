use super::*;
use fastrand::Rng;

fn between(rng: &mut Rng, low: f32, high: f32) -> f32 {
    low + (high - low) * rng.f32()
}

fn rotation(rng: &mut Rng) -> Quat {
    Quat::from_xyzw(between(rng, -1.0, 1.0), between(rng, -1.0, 1.0), between(rng, -1.0, 1.0), between(rng, -1.0, 1.0))
        .normalize()
}

/// `U diag(s) Vᵀ` and the rotation that is nearest to it: `U Vᵀ`, for `s` descending by size, only the last one negative.
fn sample(rng: &mut Rng, s: [f32; 3]) -> (Mat3, Mat3) {
    let (u, v) = (Mat3::from_quat(rotation(rng)), Mat3::from_quat(rotation(rng)));
    (u * Mat3::from_diagonal(Vec3::from(s)) * v.transpose(), u * v.transpose())
}

fn largest_difference(a: Mat3, b: Mat3) -> f32 {
    (0..3).map(|c| (a.col(c) - b.col(c)).abs().max_element()).fold(0.0, f32::max)
}

fn wide_of(a: &[Mat3; LANES]) -> WideMat3 {
    std::array::from_fn(|i| std::array::from_fn(|j| f32x8::new(a.map(|a| a.col(j)[i]))))
}

#[test]
fn stretched_flat_and_inverted_matrices_have_the_rotation_of_their_singular_vectors() {
    let mut rng = Rng::with_seed(3);
    for s in [[1.0, 1.0, 1.0], [1.0, 0.5, 0.2], [1.0, 0.6, 0.0], [1.0, 0.6, -0.3], [1.0, 0.02, 0.01], [1.0, 0.9, -0.5]]
    {
        for _ in 0..100 {
            let (a, expected) = sample(&mut rng, s);
            // The gap between the best rotation and the next best is at least 0.03: rounding of 32 bits divided by it.
            let found = Mat3::from_quat(nearest_rotation(a, rotation(&mut rng)));
            assert!(largest_difference(found, expected) < 2e-5, "{s:?}: {found} {expected}");
            assert!((found.determinant() - 1.0).abs() < 1e-5);
        }
    }
}

#[test]
fn eight_at_once_find_what_one_alone_finds_from_near_and_from_far() {
    let mut rng = Rng::with_seed(4);
    for s in [[1.0, 0.9, 0.8], [1.0, 0.5, 0.2], [1.0, 0.6, 0.0], [1.0, 0.6, -0.3], [0.3, 0.1, 0.05]] {
        for far in [0.02, 0.3, 3.0] {
            let samples: [(Mat3, Mat3); LANES] = std::array::from_fn(|_| sample(&mut rng, s));
            let mut previous = WideQuat::IDENTITY;
            for (lane, (_, r)) in samples.iter().enumerate() {
                let axis = rotation(&mut rng) * Vec3::X;
                previous.set_lane(lane, Quat::from_axis_angle(axis, far) * Quat::from_mat3(r));
            }
            let found = nearest_rotations(&wide_of(&samples.map(|s| s.0)), previous);
            for (lane, (_, expected)) in samples.iter().enumerate() {
                let found = Mat3::from_quat(found.lane(lane));
                assert!(largest_difference(found, *expected) < 2e-5, "{s:?} {far}: {found} {expected}");
            }
        }
    }
}

#[test]
fn a_line_is_turned_onto_its_image_the_shortest_way_and_a_point_not_at_all() {
    let mut rng = Rng::with_seed(5);
    for _ in 0..100 {
        let before = rotation(&mut rng);
        assert_eq!(nearest_rotation(Mat3::ZERO, before), before);
        assert_eq!(nearest_rotation(Mat3::NAN, before), before);
        // A line along x that was turned by `before` and now points a little elsewhere.
        let small = Quat::from_axis_angle(before * Vec3::Y, 0.1);
        let image = small * before * Vec3::X;
        let line = Mat3::from_cols(image, Vec3::ZERO, Vec3::ZERO);
        let found = nearest_rotation(line, before);
        // Half the distance in a f32 quaternion's last digits, through acos near 1.
        assert!(found.angle_between(small * before) < 2e-3);
    }
}

#[test]
fn matrices_of_any_scale_give_the_same_rotation() {
    let mut rng = Rng::with_seed(6);
    let (a, expected) = sample(&mut rng, [1.0, 0.7, 0.4]);
    for scale in [1e-30, 1e-6, 1.0, 1e20] {
        let found = Mat3::from_quat(nearest_rotation(a * scale, Quat::IDENTITY));
        assert!(largest_difference(found, expected) < 2e-5, "{scale}");
    }
}
