//! What random gestures did to folded and torn leaves, in figures.

use std::collections::BTreeMap;

use serde::Serialize;

use super::creasing::CreaseOutcome;
use super::figures::{Figures, TOO_DEEP};
use super::scene::Outcome;
use crate::table::Table;

/// Figures of folds and tears. Lengths are those on a page 140 mm wide.
#[derive(Clone, Debug, Serialize)]
pub struct CreaseFigures {
    folds_made: u32,
    folds_rejected: u32,
    rests_off_degrees: f32,
    rests_off_held_degrees: f32,
    at_rest_in_itself_mm: f32,
    at_rest_in_leaves_mm: f32,
    at_rest_in_piles_mm: f32,
    at_rest_in_itself_fraction: f64,
    in_others_fraction: f64,
    in_itself_fraction: f64,
    torn_off: u32,
    torn_cut: u32,
    torn_strain_worst: f32,
    torn_in_piles_mm: f32,
    torn_in_itself_mm: f32,
    torn_through_leaves_fraction: f64,
    torn_work_off: f64,
    torn_left_fraction: f64,
}

impl CreaseFigures {
    /// Those of some gestures; None where leaves were whole.
    pub fn of<'a>(outcomes: impl Iterator<Item = &'a Outcome> + Clone) -> Option<CreaseFigures> {
        let all = || {
            outcomes
                .clone()
                .filter_map(|outcome| outcome.creases.as_ref())
        };
        let count = all().count();
        if count == 0 {
            return None;
        }
        let sum = |of: fn(&CreaseOutcome) -> u32| all().map(of).sum::<u32>();
        let most = |of: fn(&CreaseOutcome) -> f32| all().map(of).fold(0.0, f32::max);
        let part = |of: u32, whole: u32| f64::from(of) / f64::from(whole.max(1));
        let gestures = |is: &dyn Fn(&Outcome, &CreaseOutcome) -> bool| {
            let pairs = outcomes
                .clone()
                .filter_map(|one| Some((one, one.creases.as_ref()?)));
            pairs.filter(|(one, creases)| is(one, creases)).count() as f64 / count as f64
        };
        let deep = |metres: f32| 1e3 * metres > TOO_DEEP;
        let left = sum(|one| one.torn.left);
        Some(CreaseFigures {
            folds_made: sum(|one| one.made),
            folds_rejected: sum(|one| one.rejected),
            rests_off_degrees: most(|one| one.rests_off).to_degrees(),
            rests_off_held_degrees: most(|one| one.rests_off_held).to_degrees(),
            at_rest_in_itself_mm: 1e3 * most(|one| one.at_rest.itself),
            at_rest_in_leaves_mm: 1e3 * most(|one| one.at_rest.leaf),
            at_rest_in_piles_mm: 1e3 * most(|one| one.at_rest.pile),
            at_rest_in_itself_fraction: gestures(&|_, creases| deep(creases.at_rest.itself)),
            in_others_fraction: gestures(&|one, _| deep(one.drawn.leaf.max(one.drawn.pile))),
            in_itself_fraction: gestures(&|one, _| deep(one.drawn.itself)),
            torn_off: sum(|one| one.torn.off),
            torn_cut: sum(|one| one.torn.cut),
            torn_strain_worst: most(|one| one.torn.strain),
            torn_in_piles_mm: 1e3 * most(|one| one.torn.pile),
            torn_in_itself_mm: 1e3 * most(|one| one.torn.itself),
            torn_through_leaves_fraction: part(
                sum(|one| one.torn.through),
                sum(|one| one.torn.pictures),
            ),
            torn_work_off: all().map(|one| one.torn.work_off).fold(0.0, f64::max),
            torn_left_fraction: part(left, left + sum(|one| one.torn.still)),
        })
    }
}

/// A figure of gestures, and those of their folds and tears.
type Figure = fn(&Figures, &CreaseFigures) -> f64;

