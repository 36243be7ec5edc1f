use super::*;

/// Rows of a table of exact solutions, worked out by other means.
fn rows(table: &str) -> Vec<Vec<f64>> {
    let path = format!(
        "{}/../engine/tests/anchors/{table}.csv",
        env!("CARGO_MANIFEST_DIR")
    );
    let text = std::fs::read_to_string(path).expect("the table is there");
    let number = |cell: &str| match cell {
        "rigid" => f64::INFINITY,
        _ => cell.parse().expect("a number"),
    };
    let row = |line: &str| line.split(',').map(number).collect();
    text.lines().skip(1).map(row).collect()
}

fn assert_near(found: f64, exact: f64, tolerance: f64, what: &str) {
    assert!(
        (found - exact).abs() <= tolerance,
        "{what}: {found}, not {exact}"
    );
}

#[test]
fn a_level_strip_hangs_as_in_the_table() {
    for row in rows("heavy_elastica") {
        let strip = Elastica {
            gamma: row[0],
            load: 0.0,
            clamp_angle: 0.0,
        };
        let hanging = strip.hanging();
        let what = format!("Gamma {}", row[0]);
        assert_near(hanging.reach, row[1], 1e-5, &what);
        assert_near(hanging.drop, row[2], 1e-5, &what);
        assert_near(-hanging.tip_angle.to_degrees(), row[4], 1e-5 * 57.3, &what);
    }
}

#[test]
fn a_strip_clamped_at_an_angle_hangs_as_in_the_table() {
    for row in rows("heavy_elastica_clamp_angle") {
        let strip = Elastica {
            gamma: row[0],
            load: 0.0,
            clamp_angle: row[1].to_radians(),
        };
        let hanging = strip.hanging();
        let what = format!("Gamma {} at {} degrees", row[0], row[1]);
        assert_near(hanging.reach, row[2], 1e-5, &what);
        assert_near(-hanging.drop, row[3], 1e-5, &what);
        assert_near(hanging.tip_angle.to_degrees(), row[4], 1e-5 * 57.3, &what);
    }
}

#[test]
fn a_strip_clamped_backward_is_the_mirror_image() {
    let strip = |degrees: f64| Elastica {
        gamma: 4.0,
        load: 0.0,
        clamp_angle: degrees.to_radians(),
    };
    let (front, back) = (strip(45.0).hanging(), strip(135.0).hanging());
    assert_near(back.reach, -front.reach, 1e-9, "reach");
    assert_near(back.drop, front.drop, 1e-9, "drop");
}

#[test]
fn a_loaded_tip_comes_down_as_in_the_table() {
    for row in rows("bisshopp_drucker") {
        let strip = Elastica {
            gamma: 0.0,
            load: row[0],
            clamp_angle: 0.0,
        };
        let hanging = strip.hanging();
        let what = format!("load {}", row[0]);
        assert_near(hanging.drop, row[2], 1e-5, &what);
        assert_near(1.0 - hanging.reach, row[3], 1e-5, &what);
        let slope = -hanging.tip_angle / core::f64::consts::FRAC_PI_2;
        assert_near(slope, row[1], 1e-5, &what);
    }
}

#[test]
fn single_figures_are_those_of_the_books() {
    assert_near(upright_gamma(), 7.837347, 1e-6, "upright");
    let pear = pear_loop();
    assert_near(pear.height, 0.424308, 1e-6, "height");
    assert_near(pear.width, 0.204214, 1e-6, "width");
    let roots = vibration_roots();
    for (root, exact) in roots.iter().zip([1.875104, 4.694091, 7.854757]) {
        assert_near(*root, exact, 1e-6, "root");
    }
}

#[test]
fn a_creased_strip_hangs_as_in_the_table() {
    let table = rows("creased_elastica");
    for row in &table {
        // Where the crease turns beyond half a turn as the weight grows, the strip
        // goes through itself, and several are at rest from there on.
        let lighter = |other: &&Vec<f64>| other[1..4] == row[1..4] && other[0] < row[0];
        if table
            .iter()
            .filter(lighter)
            .any(|other| other[7].abs() > 180.0)
        {
            continue;
        }
        let strip = CreasedElastica {
            gamma: row[0],
            at: row[1],
            rest: row[2].to_radians(),
            stiffness: row[3],
        };
        let hanging = strip.hanging().expect("it hangs");
        let what = format!("{row:?}");
        assert_near(hanging.reach, row[4], 1e-5, &what);
        assert_near(hanging.drop, row[5], 1e-5, &what);
        assert_near(hanging.tip_angle.to_degrees(), row[6], 1e-5 * 57.3, &what);
        // The table's rigid crease is a very stiff one.
        let tolerance = if row[3].is_finite() {
            1e-5 * 57.3
        } else {
            1e-3
        };
        let crease_angle = hanging.crease_angle.to_degrees();
        assert_near(crease_angle, row[7], tolerance, &what);
    }
}
