//! The leaf in flight: played, held, caught, let go.

use super::super::{Board, Book};
use super::*;
use crate::random::for_seeds;
use crate::stock::Stock;

const WIDTH: f32 = 0.14;

/// A book that lies open at leaf 40 of 100.
fn book() -> Book {
    let mut book = Book::new(0.14, 0.21, 100, 0.012).unwrap();
    *book.board_mut(0) = Board::new(Side::Left);
    book.lay(40);
    book
}

fn leaf(book: &Book) -> &Leaf {
    book.flights.order()[0].leaf()
}

/// Steps until nothing flies; `each` sees the book after every tick. Returns
/// the ticks it took.
fn rest(book: &mut Book, mut each: impl FnMut(&Book)) -> u32 {
    for tick in 0..2000 {
        if book.flights() == 0 {
            return tick;
        }
        book.step(1);
        each(book);
    }
    panic!("the leaves never came to rest");
}

/// The greatest strain and the greatest depth of the leaves in flight.
fn worst(book: &Book) -> (f32, f32) {
    let leaves = book.flights.order().iter().map(|flight| flight.leaf());
    leaves.fold((0.0, 0.0), |(strain, depth), leaf| {
        (
            f32::max(strain, leaf.sheet().max_edge_strain()),
            f32::max(depth, leaf.in_book_space().depth),
        )
    })
}

/// Of whatever paper, a turn takes its time. After 3 s it lay after 2.13, after 6 s after 3.96: the
/// hand let go with a fifth of its way to go, and the leaf slapped.
#[test]
fn a_played_turn_lies_after_its_duration_and_does_not_slap() {
    for name in Stock::NAMES {
        for (from, seconds) in [
            (Side::Left, 0.25),
            (Side::Right, 0.4),
            (Side::Left, 0.8),
            (Side::Right, 1.5),
            (Side::Right, 3.0),
            (Side::Left, 10.0),
        ] {
            let mut book = book();
            book.set_paper(&Paper {
                stock: Stock::named(name).unwrap(),
                ..Paper::default()
            });
            let (low, read) = if from == Side::Right {
                (40, 41)
            } else {
                (39, 39)
            };
            let id = book.pick_up(from, low, low + 1).unwrap();
            book.play(id, from.opposite(), seconds);
            let (mut turned, mut fastest) = (leaf(&book).turned, 0.0f32);
            let ticks = rest(&mut book, |book| {
                let (strain, depth) = worst(book);
                assert!(strain < 0.004 && depth < 3e-3, "{strain} {depth} m");
                if book.flights() > 0 {
                    let now = leaf(book).turned;
                    fastest = fastest.max((now - turned).abs() / TICK);
                    turned = now;
                }
            });
            assert_eq!((book.read(), book.landed()), (read, [1, 0]));
            let took = ticks as f32 * TICK;
            let what = format!("{name}: {took} s for {seconds} from {from:?}");
            assert!((took / seconds - 1.0).abs() < 0.05, "{what}");
            // Paper that snaps over does so by itself.
            if seconds > 1.0 {
                assert!(fastest < 2.0, "{what}, {fastest} half turns a second");
            }
        }
    }
}

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

/// The greatest shear, radians, and stretch of diagonals of the leaves in flight.
fn sheared(book: &Book) -> (f32, f32) {
    let sheets = book
        .flights
        .order()
        .iter()
        .map(|flight| flight.leaf().sheet());
    sheets.fold((0.0, 0.0), |(shear, stretch), sheet| {
        (
            f32::max(shear, sheet.max_shear()),
            f32::max(stretch, sheet.max_diagonal_stretch()),
        )
    })
}

