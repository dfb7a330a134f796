//! The palette as the shader reads it: one array of four-word rows, written anew each frame.
//!
//! ```text
//! header      integrator, number of passes, first pass, ε | origin | drag stage
//! segments    rotation | translation | local stage | global stage       a stage: first field, count, steps
//! springs     p, r_o | q
//! drags       p, r_o | q | segments
//! passes      first field, count, steps
//! collisions  kind, first share, shape | d, width | gauge or centre, rounding or inner | rotation | translation | shape | patch, its width | spread
//! shares      of four segments a row                                 none where all skin takes all
//! triangles   plane | corner | corner | corner                          of each convex hull in use, once
//! ```
//!
//! Everything is written relative to an origin near the body, which the shader adds to the result: far from the world's
//! origin the differences that normals are made of would drown in rounding.

use std::sync::Arc;

use crate::elastic::{CollisionField, Palette, SpringStage};
use crate::field::{ConvexHull, Integrator, PartShape};
use crate::math::{Pose, Vec3};

/// Rows of the header, of one segment, one spring field, one drag field, one collision field and one hull triangle.
pub(super) const HEADER: u32 = 3;
pub(super) const SEGMENT: u32 = 4;
pub(super) const SPRING: u32 = 2;
pub(super) const DRAG: u32 = 3;
pub(super) const COLLISION: u32 = 9;
pub(super) const TRIANGLE: u32 = 4;

/// Integration rules; anything else is the Runge-Kutta rule.
pub(super) const EULER: u32 = 0;
pub(super) const MIDPOINT: u32 = 1;
const RUNGE_KUTTA_4: u32 = 2;

/// Kinds of collision fields; anything else is the hugging field.
pub(super) const FIELD_SPHERE: u32 = 0;
const FIELD_HUGGING: u32 = 1;

/// Kinds of shapes; anything else is the point.
pub(super) const SHAPE_SEGMENT: u32 = 1;
pub(super) const SHAPE_CUBOID: u32 = 2;
pub(super) const SHAPE_CYLINDER: u32 = 3;
pub(super) const SHAPE_CONE: u32 = 4;
pub(super) const SHAPE_HALF_SPACE: u32 = 5;
pub(super) const SHAPE_HULL: u32 = 6;
const SHAPE_POINT: u32 = 0;

/// One row: sixteen bytes, of whole numbers or of the bits of real ones.
pub(super) type Row = [u32; 4];

/// Packs `palette` into `rows`, which are cleared first. `epsilon` is the step of the tangent points.
pub(super) fn pack(palette: &Palette, epsilon: f32, origin: Vec3, rows: &mut Vec<Row>) {
    let stages = || palette.segments.iter().flat_map(|entry| [&entry.local, &entry.global]);
    let first_spring = HEADER + SEGMENT * count(palette.segments.len());
    let first_drag = first_spring + SPRING * stages().map(|stage| count(stage.fields.len())).sum::<u32>();
    let drags = &palette.drags;
    let first_pass = first_drag + DRAG * count(drags.fields.len());
    let first_collision = first_pass + count(palette.passes.len());
    let collisions = palette.passes.iter().map(|pass| count(pass.fields.len())).sum::<u32>();
    let first_share = first_collision + COLLISION * collisions;
    let fields = || palette.passes.iter().flat_map(|pass| &pass.fields);
    let shares = fields().map(|entry| share_rows(&entry.shares)).sum::<u32>();
    let mut hulls = Hulls { next: first_share + shares, packed: Vec::new() };

    rows.clear();
    let integrator = match palette.integrator {
        Integrator::Euler => EULER,
        Integrator::Midpoint => MIDPOINT,
        Integrator::RungeKutta4 => RUNGE_KUTTA_4,
    };
    rows.push([integrator, count(palette.passes.len()), first_pass, epsilon.to_bits()]);
    rows.push(real(origin, 0.0));
    rows.push([first_drag, count(drags.fields.len()), drags.steps, 0]);

    let mut next = first_spring;
    let mut stage_row = |stage: &SpringStage| {
        let first = next;
        next += SPRING * count(stage.fields.len());
        [first, count(stage.fields.len()), stage.steps, 0]
    };
    for entry in &palette.segments {
        rows.extend(pose_rows(entry.motion, origin));
        rows.push(stage_row(&entry.local));
        rows.push(stage_row(&entry.global));
    }
    for field in stages().flat_map(|stage| &stage.fields) {
        rows.push(real(field.p - origin, field.radius));
        rows.push(real(field.q - origin, 0.0));
    }
    for drag in &drags.fields {
        rows.push(real(drag.field.p - origin, drag.field.radius));
        rows.push(real(drag.field.q - origin, 0.0));
        rows.push(drag.segments.map(u32::from));
    }
    let mut next = first_collision;
    for pass in &palette.passes {
        rows.push([next, count(pass.fields.len()), pass.steps, 0]);
        next += COLLISION * count(pass.fields.len());
    }
    let mut next = first_share;
    for entry in fields() {
        let first = if entry.shares.is_empty() { 0 } else { next };
        next += share_rows(&entry.shares);
        rows.extend(collision_rows(first, &entry.field, origin, &mut hulls));
    }
    for four in fields().flat_map(|entry| entry.shares.chunks(4)) {
        rows.push(std::array::from_fn(|i| four.get(i).copied().unwrap_or(0.0).to_bits()));
    }
    for hull in hulls.packed {
        for (&(normal, offset), corners) in hull.0.planes().iter().zip(hull.0.triangles()) {
            rows.push(real(normal, offset));
            rows.extend(corners.map(|corner| real(corner, 0.0)));
        }
    }
}

