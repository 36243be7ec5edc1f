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

use super::chains::Chains;
use super::contact::{CONTACTS, Contact};
use super::lane_nodes::LaneNodes;
use super::material::Material;
use super::settings::{CAN_CREASE, SheetSettings};
use super::touching::Touching;
use crate::lanes::Four;
use crate::vector::{dot, sub};
use core::ops::Range;

/// Sweeps go on until no edge is longer or shorter by more than this part.
pub(super) const TOLERANCE: f32 = 2e-4;

/// Shear of a cell, radians, beyond which sweeps take it back, and how much more of it is
/// no reason to go on.
const MOST_SHEAR: f32 = 3e-3;
const MORE_SHEAR: f32 = 1e-3;

/// Sweeps after which so little shear yields to the lengths of edges.
const SHEAR_SWEEPS: usize = 40;

/// Shear of a cell, radians, that sweeps go on to take back then, and how many do. What violent
/// grabs and gusts left after six sweeps was 27 degrees.
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

/// Strain of a folded sheet beyond which sweeps go on all the same, and the most of them that it
/// gets. Where a fold is opened and shut again its cells' sides and diagonals have nearly one
/// direction, and what is taken out of one goes into the next: after [`MOST`] sweeps low pages,
/// whose cells are several times as wide as high, kept 4 to 13 %.
const MOST_STRAIN: f32 = 10.0 * TOLERANCE;
const MOST_FOLDED: usize = 6 * MOST;

/// Restores the lengths of a sheet's edges.
#[derive(Clone, Debug)]
pub(super) struct Sweep {
    columns: usize,
    rows: usize,
    first: usize,
    /// Width of a cell, metres: depths are judged by it.
    cell: f32,
    /// The nodes while they are swept. What follows lists nodes as this does.
    nodes: LaneNodes,
    /// None while what it was made of has changed.
    chains: Option<Chains>,
    runs: [Range<usize>; 2],
    /// Lengths of each node's edges to the next in its row and in its column, metres.
    along_u: Vec<f32>,
    along_v: Vec<f32>,
    /// Of the cell of which a node is the foot by the spine half of one over the product of its
    /// sides, 1/m^2, and at rest the difference of the squares of its diagonals, m^2. One that is
    /// folded does not shear as a whole, and has none.
    slopes: Vec<f32>,
    rests: Vec<f32>,
    /// Diagonals along which cells are folded, and their lengths, metres.
    diagonals: Vec<([usize; 2], f32)>,
    /// Diagonals of paper that crumples, and the lengths that they do not exceed, metres.
    slack: Vec<([usize; 2], f32)>,
    /// Nodes that are kept apart, and where they are among the nodes here.
    pub apart: Apart,
    apart_at: Vec<[usize; 2]>,
    /// Nodes that are kept off other parts, and the same by where they are among the nodes here.
    pub touching: Vec<Touching>,
    touching_at: Vec<Touching>,
    /// One over a node's area, relative to an inner node's; 0 where it is held.
    mobility: Vec<f32>,
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

impl Sweep {
    /// Sweeps over the edges of a material; nodes that the settings hold at the spine do not move.
    pub fn new(settings: &SheetSettings, material: &Material) -> Sweep {
        let (columns, rows, first) = (settings.columns, settings.rows, settings.first());
        let count = columns * rows;
        let nodes = LaneNodes::new(columns, rows, first);
        let of_node = |value: f32| vec![value; nodes.len()];
        let mut sweep = Sweep {
            columns,
            rows,
            first,
            cell: settings.cell()[0] as f32,
            chains: None,
            runs: material.runs(),
            along_u: of_node(1.0),
            along_v: of_node(1.0),
            slopes: of_node(0.0),
            rests: of_node(0.0),
            diagonals: Vec::new(),
            slack: Vec::new(),
            apart: Apart::default(),
            apart_at: Vec::new(),
            touching: Vec::new(),
            touching_at: Vec::new(),
            mobility: of_node(0.0),
            firm: Vec::with_capacity(count),
            nodes,
        };
        for node in 0..count {
            sweep.release(settings, material, node);
            let at = sweep.nodes.at(node);
            if (node + 1) % columns != 0 {
                sweep.along_u[at] = material.along_u(node) as f32;
            }
            if node / columns + 1 < material.run_of(node / columns).end {
                sweep.along_v[at] = material.along_v(node) as f32;
            }
        }
        for foot in material.cells() {
            let nodes = &sweep.nodes;
            if let Some(diagonals) = material.slack_diagonals(foot) {
                let lengths = diagonals.map(|(edge, length)| (nodes.pair(edge), length as f32));
                sweep.slack.extend(lengths);
                continue;
            }
            if let Some(edge) = material.folded_diagonal(foot) {
                let [a, b] = edge.map(|node| material.places[node]);
                let d = [b[0] - a[0], b[1] - a[1]];
                let length = (d[0] * d[0] + d[1] * d[1]).sqrt();
                sweep.diagonals.push((nodes.pair(edge), length as f32));
                continue;
            }
            let [du, dv] = material.sides(foot).map(|side| side as f32);
            let at = nodes.at(foot);
            sweep.slopes[at] = 0.5 / (du * dv);
            sweep.rests[at] = material.skew(foot) as f32;
        }
        sweep
    }

