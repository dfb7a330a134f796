//! Models the meshes of the demos and writes them to `assets/meshes`; the same bytes each time.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use pliant_demos::modeller::camel::camel;
use pliant_demos::modeller::head::head;
use pliant_demos::modeller::icosphere::icosphere;
use pliant_demos::modeller::mesh::Mesh;
use pliant_demos::modeller::obj;
use pliant_demos::modeller::quality::Quality;
use pliant_demos::modeller::rock::rock;
use pliant_demos::modeller::toys::{bean, die};

fn main() -> Result<()> {
    let folder = folder();
    std::fs::create_dir_all(&folder).with_context(|| format!("creating {}", folder.display()))?;
    write(&folder.join("ball.obj"), &icosphere(0.5, 4))?;
    write(&folder.join("rock.obj"), &rock())?;
    write(&folder.join("die.obj"), &die())?;
    write(&folder.join("bean.obj"), &bean())?;
    write(&folder.join("head.obj"), &head())?;
    write(&folder.join("camel.obj"), &camel())
}

/// The folder of the meshes: the one named on the command line, or `assets/meshes`.
fn folder() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/meshes");
    std::env::args_os().nth(1).map_or(own, PathBuf::from)
}

/// Writes one mesh and says how good it is.
fn write(path: &Path, mesh: &Mesh) -> Result<()> {
    obj::write(mesh, path).with_context(|| format!("writing {}", path.display()))?;
    let name = path.file_name().unwrap_or_default().display();
    let (points, triangles) = (mesh.positions.len(), mesh.triangles.len());
    let (area, volume) = (mesh.area(), mesh.volume());
    eprintln!("{name}: {points} vertices, {triangles} triangles, {area:.3} m², {volume:.3} m³");
    eprintln!("  {:?}", Quality::of(mesh));
    Ok(())
}
