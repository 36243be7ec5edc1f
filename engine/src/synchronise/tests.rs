//! Every reading keeps what the paper says it keeps.

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
            let lanes: Vec<usize> = grid.node_lanes().filter(|&lane| free[lane] > 0.0).collect();
            let distance = |lane: usize| -rest[0][lane] * angle.cos() + rest[1][lane] * angle.sin();
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
