//! Chains of nodes whose lengths are restored at once, four chains at a time.
//!
//! Chains of rows have no node in common, nor have those of columns. So four of them in
//! lanes are what they are one after another, bit for bit.

use super::lane_nodes::LaneNodes;
use crate::lanes::Four;

/// Three coordinates, in four lanes.
type Point = [Four; 3];

/// An edge of four chains: its direction, its excess length, its row of the system.
#[derive(Clone, Copy, Debug)]
struct Link {
    direction: Point,
    excess: Four,
    diagonal: Four,
    below: Four,
}

/// How a group of four chains lies among the nodes.
#[derive(Clone, Copy, Debug)]
struct Group {
    /// Where the first chain begins.
    start: usize,
    /// Nodes of a chain.
    count: usize,
    /// Where their lengths and mobilities begin.
    first: usize,
}

/// Chains along columns and along rows of one sheet.
#[derive(Clone, Debug)]
pub(super) struct Chains {
    columns: Vec<Group>,
    rows: Vec<Group>,
    /// For each node of each group the length of its edge to the next, metres, and one over
    /// the area that moves with it, relative to an inner node's; 0 where it is held.
    lengths: Vec<Four>,
    mobilities: Vec<Four>,
    points: Vec<Point>,
    links: Vec<Link>,
}

impl Chains {
    /// Chains over the rows of each of `runs` that hang together, from column `first` on, and
    /// along all rows. Lengths and mobilities are listed as the nodes are.
    pub fn new(
        nodes: &LaneNodes,
        [columns, rows, first]: [usize; 3],
        runs: &[core::ops::Range<usize>],
        [along_u, along_v]: [&[f32]; 2],
        mobility: &[f32],
    ) -> Self {
        let nothing = Four::splat(0.0);
        let longest = columns.max(rows).next_multiple_of(4);
        let link = Link {
            direction: [nothing; 3],
            excess: nothing,
            diagonal: nothing,
            below: nothing,
        };
        let mut chains = Self {
            columns: Vec::new(),
            rows: Vec::new(),
            lengths: Vec::new(),
            mobilities: Vec::new(),
            points: vec![[nothing; 3]; longest],
            links: vec![link; longest],
        };
        for run in runs.iter().filter(|run| !run.is_empty()) {
            for column in (first..columns).step_by(4) {
                let group = Group {
                    start: run.start * nodes.stride + column,
                    count: run.len(),
                    first: chains.lengths.len(),
                };
                for k in 0..group.count {
                    let at = group.start + k * nodes.stride;
                    chains.lengths.push(Four::load(along_v, at));
                    chains.mobilities.push(Four::load(mobility, at));
                }
                chains.columns.push(group);
            }
        }
        for row in (0..rows).step_by(4) {
            let group = Group {
                start: row * nodes.stride,
                count: columns,
                first: chains.lengths.len(),
            };
            for k in 0..group.count {
                let across = |list: &[f32]| {
                    Four::new([0, 1, 2, 3].map(|lane| list[group.start + lane * nodes.stride + k]))
                };
                chains.lengths.push(across(along_u));
                chains.mobilities.push(across(mobility));
            }
            chains.rows.push(group);
        }
        chains
    }

    /// Restores the lengths of all columns, then of all rows. Returns the greatest strain found.
    pub fn restore(&mut self, nodes: &mut LaneNodes) -> f32 {
        let mut off = Four::splat(0.0);
        let stride = nodes.stride;
        for group in 0..self.columns.len() {
            let group = self.columns[group];
            let places = || (group.start..).step_by(stride);
            for (point, at) in self.points[..group.count].iter_mut().zip(places()) {
                for (lanes, axis) in point.iter_mut().zip(&nodes.axes) {
                    *lanes = Four::load(axis, at);
                }
            }
            off = off.greater(self.restore_group(group));
            for (point, at) in self.points[..group.count].iter().zip(places()) {
                for (axis, lanes) in nodes.axes.iter_mut().zip(point) {
                    lanes.store(axis, at);
                }
            }
        }
        for group in 0..self.rows.len() {
            let group = self.rows[group];
            let count = group.count.next_multiple_of(4);
            let fours = self.points[..count].as_chunks_mut::<4>().0;
            for (points, at) in fours.iter_mut().zip((group.start..).step_by(4)) {
                for (axis, list) in nodes.axes.iter().enumerate() {
                    let [a, b, c, d] = Four::transpose([
                        Four::load(list, at),
                        Four::load(list, at + stride),
                        Four::load(list, at + 2 * stride),
                        Four::load(list, at + 3 * stride),
                    ]);
                    (points[0][axis], points[1][axis]) = (a, b);
                    (points[2][axis], points[3][axis]) = (c, d);
                }
            }
            off = off.greater(self.restore_group(group));
            let fours = self.points[..count].as_chunks::<4>().0;
            for (points, at) in fours.iter().zip((group.start..).step_by(4)) {
                for (axis, list) in nodes.axes.iter_mut().enumerate() {
                    let [a, b, c, d] = points;
                    let rows = Four::transpose([a[axis], b[axis], c[axis], d[axis]]);
                    for (row, lanes) in rows.into_iter().enumerate() {
                        lanes.store(list, at + row * stride);
                    }
                }
            }
        }
        off.array().into_iter().fold(0.0, f32::max)
    }

    /// Restores the lengths of four chains, whose places are in `points`. Returns the greatest
    /// strain found of each.
    fn restore_group(&mut self, Group { count, first, .. }: Group) -> Four {
        let points = &mut self.points[..count];
        let lengths = &self.lengths[first..first + count];
        let mobilities = &self.mobilities[first..first + count];
        let links = &mut self.links[..count - 1];
        let [nothing, one] = [0.0, 1.0].map(Four::splat);
        let [shortest, least] = [1e-9, 1e-6].map(Four::splat);
        let mut off = nothing;
        let mut before = Link {
            direction: [nothing; 3],
            excess: nothing,
            diagonal: one,
            below: nothing,
        };
        let ends = points.windows(2).zip(mobilities.windows(2));
        for ((link, (ends, mobilities)), &rest) in links.iter_mut().zip(ends).zip(lengths) {
            let (a, b) = (ends[0], ends[1]);
            let d = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
            let length = shortest.greater(dot(d, d).sqrt());
            let inverse = one / length;
            let direction = [d[0] * inverse, d[1] * inverse, d[2] * inverse];
            let excess = length - rest;
            off = off.greater(excess.abs() / rest);
            let below = (nothing - mobilities[0]) * dot(before.direction, direction);
            let factor = below / before.diagonal;
            let diagonal = (mobilities[0] + mobilities[1]) - factor * below;
            before = Link {
                direction,
                excess: excess - factor * before.excess,
                diagonal: least.greater(diagonal),
                below,
            };
            *link = before;
        }
        let (mut pull, mut below) = (nothing, nothing);
        for (k, link) in links.iter().enumerate().rev() {
            pull = (link.excess - below * pull) / link.diagonal;
            below = link.below;
            let (here, there) = (mobilities[k] * pull, mobilities[k + 1] * pull);
            for axis in 0..3 {
                points[k][axis] = points[k][axis] + here * link.direction[axis];
                points[k + 1][axis] = points[k + 1][axis] - there * link.direction[axis];
            }
        }
        off
    }
}

#[inline(always)]
fn dot(a: Point, b: Point) -> Four {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
