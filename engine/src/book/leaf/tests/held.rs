//! Leaves that grabs hold: caught, carried, pressed, pulled at, held still.

use super::*;

#[test]
fn a_hand_catches_a_leaf_in_mid_turn_and_it_goes_on_from_there() {
    let mut book = book();
    let id = book.pick_up(Side::Right, 40, 41).unwrap();
    book.play(id, Side::Left, 0.8);
    book.step(40);
    let before = leaf(&book).in_book_space().points[NODES[0] - 1];
    book.grab(id, 0, 1.0, 0.0);
    assert_eq!(book.phase(id), Some(Phase::Held));
    book.step(1);
    let now = leaf(&book).in_book_space().points[NODES[0] - 1];
    let moved = [0, 1, 2].map(|axis| (now[axis] - before[axis]).abs());
    assert!(moved.iter().all(|d| *d < 3.0 * TICK), "{moved:?}");
}

#[test]
fn a_held_place_goes_where_the_hand_is() {
    for (u, v, grab) in [
        (1.0, 0.0, [0.05, 0.03, 0.08]),
        (1.0, 0.5, [-0.06, 0.1, 0.07]),
        (0.6, 0.3, [0.02, 0.06, 0.06]),
    ] {
        let mut book = book();
        let id = book.pick_up(Side::Right, 40, 41).unwrap();
        book.grab(id, 0, u, v);
        book.hold(id, 0, grab);
        book.step(240);
        let nodes = &leaf(&book).in_book_space().points;
        let column = (u * (NODES[0] - 1) as f32 + 0.5) as usize;
        let row = (v * (NODES[1] - 1) as f32 + 0.5) as usize;
        let at = nodes[row * NODES[0] + column];
        let away = [0, 1, 2].map(|axis| at[axis] - grab[axis]);
        let away = away.iter().map(|d| d * d).sum::<f32>().sqrt();
        assert!(away < 0.012, "{away} m from the grab at {u}, {v}");
    }
}

#[test]
fn two_hands_hold_one_leaf() {
    let mut book = book();
    let id = book.pick_up(Side::Right, 40, 41).unwrap();
    book.grab(id, 0, 1.0, 0.0);
    book.grab(id, 1, 1.0, 1.0);
    book.hold(id, 0, [0.02, 0.02, 0.11]);
    book.hold(id, 1, [0.11, 0.19, 0.05]);
    book.step(240);
    let nodes = &leaf(&book).in_book_space().points;
    let (foot, head) = (nodes[NODES[0] - 1], nodes[NODES[0] * NODES[1] - 1]);
    assert!(foot[0] < 0.05 && head[0] > 0.09, "{foot:?} {head:?}");
    book.release(id, 0);
    assert_eq!(book.phase(id), Some(Phase::Held));
    book.release(id, 1);
    assert_eq!(book.phase(id), Some(Phase::Falling(Side::Right)));
}

#[test]
fn no_hand_presses_a_leaf_into_its_pile() {
    for place in [[0.1, 0.1, -0.2], [-0.1, 0.1, -0.1], [0.02, 0.05, 0.0]] {
        let mut book = book();
        let id = book.pick_up(Side::Right, 40, 41).unwrap();
        book.grab(id, 0, 1.0, 0.5);
        for _ in 0..120 {
            book.hold(id, 0, place);
            book.step(1);
            let (strain, depth) = worst(&book);
            assert!(strain < 0.01 && depth < 3e-3, "{strain} {depth} m");
        }
    }
}

#[test]
fn a_leaf_pulled_up_under_another_makes_it_go_over_to_the_other_side() {
    let mut book = book();
    let upper = book.pick_up(Side::Left, 39, 40).unwrap();
    let lower = book.pick_up(Side::Left, 38, 39).unwrap();
    book.grab(lower, 0, 1.0, 0.5);
    for _ in 0..180 {
        book.hold(lower, 0, [-0.06, 0.1, 0.1]);
        book.step(1);
        let (strain, _) = worst(&book);
        assert!(strain < 0.01, "{strain}");
    }
    assert_eq!(book.phase(upper), None);
    assert_eq!(book.phase(lower), Some(Phase::Held));
}

#[test]
fn a_leaf_caught_as_it_settles_is_no_longer_down() {
    let mut book = book();
    let id = book.pick_up(Side::Right, 40, 41).unwrap();
    book.play(id, Side::Left, 0.5);
    while !leaf(&book).is_down() || book.phase(id) == Some(Phase::Resting(Side::Right)) {
        book.step(1);
    }
    book.grab(id, 0, 1.0, 0.5);
    assert!(!leaf(&book).is_down());
}

#[test]
fn no_hand_tears_a_leaf() {
    for_seeds(|random| {
        let mut book = book();
        let id = book.pick_up(Side::Right, 40, 41).unwrap();
        book.grab(id, 0, random.between(0.2, 1.0), random.between(0.0, 1.0));
        let mut most = 0.0f32;
        for _ in 0..12 {
            let far = 3.0 * WIDTH;
            let mut at = || random.between(-far, far);
            let place = [at(), at(), at()];
            book.hold(id, 0, place);
            for _ in 0..6 {
                book.step(1);
                most = most.max(worst(&book).0);
            }
        }
        book.update();
        assert!(
            book.surface(0)
                .unwrap()
                .positions
                .iter()
                .all(|x| x.is_finite())
        );
        assert!(most < 0.05, "strain {most}");
        book.release(id, 0);
        book.step(60);
        assert!(
            worst(&book).0 < 1e-3,
            "{} after half a second",
            worst(&book).0
        );
    });
}

/// A held leaf sleeps once it lies still, and wakes when a grab moves.
#[test]
fn a_leaf_held_still_sleeps_until_a_hand_moves() {
    for stock in Stock::NAMES {
        for place in [[0.1, 0.0, 0.06], [-0.08, 0.05, 0.1]] {
            let mut book = book();
            book.set_paper(&Paper {
                stock: Stock::named(stock).unwrap(),
                ..Paper::default()
            });
            assert!(book.is_asleep());
            let id = book.pick_up(Side::Right, 40, 41).unwrap();
            book.grab(id, 0, 1.0, 0.1);
            book.hold(id, 0, place);
            let mut ticks = 0;
            while !book.is_asleep() {
                book.step(1);
                ticks += 1;
                assert!(ticks < 600, "{stock} never sleeps");
            }
            // The same place again is no motion; another is, as a command is.
            let asleep = book.surface(0).unwrap().positions.clone();
            book.hold(id, 0, place);
            assert!(book.is_asleep());
            book.step(60);
            book.update();
            let apart = asleep.iter().zip(&book.surface(0).unwrap().positions);
            assert!(apart.count() > 0);
            book.hold(id, 0, place.map(|x| x + 0.01));
            assert!(!book.is_asleep());
            book.release(id, 0);
            assert!(!book.is_asleep());
            rest(&mut book, |_| {});
            assert!(book.is_asleep());
        }
    }
}
