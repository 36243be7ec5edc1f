//! The path of a tear that turns: what is torn stays, and beyond its tip the path bends to another
//! heading along an arc, then goes straight on to the edge of the page.

use super::flat::{Place, distance, length};
use super::torn_grid::TornGrid;
use super::torn_path::{STRAYS_OVER, stray};
use crate::real::bounded;
use core::f64::consts::PI;

/// Least radius of a path, in cells: nodes follow it with a few along a quarter of a circle.
const LEAST_RADIUS: f64 = 2.0;

/// Points of a bend over the length over which a hand strays.
const POINTS: f64 = 12.0;

/// Fewest metres between nodes beyond the tip, in cells: where fewer are left the tear ends as it
/// goes.
const LEAST_STEP: f64 = 0.25;

impl TornGrid {
    /// The direction of the tear where it begins, radians from u of the frame toward v.
    pub fn first_heading(&self) -> f64 {
        let (from, to) = (self.course[0], self.course[self.course.len() - 1]);
        heading_of([to[0] - from[0], to[1] - from[1]])
    }

    /// How far along the tear each of its nodes lies, metres, from the edge where it begins.
    pub fn torn_stations(&self) -> Vec<f64> {
        let mut stations = self.stations();
        if self.is_from_end {
            let all = length(&self.path);
            for station in &mut stations {
                *station = all - *station;
            }
            stations.reverse();
        }
        stations
    }

    /// The grid of the same page with a path that turns to a heading, radians as
    /// [`first_heading`](Self::first_heading), from the tip of the tear on, which is at so many
    /// nodes from its beginning. Rows and columns are as many, and nodes of the path up to the tip
    /// where they were.
    ///
    /// None where that leads back to the edge from which it comes, or no grid can be made of
    /// either piece.
    pub fn turned(&self, tip: usize, heading: f64) -> Option<TornGrid> {
        let mut stations = self.torn_stations();
        let last = stations.len() - 1;
        if tip >= last {
            return None;
        }
        let mut path = self.path.clone();
        if self.is_from_end {
            path.reverse();
        }
        let (torn, at) = part_until(&path, stations[tip]);
        let (mut course, beyond) = self.turned_course(at, heading)?;
        let ahead = strayed_from(at, length(&course), &beyond, self.frame.size());
        course.extend(&beyond[1..]);
        let mut path = torn;
        path.extend(ahead);
        let (from, all) = (stations[tip], length(&path));
        let step = (all - from) / (last - tip) as f64;
        if step < LEAST_STEP * self.spacing {
            return None;
        }
        for (k, station) in stations[tip + 1..].iter_mut().enumerate() {
            *station = from + step * (k + 1) as f64;
        }
        // On the edge, not beside it by rounding.
        stations[last] = all;
        if self.is_from_end {
            path.reverse();
            stations.reverse();
            for station in &mut stations {
                *station = all - *station;
            }
        }
        let turned = TornGrid {
            path,
            course,
            stations: Some(stations),
            places: Vec::new(),
            ..self.clone()
        };
        turned.over_page()
    }

    /// Where a tear goes whose tip is at a place: its course up to there, and from there on.
    fn turned_course(&self, tip: Place, heading: f64) -> Option<(Vec<Place>, Vec<Place>)> {
        let (mut course, from, now) = nearest_on(&self.course, tip);
        course.push(from);
        let beyond = arc_to_edge(
            from,
            [now, now + wrapped(heading - now)],
            LEAST_RADIUS * self.spacing,
            self.frame.size(),
        )?;
        Some((course, beyond))
    }
}

/// The direction of a way, radians.
fn heading_of(way: Place) -> f64 {
    libm::atan2(way[1], way[0])
}

/// An angle, radians, as the same one from -pi to pi.
pub(crate) fn wrapped(angle: f64) -> f64 {
    angle - 2.0 * PI * libm::round(angle / (2.0 * PI))
}

/// Returns the part of a line up to so many metres along it, without its end, and that end.
fn part_until(line: &[Place], along: f64) -> (Vec<Place>, Place) {
    let mut part = Vec::with_capacity(line.len());
    let mut left = along;
    for pair in line.windows(2) {
        part.push(pair[0]);
        let long = distance(pair[0], pair[1]);
        if left < long {
            let at =
                [0, 1].map(|axis| pair[0][axis] + left / long * (pair[1][axis] - pair[0][axis]));
            if left <= 0.0 {
                part.pop();
            }
            return (part, at);
        }
        left -= long;
    }
    (part, line[line.len() - 1])
}

