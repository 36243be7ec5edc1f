//! Lagrange interpolation against polynomials and against the plain double sum.

use super::{Interpolation, lagrange_weights, lobatto_nodes, uniform_samples};
use crate::random::{Random, for_seeds};

fn random_samples(random: &mut Random) -> Vec<f32> {
    let mut samples = vec![0.0];
    for _ in 0..1 + random.below(40) {
        samples.push(samples[samples.len() - 1] + random.between(0.01, 1.0));
    }
    let last = samples[samples.len() - 1];
    samples.iter().map(|sample| sample / last).collect()
}

/// One array an axis, rows `stride` long.
fn random_nodes(random: &mut Random, rows: usize, stride: usize) -> [Vec<f32>; 3] {
    [(); 3].map(|()| {
        (0..rows * stride)
            .map(|_| random.between(-1.0, 1.0))
            .collect()
    })
}

fn apply(lagrange: &mut Interpolation, nodes: &[Vec<f32>; 3], stride: usize) -> Vec<f32> {
    let (columns, rows) = lagrange.samples();
    let mut points = vec![f32::NAN; 3 * columns * rows];
    lagrange.apply(nodes.each_ref().map(|axis| &axis[..]), stride, &mut points);
    points
}

#[test]
fn weights_sum_to_one_and_pick_their_node() {
    for nodes in 2..=8 {
        for sample in uniform_samples(101) {
            let sum: f32 = lagrange_weights(nodes, sample).iter().sum();
            assert!((sum - 1.0).abs() < 2e-5, "{nodes} {sample}: {sum}");
        }
        for (node, &at) in uniform_samples(nodes).iter().enumerate() {
            for (other, weight) in lagrange_weights(nodes, at).into_iter().enumerate() {
                let expected = if other == node { 1.0 } else { 0.0 };
                assert!((weight - expected).abs() < 1e-5);
            }
        }
    }
}

#[test]
fn polynomials_of_degree_five_are_exact_in_both_directions() {
    for_seeds(|random| {
        let mut coefficient = || [(); 6].map(|()| random.between(-1.0, 1.0));
        let (p, q) = (coefficient(), coefficient());
        let value = |c: &[f32; 6], t: f32| {
            c.iter()
                .rev()
                .fold(0.0f64, |sum, c| sum * f64::from(t) + f64::from(*c))
        };
        let (u, v) = (uniform_samples(26), uniform_samples(26));
        let at = uniform_samples(6);
        let product = |i: usize| (value(&p, at[i % 6]) * value(&q, at[i / 6])) as f32;
        let nodes = [(0..36).map(product).collect(), vec![1.0; 36], vec![0.0; 36]];
        let points = apply(&mut Interpolation::lagrange(6, 6, &u, &v), &nodes, 6);
        for (i, point) in points.chunks_exact(3).enumerate() {
            let exact = value(&p, u[i % 26]) * value(&q, v[i / 26]);
            assert!((f64::from(point[0]) - exact).abs() < 2e-5);
            assert!((point[1] - 1.0).abs() < 1e-5 && point[2] == 0.0);
        }
    });
}

#[test]
fn any_grid_and_samples_agree_with_the_plain_double_sum() {
    for_seeds(|random| {
        let (columns, rows) = (2 + random.below(7), 2 + random.below(7));
        let mut u = random_samples(random);
        let mut v = random_samples(random);
        if random.below(2) == 0 {
            u = uniform_samples(2 + random.below(30));
        }
        if random.below(2) == 0 {
            v = uniform_samples(2 + random.below(30));
        }
        let stride = columns.next_multiple_of(8);
        let nodes = random_nodes(random, rows, stride);
        let points = apply(
            &mut Interpolation::lagrange(columns, rows, &u, &v),
            &nodes,
            stride,
        );
        for (row, &v) in v.iter().enumerate() {
            let along_v = lagrange_weights(rows, v);
            for (column, &u_here) in u.iter().enumerate() {
                let along_u = lagrange_weights(columns, u_here);
                for axis in 0..3 {
                    let mut sum = 0.0;
                    for (j, b) in along_v.iter().enumerate() {
                        for (i, a) in along_u.iter().enumerate() {
                            sum += f64::from(a * b) * f64::from(nodes[axis][j * stride + i]);
                        }
                    }
                    let found = f64::from(points[3 * (row * u.len() + column) + axis]);
                    // Weights of eight nodes reach about seven in each direction.
                    assert!(
                        (found - sum).abs() < 2e-4,
                        "{columns}x{rows}: {found} {sum}"
                    );
                }
            }
        }
    });
}

#[test]
fn the_ends_of_the_surface_are_the_outer_masses() {
    for_seeds(|random| {
        let nodes = random_nodes(random, 6, 8);
        let even = uniform_samples(26);
        let points = apply(&mut Interpolation::lagrange(6, 6, &even, &even), &nodes, 8);
        for (point, lane) in [(0, 0), (25, 5), (25 * 26, 40), (25 * 26 + 25, 45)] {
            for axis in 0..3 {
                assert!((points[3 * point + axis] - nodes[axis][lane]).abs() < 1e-6);
            }
        }
    });
}

