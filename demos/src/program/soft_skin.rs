//! The surface of a body that moves by itself: its skin or a section, deformed with the cells and painted.
//!
//! Skins are deformed on the device, sections and what is drawn in the order of its triangles in memory.

use std::sync::Arc;

use glam::Vec3;
use pliant::gpu::GpuEmbeddedSkin;
use pliant::math::Pose;
use pliant::mesh::{TriangleMesh, weld};
use pliant::procdef::{DeformedSkin, EmbeddedSkin};

use super::creases::creased;
use super::device_skin::{DeviceSkin, SkinPasses};
use super::directions::Directions;
use super::fields::Field;
use super::moment::SoftMoment;
use super::section::{Cut, Section};
use crate::render::{MeshData, MeshId, Overlay, Paint, Renderer};
use crate::simulation::SoftKind;

/// Faces of a boundary that meet at more than this angle have an edge between them, in degrees.
const CREASE: f32 = 60.0;

/// What all bodies of a kind are drawn with.
pub struct SoftLook {
    kind: Arc<SoftKind>,
    surface: Surface,
    directions: Directions,
    /// The skin on the device, if it has a place there.
    device: Option<GpuEmbeddedSkin>,
}

enum Surface {
    /// The rig's own skin.
    Skin,
    /// The boundary with sharp edges.
    Creased(Box<EmbeddedSkin>),
    Section(Box<Section>),
}

/// One body on the device, and the buffers to bring it up to date.
pub struct SoftSkin {
    look: Arc<SoftLook>,
    place: SkinPlace,
    cells: Vec<Vec3>,
    excitations: Vec<f32>,
    deformed: DeformedSkin,
    values: Vec<f32>,
    paint: Vec<Paint>,
    order: Vec<(f32, [u32; 3])>,
}

enum SkinPlace {
    /// Deformed in memory, and uploaded.
    Memory(MeshId),
    /// Deformed where it is drawn.
    Device(Box<DeviceSkin>),
}

impl SoftLook {
    /// The look of a kind, cut open if so wished. `start` is where a body of it starts, `eye` where the scene's camera is:
    /// what is on that side of the cut is taken away.
    pub fn new(kind: &Arc<SoftKind>, cut: Option<Cut>, start: &Pose, eye: Vec3) -> Self {
        let mesh = kind.model.rig.mesh();
        let section = cut.map(|cut| Section::new(mesh, &kind.model.boundary, cut, start.inverse_transform_point(eye)));
        let surface = match section {
            Some(Ok(section)) => Surface::Section(Box::new(section)),
            _ if kind.has_skin => Surface::Skin,
            _ => sharp(kind).map_or(Surface::Skin, |skin| Surface::Creased(Box::new(skin))),
        };
        Self { kind: kind.clone(), directions: Directions::new(&kind.model), surface, device: None }
    }

    /// The same with its skin on a device; as it was where that has no place for it.
    pub fn on(self, device: &wgpu::Device) -> Self {
        let skin = self.skin().and_then(|skin| GpuEmbeddedSkin::new(device, skin).ok());
        Self { device: skin, ..self }
    }

    fn skin(&self) -> Option<&EmbeddedSkin> {
        match &self.surface {
            Surface::Skin => Some(&self.kind.skin),
            Surface::Creased(skin) => Some(skin),
            Surface::Section(_) => None,
        }
    }

    fn triangles(&self) -> &[[u32; 3]] {
        match &self.surface {
            Surface::Section(section) => section.triangles(),
            _ => self.skin().map_or(&[], |skin| &skin.skin().triangles),
        }
    }

    fn vertex_count(&self) -> usize {
        match &self.surface {
            Surface::Section(section) => section.places().len(),
            _ => self.skin().map_or(0, |skin| skin.bindings().len()),
        }
    }

    /// Positions and normals for these positions of the cells; False where they do not fit.
    fn deform(&self, cells: &[Vec3], out: &mut DeformedSkin) -> bool {
        match (&self.surface, self.skin()) {
            (Surface::Section(section), _) => section.deform(cells, &mut out.positions, &mut out.normals).is_ok(),
            (_, Some(skin)) => skin.deform(cells, out).is_ok(),
            (_, None) => false,
        }
    }

    /// Values of the cells' vertices at those of the surface.
    fn spread(&self, values: &[f32], out: &mut Vec<f32>) {
        match (&self.surface, self.skin()) {
            (Surface::Section(section), _) => section.spread(values, out),
            (_, Some(skin)) => {
                out.clear();
                out.extend(skin.bindings().iter().map(|binding| {
                    let corners = binding.vertices.iter().zip(binding.weights);
                    corners.map(|(&v, weight)| values[v as usize] * weight).sum::<f32>()
                }));
            }
            (_, None) => out.clear(),
        }
    }
}

