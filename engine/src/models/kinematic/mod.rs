//! Leaves that follow a rule instead of forces: the models of earlier page
//! turners, for what they are good at and to compare with.
//!
//! Each is a small pure map from the flat leaf into space ([`Pose`]), in double
//! precision, chosen so that one place of the leaf, which a hand or a timed turn
//! leads, comes as near to where it is led as the shape allows. Let go, the led
//! place falls as a board of the leaf's weight would, and the leaf straightens.

mod fall;
mod lead;
mod settings;
pub mod shapes;
#[cfg(test)]
mod tests;

pub use settings::{InvalidKinematic, KinematicSettings};
pub use shapes::{Pose, Shape};

use crate::gesture::{Gesture, Grip};
use crate::grid::Side;
use crate::interpolate::uniform_samples;
use crate::surface::Surface;
use crate::turn::TurnModel;
use core::f64::consts::PI;
use fall::Fall;
use lead::Lead;

/// How conical a cone is when a timed turn leads a corner.
const BY_CORNER: f64 = 0.3;

/// Nearest to the spine that a leaf can be led, as part of the width: what is
/// bound there does not move.
const NEAREST: f64 = 0.05;

/// What leads the leaf.
#[derive(Clone, Copy, Debug)]
enum State {
    Resting,
    /// A hand: where it took hold, and where the led place was then.
    Held {
        from: [f64; 3],
        led: [f64; 3],
    },
    /// A timed turn that began at a step.
    Played {
        gesture: Gesture,
        start: u64,
    },
    Falling,
}

/// A leaf that follows a rule.
#[derive(Clone, Debug)]
pub struct Kinematic {
    settings: KinematicSettings,
    fall: Fall,
    /// Places of the drawn columns and rows on the flat leaf, metres.
    x: Vec<f64>,
    y: Vec<f64>,
    steps: u64,
    state: State,
    lead: Lead,
    /// Where a hand is that holds it: what it took hold of, and where it pulls.
    hand: Option<([f64; 2], [f64; 3])>,
    /// Rate of the led angle, rad/s.
    rate: f64,
    /// Whether the turn began on the left: then all is mirrored.
    mirrored: bool,
    pose: Pose,
    before: Pose,
}

impl Kinematic {
    /// A leaf at rest on its side.
    ///
    /// # Errors
    /// Where a setting is no number or out of bounds.
    pub fn new(settings: KinematicSettings) -> Result<Self, InvalidKinematic> {
        settings.check()?;
        let lead = Lead::rest([settings.width, 0.0], 0.0);
        let pose = pose_of(&settings, &lead);
        let (columns, rows) = (settings.columns, settings.rows);
        let mut leaf = Self {
            fall: Fall::new(&settings),
            x: Vec::new(),
            y: Vec::new(),
            steps: 0,
            state: State::Resting,
            lead,
            hand: None,
            rate: 0.0,
            mirrored: settings.side == Side::Left,
            pose,
            before: pose,
            settings,
        };
        leaf.draw_samples(&uniform_samples(columns), &uniform_samples(rows));
        Ok(leaf)
    }

    /// What it is.
    pub fn settings(&self) -> &KinematicSettings {
        &self.settings
    }

    /// Its shape now, for a turn from right to left: where
    /// [`Kinematic::mirrored`], x counts the other way.
    pub fn pose(&self) -> Pose {
        self.pose
    }

    /// Whether the turn under way began on the left.
    pub fn mirrored(&self) -> bool {
        self.mirrored
    }

    /// The side on which it rests, none while it is on its way.
    pub fn resting(&self) -> Option<Side> {
        let right = (self.lead.angle == 0.0) != self.mirrored;
        let side = if right { Side::Right } else { Side::Left };
        matches!(self.state, State::Resting).then_some(side)
    }

