//! `lab gestures`: random pointers on the leaves of a bound book, and what they do
//! to the paper: strain, penetration, time of a frame.

mod crease_figures;
mod crease_table;
pub mod creasing;
mod facets;
mod figures;
mod folding;
mod folds;
pub mod overlap;
mod parts;
mod played;
mod pointer;
pub mod random;
mod scene;
mod tearing;
pub mod timed_folding;
mod triangle;
mod world;

use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use clap::Args;
use serde::Serialize;

use crate::options::{between, make_folder};
use crate::table::Table;
use figures::{Figures, Worst};
use folding::Fold;
use played::Played;
use world::{Choice, Description, Kind, STOCKS, World};

/// Options of the experiment.
#[derive(Args)]
pub struct Options {
    /// Number of gestures.
    #[arg(long, default_value_t = 1000, value_parser = between(1u64, 10_000_000))]
    count: u64,
    /// Seed of the first; each has the next one.
    #[arg(long, default_value_t = 1, value_parser = between(0u64, u64::MAX / 2))]
    seed: u64,
    /// Leaves' stocks in turn; custom: figures as of paper, extreme: any that a book takes.
    #[arg(long, default_value = "all", value_parser = world::stocks())]
    stock: world::Stocks,
    /// What pointers do.
    #[arg(long, default_value = "all", value_parser = world::kinds())]
    kind: world::Kinds,
    /// Usual: 140 x 210 mm, still air, the usual binding and frames; any: all of them at random.
    #[arg(long, default_value = "any", value_parser = ["any", "usual"])]
    page: String,
    /// Fold and tear leaves at random too, in this way.
    #[arg(long, value_name = "FOLD", num_args = 0..=1, default_missing_value = "all", require_equals = true, value_parser = folding::folds())]
    creases: Option<folding::Folds>,
    /// List the seeds of so many of the worst.
    #[arg(long, default_value_t = 0, value_parser = between(0usize, 1000))]
    worst: usize,
    /// Gestures played at once; times of a frame are then longer.
    #[arg(long, default_value_t = 1, value_parser = between(1usize, 256))]
    jobs: usize,
    /// Write the tables into a folder, as gestures_stocks.json and gestures_kinds.json, with
    /// --creases as gestures_creases.json and gestures_folds.json.
    #[arg(long)]
    into: Option<PathBuf>,
    /// The leaves' model; there is no other in a book.
    #[arg(long, default_value = "sheet", value_parser = ["sheet"])]
    model: String,
}

/// What gestures did: all, and by stock and kind.
#[derive(Serialize)]
pub struct Report {
    seed: u64,
    #[serde(flatten)]
    all: Figures,
    stocks: BTreeMap<&'static str, Figures>,
    kinds: BTreeMap<&'static str, Figures>,
    /// By how leaves are folded.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    folds: BTreeMap<&'static str, Figures>,
    /// Of a single gesture, the book that it was played on.
    #[serde(skip_serializing_if = "Option::is_none")]
    world: Option<Description>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    worst: BTreeMap<&'static str, Vec<Worst>>,
}

/// Runs the experiment.
///
/// # Errors
/// Where a table cannot be written, in a sentence.
pub fn run(options: &Options) -> Result<Report, String> {
    options.into.as_deref().map_or(Ok(()), make_folder)?;
    let choice = Choice {
        stocks: options.stock.clone(),
        kinds: options.kind.clone(),
        is_usual: options.page == "usual",
        folds: options.creases.clone(),
    };
    let played = play(options.seed, options.count, &choice, options.jobs);
    let all: Vec<&Played> = played.iter().collect();
    let part = |is: &dyn Fn(&Played) -> bool| {
        let of: Vec<&Played> = all.iter().copied().filter(|one| is(one)).collect();
        Figures::of(&of)
    };
    let by_stock = |&stock: &usize| (STOCKS[stock], part(&|one| one.stock == stock));
    let by_kind = |&kind: &Kind| (kind.name(), part(&|one| one.kind == kind));
    let by_fold = |&fold: &Fold| (fold.name(), part(&|one| one.fold == Some(fold)));
    let report = Report {
        seed: options.seed,
        all: Figures::of(&all),
        stocks: choice.stocks.iter().map(by_stock).collect(),
        kinds: choice.kinds.iter().map(by_kind).collect(),
        folds: choice.folds.iter().flatten().map(by_fold).collect(),
        world: match all[..] {
            [one] => Some(World::new(one.seed, one.stock, &choice).describe()),
            _ => None,
        },
        worst: match options.worst {
            0 => BTreeMap::new(),
            count => figures::worst(&all, count),
        },
    };
    if let Some(folder) = &options.into {
        let [by_stock, other] = report.tables();
        let names = if report.folds.is_empty() {
            ["gestures_stocks", "gestures_kinds"]
        } else {
            ["gestures_creases", "gestures_folds"]
        };
        by_stock.write(folder, names[0])?;
        other.write(folder, names[1])?;
    }
    Ok(report)
}

impl Report {
    /// The tables by stock, and by what pointers do, or by how leaves are folded.
    fn tables(&self) -> [Table; 2] {
        if self.folds.is_empty() {
            [&self.stocks, &self.kinds].map(|parts| figures::table(self.seed, &self.all, parts))
        } else {
            let table = |parts| crease_table::table(self.seed, &self.all, parts);
            [&self.stocks, &self.folds].map(table)
        }
    }
}

impl Display for Report {
    fn fmt(&self, out: &mut Formatter) -> fmt::Result {
        let [by_stock, other] = self.tables();
        by_stock.fmt(out)?;
        writeln!(out)?;
        other.fmt(out)?;
        for (name, worst) in &self.worst {
            writeln!(out, "\nworst by {}", name.replace('_', " "))?;
            for (seed, stock, kind, figure) in worst {
                writeln!(out, "  {seed:>10}  {stock:8}  {kind:8}  {figure}")?;
            }
        }
        Ok(())
    }
}

/// Names the seed of a gesture that stops the experiment by a panic, which does not know it.
struct NamedIfStopped(u64);

impl Drop for NamedIfStopped {
    fn drop(&mut self) {
        if std::thread::panicking() {
            eprintln!("Gesture {} stopped the experiment.", self.0);
        }
    }
}

/// Plays gestures, so many at once, each by its seed and so the same whatever plays
/// beside it. Returns them by their seeds.
fn play(seed: u64, count: u64, choice: &Choice, jobs: usize) -> Vec<Played> {
    let next = AtomicU64::new(0);
    let played = Mutex::new(Vec::new());
    let work = || {
        loop {
            let seed = match next.fetch_add(1, Ordering::Relaxed) {
                done if done >= count => return,
                done => seed + done,
            };
            let _named = NamedIfStopped(seed);
            let stock = choice.stocks[(seed % choice.stocks.len() as u64) as usize];
            let world = World::new(seed, stock, choice);
            let outcome = scene::play(seed, &world);
            played.lock().expect("no gesture panics").push(Played {
                seed,
                stock,
                kind: world.kind,
                fold: world.fold,
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
