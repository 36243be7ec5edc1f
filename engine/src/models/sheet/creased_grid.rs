//! The nodes of a sheet moved onto its creases: which they are, and where the others go then.

use super::crease::SheetCrease;
use super::flat::{distance, twice_area};
use super::material::Material;
use crate::real::bounded;

/// Least area of a triangle, over that which half of its cell has without creases.
const LEAST_AREA: f64 = 0.08;

/// Least length of a crease, over the shorter side of a mean cell.
const LEAST_LENGTH: f64 = 0.2;

/// How much a path along a crease avoids nodes off its line, over its own length; both
/// in cells.
const OFF_LINE: f64 = 4.0;

/// Rounds in which the nodes beside creases find their places.
const ROUNDS: usize = 200;

/// A line over the paper, from edge to edge.
#[derive(Clone, Copy)]
pub(super) struct Line {
    /// Where it begins, metres along u and v.
    pub from: [f64; 2],
    /// Where it ends, likewise.
    pub to: [f64; 2],
}

impl Material {
    /// The grid with creases through it. None where nodes are too few for them: two lie
    /// too near each other, or nearly along an edge.
    pub fn creased(mut self, creases: &[SheetCrease]) -> Option<Self> {
        if creases.is_empty() {
            return Some(self);
        }
        self.is_even = false;
        let before = self.places.clone();
        let mut lines: Vec<Line> = Vec::new();
        // For each node the crease that it was moved onto first.
        let mut taken: Vec<Option<usize>> = vec![None; before.len()];
        for (crease, fold) in creases.iter().enumerate() {
            let line = self.line(fold)?;
            let stops = self.stops(&line, &lines, &taken)?;
            for pair in stops.windows(2) {
                let path = self.path(pair[0].0, pair[1].0, &line, &before, &taken)?;
                for step in path.windows(2) {
                    let edge = [step[0].min(step[1]), step[0].max(step[1])];
                    self.folds.push((edge, crease));
                }
                for &node in &path[1..path.len() - 1] {
                    self.places[node] = line.nearest(before[node]);
                    taken[node] = Some(crease);
                }
            }
            for (node, place) in stops {
                self.places[node] = place;
                taken[node].get_or_insert(crease);
            }
            lines.push(line);
        }
        self.relax(&before, &taken);
        self.is_sound(&before).then_some(self)
    }

    /// The whole line of a crease.
    pub fn line(&self, fold: &SheetCrease) -> Option<Line> {
        let size = self.size;
        let [a, b] = fold.through.map(|at| [at[0] * size[0], at[1] * size[1]]);
        let way = [b[0] - a[0], b[1] - a[1]];
        // Both places are on the paper, so the line there is no shorter than their distance.
        if distance(a, b) < LEAST_LENGTH * self.cell[0].min(self.cell[1]) {
            return None;
        }
        let (mut first, mut last) = (f64::NEG_INFINITY, f64::INFINITY);
        for axis in 0..2 {
            if way[axis] == 0.0 {
                continue;
            }
            let ends = [0.0, size[axis]].map(|end| (end - a[axis]) / way[axis]);
            first = first.max(ends[0].min(ends[1]));
            last = last.min(ends[0].max(ends[1]));
        }
        let at =
            |t: f64| core::array::from_fn(|axis| bounded(a[axis] + t * way[axis], 0.0, size[axis]));
        Some(Line {
            from: at(first),
            to: at(last),
        })
    }

    /// Nodes that a crease must go through, with their places, in its order: those at its
    /// ends and where it meets other creases.
    fn stops(
        &self,
        line: &Line,
        others: &[Line],
        taken: &[Option<usize>],
    ) -> Option<Vec<(usize, [f64; 2])>> {
        let mut stops = vec![self.end(line.from, taken)?];
        let mut meetings: Vec<(usize, [f64; 2])> = Vec::new();
        for (other, theirs) in others.iter().enumerate() {
            let Some(place) = line.meets(theirs) else {
                continue;
            };
            let on_it = (0..taken.len()).filter(|&node| {
                taken[node] == Some(other) && !self.is_on_rim(node)
                    || distance(self.places[node], place) < 1e-9
            });
            let away = |node: &usize| distance(self.places[*node], place);
            let node = on_it.min_by(|a, b| away(a).total_cmp(&away(b)))?;
            meetings.push((node, place));
        }
        let along = |(_, place): &(usize, [f64; 2])| distance(line.from, *place);
        meetings.sort_by(|a, b| along(a).total_cmp(&along(b)));
        stops.extend(meetings);
        stops.push(self.end(line.to, taken)?);
        stops.dedup_by_key(|(node, _)| *node);
        (stops.len() > 1).then_some(stops)
    }

