//! A drawn leaf as flat facets, and what of it is next to a point.

use turnleaf_engine::PaperMesh;
use turnleaf_engine::Surface;
use turnleaf_engine::book::Book;

use super::folds::Folds;
use super::triangle::{Crossing, Point, cross, crossing, dot, nearest_of_triangle, sub};

/// Cells along a side of a block of facets that one box bounds, and blocks along
/// a side of a group.
const BLOCK: usize = 3;
const GROUP: usize = 4;

/// Where a point is from a surface.
#[derive(Clone, Copy, Debug)]
pub struct Near {
    /// Distance to the nearest facet, metres.
    pub distance: f32,
    /// Whether the point lies on the side of the recto of that facet, or of its verso where it is
    /// folded over: what is next to a leaf is on one side of all of it.
    pub recto: bool,
    /// Whether the nearest place is on the rim, so that the point has no side.
    pub rim: bool,
}

/// A surface cut into its facets, as the viewer draws it: each cell's diagonal
/// runs from its corner next to the spine and the foot, or where a fold has it run otherwise
/// from the corner above that.
pub struct Facets<'a> {
    columns: usize,
    rows: usize,
    points: &'a [Point],
    /// What folds change; None of a leaf without any.
    folds: Option<Folds>,
    blocks: Vec<Block>,
    groups: Vec<(Bounds, core::ops::Range<usize>)>,
}

struct Block {
    bounds: Bounds,
    columns: core::ops::Range<usize>,
    rows: core::ops::Range<usize>,
    /// A direction across it, and how far along that its points reach.
    across: Point,
    reach: [f32; 2],
}

impl Block {
    /// Whether an edge may meet facets of the block.
    fn may_meet(&self, p: Point, q: Point, edge: &Bounds) -> bool {
        if !self.bounds.meets(edge) {
            return false;
        }
        let (a, b) = (dot(p, self.across), dot(q, self.across));
        a.max(b) >= self.reach[0] && a.min(b) <= self.reach[1]
    }

    /// Whether a tile has points in common with it.
    fn touches(&self, other: &Block) -> bool {
        let [c, d, r, s] = [&self.columns, &other.columns, &self.rows, &other.rows];
        c.start <= d.end && d.start <= c.end && r.start <= s.end && s.start <= r.end
    }
}

/// A box: its least and its greatest corner, metres.
#[derive(Clone, Copy)]
pub struct Bounds([f32; 3], [f32; 3]);

impl Bounds {
    const NONE: Bounds = Bounds([f32::MAX; 3], [f32::MIN; 3]);

    /// The box around points; one that holds nothing where there are none.
    pub fn of(points: impl IntoIterator<Item = Point>) -> Bounds {
        points.into_iter().fold(Bounds::NONE, |b, p| {
            Bounds(
                core::array::from_fn(|i| b.0[i].min(p[i])),
                core::array::from_fn(|i| b.1[i].max(p[i])),
            )
        })
    }

    fn square_distance(&self, p: Point) -> f32 {
        let out = |i: usize| (self.0[i] - p[i]).max(p[i] - self.1[i]).max(0.0);
        let d = [out(0), out(1), out(2)];
        dot(d, d)
    }

    fn meets(&self, other: &Bounds) -> bool {
        (0..3).all(|i| self.0[i] <= other.1[i] && other.0[i] <= self.1[i])
    }

    /// The box around both.
    fn with(self, other: Bounds) -> Bounds {
        Bounds::of([self.0, self.1, other.0, other.1])
    }

    /// Whether all unit vectors in it are less than a right angle from its middle.
    fn is_narrow(&self) -> bool {
        let middle: Point = core::array::from_fn(|i| self.0[i] + self.1[i]);
        let least = |i: usize| (middle[i] * self.0[i]).min(middle[i] * self.1[i]);
        least(0) + least(1) + least(2) > 0.0
    }
}

