//! The upper side of a loose sheet, as heights over a lattice: what other loose sheets lie upon.
//!
//! A field of heights knows no side of a sheet but the upper one, so all below that counts as
//! full. Beyond the sheet it falls off no steeper than [`SLOPE`]: a sheet whose nodes are a cell
//! apart bends over no rim that stands up, and what comes from beside is met before it is deep
//! in.

use super::aabb::Aabb;
use super::tolerance::SLIVER;
use crate::real::bounded;
use crate::triangle::PlanTriangle;
use crate::vector::sub;

/// How steeply heights fall off at most, as a sheet drapes over a rim.
const SLOPE: f32 = 1.0;

/// Where nothing lies.
const NOTHING: f32 = f32::NEG_INFINITY;

/// Least of twice the area in plan of a triangle that counts, over the square of the lattice's spacing: a
/// smaller one covers no node but by rounding.
const LEAST_AREA: f32 = 1e-4;

/// The upper side of a sheet, as it was drawn.
#[derive(Clone, Debug)]
pub struct Relief {
    lattice: Lattice,
    columns: usize,
    rows: usize,
    /// The number of its first node along x and y.
    first: [i32; 2],
    /// Height of the upper side at each node and at those next to it, metres.
    drawn: Vec<f32>,
    /// The same, falling off no steeper than [`SLOPE`].
    met: Vec<f32>,
    /// The greatest of these, metres.
    highest: f32,
    /// The points it was made of: x, y, z of each, metres.
    points: Vec<f32>,
}

/// Even nodes over the table, one at its origin.
#[derive(Clone, Copy, Debug)]
struct Lattice {
    /// Distance of two nodes, metres.
    spacing: f32,
}

impl Lattice {
    /// The last node before a place along x or y.
    fn before(self, at: f32) -> i32 {
        libm::floorf(at / self.spacing) as i32
    }

    /// Places between the ends of an edge, less than two spacings from each other in plan: none of
    /// its places is farther from one of these, or an end, than heights are known beside paper.
    fn places_along(self, [from, to]: [[f32; 3]; 2]) -> impl Iterator<Item = [f32; 3]> {
        let way = sub(to, from);
        let length = (way[0] * way[0] + way[1] * way[1]).sqrt();
        let count = libm::floorf(length / self.spacing) as u32;
        (1..count).map(move |number| {
            let part = number as f32 / count as f32;
            [0, 1, 2].map(|axis| from[axis] + part * way[axis])
        })
    }

    /// Calls `visit` with each node that lies in a triangle in plan, and the height there.
    fn each_node_in(self, corners: [[f32; 3]; 3], mut visit: impl FnMut([i32; 2], f32)) {
        let least = LEAST_AREA * self.spacing * self.spacing;
        let Some(triangle) = PlanTriangle::of(corners, least) else {
            return;
        };
        let Aabb { low, high } = Aabb::around(corners);
        let range =
            |axis: usize| libm::ceilf(low[axis] / self.spacing) as i32..=self.before(high[axis]);
        for row in range(1) {
            for column in range(0) {
                let place = [column, row].map(|number| number as f32 * self.spacing);
                if let Some(height) = triangle.height_at(place) {
                    visit([column, row], height);
                }
            }
        }
    }
}

