//! Loose sheets that meet each other.

use super::tests::{AROUND, held_folded, lying, settle, tear_off};
use super::*;
use crate::book::loose_sheets::{step_together, wake_upon};
use crate::book::stillness::LONGEST_FALL;
use crate::contact::aabb::Aabb;
use crate::contact::tolerance::OVER_PILE;
use crate::models::sheet::SheetCrease;
use crate::stock::Stock;

/// Farthest that a point of a sheet that no grab holds moves within a tick, metres: at 2.5 m/s, as
/// the rim of bible paper whips about that is let go alone.
const MOST_LEAP: f32 = 2.5 * TICK;

/// Where a sheet is taken to be carried.
const HELD_AT: [f32; 2] = [0.9, 0.8];

/// What happened while sheets moved.
#[derive(Default)]
struct Course {
    strain: f32,
    ticks: u32,
    /// The farthest that a drawn point moved within a tick of a sheet that no grab held, metres.
    leap: f32,
}

/// Steps sheets by a tick.
fn tick(sheets: &mut [TornLeaf], book: &Book, course: &mut Course) {
    let drawn = |sheet: &TornLeaf| sheet.surface().positions.clone();
    let before: Vec<Vec<f32>> = sheets.iter().map(drawn).collect();
    step_together(&mut sheets.iter_mut().collect::<Vec<_>>(), book, 1);
    for (sheet, before) in sheets.iter().zip(before) {
        if !sheet.is_held() {
            let moved = before.iter().zip(&sheet.surface().positions);
            course.leap = moved.fold(course.leap, |most, (a, b)| most.max((a - b).abs()));
        }
    }
    // What is pressed into a ball strains by itself.
    let flat = sheets.iter().filter(|sheet| !sheet.is_crumpled());
    let strain = flat.map(|sheet| sheet.sheet().max_edge_strain());
    course.strain = strain.fold(course.strain, f32::max);
    course.ticks += 1;
}

/// Carries a sheet by a place of its page to a place, and lets it go there.
fn carry(
    sheets: &mut [TornLeaf],
    which: usize,
    (at, to): ([f32; 2], [f32; 3]),
    book: &Book,
    course: &mut Course,
) {
    sheets[which].grab(0, at[0], at[1]);
    let from = place(&sheets[which], at);
    for step in 0..150 {
        let part = (step as f32 / 100.0).min(1.0);
        let rise = 0.06 * (4.0 * part * (1.0 - part));
        let mut pull: [f32; 3] = core::array::from_fn(|k| from[k] + part * (to[k] - from[k]));
        pull[2] += rise;
        sheets[which].pull(0, pull);
        tick(sheets, book, course);
    }
    sheets[which].release();
}

/// Where the drawn point is that lies next to a place of a sheet's page.
fn place(leaf: &TornLeaf, [u, v]: [f32; 2]) -> [f32; 3] {
    let surface = leaf.surface();
    let next = |at: f32, count: usize| libm::roundf(at * (count - 1) as f32) as usize;
    surface.position(next(u, surface.columns), next(v, surface.rows))
}

/// A place some centimetres beside and over a place of a sheet's page.
fn beside(leaf: &TornLeaf, at: [f32; 2]) -> [f32; 3] {
    let [x, y, z] = place(leaf, at);
    [x - 0.02, y + 0.03, z + 0.03]
}

/// Steps until all lie still by themselves.
fn rest(sheets: &mut [TornLeaf], book: &Book, course: &mut Course) {
    let start = course.ticks;
    while !sheets.iter().all(TornLeaf::is_asleep) {
        tick(sheets, book, course);
        assert!(
            course.ticks - start < 2 * LONGEST_FALL,
            "they move for ever"
        );
    }
}

