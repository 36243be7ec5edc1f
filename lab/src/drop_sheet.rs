//! `lab drop-sheet`: a free sheet let fall level in still air.

use clap::Args;
use serde::Serialize;
use turnleaf_engine::{Air, GRAVITY};

use crate::options;
use crate::report::{Compared, Lines, error};
use crate::specimen::{Held, LENGTH, ModelOptions, Piece, Specimen};

/// Length of the fall, s.
const FALL: f64 = 3.0;

/// Options of the experiment.
#[derive(Args)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// The paper.
    #[arg(long, value_parser = options::stock_name())]
    stock: &'static str,
}

/// How fast a sheet falls, m/s.
#[derive(Serialize)]
pub struct Fall {
    #[serde(skip_serializing_if = "Option::is_none")]
    stock: Option<&'static str>,
    terminal_speed: f64,
}

/// Runs the experiment.
pub fn run(options: &Options) -> Result<Lines<Compared<Fall, Fall>>, String> {
    let (model, stock) = (options.model.model()?, options::stock(options.stock));
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
    let fall = |stock, terminal_speed| Fall {
        stock,
        terminal_speed,
    };
    Ok(Lines(Compared {
        of: model.label(),
        found: fall(Some(options.stock), speed),
        exact: fall(None, exact),
        error: fall(None, error(speed, exact)),
    }))
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
