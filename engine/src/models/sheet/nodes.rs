//! Where the nodes of a sheet are, how fast they move, and what acts on them: read and set.

use super::{CONTACTS, Contact, Sheet};
use crate::grid::Side;

impl Sheet {
    /// Lays the sheet flat and still on a side, nothing holding it.
    pub fn lay_flat(&mut self, side: Side) {
        let nodes = self.positions.chunks_exact_mut(3);
        for (x, [u, v]) in nodes.zip(&self.material.places) {
            x.copy_from_slice(&[side.sign() * *u as f32, *v as f32, 0.0]);
        }
        self.velocities.fill(0.0);
        self.grabs.clear();
        let angle = match side {
            Side::Right => 0.0,
            Side::Left => core::f32::consts::PI,
        };
        self.set_clamp_angle(angle);
        self.last_tangents.copy_from_slice(&self.tangents);
    }

    /// Where its nodes are when it lies flat on the right, x, y, z of each, metres.
    pub(crate) fn flat_places(&self) -> Vec<f32> {
        let places = self.material.places.iter();
        places
            .flat_map(|[u, v]| [*u as f32, *v as f32, 0.0])
            .collect()
    }

    /// Sets the angle at which the sheet leaves the spine, radians: 0 level to
    /// the right, pi level to the left.
    pub fn set_clamp_angle(&mut self, angle: f32) {
        let (sin, cos) = libm::sincosf(angle);
        let [du, dv] = self.settings.cell().map(|cell| cell as f32);
        let is_creased = self.creased().is_some();
        for (row, tangent) in self.tangents.chunks_exact_mut(3).enumerate() {
            let v = if is_creased {
                self.material.places[row * self.settings.columns][1] as f32
            } else {
                row as f32 * dv
            };
            tangent.copy_from_slice(&[du * cos, v, du * sin]);
        }
    }

    /// Positions of the nodes, metres: x, y, z of each, row by row from the
    /// foot, each row from the spine to the fore-edge.
    pub fn positions(&self) -> &[f32] {
        &self.positions
    }

    /// Velocities of the nodes, m/s, as [`positions`](Self::positions).
    pub fn velocities(&self) -> &[f32] {
        &self.velocities
    }

    /// Kilograms of each node, without the air's.
    pub(crate) fn masses(&self) -> &[f32] {
        &self.mass
    }

    /// Moves every node: positions and velocities as
    /// [`positions`](Self::positions).
    ///
    /// # Panics
    /// If a slice is not three numbers a node long.
    pub fn write_nodes(&mut self, positions: &[f32], velocities: &[f32]) {
        self.positions.copy_from_slice(positions);
        self.velocities.copy_from_slice(velocities);
    }

    /// Moves every node to a place and stills it: x, y, z of each, metres. The edges keep
    /// their lengths, so it may come to lie a little beside it.
    pub fn place(&mut self, positions: impl Iterator<Item = f32>) {
        for (own, x) in self.positions.iter_mut().zip(positions) {
            *own = x;
        }
        self.sweep.run(&mut self.positions, &[]);
        self.velocities.fill(0.0);
    }

    /// Puts the nodes at `positions` (x, y, z of each, metres), where they were, and still.
    pub(crate) fn put_back(&mut self, positions: &[f32]) {
        self.positions.copy_from_slice(positions);
        self.velocities.fill(0.0);
    }

    /// Multiplies every velocity by `part`.
    pub fn slow(&mut self, part: f32) {
        for v in &mut self.velocities {
            *v *= part;
        }
    }

    /// Positions and masses of the nodes, with the loads to be set according to them.
    pub(crate) fn load_state(&mut self) -> (&[f32], &[f32], &mut [f32]) {
        (&self.positions, &self.mass, &mut self.loads)
    }

    /// Positions and velocities of the nodes, to be changed.
    pub(crate) fn states_mut(&mut self) -> [&mut [[f32; 3]]; 2] {
        [&mut self.positions, &mut self.velocities].map(|values| values.as_chunks_mut::<3>().0)
    }

    /// Positions, with the contacts to be set according to them.
    pub(crate) fn contact_state(&mut self) -> (&[f32], &mut [[Contact; CONTACTS]]) {
        (&self.positions, &mut self.contacts)
    }

    /// Forces on the nodes beside weight and air, N: x, y, z of each. They stay
    /// until changed.
    pub fn loads_mut(&mut self) -> &mut [f32] {
        &mut self.loads
    }

    /// What each node must not pass through, to be set before a step. It stays
    /// until changed.
    pub fn contacts_mut(&mut self) -> &mut [[Contact; CONTACTS]] {
        &mut self.contacts
    }
}
