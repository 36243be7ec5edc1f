//! The command as its users meet it.

use std::process::{Command, Output};

use serde_json::Value;

fn lab(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lab"));
    command.args(arguments).output().expect("lab runs")
}

fn json(arguments: &[&str]) -> Value {
    let output = lab(arguments);
    assert!(output.status.success(), "{arguments:?}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

#[test]
fn wrong_arguments_are_rejected_in_one_sentence() {
    let wrong: &[&[&str]] = &[
        &[],
        &["table2"],
        &["turn", "--speed", "3"],
        &["turn", "--seconds"],
        &["turn", "--seconds", "soon"],
        &["turn", "--seconds", "-1"],
        &["turn", "--preset", "news"],
        &["turn", "extra"],
        &["table1", "--runs", "0"],
        &["picture", "--frames", "1"],
        &["models", "--nodes", "2"],
        &["models", "--stock", "news"],
        &["models", "--only", "sheets"],
        &["models", "--only", "sheet", "--into", "pictures"],
        // Said before anything is measured, which takes minutes.
        &["models", "--into", "Cargo.toml/folder"],
        &["models", "--plot", "Cargo.toml/plot.svg"],
        &["gestures", "--into", "Cargo.toml/folder"],
        &["gestures", "--creases=maps"],
        &["interpolation", "--runs", "3"],
    ];
    for arguments in wrong {
        let output = lab(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let sentence = String::from_utf8(output.stderr).expect("text");
        assert!(sentence.trim_end().ends_with('.'), "{sentence}");
        assert_eq!(sentence.trim_end().lines().count(), 1, "{sentence}");
        assert!(output.stdout.is_empty());
    }
}

/// Low pages with a folded corner in two of the gestures that stretched them most: their cells are
/// several times as wide as high, and lengths are restored slowly where these are crumpled. With as
/// many sweeps as a whole leaf gets the strain was 4 and 5 %.
#[test]
fn folded_low_pages_keep_their_lengths() {
    keeps_lengths("879");
}

#[test]
#[ignore = "long: make test-long"]
fn folded_low_pages_keep_their_lengths_in_a_long_gesture() {
    keeps_lengths("881");
}

fn keeps_lengths(seed: &str) {
    let figures = creased_gesture(seed);
    let strain = figures["edge_strain_worst"].as_f64().expect("a number");
    assert!(strain > 0.0 && strain < 0.01, "{strain}, seed {seed}");
}

/// Folded leaves that land through themselves, are pressed flat and opened anew, and land so again
/// stay pressed. They lay through themselves, 5 to 11 mm deep.
#[test]
fn folded_leaves_that_land_through_themselves_twice_lie_pressed() {
    lie_pressed(&["879"]);
}

/// They went through themselves before their folds were held shut in turns, and lay so.
#[test]
fn folded_leaves_that_stand_in_each_others_way_lie_clear_of_themselves() {
    let figures = creased_gesture("98");
    assert_eq!(figures["at_rest"], true);
    assert!(figures["at_rest_in_itself_mm"].as_f64() < Some(0.1));
}

#[test]
#[ignore = "long: make test-long"]
fn more_folded_leaves_that_land_through_themselves_twice_lie_pressed() {
    lie_pressed(&["204"]);
}

fn lie_pressed(seeds: &[&str]) {
    for seed in seeds {
        let figures = creased_gesture(seed);
        assert_eq!(figures["at_rest"], true);
        let deepest = figures["at_rest_in_itself_mm"].as_f64().expect("a number");
        assert!(deepest < 0.1, "{deepest} mm, seed {seed}");
        let in_flight = figures["drawn_penetration_in_itself_mm"].as_f64();
        assert!(in_flight > Some(1.0), "they went through themselves");
    }
}

/// The figures of one random gesture on folded leaves.
fn creased_gesture(seed: &str) -> Value {
    let figures = json(&[
        "gestures",
        "--creases",
        "--count",
        "1",
        "--json",
        "--seed",
        seed,
    ]);
    assert_eq!(figures["finite"], true);
    figures
}

#[test]
fn a_turn_reports_its_strains() {
    let paper = json(&[
        "turn",
        "--preset",
        "paper-2014",
        "--seconds",
        "11.4",
        "--json",
    ]);
    let strain = paper["max_edge_strain"].as_f64().expect("a number");
    assert!((strain - 1.0).abs() < 0.1, "{strain}");
    let corner = &[
        "turn",
        "--preset",
        "book",
        "--gesture",
        "corner",
        "--seconds",
        "0.8",
        "--json",
    ];
    let book = json(corner);
    for key in ["max_edge_strain", "min_edge_strain"] {
        assert!(book[key].as_f64().expect("a number").abs() <= 0.01);
    }
    for key in [
        "max_surface_strain",
        "steps",
        "us_per_step",
        "us_per_surface",
    ] {
        assert!(book[key].is_number(), "{key}");
    }
    assert_eq!(book["finite"], Value::Bool(true));
    assert_eq!(book["hash"].as_str().map(str::len), Some(16));
}

#[test]
fn options_change_the_turn() {
    let hash = |more: &[&str]| {
        json(&[&["turn", "--seconds", "1", "--settle", "0", "--json"], more].concat())["hash"]
            .clone()
    };
    let plain = hash(&[]);
    for more in [
        &["--sync", "off"][..],
        &["--gesture", "corner", "--sync", "paper"],
        &["--gesture", "corner-alone"],
        &["--no-interpolation"],
        &["--integrator", "runge-kutta-4"],
        &["--gesture", "corner"],
    ] {
        assert_ne!(hash(more), plain, "{more:?}");
    }
    assert_eq!(hash(&[]), plain);
}

#[test]
fn table_1_has_its_rows_and_means() {
    let table = json(&["table1", "--runs", "2", "--json"]);
    let runs = table["runs"].as_array().expect("rows");
    assert_eq!(runs.len(), 2);
    for key in ["live_ms", "replay_ms"] {
        assert!(
            runs.iter()
                .all(|run| run[key].as_f64().is_some_and(|ms| ms > 0.0))
        );
    }
    for key in ["mean_live_ms", "mean_replay_ms", "reduction_percent"] {
        assert!(table[key].is_number(), "{key}");
    }
    // The third row: how much faster a replay is than the live turn.
    let number = |of: &Value, key: &str| of[key].as_f64().expect("a number");
    for run in runs {
        let ratio = number(run, "live_ms") / number(run, "replay_ms");
        assert!((number(run, "speed_ratio") - ratio).abs() < 1e-9);
    }
    let ratio = number(&table, "mean_live_ms") / number(&table, "mean_replay_ms");
    assert!((number(&table, "speed_ratio") - ratio).abs() < 1e-9);
    let printed = lab(&["table1", "--runs", "1", "--seconds", "1"]).stdout;
    let printed = String::from_utf8(printed).expect("text");
    assert!(printed.contains("ratio of speeds"), "{printed}");
    assert!(
        printed.contains("15.1 % saved, a ratio of 1.177"),
        "{printed}"
    );
}

#[test]
fn both_readings_of_synchronisation_are_compared() {
    let found = json(&["synchronisation", "--seconds", "4", "--json"]);
    let rows = found["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 12);
    let figure = |turn: &str, reading: &str, name: &str| {
        let row = rows
            .iter()
            .find(|r| r["turn"] == turn && r["reading"] == reading);
        row.expect("a row")[name].as_f64().expect("a number")
    };
    let (columns, words) = ("preset: columns", "paper's words");
    // Where the whole column is moved the two are one.
    for name in ["max_edge_strain", "min_edge_strain", "from_classic"] {
        let [a, b] = [columns, words].map(|reading| figure("whole column", reading, name));
        assert!((a - b).abs() < 1e-3, "{name}: {a} {b}");
    }
    for turn in ["whole column", "column, foot first", "foot corner alone"] {
        // Only the paper's words move what is fixed and held.
        for reading in ["none", columns, "preset: 45°"] {
            assert!(
                figure(turn, reading, "from_spine") < 1e-6,
                "{turn}, {reading}"
            );
            assert!(
                figure(turn, reading, "from_hand") < 1e-5,
                "{turn}, {reading}"
            );
        }
    }
    assert!(figure("whole column", words, "from_hand") < 1e-5);
    for turn in ["column, foot first", "foot corner alone"] {
        assert!(figure(turn, words, "from_spine") > 1e-4, "{turn}");
        assert!(figure(turn, words, "from_hand") > 0.1, "{turn}");
    }
}

#[test]
fn the_figures_of_the_paper_have_their_counterparts() {
    let folder = std::env::temp_dir().join(format!("lab-figures-{}", std::process::id()));
    let out = folder.to_str().expect("a path of text");
    let report = json(&[
        "picture",
        "--figures",
        "--out",
        out,
        "--size",
        "240",
        "--json",
    ]);
    let files = report["files"].as_array().expect("files");
    assert_eq!(files.len(), 5);
    for (index, file) in files.iter().enumerate() {
        let bytes = std::fs::read(file.as_str().expect("a path")).expect("a file");
        let start: &[u8] = if index < 4 { b"\x89PNG" } else { b"<svg" };
        assert!(bytes.starts_with(start), "{file}");
        assert!(bytes.len() > 1500, "{file}");
    }
    let flow = std::fs::read_to_string(folder.join("figure-5.svg")).expect("text");
    for step in ["36 masses and 158 springs", "Synchronise", "676 points"] {
        assert!(flow.contains(step), "{step}");
    }
    std::fs::remove_dir_all(folder).expect("removed");
}

#[test]
fn pictures_are_written() {
    let folder = std::env::temp_dir().join(format!("lab-pictures-{}", std::process::id()));
    let out = folder.to_str().expect("a path of text");
    let report = json(&[
        "picture",
        "--out",
        out,
        "--frames",
        "2",
        "--size",
        "160",
        "--seconds",
        "1",
        "--json",
    ]);
    let files = report["files"].as_array().expect("files");
    assert_eq!(files.len(), 3);
    for file in files {
        let bytes = std::fs::read(file.as_str().expect("a path")).expect("a file");
        assert!(bytes.starts_with(b"\x89PNG"));
    }
    std::fs::remove_dir_all(folder).expect("removed");
}

#[test]
fn ways_to_interpolate_have_every_figure() {
    let folder = std::env::temp_dir().join(format!("lab-into-{}", std::process::id()));
    let into = folder.join("data");
    let path = into.to_str().expect("a path of text");
    let report = json(&["interpolation", "--json", "--into", path]);
    assert!(into.join("interpolation_6x6.json").is_file());
    std::fs::remove_dir_all(folder).expect("removed");
    let grids = report["grids"].as_array().expect("grids");
    assert_eq!(grids.len(), 2);
    for grid in grids {
        let ways = grid["ways"].as_array().expect("ways");
        let named = |name: &str| {
            let way = ways.iter().find(|way| way["name"] == name);
            way.unwrap_or_else(|| panic!("no {name}"))
        };
        for way in ways {
            for figure in ["us_per_surface", "overshoot", "curvature_jump"] {
                assert!(way[figure].as_f64().is_some_and(|x| x > 0.0), "{figure}");
            }
        }
        let strain = |name: &str| {
            let figure = &named(name)["shapes"]["half turn"]["strain_error"];
            figure.as_f64().expect("a number")
        };
        // The same surface, and better nodes are better.
        assert!((strain("spline") - strain("b-spline")).abs() < 1e-4);
        assert!(strain("barycentric") < strain("lagrange"));
        assert!(strain("spline") < strain("hermite"));
    }
}

#[test]
fn a_recorded_turn_is_small_and_near() {
    for gesture in ["corner", "edge", "let-go"] {
        let found = json(&["keyframes", "--gesture", gesture, "--json"]);
        assert_eq!(found["model"], "sheet");
        assert_eq!(found["points"], serde_json::json!([26, 26]));
        let [bytes, error, stated] =
            ["bytes", "error", "stated_error"].map(|name| found[name].as_f64().expect("a number"));
        assert!(bytes < 20_000.0, "{gesture}: {bytes}");
        assert!(
            error <= 0.001 && (error - stated).abs() < 1e-6,
            "{gesture}: {error}"
        );
    }
}

#[test]
fn a_replayed_sheet_takes_a_fraction_of_the_time() {
    let turn = ["--seconds", "0.8", "--keys", "condensed", "--runs", "1"];
    let found = json(&[&["table1", "--model", "sheet", "--json"], &turn[..]].concat());
    let figure = |name: &str| found[name].as_f64().expect("a number");
    assert!(figure("replay_error") <= 0.001);
    assert!(figure("mean_live_ms") > 20.0 * figure("mean_replay_ms"));
}

#[test]
fn the_turns_that_come_with_the_viewer_are_recorded_again() {
    let turns = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../packages/turnleaf/src/leaf_models/turns"
    );
    let commands: [&[&str]; 2] = [
        &["--model", "sheet"],
        &["--model", "shell", "--nodes", "17"],
    ];
    for model in commands {
        let name = format!("{}_turn.tlkf", model[1]);
        let out = std::env::temp_dir().join(format!("{}-{name}", std::process::id()));
        let path = out.to_str().expect("a name");
        let mut arguments = vec!["keyframes", "--gesture", "edge", "--seconds", "1.2"];
        arguments.extend(["--settle", "0.3", "--json", "--out", path]);
        arguments.extend(model);
        let figures = json(&arguments);
        let bytes = std::fs::read(&out).expect("written");
        std::fs::remove_file(&out).expect("removed");
        assert!(figures["error"].as_f64().expect("a number") <= 0.001);
        assert!(bytes.len() <= 20_000, "{}", bytes.len());
        let shipped = std::fs::read(format!("{turns}/{name}")).expect("it comes with the viewer");
        assert!(bytes == shipped, "{name} is another: run make recordings");
    }
}
