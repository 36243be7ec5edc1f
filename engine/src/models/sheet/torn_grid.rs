//! The grid of a page that is torn along a path: two four-sided grids that meet there.
//!
//! The nodes of the path are there twice, once for each piece, in two rows one after the
//! other between which there are no cells. So one sheet has both pieces, with the same rows
//! and columns for solver and sweeps, and is two sheets once nothing ties those rows. Each
//! piece is mapped onto its rectangle of nodes from its four sides (Coons 1967).

use super::flat::{distance, length, twice_area};

/// Fewest and most columns: the path's nodes, no farther apart than paper needs to bend along
/// it, and no more than a frame has time for.
const COLUMNS: [usize; 2] = [6, 16];

/// Fewest and most rows of a piece: a sheet has at least four.
const ROWS: [usize; 2] = [4, 14];

/// Least area of a triangle, over that of half a mean cell: cells of a small piece are small.
const LEAST_AREA: f64 = 0.02;

/// Points of the path, which lie some millimetres apart on any page.
const POINTS: usize = 65;

/// Times that corners of the path are cut (Chaikin 1974), after which it is smooth to see.
const CUTS: usize = 3;

/// By how much a hand that tears strays from its path, metres, and over which length: some
/// millimetres over a few centimetres. Its torn edge wanders by less than a millimetre beside.
const STRAY: f64 = 0.0025;
const STRAYS_OVER: f64 = 0.03;

/// A place on the paper, metres.
type Place = [f64; 2];

/// How a page's places are counted along the path and across it: as they are, or turned by a
/// quarter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frame {
    /// Width and height of the page, metres.
    page: [f64; 2],
    /// Whether it is turned clockwise by a quarter: u of the frame is v of the page.
    is_turned: bool,
}

impl Frame {
    /// Width and height of the page in the frame, metres.
    pub fn size(self) -> [f64; 2] {
        let [width, height] = self.page;
        if self.is_turned {
            [height, width]
        } else {
            self.page
        }
    }

    /// Whether u of the frame is v of the page.
    pub fn is_turned(self) -> bool {
        self.is_turned
    }

    /// Returns u and v in the frame of a place at u and v of the page.
    pub fn of_page(self, [u, v]: [f32; 2]) -> [f32; 2] {
        if self.is_turned { [v, 1.0 - u] } else { [u, v] }
    }

    /// Returns u and v on the page of a place in the frame, metres.
    pub fn on_page(self, place: Place) -> [f64; 2] {
        let size = self.size();
        let [u, v] = [0, 1].map(|axis| place[axis] / size[axis]);
        if self.is_turned { [1.0 - v, u] } else { [u, v] }
    }

    fn metres_of_page(self, [u, v]: [f64; 2]) -> Place {
        let [width, height] = self.size();
        if self.is_turned {
            [v * width, (1.0 - u) * height]
        } else {
            [u * width, v * height]
        }
    }
}

/// The grid of a page that is torn along a path.
#[derive(Clone, Debug)]
pub(crate) struct TornGrid {
    pub frame: Frame,
    /// The path from one edge to another, along rising u of the frame, metres.
    pub path: Vec<Place>,
    /// Whether it is torn from the end of the path, and not from its beginning.
    pub is_from_end: bool,
    pub columns: usize,
    /// Rows of the piece at the foot, on the right of the path, and of the one at the head.
    pub rows: [usize; 2],
    /// Where the nodes lie in the frame, metres, row by row from the foot.
    pub places: Vec<Place>,
    /// Diagonals of cells that are cut along them alone: in their corners the paper goes
    /// straight on.
    pub diagonals: Vec<[usize; 2]>,
}