/// Returns the place on a line that is nearest to another, the line up to there, without it, and
/// its heading there, radians.
fn nearest_on(line: &[Place], to: Place) -> (Vec<Place>, Place, f64) {
    let mut best = (f64::INFINITY, 0, line[0]);
    for (k, pair) in line.windows(2).enumerate() {
        let way = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
        let off = [to[0] - pair[0][0], to[1] - pair[0][1]];
        let square = (way[0] * way[0] + way[1] * way[1]).max(f64::MIN_POSITIVE);
        let part = ((off[0] * way[0] + off[1] * way[1]) / square).clamp(0.0, 1.0);
        let at = [0, 1].map(|axis| pair[0][axis] + part * way[axis]);
        let away = distance(at, to);
        if away < best.0 {
            best = (away, k, at);
        }
    }
    let (_, k, at) = best;
    let before = line[..=k].iter().copied().filter(|place| *place != at);
    let part = distance(line[k], at) / distance(line[k], line[k + 1]).max(f64::MIN_POSITIVE);
    let [a, b] = [heading_at(line, k), heading_at(line, k + 1)];
    (before.collect(), at, a + part * wrapped(b - a))
}

/// Returns the heading of a line at one of its points, radians: the mean of those of the parts beside
/// it, and at an end what goes on so, as of an arc.
fn heading_at(line: &[Place], point: usize) -> f64 {
    let last = line.len() - 2;
    let of = |part: usize| {
        let [a, b] = [line[part], line[part + 1]];
        heading_of([b[0] - a[0], b[1] - a[1]])
    };
    let (before, beyond) = if point == 0 {
        (of(0), of(1.min(last)))
    } else if point > last {
        (of(last), of(last.saturating_sub(1)))
    } else {
        return of(point - 1) + 0.5 * wrapped(of(point) - of(point - 1));
    };
    before - 0.5 * wrapped(beyond - before)
}

/// Returns a line from a place on a page of a size, metres, which turns from one heading to another
/// with a radius and then goes straight on to the edge. None where it goes around.
fn arc_to_edge(
    from: Place,
    [now, heading]: [f64; 2],
    radius: f64,
    size: [f64; 2],
) -> Option<Vec<Place>> {
    let side = if heading < now { -1.0 } else { 1.0 };
    let bend = radius * (heading - now).abs();
    let step = STRAYS_OVER / POINTS;
    let normal = |angle: f64| [-libm::sin(angle), libm::cos(angle)];
    let start = normal(now);
    let on_arc = |along: f64| {
        let end = normal(now + side * along / radius);
        [0, 1].map(|axis| from[axis] + side * radius * (start[axis] - end[axis]))
    };
    let end = on_arc(bend);
    let straight = [libm::cos(heading), libm::sin(heading)];
    let at = |along: f64| {
        if along < bend {
            on_arc(along)
        } else {
            [0, 1].map(|axis| end[axis] + (along - bend) * straight[axis])
        }
    };
    let mut line = vec![from];
    let most = libm::ceil(2.0 * (size[0] + size[1]) / step) as usize;
    for k in 1..most {
        let (last, next) = (line[k - 1], at(step * k as f64));
        // The part of the step that is on the page.
        let parts = [0, 1].map(|axis| {
            let way = next[axis] - last[axis];
            if next[axis] < 0.0 {
                (0.0 - last[axis]) / way
            } else if next[axis] > size[axis] {
                (size[axis] - last[axis]) / way
            } else {
                f64::INFINITY
            }
        });
        let part = parts[0].min(parts[1]);
        if part > 1.0 {
            line.push(next);
            continue;
        }
        let edge = usize::from(parts[1] < parts[0]);
        let mut place = [0, 1].map(|axis| {
            bounded(
                last[axis] + part * (next[axis] - last[axis]),
                0.0,
                size[axis],
            )
        });
        place[edge] = if next[edge] < 0.0 { 0.0 } else { size[edge] };
        if distance(place, last) < 1e-3 * step && line.len() > 1 {
            line.pop();
        }
        line.push(place);
        return (line.len() > 1).then_some(line);
    }
    None
}

