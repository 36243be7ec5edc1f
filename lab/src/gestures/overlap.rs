//! How deep what is drawn lies inside what it must not: an honest measure, on
//! the drawn meshes alone.

use std::collections::{BTreeMap, BTreeSet};

use turnleaf_engine::Side;
use turnleaf_engine::book::{Book, Pile};

use super::facets::{Facets, Near};
use super::triangle::Point;

/// What is drawn deeper than this in anything is too deep, millimetres on a page 140 mm wide.
pub const TOO_DEEP: f32 = 0.1;

/// Farther than this from another leaf a point is not looked at, as a part of the width,
/// but no edge is longer.
const WITHIN: f32 = 0.086;

/// Part of a leaf, next to the spine, in which the order of leaves is looked at: what has
/// passed another there meets no edge of it any more.
const ROOT: usize = 4;

/// Cells around where a leaf meets itself in which its other part is looked for.
const PART: usize = 8;

/// The deepest of each kind, metres.
#[derive(Clone, Copy, Debug, Default)]
pub struct Overlap {
    /// Of a leaf inside a pile, or under the boards.
    pub pile: f32,
    /// Of a leaf inside another, whether its neighbour or not.
    pub leaf: f32,
    /// Of a leaf inside itself.
    pub itself: f32,
    /// Edges that go through facets of another leaf.
    pub crossings: usize,
}

impl Overlap {
    /// The deepest of all, metres.
    pub fn deepest(&self) -> f32 {
        self.pile.max(self.leaf).max(self.itself)
    }

    /// Each length so many times as long.
    pub fn scaled(self, times: f32) -> Overlap {
        Overlap {
            pile: times * self.pile,
            leaf: times * self.leaf,
            itself: times * self.itself,
            ..self
        }
    }

    /// The worse of two of each kind.
    pub fn worse(self, other: Overlap) -> Overlap {
        Overlap {
            pile: self.pile.max(other.pile),
            leaf: self.leaf.max(other.leaf),
            itself: self.itself.max(other.itself),
            crossings: self.crossings.max(other.crossings),
        }
    }
}

/// Measures what a book draws whose pages have this width and height, metres.
pub fn measure(book: &Book, page: [f32; 2]) -> Overlap {
    let facets: Vec<Facets<'_>> = (0..book.drawn_leaves())
        .filter_map(|index| Facets::of(book, index))
        .collect();
    let within = within(book, page);
    let mut worst = Overlap::default();
    for leaf in &facets {
        worst.pile = worst.pile.max(inside_piles(book, leaf));
        worst.itself = worst.itself.max(inside_itself(leaf, within));
    }
    for (k, left) in facets.iter().enumerate() {
        for right in &facets[k + 1..] {
            let (depth, crossed) = inside_each_other(left, right, within);
            worst.leaf = worst.leaf.max(depth).max(passed(left, right, within));
            worst.crossings = worst.crossings.max(crossed);
        }
    }
    worst
}

/// How far from another leaf a point of a book is looked at, metres.
pub fn within(book: &Book, page: [f32; 2]) -> f32 {
    (WITHIN * page[0]).max(1.5 * page[1] / (book.rows() - 1) as f32)
}

/// How far a leaf is past the one on its right where all of its root is, so that no edge
/// of it goes through that one any more, metres; 0 where it is not.
fn passed(left: &Facets<'_>, right: &Facets<'_>, within: f32) -> f32 {
    let columns = left.columns();
    let mut most = 0.0f32;
    for (node, place) in left.points().iter().enumerate() {
        let column = node % columns;
        if column == 0 || column > columns / ROOT {
            continue;
        }
        match right.near(*place, within) {
            Some(near) if !near.recto && !near.rim => most = most.max(near.distance),
            _ => return 0.0,
        }
    }
    most
}

/// How deep a leaf goes through itself, metres: where it cuts a piece of itself off, as
/// when a corner pokes through, how far that comes beyond the other part; elsewhere how
/// far an edge that goes through a facet comes out of its plane.
pub fn inside_itself(leaf: &Facets<'_>, within: f32) -> f32 {
    let found = leaf.own_crossings();
    if found.is_empty() {
        return 0.0;
    }
    let crossed: BTreeSet<[usize; 2]> = found.iter().map(|(edge, _)| *edge).collect();
    let mut known: BTreeMap<usize, Option<f32>> = BTreeMap::new();
    let mut deepest = 0.0f32;
    for (edge, facet) in &found {
        let (edge, facet) = (*edge, *facet);
        let heights = edge.map(|node| leaf.height_over(node, facet));
        let beyond = edge.map(|end| {
            if let Some(known) = known.get(&end) {
                return *known;
            }
            let piece = piece(leaf, end, &crossed);
            let far = piece
                .as_ref()
                .map(|piece| beyond_part(leaf, piece, &found).min(within));
            let all = piece.into_iter().flatten().chain([end]);
            known.extend(all.map(|node| (node, far)));
            far
        });
        // Of two pieces that are cut off the less deep one went through.
        let beyond = match beyond {
            [Some(a), Some(b)] => a.min(b),
            [a, b] => a.or(b).unwrap_or(0.0),
        };
        deepest = deepest.max(heights[0].min(heights[1])).max(beyond);
    }
    deepest
}

