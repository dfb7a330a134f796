//! The rigid bodies that vertices touch: copies of their velocities, and the contacts with their colliders.

use std::collections::{BTreeMap, HashMap};

use rapier3d::dynamics::{CoefficientCombineRule, RigidBodyHandle, RigidBodySet};
use rapier3d::geometry::{ColliderHandle, ColliderSet};
use rapier3d::pipeline::QueryPipeline;

use super::boxes::are_near;
use super::detect::Sight;
use super::{GroundFriction, MeetingBody};
use crate::coupling::{ObstacleError, ObstaclePart, PartCache, deepest_on_triangle, obstacles_near};
use crate::math::{Mat3, Vec3};

/// Velocities of a rigid body over the coming step. What is not dynamic is not pushed.
#[derive(Clone, Copy, Debug)]
pub struct RigidCopy {
    /// The body; none for a collider without one.
    pub handle: Option<RigidBodyHandle>,
    linear: Vec3,
    angular: Vec3,
    centre: Vec3,
    inverse_mass: Vec3,
    inverse_inertia: Mat3,
    change: [Vec3; 2],
}

impl RigidCopy {
    /// Nothing that moves.
    const FIXED: Self = Self {
        handle: None,
        linear: Vec3::ZERO,
        angular: Vec3::ZERO,
        centre: Vec3::ZERO,
        inverse_mass: Vec3::ZERO,
        inverse_inertia: Mat3::ZERO,
        change: [Vec3::ZERO; 2],
    };

    /// Reads a body; `drift` is what gravity adds to velocities in the mean of the step.
    fn read(handle: RigidBodyHandle, drift: Vec3, bodies: &RigidBodySet) -> Self {
        let Some(body) = bodies.get(handle) else { return Self::FIXED };
        let mut copy = Self {
            handle: Some(handle),
            linear: body.linvel(),
            angular: body.angvel(),
            centre: body.center_of_mass(),
            ..Self::FIXED
        };
        if body.is_dynamic() && body.is_enabled() {
            let properties = body.mass_properties();
            let inertia = properties.effective_world_inv_inertia;
            copy.inverse_mass = properties.effective_inv_mass;
            copy.inverse_inertia = Mat3::from_cols(inertia * Vec3::X, inertia * Vec3::Y, inertia * Vec3::Z);
            if !body.is_sleeping() {
                copy.linear += drift * body.gravity_scale();
            }
        }
        copy
    }

    /// Whether it takes impulses.
    pub fn is_movable(&self) -> bool {
        self.inverse_mass != Vec3::ZERO || self.inverse_inertia != Mat3::ZERO
    }

    /// Velocity of the material point at `x`.
    #[inline]
    pub fn at(&self, x: Vec3) -> Vec3 {
        self.linear + self.angular.cross(x - self.centre)
    }

    /// How much a unit impulse along `n` at `x` changes the velocity along `n` there.
    pub fn response(&self, x: Vec3, n: Vec3) -> f32 {
        let turn = (x - self.centre).cross(n);
        n.dot(self.inverse_mass * n) + turn.dot(self.inverse_inertia * turn)
    }

    /// No unit impulse at `x` changes the velocity there by more.
    pub fn largest_response(&self, x: Vec3) -> f32 {
        let arm = (x - self.centre).length_squared();
        let i = &self.inverse_inertia;
        self.inverse_mass.max_element() + arm * (i.x_axis.x + i.y_axis.y + i.z_axis.z)
    }

    /// Applies an impulse at `x`.
    #[inline]
    pub fn push(&mut self, x: Vec3, impulse: Vec3) {
        let change = [self.inverse_mass * impulse, self.inverse_inertia * (x - self.centre).cross(impulse)];
        self.linear += change[0];
        self.angular += change[1];
        self.change = [self.change[0] + change[0], self.change[1] + change[1]];
    }

    /// Writes the change of the velocities. A sleeping body is woken by what would move it noticeably, and else left alone.
    pub fn write(&self, bodies: &mut RigidBodySet) {
        let [linear, angular] = self.change;
        if linear == Vec3::ZERO && angular == Vec3::ZERO || !(linear.is_finite() && angular.is_finite()) {
            return;
        }
        let Some(body) = self.handle.and_then(|handle| bodies.get_mut(handle)) else { return };
        if body.is_sleeping() && linear.length() < NOTICED && angular.length() < NOTICED {
            return;
        }
        body.set_linvel(body.linvel() + linear, true);
        body.set_angvel(body.angvel() + angular, true);
    }
}

