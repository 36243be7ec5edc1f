//! `lab drop-sheet`: a free sheet let fall level in still air.

use serde_json::json;
use turnleaf_engine::{Air, GRAVITY, Stock};

use crate::options;
use crate::report;
use crate::specimen::{Held, LENGTH, Piece, Specimen};

/// Length of the fall, s.
const FALL: f64 = 3.0;

/// Runs the experiment.
pub fn run(parser: &mut lexopt::Parser) -> Result<(), String> {
    let mut stock = None;
    let (model, json) = report::read(parser, |option, parser| {
        if option != "stock" {
            return Ok(false);
        }
        let name = Stock::NAMES[options::choice(parser, option, &Stock::NAMES)?];
        stock = Stock::named(name).map(|stock| (name, stock));
        Ok(true)
    })?;
    let (name, stock) = stock.ok_or("A sheet to drop needs --stock, its paper.")?;
    let piece = Piece {
        grammage: stock.grammage,
        stiffness: stock.stiffness_across,
        poisson: stock.poisson,
        gravity: [0.0, 0.0, -GRAVITY],
        held: Held::Nothing,
        ..Piece::weightless()
    };
    let mut specimen = model.make(&piece)?;
    let speed = steady_speed(&mut *specimen)?;
    let exact = Air::still(LENGTH).terminal_speed(stock.grammage);
    let figures = json!({
        "model": model.name(),
        "settings": model.settings(),
        "stock": name,
        "terminal_speed": speed,
        "exact": { "terminal_speed": exact },
        "error": { "terminal_speed": report::error(speed, exact) },
    });
    report::print(json, &figures);
    Ok(())
}

/// Speed of a falling piece when from one tenth of a second to the next it has
/// ceased to change less, m/s. A sheet that falls level is not stable: in the
/// end it glides away, so there is a steadiest moment and no last one.
fn steady_speed(piece: &mut dyn Specimen) -> Result<f64, String> {
    let steps = (0.1 / piece.time_step()).round() as usize;
    let (mut speed, mut change) = (0.0, f64::INFINITY);
    for _ in 0..(10.0 * FALL) as usize {
        let from = height(piece);
        for _ in 0..steps {
            piece.step();
        }
        let now = (from - height(piece)) / (steps as f64 * piece.time_step());
        let least = change;
        change = f64::abs(now - speed) / now;
        if change < 0.02 && (change >= least || change < 1e-4) {
            return Ok(speed);
        }
        speed = now;
    }
    Err(format!("The sheet finds no steady speed within {FALL} s."))
}

/// Mean height of a piece's columns, m.
fn height(piece: &dyn Specimen) -> f64 {
    let columns = piece.grid().0;
    (0..columns)
        .map(|column| piece.middle(column)[2])
        .sum::<f64>()
        / columns as f64
}
