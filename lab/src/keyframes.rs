//! `lab keyframes`: what a recorded turn takes, and how near it is to the turn.
//!
//! A turn is simulated step by step, every step of it recorded, and condensed.
//! Its replay is then compared with the recording at every step again, from the
//! bytes of the file alone.

use std::path::Path;

use serde_json::{Value, json};
use turnleaf_engine::{
    Blend, Condensed, Contact, Gesture, KeyFrames, Kinematic, KinematicSettings, MassSpring,
    ModelKind, Replay, Root, Settings, Shape, Sheet, SheetSettings, Side, Stock, Surface,
    TurnModel, uniform_samples,
};

use crate::options;

/// A page, metres.
const PAGE: [f64; 2] = [0.14, 0.21];

/// Points of the surface along either side.
const POINTS: usize = 26;

const MODELS: [&str; 6] = ["sheet", "mass-spring", "rigid", "peel", "cylinder", "cone"];

/// A turn to record.
struct Turn {
    model: String,
    corner: bool,
    seconds: f32,
    settle: f32,
    stock: Stock,
}

/// Runs the experiment.
pub fn run(parser: &mut lexopt::Parser) -> Result<(), String> {
    let mut turn = Turn {
        model: "sheet".into(),
        corner: true,
        seconds: 0.8,
        settle: 0.0,
        stock: Stock::BOOK,
    };
    let (mut tolerance, mut out) = (0.001, None);
    let json = options::read(parser, |option, parser| {
        match option {
            "model" => turn.model = MODELS[options::choice(parser, option, &MODELS)?].into(),
            "gesture" => turn.corner = options::choice(parser, option, &["edge", "corner"])? == 1,
            "seconds" => turn.seconds = options::number(parser, option, 0.1, 60.0)?,
            "settle" => turn.settle = options::number(parser, option, 0.0, 60.0)?,
            "stock" => {
                let name = Stock::NAMES[options::choice(parser, option, &Stock::NAMES)?];
                turn.stock = Stock::named(name).expect("a preset");
            }
            "tolerance" => tolerance = options::number(parser, option, 1e-5, 0.1)?,
            "out" => out = Some(options::text(parser, option)?),
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    let recording = turn.record()?;
    let even = uniform_samples(POINTS);
    let condensed =
        Condensed::of(&recording, &even, &even, tolerance).map_err(|error| error.to_string())?;
    let bytes = condensed.to_bytes();
    let figures = figures(&turn, &recording, &bytes)?;
    if let Some(out) = out {
        std::fs::write(Path::new(&out), &bytes).map_err(|error| format!("{out}: {error}."))?;
    }
    crate::report::print(json, &figures);
    Ok(())
}

/// What the file is, and how far its replay is from the recording.
fn figures(turn: &Turn, recording: &KeyFrames, bytes: &[u8]) -> Result<Value, String> {
    let read = Condensed::from_bytes(bytes).map_err(|error| error.to_string())?;
    let width = f64::from(recording.size[0]);
    let replay = Replay::new(read.frames.clone(), Blend::Hermite, 1.0);
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
    let points = (recording.len() * recording.columns * recording.rows) as f64;
    Ok(json!({
        "model": turn.model,
        "gesture": if turn.corner { "corner" } else { "edge" },
        "seconds": recording.times.last(),
        "points": [recording.columns, recording.rows],
        "recorded_frames": recording.len(),
        "frames": read.frames.len(),
        "bytes": bytes.len(),
        "bytes_of_floats": recording.to_bytes().len(),
        "error": worst / width,
        "rms_error": (square / points).sqrt() / width,
        "stated_error": read.error,
    }))
}

impl Turn {
    /// Every step of the turn.
    fn record(&self) -> Result<KeyFrames, String> {
        match self.model.as_str() {
            "sheet" => self.record_sheet(),
            "mass-spring" => {
                let settings = Settings::book(0.14, 0.21, self.stock.grammage as f32);
                let mut leaf = MassSpring::new(settings).map_err(|error| error.to_string())?;
                leaf.lay_flat(Side::Right);
                leaf.play(self.path());
                Ok(self.follow(&mut leaf, ModelKind::MassSpring, |_, _| {}))
            }
            name => {
                let (shape, kind) = match name {
                    "peel" => (Shape::Peel, ModelKind::Peel),
                    "cylinder" => (Shape::Cylinder, ModelKind::Cylinder),
                    "cone" => (Shape::Cone, ModelKind::Cone),
                    _ => (Shape::Rigid, ModelKind::Rigid),
                };
                let settings = KinematicSettings::leaf(shape, PAGE[0], PAGE[1], self.stock);
                let mut leaf = Kinematic::new(settings).map_err(|error| error.to_string())?;
                leaf.play(self.path());
                Ok(self.follow(&mut leaf, kind, |_, _| {}))
            }
        }
    }

    /// A hand carries the corner, or the middle of the edge, of a leaf over a table.
    fn record_sheet(&self) -> Result<KeyFrames, String> {
        let settings = SheetSettings {
            root: Root::Hinged(0.0),
            ..SheetSettings::leaf(PAGE[0], PAGE[1], self.stock)
        };
        let mut sheet = Sheet::new(settings).map_err(|error| error.to_string())?;
        let even = uniform_samples(POINTS);
        sheet.draw_samples(&even, &even);
        for contacts in sheet.contacts_mut() {
            contacts[0] = Contact {
                normal: [0.0, 0.0, 1.0],
                friction: self.stock.friction as f32,
                firmness: 1.0,
                ..Contact::default()
            };
        }
        let v = if self.corner { 0.0 } else { 0.5 };
        let path = Gesture {
            pull: 0.12,
            rise: if self.corner { 0.03 } else { 0.0 },
            lag: 0.0,
            ..self.path()
        };
        sheet.grab(0, 1.0, v);
        Ok(self.follow(&mut sheet, ModelKind::Sheet, |sheet, time| {
            if time < self.seconds {
                sheet.pull(0, path.position(v, v * PAGE[1] as f32, time));
            } else {
                sheet.release(0);
            }
        }))
    }

    fn path(&self) -> Gesture {
        let make = if self.corner {
            Gesture::corner
        } else {
            Gesture::column
        };
        make(Side::Right, PAGE[0] as f32, self.seconds)
    }

    /// Steps a model to the end of the turn; `lead` moves the hand before each step.
    fn follow<M: TurnModel>(
        &self,
        model: &mut M,
        kind: ModelKind,
        mut lead: impl FnMut(&mut M, f32),
    ) -> KeyFrames {
        let mut surface = Surface::new(POINTS, POINTS);
        model.write_surface(&mut surface);
        let size = PAGE.map(|side| side as f32);
        let mut recording = KeyFrames::of_surface(kind, size, &surface);
        let (start, step) = (model.time(), model.time_step());
        recording.take(0.0, &surface);
        let steps = ((self.seconds + self.settle) / step).round() as usize;
        for count in 1..=steps {
            lead(model, count as f32 * step);
            model.step();
            model.write_surface(&mut surface);
            recording.take(model.time() - start, &surface);
        }
        recording
    }
}
