//! Where a piece of skin ends in a given direction: its triangles projected along it, in a grid.

use crate::math::{Mat3, Vec2, Vec3};

/// Triangles seen along a direction.
#[derive(Clone, Debug)]
pub struct HeightMap {
    frame: Mat3,
    low: Vec2,
    cells_per_metre: f32,
    across: [usize; 2],
    /// Where each cell's triangles begin.
    starts: Vec<u32>,
    /// Indices of triangles, cell by cell.
    members: Vec<u32>,
    triangles: Vec<Seen>,
}

/// A triangle in the frame of the map.
#[derive(Clone, Copy, Debug)]
struct Seen {
    corners: [Vec2; 3],
    heights: [f32; 3],
    /// Twice the area seen; positive where the triangle faces along the direction.
    area: f32,
}

/// Most cells along one side of the grid.
const MOST_CELLS: usize = 64;

impl HeightMap {
    /// The map of `triangles` (corners in the world) along the unit vector `up`, as far as their shadows meet the
    /// rectangle between `low` and `high` in the coordinates of `frame`: its columns are two vectors across `up`, and `up`.
    pub fn new(frame: Mat3, low: Vec2, high: Vec2, triangles: impl Iterator<Item = [Vec3; 3]>) -> Self {
        let inverse = frame.transpose();
        let seen = |corners: [Vec3; 3]| {
            let local = corners.map(|x| inverse * x);
            let flat = local.map(|x| Vec2::new(x.x, x.y));
            let (from, to) = (flat[0].min(flat[1]).min(flat[2]), flat[0].max(flat[1]).max(flat[2]));
            let meets = from.cmple(high).all() && to.cmpge(low).all();
            let area = (flat[1] - flat[0]).perp_dot(flat[2] - flat[0]);
            (meets && area != 0.0).then_some(Seen { corners: flat, heights: local.map(|x| x.z), area })
        };
        let triangles: Vec<Seen> = triangles.filter_map(seen).collect();
        let cells = ((triangles.len() as f32).sqrt() as usize).clamp(1, MOST_CELLS);
        let extent = (high - low).max(Vec2::splat(f32::MIN_POSITIVE));
        let cells_per_metre = cells as f32 / extent.max_element();
        let side = |length: f32| ((length * cells_per_metre).ceil() as usize).clamp(1, cells);
        let across = [side(extent.x), side(extent.y)];
        let mut map = Self { frame, low, cells_per_metre, across, starts: Vec::new(), members: Vec::new(), triangles };
        map.fill();
        map
    }

    fn fill(&mut self) {
        let count = self.across[0] * self.across[1];
        let mut lists: Vec<Vec<u32>> = vec![Vec::new(); count];
        for (i, triangle) in self.triangles.iter().enumerate() {
            let c = &triangle.corners;
            let (from, to) = (self.cell(c[0].min(c[1]).min(c[2])), self.cell(c[0].max(c[1]).max(c[2])));
            for row in from[1]..=to[1] {
                for column in from[0]..=to[0] {
                    lists[row * self.across[0] + column].push(i as u32);
                }
            }
        }
        self.starts = Vec::with_capacity(count + 1);
        for list in lists {
            self.starts.push(self.members.len() as u32);
            self.members.extend(list);
        }
        self.starts.push(self.members.len() as u32);
    }

    fn cell(&self, x: Vec2) -> [usize; 2] {
        let at = (x - self.low) * self.cells_per_metre;
        let clamp = |value: f32, across: usize| (value.max(0.0) as usize).min(across - 1);
        [clamp(at.x, self.across[0]), clamp(at.y, self.across[1])]
    }

    /// How far `x` must move along the direction to leave the skin, where it is inside: the nearest triangle above it
    /// then faces upwards.
    pub fn exit(&self, x: Vec3) -> Option<f32> {
        let local = self.frame.transpose() * x;
        let flat = Vec2::new(local.x, local.y);
        let [column, row] = self.cell(flat);
        let cell = row * self.across[0] + column;
        let members = &self.members[self.starts[cell] as usize..self.starts[cell + 1] as usize];
        let mut nearest = (f32::INFINITY, false);
        for &i in members {
            let triangle = &self.triangles[i as usize];
            let Some(height) = triangle.height_at(flat) else { continue };
            let above = height - local.z;
            if above >= 0.0 && above < nearest.0 {
                nearest = (above, triangle.area > 0.0);
            }
        }
        nearest.1.then_some(nearest.0)
    }
}

impl Seen {
    /// The triangle's height at a point of the plane, where its shadow covers it.
    fn height_at(&self, x: Vec2) -> Option<f32> {
        let [a, b, c] = self.corners;
        let (wa, wb, wc) = ((b - x).perp_dot(c - x), (c - x).perp_dot(a - x), (a - x).perp_dot(b - x));
        let sign = self.area.signum();
        if wa * sign < 0.0 || wb * sign < 0.0 || wc * sign < 0.0 {
            return None;
        }
        Some((wa * self.heights[0] + wb * self.heights[1] + wc * self.heights[2]) / self.area)
    }
}
