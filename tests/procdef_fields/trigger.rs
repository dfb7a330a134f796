//! Contacts as stimuli.

use pliant::procdef::{ContactTrigger, TriggerSettings};

const DT: f32 = 1.0 / 60.0;

fn trigger() -> ContactTrigger {
    ContactTrigger::new(TriggerSettings { threshold: 1.0, refractory: 0.5 })
}

#[test]
fn weak_contacts_are_not_felt_and_strong_ones_once() {
    let mut t = trigger();
    assert!(!t.step(0.99, DT));
    assert!(t.step(1.0, DT));
    // The contact lasts for ten seconds.
    assert!((0..600).all(|_| !t.step(2.0, DT)));
}

#[test]
fn after_the_rest_a_new_contact_is_felt_at_the_very_step() {
    let mut t = trigger();
    assert!(t.step(5.0, DT));
    let mut felt = Vec::new();
    for step in 1..=60 {
        // Taps: on at every other step.
        if t.step(if step % 2 == 0 { 5.0 } else { 0.0 }, DT) {
            felt.push(step);
        }
    }
    assert_eq!(felt, [30, 60]);
}

#[test]
fn what_is_not_finite_is_not_felt_and_zero_is_no_contact() {
    let mut t = trigger();
    assert!(!t.step(f32::NAN, DT) && !t.step(f32::INFINITY, DT) && !t.step(-3.0, DT));
    assert!(t.step(1.5, DT));
    let mut all = ContactTrigger::new(TriggerSettings { threshold: 0.0, refractory: 0.0 });
    assert!(!all.step(0.0, DT));
    assert!(all.step(1e-6, DT));
}
