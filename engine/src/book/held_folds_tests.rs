//! Folded leaves of a book that are folded anew in flight and pulled at by several grabs.

use super::*;
use crate::contact::tolerance::DEEP;
use crate::random::Random;
use crate::triangle::area_normal;
use crate::vector::{cross, dot, sub};

fn along(u: f64, degrees: f64) -> SheetCrease {
    let through = [[u, 0.0], [u, 1.0]];
    SheetCrease::pressed(through, degrees.to_radians(), &Stock::BOOK, 0.14)
}

/// A book open at leaf 5, which is folded in two and picked up, and the number of its flight.
fn picked_up(degrees: f64) -> (Book, u32) {
    let mut book = Book::new(0.14, 0.21, 40, 0.004).unwrap();
    *book.board_mut(0) = Board::new(Side::Left);
    book.lay(5);
    assert!(book.crease(5, &[along(0.55, degrees)]));
    let flight = book.pick_up(Side::Right, 5, 6).unwrap();
    (book, flight)
}

/// The height of the deepest edge that goes through a triangle of the leaf's paper which it does
/// not meet at a corner: how far its nearer end is from the triangle's plane, metres.
fn through_itself(book: &Book) -> f32 {
    let sheet = book.flights.order()[0].leaf().sheet();
    let points = sheet.positions().as_chunks::<3>().0;
    let triangles = sheet.node_triangles();
    let mut deepest = 0.0f32;
    for (corners, _) in &triangles {
        let [a, b, c] = corners.map(|corner| points[corner]);
        let normal = area_normal([a, b, c]);
        let size = dot(normal, normal).sqrt();
        for (others, _) in &triangles {
            for [from, to] in [[0, 1], [1, 2], [2, 0]].map(|edge| edge.map(|end| others[end])) {
                if corners.contains(&from) || corners.contains(&to) {
                    continue;
                }
                let [p, q] = [from, to].map(|end| points[end]);
                let [h, g] = [p, q].map(|end| dot(normal, sub(end, a)) / size);
                if h * g >= 0.0 || h.abs().min(g.abs()) <= deepest {
                    continue;
                }
                let way = h / (h - g);
                let place: [f32; 3] = core::array::from_fn(|i| p[i] + way * (q[i] - p[i]));
                let inside = |from, to| dot(normal, cross(sub(to, from), sub(place, from))) > 0.0;
                if inside(a, b) && inside(b, c) && inside(c, a) {
                    deepest = h.abs().min(g.abs());
                }
            }
        }
    }
    deepest
}

/// Folded elsewhere in flight, or unfolded, a leaf's edges keep their lengths: where they reach
/// over the fold that it had, they were its chords, and up to nine tenths too short.
#[test]
fn a_leaf_folded_anew_in_flight_keeps_its_lengths() {
    let lines = [vec![], vec![along(0.7, 170.0)], vec![along(0.4, -120.0)]];
    for anew in lines {
        let (mut book, flight) = picked_up(165.0);
        book.play(flight, Side::Left, 0.8);
        book.step(30);
        assert!(book.crease(5, &anew));
        for tick in 0..120 {
            let strain = book.strain(0).unwrap_or(0.0);
            assert!(strain < 0.01, "{} lines, tick {tick}: {strain}", anew.len());
            book.step(1);
        }
    }
}

/// Two grabs, on the page and on its flap, pull at random: the paper goes through itself no deeper
/// than contact brings out of it again. Before such ticks were taken back it was 9.7 to 10.9 mm deep.
#[test]
fn grabs_do_not_draw_a_flap_through_its_page() {
    for (seed, degrees) in [(8, -160.0), (9, 160.0), (10, -160.0)] {
        let (mut book, flight) = picked_up(degrees);
        let mut random = Random::new(seed);
        let mut place = |low: [f32; 3], high: [f32; 3]| {
            core::array::from_fn(|axis| random.between(low[axis], high[axis]))
        };
        for (grab, least, most) in [(0, 0.3, 0.55), (1, 0.7, 1.0)] {
            let [u, v, _] = place([least, 0.0, 0.0], [most, 1.0, 0.0]);
            book.grab(flight, grab, u, v);
        }
        for tick in 0..200 {
            if tick % 40 == 0 {
                for grab in 0..2 {
                    let to = place([-0.15, 0.0, 0.0], [0.15, 0.21, 0.15]);
                    book.hold(flight, grab, to);
                }
            }
            book.step(1);
            if tick % 3 == 0 {
                let deep = through_itself(&book);
                assert!(deep < DEEP + 1e-5, "{seed}, tick {tick}: {deep}");
            }
        }
    }
}
