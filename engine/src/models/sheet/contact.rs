//! What a sheet must not pass through, as half-spaces.
//!
//! The sheet knows nothing of piles, boards or other leaves: the book that holds
//! it says for each node which planes bound it now. Contact is a stiff
//! spring inside the implicit solve, which settles a landing leaf without the
//! strain that moving nodes out afterwards would cost.

use super::system::System;
use crate::vector::dot;

/// Half-spaces a node, at most.
pub const CONTACTS: usize = 4;

/// A half-space that a node must stay in: the points x with
/// normal . x >= offset.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contact {
    /// Unit normal, pointing to where the node may be; zero where there is none.
    pub normal: [f32; 3],
    /// Metres.
    pub offset: f32,
    /// Velocity of what is touched, m/s; friction drags along it. Where the
    /// half-space will be at the end of the step is for `offset` to say.
    pub velocity: [f32; 3],
    /// Coefficient of friction.
    pub friction: f32,
    /// 1 for what does not give way; less for what will be pushed itself.
    pub firmness: f32,
}

/// Stiffness of contact in units of mass over the square of a frame at 60 Hz.
const STIFFNESS: f32 = 200.0 * 3600.0;

/// Speed below which friction yields rather than slips, m/s: Coulomb's law is
/// rounded off there, or it would chatter.
const SLIP: f32 = 0.004;

impl Contact {
    /// How far a point is inside what is touched, metres; 0 or below where it is not.
    pub fn depth(&self, point: [f32; 3]) -> f32 {
        self.offset - dot(self.normal, point)
    }
}

/// Adds a contact's force and stiffness to the system of a step of `h` seconds
/// for a node of `mass` kg at `x` that moves at `v` and falls by `gravity`.
///
/// A node that would be inside at the end of the step is already stopped: one
/// that was only pushed out once it is inside would leave again in the same
/// step, fall back in the next, and chatter.
pub(super) fn add_contact(
    system: &mut System,
    node: usize,
    contact: &Contact,
    [x, v, gravity]: [[f32; 3]; 3],
    mass: f32,
    h: f32,
) {
    let n = contact.normal;
    let depth = contact.depth(x);
    let falling: [f32; 3] = core::array::from_fn(|axis| v[axis] + h * gravity[axis]);
    let approach = -dot(n, falling);
    if depth + h * approach <= 0.0 {
        return;
    }
    let stiffness = STIFFNESS * contact.firmness * mass;
    system.push(node, n.map(|n| stiffness * depth * n));
    system.add_product(node, node, n.map(|n| stiffness * n), n);
    // What presses now, and what stops the node.
    let stopped = h * (-dot(n, v)).max(0.0) / (1.0 + STIFFNESS * contact.firmness * h * h);
    let pressure = stiffness * (depth.max(0.0) + stopped);
    if contact.friction <= 0.0 || pressure <= 0.0 {
        return;
    }
    let slip: [f32; 3] = core::array::from_fn(|axis| v[axis] - contact.velocity[axis]);
    let through = dot(n, slip);
    let along: [f32; 3] = core::array::from_fn(|axis| slip[axis] - through * n[axis]);
    let speed = dot(along, along).sqrt();
    let drag = contact.friction * pressure / (speed + SLIP);
    // -drag * (tangential part of the velocity at the end of the step).
    let carried = dot(n, contact.velocity);
    let of_obstacle: [f32; 3] =
        core::array::from_fn(|axis| drag * (contact.velocity[axis] - carried * n[axis]));
    system.push(node, of_obstacle);
    let k = drag / h;
    system.add_diagonal(node, k);
    system.add_product(node, node, n.map(|n| -k * n), n);
}
