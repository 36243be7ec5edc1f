//! Reading and writing a leaf's nodes, and its energy.

use super::MassSpring;

impl MassSpring {
    /// Position of the node in `column` (0 spine) and `row` (0 foot): x, y, z in metres, or in the unit
    /// of length of the preset `paper-2014`.
    ///
    /// # Panics
    /// If there is no such node; so do the others here.
    pub fn position(&self, column: usize, row: usize) -> [f32; 3] {
        let lane = self.lane(column, row);
        [0, 1, 2].map(|axis| self.motion.position[axis][lane])
    }

    /// Velocity of a node, in that unit a second. Held nodes have one only where the strain limit makes
    /// velocities follow from positions.
    pub fn velocity(&self, column: usize, row: usize) -> [f32; 3] {
        let lane = self.lane(column, row);
        [0, 1, 2].map(|axis| self.motion.velocity[axis][lane])
    }

    /// Puts a node at a place, as [`position`](Self::position). Fixed and held nodes return at the next step.
    pub fn set_position(&mut self, column: usize, row: usize, position: [f32; 3]) {
        let lane = self.lane(column, row);
        for axis in 0..3 {
            self.motion.position[axis][lane] = position[axis];
        }
    }

    /// Gives a node a velocity; the spine's nodes keep theirs, which is none.
    pub fn set_velocity(&mut self, column: usize, row: usize, velocity: [f32; 3]) {
        let lane = self.lane(column, row);
        for axis in 0..3 {
            self.motion.velocity[axis][lane] = if column == 0 { 0.0 } else { velocity[axis] };
        }
    }

    /// Takes over positions and velocities of all nodes, laid out as by
    /// [`TurnModel::read_nodes`](crate::TurnModel::read_nodes): what a replay
    /// shows goes on live.
    ///
    /// # Panics
    /// If a slice is not `3 * columns * rows` long.
    pub fn write_nodes(&mut self, positions: &[f32], velocities: &[f32]) {
        self.grid.deinterleave(positions, &mut self.motion.position);
        self.grid
            .deinterleave(velocities, &mut self.motion.velocity);
        self.constraints_changed();
    }

    /// Lays the leaf flat and still on one side, which becomes the side that
    /// synchronisation measures from, lets go of it and starts its time anew.
    pub fn lay_flat(&mut self, side: crate::grid::Side) {
        self.settings.side = side;
        self.rest = self.grid.rest(side);
        for axis in 0..3 {
            self.motion.position[axis].copy_from_slice(&self.rest[axis]);
            self.motion.velocity[axis].fill(0.0);
        }
        self.steps = 0;
        self.release_all();
    }

    /// Greatest speed of any node, in the unit of length a second.
    pub fn greatest_speed(&self) -> f32 {
        let [x, y, z] = &self.motion.velocity;
        self.grid
            .node_lanes()
            .map(|lane| (x[lane] * x[lane] + y[lane] * y[lane] + z[lane] * z[lane]).sqrt())
            .fold(0.0, f32::max)
    }

    /// Kinetic energy of the nodes that are not fixed or held, J, computed in f64.
    pub fn kinetic_energy(&self) -> f64 {
        let square = |value: f32| f64::from(value) * f64::from(value);
        self.grid
            .node_lanes()
            .filter(|&lane| self.free[lane] > 0.0)
            .map(|lane| {
                let speed: f64 = self
                    .motion
                    .velocity
                    .iter()
                    .map(|axis| square(axis[lane]))
                    .sum();
                0.5 * speed / f64::from(self.own_inverse_mass[lane])
            })
            .sum()
    }

    /// Energy stored in springs, bending and height, J, computed in f64.
    pub fn potential_energy(&self) -> f64 {
        let position = &self.motion.position;
        let height: f64 = self
            .grid
            .node_lanes()
            .map(|lane| f64::from(self.forces.weight[lane]) * f64::from(position[2][lane]))
            .sum();
        let bending = self
            .forces
            .bending
            .as_ref()
            .map_or(0.0, |bending| bending.energy(position));
        self.forces.springs.energy(position) + bending + height
    }

    fn lane(&self, column: usize, row: usize) -> usize {
        assert!(
            column < self.grid.columns && row < self.grid.rows,
            "no such node"
        );
        self.grid.lane(column, row)
    }
}
