//! From a model's few nodes to the many points of the drawn surface.

#[cfg(feature = "interpolations")]
mod chebyshev;
mod lagrange;
#[cfg(feature = "interpolations")]
mod local;
mod spline;
mod tensor;
#[cfg(test)]
mod tests;

#[cfg(feature = "interpolations")]
pub use chebyshev::lobatto_nodes;
pub use lagrange::{lagrange_weights, uniform_samples};
pub use tensor::Interpolation;
