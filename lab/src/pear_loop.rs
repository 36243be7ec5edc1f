//! `lab pear-loop`: a strip bent back until its two ends lie together in one
//! clamp.

use std::f64::consts::{FRAC_PI_2, PI};

use serde_json::json;

use crate::exact::pear_loop;
use crate::options;
use crate::report;
use crate::specimen::{Held, Piece, Specimen};

/// Seconds in which the far end is bent back, and then brought to the other.
const BENDING: f64 = 2.0;

/// Runs the experiment.
pub fn run(parser: &mut lexopt::Parser) -> Result<(), String> {
    let mut columns = None;
    let (model, json) = report::read(parser, |option, parser| {
        if option != "nodes" {
            return Ok(false);
        }
        columns = Some(options::number(parser, option, 6, 513)?);
        Ok(true)
    })?;
    let piece = Piece {
        columns,
        held: Held::TwoClamps(FRAC_PI_2),
        ..Piece::weightless()
    };
    let mut specimen = model.make(&piece)?;
    bend(&mut *specimen, piece.length)?;
    specimen.rest()?;
    let (height, width) = size(&*specimen);
    let (height, width) = (height / piece.length, width / piece.length);
    let exact = pear_loop();
    let figures = json!({
        "model": model.name(),
        "settings": model.settings(),
        "height": height,
        "width": width,
        "max_edge_strain": specimen.edge_strain(),
        "exact": { "height": exact.height, "width": exact.width },
        "error": {
            "height": report::error(height, exact.height),
            "width": report::error(width, exact.width),
        },
    });
    report::print(json, &figures);
    Ok(())
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
