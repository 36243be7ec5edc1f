//! Tears whose path turns with the pull of the grabs.

use super::across_tests::{PATHS, SIZE, areas, drawn_at, holds};
use super::fracture::work_of;
use super::tests::{deepest, lying, settle};
use super::*;
use crate::stock::Stock;
use crate::vector::{dot, sub};
use core::f32::consts::PI;

/// A tear by two grabs that rise and go apart, in a direction that swings about the upright.
struct SwungTear {
    pieces: [TornLeaf; 2],
    seconds: f32,
    /// The greatest edge strain on the way.
    worst: f32,
    /// The farthest that a drawn point was off the sheet when the path turned, metres.
    jump: f32,
    turns: u32,
    /// The tear's line on the page at last, metres, from where it began.
    line: Vec<[f64; 2]>,
    /// Length of its path, metres; 0 where that is fixed.
    length: f64,
}

/// Tears a sheet across along a path that turns: `swing` says by how much the direction in which the
/// grabs go apart has swung after so many seconds, radians, from u toward v of the page.
fn tear_swung(
    mut leaf: TornLeaf,
    book: &Book,
    path: [[f64; 2]; 2],
    turns: bool,
    swing: impl Fn(f32) -> f32,
) -> SwungTear {
    assert!(leaf.tear_across(&path, turns));
    leaf.update(book);
    let holds = holds(path);
    let starts = holds.map(|at| drawn_at(&leaf, at));
    for (grab, at) in holds.iter().enumerate() {
        leaf.grab(grab, at[0], at[1]);
    }
    let middle: [f32; 3] = core::array::from_fn(|axis| starts[0][axis].midpoint(starts[1][axis]));
    let [x, y, z] = sub(starts[1], starts[0]).map(|way| 0.5 * way);
    let long = (x * x + y * y + z * z).sqrt();
    let (mut worst, mut jump, mut count) = (0.0f32, 0.0f32, 0);
    for tick in 1..400 {
        let seconds = tick as f32 * TICK;
        let raised = 0.06 * (seconds / 0.4).min(1.0);
        let away = 0.15 * (seconds - 0.3).max(0.0);
        let (sin, cos) = libm::sincosf(swing(seconds));
        let half = [x * cos - y * sin, x * sin + y * cos, z];
        for grab in 0..2 {
            let sign = if grab == 0 { -1.0 } else { 1.0 };
            let far = sign * (1.0 + away / long);
            let mut to: [f32; 3] = core::array::from_fn(|axis| middle[axis] + far * half[axis]);
            to[2] += raised + 0.5 * sign * away.min(0.08);
            leaf.pull(grab, to);
        }
        let version = leaf.surface().topology;
        leaf.update(book);
        leaf.step(book, 1);
        if leaf.surface().topology != version {
            count += 1;
            let most = leaf.drawn_offset.by.as_chunks::<3>().0;
            jump = most
                .iter()
                .fold(jump, |most, d| most.max(dot(*d, *d).sqrt()));
        }
        worst = worst.max(leaf.sheet().max_edge_strain());
        assert!(leaf.sheet().positions().iter().all(|x| x.is_finite()));
        let line = line_of(&leaf, path[0]);
        let grid = leaf.across.grid();
        let length = grid.map_or(0.0, |grid| grid.torn_stations()[grid.columns - 1]);
        if let Some(other) = leaf.part() {
            return SwungTear {
                pieces: [leaf, other],
                seconds,
                worst,
                jump,
                turns: count,
                line,
                length,
            };
        }
    }
    panic!("{path:?} holds at {} nodes", leaf.ties());
}

/// The nodes of a tear's line on the page, metres, from where it begins.
fn line_of(leaf: &TornLeaf, from: [f64; 2]) -> Vec<[f64; 2]> {
    let places = leaf.sheet().torn_places();
    let columns = leaf.sheet().settings().columns;
    let same = (1..places.len() / columns)
        .find(|row| places[row * columns] == places[(row - 1) * columns])
        .expect("it is torn in two");
    let row = &places[same * columns..(same + 1) * columns];
    let mut line: Vec<[f64; 2]> = row
        .iter()
        .map(|at| [at[0] * SIZE[0], at[1] * SIZE[1]])
        .collect();
    let away = |at: [f64; 2]| libm::hypot(at[0] - from[0] * SIZE[0], at[1] - from[1] * SIZE[1]);
    if away(line[0]) > away(line[line.len() - 1]) {
        line.reverse();
    }
    line
}

/// Area of a piece on the page, by its nodes, m^2.
fn area(piece: &TornLeaf) -> f64 {
    let places = piece.sheet().torn_places();
    let columns = piece.sheet().settings().columns;
    let at = |node: usize| [places[node][0] * SIZE[0], places[node][1] * SIZE[1]];
    let rows = places.len() / columns;
    let mut sum = 0.0;
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let foot = row * columns + column;
            let [a, b, c, d] = [foot, foot + 1, foot + columns + 1, foot + columns].map(at);
            let across = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
                (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
            };
            sum += 0.5 * (across(a, b, c) + across(a, c, d));
        }
    }
    sum.abs()
}

/// Degrees as radians.
fn degrees(angle: f32) -> f32 {
    angle * PI / 180.0
}

#[test]
fn a_pull_that_does_not_swing_tears_the_same_bits_as_along_a_fixed_path() {
    let (book, leaf) = lying(Stock::BOOK, 0.42);
    for path in [PATHS[0], PATHS[1], PATHS[4]] {
        let [fixed, turning] = [false, true].map(|turns| {
            let torn = tear_swung(leaf.clone(), &book, path, turns, |_| 0.0);
            assert_eq!(torn.turns, 0);
            let mut hash = crate::hash::BitHash::new();
            for piece in &torn.pieces {
                hash.floats(piece.sheet().positions());
            }
            (hash.value(), torn.line)
        });
        assert_eq!(fixed, turning, "{path:?}");
    }
}

