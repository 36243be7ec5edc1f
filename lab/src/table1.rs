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
//! A turn takes about a millisecond, so each run repeats it, live and replayed
//! in alternation, and states the median turn, which other work on
//! the machine disturbs least.

use std::hint::black_box;
use std::time::Instant;

use serde_json::json;
use turnleaf_engine::{
    Blend, FrameKind, MassSpring, PAPER_INTERVAL, Recorder, Replay, Settings, Side, Surface,
    TurnModel,
};

use crate::options;
use crate::simulate::median;

/// Duration of the turn: about the paper's mean time without key frames.
const SECONDS: f32 = 11.4;
/// Turns in a run.
const TURNS: usize = 60;

/// Runs the experiment.
pub fn run(parser: &mut lexopt::Parser) -> Result<(), String> {
    let (mut runs, mut kind, mut blend, mut each_frame) =
        (10, FrameKind::Masses, Blend::Linear, false);
    let json = options::read(parser, |option, parser| {
        match option {
            "runs" => runs = options::number(parser, option, 1, 1000)?,
            "frames" => {
                let kinds = [FrameKind::Masses, FrameKind::Surface];
                kind = kinds[options::choice(parser, option, &["masses", "surface"])?];
            }
            "blend" => {
                let blends = [Blend::Linear, Blend::Hermite];
                blend = blends[options::choice(parser, option, &["linear", "hermite"])?];
            }
            "interpolate" => {
                each_frame = options::choice(parser, option, &["key-frame", "frame"])? == 1;
            }
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    let mut leaf = MassSpring::new(Settings::paper_2014()).map_err(|error| error.to_string())?;
    let steps = (SECONDS / leaf.time_step()).round() as usize;
    let mut replay = record(&mut leaf, kind, blend, steps);
    replay.interpolate_each_frame(each_frame);
    let mut surface = Surface::new(26, 26);
    measure(&mut leaf, &mut replay, &mut surface, steps);
    let figures: Vec<Run> = (0..runs)
        .map(|_| measure(&mut leaf, &mut replay, &mut surface, steps))
        .collect();
    report(&figures, steps, kind, blend, each_frame, json);
    Ok(())
}

/// Milliseconds of one turn.
struct Run {
    live: f64,
    replay: f64,
    step: f64,
    surface: f64,
}

fn start(leaf: &mut MassSpring) {
    leaf.lay_flat(Side::Left);
    let gesture = leaf.settings().column_gesture(SECONDS);
    leaf.play(gesture);
}

fn record(leaf: &mut MassSpring, kind: FrameKind, blend: Blend, steps: usize) -> Replay {
    start(leaf);
    let mut recorder = Recorder::new(leaf, kind, PAPER_INTERVAL);
    for _ in 0..steps {
        leaf.step();
        recorder.observe(leaf);
    }
    Replay::new(recorder.finish(leaf), blend, leaf.time_step())
}

/// One run: turns live, replayed and without surfaces, in alternation.
fn measure(leaf: &mut MassSpring, replay: &mut Replay, surface: &mut Surface, steps: usize) -> Run {
    let (mut live, mut replayed, mut stepped) = (vec![], vec![], vec![]);
    for _ in 0..TURNS {
        start(leaf);
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
        start(leaf);
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

fn report(runs: &[Run], steps: usize, kind: FrameKind, blend: Blend, each_frame: bool, json: bool) {
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
            .map(|run| json!({ "live_ms": run.live, "replay_ms": run.replay, "reduction_percent": 100.0 * (1.0 - run.replay / run.live) }))
            .collect();
        let report = json!({
            "runs": rows,
            "mean_live_ms": live,
            "mean_replay_ms": replay,
            "reduction_percent": reduction,
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
        "One turn of {SECONDS} s, {steps} drawn frames of 676 points; ms a turn, median of {TURNS} turns a run."
    );
    println!(
        "Key frames of the {} every {PAPER_INTERVAL} s, {} blend; {each}.",
        format!("{kind:?}").to_lowercase(),
        format!("{blend:?}").to_lowercase()
    );
    println!("{COUNTED}\n\n  run      live    replay   saved");
    let row = |name: String, live: f64, replay: f64| {
        println!(
            "{name:>5}  {live:8.4}  {replay:8.4}  {:5.1} %",
            100.0 * (1.0 - replay / live)
        );
    };
    for (index, run) in runs.iter().enumerate() {
        row((index + 1).to_string(), run.live, run.replay);
    }
    row("mean".into(), live, replay);
    println!(
        "\nA step with synchronisation takes {us_per_step:.2} us, a surface {us_per_surface:.2} us, a replayed frame {:.2} us.",
        per_step(|run| run.replay)
    );
}

const COUNTED: &str = "Counted: all computation from gesture or key frames to the 676 points. \
Not counted: recording, normals, drawing on a screen.";
