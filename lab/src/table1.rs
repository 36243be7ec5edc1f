//! `lab table1`: what key frames save, as Table 1 of the paper.
//!
//! One turn is the paper's workload: the control column on its half circle for
//! 11.4 s in steps of 1/60 s, and for each step one drawn frame of 676 points.
//!
//! Counted, live: gesture, forces, integration, synchronisation and
//! interpolation of every frame. Counted, replayed: finding the key frames,
//! interpolating those of masses, and blending, for every frame. Not counted on
//! either side: recording, normals, and drawing on a screen, which the paper's
//! own milliseconds hold and which no replay can save.
//!
//! With `--model` the same is measured of another model: the leaf of a book, 140 x
//! 210 mm, turned by its fore-edge, and frames of its surface.
//!
//! A replay interpolates every drawn frame, as the paper's does (steps 7 and 8 of its experiment);
//! `--interpolate key-frame` does so once a key frame.
//!
//! A turn takes about a millisecond, so each run repeats it, live and replayed
//! in alternation, and states the median turn, in time of the processor: other work on
//! the machine disturbs it least.

use std::fmt::{self, Display, Formatter};
use std::hint::black_box;
use std::time::Instant;

use clap::{Args, ValueEnum};
use cpu_time::ThreadTime;
use serde::Serialize;
use turnleaf_engine::{
    Blend, Condensed, FrameKind, KeyFrames, LooseLeaf, MassSpring, PAPER_INTERVAL, Recorder,
    Replay, Settings, Side, Stock, Surface, TurnBy, TurnModel, uniform_samples,
};

use crate::keyframes;
use crate::options::{self, Synchronisation, between};
use crate::simulate::median;

/// The paper's own means, milliseconds, without key frames and with them.
const PAPER_MEANS: [f64; 2] = [11395.0, 9678.0];
/// Duration of the turn: about the paper's mean time without key frames.
const SECONDS: f32 = 11.4;
/// Turns in a run.
const TURNS: usize = 60;
/// Seconds from one drawn frame to the next.
const FRAME: f64 = 1.0 / 60.0;
/// How near condensed frames are to the turn, over the width.
const TOLERANCE: f32 = 0.001;

/// Options of the experiment.
#[derive(Args)]
pub struct Options {
    /// Rows of the table.
    #[arg(long, default_value_t = 10, value_parser = between(1usize, 1000))]
    runs: usize,
    /// What the key frames hold.
    #[arg(long, default_value = "masses", value_parser = ["masses", "surface"])]
    frames: String,
    /// How the replay blends them.
    #[arg(long, default_value = "linear", value_parser = ["linear", "hermite"])]
    blend: String,
    /// When a replay of masses interpolates.
    #[arg(long, default_value = "frame", value_parser = ["key-frame", "frame"])]
    interpolate: String,
    /// The paper's leaf, or a loose one of any model, whose key frames hold the surface.
    #[arg(long, default_value = "paper", value_parser = options::model_kind_or_paper())]
    model: options::ModelOrPaper,
    /// Key frames of a loose leaf: every 0.1 s, or within 0.1 % of the width.
    #[arg(long, value_enum, default_value = "even")]
    keys: Keys,
    /// Duration of the turn, s.
    #[arg(long, default_value_t = SECONDS, value_parser = between(0.2f32, 60.0))]
    seconds: f32,
    #[command(flatten)]
    sync: Synchronisation,
}

#[derive(Clone, Copy, PartialEq, Serialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
enum Keys {
    Even,
    Condensed,
}

/// What is measured.
struct Plan {
    seconds: f32,
    kind: FrameKind,
    blend: Blend,
    each_frame: bool,
    keys: Keys,
}

/// The table.
#[derive(Serialize)]
pub struct Report {
    model: &'static str,
    seconds: f32,
    key_frames: usize,
    keys: Keys,
    replay_error: Option<f64>,
    runs: Vec<Row>,
    #[serde(rename = "mean_live_ms")]
    live: f64,
    #[serde(rename = "mean_replay_ms")]
    replay: f64,
    reduction_percent: f64,
    speed_ratio: f64,
    us_per_step: f64,
    us_per_surface: f64,
    us_per_replayed_frame: f64,
    turns_per_run: usize,
    frames_per_turn: usize,
    frames: String,
    blend: String,
    interpolation: &'static str,
    counted: &'static str,
}

/// Milliseconds of one turn, and what a replay saves of them.
#[derive(Serialize)]
struct Row {
    live_ms: f64,
    replay_ms: f64,
    reduction_percent: f64,
    speed_ratio: f64,
}

impl Row {
    fn new(live_ms: f64, replay_ms: f64) -> Row {
        Row {
            live_ms,
            replay_ms,
            reduction_percent: 100.0 * (1.0 - replay_ms / live_ms),
            speed_ratio: live_ms / replay_ms,
        }
    }
}

