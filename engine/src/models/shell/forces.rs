//! All forces on a leaf that have a potential.

use super::bending::Bending;
use super::clamp::Clamps;
use super::membrane::Membrane;
use super::mesh::Mesh;
use super::newton::Potential;
use super::system::System;
use super::vector::{Vector, advance, along, difference, dot, length, scale};
use crate::grab::{self, Pressed};

/// Stiffness of the table: a node that lies on it sinks in by its weight over
/// `mass` times this, N/(kg m): 14 micrometres.
const TABLE: f64 = 200.0 * 60.0 * 60.0;

/// A hand that holds a leaf.
#[derive(Clone, Debug)]
pub(super) struct Hand {
    /// The nodes under it.
    pub pad: Vec<Pressed<f64>>,
    /// Where it pulls the middle of its pad, m.
    pub target: Vector,
    /// Its greatest force, N.
    pub strength: f64,
    /// Directions of u and v in the leaf under the pad.
    pub frame: [Vector; 2],
}

impl Hand {
    /// Turns the pad as the leaf lies under it.
    pub fn follow(&mut self, mesh: &Mesh, x: &[Vector]) {
        let mut sums = [[0.0; 3]; 2];
        for pressed in &self.pad {
            let (column, row) = (pressed.node % mesh.columns, pressed.node / mesh.columns);
            for (sum, tangent) in sums.iter_mut().zip(mesh.tangents(column, row, x)) {
                *sum = advance(*sum, pressed.weight, tangent);
            }
        }
        let u = scale(1.0 / length(sums[0]), sums[0]);
        let v = advance(sums[1], -dot(sums[1], u), u);
        self.frame = [u, scale(1.0 / length(v), v)];
    }

    /// From the place in the pad to the node that is drawn to it.
    fn away(&self, pressed: &Pressed<f64>, x: &[Vector]) -> Vector {
        let mut place = self.target;
        for (apart, direction) in pressed.apart.iter().zip(self.frame) {
            place = advance(place, *apart, direction);
        }
        difference(x[pressed.node], place)
    }

    fn value(&self, x: &[Vector]) -> f64 {
        let stiffness = grab::stiffness_for(self.strength);
        let of = |pressed: &Pressed<f64>| {
            let far = length(self.away(pressed, x));
            let reach = self.strength / stiffness;
            let energy = if far < reach {
                0.5 * stiffness * far * far
            } else {
                self.strength * (far - 0.5 * reach)
            };
            pressed.weight * energy
        };
        self.pad.iter().map(of).sum()
    }

    fn add_to(&self, x: &[Vector], system: &mut System) {
        let most = grab::stiffness_for(self.strength);
        for pressed in &self.pad {
            let away = self.away(pressed, x);
            let far = length(away);
            let stiffness = pressed.weight * grab::bounded_stiffness(most, far, self.strength);
            system.add_gradient(pressed.node, scale(stiffness, away));
            // Beyond its greatest force the spring does not stiffen along itself.
            let capped = most * far > self.strength;
            let radial = if capped {
                -stiffness / (far * far)
            } else {
                0.0
            };
            let block = along(stiffness, radial, away);
            system.add_block(pressed.node, pressed.node, block);
        }
    }
}

/// Elasticity, weight, loads, the table and the hand.
#[derive(Debug)]
pub(super) struct Forces {
    /// The edges that are held.
    pub clamps: Clamps,
    /// Mass of each node, kg.
    pub masses: Vec<f64>,
    /// Acceleration of gravity, m/s^2.
    pub gravity: Vector,
    /// A constant force on each node, N.
    pub loads: Vec<Vector>,
    /// Stretch and shear.
    pub membrane: Membrane,
    /// Bending, by the settings' discretisation.
    pub bending: Box<dyn Bending>,
    /// Whether there is a table at z = 0.
    pub table: bool,
    /// The hand that holds the leaf, if one does.
    pub hand: Option<Hand>,
}

impl Forces {
    /// Energy of weight and loads, 0 at the origin.
    pub fn of_weight(&self, x: &[Vector]) -> f64 {
        let of = |((x, &mass), load): ((&Vector, &f64), &Vector)| {
            -dot(advance(*load, mass, self.gravity), *x)
        };
        x.iter().zip(&self.masses).zip(&self.loads).map(of).sum()
    }

    /// Force of the table on a node, N.
    pub fn table_force(&self, node: usize, x: &[Vector]) -> f64 {
        let depth = -x[node][2];
        if self.table && depth > 0.0 {
            TABLE * self.masses[node] * depth
        } else {
            0.0
        }
    }
}

impl Potential for Forces {
    fn value(&self, x: &[Vector]) -> f64 {
        let table: f64 = (0..x.len())
            .map(|node| -0.5 * x[node][2] * self.table_force(node, x))
            .sum();
        let hand = self.hand.as_ref().map_or(0.0, |hand| hand.value(x));
        let elastic = self.membrane.energy(x) + self.bending.energy(x, &self.clamps);
        elastic + self.of_weight(x) + table + hand
    }

    fn add_to(&self, x: &[Vector], exact: bool, system: &mut System) {
        self.membrane.add_to(x, exact, system);
        self.bending.add_to(x, &self.clamps, exact, system);
        for node in 0..x.len() {
            let mut gradient = advance(self.loads[node], self.masses[node], self.gravity);
            gradient = scale(-1.0, gradient);
            let push = self.table_force(node, x);
            if push > 0.0 {
                gradient[2] -= push;
                let up = [0.0, 0.0, 1.0];
                let block = along(0.0, TABLE * self.masses[node], up);
                system.add_block(node, node, block);
            }
            system.add_gradient(node, gradient);
        }
        if let Some(hand) = &self.hand {
            hand.add_to(x, system);
        }
    }
}