/// The boundary of a kind without a skin, its vertices split at sharp edges.
fn sharp(kind: &SoftKind) -> Option<EmbeddedSkin> {
    let plain = kind.skin.skin();
    let split = creased(&plain.positions, &plain.triangles, CREASE);
    let triangles = split.indices.as_chunks().0.to_vec();
    let welded = weld(&split.positions);
    let (positions, normals) = (split.positions, split.normals);
    let surface = TriangleMesh { positions, normals, texture: Vec::new(), triangles, welded };
    EmbeddedSkin::new(surface, kind.model.rig.mesh()).ok().map(|(skin, _)| skin)
}

impl SoftSkin {
    /// Makes the mesh of a body; with passes it is deformed by them, if its look is on the device.
    pub fn new(renderer: &mut Renderer, look: &Arc<SoftLook>, passes: Option<&Arc<SkinPasses>>) -> Self {
        let place = match (passes, &look.device) {
            (Some(passes), Some(skin)) => {
                SkinPlace::Device(Box::new(DeviceSkin::new(renderer, passes, skin, look.triangles())))
            }
            _ => {
                let count = look.vertex_count();
                SkinPlace::Memory(renderer.add_mesh(&MeshData {
                    positions: vec![Vec3::ZERO; count],
                    normals: vec![Vec3::Y; count],
                    indices: look.triangles().as_flattened().to_vec(),
                }))
            }
        };
        Self {
            look: look.clone(),
            place,
            cells: Vec::new(),
            excitations: Vec::new(),
            deformed: DeformedSkin::default(),
            values: Vec::new(),
            paint: Vec::new(),
            order: Vec::new(),
        }
    }

    /// Its mesh on the device.
    pub fn mesh(&self) -> MeshId {
        match &self.place {
            SkinPlace::Memory(mesh) => *mesh,
            SkinPlace::Device(skin) => skin.mesh(),
        }
    }

    /// Brings the triangles into the order in which they are seen from `eye`, the farthest first: a translucent body is
    /// drawn in it. The triangles, each with the square of its distance (times nine); none of a skin that is deformed on the
    /// device, whose places are not known.
    pub fn sort(&mut self, renderer: &Renderer, eye: Vec3) -> &[(f32, [u32; 3])] {
        self.order.clear();
        let SkinPlace::Memory(mesh) = self.place else { return &self.order };
        let x = &self.deformed.positions;
        let away = |t: &[u32; 3]| t.iter().map(|&v| x[v as usize]).sum::<Vec3>().distance_squared(3.0 * eye);
        self.order.extend(self.look.triangles().iter().map(|t| (away(t), *t)));
        self.order.sort_by(|a, b| b.0.total_cmp(&a.0));
        let sorted: Vec<[u32; 3]> = self.order.iter().map(|(_, t)| *t).collect();
        renderer.write_indices(mesh, sorted.as_flattened());
        &self.order
    }

    /// Uploads the place `alpha` between two moments of the body, painted with a field, and returns its mesh. Directions
    /// are added to the overlay.
    pub fn show(
        &mut self,
        renderer: &Renderer,
        moments: [&SoftMoment; 2],
        alpha: f32,
        field: Field,
        overlay: &mut Overlay,
    ) -> Option<MeshId> {
        let [from, to] = moments;
        self.cells.clear();
        self.cells.extend(from.positions.iter().zip(&to.positions).map(|(a, b)| a.lerp(*b, alpha)));
        self.excitations.clear();
        self.excitations.extend(from.excitations.iter().zip(&to.excitations).map(|(a, b)| a + alpha * (b - a)));
        self.paint.clear();
        match field.values(&self.look.kind, &self.excitations).filter(|values| values.len() == self.cells.len()) {
            Some(values) => {
                self.look.spread(values, &mut self.values);
                self.paint.extend(self.values.iter().map(|value| field.paint(*value)));
            }
            None if matches!(self.place, SkinPlace::Device(_)) => {}
            None => self.paint.resize(self.look.vertex_count(), Paint::default()),
        }
        match &mut self.place {
            SkinPlace::Device(skin) => skin.show(renderer, &self.cells, &self.paint).ok()?,
            SkinPlace::Memory(mesh) => {
                if !self.look.deform(&self.cells, &mut self.deformed) {
                    return None;
                }
                renderer.write_painted_mesh(*mesh, &self.deformed.positions, &self.deformed.normals, &self.paint);
            }
        }
        if field == Field::Directions {
            let model = &self.look.kind.model;
            match &self.look.surface {
                Surface::Section(section) => {
                    let sites = section.places().iter().copied().zip(self.deformed.normals.iter().copied());
                    self.look.directions.draw(model, &self.cells, sites, overlay);
                }
                _ => self.look.directions.draw_boundary(model, &self.cells, overlay),
            }
        }
        Some(self.mesh())
    }
}
