//! The stage in which the vertices of bodies meet each other and rigid bodies.

use rapier3d::dynamics::RigidBodyHandle;
use rapier3d::geometry::ColliderHandle;
use rapier3d::pipeline::QueryFilter;

use super::procdef_stages::Visit;
use super::procdef_view::ProcDefView;
use super::procdef_world::ProcDefWorld;
use crate::coupling::ObstacleError;
use crate::coupling::procdef::{GroundFriction, MeetingBody, MeetingStep, Refused, meet};
use crate::math::Vec3;
use crate::procdef::ContactKind;

/// Bodies with a vertex that is faster than this, in m/s, meet nothing.
const FASTEST: f32 = 1.0e5;

impl ProcDefWorld {
    /// Bodies whose contacts are those of vertices are kept apart from all others, from rigid bodies and from the ground. The
    /// colliders that they cannot meet.
    pub(super) fn let_vertices_meet(
        &mut self,
        visits: &mut [Visit],
        rapier: &mut ProcDefView<'_>,
    ) -> Vec<(ColliderHandle, ObstacleError)> {
        let kinds = self.entries.iter().map(|(_, entry)| entry.model.contacts);
        if !(rapier.dt > 0.0 && rapier.dt.is_finite()) || kinds.into_iter().all(|kind| kind == ContactKind::Surfaces) {
            return Vec::new();
        }
        self.meetings.parts.retain(|handle| rapier.colliders.get(handle).is_some());
        let attached: Vec<Vec<RigidBodyHandle>> = self
            .entries
            .iter()
            .map(|(_, entry)| {
                let soft = rapier.soft_bodies.get(entry.link.soft_body);
                let mut handles: Vec<_> = soft.iter().flat_map(|s| s.particle_attachments()).map(|a| a.body).collect();
                handles.dedup();
                handles
            })
            .collect();
        let mut members = Vec::new();
        let mut bodies = Vec::new();
        for (place, ((index, entry), visit)) in self.entries.iter_mut().zip(visits.iter()).enumerate() {
            // What is not finite, or will not be for long, must not reach the others.
            let sane = |v: &Vec3| v.length_squared() < FASTEST * FASTEST;
            if visit.report.frozen.is_some() || !entry.body.velocities().iter().all(sane) {
                continue;
            }
            let turned = entry.is_turned();
            let friction = entry.model.ground.map_or(entry.model.friction, |g| g.least());
            members.push(place);
            bodies.push(MeetingBody {
                name: index.into_raw_parts(),
                body: &mut entry.body,
                surface: &entry.surface,
                groups: entry.groups,
                friction,
                ground: entry.directions.as_deref().map(|directions| GroundFriction { directions, turned }),
                attached: &attached[place],
                stood: !entry.meeting.ground.is_empty(),
                own_contacts: entry.model.contacts == ContactKind::Vertices,
            });
        }
        let step = MeetingStep { gravity: rapier.gravity, dt: rapier.dt, substeps: rapier.substeps };
        let mut refused = Refused::new();
        let query = rapier.broad_phase.as_query_pipeline(
            rapier.narrow_phase.query_dispatcher(),
            rapier.bodies,
            rapier.colliders,
            QueryFilter::default(),
        );
        let sets = (&*rapier.bodies, rapier.colliders);
        let (meetings, rigid) = meet(&mut bodies, &step, query, sets, &mut self.meetings, &mut refused);
        rigid.iter().for_each(|copy| copy.write(rapier.bodies));
        let mut meetings = members.into_iter().zip(meetings).peekable();
        for (place, ((_, entry), visit)) in self.entries.iter_mut().zip(visits).enumerate() {
            entry.meeting = meetings.next_if(|(member, _)| *member == place).map(|(_, m)| m).unwrap_or_default();
            visit.report.deepest = entry.meeting.deepest;
            visit.report.held = entry.meeting.held;
        }
        refused.into_values().collect()
    }
}
