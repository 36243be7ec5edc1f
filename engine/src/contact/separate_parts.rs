//! Parts of a folded leaf, as they are drawn, kept clear of each other.
//!
//! Contact between parts is of nodes with triangles between nodes (`flaps.rs`); the drawn parts
//! bend between their nodes, and so a little into each other. Here each drawn point of a part is
//! brought to the side of the triangles of another on which its creases have it lie, by the same
//! projections as leaves are kept clear of each other by ([`separate`](super::separate)). Of two
//! parts the one that is farther up moves, as the other lies on something.
//!
//!
//! Few points overlap anything: only those are looked at that are near a [block](super::drawn_parts)
//! of another part and not on their side of all its triangles.

use super::aabb::Aabb;
use super::drawn_parts::{Block, DrawnParts, Pair};
use super::flaps::Flaps;
use super::slab::Slab;
use super::tolerance::{DEEP, NOT_UPON, OVER_PILE, SLACK};
use super::work::Work;
use crate::surface::Surface;
use crate::triangle::{BESIDE, EdgePlace, Triangle, area_normal};
use crate::vector::dot;

/// Rounds of projections, at most.
pub const ROUNDS: usize = 4;

/// Work of comparing two blocks, of finding two that may overlap, of looking at a point beside a
/// block, and at a triangle next to a point, nanoseconds: a dog-ear that turns counts 24 us, a
/// letter 460. One lying with 16 pairs was measured to take some 20, one with 290 some 310.
const BLOCKS: u32 = 1;
const PAIR: u32 = 500;
const POINT: u32 = 5;
const TRIANGLE: u32 = 15;

/// A place whose nodes hardly move with it moves them by no more than if the squares of their weights
/// came to this.
pub const LEAST_WEIGHT: f32 = 0.1;

/// How thoroughly parts are moved off each other.
#[derive(Clone, Copy)]
pub struct Rounds {
    /// How much wider the page is than one of 0.14 m.
    pub scale: f32,
    /// At most.
    pub most: usize,
    /// Whether edges are moved off triangles as well, and not points alone.
    pub edges: bool,
}

/// Where a point is too low over a triangle of another part.
struct Overlap {
    corners: [usize; 3],
    /// How near the point is to each corner, 0 to 1.
    weights: [f32; 3],
    /// The direction in which the point is to go, and by how much, metres.
    normal: [f32; 3],
    missing: f32,
}

impl DrawnParts {
    /// Moves the drawn parts of a folded leaf off each other, to the sides to which they are folded,
    /// in some rounds: see [`separate`](Self::separate).
    pub fn separate_flaps(
        &mut self,
        surface: &mut Surface,
        flaps: &Flaps,
        rounds: Rounds,
        work: &mut Work,
    ) -> bool {
        let points = surface.positions.as_chunks_mut::<3>().0;
        let side = |under, part, is_alike| flaps.drawn_side(under, part, is_alike);
        self.separate(points, rounds, side, work)
    }