    /// The node to move to an end of a crease, on the sheet's edge: not a corner, unless
    /// that is where it ends.
    fn end(&self, place: [f64; 2], taken: &[Option<usize>]) -> Option<(usize, [f64; 2])> {
        let near = 1e-6 * self.cell[0];
        let (columns, rows) = (self.columns, self.rows);
        let edge = |axis: usize, last: usize| {
            if place[axis] < near {
                Some(0)
            } else if self.size[axis] - place[axis] < near {
                Some(last)
            } else {
                None
            }
        };
        let nearest = |axis: usize, node: &dyn Fn(usize) -> usize, last: usize| {
            let off = |k: &usize| (self.places[node(*k)][axis] - place[axis]).abs();
            (1..last).min_by(|a, b| off(a).total_cmp(&off(b)))
        };
        let (column, row) = match (edge(0, columns - 1), edge(1, rows - 1)) {
            (Some(column), Some(row)) => (column, row),
            (Some(column), None) => {
                let node = |row: usize| row * columns + column;
                (column, nearest(1, &node, rows - 1)?)
            }
            (None, Some(row)) => {
                let node = |column: usize| row * columns + column;
                (nearest(0, &node, columns - 1)?, row)
            }
            (None, None) => return None,
        };
        let node = row * self.columns + column;
        let is_free = taken[node].is_none() || distance(self.places[node], place) < near;
        is_free.then_some((node, place))
    }

    fn is_on_rim(&self, node: usize) -> bool {
        let (column, row) = (node % self.columns, node / self.columns);
        column == 0 || column + 1 == self.columns || row == 0 || row + 1 == self.rows
    }

    /// The nodes of a way along edges and diagonals of cells, as short and as near to
    /// the line as can be (Dijkstra 1959). It meets no other crease on its way.
    fn path(
        &self,
        from: usize,
        to: usize,
        line: &Line,
        places: &[[f64; 2]],
        taken: &[Option<usize>],
    ) -> Option<Vec<usize>> {
        let mut cost = vec![f64::INFINITY; places.len()];
        let mut before = vec![from; places.len()];
        let mut done = vec![false; places.len()];
        cost[from] = 0.0;
        loop {
            let open = (0..places.len()).filter(|&node| !done[node] && cost[node].is_finite());
            let here = open.min_by(|a, b| cost[*a].total_cmp(&cost[*b]))?;
            if here == to {
                break;
            }
            done[here] = true;
            for next in self.neighbours(here) {
                let is_way = next == to || (taken[next].is_none() && !self.is_on_rim(next));
                if done[next] || !is_way || self.crosses_fold(here, next) {
                    continue;
                }
                let [du, dv] = self.cell;
                let in_cells = |at: [f64; 2]| [at[0] / du, at[1] / dv];
                let apart = |a, b| distance(in_cells(a), in_cells(b));
                let off = if next == to {
                    0.0
                } else {
                    apart(places[next], line.nearest(places[next]))
                };
                let new = cost[here] + apart(places[here], places[next]) + OFF_LINE * off * off;
                if new < cost[next] {
                    (cost[next], before[next]) = (new, here);
                }
            }
        }
        let mut path = vec![to];
        while *path.last()? != from {
            path.push(before[*path.last()?]);
        }
        path.reverse();
        Some(path)
    }

    /// The eight nodes about one.
    fn neighbours(&self, node: usize) -> impl Iterator<Item = usize> + use<> {
        let (columns, rows) = (self.columns as isize, self.rows as isize);
        let (column, row) = (node as isize % columns, node as isize / columns);
        (0..9).filter_map(move |k| {
            let (i, j) = (column + k % 3 - 1, row + k / 3 - 1);
            let is_in = (0..columns).contains(&i) && (0..rows).contains(&j) && k != 4;
            is_in.then_some((j * columns + i) as usize)
        })
    }