impl<'a> Facets<'a> {
    /// Of the leaf that a book draws at `index`, counted from the left; None where it draws none.
    pub fn of(book: &'a Book, index: usize) -> Option<Facets<'a>> {
        let surface = book.surface(index)?;
        Some(match book.paper_mesh(index) {
            Some(mesh) => Facets::folded(surface, mesh),
            None => Facets::new(surface),
        })
    }

    /// Of a drawn surface with folds.
    pub fn folded(surface: &'a Surface, mesh: &PaperMesh) -> Facets<'a> {
        let facets = Facets::new(surface);
        let folds = Folds::of(facets.columns, facets.points, mesh);
        Facets {
            folds: Some(folds),
            ..facets
        }
    }

    /// Of a drawn surface without folds.
    pub fn new(surface: &'a Surface) -> Facets<'a> {
        let (columns, rows) = (surface.columns, surface.rows);
        let points = surface.positions.as_chunks::<3>().0;
        let (mut blocks, mut groups) = (Vec::new(), Vec::new());
        let group = BLOCK * GROUP;
        for (row, column) in places(rows - 1, columns - 1, group) {
            let from = blocks.len();
            let (high, wide) = (group.min(rows - 1 - row), group.min(columns - 1 - column));
            for (r, c) in places(high, wide, BLOCK) {
                let columns_of = column + c..(column + c + BLOCK).min(columns - 1);
                let rows_of = row + r..(row + r + BLOCK).min(rows - 1);
                let corners = (rows_of.start..=rows_of.end)
                    .flat_map(|r| (columns_of.start..=columns_of.end).map(move |c| (r, c)))
                    .map(|(r, c)| points[r * columns + c]);
                let at = |r: usize, c: usize| points[r * columns + c];
                let (r, s, c, d) = (rows_of.start, rows_of.end, columns_of.start, columns_of.end);
                let across = cross(sub(at(s, d), at(r, c)), sub(at(s, c), at(r, d)));
                let across = across.map(|x| x / dot(across, across).sqrt().max(1e-30));
                let reach = corners
                    .clone()
                    .map(|p| dot(p, across))
                    .fold([f32::MAX, f32::MIN], |[a, b], h| [a.min(h), b.max(h)]);
                blocks.push(Block {
                    bounds: Bounds::of(corners),
                    columns: columns_of,
                    rows: rows_of,
                    across,
                    // Rounding of places metres away.
                    reach: [reach[0] - 1e-6, reach[1] + 1e-6],
                });
            }
            let all = blocks[from..]
                .iter()
                .flat_map(|b: &Block| [b.bounds.0, b.bounds.1]);
            groups.push((Bounds::of(all), from..blocks.len()));
        }
        Facets {
            columns,
            rows,
            points,
            folds: None,
            blocks,
            groups,
        }
    }

    /// The surface's points, row by row from the foot, metres.
    pub fn points(&self) -> &'a [Point] {
        self.points
    }

    /// What its creases change of its facets; None where it has none.
    #[cfg(test)]
    pub fn folds(&self) -> Option<&Folds> {
        self.folds.as_ref()
    }

    /// Points along a row.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Every edge of every facet, as numbers of points.
    pub fn edges(&self) -> impl Iterator<Item = [usize; 2]> {
        let (columns, rows) = (self.columns, self.rows);
        (0..columns * rows).flat_map(move |node| {
            let (right, up) = (node % columns + 1 < columns, node / columns + 1 < rows);
            [
                right.then_some([node, node + 1]),
                up.then_some([node, node + columns]),
                (right && up).then(|| self.diagonal(node)),
            ]
            .into_iter()
            .flatten()
        })
    }

    /// Whether the diagonal of the cell whose first point is `here` runs the other way.
    fn is_falling(&self, here: usize) -> bool {
        self.folds.as_ref().is_some_and(|folds| folds.falling[here])
    }

    /// The diagonal of the cell whose first point is `here`.
    fn diagonal(&self, here: usize) -> [usize; 2] {
        let above = here + self.columns;
        if self.is_falling(here) {
            [here + 1, above]
        } else {
            [here, above + 1]
        }
    }

    /// The two facets of a cell, each turning left as the recto sees it.
    fn cell(&self, row: usize, column: usize) -> [[usize; 3]; 2] {
        let here = row * self.columns + column;
        let above = here + self.columns;
        if self.is_falling(here) {
            [[here, here + 1, above], [here + 1, above + 1, above]]
        } else {
            [[here, here + 1, above + 1], [here, above + 1, above]]
        }
    }

    /// The same, each with whether it is folded over.
    fn sided_cell(&self, row: usize, column: usize) -> [([usize; 3], bool); 2] {
        let here = row * self.columns + column;
        let folds = self.folds.as_ref();
        let turned_over = folds.map_or([false; 2], |folds| folds.turned_over[here]);
        let facets = self.cell(row, column);
        [0, 1].map(|k| (facets[k], turned_over[k]))
    }

    /// What is next to a point, where that is nearer than `within` metres.
    pub fn near(&self, point: Point, within: f32) -> Option<Near> {
        let mut best: Option<(f32, f32, Near)> = None;
        let mut least = within * within;
        for (bounds, blocks) in &self.groups {
            if bounds.square_distance(point) > least {
                continue;
            }
            for block in &self.blocks[blocks.clone()] {
                if block.bounds.square_distance(point) > least {
                    continue;
                }
                for row in block.rows.clone() {
                    for column in block.columns.clone() {
                        for facet in self.sided_cell(row, column) {
                            self.nearer(point, facet, &mut least, &mut best);
                        }
                    }
                }
            }
        }
        best.map(|best| best.2)
    }

    /// Keeps the facet where it is nearer than those before; of those equally
    /// near, as at a common edge, the one that the point is most clearly beside.
    fn nearer(
        &self,
        point: Point,
        (facet, is_turned_over): ([usize; 3], bool),
        least: &mut f32,
        best: &mut Option<(f32, f32, Near)>,
    ) {
        let [a, b, c] = facet.map(|node| self.points[node]);
        let (place, parts) = nearest_of_triangle(point, a, b, c);
        let away = sub(point, place);
        let d = dot(away, away);
        if d > *least * 1.0001 + 1e-14 {
            return;
        }
        let normal = cross(sub(b, a), sub(c, a));
        let height = dot(away, normal) / dot(normal, normal).sqrt().max(1e-20);
        let clearer =
            best.is_none_or(|(known, clear, _)| d < known * 0.9999 - 1e-14 || height.abs() > clear);
        if clearer {
            let near = Near {
                distance: d.sqrt(),
                recto: (height >= 0.0) != is_turned_over,
                rim: self.is_on_rim(facet, parts),
            };
            *best = Some((d, height.abs(), near));
        }
        *least = least.min(d);
    }

    /// Whether the place with these parts of a facet's corners is on the rim.
    fn is_on_rim(&self, facet: [usize; 3], parts: [f32; 3]) -> bool {
        let used = || facet.iter().zip(parts).filter(|(_, part)| *part > 0.0);
        let all = |is: &dyn Fn(usize) -> bool| used().all(|(node, _)| is(*node));
        all(&|node| node / self.columns == 0)
            || all(&|node| node / self.columns + 1 == self.rows)
            || all(&|node| node % self.columns == 0)
            || all(&|node| node % self.columns + 1 == self.columns)
    }

    /// Edges that may meet another leaf, as numbers of points.
    pub fn edges_near(&self, other: &Facets<'_>) -> Vec<[usize; 2]> {
        let mut found = Vec::new();
        for (bounds, blocks) in &self.groups {
            let near: Vec<&Block> = other
                .groups
                .iter()
                .filter(|(met, _)| met.meets(bounds))
                .flat_map(|(_, blocks)| &other.blocks[blocks.clone()])
                .filter(|block| block.bounds.meets(bounds))
                .collect();
            for block in &self.blocks[blocks.clone()] {
                if near.iter().any(|met| met.bounds.meets(&block.bounds)) {
                    found.extend(self.edges_of(block));
                }
            }
        }
        found
    }

    /// Whether an edge of either goes through a facet of the other.
    pub fn goes_through(&self, other: &Facets<'_>) -> bool {
        let meets = |own: &Facets<'_>, other: &Facets<'_>| {
            own.edges_near(other).into_iter().any(|edge| {
                let [p, q] = edge.map(|node| own.points[node]);
                !other.crossings(p, q).is_empty()
            })
        };
        meets(self, other) || meets(other, self)
    }

    /// Edges of the facets of a block, those on its first row and column included.
    fn edges_of(&self, block: &Block) -> impl Iterator<Item = [usize; 2]> {
        let columns = self.columns;
        // The last of a leaf have no block beyond them.
        let last = [
            block.columns.end + 1 == self.columns,
            block.rows.end + 1 == self.rows,
        ];
        let (from, to) = (block.columns.start, block.columns.end);
        let (below, above) = (block.rows.start, block.rows.end);
        (below..=above)
            .flat_map(move |row| (from..=to).map(move |column| (row, column)))
            .flat_map(move |(row, column)| {
                let here = row * columns + column;
                let (right, up) = (column < to, row < above);
                [
                    (right && (up || last[1])).then_some([here, here + 1]),
                    (up && (right || last[0])).then_some([here, here + columns]),
                    (right && up).then(|| self.diagonal(here)),
                ]
                .into_iter()
                .flatten()
            })
    }

    /// Edges of the leaf that go through facets of the same leaf, and these.
    pub fn own_crossings(&self) -> Vec<([usize; 2], [usize; 3])> {
        let mut found = Vec::new();
        let normals: Vec<Bounds> = self
            .blocks
            .iter()
            .map(|block| self.normals_of(block))
            .collect();
        let whole = normals.iter().copied().fold(Bounds::NONE, Bounds::with);
        if whole.is_narrow() {
            return found;
        }
        for (i, own) in self.blocks.iter().enumerate() {
            for (k, other) in self.blocks.iter().enumerate() {
                // What has points in common meets only where it is folded upon itself.
                if !own.bounds.meets(&other.bounds)
                    || (own.touches(other) && normals[i].with(normals[k]).is_narrow())
                {
                    continue;
                }
                self.crossings_of(own, other, &mut found);
            }
        }
        found
    }

    fn crossings_of(&self, own: &Block, other: &Block, found: &mut Vec<([usize; 2], [usize; 3])>) {
        for edge in self.edges_of(own) {
            let [p, q] = edge.map(|node| self.points[node]);
            if !other.may_meet(p, q, &Bounds::of([p, q])) {
                continue;
            }
            for row in other.rows.clone() {
                for column in other.columns.clone() {
                    for facet in self.cell(row, column) {
                        if facet.iter().any(|node| edge.contains(node)) {
                            continue;
                        }
                        let corners = facet.map(|node| self.points[node]);
                        if crossing(p, q, corners).is_some() {
                            found.push((edge, facet));
                        }
                    }
                }
            }
        }
    }

    /// The box around the unit normals of the facets of a block.
    fn normals_of(&self, block: &Block) -> Bounds {
        let cells = block
            .rows
            .clone()
            .flat_map(|row| block.columns.clone().map(move |column| (row, column)));
        Bounds::of(cells.flat_map(|(row, column)| {
            self.cell(row, column).map(|facet| {
                let [a, b, c] = facet.map(|node| self.points[node]);
                let n = cross(sub(b, a), sub(c, a));
                n.map(|x| x / dot(n, n).sqrt().max(1e-30))
            })
        }))
    }

    /// How far a point is from the nearest facet of the cells within `cells` of a facet,
    /// but for those next to the point itself, metres.
    pub fn distance_to_part(&self, node: usize, facet: [usize; 3], cells: usize) -> f32 {
        let (columns, rows) = (self.columns, self.rows);
        let (column, row) = (facet[0] % columns, facet[0] / columns);
        let (own_column, own_row) = (node % columns, node / columns);
        let mut least = f32::MAX;
        for r in row.saturating_sub(cells)..(row + cells + 1).min(rows - 1) {
            for c in column.saturating_sub(cells)..(column + cells + 1).min(columns - 1) {
                if own_column.abs_diff(c) <= 2 && own_row.abs_diff(r) <= 2 {
                    continue;
                }
                for facet in self.cell(r, c) {
                    let [a, b, d] = facet.map(|node| self.points[node]);
                    let (place, _) = nearest_of_triangle(self.points[node], a, b, d);
                    let away = sub(self.points[node], place);
                    least = least.min(dot(away, away));
                }
            }
        }
        least.sqrt()
    }

    /// How far a point is from the plane of a facet, metres.
    pub fn height_over(&self, node: usize, facet: [usize; 3]) -> f32 {
        let [a, b, c] = facet.map(|node| self.points[node]);
        let normal = cross(sub(b, a), sub(c, a));
        dot(sub(self.points[node], a), normal).abs() / dot(normal, normal).sqrt().max(1e-30)
    }

    /// Where the edge from `p` to `q` goes through facets, and through which.
    pub fn crossings(&self, p: Point, q: Point) -> Vec<(Crossing, [usize; 3])> {
        let mut found = Vec::new();
        let edge = Bounds::of([p, q]);
        for (bounds, blocks) in &self.groups {
            if !bounds.meets(&edge) {
                continue;
            }
            for block in &self.blocks[blocks.clone()] {
                if !block.may_meet(p, q, &edge) {
                    continue;
                }
                for row in block.rows.clone() {
                    for column in block.columns.clone() {
                        for (facet, is_turned_over) in self.sided_cell(row, column) {
                            let corners = facet.map(|node| self.points[node]);
                            found.extend(crossing(p, q, corners).map(|crossing| {
                                let from_recto = crossing.from_recto != is_turned_over;
                                let through = Crossing {
                                    from_recto,
                                    ..crossing
                                };
                                (through, facet)
                            }));
                        }
                    }
                }
            }
        }
        found
    }
}

/// First rows and columns of squares of a size in a grid.
fn places(rows: usize, columns: usize, size: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..rows)
        .step_by(size)
        .flat_map(move |row| (0..columns).step_by(size).map(move |column| (row, column)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A level surface of 7 x 5 points, a centimetre apart.
    fn level() -> Surface {
        let mut surface = Surface::new(7, 5);
        for (node, point) in surface.positions.chunks_exact_mut(3).enumerate() {
            point.copy_from_slice(&[(node % 7) as f32 * 0.01, (node / 7) as f32 * 0.01, 0.0]);
        }
        surface
    }

    #[test]
    fn points_over_and_under_and_beside() {
        let surface = level();
        let facets = Facets::new(&surface);
        let over = facets.near([0.033, 0.022, 0.002], 0.01).unwrap();
        assert!(over.recto && !over.rim && (over.distance - 0.002).abs() < 1e-7);
        let under = facets.near([0.02, 0.02, -0.003], 0.01).unwrap();
        assert!(!under.recto && !under.rim && (under.distance - 0.003).abs() < 1e-7);
        assert!(facets.near([0.065, 0.02, -0.001], 0.01).unwrap().rim);
        assert!(facets.near([0.03, 0.02, 0.02], 0.01).is_none());
    }

    #[test]
    fn an_edge_goes_through_where_it_does() {
        let surface = level();
        let facets = Facets::new(&surface);
        let through = facets.crossings([0.031, 0.022, -0.001], [0.031, 0.022, 0.003]);
        assert_eq!(through.len(), 1);
        assert!((through[0].0.at - 0.25).abs() < 1e-6 && !through[0].0.from_recto);
        assert!(
            facets
                .crossings([0.031, 0.022, 0.001], [0.03, 0.02, 0.003])
                .is_empty()
        );
    }
}
