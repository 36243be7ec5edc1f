//! What an experiment found: JSON, or a line a figure.

use std::path::Path;

use lexopt::Parser;
use serde_json::{Value, json};

use crate::options;
use crate::specimen::{Model, Settings};

/// Reads the options of an experiment on one piece: `--model`, `--settings`, `--json`,
/// and those that `take` knows. Returns the model and whether JSON is wanted.
pub fn read(
    parser: &mut Parser,
    mut take: impl FnMut(&str, &mut Parser) -> Result<bool, String>,
) -> Result<(Model, bool), String> {
    let (mut model, mut settings) = (Model::Sheet(Settings::default()), None);
    let json = options::read(parser, |option, parser| {
        match option {
            "model" => model = Model::read(parser)?,
            "settings" => settings = Some(Settings::read(parser)?),
            _ => return take(option, parser),
        }
        Ok(true)
    })?;
    match (model, settings) {
        (Model::Sheet(_), Some(settings)) => model = Model::Sheet(settings),
        (_, Some(_)) => return Err("--settings is for the sheet alone.".into()),
        _ => {}
    }
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
            // Of a model that has no settings to choose from.
            Value::Null if name == "settings" => {}
            Value::Null => println!("{name:<28}  unknown"),
            _ => println!("{name:<28}  {value}"),
        }
    }
}

/// How far a figure is from the exact one, as part of that.
pub fn error(found: f64, exact: f64) -> Value {
    json!((found - exact) / exact.abs())
}

/// Rows of cells, the first of them headings, as a table for people or in
/// Markdown. The first column is of names, the others of figures.
pub fn table(rows: &[Vec<String>], markdown: bool) -> String {
    let columns = rows.first().map_or(0, Vec::len);
    let width = |column: usize| {
        let cells = rows.iter().map(|row| row[column].chars().count());
        cells.max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for (index, row) in rows.iter().enumerate() {
        let cell = |(column, cell): (usize, &String)| {
            let space = " ".repeat(widths[column] - cell.chars().count());
            if column == 0 {
                format!("{cell}{space}")
            } else {
                format!("{space}{cell}")
            }
        };
        let cells: Vec<String> = row.iter().enumerate().map(cell).collect();
        if markdown {
            text.push_str(&format!("| {} |\n", cells.join(" | ")));
            if index == 0 {
                text.push_str(&format!("|---|{}\n", "---:|".repeat(columns - 1)));
            }
        } else {
            text.push_str(&format!("{}\n", cells.join("  ")));
        }
    }
    text
}

/// Bytes of a page of Markdown that is written into.
const LONGEST_PAGE: u64 = 16 << 20;

/// Puts text into a file between the lines `<!-- NAME -->` and `<!-- /NAME -->`.
///
/// # Errors
/// Where the file is not a regular one, is larger than 16 MB, cannot be read or
/// written, or has no such lines.
pub fn insert(path: &Path, name: &str, text: &str) -> Result<(), String> {
    let fail = |what: &str| Err(format!("{} {what}.", path.display()));
    match std::fs::metadata(path) {
        Ok(found) if !found.is_file() => return fail("is not a regular file"),
        Ok(found) if found.len() > LONGEST_PAGE => return fail("is larger than 16 MB"),
        _ => {}
    }
    let Ok(all) = std::fs::read_to_string(path) else {
        return fail("cannot be read");
    };
    let (open, shut) = (format!("<!-- {name} -->\n"), format!("<!-- /{name} -->"));
    let Some((before, rest)) = all.split_once(&open) else {
        return fail(&format!("has no line <!-- {name} -->"));
    };
    let Some((_, after)) = rest.split_once(&shut) else {
        return fail(&format!("has no line <!-- /{name} -->"));
    };
    let whole = format!("{before}{open}\n{}\n\n{shut}{after}", text.trim());
    match std::fs::write(path, whole) {
        Ok(()) => Ok(()),
        Err(_) => fail("cannot be written"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_put_between_its_lines_alone() {
        let path = std::env::temp_dir().join(format!("lab-insert-{}.md", std::process::id()));
        std::fs::write(&path, "a\n<!-- x -->\nold\n<!-- /x -->\nb\n").expect("written");
        insert(&path, "x", "new\n").expect("inserted");
        insert(&path, "x", "newer").expect("inserted again");
        let all = std::fs::read_to_string(&path).expect("read");
        assert_eq!(all, "a\n<!-- x -->\n\nnewer\n\n<!-- /x -->\nb\n");
        assert!(
            insert(&path, "y", "new")
                .expect_err("no such lines")
                .ends_with('.')
        );
        std::fs::remove_file(&path).expect("removed");
    }

    #[test]
    fn what_never_ends_is_not_read() {
        let folder = std::env::temp_dir();
        for path in [Path::new("/dev/zero"), &folder] {
            let sentence = insert(path, "x", "new").expect_err("no page");
            assert!(sentence.ends_with('.'), "{sentence}");
        }
    }
}
