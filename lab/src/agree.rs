//! `lab agree`: the interactive sheet against the offline shell, both turned by
//! the same hand.
//!
//! Both turn freely about the spine over a table, and a hand carries a corner,
//! or the middle of the fore-edge, over an arch and lets go. Distances are over
//! the width of the page.

use std::f64::consts::PI;
use std::fmt::{self, Display, Formatter};
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use clap::Args;
use serde::Serialize;
use turnleaf_engine::{
    Contact, Edge, Grain, Root, Sheet, SheetSettings, Shell, ShellSettings, Stock, Table, TurnModel,
};

use crate::options::{self, between, make_folder};
use crate::specimen::{BREADTH, LENGTH, Settings};
use crate::table;

/// Length of the turn, s, and of what is watched after it.
const TURN: f64 = 1.2;
const AFTER: f64 = 0.6;

/// Places in time at which the two are compared, s apart.
const APART: f64 = 0.1;

/// Cells of the shell along each of the sheet's.
const FINER: usize = 2;

/// Steps of the shell between two such places, each 1/480 s long.
const SHELL_STEPS: usize = 48;

/// Where the hand holds: at the foot corner, and in the middle of the fore-edge.
const PLACES: [(&str, [f64; 2]); 2] = [("corner", [1.0, 0.0]), ("edge", [1.0, 0.5])];

/// Options of the experiment.
#[derive(Args)]
pub struct Options {
    /// The paper, or all in turn.
    #[arg(long, default_value = "book", value_parser = options::stock_name_or_all())]
    stock: options::StockOrAll,
    /// What is held against the shell; there is no other.
    #[arg(long, default_value = "sheet", value_parser = ["sheet"])]
    model: String,
    /// Of the sheet: a book's leaf, or one on its own.
    #[arg(long, value_enum, default_value = "book")]
    settings: Settings,
    /// Turns computed at once.
    #[arg(long, default_value_t = 1, value_parser = between(1usize, 64))]
    jobs: usize,
    /// Write the table into a folder, as agree_SETTINGS.json.
    #[arg(long)]
    into: Option<PathBuf>,
}

/// What was found of one stock, or of several.
#[derive(Serialize)]
#[serde(untagged)]
pub enum Agreement {
    One(OfStock),
    All { stocks: Vec<OfStock> },
}

/// Both turns of a stock.
#[derive(Serialize)]
pub struct OfStock {
    stock: &'static str,
    settings: Settings,
    corner: Turn,
    edge: Turn,
}

/// How far sheet and shell are apart in a turn, over the width.
#[derive(Serialize)]
struct Turn {
    rms: f64,
    worst: f64,
    by_time: Vec<Moment>,
    shear_degrees: f32,
    diagonal_stretch: f32,
    shell_steps_unsolved: u64,
}

#[derive(Serialize)]
struct Moment {
    time: f64,
    rms: f64,
    worst: f64,
}

/// Runs the experiment.
///
/// # Errors
/// Where a leaf comes to no rest, or a table cannot be written, in a sentence.
pub fn run(options: &Options) -> Result<Agreement, String> {
    options.into.as_deref().map_or(Ok(()), make_folder)?;
    let &Options { settings, jobs, .. } = options;
    let names = options
        .stock
        .map_or(Stock::NAMES.to_vec(), |name| vec![name]);
    let mut stocks = all(&names, settings, jobs)?;
    if let Some(folder) = &options.into {
        table(&stocks).write(folder, &format!("agree_{}", settings.name()))?;
    }
    Ok(match options.stock {
        Some(_) => Agreement::One(stocks.remove(0)),
        None => Agreement::All { stocks },
    })
}

