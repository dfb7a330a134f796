//! The solve of one island: Gauss-Seidel over points of contact, on private copies of the velocities.

use std::ops::Range;

use super::rebound::{BOOST, Rebound};
use super::sampled_spring::SampledSpring;
use super::velocities::BodyVelocity;
use super::{FoundationContact, FoundationPoint};
use crate::math::{Mat2, Vec2, Vec3};

/// The bodies of an island and the points between them.
#[derive(Default)]
pub struct Island {
    /// The bodies.
    pub bodies: Vec<BodyVelocity>,
    rows: Vec<Row>,
    blocks: Vec<Block>,
}

/// One point.
struct Row {
    a: Moved,
    b: Option<Moved>,
    position: Vec3,
    normal: Vec3,
    tangents: [Vec3; 2],
    /// Inverse of the effective mass along the normal, in 1/kg.
    response: f32,
    /// Effective mass across it.
    slide_mass: Mat2,
    /// How much the sliding is let through for each unit of grip.
    give: Mat2,
    weight: f32,
    friction: f32,
    drag: f32,
    /// Impulse against rocking.
    rocking: f32,
    /// All of the impulse along the normal.
    pressure: f32,
    grip: Vec2,
}

/// A body of the island, and whether the point pushes it: not where the other one dominates it.
#[derive(Clone, Copy)]
struct Moved {
    index: usize,
    pushed: bool,
}

/// One contact: its points are released together.
struct Block {
    rows: Range<usize>,
    depth: f32,
    load: f32,
    spring: SampledSpring,
    rebound: Rebound,
    /// The impulse that the points share.
    shared: f32,
    /// How much a unit impulse at the centre changes the opening speed: by the guess, and where nothing holds the bodies.
    response: [f32; 2],
}

impl Island {
    /// Adds a contact between bodies of the island; `places` are those of each point's two bodies.
    pub fn add(&mut self, contact: &FoundationContact, places: &[(usize, Option<usize>)], rebound: Rebound) {
        let start = self.rows.len();
        for ((point, weight), &(a, b)) in contact.weights().zip(places) {
            let row = self.row(point, weight, a, b);
            self.rows.push(row);
        }
        self.blocks.push(Block {
            rows: start..self.rows.len(),
            depth: contact.depth(),
            load: contact.mean_depth(),
            spring: rebound.spring,
            rebound,
            shared: 0.0,
            response: [0.0; 2],
        });
    }

    fn row(&self, point: &FoundationPoint, weight: f32, a: usize, b: Option<usize>) -> Row {
        let dominance = |index: usize| self.bodies[index].dominance;
        let moved = |index: usize, other: Option<usize>| {
            let pushed = other.is_none_or(|other| dominance(index) <= dominance(other));
            Moved { index, pushed: pushed && self.bodies[index].is_movable() }
        };
        let (t, s) = point.normal.any_orthonormal_pair();
        let mut row = Row {
            a: moved(a, b),
            b: b.map(|b| moved(b, Some(a))),
            position: point.position,
            normal: point.normal,
            tangents: [t, s],
            response: 0.0,
            slide_mass: Mat2::ZERO,
            give: Mat2::ZERO,
            weight,
            friction: point.friction,
            drag: 0.0,
            rocking: 0.0,
            pressure: 0.0,
            grip: Vec2::ZERO,
        };
        row.response = self.response(&row, point.normal, point.normal);
        let across = self.response(&row, t, s);
        let slide =
            Mat2::from_cols(Vec2::new(self.response(&row, t, t), across), Vec2::new(across, self.response(&row, s, s)));
        if slide.determinant() > f32::MIN_POSITIVE {
            row.give = slide * (GIVE / weight.max(f32::MIN_POSITIVE));
            row.slide_mass = (slide + row.give).inverse();
        }
        row
    }

    fn response(&self, row: &Row, n: Vec3, m: Vec3) -> f32 {
        let of = |moved: Moved| match moved.pushed {
            true => self.bodies[moved.index].response(row.position, n, m),
            false => 0.0,
        };
        of(row.a) + row.b.map_or(0.0, of)
    }

    /// Solves the island.
    pub fn solve(&mut self, sweeps: u32, dt: f32) {
        self.prepare(dt);
        for sweep in 0..sweeps.max(1) {
            for block in 0..self.blocks.len() {
                let shared = self.release(block, dt);
                let rows = self.blocks[block].rows.clone();
                // There and back in turn: whoever comes first holds more, and that would twist the body.
                let order = |i: usize| if sweep % 2 == 0 { rows.start + i } else { rows.end - 1 - i };
                for i in 0..rows.len() {
                    self.press(order(i), shared);
                }
                let opening = self.opening(block);
                for i in 0..rows.len() {
                    self.steady(order(i), opening, shared);
                }
                for i in 0..rows.len() {
                    self.rub(order(i));
                }
            }
        }
    }

    /// Springs that are stable with what they push, and what they do to the opening speed.
    fn prepare(&mut self, dt: f32) {
        // Sum over a body's points of stiffness times response: no eigenvalue of the whole island is larger than the
        // sum of two such sums.
        let mut loads = vec![0.0_f32; self.bodies.len()];
        for block in &self.blocks {
            for row in &self.rows[block.rows.clone()] {
                for moved in [Some(row.a), row.b].into_iter().flatten().filter(|moved| moved.pushed) {
                    let body = &self.bodies[moved.index];
                    let response = body.free_response(row.position, row.normal);
                    loads[moved.index] += block.spring.push * row.weight * response;
                }
            }
        }
        for index in 0..self.blocks.len() {
            let rows = self.blocks[index].rows.clone();
            let load = |row: &Row| loads[row.a.index] + row.b.map_or(0.0, |b| loads[b.index]);
            let bound = self.rows[rows.clone()].iter().map(load).fold(0.0, f32::max);
            let spring = self.blocks[index].spring.weakened(bound, dt);
            let response = self.centre_response(rows.clone());
            self.blocks[index].spring = spring;
            self.blocks[index].response = response;
            for row in &mut self.rows[rows] {
                row.drag = spring.drag * row.weight;
            }
        }
    }

