//! A sheet that is being torn goes on with another path: its nodes come to lie at other places
//! of the paper, and the paper beside the path may belong to the other piece from then on.
//!
//! Paper ahead of the tip holds by ties, which are stretched near the tip. What changes
//! its piece moves by as much as the pieces are apart there, so that either piece keeps its shape
//! and every tie its stretch.

use super::creased::Creased;
use super::flat::distance;
use super::grid_walk::{LocatedPlace, locate};
use super::hinges::Hinges;
use super::material::Material;
use super::patches::Patches;
use super::torn::Torn;
use super::torn_grid::TornGrid;
use super::{Sheet, SheetSettings};
use crate::creased_only::CreasedOnly;
use crate::vector::sub;

/// By how much a weight may be below 0 of a place that counts as in a triangle: those on the rim
/// are, by rounding.
const ROUNDING: f64 = 1e-6;

/// Where a node of the new grid lies on the old one.
struct MovedNode {
    at: LocatedPlace,
    /// If it changes its piece, the column next to which it does so and how far it lies from
    /// there to the next; and 1 where it comes to the piece at the head.
    changes: Option<(usize, f64, f32)>,
}

impl MovedNode {
    /// Returns the node's three numbers of those of the old nodes.
    fn of(&self, material: &Material, values: &[f32]) -> [f32; 3] {
        let own = self.at.mean(values);
        let Some((column, part, sign)) = self.changes else {
            return own;
        };
        let seam = material.columns * material.runs()[0].end;
        let x = values.as_chunks::<3>().0;
        let apart = |column: usize| sub(x[seam + column], x[seam + column - material.columns]);
        let [a, b] = [apart(column), apart(column + 1)];
        core::array::from_fn(|axis| {
            own[axis] + sign * (a[axis] + part as f32 * (b[axis] - a[axis]))
        })
    }
}

impl Sheet {
    /// Goes on with another grid of the page along whose path it is being torn, as
    /// [`TornGrid::turned`] makes it of the grid that it has. `paper` are the settings of the whole
    /// sheet, `tick` is how long it is stepped at once, seconds.
    ///
    /// `shown` are the points at which it is drawn, x, y, z of each: from then on where its new ones
    /// were drawn. Ties are to be set anew.
    pub(crate) fn turn_tear(
        &mut self,
        grid: &TornGrid,
        paper: &SheetSettings,
        tick: f64,
        shown: &mut Vec<f32>,
    ) {
        let material = Material::torn(grid);
        let torn = Torn::of(grid);
        let drawn = torn.drawn(&material);
        if let Some(patches) = self.creased().and_then(|creased| creased.patches.as_ref()) {
            *shown = carried_points(&patches.drawn, &drawn, shown);
        }
        let moved = moved_nodes(&self.material, &material);
        for values in [&mut self.positions, &mut self.velocities] {
            let new: Vec<[f32; 3]> = moved
                .iter()
                .map(|at| at.of(&self.material, values))
                .collect();
            values.copy_from_slice(new.as_flattened());
        }
        self.settings = settings_over(paper, grid, material.rows, tick);
        self.creased = CreasedOnly::some(Box::new(Creased {
            lines: Vec::new(),
            hinges: Hinges::new(&self.settings, &material, &[]),
            patches: Some(Patches::over(&material, drawn)),
            torn: Some(torn),
        }));
        self.lie_on(material);
        self.sweep.run(&mut self.positions, &[]);
    }

    /// Returns how near the path of a grid comes to a place that a grab holds, metres; infinite where
    /// none does.
    pub(crate) fn nearest_grab(&self, grid: &TornGrid) -> f64 {
        let mut nearest = f64::INFINITY;
        for grab in &self.grabs {
            for place in &grid.path {
                nearest = nearest.min(distance(*place, grab.place()));
            }
        }
        nearest
    }

