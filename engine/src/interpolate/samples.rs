//! Where along a side of a leaf its surface is sampled.

/// `count` equally spaced samples, the first 0 and the last 1.
///
/// # Panics
/// If `count` is below 2.
pub fn uniform_samples(count: usize) -> Vec<f32> {
    assert!(count >= 2);
    let last = (count - 1) as f64;
    (0..count).map(|i| (i as f64 / last) as f32).collect()
}

/// Panics where samples are fewer than 2, do not rise, or leave 0..1.
pub(super) fn check_samples(samples: &[f32]) {
    assert!(samples.len() >= 2, "at least 2 samples a side");
    assert!(
        samples.windows(2).all(|pair| pair[0] < pair[1]),
        "samples must rise"
    );
    let ends = [samples[0], samples[samples.len() - 1]];
    assert!(ends[0] >= 0.0 && ends[1] <= 1.0, "samples must lie in 0..1");
}
