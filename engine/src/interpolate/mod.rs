//! From a model's few nodes to the many points of the drawn surface.

#[cfg(feature = "interpolations")]
mod chebyshev;
mod lagrange;
mod local;
mod samples;
mod spline;
mod tensor;
#[cfg(test)]
mod tests;

#[cfg(feature = "interpolations")]
pub use chebyshev::lobatto_nodes;
pub use lagrange::lagrange_weights;
pub(crate) use local::Local;
pub use samples::uniform_samples;
pub use tensor::Interpolation;