#[test]
#[should_panic(expected = "samples must rise")]
fn samples_that_fall_are_rejected() {
    Interpolation::lagrange(6, 6, &[0.0, 0.6, 0.5, 1.0], &[0.0, 1.0]);
}

#[test]
#[should_panic(expected = "samples must lie in 0..1")]
fn samples_beyond_the_leaf_are_rejected() {
    Interpolation::lagrange(6, 6, &[0.0, 1.1], &[0.0, 1.0]);
}

/// A surface as smooth as a bent page, at (u, v).
fn page(u: f64, v: f64) -> [f64; 3] {
    let angle = 2.2 * u + 0.4 * v;
    [libm::sin(angle), v + 0.1 * u * u, libm::cos(angle)]
}

/// Nodes of the page at places along u and v, one array an axis.
fn nodes_of_page(u: &[f32], v: &[f32]) -> [Vec<f32>; 3] {
    core::array::from_fn(|axis| {
        let row = |&v: &f32| {
            u.iter()
                .map(move |&u| page(f64::from(u), f64::from(v))[axis] as f32)
        };
        v.iter().flat_map(row).collect()
    })
}

#[test]
fn b_splines_draw_the_surface_of_splines() {
    for_seeds(|random| {
        let (columns, rows) = (4 + random.below(14), 4 + random.below(14));
        let (u, v) = (random_samples(random), random_samples(random));
        let nodes = random_nodes(random, rows, columns);
        let splines = apply(
            &mut Interpolation::spline(columns, rows, &u, &v),
            &nodes,
            columns,
        );
        let local = apply(
            &mut Interpolation::b_spline(columns, rows, &u, &v),
            &nodes,
            columns,
        );
        for (a, b) in splines.iter().zip(&local) {
            assert!((a - b).abs() < 3e-5, "{columns} x {rows}: {a} {b}");
        }
    });
}

#[test]
fn every_way_passes_through_its_nodes() {
    for_seeds(|random| {
        let (columns, rows) = (4 + random.below(8), 4 + random.below(8));
        let nodes = random_nodes(random, rows, columns);
        let even = (uniform_samples(columns), uniform_samples(rows));
        let graded = (lobatto_nodes(columns), lobatto_nodes(rows));
        let ways = [
            (Interpolation::lagrange(columns, rows, &even.0, &even.1)),
            (Interpolation::spline(columns, rows, &even.0, &even.1)),
            (Interpolation::b_spline(columns, rows, &even.0, &even.1)),
            (Interpolation::hermite(columns, rows, &even.0, &even.1)),
            (Interpolation::barycentric(columns, rows, &graded.0, &graded.1)),
        ];
        for (which, mut way) in ways.into_iter().enumerate() {
            let points = apply(&mut way, &nodes, columns);
            for (index, value) in points.iter().enumerate() {
                let wanted = nodes[index % 3][index / 3];
                assert!(
                    (value - wanted).abs() < 5e-5,
                    "{which} {index}: {value} {wanted}"
                );
            }
        }
    });
}

#[test]
fn hermite_pieces_keep_parabolas() {
    let at = uniform_samples(9);
    let parabola = |t: f32| 1.0 + t * (0.5 - 2.0 * t);
    let nodes = [
        (0..63).map(|k| parabola(at[k % 9])).collect(),
        (0..63).map(|k| parabola((k / 9) as f32 / 6.0)).collect(),
        vec![2.0; 63],
    ];
    let samples = uniform_samples(33);
    let points = apply(
        &mut Interpolation::hermite(9, 7, &samples, &samples),
        &nodes,
        9,
    );
    for (k, point) in points.as_chunks::<3>().0.iter().enumerate() {
        assert!((point[0] - parabola(samples[k % 33])).abs() < 1e-5);
        assert!((point[1] - parabola(samples[k / 33])).abs() < 1e-5);
        assert!((point[2] - 2.0).abs() < 1e-5);
    }
}

#[test]
fn polynomials_through_graded_nodes_do_not_swing_however_many_there_are() {
    let samples = uniform_samples(41);
    for count in [6, 12, 24, 40] {
        let at = lobatto_nodes(count);
        assert_eq!((at[0], at[count - 1]), (0.0, 1.0));
        let nodes = nodes_of_page(&at, &at);
        let mut way = Interpolation::barycentric(count, count, &samples, &samples);
        let points = apply(&mut way, &nodes, count);
        let most = if count == 6 { 5e-4 } else { 2e-6 };
        for (k, point) in points.as_chunks::<3>().0.iter().enumerate() {
            let wanted = page(f64::from(samples[k % 41]), f64::from(samples[k / 41]));
            for axis in 0..3 {
                let away = (f64::from(point[axis]) - wanted[axis]).abs();
                assert!(away < most, "{count} nodes: {away}");
            }
        }
    }
}
