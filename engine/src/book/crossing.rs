//! Whether two leaves go through each other.
//!
//! Asked where leaves have come deep into each other, of the leaves as they are
//! simulated (see [`Flights::step`](super::flights::Flights::step)) and as they are
//! drawn (see [`draw`](super::draw)).

use super::mesh::Mesh;
use crate::vector::{cross, dot, sub};

/// Cells along a side of a block that one box bounds, and points along it.
const BLOCK: usize = 3;
const SIDE: usize = BLOCK + 1;

/// Part of a facet's size by which an edge may miss it and still goes through it:
/// rounding leaves no gap between facets.
const SEAM: f32 = 1e-4;

/// The inverse of the part of a leaf, next to the spine, in which the order of leaves
/// is looked at: what has passed another there has done so all along it, and meets no
/// edge of it any more.
const ROOT: usize = 4;

type Point = [f32; 3];

/// A leaf, drawn or as paper, cut into blocks of cells; cut anew, it takes the same room.
#[derive(Clone, Debug, Default)]
pub struct Blocks(Vec<Block>);

#[derive(Clone, Debug)]
struct Block {
    /// Lowest and highest corner of its box.
    low: Point,
    high: Point,
    /// x, y, z of its points, row by row; where the leaf has fewer the last again.
    points: [[f32; SIDE * SIDE]; 3],
    /// The middle one's normal, and how far along it the points reach.
    normal: Point,
    reach: [f32; 2],
}

impl Blocks {
    /// Cuts a leaf.
    pub fn cut(&mut self, leaf: Mesh<'_>) {
        let (columns, rows) = (leaf.columns, leaf.points.len() / leaf.columns);
        self.0.clear();
        for row in (0..rows - 1).step_by(BLOCK) {
            for column in (0..columns - 1).step_by(BLOCK) {
                let node = |k: usize| {
                    let row = (row + k / SIDE).min(rows - 1);
                    row * columns + (column + k % SIDE).min(columns - 1)
                };
                let points: [[f32; SIDE * SIDE]; 3] = core::array::from_fn(|axis| {
                    core::array::from_fn(|k| leaf.points[node(k)][axis])
                });
                let normal = leaf.normals[node(SIDE + 1)];
                let [x, y, z] = points.each_ref().map(range);
                self.0.push(Block {
                    low: [x[0], y[0], z[0]],
                    high: [x[1], y[1], z[1]],
                    reach: range(&heights(&points, normal, 0.0)),
                    points,
                    normal,
                });
            }
        }
    }

    /// Whether two leaves go through each other by more than `touch`, metres: edges of
    /// which both ends are farther than that from the plane of a facet go through it.
    pub fn cross(&self, other: &Blocks, touch: f32) -> bool {
        self.0.iter().any(|own| {
            let mut met = other.0.iter().filter(|block| own.meets(block, touch));
            met.any(|block| own.pierces(block, touch) || block.pierces(own, touch))
        })
    }
}

/// Whether all of a leaf's root has passed that of the one on its right, by `astray`
/// metres or more somewhere.
#[inline(never)]
pub fn is_past(left: Mesh<'_>, right: Mesh<'_>, astray: f32) -> bool {
    let root = 1..=left.columns / ROOT;
    let nodes = (0..left.points.len()).filter(|node| root.contains(&(node % left.columns)));
    let ahead = nodes.map(|node| {
        let away = sub(left.points[node], right.points[node]);
        dot(away, right.normals[node])
    });
    let [least, most] = ahead.fold([f32::MAX, f32::MIN], |[a, b], h| [a.min(h), b.max(h)]);
    most < 0.0 && least < -astray
}

#[inline(never)]
fn range(values: &[f32; SIDE * SIDE]) -> [f32; 2] {
    // Compared by hand: a library's least and most mind what is no number, and are slow.
    let mut range = [f32::MAX, f32::MIN];
    for &value in values {
        range[0] = if value < range[0] { value } else { range[0] };
        range[1] = if value > range[1] { value } else { range[1] };
    }
    range
}

impl Block {
    /// Whether two blocks are near enough to each other to cross by more than `touch`.
    fn meets(&self, other: &Block, touch: f32) -> bool {
        (0..3).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
            && !self.is_beside(other, touch)
            && !other.is_beside(self, touch)
    }

    /// Whether all of another block is over this one, or under it, but for `touch` metres.
    fn is_beside(&self, other: &Block, touch: f32) -> bool {
        let [low, high] = range(&heights(&other.points, self.normal, 0.0));
        low >= self.reach[1] - touch || high <= self.reach[0] + touch
    }

    fn point(&self, k: usize) -> Point {
        [0, 1, 2].map(|axis| self.points[axis][k])
    }

