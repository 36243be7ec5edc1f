//! A leaf let go: helped over, fallen, eased to rest.

use super::Leaf;
use super::lead::LYING;
use super::play::USUAL;
use crate::book::limits::{MAX_GRABS, NODES, TICK};
use crate::book::phase::Phase;
use crate::contact::flaps::Flaps;
use crate::grid::Side;

/// A leaf nearer to rest than this part of its width and slower than this (m/s, of one of the usual
/// width) everywhere is eased to rest within `SETTLE_SECONDS`; so is one of the usual width that
/// has fallen for `LONGEST_FALL` seconds.
const NEAR: f32 = 0.018;
const SLOW: f32 = 0.35;
const SETTLE_SECONDS: f32 = 0.15;

/// The hand that leads a leaf puts it down in the last seconds before it is due, as soon as no node
/// has to be faster for that than a hand, m/s.
const PUT_DOWN_SECONDS: f32 = 0.05;
const PUT_DOWN_SPEED: f32 = 3.0;
const LONGEST_FALL: f32 = 2.5;

/// A leaf that has fallen for so many ticks, and has more than this part of the half turn
/// to go, and less than this rate of it (1/s), lies there: what helps it over is weaker
/// than its weight.
const LYING_TICKS: u32 = 24;
const LYING_TO_GO: f32 = 0.6;
const LYING_RATE: f32 = 0.2;

/// A leaf that folds hold up lies on its side with less than this part of the half turn to go.
const HELD_UP_TO_GO: f32 = 0.25;

impl Leaf {
    /// Lets the leaf fall to a side, led there in `seconds` where they are given.
    pub(super) fn fall(&mut self, to: Side, seconds: Option<f32>) {
        if self.phase != Phase::Falling(to) {
            self.end_open_anew();
        }
        self.drop_course();
        for grab in 0..self.pulls.len() as u32 {
            self.sheet.release(grab);
        }
        self.pulls = [None; MAX_GRABS];
        if self.phase != Phase::Falling(to) {
            self.settling = None;
            self.fallen = 0;
            if self.phase != Phase::Playing(to) {
                self.turned_over = false;
            }
        }
        self.due = seconds;
        self.phase = Phase::Falling(to);
        self.stay_awake();
    }

    pub(super) fn step_falling(&mut self, side: Side, supported: bool, has_way: bool) {
        if self.settling.is_some() && supported {
            self.step_settling(side);
            return;
        }
        self.end_open_anew();
        self.settling = None;
        let side = if self.due.is_some() || self.is_overdue() {
            side
        } else {
            self.side_ahead()
        };
        self.phase = Phase::Falling(side);
        if has_way && self.lies_across_from(side) {
            self.turned_over = true;
            self.turn(side, USUAL);
            self.step_playing(side);
            return;
        }
        self.lead(side);
        self.step_sheet();
        self.fallen += 1;
        let landed = if self.may_be_held_up() && !self.is_held_shut() {
            self.lies_held_up(side)
        } else {
            let slow = SLOW * self.slowness() / self.paper.scale as f32;
            let is_slow = self.sheet.greatest_speed() < slow;
            let height = self.height_over_rest(side);
            let is_near = height < NEAR * self.sheet.settings().width as f32;
            is_slow && is_near
                || self.is_put_down(side, height, is_slow)
                || self.is_held_up && self.lies_held_up(side)
        };
        if supported && (landed || self.is_overdue()) {
            self.landed.copy_from_slice(self.sheet.positions());
            self.find_rest(side, landed);
            self.settling = Some(0.0);
            let due = self.due.filter(|due| *due > 0.0);
            self.settle_time = due.unwrap_or(SETTLE_SECONDS).min(SETTLE_SECONDS);
            // What was put down through itself and opened anew was put down.
            self.put_down = !landed || (self.was_opened_anew && self.put_down);
            self.opens_anew = false;
            self.sheet.loads_mut().fill(0.0);
        }
    }

    /// Whether the hand that leads it puts it down now, `height` metres from its place of rest: in
    /// time, or where limp paper lies still before it lies flat.
    fn is_put_down(&self, side: Side, height: f32, is_slow: bool) -> bool {
        self.due.is_some_and(|due| match due {
            0.0 => is_slow && self.to_go(side) < LYING,
            // Its way slows down evenly to a stop, from twice its mean speed.
            _ => due <= PUT_DOWN_SECONDS && height < 0.5 * PUT_DOWN_SPEED * due,
        })
    }

    /// Whether it has fallen for as long as a leaf may, or stands in the air, caught by its own
    /// folds or by others: it is put down as soon as what lies under it is down, on the side that
    /// it is headed for by then.
    pub fn is_overdue(&self) -> bool {
        let longest = LONGEST_FALL * self.slowness();
        matches!(self.phase, Phase::Falling(_))
            && (self.fallen as f32 * TICK > longest || self.stands_still())
    }

    /// Turns a falling leaf toward a side. It has fallen for as long as before.
    pub fn head_for(&mut self, side: Side) {
        if matches!(self.phase, Phase::Falling(to) if to != side) {
            self.end_open_anew();
            self.settling = None;
            self.phase = Phase::Falling(side);
        }
    }