/// How far a piece that is cut off comes beyond the other part, metres: each point is as far
/// as the nearest of where the piece is cut off is, all along it.
fn beyond_part(leaf: &Facets<'_>, piece: &[usize], found: &[([usize; 2], [usize; 3])]) -> f32 {
    let cut = |(edge, _): &&([usize; 2], [usize; 3])| edge.iter().any(|end| piece.contains(end));
    let facets: BTreeSet<[usize; 3]> = found.iter().filter(cut).map(|(_, facet)| *facet).collect();
    let far = |node: &usize| {
        let parts = facets.iter();
        let distances = parts.map(|facet| leaf.distance_to_part(*node, *facet, PART));
        distances.fold(f32::MAX, f32::min)
    };
    piece.iter().map(far).fold(0.0, f32::max)
}

/// The points of a leaf that can be reached from one without going through the leaf; None
/// where these are not a small part of all.
fn piece(leaf: &Facets<'_>, from: usize, crossed: &BTreeSet<[usize; 2]>) -> Option<Vec<usize>> {
    let (columns, count) = (leaf.columns(), leaf.points().len());
    let mut reached = BTreeSet::new();
    let mut open = vec![from];
    while let Some(node) = open.pop() {
        if !reached.insert(node) {
            continue;
        }
        if reached.len() > count / 8 {
            return None;
        }
        open.extend(beside(node, columns, count).filter(|to| {
            let edge = [node.min(*to), node.max(*to)];
            !crossed.contains(&edge)
        }));
    }
    Some(reached.into_iter().collect())
}

/// The points next to one along its row and its column.
fn beside(node: usize, columns: usize, count: usize) -> impl Iterator<Item = usize> {
    let column = node % columns;
    [
        (column > 0).then(|| node - 1),
        (column + 1 < columns).then_some(node + 1),
        node.checked_sub(columns),
        (node + columns < count).then_some(node + columns),
    ]
    .into_iter()
    .flatten()
}

