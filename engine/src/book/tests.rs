//! The book: its piles, and many leaves in flight.

use super::*;
use crate::contact::aabb::Aabb;
use crate::grid::{cells, cut_cell};
use crate::random::{Random, for_seeds};
use crate::triangle::area_normal;
use crate::vector::{cross, dot, sub};

/// A book that lies open, its front board on the left.
fn book() -> Book {
    let mut book = Book::new(0.14, 0.21, 40, 0.012).unwrap();
    *book.board_mut(0) = Board::new(Side::Left);
    book.update();
    book
}

fn is_finite(book: &Book) -> bool {
    let piles = [Side::Right, Side::Left].map(|side| book.pile(side).curves());
    (0..book.flights()).all(|k| {
        let surface = book.surface(k).unwrap();
        surface.positions.iter().all(|x| x.is_finite())
    }) && piles
        .iter()
        .all(|curves| curves.iter().all(|x| x.is_finite()))
}

/// Steps until no leaf is in flight. Returns the ticks that took.
fn rest(book: &mut Book) -> u32 {
    for tick in 0..4000 {
        if book.flights() == 0 {
            return tick;
        }
        book.step(1);
    }
    panic!("{} leaves never came to rest", book.flights());
}

/// Lifts `count` single leaves from the right and sends them to the left.
fn riffle(book: &mut Book, count: u32, apart: u32) -> Vec<u32> {
    (0..count)
        .map(|_| {
            let low = book.read() + book.flights() as u32;
            let id = book.pick_up(Side::Right, low, low + 1).unwrap();
            book.play(id, Side::Left, 0.8);
            book.step(apart);
            id
        })
        .collect()
}

#[test]
fn a_book_has_a_size() {
    assert!(Book::new(0.14, 0.21, 0, 0.0).is_some_and(|book| is_finite(&book)));
    assert!(Book::new(f64::NAN, 0.21, 10, 0.01).is_none());
    assert!(Book::new(0.14, 0.0, 10, 0.01).is_none());
    assert!(Book::new(0.14, 0.21, 10, f64::NAN).is_none());
}

#[test]
fn more_leaves_read_than_there_are_is_all_of_them() {
    let mut book = book();
    book.lay(40);
    let left = book.pile(Side::Left).curves().to_vec();
    book.lay(99);
    assert_eq!(book.pile(Side::Left).curves(), left);
    assert_eq!(book.read(), 40);
}

#[test]
fn what_is_no_number_changes_nothing() {
    let mut book = book();
    book.lay(4);
    let id = book.pick_up(Side::Right, 4, 5).unwrap();
    book.hold(id, 0, [0.1, 0.1, 0.1]);
    book.grab(id, 0, f32::NAN, 0.5);
    assert_eq!(book.phase(id), Some(Phase::Resting(Side::Right)));
    book.grab(id, 9, 1.0, 0.5);
    assert_eq!(book.phase(id), Some(Phase::Resting(Side::Right)));
    let lying = book.surface(0).unwrap().position(48, 12);
    book.grab(id, 0, 1.0, 0.5);
    for place in [[f32::NAN, 0.1, 0.1], [0.0, 0.1, f32::NAN]] {
        book.hold(id, 0, place);
        book.step(40);
        book.update();
        let held = book.surface(0).unwrap().position(48, 12);
        assert!(
            (held[0] - lying[0]).abs() < 1e-3,
            "{held:?} after {place:?}"
        );
    }
    book.play(id, Side::Left, f32::NAN);
    book.step(30);
    book.update();
    assert!(is_finite(&book));
    // A flight that is not there.
    book.grab(77, 0, 1.0, 0.5);
    book.hold(77, 0, [0.0; 3]);
    book.release(77, 0);
    book.play(77, Side::Left, 0.8);
    assert_eq!((book.phase(77), book.flights()), (None, 1));
}

#[test]
fn only_the_uppermost_leaves_of_a_side_are_picked_up() {
    let mut book = book();
    book.lay(10);
    for (side, low, high) in [
        (Side::Right, 11, 12),
        (Side::Right, 9, 10),
        (Side::Right, 10, 10),
        (Side::Right, 10, 41),
        (Side::Left, 10, 11),
        (Side::Left, 8, 9),
        (Side::Left, 10, 9),
    ] {
        assert_eq!(book.pick_up(side, low, high), None, "{side:?} {low} {high}");
    }
    assert!(book.pick_up(Side::Right, 10, 14).is_some());
    assert!(book.pick_up(Side::Left, 9, 10).is_some());
    assert_eq!(book.pick_up(Side::Right, 10, 11), None);
    assert!(book.pick_up(Side::Right, 14, 15).is_some());
    assert_eq!(book.flights(), 3);
}

