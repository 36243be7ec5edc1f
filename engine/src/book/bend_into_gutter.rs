//! Bends a simulated leaf into the gutter of the book.
//!
//! The models simulate a leaf over a flat table with a straight root. In a book
//! the leaf's root leaves a gutter between two curved piles. Each row of the
//! leaf is therefore bent further: where its tangent points at an angle phi in
//! the plane across the spine, it is turned by
//!
//! ```text
//! delta = (1 - w) theta_right(s) - w theta_left(s),   w = phi / pi
//! ```
//!
//! and the row is summed up anew from the gutter. At rest on either side the
//! leaf so lies exactly on that side's pile; in between its root stays between
//! the two piles, so it cannot cut the opposite hump; and every segment keeps
//! its length, so bending adds no strain along a row. What would still lie
//! inside a pile is pushed onto it.

use super::fraction_turned::fraction_turned;
use super::pile::Pile;
use super::turn_by_place::turn_between;
use crate::contact::mesh::Folds;
use crate::contact::tolerance::{OVER_PILE, ROOM_FROM_SPINE, ROUNDING, SLIVER};
use crate::creased_only::CreasedOnly;

/// Bends the points of a leaf into the gutter, in place.
///
/// `positions` are x, y, z in metres, row by row, each row from the spine to
/// the fore-edge; a row has as many points as the piles have columns. The
/// piles' uppermost curves are the places where the leaf rests. One of some `straightness`
/// (0 to 1) is bent less than by a pile that is not as straight. Points `beyond` a crease, none
/// where there is no crease, are turned by where they are, and not by how far along their row.
pub fn bend_into_gutter(
    positions: &mut [f32],
    right: &Pile,
    left: &Pile,
    (straightness, beyond): (f32, CreasedOnly<&[bool]>),
) {
    let columns = right.columns();
    debug_assert_eq!(columns, left.columns());
    let angles = [right, left].map(|pile| pile.angles_for(straightness));
    if let Some(beyond) = beyond.as_ref() {
        let ends = right.distances();
        let rows = positions.chunks_exact_mut(3 * columns);
        for (row, beyond) in rows.zip(beyond.chunks_exact(columns)) {
            bend_folded_row(row, [&angles[0], &angles[1]], beyond, &ends);
        }
    } else {
        for row in positions.chunks_exact_mut(3 * columns) {
            bend_row(row, &angles[0], &angles[1]);
        }
    }
    push_off(positions, [right, left], Over::NOTHING);
}

/// How far leaves are kept over the piles (right and left).
#[derive(Clone, Copy)]
pub struct Over {
    /// Far from the spine, metres.
    most: [f32; 2],
    /// The inverse of how far from the spine it is as much, 1 / metres.
    from: f32,
}

impl Over {
    /// As far as the piles reach.
    const NOTHING: Over = Over::everywhere(0.0);

    /// As far as this over both, or under them, also at the spine, metres.
    const fn everywhere(over: f32) -> Over {
        Over {
            most: [over; 2],
            from: f32::MAX,
        }
    }

    /// So far over each where there is room, metres for a page 0.14 m wide; the page is wider by
    /// `scale`. All that fly meet in one line at the spine, where none is kept off another: toward it
    /// the distance shrinks, as that between neighbours does. What is lifted there all the same goes
    /// through the leaf over it.
    pub fn of(most: [f32; 2], scale: f32) -> Over {
        Over {
            most: most.map(|most| most * scale),
            from: SLIVER / (OVER_PILE * ROOM_FROM_SPINE * scale),
        }
    }

    fn at(&self, side: usize, x: f32) -> f32 {
        self.most[side] * (x.abs() * self.from).min(1.0)
    }
}

/// Pushes what of a leaf lies inside the piles (right and left) as far `over` them as said;
/// positions as in [`bend_into_gutter`].
pub fn push_off(positions: &mut [f32], piles: [&Pile; 2], over: Over) {
    let highest = highest(piles, over);
    for row in positions.chunks_exact_mut(3 * piles[0].columns()) {
        let mut below = Below { piles, column: 0 };
        for point in row.chunks_exact_mut(3).skip(1) {
            if point[2] < highest {
                let height = below.height(point[0], over);
                if point[2] < height {
                    point[2] = height;
                }
            }
        }
    }
}

