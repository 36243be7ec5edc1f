//! What random gestures did, in figures.

use std::collections::BTreeMap;

use serde::Serialize;

use super::crease_figures::CreaseFigures;
use super::overlap::TOO_DEEP;
use super::played::Played;
use super::scene::Outcome;
use super::world::STOCKS;
use crate::table::Table;

/// What is drawn farther than this behind the paper is counted as behind; millimetres on a
/// page 140 mm wide, as all lengths here.
const BEHIND: f32 = 1.0;

/// A figure of some gestures.
type Figure = fn(&Figures) -> f64;

/// Rows of the table: what, the figure, by how much it is multiplied, its decimals.
const ROWS: [(&str, Figure, f64, usize); 26] = [
    ("gestures", |f| f.count as f64, 1.0, 0),
    (
        "edge strain, median, %",
        |f| f.edge_strain_median.into(),
        100.0,
        4,
    ),
    (
        "the same, 99th percentile",
        |f| f.edge_strain_p99.into(),
        100.0,
        3,
    ),
    ("the same, worst", |f| f.edge_strain_worst.into(), 100.0, 3),
    (
        "half a second after release, worst, %",
        |f| f.edge_strain_after_release.into(),
        100.0,
        3,
    ),
    (
        "while eased flat, worst, %",
        |f| f.edge_strain_eased.into(),
        100.0,
        3,
    ),
    (
        "shear, 99th percentile, degrees",
        |f| f.shear_p99_degrees.into(),
        1.0,
        1,
    ),
    ("the same, worst", |f| f.shear_worst_degrees.into(), 1.0, 1),
    (
        "of leaves that no hand touched, worst",
        |f| f.shear_played_degrees.into(),
        1.0,
        1,
    ),
    (
        "diagonals, 99th percentile, %",
        |f| f.diagonal_p99.into(),
        100.0,
        2,
    ),
    ("the same, worst", |f| f.diagonal_worst.into(), 100.0, 2),
    (
        "of leaves that no hand touched, worst",
        |f| f.diagonal_played.into(),
        100.0,
        2,
    ),
    (
        "drawn inside another leaf, worst, mm",
        |f| f.drawn_penetration_in_leaves_mm.into(),
        1.0,
        3,
    ),
    (
        "drawn inside itself, worst, mm",
        |f| f.drawn_penetration_in_itself_mm.into(),
        1.0,
        3,
    ),
    (
        "drawn inside block, cover or table, worst, mm",
        |f| f.drawn_penetration_in_piles_mm.into(),
        1.0,
        3,
    ),
    (
        "gestures that draw deeper than 0.1 mm, %",
        |f| f.drawn_too_deep_fraction,
        100.0,
        2,
    ),
    (
        "depth in the solver, worst, mm",
        |f| f.solver_penetration_mm.into(),
        1.0,
        2,
    ),
    (
        "frames drawn over 1 mm behind the paper, %",
        |f| f.frames_behind_fraction,
        100.0,
        2,
    ),
    (
        "drawn behind the paper, worst, mm",
        |f| f.drawn_behind_worst_mm.into(),
        1.0,
        0,
    ),
    (
        "CPU of a frame, worst, ms",
        |f| f.cpu_ms_per_frame_worst.into(),
        1.0,
        0,
    ),
    (
        "the same counted by what is done, worst, ms",
        |f| f.work_per_frame_worst as f64,
        1e-6,
        0,
    ),
    (
        "CPU of what is drawn in a frame, worst, ms",
        |f| f.cpu_ms_per_update_worst.into(),
        1.0,
        0,
    ),
    (
        "all at rest after release, median, s",
        |f| f.seconds_to_rest_median.into(),
        1.0,
        2,
    ),
    (
        "the same, worst",
        |f| f.seconds_to_rest_worst.into(),
        1.0,
        2,
    ),
    (
        "all at rest after the first tick, worst, s",
        |f| f.seconds_to_rest_from_start_worst.into(),
        1.0,
        2,
    ),
    (
        "leaves put down after 2.5 s, %",
        |f| f.put_down_fraction,
        100.0,
        2,
    ),
];

/// A figure of one gesture, by which the worst are ranked.
type Ranked = fn(&Outcome) -> f32;

