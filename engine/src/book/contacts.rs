//! What a leaf in flight must not pass through: the piles, its neighbours,
//! itself.
//!
//! Contact is sought where the leaf is in the book and given to the sheet, which
//! lives over a flat table, as half-spaces turned back by the gutter's bend.

use super::book_space_leaf::BookSpaceLeaf;
use super::pile::Pile;
use crate::contact::tolerance::{
    APART, BETWEEN_NODES, CURLED, DEEPEST, FAR, GAP, LEAP, PAST_RIM, PUSHED_AT_ONCE,
};
use crate::models::sheet::{CONTACTS, Contact};
use crate::vector::{dot, sub};

/// Steps from a node to the other end of what lies between: edges and diagonals.
const BETWEEN: [[usize; 2]; 3] = [[1, 0], [0, 1], [1, 1]];

/// Which contact of a node is whose.
const PILE: usize = 0;
const LEFT: usize = 1;
const RIGHT: usize = 2;
const SELF: usize = 3;

/// Where and what a sheet touches: its nodes over the flat table and its contacts.
pub struct ContactView<'a> {
    /// x, y, z of each node over the flat table, metres.
    pub flat: &'a [f32],
    /// The half-spaces of each node, in the flat table's coordinates, to be written.
    pub contacts: &'a mut [[Contact; CONTACTS]],
    /// Coefficient of friction of the sheet on what it touches.
    pub friction: f32,
}

/// A neighbour of a leaf.
#[derive(Clone, Copy)]
pub struct Neighbour<'a> {
    /// The neighbour, where it is in the book.
    pub leaf: &'a BookSpaceLeaf,
    /// 1 where it is already where it will be at the end of the tick; else how
    /// firmly it is pushed, as it will be pushed back itself.
    pub firmness: f32,
}

/// Finds the contacts of a leaf with the piles (right and left) and with the
/// neighbours on its left and on its right, as far as there are any.
pub fn detect_contacts(
    leaf: &mut BookSpaceLeaf,
    piles: [&Pile; 2],
    [left, right]: [Option<Neighbour<'_>>; 2],
    sheet: &mut ContactView<'_>,
) {
    leaf.depth = 0.0;
    detect_pile_contacts(leaf, piles, sheet);
    // The left neighbour lies on the recto's side, the right one on the verso's.
    detect_neighbour_contacts(leaf, LEFT, left, -1.0, sheet);
    detect_neighbour_contacts(leaf, RIGHT, right, 1.0, sheet);
}

/// The half-space whose boundary is `gap` metres from a node, toward `normal`
/// in the book.
fn half_space(
    leaf: &BookSpaceLeaf,
    node: usize,
    (normal, gap): ([f32; 3], f32),
    velocity: [f32; 3],
    sheet: &ContactView<'_>,
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
        offset: dot(normal, flat) - gap.max(-PUSHED_AT_ONCE),
        velocity: back(velocity),
        friction: sheet.friction,
        firmness: 1.0,
    }
}

fn detect_pile_contacts(
    leaf: &mut BookSpaceLeaf,
    [right, left]: [&Pile; 2],
    sheet: &mut ContactView<'_>,
) {
    let mut column = 0;
    for node in 0..leaf.points.len() {
        let contact = &mut sheet.contacts[node][PILE];
        *contact = Contact::default();
        let [x, _, z] = leaf.points[node];
        let (pile, sign) = if x >= 0.0 { (right, 1.0) } else { (left, -1.0) };
        column = pile.column_before(x.abs(), column);
        let (height, slope) = pile.height_and_slope(x.abs(), column);
        leaf.pile_gaps[node] = z - height;
        if z - height > FAR {
            continue;
        }
        let inverse = 1.0 / (1.0 + slope * slope).sqrt();
        let normal = [-sign * slope * inverse, 0.0, inverse];
        let gap = (z - height) * inverse;
        leaf.depth = leaf.depth.max(-gap);
        sheet.contacts[node][PILE] = half_space(leaf, node, (normal, gap), [0.0; 3], sheet);
    }
}

/// `side` is 1 where the leaf lies on the recto's side of the other.
fn detect_neighbour_contacts(
    leaf: &mut BookSpaceLeaf,
    slot: usize,
    other: Option<Neighbour<'_>>,
    side: f32,
    sheet: &mut ContactView<'_>,
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
    for node in 0..leaf.points.len() {
        // The column at the spine is everyone's.
        if node % columns == 0 {
            continue;
        }
        let before = core::mem::replace(&mut leaf.gaps[slot - 1][node], FAR);
        let point = leaf.points[node];
        let start = other.start_near(point, leaf.nearest[slot - 1][node] as usize);
        let Some(near) = mesh.near(point, start) else {
            continue;
        };
        leaf.nearest[slot - 1][node] = near.node as u16;
        let gap = side * near.height - GAP;
        let away = sub(point, other.points[near.node]);
        // What is far, or far to the wrong side, is not lying upon it there.
        let was_next = before < FAR && gap > before - LEAP;
        let is_past = near.beyond && gap < -PAST_RIM;
        if gap > FAR || is_past || !(gap > -DEEPEST || was_next) || dot(away, away) > FAR * FAR {
            continue;
        }
        leaf.gaps[slot - 1][node] = gap;
        if neighbour.firmness == 1.0 {
            leaf.depth = leaf.depth.max(-gap - GAP);
        }
        let normal = near.normal.map(|n| side * n);
        let velocity = other.velocities[near.node];
        sheet.contacts[node][slot] = Contact {
            firmness: neighbour.firmness,
            ..half_space(leaf, node, (normal, gap), velocity, sheet)
        };
    }
    // Leaves that no grab has crumpled have no folds that their nodes miss.
    if leaf.was_held || other.was_held {
        detect_contacts_between_nodes(leaf, slot, neighbour, side, sheet);
    }
}

/// Finds the contacts of a leaf with a neighbour between its nodes, where folds
/// reach that its nodes do not: the ends of an edge, and the corners of a cell,
/// keep the distance that their middle has, where that is less than their own.
fn detect_contacts_between_nodes(
    leaf: &mut BookSpaceLeaf,
    slot: usize,
    neighbour: Neighbour<'_>,
    side: f32,
    sheet: &mut ContactView<'_>,
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
            if gaps[0].max(gaps[1]) > BETWEEN_NODES {
                continue;
            }
            let point = leaf.middle(node, [right, up]);
            let start = other.start_near(point, leaf.nearest[slot - 1][node] as usize);
            let Some(near) = mesh.near(point, start) else {
                continue;
            };
            let gap = side * near.height - GAP;
            let least = gaps[0].min(gaps[1]);
            if gap > least || gap < least - BETWEEN_NODES {
                continue;
            }
            if neighbour.firmness == 1.0 {
                leaf.depth = leaf.depth.max(-gap - GAP);
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
/// itself where it is, and one that has parts (`flaps`) between creases keeps them apart.
pub fn detect_self_contacts(leaf: &mut BookSpaceLeaf, sheet: &mut ContactView<'_>) {
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
fn nearest_of_itself(leaf: &BookSpaceLeaf, node: usize) -> Option<usize> {
    let columns = leaf.columns;
    let point = leaf.points[node];
    let (mut best, mut least) = (None, CURLED * CURLED);
    for (row, bounds) in leaf.bounds.iter().enumerate() {
        if !bounds.grown([CURLED; 3]).holds(point) {
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
