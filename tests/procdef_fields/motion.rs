//! Local transformations from fields, charts and stimuli.

use fastrand::Rng;
use pliant::math::{Mat3, Quat, Vec3};
use pliant::mesh::TetrahedralMesh;
use pliant::procdef::{
    ChartInterpolation, CyclicMotion, DeformationCharts, LineChart, MAX_STIMULI, Motion, MotionError, MotionFields,
    MotionRig, OrientationField, StimulusSettings, VolumeMode, excitation_colour, stretch_along,
};

use crate::meshes::bar;

fn charts(cycle: f32, volume: VolumeMode) -> DeformationCharts {
    let points = [[0.0, 1.0], [0.25, 0.6], [0.6, 1.5]];
    let mut charts = DeformationCharts::volume_preserving(cycle, volume, &points, ChartInterpolation::Smooth).unwrap();
    charts.charts[1] = LineChart::through(&[[0.2, 0.8], [0.7, 1.2]], ChartInterpolation::Linear).unwrap();
    charts
}

fn fields(mesh: &TetrahedralMesh, amplitude: f32) -> MotionFields {
    let n = mesh.vertex_count();
    MotionFields {
        orientation: OrientationField::axes(n),
        amplitude: vec![amplitude; n],
        phase: mesh.positions.iter().map(|x| x.x / 3.0).collect(),
    }
}

fn cyclic(volume: VolumeMode) -> Option<CyclicMotion> {
    Some(CyclicMotion { charts: charts(2.0, volume), speed: 0.8, rise: 0.0 })
}

fn transforms(motion: &Motion, rig: &MotionRig) -> Vec<Mat3> {
    let mut all = Vec::new();
    motion.transforms_into(rig, &mut all);
    all
}

#[test]
fn transformations_are_equation_one_with_the_shifted_charts() {
    let mut rng = Rng::with_seed(1);
    let mesh = bar([6, 1, 2], 0.5);
    for volume in [VolumeMode::Free, VolumeMode::Both, VolumeMode::Secondary] {
        let mut fields = fields(&mesh, 1.0);
        for frame in &mut fields.orientation.frames {
            *frame = Mat3::from_quat(Quat::from_xyzw(rng.f32(), rng.f32(), rng.f32(), 1.0).normalize());
        }
        let rig = MotionRig::new(&mesh, fields.clone(), cyclic(volume), None).unwrap();
        for clock in [0.0, 0.7, 123.4] {
            let all = transforms(&Motion::at(clock), &rig);
            assert_eq!(all.len(), mesh.vertex_count());
            for (v, found) in all.iter().enumerate() {
                let phase = (clock - f64::from(fields.phase[v]) / 0.8) / 2.0;
                let expected = stretch_along(&fields.orientation.frames[v], charts(2.0, volume).at(phase as f32));
                let off = (*found - expected).to_cols_array().into_iter().fold(0.0, |m: f32, c| m.max(c.abs()));
                // The table blunts kinks over 1/1024 of the cycle.
                assert!(off < 3e-3, "{found:?} {expected:?}");
            }
        }
    }
}

#[test]
fn amplitudes_of_one_zero_and_minus_one_keep_end_and_invert_the_rates() {
    let mesh = bar([6, 1, 1], 0.5);
    let rig = |amplitude| MotionRig::new(&mesh, fields(&mesh, amplitude), cyclic(VolumeMode::Free), None).unwrap();
    let (plain, none, inverse) = (rig(1.0), rig(0.0), rig(-1.0));
    for step in 0..50 {
        let motion = Motion::at(0.05 * f64::from(step));
        for v in 0..mesh.vertex_count() {
            assert_eq!(motion.rates(&none, v), [1.0; 3]);
            let (c, i) = (motion.rates(&plain, v), motion.rates(&inverse, v));
            assert!((0..3).all(|k| (c[k] * i[k] - 1.0).abs() < 1e-6));
        }
        assert!(transforms(&motion, &none).iter().all(|t| *t == Mat3::IDENTITY));
    }
}

