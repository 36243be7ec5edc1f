//! How deep what is drawn lies inside what it must not: an honest measure, on
//! the drawn meshes alone.

use std::collections::BTreeSet;

use turnleaf_engine::book::{Book, Pile};
use turnleaf_engine::{Side, Surface};

use super::facets::{Facets, Near, Point, dot, sub};

/// Farther than this from another leaf, metres, a point is not looked at.
const WITHIN: f32 = 0.012;

/// The deepest of each kind, metres.
#[derive(Clone, Copy, Debug, Default)]
pub struct Overlap {
    /// Of a leaf inside a pile, or under the boards.
    pub pile: f32,
    /// Of a leaf inside another.
    pub leaf: f32,
    /// Edges that go through facets of a neighbouring leaf.
    pub crossings: usize,
}

impl Overlap {
    /// The deepest of all, metres.
    pub fn deepest(&self) -> f32 {
        self.pile.max(self.leaf)
    }

    /// The worse of two of each kind.
    pub fn worse(self, other: Overlap) -> Overlap {
        Overlap {
            pile: self.pile.max(other.pile),
            leaf: self.leaf.max(other.leaf),
            crossings: self.crossings.max(other.crossings),
        }
    }
}

/// Measures what a book draws.
pub fn measure(book: &Book) -> Overlap {
    let surfaces: Vec<&Surface> = (0..book.flights())
        .filter_map(|index| book.surface(index))
        .collect();
    let facets: Vec<Facets<'_>> = surfaces
        .iter()
        .map(|surface| Facets::new(surface))
        .collect();
    let mut worst = Overlap::default();
    for leaf in &facets {
        worst.pile = worst.pile.max(inside_piles(book, leaf));
    }
    for pair in facets.windows(2) {
        let [left, right] = pair else { continue };
        // The left one lies on the recto's side of the right one.
        let (a, crossed) = inside_leaf(left, right, false);
        let (b, crossed_back) = inside_leaf(right, left, true);
        worst.leaf = worst.leaf.max(a).max(b);
        worst.crossings = worst.crossings.max(crossed + crossed_back);
    }
    worst
}

/// Deepest point of a leaf under the piles or the boards. A pile is a cylinder
/// along the spine over flat facets, so that the deepest point of a facet is at
/// one of its corners or where one of its edges passes over an edge of the pile.
fn inside_piles(book: &Book, leaf: &Facets<'_>) -> f32 {
    let piles = [Side::Right, Side::Left].map(|side| book.pile(side));
    let points = leaf.points();
    let mut deepest = points.iter().map(|p| under(piles, *p)).fold(0.0, f32::max);
    for [a, b] in leaf.edges() {
        let (p, q) = (points[a], points[b]);
        // What is well above every pile passes over none.
        if p[2].min(q[2]) > 0.05 {
            continue;
        }
        let (low, high) = (p[0].min(q[0]), p[0].max(q[0]));
        for pile in piles {
            let ridges = pile.curves()[..2 * pile.columns()].chunks_exact(2);
            for ridge in ridges.filter(|r| r[0] > low && r[0] < high) {
                let at = (ridge[0] - p[0]) / (q[0] - p[0]);
                let place = core::array::from_fn(|i| p[i] + at * (q[i] - p[i]));
                deepest = deepest.max(under(piles, place));
            }
        }
    }
    deepest
}

/// How far a point is under the pile on its side, along the pile's normal.
fn under([right, left]: [&Pile; 2], [x, _, z]: Point) -> f32 {
    let pile = if x >= 0.0 { right } else { left };
    let (height, slope) = pile.height_and_slope(x.abs(), pile.column_before(x.abs(), 0));
    ((height - z) / (1.0 + slope * slope).sqrt()).max(0.0)
}

/// Deepest point of a leaf that went through another, that of its recto or not,
/// and how many of its edges go through the other.
///
/// Two leaves that share their spine in the right order lie inside each other
/// only where one goes through the other. A point that has a leaf on its wrong
/// side without that has come round a rim, or lies under a flap that is folded
/// over: so depth is looked for from where edges come out of facets on the wrong
/// side, up to where the leaf comes back through or is on the right side again.
fn inside_leaf(leaf: &Facets<'_>, other: &Facets<'_>, recto: bool) -> (f32, usize) {
    let points = leaf.points();
    // The column at the spine is everyone's.
    let near: Vec<_> = points
        .iter()
        .enumerate()
        .map(|(node, p)| (node % leaf.columns() > 0).then(|| other.near(*p, WITHIN))?)
        .collect();
    let wrong = |near: &Option<Near>| match near {
        Some(near) if near.recto == recto && !near.rim => near.distance,
        _ => 0.0,
    };
    let mut deepest = 0.0f32;
    let mut crossed = BTreeSet::new();
    let mut open = Vec::new();
    for [a, b] in leaf.edges() {
        let (Some(from), Some(to)) = (near[a], near[b]) else {
            continue;
        };
        let (p, q) = (points[a], points[b]);
        let along = sub(p, q);
        let length = dot(along, along).sqrt();
        if from.distance.min(to.distance) > length {
            continue;
        }
        let through = other.crossings(p, q);
        let ends = [
            through.iter().min_by(|x, y| x.at.total_cmp(&y.at)),
            through.iter().max_by(|x, y| x.at.total_cmp(&y.at)),
        ];
        let [Some(first), Some(last)] = ends else {
            continue;
        };
        crossed.insert([a, b]);
        // An end that a facet has on its wrong side went through it.
        if first.from_recto == recto {
            open.push(a);
        }
        if last.from_recto != recto {
            open.push(b);
        }
        // Between its ends, an edge is deepest about half-way from one facet
        // that it goes through to the next.
        let at = 0.5 * (first.at + last.at);
        let middle = core::array::from_fn(|i| p[i] + at * (q[i] - p[i]));
        deepest = deepest.max(wrong(&other.near(middle, WITHIN)));
    }
    let columns = leaf.columns();
    let mut reached = vec![false; points.len()];
    while let Some(node) = open.pop() {
        let depth = wrong(&near[node]);
        if reached[node] || depth == 0.0 {
            continue;
        }
        reached[node] = true;
        deepest = deepest.max(depth);
        let (column, rows) = (node % columns, points.len() / columns);
        let beside = [
            (column > 0).then(|| node - 1),
            (column + 1 < columns).then_some(node + 1),
            node.checked_sub(columns),
            (node / columns + 1 < rows).then_some(node + columns),
        ];
        let whole = |to: &usize| !crossed.contains(&[node.min(*to), node.max(*to)]);
        open.extend(beside.into_iter().flatten().filter(whole));
    }
    (deepest, crossed.len())
}
