//! Leaves of which at least one is creased, kept clear of each other as they are drawn.
//!
//! A whole leaf is one surface: next to a point of another it has one nearest facet, and points
//! and middles of edges are enough ([`separate`](super::separate)). A folded one lies in layers,
//! and ends in folds and rims over the middle of its neighbour. So every part of it counts by
//! itself: points of either leaf are kept on their side of the triangles of each part of the
//! other, and edges that still go through a triangle are moved off it where they are deepest,
//! which is where they pass its rim.

use super::aabb::Aabb;
use super::drawn_parts::{BLOCK, Block};
use super::parted_leaf::{MovedLeaf, Order, PartedLeaf, PlacedBlocks};
use super::tolerance::{NOT_UPON, ROOM_FROM_SPINE, SLACK, SLIVER};
use super::work::Work;
use crate::triangle::{EdgePlace, Triangle};

/// Work of looking at two blocks, at a point beside a block or a triangle, and at a triangle,
/// nanoseconds.
const BLOCKS: u32 = 3;
const POINT: u32 = 2;
const TRIANGLE: u32 = 10;

/// Corners of a block, at most.
const CORNERS: usize = (BLOCK + 1) * (BLOCK + 1);

/// Where a place is too low over a triangle, or in it.
#[derive(Clone, Copy)]
struct Overlap {
    corners: [usize; 3],
    weights: [f32; 3],
    /// The side of the triangle on which the place is to be, the direction in which it is to go,
    /// and by how much, metres.
    side: f32,
    normal: [f32; 3],
    missing: f32,
}

/// Distance that is kept at a place: all leaves meet in one line at the spine.
fn room_at(place: [f32; 3], scale: f32) -> f32 {
    let away = (place[0] * place[0] + place[2] * place[2]).sqrt();
    let most = ROOM_FROM_SPINE * scale;
    if away < most {
        away / most * scale
    } else {
        scale
    }
}

/// By how much a place at a height over a triangle is too low, metres; None where it is not, or
/// where it was never over it.
fn missing(place: [f32; 3], height: f32, scale: f32) -> Option<f32> {
    if height >= SLIVER * scale || height < -NOT_UPON * scale {
        return None;
    }
    let room = room_at(place, scale);
    let missing = SLIVER * room - height;
    (missing > SLACK * room).then_some(missing)
}

/// Where an edge that goes through a triangle is lowest, and by how much it is too low there,
/// metres, if it was ever over the triangle; None where it is nowhere under it.
fn lowest_over(
    ends: [[f32; 3]; 2],
    triangle: &Triangle,
    scale: f32,
) -> Option<(EdgePlace, Option<f32>)> {
    let lowest = triangle.lowest_of_edge(ends)?;
    if lowest.height >= 0.0 {
        return None;
    }
    let place = core::array::from_fn(|i| ends[0][i] + lowest.way * (ends[1][i] - ends[0][i]));
    let missing = missing(place, lowest.height, scale);
    Some((lowest, missing))
}

/// Moves a leaf off another, once, in their order. Lengths are those of a page 0.14 m wide. Only what
/// has moved since it was looked at last is looked at.
pub fn push_off_leaf(
    own: &mut MovedLeaf<'_>,
    other: &PartedLeaf<'_>,
    placed: &mut PlacedBlocks,
    order: Order,
    work: &mut Work,
) -> Outcome {
    let has_moved = own.parts.find_moved(own.points, own.seen);
    let scale = order.scale;
    let (over, under, has_covered) =
        find_pairs(&own.parted(), &has_moved, other, placed, order, work);
    let mut outcome = if has_covered {
        Outcome::Covered
    } else {
        Outcome::Clear
    };
    // Its points off the other's triangles.
    for pairs in over.chunk_by(|a, b| a[0] == b[0]) {
        let found = deepest(&own.parted(), pairs, other, order, placed, work);
        for (node, found) in found {
            own.push([node], [1.0], found.normal, found.missing);
            outcome = Outcome::Moved;
        }
    }
    // Its triangles off the other's points. What was pushed off one may be off the next.
    let mut own_placed = PlacedBlocks::of(&own.parted());
    for pairs in under.chunk_by(|a, b| a[0] == b[0]) {
        let order = order.reversed();
        let found = deepest(other, pairs, &own.parted(), order, &mut own_placed, work);
        for (node, found) in found {
            let place = other.points[node];
            let triangle = Triangle::of(own.at(found.corners), found.side);
            if let Some(missing) = missing(place, triangle.height(place), scale) {
                own.push(found.corners, found.weights, triangle.normal, -missing);
                outcome = Outcome::Moved;
            }
        }
    }
    // Edges that still go through triangles.
    for pair in over {
        let [block, other_block] = pair;
        if under.binary_search(&[other_block, block]).is_err() {
            continue;
        }
        let facing = order.side_of((&own.parted(), block), (other, other_block));
        let slab = placed.slab(other, other_block);
        let bounds = own.parted().box_of(&own.parts.blocks[block]);
        if own.parted().is_clear_of(block, &bounds, &slab, facing, 0.0) {
            continue;
        }
        outcome = outcome.max(push_edges_off(
            own,
            other,
            (pair, Edges::Own),
            [facing, scale],
            work,
        ));
        let facing = order
            .reversed()
            .side_of((other, other_block), (&own.parted(), block));
        outcome = outcome.max(push_edges_off(
            own,
            other,
            (pair, Edges::Others),
            [facing, scale],
            work,
        ));
    }
    outcome
}