#[test]
fn transformations_keep_the_volume_with_amplitudes_phases_and_stimuli() {
    let mesh = bar([8, 2, 2], 0.4);
    let mut rng = Rng::with_seed(2);
    for volume in [VolumeMode::Both, VolumeMode::Secondary] {
        let mut fields = fields(&mesh, 1.0);
        fields.amplitude.iter_mut().for_each(|a| *a = 2.0 * rng.f32() - 1.0);
        let response = StimulusSettings { charts: charts(0.7, VolumeMode::Both), speed: 2.0, damping: 1.5 };
        let rig = MotionRig::new(&mesh, fields, cyclic(volume), Some(response)).unwrap();
        let mut motion = Motion::default();
        for step in 0..200 {
            if step % 23 == 0 {
                motion.touch(&rig, Vec3::new(3.2 * rng.f32(), 0.4, 0.4));
            }
            motion.advance(&rig, 1.0 / 60.0);
            for v in 0..mesh.vertex_count() {
                let [a, b, c] = motion.rates(&rig, v);
                assert!((a * b * c - 1.0).abs() < 1e-6, "{}", a * b * c - 1.0);
                assert!([a, b, c].iter().all(|r| (0.4999..=2.0001).contains(r)));
            }
            for t in transforms(&motion, &rig) {
                // Rounding of a determinant of entries up to 2.
                assert!((t.determinant() - 1.0).abs() < 3e-6);
            }
        }
    }
}

#[test]
fn a_signal_comes_later_where_the_phase_shift_is_larger_and_backwards_with_a_negative_speed() {
    let mesh = bar([6, 1, 1], 0.5);
    let mut chart = charts(2.0, VolumeMode::Both);
    chart.charts[0] = LineChart::through(&[[0.0, 1.0], [0.05, 0.5], [0.1, 1.0]], ChartInterpolation::Linear).unwrap();
    let strongest = |speed: f32, v: usize| {
        let motion = Some(CyclicMotion { charts: chart.clone(), speed, rise: 0.0 });
        let rig = MotionRig::new(&mesh, fields(&mesh, 1.0), motion, None).unwrap();
        let rate = |step: i32| Motion::at(2.0 + f64::from(step) * 0.01).rates(&rig, v)[0];
        (0..200).min_by(|a, b| rate(*a).total_cmp(&rate(*b))).unwrap()
    };
    for v in 0..mesh.vertex_count() {
        let delay = mesh.positions[v].x / 3.0 / 0.8;
        let wait = |delay: f32| (0.1 + delay).rem_euclid(2.0) / 0.01;
        assert!((strongest(0.8, v) as f32 - wait(delay)).abs() <= 1.0);
        assert!((strongest(-0.8, v) as f32 - wait(-delay)).abs() <= 1.0);
    }
}

#[test]
fn a_stimulus_arrives_after_distance_over_speed_with_its_damped_amplitude_and_passes_once() {
    let mesh = bar([12, 2, 2], 0.25);
    let mut pulse = DeformationCharts { cycle: 0.5, ..DeformationCharts::default() };
    pulse.charts[0] = LineChart::through(&[[0.0, 1.0], [0.5, 0.5]], ChartInterpolation::Linear).unwrap();
    let (speed, damping, dt) = (0.7, 3.0, 1.0 / 120.0);
    let response = StimulusSettings { charts: pulse, speed, damping };
    let rig = MotionRig::new(&mesh, fields(&mesh, 1.0), None, Some(response)).unwrap();
    let mut motion = Motion::default();
    let touched = Vec3::new(0.0, 0.25, 0.25);
    assert!(motion.touch(&rig, touched));
    let told: Vec<(f32, f32)> =
        (0..mesh.vertex_count()).map(|v| motion.stimuli()[0].arrival(v).expect("a vertex")).collect();
    let n = mesh.vertex_count();
    let (mut first, mut strongest, mut last) = (vec![0; n], vec![1.0f32; n], vec![0; n]);
    let mut steps = 0;
    while !motion.stimuli().is_empty() {
        steps += 1;
        motion.advance(&rig, dt);
        for v in 0..n {
            let rate = motion.rates(&rig, v)[0];
            if rate < 1.0 {
                first[v] = if first[v] == 0 { steps } else { first[v] };
                last[v] = steps;
                strongest[v] = strongest[v].min(rate);
            }
        }
    }
    for (v, x) in mesh.positions.iter().enumerate() {
        let d = x.distance(touched) / rig.length();
        let arrival = d / speed / dt;
        // Distances are exact to 2e-3, which is a third of a step at the far end.
        let (delay, amplitude) = told[v];
        assert!((delay / dt - arrival).abs() < 2e-3 * arrival + 1e-3, "{v}: {delay} {arrival}");
        assert!((amplitude - damping.powf(-d)).abs() < 3e-3, "{v}: {amplitude} {d}");
        assert!((0.0..=1.001).contains(&(first[v] as f32 - delay / dt)), "{v}: {} {delay}", first[v]);
        assert!((last[v] as f32 - arrival - 0.5 / dt).abs() <= 1.5, "{v}: {} {arrival}", last[v]);
        // The peak lies between two steps, each 1/60 of the cycle: at most 1/60 of the way below it.
        let amplitude = strongest[v].ln() / 0.5f32.ln();
        let expected = damping.powf(-d);
        assert!((amplitude - expected).abs() < 0.04 * expected, "{v}: {amplitude} {expected}");
    }
    assert!(transforms(&motion, &rig).iter().all(|t| *t == Mat3::IDENTITY));
}

