//! A leaf on its own over a table, moved by any of the models and turned by the
//! same gestures and grabs: what compares them, bakes them and plays with them.

mod body;
#[cfg(all(test, feature = "creases"))]
mod crease_tests;
mod creases;
mod measure;
mod settings;
mod springs;
mod table_sheet;
#[cfg(test)]
mod tests;

pub use measure::LeafEnergies;
pub use settings::{InvalidLoose, LooseSettings};
pub use table_sheet::CreaseState;

use crate::gesture::{Gesture, Grip};
use crate::grid::Side;
use crate::key_frames::{FrameKind, KeyFrames};
use crate::models::ModelKind;
use crate::models::mass_spring::Preset;
use crate::surface::Surface;
use crate::turn::TurnModel;
use body::Body;

/// A turn by hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TurnBy {
    /// The middle of the fore-edge is carried over; of a mass-spring leaf the
    /// whole fore-edge, as in the paper.
    Edge,
    /// The foot corner is carried over.
    Corner,
    /// As by the corner, but let go upright, half-way.
    LetGo,
}

impl TurnBy {
    /// All three.
    pub const ALL: [Self; 3] = [Self::Edge, Self::Corner, Self::LetGo];

    /// Its name as in commands and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Edge => "edge",
            Self::Corner => "corner",
            Self::LetGo => "let-go",
        }
    }
}

/// How far a hand draws a leaf in toward the spine at the height of a turn, as
/// part of the width: it bows, and is never taut.
const SLACK: f32 = 0.1;

/// Steps of one call at most: those of a minute, of the shortest steps that a model takes
/// by itself.
const MOST_STEPS: u64 = 60 * 600;

/// Numbers that a record holds at most: 64 MB of them.
const MOST_RECORDED: usize = 16_000_000;

/// A leaf over a table.
#[derive(Debug)]
pub struct LooseLeaf {
    settings: LooseSettings,
    body: Body,
    time: f64,
    steps: u64,
    turn: Option<Turn>,
    record: Option<(KeyFrames, f64, f64)>,
    surface: Surface,
}

/// A turn under way.
#[derive(Clone, Copy, Debug)]
struct Turn {
    gesture: Gesture,
    start: u64,
    /// Seconds after which the hand lets go.
    until: f64,
    /// Whether the model itself carries it out.
    by_model: bool,
}

impl LooseLeaf {
    /// A leaf flat and still on its side.
    ///
    /// # Errors
    /// Where the settings make no leaf, in a sentence.
    pub fn new(settings: LooseSettings) -> Result<Self, InvalidLoose> {
        settings.check()?;
        let mut body = Body::new(&settings)?;
        body.lay_flat(settings.side);
        Ok(Self {
            body,
            time: 0.0,
            steps: 0,
            turn: None,
            record: None,
            surface: Surface::new(2, 2),
            settings,
        })
    }

    /// What it is.
    pub fn settings(&self) -> &LooseSettings {
        &self.settings
    }

    /// Lays it flat, but for its creases, and still on a side, nothing holding it.
    pub fn lay_flat(&mut self, side: Side) {
        self.body.lay_flat(side);
        self.turn = None;
    }

    /// Draws at every pair of `u` (0 spine, 1 fore-edge) and `v` (0 foot, 1 head)
    /// instead of evenly. A mass-spring leaf without interpolation goes on to draw
    /// its nodes, and a record under way ends.
    ///
    /// # Errors
    /// Where they are fewer than 2 or more than 1024 a side, do not rise, or leave
    /// 0..1, or are too few for the leaf's creases; in a sentence.
    pub fn draw_samples(&mut self, u: &[f32], v: &[f32]) -> Result<(), InvalidLoose> {
        for samples in [u, v] {
            let rising = samples.windows(2).all(|pair| pair[0] < pair[1]);
            let inside = samples.iter().all(|at| (0.0..=1.0).contains(at));
            if !(2..=1024).contains(&samples.len()) || !rising || !inside {
                let sentence = "A leaf is drawn at 2 to 1024 places a side that rise from 0 to 1.";
                return Err(InvalidLoose(sentence.into()));
            }
        }
        self.body.draw_samples(u, v)?;
        self.record = None;
        Ok(())
    }

    /// Starts a turn that takes `seconds`, from a side, on which the leaf is laid.
    ///
    /// # Panics
    /// If the seconds are not above 0.
    pub fn play(&mut self, by: TurnBy, from: Side, seconds: f32) {
        assert!(seconds > 0.0, "a turn takes time");
        self.lay_flat(from);
        let grip = match by {
            TurnBy::Edge => Grip::ForeEdge,
            TurnBy::Corner | TurnBy::LetGo => Grip::FootCorner,
        };
        let gesture = Gesture {
            grip,
            slack: SLACK,
            ..Gesture::column(from, self.settings.size[0] as f32, seconds)
        };
        let part = if by == TurnBy::LetGo { 0.5 } else { 1.0 };
        self.turn = Some(Turn {
            gesture,
            start: self.steps,
            until: part * f64::from(seconds),
            by_model: self.body.play(gesture),
        });
    }

