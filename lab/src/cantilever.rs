//! `lab cantilever` and `lab tip-load`: a strip clamped at one end hangs by its
//! own weight, or by a load at its tip.

use serde_json::json;

use crate::exact::Elastica;
use crate::options;
use crate::report;
use crate::specimen::{Held, Model, Piece, Specimen};

/// A strip that has come to rest.
pub struct Rested {
    /// How far its tip is from the clamp horizontally, over its length.
    pub reach: f64,
    /// How far it is below the clamp.
    pub drop: f64,
    /// Angle of its tip upward from level, degrees.
    pub tip_angle: f64,
    /// Largest strain of an edge.
    pub edge_strain: f64,
}

impl Rested {
    /// A piece as it now lies.
    fn of(piece: &dyn Specimen, length: f64) -> Rested {
        let last = piece.grid().0 - 1;
        let [end, before, third] = [0, 1, 2].map(|back| piece.middle(last - back));
        // Of second order at the tip, from the last three nodes.
        let slope = [0, 2].map(|axis| 3.0 * end[axis] - 4.0 * before[axis] + third[axis]);
        Rested {
            reach: end[0] / length,
            drop: -end[2] / length,
            tip_angle: slope[1].atan2(slope[0]).to_degrees(),
            edge_strain: piece.edge_strain(),
        }
    }
}

/// A strip of a model at rest, its clamp `angle` radians upward from level.
pub fn rested(
    model: Model,
    gamma: f64,
    angle: f64,
    columns: Option<usize>,
) -> Result<Rested, String> {
    let piece = Piece {
        columns,
        held: Held::Clamp(angle),
        ..Piece::of_gamma(gamma)
    };
    let mut specimen = model.make(&piece)?;
    specimen.rest()?;
    Ok(Rested::of(&*specimen, piece.length))
}

/// Runs `lab cantilever`.
pub fn run(parser: &mut lexopt::Parser) -> Result<(), String> {
    let (mut gamma, mut degrees, mut columns) = (None, 0.0, None);
    let (model, json) = report::read(parser, |option, parser| {
        match option {
            "gamma" => gamma = Some(options::number(parser, option, 1e-3, 1e4)?),
            "clamp-angle" => degrees = options::number(parser, option, -180.0, 180.0)?,
            "nodes" => columns = Some(options::number(parser, option, 4, 513)?),
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    let gamma = gamma.ok_or("A cantilever needs --gamma, its weight over its stiffness.")?;
    let angle = f64::to_radians(degrees);
    let found = rested(model, gamma, angle, columns)?;
    let exact = Elastica {
        gamma,
        load: 0.0,
        clamp_angle: angle,
    }
    .hanging();
    let figures = json!({
        "model": model.name(),
        "settings": model.settings(),
        "gamma": gamma,
        "clamp_angle_deg": degrees,
        "reach": found.reach,
        "drop": found.drop,
        "tip_angle_deg": found.tip_angle,
        "max_edge_strain": found.edge_strain,
        "exact": {
            "reach": exact.reach,
            "drop": exact.drop,
            "tip_angle_deg": exact.tip_angle.to_degrees(),
        },
        "error": {
            "reach": report::error(found.reach, exact.reach),
            "drop": report::error(found.drop, exact.drop),
            "tip": (found.reach - exact.reach).hypot(found.drop - exact.drop),
        },
    });
    report::print(json, &figures);
    Ok(())
}

/// Runs `lab tip-load`.
pub fn run_tip_load(parser: &mut lexopt::Parser) -> Result<(), String> {
    let (mut load, mut columns) = (None, None);
    let (model, json) = report::read(parser, |option, parser| {
        match option {
            "load" => load = Some(options::number(parser, option, 0.0, 1e3)?),
            "nodes" => columns = Some(options::number(parser, option, 4, 513)?),
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    let load: f64 = load.ok_or("A tip load needs --load, P L^2 over the stiffness.")?;
    let piece = Piece {
        columns,
        ..Piece::weightless()
    };
    let mut specimen = model.make(&piece)?;
    let force = load * piece.stiffness * piece.breadth / (piece.length * piece.length);
    specimen.load_column(specimen.grid().0 - 1, [0.0, 0.0, -force])?;
    specimen.rest()?;
    let found = Rested::of(&*specimen, piece.length);
    let exact = Elastica {
        gamma: 0.0,
        load,
        clamp_angle: 0.0,
    }
    .hanging();
    let (w, u) = (found.drop, 1.0 - found.reach);
    let figures = json!({
        "model": model.name(),
        "settings": model.settings(),
        "load": load,
        "w": w,
        "u": u,
        "max_edge_strain": found.edge_strain,
        "exact": { "w": exact.drop, "u": 1.0 - exact.reach },
        "error": {
            "w": report::error(w, exact.drop),
            "u": report::error(u, 1.0 - exact.reach),
            "tip": (w - exact.drop).hypot(u - 1.0 + exact.reach),
        },
    });
    report::print(json, &figures);
    Ok(())
}
