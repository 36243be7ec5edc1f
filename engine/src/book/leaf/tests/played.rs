//! Turns by command: their time, their paper, and several at once.

use super::*;

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