    /// How much a unit impulse, spread over the points by their weights, changes the opening speed.
    fn centre_response(&self, rows: Range<usize>) -> [f32; 2] {
        let rows = &self.rows[rows];
        let mut response = [0.0; 2];
        for side in [|row: &Row| Some(row.a), |row: &Row| row.b] {
            for run in rows.chunk_by(|p, q| side(p).map(|m| m.index) == side(q).map(|m| m.index)) {
                let Some(moved) = run.first().and_then(side).filter(|moved| moved.pushed) else { continue };
                let weight: f32 = run.iter().map(|row| row.weight).sum();
                let position = run.iter().map(|row| row.position * row.weight).sum::<Vec3>() / weight;
                let normal = run.iter().map(|row| row.normal * row.weight).sum::<Vec3>() / weight;
                let body = &self.bodies[moved.index];
                response[0] += weight * weight * body.response(position, normal, normal);
                response[1] += weight * weight * body.free_response(position, normal);
            }
        }
        response
    }

    /// Velocity of `body` relative to `other` at a point.
    fn relative(&self, row: &Row) -> Vec3 {
        self.bodies[row.a.index].at(row.position) - row.b.map_or(Vec3::ZERO, |b| self.bodies[b.index].at(row.position))
    }

    fn apply(&mut self, row: usize, impulse: Vec3) {
        let Row { a, b, position, .. } = self.rows[row];
        if a.pushed {
            self.bodies[a.index].push(position, impulse);
        }
        if let Some(b) = b.filter(|b| b.pushed) {
            self.bodies[b.index].push(position, -impulse);
        }
    }

    /// The impulse `Λ` that the points of a contact share: that of spring and damper at its centre, `Λ = push d − drag V`
    /// with the speed `V` after the impulse, never pulling; less where the contact would open too fast; and what it takes to
    /// open as fast as it should where it ends in this step.
    fn release(&mut self, index: usize, dt: f32) -> f32 {
        let opening = self.opening(index);
        let block = &mut self.blocks[index];
        let [response, free] = block.response;
        if response <= 0.0 {
            return 0.0;
        }
        let SampledSpring { push, drag } = block.spring;
        let alone = opening - response * block.shared;
        let by_spring = ((push * block.load - drag * alone) / (1.0 + drag * response)).max(0.0);
        let speed = alone + response * by_spring;
        let ends = speed > 0.0 && block.depth <= dt * speed;
        let wanted = match block.rebound.bounces && ends {
            true => block.rebound.limit.min(BOOST * speed),
            false => block.rebound.limit.min(speed),
        };
        // What is held may be let go: no more is added than a free body needs.
        let change = if wanted > speed { (wanted - speed) / free } else { (wanted - speed) / response };
        block.shared = (by_spring + change).max(0.0);
        block.shared
    }

    /// The speed at which a contact opens, at its centre.
    fn opening(&self, block: usize) -> f32 {
        let rows = &self.rows[self.blocks[block].rows.clone()];
        rows.iter().map(|row| row.weight * self.relative(row).dot(row.normal)).sum()
    }

    /// The point's part of the contact's impulse.
    fn press(&mut self, index: usize, shared: f32) {
        let row = &mut self.rows[index];
        // It never pulls.
        let pressure = (row.weight * shared + row.rocking).max(0.0);
        let impulse = row.normal * (pressure - row.pressure);
        row.pressure = pressure;
        self.apply(index, impulse);
    }

    /// The damper of one point against what it moves otherwise than the contact's centre: `λ = −drag (v − V)` with the
    /// velocity `v` after the impulse.
    fn steady(&mut self, index: usize, opening: f32, shared: f32) {
        let v = self.relative(&self.rows[index]).dot(self.rows[index].normal) - opening;
        let row = &mut self.rows[index];
        let rocking = row.rocking + (-row.drag * v - row.rocking) / (1.0 + row.drag * row.response);
        let most = ROLLING_FRICTION * row.weight * shared.max(0.0);
        row.rocking = rocking.clamp(-most, most);
        self.press(index, shared);
    }

    /// Coulomb friction: stops the sliding, but for the give, as far as the pressure allows.
    fn rub(&mut self, index: usize) {
        let v = self.relative(&self.rows[index]);
        let row = &mut self.rows[index];
        let [t, s] = row.tangents;
        let slide = Vec2::new(v.dot(t), v.dot(s));
        let grip =
            (row.grip - row.slide_mass * (slide + row.give * row.grip)).clamp_length_max(row.friction * row.pressure);
        let change = grip - row.grip;
        row.grip = grip;
        self.apply(index, t * change.x + s * change.y);
    }
}

/// The damping of single points is at most this part of their pressure: enough to bring a rocking crate to rest, and little
/// enough for a ball to roll.
const ROLLING_FRICTION: f32 = 0.04;

/// A contact lets this part of a step's sliding through: rapier's answers make the guess of the velocities tremble, and
/// friction that followed every tremor would shake a stack apart.
const GIVE: f32 = 0.3;
