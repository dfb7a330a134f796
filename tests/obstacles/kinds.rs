//! One obstacle of every kind that rapier has, each with the truth about it.

use pliant::math::{Pose, Vec3};
use rapier3d::geometry::{Array2, SharedShape};
use rapier3d::math::IVector;
use rapier3d::parry::query::PointQuery;
use rapier3d::parry::shape::{Cone, ConvexPolyhedron, Cuboid, Cylinder, Polyline, TriMesh, TriMeshFlags};

/// How far a point is below the surface of an obstacle, negative above.
pub type Truth = Box<dyn Fn(Vec3) -> f32>;

/// An obstacle around the origin, about one to three metres wide.
pub struct Kind {
    pub name: &'static str,
    pub shape: SharedShape,
    /// Depth of a point below the surface, negative outside.
    pub truth: Truth,
    /// Depth down to which the parts must fill the obstacle: less than all of it for surfaces, 0 for sheets.
    pub filled: f32,
    /// Where a ball is dropped onto it from above.
    pub drop_at: Vec3,
}

fn kind(name: &'static str, shape: SharedShape, truth: Truth, drop_at: Vec3) -> Kind {
    Kind { name, shape, truth, filled: f32::INFINITY, drop_at }
}

/// The depth by a shape's exact projection, widened by `border`.
fn widened(shape: impl PointQuery + 'static, border: f32) -> Truth {
    Box::new(move |x| {
        let projection = shape.project_local_point(x, false);
        let distance = projection.point.distance(x);
        border + if projection.is_inside { distance } else { -distance }
    })
}

/// The surface of a convex polyhedron, whose projection is exact.
fn faces(hull: &ConvexPolyhedron) -> TriMesh {
    let (points, triangles) = hull.to_trimesh();
    TriMesh::with_flags(points, triangles, TriMeshFlags::ORIENTED).expect("a closed surface")
}

fn deepest(truths: Vec<Truth>) -> Truth {
    Box::new(move |x| truths.iter().map(|truth| truth(x)).fold(f32::NEG_INFINITY, f32::max))
}

fn moved(by: Vec3, truth: Truth) -> Truth {
    Box::new(move |x| truth(x - by))
}

/// A wedge with a sharp edge on top.
fn wedge() -> Vec<Vec3> {
    let end = |z: f32| [Vec3::new(-0.7, -0.5, z), Vec3::new(0.8, -0.5, z), Vec3::new(0.1, 0.5, z)];
    [end(-0.8), end(0.8)].concat()
}

/// Rolling ground: heights at the corners of `cells` by `cells` squares over `width` metres.
pub fn hills(cells: usize, width: f32) -> Array2<f32> {
    let at = |i: usize| (i as f32 / cells as f32 - 0.5) * width;
    let height = |z: f32, x: f32| 0.15 * (2.1 * x).sin() * (1.7 * z).cos() + 0.05 * (5.0 * x + z).sin();
    let heights = (0..=cells).flat_map(|j| (0..=cells).map(move |i| height(at(i), at(j)))).collect();
    Array2::new(cells + 1, cells + 1, heights)
}

/// A ring that lies in the xz plane: closed, faces outward, convex outside and concave inside.
pub fn torus(radius: f32, thickness: f32, around: u32, across: u32) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let tau = std::f32::consts::TAU;
    let mut points = Vec::new();
    let mut triangles = Vec::new();
    for i in 0..around {
        for j in 0..across {
            let (u, v) = (tau * i as f32 / around as f32, tau * j as f32 / across as f32);
            let r = radius + thickness * v.cos();
            points.push(Vec3::new(r * u.cos(), thickness * v.sin(), r * u.sin()));
            let at = |i: u32, j: u32| (i % around) * across + j % across;
            triangles.extend([[at(i, j), at(i, j + 1), at(i + 1, j)], [at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)]]);
        }
    }
    (points, triangles)
}

