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

use crate::grid::Grid;

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

/// How far a mass is from its rest before it counts as moved, and how much the
/// distances of one group differ, over the spacing of the masses.
const LITERAL_TOLERANCE: f32 = 0.01;

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

/// The least-squares projection onto piecewise-linear functions of distance.
#[derive(Clone, Debug)]
pub(crate) struct Projection {
    /// Lanes of the free nodes.
    lanes: Vec<usize>,
    /// For each node its knot below and the share of the knot above.
    place: Vec<(usize, f32)>,
    /// Value at each knot from the displacements: `[knot][node]`.
    fit: Vec<f32>,
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
            Self::Literal => synchronise_literally(grid, rest, position),
        }
    }
}

/// Moves every mass by the mean displacement of those at its distance from the
/// dog-ear line; none where no mass of the free edges has moved.
fn synchronise_literally(grid: &Grid, rest: &[Vec<f32>; 3], position: &mut [Vec<f32>; 3]) {
    let tolerance = LITERAL_TOLERANCE * grid.du().min(grid.dv());
    let Some([from, to]) = dog_ear_line(grid, rest, position, tolerance) else {
        return;
    };
    let place = |lane: usize| [rest[0][lane], rest[1][lane]];
    let [[x0, y0], [x1, y1]] = [place(from), place(to)];
    let (dx, dy) = (x1 - x0, y1 - y0);
    let length = (dx * dx + dy * dy).sqrt();
    let mut masses: Vec<(f32, usize)> = grid
        .node_lanes()
        .map(|lane| {
            let [x, y] = place(lane);
            ((dx * (y - y0) - dy * (x - x0)) / length, lane)
        })
        .collect();
    masses.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    for group in masses.chunk_by(|a, b| b.0 - a.0 < tolerance) {
        for axis in 0..3 {
            let (rest, position) = (&rest[axis], &mut position[axis]);
            let sum = group
                .iter()
                .fold(0.0, |sum, &(_, lane)| sum + (position[lane] - rest[lane]));
            let mean = sum / group.len() as f32;
            for &(_, lane) in group {
                position[lane] = rest[lane] + mean;
            }
        }
    }
}

