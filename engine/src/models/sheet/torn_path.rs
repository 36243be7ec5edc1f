//! The line along which a page is torn: as it is asked for, smoothed, and as a hand tears along it.

use super::flat::{Place, distance, length};
use crate::real::bounded;

/// Points of the path, which lie some millimetres apart on any page.
pub(super) const POINTS: usize = 65;

/// Times that corners of the path are cut (Chaikin 1974), after which it is smooth to see.
const CUTS: usize = 3;

/// By how much a hand that tears strays from its path, metres, and over which length: some
/// millimetres over a few centimetres. Its torn edge wanders by less than a millimetre beside.
const STRAY: f64 = 0.0025;
/// The length over which it does, metres.
pub(super) const STRAYS_OVER: f64 = 0.03;

/// Moves a place to the edge of the page that is next to it.
pub(super) fn onto_edge(place: Place, size: [f64; 2]) -> Place {
    let away = |k: &usize| {
        let (axis, is_far) = (k / 2, k % 2 == 1);
        (place[axis] - if is_far { size[axis] } else { 0.0 }).abs()
    };
    let nearest = (0..4)
        .min_by(|a, b| away(a).total_cmp(&away(b)))
        .unwrap_or(0);
    let mut place = place;
    place[nearest / 2] = if nearest % 2 == 1 {
        size[nearest / 2]
    } else {
        0.0
    };
    place
}

/// Cuts the corners of a path; its ends stay.
pub(super) fn smooth(mut path: Vec<Place>) -> Vec<Place> {
    for _ in 0..CUTS {
        let mut cut = vec![path[0]];
        for pair in path.windows(2) {
            let at = |part: f64| [0, 1].map(|k| pair[0][k] + part * (pair[1][k] - pair[0][k]));
            cut.extend([at(0.25), at(0.75)]);
        }
        cut.push(path[path.len() - 1]);
        path = cut;
    }
    path
}

/// Returns a path as a hand tears along it, in points at even distances; its ends stay.
pub(super) fn strayed(path: &[Place], size: [f64; 2]) -> Vec<Place> {
    let points = spread_evenly(path, POINTS);
    let (all, last) = (length(path), POINTS - 1);
    let place = |k: usize| {
        let [a, b] = [points[k.saturating_sub(1)], points[(k + 1).min(last)]];
        let long = distance(a, b).max(f64::MIN_POSITIVE);
        let normal = [(a[1] - b[1]) / long, (b[0] - a[0]) / long];
        let by = stray(k as f64 / last as f64, all);
        let place = [0, 1].map(|axis| points[k][axis] + by * normal[axis]);
        [0, 1].map(|axis| bounded(place[axis], 0.0, size[axis]))
    };
    let mut strayed: Vec<Place> = (0..POINTS).map(place).collect();
    (strayed[0], strayed[last]) = (points[0], points[last]);
    spread_evenly(&strayed, POINTS)
}

/// By how much a hand strays at a part of the length of its path, metres.
pub(super) fn stray(part: f64, all: f64) -> f64 {
    let fade = (4.0 * part * (1.0 - part)).min(1.0);
    fade * STRAY * (2.0 * wander(part * all / STRAYS_OVER) - 1.0)
}

/// Smooth noise of whole numbers, 0 to 1, the same on every machine.
fn wander(at: f64) -> f64 {
    let cell = libm::floor(at);
    let value = |n: u32| {
        let mut n = n.wrapping_mul(0x9e37_79b9);
        n = (n ^ (n >> 16)).wrapping_mul(0x21f0_aaad);
        n = (n ^ (n >> 15)).wrapping_mul(0x735a_2d97);
        f64::from((n ^ (n >> 15)) >> 8) / f64::from(1 << 24)
    };
    let [low, high] = [value(cell as u32), value(cell as u32 + 1)];
    let part = at - cell;
    low + part * part * (3.0 - 2.0 * part) * (high - low)
}

/// Returns so many places on a line at even distances along it, its ends among them.
pub(super) fn spread_evenly(line: &[Place], count: usize) -> Vec<Place> {
    places_along(line, &even_stations(length(line), count))
}

/// Returns so many even distances along a line of a length, from 0 to its end.
pub(super) fn even_stations(all: f64, count: usize) -> Vec<f64> {
    let station = |k: usize| all * k as f64 / (count - 1) as f64;
    (0..count).map(station).collect()
}

/// Returns the places on a line at rising distances along it, metres; the last is its end.
pub(super) fn places_along(line: &[Place], stations: &[f64]) -> Vec<Place> {
    let (mut part, mut before) = (0, 0.0);
    let place = |along: &f64| {
        while part + 2 < line.len() && before + distance(line[part], line[part + 1]) < *along {
            before += distance(line[part], line[part + 1]);
            part += 1;
        }
        let [a, b] = [line[part], line[part + 1]];
        let t = ((along - before) / distance(a, b).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        [0, 1].map(|axis| a[axis] + t * (b[axis] - a[axis]))
    };
    let mut places: Vec<Place> = stations.iter().map(place).collect();
    places[stations.len() - 1] = line[line.len() - 1];
    places
}
