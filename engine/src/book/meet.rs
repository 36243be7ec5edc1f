//! What a leaf in flight must not pass through: the piles, its neighbours,
//! itself.
//!
//! Contact is sought where the leaf is in the book and told to the sheet, which
//! lives over a flat table, as half-spaces turned back by the gutter's bend.

use super::block::Pile;
use super::mesh::{Mesh, dot, sub, update_normals};
use super::seat::share_turned;
use crate::models::sheet::{CONTACTS, Contact};

/// Farther than this from each other, metres, nothing meets within a tick.
const FAR: f32 = 0.07;

/// Deepest that contact pushes from at once, metres: what is deeper comes out
/// over several ticks.
const DEEPEST: f32 = 0.02;

/// Depth to which a node that was not next to a neighbour before may have been
/// pushed in, metres; deeper, it has come round its rim.
const WRONG: f32 = 0.004;

/// Depth from which a node beyond a neighbour's rim has passed it there, metres.
const PAST: f32 = 0.001;

/// By how much a node may come nearer to a neighbour between two looks, metres.
const LEAP: f32 = 0.025;

/// Depth from which nothing is pushed out any more, metres.
const LOST: f32 = 0.03;

/// Depth in a neighbour, metres, from which a node that could not be pushed out is
/// led out slowly, to which, and how firmly.
const TANGLED: f32 = 0.0035;
const FREE: f32 = 0.001;
const UNTANGLING: f32 = 0.005;

/// Firmness of a contact that is a spring alone.
const SPRING: f32 = 0.99;

/// Nodes of a cell farther than this from another leaf, metres, keep the whole
/// cell clear of it.
const CLOSE: f32 = 0.003;

/// Between nodes that are nearer than this to a neighbour, metres, it is looked for.
const BESIDE: f32 = 0.008;

/// Steps from a node to the other end of what lies between: edges and diagonals.
const BETWEEN: [[usize; 2]; 3] = [[1, 0], [0, 1], [1, 1]];

/// Distance that leaves keep, metres: a node stands for a cell around it.
const GAP: f32 = 2e-4;

/// Places of a leaf closer than this along it, metres, do not meet each other.
const APART: f32 = 0.045;

/// Distance at which parts of one leaf are looked at for contact, metres.
const CURLED: f32 = 0.012;

/// Which contact of a node is whose.
const PILE: usize = 0;
const LEFT: usize = 1;
const RIGHT: usize = 2;
const SELF: usize = 3;

/// A leaf's nodes in the book, and what it remembers of what they met.
#[derive(Clone, Debug)]
pub struct Seated {
    columns: usize,
    pub points: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    /// Cosine and sine of the gutter's turn before each node.
    pub turned: Vec<[f32; 2]>,
    /// Velocities of the nodes, m/s.
    pub velocities: Vec<[f32; 3]>,
    /// Whether a hand has held the leaf since it last lay still.
    pub was_held: bool,
    /// Node of the left and of the right neighbour that each node was nearest to.
    nearest: [Vec<u16>; 2],
    /// Distance between columns and rows, metres.
    cell: [f32; 2],
    /// Deepest contact of the last meeting, metres.
    pub depth: f32,
    /// The same of contacts that are firm.
    pub firm_depth: f32,
    /// Which nodes came too deep into the left and the right neighbour.
    tangled: [Vec<bool>; 2],
    /// Distance of each node from the left and from the right neighbour, metres.
    pub gaps: [Vec<f32>; 2],
    /// Distance of each node from the pile under it, metres.
    pile_gaps: Vec<f32>,
    /// The box around each row, metres: its lowest and its highest corner.
    bounds: Vec<[[f32; 3]; 2]>,
}

impl Seated {
    /// A leaf of `columns` x `rows` nodes, `cell` metres apart.
    pub fn new(columns: usize, rows: usize, cell: [f32; 2]) -> Seated {
        let nodes = columns * rows;
        let same: Vec<u16> = (0..nodes as u16).collect();
        Seated {
            columns,
            points: vec![[0.0; 3]; nodes],
            normals: vec![[0.0, 0.0, 1.0]; nodes],
            turned: vec![[1.0, 0.0]; nodes],
            velocities: vec![[0.0; 3]; nodes],
            was_held: false,
            nearest: [same.clone(), same],
            cell,
            depth: 0.0,
            firm_depth: 0.0,
            tangled: [vec![false; nodes], vec![false; nodes]],
            gaps: [vec![FAR; nodes], vec![FAR; nodes]],
            pile_gaps: vec![FAR; nodes],
            bounds: vec![[[0.0; 3]; 2]; rows],
        }
    }

