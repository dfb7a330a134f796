//! Deformation charts.

use fastrand::Rng;
use pliant::procdef::{
    ChartError, ChartInterpolation, ChartTable, ChartsError, DeformationCharts, LineChart, VolumeMode,
};

const BOTH_WAYS: [ChartInterpolation; 2] = [ChartInterpolation::Linear, ChartInterpolation::Smooth];

/// A chart of random control points with rates in [0.5, 2].
fn random(rng: &mut Rng, interpolation: ChartInterpolation) -> LineChart {
    let mut chart = LineChart::constant(1.0);
    chart.interpolation = interpolation;
    for _ in 0..rng.usize(0..7) {
        chart.add(rng.f32(), 0.5 + 1.5 * rng.f32()).unwrap();
    }
    chart
}

#[test]
fn charts_are_periodic_pass_through_their_points_and_stay_in_their_range() {
    let mut rng = Rng::with_seed(1);
    for round in 0..200 {
        let chart = random(&mut rng, BOTH_WAYS[round % 2]);
        let rates = chart.points().iter().map(|p| p.rate);
        let (low, high) = rates.fold((f32::INFINITY, 0.0f32), |(l, h), r| (l.min(r), h.max(r)));
        for point in chart.points() {
            assert!((chart.rate(point.phase) - point.rate).abs() < 1e-4);
        }
        for i in 0..500 {
            let phase = i as f32 / 500.0;
            let rate = chart.rate(phase);
            assert!((low..=high).contains(&rate), "{rate} in {low}..{high}");
            // Phases near 3 have an eighth of the digits, and slopes go up to 1.5 / 1e-4.
            let steepest = chart.points().windows(2).map(|w| 1.5 / (w[1].phase - w[0].phase)).fold(10.0, f32::max);
            assert!((chart.rate(phase + 3.0) - rate).abs() < 1e-6 * steepest + 1e-4);
        }
    }
}

#[test]
fn charts_are_continuous_over_the_seam_and_smooth_ones_have_no_kink() {
    let points = [[0.1, 1.0], [0.3, 0.5], [0.35, 1.8], [0.9, 1.2]];
    for interpolation in BOTH_WAYS {
        let chart = LineChart::through(&points, interpolation).unwrap();
        let h = 1e-4;
        let mut worst = 0.0f32;
        for i in 0..10_000 {
            let phase = i as f32 * h;
            worst = worst.max((chart.rate(phase + h) - chart.rate(phase)).abs());
        }
        // The steepest line rises 1.3 in 0.05; a monotone cubic at most three times that.
        assert!(worst < 3.0 * 26.0 * h, "{interpolation:?}: {worst}");
    }
    let smooth = LineChart::through(&points, ChartInterpolation::Smooth).unwrap();
    for point in smooth.points() {
        let h = 2e-3;
        let [a, b, c] = [-h, 0.0, h].map(|d| smooth.rate(point.phase + d));
        // Slopes beside the point differ by the curvature of a cubic over 0.05 times the step; a kink would be 26 to 36.
        assert!(((c - b) / h - (b - a) / h).abs() < 10.0, "{point:?}");
    }
}

#[test]
fn one_control_point_is_a_constant_and_two_meet_both_ways() {
    for interpolation in BOTH_WAYS {
        let one = LineChart::through(&[[0.4, 0.7]], interpolation).unwrap();
        assert!([0.0, 0.4, 0.9, -5.3].iter().all(|&p| one.rate(p) == 0.7));
        let two = LineChart::through(&[[0.0, 1.0], [0.5, 2.0]], interpolation).unwrap();
        assert!((two.rate(0.25) - 1.5).abs() < 1e-6 && (two.rate(0.75) - 1.5).abs() < 1e-6);
    }
}

