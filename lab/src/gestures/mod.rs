//! `lab gestures`: random hands on the leaves of a bound book, and what they do
//! to the paper: strain, penetration, time of a frame.

mod facets;
mod figures;
mod overlap;
mod random;
mod scene;

use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use serde_json::{Value, json};
use turnleaf_engine::Stock;

use crate::options;
use crate::report::insert;
use figures::{figures, table, worst_seeds};
use scene::Outcome;

/// The outcome of a seed on a stock, by its place among the names.
struct Played {
    seed: u64,
    stock: usize,
    outcome: Outcome,
}

/// Runs the experiment.
pub fn run(parser: &mut lexopt::Parser) -> Result<(), String> {
    let (mut count, mut seed, mut worst, mut jobs) = (1000u64, 1u64, 0usize, 1usize);
    let mut stocks: Vec<usize> = (0..Stock::NAMES.len()).collect();
    let mut into = None;
    let json = options::read(parser, |option, parser| {
        match option {
            "count" => count = options::number(parser, option, 1, 10_000_000)?,
            "seed" => seed = options::number(parser, option, 0, u64::MAX / 2)?,
            "worst" => worst = options::number(parser, option, 0, 1000)?,
            // A book's leaves are sheets.
            "model" => drop(options::choice(parser, option, &["sheet"])?),
            "jobs" => jobs = options::number(parser, option, 1, 256)?,
            "into" => into = Some(PathBuf::from(options::text(parser, option)?)),
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
    let played = play(seed, count, &stocks, jobs);
    let all: Vec<&Played> = played.iter().collect();
    let mut report = figures(&all);
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
    if let Some(path) = into {
        insert(&path, "gestures", &table(&report))?;
    }
    if json {
        println!("{report:#}");
    } else {
        print_lines(&report);
    }
    Ok(())
}

/// Plays gestures, so many at once, each by its seed and so the same whatever plays
/// beside it; answers them by their seeds.
fn play(seed: u64, count: u64, stocks: &[usize], jobs: usize) -> Vec<Played> {
    let next = AtomicU64::new(0);
    let played = Mutex::new(Vec::new());
    let work = || {
        loop {
            let seed = match next.fetch_add(1, Ordering::Relaxed) {
                done if done >= count => return,
                done => seed + done,
            };
            let stock = stocks[(seed % stocks.len() as u64) as usize];
            let paper = Stock::named(Stock::NAMES[stock]).expect("the name is a preset's");
            let outcome = scene::play(seed, paper);
            played.lock().expect("no gesture panics").push(Played {
                seed,
                stock,
                outcome,
            });
        }
    };
    std::thread::scope(|scope| {
        (0..jobs).for_each(|_| {
            scope.spawn(work);
        });
    });
    let mut played = played.into_inner().expect("no gesture panics");
    played.sort_by_key(|one| one.seed);
    played
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
