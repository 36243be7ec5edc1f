//! `lab vibration`: how a weightless strip clamped at one end vibrates, and how fast
//! its first mode dies away.
//!
//! A model with vibrations of its own says what they are. Any other is loaded
//! with its own inertia in the shape of a mode and rests in a shape nearer to
//! it: inverse iteration with the model as the solver, so what is measured is
//! its stiffness, with its mass lumped at the nodes.

use std::f64::consts::PI;

use clap::Args;
use serde::Serialize;

use crate::exact::vibration_roots;
use crate::options::{self, between};
use crate::report::{Lines, error};
use crate::specimen::{Label, ModelOptions, Piece, Specimen};

/// How far the tip is bent, over the length.
const BENT: f64 = 0.03;

/// Swings to one side that are watched as they die away, after the first.
const SWINGS: usize = 16;

/// Rounds of inverse iteration for a mode.
const ROUNDS: usize = 5;

/// Options of the experiment.
#[derive(Args)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// The paper.
    #[arg(long, default_value = "book", value_parser = options::stock_name())]
    stock: &'static str,
    /// Nodes from the clamp to the tip [default: the model's own number]
    #[arg(long, value_parser = between(8usize, 513))]
    nodes: Option<usize>,
}

/// How a strip vibrates.
#[derive(Serialize)]
pub struct Vibration {
    #[serde(flatten)]
    of: Label,
    stock: &'static str,
    damping: Option<f64>,
    roots: Vec<f64>,
    measured_by: &'static str,
    exact: Exact,
    error: Errors,
}

#[derive(Serialize)]
struct Exact {
    roots: [f64; 3],
    damping: f64,
}

#[derive(Serialize)]
struct Errors {
    roots: Vec<f64>,
}

/// Runs the experiment.
///
/// # Errors
/// Where the options name no model, or it makes no such strip, in a sentence.
pub fn run(options: &Options) -> Result<Lines<Vibration>, String> {
    let (model, stock) = (options.model.model()?, options::stock(options.stock));
    let piece = Piece {
        columns: options.nodes,
        grammage: stock.grammage,
        stiffness: stock.stiffness_across,
        loss: Some(stock.loss),
        ..Piece::weightless()
    };
    // A narrow strip in a vacuum, so that its own modes are those of bending.
    let narrow = Piece {
        breadth: 0.02 * piece.length,
        rows: Some(2),
        air: false,
        ..piece.clone()
    };
    let unit = (piece.grammage / piece.stiffness).sqrt() * piece.length * piece.length;
    let (rates, how) = match model
        .make(&narrow)
        .ok()
        .and_then(|mut strip| strip.frequencies(3))
    {
        Some(rates) => (rates, "eigenvalues of its stiffness and mass"),
        None => (
            by_loads(&mut *model.make(&piece)?, &piece)?,
            "inverse iteration with its stiffness",
        ),
    };
    let roots: Vec<f64> = rates.iter().map(|rate| (rate * unit).sqrt()).collect();
    let exact = vibration_roots();
    let errors: Vec<_> = roots
        .iter()
        .zip(exact)
        .map(|(root, exact)| error(*root, exact))
        .collect();
    let still = Piece {
        air: false,
        ..piece.clone()
    };
    let swings = swings(&mut *model.make(&still)?, &still, rates[0]);
    Ok(Lines(Vibration {
        of: model.label(),
        stock: options.stock,
        damping: swings.as_deref().map(damping),
        roots,
        measured_by: how,
        exact: Exact {
            roots: exact,
            damping: 0.5 * stock.loss,
        },
        error: Errors { roots: errors },
    }))
}