impl TornGrid {
    /// The grid of a page of a size, metres, that is torn along a path, u and v of places on the
    /// page each 0 to 1, from the edge next to the first to the edge next to the last. Cells are
    /// about `cell` metres wide.
    ///
    /// None where the path has fewer than two places or leaves the page, both its ends lie on one
    /// edge, or a piece is narrower than a cell or more crooked than a grid can be.
    pub fn new(page: [f64; 2], path: &[[f64; 2]], cell: f64) -> Option<Self> {
        let is_on_page = |at: &f64| (0.0..=1.0).contains(at);
        if path.len() < 2 || !path.as_flattened().iter().all(is_on_page) {
            return None;
        }
        let upright = Frame {
            page,
            is_turned: false,
        };
        let [from, to] = [path[0], path[path.len() - 1]].map(|at| upright.metres_of_page(at));
        let frame = Frame {
            is_turned: (to[1] - from[1]).abs() > (to[0] - from[0]).abs(),
            ..upright
        };
        let size = frame.size();
        let mut path: Vec<Place> = path.iter().map(|at| frame.metres_of_page(*at)).collect();
        let last = path.len() - 1;
        for end in [0, last] {
            path[end] = onto_edge(path[end], size);
        }
        let is_from_end = path[last][0] < path[0][0];
        if is_from_end {
            path.reverse();
        }
        let path = strayed(&smooth(path), size);
        let (start, end) = (path[0], path[path.len() - 1]);
        let outlines = [
            Outline::of(perimeter(start, end, size), false)?,
            Outline::of(perimeter(end, start, size), true)?,
        ];
        let across = |outline: &Outline| length(&outline.left).midpoint(length(&outline.right));
        if outlines.iter().any(|outline| across(outline) < cell) {
            return None;
        }
        let cells = |length: f64| libm::round(length / cell) as usize + 1;
        let along = length(&path) + length(&outlines[0].far) + length(&outlines[1].far);
        let columns = cells(along / 3.0).clamp(COLUMNS[0], COLUMNS[1]);
        let rows = [0, 1].map(|piece| cells(across(&outlines[piece])).clamp(ROWS[0], ROWS[1]));
        let mut grid = Self {
            frame,
            is_from_end,
            columns,
            rows,
            places: Vec::with_capacity(columns * (rows[0] + rows[1])),
            diagonals: Vec::new(),
            path,
        };
        let [foot, head] =
            [0, 1].map(|piece| outlines[piece].map(&grid.path, columns, rows[piece]));
        // From the foot up: the foot's rows come from its far side to the path.
        for row in foot.chunks(columns).rev().chain(head.chunks(columns)) {
            grid.places.extend(row);
        }
        let top = columns * (rows[0] + rows[1] - 1);
        let [low, high] = [&outlines[0], &outlines[1]].map(|outline| outline.straight);
        grid.diagonals.extend(low.map(|is_right| {
            let corner = if is_right { columns - 1 } else { 0 };
            [
                corner,
                if is_right {
                    2 * columns - 2
                } else {
                    columns + 1
                },
            ]
        }));
        grid.diagonals.extend(high.map(|is_right| {
            let corner = if is_right { top + columns - 1 } else { top };
            [
                corner - columns - usize::from(is_right) + usize::from(!is_right),
                corner,
            ]
        }));
        grid.is_sound().then_some(grid)
    }

    /// The length of path that belongs to each of its nodes, metres: half of the way to either
    /// neighbour.
    pub fn lengths(&self) -> Vec<f64> {
        let step = length(&self.path) / (self.columns - 1) as f64;
        let ends = [0, self.columns - 1];
        let part = |column: usize| if ends.contains(&column) { 0.5 } else { 1.0 };
        (0..self.columns)
            .map(|column| part(column) * step)
            .collect()
    }

    /// Mean sides of its cells, metres.
    pub fn cell(&self) -> [f64; 2] {
        let count = (self.columns - 1) as f64;
        let row = |row: usize| length(&self.places[row * self.columns..(row + 1) * self.columns]);
        let rows = self.rows[0] + self.rows[1];
        let along: f64 = (0..rows).map(row).sum::<f64>() / rows as f64;
        let [width, height] = self.frame.size();
        let area = width * height / (count * (rows - 2) as f64);
        [along / count, area * count / along]
    }

