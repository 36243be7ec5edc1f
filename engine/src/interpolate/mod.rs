//! From a model's few nodes to the many points of the drawn surface.

mod lagrange;
#[cfg(test)]
mod tests;

pub use lagrange::{Lagrange, lagrange_weights, uniform_samples};