/// How deep the upper of two sheets is drawn in the lower, where one is over the other, metres:
/// below 0 by how far they are apart; nothing where they are beside each other.
fn depth(lower: &TornLeaf, upper: &TornLeaf) -> Option<f32> {
    let triangles = |leaf: &TornLeaf| {
        let x = leaf.surface().positions.as_chunks::<3>().0;
        let corners = |corners: &[u32; 3]| corners.map(|corner| x[corner as usize]);
        leaf.triangles().iter().map(corners).collect::<Vec<_>>()
    };
    let mut deepest: Option<f32> = None;
    let uppers = triangles(upper);
    for lower in triangles(lower) {
        let around = Aabb::around(lower);
        for upper in &uppers {
            if !around.overlaps_in_plan(&Aabb::around(*upper)) {
                continue;
            }
            let below = upper
                .iter()
                .filter_map(|x| Some(height_in(&lower, *x)? - x[2]));
            let above = lower
                .iter()
                .filter_map(|x| Some(x[2] - height_in(upper, *x)?));
            let sides = |of: &[[f32; 3]; 3]| [[of[0], of[1]], [of[1], of[2]], [of[2], of[0]]];
            let crossings = sides(&lower)
                .into_iter()
                .flat_map(|a| sides(upper).map(|b| [a, b]))
                .filter_map(|[a, b]| crossing(a, b));
            for found in below.chain(above).chain(crossings) {
                deepest = Some(deepest.map_or(found, |deepest| deepest.max(found)));
            }
        }
    }
    deepest
}

/// Height of a triangle at a place that is in it in plan.
fn height_in([a, b, c]: &[[f32; 3]; 3], [x, y, _]: [f32; 3]) -> Option<f32> {
    let cross = |p: &[f32; 3], q: &[f32; 3]| (p[0] - x) * (q[1] - y) - (p[1] - y) * (q[0] - x);
    let parts = [cross(b, c), cross(c, a), cross(a, b)];
    let all: f32 = parts.iter().sum();
    let is_in = all != 0.0 && parts.iter().all(|part| part / all >= 0.0);
    is_in.then(|| (parts[0] * a[2] + parts[1] * b[2] + parts[2] * c[2]) / all)
}

/// By how much one side is above another where they cross in plan.
fn crossing([a, b]: [[f32; 3]; 2], [c, d]: [[f32; 3]; 2]) -> Option<f32> {
    let [u, v, w] = [[a, b], [c, d], [a, c]].map(|[p, q]| [q[0] - p[0], q[1] - p[1]]);
    let all = u[0] * v[1] - u[1] * v[0];
    if all == 0.0 {
        return None;
    }
    let s = (w[0] * v[1] - w[1] * v[0]) / all;
    let t = (w[0] * u[1] - w[1] * u[0]) / all;
    let is_in = (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t);
    is_in.then(|| a[2] + s * (b[2] - a[2]) - c[2] - t * (d[2] - c[2]))
}

/// A book and two sheets of a stock: the second was let fall on the first, turned against it,
/// `x` metres from the spine.
fn dropped(stock: Stock, x: f32) -> (Book, [TornLeaf; 2], Course) {
    let (book, first) = lying(stock, x);
    let second = lying(stock, 0.7).1;
    let mut sheets = [first, second];
    let mut course = Course::default();
    let to = beside(&sheets[0], HELD_AT);
    carry(&mut sheets, 1, (HELD_AT, to), &book, &mut course);
    rest(&mut sheets, &book, &mut course);
    (book, sheets, course)
}

fn check(what: &str, sheets: &[TornLeaf], course: &Course) {
    // Two that lie on the table through each other are drawn at one height.
    check_to(0.0, what, sheets, course);
}

/// Checks that sheets lie less deep than that in each other, metres, and what happened on the way.
fn check_to(most: f32, what: &str, sheets: &[TornLeaf], course: &Course) {
    let found = depth(&sheets[0], &sheets[1]);
    println!(
        "{what}: depth {found:?} m, strain {}, {} ticks, leap {} m",
        course.strain, course.ticks, course.leap
    );
    assert!(found.is_none_or(|found| found < most), "{what}: {found:?}");
    assert!(course.strain < 0.01, "{what}: {}", course.strain);
    assert!(course.leap < MOST_LEAP, "{what}: {}", course.leap);
}