#[test]
fn a_played_turn_hardly_shears_its_paper() {
    for name in Stock::NAMES {
        for (from, seconds, leaves) in [
            (Side::Right, 0.8, 1),
            (Side::Left, 0.8, 1),
            (Side::Right, 0.5, 3),
            (Side::Right, 0.8, 6),
        ] {
            let mut book = book();
            book.set_paper(&Paper {
                stock: Stock::named(name).unwrap(),
                ..Paper::default()
            });
            let mut most = (0.0f32, 0.0f32);
            let mut see = |book: &Book| {
                let (shear, stretch) = sheared(book);
                most = (most.0.max(shear), most.1.max(stretch));
            };
            for leaf in 0..leaves {
                let low = if from == Side::Right { 40 + leaf } else { 39 };
                let id = book.pick_up(from, low, low + 1).unwrap();
                book.play(id, from.opposite(), seconds);
                for _ in 0..16 {
                    book.step(1);
                    see(&book);
                }
            }
            rest(&mut book, see);
            let (shear, stretch) = (most.0.to_degrees(), 100.0 * most.1);
            assert!(
                shear <= 1.0 && stretch <= 0.5,
                "{name}: {leaves} in {seconds} s from {from:?}: {shear} degrees, {stretch} %"
            );
        }
    }
}

/// Each went on in one longer step a tick, and softer, once a fourth was in the air.
#[test]
fn leaves_are_the_same_paper_and_do_not_jerk_as_others_join_them() {
    let mut book = book();
    let first = book.pick_up(Side::Right, 40, 41).unwrap();
    book.play(first, Side::Left, 2.0);
    let alone = leaf(&book).sheet().settings().clone();
    let mut before: Option<(Vec<f32>, Vec<f32>)> = None;
    let mut most = 0;
    for tick in 0..200 {
        let joins = [20, 40, 60, 80, 100].contains(&tick);
        if joins {
            let low = 40 + tick / 20;
            let id = book.pick_up(Side::Right, low, low + 1).unwrap();
            book.play(id, Side::Left, if tick == 100 { 0.8 } else { 2.0 });
        }
        book.step(1);
        most = most.max(book.flights());
        for flight in book.flights.order() {
            assert_eq!(flight.leaf().sheet().settings(), &alone, "tick {tick}");
        }
        let Some(flight) = book.flights.get(first) else {
            break;
        };
        let sheet = flight.leaf().sheet();
        if let Some((x, v)) = &before
            && joins
        {
            for k in 0..x.len() {
                let way = sheet.positions()[k] - x[k] - TICK * v[k];
                assert!(way.abs() < 1e-3, "tick {tick}: {way} m beside its way");
            }
        }
        before = Some((sheet.positions().to_vec(), sheet.velocities().to_vec()));
    }
    assert_eq!(most, 6);
}

/// A single step in a tick was more than single precision takes of paper so stiff: five boards in the
/// air stood still.
#[test]
fn boards_turn_however_many_are_in_the_air() {
    let mut book = book();
    book.set_paper(&Paper {
        stock: Stock::BOARD,
        ..Paper::default()
    });
    let turned: Vec<u32> = (40..46)
        .map(|low| {
            let id = book.pick_up(Side::Right, low, low + 1).unwrap();
            book.play(id, Side::Left, 1.0);
            book.step(20);
            id
        })
        .collect();
    let first = |book: &Book| {
        book.flights
            .get(turned[0])
            .map(|flight| flight.leaf().turned)
    };
    assert!(first(&book).is_none_or(|turned| turned > 0.9));
    let seconds = rest(&mut book, |_| {}) as f32 * TICK;
    assert!(seconds < 1.1, "{seconds} s");
    assert_eq!((book.read(), book.landed()), (46, [6, 0]));
}

#[test]
fn a_played_turn_never_jumps() {
    let mut book = book();
    let id = book.pick_up(Side::Right, 40, 41).unwrap();
    book.play(id, Side::Left, 0.8);
    book.update();
    let mut before = book.surface(0).unwrap().positions.clone();
    while book.flights() > 0 {
        book.step(1);
        book.update();
        let Some(surface) = book.surface(0) else {
            break;
        };
        for (a, b) in before.iter().zip(&surface.positions) {
            assert!((a - b).abs() < 4.0 * TICK, "{} m in a tick", (a - b).abs());
        }
        before.copy_from_slice(&surface.positions);
    }
}

