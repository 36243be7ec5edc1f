//! What random gestures did, in figures.

use serde_json::{Value, json};

use super::played::Played;
use super::scene::Outcome;
use super::world::STOCKS;
use crate::report;

/// What is drawn farther than this behind the paper is counted as behind; millimetres on a
/// page 140 mm wide, as all lengths here.
const BEHIND: f32 = 1.0;

/// What is drawn deeper than this in anything is too deep.
const TOO_DEEP: f32 = 0.1;

/// Rows of the table: what, the figure, by how much it is multiplied, its decimals.
const ROWS: [(&str, &str, f64, usize); 25] = [
    ("gestures", "count", 1.0, 0),
    ("edge strain, median, %", "edge_strain_median", 100.0, 4),
    ("the same, 99th percentile", "edge_strain_p99", 100.0, 3),
    ("the same, worst", "edge_strain_worst", 100.0, 3),
    (
        "half a second after release, worst, %",
        "edge_strain_after_release",
        100.0,
        3,
    ),
    ("while eased flat, worst, %", "edge_strain_eased", 100.0, 3),
    (
        "shear, 99th percentile, degrees",
        "shear_p99_degrees",
        1.0,
        1,
    ),
    ("the same, worst", "shear_worst_degrees", 1.0, 1),
    (
        "of leaves that no hand touched, worst",
        "shear_played_degrees",
        1.0,
        1,
    ),
    ("diagonals, 99th percentile, %", "diagonal_p99", 100.0, 2),
    ("the same, worst", "diagonal_worst", 100.0, 2),
    (
        "of leaves that no hand touched, worst",
        "diagonal_played",
        100.0,
        2,
    ),
    (
        "drawn inside another leaf, worst, mm",
        "drawn_penetration_in_leaves_mm",
        1.0,
        3,
    ),
    (
        "drawn inside itself, worst, mm",
        "drawn_penetration_in_itself_mm",
        1.0,
        3,
    ),
    (
        "drawn inside block, cover or table, worst, mm",
        "drawn_penetration_in_piles_mm",
        1.0,
        3,
    ),
    (
        "gestures that draw deeper than 0.1 mm, %",
        "drawn_too_deep_share",
        100.0,
        2,
    ),
    (
        "depth in the solver, worst, mm",
        "solver_penetration_mm",
        1.0,
        2,
    ),
    (
        "frames drawn over 1 mm behind the paper, %",
        "frames_behind_share",
        100.0,
        2,
    ),
    (
        "drawn behind the paper, worst, mm",
        "drawn_behind_worst_mm",
        1.0,
        0,
    ),
    (
        "CPU of a frame, worst, ms",
        "cpu_ms_per_frame_worst",
        1.0,
        0,
    ),
    (
        "CPU of what is drawn in a frame, worst, ms",
        "cpu_ms_per_update_worst",
        1.0,
        0,
    ),
    (
        "all at rest after release, median, s",
        "seconds_to_rest_median",
        1.0,
        2,
    ),
    ("the same, worst", "seconds_to_rest_worst", 1.0, 2),
    (
        "all at rest after the first tick, worst, s",
        "seconds_to_rest_from_start_worst",
        1.0,
        2,
    ),
    ("leaves put down after 2.5 s, %", "put_down_share", 100.0, 2),
];

/// The figures that are wanted, all, by stock and by kind, as tables in Markdown.
pub fn tables(report: &Value) -> String {
    let [stocks, kinds] = ["stocks", "kinds"].map(|by| table(report, by));
    format!("{stocks}\n\n{kinds}")
}

fn table(report: &Value, by: &str) -> String {
    let parts = report[by].as_object().expect("figures by stock or kind");
    let of = parts.iter().map(|(name, figures)| (name.as_str(), figures));
    let columns: Vec<(&str, &Value)> = [("all", report)].into_iter().chain(of).collect();
    let mut rows = vec![vec![format!("from seed {}", report["seed"])]];
    rows[0].extend(columns.iter().map(|(name, _)| (*name).to_owned()));
    for (title, name, times, decimals) in ROWS {
        let cells = columns.iter().map(|(_, figures)| {
            let value = figures[name].as_f64().expect("a figure") * times;
            format!("{value:.decimals$}")
        });
        rows.push([title.to_owned()].into_iter().chain(cells).collect());
    }
    for (title, name) in [("all at rest", "at_rest"), ("all finite", "finite")] {
        let yes = |figures: &Value| {
            if figures[name] == json!(true) {
                "yes"
            } else {
                "no"
            }
        };
        let cells = columns.iter().map(|(_, figures)| yes(figures).to_owned());
        rows.push([title.to_owned()].into_iter().chain(cells).collect());
    }
    report::table(&rows, true)
}

