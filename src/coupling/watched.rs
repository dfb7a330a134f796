//! Watching contacts that were cancelled: where the skin is now that lies at them, and how far from their parts.

use std::collections::BTreeSet;

use super::contact::Proximity;
use super::obstacle::ObstaclePart;
use super::penetrations::{Contact, Penetration};
use super::piercing::deepest_on_triangle;
use super::skin_point::SkinPoint;
use crate::elastic::ElasticBody;
use crate::math::Vec3;

impl Contact {
    /// The contact after it was cancelled, as a guard of the skin that is nearest to its parts now, and how far that is from
    /// them. None for a contact that no field of its own has pushed.
    pub fn watched(&self, body: &ElasticBody, parts: &[ObstaclePart]) -> Option<(Self, f32)> {
        if !self.held {
            return None;
        }
        let distance = |p: &Penetration| parts[p.part].placed.distance(p.point.position(body.positions())).0;
        let mut points: Vec<Penetration> =
            self.points.iter().map(|p| Penetration { depth: -distance(p), ..*p }).collect();
        points.extend(self.beside(body, parts, self.depth()));
        let gap = points.iter().map(|p| -p.depth).fold(f32::INFINITY, f32::min);
        let height = gap + WATCHED * body.skins()[usize::from(self.near.segment)].size;
        let points: Vec<Penetration> = points.into_iter().filter(|p| -p.depth < height).collect();
        let near = self.nearest_of(&points);
        let guard = Self::guarding(body, near, points, height);
        Some((Self { held: true, pushed: self.pushed, ..guard }, gap))
    }

    /// The same guard with the nearest points of the triangles around its vertices: at a tip or an edge the skin may touch
    /// between them.
    pub(super) fn with_triangles(mut self, body: &ElasticBody, parts: &[ObstaclePart]) -> Self {
        let positions = body.positions();
        let mut is_member = vec![false; positions.len()];
        self.points.iter().flat_map(|p| p.point.corners()).for_each(|(v, _)| is_member[v] = true);
        let touched = self.parts();
        let triangles = &body.rig().mesh.triangles;
        for &vertices in triangles.iter().filter(|t| t.iter().any(|&v| is_member[v as usize])) {
            let corners = vertices.map(|v| positions[v as usize]);
            for &part in &touched {
                let placed = &parts[part].placed;
                let heights = corners.map(|x| placed.signed_distance(x));
                let lowest = heights.iter().map(|h| h.0).fold(f32::INFINITY, f32::min);
                let bound = |(at, (height, slope)): (&Vec3, &(f32, Vec3))| {
                    corners.iter().map(|x| height + slope.dot(*x - *at)).fold(f32::INFINITY, f32::min)
                };
                let least = corners.iter().zip(&heights).map(bound).fold(f32::NEG_INFINITY, f32::max);
                if least >= lowest - 1.0e-3 * self.guards || least > self.guards {
                    continue;
                }
                let (weights, height) = deepest_on_triangle(placed, corners);
                if height < lowest && height < self.guards {
                    let point = SkinPoint { vertices, weights };
                    self.points.push(Penetration { point, part, depth: -height.max(0.0), counts: 1.0 });
                }
            }
        }
        let Self { near, points, guards, .. } = self;
        Self { held: self.held, pushed: self.pushed, ..Self::guarding(body, near, points, guards) }
    }

    /// The skin that is at the place of the contact now, within `reach` metres beside what went in: that has slid along the part, and
    /// other skin has come.
    pub fn beside(&self, body: &ElasticBody, parts: &[ObstaclePart], reach: f32) -> Vec<Penetration> {
        let around = self.radius + reach;
        let own: BTreeSet<u32> = self.points.iter().map(|p| p.point.vertices[0]).collect();
        let touched = self.parts();
        let here = |&vertex: &u32| {
            let x = body.positions()[vertex as usize];
            if x.distance(self.centre) > around || own.contains(&vertex) {
                return None;
            }
            let distances = touched.iter().map(|&part| (parts[part].placed.distance(x).0, part));
            let (distance, part) = distances.min_by(|a, b| a.0.total_cmp(&b.0))?;
            Some(Penetration { point: SkinPoint::vertex(vertex), part, depth: -distance, counts: 1.0 })
        };
        body.skins()[usize::from(self.near.segment)].vertices.iter().filter_map(here).collect()
    }

    /// The proximity with the part of the nearest of these points.
    fn nearest_of(&self, points: &[Penetration]) -> Proximity {
        let nearest = points.iter().max_by(|a, b| a.depth.total_cmp(&b.depth));
        Proximity { part: nearest.map_or(self.near.part, |p| p.part), ..self.near }
    }
}

/// Skin of a cancelled contact is watched that is farther off than the nearest by at most this part of the size.
const WATCHED: f32 = 0.03;
