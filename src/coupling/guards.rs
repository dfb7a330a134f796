//! Guards: parts that the skin is close to and that nothing has gone into yet.

use rapier3d::parry::bounding_volume::BoundingVolume;
use rayon::prelude::*;

use super::contact::Proximity;
use super::obstacle::ObstaclePart;
use super::penetrations::{Contact, Penetration};
use super::skin_point::SkinPoint;
use crate::elastic::ElasticBody;

/// Contacts that are none yet: parts that the skin is within `height` metres of. Whoever pushes the skin elsewhere must not
/// push it into them.
pub fn find_guards(
    body: &ElasticBody,
    parts: &[ObstaclePart],
    near: &[Proximity],
    contacts: &[Contact],
    height: f32,
) -> Vec<Contact> {
    let touches = |near: &&Proximity| {
        let own = |contact: &Contact| contact.near.segment == near.segment && contact.parts().contains(&near.part);
        !contacts.iter().any(own)
    };
    let guard = |near: &Proximity| {
        let (part, skin) = (&parts[near.part], &body.skins()[usize::from(near.segment)]);
        let around = part.aabb.loosened(height);
        let close = |&vertex: &u32| {
            let x = body.positions()[vertex as usize];
            if !around.contains_local_point(x) {
                return None;
            }
            let (distance, out) = part.placed.signed_distance(x);
            let before = distance < height && out.dot(near.normal) > BEFORE;
            before.then_some(Penetration {
                point: SkinPoint::vertex(vertex),
                part: near.part,
                depth: -distance.max(0.0),
                counts: 1.0,
            })
        };
        let mut points: Vec<Penetration> = skin.vertices.iter().filter_map(close).collect();
        points.sort_by(|a, b| b.depth.total_cmp(&a.depth).then(a.point.vertices.cmp(&b.point.vertices)));
        points.truncate(GUARDED);
        (!points.is_empty()).then(|| Contact::guarding(body, *near, points, height))
    };
    let idle: Vec<&Proximity> = near.iter().filter(touches).collect();
    idle.par_iter().map(|near| guard(near)).collect::<Vec<_>>().into_iter().flatten().collect()
}

/// Most points that are guarded at one part.
const GUARDED: usize = 64;

/// Points lie before a part where the cosine between their way from it and the contact's is above this.
const BEFORE: f32 = 0.5;

/// Adds guards to contacts: those that go the same way as a contact watch over its neighbourhood, the others stand by
/// themselves.
pub fn add_guards(body: &ElasticBody, parts: &[ObstaclePart], guards: Vec<Contact>, contacts: &mut Vec<Contact>) {
    for guard in guards {
        match contacts.iter_mut().position(|contact| contact.goes_with(&guard, parts)) {
            Some(at) => {
                let height = contacts[at].guards;
                contacts[at].absorb(body, parts, &guard);
                let Contact { near, points, .. } = contacts[at].clone();
                let joined = Contact::guarding(body, near, points, height);
                contacts[at] = Contact {
                    pierced: contacts[at].pierced,
                    held: contacts[at].held,
                    pushed: contacts[at].pushed,
                    ..joined
                };
            }
            None => contacts.push(guard),
        }
    }
}