/// A change of velocity in m/s, or rad/s, that wakes a sleeping body.
const NOTICED: f32 = 0.05;

/// Normals whose cosine is above this are one way.
const ONE_WAY: f32 = 0.95;

/// The copies of all rigid bodies that are touched, each once.
#[derive(Default)]
pub struct Copies {
    /// In the order in which they were asked for.
    pub list: Vec<RigidCopy>,
    places: HashMap<Option<RigidBodyHandle>, u32>,
}

impl Copies {
    fn of(&mut self, handle: Option<RigidBodyHandle>, drift: Vec3, bodies: &RigidBodySet) -> u32 {
        let list = &mut self.list;
        *self.places.entry(handle).or_insert_with(|| {
            list.push(handle.map_or(RigidCopy::FIXED, |handle| RigidCopy::read(handle, drift, bodies)));
            list.len() as u32 - 1
        })
    }
}

/// A vertex or a triangle near a convex part of a collider.
#[derive(Clone, Copy, Debug)]
pub struct RigidTouch {
    /// The vertex of the body, or the first corner of the triangle.
    pub vertex: u32,
    /// The triangle and the point of it that is deepest, by its weights; none where it is the vertex.
    pub face: Option<([u32; 3], [f32; 3])>,
    /// The rigid body's place among the copies.
    pub copy: u32,
    /// Whether it is fixed ground.
    pub fixed: bool,
    /// Unit normal, out of the part.
    pub normal: Vec3,
    /// Gap in metres, negative for an overlap.
    pub gap: f32,
    /// Coulomb coefficient of the two.
    pub friction: f32,
}

/// Rapier's sets and the parts of its colliders.
pub struct Surroundings<'a> {
    /// The query pipeline of the broad phase.
    pub query: QueryPipeline<'a>,
    /// The rigid bodies.
    pub bodies: &'a RigidBodySet,
    /// The colliders.
    pub colliders: &'a ColliderSet,
    /// What gravity adds to velocities in the mean of the step, in m/s.
    pub drift: Vec3,
    /// Length of the step in seconds.
    pub h: f32,
}

/// The colliders that have no convex parts, by handle.
pub type Refused = BTreeMap<(u32, u32), (ColliderHandle, ObstacleError)>;

/// What the vertices of a body may touch in the step, but for other soft bodies, and what it is attached to.
pub fn rigid_touches(
    body: &MeetingBody<'_>,
    sight: &Sight,
    around: &Surroundings<'_>,
    copies: &mut Copies,
    cache: &mut PartCache,
    refused: &mut Refused,
) -> Vec<RigidTouch> {
    let own = |handle: RigidBodyHandle| {
        body.attached.contains(&handle) || around.bodies.get(handle).is_some_and(|b| b.soft_body().is_some())
    };
    let thickness = sight.bounds.extents().max_element();
    let parts = obstacles_near(&around.query, &sight.region, thickness, body.groups, &own, cache, refused);
    let (mut found, mut faces) = (Vec::new(), Vec::new());
    for part in &parts {
        let Some(collider) = around.colliders.get(part.collider) else { continue };
        let parent = collider.parent();
        let copy = copies.of(parent, around.drift, around.bodies);
        let fixed = parent.is_none_or(|p| around.bodies.get(p).is_none_or(|b| b.is_fixed()));
        let rule = if body.ground.is_some() { CoefficientCombineRule::Min } else { CoefficientCombineRule::Average };
        let friction =
            CoefficientCombineRule::combine(body.friction, collider.friction(), rule, collider.friction_combine_rule());
        let skins = sight.skin + collider.contact_skin();
        touch_part(body, part, &copies.list[copy as usize], around, skins, |vertex, normal, gap| {
            found.push(RigidTouch { vertex, face: None, copy, fixed, normal, gap, friction });
        });
        touch_faces(body, part, &copies.list[copy as usize], around, skins, |corners, weights, normal, gap| {
            let face = Some((corners, weights));
            faces.push(RigidTouch { vertex: corners[0], face, copy, fixed, normal, gap, friction });
        });
    }
    // Of the parts that hold a vertex the same way the deepest counts: neighbours of a surface are one obstacle.
    found.sort_by(|a, b| a.vertex.cmp(&b.vertex).then(a.gap.total_cmp(&b.gap)));
    let mut kept: Vec<RigidTouch> = Vec::with_capacity(found.len());
    for touch in found {
        let same = |other: &RigidTouch| other.copy == touch.copy && other.normal.dot(touch.normal) > ONE_WAY;
        if !kept.iter().rev().take_while(|other| other.vertex == touch.vertex).any(same) {
            kept.push(touch);
        }
    }
    kept.extend(faces);
    kept
}