    /// The leaf as others meet it.
    pub fn mesh(&self) -> Mesh<'_> {
        Mesh {
            columns: self.columns,
            points: &self.points,
            normals: &self.normals,
        }
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
        for (tangled, gaps) in self.tangled.iter_mut().zip(&mut self.gaps) {
            tangled.fill(false);
            gaps.fill(FAR);
        }
        for nearest in &mut self.nearest {
            for (node, nearest) in nearest.iter_mut().enumerate() {
                *nearest = node as u16;
            }
        }
    }

    fn is_tangled(&self) -> bool {
        self.tangled.iter().any(|tangled| tangled.contains(&true))
    }

    /// Notes which nodes are still deep in a neighbour when a tick is done: those
    /// that could be pushed out have been.
    pub fn note_tangled(&mut self) {
        for (tangled, gaps) in self.tangled.iter_mut().zip(&self.gaps) {
            for (tangled, gap) in tangled.iter_mut().zip(gaps) {
                *tangled = *gap < if *tangled { -FREE } else { -TANGLED };
            }
        }
    }

    /// Whether no node can have come deeper than `deep` metres into anything within
    /// `seconds` since all was looked for, at the velocities of now: so far off was
    /// everything.
    pub fn is_clear(&self, [left, right]: [Option<&Seated>; 2], deep: f32, seconds: f32) -> bool {
        let apart = |v: [f32; 3], w: [f32; 3]| {
            let d = sub(v, w);
            seconds * dot(d, d).sqrt()
        };
        (0..self.points.len()).all(|node| {
            let v = self.velocities[node];
            let clear_of = |side: usize, other: Option<&Seated>| {
                let nearest = self.nearest[side][node] as usize;
                other.is_none_or(|other| {
                    self.gaps[side][node] + deep > apart(v, other.velocities[nearest])
                })
            };
            self.pile_gaps[node] + deep > apart(v, [0.0; 3])
                && clear_of(0, left)
                && clear_of(1, right)
        })
    }

    /// How far the leaf's outer half has turned at most, as a share of the half turn,
    /// from the right (`side` 1) or from the left (-1).
    pub fn reach(&self, side: f32) -> f32 {
        let outer = |node: &usize| 2 * (node % self.columns) >= self.columns;
        let shares = (0..self.points.len()).filter(outer).map(|node| {
            let [x, _, z] = self.points[node];
            share_turned(side * x, z)
        });
        shares.fold(0.0, f32::max)
    }

    /// The place in the middle between a node and the one `right` columns and `up`
    /// rows on, on the cubic through the nodes before and after.
    fn middle(&self, node: usize, [right, up]: [usize; 2]) -> [f32; 3] {
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

    fn bound_rows(&mut self) {
        for (bounds, row) in self
            .bounds
            .iter_mut()
            .zip(self.points.chunks_exact(self.columns))
        {
            *bounds = [row[0], row[0]];
            for point in row {
                for axis in 0..3 {
                    bounds[0][axis] = bounds[0][axis].min(point[axis]);
                    bounds[1][axis] = bounds[1][axis].max(point[axis]);
                }
            }
        }
    }

    /// Whether nodes of this leaf come near enough to others of it to touch.
    fn is_curled(&self) -> bool {
        let normals = &self.normals;
        let middle = normals[normals.len() / 2 + self.columns / 2];
        normals.iter().any(|n| dot(*n, middle) < -0.2)
    }
}

/// Where and what a sheet touches: its nodes over the flat table and its contacts.
pub struct Sheetlike<'a> {
    pub flat: &'a [f32],
    pub contacts: &'a mut [[Contact; CONTACTS]],
    pub friction: f32,
}

/// A neighbour of a leaf.
#[derive(Clone, Copy)]
pub struct Neighbour<'a> {
    pub leaf: &'a Seated,
    /// 1 where it is already where it will be at the end of the tick; else how
    /// firmly it is pushed, as it will be pushed back itself.
    pub firmness: f32,
}