    /// Whether no cell is turned over or nearly flat, whichever way it is cut.
    fn is_sound(&self) -> bool {
        let columns = self.columns;
        let [width, height] = self.frame.size();
        let cells = (columns - 1) * (self.rows[0] + self.rows[1] - 2);
        let least = LEAST_AREA * width * height / cells as f64;
        let mut feet = (0..columns * (self.rows[0] + self.rows[1] - 1))
            .filter(|foot| (foot + 1) % columns != 0 && foot / columns + 1 != self.rows[0]);
        feet.all(|foot| {
            let [a, b, c, d] = [foot, foot + 1, foot + columns, foot + columns + 1];
            let rising = [[a, b, d], [a, d, c]];
            let falling = [[a, b, c], [b, d, c]];
            let ways = match self
                .diagonals
                .iter()
                .find(|edge| **edge == [a, d] || **edge == [b, c])
            {
                Some(edge) if *edge == [a, d] => [rising, rising],
                Some(_) => [falling, falling],
                None => [rising, falling],
            };
            ways.as_flattened().iter().all(|corners| {
                let [a, b, c] = corners.map(|node| self.places[node]);
                twice_area(a, b, c) > least
            })
        })
    }
}

/// The sides of a piece but its path, each from the path on or from left to right.
struct Outline {
    left: Vec<Place>,
    far: Vec<Place>,
    right: Vec<Place>,
    /// Whether the paper's edge goes straight on in the far corner on the right, or in that on
    /// the left, as a torn off corner has three alone.
    straight: Option<bool>,
}

impl Outline {
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

