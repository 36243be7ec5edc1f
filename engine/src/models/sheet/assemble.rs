//! Forces and matrix of a step, at the sheet's present state.

use super::contact::add_contact;
use super::settings::CAN_TEAR;
use super::{PIN, Sheet};
use crate::vector::dot;

impl Sheet {
    /// Finds the nodes' normals, along which the air acts.
    pub(super) fn update_normals(&mut self) {
        let (columns, rows) = (self.settings.columns, self.settings.rows);
        let x = self.positions.as_chunks::<3>().0;
        for row in 0..rows {
            let run = self.material.run_of(row);
            for column in 0..columns {
                let node = row * columns + column;
                let (left, right) = (
                    node - usize::from(column > 0),
                    node + usize::from(column + 1 < columns),
                );
                let (below, above) = (
                    node - if row > run.start { columns } else { 0 },
                    node + if row + 1 < run.end { columns } else { 0 },
                );
                let u: [f32; 3] = core::array::from_fn(|axis| x[right][axis] - x[left][axis]);
                let v: [f32; 3] = core::array::from_fn(|axis| x[above][axis] - x[below][axis]);
                let n = [
                    u[1] * v[2] - u[2] * v[1],
                    u[2] * v[0] - u[0] * v[2],
                    u[0] * v[1] - u[1] * v[0],
                ];
                let inverse = 1.0 / (dot(n, n).sqrt() + 1e-12);
                self.normals[node] = n.map(|n| n * inverse);
            }
        }
    }

    /// Assembles forces and matrix at the present state.
    ///
    /// Of implicit Euler's damping of bending, which is that of paper whose damping
    /// time is a step, only the paper's own is left: bending acts not at the end x of
    /// the step but at x less the `lag` times the velocity before it. Where k is the
    /// square of a mode's angle in a step and b the lag over the step, the mode keeps
    /// (1 + b k) / (1 + k) of the square of its swing a step: slow ones what paper
    /// keeps, quick ones b. It is stable at any step.
    pub(super) fn assemble(&mut self) {
        self.look_back();
        self.system.forces.copy_from_slice(&self.weight);
        let forces = &mut self.system.forces;
        for (force, load) in forces.iter_mut().zip(&self.loads) {
            *force += load;
        }
        let (then, tangents) = (&self.lagging, &self.lagging_tangents);
        match self.creased.as_mut() {
            Some(creased) => {
                let hinges = &mut creased.hinges;
                let square = self.h * self.h;
                let inertia = self.mass.iter().map(|mass| mass / square);
                hinges.add_to(then, tangents, self.stiffer, inertia, &mut self.system);
            }
            _ => {
                self.system.matrix.copy_from(&self.constant);
                self.bending.subtract_forces(then, tangents, forces);
            }
        }
        self.membrane.add_to(&self.positions, &mut self.system);
        self.add_inertia_and_air();
        for grab in &mut self.grabs {
            grab.add_to(&mut self.system, &self.positions);
        }
        self.add_bounds();
    }

    /// Finds where nodes and clamp were the lag ago, going as they do now.
    fn look_back(&mut self) {
        let (lag, part) = (self.lag, self.lag / self.h);
        let states = self.positions.iter().zip(&self.velocities);
        for (to, (x, v)) in self.lagging.iter_mut().zip(states) {
            *to = x - lag * v;
        }
        let states = self.tangents.iter().zip(&self.last_tangents);
        for (to, (now, last)) in self.lagging_tangents.iter_mut().zip(states) {
            *to = now - part * (now - last);
        }
    }

    /// Adds what each node's velocity does: inertia, the air it carries and
    /// the drag, both along its normal, which lags by a step.
    fn add_inertia_and_air(&mut self) {
        let settings = &self.settings;
        let (h, wind) = (self.h, settings.air.wind.map(|w| w as f32));
        let drag =
            (0.5 * settings.air.density * settings.air.drag / settings.stock.grammage) as f32;
        let v = self.velocities.as_chunks::<3>().0;
        for node in 0..self.mass.len() {
            if !self.system.moves(node) {
                continue;
            }
            let (n, v, mass) = (self.normals[node], v[node], self.mass[node]);
            let (along, blowing) = (dot(n, v), dot(n, wind));
            let carried = self.air_mass[node] / h;
            let resistance = drag * self.drag_mass[node] * (along - blowing).abs();
            let push = carried * along + resistance * blowing;
            let inertia = mass / h;
            self.system.push(
                node,
                core::array::from_fn(|axis| inertia * v[axis] + push * n[axis]),
            );
            let k = (carried + resistance) / h;
            self.system.add_product(node, node, n.map(|n| k * n), n);
        }
    }

    /// Adds contacts, pins, tethers and ties.
    fn add_bounds(&mut self) {
        let gravity = self.settings.gravity.map(|g| g as f32);
        let x = self.positions.as_chunks::<3>().0;
        let v = self.velocities.as_chunks::<3>().0;
        for node in 0..self.mass.len() {
            if !self.system.moves(node) {
                continue;
            }
            for contact in &self.contacts[node] {
                if contact.normal != [0.0; 3] {
                    let state = [x[node], v[node], gravity];
                    add_contact(
                        &mut self.system,
                        node,
                        contact,
                        state,
                        self.mass[node],
                        self.h,
                    );
                }
            }
            if let Some(place) = self.pins[node] {
                let pull = core::array::from_fn(|axis| PIN * (place[axis] - x[node][axis]));
                self.system.push(node, pull);
                self.system.add_diagonal(node, PIN);
            }
        }
        if CAN_TEAR {
            for tether in &self.tethers {
                tether.add_to(&mut self.system, &self.positions);
            }
            for tie in &self.ties {
                tie.add_to(&mut self.system, &self.positions);
            }
        }
    }
}
