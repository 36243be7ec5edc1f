use super::fracture::work_of;
use super::tests::{AROUND, deepest, held, lying, settle};
use super::*;
use crate::book::stillness::LONGEST_FALL;
use crate::stock::Stock;
use crate::vector::{dot, sub};

/// Paths across a page: level, slanted, upright, and along which a corner comes off.
pub(super) const PATHS: [[[f64; 2]; 2]; 5] = [
    [[0.0, 0.5], [1.0, 0.5]],
    [[1.0, 0.35], [0.0, 0.6]],
    [[0.5, 1.0], [0.45, 0.0]],
    [[0.5, 1.0], [1.0, 0.6]],
    [[0.0, 0.5], [0.6, 0.0]],
];

/// Width and height of the page, metres.
pub(super) const SIZE: [f64; 2] = [0.148, 0.21];

/// Where two grabs hold a page to tear it along a path: to the right of where that begins, and
/// to the left, u and v of each.
pub(super) fn holds([from, to]: [[f64; 2]; 2]) -> [[f32; 2]; 2] {
    let metres = |at: [f64; 2]| [0, 1].map(|axis| at[axis] * SIZE[axis]);
    let [from, to] = [from, to].map(metres);
    let way = [to[0] - from[0], to[1] - from[1]];
    let long = libm::hypot(way[0], way[1]);
    let along = way.map(|way| way / long);
    [-1.0, 1.0].map(|side| {
        let out = [-side * along[1], side * along[0]];
        [0, 1].map(|axis| {
            let place = from[axis] + 0.02 * along[axis] + 0.035 * out[axis];
            (place / SIZE[axis]).clamp(0.0, 1.0) as f32
        })
    })
}

/// The drawn point next to a place of the page, metres in book space.
pub(super) fn drawn_at(leaf: &TornLeaf, [u, v]: [f32; 2]) -> [f32; 3] {
    let places = leaf
        .paper_mesh()
        .unwrap()
        .places
        .iter()
        .zip(leaf.surface().positions.as_chunks::<3>().0);
    let away = |at: &[f32; 2]| {
        let [x, y] = [(at[0] - u) * SIZE[0] as f32, (at[1] - v) * SIZE[1] as f32];
        x * x + y * y
    };
    let nearest = places.min_by(|(a, _), (b, _)| away(a).total_cmp(&away(b)));
    *nearest.unwrap().1
}

/// What came of tearing a sheet across.
struct Torn {
    /// The piece to the right of the path, and the one to the left.
    pieces: [TornLeaf; 2],
    seconds: f32,
    /// How far apart the grabs have gone, metres.
    apart: f32,
    /// The greatest edge strain on the way.
    worst: f32,
    /// How far the tear was open after each tick, metres.
    opened: Vec<f32>,
}

/// Tears a sheet across by two grabs that rise and go apart.
fn tear_across(mut leaf: TornLeaf, book: &Book, path: [[f64; 2]; 2]) -> Torn {
    assert!(leaf.tear_across(&path, false));
    leaf.update(book);
    let holds = holds(path);
    let starts = holds.map(|at| drawn_at(&leaf, at));
    for (grab, at) in holds.iter().enumerate() {
        leaf.grab(grab, at[0], at[1]);
    }
    let between = sub(starts[1], starts[0]);
    let long = dot(between, between).sqrt();
    let apart = between.map(|x| x / long);
    let (mut worst, mut opened) = (0.0f32, vec![leaf.opened()]);
    for tick in 1..400 {
        let seconds = tick as f32 * TICK;
        let raised = 0.06 * (seconds / 0.4).min(1.0);
        let away = 0.15 * (seconds - 0.3).max(0.0);
        for (grab, start) in starts.iter().enumerate() {
            let sign = if grab == 0 { -1.0 } else { 1.0 };
            let mut to: [f32; 3] =
                core::array::from_fn(|axis| start[axis] + sign * away * apart[axis]);
            to[2] += raised + 0.5 * sign * away.min(0.08);
            leaf.pull(grab, to);
        }
        leaf.step(book, 1);
        worst = worst.max(leaf.sheet().max_edge_strain());
        assert!(leaf.sheet().positions().iter().all(|x| x.is_finite()));
        if let Some(other) = leaf.part() {
            return Torn {
                pieces: [leaf, other],
                seconds,
                apart: 2.0 * away,
                worst,
                opened,
            };
        }
        opened.push(leaf.opened());
    }
    panic!("{path:?} holds at {} nodes", leaf.ties());
}