#[test]
fn twelve_leaves_fly_at_once_and_land_in_their_order() {
    let mut book = book();
    let ids = riffle(&mut book, 12, 7);
    assert_eq!(book.flights(), 12);
    let listed: Vec<u32> = (0..12).map(|k| book.flight_id(k).unwrap()).collect();
    assert_eq!(listed, ids);
    let mut landed = 0;
    while book.flights() > 0 {
        book.step(1);
        for (k, &id) in ids.iter().enumerate() {
            assert_eq!(book.phase(id).is_none(), k < book.read() as usize);
        }
        assert!(book.read() >= landed);
        landed = book.read();
    }
    assert_eq!(landed, 12);
}

#[test]
fn no_more_fly_than_memory_is_kept_for() {
    let mut book = book();
    for k in 0..MOST_FLIGHTS as u32 {
        assert!(book.pick_up(Side::Right, k, k + 1).is_some());
    }
    let next = MOST_FLIGHTS as u32;
    assert_eq!(book.pick_up(Side::Right, next, next + 1), None);
    book.lay(0);
    assert_eq!(book.flights(), 0);
    assert!(book.pick_up(Side::Right, 0, 1).is_some());
}

#[test]
fn a_frame_has_fewer_ticks_the_more_work_they_are() {
    let mut book = book();
    assert_eq!(book.step_frame(12), 12, "nothing flies");
    let id = book.pick_up(Side::Right, 0, 1).unwrap();
    book.play(id, Side::Left, 0.8);
    assert_eq!(book.step_frame(60), 60, "one leaf flies");
    book.lay(0);
    riffle(&mut book, MOST_FLIGHTS as u32, 6);
    let mut fewest = 12;
    for frame in 0..6 {
        let id = book.flight_id(frame).unwrap();
        book.grab(id, 0, 1.0, 0.5);
        book.hold(id, 0, [0.1 - 0.03 * frame as f32, 0.2, 0.02]);
        book.begin_frame();
        let (mut work, mut ticks) = (0, 0);
        while ticks < 12 && book.step_frame(1) == 1 {
            assert!(
                work < limits::MOST_STEPPING,
                "{work} ns before tick {ticks}"
            );
            work += book.tick_work();
            ticks += 1;
        }
        assert!(
            ticks == 12 || work >= limits::MOST_STEPPING,
            "{ticks} ticks"
        );
        assert_eq!(book.step_frame(5) == 0, work >= limits::MOST_STEPPING);
        fewest = fewest.min(ticks);
    }
    assert!((1..12).contains(&fewest), "{fewest} ticks");
}

#[test]
fn leaves_from_both_sides_keep_their_order() {
    let mut book = book();
    book.lay(20);
    let right = book.pick_up(Side::Right, 20, 21).unwrap();
    let left = book.pick_up(Side::Left, 19, 20).unwrap();
    let far = book.pick_up(Side::Left, 15, 19).unwrap();
    let order: Vec<_> = (0..3).map(|k| book.flight_id(k).unwrap()).collect();
    assert_eq!(order, [far, left, right]);
    book.play(right, Side::Left, 0.8);
    // It takes the two in its way back to the left.
    book.step(20);
    rest(&mut book);
    assert_eq!(book.read(), 21);
}

#[test]
fn the_last_command_wins_where_two_leaves_are_in_each_others_way() {
    for (to, read) in [(Side::Left, 7), (Side::Right, 5)] {
        let mut book = book();
        book.lay(5);
        let ids = riffle(&mut book, 2, 20);
        // Against each other: the lower to the right, the upper to the left.
        let other = to.opposite();
        let (first, last) = match to {
            Side::Left => (ids[0], ids[1]),
            Side::Right => (ids[1], ids[0]),
        };
        book.play(first, other, 0.8);
        book.step(10);
        book.play(last, to, 0.8);
        rest(&mut book);
        assert_eq!(book.read(), read);
    }
}

