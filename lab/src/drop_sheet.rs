//! `lab drop-sheet`: a free sheet let fall level in still air.

use clap::Args;
use serde::Serialize;
use turnleaf_engine::{Air, GRAVITY};

use crate::options::{self, between};
use crate::report::{Compared, Lines, error};
use crate::specimen::{Held, LENGTH, ModelOptions, Piece, Specimen};

/// Speeds are compared after this part of the time in which a sheet nears its steady
/// speed, which is 0.3 s of book paper on Earth.
const PART: f64 = 0.25;

/// How many of those parts a sheet falls.
const PARTS: usize = 40;

/// Options of the experiment.
#[derive(Args)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// The paper.
    #[arg(long, value_parser = options::stock_name())]
    stock: &'static str,
    /// Acceleration of gravity, m/s^2; on the Moon 1.62.
    #[arg(long, default_value_t = GRAVITY, value_parser = between(0.1, 100.0))]
    gravity: f64,
}

/// How fast a sheet falls, m/s.
#[derive(Serialize)]
pub struct Fall {
    #[serde(skip_serializing_if = "Option::is_none")]
    stock: Option<&'static str>,
    terminal_speed: f64,
}

/// Runs the experiment.
///
/// # Errors
/// Where the options name no model, or its sheet never falls steadily, in a sentence.
pub fn run(options: &Options) -> Result<Lines<Compared<Fall, Fall>>, String> {
    let (model, stock) = (options.model.model()?, options::stock(options.stock));
    let piece = Piece {
        grammage: stock.grammage,
        stiffness: stock.stiffness_across,
        poisson: stock.poisson,
        gravity: [0.0, 0.0, -options.gravity],
        held: Held::Nothing,
        ..Piece::weightless()
    };
    let mut specimen = model.make(&piece)?;
    let air = Air::still(LENGTH);
    let exact = air.terminal_speed(stock.grammage) * (options.gravity / GRAVITY).sqrt();
    // The air that it carries along has to be set moving too, and weighs nothing.
    let mass = 1.0 + air.added_mass / stock.grammage;
    let speed = steady_speed(&mut *specimen, mass * exact / options.gravity)?;
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

/// Speed of a falling piece when from one part of its fall to the next it has
/// ceased to change less, m/s. A sheet that falls level is not stable: in the
/// end it glides away, so there is a steadiest moment and no last one.
///
/// `nearing`: seconds after which it falls at tanh 1, three quarters, of its steady
/// speed: that speed over its acceleration at first.
fn steady_speed(piece: &mut dyn Specimen, nearing: f64) -> Result<f64, String> {
    let steps = (PART * nearing / piece.time_step()).round().max(1.0) as usize;
    let (mut speed, mut change) = (0.0, f64::INFINITY);
    for _ in 0..PARTS {
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
    let seconds = (PARTS * steps) as f64 * piece.time_step();
    Err(format!(
        "The sheet finds no steady speed within {seconds:.1} s."
    ))
}

/// Mean height of a piece's columns, m.
fn height(piece: &dyn Specimen) -> f64 {
    let columns = piece.grid().0;
    (0..columns)
        .map(|column| piece.middle(column)[2])
        .sum::<f64>()
        / columns as f64
}
