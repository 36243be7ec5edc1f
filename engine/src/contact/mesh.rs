//! A leaf as others meet it: a grid of points with normals, and the nearest
//! place on it.

use super::tolerance::BEYOND_RIM;
use crate::creased_only::CreasedOnly;
use crate::grid::cut_cell;
use crate::surface::Surface;
use crate::triangle::{area_normal, nearest_weights, place_of};
use crate::vector::{cross, dot, sub, unit};

/// Points of a leaf in book space, row by row from the foot.
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    pub columns: usize,
    pub points: &'a [[f32; 3]],
    /// Unit normals, to the side of the recto.
    pub normals: &'a [[f32; 3]],
    /// What its creases change of it.
    pub folds: Folds<'a>,
}

/// What creases change of a mesh; by default nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Folds<'a> {
    turned_over: CreasedOnly<&'a [bool]>,
    falling: CreasedOnly<&'a [bool]>,
}

impl<'a> Folds<'a> {
    /// Those of a mesh.
    ///
    /// `turned_over` are the points that belong to what is folded over, empty where nothing is: the
    /// recto's side of the leaf is there the side of its verso. `falling` are the cells, by their
    /// first points, that are cut along their other diagonal.
    pub fn of(turned_over: &'a [bool], falling: &'a [bool]) -> Self {
        Self {
            turned_over: CreasedOnly::some(turned_over),
            falling: CreasedOnly::some(falling),
        }
    }

    /// Whether a cell is cut from its corner next to the fore-edge and the foot.
    pub fn is_falling(&self, cell: usize) -> bool {
        let falling = self.falling.as_ref();
        falling.is_some_and(|falling| falling.get(cell) == Some(&true))
    }

    /// Whether a point belongs to what is folded over.
    pub fn is_turned_over(&self, point: usize) -> bool {
        let turned_over = self.turned_over.as_ref();
        turned_over.is_some_and(|turned_over| turned_over.get(point) == Some(&true))
    }

    /// Whether anything may be folded over.
    pub fn turn_over(&self) -> bool {
        let turned_over = self.turned_over.as_ref();
        turned_over.is_some_and(|turned_over| !turned_over.is_empty())
    }
}

/// Finds the cells of a mesh that are cut along their other diagonal, by its triangles.
pub fn find_falling(
    triangles: impl Iterator<Item = ([usize; 3], u16)>,
    columns: usize,
    points: usize,
) -> Vec<bool> {
    let mut falling = vec![false; points];
    for ([foot, next, above], _) in triangles {
        falling[foot] |= [next, above] == [foot + 1, foot + columns];
    }
    falling
}

/// Finds the points of a mesh that lie beyond a crease as seen from the spine, by its triangles and
/// the creases that each lies beyond.
pub fn find_beyond(triangles: impl Iterator<Item = ([usize; 3], u16)>, points: usize) -> Vec<bool> {
    let mut beyond = vec![true; points];
    for (corners, _) in triangles.filter(|(_, part)| *part == 0) {
        for corner in corners {
            beyond[corner] = false;
        }
    }
    beyond
}

/// What lies next to a point on a mesh.
#[derive(Clone, Copy, Debug)]
pub struct Near {
    /// The nearest node.
    pub node: usize,
    /// How far the point is from the surface, to the side of the recto, metres.
    pub height: f32,
    /// The surface's normal there.
    pub normal: [f32; 3],
    /// Whether the point lies beyond the rim, where the surface would be if it went on.
    pub beyond: bool,
}

/// How far beyond an edge, in cells, a point is still above the mesh.
const OVERHANG: f32 = 1.0;

/// Most steps of the walk to the nearest node. Contacts move by less than a
/// cell from one tick to the next, so nearly all walks are of one step.
const WALK: usize = 64;

