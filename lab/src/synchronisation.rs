//! `lab synchronisation`: both readings of the paper's synchronisation, and a leaf
//! without it, on the same turns.
//!
//! The preset's reading leaves fixed and held masses where they are; that of the
//! paper's words moves every mass of a group and takes the dog-ear line from its
//! end points. How far each strains the springs, and how far masses depart from the
//! spine and from the hand that should hold them, is measured after every step.

use std::fmt::{self, Display, Formatter};
use std::path::PathBuf;

use clap::Args;
use serde::Serialize;
use turnleaf_engine::{Gesture, Grip, MassSpring, Settings, StrainRange, Synchronise, TurnModel};

use crate::options::{between, make_folder};
use crate::table::Table;

/// Duration of a turn: about the paper's mean time without key frames. What follows
/// it is watched for two seconds more.
const SECONDS: f32 = 11.4;
const AFTER: f32 = 2.0;

/// Readings, in the order of the table.
const READINGS: [(&str, Synchronise); 4] = [
    ("none", Synchronise::Off),
    ("preset: columns", Synchronise::Columns),
    (
        "preset: 45°",
        Synchronise::DogEar {
            angle: std::f32::consts::FRAC_PI_4,
        },
    ),
    ("paper's words", Synchronise::Literal),
];

/// Options of the experiment.
#[derive(Args)]
pub struct Options {
    /// Duration of a turn, s.
    #[arg(long, default_value_t = SECONDS, value_parser = between(0.2f32, 600.0))]
    seconds: f32,
    /// Write the table into a folder, as synchronisation.json.
    #[arg(long)]
    into: Option<PathBuf>,
}

/// Every turn by every reading.
#[derive(Serialize)]
pub struct Readings {
    seconds: f32,
    rows: Vec<Row>,
}

#[derive(Serialize)]
struct Row {
    turn: &'static str,
    reading: &'static str,
    #[serde(flatten)]
    outcome: Outcome,
}

/// What a turn looked like over all its steps; lengths over the leaf's width.
#[derive(Serialize)]
struct Outcome {
    max_edge_strain: f32,
    min_edge_strain: f32,
    /// The farthest that a mass of the spine was from it.
    from_spine: f32,
    /// The farthest that a held mass was from its hand.
    from_hand: f32,
    /// The farthest that a mass was from where it is without synchronisation.
    from_classic: f32,
}

/// Runs the experiment.
///
/// # Errors
/// Where a turn cannot be simulated so, or the table cannot be written, in a sentence.
pub fn run(options: &Options) -> Result<Readings, String> {
    options.into.as_deref().map_or(Ok(()), make_folder)?;
    let seconds = options.seconds;
    let settings = Settings::paper_2014();
    let turns = [
        ("whole column", settings.column_gesture(seconds)),
        ("column, foot first", settings.corner_gesture(seconds)),
        (
            "foot corner alone",
            Gesture {
                grip: Grip::FootCorner,
                ..settings.column_gesture(seconds)
            },
        ),
    ];
    let mut rows = Vec::new();
    for (turn, gesture) in turns {
        for (reading, synchronise) in READINGS {
            let outcome = observe(synchronise, gesture)?;
            rows.push(Row {
                turn,
                reading,
                outcome,
            });
        }
    }
    let found = Readings { seconds, rows };
    if let Some(folder) = &options.into {
        found.table().write(folder, "synchronisation")?;
    }
    Ok(found)
}

/// Turns a leaf and looks at every step.
fn observe(synchronise: Synchronise, gesture: Gesture) -> Result<Outcome, String> {
    let leaf = |synchronise| {
        let settings = Settings {
            synchronise,
            ..Settings::paper_2014()
        };
        let mut leaf = MassSpring::new(settings).map_err(|error| error.to_string())?;
        leaf.play(gesture);
        Ok::<_, String>(leaf)
    };
    let (mut leaf, mut classic) = (leaf(synchronise)?, leaf(Synchronise::Off)?);
    let (columns, rows) = leaf.grid_size();
    let (width, height) = (leaf.settings().width, leaf.settings().height);
    let mut strain = StrainRange::default();
    let mut outcome = Outcome {
        max_edge_strain: 0.0,
        min_edge_strain: 0.0,
        from_spine: 0.0,
        from_hand: 0.0,
        from_classic: 0.0,
    };
    let most = |most: &mut f32, a: [f32; 3], b: [f32; 3]| {
        let square: f32 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
        *most = most.max(square.sqrt() / width);
    };
    let steps = ((gesture.seconds + AFTER) / leaf.time_step()).round() as usize;
    for _ in 0..steps {
        leaf.step();
        classic.step();
        strain = strain.union(leaf.strain());
        for row in 0..rows {
            let v = row as f32 / (rows - 1) as f32;
            let y = v * height;
            most(
                &mut outcome.from_spine,
                leaf.position(0, row),
                [0.0, y, 0.0],
            );
            if gesture.holds(row) {
                let hand = gesture.position(v, y, leaf.time());
                most(
                    &mut outcome.from_hand,
                    leaf.position(columns - 1, row),
                    hand,
                );
            }
            for column in 0..columns {
                let (a, b) = (leaf.position(column, row), classic.position(column, row));
                most(&mut outcome.from_classic, a, b);
            }
        }
    }
    Ok(Outcome {
        max_edge_strain: strain.max,
        min_edge_strain: strain.min,
        ..outcome
    })
}

impl Readings {
    fn table(&self) -> Table {
        let mut table = Table::new(&[
            "turn, reading",
            "stretch %",
            "compression %",
            "off the spine %",
            "off the hand %",
            "off the classic leaf %",
        ]);
        for Row {
            turn,
            reading,
            outcome,
        } in &self.rows
        {
            let mut row = vec![format!("{turn}, {reading}")];
            let figures = [
                outcome.max_edge_strain,
                outcome.min_edge_strain,
                outcome.from_spine,
                outcome.from_hand,
                outcome.from_classic,
            ];
            row.extend(figures.map(percent));
            table.push(row);
        }
        table
    }
}

impl Display for Readings {
    fn fmt(&self, out: &mut Formatter) -> fmt::Result {
        self.table().fmt(out)
    }
}

/// Per cent, to a tenth; 0 where rounding alone is left.
fn percent(figure: f32) -> String {
    if figure.abs() < 5e-6 {
        return "0".into();
    }
    format!("{:.1}", 100.0 * figure)
}
