//! `lab uses`: what readers do with a book every day, and whether what is drawn of its leaves is where
//! their paper is.

mod act;
mod figures;
mod folded;
mod folded_figures;
mod open;
mod reader;
mod watch;

use std::fmt::{self, Display, Formatter};
use std::path::PathBuf;

use clap::Args;
use serde::Serialize;
use turnleaf_engine::Stock;

use crate::options::{between, make_folder};
use crate::table::Table;
use act::Use;
use figures::Figures;
use open::{Folded, PAGES, STOCKS};
use reader::Reader;
use watch::Watched;

/// Runs are played in steps of so many, which has no factor in common with their number: any first ones
/// of them are of all uses, books, stocks and pages.
const STRIDE: usize = 233;

/// Every so many pictures it is measured how deep leaves are drawn in each other.
const LOOKED_AT: usize = 8;

/// Options of the experiment.
#[derive(Args)]
pub struct Options {
    /// Play only so many of all runs, spread over uses, books, stocks and pages; with --folded so
    /// many in place of 300.
    #[arg(long, value_parser = between(1usize, RUNS))]
    count: Option<usize>,
    /// Play leaves that are folded at random as people fold them, and turned, thrown, jumped over
    /// and folded again.
    #[arg(long)]
    folded: bool,
    /// Seed of the first of these; each has the next one.
    #[arg(long, default_value_t = 1, requires = "folded", value_parser = between(0u64, u64::MAX / 2))]
    seed: u64,
    /// Play only what is called so: a use, a book or a stock.
    #[arg(long)]
    only: Vec<String>,
    /// List so many of the runs that are farthest behind.
    #[arg(long, default_value_t = 0, value_parser = between(0usize, RUNS))]
    worst: usize,
    /// Write the table into a folder, as uses.json.
    #[arg(long)]
    into: Option<PathBuf>,
}

/// Every use of every book.
const RUNS: usize = Use::ALL.len() * Folded::ALL.len() * STOCKS.len() * PAGES.len();

/// One use of one book.
#[derive(Clone, Copy)]
struct Run {
    what: Use,
    folded: Folded,
    stock: &'static str,
    page: &'static str,
}

impl Run {
    /// The run of a number, below [`RUNS`].
    fn of(number: usize) -> (Run, [f64; 2]) {
        let (number, what) = (number / Use::ALL.len(), number % Use::ALL.len());
        let (number, folded) = (number / Folded::ALL.len(), number % Folded::ALL.len());
        let (page, stock) = (number / STOCKS.len(), number % STOCKS.len());
        let (name, size) = PAGES[page];
        let run = Run {
            what: Use::ALL[what],
            folded: Folded::ALL[folded],
            stock: STOCKS[stock],
            page: name,
        };
        (run, size)
    }

    fn names(&self) -> [&'static str; 4] {
        [self.what.name(), self.folded.name(), self.stock, self.page]
    }
}

/// What was found.
#[derive(Serialize)]
#[serde(untagged)]
pub enum Report {
    Uses(Uses),
    Folded(folded::Report),
}

/// What uses did to what is drawn: all, and by what they are of.
#[derive(Serialize)]
pub struct Uses {
    all: Figures,
    /// Of each use, book, stock and page.
    parts: Vec<(&'static str, Figures)>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    worst: Vec<(String, f32)>,
}

/// Runs the experiment.
///
/// # Errors
/// Where no run is called so, or a table cannot be written, in a sentence.
pub fn run(options: &Options) -> Result<Report, String> {
    options.into.as_deref().map_or(Ok(()), make_folder)?;
    if options.folded {
        let count = options.count.unwrap_or(folded::RUNS) as u64;
        let seeds = options.seed..options.seed + count;
        let report = folded::Report::of(seeds, &options.only, options.worst)?;
        if let Some(folder) = &options.into {
            report.table().write(folder, "uses_folded")?;
        }
        return Ok(Report::Folded(report));
    }
    let count = options.count.unwrap_or(RUNS);
    let runs = (0..count).map(|k| Run::of(k * STRIDE % RUNS));
    let is_meant = |run: &Run| {
        options
            .only
            .iter()
            .all(|only| run.names().contains(&&only[..]))
    };
    let played: Vec<(Run, Watched)> = { runs.filter(|(run, _)| is_meant(run)) }
        .map(|(run, page)| (run, play(run, page)))
        .collect();
    if played.is_empty() {
        return Err("No run is called so.".into());
    }
    let of = |is: &dyn Fn(&Run) -> bool| {
        Figures::of(played.iter().filter(|one| is(&one.0)).map(|one| &one.1))
    };
    let uses = Use::ALL.iter().map(|what| what.name());
    let books = Folded::ALL.iter().map(|folded| folded.name());
    let pages = PAGES.iter().map(|(name, _)| *name);
    let parts = uses.chain(books).chain(STOCKS).chain(pages);
    let part = |name| (name, of(&|run| run.names().contains(&name)));
    let report = Uses {
        all: of(&|_| true),
        parts: parts
            .map(part)
            .filter(|(_, figures)| figures.runs > 0)
            .collect(),
        worst: worst(&played, options.worst),
    };
    if let Some(folder) = &options.into {
        report.table().write(folder, "uses")?;
    }
    Ok(Report::Uses(report))
}

/// Plays one use until all lies at rest.
fn play(run: Run, page: [f64; 2]) -> Watched {
    let stock = Stock::named(run.stock).expect("it is a preset");
    let folds = run.folded.folds(&stock, page);
    let (book, leaves, first) = open::open(&folds, stock, page);
    let mut reader = Reader::new((book, leaves), page.map(|side| side as f32), LOOKED_AT);
    let mut frame = 0;
    while run.what.act(&mut reader, first, frame) {
        reader.frame();
        frame += 1;
    }
    reader.come_to_rest();
    reader.into_watched()
}

/// The runs that are behind in most of their frames, with the part of those in percent.
fn worst(played: &[(Run, Watched)], count: usize) -> Vec<(String, f32)> {
    let of = |(run, watched): &(Run, Watched)| {
        (
            run.names().join(", "),
            100.0 * watched.behind as f32 / watched.frames as f32,
        )
    };
    let mut all: Vec<(String, f32)> = played.iter().map(of).collect();
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    all.truncate(count);
    all
}

impl Uses {
    fn table(&self) -> Table {
        let mut table = Table::new(&Figures::HEADINGS);
        for (name, figures) in [("all", &self.all)]
            .into_iter()
            .chain(self.parts.iter().map(|(n, f)| (*n, f)))
        {
            table.push(figures.row(name));
        }
        table
    }
}

impl Display for Report {
    fn fmt(&self, out: &mut Formatter) -> fmt::Result {
        match self {
            Report::Uses(uses) => uses.fmt(out),
            Report::Folded(folded) => folded.fmt(out),
        }
    }
}

impl Display for Uses {
    fn fmt(&self, out: &mut Formatter) -> fmt::Result {
        self.table().fmt(out)?;
        for (name, part) in &self.worst {
            writeln!(out, "  {part:5.1} %  {name}")?;
        }
        Ok(())
    }
}
