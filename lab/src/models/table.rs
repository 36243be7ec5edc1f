//! The comparison as a table, for people or in Markdown.

use serde_json::Value;

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
pub fn of(figures: &Value, markdown: bool) -> String {
    let mut rows: Vec<Vec<String>> = vec![HEADINGS.map(String::from).to_vec()];
    let ways = figures["ways"].as_array().into_iter().flatten();
    rows.extend(ways.map(row));
    crate::report::table(&rows, markdown)
}

/// What replays are beside the live leaf that they repeat, a line each.
pub fn replays(figures: &Value) -> String {
    let mut text = String::new();
    for way in figures["ways"].as_array().into_iter().flatten() {
        let of_live = &way["of_live"];
        if of_live.is_object() {
            let percent = |value: &Value| figure(value.as_f64().map(|value| 100.0 * value));
            text.push_str(&format!(
                "- {}: {} times cheaper than the live leaf, and from it {} % RMS and {} % at worst.\n",
                way["name"].as_str().unwrap_or_default(),
                figure(of_live["times_cheaper"].as_f64()),
                percent(&of_live["rms"]),
                percent(&of_live["worst"])
            ));
        }
    }
    text
}

fn row(way: &Value) -> Vec<String> {
    let name = way["name"].as_str().unwrap_or_default().to_string();
    let part = |value: &Value| figure(value.as_f64().map(|value| 100.0 * value));
    let of_turn = |turn: &str| {
        if way["reference"] == true {
            return "0".to_string();
        }
        part(&way["turns"][turn]["worst"])
    };
    let spine = match way["keeps_spine"].as_bool() {
        Some(true) => "yes".to_string(),
        Some(false) => format!("but for {} %", part(&way["spine_off"])),
        None => figure(None),
    };
    vec![
        name,
        figure(way["us_per_frame"].as_f64()),
        figure(way["bytes"].as_f64().map(|bytes| bytes / 1e3)),
        if way["reference"] == true {
            "0".into()
        } else {
            part(&way["rms"])
        },
        of_turn("edge"),
        of_turn("corner"),
        of_turn("let-go"),
        if way["reference"] == true {
            "0".into()
        } else {
            part(&way["worst_as_agree"])
        },
        part(&way["stretch"]),
        part(&way["compression"]),
        part(&way["area_change"]),
        figure(way["angle_defect_degrees"].as_f64()),
        figure(way["shear_degrees"].as_f64()),
        part(&way["diagonal_stretch"]),
        figure(way["facet_angle_degrees"].as_f64()),
        spine,
        part(&way["drag_miss"]),
    ]
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
    use super::*;

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