#[test]
fn a_sheet_lies_upon_another_on_the_table_and_on_the_pages() {
    for stock in [Stock::BIBLE, Stock::BOOK, Stock::CARD] {
        for x in [0.4, 0.2, 0.14] {
            let (_, sheets, course) = dropped(stock, x);
            let what = format!("{} kg/m2 at {x} m", stock.grammage);
            assert!(depth(&sheets[0], &sheets[1]).is_some(), "{what}");
            check(&what, &sheets, &course);
        }
    }
}

#[test]
fn what_lies_under_a_sheet_stays_where_it_is_when_that_is_taken() {
    let (book, mut sheets, _) = dropped(Stock::BOOK, 0.4);
    let before = sheets[0].surface().clone();
    let mut course = Course::default();
    carry(
        &mut sheets,
        1,
        (HELD_AT, [0.7, 0.2, 0.05]),
        &book,
        &mut course,
    );
    rest(&mut sheets, &book, &mut course);
    assert_eq!(sheets[0].surface(), &before);
    check("taken", &sheets, &course);
}

#[test]
fn a_sheet_is_pulled_out_from_below_another() {
    for stock in [Stock::BIBLE, Stock::BOOK, Stock::CARD] {
        let (book, mut sheets, _) = dropped(stock, 0.4);
        let lay = sheets[1].surface().positions.clone();
        let mut course = Course::default();
        carry(
            &mut sheets,
            0,
            (HELD_AT, [0.75, 0.2, 0.05]),
            &book,
            &mut course,
        );
        rest(&mut sheets, &book, &mut course);
        let moved = lay.iter().zip(&sheets[1].surface().positions);
        let most = moved.fold(0.0f32, |most, (a, b)| most.max((a - b).abs()));
        let low = sheets[1].drawn_bounds().low[2] - AROUND.table;
        println!("the upper moved by {most} m, and lies {low} m over the table");
        check("pulled out", &sheets, &course);
        assert!(low < 0.001, "{low}");
        // It comes to lie upon the other after that.
        let to = beside(&sheets[1], HELD_AT);
        carry(&mut sheets, 0, (HELD_AT, to), &book, &mut course);
        rest(&mut sheets, &book, &mut course);
        sheets.swap(0, 1);
        assert!(depth(&sheets[0], &sheets[1]).is_some());
        check("put back upon it", &sheets, &course);
    }
}

#[test]
fn a_sheet_that_is_jerked_up_from_below_another_throws_nothing_about() {
    for stock in [Stock::BIBLE, Stock::BOOK, Stock::CARD] {
        let (book, mut sheets, _) = dropped(stock, 0.4);
        let mut course = Course::default();
        // As a pointer that takes it: raised at once.
        let [x, y, z] = place(&sheets[0], HELD_AT);
        sheets[0].grab(0, HELD_AT[0], HELD_AT[1]);
        for step in 0..90 {
            let away = 0.003 * (step as f32 - 45.0).max(0.0);
            sheets[0].pull(0, [x + away, y, z + 0.06]);
            tick(&mut sheets, &book, &mut course);
        }
        let raised = sheets[1].drawn_bounds().high[2] - AROUND.table;
        sheets[0].release();
        rest(&mut sheets, &book, &mut course);
        println!("raised by {raised} m");
        sheets.sort_by_key(|sheet| sheet.layer);
        check("jerked up", &sheets, &course);
    }
}

#[test]
fn a_sheet_is_crumpled_below_another() {
    let (book, mut sheets, _) = dropped(Stock::BOOK, 0.4);
    let mut course = Course::default();
    assert!(sheets[0].crumple());
    rest(&mut sheets, &book, &mut course);
    check("crumpled below", &sheets, &course);
}

