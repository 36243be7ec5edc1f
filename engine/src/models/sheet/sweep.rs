//! Exact lengths: what the solver leaves of stretch is taken out.
//!
//! The lengths of all edges of a column, then of a row, are restored at once by
//! one Newton step for the multipliers of a chain of masses, a tridiagonal
//! solve (Goldenthal et al. 2007 project all at once; chains one after another
//! converge nearly as fast on a sheet and cost a thousandth). Sweeps repeat
//! until every edge has its length.
//!
//! Between them the shear of each cell is limited: chains by themselves turn what
//! they take out of stretch into shear. It is an inequality, cell by cell, as to make
//! lengths and right angles exact at once would lock the sheet.
//!
//! What a grab's pull or a throw drove through a firm contact within the step is
//! brought back between the sweeps, so that the paper around it follows.

use super::contact::{CONTACTS, Contact};
use super::material::Material;
use super::settings::{CAN_CREASE, SheetSettings};
use crate::vector::{dot, sub};
use core::ops::Range;

/// Sweeps go on until no edge is longer or shorter by more than this part.
pub(super) const TOLERANCE: f32 = 2e-4;

/// Shear of a cell, radians, beyond which sweeps take it back, and how much more of it is
/// no reason to go on.
const MOST_SHEAR: f32 = 3e-3;
const MORE_SHEAR: f32 = 1e-3;

/// Shear of a cell, radians, that sweeps go on to take back when less of it yields to
/// lengths, and how many do. What violent grabs and gusts leave a leaf that has few
/// [`shear_sweeps`](SheetSettings::shear_sweeps) was 27 degrees.
const GROSS_SHEAR: f32 = 0.1;
const GROSS_SWEEPS: usize = 60;

/// Depth in a firm contact that is left to its spring, metres; what is deeper is
/// brought back to it.
const LEFT: f32 = 3e-4;

/// Contacts no nearer than this after the solution, metres, stay out of the
/// sweeps' reach.
const BEYOND: f32 = 5e-3;

/// Sweeps after which contacts yield to lengths: between two grabs there may be
/// no place for a leaf, but tear it shall not.
const YIELD: usize = 10;

/// Most by which a sweep brings a node back, metres.
const STRIDE: f32 = 4e-3;

/// Fewest and most sweeps of a step. Nearly all steps need few; one in which a
/// wild grab crumples a light leaf needs many, and with fewer it would keep some
/// stretch.
const FEWEST: usize = 2;
const MOST: usize = 160;

/// Restores the lengths of a sheet's edges.
#[derive(Clone, Debug)]
pub(super) struct Sweep {
    columns: usize,
    rows: usize,
    /// The rows that hang together.
    runs: [Range<usize>; 2],
    first: usize,
    /// Width of a cell, metres: depths are judged by it.
    cell: f32,
    /// Lengths of each node's edges to the next in its row and in its column, metres.
    along_u: Vec<f32>,
    along_v: Vec<f32>,
    /// Of the cell of which a node is the foot by the spine.
    cells: Vec<Cell>,
    /// Diagonals along which cells are folded, and their lengths, metres.
    diagonals: Vec<([usize; 2], f32)>,
    /// Diagonals of paper that crumples, and the lengths that they do not exceed, metres.
    slack: Vec<([usize; 2], f32)>,
    /// Nodes that are kept apart.
    pub apart: Apart,
    pub shear_sweeps: usize,
    /// One over a node's area, relative to an inner node's; 0 where it is held.
    pub mobility: Vec<f32>,
    links: Vec<Link>,
    /// Firm contacts that nodes are in or near: node, contact.
    firm: Vec<(usize, Contact)>,
}

/// Pairs of nodes that must not come nearer to each other.
#[derive(Clone, Debug, Default)]
pub(crate) struct Apart {
    /// Least distance, metres.
    pub distance: f32,
    /// The numbers of the nodes.
    pub pairs: Vec<[usize; 2]>,
}

/// A cell: half of one over the product of its sides, 1/m^2, and at rest the difference of the squares of
/// its diagonals, m^2. One that is folded does not shear as a whole, and has none.
#[derive(Clone, Copy, Debug, Default)]
struct Cell {
    slope: f32,
    rest: f32,
}

/// An edge of a chain: its direction, its excess length, its row of the system.
#[derive(Clone, Copy, Debug, Default)]
struct Link {
    direction: [f32; 3],
    excess: f32,
    diagonal: f32,
    below: f32,
}

