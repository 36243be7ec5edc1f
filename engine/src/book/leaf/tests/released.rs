//! Leaves that are let go: to which side they fall, and how fast.

use super::*;

/// Seconds from letting go of a leaf that was carried to an angle until it lies, and the fraction
/// of the half turn at which it was let go.
fn released(paper: &Paper, angle: f32) -> [f32; 2] {
    let mut book = book();
    book.set_paper(paper);
    let id = book.pick_up(Side::Right, 40, 41).unwrap();
    book.grab(id, 0, 1.0, 0.5);
    for tick in 0..240 {
        let (sin, cos) = (angle * (tick as f32 / 200.0).min(1.0)).sin_cos();
        book.hold(id, 0, [0.135 * cos, 0.105, 0.006 + 0.135 * sin]);
        book.step(1);
    }
    let turned = leaf(&book).turned;
    book.release(id, 0);
    [rest(&mut book, |_| {}) as f32 * TICK, turned]
}

/// It lay after 0.17 to 0.2 s, sooner than in a vacuum.
#[test]
fn a_released_leaf_is_led_down_as_by_a_hand() {
    for degrees in [95.0f32, 105.0, 115.0, 125.0] {
        let help = Paper::default();
        let none = Paper {
            assist: false,
            ..help
        };
        let [helped, turned] = released(&help, degrees.to_radians());
        let [left, _] = released(&none, degrees.to_radians());
        let what = format!("{helped} s from {turned} of the half turn, without help {left}");
        assert!((0.40..0.55).contains(&helped), "{what}");
        assert!(helped < left, "{what}");
    }
}

#[test]
fn a_leaf_thrown_over_the_middle_goes_on_and_one_let_go_falls_back() {
    for (to, read) in [([-0.07, 0.1, 0.09], 41), ([0.1, 0.1, 0.05], 40)] {
        let mut book = book();
        let id = book.pick_up(Side::Right, 40, 41).unwrap();
        book.grab(id, 0, 1.0, 0.5);
        for k in 1..=30 {
            let t = k as f32 / 30.0;
            book.hold(id, 0, [0.14 + (to[0] - 0.14) * t, to[1], to[2] * t]);
            book.step(1);
        }
        book.release(id, 0);
        rest(&mut book, |_| {});
        assert_eq!(book.read(), read);
    }
}

#[test]
fn without_assist_gravity_decides() {
    let paper = Paper {
        assist: false,
        ..Paper::default()
    };
    for (x, read) in [(-0.05, 41), (0.05, 40)] {
        let mut book = book();
        book.set_paper(&paper);
        let id = book.pick_up(Side::Right, 40, 41).unwrap();
        book.grab(id, 0, 1.0, 0.5);
        book.hold(id, 0, [x, 0.1, 0.12]);
        book.step(240);
        book.release(id, 0);
        rest(&mut book, |_| {});
        assert_eq!(book.read(), read);
    }
}

#[test]
fn a_stiffer_stock_bows_less_and_wind_carries_a_leaf_over() {
    let lean = |stock: Stock| {
        let mut book = book();
        assert!(book.set_paper(&Paper {
            stock,
            ..Paper::default()
        }));
        let id = book.pick_up(Side::Right, 40, 41).unwrap();
        book.grab(id, 0, 1.0, 0.5);
        book.hold(id, 0, [0.06, 0.1, 0.08]);
        book.step(360);
        // Height of the middle of the leaf over the chord from spine to grab.
        let nodes = &leaf(&book).in_book_space().points;
        nodes[7 * NODES[0] + 5][2]
    };
    assert!(lean(Stock::CARD) > lean(Stock::BIBLE) + 0.005);

    let mut book = book();
    let paper = Paper {
        wind: [-3.0, 0.0, 0.0],
        assist: false,
        ..Paper::default()
    };
    assert!(book.set_paper(&paper));
    let id = book.pick_up(Side::Right, 40, 41).unwrap();
    book.grab(id, 0, 1.0, 0.5);
    book.hold(id, 0, [0.06, 0.1, 0.12]);
    book.step(120);
    book.release(id, 0);
    rest(&mut book, |_| {});
    assert_eq!(book.read(), 41);
    assert!(!book.set_paper(&Paper {
        wind: [f64::NAN, 0.0, 0.0],
        ..paper
    }));
}

/// Without help each leaf falls where its swing takes it. Two that have passed each other swing
/// to each other's sides, and neither is ever over what it would lie upon.
#[test]
fn leaves_that_have_passed_each_other_are_put_down_in_their_order() {
    let mut book = book();
    book.set_paper(&Paper {
        assist: false,
        ..Paper::default()
    });
    for (low, turned) in [(40, 0.3), (41, 0.6)] {
        let id = book.pick_up(Side::Right, low, low + 1).unwrap();
        let leaf = book.flights.get_mut(id).unwrap().leaf_mut();
        leaf.clamp = core::f32::consts::PI * turned;
        let (sin, cos) = leaf.clamp.sin_cos();
        let flat = leaf.flat.as_chunks::<3>().0.iter();
        let turned_over = flat.flat_map(|[x, y, _]| [x * cos, *y, x * sin]);
        let at: Vec<f32> = turned_over.collect();
        leaf.sheet.put_back(&at);
        leaf.turned = turned;
        leaf.fall(leaf.side_ahead(), None);
    }
    let ticks = rest(&mut book, |_| {});
    assert!(ticks as f32 * TICK < 4.0, "{ticks} ticks");
    assert_eq!(book.read(), 40);
    assert_eq!(book.landed()[0], 2);
}
