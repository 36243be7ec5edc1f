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

use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use turnleaf_engine::Stock;

use crate::options;
use crate::report;
use rows::Source;
use timing::{AFTER, TURN};

/// Nodes and step of the reference. Its two discretisations tell how fine that is.
const NODES: [usize; 2] = [17, 23];
const STEP: f64 = 1.0 / 240.0;

/// Turns for the clock beyond the first; the shell, which takes minutes, has none.
const AGAIN: usize = 20;

/// Runs the experiment.
pub fn run(parser: &mut lexopt::Parser) -> Result<(), String> {
    let (mut name, mut markdown, mut nodes) = ("book", false, NODES[0]);
    let (mut plot, mut pictures, mut into) = (None, None, None);
    let json = options::read(parser, |option, parser| {
        match option {
            "stock" => name = Stock::NAMES[options::choice(parser, option, &Stock::NAMES)?],
            "markdown" => markdown = true,
            "plot" => plot = Some(PathBuf::from(options::text(parser, option)?)),
            "pictures" => pictures = Some(PathBuf::from(options::text(parser, option)?)),
            "into" => into = Some(PathBuf::from(options::text(parser, option)?)),
            "nodes" => nodes = options::number(parser, option, 6, 65)?,
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    let stock = Stock::named(name).expect("a preset");
    // As wide as high, or nearly.
    let rows = NODES[1] * nodes / NODES[0];
    let figures = compare(stock, name, [nodes, rows.max(4)], pictures.as_deref())?;
    if let Some(path) = plot {
        std::fs::write(&path, plot::svg(&figures))
            .map_err(|error| format!("{} cannot be written: {error}.", path.display()))?;
    }
    if let Some(path) = into {
        report::insert(&path, "models", &table::of(&figures, true))?;
        report::insert(&path, "replay", &table::replays(&figures))?;
    }
    if json {
        println!("{figures:#}");
    } else {
        print!("{}", table::of(&figures, markdown));
        print!("\n{}", table::replays(&figures));
    }
    Ok(())
}

fn compare(
    stock: Stock,
    name: &str,
    nodes: [usize; 2],
    pictures: Option<&Path>,
) -> Result<Value, String> {
    let ways = rows::all(stock, nodes, STEP);
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
    let place = |is: &dyn Fn(&rows::Way) -> bool| {
        ways.iter()
            .position(is)
            .expect("the shell and the sheet are among them")
    };
    let reference = &seen[place(&|way| way.is_reference())].tracks;
    let live_of = |way: &rows::Way| {
        if !matches!(way.source, Source::Record(..) | Source::Condensed(_)) {
            return None;
        }
        let same =
            |other: &rows::Way| other.source == Source::Live && other.settings == way.settings;
        Some(&seen[place(&same)])
    };
    let rows: Vec<Value> = ways
        .iter()
        .zip(&seen)
        .map(|(way, seen)| {
            // All three improvements together have no live leaf of their own.
            let live = (way.name != "mass-spring, all three")
                .then(|| live_of(way))
                .flatten();
            measure::figures(way, seen, reference, live)
        })
        .collect();
    Ok(json!({
        "stock": name,
        "turn_seconds": TURN,
        "after_seconds": AFTER,
        "frames": measure::FRAMES,
        "points": shape::POINTS,
        "reference_nodes": nodes,
        "reference_step": STEP,
        "sheet_key_frame_tolerance": rows::SHEET_TOLERANCE,
        "photographs": photographs::COUNT,
        "ways": rows,
    }))
}
