//! `lab upright` and `lab lateral-buckling`: the weight at which a piece that
//! stands falls over.
//!
//! Bisected between a weight at which it stands and one at which it does not. A
//! model that can tell whether an equilibrium is stable is asked; any other is
//! nudged, by much less than would strain a sheet that bends two ways at once,
//! and either the nudge dies away or it grows.

use serde_json::{Value, json};
use turnleaf_engine::GRAVITY;

use crate::exact::upright_gamma;
use crate::options;
use crate::report;
use crate::specimen::{LENGTH, Model, Piece, Specimen};

/// Where the bisection stops, as part of the weight.
const TOLERANCE: f64 = 2e-4;

/// Where a nudge would push the tip of a weightless strip, over its length.
const NUDGE: f64 = 1e-6;

/// How long a nudge lasts, how long after it the sway is watched for the first
/// time, and how long for the second, s.
const WATCHED: [f64; 3] = [0.2, 3.0, 3.0];

/// Runs `lab upright`.
pub fn run_upright(parser: &mut lexopt::Parser) -> Result<(), String> {
    let mut columns = None;
    let (model, json) = report::read(parser, |option, parser| {
        if option != "nodes" {
            return Ok(false);
        }
        columns = Some(options::number(parser, option, 6, 513)?);
        Ok(true)
    })?;
    let standing = |gamma: f64| Piece {
        columns,
        gravity: [-GRAVITY, 0.0, 0.0],
        ..Piece::of_gamma(gamma)
    };
    let (critical, how) = critical(model, standing)?;
    let exact = upright_gamma();
    print(json, model, critical, how, Some(exact), json!({}));
    Ok(())
}

/// Columns of the shell as a plate in a vertical plane.
const SHELL_COLUMNS: usize = 33;

/// Runs `lab lateral-buckling`.
pub fn run_lateral(parser: &mut lexopt::Parser) -> Result<(), String> {
    let (mut nu, mut aspect, mut columns) = (None, None, None);
    let (model, json) = report::read(parser, |option, parser| {
        match option {
            "nu" => nu = Some(options::number(parser, option, 0.0, 0.49)?),
            "aspect" => aspect = Some(options::number(parser, option, 0.05, 4.0)?),
            "nodes" => columns = Some(options::number(parser, option, 6, 513)?),
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    let nu = nu.ok_or("Lateral buckling needs --nu, Poisson's ratio.")?;
    let aspect: f64 = aspect.ok_or("Lateral buckling needs --aspect, height over length.")?;
    // The shell's cells are square, so that a high plate is as finely cut as a narrow one.
    let square = model == Model::Shell;
    let columns = columns.or(square.then_some(SHELL_COLUMNS));
    let rows = columns.filter(|_| square).map(|columns| {
        let cells = (columns - 1) as f64 * aspect;
        (cells.round() as usize + 1).clamp(9, 49)
    });
    let standing = |gamma: f64| Piece {
        columns,
        rows,
        breadth: aspect * LENGTH,
        poisson: nu,
        gravity: [0.0, -GRAVITY, 0.0],
        ..Piece::of_gamma(gamma)
    };
    let (critical, how) = critical(model, standing)?;
    print(
        json,
        model,
        critical,
        how,
        None,
        json!({ "nu": nu, "aspect": aspect }),
    );
    Ok(())
}

fn print(json: bool, model: Model, critical: f64, how: &str, exact: Option<f64>, of_which: Value) {
    let mut figures = json!({
        "model": model.name(),
        "settings": model.settings(),
        "gamma_critical": critical,
        "measured_by": how,
        "exact": { "gamma_critical": exact },
        "error": { "gamma_critical": exact.map(|exact| report::error(critical, exact)) },
    });
    for (name, value) in of_which.as_object().into_iter().flatten() {
        figures[name] = value.clone();
    }
    report::print(json, &figures);
}

/// The critical weight of a piece, and how it was found.
fn critical(model: Model, piece: impl Fn(f64) -> Piece) -> Result<(f64, &'static str), String> {
    let how = match model.make(&piece(1.0))?.is_stable() {
        Some(_) => "stability of the equilibrium",
        None => "growth of a nudge",
    };
    let (mut low, mut high) = (1.0, 2.0);
    while stands(model, &piece(high))? {
        (low, high) = (high, 2.0 * high);
        if high > 1e4 {
            return Err("The piece stands however heavy it is.".into());
        }
    }
    while high - low > TOLERANCE * high {
        let middle = 0.5 * (low + high);
        if stands(model, &piece(middle))? {
            low = middle;
        } else {
            high = middle;
        }
    }
    Ok((0.5 * (low + high), how))
}

/// Whether a piece that was put up straight stays so.
fn stands(model: Model, piece: &Piece) -> Result<bool, String> {
    let mut specimen = model.make(piece)?;
    if specimen.is_stable().is_none() {
        return outlives_a_nudge(&mut *specimen, piece);
    }
    // One that finds no rest, or only far from straight, has fallen over.
    let rests = specimen.rest().is_ok();
    let straight = specimen.tip()[2].abs() < 1e-3 * piece.length;
    Ok(rests && straight && specimen.is_stable() == Some(true))
}

/// Whether a nudge at the tip dies away.
fn outlives_a_nudge(specimen: &mut dyn Specimen, piece: &Piece) -> Result<bool, String> {
    let last = specimen.grid().0 - 1;
    let load = 3.0 * NUDGE * piece.stiffness * piece.breadth / piece.length.powi(2);
    let mut sway = [0.0; 3];
    for (watch, seconds) in WATCHED.into_iter().enumerate() {
        let force = if watch == 0 { load } else { 0.0 };
        specimen.load_column(last, [0.0, 0.0, force])?;
        for _ in 0..(seconds / specimen.time_step()).round() as usize {
            specimen.step();
            sway[watch] = f64::max(sway[watch], specimen.tip()[2].abs());
        }
    }
    // One that has already fallen may well sway less than it did as it fell.
    let fallen = sway[2] > 1e3 * NUDGE * piece.length;
    Ok(!fallen && sway[2] < sway[1])
}
