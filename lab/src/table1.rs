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
//! A turn takes about a millisecond, so each run repeats it, live and replayed
//! in alternation, and states the median turn, which other work on
//! the machine disturbs least.

use std::hint::black_box;
use std::time::Instant;

use serde_json::json;
use turnleaf_engine::{
    Blend, Condensed, FrameKind, KeyFrames, LooseLeaf, MassSpring, PAPER_INTERVAL, Recorder,
    Replay, Settings, Side, Stock, Surface, TurnBy, TurnModel, uniform_samples,
};

use crate::options::{self, Sync};
use crate::simulate::median;
use crate::{keyframes, keyframes::error};

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

/// What is measured.
struct Plan {
    seconds: f32,
    kind: FrameKind,
    blend: Blend,
    each_frame: bool,
    condensed: bool,
}

/// Runs the experiment.
pub fn run(parser: &mut lexopt::Parser) -> Result<(), String> {
    let (mut runs, mut model, mut sync) = (10, None, Sync::default());
    let mut plan = Plan {
        seconds: SECONDS,
        kind: FrameKind::Masses,
        blend: Blend::Linear,
        each_frame: false,
        condensed: false,
    };
    let json = options::read(parser, |option, parser| {
        match option {
            "runs" => runs = options::number(parser, option, 1, 1000)?,
            "frames" => {
                let kinds = [FrameKind::Masses, FrameKind::Surface];
                plan.kind = kinds[options::choice(parser, option, &["masses", "surface"])?];
            }
            "blend" => {
                let blends = [Blend::Linear, Blend::Hermite];
                plan.blend = blends[options::choice(parser, option, &["linear", "hermite"])?];
            }
            "interpolate" => {
                plan.each_frame = options::choice(parser, option, &["key-frame", "frame"])? == 1;
            }
            "sync" => sync = Sync::read(parser, option)?,
            "model" => model = keyframes::model_or_paper(parser, option)?,
            "keys" => {
                plan.condensed = options::choice(parser, option, &["even", "condensed"])? == 1;
            }
            "seconds" => plan.seconds = options::number(parser, option, 0.2, 60.0)?,
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    let mut leaf = match model {
        None if plan.condensed => {
            return Err("--keys condensed is for a loose leaf; name one with --model.".into());
        }
        None => {
            let mut settings = Settings::paper_2014();
            sync.set(&mut settings);
            let leaf = MassSpring::new(settings).map_err(|error| error.to_string())?;
            Leaf::Paper(Box::new(leaf))
        }
        Some(_) if sync != Sync::default() => {
            return Err("--sync is for the paper's leaf; leave --model out.".into());
        }
        Some(model) => {
            plan.kind = FrameKind::Surface;
            Leaf::Loose(Box::new(keyframes::leaf(model, Stock::BOOK, None)?))
        }
    };
    if plan.condensed {
        plan.blend = Blend::Hermite;
    }
    let steps = (f64::from(plan.seconds) / FRAME).round() as usize;
    let frames = leaf.record(&plan, steps)?;
    let near = leaf
        .recording(&plan, steps)
        .map(|all| error(&all, frames.clone(), plan.blend).0);
    let mut replay = Replay::new(frames, plan.blend, FRAME as f32);
    replay.interpolate_each_frame(plan.each_frame);
    let mut surface = Surface::new(26, 26);
    measure(&mut leaf, &mut replay, &mut surface, &plan, steps);
    let figures: Vec<Run> = (0..runs)
        .map(|_| measure(&mut leaf, &mut replay, &mut surface, &plan, steps))
        .collect();
    let name = model.map_or("paper", |model| model.name());
    report(
        &figures,
        steps,
        &plan,
        (name, replay.frames().len(), near),
        json,
    );
    Ok(())
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
        if plan.condensed {
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
    let clock = Instant::now();
    work();
    clock.elapsed().as_secs_f64() * 1e3
}

fn report(
    runs: &[Run],
    steps: usize,
    plan: &Plan,
    (model, key_frames, near): (&str, usize, Option<f64>),
    json: bool,
) {
    let &Plan {
        seconds,
        kind,
        blend,
        each_frame,
        condensed,
    } = plan;
    let mean = |figure: fn(&Run) -> f64| runs.iter().map(figure).sum::<f64>() / runs.len() as f64;
    let (live, replay) = (mean(|run| run.live), mean(|run| run.replay));
    let reduction = 100.0 * (1.0 - replay / live);
    let per_step =
        |figure: fn(&Run) -> f64| median(runs.iter().map(figure).collect()) * 1e3 / steps as f64;
    let (us_per_step, us_per_surface) = (per_step(|run| run.step), per_step(|run| run.surface));
    let each = match (kind, each_frame) {
        (FrameKind::Surface, _) => "no interpolation in the replay",
        (FrameKind::Masses, true) => "the replay interpolates every drawn frame",
        (FrameKind::Masses, false) => "the replay interpolates every key frame once",
    };
    if json {
        let rows: Vec<_> = runs
            .iter()
            .map(|run| json!({ "live_ms": run.live, "replay_ms": run.replay, "reduction_percent": 100.0 * (1.0 - run.replay / run.live), "speed_ratio": run.live / run.replay }))
            .collect();
        let report = json!({
            "model": model,
            "seconds": seconds,
            "key_frames": key_frames,
            "keys": if condensed { "condensed" } else { "even" },
            "replay_error": near,
            "runs": rows,
            "mean_live_ms": live,
            "mean_replay_ms": replay,
            "reduction_percent": reduction,
            "speed_ratio": live / replay,
            "us_per_step": us_per_step,
            "us_per_surface": us_per_surface,
            "us_per_replayed_frame": per_step(|run| run.replay),
            "turns_per_run": TURNS,
            "frames_per_turn": steps,
            "frames": format!("{kind:?}").to_lowercase(),
            "blend": format!("{blend:?}").to_lowercase(),
            "interpolation": each,
            "counted": COUNTED,
        });
        println!("{report:#}");
        return;
    }
    println!(
        "One turn of {model}, {seconds} s, {steps} drawn frames of 676 points; ms a turn, median of {TURNS} turns a run."
    );
    let apart = if condensed {
        "where the motion asks for them"
    } else {
        "every 0.1 s"
    };
    println!(
        "{key_frames} key frames of the {}, {apart}, {} blend; {each}.",
        format!("{kind:?}").to_lowercase(),
        format!("{blend:?}").to_lowercase()
    );
    if let Some(near) = near {
        println!(
            "The replay is at most {:.3} % of the width from the turn.",
            100.0 * near
        );
    }
    println!("{COUNTED}\n\n  run      live    replay   saved   ratio of speeds");
    let row = |name: String, live: f64, replay: f64| {
        println!(
            "{name:>5}  {live:8.4}  {replay:8.4}  {:5.1} %  {:8.3}",
            100.0 * (1.0 - replay / live),
            live / replay
        );
    };
    for (index, run) in runs.iter().enumerate() {
        row((index + 1).to_string(), run.live, run.replay);
    }
    row("mean".into(), live, replay);
    let [paper_live, paper_replay] = PAPER_MEANS;
    println!(
        "\nThe paper's: {paper_live:.0} and {paper_replay:.0} ms, {:.1} % saved, a ratio of {:.3}, whose part above 1 is its third row's {:.0} %.",
        100.0 * (1.0 - paper_replay / paper_live),
        paper_live / paper_replay,
        100.0 * (paper_live / paper_replay - 1.0)
    );
    println!(
        "A step with synchronisation takes {us_per_step:.2} us, a surface {us_per_surface:.2} us, a replayed frame {:.2} us.",
        per_step(|run| run.replay)
    );
}

const COUNTED: &str = "Counted: all computation from gesture or key frames to the 676 points. \
Not counted: recording, normals, drawing on a screen.";