/// Returns a line as a hand tears along it from a place beside its beginning: so many metres along
/// its course and on a page of a size. Its end stays.
fn strayed_from(from: Place, before: f64, line: &[Place], size: [f64; 2]) -> Vec<Place> {
    let left = length(line);
    let normal_at = |k: usize| {
        let [a, b] = [line[k.saturating_sub(1)], line[(k + 1).min(line.len() - 1)]];
        let long = distance(a, b).max(f64::MIN_POSITIVE);
        [(a[1] - b[1]) / long, (b[0] - a[0]) / long]
    };
    let own = |along: f64| stray((before + along) / (before + left), before + left);
    let normal = normal_at(0);
    let off = (from[0] - line[0][0]) * normal[0] + (from[1] - line[0][1]) * normal[1] - own(0.0);
    let fades = STRAYS_OVER.min(left);
    let mut along = 0.0;
    let mut places = vec![from];
    for k in 1..line.len() {
        along += distance(line[k - 1], line[k]);
        let normal = normal_at(k);
        let by = own(along) + off * (1.0 - along / fades).max(0.0);
        let place = [0, 1].map(|axis| bounded(line[k][axis] + by * normal[axis], 0.0, size[axis]));
        places.push(place);
    }
    places[line.len() - 1] = line[line.len() - 1];
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: [f64; 2] = [0.148, 0.21];
    const CELL: f64 = 0.0164;
    const PATHS: [[[f64; 2]; 2]; 6] = [
        [[0.0, 0.5], [1.0, 0.5]],
        [[1.0, 0.35], [0.0, 0.6]],
        [[0.5, 1.0], [0.45, 0.0]],
        [[0.45, 0.0], [0.5, 1.0]],
        [[0.5, 1.0], [1.0, 0.6]],
        [[0.0, 0.5], [0.6, 0.0]],
    ];

    /// Where the nodes of the path lie from where it begins, metres.
    fn nodes(grid: &TornGrid) -> Vec<Place> {
        let row = grid.rows[0] * grid.columns;
        let mut nodes = grid.places[row..row + grid.columns].to_vec();
        if grid.is_from_end {
            nodes.reverse();
        }
        nodes
    }

    #[test]
    fn a_turn_keeps_what_is_torn_and_fills_the_page() {
        let (mut turned, mut rejected) = (0, 0);
        for path in PATHS {
            let first = TornGrid::new(PAGE, &path, CELL).unwrap();
            let straight = first.first_heading();
            for degrees in [-50, -20, -5, 5, 20, 50] {
                let mut grid = first.clone();
                for tip in [0, 2, 5, 6] {
                    let heading = straight + f64::from(degrees) * PI / 180.0;
                    let Some(next) = grid.turned(tip, heading) else {
                        rejected += 1;
                        continue;
                    };
                    turned += 1;
                    let [before, after] = [&grid, &next].map(nodes);
                    for (a, b) in before.iter().zip(&after).take(tip + 1) {
                        assert!(distance(*a, *b) < 1e-12, "{path:?}, {degrees}: {a:?} {b:?}");
                    }
                    assert!(next.torn_stations().is_sorted_by(|a, b| a < b));
                    let size = next.frame.size();
                    for place in &next.path {
                        assert!(
                            (0..2).all(|k| (0.0..=size[k]).contains(&place[k])),
                            "{place:?}"
                        );
                    }
                    let [x, y] = after[after.len() - 1];
                    assert!(x == 0.0 || x == size[0] || y == 0.0 || y == size[1]);
                    let area = next.area() / (PAGE[0] * PAGE[1]);
                    assert!((area - 1.0).abs() < 1e-9, "{path:?}, {degrees}: {area}");
                    let long: f64 = next.torn_stations()[next.columns - 1];
                    assert!((long / length(&next.path) - 1.0).abs() < 1e-9);
                    grid = next;
                }
            }
        }
        assert!(turned > 5 * rejected, "{turned} turned, {rejected} not");
    }

    #[test]
    fn a_path_turned_back_goes_straight_on_beside_where_it_was() {
        let first = TornGrid::new(PAGE, &PATHS[0], CELL).unwrap();
        let straight = first.first_heading();
        let bent = first.turned(3, straight + 0.5).unwrap();
        let back = bent.turned(3, straight).unwrap();
        for (a, b) in nodes(&first).iter().zip(nodes(&back)) {
            assert!(distance(*a, b) < 1e-3, "{a:?} {b:?}");
        }
    }
}
