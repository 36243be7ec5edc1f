//! What holds a leaf: the spine, a gesture, a hand.

use super::held::Held;
use super::{MassSpring, Settings};
use crate::gesture::Gesture;
use crate::synchronise::Synchroniser;

/// How near to taut a hand may pull, as part of the distance at rest: taut
/// would leave the springs no room for the sheet's own motion.
const REACH: f32 = 0.999;

impl MassSpring {
    /// Starts a gesture now: the nodes it holds are held until
    /// [`MassSpring::release_all`], after its end where it left them.
    pub fn play(&mut self, gesture: Gesture) {
        self.release_all();
        self.gesture = Some((gesture, self.steps));
        let column = self.grid.columns - 1;
        for row in (0..self.grid.rows).filter(|&row| gesture.holds(row)) {
            let from = self.position(column, row);
            self.held.push(Held {
                column,
                row,
                from,
                to: from,
                by_gesture: true,
            });
        }
        self.constraints_changed();
    }

    /// The gesture under way, or the one that ended last.
    pub fn gesture(&self) -> Option<&Gesture> {
        self.gesture.as_ref().map(|(gesture, _)| gesture)
    }

    /// Holds a node, or moves the place where it is held: during the next step
    /// it goes to `target` in a straight line. The target is taken as it is;
    /// see [`MassSpring::within_reach`]. Where the strain limit sweeps, it yields
    /// to a sheet that cannot follow; [`MassSpring::position`] tells where it is.
    ///
    /// # Panics
    /// If there is no such node, or if it is of the spine.
    pub fn hold(&mut self, column: usize, row: usize, target: [f32; 3]) {
        assert!(column > 0, "the spine holds its own nodes");
        let from = self.position(column, row);
        if let Some(held) = self
            .held
            .iter_mut()
            .find(|held| (held.column, held.row) == (column, row))
        {
            held.to = target;
            if held.by_gesture {
                held.by_gesture = false;
                self.constraints_changed();
            }
            return;
        }
        self.held.push(Held {
            column,
            row,
            from,
            to: target,
            by_gesture: false,
        });
        self.constraints_changed();
    }

    /// Lets go of a node, which keeps the velocity that it has.
    pub fn release(&mut self, column: usize, row: usize) {
        self.held
            .retain(|held| (held.column, held.row) != (column, row));
        self.constraints_changed();
    }

    /// Lets go of all nodes and ends the gesture; the spine stays fixed.
    pub fn release_all(&mut self) {
        self.gesture = None;
        self.held.clear();
        self.constraints_changed();
    }

    /// Whether a node is held.
    pub fn is_held(&self, column: usize, row: usize) -> bool {
        self.held
            .iter()
            .any(|held| (held.column, held.row) == (column, row))
    }

    /// The place nearest to `target` (but for a few per cent) that the node can
    /// be brought to without stretching the leaf: no farther from any node of
    /// the spine than it lies at rest, and not below the table where there is one.
    pub fn within_reach(&self, column: usize, row: usize, target: [f32; 3]) -> [f32; 3] {
        let mut place = target;
        let across = column as f32 * self.grid.du();
        for _ in 0..8 {
            for spine in 0..self.grid.rows {
                let up = (row as f32 - spine as f32) * self.grid.dv();
                let reach = REACH * (across * across + up * up).sqrt();
                let root = self.position(0, spine);
                let d = [0, 1, 2].map(|axis| place[axis] - root[axis]);
                let distance = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
                if distance > reach {
                    place = [0, 1, 2].map(|axis| root[axis] + d[axis] * (reach / distance));
                }
            }
            if self.settings.floor && place[2] < 0.0 {
                place[2] = 0.0;
            }
        }
        place
    }

    /// Puts every held node where it is to be, `part` of the way through the
    /// step, and every node of the spine back.
    pub(super) fn place_fixed_and_held(&mut self, part: f32) {
        let grid = &self.grid;
        for axis in 0..3 {
            for lane in (0..grid.lanes()).step_by(grid.stride) {
                self.motion.position[axis][lane] = self.rest[axis][lane];
            }
        }
        let mut of_gesture = None;
        for held in &mut self.held {
            let to = match &self.gesture {
                Some((gesture, start)) if held.by_gesture => {
                    let time = ((self.steps - start) as f64 + f64::from(part))
                        * f64::from(self.settings.time_step);
                    let v = held.row as f32 / (grid.rows - 1) as f32;
                    // Without lag all rows share one place on the path.
                    let path = match of_gesture {
                        Some(path) if gesture.lag == 0.0 => path,
                        _ => gesture.position(v, 0.0, time as f32),
                    };
                    of_gesture = Some(path);
                    held.to = [path[0], path[1] + held.row as f32 * grid.dv(), path[2]];
                    held.to
                }
                _ => {
                    [0, 1, 2].map(|axis| held.from[axis] + (held.to[axis] - held.from[axis]) * part)
                }
            };
            let lane = grid.lane(held.column, held.row);
            for axis in 0..3 {
                self.motion.position[axis][lane] = to[axis];
            }
        }
    }

    /// Takes note of where held nodes are at the end of a step.
    pub(super) fn remember_held(&mut self) {
        for held in &mut self.held {
            let lane = self.grid.lane(held.column, held.row);
            held.from = [0, 1, 2].map(|axis| self.motion.position[axis][lane]);
        }
    }

    /// Recomputes what follows from which nodes are fixed or held.
    pub(super) fn constraints_changed(&mut self) {
        let grid = self.grid;
        for lane in grid.node_lanes() {
            self.free[lane] = if lane % grid.stride == 0 { 0.0 } else { 1.0 };
        }
        for held in &self.held {
            self.free[grid.lane(held.column, held.row)] = 0.0;
        }
        let follows = self.limiter.moves_velocity();
        for lane in grid.node_lanes() {
            self.inverse_mass[lane] = self.own_inverse_mass[lane] * self.free[lane];
            if self.free[lane] == 0.0 && !follows {
                for axis in 0..3 {
                    self.motion.velocity[axis][lane] = 0.0;
                }
            }
        }
        self.limit_weight.copy_from_slice(&self.inverse_mass);
        for held in self.held.iter().filter(|held| !held.by_gesture) {
            let lane = grid.lane(held.column, held.row);
            self.limit_weight[lane] = self.own_inverse_mass[lane];
        }
        self.synchroniser = Synchroniser::new(self.settings.synchronise, &grid, &self.free);
    }
}

impl Settings {
    /// The gesture of a name: `column` or `corner`.
    pub fn gesture(&self, name: &str, seconds: f32) -> Option<Gesture> {
        match name {
            "column" => Some(self.column_gesture(seconds)),
            "corner" => Some(self.corner_gesture(seconds)),
            _ => None,
        }
    }
}
