//! What an experiment found: JSON, or a line a figure.

use lexopt::Parser;
use serde_json::{Value, json};

use crate::options;
use crate::specimen::Model;

/// Reads the options of an experiment on one piece: `--model`, `--json`, and
/// those that `take` knows. Returns the model and whether JSON is wanted.
pub fn read(
    parser: &mut Parser,
    mut take: impl FnMut(&str, &mut Parser) -> Result<bool, String>,
) -> Result<(Model, bool), String> {
    let mut model = Model::default();
    let json = options::read(parser, |option, parser| {
        if option == "model" {
            model = Model::read(parser)?;
            return Ok(true);
        }
        take(option, parser)
    })?;
    Ok((model, json))
}

/// Prints figures.
pub fn print(json: bool, figures: &Value) {
    if json {
        println!("{figures:#}");
    } else {
        print_lines(figures, "");
    }
}

fn print_lines(figures: &Value, before: &str) {
    for (name, value) in figures.as_object().into_iter().flatten() {
        let name = format!("{before}{}", name.replace('_', " "));
        match value {
            Value::Object(_) => print_lines(value, &format!("{name}, ")),
            Value::String(text) => println!("{name:<28}  {text}"),
            Value::Null => println!("{name:<28}  unknown"),
            _ => println!("{name:<28}  {value}"),
        }
    }
}

/// How far a figure is from the exact one, as part of that.
pub fn error(found: f64, exact: f64) -> Value {
    json!((found - exact) / exact.abs())
}
