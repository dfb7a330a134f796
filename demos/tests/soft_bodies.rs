//! The bodies that move by themselves: sound meshes, whole rigs, and files that say the same as the code.

use pliant::procdef::{CHART_SAMPLES, ChartTable, load_motion_rig};
use pliant_demos::modeller::soft::{bar, bowel, heart, jellyfish, rigs, snail, worm};

/// The bodies, how many vertices the paper's table has for them (0: not in it), and how many holes go through them.
fn bodies() -> Vec<(&'static str, pliant_demos::modeller::soft::cells::Cells, usize, i64)> {
    vec![
        ("jellyfish", jellyfish::jellyfish(&jellyfish::LARGE), 854, 0),
        ("small jellyfish", jellyfish::jellyfish(&jellyfish::SMALL), 315, 0),
        ("worm", worm::worm(&worm::LONG), 470, 0),
        ("short worm", worm::worm(&worm::SHORT), 73, 0),
        ("heart", heart::heart(heart::COARSE), 1302, 0),
        ("bowel", bowel::bowel(16, 33, 0.0), 1576, 1),
        ("bar", bar::bar(4, 20), 0, 0),
        ("snail", snail::snail(&snail::COARSE), 0, 0),
    ]
}

#[test]
fn bodies_are_sound_and_of_the_size_of_the_papers() {
    for (name, cells, paper, holes) in bodies() {
        let surface = cells.surface();
        assert!(surface.is_closed() && surface.component_count() == 1, "{name}");
        assert_eq!(surface.euler_characteristic(), 2 - 2 * holes, "{name}");
        // No cell is inside out, and the cells overlap nowhere: together they fill just what the surface encloses.
        let mesh = cells.finish().expect(name);
        let enclosed = f64::from(surface.volume());
        assert!((mesh.volume() - enclosed).abs() < 1e-4 * enclosed, "{name}: {} {enclosed}", mesh.volume());
        let count = mesh.vertex_count();
        assert!(paper == 0 || count.abs_diff(paper) * 50 <= paper, "{name}: {count} vertices, {paper} in the paper");
        let [least, most] = mesh.dihedral_angles();
        assert!(least > 1.5 && most < 176.0, "{name}: {least} to {most} degrees");
    }
}

#[test]
fn the_rig_files_say_what_the_code_says_and_can_be_used() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/rigs");
    for (name, rig) in rigs::rigs() {
        let read = load_motion_rig(folder.join(format!("{name}.toml"))).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(read.description, rig, "{name}: run the example `make_soft_bodies`");
        let motion = &read.built.motion;
        let unsure = motion.fields().orientation.confidence.iter().filter(|c| **c < 0.5).count();
        assert!(unsure * 10 <= read.mesh.vertex_count(), "{name}: {unsure} directions are not determined");
        assert!(motion.cyclic().is_some() || motion.response().is_some(), "{name} moves");
        for charts in motion.cyclic().map(|c| &c.charts).into_iter().chain(motion.response().map(|r| &r.charts)) {
            let table = ChartTable::new(charts);
            let sums = (0..CHART_SAMPLES).map(|i| table.at(i as f32 / CHART_SAMPLES as f32).iter().sum::<f32>());
            assert!(sums.fold(0.0, |m: f32, s| m.max(s.abs())) < 1e-6, "{name} keeps its volume");
        }
    }
}