#[test]
fn stimuli_add_up_in_any_order() {
    let mesh = bar([12, 2, 2], 0.25);
    let response = StimulusSettings { charts: charts(0.8, VolumeMode::Both), ..StimulusSettings::default() };
    let rig = MotionRig::new(&mesh, fields(&mesh, 1.0), None, Some(response)).unwrap();
    let places = [Vec3::new(0.0, 0.2, 0.2), Vec3::new(3.0, 0.2, 0.2)];
    let run = |order: &[usize]| {
        let mut motion = Motion::default();
        order.iter().for_each(|&k| assert!(motion.touch(&rig, places[k])));
        motion.advance(&rig, 0.9);
        (0..mesh.vertex_count()).map(|v| motion.rates(&rig, v)[0]).collect::<Vec<f32>>()
    };
    let (one, two, both, turned) = (run(&[0]), run(&[1]), run(&[0, 1]), run(&[1, 0]));
    let limit = 2.0f32;
    let mut together = 0;
    for v in 0..one.len() {
        let product = (one[v] * two[v]).clamp(1.0 / limit, limit);
        assert!((both[v] - product).abs() < 1e-5);
        assert!((both[v] - turned[v]).abs() < 1e-6);
        together += usize::from(one[v] != 1.0 && two[v] != 1.0);
    }
    assert!(together > 0, "the signals meet somewhere");
}

#[test]
fn a_seventeenth_stimulus_takes_the_place_of_the_oldest() {
    let mesh = bar([6, 1, 1], 0.5);
    let rig = MotionRig::new(&mesh, fields(&mesh, 1.0), None, Some(StimulusSettings::default())).unwrap();
    let mut motion = Motion::default();
    for touch in 0..20 {
        assert!(motion.touch(&rig, Vec3::X * 0.1 * touch as f32));
        motion.advance(&rig, 0.01);
    }
    assert_eq!(motion.stimuli().len(), MAX_STIMULI);
    assert!((motion.stimuli()[0].elapsed - 0.16).abs() < 1e-6, "{}", motion.stimuli()[0].elapsed);
    assert!(!motion.touch(&rig, Vec3::NAN));
}

#[test]
fn charts_at_one_leave_the_body_as_it_is() {
    let mesh = bar([6, 1, 1], 0.5);
    let mut rng = Rng::with_seed(5);
    for volume in [VolumeMode::Free, VolumeMode::Both, VolumeMode::Secondary] {
        let ones = DeformationCharts { volume, ..DeformationCharts::default() };
        let mut fields = fields(&mesh, 1.0);
        fields.amplitude.iter_mut().for_each(|a| *a = 2.0 * rng.f32() - 1.0);
        let cycle = CyclicMotion { charts: ones.clone(), speed: 0.8, rise: 0.0 };
        let response = StimulusSettings { charts: ones, ..StimulusSettings::default() };
        let rig = MotionRig::new(&mesh, fields, Some(cycle), Some(response)).unwrap();
        let mut motion = Motion::at(0.7);
        assert!(motion.touch(&rig, Vec3::ZERO));
        motion.advance(&rig, 0.3);
        assert!(transforms(&motion, &rig).iter().all(|t| *t == Mat3::IDENTITY), "{volume:?}");
    }
}

#[test]
fn strength_and_pace_stop_the_cycle() {
    let mesh = bar([4, 1, 1], 0.5);
    let rig = MotionRig::new(&mesh, fields(&mesh, 1.0), cyclic(VolumeMode::Both), None).unwrap();
    let mut motion = Motion::at(0.3);
    motion.pace = 0.0;
    let before = transforms(&motion, &rig);
    motion.advance(&rig, 1.0);
    assert_eq!(transforms(&motion, &rig), before);
    motion.pace = f32::NAN;
    motion.advance(&rig, f32::NAN);
    assert_eq!(transforms(&motion, &rig), before);
    motion.strength = 0.0;
    assert!(transforms(&motion, &rig).iter().all(|t| *t == Mat3::IDENTITY));
    assert!(!motion.touch(&rig, Vec3::ZERO), "it answers no stimuli");
}

