//! The common motion of bodies that may meet in a step, and how far their vertices may go beside it.

use super::MeetingBody;
use super::detect::Sight;
use crate::coupling::joined::Joined;
use crate::math::Vec3;

/// Bodies that may meet, directly or by way of others, go on in one frame.
pub struct Frames {
    /// The frame of each body.
    pub of_body: Vec<usize>,
    /// How many frames there are.
    pub count: usize,
}

/// How far the vertices of a body may go in the step, beside its frame, in metres.
pub struct Reach {
    /// As they want to go, one a vertex.
    pub moves: Vec<f32>,
    /// The largest of them.
    pub farthest: f32,
    /// What contacts may add, and the gap that is kept.
    pub spare: f32,
}

/// Contacts may add this part of the way that two bodies come nearer in a step.
const PUSHED: f32 = 0.6;

impl Frames {
    /// The frames of so many bodies, of which `pairs` may meet.
    pub fn of(bodies: usize, pairs: &[(u32, u32)]) -> Self {
        let mut joined = Joined::default();
        joined.grow(bodies);
        pairs.iter().for_each(|&(a, b)| joined.join(a as usize, b as usize));
        let mut places = vec![usize::MAX; bodies];
        let mut count = 0;
        let mut of_body = Vec::with_capacity(bodies);
        for k in 0..bodies {
            // A root is the first of its frame.
            let root = joined.root(k);
            if root == k {
                places[k] = count;
                count += 1;
            }
            of_body.push(places[root]);
        }
        Self { of_body, count }
    }

    /// The velocity of each frame now, in m/s, and whether fixed bodies hold it: the mean of its bodies, or that of what holds
    /// one of them, none. `held` are the bodies that stand on fixed ones.
    pub fn velocities(&self, bodies: &[MeetingBody<'_>], held: &[bool]) -> Vec<(Vec3, bool)> {
        let mut fixed = vec![false; self.count];
        self.of_body.iter().zip(held).for_each(|(&frame, held)| fixed[frame] |= held);
        let mut sums = vec![(Vec3::ZERO, 0.0f32); self.count];
        for (body, &frame) in bodies.iter().zip(&self.of_body) {
            let (momentum, mass) = &mut sums[frame];
            for (v, m) in body.body.velocities().iter().zip(body.body.rig().masses()) {
                *momentum += *v * *m;
                *mass += m;
            }
        }
        let mean = |(momentum, mass): (Vec3, f32)| momentum / mass.max(f32::MIN_POSITIVE);
        sums.into_iter().zip(fixed).map(|(sum, fixed)| (if fixed { Vec3::ZERO } else { mean(sum) }, fixed)).collect()
    }
}

impl Reach {
    /// How far the vertices of a body go in `h` seconds beside a frame with the velocity `common`.
    pub fn of(body: &MeetingBody<'_>, common: Vec3, h: f32) -> Self {
        let moves: Vec<f32> = body.body.velocities().iter().map(|v| v.distance(common) * h).collect();
        let farthest = body.surface.vertices.iter().map(|&v| moves[v as usize]).fold(0.0, f32::max);
        Self { moves, farthest, spare: 0.0 }
    }

    /// Whether this leaves less than another way needs.
    pub fn is_short_of(&self, other: &Self) -> bool {
        self.moves.iter().zip(&other.moves).any(|(own, other)| own + self.spare < *other)
    }
}

/// What is left to the vertices of each body beside their own ways: the gap that is kept, and what contacts may add where bodies
/// come near each other.
pub fn spares(sights: &[Sight], pairs: &[(u32, u32)], h: f32) -> Vec<f32> {
    let mut spares: Vec<f32> = sights.iter().map(|sight| sight.skin).collect();
    for &(a, b) in pairs {
        let nearing = PUSHED * h * sights[a as usize].mean.distance(sights[b as usize].mean);
        [a, b].into_iter().for_each(|k| spares[k as usize] = spares[k as usize].max(nearing));
    }
    spares
}
