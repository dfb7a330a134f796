//! The checks of a rig's numbers, those of the world included.

use super::rig_build::fault;
use super::rig_description::RigDescription;
use super::rig_fault::{MotionRigFault, MotionRigFaultKind as Kind, MotionRigPlace as Place};
use crate::math::Vec3;
use crate::mesh::TetrahedralMesh;

type Check = Result<(), MotionRigFault>;

fn within(place: Place, value: Option<f32>, least: f32, most: f32, range: &'static str) -> Check {
    match value {
        Some(value) if !(least..=most).contains(&value) => Err(fault(place, Kind::OutOfRange { value, range })),
        _ => Ok(()),
    }
}

fn positive(place: Place, value: Option<f32>) -> Check {
    within(place, value, 1.0e-6, 1.0e9, "a finite number above 0 (1e-6 to 1e9)")
}

fn not_negative(place: Place, value: f32) -> Check {
    within(place, Some(value), 0.0, 1.0e9, "a finite number of at least 0 (and at most 1e9)")
}

fn share(place: Place, value: Option<f32>) -> Check {
    within(place, value, 0.0, 1.0, "from 0 to 1")
}

fn colour(place: Place, colour: Option<[f32; 3]>) -> Check {
    colour.into_iter().flatten().try_for_each(|c| share(place, Some(c)))
}

/// Checks everything but fields and charts.
pub(super) fn check(rig: &RigDescription, mesh: &TetrahedralMesh) -> Check {
    body(rig)?;
    rise(rig)?;
    stimulus(rig)?;
    world(rig)?;
    attachments(rig, mesh)
}

fn body(rig: &RigDescription) -> Check {
    positive(Place::root("cell_size"), rig.cell_size)?;
    positive(Place::root("mass"), rig.mass)?;
    positive(Place::root("density"), rig.density)?;
    match (rig.mass, rig.density) {
        (Some(_), Some(_)) => return Err(fault(Place::root("density"), Kind::MassOrDensity("both"))),
        (None, None) => return Err(fault(Place::root(""), Kind::MassOrDensity("neither"))),
        _ => {}
    }
    within(Place::root("iterations"), rig.iterations.map(|n| n as f32), 1.0, 64.0, "from 1 to 64")?;
    share(Place::root("stiffness"), rig.stiffness)?;
    share(Place::root("least_volume"), rig.least_volume)?;
    if rig.iterations.is_some() && rig.stiffness.is_some() {
        return Err(fault(Place::root("stiffness"), Kind::StiffnessForm));
    }
    rig.damping.map_or(Ok(()), |v| not_negative(Place::root("damping"), v))?;
    colour(Place::root("colour"), rig.colour)
}

fn rise(rig: &RigDescription) -> Check {
    let rise = rig.charts.as_ref().and_then(|charts| charts.rise);
    within(Place::table("charts", "rise"), rise, 0.0, 1.0e6, "from 0 to 1e6 s")
}

fn stimulus(rig: &RigDescription) -> Check {
    let Some(stimulus) = &rig.stimulus else { return Ok(()) };
    let at = |key| Place::table("stimulus", key);
    within(at("speed"), Some(stimulus.speed), 1.0e-3, 1.0e6, "from 1e-3 to 1e6 lengths of the body a second")?;
    within(at("damping"), Some(stimulus.damping), 1.0, 1.0e6, "from 1 to 1e6")?;
    stimulus.threshold.map_or(Ok(()), |v| not_negative(at("threshold"), v))?;
    stimulus.refractory.map_or(Ok(()), |v| not_negative(at("refractory"), v))
}

fn world(rig: &RigDescription) -> Check {
    if let Some(contact) = &rig.contact {
        not_negative(Place::table("contact", "friction"), contact.friction)?;
    }
    if let Some(water) = &rig.water {
        not_negative(Place::table("water", "density"), water.density)?;
        not_negative(Place::table("water", "normal_drag"), water.normal_drag)?;
        not_negative(Place::table("water", "tangential_drag"), water.tangential_drag)?;
    }
    if let Some(ground) = &rig.ground {
        let direction = Vec3::from(ground.direction);
        let place = Place::table("ground", "direction");
        if !direction.is_finite() {
            return Err(fault(place, Kind::NotFinite));
        }
        positive(place, Some(direction.length()))?;
        not_negative(Place::table("ground", "forward"), ground.forward)?;
        not_negative(Place::table("ground", "backward"), ground.backward)?;
        not_negative(Place::table("ground", "sideways"), ground.sideways)?;
    }
    Ok(())
}

fn attachments(rig: &RigDescription, mesh: &TetrahedralMesh) -> Check {
    for (i, a) in rig.attachment.iter().enumerate() {
        let at = |key| Place::entry("attachment", i, key);
        if a.name.trim().is_empty() || rig.attachment[..i].iter().any(|b| b.name == a.name) {
            return Err(fault(at("name"), Kind::Name));
        }
        positive(at("mass"), a.mass)?;
        positive(at("radius"), Some(a.radius))?;
        colour(at("colour"), a.colour)?;
        let centre = Vec3::from(a.centre);
        if !centre.is_finite() {
            return Err(fault(at("centre"), Kind::NotFinite));
        }
        let nearest = mesh.positions.iter().map(|x| x.distance(centre)).fold(f32::INFINITY, f32::min);
        if nearest > a.radius {
            return Err(fault(at("radius"), Kind::HoldsNothing(nearest)));
        }
    }
    Ok(())
}

/// Checks the edge length of cells before it is used.
pub(super) fn cell_size(cell: f32) -> Check {
    positive(Place::root("cell_size"), Some(cell))
}