#[test]
fn leaves_over_one_that_a_hand_takes_make_way() {
    let mut book = book();
    book.lay(5);
    let ids = riffle(&mut book, 2, 30);
    book.grab(ids[0], 0, 1.0, 0.5);
    book.hold(ids[0], 0, [0.0, 0.1, 0.1]);
    for _ in 0..400 {
        book.step(1);
    }
    // The other one was headed for the left, over this one; it went back.
    assert_eq!(book.phase(ids[1]), None);
    assert_eq!((book.flights(), book.read()), (1, 5));
    book.play(ids[0], Side::Left, 0.8);
    rest(&mut book);
    assert_eq!(book.read(), 6);
}

#[test]
fn one_leaf_is_in_hand_at_a_time_with_several_fingers() {
    let mut book = book();
    book.lay(5);
    let right = book.pick_up(Side::Right, 5, 6).unwrap();
    book.grab(right, 0, 1.0, 0.5);
    book.hold(right, 0, [0.09, 0.1, 0.06]);
    book.step(60);
    assert_eq!(book.phase(right), Some(Phase::Held));
    let left = book.pick_up(Side::Left, 4, 5).unwrap();
    book.grab(left, 1, 1.0, 0.5);
    book.grab(left, 2, 1.0, 0.0);
    assert_eq!(book.phase(right), Some(Phase::Falling(Side::Right)));
    for _ in 0..120 {
        book.hold(left, 1, [-0.09, 0.1, 0.06]);
        book.hold(left, 2, [-0.08, 0.0, 0.07]);
        book.step(1);
        book.update();
    }
    book.release(left, 1);
    book.step(60);
    book.update();
    assert_eq!(book.phase(left), Some(Phase::Held));
    let corner = book.surface(0).unwrap().position(48, 0);
    assert!((corner[0] + 0.08).abs() < 0.01, "{corner:?}");
    // A grab that holds nothing lets nothing go.
    book.release(left, 1);
    assert_eq!(book.phase(left), Some(Phase::Held));
    book.release(left, 2);
    rest(&mut book);
    assert_eq!(book.read(), 5);
}

#[test]
fn piles_change_steadily_while_many_leaves_fly() {
    let mut book = book();
    book.lay(8);
    let mut before = [Side::Right, Side::Left].map(|side| book.pile(side).curves().to_vec());
    let mut picked_up = 0;
    for tick in 0..700 {
        if tick % 17 == 0 && picked_up < 12 {
            let id = book
                .pick_up(Side::Right, 8 + picked_up, 9 + picked_up)
                .unwrap();
            book.play(id, Side::Left, 0.8);
            picked_up += 1;
        }
        book.step(1);
        book.update();
        for (side, before) in [Side::Right, Side::Left].into_iter().zip(&mut before) {
            let now = book.pile(side).curves();
            let jump = before
                .iter()
                .zip(now)
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f32::max);
            assert!(jump < 1e-4, "{jump} m at tick {tick}");
            before.copy_from_slice(now);
        }
    }
    assert_eq!((book.flights(), book.read()), (0, 20));
}

#[test]
fn every_leaf_in_flight_lies_between_the_piles() {
    let mut book = book();
    book.lay(8);
    riffle(&mut book, 10, 16);
    book.update();
    for k in 0..book.flights() {
        for p in book.surface(k).unwrap().positions.chunks_exact(3) {
            let side = if p[0] >= 0.0 { Side::Right } else { Side::Left };
            let floor = book.pile(side).height(p[0].abs());
            assert!(p[2] >= floor - 1e-6, "{p:?} under {floor}");
        }
    }
}

#[test]
fn whatever_is_asked_all_come_to_rest() {
    for_seeds(|random| {
        let mut book = book();
        book.lay(20);
        let mut most = 0;
        for round in 0..120 {
            ask_anything(&mut book, random);
            book.step(6);
            book.update();
            assert!(is_finite(&book), "round {round}");
            most = most.max(book.flights());
        }
        assert!(most > 1, "at most {most} in flight");
        // Sent to the left, every leaf in flight lies there, and no other has moved.
        let read = book.read() + book.flights() as u32;
        for k in 0..book.flights() {
            book.play(book.flight_id(k).unwrap(), Side::Left, 0.3);
        }
        rest(&mut book);
        assert_eq!(book.read(), read);
    });
}

