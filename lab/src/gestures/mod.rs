//! `lab gestures`: random hands on the leaves of a bound book, and what they do
//! to the paper: strain, penetration, time of a frame.

mod facets;
mod figures;
mod hand;
mod overlap;
mod played;
mod random;
mod scene;
mod world;

use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use serde_json::{Value, json};

use crate::options;
use crate::report::insert;
use figures::{figures, tables, worst_seeds};
use played::Played;
use turnleaf_engine::Stock;
use world::{Choice, Kind, STOCKS, World};

/// Runs the experiment.
pub fn run(parser: &mut lexopt::Parser) -> Result<(), String> {
    let (mut count, mut seed, mut worst, mut jobs) = (1000u64, 1u64, 0usize, 1usize);
    let mut choice = Choice {
        stocks: (0..STOCKS.len()).collect(),
        kinds: Kind::ALL.to_vec(),
        is_usual: false,
    };
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
            "page" => choice.is_usual = options::choice(parser, option, &["any", "usual"])? == 1,
            "kind" => {
                let names = [&Kind::NAMES[..], &["all"]].concat();
                let chosen = options::choice(parser, option, &names)?;
                choice.kinds = Kind::ALL
                    .get(chosen)
                    .map_or(Kind::ALL.to_vec(), |&kind| vec![kind]);
            }
            "stock" => {
                let names = [&STOCKS[..], &["all", "presets"]].concat();
                let chosen = options::choice(parser, option, &names)?;
                choice.stocks = match names[chosen] {
                    "all" => (0..STOCKS.len()).collect(),
                    "presets" => (0..Stock::NAMES.len()).collect(),
                    _ => vec![chosen],
                };
            }
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    let played = play(seed, count, &choice, jobs);
    let all: Vec<&Played> = played.iter().collect();
    let mut report = figures(&all);
    report["seed"] = json!(seed);
    if let [one] = &all[..] {
        report["world"] = World::new(one.seed, one.stock, &choice).describe();
    }
    let part = |is: &dyn Fn(&Played) -> bool| {
        let of: Vec<&Played> = all.iter().copied().filter(|one| is(one)).collect();
        figures(&of)
    };
    for &stock in &choice.stocks {
        report["stocks"][STOCKS[stock]] = part(&|one| one.stock == stock);
    }
    for &kind in &choice.kinds {
        report["kinds"][kind.name()] = part(&|one| one.kind == kind);
    }
    if worst > 0 {
        report["worst"] = worst_seeds(&all, worst);
    }
    if let Some(path) = into {
        insert(&path, "gestures", &tables(&report))?;
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
fn play(seed: u64, count: u64, choice: &Choice, jobs: usize) -> Vec<Played> {
    let next = AtomicU64::new(0);
    let played = Mutex::new(Vec::new());
    let work = || {
        loop {
            let seed = match next.fetch_add(1, Ordering::Relaxed) {
                done if done >= count => return,
                done => seed + done,
            };
            let stock = choice.stocks[(seed % choice.stocks.len() as u64) as usize];
            let world = World::new(seed, stock, choice);
            let outcome = scene::play(seed, &world);
            played.lock().expect("no gesture panics").push(Played {
                seed,
                stock,
                kind: world.kind,
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
