//! All forces on all nodes: weight, drag, springs, bending.

use super::plate::Bending;
use super::springs::SpringSystem;

/// Forces of one leaf.
#[derive(Clone, Debug)]
pub(crate) struct Forces {
    /// The springs between nodes.
    pub springs: SpringSystem,
    /// The plate's bending; None where it has no stiffness.
    pub bending: Option<Bending>,
    /// Weight of each node, newtons downward; 0 for padding.
    pub weight: Vec<f32>,
    /// Drag in newtons per metre a second.
    pub drag: f32,
    /// Velocity of the air, m/s.
    pub wind: [f32; 3],
}

impl Forces {
    /// Computes the force on each node; on padding lanes the result means
    /// nothing, and is finite.
    pub fn compute(
        &mut self,
        position: &[Vec<f32>; 3],
        velocity: &[Vec<f32>; 3],
        force: &mut [Vec<f32>; 3],
    ) {
        for axis in 0..3 {
            let wind = self.wind[axis];
            let (force, velocity) = (&mut force[axis], &velocity[axis]);
            if axis == 2 {
                for ((f, v), weight) in force.iter_mut().zip(velocity).zip(&self.weight) {
                    *f = -self.drag * (v - wind) - weight;
                }
            } else {
                for (f, v) in force.iter_mut().zip(velocity) {
                    *f = -self.drag * (v - wind);
                }
            }
        }
        self.springs.add_forces(position, velocity, force);
        if let Some(bending) = &mut self.bending {
            bending.add_forces(position, velocity, force);
        }
    }
}