/// The figures by which the worst gestures are named.
const WORST: [(&str, Ranked); 15] = [
    ("edge_strain", |outcome| outcome.strain),
    ("edge_strain_after_release", |outcome| outcome.strain_after),
    ("edge_strain_eased", |outcome| outcome.strain_eased),
    ("shear", |outcome| outcome.shear),
    ("shear_played", |outcome| outcome.shear_played),
    ("drawn_in_itself", |outcome| outcome.drawn.itself),
    ("drawn_in_piles", |outcome| outcome.drawn.pile),
    ("drawn_in_leaves", |outcome| outcome.drawn.leaf),
    ("drawn_behind", |outcome| {
        outcome.lags.iter().copied().fold(0.0, f32::max)
    }),
    ("solver", |outcome| outcome.depth),
    ("seconds_to_rest", |outcome| outcome.rest),
    ("not_finite", |outcome| f32::from(!outcome.finite)),
    ("put_down", |outcome| outcome.put_down as f32),
    ("cpu_of_a_frame", |outcome| outcome.frame as f32),
    ("cpu_of_an_update", |outcome| outcome.update as f32),
];

/// Those of folds and tears.
const WORST_CREASES: [(&str, Ranked); 6] = [
    ("folded_in_itself_at_rest", |outcome| {
        outcome
            .creases
            .map_or(0.0, |creases| creases.at_rest.itself)
    }),
    ("folds_off_their_rest", |outcome| {
        outcome.creases.map_or(0.0, |creases| creases.rests_off)
    }),
    ("torn_strain", |outcome| {
        outcome.creases.map_or(0.0, |creases| creases.torn.strain)
    }),
    ("torn_in_piles", |outcome| {
        outcome.creases.map_or(0.0, |creases| creases.torn.pile)
    }),
    ("torn_in_itself", |outcome| {
        outcome.creases.map_or(0.0, |creases| creases.torn.itself)
    }),
    ("work_of_tearing", |outcome| {
        outcome
            .creases
            .map_or(0.0, |creases| creases.torn.work_off as f32)
    }),
];

/// The figures of some gestures.
#[derive(Serialize)]
pub struct Figures {
    /// How many gestures these are.
    pub count: usize,
    edge_strain_median: f32,
    /// Largest edge strain that 99 of 100 gestures stay below.
    pub edge_strain_p99: f32,
    /// Largest edge strain of all.
    pub edge_strain_worst: f32,
    edge_strain_after_release: f32,
    /// Largest edge strain of a leaf that is being eased flat.
    pub edge_strain_eased: f32,
    shear_p99_degrees: f32,
    shear_worst_degrees: f32,
    shear_played_degrees: f32,
    diagonal_p99: f32,
    diagonal_worst: f32,
    diagonal_played: f32,
    drawn_penetration_mm: f32,
    drawn_penetration_median_mm: f32,
    drawn_penetration_p99_mm: f32,
    /// The deepest that a leaf is drawn in a pile or under a board.
    pub drawn_penetration_in_piles_mm: f32,
    /// The deepest that one is drawn in another.
    pub drawn_penetration_in_leaves_mm: f32,
    /// The deepest that one is drawn in itself.
    pub drawn_penetration_in_itself_mm: f32,
    drawn_too_deep_fraction: f64,
    edges_through_facets: usize,
    solver_penetration_mm: f32,
    solver_penetration_median_mm: f32,
    solver_penetration_p90_mm: f32,
    solver_penetration_p99_mm: f32,
    /// Part of the frames in which a leaf is drawn more than a millimetre behind its paper.
    pub frames_behind_fraction: f64,
    drawn_behind_p99_mm: f32,
    drawn_behind_worst_mm: f32,
    /// From when all were let go until all lay still: the median.
    pub seconds_to_rest_median: f32,
    /// The same: the longest.
    pub seconds_to_rest_worst: f32,
    seconds_to_rest_from_start_median: f32,
    seconds_to_rest_from_start_worst: f32,
    landed: u32,
    put_down: u32,
    /// Part of the leaves that came to rest which were put down.
    pub put_down_fraction: f64,
    /// Whether all came to lie still.
    pub at_rest: bool,
    /// Whether all that is drawn was a number.
    pub finite: bool,
    leaves: usize,
    us_per_frame_p50: f32,
    /// Microseconds of CPU that 99 of 100 frames stay below.
    pub us_per_frame_p99: f32,
    us_per_frame_by_leaves: Vec<FrameTimes>,
    /// Most milliseconds of CPU of a frame.
    pub cpu_ms_per_frame_worst: f32,
    cpu_ms_per_update_worst: f32,
    update_work_worst: usize,
    /// Most work of a frame, in about nanoseconds, as it is counted.
    pub work_per_frame_worst: usize,
    cpu_ms_per_tick_worst: f32,
    /// What folds and tears did; None where leaves were whole.
    #[serde(flatten)]
    pub creases: Option<CreaseFigures>,
}

