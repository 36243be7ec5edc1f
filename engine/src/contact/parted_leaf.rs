//! A drawn leaf by its parts, and how two such leaves lie to each other.

use super::aabb::Aabb;
use super::drawn_parts::{Block, DrawnParts};
use super::flap_order::FlapOrder;
use super::flaps::is_turned_over;
use super::slab::Slab;
use super::tolerance::NOT_UPON;
use crate::triangle::BESIDE;
use crate::vector::dot;

/// A drawn leaf and its parts.
#[derive(Clone, Copy)]
pub struct PartedLeaf<'a> {
    pub points: &'a [[f32; 3]],
    pub parts: &'a DrawnParts,
    /// Its creases that are [shut](super::flaps::Flaps::shut).
    pub shut: u16,
    /// Parts that others cover on the side where the other leaf lies, which meets none of them.
    pub covered: &'a [u16],
}

/// How two leaves lie to each other.
#[derive(Clone, Copy, Debug)]
pub struct Order {
    /// 1 where the leaf that is moved lies on the recto's side of the other, or -1.
    pub side: f32,
    /// How much wider it is than a page of 0.14 m.
    pub scale: f32,
    /// How its parts lie upon those of the other.
    pub parts: FlapOrder,
}

impl Order {
    /// The same as seen from the other leaf.
    pub(super) fn reversed(self) -> Order {
        Order {
            side: -self.side,
            parts: self.parts.reversed(),
            ..self
        }
    }

    /// Whether a block lies under one of the other leaf, where both lie open.
    pub(super) fn is_under(
        self,
        (leaf, block): (&PartedLeaf<'_>, usize),
        (other, over): (&PartedLeaf<'_>, usize),
    ) -> bool {
        self.parts
            .is_under(leaf.is_turned_over(block), other.is_turned_over(over))
    }

    /// On which side of the triangles of a block of another leaf a block lies, 1 that of their normals
    /// or -1.
    pub(super) fn side_of(
        self,
        (leaf, block): (&PartedLeaf<'_>, usize),
        (other, under): (&PartedLeaf<'_>, usize),
    ) -> f32 {
        if other.is_turned_over(under) != self.is_under((leaf, block), (other, under)) {
            -self.side
        } else {
            self.side
        }
    }
}

/// Where the blocks of a leaf are.
pub struct PlacedBlocks {
    pub(super) boxes: Vec<Aabb>,
    slabs: Vec<Option<Slab>>,
}

impl PlacedBlocks {
    pub fn of(leaf: &PartedLeaf<'_>) -> PlacedBlocks {
        let blocks = leaf.parts.blocks.iter();
        let boxes: Vec<_> = blocks.map(|block| leaf.box_of(block)).collect();
        PlacedBlocks {
            slabs: vec![None; boxes.len()],
            boxes,
        }
    }

    pub(super) fn slab(&mut self, leaf: &PartedLeaf<'_>, block: usize) -> Slab {
        *self.slabs[block].get_or_insert_with(|| {
            let triangles = leaf.parts.blocks[block].triangles.clone();
            Slab::around(leaf.points, &leaf.parts.triangles[triangles])
        })
    }

    /// The box around all.
    pub(super) fn around(&self) -> Aabb {
        let mut all = Aabb::EMPTY;
        self.boxes.iter().for_each(|one| all.unite(one));
        all
    }

    /// Whether a box is beside a block: nowhere over its triangles or under them, or deeper than what overlaps.
    pub(super) fn is_beside(&self, bounds: &Aabb, block: usize, slab: &Slab, scale: f32) -> bool {
        let own = &self.boxes[block];
        let size = own.size();
        let beyond = BESIDE * dot(size, size).sqrt();
        let within = slab.normal.map(|n| NOT_UPON * scale * n.abs() + beyond);
        !own.grown(within).overlaps(bounds)
    }
}

impl PartedLeaf<'_> {
    pub(super) fn box_of(&self, block: &Block) -> Aabb {
        let corners = self.parts.corners[block.corners.clone()].iter();
        Aabb::around(corners.map(|node| self.points[*node]))
    }

    pub(super) fn is_covered(&self, block: usize) -> bool {
        self.covered.contains(&self.parts.blocks[block].part)
    }

    pub(super) fn is_turned_over(&self, block: usize) -> bool {
        is_turned_over(self.parts.blocks[block].part, self.shut)
    }

    /// Whether every corner of a block is so far from the triangles in a slab, on a side.
    pub(super) fn is_clear_of(
        &self,
        block: usize,
        bounds: &Aabb,
        slab: &Slab,
        side: f32,
        gap: f32,
    ) -> bool {
        let corners = &self.parts.corners[self.parts.blocks[block].corners.clone()];
        slab.distance(bounds, side) >= gap
            || corners
                .iter()
                .all(|node| slab.distance_of(self.points[*node], side) >= gap)
    }
}

/// A leaf that is moved.
pub struct MovedLeaf<'a> {
    pub points: &'a mut [[f32; 3]],
    pub parts: &'a DrawnParts,
    pub shut: u16,
    /// See [`PartedLeaf::covered`].
    pub covered: &'a [u16],
    /// Where its points were when they were looked at last; empty where they never were.
    pub seen: &'a mut Vec<[f32; 3]>,
}

impl MovedLeaf<'_> {
    pub(super) fn parted(&self) -> PartedLeaf<'_> {
        PartedLeaf {
            points: self.points,
            parts: self.parts,
            shut: self.shut,
            covered: self.covered,
        }
    }

    pub(super) fn at(&self, corners: [usize; 3]) -> [[f32; 3]; 3] {
        corners.map(|corner| self.points[corner])
    }

    /// See [`DrawnParts::push`].
    pub(super) fn push<const N: usize>(
        &mut self,
        nodes: [usize; N],
        weights: [f32; N],
        normal: [f32; 3],
        by: f32,
    ) {
        self.parts.push(self.points, (&nodes, &weights), normal, by);
    }
}
