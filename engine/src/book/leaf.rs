//! The leaf in flight: held by a hand, falling, or played from key frames.
//!
//! The model is the mass-spring leaf of the preset `book`, over a flat table;
//! [`seat`](super::seat()) then fits what is drawn between the two piles. A
//! played turn is simulated once, with the paper's corner gesture, recorded as
//! key frames and replayed from then on (Shangguan and Zeng 2014, section
//! 2.2.3). A replay writes its nodes into the model, so that a hand can catch a
//! leaf in the middle of it and the simulation goes on from there.

use super::seat::share_turned;
use crate::grid::Side;
use crate::key_frames::{Blend, FrameKind, Recorder, Replay};
use crate::models::mass_spring::{MassSpring, Settings};
use crate::surface::Surface;
use crate::turn::TurnModel;

/// Length of a tick, by which leaves and boards are stepped, seconds. A fourth
/// of a frame at 60 Hz, so that frames of any rate stand for nearly equal times.
pub const TICK: f32 = 1.0 / 240.0;

/// Duration of the hand's part of the recorded turn, seconds; the leaf comes to
/// rest a little later.
const GESTURE_SECONDS: f32 = 0.70;

/// Longest recording, ticks: a leaf that has not come to rest by then is laid down.
const LONGEST_RECORDING: u32 = 480;

/// Time between key frames, seconds: half the paper's, as a book's turn is
/// fifteen times as fast as the paper's.
const KEY_INTERVAL: f32 = 0.05;

/// How fast a held node follows the hand, 1/s, and at most, m/s: a hand that
/// jumps must not tear the leaf.
const FOLLOW: f32 = 45.0;
const FASTEST_HAND: f32 = 3.5;

/// Acceleration at the fore-edge by which a released leaf is helped over, m/s^2.
const ASSIST: f32 = 14.0;

/// How far ahead a released leaf's swing is looked at to choose its side, seconds.
const LOOK_AHEAD: f32 = 0.12;

