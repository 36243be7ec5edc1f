//! `lab convergence`: how fast a model nears the exact cantilever with more
//! nodes, and its own limit with shorter steps.

use serde_json::{Value, json};

use crate::cantilever::rested;
use crate::exact::Elastica;
use crate::report;
use crate::specimen::{Model, Piece};

/// Weight over stiffness of the strip.
const GAMMA: f64 = 10.0;

/// Runs the experiment.
pub fn run(parser: &mut lexopt::Parser) -> Result<(), String> {
    let (model, json) = report::read(parser, |_, _| Ok(false))?;
    let (columns, errors) = by_nodes(model)?;
    let cells: Vec<f64> = columns
        .iter()
        .map(|columns| 1.0 / (columns - 1) as f64)
        .collect();
    let (steps, changes) = by_step(model)?;
    let figures = json!({
        "model": model.name(),
        "settings": model.settings(),
        "gamma": GAMMA,
        "nodes": columns,
        "tip_error": errors,
        "order": slope(&cells, &errors),
        "time_steps": steps,
        "tip_change_to_half_step": changes,
        "order_in_time": slope(&steps, &changes),
    });
    if json {
        report::print(true, &figures);
        return Ok(());
    }
    println!(
        "Cantilever of {}, Gamma {GAMMA}; error of the tip over the length.",
        model.name()
    );
    table("nodes", &figures["nodes"], &figures["tip_error"]);
    println!("order {:.3}\n", slope(&cells, &errors));
    println!("Falling from level; change of the tip from a step to half of it.");
    table(
        "step, s",
        &figures["time_steps"],
        &figures["tip_change_to_half_step"],
    );
    println!("order {:.3}", slope(&steps, &changes));
    Ok(())
}

fn table(name: &str, left: &Value, right: &Value) {
    println!("{name:>12}");
    for (left, right) in left
        .as_array()
        .into_iter()
        .flatten()
        .zip(right.as_array().into_iter().flatten())
    {
        println!(
            "{:>12}  {:.3e}",
            left.to_string(),
            right.as_f64().unwrap_or(f64::NAN)
        );
    }
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