/// What was found when a leaf was moved off another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Outcome {
    /// It goes through the other nowhere, and lies clear of it.
    Clear,
    /// The same but for what lies under the other: that yields to it.
    Covered,
    /// Some of it was moved.
    Moved,
    /// It goes through the other, and was never upon it there.
    Crosses,
}

impl Outcome {
    /// Of an edge that goes through a triangle, and is moved by so much if it is.
    fn of_edge(missing: Option<f32>) -> Outcome {
        missing.map_or(Outcome::Crosses, |_| Outcome::Moved)
    }
}

/// The blocks of a leaf whose points may be too low over a block of another, with that; and the
/// blocks of the other with those of the leaf. Blocks that lie under one of the other are left out: it
/// is that one which yields. Whether there are any comes last.
fn find_pairs(
    own: &PartedLeaf<'_>,
    has_moved: &[bool],
    other: &PartedLeaf<'_>,
    placed: &mut PlacedBlocks,
    order: Order,
    work: &mut Work,
) -> (Vec<[usize; 2]>, Vec<[usize; 2]>, bool) {
    let mut has_covered = false;
    let scale = order.scale;
    let mut own_placed = PlacedBlocks::of(own);
    let [mut over, mut under] = [Vec::new(), Vec::new()];
    let (within, gap) = (NOT_UPON * scale, SLIVER * scale);
    let all = placed.around();
    let others: Vec<usize> = (0..other.parts.blocks.len())
        .filter(|block| !other.is_covered(*block))
        .collect();
    let blocks = (0..own.parts.blocks.len()).filter(|block| has_moved[*block]);
    for block in blocks.filter(|block| !own.is_covered(*block)) {
        let bounds = own_placed.boxes[block];
        let near = bounds.grown([within; 3]);
        if !near.overlaps(&all) {
            continue;
        }
        work.spend(BLOCKS * others.len() as u32);
        for other_block in others.iter().copied() {
            let other_bounds = placed.boxes[other_block];
            if !near.overlaps(&other_bounds) {
                continue;
            }
            work.spend(POINT * CORNERS as u32);
            // What a plane parts is clear, from either side.
            let slab = placed.slab(other, other_block);
            let facing = order.side_of((own, block), (other, other_block));
            if own.is_clear_of(block, &bounds, &slab, facing, gap) {
                continue;
            }
            let own_slab = own_placed.slab(own, block);
            let facing = order.reversed().side_of((other, other_block), (own, block));
            work.spend(POINT * CORNERS as u32);
            if other.is_clear_of(other_block, &other_bounds, &own_slab, facing, gap) {
                continue;
            }
            if order.is_under((own, block), (other, other_block)) {
                has_covered = true;
                continue;
            }
            if !placed.is_beside(&bounds, other_block, &slab, scale) {
                over.push([block, other_block]);
            }
            if !own_placed.is_beside(&other_bounds, block, &own_slab, scale) {
                under.push([other_block, block]);
            }
        }
    }
    under.sort_unstable();
    (over, under, has_covered)
}

