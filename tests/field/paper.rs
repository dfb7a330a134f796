//! The fields against the paper's own formulas, written out literally.

use fastrand::Rng;
use pliant::field::{SphereField, SpringField};
use pliant::math::Vec3;

use crate::random::{between, direction, in_cube};

/// `v` of equation (14) with `w` of equations (8) and (9).
fn paper_v(p: Vec3, q: Vec3, r_o: f32, x: Vec3, t: f32) -> Vec3 {
    let a = q - p;
    let m = (1.0 - t) * p + t * q;
    let b = x - m;
    if b.dot(b) > r_o * r_o {
        return Vec3::ZERO;
    }
    let alpha = r_o * r_o - 5.0 * b.dot(b);
    let beta = 4.0 * a.dot(b);
    let gamma = (r_o * r_o - b.dot(b)).powi(3) / (r_o * r_o).powi(4);
    gamma * (alpha * a + beta * b)
}

#[test]
fn the_spring_field_is_the_papers_w() {
    let mut rng = Rng::with_seed(3);
    for _ in 0..5000 {
        let p = in_cube(&mut rng, 1.0);
        let field = SpringField { p, q: p + in_cube(&mut rng, 1.0), radius: between(&mut rng, 0.3, 2.0) };
        let (x, t) = (p + in_cube(&mut rng, 2.0), rng.f32());
        let expected = paper_v(field.p, field.q, field.radius, x, t);
        let scale = (field.q - field.p).length();
        assert!((field.velocity(x, t) - expected).length() < 2e-5 * scale, "{field:?} at {x}, {t}");
    }
}

/// Gradients of `p = (1 − b) e` and `q = (1 − b) f` of section 4.1 with the blending function of equation (2), in f64.
fn grad_p_cross_grad_q(field: &SphereField, x: Vec3, t: f32) -> Vec3 {
    let centre = (field.centre + field.d * t).as_dvec3();
    let (e_axis, f_axis) = field.d.normalize().as_dvec3().any_orthonormal_pair();
    let (e_axis, f_axis) =
        if e_axis.cross(f_axis).dot(field.d.as_dvec3()) > 0.0 { (e_axis, f_axis) } else { (f_axis, e_axis) };
    let blend = |x: glam::DVec3| {
        let y =
            (((x - centre).length() - f64::from(field.inner)) / f64::from(field.outer - field.inner)).clamp(0.0, 1.0);
        // Bernstein polynomials of degree four with the weights 0 0 0 1 1.
        4.0 * y.powi(3) * (1.0 - y) + y.powi(4)
    };
    let p = |x: glam::DVec3| (1.0 - blend(x)) * (x - centre).dot(e_axis);
    let q = |x: glam::DVec3| (1.0 - blend(x)) * (x - centre).dot(f_axis);
    let x = x.as_dvec3();
    let h = 1e-5;
    let gradient = |f: &dyn Fn(glam::DVec3) -> f64| {
        let slope = |axis: glam::DVec3| (f(x + axis * h) - f(x - axis * h)) / (2.0 * h);
        glam::DVec3::new(slope(glam::DVec3::X), slope(glam::DVec3::Y), slope(glam::DVec3::Z))
    };
    (gradient(&p).cross(gradient(&q)) * f64::from(field.d.length())).as_vec3()
}

#[test]
fn the_sphere_field_is_the_length_of_d_times_grad_p_cross_grad_q() {
    let mut rng = Rng::with_seed(4);
    for _ in 0..5000 {
        let inner = between(&mut rng, 0.0, 0.8);
        let field = SphereField {
            centre: in_cube(&mut rng, 1.0),
            d: direction(&mut rng) * between(&mut rng, 0.05, 1.0),
            inner,
            outer: inner + between(&mut rng, 0.3, 1.5),
        };
        let t = rng.f32();
        let x = field.centre + in_cube(&mut rng, field.outer);
        let expected = grad_p_cross_grad_q(&field, x, t);
        let largest = field.d.length() * field.outer / (field.outer - field.inner);
        assert!((field.velocity(x, t) - expected).length() < 2e-5 * largest, "{field:?} at {x}, {t}: {expected}");
    }
}

#[test]
fn the_sphere_field_is_constant_inside_and_zero_outside() {
    let mut rng = Rng::with_seed(5);
    let field = SphereField { centre: Vec3::X, d: Vec3::new(0.1, 0.3, -0.2), inner: 0.5, outer: 1.2 };
    for _ in 0..500 {
        let (t, u) = (rng.f32(), direction(&mut rng));
        let centre = field.centre + field.d * t;
        let inside = field.velocity(centre + u * between(&mut rng, 0.0, 0.499), t);
        assert!((inside - field.d).length() < 1e-6, "{inside}");
        assert_eq!(field.velocity(centre + u * between(&mut rng, 1.201, 3.0), t), Vec3::ZERO);
    }
}