    /// Moves parts out of each other that overlap, in some rounds at most, and in one where no
    /// work is left; returns whether any did in the last. `side` says on which side of a triangle of a
    /// part a point of another lies, 1 that of its normal or -1, if the normals of both are along each
    /// other or not; None where it may lie on either. Lengths are those of a page 0.14 m wide; its own
    /// is wider by `scale`. Only what has moved since it was looked at last is looked at.
    pub fn separate(
        &mut self,
        points: &mut [[f32; 3]],
        Rounds { scale, most, edges }: Rounds,
        side: impl Fn(u16, u16, bool) -> Option<f32>,
        work: &mut Work,
    ) -> bool {
        let mut moved = false;
        for round in 0..most {
            if round > 0 && work.is_spent() {
                break;
            }
            moved = false;
            let mut seen = core::mem::take(&mut self.seen);
            let has_moved = self.find_moved(points, &mut seen);
            self.seen = seen;
            if !has_moved.contains(&true) {
                break;
            }
            self.find_pairs(points, scale, &has_moved, &side);
            let blocks = self.blocks.len() as u32;
            work.spend(BLOCKS * blocks * blocks + PAIR * self.pairs.len() as u32);
            for node in 0..self.homes.len() {
                let Some(home) = self.homes[node] else {
                    continue;
                };
                let mut under = None;
                // Of each part at most one triangle is next to the point.
                for pair in &self.pairs[self.blocks[home].pairs.clone()] {
                    let block = &self.blocks[pair.under];
                    work.spend(POINT);
                    let place = Aabb::around([points[node]]);
                    if !may_overlap(block, &place, pair.side, scale) {
                        continue;
                    }
                    work.spend(TRIANGLE * block.triangles.len() as u32);
                    for corners in &self.triangles[block.triangles.clone()] {
                        let side = self.side_of(pair, corners.map(|corner| points[corner]));
                        let found = overlap(points, node, *corners, side, scale);
                        let is_nearer = |found: &Overlap| {
                            under
                                .as_ref()
                                .is_none_or(|known: &Overlap| found.missing < known.missing)
                        };
                        if let Some(found) = found.filter(is_nearer) {
                            under = Some(found);
                        }
                    }
                }
                if let Some(Overlap {
                    corners,
                    weights,
                    normal,
                    missing,
                }) = under
                {
                    let triangle = (&corners[..], &weights[..]);
                    self.push_apart(points, (&[node], &[1.0]), triangle, normal, missing);
                    moved = true;
                }
            }
            for home in (0..self.blocks.len()).filter(|_| edges) {
                moved |= self.push_edges_apart(points, home, scale, work);
            }
            if !moved {
                break;
            }
        }
        moved
    }

    /// Finds which blocks may overlap each other where the points are now, of which one has moved.
    fn find_pairs(
        &mut self,
        points: &[[f32; 3]],
        scale: f32,
        has_moved: &[bool],
        side: &impl Fn(u16, u16, bool) -> Option<f32>,
    ) {
        for block in &mut self.blocks {
            block.bound(points, &self.corners);
        }
        self.pairs.clear();
        for home in 0..self.blocks.len() {
            let Block { part, bounds, .. } = self.blocks[home];
            let start = self.pairs.len();
            for under in 0..self.blocks.len() {
                let block = &self.blocks[under];
                if block.part == part
                    || !(has_moved[home] || has_moved[under])
                    || !block.is_near(&bounds, NOT_UPON * scale)
                {
                    continue;
                }
                let of_part = block.part;
                let [Some(alike), Some(opposed)] =
                    [true, false].map(|is_alike| side(of_part, part, is_alike))
                else {
                    continue;
                };
                let [own, other] = [home, under].map(|block| self.normal_of(block, points));
                let side = if dot(own, other) > 0.0 {
                    alike
                } else {
                    opposed
                };
                if may_overlap(&self.blocks[under], &bounds, side, scale) {
                    self.pairs.push(Pair {
                        under,
                        side,
                        by_facing: alike != opposed,
                    });
                }
            }
            self.blocks[home].pairs = start..self.pairs.len();
        }
    }

    /// The mean normal of a block.
    fn normal_of(&mut self, block: usize, points: &[[f32; 3]]) -> [f32; 3] {
        let block = &mut self.blocks[block];
        let triangles = &self.triangles[block.triangles.clone()];
        let slab = { &mut block.slab }.get_or_insert_with(|| Slab::around(points, triangles));
        slab.normal
    }