    /// Lays the leaf flat and still on a side, nothing holding it.
    pub fn lay_flat(&mut self, side: Side) {
        self.mirrored = side == Side::Left;
        self.lead = Lead::rest(self.lead.place, 0.0);
        (self.state, self.hand, self.rate) = (State::Resting, None, 0.0);
        self.pose = pose_of(&self.settings, &self.lead);
        self.before = self.pose;
    }

    /// Draws at every pair of `u` (0 spine, 1 fore-edge) and `v` (0 foot, 1
    /// head), each rising and within 0..1.
    ///
    /// # Panics
    /// If there are fewer than 2 of either.
    pub fn draw_samples(&mut self, u: &[f32], v: &[f32]) {
        assert!(u.len() >= 2 && v.len() >= 2, "at least 2 samples a side");
        let at = |samples: &[f32], size: f64| -> Vec<f64> {
            samples.iter().map(|&s| f64::from(s) * size).collect()
        };
        self.x = at(u, self.settings.width);
        self.y = at(v, self.settings.height);
        (self.settings.columns, self.settings.rows) = (u.len(), v.len());
    }

    /// Starts a timed turn, from where the gesture begins: the middle of the
    /// fore-edge is led, or its foot corner where only that is held or where it
    /// goes ahead.
    pub fn play(&mut self, gesture: Gesture) {
        self.lay_flat(gesture.from);
        let corner = gesture.grip == Grip::FootCorner || gesture.lag > 0.0;
        let [width, height] = self.size();
        let place = [width, if corner { 0.0 } else { 0.5 * height }];
        self.lead = Lead {
            conical: Some(if corner { BY_CORNER } else { 0.0 }),
            ..Lead::rest(place, 0.0)
        };
        let start = self.steps;
        self.state = State::Played { gesture, start };
    }

    /// A hand takes hold at (u, v), 0 to 1, where the leaf is now. In the middle of
    /// a turn the place that led until then goes on to lead, moved as the hand
    /// moves, so that the leaf does not jump.
    pub fn grab(&mut self, u: f32, v: f32) {
        if !(u.is_finite() && v.is_finite()) {
            return;
        }
        let [width, height] = self.size();
        let u = f64::from(u).clamp(NEAREST, 1.0);
        let place = [u * width, f64::from(v).clamp(0.0, 1.0) * height];
        if matches!(self.state, State::Resting) {
            let side = self.resting().unwrap_or(Side::Right);
            self.mirrored = side == Side::Left;
            self.lead = Lead::rest(place, 0.0);
            self.pose = pose_of(&self.settings, &self.lead);
        }
        let (from, led) = (self.pose.place(place), self.lead.at());
        self.state = State::Held { from, led };
        self.hand = Some((place, from));
        self.rate = 0.0;
    }

    /// The hand pulls to a place, metres. Nothing happens where none holds, or
    /// where the place is no number.
    pub fn pull(&mut self, to: [f32; 3]) {
        let mirror = if self.mirrored { -1.0 } else { 1.0 };
        if let Some((_, at)) = &mut self.hand
            && to.iter().all(|x| x.is_finite())
        {
            let [x, y, z] = to.map(|x| f64::from(x).clamp(-1e3, 1e3));
            *at = [mirror * x, y, z];
        }
    }

    /// The hand, or the timed turn, lets go: the leaf falls.
    pub fn release(&mut self) {
        if !matches!(self.state, State::Resting) {
            (self.state, self.hand) = (State::Falling, None);
        }
    }

    /// Where what a hand holds is now, metres; none where none holds.
    pub fn held_place(&self) -> Option<[f32; 3]> {
        let (place, _) = self.hand?;
        Some(self.drawn(&self.pose, place))
    }

    fn size(&self) -> [f64; 2] {
        [self.settings.width, self.settings.height]
    }

    /// Where a place is drawn.
    fn drawn(&self, pose: &Pose, place: [f64; 2]) -> [f32; 3] {
        let [x, y, z] = pose.place(place);
        [if self.mirrored { -x } else { x }, y, z].map(|x| x as f32)
    }