fn ask_anything(book: &mut Book, random: &mut Random) {
    let flights = book.flights();
    let id = book.flight_id(random.below(flights + 1)).unwrap_or(0);
    let grab = random.below(5) as u32;
    let side = [Side::Right, Side::Left][random.below(2)];
    match random.below(5) {
        0 => {
            let read = book.read();
            let low = match side {
                Side::Right => read + flights as u32,
                Side::Left => read.saturating_sub(1),
            };
            // One that is neither held nor sent falls back within a tick.
            let Some(id) = book.pick_up(side, low, low + 1) else {
                return;
            };
            if random.below(2) == 0 {
                book.play(id, side.opposite(), random.between(0.1, 1.0));
            } else {
                book.grab(id, grab, random.between(0.0, 1.0), random.between(0.0, 1.0));
            }
        }
        1 => book.grab(id, grab, random.between(0.0, 1.0), random.between(0.0, 1.0)),
        2 => {
            let mut between = |low, high| random.between(low, high);
            let place = [between(-0.5, 0.5), between(-0.4, 0.6), between(-0.1, 0.5)];
            book.hold(id, grab, place);
        }
        3 => book.release(id, grab),
        _ => book.play(id, side, random.between(0.0, 1.0)),
    }
}

/// What a reader does: the next leaf is dragged over while the one before still falls,
/// and a leaf is caught in the middle of a riffle.
#[test]
fn an_ordinary_drag_beside_others_is_drawn_where_the_paper_is() {
    let mut book = Book::new(0.14, 0.21, 100, 0.012).unwrap();
    book.lay(40);
    for k in 0..4 {
        let id = book.pick_up(Side::Right, 40 + k, 41 + k).unwrap();
        book.play(id, Side::Left, 0.8);
        for _ in 0..6 {
            book.step(2);
            book.update();
        }
    }
    let id = book.pick_up(Side::Right, 44, 45).unwrap();
    book.grab(id, 0, 1.0, 0.15);
    let (mut frames, mut behind, mut worst) = (0, 0, 0.0f32);
    for frame in 0..60 {
        let s = frame as f32 / 59.0;
        let (sin, cos) = libm::sincosf(core::f32::consts::PI * s * s * (3.0 - 2.0 * s));
        book.hold(id, 0, [0.135 * cos, 0.03 + 0.02 * sin, 0.11 * sin + 0.01]);
        book.step(2);
        book.update();
        let lag = (0..book.flights())
            .map(|index| book.lag(index).unwrap())
            .fold(0.0, f32::max);
        frames += 1;
        behind += usize::from(lag > 1e-3);
        worst = worst.max(lag);
    }
    assert!(behind == 0, "{behind} of {frames} frames, {worst} m");
}

/// Whether two drawn leaves, or one with itself, go through each other by more than what
/// comes of rounding; every edge is held against every facet.
fn is_drawn_through(left: &Surface, right: &Surface) -> bool {
    let facets = |surface: &Surface| -> Vec<[usize; 3]> {
        let columns = surface.columns;
        let cells = cells(columns, surface.rows);
        cells
            .flat_map(|foot| cut_cell(foot, columns, false))
            .collect()
    };
    let is_same = core::ptr::eq(left, right);
    let through = |edges: &Surface, other: &Surface| {
        let points = edges.positions.as_chunks::<3>().0;
        let corners = other.positions.as_chunks::<3>().0;
        let own = facets(edges);
        let boxes: Vec<Aabb> = own
            .iter()
            .map(|own| Aabb::around(own.map(|node| points[node])))
            .collect();
        facets(other).iter().any(|facet| {
            let [a, b, c] = facet.map(|node| corners[node]);
            let normal = area_normal([a, b, c]);
            let tolerance = 2e-6 * dot(normal, normal).sqrt();
            let around = Aabb::around([a, b, c]);
            own.iter().zip(&boxes).any(|(own, bounds)| {
                bounds.overlaps(&around)
                    && (0..3).any(|k| {
                        let ends = [own[k], own[(k + 1) % 3]];
                        let [p, q] = ends.map(|node| points[node]);
                        let [h, g] = [p, q].map(|p| dot(sub(p, a), normal));
                        if (is_same && ends.iter().any(|node| facet.contains(node)))
                            || h.min(g) >= -tolerance
                            || h.max(g) <= tolerance
                        {
                            return false;
                        }
                        let place = core::array::from_fn(|i| p[i] + h / (h - g) * (q[i] - p[i]));
                        [[a, b], [b, c], [c, a]].into_iter().all(|[from, to]| {
                            dot(normal, cross(sub(to, from), sub(place, from))) > 0.0
                        })
                    })
            })
        })
    };
    through(left, right) || (!is_same && through(right, left))
}

