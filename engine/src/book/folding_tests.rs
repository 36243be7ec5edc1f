//! Creased leaves in a book: how they lie, turn, are covered and come out again.

use super::*;

/// Across the corner of foot and fore-edge, 30 mm from it, folded over to the recto's side (or
/// the verso's) and resting 20 degrees open.
fn dog_ear(on_recto: bool) -> SheetCrease {
    let sign = if on_recto { 1.0 } else { -1.0 };
    let through = [[1.0 - 0.03 / 0.14, 0.0], [1.0, 0.03 / 0.21]];
    SheetCrease::pressed(through, sign * 160f64.to_radians(), &Stock::BOOK, 0.14)
}

/// A book open at leaf 5, which is dog-eared.
fn book(on_recto: bool) -> Book {
    let mut book = Book::new(0.14, 0.21, 40, 0.004).unwrap();
    *book.board_mut(0) = Board::new(Side::Left);
    book.lay(5);
    assert!(book.crease(5, &[dog_ear(on_recto)]));
    book
}

/// Turns the uppermost leaf of a side over, and checks in every frame what is drawn. Returns the
/// ticks that took.
fn turn(book: &mut Book, from: Side) -> u32 {
    let low = match from {
        Side::Right => book.read(),
        Side::Left => book.read() - 1,
    };
    let id = book.pick_up(from, low, low + 1).unwrap();
    book.play(id, from.opposite(), 0.8);
    for frame in 0..500 {
        if book.flights() == 0 && book.is_asleep() {
            return 2 * frame;
        }
        book.step(2);
        book.update();
        for index in 0..book.drawn_leaves() {
            assert!(book.strain(index).unwrap() < 0.01, "frame {frame}");
            let surface = book.surface(index).unwrap();
            assert!(surface.positions.iter().all(|x| x.is_finite()));
        }
    }
    panic!("leaf {low} never came to rest");
}

/// By how much the drawn flap of the only leaf is apart from the rest of it, at least, metres:
/// below 0 where they go through each other.
fn least_gap(book: &Book, on_recto: bool) -> f32 {
    let (surface, mesh) = (book.surface(0).unwrap(), book.paper_mesh(0).unwrap());
    let points = surface.positions.as_chunks::<3>().0;
    let beyond = |k: usize| mesh.places[k][0] * 0.14 - 0.11 - mesh.places[k][1] * 0.21;
    let all = 0..points.len();
    let (flap, rest): (Vec<_>, Vec<_>) = all
        .filter(|k| beyond(*k).abs() > 1e-5)
        .partition(|k| beyond(*k) > 0.0);
    assert!(flap.len() > 5);
    let up = if book.lies_creased(Side::Right) == on_recto {
        1.0
    } else {
        -1.0
    };
    let gaps = flap.iter().map(|k| {
        let away = |j: &usize| (points[*j][0] - points[*k][0]).hypot(points[*j][1] - points[*k][1]);
        let near = rest
            .iter()
            .min_by(|a, b| away(a).total_cmp(&away(b)))
            .unwrap();
        up * (points[*k][2] - points[*near][2])
    });
    gaps.fold(f32::INFINITY, f32::min)
}

#[test]
fn a_dog_ear_turned_over_and_back_ten_times_keeps_its_rest_and_lies_off_its_leaf() {
    for on_recto in [true, false] {
        let mut book = book(on_recto);
        assert_eq!([book.flights(), book.drawn_leaves()], [0, 1]);
        for k in 0..20 {
            assert!(least_gap(&book, on_recto) > 5e-5, "before turn {k}");
            let [from, to] = if k % 2 == 0 {
                [Side::Right, Side::Left]
            } else {
                [Side::Left, Side::Right]
            };
            turn(&mut book, from);
            assert!(book.lies_creased(to) && !book.lies_creased(from));
            assert_eq!([book.flights(), book.drawn_leaves()], [0, 1]);
            assert!(book.is_asleep());
            let rest = book.creases(5)[0].rest.to_degrees().abs();
            assert!((rest - 160.0).abs() < 1.0, "{rest} after turn {k}");
        }
        assert_eq!(book.landed(), [20, 0]);
    }
}

