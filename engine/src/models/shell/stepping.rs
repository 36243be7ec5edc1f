//! Steps in time: each scheme as one or a few stages.

use super::forces::Forces;
use super::motion::Stage;
use super::newton::minimise;
use super::vector::{Vector, advance, difference, furthest, scale};
use super::{Scheme, Shell};

/// Most rounds for the middle of a step.
const MIDDLE_ROUNDS: usize = 30;

/// Most Newton steps of a time step.
const NEWTON_STEPS: usize = 100;

impl Shell {
    /// Moves on by one time step.
    pub(super) fn advance(&mut self) {
        let h = self.settings.time_step;
        match (self.settings.scheme, self.before.take()) {
            (Scheme::ImplicitMidpoint, _) => {
                let (x, v) = (self.x.clone(), self.v.clone());
                self.solve_middle(0.5 * h, &x, &v);
                for node in 0..x.len() {
                    if !self.system.held[node] {
                        self.x[node] = advance(scale(2.0, self.x[node]), -1.0, x[node]);
                    }
                    self.v[node] = advance(scale(2.0, self.v[node]), -1.0, v[node]);
                }
            }
            (Scheme::Bdf2, Some((x, v))) => {
                let recent = (self.x.clone(), self.v.clone());
                let (from, coasting) = (ahead(&self.x, &x), ahead(&self.v, &v));
                self.solve_stage(2.0 / 3.0 * h, from, coasting);
                self.before = Some(recent);
            }
            (scheme, _) => {
                let recent = (self.x.clone(), self.v.clone());
                self.solve_stage(h, recent.0.clone(), recent.1.clone());
                self.before = (scheme == Scheme::Bdf2).then_some(recent);
            }
        }
        self.stay_down();
        let Forces {
            bending, clamps, ..
        } = &mut self.forces;
        bending.let_creases_follow(&self.x, clamps, h);
    }

    /// Takes the speed across the table from nodes that touch it: paper that slaps down
    /// stays there. What the formulas remember of the fall would else throw it up again,
    /// by half of the speed at which it came.
    fn stay_down(&mut self) {
        for node in 0..self.x.len() {
            if self.forces.table_force(node, &self.x) > 0.0 {
                self.v[node][2] = 0.0;
                if let Some((x, v)) = &mut self.before {
                    x[node][2] = self.x[node][2];
                    v[node][2] = 0.0;
                }
            }
        }
    }

    /// Solves for the middle of a step from `x` and `v`. The mean of the strains
    /// at its ends depends on the middle: it is taken from the last solution,
    /// again until that stays. Each round brings it nearer by the angle that the
    /// leaf turns in the step.
    fn solve_middle(&mut self, half: f64, x: &[Vector], v: &[Vector]) {
        for _ in 0..MIDDLE_ROUNDS {
            let last = self.x.clone();
            self.solve_stage(half, x.to_vec(), v.to_vec());
            if furthest(&self.x, &last) < self.settings.tolerance {
                break;
            }
            let ways = self.x.iter().zip(x);
            let ways: Vec<Vector> = ways.map(|(x, start)| difference(*x, *start)).collect();
            self.forces.membrane.swing(&ways);
        }
        self.forces.membrane.swing(&vec![[0.0; 3]; x.len()]);
    }

    /// Solves for the places `x` whose velocity is (x - from) / span and whose
    /// acceleration is (velocity - `coasting`) / span.
    fn solve_stage(&mut self, span: f64, from: Vec<Vector>, coasting: Vec<Vector>) {
        if let Some(hand) = &mut self.forces.hand {
            hand.follow(&self.mesh, &self.x);
        }
        let friction = self.settings.table.map_or(0.0, |table| table.friction);
        let ratio = self.settings.damping_time() / span;
        if ratio > 0.0 {
            self.forces.bending.damp(ratio, &from, &self.forces.clamps);
        }
        let aims = from.iter().zip(&coasting);
        let stage = Stage {
            span,
            aim: aims.map(|(x, v)| advance(*x, span, *v)).collect(),
            from,
            air: self.settings.air,
            areas: &self.areas,
            normals: self.mesh.normals(&self.x),
            friction: (0..self.x.len())
                .map(|node| friction * self.forces.table_force(node, &self.x))
                .collect(),
            forces: &self.forces,
        };
        let tolerance = self.settings.tolerance;
        let solved = minimise(
            &stage,
            &mut self.x,
            &mut self.system,
            tolerance,
            NEWTON_STEPS,
        );
        self.unsolved += u64::from(!solved);
        for (v, (x, from)) in self.v.iter_mut().zip(self.x.iter().zip(&stage.from)) {
            *v = scale(1.0 / span, difference(*x, *from));
        }
        if ratio > 0.0 {
            self.forces.bending.damp(0.0, &self.x, &self.forces.clamps);
        }
    }
}

/// 4/3 of the new less 1/3 of the old, from which the second-order formula goes on.
fn ahead(new: &[Vector], old: &[Vector]) -> Vec<Vector> {
    let pairs = new.iter().zip(old);
    pairs
        .map(|(new, old)| advance(scale(4.0 / 3.0, *new), -1.0 / 3.0, *old))
        .collect()
}