fn touch_part(
    body: &MeetingBody<'_>,
    part: &ObstaclePart,
    rigid: &RigidCopy,
    around: &Surroundings<'_>,
    skins: f32,
    mut touch: impl FnMut(u32, Vec3, f32),
) {
    let (x, v) = (body.body.positions(), body.body.velocities());
    let bounds = [part.aabb.mins, part.aabb.maxs];
    for &vertex in &body.surface.vertices {
        let (x, v) = (x[vertex as usize], v[vertex as usize]);
        let travel = around.h * (v + around.drift).distance(rigid.at(x));
        if !are_near([x; 2], bounds, skins + travel) {
            continue;
        }
        let (mut distance, mut normal) = part.placed.signed_distance(x);
        if distance < 0.0
            && let Some(face) = &part.face
        {
            normal = face.way_out(normal);
            if let Some(depth) = face.exit(x, normal) {
                distance = -depth;
            } else if let Some(way) = face.way_to_surface(x) {
                (distance, normal) = (-way.length(), face.normal);
            }
        }
        let gap = distance - skins;
        if gap <= travel && normal.is_finite() && normal != Vec3::ZERO {
            touch(vertex, normal, gap);
        }
    }
}

/// A convex part that is no larger than so many edges of the body's triangles reaches in between their vertices.
const SLIPS_IN: f32 = 12.0;

/// A triangle touches by itself where a point of it is deeper than its corners by this part of an edge.
const BULGES: f32 = 0.02;

/// What triangles touch with points between their vertices: of small parts.
fn touch_faces(
    body: &MeetingBody<'_>,
    part: &ObstaclePart,
    rigid: &RigidCopy,
    around: &Surroundings<'_>,
    skins: f32,
    mut touch: impl FnMut([u32; 3], [f32; 3], Vec3, f32),
) {
    let surface = body.surface;
    // A piece of a surface ends where its neighbour begins: its border is no edge.
    if part.face.is_some() || part.aabb.extents().max_element() > SLIPS_IN * surface.edge {
        return;
    }
    let bounds = [part.aabb.mins, part.aabb.maxs];
    let (x, v) = (body.body.positions(), body.body.velocities());
    for &vertices in &surface.triangles[..surface.triangle_count()] {
        let corners = vertices.map(|i| x[i as usize]);
        let travel = |i: u32| around.h * (v[i as usize] + around.drift).distance(rigid.at(x[i as usize]));
        let travel = vertices.map(travel).into_iter().fold(0.0, f32::max);
        let reach = skins + travel;
        let (low, high) =
            (corners.into_iter().fold(Vec3::MAX, Vec3::min), corners.into_iter().fold(Vec3::MIN, Vec3::max));
        if !are_near([low, high], bounds, reach) {
            continue;
        }
        // Tangent planes at the corners bound the distance from below: most triangles need no search.
        let heights = corners.map(|x| part.placed.signed_distance(x));
        let lowest = heights.iter().map(|h| h.0).fold(f32::INFINITY, f32::min);
        let below = (lowest - BULGES * surface.edge).min(reach);
        let bound = |(at, (height, slope)): (&Vec3, &(f32, Vec3))| {
            corners.iter().map(|x| height + slope.dot(*x - *at)).fold(f32::INFINITY, f32::min)
        };
        if corners.iter().zip(&heights).any(|corner| bound(corner) >= below) {
            continue;
        }
        let (weights, height) = deepest_on_triangle(&part.placed, corners);
        let point: Vec3 = corners.iter().zip(weights).map(|(x, w)| *x * w).sum();
        let normal = part.placed.signed_distance(point).1;
        if height < below && normal.is_finite() && normal != Vec3::ZERO {
            touch(vertices, weights, normal, height - skins);
        }
    }
}

/// Friction of a vertex on fixed ground with a direction of its own.
pub fn directed(
    ground: &GroundFriction<'_>,
    vertex: u32,
    normal: Vec3,
    floor: f32,
    positions: &[Vec3],
) -> super::solve::Friction {
    let along = ground.directions.at(vertex, positions);
    let along = (along - normal * along.dot(normal)).normalize_or_zero();
    super::solve::Friction::Directed { along, coefficients: ground.directions.coefficients(floor, ground.turned) }
}
