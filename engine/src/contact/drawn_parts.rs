//! The drawn mesh of a leaf by its parts, and the triangles of each part in blocks.
//!
//! Few points of one part come near another. So the triangles that are near each other are gathered
//! in blocks, each with its box and two planes around it, and what is clear of these is clear of them.

use super::aabb::Aabb;
use super::slab::Slab;
use crate::grid::{cells, cut_cell};
use crate::paper_mesh::PaperMesh;
use core::ops::Range;

/// Cells along a side of a block of triangles that one box bounds.
pub const BLOCK: usize = 3;

/// The triangles of a folded leaf's drawn mesh, by the parts between its creases.
#[derive(Clone, Debug, Default)]
pub struct DrawnParts {
    /// The block of each point; None for those on creases and at the spine.
    pub(super) homes: Vec<Option<usize>>,
    pub triangles: Vec<[usize; 3]>,
    /// The points of the blocks, of one after the other.
    pub corners: Vec<usize>,
    /// The same without those at the spine, and each in one block alone.
    pub own_points: Vec<usize>,
    /// The edges of the blocks, each in one block alone, between two of its points by their places
    /// among these.
    pub edges: Vec<[u8; 2]>,
    pub blocks: Vec<Block>,
    /// What the points of the blocks may overlap, of one after the other.
    pub(super) pairs: Vec<Pair>,
    /// Where the points were when they were looked at last; empty where they never were.
    pub(super) seen: Vec<[f32; 3]>,
    columns: usize,
}

/// Triangles of one part that are near each other.
#[derive(Clone, Debug)]
pub struct Block {
    pub part: u16,
    /// Its triangles, and their points, each once.
    pub triangles: Range<usize>,
    pub corners: Range<usize>,
    /// Its own points and edges: see [`DrawnParts::own_points`].
    pub own_points: Range<usize>,
    pub edges: Range<usize>,
    /// The box around them now.
    pub(super) bounds: Aabb,
    /// Where it lies between two planes; found where it is asked for.
    pub(super) slab: Option<Slab>,
    /// The blocks that its points may overlap.
    pub(super) pairs: Range<usize>,
}

/// A block of another part that points may overlap, and on which side of it they lie, 1 that of
/// its slab's normal or -1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    pub under: usize,
    pub side: f32,
    /// Whether they lie on the other side of triangles that do not face as their block does.
    pub by_facing: bool,
}

impl Block {
    /// Finds the box around its triangles.
    pub(super) fn bound(&mut self, points: &[[f32; 3]], corners: &[usize]) {
        let corners = corners[self.corners.clone()].iter();
        self.bounds = Aabb::around(corners.map(|node| points[*node]));
        self.slab = None;
    }

    pub(super) fn is_near(&self, bounds: &Aabb, within: f32) -> bool {
        self.bounds.grown([within; 3]).overlaps(bounds)
    }
}