#[test]
fn what_is_taken_away_lets_down_what_lay_upon_it() {
    let (book, [mut first, mut second], _) = dropped(Stock::BOOK, 0.4);
    assert!(second.is_asleep());
    wake_upon(&mut [&mut first, &mut second], 0, &book);
    assert!(first.is_asleep() && !second.is_asleep());
    wake_upon(&mut [&mut first, &mut second], 1, &book);
    assert!(first.is_asleep());
    settle(&mut second, &book);
    let low = second.drawn_bounds().low[2] - AROUND.table;
    assert!(low < 1.5 * OVER_PILE, "{low}");
}

#[test]
fn both_pieces_of_a_sheet_lie_upon_each_other() {
    for (from, to) in [([0.0, 0.5], [1.0, 0.45]), ([0.3, 0.0], [0.6, 1.0])] {
        let (book, mut whole) = lying(Stock::BOOK, 0.4);
        assert!(whole.tear_across(&[from, to], false));
        whole.cut();
        let other = whole.part().unwrap();
        let mut sheets = [whole, other];
        let mut course = Course::default();
        // Both fall at once, on one place.
        for (k, piece) in sheets.iter_mut().enumerate() {
            piece.update(&book);
            let surface = piece.surface();
            let middle = (surface.rows / 2) * surface.columns + surface.columns / 2;
            let [u, v] = piece.paper_mesh().unwrap().places[middle];
            piece.grab(0, u, v);
            piece.pull(0, [0.5, 0.1, 0.04 + 0.02 * k as f32]);
        }
        for _ in 0..120 {
            tick(&mut sheets, &book, &mut course);
        }
        for piece in &mut sheets {
            piece.release();
        }
        rest(&mut sheets, &book, &mut course);
        assert!(depth(&sheets[0], &sheets[1]).is_some());
        check("pieces", &sheets, &course);
    }
}

#[test]
fn many_sheets_that_are_dropped_on_one_place_come_to_rest() {
    let (book, first) = lying(Stock::BOOK, 0.4);
    let mut sheets = vec![first; 6];
    let mut course = Course::default();
    for k in 0..sheets.len() {
        let [x, y, z] = place(&sheets[0], HELD_AT);
        let around = [0.03 * (k % 3) as f32 - 0.03, 0.02 * (k / 3) as f32];
        let to = [x + around[0], y + around[1], z + 0.04];
        carry(&mut sheets, k, (HELD_AT, to), &book, &mut course);
    }
    rest(&mut sheets, &book, &mut course);
    sheets.sort_by_key(|sheet| sheet.layer);
    let mut deepest = f32::NEG_INFINITY;
    for upper in 1..sheets.len() {
        for lower in 0..upper {
            let found = depth(&sheets[lower], &sheets[upper]);
            deepest = deepest.max(found.unwrap_or(deepest));
        }
    }
    println!(
        "many: depth {deepest} m, strain {}, {} ticks, leap {}",
        course.strain, course.ticks, course.leap
    );
    assert!(deepest < 0.0 && course.strain < 0.01 && course.leap < MOST_LEAP);
}