impl Relief {
    /// The upper side of a mesh over a table at a height, metres, at nodes so far apart. Nothing
    /// lies there where a point is not finite, or the mesh reaches farther than `longest`.
    pub fn of(
        points: &[f32],
        triangles: &[[u32; 3]],
        spacing: f32,
        (table, longest): (f32, f32),
    ) -> Relief {
        let lattice = Lattice { spacing };
        let x = points.as_chunks::<3>().0;
        let bounds = Aabb::around(x.iter().copied());
        let Aabb { low, high } = bounds;
        let mut relief = Relief {
            lattice,
            columns: 0,
            rows: 0,
            first: [0; 2],
            drawn: Vec::new(),
            met: Vec::new(),
            highest: high[2],
            points: points.to_vec(),
        };
        if !bounds.size().iter().all(|side| *side <= longest) {
            return relief;
        }
        let falling = bounded(high[2] - table, 0.0, longest) / (SLOPE * spacing);
        let margin = 2 + libm::ceilf(falling) as i32;
        relief.first = [0, 1].map(|axis| lattice.before(low[axis]) - margin);
        let last = [0, 1].map(|axis| lattice.before(high[axis]) + 1 + margin);
        let [columns, rows] = [0, 1].map(|axis| (last[axis] - relief.first[axis]) as usize + 1);
        (relief.columns, relief.rows) = (columns, rows);
        let mut covered = vec![NOTHING; columns * rows];
        let first = relief.first;
        let index = |[column, row]: [i32; 2]| {
            (row - first[1]) as usize * columns + (column - first[0]) as usize
        };
        for corners in triangles {
            let corners = corners.map(|corner| x[corner as usize]);
            lattice.each_node_in(corners, |node, height| {
                let covered = &mut covered[index(node)];
                *covered = covered.max(height);
            });
        }
        // Paper that stands on edge covers no node in plan.
        let bare = covered.clone();
        for point in x {
            let node = index([0, 1].map(|axis| lattice.before(point[axis] + 0.5 * spacing)));
            if bare[node] == NOTHING {
                covered[node] = covered[node].max(point[2]);
            }
        }
        relief.drawn = beside(&covered, columns);
        relief.met = relief.drawn.clone();
        fall_off(&mut relief.met, columns, SLOPE * spacing);
        relief
    }

    /// Whether a mesh is elsewhere than the one this was made of, by more than what is seen.
    pub fn is_outdated(&self, points: &[f32]) -> bool {
        let mut pairs = self.points.iter().zip(points);
        self.points.len() != points.len() || pairs.any(|(a, b)| (a - b).abs() > SLIVER)
    }

    /// Whether something in a box lies over or beside it in plan.
    pub fn is_near(&self, bounds: &Aabb) -> bool {
        let spacing = self.lattice.spacing;
        let sides = [self.columns, self.rows];
        sides.iter().all(|count| *count > 0) && {
            let [from_x, from_y] = self.first.map(|first| first as f32 * spacing);
            let [along_x, along_y] = sides.map(|count| (count - 1) as f32 * spacing);
            let own = Aabb {
                low: [from_x, from_y, 0.0],
                high: [from_x + along_x, from_y + along_y, 0.0],
            };
            own.overlaps_in_plan(bounds)
        }
    }

    /// Whether the paper itself lies under or over a place in plan.
    pub fn covers(&self, x: f32, y: f32) -> bool {
        self.drawn_height(x, y).is_some()
    }

    /// Height of what lies there, metres, and its slopes along x and y; None where nothing does.
    pub fn height_and_slope(&self, x: f32, y: f32) -> Option<(f32, [f32; 2])> {
        let (corners, [s, t]) = self.corners(&self.met, x, y)?;
        if corners.contains(&NOTHING) {
            return None;
        }
        let [a, b, c, d] = corners;
        let height = (1.0 - t) * (a + s * (b - a)) + t * (c + s * (d - c));
        let along_x = (1.0 - t) * (b - a) + t * (d - c);
        let along_y = (1.0 - s) * (c - a) + s * (d - b);
        Some((
            height,
            [along_x, along_y].map(|rise| rise / self.lattice.spacing),
        ))
    }

    /// Height of the paper at a place, metres; None where there is none.
    pub fn drawn_height(&self, x: f32, y: f32) -> Option<f32> {
        let (corners, [s, t]) = self.corners(&self.drawn, x, y)?;
        let [a, b, c, d] = corners;
        let highest = a.max(b).max(c).max(d);
        if highest == NOTHING {
            None
        } else if corners.contains(&NOTHING) {
            Some(highest)
        } else {
            Some((1.0 - t) * (a + s * (b - a)) + t * (c + s * (d - c)))
        }
    }