impl Sweep {
    pub fn new(settings: &SheetSettings, material: &Material) -> Sweep {
        let (columns, rows, first) = (settings.columns, settings.rows, settings.first());
        let nodes = columns * rows;
        let mut sweep = Sweep {
            columns,
            rows,
            runs: material.runs(),
            first,
            cell: settings.cell()[0] as f32,
            along_u: vec![0.0; nodes],
            along_v: vec![0.0; nodes],
            cells: vec![Cell::default(); nodes],
            diagonals: Vec::new(),
            slack: Vec::new(),
            apart: Apart::default(),
            shear_sweeps: settings.shear_sweeps,
            mobility: vec![0.0; nodes],
            links: vec![Link::default(); columns.max(rows)],
            firm: Vec::with_capacity(nodes),
        };
        for node in 0..nodes {
            sweep.release(settings, material, node);
            if (node + 1) % columns != 0 {
                sweep.along_u[node] = material.along_u(node) as f32;
            }
            if node / columns + 1 < material.run_of(node / columns).end {
                sweep.along_v[node] = material.along_v(node) as f32;
            }
        }
        for foot in material.cells() {
            if let Some(diagonals) = material.slack_diagonals(foot) {
                let lengths = diagonals.map(|(edge, length)| (edge, length as f32));
                sweep.slack.extend(lengths);
                continue;
            }
            if let Some(edge) = material.folded_diagonal(foot) {
                let [a, b] = edge.map(|node| material.places[node]);
                let d = [b[0] - a[0], b[1] - a[1]];
                let length = (d[0] * d[0] + d[1] * d[1]).sqrt();
                sweep.diagonals.push((edge, length as f32));
                continue;
            }
            let [du, dv] = material.sides(foot).map(|side| side as f32);
            sweep.cells[foot] = Cell {
                slope: 0.5 / (du * dv),
                rest: material.skew(foot) as f32,
            };
        }
        sweep
    }

    /// Lets a node move again.
    pub fn release(&mut self, settings: &SheetSettings, material: &Material, node: usize) {
        let [du, dv] = settings.cell();
        self.mobility[node] = if node % self.columns < self.first {
            0.0
        } else {
            (du * dv / material.area_at(node)) as f32
        };
    }

    /// Sweeps until every edge has its length, or as often as there is time for. Returns
    /// how often.
    pub fn run(&mut self, positions: &mut [f32], contacts: &[[Contact; CONTACTS]]) -> u32 {
        let (columns, rows) = (self.columns, self.rows);
        self.find_firm(positions, contacts);
        for round in 0..MOST {
            let mut off = if round < YIELD {
                self.bring_back(positions)
            } else {
                0.0
            };
            let allowed = match round {
                _ if round < self.shear_sweeps => Some(MOST_SHEAR),
                _ if round < GROSS_SWEEPS => Some(GROSS_SHEAR),
                _ => None,
            };
            if allowed.is_some_and(|allowed| self.limit_shear(positions, allowed) > MORE_SHEAR) {
                off = off.max(1.0);
            }
            if CAN_CREASE {
                for (edge, length) in &self.diagonals {
                    off = off.max(restore(positions, *edge, *length, &self.mobility));
                }
                for (edge, length) in &self.slack {
                    if length_of(positions, *edge) > *length {
                        off = off.max(restore(positions, *edge, *length, &self.mobility));
                    }
                }
                // As firm contacts, they yield to lengths in the end.
                let pairs = if round < YIELD {
                    &self.apart.pairs[..]
                } else {
                    &[]
                };
                for pair in pairs {
                    if length_of(positions, *pair) < self.apart.distance {
                        restore(positions, *pair, self.apart.distance, &self.mobility);
                    }
                }
            }
            for run in self.runs.iter().filter(|run| !run.is_empty()) {
                for column in self.first..columns {
                    let chain = Chain {
                        start: run.start * columns + column,
                        step: columns,
                        count: run.len(),
                    };
                    off = off.max(chain.restore(
                        positions,
                        &self.along_v,
                        &self.mobility,
                        &mut self.links,
                    ));
                }
            }
            for row in 0..rows {
                let chain = Chain {
                    start: row * columns,
                    step: 1,
                    count: columns,
                };
                off = off.max(chain.restore(
                    positions,
                    &self.along_u,
                    &self.mobility,
                    &mut self.links,
                ));
            }
            if off < TOLERANCE && round + 1 >= FEWEST {
                return round as u32 + 1;
            }
        }
        MOST as u32
    }

    fn find_firm(&mut self, positions: &[f32], contacts: &[[Contact; CONTACTS]]) {
        let x = positions.as_chunks::<3>().0;
        self.firm.clear();
        for (node, contacts) in contacts.iter().enumerate() {
            for contact in contacts {
                let is_firm = contact.firmness >= 1.0 && contact.normal != [0.0; 3];
                if is_firm && self.mobility[node] > 0.0 && contact.depth(x[node]) > -BEYOND {
                    self.firm.push((node, *contact));
                }
            }
        }
    }

    /// Brings back what is deep in a firm contact. Returns by how much at most,
    /// as a part of a cell.
    fn bring_back(&self, positions: &mut [f32]) -> f32 {
        let x = positions.as_chunks_mut::<3>().0;
        let mut most = 0.0f32;
        for (node, contact) in &self.firm {
            let deep = contact.depth(x[*node]) - LEFT;
            if deep > 0.0 {
                let back = deep.min(STRIDE);
                for axis in 0..3 {
                    x[*node][axis] += back * contact.normal[axis];
                }
                most = most.max(deep);
            }
        }
        // A tenth of what is left to the springs is no reason to go on.
        if most > 0.1 * LEFT {
            most / self.cell
        } else {
            0.0
        }
    }