/// Times of the frames in which so many leaves were in flight.
#[derive(Serialize)]
struct FrameTimes {
    leaves: usize,
    frames: usize,
    us_per_frame_p50: f32,
    us_per_frame_p99: f32,
}

impl Figures {
    /// Those of some gestures.
    pub fn of(played: &[&Played]) -> Figures {
        let outcomes = || played.iter().map(|one| &one.outcome);
        let of = |value: fn(&Outcome) -> f32| Sorted::new(outcomes().map(value));
        let most = |value: fn(&Outcome) -> f32| of(value).at(1.0);
        let highest = |value: fn(&Outcome) -> usize| outcomes().map(value).max().unwrap_or(0);
        let strain = of(|outcome| outcome.strain);
        let shear = of(|outcome| outcome.shear.to_degrees());
        let diagonal = of(|outcome| outcome.diagonal);
        let drawn = of(|outcome| 1e3 * outcome.drawn.deepest());
        let depth = of(|outcome| 1e3 * outcome.depth);
        let lags =
            Sorted::new(outcomes().flat_map(|outcome| outcome.lags.iter().map(|lag| 1e3 * lag)));
        let rest = of(|outcome| outcome.rest);
        let from_start = of(|outcome| outcome.rest_from_start);
        let landed: u32 = outcomes().map(|outcome| outcome.landed).sum();
        let put_down: u32 = outcomes().map(|outcome| outcome.put_down).sum();
        let frames = || outcomes().flat_map(|outcome| outcome.frames.iter());
        let times = |leaves: Option<usize>| {
            let of = frames().filter(|frame| leaves.is_none_or(|leaves| frame.0 == leaves));
            Sorted::new(of.map(|frame| frame.1 as f32 * 1e6))
        };
        let all_times = times(None);
        let by_leaves = |leaves: usize| {
            let times = times(Some(leaves));
            FrameTimes {
                leaves,
                frames: times.0.len(),
                us_per_frame_p50: times.at(0.5),
                us_per_frame_p99: times.at(0.99),
            }
        };
        let most_leaves = frames().map(|frame| frame.0).max().unwrap_or(0);
        Figures {
            count: played.len(),
            edge_strain_median: strain.at(0.5),
            edge_strain_p99: strain.at(0.99),
            edge_strain_worst: strain.at(1.0),
            edge_strain_after_release: most(|outcome| outcome.strain_after),
            edge_strain_eased: most(|outcome| outcome.strain_eased),
            shear_p99_degrees: shear.at(0.99),
            shear_worst_degrees: shear.at(1.0),
            shear_played_degrees: most(|outcome| outcome.shear_played.to_degrees()),
            diagonal_p99: diagonal.at(0.99),
            diagonal_worst: diagonal.at(1.0),
            diagonal_played: most(|outcome| outcome.diagonal_played),
            drawn_penetration_mm: drawn.at(1.0),
            drawn_penetration_median_mm: drawn.at(0.5),
            drawn_penetration_p99_mm: drawn.at(0.99),
            drawn_penetration_in_piles_mm: most(|outcome| 1e3 * outcome.drawn.pile),
            drawn_penetration_in_leaves_mm: most(|outcome| 1e3 * outcome.drawn.leaf),
            drawn_penetration_in_itself_mm: most(|outcome| 1e3 * outcome.drawn.itself),
            drawn_too_deep_fraction: drawn.part_above(TOO_DEEP),
            edges_through_facets: highest(|outcome| outcome.drawn.crossings),
            solver_penetration_mm: depth.at(1.0),
            solver_penetration_median_mm: depth.at(0.5),
            solver_penetration_p90_mm: depth.at(0.9),
            solver_penetration_p99_mm: depth.at(0.99),
            frames_behind_fraction: lags.part_above(BEHIND),
            drawn_behind_p99_mm: lags.at(0.99),
            drawn_behind_worst_mm: lags.at(1.0),
            seconds_to_rest_median: rest.at(0.5),
            seconds_to_rest_worst: rest.at(1.0),
            seconds_to_rest_from_start_median: from_start.at(0.5),
            seconds_to_rest_from_start_worst: from_start.at(1.0),
            landed,
            put_down,
            put_down_fraction: f64::from(put_down) / f64::from(landed.max(1)),
            at_rest: outcomes().all(|outcome| outcome.at_rest),
            finite: outcomes().all(|outcome| outcome.finite),
            leaves: highest(|outcome| outcome.leaves),
            us_per_frame_p50: all_times.at(0.5),
            us_per_frame_p99: all_times.at(0.99),
            us_per_frame_by_leaves: (1..=most_leaves).map(by_leaves).collect(),
            cpu_ms_per_frame_worst: most(|outcome| 1e3 * outcome.frame as f32),
            cpu_ms_per_update_worst: most(|outcome| 1e3 * outcome.update as f32),
            update_work_worst: highest(|outcome| outcome.update_work as usize),
            work_per_frame_worst: highest(|outcome| outcome.frame_work as usize),
            cpu_ms_per_tick_worst: most(|outcome| 1e3 * outcome.tick as f32),
            creases: CreaseFigures::of(played.iter().map(|one| &one.outcome)),
        }
    }
}

