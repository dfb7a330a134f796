//! Models the bodies that move by themselves and writes their meshes, skins and rigs to `assets`; the same bytes each time.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use pliant::mesh::{TetrahedralFormat, TetrahedralMesh, write_tetrahedral};
use pliant::procdef::{load_motion_rig, write_motion_rig};
use pliant_demos::modeller::mesh::Mesh;
use pliant_demos::modeller::obj;
use pliant_demos::modeller::soft::cells::Cells;
use pliant_demos::modeller::soft::{bar, bowel, heart, jellyfish, rigs, shell, snail, worm};
use pliant_demos::modeller::subdivide::subdivided;

fn main() -> Result<()> {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets");
    let folder = std::env::args_os().nth(1).map_or(own, PathBuf::from);
    let (meshes, rig_files) = (folder.join("meshes"), folder.join("rigs"));
    for folder in [&meshes, &rig_files] {
        std::fs::create_dir_all(folder).with_context(|| format!("creating {}", folder.display()))?;
    }
    let bodies: [(&str, Cells, Option<Cells>); 8] = [
        ("bar", bar::bar(4, 20), None),
        ("bowel", bowel::bowel(16, 33, 0.0), Some(bowel::bowel(40, 161, 0.12))),
        ("heart", heart::heart(heart::COARSE), Some(heart::heart(heart::FINE))),
        ("jellyfish", jellyfish::jellyfish(&jellyfish::LARGE), Some(jellyfish::jellyfish(&jellyfish::LARGE_SKIN))),
        (
            "small_jellyfish",
            jellyfish::jellyfish(&jellyfish::SMALL),
            Some(jellyfish::jellyfish(&jellyfish::SMALL_SKIN)),
        ),
        ("snail", snail::snail(&snail::COARSE), None),
        ("worm", worm::worm(&worm::LONG), Some(worm::worm(&worm::LONG_SKIN))),
        ("short_worm", worm::worm(&worm::SHORT), Some(worm::worm(&worm::SHORT_SKIN))),
    ];
    for (name, cells, skin) in bodies {
        if let Some(skin) = skin {
            write_skin(&meshes.join(format!("{name}_skin.obj")), &skin.surface())?;
        }
        let mesh = cells.finish().with_context(|| name.to_string())?;
        write_tetrahedral(meshes.join(format!("{name}.mesh")), &mesh, TetrahedralFormat::Medit)?;
        tell(name, &mesh);
    }
    let snail = subdivided(&subdivided(&snail::snail(&snail::COARSE).surface()));
    write_skin(&meshes.join("snail_skin.obj"), &snail)?;
    write_skin(&meshes.join("snail_shell.obj"), &shell::shell(3000))?;
    for (name, rig) in rigs::rigs() {
        let path = rig_files.join(format!("{name}.toml"));
        write_motion_rig(&path, &rig)?;
        let read = load_motion_rig(&path)?;
        let doubtful = read.built.motion.fields().orientation.confidence.iter().filter(|c| **c < 0.5).count();
        eprintln!("{name}.toml: {doubtful} vertices whose directions come from their surroundings");
    }
    Ok(())
}

fn write_skin(path: &Path, skin: &Mesh) -> Result<()> {
    obj::write(skin, path).with_context(|| format!("writing {}", path.display()))?;
    let name = path.file_name().unwrap_or_default().display();
    let closed = if skin.is_closed() { "closed" } else { "OPEN" };
    eprintln!("{name}: {} vertices, {} triangles, {closed}", skin.positions.len(), skin.triangles.len());
    Ok(())
}

fn tell(name: &str, mesh: &TetrahedralMesh) {
    let [least, most] = mesh.dihedral_angles();
    let (vertices, cells, volume) = (mesh.vertex_count(), mesh.cells.len(), mesh.volume());
    eprintln!(
        "{name}.mesh: {vertices} vertices, {cells} cells, {volume:.3} m³, angles {least:.1} to {most:.1} degrees"
    );
}
