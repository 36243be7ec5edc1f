//! Exact solutions that tests are held against: the tables of `engine/tests/anchors`.

/// Rows of figures of a table, without its heading; infinite where it says rigid.
pub(crate) fn rows(csv: &str) -> Vec<Vec<f64>> {
    let number = |figure: &str| match figure {
        "rigid" => f64::INFINITY,
        _ => figure.parse().expect("the table has numbers"),
    };
    let row = |line: &str| line.trim().split(',').map(number).collect();
    csv.lines().skip(1).map(row).collect()
}

/// The creased strips that do not go through themselves as they grow heavier: gamma, place,
/// rest in degrees, stiffness, reach, drop, and angles of tip and crease in degrees.
pub(crate) fn creased_strips() -> Vec<Vec<f64>> {
    let all = rows(include_str!("../tests/anchors/creased_elastica.csv"));
    let goes_through = |strip: &Vec<f64>| {
        let is_lighter = |other: &&Vec<f64>| other[1..4] == strip[1..4] && other[0] <= strip[0];
        all.iter()
            .filter(is_lighter)
            .any(|other| other[7].abs() > 180.0)
    };
    all.iter()
        .filter(|strip| !goes_through(strip))
        .cloned()
        .collect()
}
