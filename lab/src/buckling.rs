//! `lab upright` and `lab lateral-buckling`: the weight at which a piece that
//! stands falls over.
//!
//! Bisected between a weight at which it stands and one at which it does not. A
//! model that can tell whether an equilibrium is stable says so; any other is
//! nudged, by much less than would strain a sheet that bends two ways at once,
//! and either the nudge dies away or it grows.

use clap::Args;
use serde::Serialize;
use turnleaf_engine::GRAVITY;

use crate::exact::upright_gamma;
use crate::options::between;
use crate::report::{Compared, Lines, error};
use crate::specimen::{LENGTH, Model, ModelOptions, Piece, Specimen};

/// Where the bisection stops, as part of the weight.
const TOLERANCE: f64 = 2e-4;

/// Where a nudge would push the tip of a weightless strip, over its length.
const NUDGE: f64 = 1e-6;

/// How long a nudge lasts, how long after it the sway is watched for the first
/// time, and how long for the second, s.
const WATCHED: [f64; 3] = [0.2, 3.0, 3.0];

/// Options of `lab upright`.
#[derive(Args)]
pub struct UprightOptions {
    #[command(flatten)]
    model: ModelOptions,
    /// Nodes from the foot to the head [default: the model's own number]
    #[arg(long, value_parser = between(6usize, 513))]
    nodes: Option<usize>,
}

/// The weight at which a piece falls over, and how it was found.
#[derive(Serialize)]
pub struct Critical {
    gamma_critical: f64,
    measured_by: &'static str,
    /// A plate's Poisson's ratio, and its height over its length.
    #[serde(skip_serializing_if = "Option::is_none")]
    nu: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    aspect: Option<f64>,
}

/// The exact weight, where it is known.
#[derive(Serialize)]
pub struct Gamma {
    gamma_critical: Option<f64>,
}

/// Runs `lab upright`.
///
/// # Errors
/// Where the options name no model, or its piece comes to no rest, in a sentence.
pub fn run_upright(options: &UprightOptions) -> Result<Lines<Compared<Critical, Gamma>>, String> {
    let model = options.model.model()?;
    let standing = |gamma: f64| Piece {
        columns: options.nodes,
        gravity: [-GRAVITY, 0.0, 0.0],
        ..Piece::of_gamma(gamma)
    };
    let found = critical(model, standing)?;
    let exact = upright_gamma();
    let gamma = |gamma_critical| Gamma { gamma_critical };
    Ok(Lines(Compared {
        of: model.label(),
        exact: gamma(Some(exact)),
        error: gamma(Some(error(found.gamma_critical, exact))),
        found,
    }))
}

/// Columns of the shell as a plate in a vertical plane.
const SHELL_COLUMNS: usize = 33;

/// Options of `lab lateral-buckling`.
#[derive(Args)]
pub struct LateralOptions {
    #[command(flatten)]
    model: ModelOptions,
    /// Poisson's ratio.
    #[arg(long, value_parser = between(0.0, 0.49))]
    nu: f64,
    /// Height over length.
    #[arg(long, value_parser = between(0.05, 4.0))]
    aspect: f64,
    /// Nodes from the clamp to the tip [default: the model's own number]
    #[arg(long, value_parser = between(6usize, 513))]
    nodes: Option<usize>,
}

/// Runs `lab lateral-buckling`.
///
/// # Errors
/// Where the options name no model, or its piece comes to no rest, in a sentence.
pub fn run_lateral(options: &LateralOptions) -> Result<Lines<Compared<Critical, Gamma>>, String> {
    let model = options.model.model()?;
    let &LateralOptions { nu, aspect, .. } = options;
    // The shell's cells are square, so that a high plate is as finely cut as a narrow one.
    let square = model == Model::Shell;
    let columns = options.nodes.or(square.then_some(SHELL_COLUMNS));
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
    let unknown = || Gamma {
        gamma_critical: None,
    };
    Ok(Lines(Compared {
        of: model.label(),
        found: Critical {
            nu: Some(nu),
            aspect: Some(aspect),
            ..critical(model, standing)?
        },
        exact: unknown(),
        error: unknown(),
    }))
}

/// The critical weight of a piece, and how it was found.
fn critical(model: Model, piece: impl Fn(f64) -> Piece) -> Result<Critical, String> {
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
    Ok(Critical {
        gamma_critical: 0.5 * (low + high),
        measured_by: how,
        nu: None,
        aspect: None,
    })
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