    /// Moves edges of a block and triangles that they go under apart, where they are lowest: between
    /// its points a part may go through another that is dented. Returns whether any were moved.
    fn push_edges_apart(
        &self,
        points: &mut [[f32; 3]],
        home: usize,
        scale: f32,
        work: &mut Work,
    ) -> bool {
        let block = &self.blocks[home];
        let nodes = &self.corners[block.corners.clone()];
        let mut moved = false;
        for pair in &self.pairs[block.pairs.clone()] {
            let under = &self.blocks[pair.under];
            if !under.bounds.overlaps(&block.bounds) {
                continue;
            }
            for corners in &self.triangles[under.triangles.clone()] {
                work.spend(TRIANGLE);
                let at = corners.map(|corner| points[corner]);
                let triangle = Triangle::of(at, self.side_of(pair, at));
                let is_under = |set: u32, (k, node): (usize, &usize)| {
                    set | u32::from(triangle.height(points[*node]) < 0.0) << k
                };
                let below = nodes.iter().enumerate().fold(0, is_under);
                if below == 0 || below.count_ones() as usize == nodes.len() {
                    continue;
                }
                let edges = self.edges[block.edges.clone()].iter();
                for [p, q] in edges.filter(|[p, q]| (below >> p ^ below >> q) & 1 == 1) {
                    let edge = [p, q].map(|end| nodes[usize::from(*end)]);
                    // Both hang together at a crease.
                    if edge.iter().any(|end| corners.contains(end)) {
                        continue;
                    }
                    work.spend(POINT);
                    let ends = edge.map(|end| points[end]);
                    let Some(lowest) = triangle.lowest_of_edge(ends) else {
                        continue;
                    };
                    // Where an end is deeper it is not facets alone that go through each other but the
                    // paper.
                    let is_grazing = ends.iter().all(|end| triangle.height(*end) > -DEEP * scale);
                    if is_grazing && lowest.height < 0.0 {
                        let EdgePlace { way, weights, .. } = lowest;
                        let by = SLACK * scale - lowest.height;
                        let at = [1.0 - way, way];
                        let under = (&corners[..], &weights[..]);
                        self.push_apart(points, (&edge, &at), under, triangle.normal, by);
                        moved = true;
                    }
                }
            }
        }
        moved
    }

    /// On which side of a triangle of a block the points of a pair lie, 1 that of its normal or -1.
    fn side_of(&self, pair: &Pair, triangle: [[f32; 3]; 3]) -> f32 {
        let slab = self.blocks[pair.under].slab.as_ref();
        let curled = slab.filter(|slab| pair.by_facing && !slab.is_even);
        curled.map_or(pair.side, |slab| {
            pair.side * dot(area_normal(triangle), slab.normal).signum()
        })
    }

    /// Moves a place of some nodes and one of a triangle apart along a normal, each by these weights: of
    /// the two the one that is farther up moves.
    fn push_apart(
        &self,
        points: &mut [[f32; 3]],
        over: (&[usize], &[f32]),
        under: (&[usize], &[f32]),
        normal: [f32; 3],
        missing: f32,
    ) {
        let up = (0.5 + normal[2]).clamp(0.0, 1.0);
        self.push(points, over, normal, up * missing);
        self.push(points, under, normal, (up - 1.0) * missing);
    }

    /// Moves the place that has these weights of some nodes along a normal by so much, and the nodes with
    /// it, but for those at the spine.
    #[inline(never)]
    pub fn push(
        &self,
        points: &mut [[f32; 3]],
        (nodes, weights): (&[usize], &[f32]),
        normal: [f32; 3],
        by: f32,
    ) {
        let free = nodes.iter().zip(weights);
        let free = free.filter(|(node, _)| !self.is_bound(**node));
        let whole: f32 = free.clone().map(|(_, weight)| weight * weight).sum();
        for (node, weight) in free {
            for axis in 0..3 {
                points[*node][axis] += by * weight / whole.max(LEAST_WEIGHT) * normal[axis];
            }
        }
    }
}

/// Whether anything in a box may be too low over triangles of a block, or in them.
fn may_overlap(block: &Block, bounds: &Aabb, side: f32, scale: f32) -> bool {
    let is_clear = |slab: &Slab| {
        let size = block.bounds.size();
        let within = core::array::from_fn(|i| {
            // A corner's weight is up to twice as much beyond 1 as the others' are below 0.
            let beyond = 2.0 * BESIDE * size[i];
            NOT_UPON * scale * slab.lean[i] + OVER_PILE * scale + beyond
        });
        !block.bounds.grown(within).overlaps(bounds)
            || slab.distance(bounds, side) > (OVER_PILE - SLACK) * scale
    };
    block.is_near(bounds, NOT_UPON * scale) && !block.slab.as_ref().is_some_and(is_clear)
}

