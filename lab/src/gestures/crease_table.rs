//! The figures of folds and tears beside those of all gestures, as a table.

use std::collections::BTreeMap;

use super::crease_figures::CreaseFigures;
use super::figures::Figures;
use crate::table::Table;

/// A figure of gestures, and those of their folds and tears.
type Figure = fn(&Figures, &CreaseFigures) -> f64;

/// Rows of the table: what, the figure, by how much it is multiplied, its decimals.
const ROWS: [(&str, Figure, f64, usize); 32] = [
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
        "gestures in which that is more than 1 mm, %",
        |_, c| c.at_rest_far_in_itself_fraction,
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
