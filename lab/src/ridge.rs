//! `lab ridge`: how the energy of a single stretching ridge grows with its length.
//!
//! A sheet is folded along a line at two opposite edges, which are held by sharp frames, X
//! apart. Between their corners the paper bends less sharply, at the cost of stretch. As
//! energy over bending stiffness depends on X over thickness alone, X is kept and the
//! thickness changes.

use clap::Args;
use serde::Serialize;
use turnleaf_engine::{MeshSettings, MeshShell};

use crate::options::between;
use crate::report::Lines;

/// Energy grows as X to this power at fixed thickness (Lobkovsky, Gentges, Li, Morse and
/// Witten 1995, "Scaling properties of stretching ridges in a crumpled elastic sheet").
const EXPONENT: f64 = 1.0 / 3.0;

/// X over thickness, of each row.
const LENGTHS: [f64; 6] = [1e3, 2e3, 4e3, 8e3, 16e3, 32e3];

/// Rows, the longest, of which the exponent is: shorter ridges have less, as their ends count.
const LONGEST: usize = 3;

/// Half of the sheet's width over X.
const HALF_WIDTH: f64 = 0.5;

/// Angle by which each side of the fold falls, radians: the frames are at a right angle.
const FALL: f64 = core::f64::consts::FRAC_PI_4;

/// How far a node may still move, over X.
const TOLERANCE: f64 = 1e-6;

/// Options of `lab ridge`.
#[derive(Args)]
pub struct Options {
    /// Cells along the ridge, and on either side of it.
    #[arg(long, default_value_t = 16, value_parser = between(8usize, 64))]
    cells: usize,
}

/// The exponent.
#[derive(Serialize)]
pub struct Exponent {
    exponent: f64,
}

/// A ridge of a length.
#[derive(Serialize)]
struct Row {
    length_over_thickness: f64,
    energy_over_stiffness: f64,
    bending_over_stretch: f64,
    /// The exponent from the row before to this.
    #[serde(skip_serializing_if = "Option::is_none")]
    exponent: Option<f64>,
}

/// The growth of a ridge's energy beside the exact one.
#[derive(Serialize)]
pub struct Ridge {
    model: &'static str,
    cells: usize,
    rows: Vec<Row>,
    #[serde(flatten)]
    found: Exponent,
    exact: Exponent,
    error: Exponent,
}

/// Runs `lab ridge`.
///
/// # Errors
/// Where the paper finds no rest, in a sentence.
pub fn run(options: &Options) -> Result<Lines<Ridge>, String> {
    let mut rows = Vec::new();
    let mut places = Vec::new();
    for length in LENGTHS {
        let mut row = ridge(length, options.cells, &mut places)?;
        row.exponent = rows
            .last()
            .map(|last: &Row| slope(&[last.point(), row.point()]));
        rows.push(row);
    }
    let points: Vec<[f64; 2]> = rows[LENGTHS.len() - LONGEST..]
        .iter()
        .map(|row| {
            [
                row.length_over_thickness.ln(),
                row.energy_over_stiffness.ln(),
            ]
        })
        .collect();
    let found = slope(&points);
    let exponent = |exponent| Exponent { exponent };
    Ok(Lines(Ridge {
        model: "shell",
        cells: options.cells,
        rows,
        found: exponent(found),
        exact: exponent(EXPONENT),
        error: exponent(found - EXPONENT),
    }))
}

impl Row {
    /// The logarithms of length and energy.
    fn point(&self) -> [f64; 2] {
        [self.length_over_thickness, self.energy_over_stiffness].map(f64::ln)
    }
}

/// Slope of the line through points, by least squares.
fn slope(points: &[[f64; 2]]) -> f64 {
    let mean = |axis: usize| points.iter().map(|p| p[axis]).sum::<f64>() / points.len() as f64;
    let [x, y] = [mean(0), mean(1)];
    let products: f64 = points.iter().map(|p| (p[0] - x) * (p[1] - y)).sum();
    let squares: f64 = points.iter().map(|p| (p[0] - x) * (p[0] - x)).sum();
    products / squares
}

/// A ridge of a length over thickness, from where the one before it came to rest.
fn ridge(length: f64, cells: usize, places: &mut Vec<[f64; 3]>) -> Result<Row, String> {
    // Finer towards the ridge, and along it towards its ends.
    let across = |row: usize| {
        let part = (row as f64 - cells as f64) / cells as f64;
        HALF_WIDTH * part.signum() * part.abs().powf(1.8)
    };
    let along = |column: usize| {
        let part = column as f64 / cells as f64;
        part - 0.7 * (2.0 * core::f64::consts::PI * part).sin() / (2.0 * core::f64::consts::PI)
    };
    let (columns, lines) = (cells + 1, 2 * cells + 1);
    let flat: Vec<[f64; 2]> = (0..columns * lines)
        .map(|node| [along(node % columns), across(node / columns)])
        .collect();
    let corners = (0..(lines - 1) * columns).filter(|node| node % columns != cells);
    let mut shell = MeshShell::new(MeshSettings {
        cells: corners
            .map(|foot| vec![foot, foot + 1, foot + columns + 1, foot + columns])
            .collect(),
        places: flat.clone(),
        bending: 1.0,
        membrane: 12.0 * length * length,
    })
    .map_err(|error| error.to_string())?;
    let (sin, cos) = FALL.sin_cos();
    let folded = |node: usize| {
        let [u, v] = flat[node];
        [u, v * cos, -v.abs() * sin]
    };
    if places.is_empty() {
        *places = (0..flat.len()).map(folded).collect();
    }
    shell.place(places);
    for row in 0..lines {
        for column in [0, cells] {
            let node = row * columns + column;
            shell.pin(node, Some(folded(node)));
        }
    }
    shell.settle(TOLERANCE).map_err(|error| error.to_string())?;
    *places = shell.positions().to_vec();
    let energy = shell.energy();
    Ok(Row {
        length_over_thickness: length,
        energy_over_stiffness: energy.bending + energy.membrane,
        bending_over_stretch: energy.bending / energy.membrane,
        exponent: None,
    })
}
