//! What the integration tests share: a soft ball made in code.
#![allow(dead_code)] // each test file uses a part of it

use std::collections::HashMap;
use std::sync::Arc;

use pliant::elastic::{ContactSettings, ElasticRig, MassSpringSetRig, Segment, SegmentMass, SegmentShape, SkinWeights};
use pliant::math::{Pose, Vec3};
use pliant::mesh::TriangleMesh;
use pliant::spring::SpringCoefficients;

/// A sphere from an icosahedron split `splits` times: 10·4^splits + 2 vertices (2,562 for 4).
pub fn icosphere(radius: f32, splits: u32) -> TriangleMesh {
    let phi = (1.0 + 5.0_f32.sqrt()) / 2.0;
    let mut points: Vec<Vec3> = Vec::new();
    for (a, b) in [(-1.0, phi), (1.0, phi), (-1.0, -phi), (1.0, -phi)] {
        points.push(Vec3::new(a, b, 0.0).normalize());
        points.push(Vec3::new(0.0, a, b).normalize());
        points.push(Vec3::new(b, 0.0, a).normalize());
    }
    // The hull of the twelve points is the icosahedron, oriented outward.
    let (corners, mut triangles) = parry3d::transformation::convex_hull(&points);
    points = corners;
    for _ in 0..splits {
        let mut middle: HashMap<(u32, u32), u32> = HashMap::new();
        let mut next = Vec::with_capacity(triangles.len() * 4);
        for [a, b, c] in triangles {
            let mut half = |i: u32, j: u32| {
                *middle.entry((i.min(j), i.max(j))).or_insert_with(|| {
                    points.push((points[i as usize] + points[j as usize]).normalize());
                    points.len() as u32 - 1
                })
            };
            let (ab, bc, ca) = (half(a, b), half(b, c), half(c, a));
            next.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
        }
        triangles = next;
    }
    TriangleMesh::from_triangles(points.into_iter().map(|p| p * radius).collect(), triangles).expect("a sphere")
}

/// A soft ball of one segment and one mass-spring set, centred at the origin.
pub fn ball_rig(radius: f32, softness: f32, contact: SpringCoefficients) -> Arc<ElasticRig> {
    let mesh = icosphere(radius, 4);
    let weights = vec![SkinWeights { segments: [0; 4], weights: [1.0, 0.0, 0.0, 0.0] }; mesh.positions.len()];
    Arc::new(ElasticRig {
        mesh,
        segments: vec![Segment {
            name: "ball".into(),
            bone: [Vec3::ZERO, Vec3::ZERO],
            shape: SegmentShape::Ball { radius },
            mass: SegmentMass::Mass(1.0),
        }],
        joints: Vec::new(),
        weights,
        sets: vec![MassSpringSetRig {
            segment: 0,
            also: Vec::new(),
            anchor: Vec3::ZERO,
            radius: 1.5 * radius,
            spring: SpringCoefficients::new(3.0, 0.2),
        }],
        softness,
        local_threshold: 0.5 * radius,
        contact: ContactSettings { spring: contact, friction: 0.5 },
        rest_poses: vec![Pose::IDENTITY],
    })
}