/// Deepest point of a leaf under the piles or the boards. A pile is a cylinder
/// along the spine over flat facets, so that the deepest point of a facet is at
/// one of its corners or where one of its edges passes over an edge of the pile.
fn inside_piles(book: &Book, leaf: &Facets<'_>) -> f32 {
    let piles = [Side::Right, Side::Left].map(|side| book.pile(side));
    let points = leaf.points();
    let highest = piles[0].highest().max(piles[1].highest());
    let mut deepest = points.iter().map(|p| under(piles, *p)).fold(0.0, f32::max);
    for [a, b] in leaf.edges() {
        let (p, q) = (points[a], points[b]);
        // What is well above every pile passes over none.
        if p[2].min(q[2]) > highest {
            continue;
        }
        let (low, high) = (p[0].min(q[0]), p[0].max(q[0]));
        for (pile, sign) in [(piles[0], 1.0), (piles[1], -1.0)] {
            let (near, far) = ((sign * low).min(sign * high), (sign * low).max(sign * high));
            let mut ridge = pile.column_before(near.max(0.0), 0);
            while ridge < pile.columns() && pile.place(ridge)[0] < far {
                let x = sign * pile.place(ridge)[0];
                if x > low && x < high {
                    let at = (x - p[0]) / (q[0] - p[0]);
                    let place = core::array::from_fn(|i| p[i] + at * (q[i] - p[i]));
                    deepest = deepest.max(under(piles, place));
                }
                ridge += 1;
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

/// How deep two leaves that share their spine are in each other, metres, and how many edges of
/// either go through the other: the left one lies on the recto's side of the right one.
///
/// Of two pieces that went through each other it is the less deep one that did. What is bent
/// over under another leaf so that its rim dips into that has all of that one on its wrong side,
/// which is no deeper for it than the rim is.
fn inside_each_other(left: &Facets<'_>, right: &Facets<'_>, within: f32) -> (f32, usize) {
    let own = Through::find(left, right, false, within);
    let other = Through::find(right, left, true, within);
    let depth = own.deepest(&other).max(other.deepest(&own));
    (depth, own.crossed.len() + other.crossed.len())
}

/// What of a leaf went through another.
///
/// Two leaves lie inside each other only where one goes through the other. A point that has a
/// leaf on its wrong side without that has come round a rim, or lies under a flap that is folded
/// over: so depth is looked for from where edges come out of facets on the wrong side, up to
/// where the leaf comes back through or is on the right side again.
struct Through {
    /// Edges that go through the other leaf.
    crossed: BTreeSet<[usize; 2]>,
    /// Points that came out on the wrong side, and the facet of the other leaf that they did by.
    out: Vec<(usize, [usize; 3])>,
    /// The pieces that points on the wrong side belong to, and how deep each is, metres.
    pieces: BTreeMap<usize, usize>,
    depths: Vec<f32>,
    /// How deep an edge is between two facets that it goes through, metres.
    between: f32,
}

impl Through {
    /// What of a leaf went through another that has it on its recto or not.
    fn find(leaf: &Facets<'_>, other: &Facets<'_>, recto: bool, within: f32) -> Through {
        let points = leaf.points();
        let mut known: Vec<Option<Option<Near>>> = vec![None; points.len()];
        // The column at the spine is everyone's.
        let mut near = |node: usize| {
            let found = || other.near(points[node], within);
            *known[node]
                .get_or_insert_with(|| (!node.is_multiple_of(leaf.columns())).then(found)?)
        };
        let wrong = |near: &Option<Near>| match near {
            Some(near) if near.recto == recto && !near.rim => near.distance,
            _ => 0.0,
        };
        let mut found = Through {
            crossed: BTreeSet::new(),
            out: Vec::new(),
            pieces: BTreeMap::new(),
            depths: Vec::new(),
            between: 0.0,
        };
        for [a, b] in leaf.edges_near(other) {
            let (p, q) = (points[a], points[b]);
            let through = other.crossings(p, q);
            let ends = [
                through.iter().min_by(|x, y| x.0.at.total_cmp(&y.0.at)),
                through.iter().max_by(|x, y| x.0.at.total_cmp(&y.0.at)),
            ];
            let [Some((first, by_first)), Some((last, by_last))] = ends else {
                continue;
            };
            if near(a).is_none() || near(b).is_none() {
                continue;
            }
            found.crossed.insert([a, b]);
            // An end that a facet has on its wrong side went through it.
            if first.from_recto == recto {
                found.out.push((a, *by_first));
            }
            if last.from_recto != recto {
                found.out.push((b, *by_last));
            }
            // Between its ends, an edge is deepest about half-way from one facet
            // that it goes through to the next.
            let at = 0.5 * (first.at + last.at);
            let middle = core::array::from_fn(|i| p[i] + at * (q[i] - p[i]));
            found.between = found.between.max(wrong(&other.near(middle, within)));
        }
        for &(from, _) in &found.out {
            let piece = found.depths.len();
            let mut deepest = 0.0f32;
            let mut open = vec![from];
            while let Some(node) = open.pop() {
                let depth = wrong(&near(node));
                if depth == 0.0 || found.pieces.contains_key(&node) {
                    continue;
                }
                found.pieces.insert(node, piece);
                deepest = deepest.max(depth);
                let whole = |to: &usize| !found.crossed.contains(&[node.min(*to), node.max(*to)]);
                open.extend(beside(node, leaf.columns(), points.len()).filter(whole));
            }
            found.depths.push(deepest);
        }
        found
    }

    /// How deep the piece of a point is, metres; None where it belongs to none.
    fn depth(&self, node: usize) -> Option<f32> {
        self.pieces.get(&node).map(|piece| self.depths[*piece])
    }

    /// The deepest of its pieces in the other leaf, of which `other` tells the same, metres.
    fn deepest(&self, other: &Through) -> f32 {
        let depth = |(end, facet): &(usize, [usize; 3])| {
            let own = self.depth(*end).unwrap_or(0.0);
            let others = facet.iter().filter_map(|corner| other.depth(*corner));
            own.min(others.reduce(f32::max).unwrap_or(f32::MAX))
        };
        self.out.iter().map(depth).fold(self.between, f32::max)
    }
}

#[cfg(test)]
mod tests {
    use turnleaf_engine::Surface;

    use super::*;

    const WITHIN: f32 = 0.012;

    /// A surface of 25 x 7 points 5 mm apart with these places along x and z for each column.
    fn surface(place: impl Fn(usize) -> [f32; 2]) -> Surface {
        let mut surface = Surface::new(25, 7);
        for (node, point) in surface.positions.chunks_exact_mut(3).enumerate() {
            let [x, z] = place(node % 25);
            point.copy_from_slice(&[x, (node / 25) as f32 * 0.005, z]);
        }
        surface
    }

    /// A leaf over another whose outer third is bent down under the rest and back, so that its
    /// rim is `deep` in the other one: what lies under the flap has the flap's recto next to it,
    /// far from its rim too, and is not inside it by that.
    #[test]
    fn a_rim_that_is_folded_under_is_as_deep_as_it_is() {
        for deep in [0.4e-6, 0.2e-3, 1.1e-3] {
            let under = surface(|column| [column as f32 * 0.005, 0.0]);
            let over = surface(|column| match column {
                0..16 => [column as f32 * 0.005, 0.006],
                16 => [0.08, 0.003],
                _ => {
                    let back = (column - 16) as f32;
                    [0.08 - 0.005 * back, 0.003 - back * (0.003 + deep) / 8.0]
                }
            });
            let [left, right] = [&over, &under].map(Facets::new);
            let (depth, _) = inside_each_other(&left, &right, WITHIN);
            assert!((depth - deep).abs() < 0.01 * deep, "{deep}: {depth}");
        }
    }
}