    /// Whether folds, its own or those under it, may keep it from lying flat.
    pub(super) fn may_be_held_up(&self) -> bool {
        self.is_held_up || self.sheet.is_creased()
    }

    /// Whether a leaf lies on its side as still as it will: what folds hold up rests above the
    /// pile.
    fn lies_held_up(&self, side: Side) -> bool {
        self.to_go(side) < HELD_UP_TO_GO && self.stands_still()
    }

    /// Whether a leaf that folds may hold up is where nothing moves it any more, wherever that is:
    /// a tick that is taken back leaves it there with some speed, and the next one is like it.
    fn stands_still(&self) -> bool {
        let is_led = self.due.is_some_and(|due| due > 0.0);
        self.may_be_held_up()
            && !is_led
            && (self.opening.is_none() || self.is_held_shut())
            && (self.lies_still() || self.is_slow())
    }

    /// Finds where the leaf, which has landed on a side or not, is eased to rest: flat on the
    /// pile; with creases, where it landed, or folded as they rest. Where its folds lie upon folds,
    /// whose shape is not known beforehand, it is lowered about the spine as it is.
    fn find_rest(&mut self, side: Side, landed: bool) {
        self.lowering = 0.0;
        if self.is_held_shut() {
            self.find_shut_rest(side);
        } else if !self.sheet.is_creased() {
            for (k, (rest, flat)) in self.rest.iter_mut().zip(&self.flat).enumerate() {
                *rest = if k % 3 == 0 {
                    side.sign() * flat
                } else {
                    *flat
                };
            }
        } else if landed {
            self.rest.copy_from_slice(&self.landed);
        } else if self.flaps.as_ref().is_some_and(Flaps::overlap) {
            self.lowering = lowest_angle(&self.landed, side);
            let lowered = lowered(&self.landed, side, self.lowering);
            for (rest, x) in self.rest.iter_mut().zip(lowered) {
                *rest = x;
            }
        } else {
            self.sheet.lay_folded(side);
            self.rest.copy_from_slice(self.sheet.positions());
            self.sheet.put_back(&self.landed);
        }
    }

    /// Whether it lies on the other side than it is headed for, and no grab of its own has
    /// tried to turn it over yet.
    fn lies_across_from(&self, side: Side) -> bool {
        self.due.is_some()
            && !self.turned_over
            && self.fallen >= LYING_TICKS
            && self.to_go(side) > LYING_TO_GO
            && self.turn_rate.abs() < LYING_RATE
    }

    fn step_settling(&mut self, side: Side) {
        let Some(time) = &mut self.settling else {
            return;
        };
        *time += TICK;
        let t = (*time / self.settle_time).min(1.0);
        if t >= 1.0 {
            if self.settle_pressed(side) {
                return;
            }
            let put_down = self.put_down;
            if self.sheet.is_creased() {
                let rest = core::mem::take(&mut self.rest);
                self.lay_at(side, &rest);
                self.rest = rest;
            } else {
                self.lay(side);
            }
            self.put_down = put_down;
            return;
        }
        // A hand that puts it down goes on as it led it.
        let eased = if self.due.is_some() {
            t * (2.0 - t)
        } else {
            t * t * (3.0 - 2.0 * t)
        };
        if self.lowering > 0.0 {
            let lowered = lowered(&self.landed, side, eased * self.lowering);
            self.sheet.place(lowered);
            return;
        }
        let states = self.landed.iter().zip(&self.rest);
        let eased = states.map(|(landed, rest)| landed + (rest - landed) * eased);
        self.sheet.place(eased);
    }

    /// Greatest distance of a node from its place of rest on a side, metres.
    fn height_over_rest(&self, side: Side) -> f32 {
        let flat = self.shut_places().unwrap_or(&self.flat);
        let states = self.sheet.positions().iter().zip(flat);
        let apart = states.enumerate().map(|(k, (x, flat))| {
            let rest = if k % 3 == 0 {
                side.sign() * flat
            } else {
                *flat
            };
            (x - rest).abs()
        });
        apart.fold(0.0, f32::max)
    }
}

/// Angle by which nodes can be turned about the spine toward a side until one of them is on the
/// table, radians, 0 or more. Those on the spine stay where they are.
fn lowest_angle(nodes: &[f32], side: Side) -> f32 {
    let nodes = nodes.as_chunks::<3>().0.iter().enumerate();
    let free = nodes.filter(|(node, _)| node % NODES[0] > 0);
    let angles = free.map(|(_, [x, _, z])| libm::atan2f(*z, side.sign() * x));
    angles.fold(core::f32::consts::PI, f32::min).max(0.0)
}

/// Nodes turned about the spine toward a side by an angle, radians.
fn lowered(nodes: &[f32], side: Side, angle: f32) -> impl Iterator<Item = f32> {
    let (sin, cos) = libm::sincosf(angle);
    let sign = side.sign();
    nodes.as_chunks::<3>().0.iter().flat_map(move |[x, y, z]| {
        let ahead = sign * x;
        [sign * (ahead * cos + z * sin), *y, z * cos - ahead * sin]
    })
}
