//! `lab agree`: the interactive sheet against the offline shell, both turned by
//! the same hand.
//!
//! Both turn freely about the spine over a table, and a hand carries a corner,
//! or the middle of the fore-edge, over an arch and lets go. Distances are over
//! the width of the page.

use std::f64::consts::PI;
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use serde_json::{Value, json};
use turnleaf_engine::{
    Contact, Edge, Grain, Root, Sheet, SheetSettings, Shell, ShellSettings, Stock, Table, TurnModel,
};

use crate::options;
use crate::report;
use crate::specimen::{BREADTH, LENGTH, Settings};

/// Length of the turn, s, and of what is watched after it.
const TURN: f64 = 1.2;
const AFTER: f64 = 0.6;

/// Places in time at which the two are compared, s apart.
const APART: f64 = 0.1;

/// Cells of the shell along each of the sheet's.
const FINER: usize = 2;

/// Steps of the shell between two such places, each 1/480 s long.
const SHELL_STEPS: usize = 48;

/// Where hands hold: at the foot corner, and in the middle of the fore-edge.
const PLACES: [(&str, [f64; 2]); 2] = [("corner", [1.0, 0.0]), ("edge", [1.0, 0.5])];

/// Runs the experiment.
pub fn run(parser: &mut lexopt::Parser) -> Result<(), String> {
    let (mut names, mut settings, mut jobs) = (vec!["book"], Settings::default(), 1);
    let mut into = None;
    let json = options::read(parser, |option, parser| {
        match option {
            "stock" => {
                let known = [&Stock::NAMES[..], &["all"]].concat();
                let name = known[options::choice(parser, option, &known)?];
                names = if name == "all" {
                    Stock::NAMES.to_vec()
                } else {
                    vec![name]
                };
            }
            // What is held against the shell.
            "model" => drop(options::choice(parser, option, &["sheet"])?),
            "settings" => settings = Settings::read(parser)?,
            "jobs" => jobs = options::number(parser, option, 1, 64)?,
            "into" => into = Some(PathBuf::from(options::text(parser, option)?)),
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    let figures = all(&names, settings, jobs)?;
    if let Some(path) = into {
        let name = format!("agree {}", settings.name());
        report::insert(&path, &name, &table(&figures, true))?;
    }
    match &figures[..] {
        [only] if json => report::print(true, only),
        _ if json => report::print(true, &json!({ "stocks": figures })),
        [only] => print_by_time(only),
        _ => print!("{}", table(&figures, false)),
    }
    Ok(())
}

/// The figures of each stock; so many turns are computed at once.
fn all(names: &[&'static str], settings: Settings, jobs: usize) -> Result<Vec<Value>, String> {
    let count = names.len() * PLACES.len();
    let (next, found) = (AtomicUsize::new(0), Mutex::new(vec![Value::Null; count]));
    let work = || -> Result<(), String> {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(name) = names.get(index / PLACES.len()) else {
                return Ok(());
            };
            let stock = Stock::named(name).expect("a preset");
            let figures = turn(&stock, settings, PLACES[index % PLACES.len()].1)?;
            found.lock().expect("no thread panics")[index] = figures;
        }
    };
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..jobs.min(count)).map(|_| scope.spawn(work)).collect();
        threads
            .into_iter()
            .try_for_each(|thread| thread.join().expect("no thread panics"))
    })?;
    let found = found.into_inner().expect("no thread panics");
    let stocks = names.iter().zip(found.chunks(PLACES.len()));
    let of_stock = |(name, found): (&&str, &[Value])| {
        let mut figures = json!({ "stock": name, "settings": settings.name() });
        for ((by, _), found) in PLACES.iter().zip(found) {
            figures[by] = found.clone();
        }
        figures
    };
    Ok(stocks.map(of_stock).collect())
}

fn print_by_time(figures: &Value) {
    for (by, _) in PLACES {
        println!(
            "Turn of {} paper by the {by}, settings of {}; distance of sheet and shell over the width.",
            figures["stock"].as_str().unwrap_or_default(),
            figures["settings"].as_str().unwrap_or_default(),
        );
        println!("{:>8}  {:>9}  {:>9}", "time, s", "RMS", "worst");
        for row in figures[by]["by_time"].as_array().into_iter().flatten() {
            println!(
                "{:>8}  {:9.5}  {:9.5}",
                row["time"],
                row["rms"].as_f64().unwrap_or(f64::NAN),
                row["worst"].as_f64().unwrap_or(f64::NAN)
            );
        }
        println!(
            "{:>8}  {:9.5}  {:9.5}",
            "all",
            figures[by]["rms"].as_f64().unwrap_or(f64::NAN),
            figures[by]["worst"].as_f64().unwrap_or(f64::NAN)
        );
        println!(
            "The sheet shears by {:.2} degrees at most, and its diagonals stretch by {:.2} %.\n",
            figures[by]["shear_degrees"].as_f64().unwrap_or(f64::NAN),
            100.0 * figures[by]["diagonal_stretch"].as_f64().unwrap_or(f64::NAN)
        );
    }
}

/// The worst of each stock's turns as a table.
fn table(figures: &[Value], markdown: bool) -> String {
    let headings = [
        "stock",
        "corner: RMS, %",
        "worst, %",
        "shear, °",
        "diagonals, %",
        "fore-edge: RMS, %",
        "worst, %",
        "shear, °",
        "diagonals, %",
    ];
    let mut rows = vec![headings.map(String::from).to_vec()];
    for stock in figures {
        let mut row = vec![stock["stock"].as_str().unwrap_or_default().to_string()];
        for (by, _) in PLACES {
            for (name, scale) in [
                ("rms", 100.0),
                ("worst", 100.0),
                ("shear_degrees", 1.0),
                ("diagonal_stretch", 100.0),
            ] {
                let value = scale * stock[by][name].as_f64().unwrap_or(f64::NAN);
                row.push(format!("{value:.2}"));
            }
        }
        rows.push(row);
    }
    report::table(&rows, markdown)
}

/// Turns both models by a place (u, v) and compares them.
fn turn(stock: &Stock, settings: Settings, at: [f64; 2]) -> Result<Value, String> {
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
    let mut samples = Vec::new();
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
        samples.push(json!({ "time": time, "rms": mean.sqrt(), "worst": worst }));
    }
    let worst = samples
        .iter()
        .filter_map(|sample| sample["worst"].as_f64())
        .fold(0.0, f64::max);
    Ok(json!({
        "rms": (square / samples.len() as f64).sqrt(),
        "worst": worst,
        "by_time": samples,
        "shear_degrees": shear.to_degrees(),
        "diagonal_stretch": stretch,
        "shell_steps_unsolved": shell.unsolved_steps(),
    }))
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