    /// Returns where so many columns and rows of nodes lie, row by row from the path.
    fn map(&self, path: &[Place], columns: usize, rows: usize) -> Vec<Place> {
        let [near, far] = [path, &self.far].map(|side| spread(side, columns));
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

/// Moves a place to the edge of the page that is next to it.
fn onto_edge(place: Place, size: [f64; 2]) -> Place {
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
fn smooth(mut path: Vec<Place>) -> Vec<Place> {
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
fn strayed(path: &[Place], size: [f64; 2]) -> Vec<Place> {
    let points = spread_evenly(path, POINTS);
    let (all, last) = (length(path), POINTS - 1);
    let stray = |k: usize| {
        let part = k as f64 / last as f64;
        let [a, b] = [points[k.saturating_sub(1)], points[(k + 1).min(last)]];
        let long = distance(a, b).max(f64::MIN_POSITIVE);
        let normal = [(a[1] - b[1]) / long, (b[0] - a[0]) / long];
        let fade = (4.0 * part * (1.0 - part)).min(1.0);
        let by = fade * STRAY * (2.0 * wander(part * all / STRAYS_OVER) - 1.0);
        let place = [0, 1].map(|axis| points[k][axis] + by * normal[axis]);
        [0, 1].map(|axis| place[axis].clamp(0.0, size[axis]))
    };
    let mut strayed: Vec<Place> = (0..POINTS).map(stray).collect();
    (strayed[0], strayed[last]) = (points[0], points[last]);
    spread_evenly(&strayed, POINTS)
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

/// Returns so many places on a line at even distances along it, its ends among them.
pub(super) fn spread_evenly(line: &[Place], count: usize) -> Vec<Place> {
    let all = length(line);
    let (mut part, mut before) = (0, 0.0);
    let place = |k: usize| {
        let along = all * k as f64 / (count - 1) as f64;
        while part + 2 < line.len() && before + distance(line[part], line[part + 1]) < along {
            before += distance(line[part], line[part + 1]);
            part += 1;
        }
        let [a, b] = [line[part], line[part + 1]];
        let t = ((along - before) / distance(a, b).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        [0, 1].map(|axis| a[axis] + t * (b[axis] - a[axis]))
    };
    let mut places: Vec<Place> = (0..count).map(place).collect();
    places[count - 1] = line[line.len() - 1];
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: [f64; 2] = [0.148, 0.21];
    const CELL: f64 = 0.0164;

    /// Area of the cells of rows of a grid, m^2.
    fn area(grid: &TornGrid, rows: core::ops::Range<usize>) -> f64 {
        let columns = grid.columns;
        let feet = rows.flat_map(|row| (0..columns - 1).map(move |k| row * columns + k));
        let of = |foot: usize| {
            let nodes = [foot, foot + 1, foot + columns + 1, foot + columns];
            let [a, b, c, d] = nodes.map(|node| grid.places[node]);
            0.5 * (twice_area(a, b, c) + twice_area(a, c, d))
        };
        feet.map(of).sum()
    }

    #[test]
    fn pieces_fill_the_page() {
        for (from, to) in [
            ([0.0, 0.5], [1.0, 0.5]),
            ([1.0, 0.3], [0.0, 0.7]),
            ([0.4, 1.0], [0.6, 0.0]),
            ([0.0, 0.4], [0.5, 0.0]),
            ([0.5, 0.0], [0.0, 0.4]),
            ([0.6, 1.0], [1.0, 0.7]),
            ([0.0, 0.9], [0.3, 0.0]),
            ([1.0, 0.2], [0.2, 1.0]),
            ([0.0, 0.0], [1.0, 1.0]),
        ] {
            let grid = TornGrid::new(PAGE, &[from, to], CELL);
            let grid = grid.unwrap_or_else(|| panic!("{from:?} to {to:?}"));
            let [foot, head] = grid.rows;
            assert_eq!(grid.places.len(), grid.columns * (foot + head));
            let areas = [area(&grid, 0..foot - 1), area(&grid, foot..foot + head - 1)];
            let all = PAGE[0] * PAGE[1];
            // Nodes on the path cut its bends.
            let off = (areas[0] + areas[1]) / all - 1.0;
            assert!(off.abs() < 1e-9, "{from:?} to {to:?}: {off}");
            assert!(areas.iter().all(|area| *area > 0.02 * all), "{areas:?}");
            for column in 0..grid.columns {
                let [low, high] =
                    [foot - 1, foot].map(|row| grid.places[row * grid.columns + column]);
                assert_eq!(low, high);
            }
            let first = if grid.is_from_end { POINTS - 1 } else { 0 };
            let at = grid.frame.on_page(grid.path[first]);
            assert!(distance(at, from) < 1e-12, "{at:?} for {from:?}");
        }
    }

    #[test]
    fn a_bent_path_is_followed() {
        let path = [[0.0, 0.4], [0.5, 0.6], [1.0, 0.4]];
        let grid = TornGrid::new(PAGE, &path, CELL).unwrap();
        let highest = grid.path.iter().fold(0.0, |most: f64, [_, y]| most.max(*y));
        assert!((0.53..0.6).contains(&(highest / PAGE[1])), "{highest}");
        assert!((grid.lengths().iter().sum::<f64>() / length(&grid.path) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn what_is_no_path_across_the_page_is_rejected() {
        for path in [
            vec![],
            vec![[0.0, 0.5]],
            vec![[0.0, 0.5], [1.2, 0.5]],
            vec![[0.0, f64::NAN], [1.0, 0.5]],
            // Along an edge, or from it back to it.
            vec![[0.0, 0.3], [0.0, 0.8]],
            vec![[0.2, 0.0], [0.5, 0.4], [0.8, 0.0]],
            // Narrower than a cell.
            vec![[0.0, 0.97], [1.0, 0.97]],
            vec![[0.0, 0.5], [0.0, 0.5]],
        ] {
            assert!(TornGrid::new(PAGE, &path, CELL).is_none(), "{path:?}");
        }
    }
}