impl<'a> Mesh<'a> {
    /// A drawn surface.
    pub fn of(surface: &'a Surface) -> Mesh<'a> {
        Mesh {
            columns: surface.columns,
            points: surface.positions.as_chunks::<3>().0,
            normals: surface.normals.as_chunks::<3>().0,
            folds: Folds::default(),
        }
    }

    /// The normal at a node, to the recto's side of the leaf.
    pub fn normal(&self, node: usize) -> [f32; 3] {
        let normal = self.normals[node];
        if self.is_turned_over(node) {
            normal.map(|n| -n)
        } else {
            normal
        }
    }

    /// Whether a node belongs to what is folded over.
    pub fn is_turned_over(&self, node: usize) -> bool {
        self.folds.is_turned_over(node)
    }

    pub fn rows(&self) -> usize {
        self.points.len() / self.columns
    }

    /// Tangents at a node, a cell long along u and along v.
    fn tangents(&self, node: usize) -> [[f32; 3]; 2] {
        tangents(self.points, self.columns, node)
    }

    /// Walks from node `start` to the node nearest to a point.
    pub fn nearest_node(&self, point: [f32; 3], start: usize) -> usize {
        let away = |node: usize| {
            let d = sub(point, self.points[node]);
            dot(d, d)
        };
        let (mut here, mut least) = (start, away(start));
        for _ in 0..WALK {
            let (column, row) = (here % self.columns, here / self.columns);
            let mut best = here;
            for row in row.saturating_sub(1)..(row + 2).min(self.rows()) {
                for column in column.saturating_sub(1)..(column + 2).min(self.columns) {
                    let node = row * self.columns + column;
                    let d = away(node);
                    if d < least {
                        (best, least) = (node, d);
                    }
                }
            }
            if best == here {
                break;
            }
            here = best;
        }
        here
    }

    /// The surface next to a point, sought from node `start`; None where the
    /// point lies beside the mesh rather than over or under it.
    ///
    /// Between nodes the surface is that whose normals run evenly from one to
    /// the next, which is right to third order in the size of a cell.
    pub fn near(&self, point: [f32; 3], start: usize) -> Option<Near> {
        let node = self.nearest_node(point, start);
        let away = sub(point, self.points[node]);
        let [u, v] = self.tangents(node);
        let (column, row) = (node % self.columns, node / self.columns);
        let a = dot(away, u) / dot(u, u).max(1e-12);
        let b = dot(away, v) / dot(v, v).max(1e-12);
        let beyond = |at: f32, i: usize, count: usize| {
            (i == 0 && at < -OVERHANG) || (i + 1 == count && at > OVERHANG)
        };
        if beyond(a, column, self.columns) || beyond(b, row, self.rows()) {
            return None;
        }
        let outside =
            |at: f32, i: usize, count: usize| (i == 0 && at < 0.0) || (i + 1 == count && at > 0.0);
        let own = self.normals[node];
        let toward = |at: f32, i: usize, count: usize, step: usize| {
            let other = if at > 0.0 && i + 1 < count {
                node + step
            } else if at < 0.0 && i > 0 {
                node - step
            } else {
                node
            };
            let part = at.abs().min(1.0);
            sub(self.normals[other], own).map(|d| part * d)
        };
        let (du, dv) = (
            toward(a, column, self.columns, 1),
            toward(b, row, self.rows(), self.columns),
        );
        let halfway: [f32; 3] = core::array::from_fn(|i| own[i] + 0.5 * (du[i] + dv[i]));
        let there: [f32; 3] = core::array::from_fn(|i| own[i] + du[i] + dv[i]);
        Some(Near {
            node,
            height: dot(away, unit(halfway)),
            normal: unit(there),
            beyond: outside(a, column, self.columns) || outside(b, row, self.rows()),
        })
    }

    /// The facet nearest to a point of those around a node, which is the one nearest
    /// to the point. The mesh is taken as it is drawn: each cell's diagonal runs from
    /// its corner next to the spine and the foot. Where the mesh does not bend, the
    /// cell over or under which the point lies is enough.
    pub fn facet_next_to(&self, point: [f32; 3], node: usize, bends: bool) -> Facet {
        let away = sub(point, self.points[node]);
        let [u, v] = self.tangents(node);
        let cells = |along: [f32; 3], at: usize, count: usize| {
            let forward = dot(away, along) > 0.0;
            let low = at.saturating_sub(usize::from(bends || !forward));
            let high = at + usize::from(bends || forward || at == 0);
            low.min(count - 2)..high.min(count - 1)
        };
        let mut best: Option<Seen> = None;
        let mut least = f32::MAX;
        for row in cells(v, node / self.columns, self.rows()) {
            for column in cells(u, node % self.columns, self.columns) {
                let here = row * self.columns + column;
                for corners in cut_cell(here, self.columns, self.folds.is_falling(here)) {
                    let at = corners.map(|node| self.points[node]);
                    let parts = nearest_weights(point, at);
                    let away = sub(point, place_of(parts, at));
                    let square = dot(away, away);
                    // Most are farther, and nothing more needs to be known of them.
                    if square < least * 1.0001 + 1e-14 {
                        let seen = self.see(corners, parts, away);
                        // Of those equally near, as at a common edge, the one that the
                        // point is most clearly beside.
                        let clearer = best.as_ref().is_none_or(|known| {
                            square < least * 0.9999 || seen.height.abs() > known.height.abs()
                        });
                        if clearer {
                            best = Some(seen);
                        }
                    }
                    least = least.min(square);
                }
            }
        }
        self.facet(best.expect("a node has a cell beside it"))
    }

    /// A facet of these corners as seen from a point that is `away` from the nearest place on it.
    fn see(&self, corners: [usize; 3], parts: [f32; 3], away: [f32; 3]) -> Seen {
        let mut normal = unit(area_normal(corners.map(|node| self.points[node])));
        if corners.iter().any(|node| self.is_turned_over(*node)) {
            normal = normal.map(|n| -n);
        }
        Seen {
            corners,
            parts,
            away,
            normal,
            height: dot(away, normal),
        }
    }

    /// The facet that a point sees.
    fn facet(&self, seen: Seen) -> Facet {
        let Seen {
            corners,
            parts,
            away,
            normal,
            height,
        } = seen;
        let on = |is: &dyn Fn(usize) -> bool| {
            let mut used = corners.iter().zip(parts).filter(|(_, part)| *part > 0.0);
            used.all(|(node, _)| is(*node))
        };
        let (columns, rows) = (self.columns, self.rows());
        let at_rim = on(&|node| node < columns)
            || on(&|node| node / columns + 1 == rows)
            || on(&|node| node % columns + 1 == columns);
        let square = dot(away, away);
        Facet {
            corners,
            parts,
            height,
            normal,
            beyond: at_rim && square - height * height > BEYOND_RIM * BEYOND_RIM,
        }
    }
}

/// A facet as a point sees it, before it is known whether the point lies beyond the rim.
struct Seen {
    corners: [usize; 3],
    parts: [f32; 3],
    /// From the facet's place nearest to the point to the point, metres.
    away: [f32; 3],
    normal: [f32; 3],
    height: f32,
}

/// A facet of a mesh as seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    pub corners: [usize; 3],
    /// The corners' parts of the place nearest to the point; they add up to 1.
    pub parts: [f32; 3],
    /// How far the point is from the facet's plane, to the side of the recto, metres.
    pub height: f32,
    /// The facet's unit normal, to the side of the recto.
    pub normal: [f32; 3],
    /// Whether the point lies beyond the mesh's rim, so that it has no side.
    pub beyond: bool,
}