    /// Whether a turn is under way: a hand of the leaf's own still leads it.
    pub fn is_playing(&self) -> bool {
        self.turn.is_some()
    }

    /// A hand takes hold at (u, v), 0 to 1, and ends a turn under way. Of a
    /// kinematic leaf see [`Kinematic::grab`](crate::Kinematic::grab).
    pub fn grab(&mut self, u: f32, v: f32) {
        if u.is_finite() && v.is_finite() {
            self.turn = None;
            self.body.grab(u, v);
            self.let_yield(true);
        }
    }

    /// The hand pulls to a place, metres. Nothing happens where none holds, or
    /// where the place is no number.
    pub fn pull(&mut self, to: [f32; 3]) {
        if to.iter().all(|x| x.is_finite()) {
            self.body.pull(to);
        }
    }

    /// The hand, or the turn under way, lets go.
    pub fn release(&mut self) {
        self.turn = None;
        self.body.release();
        self.let_yield(false);
    }

    /// Steps so often that at least `seconds` (0 to 60 or the nearer of these) more have
    /// passed, but for half a step, and what is left is made up for by the next call;
    /// but at most 36,000 times, and no time passes beyond these. Seconds that are
    /// not finite pass none.
    pub fn advance(&mut self, seconds: f64) {
        if !seconds.is_finite() {
            return;
        }
        self.time += seconds.clamp(0.0, 60.0);
        let h = f64::from(self.time_step());
        let most = self.steps + MOST_STEPS;
        while self.steps as f64 * h < self.time - 0.5 * h {
            if self.steps == most {
                self.time = self.steps as f64 * h;
                return;
            }
            self.step();
        }
    }

    /// Records the drawn surface from now on, a frame every `interval` seconds,
    /// which is above 0. Frames beyond 16 million numbers are left out. A creased leaf is not
    /// recorded: these frames know no other mesh than a grid.
    ///
    /// # Panics
    /// If the interval is not above 0.
    pub fn record(&mut self, interval: f64) {
        assert!(interval > 0.0, "the interval is above 0");
        if self.paper_mesh().is_some() {
            return;
        }
        let mut surface = core::mem::replace(&mut self.surface, Surface::new(2, 2));
        self.write_surface(&mut surface);
        let frames = KeyFrames {
            kind: FrameKind::Surface,
            model: self.settings.kind,
            preset: match self.settings.kind {
                ModelKind::MassSpring => self.settings.preset,
                _ => Preset::Custom,
            },
            size: self.settings.size.map(|size| size as f32),
            columns: surface.columns,
            rows: surface.rows,
            times: vec![0.0],
            positions: surface.positions.clone(),
        };
        self.surface = surface;
        let start = self.steps as f64 * f64::from(self.time_step());
        self.record = Some((frames, start, interval));
    }

    /// Ends the record. Returns it, or none where none was begun.
    pub fn finish_record(&mut self) -> Option<KeyFrames> {
        self.record.take().map(|(frames, ..)| frames)
    }

    fn take_frame(&mut self) {
        let now = self.steps as f64 * f64::from(self.time_step());
        let half = 0.5 * f64::from(self.time_step());
        let due = |(frames, start, interval): &(KeyFrames, f64, f64)| {
            now - start >= frames.len() as f64 * interval - half
        };
        let has_room = |(frames, ..): &(KeyFrames, f64, f64)| {
            let frame = 3 * frames.columns * frames.rows;
            frames.positions.len() + frame <= MOST_RECORDED
        };
        let is_due = |record| due(record) && has_room(record);
        if self.record.as_ref().is_some_and(is_due) {
            let mut surface = core::mem::replace(&mut self.surface, Surface::new(2, 2));
            self.write_surface(&mut surface);
            if let Some((frames, start, _)) = &mut self.record {
                frames.times.push((now - *start) as f32);
                frames.positions.extend_from_slice(&surface.positions);
            }
            self.surface = surface;
        }
    }
}

impl TurnModel for LooseLeaf {
    fn time_step(&self) -> f32 {
        self.body.model().time_step()
    }

    fn time(&self) -> f32 {
        (self.steps as f64 * f64::from(self.time_step())) as f32
    }

    fn step(&mut self) {
        let h = f64::from(self.time_step());
        if let Some(turn) = self.turn {
            // Where the hand is at the end of this step.
            let time = (self.steps + 1 - turn.start) as f64 * h;
            if time > turn.until + 0.5 * h {
                self.release();
            } else if !turn.by_model {
                let v = body::grip_v(turn.gesture.grip);
                let y = v * self.settings.size[1] as f32;
                self.body.pull(turn.gesture.position(v, y, time as f32));
            }
        }
        self.body.step();
        self.steps += 1;
        self.take_frame();
    }

    fn write_surface(&mut self, surface: &mut Surface) {
        self.body.model_mut().write_surface(surface);
    }

    fn grid_size(&self) -> (usize, usize) {
        self.body.model().grid_size()
    }

    fn read_nodes(&self, positions: &mut [f32], velocities: &mut [f32]) {
        self.body.model().read_nodes(positions, velocities);
    }
}