/// A leaf lower than this (metres) and slower than this (m/s) everywhere is
/// eased to rest within `SETTLE_SECONDS`; so is one that has fallen for
/// `LONGEST_FALL` ticks.
const LOW: f32 = 0.004;
const SLOW: f32 = 0.5;
const SETTLE_SECONDS: f32 = 0.14;
const LONGEST_FALL: u32 = 360;

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
        let (columns, node_rows) = model.grid_size();
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
            positions: vec![0.0; 3 * columns * node_rows],
            velocities: vec![0.0; 3 * columns * node_rows],
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

    fn step_falling(&mut self, side: Side) {
        if self.settling.is_some() {
            self.step_settling(side);
            return;
        }
        self.help_over(side);
        self.model.step();
        self.fallen += 1;
        let landed = self.height_over_rest(side) < LOW && self.model.greatest_speed() < SLOW;
        if landed || self.fallen > LONGEST_FALL {
            self.read_nodes();
            self.settling = Some(Settling {
                from: self.positions.clone(),
                time: 0.0,
            });
        }
    }

    /// Pushes the leaf round the spine toward a side, most at the fore-edge and
    /// less the farther it has come, where its weight does the rest.
    fn help_over(&mut self, side: Side) {
        let (to_go, sign) = match side {
            Side::Left => (1.0 - self.share, 1.0),
            Side::Right => (self.share, -1.0),
        };
        let strength = ((to_go - 0.12) / 0.3).clamp(0.0, 1.0) * ASSIST * sign * TICK;
        if strength == 0.0 {
            return;
        }
        let (columns, rows) = self.model.grid_size();
        for row in 0..rows {
            for column in 1..columns {
                let [x, _, z] = self.model.position(column, row);
                let radius = (x * x + z * z).sqrt().max(1e-6);
                let push = strength * column as f32 / (columns - 1) as f32 / radius;
                let [vx, vy, vz] = self.model.velocity(column, row);
                let velocity = [vx - push * z, vy, vz + push * x];
                self.model.set_velocity(column, row, velocity);
            }
        }
    }

    fn step_settling(&mut self, side: Side) {
        let Some(settling) = &mut self.settling else {
            return;
        };
        settling.time += TICK;
        let t = (settling.time / SETTLE_SECONDS).min(1.0);
        if t >= 1.0 {
            self.lay(side);
            return;
        }
        let eased = t * t * (3.0 - 2.0 * t);
        let from = core::mem::take(&mut settling.from);
        let (columns, rows) = self.model.grid_size();
        for row in 0..rows {
            for column in 0..columns {
                let at = 3 * (row * columns + column);
                let rest = self.rest_position(side, column, row);
                for axis in 0..3 {
                    self.positions[at + axis] =
                        from[at + axis] + (rest[axis] - from[at + axis]) * eased;
                }
            }
        }
        self.velocities.fill(0.0);
        self.model.write_nodes(&self.positions, &self.velocities);
        if let Some(settling) = &mut self.settling {
            settling.from = from;
        }
    }

    fn step_playing(&mut self, side: Side) {
        let Some(mut course) = self.course else {
            return;
        };
        course.time += TICK * course.rate;
        self.course = Some(course);
        let recording = self
            .recording
            .as_ref()
            .expect("recorded before it is played");
        if course.time <= 0.0 || course.time >= recording.duration() {
            self.lay(side);
            return;
        }
        recording.read_nodes_at(course.time, &mut self.positions, &mut self.velocities);
        // Recorded from the right; from the left it is the mirror image.
        let mirror = course.from.sign();
        for (p, v) in self
            .positions
            .chunks_exact_mut(3)
            .zip(self.velocities.chunks_exact_mut(3))
        {
            p[0] *= mirror;
            v[0] *= mirror * course.rate;
            v[1] *= course.rate;
            v[2] *= course.rate;
        }
        self.model.write_nodes(&self.positions, &self.velocities);
    }

    /// Recorded seconds a second that make a whole turn `seconds` long; records
    /// the turn if it has not been yet.
    fn rate(&mut self, seconds: f32) -> f32 {
        if self.recording.is_none() {
            self.recording = Some(self.record());
        }
        let recorded = self.recording.as_ref().map_or(1.0, Replay::duration);
        recorded
            / if seconds.is_finite() {
                seconds.max(0.05)
            } else {
                1.0
            }
    }

    /// Simulates a whole turn from the right and records it.
    fn record(&self) -> Replay {
        let mut leaf = Leaf {
            model: self.model.clone(),
            phase: Phase::Resting(Side::Right),
            grip: None,
            course: None,
            settling: None,
            recording: None,
            fallen: 0,
            share: 0.0,
            share_rate: 0.0,
            positions: self.positions.clone(),
            velocities: self.velocities.clone(),
        };
        leaf.lay(Side::Right);
        let mut recorder = Recorder::new(&mut leaf.model, FrameKind::Masses, KEY_INTERVAL);
        let gesture = leaf.model.settings().corner_gesture(GESTURE_SECONDS);
        leaf.model.play(gesture);
        let mut time = 0.0;
        let gesture_ticks = libm::ceilf(GESTURE_SECONDS / TICK) as u32;
        for tick in 1..=LONGEST_RECORDING {
            if tick <= gesture_ticks {
                leaf.model.step();
                leaf.share = leaf.measure_share();
            } else {
                if tick == gesture_ticks + 1 {
                    leaf.fall(Side::Left);
                }
                leaf.step(1);
            }
            time = tick as f32 * TICK;
            recorder.observe_at(&mut leaf.model, time);
            if let Phase::Resting(_) = leaf.phase
                && tick > gesture_ticks
            {
                break;
            }
        }
        leaf.lay(Side::Left);
        let frames = recorder.finish_at(&mut leaf.model, time + TICK);
        Replay::new(frames, Blend::Hermite, TICK)
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

    /// Greatest distance of a node from its place of rest on a side, metres.
    fn height_over_rest(&self, side: Side) -> f32 {
        let (columns, rows) = self.model.grid_size();
        let mut greatest = 0.0f32;
        for row in 0..rows {
            for column in 1..columns {
                let rest = self.rest_position(side, column, row);
                let place = self.model.position(column, row);
                greatest = greatest.max(length([0, 1, 2].map(|axis| place[axis] - rest[axis])));
            }
        }
        greatest
    }

    fn rest_position(&self, side: Side, column: usize, row: usize) -> [f32; 3] {
        let (columns, rows) = self.model.grid_size();
        let settings = self.model.settings();
        [
            side.sign() * settings.width * column as f32 / (columns - 1) as f32,
            settings.height * row as f32 / (rows - 1) as f32,
            0.0,
        ]
    }

    fn read_nodes(&mut self) {
        self.model
            .read_nodes(&mut self.positions, &mut self.velocities);
    }
}