/// Pushes edges that come lower between their ends than [`push_off`] lets those, at both
/// ends: over a ridge two points may lie clear of the pile and what is drawn between
/// them not. `folds` are those of the leaf.
pub fn push_edges_off(positions: &mut [f32], folds: Folds<'_>, piles: [&Pile; 2], over: Over) {
    let columns = piles[0].columns();
    push_edges_off_where((positions, columns, folds), piles, over, |_| true);
}

/// The same of points in so many columns, and of edges both of whose ends lie where something
/// `is_over` a pile.
pub fn push_edges_off_where(
    (positions, columns, folds): (&mut [f32], usize, Folds<'_>),
    piles: [&Pile; 2],
    over: Over,
    is_over: impl Fn([f32; 3]) -> bool,
) {
    let highest = highest(piles, over);
    let points = positions.as_chunks_mut::<3>().0;
    let mut below = Below { piles, column: 0 };
    for node in 0..points.len() - 1 {
        let column = node % columns;
        // Along a row, along a column, along the diagonal of a cell as it is drawn.
        for step in [1, columns, columns + 1] {
            let at_rim = node + step >= points.len() || (column + 1 == columns && step != columns);
            if column == 0 || at_rim {
                continue;
            }
            let [from, to] = ends_of(node, step, columns, folds);
            let (a, b) = (points[from], points[to]);
            if (a[2] > highest && b[2] > highest) || !is_over(a) || !is_over(b) {
                continue;
            }
            let most = below.missing([a, b], over);
            if most > 0.0 {
                points[from][2] += most;
                points[to][2] += most;
            }
        }
    }
}

/// The ends of an edge that leads so many points on from a node, which is its cell's diagonal where
/// that is a row and a point: a fold may have it run the other way.
fn ends_of(node: usize, step: usize, columns: usize, folds: Folds<'_>) -> [usize; 2] {
    if step == columns + 1 && folds.is_falling(node) {
        [node + 1, node + columns]
    } else {
        [node, node + step]
    }
}

/// Whether no point and no edge of a leaf with some `folds` lies inside the piles (right and left);
/// positions as in [`bend_into_gutter`].
pub fn is_clear(positions: &[f32], folds: Folds<'_>, piles: [&Pile; 2]) -> bool {
    let over = Over::everywhere(-ROUNDING);
    let highest = highest(piles, over);
    let columns = piles[0].columns();
    let points = positions.as_chunks::<3>().0;
    let mut below = Below { piles, column: 0 };
    (0..points.len()).all(|node| {
        let (column, point) = (node % columns, points[node]);
        // The column at the spine is everyone's.
        if column == 0 {
            return true;
        }
        let mut edges = [1, columns, columns + 1].into_iter();
        (point[2] > highest || point[2] >= below.height(point[0], over))
            && edges.all(|step| {
                let at_rim =
                    node + step >= points.len() || (column + 1 == columns && step != columns);
                at_rim || {
                    let ends = ends_of(node, step, columns, folds).map(|end| points[end]);
                    ends[0][2].min(ends[1][2]) > highest || below.missing(ends, over) <= 0.0
                }
            })
    })
}

/// What lies below one place after another: the piles (right and left), and the column
/// before the last place.
struct Below<'a> {
    piles: [&'a Pile; 2],
    column: usize,
}

impl Below<'_> {
    /// The side of `x`, and the column of the pile before it.
    fn find(&mut self, x: f32) -> (usize, usize) {
        let side = usize::from(x < 0.0);
        self.column = self.piles[side].column_before(x.abs(), self.column);
        (side, self.column)
    }

    /// How high a leaf is pushed up at `x`, metres.
    fn height(&mut self, x: f32, over: Over) -> f32 {
        let (side, column) = self.find(x);
        self.piles[side].height_and_slope(x.abs(), column).0 + over.at(side, x)
    }

    /// By how much an edge, the ends of which are not, is too low somewhere, metres.
    fn missing(&mut self, [a, b]: [[f32; 3]; 2], over: Over) -> f32 {
        let ends = [self.find(b[0]), self.find(a[0])];
        // A pile is straight between its columns: the edge is lowest over one of these.
        let mut most = 0.0;
        for side in 0..2 {
            let on_side = ends.map(|(own, column)| if own == side { column + 1 } else { 0 });
            for column in on_side[0].min(on_side[1])..on_side[0].max(on_side[1]) {
                let [x, height] = self.piles[side].place(column);
                let x = if side == 0 { x } else { -x };
                let z = a[2] + (x - a[0]) / (b[0] - a[0]) * (b[2] - a[2]);
                let missing = height + over.at(side, x) - z;
                most = if missing > most { missing } else { most };
            }
        }
        most
    }
}

