//! The number of threads changes nothing: not a bit of any vertex in any step.

use pliant_demos::scene::{find_scene, load_scene};
use pliant_demos::simulation::Simulation;

/// The bits of all vertices after each step, as one number a step.
pub fn fingerprints(scene: &str, threads: usize, steps: u64) -> Vec<u64> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    pool.install(|| {
        let scene = load_scene(find_scene(scene).expect("a scene")).expect("a scene");
        let mut simulation = Simulation::new(scene, 0).expect("a scene that can be built");
        // Nothing depends on the measurements.
        simulation.deformation.settings.measure = false;
        let mut prints = Vec::new();
        for _ in 0..steps {
            simulation.step();
            let skins = simulation.actors.iter().filter_map(|actor| simulation.deformation.get(actor.handle));
            let bodies = simulation.soft_actors.iter().filter_map(|actor| simulation.creatures.get(actor.handle));
            let skins = skins.flat_map(|body| body.positions());
            let words = skins.chain(bodies.flat_map(|body| body.positions()));
            let words = words.flat_map(|x| x.to_array()).map(f32::to_bits);
            prints.push(
                words.fold(0xCBF2_9CE4_8422_2325, |hash, word| (hash ^ u64::from(word)).wrapping_mul(0x0100_0000_01B3)),
            );
        }
        prints
    })
}