fn length(d: [f32; 3]) -> f32 {
    (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: f32 = 0.14;
    const HEIGHT: f32 = 0.21;

    fn leaf() -> Leaf {
        Leaf::new(WIDTH, HEIGHT, 0.07, &super::super::crowded_columns(49), 25)
    }

    fn ticks_to_rest(leaf: &mut Leaf) -> u32 {
        for tick in 0..2000 {
            if let Phase::Resting(_) = leaf.phase() {
                return tick;
            }
            leaf.step(1);
        }
        panic!("the leaf never came to rest: {:?}", leaf.phase());
    }

    fn corner(leaf: &Leaf) -> [f32; 3] {
        leaf.model.position(5, 0)
    }

    #[test]
    fn a_played_turn_takes_its_time_and_lands_flat() {
        for from in [Side::Right, Side::Left] {
            let mut leaf = leaf();
            leaf.lay(from);
            leaf.play(from.opposite(), 0.8);
            let ticks = ticks_to_rest(&mut leaf);
            assert!((190..=194).contains(&ticks), "{ticks}");
            assert_eq!(leaf.phase(), Phase::Resting(from.opposite()));
            assert_eq!(corner(&leaf), [from.opposite().sign() * WIDTH, 0.0, 0.0]);
        }
    }

    #[test]
    fn turns_from_left_and_right_mirror_each_other() {
        let (mut a, mut b) = (leaf(), leaf());
        b.lay(Side::Left);
        a.play(Side::Left, 0.8);
        b.play(Side::Right, 0.8);
        for _ in 0..150 {
            a.step(1);
            b.step(1);
            let (p, q) = (corner(&a), corner(&b));
            assert_eq!([p[0], p[1], p[2]], [-q[0], q[1], q[2]]);
        }
    }

    #[test]
    fn a_played_turn_never_jumps() {
        let mut leaf = leaf();
        leaf.play(Side::Left, 0.8);
        let mut before = corner(&leaf);
        while leaf.phase() == Phase::Playing(Side::Left) {
            leaf.step(1);
            let now = corner(&leaf);
            let step = length([0, 1, 2].map(|axis| now[axis] - before[axis]));
            assert!(step < 2.5 * TICK, "{step} m in a tick");
            before = now;
        }
    }

    #[test]
    fn a_turn_can_be_reversed_and_hurried() {
        let mut leaf = leaf();
        leaf.play(Side::Left, 0.8);
        leaf.step(80);
        leaf.play(Side::Right, 0.8);
        assert!((78..=82).contains(&ticks_to_rest(&mut leaf)));
        assert_eq!(leaf.phase(), Phase::Resting(Side::Right));
        leaf.play(Side::Left, 0.8);
        leaf.step(96);
        leaf.play(Side::Left, 0.4);
        assert!((46..=50).contains(&ticks_to_rest(&mut leaf)));
        assert_eq!(leaf.phase(), Phase::Resting(Side::Left));
    }

    #[test]
    fn a_turning_leaf_can_be_caught_and_let_go() {
        let mut leaf = leaf();
        leaf.play(Side::Left, 0.8);
        leaf.step(70);
        let before = corner(&leaf);
        leaf.grab(1.0, 0.0);
        leaf.hold(before);
        leaf.step(1);
        let now = corner(&leaf);
        assert!(length([0, 1, 2].map(|axis| now[axis] - before[axis])) < 0.01);
        leaf.hold([0.12, 0.0, 0.03]);
        leaf.step(200);
        assert!(length([corner(&leaf)[0] - 0.12, corner(&leaf)[2] - 0.03, 0.0]) < 1e-3);
        leaf.release();
        assert!(ticks_to_rest(&mut leaf) < 480);
        assert_eq!(leaf.phase(), Phase::Resting(Side::Right));
    }

    #[test]
    fn a_leaf_let_go_beyond_the_spine_falls_to_the_left() {
        let mut leaf = leaf();
        leaf.grab(1.0, 0.5);
        for k in 0..120 {
            let angle = 2.2 * k as f32 / 120.0;
            let (sin, cos) = libm::sincosf(angle);
            leaf.hold([0.9 * WIDTH * cos, 0.5 * HEIGHT, 0.9 * WIDTH * sin]);
            leaf.step(1);
        }
        leaf.release();
        assert!(ticks_to_rest(&mut leaf) < 480);
        assert_eq!(leaf.phase(), Phase::Resting(Side::Left));
    }

    #[test]
    fn no_pull_however_wild_breaks_it() {
        let seed = 0x5eed_u64;
        let mut state = seed;
        let mut random = move || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 40) as f32 / (1u64 << 24) as f32
        };
        let mut leaf = leaf();
        let mut worst = 0.0f32;
        for pull in 0..400 {
            if pull % 20 == 0 {
                leaf.grab(random(), random());
            }
            leaf.hold([random() - 0.5, random() - 0.4, 0.6 * random() - 0.1]);
            leaf.step(12);
            let strain = leaf.model.strain();
            worst = worst.max(strain.max).max(-strain.min);
            assert!(leaf.model.is_finite(), "not finite; seed {seed:#x}");
        }
        // Targets half a metre apart every 50 ms; a hand that did not yield
        // would stretch the leaf by more than half.
        assert!(worst < 0.06, "strain {worst}; seed {seed:#x}");
        leaf.release();
        ticks_to_rest(&mut leaf);
        assert!(leaf.model.strain().max < 1e-5);
    }

    #[test]
    fn what_is_no_number_changes_nothing() {
        let mut leaf = leaf();
        leaf.grab(f32::NAN, 0.0);
        assert_eq!(leaf.phase(), Phase::Resting(Side::Right));
        leaf.grab(1.0, 0.0);
        leaf.hold([f32::INFINITY, 0.0, 0.0]);
        leaf.step(10);
        assert!(leaf.model.is_finite());
    }
}