/// A drawn leaf of the book's with its points at places by u and v, 0 to 1, over a flat
/// table.
fn override_surface(book: &mut Book, index: usize, place: impl Fn(f32, f32) -> [f32; 3]) {
    let u = book.columns().to_vec();
    let rows = book.rows();
    let points = book.override_surface(index).unwrap().as_chunks_mut::<3>().0;
    for (node, point) in points.iter_mut().enumerate() {
        let v = (node / u.len()) as f32 / (rows - 1) as f32;
        *point = place(u[node % u.len()], v);
    }
}

#[test]
fn leaves_that_are_not_next_to_each_other_are_not_drawn_through_each_other() {
    let mut book = book();
    book.lay(20);
    riffle(&mut book, 3, 0);
    // The middle one shrinks to the spine; the outer two meet across it.
    let upright = |lean: f32| {
        move |u: f32, v: f32| {
            let (sin, cos) = libm::sincosf(1.57 + lean * (v - 0.5));
            [0.14 * u * cos, 0.21 * v, 0.14 * u * sin]
        }
    };
    for frame in 0..6 {
        let lean = 0.3 * frame as f32 - 0.9;
        override_surface(&mut book, 0, upright(lean));
        override_surface(&mut book, 1, |u, v| [0.0, 0.21 * v, 0.001 * u]);
        override_surface(&mut book, 2, upright(-lean));
        book.update();
        for (left, right) in [(0, 1), (1, 2), (0, 2)] {
            let [left, right] = [left, right].map(|index| book.surface(index).unwrap());
            assert!(!is_drawn_through(left, right), "frame {frame}");
        }
    }
}

#[test]
fn a_leaf_is_not_drawn_through_itself() {
    let mut book = book();
    book.lay(20);
    riffle(&mut book, 1, 0);
    for frame in 0..12 {
        // It is rolled up the farther, the narrower toward the head, and through itself.
        let turns = frame as f32;
        override_surface(&mut book, 0, |u, v| {
            let (sin, cos) = libm::sincosf(turns * u - 1.57);
            let radius = 0.02 + 0.02 * u * (v - 0.5);
            [radius * cos, 0.21 * v, 0.05 + radius * sin]
        });
        book.update();
        let surface = book.surface(0).unwrap();
        assert!(!is_drawn_through(surface, surface), "frame {frame}");
    }
    assert!(book.lag(0).unwrap() > 0.01);
}

/// Two fingers pull a leaf of paper over itself. Nine in ten pictures show it where it is.
#[test]
fn a_leaf_that_hands_crumple_stays_out_of_itself() {
    for_seeds(|random| {
        let mut book = book();
        book.lay(20);
        let id = book.pick_up(Side::Right, 20, 21).unwrap();
        for grab in 0..2 {
            book.grab(id, grab, random.between(0.4, 1.0), random.between(0.0, 1.0));
        }
        let mut behind = 0;
        for frame in 0..60 {
            for grab in 0..2 {
                if frame % 12 == 6 * grab {
                    let x = random.between(-0.3, 0.3);
                    let place = [x, random.between(-0.2, 0.4), random.between(0.0, 0.2)];
                    book.hold(id, grab, place);
                }
            }
            book.step(2);
            book.update();
            let surface = book.surface(0).unwrap();
            let is_looked_at = frame % 4 == 0;
            assert!(
                !(is_looked_at && is_drawn_through(surface, surface)),
                "frame {frame}"
            );
            behind += usize::from(book.lag(0).unwrap() > 1e-3);
        }
        assert!(behind <= 6, "{behind} of 60 pictures are behind the paper");
    });
}

/// Eleven leaves that grabs tug at in turn, so that all are crumpled: the work of a picture
/// has a bound, beyond which only what was begun is ended.
#[test]
fn a_picture_takes_bounded_work_whatever_hands_do() {
    for seed in 0..3 {
        println!("seed {seed}");
        let random = &mut Random::new(seed);
        let mut book = Book::new(0.14, 0.21, 100, 0.012).unwrap();
        book.lay(40);
        riffle(&mut book, 11, 6);
        for frame in 0..24 {
            if frame % 4 == 0 {
                let id = book
                    .flight_id(random.below(book.flights() + 1))
                    .unwrap_or(0);
                book.grab(id, 0, 1.0, random.between(0.0, 1.0));
                let x = random.between(-0.2, 0.2);
                book.hold(id, 0, [x, random.between(-0.1, 0.3), 0.05]);
            }
            book.step(2);
            book.update();
            let work = book.update_work();
            assert!(work < 5_000_000, "{work} ns in frame {frame}");
        }
    }
}
