//! The energies of a leaf.

use super::Shell;
use super::vector::dot;

/// Energies of a leaf, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energies {
    /// Of motion, with that of the air carried along.
    pub kinetic: f64,
    /// Of bending and twist.
    pub bending: f64,
    /// Of stretch and shear.
    pub membrane: f64,
    /// Of weight and constant loads; 0 at the origin.
    pub gravity: f64,
}

impl Energies {
    /// All together.
    pub fn total(&self) -> f64 {
        self.kinetic + self.bending + self.membrane + self.gravity
    }
}

impl Shell {
    /// Energies now.
    pub fn energy(&self) -> Energies {
        let normals = self.mesh.normals(&self.x);
        let kinetic = |node: usize| {
            let across = dot(self.v[node], normals[node]);
            let carried = self.settings.air.added_mass * self.areas[node] * across * across;
            0.5 * (self.forces.masses[node] * dot(self.v[node], self.v[node]) + carried)
        };
        Energies {
            kinetic: (0..self.mesh.nodes()).map(kinetic).sum(),
            bending: self.forces.bending.energy(&self.x, &self.forces.clamps),
            membrane: self.forces.membrane.energy(&self.x),
            gravity: self.forces.of_weight(&self.x),
        }
    }
}
