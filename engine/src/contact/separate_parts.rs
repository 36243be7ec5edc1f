//! Parts of a folded leaf, as they are drawn, kept clear of each other.
//!
//! Contact between parts is of nodes with triangles between nodes (`flaps.rs`); the drawn parts
//! bend between their nodes, and so a little into each other. Here each drawn point of a part is
//! brought to the side of the triangles of another on which its creases have it lie, by the same
//! projections as leaves are kept clear of each other by ([`separate`](super::separate)). Of two
//! parts the one that is farther up moves, as the other lies on something.
//!
//! Few points overlap anything. So the triangles are gathered in blocks, and only those points are
//! looked at that are near a block of another part and not on their side of all its triangles.

use super::aabb::Aabb;
use super::flaps::Flaps;
use super::tolerance::{DEEP, NOT_UPON, OVER_PILE, SLACK};
use super::work::Work;
use crate::grid::{cells, cut_cell};
use crate::paper_mesh::PaperMesh;
use crate::surface::Surface;
use crate::triangle::{BESIDE, EdgePlace, Triangle, area_normal};
use crate::vector::{dot, unit};
use core::ops::Range;

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

/// Cells along a side of a block of triangles that one box bounds.
pub const BLOCK: usize = 3;

/// The triangles of a folded leaf's drawn mesh, by the parts between its creases.
#[derive(Clone, Debug, Default)]
pub struct DrawnParts {
    /// The block of each point; None for those on creases and at the spine.
    points: Vec<Option<usize>>,
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
    pairs: Vec<Pair>,
    /// Where the points were when they were looked at last; empty where they never were.
    seen: Vec<[f32; 3]>,
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
    bounds: Aabb,
    /// Where it lies between two planes; found where it is asked for.
    slab: Option<Slab>,
    /// The blocks that its points may overlap.
    pairs: Range<usize>,
}

/// A block of another part that points may overlap, and on which side of it they lie, 1 that of
/// its slab's normal or -1.
#[derive(Clone, Copy, Debug)]
struct Pair {
    under: usize,
    side: f32,
    /// Whether they lie on the other side of triangles that do not face as their block does.
    by_facing: bool,
}

/// Two parallel planes between which triangles lie, as far beyond their sides as points still
/// count as over them.
#[derive(Clone, Copy, Debug)]
pub struct Slab {
    /// The planes' unit normal: the mean of the triangles'.
    pub normal: [f32; 3],
    low: f32,
    high: f32,
    /// How far a point at most is along each axis from the triangle that it is one metre over.
    lean: [f32; 3],
    /// Whether all triangles face along the normal. What is outside of the slab is then at least
    /// as far from each triangle that it is over.
    is_even: bool,
}

impl Block {
    /// Finds the box around its triangles.
    fn bound(&mut self, points: &[[f32; 3]], corners: &[usize]) {
        let corners = corners[self.corners.clone()].iter();
        self.bounds = Aabb::around(corners.map(|node| points[*node]));
        self.slab = None;
    }

    fn is_near(&self, bounds: &Aabb, within: f32) -> bool {
        self.bounds.grown([within; 3]).overlaps(bounds)
    }
}

impl Slab {
    pub fn around(points: &[[f32; 3]], triangles: &[[usize; 3]]) -> Slab {
        let normal_of = |corners: &[usize; 3]| area_normal(corners.map(|corner| points[corner]));
        let normals = triangles.iter().map(normal_of);
        let sum = normals.clone().fold([0.0; 3], |sum: [f32; 3], normal| {
            core::array::from_fn(|axis| sum[axis] + normal[axis])
        });
        let normal = unit(sum);
        let heights = triangles.as_flattened().iter();
        let heights = heights.map(|node| dot(points[*node], normal));
        // Compared by hand, as a library's least and most are slow.
        let [low, high] = heights.fold([f32::MAX, f32::MIN], |[low, high], height| {
            [
                if height < low { height } else { low },
                if height > high { height } else { high },
            ]
        });
        // A corner's weight is up to twice as much beyond 1 as the others' are below 0.
        let beyond = 2.0 * BESIDE * (high - low);
        Slab {
            normal,
            low: low - beyond,
            high: high + beyond,
            lean: normals.clone().fold([0.0; 3], |lean: [f32; 3], normal| {
                let normal = unit(normal).map(f32::abs);
                core::array::from_fn(|i| {
                    if lean[i] > normal[i] {
                        lean[i]
                    } else {
                        normal[i]
                    }
                })
            }),
            is_even: normals.into_iter().all(|own| dot(own, normal) > 0.0),
        }
    }

    /// How far a point is outside of it on a side, metres; less than 0 where it is not, or nothing
    /// is known by that.
    pub fn distance_of(&self, point: [f32; 3], side: f32) -> f32 {
        if !self.is_even {
            return f32::MIN;
        }
        side * dot(point, self.normal) - if side > 0.0 { self.high } else { -self.low }
    }

    /// How far a box is outside of it on a side, metres; less than 0 where it is not, or nothing
    /// is known by that.
    pub fn distance(&self, bounds: &Aabb, side: f32) -> f32 {
        if !self.is_even {
            return f32::MIN;
        }
        let along = |axis: usize| {
            let normal = side * self.normal[axis];
            let nearest = if normal > 0.0 {
                bounds.low
            } else {
                bounds.high
            };
            normal * nearest[axis]
        };
        let nearest = along(0) + along(1) + along(2);
        nearest - if side > 0.0 { self.high } else { -self.low }
    }
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
            points: homes,
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
            let has_moved = self.find_moved(points);
            if !has_moved.contains(&true) {
                break;
            }
            self.find_pairs(points, scale, &has_moved, &side);
            let blocks = self.blocks.len() as u32;
            work.spend(BLOCKS * blocks * blocks + PAIR * self.pairs.len() as u32);
            for node in 0..self.points.len() {
                let Some(home) = self.points[node] else {
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

    /// Whether any corner of each block has moved since it was looked at last; all that are now
    /// count as looked at. What overlapped then was moved.
    fn find_moved(&mut self, points: &[[f32; 3]]) -> Vec<bool> {
        let has_moved = |node: &usize| self.seen.get(*node) != Some(&points[*node]);
        let moved = self.blocks.iter().map(|block| {
            let mut corners = self.corners[block.corners.clone()].iter();
            corners.any(has_moved)
        });
        let moved = moved.collect();
        self.seen.clear();
        self.seen.extend_from_slice(points);
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
