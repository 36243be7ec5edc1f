//! `lab turn`: one turn, measured over all its steps.

use clap::Args;
use serde::Serialize;

use crate::options::Scene;
use crate::report::Lines;
use crate::simulate;

/// Options of the experiment.
#[derive(Args)]
pub struct Options {
    #[command(flatten)]
    scene: Scene,
}

/// What a turn looked like, and what it cost.
#[derive(Serialize)]
pub struct Turn {
    model: &'static str,
    preset: &'static str,
    gesture: String,
    seconds: f32,
    settle: f32,
    integrator: String,
    synchronise: String,
    interpolation: bool,
    max_edge_strain: f32,
    min_edge_strain: f32,
    max_surface_strain: f32,
    min_surface_strain: f32,
    steps: usize,
    us_per_step: f64,
    us_per_surface: f64,
    hash: String,
    finite: bool,
}

/// Runs the experiment.
///
/// # Errors
/// Where the scene makes no leaf, in a sentence.
pub fn run(Options { scene }: &Options) -> Result<Lines<Turn>, String> {
    let outcome = simulate::observe(scene)?;
    let (us_per_step, us_per_surface) = simulate::cost(scene)?;
    let settings = scene.settings();
    Ok(Lines(Turn {
        model: "mass-spring",
        preset: scene.preset.name(),
        gesture: scene.gesture.clone(),
        seconds: scene.seconds(),
        settle: scene.settle(),
        integrator: format!("{:?}", settings.integrator),
        synchronise: format!("{:?}", settings.synchronise),
        interpolation: !scene.no_interpolation,
        max_edge_strain: outcome.edges.max,
        min_edge_strain: outcome.edges.min,
        max_surface_strain: outcome.surface.max,
        min_surface_strain: outcome.surface.min,
        steps: outcome.steps,
        us_per_step,
        us_per_surface,
        hash: format!("{:016x}", outcome.hash),
        finite: outcome.finite,
    }))
}