    /// Takes back the shear of cells that have more of it than is `allowed`, one after
    /// another; returns by how much more they had at most, in radians while it is small. The shear
    /// is the product of a cell's mean tangents, the difference of the squares of its
    /// diagonals over four times its area.
    fn limit_shear(&self, positions: &mut [f32], allowed: f32) -> f32 {
        let x = positions.as_chunks_mut::<3>().0;
        let mut most = 0.0f32;
        for foot in 0..self.columns * (self.rows - 1) {
            if (foot + 1).is_multiple_of(self.columns) {
                continue;
            }
            let head = foot + self.columns;
            let rising = sub(x[head + 1], x[foot]);
            let falling = sub(x[foot + 1], x[head]);
            let [long, short] = [dot(rising, rising), dot(falling, falling)];
            let Cell { slope, rest } = self.cells[foot];
            let shear = 0.5 * slope * (long - short - rest);
            let excess = shear.abs() - allowed;
            if excess <= 0.0 {
                continue;
            }
            most = most.max(excess);
            let [a, b, c, d] = [foot, foot + 1, head, head + 1].map(|node| self.mobility[node]);
            let stiff = slope * slope * ((a + d) * long + (b + c) * short);
            if stiff <= 0.0 {
                continue;
            }
            let back = slope * excess.copysign(shear) / stiff;
            for axis in 0..3 {
                x[foot][axis] += back * a * rising[axis];
                x[head + 1][axis] -= back * d * rising[axis];
                x[foot + 1][axis] += back * b * falling[axis];
                x[head][axis] -= back * c * falling[axis];
            }
        }
        most
    }
}

/// Nodes one after another in a row or a column.
struct Chain {
    start: usize,
    /// Nodes from one to the next.
    step: usize,
    count: usize,
}

impl Chain {
    /// Restores its lengths, which are given for the first node of each edge. Returns the
    /// greatest strain found.
    fn restore(
        &self,
        positions: &mut [f32],
        lengths: &[f32],
        mobilities: &[f32],
        links: &mut [Link],
    ) -> f32 {
        let x = positions.as_chunks_mut::<3>().0;
        let Chain { start, step, count } = *self;
        let links = &mut links[..count - 1];
        let mut off = 0.0f32;
        let mut before = Link::default();
        let mut mobility = mobilities[start];
        for (k, link) in links.iter_mut().enumerate() {
            let near = start + k * step;
            let (a, b) = (x[near], x[near + step]);
            let d = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
            let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt().max(1e-9);
            let inverse = 1.0 / length;
            link.direction = d.map(|d| d * inverse);
            link.excess = length - lengths[near];
            off = off.max(link.excess.abs() / lengths[near]);
            let next = mobilities[near + step];
            link.diagonal = mobility + next;
            if k > 0 {
                let (p, q) = (before.direction, link.direction);
                link.below = -mobility * (p[0] * q[0] + p[1] * q[1] + p[2] * q[2]);
                let factor = link.below / before.diagonal;
                link.diagonal -= factor * link.below;
                link.excess -= factor * before.excess;
            }
            link.diagonal = link.diagonal.max(1e-6);
            mobility = next;
            before = *link;
        }
        let mut pull = 0.0;
        let mut below = 0.0;
        for (k, link) in links.iter().enumerate().rev() {
            pull = (link.excess - below * pull) / link.diagonal;
            below = link.below;
            let (near, far) = (start + k * step, start + (k + 1) * step);
            let (here, there) = (mobilities[near] * pull, mobilities[far] * pull);
            for axis in 0..3 {
                x[near][axis] += here * link.direction[axis];
                x[far][axis] -= there * link.direction[axis];
            }
        }
        off
    }
}

/// Distance between two nodes, metres.
fn length_of(positions: &[f32], [a, b]: [usize; 2]) -> f32 {
    let x = positions.as_chunks::<3>().0;
    let d = sub(x[b], x[a]);
    dot(d, d).sqrt()
}

/// Restores the length of one edge. Returns its strain.
fn restore(positions: &mut [f32], [a, b]: [usize; 2], rest: f32, mobilities: &[f32]) -> f32 {
    let x = positions.as_chunks_mut::<3>().0;
    let d = sub(x[b], x[a]);
    let length = dot(d, d).sqrt().max(1e-9);
    let mobile = mobilities[a] + mobilities[b];
    if mobile > 0.0 {
        let pull = (length - rest) / (length * mobile);
        for axis in 0..3 {
            x[a][axis] += mobilities[a] * pull * d[axis];
            x[b][axis] -= mobilities[b] * pull * d[axis];
        }
    }
    (length - rest).abs() / rest
}
