//! Where nodes of another grid are on a sheet: between its own, or between the points at which it
//! is drawn.

use crate::interpolate::uniform_samples;
use crate::models::sheet::Sheet;
use crate::surface::Surface;

/// Where the nodes of a finer grid are on a sheet: between those of its own.
pub(super) fn finer(sheet: &Sheet, [columns, rows]: [usize; 2]) -> Vec<[f32; 3]> {
    let (coarse, even) = evenly(sheet);
    nodes_of(&coarse, &even, [columns, rows])
}

/// Where places of a sheet's page are, u and v of each.
pub(super) fn at_places(sheet: &Sheet, places: &[[f64; 2]]) -> Vec<[f32; 3]> {
    let (coarse, even) = evenly(sheet);
    let at = |place: &[f64; 2]| point_at(&coarse, &even, place.map(|at| at as f32));
    places.iter().map(at).collect()
}

/// A sheet drawn at its nodes, and u of their columns.
fn evenly(sheet: &Sheet) -> (Surface, Vec<f32>) {
    let settings = sheet.settings();
    let drawn = Surface {
        positions: sheet.positions().to_vec(),
        ..Surface::new(settings.columns, settings.rows)
    };
    (drawn, uniform_samples(settings.columns))
}

/// Where so many columns and rows of nodes of a leaf are that is drawn at the columns `u` and
/// even rows: between its points.
pub(super) fn nodes_of(drawn: &Surface, u: &[f32], [columns, rows]: [usize; 2]) -> Vec<[f32; 3]> {
    let mut nodes = Vec::with_capacity(columns * rows);
    for row in 0..rows {
        for column in 0..columns {
            let at = [(column, columns), (row, rows)].map(|(k, of)| k as f32 / (of - 1) as f32);
            nodes.push(point_at(drawn, u, at));
        }
    }
    nodes
}

/// Where a place of a leaf is that is drawn at the columns `u` and even rows: between its points.
fn point_at(drawn: &Surface, columns: &[f32], [u, v]: [f32; 2]) -> [f32; 3] {
    let v = v * (drawn.rows - 1) as f32;
    let low = (v as usize).min(drawn.rows - 2);
    let left = columns.partition_point(|column| *column <= u);
    let left = left.clamp(1, columns.len() - 1) - 1;
    let part = (u - columns[left]) / (columns[left + 1] - columns[left]);
    let along = |row: usize| {
        let [a, b] = [left, left + 1].map(|column| drawn.position(column, row));
        core::array::from_fn::<f32, 3, _>(|axis| a[axis] + part * (b[axis] - a[axis]))
    };
    let [a, b] = [along(low), along(low + 1)];
    let part = v - low as f32;
    core::array::from_fn(|axis| a[axis] + part * (b[axis] - a[axis]))
}
