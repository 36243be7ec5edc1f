//! Tables: for people, in Markdown, and as the files of data that the pages of the
//! docs include.

use std::fmt::{self, Display, Formatter};
use std::path::Path;

use serde_json::json;

/// A table, printed as Markdown by `{:#}`. The first column has names, the others figures.
pub struct Table {
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table without rows.
    pub fn new(headings: &[&str]) -> Table {
        Table {
            rows: vec![headings.iter().map(|heading| (*heading).into()).collect()],
        }
    }

    /// Adds a row.
    pub fn push(&mut self, row: Vec<String>) {
        self.rows.push(row);
    }

    /// Writes it as `NAME.json` into a folder, a row a line, for `scripts/docs_tables.mjs`.
    ///
    /// # Errors
    /// Where the file cannot be written, in a sentence.
    pub fn write(&self, folder: &Path, name: &str) -> Result<(), String> {
        let path = folder.join(format!("{name}.json"));
        let rows = self.rows.iter().map(|row| format!("  {}", json!(row)));
        let text = format!("[\n{}\n]\n", rows.collect::<Vec<_>>().join(",\n"));
        std::fs::write(&path, text)
            .map_err(|error| format!("{} cannot be written: {error}.", path.display()))
    }
}

impl Display for Table {
    fn fmt(&self, out: &mut Formatter) -> fmt::Result {
        let columns = self.rows[0].len();
        if out.alternate() {
            for (index, row) in self.rows.iter().enumerate() {
                writeln!(out, "| {} |", row.join(" | "))?;
                if index == 0 {
                    writeln!(out, "|---|{}", "---:|".repeat(columns - 1))?;
                }
            }
            return Ok(());
        }
        let width = |column: usize| {
            let cells = self.rows.iter().map(|row| row[column].chars().count());
            cells.max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..columns).map(width).collect();
        for row in &self.rows {
            write!(out, "{:<1$}", row[0], widths[0])?;
            for (cell, width) in row.iter().zip(&widths).skip(1) {
                write!(out, "  {cell:>width$}")?;
            }
            writeln!(out)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_written_for_people_and_for_the_docs() {
        let mut table = Table::new(&["sheet, or not", "µs"]);
        table.push(vec!["sheet".into(), "0.5".into()]);
        assert_eq!(
            table.to_string(),
            "sheet, or not   µs\nsheet          0.5\n"
        );
        assert_eq!(
            format!("{table:#}"),
            "| sheet, or not | µs |\n|---|---:|\n| sheet | 0.5 |\n"
        );
        let folder = std::env::temp_dir();
        let name = format!("lab-table-{}", std::process::id());
        table.write(&folder, &name).expect("written");
        let path = folder.join(format!("{name}.json"));
        let text = std::fs::read_to_string(&path).expect("read");
        assert_eq!(
            text,
            "[\n  [\"sheet, or not\",\"µs\"],\n  [\"sheet\",\"0.5\"]\n]\n"
        );
        std::fs::remove_file(&path).expect("removed");
        let nowhere = table.write(&path, &name).expect_err("no folder");
        assert!(nowhere.ends_with('.'), "{nowhere}");
    }
}
