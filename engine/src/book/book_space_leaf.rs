//! A leaf's nodes in the book, and what it remembers of what they met.

use super::fraction_turned::fraction_turned;
use crate::contact::aabb::Aabb;
use crate::contact::mesh::{Folds, Mesh, update_normals};
use crate::contact::tolerance::{CLOSE, FAR};
use crate::vector::{dot, sub};

/// Width of the page for which lengths of drawing are given, metres.
pub const WIDTH: f32 = 0.14;

/// Cosine of the angle between normals at nodes of a leaf that may reach round others; less
/// than a right angle, as a fold between nodes is sharper.
const BENT_BACK: f32 = 0.3;

/// A leaf's nodes in the book, and what it remembers of what they met.
#[derive(Clone, Debug)]
pub struct BookSpaceLeaf {
    /// Nodes along a row; nodes are listed row by row from the foot, from the spine on.
    pub columns: usize,
    /// Where the nodes are in the book, metres.
    pub points: Vec<[f32; 3]>,
    /// Unit normal of each, pointing to the side of the recto.
    pub normals: Vec<[f32; 3]>,
    /// Cosine and sine of the gutter's turn before each node.
    pub turned: Vec<[f32; 2]>,
    /// Velocities of the nodes, m/s.
    pub velocities: Vec<[f32; 3]>,
    /// Whether a grab has held the leaf since it last lay still.
    pub was_held: bool,
    /// Node of the left and of the right neighbour that each node was nearest to.
    pub nearest: [Vec<u16>; 2],
    /// Distance between columns and rows, metres.
    pub cell: [f32; 2],
    /// How much wider the page is than the one for which lengths of drawing are given.
    pub scale: f32,
    /// Deepest contact of the last meeting, metres.
    pub depth: f32,
    /// Distance of each node from the left and from the right neighbour, metres.
    pub gaps: [Vec<f32>; 2],
    /// Distance of each node from the pile under it, metres.
    pub pile_gaps: Vec<f32>,
    /// The box around each row.
    pub bounds: Vec<Aabb>,
    /// Whether parts of it are folded over.
    pub has_folds: bool,
    /// See [`Folds::falling`].
    pub falling: Vec<bool>,
}

impl BookSpaceLeaf {
    /// A leaf of `columns` x `rows` nodes, `cell` metres apart.
    pub fn new(columns: usize, rows: usize, cell: [f32; 2]) -> BookSpaceLeaf {
        let nodes = columns * rows;
        let same: Vec<u16> = (0..nodes as u16).collect();
        BookSpaceLeaf {
            columns,
            points: vec![[0.0; 3]; nodes],
            normals: vec![[0.0, 0.0, 1.0]; nodes],
            turned: vec![[1.0, 0.0]; nodes],
            velocities: vec![[0.0; 3]; nodes],
            was_held: false,
            nearest: [same.clone(), same],
            cell,
            scale: cell[0] * (columns - 1) as f32 / WIDTH,
            depth: 0.0,
            gaps: [vec![FAR; nodes], vec![FAR; nodes]],
            pile_gaps: vec![FAR; nodes],
            bounds: vec![Aabb::EMPTY; rows],
            has_folds: false,
            falling: Vec::new(),
        }
    }