/// Tangents at a node of a grid, a cell long along u and along v.
fn tangents(points: &[[f32; 3]], columns: usize, node: usize) -> [[f32; 3]; 2] {
    let (column, row, rows) = (node % columns, node / columns, points.len() / columns);
    let along = |at: usize, count: usize, step: usize| {
        let (before, after) = (usize::from(at > 0), usize::from(at + 1 < count));
        let d = sub(points[node + after * step], points[node - before * step]);
        let inverse = 1.0 / (before + after) as f32;
        d.map(|d| d * inverse)
    };
    [along(column, columns, 1), along(row, rows, columns)]
}

/// Computes the normals of a grid of points by central differences; where they
/// vanish, the former normal stays.
pub fn update_normals(points: &[[f32; 3]], columns: usize, normals: &mut [[f32; 3]]) {
    for (node, normal) in normals.iter_mut().enumerate() {
        let [u, v] = tangents(points, columns, node);
        let n = cross(u, v);
        let length = dot(n, n).sqrt();
        if length > 1e-12 {
            *normal = n.map(|n| n / length);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A mesh rolled about an axis along v with a radius, cells of 10 mm.
    fn rolled(radius: f32) -> [Vec<[f32; 3]>; 2] {
        let place = |node: usize| {
            let (u, v) = ((node % 10) as f32 * 0.01, (node / 10) as f32 * 0.01);
            let (sin, cos) = libm::sincosf(u / radius);
            [radius * sin, v, radius * (1.0 - cos)]
        };
        let points: Vec<_> = (0..80).map(place).collect();
        let mut normals = vec![[0.0; 3]; 80];
        update_normals(&points, 10, &mut normals);
        [points, normals]
    }

    fn mesh([points, normals]: &[Vec<[f32; 3]>; 2]) -> Mesh<'_> {
        Mesh {
            columns: 10,
            points,
            normals,
            folds: Folds::default(),
        }
    }

    #[test]
    fn heights_over_a_roll_are_those_over_its_cylinder() {
        let radius = 0.06;
        let rolled = rolled(radius);
        let mesh = mesh(&rolled);
        for (u, height) in [(0.033f32, 0.004), (0.047, -0.003), (0.052, 0.0)] {
            let (sin, cos) = libm::sincosf(u / radius);
            // To the side of the recto is toward the axis.
            let r = radius - height;
            let point = [r * sin, 0.036, radius - r * cos];
            let near = mesh.near(point, 0).unwrap();
            assert!(
                (near.height - height).abs() < 1.5e-4,
                "{near:?} for {height}"
            );
            assert!((near.normal[0] + sin).abs() < 0.02);
            // Facets cut inside the arc by cell^2 / 8 radius at most.
            let drawn = mesh.facet_next_to(point, near.node, true);
            assert!((drawn.height - near.height).abs() < 3e-4, "{drawn:?}");
            assert!(dot(drawn.normal, near.normal) > 0.99);
        }
    }

    #[test]
    fn beside_a_mesh_there_is_nothing() {
        let rolled = rolled(10.0);
        let mesh = mesh(&rolled);
        assert!(mesh.near([0.12, 0.03, 0.001], 0).is_none());
        assert!(mesh.near([0.05, -0.02, 0.001], 0).is_none());
        assert!(mesh.near([0.05, 0.03, 0.001], 79).is_some());
    }
}
