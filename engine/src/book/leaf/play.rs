//! A turn without a reader's hand: a grab of its own turns the leaf.

use super::Leaf;
use super::course::Course;
use crate::book::limits::{LONGEST_TURN, NODES, TICK};
use crate::book::phase::Phase;
use crate::grid::Side;

/// Number of the grab that turns a leaf; readers' grabs have lower ones.
const TURNER: u32 = 1000;

/// Where on the leaf it holds: at the fore-edge, a little above the foot; where the leaf is
/// folded over there, the same below the head, in the middle, or farther in.
const PLACES: [[f32; 2]; 5] = [
    [1.0, 0.14],
    [1.0, 0.86],
    [1.0, 0.5],
    [0.75, 0.5],
    [0.5, 0.5],
];

/// Part of a turn's duration, and the most seconds of one of a leaf of the usual width, by which
/// the grab is there before the leaf lies.
const AHEAD: f32 = 0.15;
const LONGEST_AHEAD: f32 = 0.12;

/// Part of its way from which on the grab lets go, if what is left of the turn is no longer than a
/// released leaf is led down in; else it leads the leaf until it is nearly there.
const LET_GO: f32 = 0.8;

/// How far the grab is drawn in toward the spine half-way, as part of the
/// width, so that the leaf bows up; and how far toward the head, of the height.
const PULL: f32 = 0.16;
const RISE: f32 = 0.05;

/// Shortest turn, seconds.
const SHORTEST: f32 = 0.2;

/// Length of a turn for which no number is given, seconds.
pub(super) const USUAL: f32 = 0.8;

impl Leaf {
    /// Takes the leaf to a side by a grab of its own, so that it lies there after `seconds` (0.2 to
    /// 600, 0.8 where they are not finite) if nothing stops it; a turn that it is in goes on at that
    /// pace, backward if need be, and so does a leaf that is held or falls.
    pub fn play(&mut self, to: Side, seconds: f32) {
        let seconds = if seconds.is_finite() {
            seconds.clamp(SHORTEST, LONGEST_TURN)
        } else {
            USUAL
        };
        match self.phase {
            Phase::Resting(side) if side == to => {}
            Phase::Resting(from) => {
                let time = if from == Side::Right { 0.0 } else { 1.0 };
                self.was_opened_anew = false;
                self.take(time, to, seconds);
            }
            Phase::Playing(_) => {
                if let Some(course) = self.course {
                    self.send(course.time, to, seconds);
                }
            }
            Phase::Held | Phase::Falling(_) => {
                let due = seconds * self.to_go(to);
                self.fall(to, Some(due));
                if self.is_carried(due, to) {
                    self.turn(to, seconds);
                }
            }
        }
    }

    /// Has a grab of its own turn the leaf to a side from where it is, as in a turn that takes
    /// `seconds` in all.
    pub(super) fn turn(&mut self, to: Side, seconds: f32) {
        // Where a grab is at this fraction of its way: of a smoothstep, near enough.
        let time = self.turned.clamp(0.0, 1.0);
        self.drop_course();
        self.take(time, to, seconds);
    }

    fn take(&mut self, time: f32, to: Side, seconds: f32) {
        let [u, v] = self.turner_place();
        self.sheet.grab(TURNER, u, v);
        self.sheet.hasten(TURNER);
        self.send(time, to, seconds);
    }

    /// Sends the grab that turns the leaf from a time of its course to a side.
    fn send(&mut self, time: f32, to: Side, seconds: f32) {
        let ahead = (AHEAD * seconds).min(LONGEST_AHEAD * self.slowness());
        let rate = 1.0 / (seconds - ahead);
        let (rate, to_go) = match to {
            Side::Left => (rate, 1.0 - time),
            Side::Right => (-rate, time),
        };
        self.course = Some(Course { time, rate });
        self.due = Some(seconds * to_go);
        self.phase = Phase::Playing(to);
    }

    /// Whether a leaf that is due on a side in so many seconds is slower than one that was released
    /// and is led there: then a grab has to carry it.
    fn is_carried(&self, due: f32, to: Side) -> bool {
        due > self
            .lead_time(self.to_go(to))
            .max(LONGEST_AHEAD * self.slowness())
    }

    /// Where the grab that turns the leaf holds it: not on what is folded over, which it would
    /// unfold.
    fn turner_place(&self) -> [f32; 2] {
        let is_whole = |place: &[f32; 2]| !self.sheet.is_beyond_crease(*place);
        PLACES.into_iter().find(is_whole).unwrap_or_else(|| {
            // Else as far out as it is whole.
            let node = self.edge[NODES[1] / 2];
            let [u, v, _] = self.flat.as_chunks::<3>().0[node];
            let settings = self.sheet.settings();
            [u / settings.width as f32, v / settings.height as f32]
        })
    }

    pub(super) fn drop_course(&mut self) {
        self.course = None;
        self.sheet.release(TURNER);
        self.sheet.loads_mut().fill(0.0);
    }

    pub(super) fn step_playing(&mut self, side: Side) {
        let Some(mut course) = self.course else {
            return;
        };
        course.time = (course.time + TICK * course.rate).clamp(0.0, 1.0);
        self.course = Some(course);
        let s = course.time;
        let way = s * s * (3.0 - 2.0 * s);
        let settings = self.sheet.settings();
        let (width, height) = (settings.width as f32, settings.height as f32);
        let (sin, cos) = libm::sincosf(core::f32::consts::PI * way);
        let [u, v] = self.turner_place();
        let radius = width * u * (1.0 - PULL * sin * sin);
        let y = height * (v + RISE * sin * sin);
        self.sheet.pull(TURNER, [radius * cos, y, radius * sin]);
        self.step_sheet();
        let gone = if side == Side::Left { way } else { 1.0 - way };
        let due = self.due.unwrap_or_default();
        if gone > LET_GO && !self.is_carried(due, side) {
            self.fall(side, Some(due));
        }
    }
}
