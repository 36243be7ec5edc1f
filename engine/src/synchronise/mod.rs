//! Synchronisation, the paper's first improvement (Shangguan and Zeng 2014,
//! section 2.2.1): lines parallel to the dog-ear line stay parallel, as on a
//! rolled tube of paper.
//!
//! Masses are grouped by the distance of their rest position from the dog-ear
//! line, and within a group every displacement from rest is replaced by the
//! group's mean. Masses that are fixed or held are left out of the mean and
//! never moved; velocities are kept. On a grid only lines along it give groups
//! of several masses, so a line at another angle projects the displacements
//! onto piecewise-linear functions of the distance, by least squares; for lines
//! along the grid that is the same as the means.
//!
//! [`Synchronise::Literal`] is the paper's text word for word instead: it moves
//! fixed and held masses too, and takes the line from its end points.

mod literal;
mod projection;
#[cfg(test)]
mod tests;

use crate::grid::Grid;
use projection::Projection;

/// Which lines are kept parallel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Synchronise {
    /// None: the classic model.
    Off,
    /// Those parallel to the spine: groups are the columns.
    Columns,
    /// Those parallel to a dog-ear line that makes `angle` radians with the
    /// spine: 0 is parallel to the spine, pi/2 to the foot, and pi/4 runs from
    /// the fore-edge's lower part up toward the spine, as when the foot corner
    /// is lifted.
    DogEar {
        /// Angle with the spine in radians.
        angle: f32,
    },
    /// As the paper says it (section 3.1, step 6). The dog-ear line is taken anew
    /// at each step from its end points: on the way around the leaf from the
    /// spine's foot along the free edges to the spine's head, the last masses
    /// before the first and after the last that has moved. Masses at rest at the
    /// same distance from it are a group, and every mass of a group, fixed and held
    /// ones too, is moved by the mean of all their displacements. So the spine
    /// leaves its place where the line is not parallel to it.
    Literal,
}

/// Synchronisation made ready for one grid and one set of free nodes.
#[derive(Clone, Debug)]
pub(crate) enum Synchroniser {
    Off,
    Columns {
        /// For each lane of a row one over the number of free nodes of its column.
        inverse_count: Vec<f32>,
    },
    Projection(Projection),
    Literal,
}

impl Synchroniser {
    /// Prepares for a grid whose nodes are free where `free` is 1.
    pub fn new(kind: Synchronise, grid: &Grid, free: &[f32]) -> Self {
        match kind {
            Synchronise::Off => Self::Off,
            Synchronise::Columns => {
                let count = |lane: usize| {
                    (0..grid.rows)
                        .map(|row| free[row * grid.stride + lane])
                        .sum::<f32>()
                };
                let inverse = |count: f32| if count > 0.0 { 1.0 / count } else { 0.0 };
                Self::Columns {
                    inverse_count: (0..grid.stride).map(|lane| inverse(count(lane))).collect(),
                }
            }
            Synchronise::DogEar { angle } => Self::Projection(Projection::new(angle, grid, free)),
            Synchronise::Literal => Self::Literal,
        }
    }

    /// Synchronises the positions: those of the free nodes, or of all where the
    /// reading is literal.
    pub fn apply(
        &self,
        grid: &Grid,
        free: &[f32],
        rest: &[Vec<f32>; 3],
        position: &mut [Vec<f32>; 3],
    ) {
        match self {
            Self::Off => {}
            Self::Columns { inverse_count } => {
                for axis in 0..3 {
                    average_columns(
                        inverse_count,
                        grid.lanes(),
                        free,
                        &rest[axis],
                        &mut position[axis],
                    );
                }
            }
            Self::Projection(projection) => {
                for axis in 0..3 {
                    projection.apply(&rest[axis], &mut position[axis]);
                }
            }
            Self::Literal => literal::synchronise(grid, rest, position),
        }
    }
}

/// Means over each column's free nodes, eight columns at a time.
fn average_columns(
    inverse_count: &[f32],
    lanes: usize,
    free: &[f32],
    rest: &[f32],
    position: &mut [f32],
) {
    let stride = inverse_count.len();
    let (free, rest, position) = (&free[..lanes], &rest[..lanes], &mut position[..lanes]);
    for at in (0..stride).step_by(8) {
        let mut mean = [0.0f32; 8];
        for row in (at..lanes).step_by(stride) {
            let (free, rest, here) = (
                &free[row..row + 8],
                &rest[row..row + 8],
                &position[row..row + 8],
            );
            for i in 0..8 {
                mean[i] += free[i] * (here[i] - rest[i]);
            }
        }
        for i in 0..8 {
            mean[i] *= inverse_count[at + i];
        }
        for row in (at..lanes).step_by(stride) {
            let (free, rest, here) = (
                &free[row..row + 8],
                &rest[row..row + 8],
                &mut position[row..row + 8],
            );
            for i in 0..8 {
                here[i] = if free[i] > 0.0 {
                    rest[i] + mean[i]
                } else {
                    here[i]
                };
            }
        }
    }
}
