//! Rig files of bodies that move by themselves: TOML, read into a mesh with its motion, and written.

use super::rig_build::{BuiltMotion, fault};
use super::rig_description::RigDescription;
use super::rig_fault::{MotionRigFault, MotionRigFaultKind as Kind, MotionRigPlace as Place};
use crate::files::{TomlError, TomlText};
use crate::mesh::{
    AtomicFile, FillReport, TetrahedralError, TetrahedralMesh, TriangleMesh, fill_closely, fill_surface, load_obj,
    load_tetrahedral,
};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Why a rig file cannot be used or written.
#[derive(Debug, thiserror::Error)]
pub enum MotionRigError {
    /// The file cannot be read or is not the TOML of a rig.
    #[error(transparent)]
    Toml(#[from] TomlError),
    /// The rig that it describes is wrong.
    #[error("{}:{line}: {fault}", path.display())]
    Rig {
        /// The rig file.
        path: PathBuf,
        /// The line of the value at fault, from 1.
        line: usize,
        /// What is wrong.
        #[source]
        fault: Box<MotionRigFault>,
    },
    /// The file cannot be written.
    #[error("{}: cannot be written: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
}

/// A rig file with all that it names.
#[derive(Clone, Debug)]
pub struct MotionRigFile {
    /// What the file says.
    pub description: RigDescription,
    /// Its cells. [`TetrahedralMesh::dihedral_angles`] tells the worst of them.
    pub mesh: TetrahedralMesh,
    /// How well the cells fill the surface, where they were made for one.
    pub fill: Option<FillReport>,
    /// The surface that is drawn, if the file names one.
    pub skin: Option<TriangleMesh>,
    /// Its fields and charts.
    pub built: BuiltMotion,
    /// The shape of each attachment, where it has one.
    pub attachments: Vec<Option<TriangleMesh>>,
}

/// Reads a rig file and the meshes that it names (relative to the file), paints its fields and checks everything.
///
/// # Errors
/// Each fault of the file, of the meshes or of the rig, with file and line.
pub fn load_motion_rig(path: impl AsRef<Path>) -> Result<MotionRigFile, MotionRigError> {
    let text = TomlText::read(path)?;
    let description: RigDescription = text.parse()?;
    read(&text, description).map_err(|fault| MotionRigError::Rig {
        path: text.path().into(),
        line: text.line_of(&fault.place.keys()),
        fault: Box::new(fault),
    })
}

fn read(text: &TomlText, description: RigDescription) -> Result<MotionRigFile, MotionRigFault> {
    let (mesh, fill) = mesh(text, &description)?;
    let surface = |place, path: &PathBuf| load_obj(text.resolve(path)).map_err(|e| fault(place, e));
    let skin = description.skin.as_ref().map(|path| surface(Place::root("skin"), path)).transpose()?;
    let attachments = description.attachment.iter().enumerate();
    let attachments = attachments
        .map(|(i, a)| a.mesh.as_ref().map(|path| surface(Place::entry("attachment", i, "mesh"), path)).transpose())
        .collect::<Result<_, _>>()?;
    let built = description.build(&mesh)?;
    Ok(MotionRigFile { description, mesh, fill, skin, built, attachments })
}

/// The mesh that a rig names: cells from a file, or a closed surface that is filled with them.
fn mesh(
    text: &TomlText,
    description: &RigDescription,
) -> Result<(TetrahedralMesh, Option<FillReport>), MotionRigFault> {
    let path = text.resolve(&description.mesh);
    let is_surface = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("obj"));
    match (is_surface, description.cell_size) {
        (false, None) => load_tetrahedral(path).map(|mesh| (mesh, None)).map_err(|e| fault(Place::root("mesh"), e)),
        (false, Some(_)) => Err(fault(Place::root("cell_size"), Kind::CellSize)),
        (true, cell_size) => {
            if let Some(cell) = cell_size {
                super::rig_checks::cell_size(cell)?;
            }
            let unusable = |e| fault(Place::root("mesh"), e);
            let surface = load_obj(path).map_err(|e| fault(Place::root("mesh"), e))?;
            let (mesh, report) = match cell_size {
                Some(cell) => fill_surface(&surface, cell),
                None => fill_closely(&surface),
            }
            .map_err(unusable)?;
            if report.follows() {
                return Ok((mesh, Some(report)));
            }
            let (distance, percent) = (report.hausdorff, 100.0 * report.relative);
            let error =
                TetrahedralError::NotFollowed { cell_size: cell_size.unwrap_or(report.cell_size), distance, percent };
            Err(fault(Place::root(if cell_size.is_some() { "cell_size" } else { "mesh" }), error))
        }
    }
}

/// Writes a rig file; what is read from it again is equal to the description. Comments of an old file are lost.
///
/// # Errors
/// The file cannot be written; an old one stays as it was.
pub fn write_motion_rig(path: impl AsRef<Path>, description: &RigDescription) -> Result<(), MotionRigError> {
    let path = path.as_ref();
    let failed = |source| MotionRigError::Write { path: path.into(), source };
    let text = toml::to_string(description).map_err(|e| failed(std::io::Error::other(e)))?;
    let mut file = AtomicFile::create(path).map_err(failed)?;
    file.write_all(text.as_bytes()).map_err(failed)?;
    file.finish().map_err(failed)
}
