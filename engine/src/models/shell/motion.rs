//! One step in time as the minimum of a potential: inertia, air and friction.
//!
//! Each scheme finds places x with velocity (x - from) / span at one instant, so
//! that inertia is half of mass times |x - aim|^2 / span^2, and a force -f(v) of
//! dissipation has the potential span F((x - from) / span) where F' = f (Ortiz
//! and Stainier 1999, "The variational formulation of viscoplastic constitutive
//! updates"). Normals and the table's pressure are those at the start.

use super::forces::Forces;
use super::newton::Potential;
use super::system::System;
use super::vector::{Vector, advance, along, difference, dot, length, scale};
use crate::air::Air;

/// Speed below which friction has not its full force, m/s.
const CREEP: f64 = 1e-3;

/// What a step minimises.
#[derive(Debug)]
pub(super) struct Stage<'a> {
    /// What acts on the leaf.
    pub forces: &'a Forces,
    /// Time over which a velocity is (x - from) / span, s.
    pub span: f64,
    /// Where the nodes are when it begins, m.
    pub from: Vec<Vector>,
    /// Where they would be when it ends if nothing but inertia acted, m.
    pub aim: Vec<Vector>,
    /// The air around the leaf.
    pub air: Air,
    /// Area of each node, m^2.
    pub areas: &'a [f64],
    /// Unit normal of each node when the stage begins.
    pub normals: Vec<Vector>,
    /// Friction of each node at full slip, N.
    pub friction: Vec<f64>,
}

impl Stage<'_> {
    fn wind_across(&self, node: usize, x: &[Vector]) -> f64 {
        let velocity = scale(1.0 / self.span, difference(x[node], self.from[node]));
        dot(difference(velocity, self.air.wind), self.normals[node])
    }

    fn drag(&self, node: usize) -> f64 {
        0.5 * self.air.density * self.air.drag * self.areas[node]
    }

    /// Velocity along the table.
    fn slip(&self, node: usize, x: &[Vector]) -> Vector {
        let moved = scale(1.0 / self.span, difference(x[node], self.from[node]));
        [moved[0], moved[1], 0.0]
    }

    fn value_at(&self, node: usize, x: &[Vector]) -> f64 {
        let apart = difference(x[node], self.aim[node]);
        let across = dot(apart, self.normals[node]);
        let own = self.forces.masses[node] * dot(apart, apart);
        let carried = self.air.added_mass * self.areas[node] * across * across;
        let inertia = (own + carried) / (2.0 * self.span * self.span);
        let wind = self.wind_across(node, x).abs();
        let drag = self.drag(node) * wind * wind * wind / 3.0;
        inertia + self.span * (drag + self.friction[node] * slip_length(self.slip(node, x)))
    }

    fn add_node(&self, node: usize, x: &[Vector], system: &mut System) {
        let normal = self.normals[node];
        let apart = difference(x[node], self.aim[node]);
        let inertia = 1.0 / (self.span * self.span);
        let own = inertia * self.forces.masses[node];
        let carried = inertia * self.air.added_mass * self.areas[node];
        let wind = self.wind_across(node, x);
        let drag = self.drag(node) * wind.abs();
        let across = carried * dot(apart, normal) + drag * wind;
        system.add_gradient(node, advance(scale(own, apart), across, normal));
        let stiffness = carried + 2.0 * drag / self.span;
        system.add_block(node, node, along(own, stiffness, normal));
        if self.friction[node] > 0.0 {
            self.add_friction(node, x, system);
        }
    }

    fn add_friction(&self, node: usize, x: &[Vector], system: &mut System) {
        let slip = self.slip(node, x);
        let speed = length(slip);
        let force = self.friction[node] / speed.max(CREEP);
        system.add_gradient(node, scale(force, slip));
        let stiffness = force / self.span;
        let turning = if speed > CREEP {
            -stiffness / (speed * speed)
        } else {
            0.0
        };
        let mut block = along(stiffness, turning, slip);
        block[2][2] = 0.0;
        system.add_block(node, node, block);
    }
}

/// Integral of the part of full friction over the slip: smooth at rest.
fn slip_length(slip: Vector) -> f64 {
    let speed = length(slip);
    if speed > CREEP {
        speed - 0.5 * CREEP
    } else {
        0.5 * speed * speed / CREEP
    }
}

impl Potential for Stage<'_> {
    fn value(&self, x: &[Vector]) -> f64 {
        let nodes: f64 = (0..x.len()).map(|node| self.value_at(node, x)).sum();
        self.forces.value(x) + nodes
    }

    fn add_to(&self, x: &[Vector], exact: bool, system: &mut System) {
        self.forces.add_to(x, exact, system);
        for node in 0..x.len() {
            self.add_node(node, x, system);
        }
    }
}