/// The figures of each stock; so many turns are computed at once.
fn all(names: &[&'static str], settings: Settings, jobs: usize) -> Result<Vec<OfStock>, String> {
    let turns: Vec<(&str, [f64; 2])> = { names.iter() }
        .flat_map(|name| PLACES.map(|(_, place)| (*name, place)))
        .collect();
    let next = AtomicUsize::new(0);
    let found = Mutex::new(Vec::new());
    let work = || -> Result<(), String> {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(&(name, place)) = turns.get(index) else {
                return Ok(());
            };
            let turn = turn(&options::stock(name), settings, place)?;
            found.lock().expect("no thread panics").push((index, turn));
        }
    };
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..jobs.min(turns.len()))
            .map(|_| scope.spawn(work))
            .collect();
        threads
            .into_iter()
            .try_for_each(|thread| thread.join().expect("no thread panics"))
    })?;
    let mut found = found.into_inner().expect("no thread panics");
    found.sort_by_key(|(index, _)| *index);
    let mut turns = found.into_iter().map(|(_, turn)| turn);
    let mut next = || turns.next().expect("two turns of each stock");
    let of_stock = |stock: &&'static str| OfStock {
        stock,
        settings,
        corner: next(),
        edge: next(),
    };
    Ok(names.iter().map(of_stock).collect())
}

impl Display for Agreement {
    fn fmt(&self, out: &mut Formatter) -> fmt::Result {
        match self {
            Agreement::One(stock) => stock.fmt(out),
            Agreement::All { stocks } => table(stocks).fmt(out),
        }
    }
}

impl Display for OfStock {
    fn fmt(&self, out: &mut Formatter) -> fmt::Result {
        for ((by, _), turn) in PLACES.iter().zip([&self.corner, &self.edge]) {
            let (stock, settings) = (self.stock, self.settings.name());
            writeln!(
                out,
                "Turn of {stock} paper by the {by}, settings of {settings}; distance of sheet and shell over the width."
            )?;
            writeln!(out, "{:>8}  {:>9}  {:>9}", "time, s", "RMS", "worst")?;
            for Moment { time, rms, worst } in &turn.by_time {
                writeln!(out, "{time:>8}  {rms:9.5}  {worst:9.5}")?;
            }
            writeln!(out, "{:>8}  {:9.5}  {:9.5}", "all", turn.rms, turn.worst)?;
            writeln!(
                out,
                "The sheet shears by {:.2} degrees at most, and its diagonals stretch by {:.2} %.\n",
                turn.shear_degrees,
                100.0 * turn.diagonal_stretch
            )?;
        }
        Ok(())
    }
}

/// The worst of each stock's turns as a table.
fn table(stocks: &[OfStock]) -> table::Table {
    let mut table = table::Table::new(&[
        "stock",
        "corner: RMS, %",
        "worst, %",
        "shear, °",
        "diagonals, %",
        "fore-edge: RMS, %",
        "worst, %",
        "shear, °",
        "diagonals, %",
    ]);
    for stock in stocks {
        let mut row = vec![stock.stock.to_string()];
        for turn in [&stock.corner, &stock.edge] {
            row.push(format!("{:.2}", 100.0 * turn.rms));
            row.push(format!("{:.2}", 100.0 * turn.worst));
            row.push(format!("{:.2}", turn.shear_degrees));
            row.push(format!("{:.2}", 100.0 * turn.diagonal_stretch));
        }
        table.push(row);
    }
    table
}

