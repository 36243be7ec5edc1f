//! `lab convergence`: how fast a model nears the exact cantilever with more
//! nodes, and its own limit with shorter steps.

use clap::Args;
use serde::Serialize;

use crate::cantilever::rested;
use crate::exact::Elastica;
use crate::report::Lines;
use crate::specimen::{Label, Model, ModelOptions, Piece};

/// Weight over stiffness of the strip.
const GAMMA: f64 = 10.0;

/// Options of the experiment.
#[derive(Args)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
}

/// How fast a model nears the exact strip.
#[derive(Serialize)]
pub struct Convergence {
    #[serde(flatten)]
    of: Label,
    gamma: f64,
    nodes: Vec<usize>,
    tip_error: Vec<f64>,
    order: f64,
    time_steps: Vec<f64>,
    tip_change_to_half_step: Vec<f64>,
    order_in_time: f64,
}

/// Runs the experiment.
///
/// # Errors
/// Where the options name no model, or a strip of it comes to no rest, in a sentence.
pub fn run(options: &Options) -> Result<Lines<Convergence>, String> {
    let model = options.model.model()?;
    let (nodes, tip_error) = by_nodes(model)?;
    let cells: Vec<f64> = nodes.iter().map(|nodes| 1.0 / (nodes - 1) as f64).collect();
    let (time_steps, tip_change_to_half_step) = by_step(model)?;
    Ok(Lines(Convergence {
        of: model.label(),
        gamma: GAMMA,
        order: slope(&cells, &tip_error),
        nodes,
        tip_error,
        order_in_time: slope(&time_steps, &tip_change_to_half_step),
        time_steps,
        tip_change_to_half_step,
    }))
}

/// Numbers of nodes, and how far from the exact place the tip rests with each,
/// over the length.
fn by_nodes(model: Model) -> Result<(Vec<usize>, Vec<f64>), String> {
    let exact = Elastica {
        gamma: GAMMA,
        load: 0.0,
        clamp_angle: 0.0,
    }
    .hanging();
    let columns = model.refinement();
    let mut errors = Vec::new();
    for &columns in columns {
        let found = rested(model, GAMMA, 0.0, Some(columns))?;
        errors.push((found.reach - exact.reach).hypot(found.drop - exact.drop));
    }
    Ok((columns.to_vec(), errors))
}

/// Lengths of steps, s, and how much further half of each would bring the tip of
/// a strip that falls from level for a tenth of a second, over the length.
fn by_step(model: Model) -> Result<(Vec<f64>, Vec<f64>), String> {
    let longest = 1.0 / 120.0;
    let steps: Vec<f64> = (0..5)
        .map(|halvings| longest / f64::from(1 << halvings))
        .collect();
    let mut tips = Vec::new();
    for &step in &steps {
        let piece = Piece {
            time_step: Some(step),
            ..Piece::of_gamma(GAMMA)
        };
        let mut strip = model.make(&piece)?;
        for _ in 0..(0.1 / step).round() as usize {
            strip.step();
        }
        tips.push(strip.tip().map(|x| x / piece.length));
    }
    let changes = tips
        .windows(2)
        .map(|pair| (pair[0][0] - pair[1][0]).hypot(pair[0][2] - pair[1][2]));
    Ok((steps[..4].to_vec(), changes.collect()))
}

/// Slope of the straight line through points on logarithmic axes.
fn slope(x: &[f64], y: &[f64]) -> f64 {
    let logs = |values: &[f64]| -> Vec<f64> { values.iter().map(|value| value.ln()).collect() };
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (x, y) = (logs(x), logs(y));
    let (middle_x, middle_y) = (mean(&x), mean(&y));
    let pairs = || x.iter().zip(&y).map(|(x, y)| (x - middle_x, y - middle_y));
    pairs().map(|(x, y)| x * y).sum::<f64>() / pairs().map(|(x, _)| x * x).sum::<f64>()
}
