//! The preset stocks as the viewer has them: a TypeScript file, written from the engine's by
//! `UPDATE_GOLDEN=1 cargo test -p turnleaf-engine --test preset_stocks`.

use turnleaf_engine::Stock;

const FILE: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../packages/turnleaf/src/stocks.ts"
);

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

#[test]
fn the_viewer_has_the_same_presets() {
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(FILE, written()).unwrap();
    } else {
        assert_eq!(std::fs::read_to_string(FILE).unwrap(), written(), "{FILE}");
    }
}
