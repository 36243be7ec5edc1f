//! Degree n - 1 polynomials through n nodes, the paper's third improvement
//! (Shangguan and Zeng 2014, section 2.2.2).

/// The weights of `nodes` equally spaced nodes on 0..1 for a value at
/// `position`. They sum to 1, and are exact for polynomials of a degree below
/// `nodes`. Computed in f64 from exact node numbers.
///
/// # Panics
/// If there are fewer than 2 nodes.
pub fn lagrange_weights(nodes: usize, position: f32) -> Vec<f32> {
    assert!(nodes >= 2);
    let t = f64::from(position) * (nodes - 1) as f64;
    (0..nodes)
        .map(|j| {
            let product = (0..nodes)
                .filter(|&m| m != j)
                .map(|m| (t - m as f64) / (j as f64 - m as f64))
                .product::<f64>();
            product as f32
        })
        .collect()
}
