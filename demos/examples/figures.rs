//! scratch
use pliant_demos::scene::{find_scene, load_scene};
use pliant_demos::simulation::Simulation;
fn main() -> anyhow::Result<()> {
    let name = std::env::args().nth(1).unwrap_or_else(|| "tower".into());
    let seed = std::env::args().nth(2).map_or(0, |s| s.parse().unwrap());
    let scene = load_scene(find_scene(&name)?)?;
    let mut sim = Simulation::new(scene, seed)?;
    let mut sum = [0.0f32; 5];
    for f in 0..sim.frames() {
        if std::env::var("DBG").is_ok() { eprintln!("frame {f}"); }
        sim.step();
        let t = sim.times();
        for (s, v) in sum.iter_mut().zip([sim.rigid_ms, t.springs, t.contact, t.deform, t.measure]) {
            *s += v;
        }
        for a in &sim.actors.clone() {
            let r = sim.report(a);
            let p = r.penetration;
            let rag = sim.deformation.ragdoll(a.handle).unwrap();
            let y = sim.physics.bodies[rag.bodies[0]].translation();
            let v: f32 = rag.bodies.iter().map(|b| sim.physics.bodies[*b].linvel().length()).fold(0.0, f32::max);
            println!(
                "{f} {} y {:.2} {:.2} {:.2} v {v:.2} vol {:.4} before {:.4} after {:.5} gap {:.4} in {} passes {} steps {} contact {:.2} {:?}",
                a.name, y.x, y.y, y.z, r.volume_ratio, p.max_depth_before, p.max_depth_after, p.max_gap, p.vertices_inside, r.passes, r.steps, t.contact, r.frozen
            );
        }
    }
    println!("mean ms rigid springs contact deform measure {:?}", sum.map(|s| s / sim.frames() as f32));
    Ok(())
}
