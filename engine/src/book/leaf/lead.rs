//! How a released leaf is led to its side: as by a flat hand that goes with it, carried over
//! the top and let down.
//!
//! The hand turns the leaf about the spine. Each tick it takes the course of least effort, the
//! cubic in time that comes to rest on the side when the leaf is due there, and gives the torque
//! that this takes beside gravity and the drag of the air. Its force grows with the distance from
//! the spine as the leaf's inertia does, so it bends the leaf as little as a turn of all of it
//! would.

use super::Leaf;
use crate::book::limits::TICK;
use crate::book::phase::Phase;
use crate::grab::strongest;
use crate::grid::Side;
use crate::real::bounded;
use core::f32::consts::PI;

/// Time in which a hand leads a leaf of the usual width through half of the half turn, seconds:
/// from upright. Farther ones take longer by the root, as at an even acceleration.
const FROM_UPRIGHT: f32 = 0.52;

/// Ticks before a leaf is due after which it is not hurried to be there on time: what stops it
/// then is not the hand's to push away.
const LAST_TICKS: f32 = 4.0;

/// A leaf that was due earlier and has less than this part of the half turn to go is left to its
/// weight: what keeps it up is below it.
pub(super) const LYING: f32 = 0.1;

impl Leaf {
    /// Seconds in which a hand leads the leaf through a part of the half turn, 0 to 1, to lie.
    pub(super) fn lead_time(&self, to_go: f32) -> f32 {
        FROM_UPRIGHT * (to_go.max(0.0) / 0.5).sqrt() * self.slowness()
    }

    /// Times of a leaf as wide as this one over those of one of the usual width.
    pub(super) fn slowness(&self) -> f32 {
        self.paper.slowness(self.sheet.settings().width)
    }

    /// Seconds in which a leaf released here is led to a side; None where it is left to itself.
    pub(super) fn help_to(&self, side: Side) -> Option<f32> {
        self.paper.assist.then(|| self.lead_time(self.to_go(side)))
    }

    /// Lets a tick of the time pass in which the leaf is due.
    pub(super) fn come_due(&mut self) {
        if let Some(due) = self.due.filter(|due| *due > 0.0) {
            self.due = Some((due - TICK).max(0.0));
            // A hand that has led it down held it: whether it lies still shows after that.
            if self.due == Some(0.0) && self.phase != Phase::Held {
                self.stay_awake();
            }
        }
    }

    /// Part of the half turn that the leaf has to go to a side, 0 to 1.
    pub(super) fn to_go(&self, side: Side) -> f32 {
        match side {
            Side::Left => 1.0 - self.turned,
            Side::Right => self.turned,
        }
    }

    /// Loads the leaf with the force of the hand that leads it to a side; without one with none.
    pub(super) fn lead(&mut self, side: Side) {
        let to_go = self.to_go(side);
        let Some(due) = self.due.filter(|due| *due > 0.0 || to_go > LYING) else {
            self.sheet.loads_mut().fill(0.0);
            return;
        };
        let usual = self.lead_time(to_go);
        // Angles, radians, are counted toward the side.
        let sign = -side.sign();
        let settings = self.sheet.settings();
        // The hand moves the air that the leaf carries along with it.
        let inert = (1.0 + settings.air.added_mass / settings.stock.grammage) as f32;
        let drag = (0.5 * settings.air.density * settings.air.drag) as f32;
        let (width, height) = (settings.width as f32, settings.height as f32);
        let area = settings.width * settings.height;
        let most =
            (settings.grab_strength * strongest(settings.stock.grammage, area)) as f32 * width;
        let gravity = settings.gravity[2] as f32;

        let (mut inertia, mut momentum, mut fall) = (0.0f32, 0.0f32, 0.0f32);
        let velocities = self.sheet.velocities().as_chunks::<3>().0;
        let places = self.sheet.positions().as_chunks::<3>().0;
        for ((mass, x), v) in self.sheet.masses().iter().zip(places).zip(velocities) {
            inertia += inert * mass * (x[0] * x[0] + x[2] * x[2]);
            momentum += inert * mass * (x[0] * v[2] - x[2] * v[0]);
            fall += mass * x[0] * gravity;
        }
        let inertia = inertia.max(f32::MIN_POSITIVE);
        let rate = sign * momentum / inertia;
        let way = PI * to_go;
        let least = LAST_TICKS * TICK;
        let left = if due > least { due } else { usual };
        // What is faster than that arrives earlier: it does not turn back.
        let left = if rate > 0.0 {
            left.min(3.0 * way / rate)
        } else {
            left
        }
        .max(least);
        let wanted = 6.0 * way / (left * left) - 4.0 * rate / left;
        // Drag on a flat leaf: of each strip by the square of its speed.
        let square = width * width;
        let slowing = drag * height * square * square / 4.0 * rate * rate.abs();
        let torque = bounded(inertia * wanted + slowing - sign * fall, -most, most);
        // Held from below its folds would fall open.
        let torque = if self.sheet.is_creased() && !self.is_held_shut() {
            torque.max(0.0)
        } else {
            torque
        };
        let push = sign * torque * inert / inertia;
        let (places, masses, loads) = self.sheet.load_state();
        let nodes = places.as_chunks::<3>().0.iter().zip(masses);
        for ((x, mass), load) in nodes.zip(loads.as_chunks_mut::<3>().0) {
            *load = [-push * mass * x[2], 0.0, push * mass * x[0]];
        }
    }
}
