//! The heart beats: its left ventricle empties and its apex turns.

#[path = "../common/ventricle.rs"]
mod ventricle;

use crate::scene::{Scene, model};
use pliant::math::Vec3;

#[test]
fn the_left_ventricle_loses_a_third_of_its_volume_and_the_apex_turns() {
    let kind = model("heart");
    let heart = ventricle::Heart::of(&kind.boundary, &kind.rig.mesh().positions);
    let at_rest = heart.volume_at_rest();
    assert!(at_rest > 0.01, "the cavity is one: {at_rest} m³");
    let mut scene = Scene::new(0.0, 2);
    let handle = scene.insert(&kind, Vec3::ZERO);
    let (mut least, mut most, mut twist) = (f32::MAX, f32::MIN, 0f32);
    for frame in 0..180 {
        scene.run(1.0 / 60.0);
        if frame >= 60 {
            let now = scene.body(handle).positions();
            let v = heart.volume(now);
            (least, most) = (least.min(v), most.max(v));
            twist = twist.max(heart.twist(now).abs());
        }
    }
    println!("volumes {least} to {most} of that at rest, twist {twist} degrees");
    assert!(least < 0.7 * most, "{least} {most}");
    assert!(twist > 5.0, "{twist}");
}