/// Heights of the swings of a piece that starts in the shape of its first mode, of an
/// angular frequency `rate`, to either side in turn, m; None where it cannot be put there.
fn swings(specimen: &mut dyn Specimen, piece: &Piece, rate: f64) -> Option<Vec<f64>> {
    let (columns, rows) = specimen.grid();
    let root = vibration_roots()[0];
    let ratio = (root.cosh() + root.cos()) / (root.sinh() + root.sin());
    let place = |node: usize| {
        let u = (node % columns) as f64 / (columns - 1) as f64;
        let x = root * u;
        let shape = x.cosh() - x.cos() - ratio * (x.sinh() - x.sin());
        let v = (node / columns) as f64 / (rows - 1) as f64;
        let height = 0.5 * BENT * piece.length * shape;
        [u * piece.length, v * piece.breadth, height]
    };
    let places: Vec<_> = (0..columns * rows).map(place).collect();
    specimen.put(&places).ok()?;
    let (mut found, mut most, mut side) = (Vec::new(), 0.0f64, 1.0);
    let steps = SWINGS as f64 * PI / (rate * specimen.time_step());
    for _ in 0..(2.0 * steps) as usize {
        specimen.step();
        let height = specimen.tip()[2];
        if height * side < 0.0 {
            found.push(most);
            (most, side) = (0.0, -side);
        }
        most = most.max(height.abs());
        if found.len() > SWINGS {
            return Some(found);
        }
    }
    None
}

/// The part of critical damping by which swings die away, after the first; that of paper
/// is half of its loss tangent.
fn damping(swings: &[f64]) -> f64 {
    let (first, last) = (swings[1], swings[swings.len() - 1]);
    (first / last).ln() / (PI * (swings.len() - 2) as f64)
}

/// The first three angular frequencies of a piece, rad/s.
fn by_loads(specimen: &mut dyn Specimen, piece: &Piece) -> Result<Vec<f64>, String> {
    let columns = specimen.grid().0;
    let cell = piece.length / (columns - 1) as f64;
    let mass = |column: usize| {
        let part = if column + 1 == columns { 0.5 } else { 1.0 };
        part * piece.grammage * piece.breadth * cell
    };
    let product = |a: &[f64], b: &[f64]| -> f64 {
        (0..columns)
            .map(|column| mass(column) * a[column] * b[column])
            .sum()
    };
    let slowest = (piece.stiffness / piece.grammage).sqrt() / (piece.length * piece.length);
    let mut modes: Vec<Vec<f64>> = Vec::new();
    let mut rates = Vec::new();
    for mode in 0..3 {
        let number = (mode as f64 + 0.5) * PI;
        let mut square = (number * number * slowest).powi(2);
        let mut shape: Vec<f64> = (0..columns)
            .map(|column| column as f64 / (columns - 1) as f64)
            .map(|u| u * u * (number * u).cos())
            .collect();
        for _ in 0..ROUNDS {
            for other in &modes {
                let part = product(&shape, other) / product(other, other);
                for (shape, other) in shape.iter_mut().zip(other) {
                    *shape -= part * other;
                }
            }
            let most = shape.iter().fold(0.0, |most: f64, z| most.max(z.abs()));
            for z in &mut shape {
                *z *= BENT * piece.length / most;
            }
            for column in 1..columns {
                let force = square * mass(column) * shape[column];
                specimen.load_column(column, [0.0, 0.0, force])?;
            }
            specimen.rest()?;
            let bent = mean_heights(specimen);
            square *= product(&bent, &shape) / product(&bent, &bent);
            shape = bent;
        }
        modes.push(shape);
        rates.push(square.sqrt());
    }
    Ok(rates)
}

/// Heights of the columns of a piece at rest, m: the mean of a second, as a
/// sheet in single precision trembles.
fn mean_heights(piece: &mut dyn Specimen) -> Vec<f64> {
    let columns = piece.grid().0;
    let steps = (1.0 / piece.time_step()).round() as usize;
    let mut sum = vec![0.0; columns];
    for _ in 0..steps {
        piece.step();
        for (column, sum) in sum.iter_mut().enumerate() {
            *sum += piece.middle(column)[2];
        }
    }
    sum.iter().map(|sum| sum / steps as f64).collect()
}