#[test]
fn control_points_are_added_dragged_and_removed() {
    let mut chart = LineChart::default();
    assert_eq!(chart.add(0.5, 1.5), Ok(1));
    assert_eq!(chart.add(0.25, 0.8), Ok(1));
    assert_eq!(chart.add(1.25, 0.9), Ok(1));
    assert_eq!(chart.points().len(), 3);
    assert_eq!(chart.points()[1].rate, 0.9);
    // A dragged point stays between its neighbours and in the range.
    let moved = chart.drag(1, 0.9, 9.0, 0.5..=2.0).unwrap();
    assert!(moved.phase < 0.5 && moved.phase > 0.49 && moved.rate == 2.0);
    assert_eq!(chart.remove(5), Err(ChartError::NoPoint { point: 5, count: 3 }));
    chart.remove(0).unwrap();
    chart.remove(0).unwrap();
    assert_eq!(chart.remove(0), Err(ChartError::Empty));
}

#[test]
fn the_product_of_the_rates_is_one_in_both_volume_modes() {
    let mut rng = Rng::with_seed(2);
    for round in 0..100 {
        for volume in [VolumeMode::Both, VolumeMode::Secondary] {
            let interpolation = BOTH_WAYS[round % 2];
            let charts = std::array::from_fn(|_| random(&mut rng, interpolation));
            let charts = DeformationCharts { cycle: 1.3, limit: 2.0, volume, charts };
            charts.check().unwrap();
            let table = ChartTable::new(&charts);
            for _ in 0..100 {
                let phase = 4.0 * rng.f32() - 2.0;
                let product = |c: [f32; 3]| (c[0] * c[1] * c[2] - 1.0).abs();
                assert!(product(charts.at(phase)) < 1e-6);
                assert!(product(table.at(phase).map(f32::exp)) < 1e-6);
                let [first, second, third] = charts.at(phase);
                match volume {
                    VolumeMode::Both => assert!((second - third).abs() < 1e-6),
                    _ => assert!((second * first - 1.0).abs() < 1e-6 && third == 1.0),
                }
            }
        }
    }
}

#[test]
fn the_table_is_the_charts() {
    let mut rng = Rng::with_seed(3);
    for round in 0..20 {
        let charts = std::array::from_fn(|_| {
            LineChart::through(&[[0.05, 1.0], [0.3, 0.6], [0.6, 1.7]], BOTH_WAYS[round % 2]).unwrap()
        });
        let charts = DeformationCharts { cycle: 1.0, limit: 2.0, volume: VolumeMode::Free, charts };
        let table = ChartTable::new(&charts);
        for _ in 0..200 {
            let phase = rng.f32();
            let (exact, sampled) = (charts.logarithms(phase), table.at(phase));
            // A kink of slope 4 to either side is blunted by a quarter of a sample, 1/1024.
            assert!((0..3).all(|k| (exact[k] - sampled[k]).abs() < 3e-3), "{exact:?} {sampled:?}");
        }
    }
}

#[test]
fn wrong_charts_are_told_with_chart_and_point() {
    let through = |points: &[[f32; 2]]| LineChart::through(points, ChartInterpolation::Linear).unwrap_err();
    assert_eq!(through(&[]), ChartError::Empty);
    assert_eq!(through(&[[0.0, 1.0], [1.0, 1.0]]), ChartError::Phase { point: 1, phase: 1.0 });
    assert_eq!(through(&[[0.0, 0.0]]), ChartError::Rate { point: 0, rate: 0.0 });
    assert_eq!(through(&[[0.5, 1.0], [0.5, 2.0]]), ChartError::Order { point: 1, phase: 0.5 });
    let mut charts = DeformationCharts::default();
    charts.charts[1].add(0.5, 2.5).unwrap();
    let outside = ChartsError::OutOfLimits { chart: "secondary", point: 1, rate: 2.5, limit: 2.0 };
    assert_eq!(charts.check(), Err(outside));
    assert_eq!(DeformationCharts { cycle: 0.0, ..charts.clone() }.check(), Err(ChartsError::Cycle(0.0)));
    assert_eq!(DeformationCharts { limit: 1.0, ..charts }.check(), Err(ChartsError::Limit(1.0)));
}