    /// How the paper of a torn sheet lies in space: the ways there, of about unit length, along u and
    /// along v of its frame, by the plane that fits its nodes best. None where these lie on a line.
    pub(crate) fn lies_along(&self) -> Option<[[f64; 3]; 2]> {
        let x = self.positions.as_chunks::<3>().0;
        let nodes = || 0..x.len();
        let count = x.len() as f64;
        let (mut flat, mut space) = ([0.0; 2], [0.0; 3]);
        for node in nodes() {
            for axis in 0..2 {
                flat[axis] += self.material.places[node][axis] / count;
            }
            for axis in 0..3 {
                space[axis] += f64::from(x[node][axis]) / count;
            }
        }
        let (mut uu, mut uv, mut vv) = (0.0, 0.0, 0.0);
        let mut sums = [[0.0; 3]; 2];
        for node in nodes() {
            let [u, v] = [0, 1].map(|axis| self.material.places[node][axis] - flat[axis]);
            uu += u * u;
            uv += u * v;
            vv += v * v;
            for axis in 0..3 {
                let off = f64::from(x[node][axis]) - space[axis];
                sums[0][axis] += off * u;
                sums[1][axis] += off * v;
            }
        }
        let determinant = uu * vv - uv * uv;
        let [by_u, by_v] = sums;
        (determinant > f64::MIN_POSITIVE).then(|| {
            [
                core::array::from_fn(|axis| (vv * by_u[axis] - uv * by_v[axis]) / determinant),
                core::array::from_fn(|axis| (uu * by_v[axis] - uv * by_u[axis]) / determinant),
            ]
        })
    }
}

/// The settings of a sheet of a paper over the grid of a torn page, of so many rows in all.
pub(super) fn settings_over(
    paper: &SheetSettings,
    grid: &TornGrid,
    rows: usize,
    tick: f64,
) -> SheetSettings {
    let mut settings = paper.clone();
    if grid.frame.is_turned() {
        settings.grain = settings.grain.turned();
    }
    settings
        .over(grid.columns, rows, grid.cell())
        .bearable(tick)
}

/// Where each node of a torn material lies on another of the same page and as many nodes.
fn moved_nodes(from: &Material, to: &Material) -> Vec<MovedNode> {
    let move_of = |node: usize| {
        let (own, other) = pieces_of(from, node);
        let place = to.places[node];
        let at = locate(from, &own, place, node);
        if at.least() >= -ROUNDING {
            return MovedNode { at, changes: None };
        }
        let beyond = locate(from, &other, place, node);
        if beyond.least() <= at.least() {
            return MovedNode { at, changes: None };
        }
        let (column, part) = nearest_column(from, place);
        let sign = if own.start > 0 { 1.0 } else { -1.0 };
        MovedNode {
            at: beyond,
            changes: Some((column, part, sign)),
        }
    };
    (0..to.places.len()).map(move_of).collect()
}

/// Where the points of a drawn grid were drawn, of those of another of the same page and as many
/// points: each with the piece to which it belonged.
fn carried_points(from: &Material, to: &Material, shown: &[f32]) -> Vec<f32> {
    let place_of = |point: usize| {
        let (own, other) = pieces_of(from, point);
        let place = to.places[point];
        let at = locate(from, &own, place, point);
        if at.least() >= -ROUNDING {
            return at.mean(shown);
        }
        let beyond = locate(from, &other, place, point);
        let nearer = if beyond.least() > at.least() {
            beyond
        } else {
            at
        };
        nearer.mean(shown)
    };
    let points: Vec<[f32; 3]> = (0..to.places.len()).map(place_of).collect();
    points.into_flattened()
}

/// The rows of the piece to which a node belongs, and those of the other.
fn pieces_of(
    material: &Material,
    node: usize,
) -> (core::ops::Range<usize>, core::ops::Range<usize>) {
    let [before, beyond] = material.runs();
    if before.contains(&(node / material.columns)) {
        (before, beyond)
    } else {
        (beyond, before)
    }
}

/// The column of the path that is next to a place or before it, and how far it lies from there to
/// the next, 0 to 1.
fn nearest_column(material: &Material, place: [f64; 2]) -> (usize, f64) {
    let seam = material.columns * material.runs()[0].end;
    let rim = &material.places[seam..seam + material.columns];
    let mut best = (f64::INFINITY, 0, 0.0);
    for (column, pair) in rim.windows(2).enumerate() {
        let way = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
        let off = [place[0] - pair[0][0], place[1] - pair[0][1]];
        let square = (way[0] * way[0] + way[1] * way[1]).max(f64::MIN_POSITIVE);
        let part = ((off[0] * way[0] + off[1] * way[1]) / square).clamp(0.0, 1.0);
        let away = distance([part * way[0], part * way[1]], off);
        if away < best.0 {
            best = (away, column, part);
        }
    }
    (best.1, best.2)
}