/// Held shut, 20 degrees off its rest and 8.65 below its yield, for seconds t, it creeps by
/// c ln(1 + t exp(-8.65 / c)), with c 6 degrees over ln 10.
#[test]
fn a_dog_ear_under_other_leaves_creeps_shut_with_the_logarithm_of_time() {
    for (seconds, degrees) in [(60.0f64, 3.01), (3600.0, 12.72), (1e5, 20.0)] {
        for on_recto in [true, false] {
            let mut book = book(on_recto);
            let rest = |book: &Book| book.creases(5)[0].rest.to_degrees().abs();
            book.step(200);
            assert!(book.is_asleep());
            book.wait(seconds);
            assert!((rest(&book) - 160.0).abs() < 0.1, "nothing lies upon it");
            turn(&mut book, Side::Left);
            // A part passes before the leaf upon it is taken up, and the rest before that moves.
            book.wait(0.75 * seconds);
            let id = book.pick_up(Side::Right, 4, 5).unwrap();
            book.wait(0.25 * seconds);
            book.play(id, Side::Left, 0.8);
            while book.flights() > 0 {
                book.step(1);
            }
            let crept = rest(&book) - 160.0;
            assert!((crept - degrees).abs() < 0.5, "{crept} in {seconds} s");
        }
    }
}

/// A tick in which nothing moves is no work, whatever the one before it was.
#[test]
fn a_book_at_rest_takes_no_work() {
    let mut book = book(true);
    turn(&mut book, Side::Right);
    book.begin_frame();
    assert_eq!(book.step_frame(1), 1);
    assert_eq!(book.tick_work(), 0);
    book.step(1);
    assert_eq!(book.tick_work(), 0);
}

#[test]
fn a_leaf_that_is_laid_upon_a_dog_ear_covers_it_and_uncovers_it() {
    let mut book = book(true);
    turn(&mut book, Side::Left);
    assert_eq!([book.read(), book.drawn_leaves() as u32], [4, 0]);
    turn(&mut book, Side::Right);
    assert_eq!([book.read(), book.drawn_leaves() as u32], [5, 1]);
    assert!(book.lies_creased(Side::Right));
    let rest = book.creases(5)[0].rest.to_degrees();
    assert!((rest - 160.0).abs() < 1.0, "{rest}");
}

/// Each leaf's corner lies upon that of the next.
#[test]
fn leaves_that_are_all_dog_eared_turn_off_each_other_and_lie_still_by_themselves() {
    for on_recto in [true, false] {
        let mut book = Book::new(0.14, 0.21, 40, 0.004).unwrap();
        *book.board_mut(0) = Board::new(Side::Left);
        book.lay(5);
        for leaf in 4..9 {
            assert!(book.crease(leaf, &[dog_ear(on_recto)]));
        }
        // The uppermost ones open to their rests first.
        while !book.is_asleep() {
            book.step(1);
        }
        for from in [Side::Right, Side::Right, Side::Left] {
            let ticks = turn(&mut book, from);
            assert!(
                ticks < 220,
                "{ticks} ticks from the {from:?}, recto {on_recto}"
            );
        }
        assert_eq!([book.read(), book.landed()[1]], [6, 0]);
    }
}

#[test]
fn a_book_laid_open_shows_the_creased_leaves_that_lie_uppermost() {
    let mut book = book(true);
    for (read, lies) in [(3, [false, false]), (6, [true, false]), (5, [false, true])] {
        book.lay(read);
        let found = [Side::Left, Side::Right].map(|side| book.lies_creased(side));
        assert_eq!((book.read(), found), (read, lies));
        assert_eq!(
            book.drawn_leaves(),
            lies.iter().filter(|lies| **lies).count()
        );
    }
}

#[test]
fn leaves_that_fly_as_one_are_not_creased() {
    let mut book = book(true);
    let id = book.pick_up(Side::Right, 5, 8).unwrap();
    assert_eq!(book.drawn_leaves(), 1);
    assert!(book.paper_mesh(0).is_none());
    book.play(id, Side::Left, 0.8);
    for _ in 0..400 {
        book.step(1);
    }
    assert_eq!([book.read(), book.flights() as u32], [8, 0]);
    assert_eq!(book.creases(5).len(), 1);
}

#[test]
fn pressing_a_crease_folds_the_leaf_and_opens_it_again() {
    let mut book = book(true);
    let corner = |book: &Book| book.surface(0).unwrap().position(48, 0);
    let folded = corner(&book);
    let id = book.pick_up(Side::Right, 5, 6).unwrap();
    for step in 1..=60 {
        let angle = 160.0 * (1.0 - step as f32 / 60.0);
        book.press(5, 0, angle.to_radians());
        book.step(1);
    }
    for _ in 0..300 {
        book.step(1);
    }
    book.update();
    assert!(book.phase(id).is_none());
    let open = corner(&book);
    assert!(
        open[0] - folded[0] > 0.025 && open[1] < 0.003,
        "{open:?} from {folded:?}"
    );
    assert!(book.crease(5, &[]));
    for _ in 0..400 {
        book.step(1);
    }
    assert_eq!([book.drawn_leaves(), book.creases(5).len()], [0, 0]);
}