/// Rows of the table: what, the figure, by how much it is multiplied, its decimals.
const ROWS: [(&str, Figure, f64, usize); 31] = [
    ("gestures", |f, _| f.count as f64, 1.0, 0),
    ("folds made", |_, c| c.folds_made.into(), 1.0, 0),
    (
        "folds that leaves have too few nodes for",
        |_, c| c.folds_rejected.into(),
        1.0,
        0,
    ),
    (
        "edge strain, 99th percentile, %",
        |f, _| f.edge_strain_p99.into(),
        100.0,
        3,
    ),
    (
        "the same, worst",
        |f, _| f.edge_strain_worst.into(),
        100.0,
        3,
    ),
    (
        "while eased flat, worst, %",
        |f, _| f.edge_strain_eased.into(),
        100.0,
        3,
    ),
    (
        "drawn inside another leaf, worst, mm",
        |f, _| f.drawn_penetration_in_leaves_mm.into(),
        1.0,
        3,
    ),
    (
        "drawn inside block, cover or table, worst, mm",
        |f, _| f.drawn_penetration_in_piles_mm.into(),
        1.0,
        3,
    ),
    (
        "gestures that draw deeper than 0.1 mm in either, %",
        |_, c| c.in_others_fraction,
        100.0,
        2,
    ),
    (
        "drawn inside itself at rest, worst, mm",
        |_, c| c.at_rest_in_itself_mm.into(),
        1.0,
        3,
    ),
    (
        "gestures in which that is more than 0.1 mm, %",
        |_, c| c.at_rest_in_itself_fraction,
        100.0,
        2,
    ),
    (
        "drawn inside itself in flight too, worst, mm",
        |f, _| f.drawn_penetration_in_itself_mm.into(),
        1.0,
        3,
    ),
    (
        "gestures in which that is more than 0.1 mm, %",
        |_, c| c.in_itself_fraction,
        100.0,
        2,
    ),
    (
        "drawn at rest inside another leaf, worst, mm",
        |_, c| c.at_rest_in_leaves_mm.into(),
        1.0,
        3,
    ),
    (
        "drawn at rest inside block, cover or table, worst, mm",
        |_, c| c.at_rest_in_piles_mm.into(),
        1.0,
        3,
    ),
    (
        "rest of creases that no hand held, off by at most, degrees",
        |_, c| c.rests_off_degrees.into(),
        1.0,
        2,
    ),
    (
        "rest of creases of held leaves, changed by at most, degrees",
        |_, c| c.rests_off_held_degrees.into(),
        1.0,
        0,
    ),
    (
        "frames drawn over 1 mm behind the paper, %",
        |f, _| f.frames_behind_fraction,
        100.0,
        2,
    ),
    (
        "CPU of a frame, 99th percentile, ms",
        |f, _| f.us_per_frame_p99.into(),
        1e-3,
        1,
    ),
    (
        "the same, worst",
        |f, _| f.cpu_ms_per_frame_worst.into(),
        1.0,
        0,
    ),
    (
        "the same counted by what is done, worst, ms",
        |f, _| f.work_per_frame_worst as f64,
        1e-6,
        0,
    ),
    (
        "all at rest after release, median, s",
        |f, _| f.seconds_to_rest_median.into(),
        1.0,
        2,
    ),
    (
        "the same, worst",
        |f, _| f.seconds_to_rest_worst.into(),
        1.0,
        2,
    ),
    (
        "leaves put down after 2.5 s, %",
        |f, _| f.put_down_fraction,
        100.0,
        2,
    ),
    (
        "leaves torn off by a pull, and cut",
        |_, c| (c.torn_off + c.torn_cut).into(),
        1.0,
        0,
    ),
    (
        "torn leaf, edge strain, worst, %",
        |_, c| c.torn_strain_worst.into(),
        100.0,
        3,
    ),
    (
        "torn leaf, drawn inside pages, boards or table, worst, mm",
        |_, c| c.torn_in_piles_mm.into(),
        1.0,
        3,
    ),
    (
        "torn leaf, drawn inside itself, worst, mm",
        |_, c| c.torn_in_itself_mm.into(),
        1.0,
        3,
    ),
    (
        "pictures of torn leaves that go through a leaf, %",
        |_, c| c.torn_through_leaves_fraction,
        100.0,
        2,
    ),
    (
        "work of tearing, off the sum of G t l by at most, %",
        |_, c| c.torn_work_off,
        100.0,
        4,
    ),
    (
        "torn leaves left as they lay after 4 s, %",
        |_, c| c.torn_left_fraction,
        100.0,
        2,
    ),
];

/// Figures by name as the columns of a table, beside those of all.
pub fn table(seed: u64, all: &Figures, parts: &BTreeMap<&str, Figures>) -> Table {
    let named = parts.iter().map(|(name, figures)| (*name, figures));
    let columns: Vec<(&str, &Figures)> = [("all", all)].into_iter().chain(named).collect();
    let title = format!("from seed {seed}");
    let headings = columns.iter().map(|(name, _)| *name);
    let mut table = Table::new(
        &[title.as_str()]
            .into_iter()
            .chain(headings)
            .collect::<Vec<_>>(),
    );
    let mut push = |title: &str, cell: &dyn Fn(&Figures, &CreaseFigures) -> String| {
        let cells = columns.iter().map(|(_, figures)| match &figures.creases {
            Some(creases) => cell(figures, creases),
            // No gesture was of this kind.
            None => String::new(),
        });
        table.push([title.into()].into_iter().chain(cells).collect());
    };
    for (title, figure, times, decimals) in ROWS {
        push(title, &|figures, creases| {
            format!("{:.decimals$}", times * figure(figures, creases))
        });
    }
    let yes = |is: bool| if is { "yes".into() } else { "no".into() };
    push("all at rest", &|figures, _| yes(figures.at_rest));
    push("all finite", &|figures, _| yes(figures.finite));
    table
}