impl DrawnParts {
    /// Those of a mesh with so many columns and points, whose triangles each belong to a part.
    pub fn new(columns: usize, count: usize, triangles: &[([usize; 3], u16)]) -> DrawnParts {
        let mut points: Vec<Option<Option<u16>>> = vec![None; count];
        for (corners, part) in triangles {
            for corner in corners {
                let own = points[*corner].get_or_insert(Some(*part));
                if *own != Some(*part) {
                    *own = None;
                }
            }
        }
        let block_of = |corners: &[usize; 3]| {
            let [a, ..] = *corners;
            (a / columns / BLOCK, a % columns / BLOCK)
        };
        let mut order: Vec<&([usize; 3], u16)> = triangles.iter().collect();
        order.sort_by_key(|(corners, part)| (*part, block_of(corners)));
        let mut blocks: Vec<Block> = Vec::new();
        for (at, (corners, part)) in order.iter().enumerate() {
            let goes_on = at > 0 && {
                let (before, of) = order[at - 1];
                of == part && block_of(before) == block_of(corners)
            };
            match blocks.last_mut() {
                Some(block) if goes_on => block.triangles.end = at + 1,
                _ => blocks.push(Block {
                    part: *part,
                    triangles: at..at + 1,
                    corners: 0..0,
                    own_points: 0..0,
                    edges: 0..0,
                    bounds: Aabb::EMPTY,
                    slab: None,
                    pairs: 0..0,
                }),
            }
        }
        let triangles: Vec<[usize; 3]> = order.into_iter().map(|(corners, _)| *corners).collect();
        let mut corners = Vec::new();
        let mut homes = vec![None; count];
        let (mut own_points, mut edges) = (Vec::new(), Vec::new());
        let mut is_taken = vec![false; count];
        // Of each edge only one block's.
        let mut is_known = vec![0u8; count];
        for (number, block) in blocks.iter_mut().enumerate() {
            let first = [own_points.len(), edges.len()];
            let mut own = triangles[block.triangles.clone()].as_flattened().to_vec();
            own.sort_unstable();
            own.dedup();
            let place = |node: usize| own.partition_point(|known| *known < node) as u8;
            for &[a, b, c] in &triangles[block.triangles.clone()] {
                for node in [a, b, c] {
                    if !node.is_multiple_of(columns) && !is_taken[node] {
                        is_taken[node] = true;
                        own_points.push(node);
                    }
                }
                for [p, q] in [[a, b], [b, c], [a, c]] {
                    let [from, to] = [p.min(q), p.max(q)];
                    // An edge leads a column on, or a row on and at most a column back or on.
                    let way = match to - from {
                        1 => 1,
                        step => 2 << (step + 1 - columns),
                    };
                    if is_known[from] & way == 0 {
                        is_known[from] |= way;
                        edges.push([from, to].map(place));
                    }
                }
            }
            block.own_points = first[0]..own_points.len();
            block.edges = first[1]..edges.len();
            for corner in &own {
                // The column at the spine is everyone's.
                let is_free = !corner.is_multiple_of(columns);
                if is_free && points[*corner].flatten() == Some(block.part) {
                    homes[*corner] = Some(number);
                }
            }
            block.corners = corners.len()..corners.len() + own.len();
            corners.extend(own);
        }
        DrawnParts {
            homes,
            triangles,
            corners,
            own_points,
            edges,
            blocks,
            pairs: Vec::new(),
            seen: Vec::new(),
            columns,
        }
    }

    /// Those of a mesh with so many columns.
    pub fn of(mesh: &PaperMesh, columns: usize) -> DrawnParts {
        let triangles: Vec<_> = mesh.parted_triangles().collect();
        DrawnParts::new(columns, mesh.places.len(), &triangles)
    }

    /// The one part of a whole leaf's mesh of so many columns and rows.
    pub fn whole(columns: usize, rows: usize) -> DrawnParts {
        let triangles = cells(columns, rows).flat_map(|foot| cut_cell(foot, columns, false));
        let triangles: Vec<_> = triangles.map(|corners| (corners, 0)).collect();
        DrawnParts::new(columns, columns * rows, &triangles)
    }

    /// Whether a point is bound at the spine.
    pub fn is_bound(&self, node: usize) -> bool {
        node.is_multiple_of(self.columns)
    }

    /// Forgets where the points were, as other creases are folded, or otherwise.
    pub fn forget(&mut self) {
        self.seen.clear();
    }

    /// Of each block whether any corner is elsewhere than in `seen`, where the points were looked at last
    /// (empty where they never were); all count as looked at now.
    pub(super) fn find_moved(&self, points: &[[f32; 3]], seen: &mut Vec<[f32; 3]>) -> Vec<bool> {
        let has_moved = |node: &usize| seen.get(*node) != Some(&points[*node]);
        let moved = self.blocks.iter().map(|block| {
            let mut corners = self.corners[block.corners.clone()].iter();
            corners.any(has_moved)
        });
        let moved = moved.collect();
        seen.clear();
        seen.extend_from_slice(points);
        moved
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Otherwise edges of one leaf go through triangles of another unseen, or are pushed twice.
    #[test]
    fn every_edge_of_a_mesh_is_in_one_block() {
        let (columns, rows) = (9, 7);
        let parts = DrawnParts::whole(columns, rows);
        let of_block = |block: &Block| {
            let corners = &parts.corners[block.corners.clone()];
            let edges = parts.edges[block.edges.clone()].iter();
            edges
                .map(|edge| edge.map(|end| corners[usize::from(end)]))
                .collect::<Vec<_>>()
        };
        let mut found: Vec<[usize; 2]> = parts.blocks.iter().flat_map(of_block).collect();
        let sides = |&[a, b, c]: &[usize; 3]| [[a, b], [b, c], [a, c]];
        let mut all: Vec<[usize; 2]> = parts.triangles.iter().flat_map(sides).collect();
        for edge in found.iter_mut().chain(&mut all) {
            edge.sort_unstable();
        }
        found.sort_unstable();
        all.sort_unstable();
        all.dedup();
        assert_eq!(found, all);
    }
}
