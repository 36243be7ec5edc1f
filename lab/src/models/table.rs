//! The comparison as tables.

use super::measure::Figures;
use crate::table::Table;

/// Headings of the columns.
const HEADINGS: [&str; 17] = [
    "model",
    "µs a frame",
    "kB",
    "RMS %",
    "worst %: edge",
    "corner",
    "let go",
    "as lab agree",
    "stretch %",
    "compression %",
    "area %",
    "angles °",
    "shear °",
    "diagonals %",
    "facets °",
    "keeps the spine",
    "misses a hand by %",
];

/// The table of all ways.
pub fn of(ways: &[Figures]) -> Table {
    let mut table = Table::new(&HEADINGS);
    ways.iter().for_each(|way| table.push(row(way)));
    table
}

/// What replays are beside the live leaf that they repeat.
pub fn replays(ways: &[Figures]) -> Table {
    let mut table = Table::new(&[
        "replay",
        "times cheaper than the live leaf",
        "from it: RMS %",
        "worst %",
    ]);
    for way in ways {
        if let Some(of_live) = &way.of_live {
            table.push(vec![
                way.name.into(),
                figure(Some(of_live.times_cheaper)),
                percent(Some(of_live.rms)),
                percent(Some(of_live.worst)),
            ]);
        }
    }
    table
}

fn row(way: &Figures) -> Vec<String> {
    let faults = &way.faults;
    // Of itself the reference is no distance away, but for rounding.
    let away = |part: f64| percent(Some(if way.reference { 0.0 } else { part }));
    let of_turn = |turn: &str| away(way.turns[turn].worst);
    let spine = match faults.keeps_spine {
        Some(true) => "yes".to_string(),
        Some(false) => format!("but for {} %", percent(faults.spine_off)),
        None => figure(None),
    };
    vec![
        way.name.into(),
        figure(Some(way.us_per_frame)),
        figure(Some(way.bytes as f64 / 1e3)),
        away(way.rms),
        of_turn("edge"),
        of_turn("corner"),
        of_turn("let-go"),
        away(way.worst_as_agree),
        percent(faults.stretch.map(f64::from)),
        percent(faults.compression.map(f64::from)),
        percent(faults.area_change),
        figure(faults.angle_defect_degrees),
        figure(faults.shear_degrees),
        percent(faults.diagonal_stretch),
        figure(faults.facet_angle_degrees),
        spine,
        percent(way.drag_miss),
    ]
}

fn percent(part: Option<f64>) -> String {
    figure(part.map(|part| 100.0 * part))
}

/// Three digits of a figure, where there is one.
fn figure(value: Option<f64>) -> String {
    let Some(value) = value else {
        return "does not apply".into();
    };
    let size = value.abs();
    match size {
        _ if size < 5e-4 => "0".into(),
        _ if size < 1.0 => format!("{value:.3}")
            .trim_end_matches('0')
            .trim_end_matches('.')
            .into(),
        _ if size < 10.0 => format!("{value:.2}"),
        _ if size < 100.0 => format!("{value:.1}"),
        _ => format!("{value:.0}"),
    }
}

#[cfg(test)]
mod tests {
    use turnleaf_engine::Stock;

    use super::super::{rows, strips};
    use super::*;

    const PAGE: &str = include_str!("../../../docs/methods.md");
    const DATA: &str = include_str!("../../../docs/data/models.json");

    #[test]
    fn the_page_of_methods_has_every_row_and_column_and_says_what_they_are() {
        let data: Vec<Vec<String>> = serde_json::from_str(DATA).expect("rows of cells");
        assert_eq!(data[0], HEADINGS, "docs/data/models.json: run make methods");
        let names: Vec<&str> = data[1..].iter().map(|row| &row[0][..]).collect();
        let ways = rows::all(Stock::BOOK, rows::NODES);
        let rows: Vec<&str> = ways.iter().map(|way| way.name).collect();
        assert_eq!(names, rows, "docs/data/models.json: run make methods");
        for name in rows {
            let picture = format!("](methods/{})", strips::file(name));
            assert!(PAGE.contains(&picture), "docs/methods.md has no {picture}");
        }
        let (_, after) = PAGE
            .split_once("What the columns say:")
            .expect("what the columns say");
        let (said, _) = after.split_once("\n## ").expect("a section after it");
        // Every second part is in bold.
        let bold: Vec<&str> = said
            .split("**")
            .skip(1)
            .step_by(2)
            .flat_map(|words| words.split(", "))
            .collect();
        for heading in &HEADINGS[1..] {
            let words = heading.trim_end_matches([' ', '%', '°']);
            assert!(
                bold.contains(&words),
                "docs/methods.md does not say what the column {heading} is"
            );
        }
    }

    #[test]
    fn figures_have_three_digits() {
        let shown =
            [0.0, 1e-4, 0.0123, 0.5, 2.71528, 27.1528, 271.528, 27152.8].map(|x| figure(Some(x)));
        assert_eq!(
            shown,
            ["0", "0", "0.012", "0.5", "2.72", "27.2", "272", "27153"]
        );
        assert_eq!(figure(None), "does not apply");
    }
}