/// No leaf is pushed higher than this, metres.
fn highest(piles: [&Pile; 2], over: Over) -> f32 {
    let highest = |side: usize| piles[side].highest() + over.most[side];
    highest(0).max(highest(1))
}

fn bend_row(row: &mut [f32], right: &[f32], left: &[f32]) {
    let (mut x0, mut z0) = (row[0], row[2]);
    let (mut x, mut z) = (0.0, 0.0);
    row[0] = x;
    row[2] = z;
    for (k, point) in row.chunks_exact_mut(3).skip(1).enumerate() {
        let (dx, dz) = (point[0] - x0, point[2] - z0);
        (x0, z0) = (point[0], point[2]);
        let w = fraction_turned(dx, dz);
        let (sin, cos) = libm::sincosf((1.0 - w) * right[k] - w * left[k]);
        x += dx * cos - dz * sin;
        z += dx * sin + dz * cos;
        point[0] = x;
        point[2] = z;
    }
}

/// Bends a row of a creased leaf: see [`bend_into_gutter`]. `ends` say how far from the spine the
/// piles' columns are.
fn bend_folded_row(row: &mut [f32], [right, left]: [&[f32]; 2], beyond: &[bool], ends: &[f32]) {
    let turn = |cell: usize, turned: f32| {
        let (sin, cos) = libm::sincosf((1.0 - turned) * right[cell] - turned * left[cell]);
        [cos, sin]
    };
    let points = row.as_chunks_mut::<3>().0;
    let mut flat = [points[0][0], points[0][2]];
    let mut at = [0.0, 0.0];
    (points[0][0], points[0][2]) = (0.0, 0.0);
    for (k, (point, is_beyond)) in points.iter_mut().zip(beyond).enumerate().skip(1) {
        let before = flat;
        flat = [point[0], point[2]];
        let [dx, dz] = [flat[0] - before[0], flat[1] - before[1]];
        let [cos, sin] = if *is_beyond {
            turn_between(before, flat, ends, turn)
        } else {
            turn(k - 1, fraction_turned(dx, dz))
        };
        at = [at[0] + dx * cos - dz * sin, at[1] + dx * sin + dz * cos];
        (point[0], point[2]) = (at[0], at[1]);
    }
}

#[cfg(test)]
mod tests {
    use super::super::pile::crowded_columns;
    use super::*;
    use crate::grid::Side;

    const WIDTH: f32 = 0.14;

    fn piles(right: f64, left: f64) -> (Pile, Pile, Vec<f32>) {
        let u = crowded_columns(49);
        (
            Pile::new(Side::Right, WIDTH as f64, right, &u),
            Pile::new(Side::Left, WIDTH as f64, left, &u),
            u,
        )
    }

    /// A straight row of a leaf turned by `angle`.
    fn straight(u: &[f32], angle: f32) -> Vec<f32> {
        let (sin, cos) = libm::sincosf(angle);
        u.iter()
            .flat_map(|u| [u * WIDTH * cos, 0.0, u * WIDTH * sin])
            .collect()
    }