/// The end points of the dog-ear line, if a mass of the free edges has moved.
fn dog_ear_line(
    grid: &Grid,
    rest: &[Vec<f32>; 3],
    position: &[Vec<f32>; 3],
    tolerance: f32,
) -> Option<[usize; 2]> {
    let foot = (0..grid.columns).map(|column| (column, 0));
    let fore_edge = (1..grid.rows - 1).map(|row| (grid.columns - 1, row));
    let head = (0..grid.columns)
        .rev()
        .map(|column| (column, grid.rows - 1));
    let way: Vec<usize> = foot
        .chain(fore_edge)
        .chain(head)
        .map(|(column, row)| grid.lane(column, row))
        .collect();
    let has_moved = |&lane: &usize| {
        let square = |axis: usize| {
            let d = position[axis][lane] - rest[axis][lane];
            d * d
        };
        square(0) + square(1) + square(2) > tolerance * tolerance
    };
    let first = way.iter().position(has_moved)?;
    let last = way.iter().rposition(has_moved)?;
    let [from, to] = [first.saturating_sub(1), (last + 1).min(way.len() - 1)];
    Some([way[from], way[to]])
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

impl Projection {
    fn new(angle: f32, grid: &Grid, free: &[f32]) -> Self {
        let (sin, cos) = libm::sincos(f64::from(angle));
        let distance = |column: usize, row: usize| {
            column as f64 * f64::from(grid.du()) * cos + row as f64 * f64::from(grid.dv()) * sin
        };
        let nodes: Vec<(usize, f64)> = (0..grid.rows)
            .flat_map(|row| (0..grid.columns).map(move |column| (column, row)))
            .map(|(column, row)| (grid.lane(column, row), distance(column, row)))
            .filter(|&(lane, _)| free[lane] > 0.0)
            .collect();
        let low = nodes.iter().map(|n| n.1).fold(f64::INFINITY, f64::min);
        let high = nodes.iter().map(|n| n.1).fold(f64::NEG_INFINITY, f64::max);
        let spacing = f64::from(grid.du()) * cos * cos + f64::from(grid.dv()) * sin * sin;
        if nodes.is_empty() {
            return Self {
                lanes: vec![],
                place: vec![],
                fit: vec![],
            };
        }
        // A span that is a whole number of spacings, but for rounding, stays one.
        let intervals = ((high - low) / spacing - 1e-6).ceil().max(1.0) as usize;
        let scale = if high > low {
            intervals as f64 / (high - low)
        } else {
            0.0
        };
        let place: Vec<(usize, f64)> = nodes
            .iter()
            .map(|&(_, distance)| {
                let along = (distance - low) * scale;
                let knot = (along.floor() as usize).min(intervals - 1);
                (knot, along - knot as f64)
            })
            .collect();
        Self {
            lanes: nodes.iter().map(|n| n.0).collect(),
            fit: least_squares(&place, intervals + 1),
            place: place
                .iter()
                .map(|&(knot, part)| (knot, part as f32))
                .collect(),
        }
    }

    fn apply(&self, rest: &[f32], position: &mut [f32]) {
        let count = self.lanes.len();
        if count == 0 {
            return;
        }
        // Knots are evaluated two at a time as the nodes need them, in a small
        // array: at most the nodes' own number of knots.
        let mut knots = [0.0f32; MOST_KNOTS];
        for (knot, fit) in knots.iter_mut().zip(self.fit.chunks_exact(count)) {
            *knot = self
                .lanes
                .iter()
                .zip(fit)
                .fold(0.0, |sum, (&lane, weight)| {
                    sum + weight * (position[lane] - rest[lane])
                });
        }
        for (&lane, &(knot, part)) in self.lanes.iter().zip(&self.place) {
            let (near, far) = (knots[knot], knots[knot + 1]);
            position[lane] = rest[lane] + (near + part * (far - near));
        }
    }
}

/// More knots than any grid of 16 x 16 nodes has along any direction, unless
/// its cells are extremely narrow.
const MOST_KNOTS: usize = 64;

/// For each knot the weights of the nodes' values in the least-squares fit of a
/// piecewise-linear function: (B^T B)^-1 B^T, by Gauss-Jordan in f64. A hair of
/// ridge keeps a knot that no node determines from being singular.
fn least_squares(place: &[(usize, f64)], knots: usize) -> Vec<f32> {
    assert!(
        knots <= MOST_KNOTS,
        "the cells are too narrow for a dog-ear line"
    );
    let count = place.len();
    let width = knots + count;
    let mut m = vec![0.0f64; knots * width];
    for (node, &(knot, part)) in place.iter().enumerate() {
        let hats = [(knot, 1.0 - part), (knot + 1, part)];
        for (i, a) in hats {
            for (j, b) in hats {
                m[i * width + j] += a * b;
            }
            m[i * width + knots + node] += a;
        }
    }
    for i in 0..knots {
        m[i * width + i] += 1e-12;
    }
    for pivot in 0..knots {
        let inverse = 1.0 / m[pivot * width + pivot];
        for j in 0..width {
            m[pivot * width + j] *= inverse;
        }
        for i in (0..knots).filter(|&i| i != pivot) {
            let factor = m[i * width + pivot];
            for j in 0..width {
                m[i * width + j] -= factor * m[pivot * width + j];
            }
        }
    }
    (0..knots)
        .flat_map(|i| m[i * width + knots..(i + 1) * width].to_vec())
        .map(|weight| weight as f32)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Side;
    use crate::random::{Random, for_seeds};

    /// A grid, which of its nodes are free, its rest and a random shape of it.
    type Scene = (Grid, Vec<f32>, [Vec<f32>; 3], [Vec<f32>; 3]);

    fn scene(random: &mut Random) -> Scene {
        let (columns, rows) = (3 + random.below(8), 3 + random.below(8));
        let (width, height) = (random.between(1.0, 30.0), random.between(1.0, 30.0));
        let grid = Grid::new(columns, rows, width, height);
        let rest = grid.rest(Side::Left);
        let (mut free, mut position) = (grid.zeros(), rest.clone());
        for lane in grid.node_lanes() {
            let held = lane % grid.stride == 0 || random.below(5) == 0;
            free[lane] = if held { 0.0 } else { 1.0 };
            for axis in &mut position {
                axis[lane] += random.between(-1.0, 1.0);
            }
        }
        (grid, free, rest, position)
    }

    fn apply(kind: Synchronise, scene: &Scene) -> [Vec<f32>; 3] {
        let (grid, free, rest, position) = scene;
        let mut result = position.clone();
        Synchroniser::new(kind, grid, free).apply(grid, free, rest, &mut result);
        result
    }

    const KINDS: [Synchronise; 5] = [
        Synchronise::Columns,
        Synchronise::DogEar { angle: 0.0 },
        Synchronise::DogEar {
            angle: core::f32::consts::FRAC_PI_2,
        },
        Synchronise::DogEar {
            angle: core::f32::consts::FRAC_PI_4,
        },
        Synchronise::DogEar { angle: 0.37 },
    ];

    #[test]
    fn the_mean_displacement_stays() {
        for_seeds(|random| {
            let scene = scene(random);
            for kind in KINDS {
                let after = apply(kind, &scene);
                let (grid, free, _, before) = &scene;
                for axis in 0..3 {
                    let sum = |axes: &[Vec<f32>; 3]| {
                        let lanes = grid.node_lanes().filter(|&lane| free[lane] > 0.0);
                        lanes.map(|lane| f64::from(axes[axis][lane])).sum::<f64>()
                    };
                    assert!((sum(&after) - sum(before)).abs() < 1e-3, "{kind:?}");
                }
            }
        });
    }

    #[test]
    fn fixed_and_held_masses_stay_where_they_are() {
        for_seeds(|random| {
            let scene = scene(random);
            for kind in KINDS {
                let after = apply(kind, &scene);
                let (grid, free, _, before) = &scene;
                for lane in grid.node_lanes().filter(|&lane| free[lane] == 0.0) {
                    for axis in 0..3 {
                        assert_eq!(after[axis][lane], before[axis][lane], "{kind:?}");
                    }
                }
            }
        });
    }

    #[test]
    fn masses_on_a_line_parallel_to_the_dog_ear_line_move_alike() {
        for_seeds(|random| {
            let scene = scene(random);
            for kind in KINDS {
                let angle = match kind {
                    Synchronise::DogEar { angle } => angle,
                    _ => 0.0,
                };
                let after = apply(kind, &scene);
                let (grid, free, rest, _) = &scene;
                let lanes: Vec<usize> =
                    grid.node_lanes().filter(|&lane| free[lane] > 0.0).collect();
                let distance =
                    |lane: usize| -rest[0][lane] * angle.cos() + rest[1][lane] * angle.sin();
                for &a in &lanes {
                    for &b in lanes
                        .iter()
                        .filter(|&&b| (distance(a) - distance(b)).abs() < 1e-5)
                    {
                        for axis in 0..3 {
                            let moved = |lane: usize| after[axis][lane] - rest[axis][lane];
                            assert!((moved(a) - moved(b)).abs() < 2e-5, "{kind:?}");
                        }
                    }
                }
            }
        });
    }

    /// Displacements of all masses.
    fn displacements(scene: &Scene, after: &[Vec<f32>; 3]) -> Vec<(usize, [f32; 3])> {
        let (grid, _, rest, _) = scene;
        let moved = |lane: usize| [0, 1, 2].map(|axis| after[axis][lane] - rest[axis][lane]);
        grid.node_lanes().map(|lane| (lane, moved(lane))).collect()
    }

    /// A flat leaf, some masses of which are lifted by 1.
    fn lifted(lift: impl Fn(usize, usize) -> bool) -> Scene {
        let grid = Grid::new(6, 6, 25.0, 25.0);
        let rest = grid.rest(Side::Left);
        let mut position = rest.clone();
        for row in 0..6 {
            for column in (0..6).filter(|&column| lift(column, row)) {
                position[2][grid.lane(column, row)] += 1.0;
            }
        }
        let free = grid.zeros();
        (grid, free, rest, position)
    }

    #[test]
    fn the_literal_reading_moves_fixed_and_held_masses_with_their_group() {
        // The foot corner alone: the line runs from its neighbour on the foot to that
        // on the fore-edge, and the diagonal beside it has two masses, both lying.
        let scene = lifted(|column, row| (column, row) == (5, 0));
        for (lane, moved) in displacements(&scene, &apply(Synchronise::Literal, &scene)) {
            let expected = if lane == scene.0.lane(5, 0) { 1.0 } else { 0.0 };
            assert!((moved[2] - expected).abs() < 1e-6, "{lane}: {moved:?}");
        }
        // The foot and the corner's column: a line from (0, 0) to (5, 5), whose
        // parallels hold masses of the spine and of the fore-edge. None is free.
        let scene = lifted(|column, row| (row == 0 && column > 0) || (column == 5 && row < 5));
        let after = displacements(&scene, &apply(Synchronise::Literal, &scene));
        for (lane, moved) in after {
            let (column, row) = (lane % scene.0.stride, lane / scene.0.stride);
            // Of the masses of a diagonal below the line both ends are lifted.
            let count = 6.0 - column as f32 + row as f32;
            let lifted = if column == row + 5 { 1.0 } else { 2.0 };
            let expected = if column > row { lifted / count } else { 0.0 };
            assert!(
                (moved[2] - expected).abs() < 1e-6,
                "{column} {row}: {moved:?}"
            );
        }
    }

    #[test]
    fn the_literal_reading_is_the_columns_where_whole_columns_are_moved() {
        for_seeds(|random| {
            let first = 1 + random.below(5);
            let mut scene = lifted(|column, _| column >= first);
            let (grid, free, _, position) = &mut scene;
            for lane in grid.node_lanes() {
                free[lane] = 1.0;
                if lane % grid.stride >= first {
                    position[0][lane] += random.between(-0.3, 0.3);
                }
            }
            let literal = apply(Synchronise::Literal, &scene);
            let columns = apply(Synchronise::Columns, &scene);
            for axis in 0..3 {
                for lane in scene.0.node_lanes() {
                    assert!((literal[axis][lane] - columns[axis][lane]).abs() < 2e-5);
                }
            }
        });
    }

    #[test]
    fn the_literal_reading_leaves_a_leaf_at_rest_alone_and_keeps_the_mean() {
        let scene = lifted(|_, _| false);
        assert_eq!(apply(Synchronise::Literal, &scene), scene.3);
        for_seeds(|random| {
            let scene = self::scene(random);
            let after = apply(Synchronise::Literal, &scene);
            for axis in 0..3 {
                let sum = |axes: &[Vec<f32>; 3]| {
                    let lanes = scene.0.node_lanes();
                    lanes.map(|lane| f64::from(axes[axis][lane])).sum::<f64>()
                };
                assert!((sum(&after) - sum(&scene.3)).abs() < 1e-3);
            }
        });
    }

    #[test]
    fn twice_is_once() {
        for_seeds(|random| {
            let (grid, free, rest, position) = scene(random);
            for kind in KINDS {
                let once = apply(kind, &(grid, free.clone(), rest.clone(), position.clone()));
                let twice = apply(kind, &(grid, free.clone(), rest.clone(), once.clone()));
                for axis in 0..3 {
                    for lane in grid.node_lanes() {
                        assert!(
                            (once[axis][lane] - twice[axis][lane]).abs() < 2e-5,
                            "{kind:?}"
                        );
                    }
                }
            }
        });
    }

    #[test]
    fn a_line_along_the_grid_takes_the_means_of_its_groups() {
        for_seeds(|random| {
            let scene = scene(random);
            let exact = apply(Synchronise::Columns, &scene);
            let projected = apply(Synchronise::DogEar { angle: 0.0 }, &scene);
            for lane in scene.0.node_lanes() {
                for axis in 0..3 {
                    assert!((exact[axis][lane] - projected[axis][lane]).abs() < 2e-5);
                }
            }
        });
    }

    #[test]
    fn a_leaf_rolled_about_the_dog_ear_line_is_left_alone() {
        let grid = Grid::new(6, 6, 25.0, 25.0);
        let rest = grid.rest(Side::Right);
        let mut free = grid.zeros();
        grid.node_lanes().for_each(|lane| free[lane] = 1.0);
        let mut rolled = rest.clone();
        let angle = core::f32::consts::FRAC_PI_4;
        for lane in grid.node_lanes() {
            // Distance from the line in whole steps: rolled by a kinked function.
            let steps = (rest[0][lane] + rest[1][lane]) / 5.0;
            rolled[2][lane] =
                [0.0, 0.1, 0.3, 0.2, 0.7, 1.1, 0.9, 2.0, 1.0, 0.0, 3.0][steps.round() as usize];
        }
        let after = apply(
            Synchronise::DogEar { angle },
            &(grid, free, rest, rolled.clone()),
        );
        let error = grid
            .node_lanes()
            .map(|lane| (after[2][lane] - rolled[2][lane]).abs())
            .fold(0.0, f32::max);
        // The knots are a cell apart, the lines 0.7 of one: near, not equal.
        assert!(error < 0.6, "{error}");
    }
}
