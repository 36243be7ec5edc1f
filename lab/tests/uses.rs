//! What readers do every day, on a usual book: pictures are where the paper is.

use std::process::Command;

use serde_json::Value;

/// Twelve uses of a book of book paper, 140 x 210 mm. The whole table, of folded books, other stocks and
/// other pages too, is `lab uses`; docs/reports/contact.md says which do not keep the bounds.
#[test]
fn ordinary_uses_of_a_usual_book_are_drawn_where_the_paper_is() {
    let output = Command::new(env!("CARGO_BIN_EXE_lab"))
        .args(["uses", "--json", "--only", "whole", "--only", "book"])
        .args(["--only", "140 x 210 mm"])
        .output()
        .expect("lab runs");
    let found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let all = &found["all"];
    assert_eq!(all["runs"], 12);
    for (name, most) in [
        ("behind_percent", 1.0),
        ("still_ms", 50.0),
        ("depth_mm", 0.1),
        // As counted: a clock would measure what else runs.
        ("work_ms", 25.0),
    ] {
        let value = all[name].as_f64().expect("a number");
        assert!(value <= most, "{name} is {value}, beyond {most}");
    }
}

/// A few of the 300 runs of folded leaves by `lab uses --folded`: none lies through itself.
#[test]
fn folded_leaves_that_are_turned_lie_clear_of_themselves() {
    let output = Command::new(env!("CARGO_BIN_EXE_lab"))
        .args(["uses", "--folded", "--json", "--seed", "15", "--count", "4"])
        .output()
        .expect("lab runs");
    let found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let all = &found["all"];
    assert_eq!(all["runs"], 4);
    assert_eq!(all["through_at_rest"], 0);
    assert!(all["frames"].as_u64() > Some(100), "{all}");
}