    /// The leaf as others meet it.
    pub fn mesh(&self) -> Mesh<'_> {
        Mesh {
            columns: self.columns,
            points: &self.points,
            normals: &self.normals,
            folds: Folds::of(&[], &self.falling),
        }
    }

    /// A node from which a walk leads to the node nearest to a point, sought from node `start`.
    /// What is folded over has a nearest node of its own, at which a walk may end: of a leaf
    /// with such parts the nearest of all nodes is sought.
    pub fn start_near(&self, point: [f32; 3], start: usize) -> usize {
        if !self.has_folds {
            return start;
        }
        let away = |node: usize| {
            let way = sub(point, self.points[node]);
            dot(way, way)
        };
        let (mut best, mut least) = (start, away(start));
        for (row, bounds) in self.bounds.iter().enumerate() {
            if bounds.square_distance(point) >= least {
                continue;
            }
            for node in row * self.columns..(row + 1) * self.columns {
                let d = away(node);
                if d < least {
                    (best, least) = (node, d);
                }
            }
        }
        best
    }

    /// Whether a cell (its first column and row) may overlap the left (0) or the
    /// right (1) neighbour between its nodes.
    pub fn is_close(&self, side: usize, column: usize, row: usize) -> bool {
        let node = row * self.columns + column;
        let corners = [node, node + 1, node + self.columns, node + self.columns + 1];
        corners.iter().any(|&node| self.gaps[side][node] < CLOSE)
    }

    /// Brings the normals up to date with the points.
    pub fn update_normals(&mut self) {
        update_normals(&self.points, self.columns, &mut self.normals);
    }

    /// Forgets what was met: each node is looked for next to its own place.
    pub fn forget(&mut self) {
        self.was_held = false;
        self.depth = 0.0;
        for gaps in &mut self.gaps {
            gaps.fill(FAR);
        }
        for nearest in &mut self.nearest {
            for (node, nearest) in nearest.iter_mut().enumerate() {
                *nearest = node as u16;
            }
        }
    }

    /// Forgets neighbours that nodes seem deeper in than `deep` metres: such a node has
    /// come round a rim, or lies under a flap.
    pub fn forget_deep(&mut self, deep: f32) {
        for gap in self.gaps.iter_mut().flatten().filter(|gap| **gap < -deep) {
            *gap = FAR;
        }
    }

    /// Whether no node can have come deeper than `deep` metres into anything within
    /// `seconds` since all was looked for, at the velocities of now, nor any that was
    /// not [close](Self::is_close) to a neighbour have come close: so far off was
    /// everything.
    pub fn is_clear(
        &self,
        [left, right]: [Option<&BookSpaceLeaf>; 2],
        deep: f32,
        seconds: f32,
    ) -> bool {
        let apart = |v: [f32; 3], w: [f32; 3]| {
            let d = sub(v, w);
            seconds * dot(d, d).sqrt()
        };
        (0..self.points.len()).all(|node| {
            let v = self.velocities[node];
            let clear_of = |side: usize, other: Option<&BookSpaceLeaf>| {
                let nearest = self.nearest[side][node] as usize;
                other.is_none_or(|other| {
                    let gap = self.gaps[side][node];
                    let nearer = apart(v, other.velocities[nearest]);
                    gap + deep > nearer && (gap < CLOSE || gap - CLOSE > nearer)
                })
            };
            self.pile_gaps[node] + deep > apart(v, [0.0; 3])
                && clear_of(0, left)
                && clear_of(1, right)
        })
    }

    /// How far the leaf's outer half has turned at most, as a fraction of the half turn,
    /// from the right (`side` 1) or from the left (-1).
    pub fn reach(&self, side: f32) -> f32 {
        let outer = |node: &usize| 2 * (node % self.columns) >= self.columns;
        let fractions = (0..self.points.len()).filter(outer).map(|node| {
            let [x, _, z] = self.points[node];
            fraction_turned(side * x, z)
        });
        fractions.fold(0.0, f32::max)
    }

    /// The place in the middle between a node and the one `right` columns and `up`
    /// rows on, on the cubic through the nodes before and after.
    pub fn middle(&self, node: usize, [right, up]: [usize; 2]) -> [f32; 3] {
        let step = right + up * self.columns;
        let end = node + step;
        let column = node % self.columns;
        let (p, q) = (self.points[node], self.points[end]);
        let before = column >= right && node >= step;
        let after = column + 2 * right < self.columns && end + step < self.points.len();
        let a = before.then(|| self.points[node - step]);
        let b = after.then(|| self.points[end + step]);
        core::array::from_fn(|i| {
            let a = a.map_or(2.0 * p[i] - q[i], |a| a[i]);
            let b = b.map_or(2.0 * q[i] - p[i], |b| b[i]);
            (9.0 * (p[i] + q[i]) - a - b) * 0.0625
        })
    }

    /// Finds the box around each row.
    pub fn bound_rows(&mut self) {
        let rows = self.points.chunks_exact(self.columns);
        for (bounds, row) in self.bounds.iter_mut().zip(rows) {
            *bounds = Aabb::around(row.iter().copied());
        }
    }

    /// Whether normals of this leaf are apart by so much that it may reach round others.
    pub fn is_bent_back(&self) -> bool {
        let normals = &self.normals;
        let middle = normals[normals.len() / 2 + self.columns / 2];
        normals.iter().any(|n| dot(*n, middle) < BENT_BACK)
    }

    /// Whether nodes of this leaf come near enough to others of it to touch.
    pub fn is_curled(&self) -> bool {
        let normals = &self.normals;
        let middle = normals[normals.len() / 2 + self.columns / 2];
        normals.iter().any(|n| dot(*n, middle) < -0.2)
    }
}