    #[test]
    fn a_leaf_at_rest_lies_on_its_pile() {
        let (right, left, u) = piles(0.012, 0.005);
        for (angle, pile) in [(0.0, &right), (core::f32::consts::PI, &left)] {
            let mut row = straight(&u, angle);
            bend_into_gutter(&mut row, &right, &left, (0.0, CreasedOnly::NONE));
            for (p, q) in row.chunks_exact(3).zip(pile.curves().chunks_exact(2)) {
                let distance = (p[0] - q[0]).hypot(p[2] - q[1]);
                assert!(distance < 2e-4, "{distance} m at angle {angle}");
            }
        }
    }

    #[test]
    fn rows_keep_their_length_and_stay_out_of_the_piles() {
        let (right, left, u) = piles(0.008, 0.014);
        for i in 1..36 {
            let mut row = straight(&u, i as f32 * core::f32::consts::PI / 36.0);
            bend_into_gutter(&mut row, &right, &left, (0.0, CreasedOnly::NONE));
            let length: f32 = row
                .windows(6)
                .step_by(3)
                .map(|w| (w[3] - w[0]).hypot(w[5] - w[2]))
                .sum();
            if (4..32).contains(&i) {
                assert!((length / WIDTH - 1.0).abs() < 2e-3, "{length} at {i}");
            }
            for p in row.chunks_exact(3) {
                let pile = if p[0] >= 0.0 { &right } else { &left };
                assert!(p[2] >= pile.height(p[0].abs()) - 1e-6);
            }
        }
    }

    /// Of a cell that is cut along its other diagonal that lies over the hump, between two points
    /// that lie on the pile.
    #[test]
    fn the_diagonal_along_which_a_cell_is_cut_is_pushed_off() {
        let (right, left, u) = piles(0.012, 0.005);
        let columns = u.len();
        let (before, after) = (columns / 4, columns / 2);
        let mut points: Vec<[f32; 3]> = (0..2 * columns)
            .map(|node| [u[node % columns] * WIDTH, 0.0, 0.1])
            .collect();
        let on_pile = |column: usize| {
            let [x, height] = right.place(column);
            [x, 0.0, height + ROUNDING]
        };
        // The lower corners of a cell's other diagonal.
        points[after + 1] = on_pile(after);
        points[columns + after] = on_pile(before);
        let mut positions = points.concat();
        let mut falling = vec![false; 2 * columns];
        falling[after] = true;
        let folds = Folds::of(&[], &falling);
        let piles = [&right, &left];
        assert!(is_clear(&positions, Folds::default(), piles));
        assert!(!is_clear(&positions, folds, piles));
        let unmoved = positions.clone();
        push_edges_off(&mut positions, Folds::default(), piles, Over::NOTHING);
        assert_eq!(positions, unmoved);
        push_edges_off(&mut positions, folds, piles, Over::NOTHING);
        assert!(is_clear(&positions, folds, piles));
    }

    #[test]
    fn the_root_turns_steadily_between_the_piles() {
        let (right, left, u) = piles(0.01, 0.01);
        let mut before = f32::MAX;
        for i in 0..=36 {
            let mut row = straight(&u, i as f32 * core::f32::consts::PI / 36.0);
            bend_row(&mut row, right.angles(), left.angles());
            assert!(row[3] <= before, "the root went back at step {i}");
            before = row[3];
        }
    }

    /// At the spine, where all that fly meet, nothing is lifted; far from it all of it is.
    #[test]
    fn what_is_kept_over_a_pile_is_less_so_toward_the_spine() {
        let (right, left, u) = piles(0.01, 0.01);
        let mut positions = straight(&u, 0.0);
        bend_into_gutter(&mut positions, &right, &left, (0.0, CreasedOnly::NONE));
        let lying = positions.clone();
        push_off(
            &mut positions,
            [&right, &left],
            Over::of([4.0 * OVER_PILE; 2], 1.0),
        );
        let angle = 4.0 * SLIVER / ROOM_FROM_SPINE;
        for (now, before) in { positions.chunks_exact(3) }.zip(lying.chunks_exact(3)) {
            let (x, lifted) = (before[0], now[2] - before[2]);
            let most = (angle * x).min(4.0 * OVER_PILE);
            assert!((lifted - most).abs() < 1e-6, "{lifted} m at {x} m");
        }
    }
}