/// Rows that the shares of a field take.
fn share_rows(shares: &[f32]) -> u32 {
    count(shares.len().div_ceil(4))
}

fn collision_rows<'a>(
    first_share: u32,
    field: &'a CollisionField,
    origin: Vec3,
    hulls: &mut Hulls<'a>,
) -> [Row; COLLISION as usize] {
    match field {
        CollisionField::Sphere(field) => {
            let mut rows = [Row::default(); COLLISION as usize];
            rows[0] = [FIELD_SPHERE, first_share, SHAPE_POINT, 0];
            rows[1] = real(field.d, field.outer);
            rows[2] = real(field.centre - origin, field.inner);
            rows
        }
        CollisionField::Hugging(field) => {
            let (shape, one, two) = match &field.part.part().shape {
                PartShape::Point => (SHAPE_POINT, Row::default(), Row::default()),
                PartShape::Segment { a, b } => (SHAPE_SEGMENT, real(*a, 0.0), real(*b, 0.0)),
                PartShape::Cuboid { half_extents } => (SHAPE_CUBOID, real(*half_extents, 0.0), Row::default()),
                PartShape::Cylinder { half_height, radius } => {
                    (SHAPE_CYLINDER, [half_height.to_bits(), radius.to_bits(), 0, 0], Row::default())
                }
                PartShape::Cone { half_height, radius } => {
                    (SHAPE_CONE, [half_height.to_bits(), radius.to_bits(), 0, 0], Row::default())
                }
                PartShape::HalfSpace { normal } => (SHAPE_HALF_SPACE, real(*normal, 0.0), Row::default()),
                PartShape::Hull(hull) => (
                    SHAPE_HULL,
                    [hulls.place(hull), count(hull.planes().len()), hull.rounding_error().to_bits(), 0],
                    Row::default(),
                ),
            };
            let [rotation, translation] = pose_rows(*field.part.pose(), origin);
            [
                [FIELD_HUGGING, first_share, shape, 0],
                real(field.d, field.width),
                real(field.gauge - origin, field.part.part().rounding),
                rotation,
                [translation[0], translation[1], translation[2], field.patch.width.to_bits()],
                one,
                two,
                real(field.patch.centre - origin, field.patch.radius.min(f32::MAX)),
                real(field.spread.along, field.spread.share),
            ]
        }
    }
}

/// The hulls met so far and where each begins: a hull that several fields use is packed once.
struct Hulls<'a> {
    next: u32,
    packed: Vec<(&'a Arc<ConvexHull>, u32)>,
}

impl<'a> Hulls<'a> {
    fn place(&mut self, hull: &'a Arc<ConvexHull>) -> u32 {
        if let Some((_, first)) = self.packed.iter().find(|(other, _)| Arc::ptr_eq(other, hull)) {
            return *first;
        }
        let first = self.next;
        self.next += TRIANGLE * count(hull.planes().len());
        self.packed.push((hull, first));
        first
    }
}

fn pose_rows(pose: Pose, origin: Vec3) -> [Row; 2] {
    [pose.rotation.to_array().map(f32::to_bits), real(pose.translation - origin, 0.0)]
}

fn real(v: Vec3, w: f32) -> Row {
    [v.x, v.y, v.z, w].map(f32::to_bits)
}

/// Lengths of a palette that fits a device are far below 2³²; a longer one is caught by its size in bytes.
fn count(length: usize) -> u32 {
    u32::try_from(length).unwrap_or(u32::MAX)
}
