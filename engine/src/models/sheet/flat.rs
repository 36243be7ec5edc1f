//! Places, lengths and areas on the flat paper, in metres.

/// A place on the paper, metres.
pub(super) type Place = [f64; 2];

/// Distance between two places, metres.
pub(super) fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    let d = [a[0] - b[0], a[1] - b[1]];
    (d[0] * d[0] + d[1] * d[1]).sqrt()
}

/// Twice the area of a triangle, above 0 where its corners go around as u to v does.
pub(super) fn twice_area(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Weights with which the corners of a triangle have a place as their mean; all are above 0 within
/// it.
pub(super) fn weights(place: [f64; 2], [a, b, c]: [[f64; 2]; 3]) -> [f64; 3] {
    let all = twice_area(a, b, c);
    [(b, c), (c, a), (a, b)].map(|(p, q)| twice_area(place, p, q) / all)
}

/// Length of a line through places, metres.
pub(super) fn length(line: &[[f64; 2]]) -> f64 {
    line.windows(2).map(|pair| distance(pair[0], pair[1])).sum()
}