/// Turns both models by a place (u, v) and compares them.
fn turn(stock: &Stock, settings: Settings, at: [f64; 2]) -> Result<Turn, String> {
    let settings = SheetSettings {
        root: Root::Hinged(0.0),
        ..settings.sheet([LENGTH, BREADTH], *stock)
    };
    let (columns, rows) = (settings.columns, settings.rows);
    let step = settings.time_step;
    let mut shell = Shell::new(ShellSettings {
        columns: FINER * (columns - 1) + 1,
        rows: FINER * (rows - 1) + 1,
        time_step: APART / SHELL_STEPS as f64,
        spine: Edge::Hinged {
            angle: 0.0,
            stiffness: 0.0,
        },
        table: Some(Table {
            friction: stock.friction,
        }),
        ..ShellSettings::leaf(stock, Grain::AlongSpine, LENGTH, BREADTH)
    })
    .map_err(|error| error.to_string())?;
    let mut sheet = Sheet::new(settings).map_err(|error| error.to_string())?;
    for contacts in sheet.contacts_mut() {
        contacts[0] = Contact {
            normal: [0.0, 0.0, 1.0],
            friction: stock.friction as f32,
            firmness: 1.0,
            ..Contact::default()
        };
    }
    sheet.grab(0, at[0] as f32, at[1] as f32);
    shell.grab(at[0], at[1]);
    let steps = (APART / step).round() as usize;
    let mut by_time: Vec<Moment> = Vec::new();
    let mut square = 0.0;
    let (mut shear, mut stretch) = (0.0f32, 0.0f32);
    for moment in 1..=((TURN + AFTER) / APART).round() as usize {
        // Where the hand is at the end of a step; once it has let go, nowhere.
        let hand = |count: usize, of: usize| {
            let time = APART * ((moment - 1) as f64 + count as f64 / of as f64);
            (time < TURN + 1e-9).then(|| arch(at, (time / TURN).min(1.0)))
        };
        for count in 1..=steps {
            match hand(count, steps) {
                Some(place) => sheet.pull(0, place.map(|x| x as f32)),
                None => sheet.release(0),
            }
            sheet.step();
            shear = shear.max(sheet.max_shear());
            stretch = stretch.max(sheet.max_diagonal_stretch());
        }
        for count in 1..=SHELL_STEPS {
            match hand(count, SHELL_STEPS) {
                Some(place) => shell.pull(place),
                None => shell.release(),
            }
            shell.step();
        }
        let apart = distances(&sheet, &shell, columns);
        let mean = apart.iter().map(|d| d * d).sum::<f64>() / apart.len() as f64;
        square += mean;
        let worst = apart.iter().copied().fold(0.0, f64::max);
        let time = (moment as f64 * APART * 1e3).round() / 1e3;
        by_time.push(Moment {
            time,
            rms: mean.sqrt(),
            worst,
        });
    }
    Ok(Turn {
        rms: (square / by_time.len() as f64).sqrt(),
        worst: by_time
            .iter()
            .map(|moment| moment.worst)
            .fold(0.0, f64::max),
        by_time,
        shear_degrees: shear.to_degrees(),
        diagonal_stretch: stretch,
        shell_steps_unsolved: shell.unsolved_steps(),
    })
}

/// Where the hand is when it has done a part of the turn, m: on a half circle
/// over the spine, a tenth within the paper's reach at its height.
fn arch([u, v]: [f64; 2], part: f64) -> [f64; 3] {
    // As smooth as a hand's way from rest to rest.
    let eased = part * part * (3.0 - 2.0 * part);
    let reach = u * LENGTH * (1.0 - 0.1 * (PI * eased).sin());
    let (sin, cos) = (PI * eased).sin_cos();
    [reach * cos, v * BREADTH, reach * sin]
}

/// Distances of the sheet's nodes from the same places of the shell, over the
/// width.
fn distances(sheet: &Sheet, shell: &Shell, columns: usize) -> Vec<f64> {
    let fine = shell.positions().as_chunks::<3>().0;
    let stride = FINER * (columns - 1) + 1;
    let coarse = sheet.positions().as_chunks::<3>().0.iter().enumerate();
    let distance = |(node, place): (usize, &[f32; 3])| {
        let other = fine[FINER * (node / columns) * stride + FINER * (node % columns)];
        let square = place
            .iter()
            .zip(other)
            .map(|(a, b)| (f64::from(*a) - b).powi(2));
        square.sum::<f64>().sqrt() / LENGTH
    };
    coarse.map(distance).collect()
}
