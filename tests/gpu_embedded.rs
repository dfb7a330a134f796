//! The embedded skin on the device against the processor: random deformations, also with cells that are flat or inside out.
//!
//! Without a device the tests say so and pass; with `PLIANT_REQUIRE_GPU=1` in the environment they fail instead.
#![cfg(feature = "gpu")]

#[path = "gpu/device.rs"]
#[allow(dead_code)] // it uses a part of it
mod device;
#[path = "common/icosphere.rs"]
mod icosphere;

use device::Gpu;
use fastrand::Rng;
use pliant::gpu::{EmbedPipeline, GpuEmbeddedBody, GpuEmbeddedSkin, GpuError};
use pliant::math::Vec3;
use pliant::mesh::{TetrahedralMesh, TriangleMesh, fill_surface};
use pliant::procdef::{DeformedSkin, EmbeddedSkin};

fn sphere(subdivisions: u32, radius: f32) -> TriangleMesh {
    let (points, triangles) = icosphere::icosphere(subdivisions);
    TriangleMesh::from_triangles(points.into_iter().map(|p| p * radius).collect(), triangles).expect("a sphere")
}

fn ball() -> (TetrahedralMesh, EmbeddedSkin) {
    let body = fill_surface(&sphere(3, 0.5), 0.15).expect("cells").0;
    let skin = EmbeddedSkin::new(sphere(4, 0.52), &body).expect("a skin").0;
    (body, skin)
}

#[test]
fn the_device_deforms_an_embedded_skin_as_the_processor_does() {
    let Some(gpu) = Gpu::open() else { return };
    let (body, skin) = ball();
    let pipeline = EmbedPipeline::new(&gpu.device);
    let rest = GpuEmbeddedSkin::new(&gpu.device, &skin).expect("a skin");
    let mut buffers = GpuEmbeddedBody::new(&gpu.device, &rest);
    let mut rng = Rng::with_seed(8);
    let mut normals_moved = 0;
    for round in 0..6 {
        let amount = [0.0, 0.01, 0.05, 0.1, 0.3, 1.0][round];
        let nudge = |rng: &mut Rng| Vec3::from_array(std::array::from_fn(|_| rng.f32() - 0.5));
        let flat = if round == 3 { 0.0 } else { 1.0 };
        let positions: Vec<Vec3> = body
            .positions
            .iter()
            .map(|&x| Vec3::new(x.x, x.y * flat, x.z) + Vec3::X + nudge(&mut rng) * amount)
            .collect();
        let mut expected = DeformedSkin::default();
        skin.deform(&positions, &mut expected).expect("as many positions as vertices");
        let mut encoder = gpu.encoder();
        pipeline.encode(&gpu.device, &gpu.queue, &mut encoder, &mut buffers, &positions).expect("a body that fits");
        gpu.queue.submit([encoder.finish()]);
        let (x, n) = (gpu.read(buffers.positions()), gpu.read(buffers.normals()));
        assert_eq!((x.len(), n.len()), (expected.positions.len(), expected.normals.len()));
        for v in 0..x.len() {
            assert_eq!((x[v][3], n[v][3]), (1.0, 0.0));
            // Drivers may fuse a product and a sum: some roundings of numbers about 2.
            let off = Vec3::from_slice(&x[v][..3]).distance(expected.positions[v]);
            assert!(off < 3e-6, "round {round}, vertex {v}: {off}");
            // A normal is a quotient of cofactors, which cancel where cells are nearly flat.
            let turned = Vec3::from_slice(&n[v][..3]).distance(expected.normals[v]);
            assert!(turned < 1e-2, "round {round}, vertex {v}: {turned}");
            normals_moved += usize::from(expected.normals[v].distance(skin.skin().normals[v]) > 0.1);
        }
    }
    assert!(normals_moved > 1000, "{normals_moved}");
}

#[test]
fn another_number_of_positions_is_refused() {
    let Some(gpu) = Gpu::open() else { return };
    let (body, skin) = ball();
    let rest = GpuEmbeddedSkin::new(&gpu.device, &skin).expect("a skin");
    let mut buffers = GpuEmbeddedBody::new(&gpu.device, &rest);
    let positions = &body.positions[1..];
    let result =
        EmbedPipeline::new(&gpu.device).encode(&gpu.device, &gpu.queue, &mut gpu.encoder(), &mut buffers, positions);
    assert_eq!(result, Err(GpuError::BodyVertices { needed: positions.len() + 1, given: positions.len() }));
}