    /// Whether the way between two neighbours is a diagonal of a cell that is folded
    /// along one.
    fn crosses_fold(&self, a: usize, b: usize) -> bool {
        let (low, high) = (a.min(b), a.max(b));
        let foot = match high - low {
            apart if apart == self.columns + 1 => low,
            apart if apart + 1 == self.columns => low - 1,
            _ => return false,
        };
        self.folded_diagonal(foot).is_some()
    }

    /// Moves the nodes that are on no crease as far as their neighbours are moved in the
    /// mean, those on an edge of the sheet along it.
    fn relax(&mut self, before: &[[f64; 2]], taken: &[Option<usize>]) {
        let (columns, rows) = (self.columns, self.rows);
        let pairs = self.places.iter().zip(before);
        let mut moved: Vec<[f64; 2]> = pairs
            .map(|(now, then)| [now[0] - then[0], now[1] - then[1]])
            .collect();
        for _ in 0..ROUNDS {
            for node in (0..moved.len()).filter(|&node| taken[node].is_none()) {
                let inner_u = !node.is_multiple_of(columns) && (node + 1) % columns != 0;
                let inner_v = node >= columns && node + columns < columns * rows;
                let mean = |step: usize, axis: usize| {
                    moved[node - step][axis].midpoint(moved[node + step][axis])
                };
                moved[node] = match (inner_u, inner_v) {
                    (false, false) => continue,
                    (true, false) => [mean(1, 0), 0.0],
                    (false, true) => [0.0, mean(columns, 1)],
                    (true, true) => {
                        core::array::from_fn(|axis| mean(1, axis).midpoint(mean(columns, axis)))
                    }
                };
            }
        }
        for node in (0..moved.len()).filter(|&node| taken[node].is_none()) {
            self.places[node] = core::array::from_fn(|axis| before[node][axis] + moved[node][axis]);
        }
    }

    /// Whether no cell is turned over or nearly flat.
    fn is_sound(&self, before: &[[f64; 2]]) -> bool {
        let columns = self.columns;
        let is_wide = |foot: usize| {
            let head = foot + columns;
            let corners = [foot, foot + 1, head, head + 1];
            let least = {
                let [a, _, _, d] = corners.map(|node| before[node]);
                LEAST_AREA * (d[0] - a[0]) * (d[1] - a[1])
            };
            let [a, b, c, d] = corners.map(|node| self.places[node]);
            [[a, b, d], [a, d, c], [a, b, c], [b, d, c]]
                .iter()
                .all(|[a, b, c]| twice_area(*a, *b, *c) > least)
        };
        self.cells().all(is_wide)
    }
}

impl Line {
    /// The point on it next to a place.
    fn nearest(&self, place: [f64; 2]) -> [f64; 2] {
        let way = [self.to[0] - self.from[0], self.to[1] - self.from[1]];
        let off = [place[0] - self.from[0], place[1] - self.from[1]];
        let part = (off[0] * way[0] + off[1] * way[1]) / (way[0] * way[0] + way[1] * way[1]);
        core::array::from_fn(|axis| self.from[axis] + part.clamp(0.0, 1.0) * way[axis])
    }

    /// Where it meets another within both, their ends too.
    fn meets(&self, other: &Line) -> Option<[f64; 2]> {
        let way = [self.to[0] - self.from[0], self.to[1] - self.from[1]];
        let theirs = [other.to[0] - other.from[0], other.to[1] - other.from[1]];
        let across = way[0] * theirs[1] - way[1] * theirs[0];
        let between = [other.from[0] - self.from[0], other.from[1] - self.from[1]];
        let own = (between[0] * theirs[1] - between[1] * theirs[0]) / across;
        let its = (between[0] * way[1] - between[1] * way[0]) / across;
        let within = |part: f64| (-1e-9..=1.0 + 1e-9).contains(&part);
        (within(own) && within(its))
            .then(|| core::array::from_fn(|axis| self.from[axis] + own * way[axis]))
    }
}