/// The figures of some gestures.
pub fn figures(played: &[&Played]) -> Value {
    let mut all = serde_json::Map::new();
    for part in [strains, penetrations, rest, frames] {
        if let Value::Object(figures) = part(played) {
            all.extend(figures);
        }
    }
    all.into()
}

/// A figure of each gesture, from the least to the most.
fn of(played: &[&Played], value: fn(&Outcome) -> f32) -> Vec<f32> {
    sorted(played.iter().map(|one| value(&one.outcome)).collect())
}

fn most(played: &[&Played], value: fn(&Outcome) -> f32) -> f32 {
    of(played, value).last().copied().unwrap_or(0.0)
}

fn strains(played: &[&Played]) -> Value {
    let strains = of(played, |outcome| outcome.strain);
    let shears = of(played, |outcome| outcome.shear.to_degrees());
    let diagonals = of(played, |outcome| outcome.diagonal);
    json!({
        "count": played.len(),
        "edge_strain_median": at(&strains, 0.5),
        "edge_strain_p99": at(&strains, 0.99),
        "edge_strain_worst": at(&strains, 1.0),
        "edge_strain_after_release": most(played, |outcome| outcome.strain_after),
        "edge_strain_eased": most(played, |outcome| outcome.strain_eased),
        "shear_p99_degrees": at(&shears, 0.99),
        "shear_worst_degrees": at(&shears, 1.0),
        "shear_played_degrees": most(played, |outcome| outcome.shear_played.to_degrees()),
        "diagonal_p99": at(&diagonals, 0.99),
        "diagonal_worst": at(&diagonals, 1.0),
        "diagonal_played": most(played, |outcome| outcome.diagonal_played),
    })
}

fn penetrations(played: &[&Played]) -> Value {
    let drawn = of(played, |outcome| 1e3 * outcome.drawn.deepest());
    let depths = of(played, |outcome| 1e3 * outcome.depth);
    let lags = played.iter().flat_map(|one| one.outcome.lags.iter());
    let lags = sorted(lags.map(|lag| 1e3 * lag).collect());
    let behind = lags.iter().filter(|lag| **lag > BEHIND).count();
    let too_deep = drawn.iter().filter(|depth| **depth > TOO_DEEP).count();
    json!({
        "drawn_penetration_mm": at(&drawn, 1.0),
        "drawn_penetration_median_mm": at(&drawn, 0.5),
        "drawn_penetration_p99_mm": at(&drawn, 0.99),
        "drawn_penetration_in_piles_mm": 1e3 * most(played, |outcome| outcome.drawn.pile),
        "drawn_penetration_in_leaves_mm": 1e3 * most(played, |outcome| outcome.drawn.leaf),
        "drawn_penetration_in_itself_mm": 1e3 * most(played, |outcome| outcome.drawn.itself),
        "drawn_too_deep_share": too_deep as f64 / played.len().max(1) as f64,
        "edges_through_facets": most(played, |outcome| outcome.drawn.crossings as f32),
        "solver_penetration_mm": at(&depths, 1.0),
        "solver_penetration_median_mm": at(&depths, 0.5),
        "solver_penetration_p90_mm": at(&depths, 0.9),
        "solver_penetration_p99_mm": at(&depths, 0.99),
        "frames_behind_share": behind as f64 / lags.len().max(1) as f64,
        "drawn_behind_p99_mm": at(&lags, 0.99),
        "drawn_behind_worst_mm": at(&lags, 1.0),
    })
}

