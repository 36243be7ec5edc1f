//! The figures of some runs.

use serde::Serialize;

use super::watch::Watched;

/// Milliseconds of a frame.
const FRAME: f32 = 1e3 / 60.0;

/// What runs did to what is drawn.
#[derive(Serialize)]
pub struct Figures {
    /// How many runs these are.
    pub runs: usize,
    frames: usize,
    /// Part of the frames in which a leaf is drawn more than 5 mm behind its paper, percent, and
    /// how far at most, millimetres.
    behind_percent: f64,
    farthest_mm: f32,
    /// Longest that a leaf stands still while its paper moves, milliseconds.
    still_ms: f32,
    /// Part of the frames in which an edge is drawn a fifth longer than it is, percent.
    stretched_percent: f64,
    /// How deep leaves are drawn in something, millimetres.
    depth_mm: f32,
    /// Most CPU of a frame, and as its work is counted, milliseconds.
    frame_ms: f64,
    work_ms: f64,
}

impl Figures {
    /// Names of the table's columns.
    pub const HEADINGS: [&str; 10] = [
        "of",
        "runs",
        "frames",
        "behind by 5 mm, %",
        "at most, mm",
        "still, ms",
        "stretched by 20 %, %",
        "drawn deep, mm",
        "CPU of a frame, worst, ms",
        "the same as counted",
    ];

    /// Those of some runs.
    pub fn of<'a>(runs: impl Iterator<Item = &'a Watched>) -> Figures {
        let mut all = Watched::default();
        let mut count = 0;
        for run in runs {
            count += 1;
            all.frames += run.frames;
            all.behind += run.behind;
            all.stretched += run.stretched;
            all.farthest = all.farthest.max(run.farthest);
            all.still = all.still.max(run.still);
            all.depth = all.depth.max(run.depth);
            all.seconds = all.seconds.max(run.seconds);
            all.work = all.work.max(run.work);
        }
        let percent = |frames: usize| 100.0 * frames as f64 / all.frames.max(1) as f64;
        Figures {
            runs: count,
            frames: all.frames,
            behind_percent: percent(all.behind),
            farthest_mm: 1e3 * all.farthest,
            still_ms: FRAME * all.still as f32,
            stretched_percent: percent(all.stretched),
            depth_mm: 1e3 * all.depth,
            frame_ms: 1e3 * all.seconds,
            work_ms: 1e-6 * f64::from(all.work),
        }
    }

    /// A row of the table.
    pub fn row(&self, name: &str) -> Vec<String> {
        vec![
            name.into(),
            self.runs.to_string(),
            self.frames.to_string(),
            format!("{:.2}", self.behind_percent),
            format!("{:.1}", self.farthest_mm),
            format!("{:.0}", self.still_ms),
            format!("{:.2}", self.stretched_percent),
            format!("{:.3}", self.depth_mm),
            format!("{:.1}", self.frame_ms),
            format!("{:.1}", self.work_ms),
        ]
    }
}
