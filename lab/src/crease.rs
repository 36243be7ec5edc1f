//! `lab crease`: a strip with one crease hangs by its own weight from a level
//! clamp, by the sheet or the shell.

use clap::Args;
use serde::Serialize;
use turnleaf_engine::{
    Crease, Discretisation, GRAVITY, Root, Sheet, SheetCrease, SheetSettings, Shell, ShellSettings,
    TurnModel,
};

use crate::exact::CreasedElastica;
use crate::options::between;
use crate::report::Lines;
use crate::specimen::{Label, Model, ModelOptions, Piece, Settings, stock};

/// Columns of nodes of the shell, of which there are as many more as the crease needs to lie
/// on one.
const COLUMNS: std::ops::RangeInclusive<usize> = 65..=257;

/// Steps in which the weight grows: the equilibrium meant is that which grows out
/// of the weightless one.
const RAISES: usize = 20;

/// How far a node of the shell may still move in the last step to an equilibrium, over the
/// length.
const TOLERANCE: f64 = 1e-9;

/// Seconds that the sheet has for each step of the weight, and at the end.
const SWINGING: f64 = 1.0;
const SETTLING: f64 = 20.0;

/// What slows the sheet beside air meanwhile, 1/s: its shape at rest is as it is without.
const SLOWER: f64 = 4.0;

/// Speed at which it is at rest, m/s.
const STILL: f32 = 1e-4;

/// Angle from which on a crease counts as closed, degrees.
const MOST_FOLDED: f64 = 175.0;

/// Options of `lab crease`.
#[derive(Args)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
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
pub struct Hanging {
    /// How far the tip is from the clamp horizontally, over the length.
    pub reach: f64,
    /// How far it is below the clamp, over the length.
    pub drop: f64,
    /// Angle of the tip upward from level, degrees.
    pub tip_angle_deg: f64,
    /// Angle of the crease, degrees, above 0 where the strip is turned up.
    pub crease_angle_deg: f64,
}

/// A creased strip of a model at rest.
struct Rested {
    hanging: Hanging,
    nodes: usize,
    max_edge_strain: f64,
}

/// A creased strip beside the exact one.
#[derive(Serialize)]
pub struct Creased {
    #[serde(flatten)]
    of: Label,
    gamma: f64,
    at: f64,
    rest_deg: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    stiffness: Option<f64>,
    nodes: usize,
    #[serde(flatten)]
    found: Hanging,
    /// Largest strain of an edge.
    pub max_edge_strain: f64,
    /// Where the exact strip is.
    pub exact: Hanging,
    /// Of the tip's place over the length, and of both angles in degrees.
    pub error: Hanging,
}

/// Runs `lab crease`.
///
/// # Errors
/// Where the strip falls over before it has its weight, in a sentence.
pub fn run(options: &Options) -> Result<Lines<Creased>, String> {
    let strip = CreasedElastica {
        gamma: options.gamma,
        at: options.at,
        rest: options.rest.to_radians(),
        stiffness: options.stiffness.unwrap_or(f64::INFINITY),
    };
    hang(strip, options.model.model()?).map(Lines)
}

/// Hangs a strip of a model beside the exact one.
///
/// # Errors
/// As [`run`].
pub fn hang(mut strip: CreasedElastica, model: Model) -> Result<Creased, String> {
    let rested = match model {
        Model::Sheet(settings) => by_sheet(&strip, settings)?,
        Model::Shell => {
            // Its crease lies along a column of nodes.
            let columns = columns(strip.at);
            strip.at = column(strip.at, columns) as f64 / (columns - 1) as f64;
            by_shell(&strip, columns)?
        }
        Model::MassSpring => return Err("Masses and springs have no creases.".into()),
    };
    let exact = strip.hanging()?;
    let exact = Hanging {
        reach: exact.reach,
        drop: exact.drop,
        tip_angle_deg: exact.tip_angle.to_degrees(),
        crease_angle_deg: exact.crease_angle.to_degrees(),
    };
    // Angles of a model are known but for whole turns.
    let found = rested.hanging;
    let turns = ((exact.tip_angle_deg - found.tip_angle_deg) / 360.0).round();
    let found = Hanging {
        tip_angle_deg: found.tip_angle_deg + 360.0 * turns,
        ..found
    };
    Ok(Creased {
        of: model.label(),
        gamma: strip.gamma,
        at: strip.at,
        rest_deg: strip.rest.to_degrees(),
        stiffness: strip.stiffness.is_finite().then_some(strip.stiffness),
        nodes: rested.nodes,
        error: Hanging {
            reach: found.reach - exact.reach,
            drop: found.drop - exact.drop,
            tip_angle_deg: found.tip_angle_deg - exact.tip_angle_deg,
            crease_angle_deg: found.crease_angle_deg - exact.crease_angle_deg,
        },
        max_edge_strain: rested.max_edge_strain,
        found,
        exact,
    })
}