fn rest(played: &[&Played]) -> Value {
    let sum = |value: fn(&Outcome) -> u32| {
        let values = played.iter().map(|one| value(&one.outcome));
        values.sum::<u32>()
    };
    let landed = sum(|outcome| outcome.landed);
    let put_down = sum(|outcome| outcome.put_down);
    let rest = of(played, |outcome| outcome.rest);
    let from_start = of(played, |outcome| outcome.rest_from_start);
    json!({
        "seconds_to_rest_median": at(&rest, 0.5),
        "seconds_to_rest_worst": at(&rest, 1.0),
        "seconds_to_rest_from_start_median": at(&from_start, 0.5),
        "seconds_to_rest_from_start_worst": at(&from_start, 1.0),
        "landed": landed,
        "put_down": put_down,
        "put_down_share": f64::from(put_down) / f64::from(landed.max(1)),
        "at_rest": played.iter().all(|one| one.outcome.at_rest),
        "finite": played.iter().all(|one| one.outcome.finite),
    })
}

fn frames(played: &[&Played]) -> Value {
    let frames = || played.iter().flat_map(|one| one.outcome.frames.iter());
    let times = sorted(frames().map(|frame| frame.1 as f32 * 1e6).collect());
    let leaves = frames().map(|frame| frame.0).max().unwrap_or(0);
    let by_leaves: Vec<Value> = (1..=leaves)
        .map(|leaves| {
            let of = frames().filter(|frame| frame.0 == leaves);
            let times = sorted(of.map(|frame| frame.1 as f32 * 1e6).collect());
            json!({ "leaves": leaves, "frames": times.len(),
                "us_per_frame_p50": at(&times, 0.5), "us_per_frame_p99": at(&times, 0.99) })
        })
        .collect();
    json!({
        "leaves": played.iter().map(|one| one.outcome.leaves).max(),
        "us_per_frame_p50": at(&times, 0.5),
        "us_per_frame_p99": at(&times, 0.99),
        "us_per_frame_by_leaves": by_leaves,
        "cpu_ms_per_frame_worst": most(played, |outcome| 1e3 * outcome.frame as f32),
        "cpu_ms_per_update_worst": most(played, |outcome| 1e3 * outcome.update as f32),
        "update_work_worst": played.iter().map(|one| one.outcome.update_work).max(),
        "cpu_ms_per_tick_worst": most(played, |outcome| 1e3 * outcome.tick as f32),
    })
}

/// The seeds of the worst gestures by each figure.
pub fn worst_seeds(all: &[&Played], count: usize) -> Value {
    let by = |value: fn(&Outcome) -> f32| -> Value {
        let mut order: Vec<&&Played> = all.iter().collect();
        order.sort_by(|a, b| value(&b.outcome).total_cmp(&value(&a.outcome)));
        let worst = order.iter().take(count);
        worst
            .map(|one| {
                json!([
                    one.seed,
                    STOCKS[one.stock],
                    one.kind.name(),
                    value(&one.outcome)
                ])
            })
            .collect()
    };
    json!({
        "edge_strain": by(|outcome| outcome.strain),
        "edge_strain_after_release": by(|outcome| outcome.strain_after),
        "edge_strain_eased": by(|outcome| outcome.strain_eased),
        "shear": by(|outcome| outcome.shear),
        "shear_played": by(|outcome| outcome.shear_played),
        "drawn_in_itself": by(|outcome| outcome.drawn.itself),
        "drawn_in_piles": by(|outcome| outcome.drawn.pile),
        "drawn_in_leaves": by(|outcome| outcome.drawn.leaf),
        "drawn_behind": by(|outcome| outcome.lags.iter().copied().fold(0.0, f32::max)),
        "solver": by(|outcome| outcome.depth),
        "seconds_to_rest": by(|outcome| outcome.rest),
        "not_finite": by(|outcome| f32::from(!outcome.finite)),
        "put_down": by(|outcome| outcome.put_down as f32),
        "cpu_of_a_frame": by(|outcome| outcome.frame as f32),
        "cpu_of_an_update": by(|outcome| outcome.update as f32),
    })
}

fn sorted(mut values: Vec<f32>) -> Vec<f32> {
    values.sort_by(f32::total_cmp);
    values
}

/// The value below which a part of sorted values lies; 0 where there are none.
fn at(sorted: &[f32], part: f32) -> f32 {
    let last = sorted.len().saturating_sub(1) as f32;
    sorted
        .get((part * last).round() as usize)
        .copied()
        .unwrap_or(0.0)
}