/// Area of what is drawn but the rows beside the tear, from the mesh on the page and in space, m^2.
pub(super) fn areas(leaf: &TornLeaf) -> [f64; 2] {
    let x = leaf.surface().positions.as_chunks::<3>().0;
    let mut sums = [0.0; 2];
    for corners in &leaf.paper_mesh().unwrap().triangles {
        let flat = corners.map(|k| {
            let [u, v] = leaf.paper_mesh().unwrap().places[k as usize];
            [u * SIZE[0] as f32, v * SIZE[1] as f32, 0.0]
        });
        let bent = corners.map(|k| x[k as usize]);
        for (sum, [a, b, c]) in sums.iter_mut().zip([flat, bent]) {
            let across = crate::vector::cross(sub(b, a), sub(c, a));
            *sum += 0.5 * f64::from(dot(across, across).sqrt());
        }
    }
    sums
}

/// Length of the path along which a sheet is torn, metres.
fn path_length(leaf: &TornLeaf, path: [[f64; 2]; 2]) -> f64 {
    let (_, grid) = leaf.sheet.torn_along(&path, f64::from(TICK)).unwrap();
    grid.lengths().iter().sum()
}

#[test]
fn both_pieces_keep_their_paper_and_come_to_rest() {
    for stock in [Stock::BIBLE, Stock::BOOK, Stock::CARD] {
        let (book, leaf) = lying(stock, 0.41);
        for path in PATHS {
            let torn = tear_across(leaf.clone(), &book, path);
            let mut pieces = torn.pieces;
            let work = f64::from(pieces[0].take_work());
            let wanted = work_of(stock.caliper, path_length(&leaf, path));
            assert!((work / wanted - 1.0).abs() < 1e-4, "{work} J for {wanted}");
            assert_eq!(pieces[1].take_work(), 0.0);
            let mut worst = torn.worst;
            let mut flat = 0.0;
            for piece in &mut pieces {
                piece.release();
                worst = worst.max(settle(piece, &book));
                assert_eq!(deepest(piece, &book), 0.0, "{path:?}");
                assert!(
                    piece.stillness.is_still(),
                    "{path:?}: {:?}",
                    piece.stillness
                );
                let [paper, drawn] = areas(piece);
                assert!((drawn / paper - 1.0).abs() < 1e-3, "{drawn} of {paper} m^2");
                flat += paper;
            }
            eprintln!(
                "{} g/m2, {path:?}: {:.2} s, {:.0} mm apart, {work:.3} J, strain {worst:.5}",
                1e3 * stock.grammage,
                torn.seconds,
                1e3 * torn.apart
            );
            assert!(worst < 0.01, "{path:?}: {worst}");
            // Either piece is drawn a millimetre beyond the path, where the picture cuts it.
            let more = flat / (SIZE[0] * SIZE[1]) - 1.0;
            assert!((0.0..0.03).contains(&more), "{path:?}: {more}");
        }
    }
}

#[test]
fn a_tear_opens_from_the_edge_at_which_it_begins() {
    let (book, leaf) = lying(Stock::BOOK, 0.42);
    for path in [PATHS[0], PATHS[1], PATHS[2]] {
        let torn = tear_across(leaf.clone(), &book, path);
        assert!(torn.opened.is_sorted(), "{:?}", torn.opened);
        assert_eq!(torn.opened[0], 0.0);
        // It takes its time.
        let between = torn.opened.iter().filter(|open| **open > 0.0);
        assert!(between.count() > 10, "{:?}", torn.opened);
    }
}

#[test]
fn the_same_pulls_tear_the_same_bits() {
    let (book, leaf) = lying(Stock::BOOK, 0.42);
    let hash = || {
        let mut hash = crate::hash::BitHash::new();
        for piece in tear_across(leaf.clone(), &book, PATHS[1]).pieces {
            hash.floats(piece.sheet().positions());
        }
        hash.value()
    };
    assert_eq!(hash(), hash());
}

#[test]
fn a_gentle_pull_tears_no_further() {
    let (book, mut leaf) = lying(Stock::BOOK, 0.42);
    assert!(leaf.tear_across(&PATHS[0], false));
    leaf.update(&book);
    let count = leaf.ties();
    for (grab, at) in holds(PATHS[0]).into_iter().enumerate() {
        let [x, y, z] = drawn_at(&leaf, at);
        leaf.grab(grab, at[0], at[1]);
        leaf.pull(grab, [x, y, z + 0.03]);
    }
    for _ in 0..240 {
        leaf.step(&book, 1);
    }
    leaf.release();
    settle(&mut leaf, &book);
    assert_eq!(
        (leaf.ties(), leaf.opened(), leaf.take_work()),
        (count, 0.0, 0.0)
    );
    assert!(leaf.part().is_none());
    // Cut, it parts without work.
    leaf.cut();
    assert_eq!((leaf.opened(), leaf.take_work()), (f32::INFINITY, 0.0));
    assert!(leaf.part().is_some() && leaf.part().is_none());
}