#[test]
fn a_turn_can_be_reversed_on_its_way() {
    let mut book = book();
    let id = book.pick_up(Side::Right, 40, 41).unwrap();
    book.play(id, Side::Left, 0.8);
    book.step(40);
    assert_eq!(book.phase(id), Some(Phase::Playing(Side::Left)));
    book.play(id, Side::Right, 0.8);
    rest(&mut book, |_| {});
    assert_eq!(book.read(), 40);
}

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
fn leaves_of_a_riffle_do_not_pass_through_each_other() {
    let mut book = book();
    for k in 0..12 {
        let id = book.pick_up(Side::Right, 40 + k, 41 + k).unwrap();
        book.play(id, Side::Left, 0.5);
        for _ in 0..5 {
            book.step(1);
            let (strain, depth) = worst(&book);
            assert!(strain < 0.004 && depth < 3e-3, "{strain} {depth} m");
        }
    }
    assert!(book.flights() >= 10);
    rest(&mut book, |book| {
        let (strain, depth) = worst(book);
        assert!(strain < 0.004 && depth < 3e-3, "{strain} {depth} m");
    });
    assert_eq!(book.read(), 52);
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

/// Sent back before it had come to rest, a leaf lay on its side until it was put down
/// through the spine: what helps a leaf over is weaker than its weight.
#[test]
fn a_leaf_that_is_sent_back_while_it_lands_is_turned_and_not_put_down() {
    for stock in Stock::NAMES {
        let mut book = book();
        book.set_paper(&Paper {
            stock: Stock::named(stock).unwrap(),
            ..Paper::default()
        });
        let id = book.pick_up(Side::Right, 40, 41).unwrap();
        book.play(id, Side::Left, 0.8);
        while book.phase(id) != Some(Phase::Falling(Side::Left)) || leaf(&book).turned < 0.98 {
            book.step(1);
        }
        book.play(id, Side::Right, 0.8);
        let mut ticks = 0;
        let mut highest = 0.0f32;
        while book.phase(id).is_some() && ticks < 400 {
            book.step(1);
            book.update();
            if let Some(surface) = book.surface(0) {
                let heights = surface.positions.chunks_exact(3).map(|p| p[2]);
                highest = heights.fold(highest, f32::max);
            }
            ticks += 1;
        }
        assert_eq!(book.landed(), [1, 0], "{stock}");
        assert_eq!(book.read(), 40, "{stock}");
        // It is lifted over the spine, and not drawn through it.
        assert!(highest > 0.09, "{stock}: {highest} m high");
        assert!(ticks < 240, "{stock}: {ticks} ticks");
    }
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

#[test]
#[cfg(feature = "creases")]
fn a_leaf_folded_upon_its_folds_that_stays_upright_is_put_down_on_its_side() {
    use crate::models::sheet::SheetCrease;
    for side in [Side::Right, Side::Left] {
        let drawn = crate::interpolate::uniform_samples(27);
        let size = [f64::from(WIDTH), 0.21];
        let mut leaf = Leaf::new(size, &crate::book::Paper::default(), 0.0, (&drawn, 27));
        let along = |u: f64, degrees: f64| {
            let through = [[u, 0.0], [u, 1.0]];
            SheetCrease::pressed(through, degrees.to_radians(), &Stock::BOOK, size[0])
        };
        assert!(leaf.crease(&[along(0.7, 175.0), along(0.4, 160.0)]));
        leaf.sheet.lay_folded(side);
        leaf.lie(side);
        let laid = leaf.measure_fraction();
        let sign = side.sign();
        let nodes = leaf.sheet.positions().as_chunks::<3>().0;
        let upright: Vec<f32> = nodes
            .iter()
            .flat_map(|[x, y, z]| [-sign * z, *y, sign * x])
            .collect();
        leaf.sheet.put_back(&upright);
        leaf.clamp = core::f32::consts::FRAC_PI_2;
        leaf.turned = leaf.measure_fraction();
        leaf.wake();
        leaf.fallen = 1000;
        let mut strain = 0.0f32;
        for _ in 0..60 {
            leaf.step(true, false, false);
            strain = strain.max(leaf.sheet.max_edge_strain());
        }
        assert_eq!(leaf.phase(), Phase::Resting(side));
        // As it lay folded, which is not flat.
        let off = (leaf.fraction_turned() - laid).abs();
        assert!(off < 0.01, "{off} of the half turn off");
        assert!(strain < 0.01, "{strain}");
    }
}

/// How far a creased leaf that lies uppermost is drawn through itself at most, metres.
#[cfg(feature = "creases")]
fn drawn_through_itself(
    book: &Book,
    index: usize,
    creases: &[crate::models::sheet::SheetCrease],
) -> f32 {
    let (surface, mesh) = (
        book.surface(index).unwrap(),
        book.paper_mesh(index).unwrap(),
    );
    crate::book::parts_depth::depth_of_parts(surface, mesh, creases)
}

/// Half of its flap lies under its page and half over it, as no paper can: put down so it is
/// pressed flat, and opens to where its crease rests. In one that lies as it is folded nothing is
/// opened.
#[test]
#[cfg(feature = "creases")]
fn a_folded_leaf_that_comes_to_lie_through_itself_is_opened_anew() {
    use crate::contact::mesh::find_beyond;
    use crate::models::sheet::SheetCrease;
    let through = [[0.6, 0.0], [0.6, 1.0]];
    let crease = SheetCrease::pressed(through, 160f64.to_radians(), &Stock::BOOK, f64::from(WIDTH));
    for tilt in [0.0, 0.2] {
        let mut book = book();
        assert!(book.crease(40, &[crease]));
        while !book.is_asleep() {
            book.step(1);
        }
        let id = book.pick_up(Side::Right, 40, 41).unwrap();
        let leaf = book.flights.get_mut(id).unwrap().leaf_mut();
        let nodes = leaf.sheet.positions().as_chunks::<3>().0.iter();
        let beyond = find_beyond(leaf.sheet.node_triangles().into_iter(), nodes.len());
        let tilted: Vec<f32> = nodes
            .zip(&beyond)
            .flat_map(|([x, y, z], is_beyond)| {
                let up = if *is_beyond { tilt * (y - 0.105) } else { 0.02 };
                [*x, *y, z + up]
            })
            .collect();
        leaf.sheet.put_back(&tilted);
        leaf.wake();
        leaf.fallen = 1000;
        let (mut is_opened, mut strain) = (false, 0.0f32);
        let mut before: Option<Vec<[f32; 3]>> = None;
        let mut fastest = 0.0f32;
        for _ in 0..400 {
            book.step(1);
            let leaf = book.flights.order()[0].leaf();
            is_opened |= !leaf.opening.is_none();
            strain = strain.max(leaf.sheet.max_edge_strain());
            let now = leaf.sheet.positions().as_chunks::<3>().0.to_vec();
            for (p, q) in before.iter().flatten().zip(&now) {
                fastest = fastest.max(
                    (0..3)
                        .map(|axis| (p[axis] - q[axis]).abs())
                        .fold(0.0, f32::max),
                );
            }
            before = Some(now);
        }
        book.update();
        assert!(book.is_asleep(), "{tilt}");
        assert_eq!(is_opened, tilt > 0.0);
        assert!(strain < 1e-3, "{strain}, {tilt}");
        // At most 42 mm are eased in 18 ticks, half as fast again midway: nothing leaps.
        assert!(fastest < 4e-3, "{fastest} m in a tick, {tilt}");
        assert!(drawn_through_itself(&book, 0, &[crease]) < 1e-4, "{tilt}");
    }
}

/// The parts of a thing move in time by the root of its size, and fingers are as strong as what they
/// turn is large: a leaf of 20 mm stayed where it was let go, one of 1.5 m was put down through the
/// air after 2.5 s and no hand could lift it.
#[test]
fn leaves_of_all_sizes_are_turned_and_fall() {
    for (width, stock, help, alone) in [
        (0.02, Stock::BOOK, 0.15..0.25, 0.1..0.6),
        (0.075, Stock::BOOK, 0.3..0.45, 0.3..0.9),
        (0.21, Stock::BOOK, 0.5..0.7, 0.5..1.6),
        (0.42, Stock::COATED, 0.7..1.0, 0.7..3.0),
        (1.5, Stock::BOARD, 1.3..1.8, 1.5..8.5),
    ] {
        let size = [width, 1.5 * width];
        let open = |assist: bool| {
            let mut book = Book::new(size[0], size[1], 20, 0.0018).unwrap();
            book.set_paper(&Paper {
                stock,
                assist,
                ..Paper::default()
            });
            *book.board_mut(0) = Board::new(Side::Left);
            book.lay(10);
            book
        };
        for (is_helped, expected) in [(true, help), (false, alone)] {
            let mut book = open(is_helped);
            let id = book.pick_up(Side::Right, 10, 11).unwrap();
            book.grab(id, 0, 1.0, 0.5);
            let radius = 0.96 * width as f32;
            for tick in 0..480 {
                let (sin, cos) = (1.95 * (tick as f32 / 360.0).min(1.0)).sin_cos();
                book.hold(id, 0, [radius * cos, 0.75 * width as f32, radius * sin]);
                book.step(1);
            }
            let turned = leaf(&book).turned;
            assert!((0.5..0.75).contains(&turned), "{width} m: {turned}");
            book.release(id, 0);
            let took = rest(&mut book, |_| {}) as f32 * TICK;
            assert!(expected.contains(&took), "{width} m, {is_helped}: {took} s");
            assert_eq!(book.landed(), [1, 0], "{width} m, {is_helped}");
            // Left alone, limp paper falls to the side that most of it is over.
            assert!(!is_helped || book.read() == 11, "{width} m");
        }
        let mut book = open(true);
        let id = book.pick_up(Side::Right, 10, 11).unwrap();
        book.play(id, Side::Left, 2.0);
        let took = rest(&mut book, |_| {}) as f32 * TICK;
        assert!((took / 2.0 - 1.0).abs() < 0.05, "{width} m: {took} s for 2");
    }
}

/// What book space is drawn at another scale moves as the book itself of that size.
#[test]
fn a_scaled_book_moves_as_the_large_one() {
    for (scale, stock) in [
        (0.25, Stock::BOOK),
        (0.6, Stock::CARD),
        (2.0, Stock::COATED),
    ] {
        let turn = |size: f64, scale: f64| {
            let mut book = Book::new(0.14 * size, 0.21 * size, 20, 0.0018 * size).unwrap();
            book.set_paper(&Paper {
                stock,
                scale,
                ..Paper::default()
            });
            *book.board_mut(0) = Board::new(Side::Left);
            book.lay(10);
            let id = book.pick_up(Side::Right, 10, 11).unwrap();
            book.grab(id, 0, 1.0, 0.5);
            let mut turned = vec![];
            for tick in 0..300 {
                let (sin, cos) = (1.8 * (tick as f32 / 180.0).min(1.0)).sin_cos();
                let radius = 0.135 * size as f32;
                book.hold(id, 0, [radius * cos, 0.105 * size as f32, radius * sin]);
                book.step(1);
                turned.push(leaf(&book).turned);
            }
            book.release(id, 0);
            let seconds = rest(&mut book, |book| {
                if book.flights() > 0 {
                    turned.push(leaf(book).turned);
                }
            }) as f32
                * TICK;
            (turned, seconds)
        };
        let ((small, in_small), (large, in_large)) = (turn(1.0, scale), turn(scale, 1.0));
        let ways = small.iter().zip(&large).map(|(a, b)| (a - b).abs());
        let most = ways.fold(0.0, f32::max);
        let what = format!("scale {scale}: {most}, {in_small} and {in_large} s");
        assert!(most < 0.06 && (in_small - in_large).abs() < 0.06, "{what}");
    }
}