#[test]
fn a_swing_before_the_tear_opens_bends_it_by_an_arc() {
    let (book, leaf) = lying(Stock::BOOK, 0.42);
    let cell = 0.5 * (SIZE[0] / 9.0 + SIZE[1] / 13.0);
    let radius = 2.0 * cell;
    for angle in [40.0, -40.0f32] {
        let swing = |seconds: f32| if seconds > 0.05 { degrees(angle) } else { 0.0 };
        let torn = tear_swung(leaf.clone(), &book, PATHS[0], true, swing);
        assert!(torn.turns > 0);
        // From the edge on an arc, then straight on to where it comes to an edge.
        let (side, angle) = (f64::from(angle.signum()), f64::from(degrees(angle.abs())));
        let from = torn.line[0];
        let corner = [radius * libm::sin(angle), radius * (1.0 - libm::cos(angle))];
        let exact = |x: f64| {
            let up = if x < corner[0] {
                radius - libm::sqrt(radius * radius - x * x)
            } else {
                corner[1] + (x - corner[0]) * libm::tan(angle)
            };
            from[1] + side * up
        };
        let off = torn
            .line
            .iter()
            .map(|at| (at[1] - exact(at[0])).abs() * libm::cos(angle));
        let off = off.fold(0.0, f64::max);
        eprintln!("{angle}: {:.2} mm off, {:?}", 1e3 * off, torn.line.last());
        // A hand strays by 2.5 mm.
        assert!(off < 0.0026, "{off} m for {angle}: {:?}", torn.line);
    }
}

#[test]
fn both_pieces_keep_their_paper_where_a_tear_turns() {
    let mut open = 0;
    for stock in [Stock::BIBLE, Stock::BOOK, Stock::CARD] {
        let (book, leaf) = lying(stock, 0.42);
        for (path, rate) in [
            (PATHS[0], 60.0f32),
            (PATHS[0], -150.0),
            (PATHS[1], 90.0),
            (PATHS[2], -60.0),
            (PATHS[2], 400.0),
            (PATHS[3], 40.0),
            (PATHS[4], -40.0),
        ] {
            let swing = |t: f32| degrees(rate * (t - 0.4).max(0.0)).clamp(-PI / 2.0, PI / 2.0);
            let torn = tear_swung(leaf.clone(), &book, path, true, swing);
            let mut pieces = torn.pieces;
            let work = f64::from(pieces[0].take_work());
            let wanted = work_of(stock.caliper, torn.length);
            let whole = SIZE[0] * SIZE[1];
            let parts = pieces.each_ref().map(|piece| area(piece) / whole);
            let mut worst = torn.worst;
            let mut drawn = Vec::new();
            for piece in &mut pieces {
                piece.release();
                worst = worst.max(settle(piece, &book));
                assert_eq!(deepest(piece, &book), 0.0, "{path:?}");
                let [paper, bent] = areas(piece);
                // One that fell folded over is cut short at its bend.
                let normals = piece.surface().normals.as_chunks::<3>().0;
                let up = normals.iter().filter(|normal| normal[2] > 0.0).count();
                if up == 0 || up == normals.len() {
                    drawn.push(bent / paper - 1.0);
                }
            }
            eprintln!(
                "{:.0} g/m2, {path:?}, {rate} degrees/s: {:.2} s, {} turns, drawn {:.1} mm off, strain {worst:.4}, \
                 work {:.6}, areas {:.4} and {:.4}, drawn {drawn:.5?}, from {:.3?} to {:.3?}, bent {:.1} mm",
                1e3 * stock.grammage,
                torn.seconds,
                torn.turns,
                1e3 * torn.jump,
                work / wanted,
                parts[0],
                parts[1],
                torn.line[0],
                torn.line[torn.line.len() - 1],
                1e3 * bend(&torn.line),
            );
            assert!(torn.turns > 0);
            assert!((work / wanted - 1.0).abs() < 1e-4, "{work} J for {wanted}");
            assert!((parts[0] + parts[1] - 1.0).abs() < 1e-3, "{parts:?}");
            assert!(worst < 0.01, "{path:?}, {rate}: {worst}");
            open += drawn.len();
            let keeps = |off: &f64| off.abs() < 1e-3;
            assert!(drawn.iter().all(keeps), "{drawn:?}");
        }
    }
    // Of 42 pieces.
    assert!(open > 21, "{open} pieces lie open");
}

/// How far a line ends on the left of the way in which it begins, metres.
fn bend(line: &[[f64; 2]]) -> f64 {
    let [a, b, c] = [line[0], line[1], line[line.len() - 1]];
    let way = [b[0] - a[0], b[1] - a[1]];
    (way[0] * (c[1] - a[1]) - way[1] * (c[0] - a[0])) / libm::hypot(way[0], way[1])
}

#[test]
fn the_same_swings_tear_the_same_bits() {
    let (book, leaf) = lying(Stock::BOOK, 0.42);
    let hash = || {
        let mut hash = crate::hash::BitHash::new();
        let swing = |seconds: f32| degrees(60.0 * (seconds - 0.4).max(0.0));
        let torn = tear_swung(leaf.clone(), &book, PATHS[2], true, swing);
        for piece in &torn.pieces {
            hash.floats(piece.sheet().positions());
        }
        hash.value()
    };
    assert_eq!(hash(), hash());
}