/// Tears a sheet across by two grabs that go apart until it is open over a part of its path, and
/// holds it there. Returns it once it is left as it is.
fn held_half_torn(mut leaf: TornLeaf, book: &Book, path: [[f64; 2]; 2], part: f32) -> TornLeaf {
    let long = path_length(&leaf, path) as f32;
    assert!(leaf.tear_across(&path, false));
    leaf.update(book);
    let holds = holds(path);
    let starts = holds.map(|at| drawn_at(&leaf, at));
    for (grab, at) in holds.iter().enumerate() {
        leaf.grab(grab, at[0], at[1]);
    }
    let between = sub(starts[1], starts[0]);
    let apart = between.map(|x| x / dot(between, between).sqrt());
    for tick in 1..400 {
        let seconds = tick as f32 * TICK;
        let away = 0.15 * (seconds - 0.3).max(0.0);
        for (grab, start) in starts.iter().enumerate() {
            let sign = if grab == 0 { -1.0 } else { 1.0 };
            let mut to: [f32; 3] =
                core::array::from_fn(|axis| start[axis] + sign * away * apart[axis]);
            to[2] += 0.06 * (seconds / 0.4).min(1.0) + 0.5 * sign * away.min(0.08);
            leaf.pull(grab, to);
        }
        leaf.step(book, 1);
        if leaf.opened() >= part * long {
            break;
        }
    }
    for _ in 0..LONGEST_FALL {
        leaf.step(book, 1);
    }
    leaf
}

#[test]
fn a_half_torn_sheet_that_two_grabs_hold_still_comes_to_rest() {
    let mut moving = Vec::new();
    for stock in [Stock::BIBLE, Stock::CARD] {
        let (book, leaf) = lying(stock, 0.41);
        for path in [PATHS[0], PATHS[2]] {
            for part in [0.2, 0.5] {
                let leaf = held_half_torn(leaf.clone(), &book, path, part);
                if !leaf.is_asleep() {
                    let speeds = leaf.sheet().velocities().as_chunks::<3>().0;
                    let square = speeds.iter().map(|v| dot(*v, *v)).sum::<f32>();
                    let speed = (square / speeds.len() as f32).sqrt();
                    moving.push((stock.grammage, path, part, speed));
                }
            }
        }
    }
    assert!(moving.is_empty(), "{moving:#?}");
}

#[test]
fn what_cannot_be_torn_across_stays_as_it_is() {
    let (book, id) = held(Side::Right, Stock::BOOK, [0.95, 0.9]);
    let mut bound = TornLeaf::tear(&book, id, TearLine::Sewn, 0..NODES[1], AROUND).unwrap();
    assert!(!bound.tear_across(&PATHS[0], false));
    let (_, leaf) = lying(Stock::BOOK, 0.42);
    let mut ball = leaf.clone();
    assert!(ball.crumple() && !ball.tear_across(&PATHS[0], false));
    let mut torn = leaf.clone();
    assert!(!torn.tear_across(&[[0.0, 0.2], [0.0, 0.8]], false));
    assert_eq!(torn.sheet().positions(), leaf.sheet().positions());
    assert!(torn.tear_across(&PATHS[0], false) && !torn.tear_across(&PATHS[2], false));
    assert!(!torn.crumple());
    torn.cut();
    let mut other = torn.part().unwrap();
    assert!(!other.tear_across(&PATHS[2], false));
}

#[test]
fn a_sheet_that_is_torn_through_goes_on_where_it_is() {
    let (book, mut leaf) = lying(Stock::BOOK, 0.36);
    assert!(leaf.tear_across(&PATHS[1], false));
    leaf.update(&book);
    let holds = holds(PATHS[1]);
    let starts = holds.map(|at| drawn_at(&leaf, at));
    for (grab, at) in holds.iter().enumerate() {
        leaf.grab(grab, at[0], at[1]);
    }
    let between = sub(starts[1], starts[0]);
    let apart = between.map(|x| x / dot(between, between).sqrt());
    let mut through = 0;
    for tick in 1..600 {
        let away = 0.15 * tick as f32 * TICK;
        for (grab, start) in starts.iter().enumerate() {
            let away = if grab == 0 { -away } else { away };
            let [x, y, z]: [f32; 3] = core::array::from_fn(|k| start[k] + away * apart[k]);
            leaf.pull(grab, [x, y, z + 0.02]);
        }
        let before = leaf.sheet().positions().to_vec();
        leaf.step(&book, 1);
        through += usize::from(leaf.ties() == 0);
        if through > 1 {
            // The viewer parts it after as many ticks as a frame has.
            let moved = leaf.sheet().positions().iter().zip(&before);
            let most = moved.fold(0.0f32, |most, (a, b)| most.max((a - b).abs()));
            assert!(most < 0.02, "{tick}: {most} m in a tick");
        }
        if through == 8 {
            assert!(leaf.part().is_some());
            return;
        }
    }
    panic!("it holds at {} nodes", leaf.ties());
}