/// How a point lies too low over a triangle, or in it; None where it does not lie over it.
fn overlap(
    points: &[[f32; 3]],
    node: usize,
    corners: [usize; 3],
    side: f32,
    scale: f32,
) -> Option<Overlap> {
    let triangle = Triangle::of(corners.map(|corner| points[corner]), side);
    let missing = OVER_PILE * scale - triangle.height(points[node]);
    if missing < SLACK * scale || missing > NOT_UPON * scale {
        return None;
    }
    let weights = triangle.weights_over(points[node])?;
    Some(Overlap {
        corners,
        weights,
        normal: triangle.normal,
        missing,
    })
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use crate::grid::{cells, cut_cell};

    const COLUMNS: usize = 9;
    const ROWS: usize = 7;

    const ALL: Rounds = Rounds {
        scale: 1.0,
        most: ROUNDS,
        edges: true,
    };

    /// Two level parts of points a centimetre apart, the second folded over the first: what is
    /// folded at column 4 comes back to 20 mm, `over` metres above it.
    pub fn folded(over: f32) -> (Vec<[f32; 3]>, DrawnParts) {
        let points = (0..COLUMNS * ROWS).map(|node| {
            let (column, y) = (node % COLUMNS, (node / COLUMNS) as f32 * 0.01);
            match column {
                0..=4 => [column as f32 * 0.01, y, 0.0],
                // Half a cell beside those under it.
                _ => [0.04 - (column - 4) as f32 * 0.01 + 0.005, y, over],
            }
        });
        let triangles = cells(COLUMNS, ROWS).flat_map(|foot| {
            let part = u16::from(foot % COLUMNS >= 4);
            cut_cell(foot, COLUMNS, false).map(|corners| (corners, part))
        });
        let triangles: Vec<_> = triangles.collect();
        let parts = DrawnParts::new(COLUMNS, COLUMNS * ROWS, &triangles);
        (points.collect(), parts)
    }

    fn unbounded() -> Work {
        Work::new(u32::MAX)
    }

    fn heights(points: &[[f32; 3]], columns: core::ops::Range<usize>) -> [f32; 2] {
        let of = points.iter().enumerate();
        let of = of.filter(|(node, _)| columns.contains(&(node % COLUMNS)));
        of.fold([f32::MAX, f32::MIN], |[low, high], (_, point)| {
            [low.min(point[2]), high.max(point[2])]
        })
    }

    #[test]
    fn a_flap_that_is_drawn_into_its_page_is_raised_out_of_it() {
        for over in [5e-5f32, 0.0, -1e-3] {
            let (mut points, mut parts) = folded(over);
            parts.separate(&mut points, ALL, |_, _, _| Some(1.0), &mut unbounded());
            assert_eq!(heights(&points, 0..5), [0.0; 2], "the page stays");
            let [low, _] = heights(&points, 5..9);
            assert!(low > 0.5 * OVER_PILE, "{low} from {over}");
        }
    }

    /// Edges that go through a triangle of another part, but for those that end at the fold.
    fn crossings(points: &[[f32; 3]], parts: &DrawnParts) -> usize {
        let of_block = |block: &Block| {
            let triangles = parts.triangles[block.triangles.clone()].iter();
            triangles
                .map(|corners| (block.part, *corners))
                .collect::<Vec<_>>()
        };
        let ends_at_fold =
            |(_, corners): &(u16, [usize; 3])| corners.iter().any(|corner| corner % COLUMNS == 4);
        let all: Vec<(u16, [usize; 3])> = { parts.blocks.iter() }
            .flat_map(of_block)
            .filter(|triangle| !ends_at_fold(triangle))
            .collect();
        let goes_through = |corners: &[usize; 3], edge: [usize; 2]| {
            let triangle = Triangle::of(corners.map(|corner| points[corner]), 1.0);
            let [from, to] = edge.map(|end| points[end]);
            let [a, b] = [from, to].map(|end| triangle.height(end));
            let at = core::array::from_fn(|i| from[i] + a / (a - b) * (to[i] - from[i]));
            let is_within = || triangle.weights(at).iter().all(|weight| *weight > 0.0);
            a * b < 0.0 && !edge.iter().any(|end| corners.contains(end)) && is_within()
        };
        let mut count = 0;
        for (part, corners) in &all {
            for (_, [p, q, r]) in all.iter().filter(|(other, _)| other != part) {
                let edges = [[*p, *q], [*q, *r], [*r, *p]];
                count += edges
                    .iter()
                    .filter(|edge| goes_through(corners, **edge))
                    .count();
            }
        }
        count
    }

    /// Folded over, its cells are cut along the other diagonals, and where both are dented alike these go
    /// through each other between points that are clear.
    #[test]
    fn a_flap_is_raised_where_its_edges_go_through_a_dented_page() {
        let (mut points, mut parts) = folded(0.0);
        for (node, point) in points.iter_mut().enumerate() {
            let (column, row) = (node % COLUMNS, node / COLUMNS);
            let is_flap = column > 4;
            let column = if is_flap { 8 - column } else { column };
            point[0] = column as f32 * 0.01;
            let dent = if (column + row).is_multiple_of(2) {
                4e-4
            } else {
                -4e-4
            };
            point[2] = dent + if is_flap { 1.2 * OVER_PILE } else { 0.0 };
        }
        assert!(crossings(&points, &parts) > 0);
        for _ in 0..3 {
            let upon = |_, _, _| Some(1.0);
            parts.separate(&mut points, ALL, upon, &mut unbounded());
        }
        assert_eq!(crossings(&points, &parts), 0);
    }

    #[test]
    fn what_has_not_moved_is_not_looked_at_again() {
        let (mut points, mut parts) = folded(0.0);
        let upon = |_, _, _| Some(1.0);
        assert!(!parts.separate(&mut points, ALL, upon, &mut unbounded()));
        let mut work = unbounded();
        parts.separate(&mut points, ALL, upon, &mut work);
        assert_eq!(work.done(), 0);
        parts.forget();
        parts.separate(&mut points, ALL, upon, &mut work);
        assert!(work.done() > 0);
    }

    #[test]
    fn a_page_is_raised_off_a_flap_that_lies_under_it() {
        let (mut points, mut parts) = folded(5e-4);
        parts.separate(&mut points, ALL, |_, _, _| Some(-1.0), &mut unbounded());
        let [low, high] = heights(&points, 5..9);
        assert_eq!([low, high], [5e-4; 2], "the flap stays");
        let middle = heights(&points, 2..4)[0];
        assert!(middle > 5e-4, "{middle}");
    }

    #[test]
    fn once_no_work_is_left_parts_are_moved_in_one_round_alone() {
        let rounds = |rounds: usize, most: u32| {
            let (mut points, mut parts) = folded(-1e-3);
            let mut work = Work::new(most);
            let rounds = Rounds {
                most: rounds,
                ..ALL
            };
            parts.separate(&mut points, rounds, |_, _, _| Some(1.0), &mut work);
            (points, work.done())
        };
        let [one, all, spent] = [(1, u32::MAX), (ROUNDS, u32::MAX), (ROUNDS, 1)]
            .map(|(count, most)| rounds(count, most));
        assert!(0 < one.1 && one.1 < all.1, "{} of {}", one.1, all.1);
        assert_eq!(spent, one);
    }

    #[test]
    fn what_lies_clear_or_on_either_side_stays() {
        let (before, mut parts) = folded(1e-3);
        let mut points = before.clone();
        parts.separate(&mut points, ALL, |_, _, _| Some(1.0), &mut unbounded());
        assert_eq!(points, before);
        let (before, mut parts) = folded(-1e-3);
        let mut points = before.clone();
        parts.separate(&mut points, ALL, |_, _, _| None, &mut unbounded());
        assert_eq!(points, before);
    }
}