/// A flat square sheet of `cells` by `cells` squares in the xz plane, facing up.
pub fn sheet(cells: u32, width: f32) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let at = |i: u32| (i as f32 / cells as f32 - 0.5) * width;
    let points = (0..=cells).flat_map(|j| (0..=cells).map(move |i| Vec3::new(at(i), 0.0, at(j)))).collect();
    let mut triangles = Vec::new();
    for j in 0..cells {
        for i in 0..cells {
            let corner = |i: u32, j: u32| j * (cells + 1) + i;
            let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i, j + 1), corner(i + 1, j + 1)];
            triangles.extend([[a, c, b], [b, c, d]]);
        }
    }
    (points, triangles)
}

fn trimesh((points, triangles): (Vec<Vec3>, Vec<[u32; 3]>), flags: TriMeshFlags) -> SharedShape {
    SharedShape::trimesh_with_flags(points, triangles, flags).expect("a mesh")
}

/// Depth below a heightfield of 4 m by 4 m, along the vertical: at least the true depth, but not beyond the rim.
fn below_ground(shape: &SharedShape) -> Truth {
    let shape = shape.clone();
    Box::new(move |x| {
        let field = shape.as_heightfield().expect("a heightfield");
        let rim = (2.0 - x.x.abs()).min(2.0 - x.z.abs());
        // On the rim, and outside by rounding, the ground is that beside it.
        let x = x.clamp(Vec3::new(-1.9999, x.y, -1.9999), Vec3::new(1.9999, x.y, 1.9999));
        let inside = field.cell_at_point(x).map(|(i, j)| field.triangles_at(i, j));
        let height = |triangle: &rapier3d::parry::shape::Triangle| {
            let [a, b, c] = *triangle.vertices();
            let side = |p: Vec3, q: Vec3| (q - p).with_y(0.0).cross((x - p).with_y(0.0)).y;
            let (ab, bc, ca) = (side(a, b), side(b, c), side(c, a));
            let within = (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
            let sum = ab + bc + ca;
            within.then(|| (a.y * bc + b.y * ca + c.y * ab) / sum)
        };
        let (one, other) = inside.unwrap_or((None, None));
        let ground = one.as_ref().and_then(height).or_else(|| other.as_ref().and_then(height));
        ground.map_or(f32::NEG_INFINITY, |ground| (ground - x.y).min(rim))
    })
}

/// All kinds.
pub fn all() -> Vec<Kind> {
    let up = Vec3::Y;
    let hull = ConvexPolyhedron::from_convex_hull(&wedge()).expect("a wedge");
    let triangle = [Vec3::new(-1.0, 0.0, -0.9), Vec3::new(0.1, 0.1, 1.1), Vec3::new(1.1, 0.0, -0.8)];
    let [a, b, c] = triangle;
    let (half, segment) = (Vec3::new(0.8, 0.3, 0.6), [Vec3::new(-1.0, 0.0, 0.1), Vec3::new(1.0, 0.2, 0.0)]);
    let line = vec![Vec3::new(-1.2, 0.2, 0.0), Vec3::new(0.0, 0.0, 0.1), Vec3::new(1.2, 0.3, 0.0)];
    let ground = SharedShape::heightfield(hills(40, 4.0), Vec3::new(4.0, 1.0, 4.0));
    let ring = torus(0.8, 0.35, 32, 16);
    let closed = TriMesh::with_flags(ring.0.clone(), ring.1.clone(), TriMeshFlags::ORIENTED).expect("a torus");
    let steps: Vec<IVector> = (-6..6)
        .flat_map(|x: i32| (-4..4).flat_map(move |z| (-3..=x.div_euclid(3)).map(move |y| IVector::new(x, y, z))))
        .collect();
    let cell = 0.15;
    let step = move |v: &IVector| {
        let centre = (v.as_vec3() + 0.5) * cell;
        moved(centre, widened(Cuboid::new(Vec3::splat(0.5 * cell)), 0.0))
    };
    let stairs = deepest(steps.iter().map(step).collect());
    let arms = [
        (Pose::from_translation(up * 0.1), SharedShape::ball(0.5)),
        (Pose::IDENTITY, SharedShape::cuboid(1.0, 0.2, 0.2)),
    ];
    let cross = deepest(vec![
        moved(up * 0.1, widened(rapier3d::parry::shape::Ball::new(0.5), 0.0)),
        widened(Cuboid::new(Vec3::new(1.0, 0.2, 0.2)), 0.0),
    ]);
    let round = |name, shape, truth: Truth| kind(name, shape, truth, up);
    let no_depth = |mut kind: Kind| {
        kind.filled = 0.0;
        kind
    };
    vec![
        kind("ball", SharedShape::ball(0.7), Box::new(|x| 0.7 - x.length()), up * 1.4),
        kind(
            "capsule",
            SharedShape::capsule_x(0.8, 0.3),
            widened(rapier3d::parry::shape::Segment::new(Vec3::X * -0.8, Vec3::X * 0.8), 0.3),
            up,
        ),
        kind("cuboid", SharedShape::cuboid(half.x, half.y, half.z), widened(Cuboid::new(half), 0.0), up),
        kind("cylinder", SharedShape::cylinder(0.4, 0.8), widened(Cylinder::new(0.4, 0.8), 0.0), up),
        kind("cone", SharedShape::cone(0.6, 0.9), widened(Cone::new(0.6, 0.9), 0.0), up * 1.3 + Vec3::X * 0.3),
        round(
            "round cuboid",
            SharedShape::round_cuboid(0.7, 0.2, 0.5, 0.1),
            widened(Cuboid::new(Vec3::new(0.7, 0.2, 0.5)), 0.1),
        ),
        round("round cylinder", SharedShape::round_cylinder(0.3, 0.7, 0.1), widened(Cylinder::new(0.3, 0.7), 0.1)),
        Kind {
            drop_at: up * 1.3 + Vec3::X * 0.3,
            ..round("round cone", SharedShape::round_cone(0.5, 0.8, 0.1), widened(Cone::new(0.5, 0.8), 0.1))
        },
        round("hull", SharedShape::convex_hull(&wedge()).expect("a wedge"), widened(faces(&hull), 0.0)),
        round(
            "round hull",
            SharedShape::round_convex_hull(&wedge(), 0.1).expect("a wedge"),
            widened(faces(&hull), 0.1),
        ),
        round(
            "round triangle",
            SharedShape::round_triangle(a, b, c, 0.15),
            widened(rapier3d::parry::shape::Triangle::new(a, b, c), 0.15),
        ),
        no_depth(round(
            "triangle",
            SharedShape::triangle(a, b, c),
            widened(rapier3d::parry::shape::Triangle::new(a, b, c), 0.0),
        )),
        no_depth(round(
            "segment",
            SharedShape::segment(segment[0], segment[1]),
            widened(rapier3d::parry::shape::Segment::new(segment[0], segment[1]), 0.0),
        )),
        no_depth(round("polyline", SharedShape::polyline(line.clone(), None), widened(Polyline::new(line, None), 0.0))),
        kind(
            "half-space",
            SharedShape::halfspace(Vec3::new(0.2, 1.0, 0.0).normalize()),
            Box::new(|x| -x.dot(Vec3::new(0.2, 1.0, 0.0).normalize())),
            up * 0.7,
        ),
        round("compound", SharedShape::compound(arms.to_vec()), cross),
        Kind { filled: 0.5, ..round("heightfield", ground.clone(), below_ground(&ground)) },
        Kind {
            filled: 0.1,
            drop_at: up + Vec3::X * 0.8,
            ..round("closed triangle mesh", trimesh(ring, TriMeshFlags::empty()), widened(closed, 0.0))
        },
        Kind {
            filled: 0.5,
            ..round(
                "oriented triangle mesh",
                trimesh(sheet(6, 3.0), TriMeshFlags::ORIENTED),
                Box::new(|x| (-x.y).min(1.5 - x.x.abs()).min(1.5 - x.z.abs())),
            )
        },
        no_depth(round(
            "sheet",
            trimesh(sheet(6, 3.0), TriMeshFlags::empty()),
            Box::new(|x| -x.y.abs().max(x.x.abs() - 1.5).max(x.z.abs() - 1.5)),
        )),
        Kind {
            drop_at: Vec3::new(-0.1, 1.0, 0.0),
            ..round("voxels", SharedShape::voxels(Vec3::splat(cell), &steps), stairs)
        },
    ]
}