/// How points of a block, the first of all these pairs, are too low over triangles of another leaf
/// in the second blocks: of each part that over which one is too low by least, and of the parts the
/// one over which it is so by most.
fn deepest(
    leaf: &PartedLeaf<'_>,
    pairs: &[[usize; 2]],
    other: &PartedLeaf<'_>,
    order: Order,
    placed: &mut PlacedBlocks,
    work: &mut Work,
) -> Vec<(usize, Overlap)> {
    let scale = order.scale;
    // By points and parts.
    let mut found: Vec<(usize, u16, Overlap)> = Vec::new();
    let own_points = leaf.parts.blocks[pairs[0][0]].own_points.clone();
    let nodes = &leaf.parts.own_points[own_points];
    let mut near = Vec::with_capacity(CORNERS);
    for [own, block] in pairs {
        let facing = order.side_of((leaf, *own), (other, *block));
        let slab = placed.slab(other, *block);
        let is_near = |node: &usize| slab.distance_of(leaf.points[*node], facing) < SLIVER * scale;
        near.clear();
        near.extend(nodes.iter().copied().filter(is_near));
        let Block {
            part, triangles, ..
        } = &other.parts.blocks[*block];
        work.spend(POINT * nodes.len() as u32);
        if near.is_empty() {
            continue;
        }
        work.spend((TRIANGLE + POINT * near.len() as u32) * triangles.len() as u32);
        for corners in &other.parts.triangles[triangles.clone()] {
            let triangle = Triangle::of(corners.map(|corner| other.points[corner]), facing);
            for node in near.iter().copied() {
                let point = leaf.points[node];
                // Most are beside it.
                let Some(weights) = triangle.weights_over(point) else {
                    continue;
                };
                let Some(missing) = missing(point, triangle.height(point), scale) else {
                    continue;
                };
                let known = found
                    .iter_mut()
                    .find(|(of, on, _)| (*of, on) == (node, part));
                if known
                    .as_ref()
                    .is_some_and(|known| known.2.missing <= missing)
                {
                    continue;
                }
                let here = Overlap {
                    corners: *corners,
                    weights,
                    side: facing,
                    normal: triangle.normal,
                    missing,
                };
                match known {
                    Some(known) => known.2 = here,
                    None => found.push((node, *part, here)),
                }
            }
        }
    }
    let mut of_points: Vec<(usize, Overlap)> = Vec::with_capacity(found.len());
    for (node, _, overlap) in found {
        match of_points.iter_mut().find(|(of, _)| *of == node) {
            Some(known) if known.1.missing < overlap.missing => known.1 = overlap,
            Some(_) => {}
            None => of_points.push((node, overlap)),
        }
    }
    of_points
}

/// Whose edges go through whose triangles, of a leaf that is moved and another.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Edges {
    Own,
    Others,
}

/// Moves a block of a leaf and a block of another off each other where edges of one go through
/// triangles of the other.
fn push_edges_off(
    own: &mut MovedLeaf<'_>,
    other: &PartedLeaf<'_>,
    ([block, other_block], edges): ([usize; 2], Edges),
    [side, scale]: [f32; 2],
    work: &mut Work,
) -> Outcome {
    let mut found = Outcome::Clear;
    let parts = own.parts;
    let (triangles, bounds) = match edges {
        Edges::Own => (
            &other.parts.triangles[other.parts.blocks[other_block].triangles.clone()],
            own.parted().box_of(&parts.blocks[block]),
        ),
        Edges::Others => (
            &parts.triangles[parts.blocks[block].triangles.clone()],
            other.box_of(&other.parts.blocks[other_block]),
        ),
    };
    for corners in triangles {
        let at = |own: &MovedLeaf<'_>| match edges {
            Edges::Own => corners.map(|corner| other.points[corner]),
            Edges::Others => own.at(*corners),
        };
        let around = Aabb::around(at(own));
        if !around.overlaps(&bounds) {
            continue;
        }
        let triangle = Triangle::of(at(own), side);
        let through = match edges {
            Edges::Own => edges_through(&triangle, &own.parted(), block, work),
            Edges::Others => edges_through(&triangle, other, other_block, work),
        };
        for edge in through {
            let ends = match edges {
                Edges::Own => edge.map(|node| own.points[node]),
                Edges::Others => edge.map(|node| other.points[node]),
            };
            if !around.overlaps(&Aabb::around(ends)) {
                continue;
            }
            // Where the edge before has moved it.
            let triangle = Triangle::of(at(own), side);
            if let Some((lowest, missing)) = lowest_over(ends, &triangle, scale) {
                let EdgePlace { way, weights, .. } = lowest;
                match (edges, missing) {
                    (Edges::Own, Some(by)) => own.push(edge, [1.0 - way, way], triangle.normal, by),
                    (Edges::Others, Some(by)) => own.push(*corners, weights, triangle.normal, -by),
                    (_, None) => {}
                }
                found = found.max(Outcome::of_edge(missing));
            }
        }
    }
    found
}

