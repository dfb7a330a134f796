use super::*;
use crate::mesh::measure;

/// A cube of side 1 cut into six cells about its diagonal.
fn cube() -> TetrahedralMesh {
    let p = (0..8).map(|i| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32)).collect();
    let cells = vec![[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]];
    TetrahedralMesh::new(p, cells).unwrap()
}

#[test]
fn the_boundary_of_a_cube_is_closed_faces_outward_and_encloses_its_volume() {
    let mesh = cube();
    let boundary = mesh.boundary();
    assert_eq!(boundary.len(), 12);
    // Six cells of a sixth each, exact in f64.
    assert!((mesh.volume() - 1.0).abs() < 1e-12);
    assert!((measure::signed_volume(&mesh.positions, &boundary) - 1.0).abs() < 1e-12);
    assert!((measure::surface_area(&mesh.positions, &boundary) - 6.0).abs() < 1e-12);
    assert_eq!(mesh.surface_vertices(), [0, 1, 2, 3, 4, 5, 6, 7]);
    assert!((mesh.vertex_volumes().iter().sum::<f64>() - 1.0).abs() < 1e-12);
}

#[test]
fn neighbours_are_those_of_shared_cells_and_mutual() {
    let lists = cube().neighbours();
    assert_eq!(lists.len(), 8);
    assert_eq!(lists.of(0), [1, 2, 3, 4, 5, 6, 7]);
    // No cell holds two opposite corners other than 0 and 7.
    assert_eq!(lists.of(1), [0, 3, 5, 7]);
    for v in 0..8u32 {
        assert!(lists.of(v as usize).iter().all(|&n| lists.of(n as usize).contains(&v)));
    }
    assert!(lists.of(8).is_empty());
}

#[test]
fn dihedral_angles_of_the_cube_cut_about_its_diagonal_are_45_to_90_degrees() {
    let [least, most] = cube().dihedral_angles();
    // Exact angles; f64 rounding in acos.
    assert!((least - 45.0).abs() < 1e-6 && (most - 90.0).abs() < 1e-6, "{least} {most}");
}

#[test]
fn bad_arrays_are_refused_with_the_vertex_or_cell_at_fault() {
    let p = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
    let message = |p: Vec<Vec3>, c: Vec<[u32; 4]>| TetrahedralMesh::new(p, c).unwrap_err().to_string();
    assert!(message(vec![], vec![[0, 1, 2, 3]]).contains("no vertices"));
    assert!(message(p.clone(), vec![]).contains("no tetrahedra"));
    assert!(message(p.clone(), vec![[0, 1, 2, 3], [0, 1, 2, 9]]).contains("cell 1 uses vertex 9"));
    assert!(message(p.clone(), vec![[0, 2, 1, 3]]).contains("cell 0 has the volume -1.6"));
    assert!(message(p.clone(), vec![[0, 1, 2, 2]]).contains("cell 0 has the volume"));
    assert!(message([p.clone(), vec![Vec3::ONE]].concat(), vec![[0, 1, 2, 3]]).contains("vertex 4 belongs to no cell"));
    let infinite = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::INFINITY];
    assert!(message(infinite, vec![[0, 1, 2, 3]]).contains("vertex 3"));
    let three = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::Z * 2.0, Vec3::Z * 3.0];
    let error = message(three, vec![[0, 1, 2, 3], [0, 1, 2, 4], [0, 1, 2, 5]]);
    assert!(error.contains("more than two cells") && error.contains("cell 2"), "{error}");
}
