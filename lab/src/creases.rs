//! `lab creases`: creased strips of the sheet and of the shell beside every exact one of
//! the table that the tests have, and beside some that no table has.

use std::fmt::{self, Display, Formatter};
use std::path::PathBuf;

use clap::Args;
use serde::Serialize;

use crate::crease::{Creased, hang};
use crate::exact::CreasedElastica;
use crate::options::make_folder;
use crate::specimen::{Model, Settings};
use crate::table::Table;

/// Exact strips, integrated elsewhere.
const ANCHORS: &str = include_str!("../../engine/tests/anchors/creased_elastica.csv");

/// Strips in no table: Gamma, place, rest in degrees, stiffness.
const OTHERS: [[f64; 4]; 8] = [
    [0.5, 0.4, 45.0, 2.0],
    [4.0, 0.2, 135.0, 10.0],
    [8.0, 0.3, -60.0, f64::INFINITY],
    [15.0, 0.85, 150.0, 0.7],
    [25.0, 0.6, 90.0, 3.0],
    [28.0, 0.35, -120.0, 8.0],
    [60.0, 0.7, -30.0, 0.5],
    [90.0, 0.45, 75.0, f64::INFINITY],
];

/// Gammas up to which a row of the table of the worst goes.
const RANGES: [f64; 2] = [30.0, 100.0];

/// Angle beyond which a crease has closed as the weight grew, degrees: such a strip would
/// go through itself.
const CLOSED: f64 = 180.0;

/// Options of the experiment.
#[derive(Args)]
pub struct Options {
    /// Write the tables into a folder, as creases.json and creases_worst.json.
    #[arg(long)]
    into: Option<PathBuf>,
}

/// Every strip by both models.
#[derive(Serialize)]
pub struct Strips {
    /// Of the table that the tests have.
    anchors: Vec<Both>,
    /// Of no table.
    others: Vec<Both>,
    left_out: usize,
}

#[derive(Serialize)]
struct Both {
    sheet: Creased,
    shell: Creased,
    #[serde(skip)]
    strip: CreasedElastica,
}

/// The greatest distance of a tip, over the length, and of the angles of tip and crease,
/// degrees.
#[derive(Default)]
struct Worst {
    place: f64,
    tip: f64,
    crease: f64,
    strain: f64,
}

/// Runs the experiment.
///
/// # Errors
/// Where a strip does not come to rest, or a table cannot be written, in a sentence.
pub fn run(options: &Options) -> Result<Strips, String> {
    options.into.as_deref().map_or(Ok(()), make_folder)?;
    let rows: Vec<Vec<f64>> = ANCHORS.lines().skip(1).map(numbers).collect();
    let has_closed = |row: &&Vec<f64>| {
        let is_lighter = |other: &&Vec<f64>| other[1..4] == row[1..4] && other[0] <= row[0];
        let angles = rows.iter().filter(is_lighter).map(|other| other[7].abs());
        angles.fold(0.0, f64::max) > CLOSED
    };
    let known = rows.iter().filter(|row| !has_closed(row));
    let anchors: Result<Vec<Both>, String> = known
        .map(|row| both([row[0], row[1], row[2], row[3]]))
        .collect();
    let anchors = anchors?;
    let others: Result<Vec<Both>, String> = OTHERS.into_iter().map(both).collect();
    let strips = Strips {
        left_out: rows.len() - anchors.len(),
        anchors,
        others: others?,
    };
    if let Some(folder) = &options.into {
        strips.rows().write(folder, "creases")?;
        strips.worst().write(folder, "creases_worst")?;
    }
    Ok(strips)
}

fn numbers(line: &str) -> Vec<f64> {
    let number = |figure: &str| match figure {
        "rigid" => f64::INFINITY,
        _ => figure.parse().expect("the table has numbers"),
    };
    line.trim().split(',').map(number).collect()
}

fn both([gamma, at, rest, stiffness]: [f64; 4]) -> Result<Both, String> {
    let strip = CreasedElastica {
        gamma,
        at,
        rest: rest.to_radians(),
        stiffness,
    };
    Ok(Both {
        sheet: hang(strip, Model::Sheet(Settings::Book))?,
        shell: hang(strip, Model::Shell)?,
        strip,
    })
}