#[test]
fn a_rising_cycle_grows_from_rest_to_all_of_its_strength_and_keeps_the_volume() {
    let mesh = bar([6, 1, 1], 0.5);
    let cycle = CyclicMotion { rise: 0.5, ..cyclic(VolumeMode::Secondary).unwrap() };
    let rig = MotionRig::new(&mesh, fields(&mesh, 1.0), Some(cycle), None).unwrap();
    let mut motion = Motion::rising(0.3, &rig);
    assert!(transforms(&motion, &rig).iter().all(|t| *t == Mat3::IDENTITY), "it begins at rest");
    let mut before = vec![[0.0f32; 3]; mesh.vertex_count()];
    for step in 1..=60 {
        motion.advance(&rig, 1.0 / 60.0);
        let whole = Motion::at(motion.clock);
        let u = (f64::from(step) / 30.0).min(1.0);
        let share = (u * u * (3.0 - 2.0 * u)) as f32;
        for (v, before) in before.iter_mut().enumerate() {
            let (rates, all) = (motion.rates(&rig, v), whole.rates(&rig, v));
            assert!((0..3).all(|k| (rates[k].ln() - share * all[k].ln()).abs() < 1e-5), "{step}: {rates:?} {all:?}");
            assert!((rates[0] * rates[1] * rates[2] - 1.0).abs() < 1e-6);
            // At once it would jump by up to 0.69, the logarithm of 2.
            assert!((rates[0].ln() - before[0]).abs() < 0.08, "{step}: {rates:?}");
            *before = rates.map(f32::ln);
        }
    }
    // It is no part of the pace, and what is set by hand counts.
    motion.rise = 0.0;
    assert_eq!(motion.rates(&rig, 3), Motion::at(motion.clock).rates(&rig, 3));
    let mut stopped = Motion::rising(0.3, &rig);
    stopped.pace = 0.0;
    stopped.advance(&rig, 0.5);
    assert_eq!(stopped.rates(&rig, 3), Motion::at(0.3).rates(&rig, 3));
}

#[test]
fn excitation_is_minus_one_at_full_contraction_and_is_drawn_red() {
    let mesh = bar([4, 1, 1], 0.5);
    let mut cycle = cyclic(VolumeMode::Both).unwrap();
    cycle.charts.charts[0] = LineChart::constant(0.5);
    let rig = MotionRig::new(&mesh, fields(&mesh, 1.0), Some(cycle), None).unwrap();
    let mut all = Vec::new();
    Motion::at(0.2).excitations_into(&rig, &mut all);
    assert!(all.len() == mesh.vertex_count() && all.iter().all(|e| (*e + 1.0).abs() < 1e-5));
    let [red, green, blue] = excitation_colour(-1.0, [0.5; 3]);
    assert!(red > 3.0 * green && red > 3.0 * blue);
    let [red, green, blue] = excitation_colour(1.0, [0.5; 3]);
    assert!(blue > green && green > red);
    assert_eq!(excitation_colour(0.0, [0.3, 0.4, 0.5]), [0.3, 0.4, 0.5]);
}

#[test]
fn fields_of_another_mesh_are_refused() {
    let mesh = bar([4, 1, 1], 0.5);
    let refused = |change: fn(&mut MotionFields)| {
        let mut fields = fields(&mesh, 1.0);
        change(&mut fields);
        MotionRig::new(&mesh, fields, None, None).unwrap_err()
    };
    let expected = mesh.vertex_count();
    let short = refused(|f| f.phase.truncate(9));
    assert_eq!(short, MotionError::Length { field: "phase", given: 9, expected });
    assert_eq!(refused(|f| f.amplitude[3] = f32::NAN), MotionError::NotFinite { field: "amplitude", vertex: 3 });
    let still = CyclicMotion { speed: 0.0, ..cyclic(VolumeMode::Both).unwrap() };
    let error = MotionRig::new(&mesh, fields(&mesh, 1.0), Some(still), None).unwrap_err();
    assert_eq!(error, MotionError::Speed(0.0));
    let backwards = CyclicMotion { rise: -1.0, ..cyclic(VolumeMode::Both).unwrap() };
    let error = MotionRig::new(&mesh, fields(&mesh, 1.0), Some(backwards), None).unwrap_err();
    assert_eq!(error, MotionError::Rise(-1.0));
}
