//! The ways of turning a page: one folder a model, and the list of all.

mod kind;
pub mod kinematic;
pub mod mass_spring;
mod plastic_hinge;
pub mod sheet;
pub mod shell;

pub use kind::ModelKind;
