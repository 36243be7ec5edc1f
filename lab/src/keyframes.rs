//! `lab keyframes`: what a recorded turn takes, and how near it is to the turn.
//!
//! A turn is simulated and recorded at 120 Hz, or at every step where these are
//! longer, and condensed. Its replay is then compared with the recording, frame
//! by frame, from the bytes of the file alone.

use std::path::PathBuf;

use clap::Args;
use serde::Serialize;
use turnleaf_engine::{
    Blend, Condensed, KeyFrames, LooseLeaf, LooseSettings, ModelKind, Replay, Side, Stock, TurnBy,
    TurnModel, uniform_samples,
};

use crate::options::{self, between, make_folder_of};
use crate::report::Lines;

/// A page, metres.
const PAGE: [f64; 2] = [0.14, 0.21];

/// Seconds between frames of the recording.
const APART: f64 = 1.0 / 120.0;

/// Options of the experiment.
#[derive(Args)]
pub struct Options {
    /// The model.
    #[arg(long, default_value = "sheet", value_parser = options::model_kind())]
    model: ModelKind,
    /// The gesture.
    #[arg(long, default_value = "corner", value_parser = options::turn_by())]
    gesture: TurnBy,
    /// The paper.
    #[arg(long, default_value = "book", value_parser = options::stock_name())]
    stock: &'static str,
    /// Duration of the gesture, s.
    #[arg(long, default_value_t = 0.8, value_parser = between(0.1f32, 60.0))]
    seconds: f32,
    /// Time recorded after it, s.
    #[arg(long, default_value_t = 0.0, value_parser = between(0.0f32, 60.0))]
    settle: f32,
    /// Columns of nodes [default: the model's own number]
    #[arg(long, value_parser = between(6usize, 65))]
    nodes: Option<usize>,
    /// Largest error over the width.
    #[arg(long, default_value_t = 0.001, value_parser = between(1e-5f32, 0.1))]
    tolerance: f32,
    /// Write the key frames into a file.
    #[arg(long)]
    out: Option<PathBuf>,
}

/// What the file is, and how far its replay is from the recording, over the width.
#[derive(Serialize)]
pub struct File {
    model: &'static str,
    gesture: &'static str,
    seconds: Option<f32>,
    points: [usize; 2],
    recorded_frames: usize,
    frames: usize,
    bytes: usize,
    bytes_of_floats: usize,
    error: f64,
    rms_error: f64,
    stated_error: f32,
}

/// Runs the experiment.
///
/// # Errors
/// Where the turn cannot be recorded or condensed so, or a file cannot be written, in a sentence.
pub fn run(options: &Options) -> Result<Lines<File>, String> {
    options.out.as_deref().map_or(Ok(()), make_folder_of)?;
    let recording = record(options)?;
    let [u, v] = [recording.columns, recording.rows].map(uniform_samples);
    let condensed =
        Condensed::of(&recording, &u, &v, options.tolerance).map_err(|error| error.to_string())?;
    let bytes = condensed.to_bytes();
    let read = Condensed::from_bytes(&bytes).map_err(|error| error.to_string())?;
    let (worst, mean) = error(&recording, read.frames.clone(), Blend::Hermite);
    if let Some(path) = &options.out {
        std::fs::write(path, &bytes)
            .map_err(|error| format!("{} cannot be written: {error}.", path.display()))?;
    }
    Ok(Lines(File {
        model: options.model.name(),
        gesture: options.gesture.name(),
        seconds: recording.times.last().copied(),
        points: [recording.columns, recording.rows],
        recorded_frames: recording.len(),
        frames: read.frames.len(),
        bytes: bytes.len(),
        bytes_of_floats: recording.to_bytes().len(),
        error: worst,
        rms_error: mean,
        stated_error: read.error,
    }))
}

/// A leaf of a model over a table; of masses and springs with paper's weight and
/// stiffness, interpolated.
///
/// `nodes` is the number of columns of nodes, which then lie as far apart as the
/// rows do; none for the model's own number.
///
/// # Errors
/// Where the model makes no such leaf, in a sentence.
pub fn leaf(model: ModelKind, stock: Stock, nodes: Option<usize>) -> Result<LooseLeaf, String> {
    let rows = |columns: usize| 1 + ((columns - 1) as f64 * PAGE[1] / PAGE[0]).round() as usize;
    let settings = LooseSettings {
        nodes: nodes.map(|columns| [columns, rows(columns)]),
        interpolate: true,
        preset: turnleaf_engine::Preset::Book,
        ..LooseSettings::leaf(model, PAGE, stock)
    };
    LooseLeaf::new(settings).map_err(|error| error.to_string())
}

/// Farthest and root mean square distance of a replay from a recording, over the width.
pub fn error(recording: &KeyFrames, frames: KeyFrames, blend: Blend) -> (f64, f64) {
    let replay = Replay::new(frames, blend, 1.0);
    let mut here = vec![0.0; recording.frame_length()];
    let mut rate = here.clone();
    let (mut worst, mut square) = (0.0f64, 0.0);
    for (frame, time) in recording.times.iter().enumerate() {
        replay.read_nodes_at(*time, &mut here, &mut rate);
        let points = here.as_chunks::<3>().0.iter();
        for (a, b) in points.zip(recording.frame(frame).as_chunks::<3>().0) {
            let apart: f64 = (0..3).map(|k| f64::from(a[k] - b[k]).powi(2)).sum();
            worst = worst.max(apart.sqrt());
            square += apart;
        }
    }
    let points = (recording.positions.len() / 3) as f64;
    let width = f64::from(recording.size[0]);
    (worst / width, (square / points).sqrt() / width)
}

fn record(options: &Options) -> Result<KeyFrames, String> {
    let stock = options::stock(options.stock);
    let mut leaf = leaf(options.model, stock, options.nodes)?;
    leaf.play(options.gesture, Side::Right, options.seconds);
    let apart = APART.max(f64::from(leaf.time_step()));
    leaf.record(apart);
    let seconds = f64::from(options.seconds + options.settle);
    for _ in 0..(seconds / apart).round() as usize {
        leaf.advance(apart);
    }
    leaf.finish_record().ok_or("Nothing was recorded.".into())
}