/// Figures by name as the columns of a table, beside those of all.
pub fn table(seed: u64, all: &Figures, parts: &BTreeMap<&str, Figures>) -> Table {
    let columns: Vec<&Figures> = [all].into_iter().chain(parts.values()).collect();
    let title = format!("from seed {seed}");
    let headings: Vec<&str> = { [title.as_str(), "all"].into_iter() }
        .chain(parts.keys().copied())
        .collect();
    let mut table = Table::new(&headings);
    let mut push = |title: &str, cell: &dyn Fn(&Figures) -> String| {
        let cells = columns.iter().map(|figures| cell(figures));
        table.push([title.into()].into_iter().chain(cells).collect());
    };
    for (title, figure, times, decimals) in ROWS {
        push(title, &|figures| {
            format!("{:.decimals$}", times * figure(figures))
        });
    }
    let yes = |is: bool| if is { "yes".into() } else { "no".into() };
    push("all at rest", &|figures| yes(figures.at_rest));
    push("all finite", &|figures| yes(figures.finite));
    table
}

/// A gesture that is among the worst: its seed, stock, kind and figure.
pub type Worst = (u64, &'static str, &'static str, f32);

/// The worst gestures by each figure.
pub fn worst(all: &[&Played], count: usize) -> BTreeMap<&'static str, Vec<Worst>> {
    let has_creases = all.iter().any(|one| one.outcome.creases.is_some());
    let creases = if has_creases { &WORST_CREASES[..] } else { &[] };
    let by = |&(name, value): &(&'static str, Ranked)| {
        let mut order: Vec<&&Played> = all.iter().collect();
        order.sort_by(|a, b| value(&b.outcome).total_cmp(&value(&a.outcome)));
        let row = |one: &&Played| {
            let value = value(&one.outcome);
            (one.seed, STOCKS[one.stock], one.kind.name(), value)
        };
        (name, order.into_iter().take(count).map(row).collect())
    };
    WORST.iter().chain(creases).map(by).collect()
}

/// Values from the least to the most.
struct Sorted(Vec<f32>);

impl Sorted {
    fn new(values: impl Iterator<Item = f32>) -> Sorted {
        let mut values: Vec<f32> = values.collect();
        values.sort_by(f32::total_cmp);
        Sorted(values)
    }

    /// The value below which a part of them lies; 0 where there are none.
    fn at(&self, part: f32) -> f32 {
        let last = self.0.len().saturating_sub(1) as f32;
        let value = self.0.get((part * last).round() as usize);
        value.copied().unwrap_or(0.0)
    }

    /// The part of them that lies above a bound.
    fn part_above(&self, bound: f32) -> f64 {
        let above = self.0.iter().filter(|value| **value > bound).count();
        above as f64 / self.0.len().max(1) as f64
    }
}