    /// Moves the led place on by a step.
    fn advance(&mut self) {
        let (h, before) = (self.settings.time_step, self.lead.angle);
        let height = self.settings.height;
        match self.state {
            State::Resting => return,
            State::Held { from, led } => {
                let Some((place, at)) = self.hand else { return };
                // What leads is nearer to the spine, or farther, than the hand.
                let scale = self.lead.place[0] / place[0];
                let to = core::array::from_fn(|axis| led[axis] + scale * (at[axis] - from[axis]));
                self.lead.go(height, to);
            }
            State::Played { gesture, start } => {
                let time = (self.steps - start) as f64 * h;
                let [_, y] = self.lead.place;
                let [x, y, z] = gesture
                    .position((y / height) as f32, y as f32, time as f32)
                    .map(f64::from);
                let scale = self.settings.width / f64::from(gesture.radius);
                let mirror = f64::from(gesture.from.sign());
                self.lead.go(height, [scale * mirror * x, y, scale * z]);
                if time >= f64::from(gesture.seconds) {
                    self.rest(PI);
                    return;
                }
            }
            State::Falling => {
                (self.lead.angle, self.rate) = self.fall.step(before, self.rate, h);
                let part = Fall::straightening(h);
                let [x, y] = self.lead.place;
                self.lead.distance = x + part * (self.lead.distance - x);
                self.lead.along = y + part * (self.lead.along - y);
                let down = self.lead.angle == 0.0 || self.lead.angle == PI;
                if down && x - self.lead.distance < 1e-5 * x {
                    self.rest(self.lead.angle);
                }
                return;
            }
        }
        self.rate = (self.lead.angle - before) / h;
    }

    fn rest(&mut self, angle: f64) {
        self.lead = Lead::rest(self.lead.place, angle);
        (self.state, self.hand, self.rate) = (State::Resting, None, 0.0);
    }
}

/// The pose of a leaf that is led.
fn pose_of(settings: &KinematicSettings, lead: &Lead) -> Pose {
    Pose::toward(settings.shape, [settings.width, settings.height], lead)
}

impl TurnModel for Kinematic {
    fn time_step(&self) -> f32 {
        self.settings.time_step as f32
    }

    fn time(&self) -> f32 {
        (self.steps as f64 * self.settings.time_step) as f32
    }

    fn step(&mut self) {
        self.steps += 1;
        self.advance();
        self.before = self.pose;
        self.pose = pose_of(&self.settings, &self.lead);
    }

    fn write_surface(&mut self, surface: &mut Surface) {
        surface.resize(self.x.len(), self.y.len());
        let points = surface.positions.as_chunks_mut::<3>().0;
        let mirror = if self.mirrored { -1.0 } else { 1.0 };
        self.pose.write(&self.x, &self.y, mirror, points);
        surface.touch();
    }

    /// The drawn points: it has no other nodes.
    fn grid_size(&self) -> (usize, usize) {
        (self.x.len(), self.y.len())
    }

    fn read_nodes(&self, positions: &mut [f32], velocities: &mut [f32]) {
        let count = 3 * self.x.len() * self.y.len();
        assert!(positions.len() == count && velocities.len() == count);
        let rate = (1.0 / self.settings.time_step) as f32;
        let (points, speeds) = (
            positions.as_chunks_mut::<3>().0,
            velocities.as_chunks_mut::<3>().0,
        );
        let places = self
            .y
            .iter()
            .flat_map(|&y| self.x.iter().map(move |&x| [x, y]));
        for ((point, speed), place) in points.iter_mut().zip(speeds).zip(places) {
            *point = self.drawn(&self.pose, place);
            let before = self.drawn(&self.before, place);
            *speed = core::array::from_fn(|axis| (point[axis] - before[axis]) * rate);
        }
    }
}
