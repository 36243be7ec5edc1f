//! The preset stocks as the viewer has them, and as the docs list them: two files written from the
//! engine's by `UPDATE_GOLDEN=1 cargo test -p turnleaf-engine --test preset_stocks`.

use turnleaf_engine::{Air, Grain, Stock};

/// Width of the page that the docs compare stocks by, m.
const WIDTH: f64 = 0.148;

/// Returns what TypeScript has.
fn written() -> String {
    let mut text = String::from(
        "/** Written from engine/src/stock.rs: `UPDATE_GOLDEN=1 cargo test -p turnleaf-engine --test preset_stocks`. */\n\n\
        /**\n\
        \x20* The preset stocks, from the lightest to the heaviest, board the last; the engine counts them in this\n\
        \x20* order. Mass per area, kg/m²; thickness, m; bending stiffness along and across the grain, N m; friction.\n\
        \x20*/\n\
        export const presetStocks = {\n",
    );
    for (name, stock) in Stock::PRESETS {
        text.push_str(&format!("  {name}: {{\n"));
        for (figure, value) in [
            ("grammage", stock.grammage),
            ("caliper", stock.caliper),
            ("stiffnessAlong", stock.stiffness_along),
            ("stiffnessAcross", stock.stiffness_across),
            ("friction", stock.friction),
        ] {
            text.push_str(&format!("    {figure}: {value},\n"));
        }
        text.push_str("  },\n");
    }
    text + "} as const;\n"
}

/// Returns the table of the docs, a row a line, as `scripts/docs_tables.mjs` reads it.
fn table() -> String {
    let headings = [
        "stock",
        "g/m²",
        "caliper, µm",
        "D across, mN m",
        "D along, mN m",
        "friction",
        "Γ",
        "air carried / own mass",
        "terminal speed, m/s",
    ];
    let mut rows = vec![headings.map(String::from)];
    for (name, stock) in Stock::PRESETS {
        let air = Air::still(WIDTH);
        let figures = [
            1e3 * stock.grammage,
            1e6 * stock.caliper,
            1e3 * stock.stiffness_across,
            1e3 * stock.stiffness_along,
            stock.friction,
            stock.heaviness(WIDTH, Grain::AlongSpine),
            air.added_mass / stock.grammage,
            air.terminal_speed(stock.grammage),
        ];
        let [a, b, c, d, e, f, g, h] = figures.map(rounded);
        rows.push([name.into(), a, b, c, d, e, f, g, h]);
    }
    let line = |row: [String; 9]| format!("  [{}]", row.map(|cell| format!("{cell:?}")).join(","));
    let lines: Vec<String> = rows.into_iter().map(line).collect();
    format!("[\n{}\n]\n", lines.join(",\n"))
}

/// Returns a figure to three digits; digits before its point are kept.
fn rounded(value: f64) -> String {
    let before = value.log10().floor() as i32 + 1;
    let digits = (3 - before).max(0) as usize;
    let text = format!("{value:.digits$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').into(),
        false => text,
    }
}

/// Compares a file of the repository with what it is to be, or writes it.
fn expect_file(path: &str, expected: &str) {
    let path = format!("{}/../{path}", env!("CARGO_MANIFEST_DIR"));
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(path, expected).unwrap();
    } else {
        assert_eq!(std::fs::read_to_string(&path).unwrap(), expected, "{path}");
    }
}

#[test]
fn the_viewer_has_the_same_presets() {
    expect_file("packages/turnleaf/src/stocks.ts", &written());
}

#[test]
fn the_docs_list_the_presets() {
    expect_file("docs/data/stocks.json", &table());
}