#[test]
fn a_leaf_cannot_be_creased_across_the_spine_or_where_there_is_none() {
    let mut book = book(true);
    let across = SheetCrease::pressed([[0.0, 0.5], [1.0, 0.5]], 1.0, &Stock::BOOK, 0.14);
    let wrong = SheetCrease {
        rest: f64::NAN,
        ..dog_ear(true)
    };
    assert!(!book.crease(5, &[across]));
    assert!(!book.crease(5, &[wrong]));
    assert!(!book.crease(40, &[dog_ear(true)]));
    assert!(!book.crease(5, &[dog_ear(true); 17]));
    // Along the line of another leaf, too.
    for rest in [4.0, f64::NAN] {
        let beyond = SheetCrease {
            rest,
            ..dog_ear(true)
        };
        assert!(!book.crease(6, &[beyond]));
    }
    assert!(book.crease(6, &[dog_ear(false)]));
    // And where there is no room for one more leaf, neither in the book nor as it is drawn.
    let mut full = Book::new(0.14, 0.21, 5000, 0.004).unwrap();
    full.lay(4999);
    for leaf in 0..4096 {
        assert!(full.crease(leaf, &[dog_ear(true)]));
    }
    let id = full.pick_up(Side::Right, 4999, 5000).unwrap();
    full.play(id, Side::Left, 0.8);
    full.step(2);
    assert!(!full.crease(4999, &[dog_ear(true)]));
    assert!(full.creases(4999).is_empty());
    assert_eq!(book.creases(5).len(), 1);
    book.press(5, 0, f32::NAN);
    book.press(5, 9, 1.0);
    book.press(99, 0, 1.0);
    assert!((book.creases(5)[0].rest.to_degrees() - 160.0).abs() < 1e-3);
}

#[test]
fn paper_may_be_changed_under_a_creased_leaf() {
    let mut book = book(true);
    assert!(book.set_paper(&Paper {
        stock: Stock::CARD,
        ..Paper::default()
    }));
    assert!(book.lies_creased(Side::Right));
    turn(&mut book, Side::Right);
    assert!(book.lies_creased(Side::Left));
}

/// Each leaf comes down upon the folded corner of another, and lies there: where both are all but
/// down, 39 of 253 pictures were held back, as leaves were still drawn through each other after
/// all were moved apart.
#[test]
fn leaves_that_lie_on_each_others_dog_ears_are_drawn_where_they_are() {
    for on_recto in [true, false] {
        let mut book = Book::new(0.14, 0.21, 40, 0.004).unwrap();
        *book.board_mut(0) = Board::new(Side::Left);
        book.lay(5);
        for leaf in 5..15 {
            assert!(book.crease(leaf, &[dog_ear(on_recto)]));
        }
        let [mut pictures, mut held_back] = [0, 0];
        for leaf in 6..12 {
            let id = book.pick_up(Side::Right, leaf - 1, leaf).unwrap();
            book.play(id, Side::Left, 0.6);
            while book.flights() > 0 {
                book.step(2);
                book.update();
                let lags = (0..book.drawn_leaves()).map(|index| book.lag(index).unwrap());
                pictures += 1;
                held_back += usize::from(lags.fold(0.0, f32::max) > 1e-5);
            }
        }
        assert!(
            20 * held_back <= pictures,
            "{held_back} of {pictures} pictures, recto {on_recto}"
        );
    }
}

/// Frames are late: by the second the leaf, hardly folded yet, lies so still that it is eased to rest.
#[test]
fn a_leaf_that_is_pressed_while_it_comes_to_rest_is_folded() {
    let mut book = Book::new(0.13, 0.2, 12, 0.004).unwrap();
    *book.board_mut(0) = Board::new(Side::Left);
    book.lay(2);
    let id = book.pick_up(Side::Right, 2, 3).unwrap();
    let line = SheetCrease::pressed([[0.6, 0.0], [0.6, 1.0]], 0.0, &Stock::BOOK, 0.13);
    assert!(book.crease(2, &[line]));
    for (ticks, rest) in [(4, 2f32), (12, 28.0), (14, 80.0), (2, 88.0), (120, 160.0)] {
        book.press(2, 0, rest.to_radians());
        book.step(ticks);
    }
    book.update();
    assert!(book.phase(id).is_none() && book.is_asleep());
    let fore_edge = book.surface(0).unwrap().position(48, 0);
    assert!(fore_edge[0] < 0.4 * 0.13, "{fore_edge:?}");
}
