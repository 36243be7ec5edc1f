//! The ways of turning a page, one folder a model.

pub mod kinematic;
pub mod mass_spring;
pub mod sheet;
pub mod shell;
