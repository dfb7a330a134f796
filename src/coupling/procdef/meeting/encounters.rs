//! What may meet in a step: who, where, and the contacts that come of it.

use rayon::prelude::*;

use super::boxes::Boxes;
use super::detect::{Sight, Touch, pairs, touches_of};
use super::edges::PlacedEdges;
use super::frames::{Frames, Reach, spares};
use super::hold::{Ways, hold_apart};
use super::near::{Near, Side, near_of};
use super::rigid::{Copies, Refused, Surroundings, directed, rigid_touches};
use super::solve::{Contact, Friction, PARTING, Sides, Velocities};
use super::tangles::KnownApart;
use super::triangles::PlacedTriangles;
use super::{Meeting, MeetingBody, MeetingStep};
use crate::coupling::PartCache;
use crate::coupling::procdef::GroundContact;
use crate::math::Vec3;

/// A body's surface where it is now.
#[derive(Default)]
pub struct Placed {
    /// Its triangles.
    pub triangles: PlacedTriangles,
    /// Its edges.
    pub edges: PlacedEdges,
    /// The boxes of its vertices.
    pub points: Boxes,
}

/// What may meet in a step.
pub struct Encounters {
    /// Bodies that may meet, ascending.
    pairs: Vec<(u32, u32)>,
    frames: Frames,
    /// The first vertex of each body among those of all, and how many there are.
    offsets: Vec<u32>,
    sights: Vec<Sight>,
    placed: Vec<Placed>,
    reaches: Vec<Reach>,
    /// Which bodies are in one of the pairs.
    meets: Vec<bool>,
    /// What is near of pairs that are apart.
    near: Vec<Vec<Near>>,
    /// How those get apart that are not; of a pair there is one or the other.
    tangled: Vec<Option<Vec<Touch>>>,
}

