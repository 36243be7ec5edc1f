//! The three integrators, over flat arrays.

use super::forces::Forces;
use super::settings::Integrator;
use crate::grid::Grid;

/// Motion of all nodes, and the room that integrators need.
#[derive(Clone, Debug)]
pub(crate) struct Motion {
    /// x, y, z of the nodes, an array over the grid each, in the model's unit of length.
    pub position: [Vec<f32>; 3],
    /// Their velocities, likewise, a second.
    pub velocity: [Vec<f32>; 3],
    force: [Vec<f32>; 3],
    stage: Option<Box<Stage>>,
}

/// Intermediate states of the Runge-Kutta method.
#[derive(Clone, Debug)]
struct Stage {
    position: [Vec<f32>; 3],
    velocity: [Vec<f32>; 3],
    /// Weighted sums of the four slopes.
    slope_x: [Vec<f32>; 3],
    slope_v: [Vec<f32>; 3],
}

impl Motion {
    /// Nodes at rest at the given positions.
    pub fn new(grid: &Grid, position: [Vec<f32>; 3], integrator: Integrator) -> Self {
        let stage = (integrator == Integrator::RungeKutta4).then(|| {
            Box::new(Stage {
                position: grid.zeros3(),
                velocity: grid.zeros3(),
                slope_x: grid.zeros3(),
                slope_v: grid.zeros3(),
            })
        });
        Self {
            position,
            velocity: grid.zeros3(),
            force: grid.zeros3(),
            stage,
        }
    }

    /// Advances by `h` seconds; nodes of no inverse mass keep their velocity.
    pub fn advance(
        &mut self,
        integrator: Integrator,
        h: f32,
        forces: &mut Forces,
        inverse_mass: &[f32],
    ) {
        match integrator {
            Integrator::ExplicitEuler => {
                forces.compute(&self.position, &self.velocity, &mut self.force);
                for axis in 0..3 {
                    add_scaled(&mut self.position[axis], h, &self.velocity[axis]);
                    accelerate(&mut self.velocity[axis], h, &self.force[axis], inverse_mass);
                }
            }
            Integrator::SemiImplicitEuler => {
                forces.compute(&self.position, &self.velocity, &mut self.force);
                for axis in 0..3 {
                    accelerate(&mut self.velocity[axis], h, &self.force[axis], inverse_mass);
                    add_scaled(&mut self.position[axis], h, &self.velocity[axis]);
                }
            }
            Integrator::RungeKutta4 => self.runge_kutta(h, forces, inverse_mass),
        }
    }

    fn runge_kutta(&mut self, h: f32, forces: &mut Forces, inverse_mass: &[f32]) {
        let Some(stage) = &mut self.stage else { return };
        for axis in 0..3 {
            stage.position[axis].copy_from_slice(&self.position[axis]);
            stage.velocity[axis].copy_from_slice(&self.velocity[axis]);
            stage.slope_x[axis].fill(0.0);
            stage.slope_v[axis].fill(0.0);
        }
        // Share of each slope in the sum, and how far the next stage goes along it.
        let stages = [
            (1.0 / 6.0, 0.5),
            (1.0 / 3.0, 0.5),
            (1.0 / 3.0, 1.0),
            (1.0 / 6.0, 0.0),
        ];
        for (weight, ahead) in stages {
            forces.compute(&stage.position, &stage.velocity, &mut self.force);
            for axis in 0..3 {
                add_scaled(&mut stage.slope_x[axis], weight, &stage.velocity[axis]);
                accelerate(
                    &mut stage.slope_v[axis],
                    weight,
                    &self.force[axis],
                    inverse_mass,
                );
                for lane in 0..inverse_mass.len() {
                    let slope_x = stage.velocity[axis][lane];
                    let slope_v = self.force[axis][lane] * inverse_mass[lane];
                    stage.position[axis][lane] = self.position[axis][lane] + h * ahead * slope_x;
                    stage.velocity[axis][lane] = self.velocity[axis][lane] + h * ahead * slope_v;
                }
            }
        }
        for axis in 0..3 {
            add_scaled(&mut self.position[axis], h, &stage.slope_x[axis]);
            add_scaled(&mut self.velocity[axis], h, &stage.slope_v[axis]);
        }
    }
}

/// a += h b.
fn add_scaled(a: &mut [f32], h: f32, b: &[f32]) {
    for (a, b) in a.iter_mut().zip(b) {
        *a += h * b;
    }
}

/// v += h f / m.
fn accelerate(v: &mut [f32], h: f32, force: &[f32], inverse_mass: &[f32]) {
    for ((v, f), w) in v.iter_mut().zip(force).zip(inverse_mass) {
        *v += h * (f * w);
    }
}
