//! The four sides of a piece of a torn page, and the grid between them (Coons 1967).

use super::flat::{Place, distance, length};
use super::torn_path::spread_evenly;

/// The sides of a piece but its path, each from the path on or from left to right.
pub(super) struct Outline {
    left: Vec<Place>,
    /// The side opposite the path, from left to right.
    pub far: Vec<Place>,
    right: Vec<Place>,
    /// Whether the paper's edge goes straight on in the far corner on the right, or in that on
    /// the left, as a torn off corner has three alone.
    pub straight: Option<bool>,
}

impl Outline {
    /// The outlines of both pieces of a page of a size, metres, that is torn along a path: of the
    /// one at the foot, on the right of it, and of the one at the head. None where both ends of
    /// the path lie on one edge.
    pub fn of_both(path: &[Place], size: [f64; 2]) -> Option<[Self; 2]> {
        let (start, end) = (path[0], path[path.len() - 1]);
        Some([
            Self::of(perimeter(start, end, size), false)?,
            Self::of(perimeter(end, start, size), true)?,
        ])
    }

    /// Parts the edge of a piece, from one end of the path to the other through the page's
    /// corners between them: one to three. None where there are none.
    ///
    /// `from_right` says whether it begins at the right end of the path.
    fn of(edge: Vec<Place>, from_right: bool) -> Option<Self> {
        let last = edge.len() - 1;
        let (first_leg, last_leg) = (
            distance(edge[0], edge[1]),
            distance(edge[last - 1], edge[last]),
        );
        let (parts, straight_at_first) = match edge.len() - 2 {
            1 => {
                let halved = if last_leg >= first_leg { 1 } else { 0 };
                let middle = [0, 1].map(|axis| edge[halved][axis].midpoint(edge[halved + 1][axis]));
                let mut edge = edge;
                edge.insert(halved + 1, middle);
                let parts = [edge[..2].to_vec(), edge[1..3].to_vec(), edge[2..].to_vec()];
                (parts, Some(halved == 0))
            }
            2 => (
                [edge[..2].to_vec(), edge[1..3].to_vec(), edge[2..].to_vec()],
                None,
            ),
            // One corner more than a rectangle has is within a side.
            3 if first_leg < last_leg => (
                [edge[..3].to_vec(), edge[2..4].to_vec(), edge[3..].to_vec()],
                None,
            ),
            3 => (
                [edge[..2].to_vec(), edge[1..3].to_vec(), edge[2..].to_vec()],
                None,
            ),
            _ => return None,
        };
        let [first, mut far, mut second] = parts;
        second.reverse();
        let (left, right) = if from_right {
            far.reverse();
            (second, first)
        } else {
            (first, second)
        };
        Some(Self {
            left,
            far,
            right,
            straight: straight_at_first.map(|at_first| at_first == from_right),
        })
    }

    /// Length of the sides beside the path in the mean, metres.
    pub fn across(&self) -> f64 {
        length(&self.left).midpoint(length(&self.right))
    }

    /// Returns where so many rows of nodes lie, row by row from those on the path, `near`.
    pub fn map(&self, near: &[Place], rows: usize) -> Vec<Place> {
        let columns = near.len();
        let far = spread(&self.far, columns);
        let [left, right] = [&self.left, &self.right].map(|side| spread(side, rows));
        let mut places = Vec::with_capacity(columns * rows);
        for row in 0..rows {
            let t = row as f64 / (rows - 1) as f64;
            for column in 0..columns {
                let s = column as f64 / (columns - 1) as f64;
                places.push(core::array::from_fn(|axis| {
                    let mix = |a: f64, b: f64, part: f64| a + part * (b - a);
                    let of = |place: Place| place[axis];
                    let up = mix(of(near[column]), of(far[column]), t);
                    let along = mix(of(left[row]), of(right[row]), s);
                    let low = mix(of(left[0]), of(right[0]), s);
                    let high = mix(of(left[rows - 1]), of(right[rows - 1]), s);
                    up + along - mix(low, high, t)
                }));
            }
        }
        places
    }
}

/// Returns the edge of the page counterclockwise from one place on it to another: these, and
/// the corners between them.
fn perimeter(from: Place, to: Place, [width, height]: [f64; 2]) -> Vec<Place> {
    let around = 2.0 * (width + height);
    let position = |[x, y]: Place| {
        if y <= 0.0 {
            x
        } else if x >= width {
            width + y
        } else if y >= height {
            2.0 * width + height - x
        } else {
            around - y
        }
    };
    let start = position(from);
    let beyond = |place: Place| {
        let way = position(place) - start;
        if way < 0.0 { way + around } else { way }
    };
    let end = beyond(to);
    let corners = [[width, 0.0], [width, height], [0.0, height], [0.0, 0.0]];
    // Counterclockwise from the first one beyond `from`.
    let first = (0..4)
        .min_by(|a, b| beyond(corners[*a]).total_cmp(&beyond(corners[*b])))
        .unwrap_or(0);
    let on = (0..4).map(|k| corners[(first + k) % 4]);
    let mut places = vec![from];
    places.extend(on.filter(|corner| (1e-9..end - 1e-9).contains(&beyond(*corner))));
    places.push(to);
    places
}

/// Returns so many places on a line of one or two straight parts, or of many that are nearly
/// straight: evenly, but one on its corner if it has one.
fn spread(line: &[Place], count: usize) -> Vec<Place> {
    let [a, corner, b] = line else {
        return spread_evenly(line, count);
    };
    let (before, after) = (distance(*a, *corner), distance(*corner, *b));
    let last = count - 1;
    let at = libm::round(last as f64 * before / (before + after)) as usize;
    let at = at.clamp(1, last - 1);
    let mut places = spread_evenly(&[*a, *corner], at + 1);
    places.pop();
    places.extend(spread_evenly(&[*corner, *b], last - at + 1));
    places
}
