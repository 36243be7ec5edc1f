//! How creases open that were pressed shut under other leaves.

use crate::models::sheet::SheetCrease;

/// Ticks in which creases open that were pressed shut: half a second, as they are folded in by hand.
/// Paper that was pressed recovers in time; let go at once, a letter would leap.
const OPENING: u32 = 60;

/// Part of its speed that what begins to open keeps in a tick, all once it is open: air between its
/// parts has to come in. Parts that lie nearer to each other than they keep apart would else throw
/// each other off.
const KEPT_SPEED: f32 = 0.1;

/// How creases open that were pressed shut.
pub(super) struct Opening {
    /// Where each was pressed to, and where it rests once it is open, radians.
    from: Vec<f32>,
    pub to: Vec<f32>,
    /// Ticks since it was pressed.
    ticks: u32,
}

impl Opening {
    /// Begins with creases that were pressed to angles, and will rest at others.
    pub fn new(from: Vec<f32>, to: Vec<f32>) -> Opening {
        Opening { from, to, ticks: 0 }
    }

    /// Has creases along these lines that have not begun to open creep toward where they are pressed
    /// to, for so many seconds.
    pub fn creep(&mut self, lines: &[SheetCrease], seconds: f64) {
        if self.ticks > 0 {
            return;
        }
        for ((line, pressed), to) in lines.iter().zip(&self.from).zip(&mut self.to) {
            let made = SheetCrease {
                rest: f64::from(*to),
                ..*line
            };
            *to = made.held_at(f64::from(*pressed), seconds).rest as f32;
        }
    }

    /// Goes on by a tick. Returns the angle at which each crease rests then; None once all are open.
    pub fn step(&mut self) -> Option<Vec<f32>> {
        self.ticks += 1;
        let part = self.part();
        if part >= 1.0 {
            return None;
        }
        let eased = part * part * (3.0 - 2.0 * part);
        let rests = self.from.iter().zip(&self.to);
        Some(rests.map(|(from, to)| from + (to - from) * eased).collect())
    }

    /// Returns the angle at which each crease rests once it is a part of the way, 0 to 1, back to
    /// where it was pressed to, and is to open from there.
    pub fn shut(&mut self, part: f32) -> Vec<f32> {
        self.ticks = 0;
        let rests = self.from.iter().zip(&self.to);
        rests.map(|(from, to)| to + (from - to) * part).collect()
    }

    /// Part of its speed that the leaf keeps in a tick.
    pub fn kept_speed(&self) -> f32 {
        KEPT_SPEED + self.part() * (1.0 - KEPT_SPEED)
    }

    /// How far it has opened, 0 to 1.
    pub fn part(&self) -> f32 {
        self.ticks as f32 / OPENING as f32
    }
}