/// Runs the experiment.
///
/// # Errors
/// Where the options do not go together or make no leaf, in a sentence.
pub fn run(options: &Options) -> Result<Report, String> {
    let is_condensed = options.keys == Keys::Condensed;
    let plan = Plan {
        seconds: options.seconds,
        kind: match (options.model, &options.frames[..]) {
            (None, "masses") => FrameKind::Masses,
            _ => FrameKind::Surface,
        },
        blend: match &options.blend[..] {
            "linear" if !is_condensed => Blend::Linear,
            _ => Blend::Hermite,
        },
        each_frame: options.interpolate == "frame",
        keys: options.keys,
    };
    let mut leaf = match options.model {
        None if is_condensed => {
            return Err("--keys condensed is for a loose leaf; name one with --model.".into());
        }
        None => {
            let mut settings = Settings::paper_2014();
            options.sync.set(&mut settings);
            let leaf = MassSpring::new(settings).map_err(|error| error.to_string())?;
            Leaf::Paper(Box::new(leaf))
        }
        Some(_) if !options.sync.is_preset() => {
            return Err("--sync is for the paper's leaf; leave --model out.".into());
        }
        Some(model) => Leaf::Loose(Box::new(keyframes::leaf(model, Stock::BOOK, None)?)),
    };
    let steps = (f64::from(plan.seconds) / FRAME).round() as usize;
    let frames = leaf.record(&plan, steps)?;
    let replay_error = leaf
        .recording(&plan, steps)
        .map(|all| keyframes::error(&all, frames.clone(), plan.blend).0);
    let mut replay = Replay::new(frames, plan.blend, FRAME as f32);
    replay.interpolate_each_frame(plan.each_frame);
    let mut surface = Surface::new(26, 26);
    measure(&mut leaf, &mut replay, &mut surface, &plan, steps);
    let runs: Vec<Run> = (0..options.runs)
        .map(|_| measure(&mut leaf, &mut replay, &mut surface, &plan, steps))
        .collect();
    let mean = |figure: fn(&Run) -> f64| runs.iter().map(figure).sum::<f64>() / runs.len() as f64;
    let per_step =
        |figure: fn(&Run) -> f64| median(runs.iter().map(figure).collect()) * 1e3 / steps as f64;
    let means = Row::new(mean(|run| run.live), mean(|run| run.replay));
    Ok(Report {
        model: options.model.map_or("paper", |model| model.name()),
        seconds: plan.seconds,
        key_frames: replay.frames().len(),
        keys: plan.keys,
        replay_error,
        live: means.live_ms,
        replay: means.replay_ms,
        reduction_percent: means.reduction_percent,
        speed_ratio: means.speed_ratio,
        us_per_step: per_step(|run| run.step),
        us_per_surface: per_step(|run| run.surface),
        us_per_replayed_frame: per_step(|run| run.replay),
        runs: { runs.iter() }
            .map(|run| Row::new(run.live, run.replay))
            .collect(),
        turns_per_run: TURNS,
        frames_per_turn: steps,
        frames: format!("{:?}", plan.kind).to_lowercase(),
        blend: format!("{:?}", plan.blend).to_lowercase(),
        interpolation: match (plan.kind, plan.each_frame) {
            (FrameKind::Surface, _) => "no interpolation in the replay",
            (FrameKind::Masses, true) => "the replay interpolates every drawn frame",
            (FrameKind::Masses, false) => "the replay interpolates every key frame once",
        },
        counted: COUNTED,
    })
}

/// The leaf that is turned.
enum Leaf {
    Paper(Box<MassSpring>),
    Loose(Box<LooseLeaf>),
}

impl Leaf {
    fn start(&mut self, plan: &Plan) {
        match self {
            Leaf::Paper(leaf) => {
                leaf.lay_flat(Side::Left);
                let gesture = leaf.settings().column_gesture(plan.seconds);
                leaf.play(gesture);
            }
            Leaf::Loose(leaf) => leaf.play(TurnBy::Edge, Side::Left, plan.seconds),
        }
    }

    /// From one drawn frame to the next.
    fn step(&mut self) {
        match self {
            Leaf::Paper(leaf) => leaf.step(),
            Leaf::Loose(leaf) => leaf.advance(FRAME),
        }
    }

    fn write_surface(&mut self, surface: &mut Surface) {
        match self {
            Leaf::Paper(leaf) => leaf.write_surface(surface),
            Leaf::Loose(leaf) => leaf.write_surface(surface),
        }
    }