impl Encounters {
    /// Looks for all that may meet of some bodies.
    /// `stands` tells which bodies stand on fixed ones.
    pub fn find(bodies: &[MeetingBody<'_>], step: &MeetingStep, stands: &[bool], apart: &mut KnownApart) -> Self {
        let h = step.dt;
        let sights: Vec<Sight> = bodies.par_iter().map(|body| Sight::of(body, step.drift(), h)).collect();
        let pairs = pairs(bodies, &sights);
        let mut meets = vec![false; bodies.len()];
        pairs.iter().flat_map(|&(a, b)| [a, b]).for_each(|k| meets[k as usize] = true);
        let frames = Frames::of(bodies.len(), &pairs);
        let common = frames.velocities(bodies, stands);
        let reach = |(k, spare): (usize, f32)| Reach { spare, ..Reach::of(&bodies[k], common[frames.of_body[k]].0, h) };
        let reaches: Vec<Reach> = spares(&sights, &pairs, h).into_iter().enumerate().map(reach).collect();
        let placed = places(bodies, &reaches, &meets);
        let mut offsets = vec![0];
        for body in bodies {
            offsets.push(offsets[offsets.len() - 1] + body.body.positions().len() as u32);
        }
        let mut found =
            Self { pairs, frames, offsets, sights, placed, reaches, meets, near: Vec::new(), tangled: Vec::new() };
        let sides: Vec<_> = found.pairs.iter().map(|&(a, b)| (found.side(bodies, a), found.side(bodies, b))).collect();
        let tangled = apart.tangled(&sides);
        let both: Vec<_> = sides
            .par_iter()
            .zip(tangled)
            .map(|((a, b), tangled)| if tangled { (Vec::new(), Some(touches_of(a, b))) } else { (near_of(a, b), None) })
            .collect();
        drop(sides);
        (found.near, found.tangled) = both.into_iter().unzip();
        found
    }

    fn side<'a>(&'a self, bodies: &'a [MeetingBody<'a>], body: u32) -> Side<'a> {
        let k = body as usize;
        Side {
            body: &bodies[k],
            sight: &self.sights[k],
            placed: &self.placed[k],
            reach: &self.reaches[k],
            offset: self.offsets[k],
        }
    }

    /// The contacts with rigid colliders; for each the body, its vertex and whether it stands on fixed ground.
    pub fn add_rigid(
        &self,
        bodies: &[MeetingBody<'_>],
        around: &Surroundings<'_>,
        (copies, parts, refused): (&mut Copies, &mut PartCache, &mut Refused),
        contacts: &mut Vec<Contact>,
    ) -> Vec<(usize, u32, bool)> {
        let mut from = Vec::new();
        for (a, body) in bodies.iter().enumerate().filter(|(_, body)| body.own_contacts) {
            for touch in rigid_touches(body, &self.sights[a], around, copies, parts, refused) {
                let x = body.body.positions();
                let friction = match &body.ground {
                    Some(ground) if touch.fixed && touch.face.is_none() => {
                        directed(ground, touch.vertex, touch.normal, touch.friction, x)
                    }
                    _ => Friction::Even(touch.friction),
                };
                from.push((a, touch.vertex, touch.fixed));
                let sides = match touch.face {
                    None => Sides::Rigid(self.offsets[a] + touch.vertex, touch.copy, x[touch.vertex as usize]),
                    Some((corners, weights)) => {
                        let point = corners.iter().zip(weights).map(|(&v, w)| x[v as usize] * w).sum();
                        Sides::Face(corners.map(|v| v + self.offsets[a]), weights, touch.copy, point)
                    }
                };
                contacts.push(Contact {
                    sides,
                    normal: touch.normal,
                    gap: touch.gap,
                    parting: PARTING * self.sights[a].skin,
                    friction,
                    impulse: (0.0, Vec3::ZERO),
                });
            }
        }
        from
    }

    /// The contacts between bodies that move by themselves.
    pub fn add_soft(&self, bodies: &[MeetingBody<'_>], contacts: &mut Vec<Contact>) {
        for ((&(a, b), near), tangled) in self.pairs.iter().zip(&self.near).zip(&self.tangled) {
            let (a, b) = (a as usize, b as usize);
            let skins = self.sights[a].skin + self.sights[b].skin;
            let friction = Friction::Even(between(&bodies[a], &bodies[b]));
            let contact = |sides, normal, gap| Contact {
                sides,
                normal,
                gap,
                parting: PARTING * skins,
                friction,
                impulse: (0.0, Vec3::ZERO),
            };
            let pressing = near.iter().filter(|near| near.presses);
            let sides = |near: &Near| Sides::Soft(near.vertices, near.weights);
            contacts.extend(pressing.map(|near| contact(sides(near), near.normal, near.distance - skins)));
            let touches = tangled.iter().flatten();
            contacts.extend(touches.map(|t| contact(Sides::Soft(t.vertices, t.weights), t.normal, t.gap)));
        }
    }

    /// The velocities of all vertices in the mean of the step.
    pub fn velocities(&self, bodies: &[MeetingBody<'_>], drift: Vec3) -> Velocities {
        Velocities {
            vertices: bodies.iter().flat_map(|b| b.body.velocities().iter().map(|v| *v + drift)).collect(),
            inverse_masses: bodies.iter().flat_map(|b| b.body.rig().masses().iter().map(|m| 1.0 / m)).collect(),
            rigid: Vec::new(),
        }
    }

    /// Gives the velocities back to the bodies.
    pub fn take(&self, bodies: &mut [MeetingBody<'_>], velocities: &[Vec3], drift: Vec3) {
        for (body, &offset) in bodies.iter_mut().zip(&self.offsets) {
            let own = velocities[offset as usize..].iter();
            body.body.velocities_mut().iter_mut().zip(own).for_each(|(v, &new)| *v = new - drift);
        }
    }

    /// What contacts did to each body; `touched` says where the first of them come from, those with rigid bodies.
    pub fn report(
        &self,
        bodies: &[MeetingBody<'_>],
        contacts: &[Contact],
        touched: &[(usize, u32, bool)],
        meetings: &mut [Meeting],
    ) {
        let mut felt = vec![Vec3::ZERO; self.offsets[bodies.len()] as usize];
        let from = touched.iter().map(Some).chain(std::iter::repeat(None));
        for (contact, from) in contacts.iter().zip(from) {
            let (pressed, braked) = contact.impulse;
            let (vertices, weights, count) = match contact.sides {
                Sides::Soft(vertices, weights) => (vertices, weights, 4),
                Sides::Rigid(vertex, ..) => ([vertex; 4], [1.0; 4], 1),
                Sides::Face([a, b, c], [wa, wb, wc], ..) => ([a, b, c, a], [wa, wb, wc, 0.0], 3),
            };
            for v in [vertices[0], vertices[3]] {
                let deepest = &mut meetings[self.offsets.partition_point(|&o| o <= v) - 1].deepest;
                *deepest = deepest.max(-contact.gap);
            }
            if pressed == 0.0 {
                continue;
            }
            let impulse = contact.normal * pressed + braked;
            if let Some(&(a, vertex, true)) = from {
                if let Sides::Rigid(..) = contact.sides {
                    meetings[a].ground.push(GroundContact { vertex, normal: contact.normal });
                }
                continue;
            }
            for (&v, w) in vertices.iter().zip(weights).take(count) {
                felt[v as usize] += impulse * w;
            }
        }
        for ((meeting, body), &offset) in meetings.iter_mut().zip(bodies).zip(&self.offsets) {
            meeting.ground.dedup_by_key(|g| g.vertex);
            let own = &felt[offset as usize..][..body.body.positions().len()];
            if own.iter().any(|f| *f != Vec3::ZERO) {
                meeting.felt.extend_from_slice(own);
            }
        }
    }

    /// Turns and shortens the ways of vertices that contacts would let into another body.
    pub fn hold_apart(
        self,
        bodies: &mut [MeetingBody<'_>],
        step: &MeetingStep,
        stands: &[bool],
        apart: &mut KnownApart,
        meetings: &mut [Meeting],
    ) {
        let common = self.frames.velocities(bodies, stands);
        if self.is_left(bodies, step, &common) {
            // Contacts sent a vertex farther than was looked at: all is looked for again.
            let found = Self::find(bodies, step, stands, apart);
            let common = found.frames.velocities(bodies, stands);
            found.hold_near_apart(bodies, step, &common, meetings);
        } else {
            self.hold_near_apart(bodies, step, &common, meetings);
        }
    }

    fn hold_near_apart(
        &self,
        bodies: &mut [MeetingBody<'_>],
        step: &MeetingStep,
        common: &[(Vec3, bool)],
        meetings: &mut [Meeting],
    ) {
        if self.pairs.is_empty() {
            return;
        }
        let mut all = self.velocities(bodies, Vec3::ZERO);
        let counts = self.offsets.windows(2).map(|w| (w[1] - w[0]) as usize);
        let frames: Vec<u32> =
            self.frames.of_body.iter().zip(counts).flat_map(|(&f, n)| std::iter::repeat_n(f as u32, n)).collect();
        let mut ways = Ways {
            velocities: &mut all.vertices,
            inverse_masses: &all.inverse_masses,
            frames: &frames,
            common,
            h: step.dt,
        };
        let held = hold_apart(&self.near, &mut ways);
        if held.is_empty() {
            return;
        }
        self.take(bodies, &all.vertices, Vec3::ZERO);
        for vertex in held {
            meetings[self.offsets.partition_point(|&o| o <= vertex) - 1].held += 1;
        }
    }

    /// Whether a body goes where nothing was looked for.
    fn is_left(&self, bodies: &[MeetingBody<'_>], step: &MeetingStep, common: &[(Vec3, bool)]) -> bool {
        let drift = step.drift();
        bodies.len() > 1
            && bodies.par_iter().enumerate().any(|(k, body)| {
                let (x, v) = (body.body.positions(), body.body.velocities());
                let region = &self.sights[k].region;
                let leaves = |&i: &u32| !region.contains_local_point(x[i as usize] + (v[i as usize] + drift) * step.dt);
                let short = || self.reaches[k].is_short_of(&Reach::of(body, common[self.frames.of_body[k]].0, step.dt));
                body.surface.vertices.iter().any(leaves) || self.meets[k] && short()
            })
    }
}

/// The surfaces of those bodies that meet others, where they are now.
fn places(bodies: &[MeetingBody<'_>], reaches: &[Reach], meets: &[bool]) -> Vec<Placed> {
    let place = |((body, reach), meets): ((&MeetingBody<'_>, &Reach), &bool)| {
        let mut placed = Placed::default();
        if *meets {
            placed.triangles.place(body.surface, body.body.positions(), &reach.moves);
            placed.edges.place(body.surface, body.body.positions(), &reach.moves);
            placed.points.place(&body.surface.points, body.body.positions(), &reach.moves);
        }
        placed
    };
    bodies.par_iter().zip(reaches).zip(meets).map(place).collect()
}

/// The coefficient of friction between two bodies: the mean, or the least where one has a direction of its own.
fn between(a: &MeetingBody<'_>, b: &MeetingBody<'_>) -> f32 {
    if a.ground.is_some() || b.ground.is_some() { a.friction.min(b.friction) } else { 0.5 * (a.friction + b.friction) }
}
