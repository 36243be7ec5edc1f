//! Quadratic drag of the air across the sheet.

use super::settings::Settings;
use crate::grid::Grid;

/// Slows each node's motion along the sheet's normal, as air does: force
/// -c A |w| w along the normal, w being the normal part of the velocity against
/// the air. Taken implicitly, so that it can stop a node and never turn it back.
#[derive(Clone, Debug)]
pub(crate) struct Air {
    /// c A / m of each node, one over metres; 0 for padding.
    coefficient: Vec<f32>,
    wind: [f32; 3],
}

impl Air {
    /// Air for a leaf with the given areas and masses, or nothing when there is
    /// no drag.
    pub fn new(settings: &Settings, grid: &Grid, inverse_mass: &[f32]) -> Option<Self> {
        if settings.air_drag == 0.0 {
            return None;
        }
        let cell = grid.du() * grid.dv();
        let mut coefficient = grid.zeros();
        for row in 0..grid.rows {
            for column in 0..grid.columns {
                let lane = grid.lane(column, row);
                let area = cell * grid.area_fraction(column, row);
                coefficient[lane] = settings.air_drag * area * inverse_mass[lane];
            }
        }
        Some(Self {
            coefficient,
            wind: settings.wind,
        })
    }

    /// Applies drag over a time `h` to the free nodes' velocities.
    pub fn apply(
        &self,
        grid: &Grid,
        h: f32,
        free: &[f32],
        position: &[Vec<f32>; 3],
        velocity: &mut [Vec<f32>; 3],
    ) {
        for row in 0..grid.rows {
            let (below, above) = (row.saturating_sub(1), (row + 1).min(grid.rows - 1));
            for column in 0..grid.columns {
                let lane = grid.lane(column, row);
                if free[lane] == 0.0 {
                    continue;
                }
                let (left, right) = (column.saturating_sub(1), (column + 1).min(grid.columns - 1));
                let across = |axis: usize| {
                    position[axis][grid.lane(right, row)] - position[axis][grid.lane(left, row)]
                };
                let along = |axis: usize| {
                    position[axis][grid.lane(column, above)]
                        - position[axis][grid.lane(column, below)]
                };
                let (a, b) = ([0, 1, 2].map(across), [0, 1, 2].map(along));
                let n = [
                    a[1] * b[2] - a[2] * b[1],
                    a[2] * b[0] - a[0] * b[2],
                    a[0] * b[1] - a[1] * b[0],
                ];
                let square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
                if square <= 0.0 {
                    continue;
                }
                let w = [0, 1, 2].map(|axis| velocity[axis][lane] - self.wind[axis]);
                // Normal part of the velocity, times the length of n.
                let through = w[0] * n[0] + w[1] * n[1] + w[2] * n[2];
                let speed = through.abs() / square.sqrt();
                let slowing = self.coefficient[lane] * speed * h;
                let change = through / square * (slowing / (1.0 + slowing));
                for axis in 0..3 {
                    velocity[axis][lane] -= change * n[axis];
                }
            }
        }
    }
}
