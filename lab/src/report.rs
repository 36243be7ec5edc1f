//! What an experiment found: JSON, or a line a figure.

use std::fmt::{self, Display, Formatter};

use serde::Serialize;
use serde_json::Value;

use crate::specimen::Label;

/// Figures that are shown to people as a line each.
#[derive(Serialize)]
#[serde(transparent)]
pub struct Lines<T>(pub T);

impl<T: Serialize> Display for Lines<T> {
    fn fmt(&self, out: &mut Formatter) -> fmt::Result {
        let figures = serde_json::to_value(&self.0).map_err(|_| fmt::Error)?;
        write_lines(out, &figures, "")
    }
}

fn write_lines(out: &mut Formatter, figures: &Value, before: &str) -> fmt::Result {
    for (name, value) in figures.as_object().into_iter().flatten() {
        let name = format!("{before}{}", name.replace('_', " "));
        match value {
            Value::Object(_) => write_lines(out, value, &format!("{name}, "))?,
            Value::String(text) => writeln!(out, "{name:<28}  {text}")?,
            // Of a model that has no settings to choose from.
            Value::Null if name == "settings" => {}
            Value::Null => writeln!(out, "{name:<28}  unknown")?,
            _ => writeln!(out, "{name:<28}  {value}")?,
        }
    }
    Ok(())
}

/// What was found of a piece of a model, beside the exact figures.
#[derive(Serialize)]
pub struct Compared<Found, Exact, Error = Exact> {
    #[serde(flatten)]
    pub of: Label,
    /// What was found.
    #[serde(flatten)]
    pub found: Found,
    /// What is exact.
    pub exact: Exact,
    /// How far the one is from the other.
    pub error: Error,
}

/// How far a figure is from the exact one, as part of that.
pub fn error(found: f64, exact: f64) -> f64 {
    (found - exact) / exact.abs()
}
