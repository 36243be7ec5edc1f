//! `lab pear-loop`: a strip bent back until its two ends lie together in one
//! clamp.

use std::f64::consts::{FRAC_PI_2, PI};

use clap::Args;
use serde::Serialize;

use crate::exact::pear_loop;
use crate::options::between;
use crate::report::{Compared, Lines, error};
use crate::specimen::{Held, ModelOptions, Piece, Specimen};

/// Seconds in which the far end is bent back, and then brought to the other.
const BENDING: f64 = 2.0;

/// Options of the experiment.
#[derive(Args)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// Nodes from one end to the other [default: the model's own number]
    #[arg(long, value_parser = between(6usize, 513))]
    nodes: Option<usize>,
}

/// How large a loop is, over its length.
#[derive(Serialize)]
pub struct Size {
    height: f64,
    width: f64,
}

/// That, and its strain.
#[derive(Serialize)]
pub struct Loop {
    #[serde(flatten)]
    size: Size,
    max_edge_strain: f64,
}

/// Runs the experiment.
///
/// # Errors
/// Where the options name no model, or its strip comes to no rest, in a sentence.
pub fn run(options: &Options) -> Result<Lines<Compared<Loop, Size>>, String> {
    let model = options.model.model()?;
    let piece = Piece {
        columns: options.nodes,
        held: Held::TwoClamps(FRAC_PI_2),
        ..Piece::weightless()
    };
    let mut specimen = model.make(&piece)?;
    bend(&mut *specimen, piece.length)?;
    specimen.rest()?;
    let (height, width) = size(&*specimen);
    let (height, width) = (height / piece.length, width / piece.length);
    let exact = pear_loop();
    Ok(Lines(Compared {
        of: model.label(),
        found: Loop {
            size: Size { height, width },
            max_edge_strain: specimen.edge_strain(),
        },
        error: Size {
            height: error(height, exact.height),
            width: error(width, exact.width),
        },
        exact: Size {
            height: exact.height,
            width: exact.width,
        },
    }))
}

/// Bends a strip that stands upright into ever more of a circle until its far
/// end points down, and then brings that end to the other.
fn bend(piece: &mut dyn Specimen, length: f64) -> Result<(), String> {
    let steps = (BENDING / piece.time_step()).round() as usize;
    for step in 1..=steps {
        let turn = PI * step as f64 / steps as f64;
        let radius = length / turn;
        let (x, z) = (radius * (1.0 - turn.cos()), radius * turn.sin());
        piece.carry_end(x, z, FRAC_PI_2 - turn)?;
        piece.step();
    }
    for step in 1..=steps {
        let apart = 1.0 - step as f64 / steps as f64;
        piece.carry_end(apart * length * 2.0 / PI, 0.0, -FRAC_PI_2)?;
        piece.step();
    }
    Ok(())
}

/// Height over the clamp and width of a loop, m: the extremes of parabolas
/// through the nodes next to its own.
fn size(piece: &dyn Specimen) -> (f64, f64) {
    let columns = piece.grid().0;
    let extreme = |axis: usize, sign: f64| {
        let of = |column: usize| sign * piece.middle(column)[axis];
        let at = (1..columns - 1)
            .max_by(|a, b| of(*a).total_cmp(&of(*b)))
            .expect("columns");
        let [low, most, high] = [of(at - 1), of(at), of(at + 1)];
        let bend = low - 2.0 * most + high;
        most - (high - low) * (high - low) / (8.0 * bend)
    };
    (extreme(2, 1.0), extreme(0, 1.0) + extreme(0, -1.0))
}
