//! Ground: a heightfield as solid blocks below its flat pieces.
//!
//! A quadtree over the grid finds the squares that are flat: a plain, however finely it is divided, is one block. A cell
//! that is folded along its diagonal is two.

use rapier3d::parry::bounding_volume::Aabb;
use rapier3d::parry::shape::{HeightField, ShapeType};

use super::error::ObstacleError;
use super::local_part::LocalPart;
use super::outer_face::OuterFace;
use crate::math::Vec3;

/// Corners farther from a plane than this part of the longest side are not on it.
const FLAT: f32 = 1.0e-6;

/// A heightfield with its flat pieces.
pub struct HeightFieldPieces {
    field: HeightField,
    /// The squares of the quadtree, single cells first; each level has half as many a side as the one before.
    levels: Vec<Level>,
}

struct Level {
    /// Squares along z and x.
    squares: [usize; 2],
    /// Along z first, as in the heightfield.
    nodes: Vec<Node>,
}

/// A square of `2ⁿ` by `2ⁿ` cells, as far as they lie in the grid.
#[derive(Clone, Copy)]
struct Node {
    flat: bool,
    low: f32,
    high: f32,
}

/// Level and place of a square, packed into a number.
#[derive(Clone, Copy)]
struct Square {
    level: usize,
    row: usize,
    column: usize,
}

impl Square {
    fn key(self) -> u64 {
        ((self.level as u64) << 56) | ((self.row as u64) << 28) | self.column as u64
    }

    fn from_key(key: u64) -> Self {
        let place = (1 << 28) - 1;
        Self { level: (key >> 56) as usize, row: ((key >> 28) & place) as usize, column: (key & place) as usize }
    }
}

impl HeightFieldPieces {
    /// Finds the flat pieces: O(cells).
    ///
    /// # Errors
    /// [`ObstacleError::NoArea`] where the field has no extent, a height is not finite, or all triangles are removed.
    pub fn new(field: &HeightField) -> Result<Self, ObstacleError> {
        let error = ObstacleError::NoArea(ShapeType::HeightField);
        let scale = field.scale();
        let row_is_finite = |row: usize| (0..=field.ncols()).all(|column| field.heights()[(row, column)].is_finite());
        let finite = scale.is_finite() && (0..=field.nrows()).all(row_is_finite);
        if !finite || scale.x.abs() <= 0.0 || scale.z.abs() <= 0.0 {
            return Err(error);
        }
        let mut pieces = Self { field: field.clone(), levels: Vec::new() };
        pieces.add_cells();
        while pieces.levels.last().is_some_and(|level| level.squares != [1, 1]) {
            pieces.add_level();
        }
        let any = pieces.levels.first().is_some_and(|cells| cells.nodes.iter().any(|node| node.low <= node.high));
        if any { Ok(pieces) } else { Err(error) }
    }

    fn corner(&self, row: usize, column: usize) -> Vec3 {
        let height = self.field.heights()[(row, column)] * self.field.scale().y;
        Vec3::new(self.field.x_at(column), height, self.field.z_at(row))
    }

    fn tolerance(&self) -> f32 {
        FLAT * self.field.scale().abs().max_element()
    }

    fn add_cells(&mut self) {
        let squares = [self.field.nrows(), self.field.ncols()];
        let cell = |row, column| match self.field.triangles_at(row, column) {
            (None, None) => Node { flat: false, low: f32::INFINITY, high: f32::NEG_INFINITY },
            triangles => {
                let square = Square { level: 0, row, column };
                let heights = self.corners(square).map(|p| p.y);
                let whole = triangles.0.is_some() && triangles.1.is_some();
                Node {
                    flat: whole && self.is_flat(self.corners(square)),
                    low: heights.into_iter().fold(f32::INFINITY, f32::min),
                    high: heights.into_iter().fold(f32::NEG_INFINITY, f32::max),
                }
            }
        };
        let nodes = (0..squares[1]).flat_map(|column| (0..squares[0]).map(move |row| cell(row, column))).collect();
        self.levels.push(Level { squares, nodes });
    }

    fn add_level(&mut self) {
        let level = self.levels.len();
        let Some(below) = self.levels.last() else { return };
        let squares = below.squares.map(|count| count.div_ceil(2));
        let join = |row: usize, column: usize| {
            let mut all = Node { flat: true, low: f32::INFINITY, high: f32::NEG_INFINITY };
            for (row, column) in children(row, column, below.squares) {
                let child = below.node(row, column);
                all.flat &= child.flat && self.is_flat_with(level, row / 2, column / 2, row, column);
                (all.low, all.high) = (all.low.min(child.low), all.high.max(child.high));
            }
            all
        };
        let nodes = (0..squares[1]).flat_map(|column| (0..squares[0]).map(move |row| join(row, column))).collect();
        self.levels.push(Level { squares, nodes });
    }

    /// The corners of a square in the order (−z, −x), (+z, −x), (−z, +x), (+z, +x).
    fn corners(&self, square: Square) -> [Vec3; 4] {
        let end = |place: usize, count: usize| ((place + 1) << square.level).min(count);
        let (low, left) = (square.row << square.level, square.column << square.level);
        let (high, right) = (end(square.row, self.field.nrows()), end(square.column, self.field.ncols()));
        [(low, left), (high, left), (low, right), (high, right)].map(|(row, column)| self.corner(row, column))
    }

