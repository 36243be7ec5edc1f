//! Polynomials through nodes that lie closer together toward the ends, where
//! equally spaced ones swing: the Lobatto nodes of Chebyshev, by the barycentric
//! formula, which is stable for any number of them (Berrut and Trefethen 2004).

use core::f64::consts::PI;

/// `count` nodes from 0 to 1, closer together toward both.
///
/// # Panics
/// If `count` is below 2.
pub fn lobatto_nodes(count: usize) -> Vec<f32> {
    exact_nodes(count).iter().map(|&node| node as f32).collect()
}

fn exact_nodes(count: usize) -> Vec<f64> {
    assert!(count >= 2, "at least 2 nodes");
    // Half the square of a sine is exact near both ends; so is the mirror image.
    let node = |k: usize| {
        let sine = libm::sin(0.5 * PI * k as f64 / (count - 1) as f64);
        sine * sine
    };
    let half = |k: usize| {
        if 2 * k < count {
            node(k)
        } else {
            1.0 - node(count - 1 - k)
        }
    };
    (0..count).map(half).collect()
}

/// The weights of `nodes` Lobatto nodes for a value at `position`.
///
/// # Panics
/// If there are fewer than 2 nodes.
pub(super) fn lobatto_weights(nodes: usize, position: f32) -> Vec<f32> {
    let places = exact_nodes(nodes);
    let t = f64::from(position);
    // As the samples are single numbers, so is what counts as a node.
    let at = places.iter().position(|&place| place as f32 == position);
    if let Some(at) = at {
        return (0..nodes)
            .map(|k| if k == at { 1.0 } else { 0.0 })
            .collect();
    }
    let weight = |k: usize| {
        let end = if k == 0 || k + 1 == nodes { 0.5 } else { 1.0 };
        let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        sign * end / (t - places[k])
    };
    let weights: Vec<f64> = (0..nodes).map(weight).collect();
    let sum: f64 = weights.iter().sum();
    weights.iter().map(|weight| (weight / sum) as f32).collect()
}
