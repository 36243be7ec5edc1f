//! Running a scene from start to end.

use std::hint::black_box;
use std::time::Instant;

use turnleaf_engine::{MassSpring, StrainRange, Surface, TurnModel, turn_hash, uniform_samples};

use crate::options::Scene;

/// What a turn looked like over all its steps.
pub struct Outcome {
    /// Number of steps.
    pub steps: usize,
    /// Strains of structural and shear springs, over all steps.
    pub edges: StrainRange,
    /// Strains of the drawn mesh's edges along u and v, over all steps.
    pub surface: StrainRange,
    /// Hash of all bits of all steps.
    pub hash: u64,
    /// Whether every number stayed finite.
    pub finite: bool,
}

/// Steps in a scene.
pub fn step_count(scene: &Scene, leaf: &MassSpring) -> usize {
    let seconds = f64::from(scene.seconds()) + f64::from(scene.settle());
    (seconds / f64::from(leaf.time_step())).round() as usize
}

/// Runs a scene and looks at every step.
///
/// # Errors
/// Where the scene makes no leaf, in a sentence.
pub fn observe(scene: &Scene) -> Result<Outcome, String> {
    let mut leaf = scene.leaf()?;
    let steps = step_count(scene, &leaf);
    let mut surface = Surface::new(2, 2);
    let (mut edges, mut drawn) = (StrainRange::default(), StrainRange::default());
    let mut finite = true;
    for _ in 0..steps {
        leaf.step();
        leaf.write_surface(&mut surface);
        finite &= leaf.is_finite();
        edges = edges.union(leaf.strain());
        let (u, v) = (
            uniform_samples(surface.columns),
            uniform_samples(surface.rows),
        );
        let (width, height) = (leaf.settings().width, leaf.settings().height);
        drawn = drawn.union(surface.strain(&u, &v, width, height));
    }
    Ok(Outcome {
        steps,
        edges,
        surface: drawn,
        hash: turn_hash(&mut scene.leaf()?, steps),
        finite,
    })
}

/// Microseconds that one step, and one surface, take: the median over
/// repetitions of the whole turn, each long enough for the clock.
///
/// # Errors
/// Where the scene makes no leaf, in a sentence.
pub fn cost(scene: &Scene) -> Result<(f64, f64), String> {
    let start = scene.leaf()?;
    let steps = step_count(scene, &start);
    let mut surface = Surface::new(2, 2);
    let turns = (20_000 / steps).max(1);
    let per_step = (0..9).map(|_| {
        let clock = Instant::now();
        for _ in 0..turns {
            let mut leaf = start.clone();
            for _ in 0..steps {
                leaf.step();
            }
            black_box(&leaf);
        }
        clock.elapsed().as_secs_f64() * 1e6 / (turns * steps) as f64
    });
    let per_step: Vec<f64> = per_step.collect();
    let mut leaf = start.clone();
    for _ in 0..steps / 2 {
        leaf.step();
    }
    let count = 20_000;
    let per_surface = (0..9).map(|_| {
        let clock = Instant::now();
        for _ in 0..count {
            black_box(&mut leaf).write_surface(&mut surface);
            black_box(&surface);
        }
        clock.elapsed().as_secs_f64() * 1e6 / f64::from(count)
    });
    Ok((median(per_step), median(per_surface.collect())))
}

/// The middle of some figures.
pub fn median(mut figures: Vec<f64>) -> f64 {
    figures.sort_by(f64::total_cmp);
    figures[figures.len() / 2]
}
