//! A leaf let go: helped over, fallen, eased to rest.

use super::{Leaf, Settling, TICK, length};
use crate::grid::Side;
use crate::turn::TurnModel;

/// Acceleration at the fore-edge by which a released leaf is helped over, m/s^2.
const ASSIST: f32 = 14.0;

/// A leaf nearer to rest than this (metres) and slower than this (m/s) everywhere is
/// eased to rest within `SETTLE_SECONDS`; so is one that has fallen for
/// `LONGEST_FALL` ticks.
const NEAR: f32 = 0.004;
const SLOW: f32 = 0.5;
const SETTLE_SECONDS: f32 = 0.14;
const LONGEST_FALL: u32 = 360;

impl Leaf {
    pub(super) fn step_falling(&mut self, side: Side) {
        if self.settling.is_some() {
            self.step_settling(side);
            return;
        }
        self.help_over(side);
        self.model.step();
        self.fallen += 1;
        let landed = self.farthest_from_rest(side) < NEAR && self.model.greatest_speed() < SLOW;
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

    /// Greatest distance of a node from its place of rest on a side, metres.
    fn farthest_from_rest(&self, side: Side) -> f32 {
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
