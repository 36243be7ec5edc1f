//! `lab keyframes`: what a recorded turn takes, and how near it is to the turn.
//!
//! A turn is simulated and recorded at 120 Hz, or at every step where these are
//! longer, and condensed. Its replay is then compared with the recording, frame
//! by frame, from the bytes of the file alone.

use std::path::Path;

use serde_json::{Value, json};
use turnleaf_engine::{
    Blend, Condensed, KeyFrames, LooseLeaf, LooseSettings, ModelKind, Replay, Side, Stock, TurnBy,
    TurnModel, uniform_samples,
};

use crate::options;

/// A page, metres.
const PAGE: [f64; 2] = [0.14, 0.21];

/// Seconds between frames of the recording.
const APART: f64 = 1.0 / 120.0;

/// A turn to record.
struct Turn {
    model: ModelKind,
    by: TurnBy,
    seconds: f32,
    settle: f32,
    stock: Stock,
    /// Columns of nodes; none for the model's own number.
    nodes: Option<usize>,
}

/// Runs the experiment.
pub fn run(parser: &mut lexopt::Parser) -> Result<(), String> {
    let mut turn = Turn {
        model: ModelKind::Sheet,
        by: TurnBy::Corner,
        seconds: 0.8,
        settle: 0.0,
        stock: Stock::BOOK,
        nodes: None,
    };
    let (mut tolerance, mut out) = (0.001, None);
    let json = options::read(parser, |option, parser| {
        match option {
            "model" => turn.model = model(parser, option)?,
            "gesture" => {
                turn.by =
                    TurnBy::ALL[options::choice(parser, option, &TurnBy::ALL.map(TurnBy::name))?];
            }
            "seconds" => turn.seconds = options::number(parser, option, 0.1, 60.0)?,
            "settle" => turn.settle = options::number(parser, option, 0.0, 60.0)?,
            "stock" => {
                let name = Stock::NAMES[options::choice(parser, option, &Stock::NAMES)?];
                turn.stock = Stock::named(name).expect("a preset");
            }
            "nodes" => turn.nodes = Some(options::number(parser, option, 6, 65)?),
            "tolerance" => tolerance = options::number(parser, option, 1e-5, 0.1)?,
            "out" => out = Some(options::text(parser, option)?),
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    let recording = turn.record()?;
    let [u, v] = [recording.columns, recording.rows].map(uniform_samples);
    let condensed =
        Condensed::of(&recording, &u, &v, tolerance).map_err(|error| error.to_string())?;
    let bytes = condensed.to_bytes();
    let figures = figures(&turn, &recording, &bytes)?;
    if let Some(out) = out {
        std::fs::write(Path::new(&out), &bytes).map_err(|error| format!("{out}: {error}."))?;
    }
    crate::report::print(json, &figures);
    Ok(())
}

/// The option's value as a model of loose leaves.
pub fn model(parser: &mut lexopt::Parser, option: &str) -> Result<ModelKind, String> {
    Ok(ModelKind::ALL[options::choice(parser, option, &ModelKind::ALL.map(ModelKind::name))?])
}

/// The same, or the paper's own leaf, which is none of them.
pub fn model_or_paper(
    parser: &mut lexopt::Parser,
    option: &str,
) -> Result<Option<ModelKind>, String> {
    let mut names = vec!["paper"];
    names.extend(ModelKind::ALL.map(ModelKind::name));
    let chosen = options::choice(parser, option, &names)?;
    Ok(chosen.checked_sub(1).map(|at| ModelKind::ALL[at]))
}

/// A leaf of a model over a table; of masses and springs with paper's weight and
/// stiffness, interpolated.
///
/// `nodes` is the number of columns of nodes, which then lie as far apart as the
/// rows do; none for the model's own number.
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

/// What the file is, and how far its replay is from the recording.
fn figures(turn: &Turn, recording: &KeyFrames, bytes: &[u8]) -> Result<Value, String> {
    let read = Condensed::from_bytes(bytes).map_err(|error| error.to_string())?;
    let (worst, mean) = error(recording, read.frames.clone(), Blend::Hermite);
    Ok(json!({
        "model": turn.model.name(),
        "gesture": turn.by.name(),
        "seconds": recording.times.last(),
        "points": [recording.columns, recording.rows],
        "recorded_frames": recording.len(),
        "frames": read.frames.len(),
        "bytes": bytes.len(),
        "bytes_of_floats": recording.to_bytes().len(),
        "error": worst,
        "rms_error": mean,
        "stated_error": read.error,
    }))
}

impl Turn {
    fn record(&self) -> Result<KeyFrames, String> {
        let mut leaf = leaf(self.model, self.stock, self.nodes)?;
        leaf.play(self.by, Side::Right, self.seconds);
        let apart = APART.max(f64::from(leaf.time_step()));
        leaf.record(apart);
        let frames = (f64::from(self.seconds + self.settle) / apart).round() as usize;
        for _ in 0..frames {
            leaf.advance(apart);
        }
        leaf.finish_record().ok_or("Nothing was recorded.".into())
    }
}