/// The edges of a block that go through the plane of a triangle.
fn edges_through(
    triangle: &Triangle,
    leaf: &PartedLeaf<'_>,
    block: usize,
    work: &mut Work,
) -> Vec<[usize; 2]> {
    let block = &leaf.parts.blocks[block];
    let corners = &leaf.parts.corners[block.corners.clone()];
    work.spend(TRIANGLE + POINT * corners.len() as u32);
    let is_under = |set: u32, (k, node): (usize, &usize)| {
        set | u32::from(triangle.height(leaf.points[*node]) < 0.0) << k
    };
    let under = corners.iter().enumerate().fold(0, is_under);
    if under == 0 || under.count_ones() as usize == corners.len() {
        return Vec::new();
    }
    let edges = leaf.parts.edges[block.edges.clone()].iter();
    let through = edges.filter(|[p, q]| (under >> p ^ under >> q) & 1 == 1);
    through
        .map(|edge| edge.map(|end| corners[usize::from(end)]))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::drawn_parts::DrawnParts;
    use crate::contact::flap_order::FlapOrder;
    use crate::contact::separate_parts::{ROUNDS, tests::folded};

    const COLUMNS: usize = 9;
    const ROWS: usize = 7;

    const ORDER: Order = Order {
        side: 1.0,
        scale: 1.0,
        parts: FlapOrder::NONE,
    };

    /// Points a centimetre apart, from a place on, at a height by column and row.
    fn points(from: [f32; 2], height: impl Fn(usize, usize) -> f32) -> Vec<[f32; 3]> {
        let place = |node: usize| {
            let (column, row) = (node % COLUMNS, node / COLUMNS);
            let [x, y] = [column, row].map(|k| k as f32 * 0.01);
            [x + from[0], y + from[1], height(column, row)]
        };
        (0..COLUMNS * ROWS).map(place).collect()
    }

    /// Moves a whole leaf up, off another that is under it. Returns what was found in the end.
    fn move_off(own: &mut [[f32; 3]], other: &PartedLeaf<'_>) -> Outcome {
        let parts = DrawnParts::whole(COLUMNS, ROWS);
        let mut placed = PlacedBlocks::of(other);
        let (mut seen, mut found) = (Vec::new(), Outcome::Clear);
        for _ in 0..ROUNDS {
            let leaf = &mut MovedLeaf {
                points: own,
                parts: &parts,
                shut: 0,
                covered: &[],
                seen: &mut seen,
            };
            found = push_off_leaf(leaf, other, &mut placed, ORDER, &mut Work::new(u32::MAX));
        }
        found
    }

    /// No point of either is near the other's triangles.
    #[test]
    fn a_valley_is_moved_off_a_ridge_across_it_between_the_points_of_both() {
        let mut own = points([0.0; 2], |_, row| if row == 3 { -1e-4 } else { 2e-3 });
        let ridge = points([5e-3; 2], |column, _| if column == 4 { 0.0 } else { -2e-3 });
        let other = PartedLeaf {
            points: &ridge,
            parts: &DrawnParts::whole(COLUMNS, ROWS),
            shut: 0,
            covered: &[],
        };
        assert_eq!(move_off(&mut own, &other), Outcome::Clear);
        let [before, after] = [4, 5].map(|column| own[3 * COLUMNS + column][2]);
        assert!(0.5 * (before + after) > 0.0, "{before} {after}");
        assert_eq!(own[3 * COLUMNS + 1][2], -1e-4, "the rest stays");
    }

    /// Of the page under the flap it is clear, and nearer to that.
    #[test]
    fn a_leaf_between_a_page_and_its_flap_is_moved_over_both() {
        let (under, parts) = folded(1e-3);
        let other = PartedLeaf {
            points: &under,
            parts: &parts,
            shut: 1,
            covered: &[],
        };
        let mut own = points([0.0; 2], |_, _| 3e-4);
        assert_eq!(move_off(&mut own, &other), Outcome::Clear);
        for row in 0..ROWS {
            // The flap reaches from the fold, at 40 mm, to 5 mm.
            for column in 1..=3 {
                let height = own[row * COLUMNS + column][2];
                assert!(height > 1e-3, "{height} at column {column}, row {row}");
            }
            assert_eq!(own[row * COLUMNS + 6][2], 3e-4, "beyond the fold it stays");
        }
    }

    /// As where the flap lies on the other side of its page.
    #[test]
    fn a_part_that_others_cover_is_not_met() {
        let (under, parts) = folded(1e-3);
        let other = PartedLeaf {
            points: &under,
            parts: &parts,
            shut: 1,
            covered: &[1],
        };
        let before = points([0.0; 2], |_, _| 3e-4);
        let mut own = before.clone();
        assert_eq!(move_off(&mut own, &other), Outcome::Clear);
        assert_eq!(own, before);
    }

    #[test]
    fn a_leaf_that_lies_clear_of_a_folded_one_stays() {
        let (under, parts) = folded(1e-3);
        let other = PartedLeaf {
            points: &under,
            parts: &parts,
            shut: 1,
            covered: &[],
        };
        let before = points([0.0; 2], |_, _| 1.1e-3);
        let mut own = before.clone();
        assert_eq!(move_off(&mut own, &other), Outcome::Clear);
        assert_eq!(own, before);
    }
}
