//! The band against dense matrices.

use super::*;
use crate::random::{Random, for_seeds};

/// Orders and half-bandwidths about the sizes of panels and tiles.
const SHAPES: [(usize, usize); 12] = [
    (0, 3),
    (1, 0),
    (1, 5),
    (3, 1),
    (5, 0),
    (7, 9),
    (8, 3),
    (13, 4),
    (30, 11),
    (33, 12),
    (61, 17),
    (90, 68),
];

/// Entries between -1 and 1, and a diagonal that is greater than its row's sum.
fn definite<T: Real>(random: &mut Random, order: usize, half_bandwidth: usize) -> Band<T> {
    let mut band = Band::new(order, half_bandwidth);
    for row in 0..order {
        for column in row.saturating_sub(half_bandwidth)..row {
            let value = T::of(f64::from(random.between(-1.0, 1.0)));
            band.add(row, column, value);
            band.add(row, row, value.abs());
            band.add(column, column, value.abs());
        }
        band.add(row, row, T::of(f64::from(random.between(0.01, 1.0))));
    }
    band
}

fn dense<T: Real>(band: &Band<T>) -> Vec<Vec<T>> {
    let mut dense = vec![vec![T::ZERO; band.order]; band.order];
    let mut band = band.clone();
    for row in 0..band.order {
        for column in row.saturating_sub(band.half_bandwidth)..=row {
            let place = band.half_bandwidth - (row - column);
            let value = band.row_mut(row)[place];
            dense[row][column] = value;
            dense[column][row] = value;
        }
    }
    dense
}

/// The same factors in scalars, one entry after the other. An entry takes in
/// the rows after its panel, then its panel's from the last.
fn dense_factors<T: Real>(mut a: Vec<Vec<T>>) -> Vec<Vec<T>> {
    let order = a.len();
    let mut inverses = vec![T::ZERO; order];
    for i in (0..order).rev() {
        let end = (i + 1).next_multiple_of(PANEL).min(order);
        for j in 0..=i {
            for k in (end..order).chain((i + 1..end).rev()) {
                let product = a[k][i] * inverses[k] * a[k][j];
                a[i][j] -= product;
            }
        }
        inverses[i] = T::ONE / a[i][i];
    }
    a
}

fn times<T: Real>(a: &[Vec<T>], x: &[T]) -> Vec<T> {
    let product = |row: &Vec<T>| {
        let terms = row.iter().zip(x).map(|(&a, &x)| a * x);
        terms.fold(T::ZERO, |sum, term| sum + term)
    };
    a.iter().map(product).collect()
}

fn greatest<T: Real>(values: impl IntoIterator<Item = T>) -> T {
    values
        .into_iter()
        .fold(T::ZERO, |most, value| most.max(value.abs()))
}

fn factors_agree<T: Real>(random: &mut Random) {
    for (order, half_bandwidth) in SHAPES {
        let mut band = definite::<T>(random, order, half_bandwidth);
        let expected = dense_factors(dense(&band));
        assert_eq!(band.factorise(), 0);
        let got = dense(&band);
        for row in 0..order {
            assert_eq!(
                got[row][..=row],
                expected[row][..=row],
                "row {row} of {order}, {half_bandwidth}"
            );
        }
    }
}

#[test]
fn factors_are_those_of_scalars_in_the_same_order() {
    for_seeds(factors_agree::<f32>);
    for_seeds(factors_agree::<f64>);
}

fn right_side<T: Real>(random: &mut Random, order: usize) -> Vec<T> {
    let mut value = || T::of(f64::from(random.between(-1.0, 1.0)));
    (0..order).map(|_| value()).collect()
}

fn solution_multiplies_back<T: Real>(random: &mut Random, precision: f64) {
    for (order, half_bandwidth) in SHAPES {
        let mut band = definite::<T>(random, order, half_bandwidth);
        let a = dense(&band);
        let b = right_side::<T>(random, order);
        let mut x = b.clone();
        assert_eq!(band.factorise(), 0);
        band.solve(&mut x);
        let residual = greatest(times(&a, &x).iter().zip(&b).map(|(&ax, &b)| ax - b));
        let scale = greatest(a.concat()) * greatest(x) * T::of(order as f64);
        assert!(
            residual <= scale * T::of(precision),
            "{residual:?} of {scale:?}"
        );
    }
}

#[test]
fn solution_multiplies_back_to_b() {
    for_seeds(|random| solution_multiplies_back::<f32>(random, f64::from(f32::EPSILON)));
    for_seeds(|random| solution_multiplies_back::<f64>(random, f64::EPSILON));
}

/// A matrix with pivots of either sign, and entries far greater than them.
fn indefinite<T: Real>(random: &mut Random, order: usize, half_bandwidth: usize) -> Band<T> {
    let mut band = definite(random, order, half_bandwidth);
    for row in 0..order {
        let column = row.saturating_sub(random.below(half_bandwidth + 1));
        band.add(row, column, T::of(f64::from(random.between(-3e3, 3e3))));
    }
    band
}

fn unknowns_without_a_positive_pivot_are_held<T: Real>(random: &mut Random) {
    for (order, half_bandwidth) in SHAPES {
        let mut band = indefinite::<T>(random, order, half_bandwidth);
        let b = right_side::<T>(random, order);
        let mut x = b.clone();
        let held = band.factorise();
        band.solve(&mut x);
        assert!(dense(&band).concat().iter().all(|value| value.is_finite()));
        assert_eq!(x.iter().filter(|&&x| x == T::ZERO).count(), held);
        let along: f64 = x.iter().zip(&b).map(|(x, b)| x.to_f64() * b.to_f64()).sum();
        assert!(along > 0.0 || held == order, "b·x is {along}");
    }
}

#[test]
fn an_unknown_without_a_positive_pivot_is_held() {
    for_seeds(unknowns_without_a_positive_pivot_are_held::<f32>);
    for_seeds(unknowns_without_a_positive_pivot_are_held::<f64>);
}

#[test]
fn a_cleared_matrix_is_as_good_as_new() {
    let mut band = Band::<f32>::new(6, 2);
    assert_eq!(band.factorise(), 6);
    band.clear();
    (0..6).for_each(|row| band.add(row, row, 2.0));
    let mut copy = Band::new(6, 2);
    copy.copy_from(&band);
    assert_eq!(copy.factorise(), 0);
    let mut x = [1.0; 6];
    copy.solve(&mut x);
    assert_eq!(x, [0.5; 6]);
}