    /// Holds a node where it is.
    pub fn hold(&mut self, node: usize) {
        let at = self.nodes.at(node);
        self.mobility[at] = 0.0;
        self.chains = None;
    }

    /// Lets a node move again.
    pub fn release(&mut self, settings: &SheetSettings, material: &Material, node: usize) {
        let [du, dv] = settings.cell();
        let at = self.nodes.at(node);
        self.mobility[at] = if node % self.columns < self.first {
            0.0
        } else {
            (du * dv / material.area_at(node)) as f32
        };
        self.chains = None;
    }

    /// Has a node move so many times as easily as it does, until it is [released](Self::release).
    pub fn lighten(&mut self, node: usize, times: f32) {
        self.mobility[self.nodes.at(node)] *= times;
        self.chains = None;
    }

    /// Sweeps until every edge has its length, or as often as there is time for. Returns
    /// how often.
    pub fn run(&mut self, positions: &mut [f32], contacts: &[[Contact; CONTACTS]]) -> u32 {
        self.nodes.read(positions);
        self.find_firm(contacts);
        if CAN_CREASE {
            self.apart_at.clear();
            let pairs = self.apart.pairs.iter().map(|pair| self.nodes.pair(*pair));
            self.apart_at.extend(pairs);
            self.touching_at.clear();
            let nodes = &self.nodes;
            let touching = self.touching.iter().map(|touching| Touching {
                node: nodes.at(touching.node),
                under: touching.under.map(|node| nodes.at(node)),
                ..*touching
            });
            self.touching_at.extend(touching);
        }
        let mut chains = self.chains.take().unwrap_or_else(|| self.chains());
        let is_folded = self.is_folded();
        let mut rounds = 0;
        loop {
            let mut off = self.restore_others(rounds);
            off = off.max(chains.restore(&mut self.nodes));
            rounds += 1;
            let is_far_off = is_folded && off > MOST_STRAIN;
            let most = if is_far_off { MOST_FOLDED } else { MOST };
            if rounds >= most || off < TOLERANCE && rounds >= FEWEST {
                break;
            }
        }
        self.chains = Some(chains);
        self.nodes.write(positions);
        rounds as u32
    }

    /// Whether some of its cells are folded and none crumpled: what crumples gives way.
    fn is_folded(&self) -> bool {
        CAN_CREASE && !self.diagonals.is_empty() && self.slack.is_empty()
    }

    fn chains(&self) -> Chains {
        let size = [self.columns, self.rows, self.first];
        let lengths = [&self.along_u[..], &self.along_v];
        Chains::new(&self.nodes, size, &self.runs, lengths, &self.mobility)
    }

    /// Brings back in a round what is deep in contacts, sheared, or a diagonal. Returns the
    /// greatest strain found.
    fn restore_others(&mut self, round: usize) -> f32 {
        let mut off = if round < YIELD {
            self.bring_back()
        } else {
            0.0
        };
        let allowed = match round {
            _ if round < SHEAR_SWEEPS => Some(MOST_SHEAR),
            _ if round < GROSS_SWEEPS => Some(GROSS_SHEAR),
            _ => None,
        };
        if allowed.is_some_and(|allowed| self.limit_shear(allowed) > MORE_SHEAR) {
            off = off.max(1.0);
        }
        if CAN_CREASE {
            let (nodes, mobility) = (&mut self.nodes, &self.mobility);
            for (edge, length) in &self.diagonals {
                off = off.max(restore(nodes, *edge, *length, mobility));
            }
            for (edge, length) in &self.slack {
                if length_of(nodes, *edge) > *length {
                    off = off.max(restore(nodes, *edge, *length, mobility));
                }
            }
            // As firm contacts, they yield to lengths in the end.
            if round < YIELD {
                for pair in &self.apart_at {
                    if length_of(nodes, *pair) < self.apart.distance {
                        restore(nodes, *pair, self.apart.distance, mobility);
                    }
                }
                let mut deep = 0.0f32;
                for touching in &self.touching_at {
                    deep = deep.max(touching.restore(nodes, mobility, STRIDE));
                }
                if deep > LEFT {
                    off = off.max(deep / self.cell);
                }
            }
        }
        off
    }