    /// Whether an edge of this block goes through a facet of another. Each cell's
    /// diagonal runs, as it is drawn, from its corner next to the spine and the foot.
    fn pierces(&self, other: &Block, touch: f32) -> bool {
        let mut cells = (0..BLOCK * BLOCK).map(|k| k / BLOCK * SIDE + k % BLOCK);
        cells.any(|here| {
            let above = here + SIDE;
            let mut facets = [[here, here + 1, above + 1], [here, above + 1, above]].into_iter();
            facets.any(|corners| {
                let facet = corners.map(|k| other.point(k));
                self.is_by(&facet) && self.pierces_facet(facet, touch)
            })
        })
    }

    /// Whether a facet reaches into the block's box.
    fn is_by(&self, [a, b, c]: &[Point; 3]) -> bool {
        (0..3).all(|i| {
            let (low, high) = (self.low[i], self.high[i]);
            (a[i] >= low || b[i] >= low || c[i] >= low)
                && (a[i] <= high || b[i] <= high || c[i] <= high)
        })
    }

    fn pierces_facet(&self, facet: [Point; 3], touch: f32) -> bool {
        let [a, b, c] = facet;
        let normal = cross(sub(b, a), sub(c, a));
        let touch = touch * dot(normal, normal).sqrt();
        let heights = heights(&self.points, normal, dot(normal, a));
        let [low, high] = range(&heights);
        if low >= -touch || high <= touch {
            return false;
        }
        (0..SIDE * SIDE).any(|k| {
            let (right, up) = (k % SIDE < BLOCK, k / SIDE < BLOCK);
            let ends = [(right, 1), (up, SIDE), (right && up, SIDE + 1)];
            ends.into_iter().any(|(is_edge, step)| {
                if !is_edge {
                    return false;
                }
                let (h, g) = (heights[k], heights[k + step]);
                if h.min(g) >= -touch || h.max(g) <= touch {
                    return false;
                }
                let (p, q) = (self.point(k), self.point(k + step));
                let at = h / (h - g);
                let place = core::array::from_fn(|i| p[i] + at * (q[i] - p[i]));
                holds(facet, normal, place)
            })
        })
    }
}

/// How far points are along a normal, beyond `from`.
#[inline(never)]
fn heights([x, y, z]: &[[f32; SIDE * SIDE]; 3], n: Point, from: f32) -> [f32; SIDE * SIDE] {
    core::array::from_fn(|k| n[0] * x[k] + n[1] * y[k] + n[2] * z[k] - from)
}

/// Whether a place in the plane of a facet lies in it.
#[inline(never)]
fn holds([a, b, c]: [Point; 3], normal: Point, place: Point) -> bool {
    let seam = -SEAM * dot(normal, normal);
    let inside = |p: Point, q: Point| dot(normal, cross(sub(q, p), sub(place, p))) >= seam;
    inside(a, b) && inside(b, c) && inside(c, a)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::Surface;

    /// A surface of 9 x 7 points a centimetre apart, at a height by column and row.
    fn surface(height: impl Fn(f32, f32) -> f32) -> Surface {
        let mut surface = Surface::new(9, 7);
        for (node, point) in surface.positions.chunks_exact_mut(3).enumerate() {
            let (x, y) = ((node % 9) as f32 * 0.01, (node / 9) as f32 * 0.01);
            point.copy_from_slice(&[x, y, height(x, y)]);
        }
        surface.update_normals();
        surface
    }

    fn crosses(left: &Surface, right: &Surface) -> bool {
        let [mut a, mut b] = [Blocks::default(), Blocks::default()];
        a.cut(Mesh::of(left));
        b.cut(Mesh::of(right));
        assert_eq!(a.cross(&b, 1e-6), b.cross(&a, 1e-6));
        a.cross(&b, 1e-6)
    }

    #[test]
    fn leaves_upon_each_other_do_not_cross_however_they_bend() {
        let bent = |gap: f32| surface(move |x, y| 0.02 * (20.0 * x + 9.0 * y).sin() + gap);
        assert!(!crosses(&bent(0.0), &bent(5e-5)));
        assert!(!crosses(&bent(0.0), &bent(0.0)));
        assert!(crosses(&bent(0.0), &surface(|_, _| 0.01)));
    }

    #[test]
    fn a_crease_through_a_plane_is_found_wherever_it_is() {
        let level = surface(|_, _| 0.0);
        for row in 0..7 {
            for column in 0..9 {
                let (x, y) = (column as f32 * 0.01, row as f32 * 0.01);
                let at = |p: f32, q: f32| (p - x).abs() < 1e-4 && (q - y).abs() < 1e-4;
                let dented = surface(|p, q| if at(p, q) { -2e-5 } else { 2e-5 });
                assert!(crosses(&dented, &level), "{column} {row}");
            }
        }
    }

    #[test]
    fn a_leaf_swung_past_the_next_is_past_it_and_meets_no_edge_of_it() {
        let [left, right] = [1.0, -1.0].map(|slope| surface(move |x, _| slope * x));
        assert!(!is_past(Mesh::of(&left), Mesh::of(&right), 5e-5));
        assert!(is_past(Mesh::of(&right), Mesh::of(&left), 5e-5));
        assert!(!crosses(&left, &right));
    }
}