#[test]
fn a_ball_and_a_sheet_lie_upon_each_other() {
    for is_ball_upper in [true, false] {
        let (book, mut first) = lying(Stock::BOOK, 0.4);
        let mut second = lying(Stock::BOOK, 0.7).1;
        let ball = if is_ball_upper {
            &mut second
        } else {
            &mut first
        };
        assert!(ball.crumple());
        settle(ball, &book);
        let mut sheets = [first, second];
        let mut course = Course::default();
        let Aabb { low, high } = sheets[0].drawn_bounds();
        let [x, y] = [0, 1].map(|axis| low[axis].midpoint(high[axis]));
        let to = [x, y, high[2] + 0.04];
        carry(&mut sheets, 1, ([0.5, 0.5], to), &book, &mut course);
        // None falls through the other: a sheet slips off a ball by the way, and is drawn in its flank.
        let mut deepest = None;
        while !sheets.iter().all(TornLeaf::is_asleep) {
            tick(&mut sheets, &book, &mut course);
            if course.ticks.is_multiple_of(10) {
                deepest = [deepest, depth(&sheets[0], &sheets[1])]
                    .into_iter()
                    .flatten()
                    .reduce(f32::max);
            }
        }
        println!("the deepest as it falls: {deepest:?}");
        assert!(
            deepest.is_some_and(|deepest| deepest < 0.005),
            "{deepest:?}"
        );
        // Corners of facets stand up between the places at which its height is known.
        let most = if is_ball_upper { 0.0 } else { 2.0 * OVER_PILE };
        let what = format!("ball upper: {is_ball_upper}");
        check_to(most, &what, &sheets, &course);
        carry(
            &mut sheets,
            0,
            (HELD_AT, [0.8, 0.2, 0.05]),
            &book,
            &mut course,
        );
        rest(&mut sheets, &book, &mut course);
        check("the lower one taken", &sheets, &course);
    }
}

#[test]
fn a_folded_sheet_and_another_lie_upon_each_other() {
    let line = SheetCrease::pressed([[0.6, 0.0], [0.6, 1.0]], 2.8, &Stock::BOOK, 0.148);
    let at = [0.3, 0.5];
    let (book, id) = held_folded(Side::Right, Stock::BOOK, at, &[line]);
    let (mut folded, ..) = tear_off(&book, id, TearLine::Sewn, (Side::Right, at));
    folded.release();
    let flat = lying(Stock::BOOK, 0.7).1;
    for is_folded_upper in [true, false] {
        let mut sheets = [folded.clone(), flat.clone()];
        let mut course = Course::default();
        carry(&mut sheets, 0, (at, [0.4, 0.1, 0.05]), &book, &mut course);
        rest(&mut sheets, &book, &mut course);
        let [which, to] = if is_folded_upper { [0, 1] } else { [1, 0] };
        let [x, y, z] = place(&sheets[to], [0.5, 0.5]);
        carry(
            &mut sheets,
            which,
            ([0.4, 0.5], [x, y, z + 0.05]),
            &book,
            &mut course,
        );
        rest(&mut sheets, &book, &mut course);
        if is_folded_upper {
            sheets.swap(0, 1);
        }
        check(
            &format!("folded upper: {is_folded_upper}"),
            &sheets,
            &course,
        );
    }
}

#[test]
fn one_sheet_alone_moves_as_if_there_were_no_others() {
    let (book, mut alone) = lying(Stock::BOOK, 0.4);
    let mut sheets = [alone.clone()];
    let mut course = Course::default();
    carry(
        &mut sheets,
        0,
        (HELD_AT, [0.6, 0.1, 0.05]),
        &book,
        &mut course,
    );
    rest(&mut sheets, &book, &mut course);
    alone.grab(0, HELD_AT[0], HELD_AT[1]);
    let mut twin = [alone];
    let from = place(&twin[0], HELD_AT);
    let to = [0.6, 0.1, 0.05];
    for step in 0..150 {
        let part = (step as f32 / 100.0).min(1.0);
        let mut pull: [f32; 3] = core::array::from_fn(|k| from[k] + part * (to[k] - from[k]));
        pull[2] += 0.06 * (4.0 * part * (1.0 - part));
        twin[0].pull(0, pull);
        twin[0].step(&book, 1);
    }
    let [mut alone] = twin;
    alone.release();
    settle(&mut alone, &book);
    assert_eq!(alone.sheet().positions(), sheets[0].sheet().positions());
    assert_eq!(alone.surface().positions, sheets[0].surface().positions);
}