    /// The ways in which a square ends at the rim of the field.
    fn rim(&self, square: Square) -> Vec<Vec3> {
        let [first, .., last] = self.corners(square);
        let rim = self.field.root_aabb();
        let at_rim = |side: &Vec3| {
            let corner = if side.element_sum() < 0.0 { first.min(last) } else { first.max(last) };
            let border = if side.element_sum() < 0.0 { rim.mins } else { rim.maxs };
            ((corner - border) * side.abs()).abs().max_element() <= self.tolerance()
        };
        SIDES.into_iter().filter(at_rim).collect()
    }

    fn is_flat(&self, [a, b, c, d]: [Vec3; 4]) -> bool {
        (a.y + d.y - b.y - c.y).abs() <= self.tolerance()
    }

    /// True where a square and a square within it lie on one plane.
    fn is_flat_with(&self, level: usize, row: usize, column: usize, inner_row: usize, inner_column: usize) -> bool {
        let corners = self.corners(Square { level, row, column });
        let inner = self.corners(Square { level: level - 1, row: inner_row, column: inner_column });
        let [a, b, c, _] = corners;
        let (along_z, along_x) = ((b.y - a.y) / (b.z - a.z), (c.y - a.y) / (c.x - a.x));
        let height = |p: Vec3| a.y + along_z * (p.z - a.z) + along_x * (p.x - a.x);
        self.is_flat(corners) && inner.iter().all(|p| (p.y - height(*p)).abs() <= self.tolerance())
    }

    /// See [`super::PartSource::cells_near`].
    pub(super) fn cells_near(&self, region: &Aabb, thickness: f32, cells: &mut Vec<u64>) {
        let top = Square { level: self.levels.len() - 1, row: 0, column: 0 };
        let mut open = vec![top];
        while let Some(square) = open.pop() {
            let node = self.levels[square.level].node(square.row, square.column);
            let [first, .., last] = self.corners(square);
            let (mins, maxs) = (first.min(last), first.max(last));
            let beside = maxs.x < region.mins.x || mins.x > region.maxs.x;
            let before = maxs.z < region.mins.z || mins.z > region.maxs.z;
            if beside || before || node.high < region.mins.y || node.low - thickness > region.maxs.y {
                continue;
            }
            if node.flat || square.level == 0 {
                cells.push(square.key());
            } else {
                let below = self.levels[square.level - 1].squares;
                let inner = children(square.row, square.column, below);
                open.extend(inner.map(|(row, column)| Square { level: square.level - 1, row, column }));
            }
        }
    }

    /// See [`super::PartSource::expand`].
    pub(super) fn expand(&self, cell: u64, thickness: f32) -> Vec<(u32, LocalPart)> {
        let square = Square::from_key(cell);
        if self.levels.get(square.level).is_none_or(|l| square.row >= l.squares[0] || square.column >= l.squares[1]) {
            return Vec::new();
        }
        let first = (square.row << square.level) + (square.column << square.level) * self.field.nrows();
        let number = 2 * first as u32;
        let rim = self.rim(square);
        let block = |number: u32, top: &[Vec3]| Some((number, block(top, thickness, &rim)?));
        if self.levels[square.level].node(square.row, square.column).flat {
            return block(number, &self.corners(square)).into_iter().collect();
        }
        let (a, b) = self.field.triangles_at(square.row, square.column);
        let halves = [(number, a), (number + 1, b)].into_iter();
        halves.filter_map(|(number, half)| block(number, half?.vertices())).collect()
    }
}

impl Level {
    fn node(&self, row: usize, column: usize) -> Node {
        self.nodes[row + column * self.squares[0]]
    }
}

/// The squares one level below that lie in a square, as far as there are any.
fn children(row: usize, column: usize, below: [usize; 2]) -> impl Iterator<Item = (usize, usize)> {
    let rows = 2 * row..(2 * row + 2).min(below[0]);
    rows.flat_map(move |row| (2 * column..(2 * column + 2).min(below[1])).map(move |column| (row, column)))
}

/// The solid between a flat top and a level bottom, `thickness` below the lowest corner of the top; `rim` are the ways
/// in which there is no ground beside it.
fn block(top: &[Vec3], thickness: f32, rim: &[Vec3]) -> Option<LocalPart> {
    let bottom = top.iter().map(|p| p.y).fold(f32::INFINITY, f32::min) - thickness;
    let points: Vec<Vec3> = top.iter().flat_map(|p| [*p, p.with_y(bottom)]).collect();
    let parallelogram = (top[1] - top[0]).cross(top[2] - top[0]);
    let area = parallelogram.length() * if top.len() == 3 { 0.5 } else { 1.0 };
    let normal = parallelogram.try_normalize()?;
    let normal = if normal.y < 0.0 { -normal } else { normal };
    // A way out may be tilted over the rim; nowhere else, for next to ground there is ground.
    let middle = top.iter().sum::<Vec3>() / top.len() as f32;
    let edge = |way: Vec3| {
        let along = (way - normal * way.dot(normal)).try_normalize()?;
        Some((along, if rim.contains(&way) { f32::INFINITY } else { 0.0 }))
    };
    let edges = SIDES.into_iter().filter_map(edge).collect();
    let face = OuterFace { normal, offset: normal.dot(middle), area, two_sided: false, edges };
    LocalPart::piece(&points, &face).ok()
}

const SIDES: [Vec3; 4] = [Vec3::NEG_X, Vec3::X, Vec3::NEG_Z, Vec3::Z];
