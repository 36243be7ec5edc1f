//! The leaf in flight: held by a hand, falling, or played from key frames.
//!
//! The model is the mass-spring leaf of the preset `book`, over a flat table;
//! [`seat`](super::seat()) then fits what is drawn between the two piles. A
//! played turn is simulated once, with the paper's corner gesture, recorded as
//! key frames and replayed from then on (Shangguan and Zeng 2014, section
//! 2.2.3). A replay writes its nodes into the model, so that a hand can catch a
//! leaf in the middle of it and the simulation goes on from there.

mod fall;
mod play;
#[cfg(test)]
mod tests;

use super::seat::share_turned;
use crate::grid::Side;
use crate::key_frames::Replay;
use crate::models::mass_spring::{MassSpring, Settings};
use crate::surface::Surface;
use crate::turn::TurnModel;

/// Length of a tick, by which leaves and boards are stepped, seconds. A fourth
/// of a frame at 60 Hz, so that frames of any rate stand for nearly equal times.
pub const TICK: f32 = 1.0 / 240.0;

/// How fast a held node follows the hand, 1/s, and at most, m/s: a hand that
/// jumps must not tear the leaf.
const FOLLOW: f32 = 45.0;
const FASTEST_HAND: f32 = 3.5;

/// How far ahead a released leaf's swing is looked at to choose its side, seconds.
const LOOK_AHEAD: f32 = 0.12;

/// What a leaf or a board is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// It lies still on a side.
    Resting(Side),
    /// A hand holds it.
    Held,
    /// It falls to a side by itself.
    Falling(Side),
    /// A recorded turn takes it to a side.
    Playing(Side),
}

/// Where a hand holds the leaf.
#[derive(Clone, Copy, Debug)]
struct Grip {
    u: f32,
    v: f32,
    column: usize,
    row: usize,
    /// From the place held to the node that is moved for it.
    offset: [f32; 3],
    /// Where the hand is, and where the node has followed it to.
    target: [f32; 3],
    place: [f32; 3],
}

/// A recorded turn being played.
#[derive(Clone, Copy, Debug)]
struct Course {
    /// Side on which the recorded leaf was taken up.
    from: Side,
    /// Time in the recording, seconds.
    time: f32,
    /// Recorded seconds a second; negative backward.
    rate: f32,
}

/// Easing of a landed leaf to rest.
#[derive(Clone, Debug)]
struct Settling {
    from: Vec<f32>,
    time: f32,
}

/// One leaf of paper between two piles.
#[derive(Clone)]
pub struct Leaf {
    model: MassSpring,
    phase: Phase,
    grip: Option<Grip>,
    course: Option<Course>,
    settling: Option<Settling>,
    recording: Option<Replay>,
    /// Ticks since it was let go.
    fallen: u32,
    /// Share of the half turn done and its rate of change, 1/s.
    share: f32,
    share_rate: f32,
    positions: Vec<f32>,
    velocities: Vec<f32>,
}

impl Phase {
    /// The side where it rests or is bound for; None while a hand holds it.
    pub fn side(self) -> Option<Side> {
        match self {
            Phase::Held => None,
            Phase::Resting(side) | Phase::Falling(side) | Phase::Playing(side) => Some(side),
        }
    }
}

impl Leaf {
    /// A leaf of `width` x `height` metres and `grammage` kg/m^2 at rest on the
    /// right, drawn at the columns `u` and at `rows` even rows.
    pub fn new(width: f32, height: f32, grammage: f32, u: &[f32], rows: usize) -> Leaf {
        let settings = Settings {
            time_step: TICK,
            substeps: 2,
            ..Settings::book(width, height, grammage)
        };
        let mut model = MassSpring::new(settings).expect("the preset makes a leaf");
        let v: Vec<f32> = (0..rows).map(|j| j as f32 / (rows - 1) as f32).collect();
        model.draw_samples(u, &v);
        let mut leaf = Leaf::of(model);
        // Now rather than in the middle of the first turn, and once for all copies.
        leaf.recording = Some(leaf.record());
        leaf
    }

    /// A leaf of a model, at rest on the right.
    fn of(model: MassSpring) -> Leaf {
        let (columns, rows) = model.grid_size();
        let mut leaf = Leaf {
            model,
            phase: Phase::Resting(Side::Right),
            grip: None,
            course: None,
            settling: None,
            recording: None,
            fallen: 0,
            share: 0.0,
            share_rate: 0.0,
            positions: vec![0.0; 3 * columns * rows],
            velocities: vec![0.0; 3 * columns * rows],
        };
        leaf.lay(Side::Right);
        leaf
    }

    /// Lays the leaf flat and still on a side.
    pub fn lay(&mut self, side: Side) {
        self.model.lay_flat(side);
        self.grip = None;
        self.course = None;
        self.settling = None;
        self.share = if side == Side::Right { 0.0 } else { 1.0 };
        self.share_rate = 0.0;
        self.phase = Phase::Resting(side);
    }

    /// What the leaf is doing.
    pub fn phase(&self) -> Phase {
        self.phase
    }

    /// How far the fore-edge has turned: 0 on the right, 1 on the left.
    pub fn share_turned(&self) -> f32 {
        self.share
    }

    /// Writes the leaf's surface, over a flat table (see [`seat`](super::seat())).
    pub fn write_surface(&mut self, surface: &mut Surface) {
        self.model.write_surface(surface);
    }

