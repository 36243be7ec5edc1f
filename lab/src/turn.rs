//! `lab turn`: one turn, measured over all its steps.

use serde_json::json;

use crate::options::{self, Scene};
use crate::simulate;

/// Runs the experiment.
pub fn run(parser: &mut lexopt::Parser) -> Result<(), String> {
    let mut scene = Scene::default();
    let json = options::read(parser, |option, parser| scene.take(option, parser))?;
    let outcome = simulate::observe(&scene)?;
    let (us_per_step, us_per_surface) = simulate::cost(&scene)?;
    let settings = scene.settings();
    let report = json!({
        "model": "mass-spring",
        "preset": scene.preset.name(),
        "gesture": scene.gesture,
        "seconds": rounded(scene.seconds()),
        "settle": rounded(scene.settle()),
        "integrator": format!("{:?}", settings.integrator),
        "synchronise": format!("{:?}", settings.synchronise),
        "interpolation": !scene.no_interpolation,
        "max_edge_strain": outcome.edges.max,
        "min_edge_strain": outcome.edges.min,
        "max_surface_strain": outcome.surface.max,
        "min_surface_strain": outcome.surface.min,
        "steps": outcome.steps,
        "us_per_step": us_per_step,
        "us_per_surface": us_per_surface,
        "hash": format!("{:016x}", outcome.hash),
        "finite": outcome.finite,
    });
    if json {
        println!("{report:#}");
        return Ok(());
    }
    println!(
        "{} {} turn of {} s, and {} s after",
        scene.preset.name(),
        scene.gesture,
        report["seconds"],
        report["settle"]
    );
    println!(
        "  edge strain     {:+.4} to {:+.4}",
        outcome.edges.min, outcome.edges.max
    );
    println!(
        "  surface strain  {:+.4} to {:+.4}",
        outcome.surface.min, outcome.surface.max
    );
    println!(
        "  steps           {}, {:.2} us each",
        outcome.steps, us_per_step
    );
    println!("  surface         {us_per_surface:.2} us each, without normals");
    println!(
        "  hash            {:016x}{}",
        outcome.hash,
        if outcome.finite { "" } else { ", NOT FINITE" }
    );
    Ok(())
}

/// A float as the decimal that was meant.
fn rounded(value: f32) -> f64 {
    (f64::from(value) * 1e6).round() / 1e6
}