    /// The key frames of a turn.
    fn record(&mut self, plan: &Plan, steps: usize) -> Result<KeyFrames, String> {
        if plan.keys == Keys::Condensed {
            let all = self.recording(plan, steps).ok_or("Nothing was recorded.")?;
            let [u, v] = [all.columns, all.rows].map(uniform_samples);
            let condensed = Condensed::of(&all, &u, &v, TOLERANCE);
            return condensed
                .map(|condensed| condensed.frames)
                .map_err(|error| error.to_string());
        }
        self.start(plan);
        match self {
            Leaf::Paper(leaf) => {
                let mut recorder = Recorder::new(leaf, plan.kind, PAPER_INTERVAL);
                for _ in 0..steps {
                    leaf.step();
                    recorder.observe(leaf);
                }
                Ok(recorder.finish(leaf))
            }
            Leaf::Loose(leaf) => {
                leaf.record(f64::from(PAPER_INTERVAL));
                (0..steps).for_each(|_| leaf.advance(FRAME));
                leaf.finish_record().ok_or("Nothing was recorded.".into())
            }
        }
    }

    /// Every drawn frame of a turn; of the paper's leaf none, whose frames may be of masses.
    fn recording(&mut self, plan: &Plan, steps: usize) -> Option<KeyFrames> {
        self.start(plan);
        match self {
            Leaf::Paper(_) => None,
            Leaf::Loose(leaf) => {
                leaf.record(FRAME);
                (0..steps).for_each(|_| leaf.advance(FRAME));
                leaf.finish_record()
            }
        }
    }
}

/// Milliseconds of one turn.
struct Run {
    live: f64,
    replay: f64,
    step: f64,
    surface: f64,
}

/// One run: turns live, replayed and without surfaces, in alternation.
fn measure(
    leaf: &mut Leaf,
    replay: &mut Replay,
    surface: &mut Surface,
    plan: &Plan,
    steps: usize,
) -> Run {
    let (mut live, mut replayed, mut stepped) = (vec![], vec![], vec![]);
    // A shell takes seconds for what a sheet does in one.
    let most = Instant::now();
    for turn in 0..TURNS {
        if turn > 2 && most.elapsed().as_secs() > 4 {
            break;
        }
        leaf.start(plan);
        live.push(milliseconds(|| {
            for _ in 0..steps {
                black_box(&mut *leaf).step();
                leaf.write_surface(black_box(surface));
            }
        }));
        replay.rewind();
        replayed.push(milliseconds(|| {
            for _ in 0..steps {
                black_box(&mut *replay).step();
                replay.write_surface(black_box(surface));
            }
        }));
        leaf.start(plan);
        stepped.push(milliseconds(|| {
            for _ in 0..steps {
                black_box(&mut *leaf).step();
            }
        }));
    }
    let (live, replay, step) = (median(live), median(replayed), median(stepped));
    Run {
        live,
        replay,
        step,
        surface: live - step,
    }
}

fn milliseconds(work: impl FnOnce()) -> f64 {
    let clock = ThreadTime::now();
    work();
    clock.elapsed().as_secs_f64() * 1e3
}

impl Display for Report {
    fn fmt(&self, out: &mut Formatter) -> fmt::Result {
        let Report {
            model,
            seconds,
            key_frames,
            frames_per_turn,
            frames,
            blend,
            interpolation,
            ..
        } = self;
        writeln!(
            out,
            "One turn of {model}, {seconds} s, {frames_per_turn} drawn frames of 676 points; ms of processor time a turn, median of {TURNS} turns a run."
        )?;
        let apart = match self.keys {
            Keys::Condensed => "where the motion needs them",
            Keys::Even => "every 0.1 s",
        };
        writeln!(
            out,
            "{key_frames} key frames of the {frames}, {apart}, {blend} blend; {interpolation}."
        )?;
        if let Some(error) = self.replay_error {
            let percent = 100.0 * error;
            writeln!(
                out,
                "The replay is at most {percent:.3} % of the width from the turn."
            )?;
        }
        writeln!(
            out,
            "{COUNTED}\n\n  run      live    replay   saved   ratio of speeds"
        )?;
        let mut row = |name: &dyn Display, row: &Row| {
            writeln!(
                out,
                "{name:>5}  {:8.4}  {:8.4}  {:5.1} %  {:8.3}",
                row.live_ms, row.replay_ms, row.reduction_percent, row.speed_ratio
            )
        };
        for (index, run) in self.runs.iter().enumerate() {
            row(&(index + 1), run)?;
        }
        row(&"mean", &Row::new(self.live, self.replay))?;
        let [live, replay] = PAPER_MEANS;
        let paper = Row::new(live, replay);
        writeln!(
            out,
            "\nThe paper's: {live:.0} and {replay:.0} ms, {:.1} % saved, a ratio of {:.3}, whose part above 1 is its third row's {:.0} %.",
            paper.reduction_percent,
            paper.speed_ratio,
            100.0 * (paper.speed_ratio - 1.0)
        )?;
        writeln!(
            out,
            "A step with synchronisation takes {:.2} us, a surface {:.2} us, a replayed frame {:.2} us.",
            self.us_per_step, self.us_per_surface, self.us_per_replayed_frame
        )
    }
}

const COUNTED: &str = "Counted: all computation from gesture or key frames to the 676 points. \
Not counted: recording, normals, drawing on a screen.";