    /// A hand takes hold at (`u`, `v`): of the node nearest to it, which is the
    /// paper's control point. Whatever the leaf was doing, it goes on from
    /// where it is.
    pub fn grab(&mut self, u: f32, v: f32) {
        if !u.is_finite() || !v.is_finite() {
            return;
        }
        let (columns, rows) = self.model.grid_size();
        let nearest =
            |at: f32, count: usize| libm::roundf(at.clamp(0.0, 1.0) * (count - 1) as f32) as usize;
        // Next to the spine a hand would only tear at the binding.
        let column = nearest(u, columns).max(columns / 2);
        let row = nearest(v, rows);
        let node = self.model.position(column, row);
        let settings = self.model.settings();
        let along = (row as f32 / (rows - 1) as f32 - v.clamp(0.0, 1.0)) * settings.height;
        let across = (column as f32 / (columns - 1) as f32 - u.clamp(0.0, 1.0)) * settings.width;
        let inner = self.model.position(column - 1, row);
        let step = settings.width / (columns - 1) as f32;
        let offset = [0, 1, 2].map(|axis| {
            let tangent = (node[axis] - inner[axis]) / step;
            across * tangent + if axis == 1 { along } else { 0.0 }
        });
        let place = node;
        let target = [0, 1, 2].map(|axis| node[axis] - offset[axis]);
        self.model.release_all();
        self.model.hold(column, row, place);
        self.grip = Some(Grip {
            u,
            v,
            column,
            row,
            offset,
            target,
            place,
        });
        self.course = None;
        self.settling = None;
        self.phase = Phase::Held;
    }

    /// Where the hand holds the leaf, in u and v; the middle of the fore-edge
    /// when none does.
    pub fn grabbed_at(&self) -> (f32, f32) {
        self.grip.map_or((1.0, 0.5), |grip| (grip.u, grip.v))
    }

    /// Where the held place is, over the flat table, metres.
    pub fn grabbed_point(&self) -> [f32; 3] {
        match &self.grip {
            Some(grip) => [0, 1, 2].map(|axis| grip.place[axis] - grip.offset[axis]),
            None => [0.0; 3],
        }
    }

    /// The hand pulls the held place to `target` (metres, over the flat table).
    /// It is followed only so far as the leaf reaches.
    pub fn hold(&mut self, target: [f32; 3]) {
        if target.iter().all(|t| t.is_finite())
            && let Some(grip) = &mut self.grip
        {
            grip.target = target;
        }
    }

    /// The hand lets go; the leaf falls to the side its swing takes it.
    pub fn release(&mut self) {
        if self.phase == Phase::Held {
            let ahead = self.share + LOOK_AHEAD * self.share_rate;
            self.fall(if ahead > 0.5 { Side::Left } else { Side::Right });
        }
    }

    /// Takes the leaf to a side: from rest by the recorded turn, `seconds` (at
    /// least 0.05) long; a turn being played goes on at that pace, backward if
    /// need be; a leaf that is held or falls is let fall there.
    pub fn play(&mut self, to: Side, seconds: f32) {
        match self.phase {
            Phase::Resting(side) if side == to => {}
            Phase::Resting(from) => {
                let rate = self.rate(seconds);
                self.course = Some(Course {
                    from,
                    time: 0.0,
                    rate,
                });
                self.phase = Phase::Playing(to);
            }
            Phase::Playing(_) => {
                let rate = self.rate(seconds);
                if let Some(course) = &mut self.course {
                    course.rate = if course.from == to { -rate } else { rate };
                    self.phase = Phase::Playing(to);
                }
            }
            Phase::Held | Phase::Falling(_) => self.fall(to),
        }
    }

    /// Steps by `ticks` of [`TICK`] seconds.
    pub fn step(&mut self, ticks: u32) {
        for _ in 0..ticks {
            let before = self.share;
            match self.phase {
                Phase::Resting(_) => return,
                Phase::Held => self.step_held(),
                Phase::Falling(side) => self.step_falling(side),
                Phase::Playing(side) => self.step_playing(side),
            }
            if let Phase::Resting(_) = self.phase {
                return;
            }
            self.share = self.measure_share();
            // Smoothed over about 20 ms: a hand's last twitch is not its throw.
            let rate = (self.share - before) / TICK;
            self.share_rate += (rate - self.share_rate) * 0.2;
        }
    }

    fn fall(&mut self, to: Side) {
        self.model.release_all();
        self.grip = None;
        self.course = None;
        if self.phase != Phase::Falling(to) {
            self.settling = None;
            self.fallen = 0;
        }
        self.phase = Phase::Falling(to);
    }

    fn step_held(&mut self) {
        let Some(mut grip) = self.grip else {
            return;
        };
        let wanted = [0, 1, 2].map(|axis| grip.target[axis] + grip.offset[axis]);
        let wanted = self.model.within_reach(grip.column, grip.row, wanted);
        let d = [0, 1, 2].map(|axis| wanted[axis] - grip.place[axis]);
        let distance = length(d);
        let step = (distance * FOLLOW * TICK).min(FASTEST_HAND * TICK);
        if distance > 1e-7 {
            grip.place = [0, 1, 2].map(|axis| grip.place[axis] + d[axis] * (step / distance));
        }
        self.model.hold(grip.column, grip.row, grip.place);
        self.model.step();
        // A hand yields where the leaf cannot follow: it goes on from there.
        grip.place = self.model.position(grip.column, grip.row);
        self.grip = Some(grip);
    }

    /// Mean over the fore-edge of how far it has turned.
    fn measure_share(&self) -> f32 {
        let (columns, rows) = self.model.grid_size();
        let sum: f32 = (0..rows)
            .map(|row| {
                let [x, _, z] = self.model.position(columns - 1, row);
                share_turned(x, z)
            })
            .sum();
        sum / rows as f32
    }
}

fn length(d: [f32; 3]) -> f32 {
    (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt()
}
