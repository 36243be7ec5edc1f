//! `lab agree`: the interactive sheet against the offline shell, both turned by
//! the same hand.
//!
//! Both turn freely about the spine over a table, and a hand carries a corner,
//! or the middle of the fore-edge, over an arch and lets go. Distances are over
//! the width of the page.

use std::f64::consts::PI;

use serde_json::{Value, json};
use turnleaf_engine::{
    Contact, Edge, Grain, Root, Sheet, SheetSettings, Shell, ShellSettings, Stock, Table, TurnModel,
};

use crate::options;
use crate::report;
use crate::specimen::{BREADTH, LENGTH};

/// Length of the turn, s, and of what is watched after it.
const TURN: f64 = 1.2;
const AFTER: f64 = 0.6;

/// Places in time at which the two are compared, s apart.
const APART: f64 = 0.1;

/// Cells of the shell along each of the sheet's.
const FINER: usize = 2;

/// Steps of the shell in each of the sheet's.
const QUICKER: usize = 2;

/// Runs the experiment.
pub fn run(parser: &mut lexopt::Parser) -> Result<(), String> {
    let mut name = "book";
    let json = options::read(parser, |option, parser| {
        match option {
            "stock" => name = Stock::NAMES[options::choice(parser, option, &Stock::NAMES)?],
            // What is held against the shell.
            "model" => drop(options::choice(parser, option, &["sheet"])?),
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    let stock = Stock::named(name).expect("a preset");
    let figures = json!({
        "stock": name,
        "corner": turn(&stock, [1.0, 0.0])?,
        "edge": turn(&stock, [1.0, 0.5])?,
    });
    if json {
        report::print(true, &figures);
        return Ok(());
    }
    for by in ["corner", "edge"] {
        println!("Turn of {name} paper by the {by}; distance of sheet and shell over the width.");
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
            "{:>8}  {:9.5}  {:9.5}\n",
            "all",
            figures[by]["rms"].as_f64().unwrap_or(f64::NAN),
            figures[by]["worst"].as_f64().unwrap_or(f64::NAN)
        );
    }
    Ok(())
}

/// Turns both models by a place (u, v) and compares them.
fn turn(stock: &Stock, at: [f64; 2]) -> Result<Value, String> {
    let settings = SheetSettings {
        root: Root::Hinged(0.0),
        ..SheetSettings::leaf(LENGTH, BREADTH, *stock)
    };
    let (columns, rows) = (settings.columns, settings.rows);
    let step = settings.time_step;
    let mut shell = Shell::new(ShellSettings {
        columns: FINER * (columns - 1) + 1,
        rows: FINER * (rows - 1) + 1,
        time_step: step / QUICKER as f64,
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
    let (steps, every) = (
        ((TURN + AFTER) / step).round() as usize,
        (APART / step).round() as usize,
    );
    let mut samples = Vec::new();
    let mut square = 0.0;
    for count in 1..=steps {
        let time = count as f64 * step;
        if time < TURN {
            sheet.pull(0, arch(at, time / TURN).map(|x| x as f32));
        } else {
            sheet.release(0);
            shell.release();
        }
        sheet.step();
        for part in 1..=QUICKER {
            let time = time - step + part as f64 * step / QUICKER as f64;
            shell.pull(arch(at, (time / TURN).min(1.0)));
            shell.step();
        }
        if count % every == 0 {
            let apart = distances(&sheet, &shell, columns);
            let mean = apart.iter().map(|d| d * d).sum::<f64>() / apart.len() as f64;
            square += mean;
            let worst = apart.iter().copied().fold(0.0, f64::max);
            let time = (time * 1e3).round() / 1e3;
            samples.push(json!({ "time": time, "rms": mean.sqrt(), "worst": worst }));
        }
    }
    let worst = samples
        .iter()
        .filter_map(|sample| sample["worst"].as_f64())
        .fold(0.0, f64::max);
    Ok(json!({
        "rms": (square / samples.len() as f64).sqrt(),
        "worst": worst,
        "by_time": samples,
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
