//! From a model's few nodes to the many points of the drawn surface.

mod lagrange;
mod spline;
mod tensor;
#[cfg(test)]
mod tests;

pub use lagrange::{lagrange_weights, uniform_samples};
pub use tensor::Interpolation;
