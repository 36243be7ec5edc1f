//! What random gestures did, in figures.

use serde_json::{Value, json};
use turnleaf_engine::Stock;

use super::Played;
use super::scene::Outcome;
use crate::report;

/// What is drawn farther than this behind the paper, metres, is counted as behind.
const BEHIND: f32 = 1e-3;

/// Rows of the table: what, the figure, by how much it is multiplied, its decimals.
const ROWS: [(&str, &str, f64, usize); 12] = [
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
    (
        "drawn inside another leaf, worst, mm",
        "drawn_penetration_in_leaves_mm",
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
        "all at rest after release, median, s",
        "seconds_to_rest_median",
        1.0,
        2,
    ),
    ("the same, worst", "seconds_to_rest_worst", 1.0, 2),
];

/// The figures that are wanted, all and by stock, as a table in Markdown.
pub fn table(report: &Value) -> String {
    let stocks = report["stocks"].as_object().expect("figures by stock");
    let of = stocks
        .iter()
        .map(|(name, figures)| (name.as_str(), figures));
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
    let mut finite = vec!["all finite".to_owned()];
    finite.extend(columns.iter().map(|(_, figures)| match figures["finite"] {
        Value::Bool(true) => "yes".to_owned(),
        _ => "no".to_owned(),
    }));
    rows.push(finite);
    report::table(&rows, true)
}

/// The figures of some gestures.
pub fn figures(played: &[&Played]) -> Value {
    let of = |value: fn(&Outcome) -> f32| -> Vec<f32> {
        sorted(played.iter().map(|one| value(&one.outcome)).collect())
    };
    let strains = of(|outcome| outcome.strain);
    let most = |value: fn(&Outcome) -> f32| of(value).last().copied().unwrap_or(0.0);
    let frames = || played.iter().flat_map(|one| one.outcome.frames.iter());
    let times = sorted(frames().map(|frame| frame.1 as f32 * 1e6).collect());
    let lags = sorted(
        played
            .iter()
            .flat_map(|one| one.outcome.lags.clone())
            .collect(),
    );
    let behind = lags.iter().filter(|lag| **lag > BEHIND).count();
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
        "count": played.len(),
        "edge_strain_median": at(&strains, 0.5),
        "edge_strain_p99": at(&strains, 0.99),
        "edge_strain_worst": at(&strains, 1.0),
        "edge_strain_after_release": most(|outcome| outcome.strain_after),
        "drawn_penetration_mm": 1e3 * most(|outcome| outcome.drawn.deepest()),
        "drawn_penetration_in_piles_mm": 1e3 * most(|outcome| outcome.drawn.pile),
        "drawn_penetration_in_leaves_mm": 1e3 * most(|outcome| outcome.drawn.leaf),
        "drawn_penetration_p99_mm": 1e3 * at(&of(|outcome| outcome.drawn.deepest()), 0.99),
        "edges_through_facets": most(|outcome| outcome.drawn.crossings as f32),
        "solver_penetration_mm": 1e3 * most(|outcome| outcome.depth),
        "drawn_penetration_median_mm": 1e3 * at(&of(|outcome| outcome.drawn.deepest()), 0.5),
        "solver_penetration_median_mm": 1e3 * at(&of(|outcome| outcome.depth), 0.5),
        "solver_penetration_p90_mm": 1e3 * at(&of(|outcome| outcome.depth), 0.9),
        "solver_penetration_p99_mm": 1e3 * at(&of(|outcome| outcome.depth), 0.99),
        "frames_behind_share": behind as f64 / lags.len().max(1) as f64,
        "drawn_behind_p99_mm": 1e3 * at(&lags, 0.99),
        "drawn_behind_worst_mm": 1e3 * at(&lags, 1.0),
        "seconds_to_rest_median": at(&of(|outcome| outcome.rest), 0.5),
        "seconds_to_rest_worst": most(|outcome| outcome.rest),
        "finite": played.iter().all(|one| one.outcome.finite),
        "leaves": played.iter().map(|one| one.outcome.leaves).max(),
        "us_per_frame_p50": at(&times, 0.5),
        "us_per_frame_p99": at(&times, 0.99),
        "us_per_frame_by_leaves": by_leaves,
    })
}

/// The seeds of the worst gestures by each figure.
pub fn worst_seeds(all: &[&Played], count: usize) -> Value {
    let by = |value: fn(&Outcome) -> f32| -> Value {
        let mut order: Vec<&&Played> = all.iter().collect();
        order.sort_by(|a, b| value(&b.outcome).total_cmp(&value(&a.outcome)));
        let worst = order.iter().take(count);
        worst
            .map(|one| json!([one.seed, Stock::NAMES[one.stock], value(&one.outcome)]))
            .collect()
    };
    json!({
        "edge_strain": by(|outcome| outcome.strain),
        "edge_strain_after_release": by(|outcome| outcome.strain_after),
        "drawn_in_piles": by(|outcome| outcome.drawn.pile),
        "drawn_in_leaves": by(|outcome| outcome.drawn.leaf),
        "solver": by(|outcome| outcome.depth),
        "seconds_to_rest": by(|outcome| outcome.rest),
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