    /// By how much each point of a mesh has to rise so that it is nowhere less than `gap` over the
    /// paper, metres: added to `rises` where that is more. What is farther below than `deepest`
    /// is left there.
    pub fn lift(
        &self,
        points: &[[f32; 3]],
        triangles: &[[u32; 3]],
        [gap, deepest]: [f32; 2],
        rises: &mut [f32],
    ) {
        let missing = |height: f32, z: f32| {
            let missing = height + gap - z;
            if missing < deepest { missing } else { 0.0 }
        };
        for ([x, y, z], rise) in points.iter().zip(rises.iter_mut()) {
            if *z < self.highest + gap
                && let Some(height) = self.drawn_height(*x, *y)
            {
                *rise = rise.max(missing(height, *z));
            }
        }
        let [columns, rows] = [self.columns as i32, self.rows as i32];
        for corners in triangles {
            let places = corners.map(|corner| points[corner as usize]);
            if places.iter().all(|place| place[2] >= self.highest + gap) {
                continue;
            }
            let mut most = 0.0f32;
            self.lattice.each_node_in(places, |[column, row], z| {
                let [i, j] = [column - self.first[0], row - self.first[1]];
                if (0..columns).contains(&i) && (0..rows).contains(&j) {
                    let height = self.drawn[(j * columns + i) as usize];
                    most = most.max(missing(height, z));
                }
            });
            // Where an edge passes over a rim no node need be in its triangle.
            for (from, to) in [(0, 1), (1, 2), (2, 0)] {
                for [x, y, z] in self.lattice.places_along([places[from], places[to]]) {
                    if let Some(height) = self.drawn_height(x, y) {
                        most = most.max(missing(height, z));
                    }
                }
            }
            for corner in corners {
                let rise = &mut rises[*corner as usize];
                *rise = rise.max(most);
            }
        }
    }

    /// The heights at the four nodes about a place, from the foot left, and where it lies between
    /// them, 0 to 1 along x and y; None beyond the lattice.
    fn corners(&self, heights: &[f32], x: f32, y: f32) -> Option<([f32; 4], [f32; 2])> {
        let [column, row] = [x, y].map(|at| self.lattice.before(at));
        let [i, j] = [column - self.first[0], row - self.first[1]];
        let is_in = |at: i32, count: usize| (0..count as i32 - 1).contains(&at);
        if !is_in(i, self.columns) || !is_in(j, self.rows) {
            return None;
        }
        let foot = j as usize * self.columns + i as usize;
        let head = foot + self.columns;
        let part = |at: f32, number: i32| at / self.lattice.spacing - number as f32;
        let corners = [foot, foot + 1, head, head + 1].map(|node| heights[node]);
        Some((corners, [part(x, column), part(y, row)]))
    }
}

/// Heights with those of the nodes next to paper: its rim ends between nodes.
fn beside(covered: &[f32], columns: usize) -> Vec<f32> {
    let mut out = covered.to_vec();
    let rows = covered.len() / columns;
    for row in 1..rows - 1 {
        for column in 1..columns - 1 {
            let here = row * columns + column;
            if covered[here] == NOTHING {
                let near = [here - columns, here, here + columns];
                let near = near.iter().flat_map(|node| &covered[node - 1..=node + 1]);
                out[here] = near.fold(NOTHING, |most, height| most.max(*height));
            }
        }
    }
    out
}

/// Raises heights so that they fall by no more than `step` from node to node, and by its diagonal
/// across: in two sweeps, as distances on a lattice are found (Borgefors 1986).
fn fall_off(heights: &mut [f32], columns: usize, step: f32) {
    let rows = heights.len() / columns;
    let across = core::f32::consts::SQRT_2 * step;
    for row in 0..rows {
        for column in 0..columns {
            let here = row * columns + column;
            let mut most = heights[here];
            if column > 0 {
                most = most.max(heights[here - 1] - step);
            }
            if row > 0 {
                most = most.max(heights[here - columns] - step);
                if column > 0 {
                    most = most.max(heights[here - columns - 1] - across);
                }
                if column + 1 < columns {
                    most = most.max(heights[here - columns + 1] - across);
                }
            }
            heights[here] = most;
        }
    }
    // From the head back: a half turn of the same.
    for row in (0..rows).rev() {
        for column in (0..columns).rev() {
            let here = row * columns + column;
            let mut most = heights[here];
            if column + 1 < columns {
                most = most.max(heights[here + 1] - step);
            }
            if row + 1 < rows {
                most = most.max(heights[here + columns] - step);
                if column + 1 < columns {
                    most = most.max(heights[here + columns + 1] - across);
                }
                if column > 0 {
                    most = most.max(heights[here + columns - 1] - across);
                }
            }
            heights[here] = most;
        }
    }
}