/// Finds the contacts of a leaf with the piles (right and left) and with the
/// neighbours on its left and on its right, as far as there are any.
pub fn meet_others(
    leaf: &mut Seated,
    piles: [&Pile; 2],
    [left, right]: [Option<Neighbour<'_>>; 2],
    sheet: &mut Sheetlike<'_>,
) {
    leaf.depth = 0.0;
    leaf.firm_depth = 0.0;
    meet_piles(leaf, piles, sheet);
    // The left neighbour lies on the recto's side, the right one on the verso's.
    meet_neighbour(leaf, LEFT, left, -1.0, sheet);
    meet_neighbour(leaf, RIGHT, right, 1.0, sheet);
}

/// The half-space whose boundary is `gap` metres from a node, toward `normal`
/// in the book.
fn half_space(
    leaf: &Seated,
    node: usize,
    (normal, gap): ([f32; 3], f32),
    velocity: [f32; 3],
    sheet: &Sheetlike<'_>,
) -> Contact {
    let [cos, sin] = leaf.turned[node];
    let length = (cos * cos + sin * sin).sqrt().max(1e-6);
    let back = |v: [f32; 3]| {
        [
            (cos * v[0] + sin * v[2]) / length,
            v[1],
            (cos * v[2] - sin * v[0]) / length,
        ]
    };
    let normal = back(normal);
    let flat = sheet.flat.as_chunks::<3>().0[node];
    Contact {
        normal,
        offset: dot(normal, flat) - gap.max(-DEEPEST),
        velocity: back(velocity),
        friction: sheet.friction,
        firmness: 1.0,
    }
}

fn meet_piles(leaf: &mut Seated, [right, left]: [&Pile; 2], sheet: &mut Sheetlike<'_>) {
    for node in 0..leaf.points.len() {
        let contact = &mut sheet.contacts[node][PILE];
        *contact = Contact::default();
        let [x, _, z] = leaf.points[node];
        let (pile, sign) = if x >= 0.0 { (right, 1.0) } else { (left, -1.0) };
        let (height, slope) = pile.height_and_slope(x.abs());
        leaf.pile_gaps[node] = z - height;
        if z - height > FAR {
            continue;
        }
        let inverse = 1.0 / (1.0 + slope * slope).sqrt();
        let normal = [-sign * slope * inverse, 0.0, inverse];
        let gap = (z - height) * inverse;
        leaf.depth = leaf.depth.max(-gap);
        leaf.firm_depth = leaf.firm_depth.max(-gap);
        sheet.contacts[node][PILE] = half_space(leaf, node, (normal, gap), [0.0; 3], sheet);
    }
}

/// `side` is 1 where the leaf lies on the recto's side of the other.
fn meet_neighbour(
    leaf: &mut Seated,
    slot: usize,
    other: Option<Neighbour<'_>>,
    side: f32,
    sheet: &mut Sheetlike<'_>,
) {
    for contacts in sheet.contacts.iter_mut() {
        contacts[slot] = Contact::default();
    }
    let Some(neighbour) = other else {
        leaf.gaps[slot - 1].fill(FAR);
        return;
    };
    let other = neighbour.leaf;
    let mesh = other.mesh();
    let columns = leaf.columns;
    let is_tangled = leaf.tangled[slot - 1].contains(&true) || other.is_tangled();
    for node in 0..leaf.points.len() {
        // The column at the spine is everyone's.
        if node % columns == 0 {
            continue;
        }
        let before = core::mem::replace(&mut leaf.gaps[slot - 1][node], FAR);
        let point = leaf.points[node];
        let start = leaf.nearest[slot - 1][node] as usize;
        let Some(near) = mesh.near(point, start) else {
            continue;
        };
        leaf.nearest[slot - 1][node] = near.node as u16;
        let gap = side * near.height - GAP;
        let away = sub(point, other.points[near.node]);
        // What is far, or far to the wrong side, is not lying upon it there.
        let was_next = before < FAR && gap > before - LEAP && gap > -LOST;
        let is_past = near.beyond && gap < -PAST;
        if gap > FAR || is_past || !(gap > -WRONG || was_next) || dot(away, away) > FAR * FAR {
            continue;
        }
        leaf.gaps[slot - 1][node] = gap;
        // What has come so deep is led out slowly: by force it would tear.
        let firmness = if leaf.tangled[slot - 1][node] {
            UNTANGLING
        } else if is_tangled {
            neighbour.firmness.min(SPRING)
        } else {
            neighbour.firmness
        };
        if neighbour.firmness == 1.0 {
            leaf.depth = leaf.depth.max(-gap - GAP);
            if !is_tangled {
                leaf.firm_depth = leaf.firm_depth.max(-gap - GAP);
            }
        }
        let normal = near.normal.map(|n| side * n);
        let velocity = other.velocities[near.node];
        sheet.contacts[node][slot] = Contact {
            firmness,
            ..half_space(leaf, node, (normal, gap), velocity, sheet)
        };
    }
    // Leaves that no hand has crumpled have no folds that their nodes miss.
    if leaf.was_held || other.was_held {
        meet_between(leaf, slot, neighbour, side, sheet);
    }
}

/// Finds the contacts of a leaf with a neighbour between its nodes, where folds
/// reach that its nodes do not: the ends of an edge, and the corners of a cell,
/// keep the distance that their middle has, where that is less than their own.
fn meet_between(
    leaf: &mut Seated,
    slot: usize,
    neighbour: Neighbour<'_>,
    side: f32,
    sheet: &mut Sheetlike<'_>,
) {
    let other = neighbour.leaf;
    let mesh = other.mesh();
    let columns = leaf.columns;
    let nodes = leaf.points.len();
    for node in 0..nodes {
        let column = node % columns;
        for [right, up] in BETWEEN {
            let end = node + right + up * columns;
            if column == 0 || column + right >= columns || end >= nodes {
                continue;
            }
            let ends = [node, end];
            let gaps = ends.map(|node| leaf.gaps[slot - 1][node]);
            if gaps[0].max(gaps[1]) > BESIDE {
                continue;
            }
            let point = leaf.middle(node, [right, up]);
            let start = leaf.nearest[slot - 1][node] as usize;
            let Some(near) = mesh.near(point, start) else {
                continue;
            };
            let gap = side * near.height - GAP;
            let least = gaps[0].min(gaps[1]);
            if gap > least || gap < least - BESIDE {
                continue;
            }
            if neighbour.firmness == 1.0 {
                leaf.depth = leaf.depth.max(-gap - GAP);
                leaf.firm_depth = leaf.firm_depth.max(-gap - GAP);
            }
            let normal = near.normal.map(|n| side * n);
            let velocity = other.velocities[near.node];
            for node in ends {
                let known = sheet.contacts[node][slot];
                let space = half_space(leaf, node, (normal, gap), velocity, sheet);
                sheet.contacts[node][slot] = Contact {
                    firmness: known.firmness,
                    ..space
                };
            }
        }
    }
}

/// Finds the contacts of a leaf with itself: a curled one stays on the side of
/// itself where it is.
pub fn meet_itself(leaf: &mut Seated, sheet: &mut Sheetlike<'_>) {
    for contacts in sheet.contacts.iter_mut() {
        contacts[SELF] = Contact::default();
    }
    if !leaf.is_curled() {
        return;
    }
    leaf.bound_rows();
    let columns = leaf.columns;
    for node in 0..leaf.points.len() {
        if node % columns == 0 {
            continue;
        }
        let Some(other) = nearest_of_itself(leaf, node) else {
            continue;
        };
        let away = sub(leaf.points[node], leaf.points[other]);
        let normal = leaf.normals[other];
        let height = dot(away, normal);
        let side = if height >= 0.0 { 1.0 } else { -1.0 };
        let space = (normal.map(|n| side * n), height.abs() - GAP);
        let velocity = leaf.velocities[other];
        // The other node is pushed itself.
        sheet.contacts[node][SELF] = Contact {
            firmness: 0.5,
            ..half_space(leaf, node, space, velocity, sheet)
        };
    }
}

/// The node nearest to a node of those far from it along the leaf, if it is
/// near enough to touch.
fn nearest_of_itself(leaf: &Seated, node: usize) -> Option<usize> {
    let columns = leaf.columns;
    let point = leaf.points[node];
    let (mut best, mut least) = (None, CURLED * CURLED);
    for (row, [low, high]) in leaf.bounds.iter().enumerate() {
        let beside =
            |axis: usize| point[axis] < low[axis] - CURLED || point[axis] > high[axis] + CURLED;
        if (0..3).any(beside) {
            continue;
        }
        for other in row * columns..(row + 1) * columns {
            let away = sub(point, leaf.points[other]);
            let d = dot(away, away);
            if d < least {
                let u = (node % columns).abs_diff(other % columns) as f32 * leaf.cell[0];
                let v = (node / columns).abs_diff(row) as f32 * leaf.cell[1];
                if u * u + v * v > APART * APART {
                    (best, least) = (Some(other), d);
                }
            }
        }
    }
    best
}
