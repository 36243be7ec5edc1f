//! Cubic splines through equally spaced nodes: twice continuously
//! differentiable, and without the swing of polynomials through many nodes.

/// What a spline does at an end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// No curvature: the free edge of a sheet.
    Natural,
    /// The first two pieces are one cubic: nothing is assumed.
    NotAKnot,
}

/// The weights of `nodes` equally spaced nodes on 0..1 for the values at each
/// of `samples`: `[sample][node]`. Computed in f64.
///
/// The spline of each node alone is found from its second derivatives (de Boor,
/// A Practical Guide to Splines, chapter IV).
///
/// # Panics
/// If there are fewer than 4 nodes.
pub(super) fn spline_weights(nodes: usize, samples: &[f32], ends: [End; 2]) -> Vec<Vec<f32>> {
    assert!(nodes >= 4, "a spline needs 4 nodes");
    let curvatures: Vec<Vec<f64>> = (0..nodes)
        .map(|of| second_derivatives(nodes, of, ends))
        .collect();
    let weights = |&sample: &f32| {
        let t = f64::from(sample) * (nodes - 1) as f64;
        let left = (t as usize).min(nodes - 2);
        let b = t - left as f64;
        let a = 1.0 - b;
        let weight = |of: usize| {
            let at = |node: usize| if node == of { 1.0 } else { 0.0 };
            let m = &curvatures[of];
            let bend = (a * a * a - a) * m[left] + (b * b * b - b) * m[left + 1];
            (a * at(left) + b * at(left + 1) + bend / 6.0) as f32
        };
        (0..nodes).map(weight).collect()
    };
    samples.iter().map(weights).collect()
}

/// Second derivatives at the nodes (unit spacing) of the spline that is 1 at
/// node `of` and 0 at the others.
fn second_derivatives(nodes: usize, of: usize, ends: [End; 2]) -> Vec<f64> {
    let value = |node: usize| if node == of { 1.0 } else { 0.0 };
    // m[i-1] + 4 m[i] + m[i+1] = 6 (y[i-1] - 2 y[i] + y[i+1]) inside. An end is
    // natural by m[0] = 0, and no knot by m[0] = 2 m[1] - m[2], which leaves
    // 6 m[1] in the first equation.
    let inner = nodes - 2;
    let (mut diagonal, mut above) = (vec![4.0; inner], vec![1.0; inner]);
    let mut below = vec![1.0; inner];
    if ends[0] == End::NotAKnot {
        (diagonal[0], above[0]) = (6.0, 0.0);
    }
    if ends[1] == End::NotAKnot {
        (diagonal[inner - 1], below[inner - 1]) = (6.0, 0.0);
    }
    let mut m: Vec<f64> = (1..=inner)
        .map(|i| 6.0 * (value(i - 1) - 2.0 * value(i) + value(i + 1)))
        .collect();
    for i in 1..inner {
        let factor = below[i] / diagonal[i - 1];
        diagonal[i] -= factor * above[i - 1];
        m[i] -= factor * m[i - 1];
    }
    for i in (0..inner).rev() {
        let next = if i + 1 < inner { m[i + 1] } else { 0.0 };
        m[i] = (m[i] - above[i] * next) / diagonal[i];
    }
    let end = |kind: End, near: f64, far: f64| match kind {
        End::Natural => 0.0,
        End::NotAKnot => 2.0 * near - far,
    };
    let first = end(ends[0], m[0], m[1]);
    let last = end(ends[1], m[inner - 1], m[inner - 2]);
    [vec![first], m, vec![last]].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(weights: &[f32], nodes: usize, of: impl Fn(f64) -> f64) -> f64 {
        let at = |node: usize| of(node as f64 / (nodes - 1) as f64);
        weights
            .iter()
            .enumerate()
            .map(|(node, w)| f64::from(*w) * at(node))
            .sum()
    }

    #[test]
    fn passes_through_its_nodes_and_keeps_lines() {
        let samples: Vec<f32> = (0..=40).map(|i| i as f32 / 40.0).collect();
        for ends in [[End::Natural; 2], [End::NotAKnot, End::Natural]] {
            for nodes in [4, 5, 12] {
                for (weights, &at) in spline_weights(nodes, &samples, ends).iter().zip(&samples) {
                    let line = value(weights, nodes, |t| 3.0 - 2.0 * t);
                    assert!((line - (3.0 - 2.0 * f64::from(at))).abs() < 1e-6);
                }
            }
        }
        let at_nodes = spline_weights(5, &[0.0, 0.25, 1.0], [End::Natural; 2]);
        for (weights, node) in at_nodes.iter().zip([0, 1, 4]) {
            for (k, weight) in weights.iter().enumerate() {
                assert!((weight - if k == node { 1.0 } else { 0.0 }).abs() < 1e-7);
            }
        }
    }

    #[test]
    fn no_knot_at_both_ends_keeps_cubics() {
        let cubic = |t: f64| 1.0 + t * (2.0 - t * (3.0 - 4.0 * t));
        let samples = [0.03, 0.4, 0.77, 0.99f32];
        let all = spline_weights(7, &samples, [End::NotAKnot; 2]);
        for (weights, at) in all.iter().zip(samples) {
            assert!((value(weights, 7, cubic) - cubic(f64::from(at))).abs() < 1e-6);
        }
    }

    #[test]
    fn an_arc_gains_no_more_than_a_quarter_per_cent_of_length() {
        let nodes = 12;
        let samples: Vec<f32> = (0..=200).map(|i| i as f32 / 200.0).collect();
        let all = spline_weights(nodes, &samples, [End::NotAKnot, End::Natural]);
        let angle = |t: f64| t * core::f64::consts::PI;
        let points: Vec<[f64; 2]> = all
            .iter()
            .map(|w| {
                [
                    value(w, nodes, |t| libm::sincos(angle(t)).0),
                    value(w, nodes, |t| libm::sincos(angle(t)).1),
                ]
            })
            .collect();
        let length: f64 = points
            .windows(2)
            .map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1]))
            .sum();
        assert!(
            (length / core::f64::consts::PI - 1.0).abs() < 2.5e-3,
            "{length}"
        );
    }
}