/// How far a strip's tip is off, over its length.
fn off(creased: &Creased) -> f64 {
    creased.error.reach.hypot(creased.error.drop)
}

impl Worst {
    fn include(&mut self, creased: &Creased) {
        self.place = self.place.max(off(creased));
        self.tip = self.tip.max(creased.error.tip_angle_deg.abs());
        self.crease = self.crease.max(creased.error.crease_angle_deg.abs());
        self.strain = self.strain.max(creased.max_edge_strain);
    }

    fn cells(&self) -> [String; 4] {
        [
            format!("{:.3} %", 100.0 * self.place),
            format!("{:.2}", self.tip),
            format!("{:.2}", self.crease),
            format!("{:.0e}", self.strain),
        ]
    }
}

impl Strips {
    /// The strips of no table, a row each.
    fn rows(&self) -> Table {
        let mut table = Table::new(&[
            "Γ, place, rest in °, stiffness",
            "exact reach and drop",
            "exact angles of tip and crease, °",
            "sheet: tip off by, of the length",
            "angles off by, °",
            "shell: tip off by",
            "angles off by, °",
        ]);
        for both in &self.others {
            let CreasedElastica { gamma, at, .. } = both.strip;
            let stiffness = match both.strip.stiffness {
                k if k.is_finite() => k.to_string(),
                _ => "rigid".into(),
            };
            let exact = &both.shell.exact;
            let of = |creased: &Creased| {
                [
                    format!("{:.3} %", 100.0 * off(creased)),
                    format!(
                        "{:.2}, {:.2}",
                        creased.error.tip_angle_deg.abs(),
                        creased.error.crease_angle_deg.abs()
                    ),
                ]
            };
            let mut row = vec![
                format!(
                    "{gamma}, {at}, {:.0}, {stiffness}",
                    both.strip.rest.to_degrees()
                ),
                format!("{:.5}, {:.5}", exact.reach, exact.drop),
                format!("{:.2}, {:.2}", exact.tip_angle_deg, exact.crease_angle_deg),
            ];
            row.extend(of(&both.sheet));
            row.extend(of(&both.shell));
            table.push(row);
        }
        table
    }

    /// The worst of the table that the tests have.
    fn worst(&self) -> Table {
        let mut table = Table::new(&[
            "",
            "strips",
            "tip off by, of the length, at worst",
            "angle of the tip, °",
            "angle of the crease, °",
            "edge strain",
            "strips beyond 1 % and 1°",
        ]);
        let mut least = 0.0;
        for most in RANGES {
            let within: Vec<&Both> = self
                .anchors
                .iter()
                .filter(|both| {
                    (least..=most).contains(&both.strip.gamma) && both.strip.gamma > least
                })
                .collect();
            for name in ["sheet", "shell"] {
                let mut worst = Worst::default();
                let mut beyond = 0;
                for both in &within {
                    let creased = if name == "sheet" {
                        &both.sheet
                    } else {
                        &both.shell
                    };
                    worst.include(creased);
                    let angles = creased.error.tip_angle_deg.abs();
                    let angles = angles.max(creased.error.crease_angle_deg.abs());
                    beyond += usize::from(off(creased) > 0.01 || angles > 1.0);
                }
                let mut row = vec![format!("{name}, Γ up to {most}"), within.len().to_string()];
                row.extend(worst.cells());
                row.push(beyond.to_string());
                table.push(row);
            }
            least = most;
        }
        table
    }
}

impl Display for Strips {
    fn fmt(&self, out: &mut Formatter) -> fmt::Result {
        for table in [self.worst(), self.rows()] {
            if out.alternate() {
                writeln!(out, "{table:#}")?;
            } else {
                writeln!(out, "{table}")?;
            }
        }
        writeln!(
            out,
            "{} strips whose crease closes as they grow heavier are left out.",
            self.left_out
        )
    }
}
