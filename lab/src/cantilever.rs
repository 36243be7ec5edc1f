//! `lab cantilever` and `lab tip-load`: a strip clamped at one end hangs by its
//! own weight, or by a load at its tip.

use clap::Args;
use serde::Serialize;

use crate::exact::Elastica;
use crate::options::between;
use crate::report::{Compared, Lines, error};
use crate::specimen::{Held, Model, ModelOptions, Piece, Specimen};

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
///
/// # Errors
/// Where the model makes no such strip, or it comes to no rest, in a sentence.
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

/// Options of `lab cantilever`.
#[derive(Args)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// Gamma, weight x length^3 / stiffness.
    #[arg(long, value_parser = between(1e-3, 1e4))]
    gamma: f64,
    /// Angle of the clamp, degrees upward from level.
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true, value_parser = between(-180.0, 180.0))]
    clamp_angle: f64,
    /// Nodes from the clamp to the tip [default: the model's own number]
    #[arg(long, value_parser = between(4usize, 513))]
    nodes: Option<usize>,
}

/// What hangs, and where.
#[derive(Serialize)]
pub struct Hanging {
    gamma: f64,
    clamp_angle_deg: f64,
    #[serde(flatten)]
    tip: Tip,
    max_edge_strain: f64,
}

/// Where the tip of a strip is.
#[derive(Serialize)]
pub struct Tip {
    reach: f64,
    drop: f64,
    tip_angle_deg: f64,
}

/// How far it is from there, as parts of both ways and as a distance.
#[derive(Serialize)]
pub struct TipError {
    reach: f64,
    drop: f64,
    tip: f64,
}

/// Runs `lab cantilever`.
///
/// # Errors
/// Where the options name no model, or its strip comes to no rest, in a sentence.
pub fn run(options: &Options) -> Result<Lines<Compared<Hanging, Tip, TipError>>, String> {
    let (model, gamma) = (options.model.model()?, options.gamma);
    let clamp_angle = options.clamp_angle.to_radians();
    let found = rested(model, gamma, clamp_angle, options.nodes)?;
    let exact = Elastica {
        gamma,
        load: 0.0,
        clamp_angle,
    }
    .hanging();
    Ok(Lines(Compared {
        of: model.label(),
        found: Hanging {
            gamma,
            clamp_angle_deg: options.clamp_angle,
            tip: Tip {
                reach: found.reach,
                drop: found.drop,
                tip_angle_deg: found.tip_angle,
            },
            max_edge_strain: found.edge_strain,
        },
        exact: Tip {
            reach: exact.reach,
            drop: exact.drop,
            tip_angle_deg: exact.tip_angle.to_degrees(),
        },
        error: TipError {
            reach: error(found.reach, exact.reach),
            drop: error(found.drop, exact.drop),
            tip: (found.reach - exact.reach).hypot(found.drop - exact.drop),
        },
    }))
}

/// Options of `lab tip-load`.
#[derive(Args)]
pub struct TipLoadOptions {
    #[command(flatten)]
    model: ModelOptions,
    /// The load, P L^2 / stiffness.
    #[arg(long, value_parser = between(0.0, 1e3))]
    load: f64,
    /// Nodes from the clamp to the tip [default: the model's own number]
    #[arg(long, value_parser = between(4usize, 513))]
    nodes: Option<usize>,
}

/// What is loaded, and how far its tip has come.
#[derive(Serialize)]
pub struct Loaded {
    load: f64,
    #[serde(flatten)]
    tip: Way,
    max_edge_strain: f64,
}

/// How far a tip has come down, w, and in, u; and of an error the distance.
#[derive(Serialize)]
pub struct Way {
    w: f64,
    u: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    tip: Option<f64>,
}

/// Runs `lab tip-load`.
///
/// # Errors
/// Where the options name no model, or its strip comes to no rest, in a sentence.
pub fn run_tip_load(options: &TipLoadOptions) -> Result<Lines<Compared<Loaded, Way>>, String> {
    let (model, load) = (options.model.model()?, options.load);
    let piece = Piece {
        columns: options.nodes,
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
    let way = |w, u, tip| Way { w, u, tip };
    let (w, u) = (found.drop, 1.0 - found.reach);
    let (exact_w, exact_u) = (exact.drop, 1.0 - exact.reach);
    let apart = (w - exact_w).hypot(u - exact_u);
    Ok(Lines(Compared {
        of: model.label(),
        found: Loaded {
            load,
            tip: way(w, u, None),
            max_edge_strain: found.edge_strain,
        },
        exact: way(exact_w, exact_u, None),
        error: way(error(w, exact_w), error(u, exact_u), Some(apart)),
    }))
}
