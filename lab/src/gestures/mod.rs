//! `lab gestures`: random hands on the leaves of a bound book, and what they do
//! to the paper: strain, penetration, time of a frame.

mod facets;
mod overlap;
mod random;
mod scene;

use serde_json::{Value, json};
use turnleaf_engine::Stock;

use crate::options;
use scene::Outcome;

/// What is drawn farther than this behind the paper, metres, is counted as behind.
const BEHIND: f32 = 1e-3;

/// The outcome of a seed on a stock, by its place among the names.
struct Played {
    seed: u64,
    stock: usize,
    outcome: Outcome,
}

/// Runs the experiment.
pub fn run(parser: &mut lexopt::Parser) -> Result<(), String> {
    let (mut count, mut seed, mut worst) = (1000u64, 1u64, 0usize);
    let mut stocks: Vec<usize> = (0..Stock::NAMES.len()).collect();
    let json = options::read(parser, |option, parser| {
        match option {
            "count" => count = options::number(parser, option, 1, 10_000_000)?,
            "seed" => seed = options::number(parser, option, 0, u64::MAX / 2)?,
            "worst" => worst = options::number(parser, option, 0, 1000)?,
            "stock" => {
                let names = [&Stock::NAMES[..], &["all"]].concat();
                let chosen = options::choice(parser, option, &names)?;
                if chosen < Stock::NAMES.len() {
                    stocks = vec![chosen];
                }
            }
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    let played: Vec<Played> = (seed..seed + count)
        .map(|seed| {
            let stock = stocks[(seed % stocks.len() as u64) as usize];
            let paper = Stock::named(Stock::NAMES[stock]).expect("the name is a preset's");
            Played {
                seed,
                stock,
                outcome: scene::play(seed, paper),
            }
        })
        .collect();
    let all: Vec<&Played> = played.iter().collect();
    let mut report = figures(&all);
    report["count"] = json!(count);
    report["seed"] = json!(seed);
    report["stocks"] = stocks
        .iter()
        .map(|&stock| {
            let of: Vec<&Played> = all
                .iter()
                .copied()
                .filter(|one| one.stock == stock)
                .collect();
            (Stock::NAMES[stock].to_owned(), figures(&of))
        })
        .collect::<serde_json::Map<String, Value>>()
        .into();
    if worst > 0 {
        report["worst"] = worst_seeds(&all, worst);
    }
    if json {
        println!("{report:#}");
    } else {
        print_lines(&report);
    }
    Ok(())
}

/// The figures of some gestures.
fn figures(played: &[&Played]) -> Value {
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
fn worst_seeds(all: &[&Played], count: usize) -> Value {
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

fn print_lines(report: &Value) {
    println!("{} gestures from seed {}", report["count"], report["seed"]);
    let object = report.as_object().expect("the report is an object");
    for (name, value) in object.iter().filter(|(_, value)| !value.is_object()) {
        if let Value::Array(rows) = value {
            for row in rows {
                println!("    {row}");
            }
        } else {
            println!("  {name:32} {value}");
        }
    }
    for (name, worst) in report["worst"].as_object().into_iter().flatten() {
        println!("  worst {name:26} {worst}");
    }
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
