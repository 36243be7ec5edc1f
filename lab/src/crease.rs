//! `lab crease`: a strip with one crease hangs by its own weight from a level
//! clamp, by the shell.

use clap::Args;
use serde::Serialize;
use turnleaf_engine::{Crease, Discretisation, GRAVITY, Shell, ShellSettings};

use crate::exact::CreasedElastica;
use crate::options::between;
use crate::report::Lines;

/// Columns of nodes, of which there are as many more as the crease needs to lie on one.
const COLUMNS: std::ops::RangeInclusive<usize> = 65..=257;

/// Steps in which the weight grows: the equilibrium meant is that which grows out
/// of the weightless one.
const RAISES: usize = 20;

/// How far a node may still move in the last step to an equilibrium, over the length.
const TOLERANCE: f64 = 1e-9;

/// Angle from which on a crease counts as closed, degrees.
const MOST_FOLDED: f64 = 175.0;

/// Options of `lab crease`.
#[derive(Args)]
pub struct Options {
    /// Gamma, weight x length^3 / stiffness.
    #[arg(long, value_parser = between(1e-3, 1e3))]
    gamma: f64,
    /// Distance of the crease from the clamp, over the length.
    #[arg(long, value_parser = between(0.02, 0.98))]
    at: f64,
    /// Angle of the crease without moment, degrees upward.
    #[arg(long, allow_negative_numbers = true, value_parser = between(-180.0, 180.0))]
    rest: f64,
    /// Stiffness of the crease, k L / D [default: rigid]
    #[arg(long, value_parser = between(1e-3, 1e6))]
    stiffness: Option<f64>,
}

/// Where a creased strip is, or how far from there.
#[derive(Serialize)]
struct Hanging {
    reach: f64,
    drop: f64,
    tip_angle_deg: f64,
    crease_angle_deg: f64,
}

/// A creased strip of the shell beside the exact one.
#[derive(Serialize)]
pub struct Creased {
    model: &'static str,
    gamma: f64,
    at: f64,
    rest_deg: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    stiffness: Option<f64>,
    nodes: usize,
    #[serde(flatten)]
    found: Hanging,
    max_edge_strain: f64,
    exact: Hanging,
    /// Of the tip's place over the length, and of both angles in degrees.
    error: Hanging,
}

/// Runs `lab crease`.
///
/// # Errors
/// Where the strip falls over before it has its weight, in a sentence.
pub fn run(options: &Options) -> Result<Lines<Creased>, String> {
    let Options { gamma, at, .. } = *options;
    let rest = options.rest.to_radians();
    let stiffness = options.stiffness.unwrap_or(f64::INFINITY);
    let columns = columns(at);
    let exact = CreasedElastica {
        gamma,
        at: column(at, columns) as f64 / (columns - 1) as f64,
        rest,
        stiffness,
    }
    .hanging()?;
    let exact = Hanging {
        reach: exact.reach,
        drop: exact.drop,
        tip_angle_deg: exact.tip_angle.to_degrees(),
        crease_angle_deg: exact.crease_angle.to_degrees(),
    };
    let strip = ShellSettings::strip(columns, gamma);
    let crease = Crease {
        column: column(at, columns),
        rest,
        stiffness: stiffness * strip.rigidity.d11,
    };
    let mut shell = Shell::new(ShellSettings {
        discretisation: Discretisation::Triangles,
        creases: vec![crease],
        ..strip
    })
    .map_err(|error| error.to_string())?;
    for part in 1..=RAISES {
        shell.set_gravity([0.0, 0.0, -GRAVITY * part as f64 / RAISES as f64]);
        let settled = shell.settle(TOLERANCE);
        if crease_angle(&shell).abs() > MOST_FOLDED {
            return Err(
                "The crease closes as the weight grows: such a strip would go through itself."
                    .into(),
            );
        }
        settled.map_err(|error| error.to_string())?;
    }
    let found = hanging(&shell);
    // Angles of the shell are known but for whole turns.
    let turns = ((exact.tip_angle_deg - found.tip_angle_deg) / 360.0).round();
    let found = Hanging {
        tip_angle_deg: found.tip_angle_deg + 360.0 * turns,
        ..found
    };
    Ok(Lines(Creased {
        model: "shell",
        gamma,
        at,
        rest_deg: options.rest,
        stiffness: options.stiffness,
        nodes: columns,
        error: Hanging {
            reach: found.reach - exact.reach,
            drop: found.drop - exact.drop,
            tip_angle_deg: found.tip_angle_deg - exact.tip_angle_deg,
            crease_angle_deg: found.crease_angle_deg - exact.crease_angle_deg,
        },
        max_edge_strain: shell.max_edge_strain(),
        found,
        exact,
    }))
}

/// The number of columns nearest to one of which the crease is.
fn columns(at: f64) -> usize {
    let off = |columns: usize| (column(at, columns) as f64 / (columns - 1) as f64 - at).abs();
    let better = |best: usize, next: usize| {
        if off(next) < off(best) - 1e-9 {
            next
        } else {
            best
        }
    };
    COLUMNS.fold(*COLUMNS.start(), better)
}

/// The column nearest to a place.
fn column(at: f64, columns: usize) -> usize {
    (at * (columns - 1) as f64).round() as usize
}

/// Where the foot edge of a strip of length 1 is.
fn hanging(shell: &Shell) -> Hanging {
    let columns = shell.settings().columns;
    let places: &[[f64; 3]] = shell.positions().as_chunks().0;
    let [end, before, third] = [1, 2, 3].map(|back| places[columns - back]);
    // Of second order at the tip, from the last three nodes.
    let slope = [0, 2].map(|axis| 3.0 * end[axis] - 4.0 * before[axis] + third[axis]);
    Hanging {
        reach: end[0],
        drop: -end[2],
        tip_angle_deg: slope[1].atan2(slope[0]).to_degrees(),
        crease_angle_deg: crease_angle(shell),
    }
}

/// Angle of the one crease, degrees.
fn crease_angle(shell: &Shell) -> f64 {
    let angle = shell.crease_angle(0).expect("the shell has the crease");
    angle.to_degrees()
}
