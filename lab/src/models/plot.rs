//! Cost against fidelity, as an SVG picture.

use super::measure::Figures;

/// Size of the picture, and the margins of its field: left, top, right, bottom.
const SIZE: [f64; 2] = [860.0, 520.0];
const MARGINS: [f64; 4] = [74.0, 24.0, 24.0, 58.0];

/// One way.
struct Dot {
    name: &'static str,
    cost: f64,
    away: f64,
}

/// The plot: across what a frame costs, upward how far the leaf is from the
/// shell's, both on logarithmic scales.
pub fn svg(ways: &[Figures]) -> String {
    let dots = ways.iter().filter(|way| !way.reference).map(|way| Dot {
        name: way.name,
        cost: way.us_per_frame,
        away: 100.0 * way.rms,
    });
    draw(&dots.collect::<Vec<_>>())
}

fn draw(dots: &[Dot]) -> String {
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
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"#403c36\">\n<title>Cost of a frame against distance from the shell, by model</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#f4f2ee\"/>",
        SIZE[0], SIZE[1]
    )];
    for decade in costs.0..=costs.1 {
        let at = x(10f64.powi(decade));
        parts.push(line(at, top, at, SIZE[1] - bottom));
        let label = number(10f64.powi(decade));
        let anchor = if decade == costs.1 { "end" } else { "middle" };
        parts.push(text(at, SIZE[1] - bottom + 20.0, anchor, &label));
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
    let places: Vec<[f64; 2]> = dots.iter().map(|dot| [x(dot.cost), y(dot.away)]).collect();
    let mut taken: Vec<[f64; 4]> = places
        .iter()
        .map(|[x, y]| [x - 6.0, y - 6.0, x + 6.0, y + 6.0])
        .collect();
    for (dot, [at_x, at_y]) in dots.iter().zip(&places) {
        parts.push(format!(
            "<circle cx=\"{at_x:.1}\" cy=\"{at_y:.1}\" r=\"5\" fill=\"#b5482f\"/>"
        ));
        let label = place_label([*at_x, *at_y], dot.name, &taken);
        if (label.y - at_y).abs() > 10.0 {
            parts.push(format!(
                "<path d=\"M{:.1} {:.1}L{at_x:.1} {at_y:.1}\" stroke=\"#b5482f\" stroke-width=\"0.7\"/>",
                label.x, label.y
            ));
        }
        taken.push(label.covers);
        let anchor = if label.leftward { "end" } else { "start" };
        parts.push(text(label.x, label.y + 4.0, anchor, dot.name));
    }
    parts.push("</svg>\n".into());
    parts.join("\n")
}

/// Where a name stands.
struct Label {
    x: f64,
    y: f64,
    leftward: bool,
    /// Left, top, right, bottom.
    covers: [f64; 4],
}

/// Puts a name beside its dot, or as little above or below as leaves what is
/// `taken` free.
fn place_label([x, y]: [f64; 2], name: &str, taken: &[[f64; 4]]) -> Label {
    let wide = 6.7 * name.len() as f64;
    let at = |apart: f64, leftward: bool| {
        let start = if leftward { x - 10.0 } else { x + 10.0 };
        let (left, right) = if leftward {
            (start - wide, start)
        } else {
            (start, start + wide)
        };
        Label {
            x: start,
            y: y + apart,
            leftward,
            covers: [left, y + apart - 7.0, right, y + apart + 7.0],
        }
    };
    let free = |label: &Label| {
        let [left, top, right, bottom] = label.covers;
        let inside = left > MARGINS[0] && right < SIZE[0] && top > 0.0;
        inside
            && taken.iter().all(|other| {
                right < other[0] || other[2] < left || bottom < other[1] || other[3] < top
            })
    };
    let steps = (0..12).flat_map(|k| [f64::from(k) * 15.0, f64::from(k) * -15.0]);
    steps
        .flat_map(|apart| [at(apart, false), at(apart, true)])
        .find(free)
        .unwrap_or_else(|| at(0.0, false))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_do_not_lie_on_one_another() {
        let dot = |name| Dot {
            name,
            cost: 2.0,
            away: 10.0,
        };
        let far = Dot {
            cost: 2000.0,
            away: 1.0,
            ..dot("far")
        };
        let picture = draw(&[dot("one"), dot("another"), dot("a third"), far]);
        assert!(picture.starts_with("<svg") && picture.ends_with("</svg>\n"));
        let place = |name: &str| {
            let line = picture
                .lines()
                .find(|line| line.contains(&format!(">{name}<")));
            line.and_then(|line| line.split('>').next())
                .expect("its name")
        };
        let places = ["one", "another", "a third"].map(place);
        assert!(places[0] != places[1] && places[1] != places[2] && places[0] != places[2]);
    }
}
