//! Cost against fidelity, as an SVG picture.

use serde_json::Value;

/// Size of the picture, and the margins of its field: left, top, right, bottom.
const SIZE: [f64; 2] = [860.0, 520.0];
const MARGINS: [f64; 4] = [74.0, 24.0, 24.0, 58.0];

/// One way.
struct Dot {
    name: String,
    cost: f64,
    away: f64,
}

/// The plot: across what a frame costs, upward how far the leaf is from the
/// shell's, both on logarithmic scales.
pub fn svg(figures: &Value) -> String {
    let ways = figures["ways"].as_array().into_iter().flatten();
    let dots: Vec<Dot> = ways
        .filter(|way| way["measured"] == true && way["reference"] != true)
        .filter_map(|way| {
            Some(Dot {
                name: way["name"].as_str()?.to_string(),
                cost: way["us_per_frame"].as_f64()?,
                away: 100.0 * way["rms"].as_f64()?,
            })
        })
        .collect();
    let decades = |of: &dyn Fn(&Dot) -> f64| {
        let low = dots.iter().map(of).fold(f64::MAX, f64::min).log10().floor();
        let high = dots.iter().map(of).fold(f64::MIN, f64::max).log10().ceil();
        (low as i32, high as i32)
    };
    let (costs, aways) = (decades(&|dot| dot.cost), decades(&|dot| dot.away));
    let [left, top, right, bottom] = MARGINS;
    let x = |cost: f64| {
        let part = (cost.log10() - f64::from(costs.0)) / f64::from(costs.1 - costs.0);
        left + part * (SIZE[0] - left - right)
    };
    let y = |away: f64| {
        let part = (away.log10() - f64::from(aways.0)) / f64::from(aways.1 - aways.0);
        SIZE[1] - bottom - part * (SIZE[1] - top - bottom)
    };
    let mut parts = vec![format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"#403c36\">\n<rect width=\"100%\" height=\"100%\" fill=\"#f4f2ee\"/>",
        SIZE[0], SIZE[1]
    )];
    for decade in costs.0..=costs.1 {
        let at = x(10f64.powi(decade));
        parts.push(line(at, top, at, SIZE[1] - bottom));
        let label = number(10f64.powi(decade));
        parts.push(text(at, SIZE[1] - bottom + 20.0, "middle", &label));
    }
    for decade in aways.0..=aways.1 {
        let at = y(10f64.powi(decade));
        parts.push(line(left, at, SIZE[0] - right, at));
        let label = format!("{} %", number(10f64.powi(decade)));
        parts.push(text(left - 8.0, at + 4.0, "end", &label));
    }
    parts.push(text(
        0.5 * (left + SIZE[0] - right),
        SIZE[1] - 12.0,
        "middle",
        "microseconds a frame",
    ));
    parts.push(format!(
        "<text transform=\"translate(18 {}) rotate(-90)\" text-anchor=\"middle\">RMS distance from the shell, over the width</text>",
        0.5 * (top + SIZE[1] - bottom)
    ));
    let mut taken: Vec<[f64; 2]> = Vec::new();
    for dot in &dots {
        let at = [x(dot.cost), y(dot.away)];
        parts.push(format!(
            "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"5\" fill=\"#b5482f\"/>",
            at[0], at[1]
        ));
        let right_half = at[0] > 0.62 * SIZE[0];
        let (anchor, side) = if right_half {
            ("end", -10.0)
        } else {
            ("start", 10.0)
        };
        let mut label = [at[0] + side, at[1] + 4.0];
        // Names that would lie on one another go below one another.
        while taken
            .iter()
            .any(|other| (other[1] - label[1]).abs() < 14.0 && (other[0] - label[0]).abs() < 170.0)
        {
            label[1] += 15.0;
        }
        taken.push(label);
        parts.push(text(label[0], label[1], anchor, &dot.name));
    }
    parts.push("</svg>\n".into());
    parts.join("\n")
}

fn line(x1: f64, y1: f64, x2: f64, y2: f64) -> String {
    format!("<path d=\"M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}\" stroke=\"#d8d3ca\" stroke-width=\"1\"/>")
}

fn text(x: f64, y: f64, anchor: &str, words: &str) -> String {
    format!("<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{words}</text>")
}

/// A power of ten in figures.
fn number(value: f64) -> String {
    if value >= 1.0 {
        format!("{value:.0}")
    } else {
        format!("{value}")
    }
}
