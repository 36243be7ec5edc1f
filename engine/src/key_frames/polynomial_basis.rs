//! A frame as a sum of smooth surfaces: polynomials along u times polynomials
//! along v, orthonormal over the points. Paper bends smoothly, so a few of them
//! say nearly all of it, and the rest rounds to nothing.

/// Orthonormal polynomials over places: value of the k-th at place i at
/// `k * n + i`. Not all finite where places are too near each other.
pub(super) fn polynomials(places: &[f32]) -> Vec<f64> {
    let n = places.len();
    let mut basis = vec![0.0; n * n];
    let mut next = vec![1.0; n];
    for k in 0..n {
        // Taken away twice: once leaves a rounding error that grows with the degree.
        for _ in 0..2 {
            for lower in basis[..k * n].chunks_exact(n) {
                let projection: f64 = next.iter().zip(lower).map(|(a, b)| a * b).sum();
                for (value, lower) in next.iter_mut().zip(lower) {
                    *value -= projection * lower;
                }
            }
        }
        let length = next.iter().map(|value| value * value).sum::<f64>().sqrt();
        let row = &mut basis[k * n..(k + 1) * n];
        for i in 0..n {
            row[i] = next[i] / length;
            next[i] = row[i] * (2.0 * f64::from(places[i]) - 1.0);
        }
    }
    basis
}

/// Places of the coefficients in the order in which they are kept, the smoothest first.
pub(super) fn order(columns: usize, rows: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..columns * rows).collect();
    order.sort_by_key(|at| (at % columns * rows + at / columns * columns, *at));
    order
}

/// Frames of a size as sums, and back.
pub(super) struct PolynomialBasis {
    columns: usize,
    rows: usize,
    along_u: Vec<f64>,
    along_v: Vec<f64>,
}

impl PolynomialBasis {
    /// None where the places are too near each other.
    pub fn new(u: &[f32], v: &[f32]) -> Option<Self> {
        let (columns, rows) = (u.len(), v.len());
        let (along_u, along_v) = (polynomials(u), polynomials(v));
        if !along_u.iter().chain(&along_v).all(|x| x.is_finite()) {
            return None;
        }
        Some(Self {
            columns,
            rows,
            along_u,
            along_v,
        })
    }

    /// The coefficients of values, row by row.
    pub fn coefficients(&self, values: &[f64]) -> Vec<f64> {
        let (columns, rows) = (self.columns, self.rows);
        let mut half = vec![0.0; columns * rows];
        for row in 0..rows {
            for k in 0..columns {
                let basis = &self.along_u[k * columns..(k + 1) * columns];
                let values = &values[row * columns..(row + 1) * columns];
                half[row * columns + k] = values.iter().zip(basis).map(|(a, b)| a * b).sum();
            }
        }
        let mut coefficients = vec![0.0; columns * rows];
        for k in 0..rows {
            for row in 0..rows {
                let basis = self.along_v[k * rows + row];
                for column in 0..columns {
                    coefficients[k * columns + column] += half[row * columns + column] * basis;
                }
            }
        }
        coefficients
    }

    /// The values of sums with these coefficients.
    pub fn values(&self, coefficients: &[f64]) -> Vec<f64> {
        let (columns, rows) = (self.columns, self.rows);
        let mut half = vec![0.0; columns * rows];
        for (at, &coefficient) in coefficients
            .iter()
            .enumerate()
            .filter(|(_, coefficient)| **coefficient != 0.0)
        {
            let (k, row) = (at % columns, at / columns);
            for column in 0..columns {
                half[row * columns + column] += coefficient * self.along_u[k * columns + column];
            }
        }
        let mut values = vec![0.0; columns * rows];
        for k in 0..rows {
            let half = &half[k * columns..(k + 1) * columns];
            if half.iter().all(|value| *value == 0.0) {
                continue;
            }
            for row in 0..rows {
                let basis = self.along_v[k * rows + row];
                for column in 0..columns {
                    values[row * columns + column] += half[column] * basis;
                }
            }
        }
        values
    }
}