/// What a strip whose crease has closed says.
fn closed() -> String {
    "The crease closes as the weight grows: such a strip would go through itself.".into()
}

fn by_shell(strip: &CreasedElastica, columns: usize) -> Result<Rested, String> {
    let settings = ShellSettings::strip(columns, strip.gamma);
    let crease = Crease::elastic(
        column(strip.at, columns),
        strip.rest,
        strip.stiffness * settings.rigidity.d11,
    );
    let mut shell = Shell::new(ShellSettings {
        discretisation: Discretisation::Triangles,
        creases: vec![crease],
        ..settings
    })
    .map_err(|error| error.to_string())?;
    let angle = |shell: &Shell| {
        let angle = shell.crease_angle(0).expect("the shell has the crease");
        angle.to_degrees()
    };
    for part in 1..=RAISES {
        shell.set_gravity([0.0, 0.0, -GRAVITY * part as f64 / RAISES as f64]);
        let settled = shell.settle(TOLERANCE);
        if angle(&shell).abs() > MOST_FOLDED {
            return Err(closed());
        }
        settled.map_err(|error| error.to_string())?;
    }
    let places: &[[f64; 3]] = shell.positions().as_chunks().0;
    Ok(Rested {
        hanging: hanging(&places[..columns], 1.0, angle(&shell)),
        nodes: columns,
        max_edge_strain: shell.max_edge_strain(),
    })
}

/// A strip of the sheet, from a shape without weight that is folded to the rest angle.
fn by_sheet(strip: &CreasedElastica, settings: Settings) -> Result<Rested, String> {
    let piece = Piece::of_gamma(strip.gamma);
    let length = piece.length;
    let whole = settings.sheet([length, piece.breadth], stock(&piece));
    // No broader than the fewest rows need: the strip bends one way.
    let rows = 4;
    let breadth = piece.breadth * (rows - 1) as f64 / (whole.rows - 1) as f64;
    let mut sheet = Sheet::new(SheetSettings {
        rows,
        height: breadth,
        root: Root::Clamped,
        gravity: [0.0; 3],
        ..whole
    })
    .map_err(|error| error.to_string())?;
    let crease = SheetCrease {
        through: [[strip.at, 0.0], [strip.at, 1.0]],
        rest: strip.rest,
        stiffness: strip.stiffness * piece.stiffness / length,
        yields: f64::INFINITY,
        creep: 0.0,
    };
    sheet.crease(&[crease]).map_err(|error| error.to_string())?;
    let (sin, cos) = strip.rest.sin_cos();
    let corner = strip.at * length;
    let flat: &[[f32; 3]] = sheet.positions().as_chunks().0;
    let folded = flat.iter().flat_map(|&[x, y, _]| {
        let beyond = (f64::from(x) - corner).max(0.0);
        let along = f64::from(x).min(corner);
        [(along + beyond * cos) as f32, y, (beyond * sin) as f32]
    });
    let folded: Vec<f32> = folded.collect();
    sheet.write_nodes(&folded, &vec![0.0; folded.len()]);
    let angle = |sheet: &Sheet| {
        let [angle, _] = sheet.crease_angle(0).expect("the sheet has the crease");
        f64::from(angle).to_degrees()
    };
    let step = f64::from(sheet.time_step());
    for part in 1..=RAISES {
        sheet.set_gravity([0.0, 0.0, -GRAVITY * part as f64 / RAISES as f64]);
        let seconds = if part == RAISES { SETTLING } else { SWINGING };
        for _ in 0..(seconds / step) as usize {
            sheet.step();
            sheet.slow((1.0 - SLOWER * step) as f32);
        }
        if angle(&sheet).abs() > MOST_FOLDED {
            return Err(closed());
        }
    }
    if sheet.greatest_speed() > STILL {
        return Err(format!(
            "The strip still moves after {SETTLING} s, at {:.1e} m/s.",
            sheet.greatest_speed()
        ));
    }
    let columns = sheet.grid_size().0;
    let places: &[[f32; 3]] = sheet.positions().as_chunks().0;
    let foot: Vec<[f64; 3]> = places[..columns].iter().map(|x| x.map(f64::from)).collect();
    Ok(Rested {
        hanging: hanging(&foot, length, angle(&sheet)),
        nodes: columns,
        max_edge_strain: f64::from(sheet.max_edge_strain()),
    })
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

/// Where the foot edge of a strip is, whose crease is turned by `crease_angle_deg`.
fn hanging(foot: &[[f64; 3]], length: f64, crease_angle_deg: f64) -> Hanging {
    let [before, end] = [foot[foot.len() - 2], foot[foot.len() - 1]];
    // The free end bears no moment, and is straight.
    let tip_angle_deg = (end[2] - before[2]).atan2(end[0] - before[0]).to_degrees();
    Hanging {
        reach: end[0] / length,
        drop: -end[2] / length,
        tip_angle_deg,
        crease_angle_deg,
    }
}
