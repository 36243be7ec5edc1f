//! `lab energy`: what a strip that swings undamped in a vacuum loses or gains.

use clap::Args;
use serde::Serialize;

use crate::exact::vibration_roots;
use crate::options::between;
use crate::report::Lines;
use crate::specimen::{Label, Model, ModelOptions, Piece, Specimen};

/// Weight over stiffness of the strip, which starts level.
const GAMMA: f64 = 1.0;

/// Steps of a period for a model that takes any step.
const FINE: f64 = 400.0;

/// Options of the experiment.
#[derive(Args)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// Periods of the swing.
    #[arg(long, default_value_t = 10, value_parser = between(2usize, 1000))]
    periods: usize,
}

/// What a strip has gained of its energy.
#[derive(Serialize)]
pub struct Energy {
    #[serde(flatten)]
    of: Label,
    gamma: f64,
    periods: usize,
    time_step: f64,
    drift: f64,
    measured_by: &'static str,
    exact: Drift,
}

#[derive(Serialize)]
struct Drift {
    drift: f64,
}

/// Runs the experiment.
///
/// # Errors
/// Where the options name no model, or its strip comes to no rest, in a sentence.
pub fn run(options: &Options) -> Result<Lines<Energy>, String> {
    let (model, periods) = (options.model.model()?, options.periods);
    let mut piece = Piece {
        loss: Some(0.0),
        air: false,
        ..Piece::of_gamma(GAMMA)
    };
    let rate = vibration_roots()[0].powi(2) * (piece.stiffness / piece.grammage).sqrt()
        / (piece.length * piece.length);
    let period = 2.0 * std::f64::consts::PI / rate;
    if model.takes_any_step() {
        piece.time_step = Some(period / FINE);
        // It bends alike along its whole breadth.
        piece.rows = Some(3);
    }
    let mut strip = model.make(&piece)?;
    let (drift, how) = match strip.energy() {
        Some(energy) => {
            let swing = energy - energy_at_rest(model, &piece)?;
            (drift(&mut *strip, period, periods) / swing, "energy")
        }
        None => (
            -lost(&mut *strip, period, periods),
            "height of the swing, squared",
        ),
    };
    Ok(Lines(Energy {
        of: model.label(),
        gamma: GAMMA,
        periods,
        time_step: strip.time_step(),
        drift,
        measured_by: how,
        exact: Drift { drift: 0.0 },
    }))
}

fn energy_at_rest(model: Model, piece: &Piece) -> Result<f64, String> {
    let damped = Piece {
        loss: None,
        air: true,
        ..piece.clone()
    };
    let mut strip = model.make(&damped)?;
    strip.rest()?;
    strip
        .energy()
        .ok_or_else(|| "The strip keeps no account of its energy.".into())
}

/// How far the energy of a swinging strip strays most from what it was at first, J.
fn drift(strip: &mut dyn Specimen, period: f64, periods: usize) -> f64 {
    let start = strip.energy().unwrap_or(f64::NAN);
    let mut most = 0.0f64;
    for _ in 0..(periods as f64 * period / strip.time_step()).ceil() as usize {
        strip.step();
        let away = strip.energy().unwrap_or(f64::NAN) - start;
        if away.is_nan() || away.abs() > most.abs() {
            most = away;
        }
    }
    most
}

/// The part of its energy that a swinging strip has lost by the last of some
/// periods, by the heights of its swings: energy goes with their squares.
fn lost(strip: &mut dyn Specimen, period: f64, periods: usize) -> f64 {
    let steps = (period / strip.time_step()).round() as usize;
    let mut heights = (0..periods).map(|_| {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for _ in 0..steps {
            strip.step();
            let z = strip.tip()[2];
            (low, high) = (low.min(z), high.max(z));
        }
        high - low
    });
    let first = heights.next().unwrap_or(f64::NAN);
    let last = heights.last().unwrap_or(f64::NAN);
    1.0 - (last / first) * (last / first)
}