    fn find_firm(&mut self, contacts: &[[Contact; CONTACTS]]) {
        self.firm.clear();
        for (node, contacts) in contacts.iter().enumerate() {
            let at = self.nodes.at(node);
            for contact in contacts {
                let is_firm = contact.firmness >= 1.0 && contact.normal != [0.0; 3];
                let is_near = || contact.depth(self.nodes.get(at)) > -BEYOND;
                if is_firm && self.mobility[at] > 0.0 && is_near() {
                    self.firm.push((at, *contact));
                }
            }
        }
    }

    /// Brings back what is deep in a firm contact. Returns by how much at most,
    /// as a part of a cell.
    fn bring_back(&mut self) -> f32 {
        let mut most = 0.0f32;
        for (at, contact) in &self.firm {
            let deep = contact.depth(self.nodes.get(*at)) - LEFT;
            if deep > 0.0 {
                self.nodes.shift(*at, deep.min(STRIDE), contact.normal);
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
    fn limit_shear(&mut self, allowed: f32) -> f32 {
        let stride = self.nodes.stride;
        let (nothing, half) = (Four::splat(0.0), Four::splat(0.5));
        let most_allowed = Four::splat(allowed);
        let mut most = 0.0f32;
        for row in 0..self.rows - 1 {
            for column in (0..self.columns - 1).step_by(4) {
                let foot = row * stride + column;
                let (mut long, mut short) = (nothing, nothing);
                for axis in &self.nodes.axes {
                    let rising = Four::load(axis, foot + stride + 1) - Four::load(axis, foot);
                    let falling = Four::load(axis, foot + 1) - Four::load(axis, foot + stride);
                    long = long + rising * rising;
                    short = short + falling * falling;
                }
                let rest = Four::load(&self.rests, foot);
                let shear = half * Four::load(&self.slopes, foot) * (long - short - rest);
                // Of cells side by side each moves the next, once one has more.
                let more = shear.abs().exceeding(most_allowed);
                if more > 0 {
                    let end = column + 4;
                    for next in column + more.trailing_zeros() as usize..end.min(self.columns - 1) {
                        most = most.max(self.take_back_shear(row * stride + next, allowed));
                    }
                }
            }
        }
        most
    }

    /// Takes back the shear of a cell beyond what is allowed. Returns how much it was.
    fn take_back_shear(&mut self, foot: usize, allowed: f32) -> f32 {
        let head = foot + self.nodes.stride;
        let [a, b, c, d] = [foot, foot + 1, head, head + 1];
        let rising = sub(self.nodes.get(d), self.nodes.get(a));
        let falling = sub(self.nodes.get(b), self.nodes.get(c));
        let [long, short] = [dot(rising, rising), dot(falling, falling)];
        let (slope, rest) = (self.slopes[foot], self.rests[foot]);
        let shear = 0.5 * slope * (long - short - rest);
        let excess = shear.abs() - allowed;
        if excess <= 0.0 {
            return 0.0;
        }
        let mobile = [a, b, c, d].map(|at| self.mobility[at]);
        let stiff =
            slope * slope * ((mobile[0] + mobile[3]) * long + (mobile[1] + mobile[2]) * short);
        if stiff <= 0.0 {
            return excess;
        }
        let back = slope * excess.copysign(shear) / stiff;
        self.nodes.shift(a, back * mobile[0], rising);
        self.nodes.shift(d, -(back * mobile[3]), rising);
        self.nodes.shift(b, back * mobile[1], falling);
        self.nodes.shift(c, -(back * mobile[2]), falling);
        excess
    }
}

/// Distance between two nodes, metres.
fn length_of(nodes: &LaneNodes, [a, b]: [usize; 2]) -> f32 {
    let d = sub(nodes.get(b), nodes.get(a));
    dot(d, d).sqrt()
}

/// Restores the length of one edge. Returns its strain.
fn restore(nodes: &mut LaneNodes, [a, b]: [usize; 2], rest: f32, mobilities: &[f32]) -> f32 {
    let d = sub(nodes.get(b), nodes.get(a));
    let length = dot(d, d).sqrt().max(1e-9);
    let mobile = mobilities[a] + mobilities[b];
    if mobile > 0.0 {
        let pull = (length - rest) / (length * mobile);
        nodes.shift(a, mobilities[a] * pull, d);
        nodes.shift(b, -(mobilities[b] * pull), d);
    }
    (length - rest).abs() / rest
}
