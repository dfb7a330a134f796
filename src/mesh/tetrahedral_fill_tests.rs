use super::*;
use crate::mesh::measure::tests::sphere;

fn cuboid(size: Vec3) -> TriangleMesh {
    let p = (0..8).map(|i| (Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32) - 0.5) * size).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let t = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    TriangleMesh::from_triangles(p, t).unwrap()
}

/// The boundary is closed and faces outward.
fn assert_sound(mesh: &TetrahedralMesh) {
    let boundary = TriangleMesh::from_triangles(mesh.positions.clone(), mesh.boundary()).unwrap();
    let topology = Topology::of(&boundary);
    assert!(topology.is_closed());
    assert_eq!(topology.orientation, Orientation::Outward);
    assert!(mesh.volumes().iter().all(|v| *v > 0.0));
}

#[test]
fn a_ball_of_a_thousand_vertices_follows_its_surface_within_two_percent_and_has_good_angles() {
    let ball = sphere(0.5, 64, 32);
    let (mesh, report) = fill_surface(&ball, 0.115).unwrap();
    assert!((800..1300).contains(&mesh.vertex_count()), "{}", mesh.vertex_count());
    assert!(report.hausdorff < 0.02 * ball.size(), "{report:?}");
    // Flat faces on a sphere lose h²/8r over each edge h: about 2 % of the volume.
    assert!((report.volume_ratio - 1.0).abs() < 0.03, "{report:?}");
    // The paper of the method has 10.7° and 164.8° without smoothing.
    assert!(report.dihedral_angles[0] > 20.0 && report.dihedral_angles[1] < 140.0, "{report:?}");
    assert_sound(&mesh);
}

#[test]
fn boxes_are_filled_soundly_and_cut_off_by_less_than_a_cell_at_their_edges() {
    let mut rng = fastrand::Rng::with_seed(2);
    let mut worst = 0.0f32;
    for _ in 0..40 {
        let size = Vec3::new(0.6 + rng.f32(), 0.6 + rng.f32(), 0.6 + rng.f32());
        let surface = cuboid(size);
        let cell = 0.12 + 0.1 * rng.f32();
        let (mesh, report) = fill_surface(&surface, cell).unwrap();
        assert_sound(&mesh);
        // A corner that is not caught is cut off, by less than a cell.
        assert!(report.hausdorff < cell, "{size}: {report:?}");
        assert!(report.dihedral_angles[0] > 5.0 && report.dihedral_angles[1] < 172.0, "{size}: {report:?}");
        worst = worst.max(report.hausdorff / cell);
    }
    println!("cut off by {worst} cells at most");
    // Where the lattice lies well, all edges are caught.
    let (_, report) = fill_surface(&cuboid(Vec3::ONE), 0.2).unwrap();
    assert!(report.hausdorff < 1e-4, "{report:?}");
}

#[test]
fn two_balls_are_filled_as_two_pieces() {
    let ball = sphere(0.5, 24, 12);
    let n = ball.positions.len() as u32;
    let p: Vec<Vec3> =
        ball.positions.iter().copied().chain(ball.positions.iter().map(|p| *p + Vec3::X * 3.0)).collect();
    let t: Vec<[u32; 3]> =
        ball.triangles.iter().copied().chain(ball.triangles.iter().map(|t| t.map(|v| v + n))).collect();
    let (mesh, report) = fill_surface(&TriangleMesh::from_triangles(p, t).unwrap(), 0.2).unwrap();
    assert!((report.volume_ratio - 1.0).abs() < 0.1, "{report:?}");
    assert_sound(&mesh);
}

#[test]
fn what_cannot_be_filled_is_refused_with_the_reason() {
    let mut open = sphere(0.5, 12, 8);
    let message = |mesh: &TriangleMesh, cell: f32| fill_surface(mesh, cell).unwrap_err().to_string();
    assert!(message(&open, 0.0).contains("choose another size"));
    assert!(message(&open, f32::NAN).contains("choose another size"));
    assert!(message(&open, -1.0).contains("choose another size"));
    assert!(message(&open, 1e-4).contains("choose another size"));
    open.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    assert!(message(&open, 0.2).contains("do not face outward"));
    open.triangles.pop();
    assert!(message(&open, 0.2).contains("not closed"));
}
