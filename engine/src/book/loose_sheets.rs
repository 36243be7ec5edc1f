//! Loose sheets that meet each other: each lies upon those below it.
//!
//! They have an order from the table up. A sheet is stepped over the upper sides ([`Relief`]) of
//! those before it in that order, and does not press on them. One that a grab holds comes to the
//! top as soon as nothing lies upon it; until then it takes along what does.

use std::rc::Rc;

use super::Book;
use super::torn_leaf::TornLeaf;
use crate::contact::relief::Relief;
use crate::contact::tolerance::FAR;

/// Steps loose sheets by `ticks` of [`TICK`](super::TICK) seconds on and beside a book as it is drawn, and
/// brings what is drawn of them up to date. Those that are asleep and that nothing moves stay so.
pub fn step_together(sheets: &mut [&mut TornLeaf], book: &Book, ticks: u32) {
    let mut order = order_of(sheets);
    raise_held(sheets, &mut order, book);
    for (layer, sheet) in order.iter().enumerate() {
        sheets[*sheet].layer = layer as u32;
    }
    let mut has_moved = vec![false; sheets.len()];
    for _ in 0..ticks {
        for (layer, sheet) in order.iter().enumerate() {
            if sheets[*sheet].is_asleep() {
                continue;
            }
            let under = under(sheets, &order[..layer], *sheet, book);
            sheets[*sheet].tick_over(book, &under);
            has_moved[*sheet] = true;
            move_upon(sheets, &order[layer..], book, &under);
        }
    }
    for (layer, sheet) in order.iter().enumerate() {
        if has_moved[*sheet] {
            let under = under(sheets, &order[..layer], *sheet, book);
            sheets[*sheet].update_over(book, &under);
        }
    }
}

/// Wakes what lies upon a sheet that is about to be taken away, by its index.
pub fn wake_upon(sheets: &mut [&mut TornLeaf], gone: usize, book: &Book) {
    let order = order_of(sheets);
    let Some(layer) = order.iter().position(|sheet| *sheet == gone) else {
        return;
    };
    let relief = sheets[gone].renew_relief(book);
    wake_near(sheets, &order[layer + 1..], &relief);
}

/// The indices of sheets from the table up: those of one layer as they are listed.
fn order_of(sheets: &[&mut TornLeaf]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..sheets.len()).collect();
    order.sort_by_key(|sheet| sheets[*sheet].layer);
    order
}

/// Brings the sheets that grabs hold to the top, below what lies upon them, which they are laden
/// with.
fn raise_held(sheets: &mut [&mut TornLeaf], order: &mut Vec<usize>, book: &Book) {
    let held: Vec<usize> = (0..sheets.len())
        .filter(|sheet| sheets[*sheet].is_held())
        .collect();
    for sheet in held {
        let Some(layer) = order.iter().position(|other| *other == sheet) else {
            continue;
        };
        let mut raised = vec![sheet];
        let mut others = order[..layer].to_vec();
        for other in &order[layer + 1..] {
            let lies_upon = raised
                .iter()
                .any(|lower| lies_over(sheets, *lower, *other, book));
            if lies_upon {
                raised.push(*other);
            } else {
                others.push(*other);
            }
        }
        sheets[sheet].is_laden = raised.len() > 1;
        others.extend(raised);
        *order = others;
    }
}

/// Whether a sheet that comes after another in the order is over it in plan, and not below all of
/// it.
fn lies_over(sheets: &mut [&mut TornLeaf], lower: usize, upper: usize, book: &Book) -> bool {
    let [of_upper, of_lower] = [upper, lower].map(|sheet| sheets[sheet].drawn_bounds());
    if !of_upper.overlaps_in_plan(&of_lower) || of_upper.high[2] < of_lower.low[2] {
        return false;
    }
    let relief = sheets[lower].renew_relief(book);
    let points = sheets[upper].surface().positions.as_chunks::<3>().0;
    points.iter().any(|[x, y, _]| relief.covers(*x, *y))
}

/// Whether two sheets are over or beside each other in plan, so near that the upper side of the
/// first may be met by the second.
fn are_near(sheets: &[&mut TornLeaf], lower: usize, upper: usize) -> bool {
    let [of_lower, of_upper] = [lower, upper].map(|sheet| sheets[sheet].node_bounds());
    // Beyond its rim it falls off by 45 degrees.
    let room = (of_lower.high[2] - sheets[lower].table()).max(0.0) + FAR;
    of_lower.grown([room; 3]).overlaps_in_plan(&of_upper)
}

/// The upper sides of what a sheet may lie upon.
fn under(
    sheets: &mut [&mut TornLeaf],
    lower: &[usize],
    sheet: usize,
    book: &Book,
) -> Vec<Rc<Relief>> {
    let mut under = Vec::new();
    for other in lower {
        if are_near(sheets, *other, sheet) {
            under.push(sheets[*other].renew_relief(book));
        }
    }
    under
}

/// A sheet, the first of `order`, has moved: what is near it and comes after it in the order meets
/// it where it is now, and goes on moving.
fn move_upon(sheets: &mut [&mut TornLeaf], order: &[usize], book: &Book, under: &[Rc<Relief>]) {
    let Some((sheet, upper)) = order.split_first() else {
        return;
    };
    if !upper.iter().any(|other| are_near(sheets, *sheet, *other)) {
        return;
    }
    sheets[*sheet].update_over(book, under);
    let before = sheets[*sheet].relief(book);
    let now = sheets[*sheet].renew_relief(book);
    if !Rc::ptr_eq(&before, &now) {
        wake_near(sheets, upper, &before);
        wake_near(sheets, upper, &now);
    }
}

/// Wakes sheets that lie over or beside another.
fn wake_near(sheets: &mut [&mut TornLeaf], others: &[usize], relief: &Relief) {
    for other in others {
        if relief.is_near(&sheets[*other].node_bounds()) {
            sheets[*other].wake();
        }
    }
}
