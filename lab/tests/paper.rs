//! The experiments on a piece of paper, and how near each model must come to
//! the exact solutions.

use std::process::Command;

use serde_json::Value;
use turnleaf_engine::Stock;

fn lab(line: &str) -> Value {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lab"));
    let output = command
        .args(line.split(' '))
        .arg("--json")
        .output()
        .expect("lab runs");
    let sentence = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{line}: {sentence}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// The figure at a path of an experiment.
fn figure(found: &Value, path: &str) -> f64 {
    let value = path.split('.').fold(found, |value, name| &value[name]);
    value
        .as_f64()
        .unwrap_or_else(|| panic!("{path} of {found}"))
}

fn assert_within(line: &str, paths: &[&str], most: f64) {
    let found = lab(line);
    for path in paths {
        let error = figure(&found, path);
        assert!(
            error.abs() <= most,
            "{line}: {path} is {error}, beyond {most}"
        );
    }
    if let Some(strain) = found["max_edge_strain"].as_f64() {
        assert!(strain < 1e-3, "{line}: strain {strain}");
    }
}

#[test]
fn a_sheet_hangs_as_paper_does() {
    for gamma in [1, 10, 100] {
        for settings in ["book", "lab"] {
            let line = format!("cantilever --gamma {gamma} --settings {settings}");
            assert_within(&line, &["error.drop", "error.tip"], 0.01);
        }
    }
    for gamma in ["0.1", "3", "30", "300", "1000"] {
        let line = format!("cantilever --gamma {gamma} --settings lab");
        assert_within(&line, &["error.drop", "error.tip"], 0.02);
    }
    for (gamma, angle) in [("0.5", 60), ("4", 75), ("10", 90), ("30", -30), ("15", 135)] {
        let line = format!("cantilever --gamma {gamma} --clamp-angle {angle} --settings lab");
        assert_within(&line, &["error.tip"], 0.02);
    }
}

#[test]
fn a_shell_hangs_as_paper_does() {
    for gamma in ["0.1", "1", "10", "100", "1000"] {
        let line = format!("cantilever --model shell --gamma {gamma}");
        assert_within(&line, &["error.drop", "error.tip"], 0.002);
    }
    for (gamma, angle) in [("4", 75), ("10", 90), ("30", -30)] {
        let line = format!("cantilever --model shell --gamma {gamma} --clamp-angle {angle}");
        assert_within(&line, &["error.tip"], 0.005);
    }
}

/// Rows that are in no table of exact solutions too.
#[test]
fn a_creased_strip_hangs_as_paper_does() {
    hang_creased_strips(&[("8", "0.3", "-60", None), ("60", "0.7", "-30", Some("0.5"))]);
}

#[test]
#[ignore = "long: make test-long"]
fn more_creased_strips_hang_as_paper_does() {
    hang_creased_strips(&[
        ("0.5", "0.4", "45", Some("2")),
        ("25", "0.6", "90", Some("3")),
    ]);
}

/// Hangs strips of a load, creased at a place, at rest at an angle, of a stiffness if they have any.
fn hang_creased_strips(rows: &[(&str, &str, &str, Option<&str>)]) {
    for &(gamma, at, rest, stiffness) in rows {
        let stiffness = stiffness.map_or(String::new(), |k| format!(" --stiffness {k}"));
        let limp = gamma == "60";
        let sheet = if limp { (0.02, 2.0) } else { (0.01, 1.0) };
        for (model, (most, degrees)) in [("shell", (0.002, 0.2)), ("sheet", sheet)] {
            let line = format!(
                "crease --model {model} --gamma {gamma} --at {at} --rest {rest}{stiffness}"
            );
            assert_within(&line, &["error.reach", "error.drop"], most);
            let angles = ["error.tip_angle_deg", "error.crease_angle_deg"];
            assert_within(&line, &angles, degrees);
        }
    }
}

#[test]
fn a_loaded_tip_comes_down() {
    for (model, most) in [("sheet", 0.02), ("shell", 0.005)] {
        for load in ["0.1", "1", "5"] {
            let line = format!("tip-load --model {model} --load {load}");
            assert_within(&line, &["error.w", "error.u"], most);
        }
    }
}

/// The shell has fewer nodes than the command gives it of itself.
#[test]
fn a_loop_of_two_ends_is_a_pear() {
    loops_are_pears([("sheet", 0.02), ("shell --nodes 33", 0.005)]);
}

#[test]
#[ignore = "long: make test-long"]
fn a_fine_loop_of_two_ends_is_a_pear() {
    loops_are_pears([("shell", 0.005)]);
}

fn loops_are_pears<const N: usize>(models: [(&str, f64); N]) {
    for (model, most) in models {
        let line = format!("pear-loop --model {model}");
        assert_within(&line, &["error.height", "error.width"], most);
    }
}

/// By fewer nodes than the command has of itself.
#[test]
fn paper_in_a_funnel_is_lifted_over_one_sector() {
    for slope in ["0.1", "0.2"] {
        let line = format!("d-cone --model shell --nodes 96 --slope {slope}");
        assert_within(&line, &["error.sector_deg"], 4.0);
    }
}

/// By fewer cells than the command has of itself, which is within 0.05.
#[test]
fn the_energy_of_a_ridge_grows_with_its_length() {
    assert_within("ridge --cells 12", &["error.exponent"], 0.08);
}

/// By a coarser mesh and fewer tears than the command has of itself.
#[test]
fn legs_are_pulled_apart_by_half_the_work_of_fracture() {
    let line = "trouser --cells 2 --edges 3 --long 2 --fracture 20 --leg 5";
    let found = lab(line);
    let exact = figure(&found, "exact.force_n");
    for path in ["force_n", "at_grips_n"] {
        let error = figure(&found, path) / exact - 1.0;
        assert!(error.abs() <= 0.05, "{line}: {path} is off by {error}");
    }
    assert_eq!(found["aside"], 0, "{line}");
}

#[test]
fn what_stands_falls_over_at_its_weight() {
    assert_within("upright", &["error.gamma_critical"], 0.02);
    assert_within("upright --model shell", &["error.gamma_critical"], 0.005);
    // Ritz's method, about a thousandth.
    for (model, most) in [("sheet", 0.05), ("shell", 0.01)] {
        let found = lab(&format!(
            "lateral-buckling --model {model} --nu 0.3 --aspect 0.5"
        ));
        let error = figure(&found, "gamma_critical") / 21.60207 - 1.0;
        assert!(error.abs() <= most, "{model}: {error}");
    }
}

/// Of book paper, with the settings of a viewer's book, whose leaf has fewer columns, and with the lab's.
#[test]
fn a_strip_vibrates_at_its_pitches_and_swings_as_long_as_paper_does() {
    for (settings, most) in [("book", [0.005, 0.02, 0.06]), ("lab", [0.005, 0.02, 0.05])] {
        let found = lab(&format!("vibration --stock book --settings {settings}"));
        assert_roots(&found, most);
        assert_damping(&found);
    }
    assert_roots(&lab("vibration --model shell"), [0.001; 3]);
    assert_damping(&lab("vibration --stock card --settings book"));
}

#[test]
#[ignore = "long: make test-long"]
fn a_page_of_card_swings_as_long_with_the_settings_of_the_lab() {
    assert_damping(&lab("vibration --stock card --settings lab"));
}

fn assert_roots(found: &Value, most: [f64; 3]) {
    for (mode, most) in most.iter().enumerate() {
        let error = found["error"]["roots"][mode].as_f64().expect("a number");
        assert!(error.abs() <= *most, "mode {mode}: {found}");
    }
}

/// Asserts the damping of a page's first mode in a vacuum, as part of critical: half of the
/// loss tangent. Bible paper has more: see docs/reports/physics.md.
fn assert_damping(found: &Value) {
    let damping = figure(found, "damping");
    assert!((damping - 0.015).abs() <= 0.005, "{found}");
}

#[test]
fn a_level_sheet_falls_at_its_speed() {
    for stock in Stock::NAMES.iter().filter(|name| **name != "board") {
        let line = format!("drop-sheet --stock {stock}");
        assert_within(&line, &["error.terminal_speed"], 0.02);
    }
    // On the Moon and on Jupiter.
    for gravity in ["1.62", "24.79"] {
        let line = format!("drop-sheet --stock book --gravity {gravity}");
        assert_within(&line, &["error.terminal_speed"], 0.02);
    }
}

#[test]
fn a_shell_keeps_its_energy() {
    assert_within("energy --model shell --periods 10", &["drift"], 0.01);
    // The interactive sheet's quick modes are damped: it loses, and never gains.
    let drift = figure(&lab("energy"), "drift");
    assert!((-1.0..=0.0).contains(&drift), "{drift}");
}

#[test]
fn refinement_is_of_second_order() {
    let shell = lab("convergence --model shell");
    assert!(figure(&shell, "order") >= 1.8, "{shell}");
    assert!(figure(&shell, "order_in_time") >= 1.8, "{shell}");
    let sheet = lab("convergence --model sheet");
    assert!(figure(&sheet, "order") >= 1.8, "{sheet}");
}

/// A leaf with the settings of a viewer's book.
#[test]
fn the_sheet_turns_as_the_shell_does() {
    assert_agree("book", 0.05);
}

#[test]
#[ignore = "long: make test-long"]
fn a_sheet_of_card_turns_as_the_shell_does() {
    assert_agree("card", 0.1);
}

fn assert_agree(stock: &str, most: f64) {
    let found = lab(&format!("agree --stock {stock} --jobs 2"));
    assert_eq!(found["settings"], "book");
    for by in ["corner", "edge"] {
        let worst = figure(&found, &format!("{by}.worst"));
        assert!(worst <= most, "{stock} by the {by}: {worst}");
        let shear = figure(&found, &format!("{by}.shear_degrees"));
        assert!(shear <= 1.0, "{stock} by the {by}: {shear} degrees");
        let stretch = figure(&found, &format!("{by}.diagonal_stretch"));
        assert!(stretch <= 0.005, "{stock} by the {by}: {stretch}");
        // At the end both lie on the left.
        let samples = found[by]["by_time"].as_array().expect("samples");
        let last = figure(samples.last().expect("a sample"), "worst");
        assert!(last < 0.005, "{stock} by the {by}: {last}");
    }
}

/// What pointers can do to paper: a sample of what `make gestures` plays, which takes half an hour.
#[test]
fn gestures_neither_stretch_paper_nor_push_it_through_paper() {
    play_usual_gestures(50);
}

#[test]
#[ignore = "long: make test-long"]
fn many_gestures_neither_stretch_paper_nor_push_it_through_paper() {
    play_usual_gestures(250);
}

fn play_usual_gestures(count: usize) {
    let found = lab(&format!(
        "gestures --count {count} --seed 1 --kind hands --page usual --stock presets"
    ));
    assert_eq!(found["finite"], Value::Bool(true));
    for (name, most) in [
        ("edge_strain_median", 0.003),
        ("edge_strain_p99", 0.01),
        ("edge_strain_worst", 0.05),
        ("edge_strain_after_release", 0.001),
        ("solver_penetration_mm", 3.0),
        ("drawn_penetration_in_leaves_mm", 0.1),
        ("drawn_penetration_in_piles_mm", 0.1),
        ("seconds_to_rest_worst", 4.0),
    ] {
        let value = figure(&found, name);
        assert!(value <= most, "{name} is {value}, beyond {most}");
    }
}

/// Pages, papers, air, frames and pointers of every kind; 20,000 are in docs/reports/physics.md.
#[test]
fn gestures_of_every_kind_on_any_page_stay_finite_come_to_rest_and_out_of_each_other() {
    play_every_kind(4, 1);
}

#[test]
#[ignore = "long: make test-long"]
fn more_gestures_of_every_kind_stay_finite_come_to_rest_and_out_of_each_other() {
    play_every_kind(12, 3);
}

/// Plays so many gestures of each kind, and so many riffles.
fn play_every_kind(gestures: usize, riffles: usize) {
    let kinds = ["hands", "teleport", "circle", "pin", "apart", "mixed"];
    let counts = kinds.map(|kind| (kind, gestures));
    for (kind, count) in counts.into_iter().chain([("riffle", riffles)]) {
        let found = lab(&format!(
            "gestures --count {count} --seed 101 --kind {kind}"
        ));
        assert_eq!(found["finite"], Value::Bool(true), "{kind}");
        assert_eq!(found["at_rest"], Value::Bool(true), "{kind}");
        for (name, most) in [
            ("edge_strain_worst", 0.01),
            ("edge_strain_eased", 0.03),
            ("drawn_penetration_in_leaves_mm", 0.1),
            ("drawn_penetration_in_piles_mm", 0.1),
            ("drawn_penetration_in_itself_mm", 0.1),
            ("update_work_worst", 5e6),
        ] {
            let value = figure(&found, name);
            assert!(value <= most, "{kind}: {name} is {value}, beyond {most}");
        }
    }
}

/// Folded and torn leaves; what they keep of the bounds of whole ones is in docs/reports/folding.md.
#[test]
fn gestures_fold_and_tear_leaves_and_all_stays_finite() {
    let line = "gestures --creases --count 6 --seed 1 --page usual --stock presets --kind hands";
    let found = lab(line);
    assert_eq!(found["finite"], Value::Bool(true));
    assert!(figure(&found, "folds_made") >= 6.0);
    assert!(figure(&found, "torn_work_off") < 1e-3);
    assert!(figure(&found, "torn_strain_worst") < 0.01);
    assert!(found["folds"]["dog-ears"].is_object());
}

/// A leaf that lies on the other side than it is bound for is turned over: these were once
/// put down through the spine.
#[test]
fn gestures_that_once_put_leaves_down_do_not() {
    for seed in [9, 11, 12] {
        let found = lab(&format!(
            "gestures --count 1 --seed {seed} --kind hands --page usual --stock card"
        ));
        assert_eq!(figure(&found, "put_down"), 0.0, "seed {seed}");
    }
}

/// The gesture of a seed on a page of the usual size, in still air.
fn usual_gesture(seed: u64) -> Value {
    lab(&format!(
        "gestures --count 1 --seed {seed} --kind hands --page usual --stock presets"
    ))
}

/// Gestures that drew leaves through each other once: taken up from right under a crumpled
/// one, played together or beside one in hand, touching by less than was looked for, at a
/// small angle or at their rims.
#[test]
fn gestures_that_once_drew_leaves_through_each_other_do_not() {
    // The last two drew a leaf through itself.
    for seed in [1452, 1524, 1590, 3150, 3, 7] {
        is_drawn_clear(&usual_gesture(seed));
    }
    // The last two are riffles: rims over rims, and one drawn through itself as others moved what
    // was held back of it.
    for seed in [5007, 5012, 910155, 3323, 2983] {
        is_drawn_clear(&any_gesture(seed));
    }
    is_drawn_clear(&preset_gesture(31000160));
    // Of books thicker than their pages are wide, whose piles once bent back over the spine.
    is_drawn_clear(&any_gesture(3837));
    is_drawn_clear(&preset_gesture(31000100));
}

#[test]
#[ignore = "long: make test-long"]
fn more_gestures_that_once_drew_leaves_through_each_other_do_not() {
    for seed in [
        1730, 2575, 5791, 5981, 8384, 10202, 12488, 12558, 12917, 15400,
    ] {
        is_drawn_clear(&usual_gesture(seed));
    }
    // Drawn through itself.
    for seed in [21, 40] {
        is_drawn_clear(&usual_gesture(seed));
    }
    for seed in [5031, 5034, 5036, 5082, 7300464, 7301398] {
        is_drawn_clear(&any_gesture(seed));
    }
    // Riffles: a fore-edge deep in the next leaf, which it crosses at a small angle.
    for seed in [987, 3797] {
        is_drawn_clear(&any_gesture(seed));
    }
    for seed in [31000484, 31000488] {
        is_drawn_clear(&preset_gesture(seed));
    }
    // Of books thicker than their pages are wide.
    for seed in [4417, 7300812] {
        is_drawn_clear(&any_gesture(seed));
    }
    for seed in [31000241, 31000365] {
        is_drawn_clear(&preset_gesture(seed));
    }
}

/// The gesture of a seed on any page, of any stock.
fn any_gesture(seed: u64) -> Value {
    lab(&format!("gestures --count 1 --seed {seed}"))
}

/// The gesture of a seed on any page of a stock that has a name.
fn preset_gesture(seed: u64) -> Value {
    lab(&format!("gestures --count 1 --seed {seed} --stock presets"))
}

/// Violent pointers on several leaves once sheared them by 14 to 29 degrees.
#[test]
fn leaves_are_sheared_little_however_many_fly() {
    shear_little([31000072, 31000079]);
}

#[test]
#[ignore = "long: make test-long"]
fn leaves_are_sheared_little_in_long_gestures() {
    shear_little([31000240, 31000355]);
}

fn shear_little(seeds: [u64; 2]) {
    for seed in seeds {
        let shear = figure(&preset_gesture(seed), "shear_worst_degrees");
        assert!(shear < 10.0, "seed {seed}: {shear} degrees");
    }
}

fn is_drawn_clear(found: &Value) {
    for name in ["leaves", "piles", "itself"] {
        let drawn = figure(found, &format!("drawn_penetration_in_{name}_mm"));
        assert!(drawn <= 0.1, "seed {}: {drawn} mm in {name}", found["seed"]);
    }
}

/// Leaves that take back what they did at every tick stand in the air until they are put
/// down; so these two did once, for a third of their frames.
#[test]
fn leaves_that_press_on_each_other_do_not_stand_still() {
    for seed in [1452, 2575] {
        let found = usual_gesture(seed);
        let behind = figure(&found, "frames_behind_fraction");
        assert!(behind < 0.05, "seed {seed}: {behind} of the frames");
    }
}

/// Stiffer than single precision bears, leaves were thrown about: edges grew to 1,400 times
/// their length.
#[test]
fn the_stiffest_and_lightest_leaves_keep_their_lengths() {
    for seed in [20000061, 20000065, 20000086, 20000131] {
        let found = lab(&format!("gestures --count 1 --seed {seed} --stock extreme"));
        let strain = figure(&found, "edge_strain_worst");
        assert!(strain < 0.01, "seed {seed}: {strain}");
    }
}

#[test]
fn gestures_are_repeated_by_their_seed() {
    let line = "gestures --count 4 --seed 7 --stock card --kind hands";
    let (first, second) = (lab(line), lab(&format!("{line} --jobs 3 --model sheet")));
    for name in [
        "edge_strain_median",
        "edge_strain_p99",
        "edge_strain_worst",
        "edge_strain_after_release",
        "drawn_penetration_mm",
        "solver_penetration_mm",
        "seed",
    ] {
        assert!(first[name].is_number(), "{name}");
        assert_eq!(first[name], second[name], "{name}");
    }
    assert_eq!(first["finite"], Value::Bool(true));
    for name in ["us_per_frame_p50", "us_per_frame_p99"] {
        assert!(figure(&first, name) > 0.0);
    }
}

#[test]
fn what_a_model_cannot_do_it_says() {
    let wrong = [
        "tip-load --model mass-spring --load 1",
        "pear-loop --model mass-spring",
        "drop-sheet --model mass-spring --stock book",
        "lateral-buckling --model mass-spring --nu 0.3 --aspect 0.5",
        "cantilever",
        "cantilever --gamma nothing",
        "cantilever --gamma 1 --nodes 2",
        "cantilever --gamma 1 --nodes 400",
        "drop-sheet --stock vellum",
        "drop-sheet --stock book --gravity 0",
        "tip-load",
        "agree --model shell",
        "agree --settings paper",
        "cantilever --gamma 1 --model shell --settings lab",
        "gestures --model mass-spring",
        "gestures --count 0",
    ];
    for line in wrong {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lab"));
        let output = command.args(line.split(' ')).output().expect("lab runs");
        assert_eq!(output.status.code(), Some(2), "{line}");
        let sentence = String::from_utf8(output.stderr).expect("text");
        assert!(sentence.trim_end().ends_with('.'), "{line}: {sentence}");
        assert_eq!(sentence.trim_end().lines().count(), 1, "{line}: {sentence}");
        assert!(output.stdout.is_empty());
    }
}
