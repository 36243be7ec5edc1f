//! `lab models`: every way of turning a page on the same three turns, beside the
//! shell.
//!
//! A hand carries a leaf of book paper over in 1.2 s, by the middle of its
//! fore-edge, by its foot corner, or by that and lets go upright. Every way plays
//! the same path in the same time and is drawn 60 times a second; distances are
//! those of 26 x 26 places of the drawn surface from the same places of the
//! shell's, over the width of the page, in every frame.

mod measure;
mod photographs;
mod plot;
mod rows;
mod shape;
mod strips;
mod table;
mod timing;

use std::fmt::{self, Display, Formatter};
use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;

use crate::options::{self, between, make_folder, make_folder_of};
use measure::Figures;
use rows::{NODES, STEP, Source};
use timing::{AFTER, TURN};

/// Turns for the clock beyond the first; the shell, which takes minutes, has none.
const AGAIN: usize = 20;

/// Options of the experiment.
#[derive(Args)]
pub struct Options {
    /// The paper.
    #[arg(long, default_value = "book", value_parser = options::stock_name())]
    stock: &'static str,
    /// Columns of nodes of the shell.
    #[arg(long, default_value_t = NODES[0], value_parser = between(6usize, 65))]
    nodes: usize,
    /// Measure and draw only this row of the table, and the shell, from which distances are
    /// taken; may be given several times.
    #[arg(long, value_name = "NAME", value_parser = rows::name(), conflicts_with_all = ["plot", "into"])]
    only: Vec<String>,
    /// Write cost against fidelity into a file, as SVG.
    #[arg(long)]
    plot: Option<PathBuf>,
    /// Write each way at five moments into a folder, as PNG.
    #[arg(long)]
    pictures: Option<PathBuf>,
    /// Write the tables into a folder, as models.json and replays.json.
    #[arg(long)]
    into: Option<PathBuf>,
}

/// All ways beside each other.
#[derive(Serialize)]
pub struct Comparison {
    stock: &'static str,
    turn_seconds: f64,
    after_seconds: f64,
    frames: usize,
    points: usize,
    reference_nodes: [usize; 2],
    reference_step: f64,
    sheet_key_frame_tolerance: f64,
    photographs: usize,
    ways: Vec<Figures>,
}

/// Runs the experiment.
///
/// # Errors
/// Where a way makes no leaf, or a file cannot be written, in a sentence.
pub fn run(options: &Options) -> Result<Comparison, String> {
    for folder in [&options.pictures, &options.into].into_iter().flatten() {
        make_folder(folder)?;
    }
    options.plot.as_deref().map_or(Ok(()), make_folder_of)?;
    // As wide as high, or nearly.
    let rows = (NODES[1] * options.nodes / NODES[0]).max(4);
    let ways = rows::all(options::stock(options.stock), [options.nodes, rows]);
    let found = compare(
        options.stock,
        rows::with_references(ways, &options.only),
        [options.nodes, rows],
        options.pictures.as_deref(),
    )?;
    if let Some(path) = &options.plot {
        std::fs::write(path, plot::svg(&found.ways))
            .map_err(|error| format!("{} cannot be written: {error}.", path.display()))?;
    }
    if let Some(folder) = &options.into {
        table::of(&found.ways).write(folder, "models")?;
        table::replays(&found.ways).write(folder, "replays")?;
    }
    Ok(found)
}

impl Display for Comparison {
    fn fmt(&self, out: &mut Formatter) -> fmt::Result {
        table::of(&self.ways).fmt(out)?;
        writeln!(out)?;
        table::replays(&self.ways).fmt(out)
    }
}

fn compare(
    stock: &'static str,
    ways: Vec<rows::Way>,
    nodes: [usize; 2],
    pictures: Option<&Path>,
) -> Result<Comparison, String> {
    let mut seen: Vec<measure::Seen> = Vec::new();
    for way in &ways {
        if way.source == Source::Photographs {
            let reference = ways.iter().position(rows::Way::is_reference);
            let taken = reference.and_then(|at| seen.get(at));
            let tracks = &taken
                .ok_or("Photographs come after what they are of.")?
                .tracks;
            seen.push(photographs::look(tracks, AGAIN));
            continue;
        }
        let again = if way.settings.kind == turnleaf_engine::ModelKind::Shell {
            0
        } else {
            AGAIN
        };
        seen.push(measure::look(way, again)?);
    }
    if let Some(folder) = pictures {
        strips::write(folder, &ways, &seen)?;
    }
    let reference = ways.iter().position(rows::Way::is_reference);
    let reference = &seen[reference.expect("the shell is always among them")].tracks;
    let live_of = |way: &rows::Way| {
        let is_live = |other: &rows::Way| way.repeats(other);
        ways.iter().position(is_live).map(|at| &seen[at])
    };
    let figures = |(way, seen)| Figures::new(way, seen, reference, live_of(way));
    Ok(Comparison {
        stock,
        turn_seconds: TURN,
        after_seconds: AFTER,
        frames: measure::FRAMES,
        points: shape::POINTS,
        reference_nodes: nodes,
        reference_step: STEP,
        sheet_key_frame_tolerance: rows::SHEET_TOLERANCE,
        photographs: photographs::COUNT,
        ways: ways.iter().zip(&seen).map(figures).collect(),
    })
}
