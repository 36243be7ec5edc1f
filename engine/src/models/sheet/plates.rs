//! How stiff a creased sheet's paper counts beside clamps and creases.

use super::material::Material;
use super::settings::{Root, SheetSettings};
use crate::rigidity::Rigidity;

/// By how much Gregory's rule changes the trapezoidal rule's weights from an end on.
const GREGORY: [f64; 3] = [-1.0 / 8.0, 1.0 / 6.0, -1.0 / 24.0];

/// One over the weights of curvatures along u and along v at each node, relative to the
/// trapezoidal rule's. The turn of a sheet between two places is the integral of moment over
/// stiffness, and the moment's slope jumps at a clamp and at a crease; so between them
/// Gregory's rule is a better quadrature of it.
pub(super) fn weights(settings: &SheetSettings, material: &Material) -> [Vec<f64>; 2] {
    let (columns, rows) = (material.columns, material.rows);
    let nodes = columns * rows;
    let mut is_end = vec![false; nodes];
    for node in material.folds.iter().flat_map(|(edge, _)| edge) {
        is_end[*node] = true;
    }
    let mut weights = [vec![0.0; nodes], vec![0.0; nodes]];
    let lines = (0..rows).map(|row| (0, row * columns, 1, columns));
    for (axis, start, step, count) in
        lines.chain((0..columns).map(|column| (1, column, columns, rows)))
    {
        let node = |k: usize| start + k * step;
        let is_clamped = axis == 0 && settings.root != Root::Free;
        let ends: Vec<usize> = (0..count)
            .filter(|&k| is_end[node(k)] || (k == 0 && is_clamped))
            .collect();
        // Between two ends, or an end and a free edge, of at least two cells.
        let mut bounds = ends.clone();
        bounds.insert(0, 0);
        bounds.push(count - 1);
        for pair in bounds.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            let cells = to - from;
            let mut add = |k: usize, weight: f64| weights[axis][node(k)] += weight;
            for k in from..to {
                add(k, 0.5);
                add(k + 1, 0.5);
            }
            if cells < 2 {
                continue;
            }
            for (k, change) in GREGORY.into_iter().enumerate() {
                if ends.contains(&from) {
                    add(from + k, change);
                }
                if ends.contains(&to) {
                    add(to - k, change);
                }
            }
        }
        for k in 0..count {
            let rim = k == 0 || k + 1 == count;
            let weight = &mut weights[axis][node(k)];
            *weight = if rim { 0.5 } else { 1.0 } / *weight;
        }
    }
    weights
}

/// The plate as a triangle of a grid sees it: as stiff along each side as the weights of its
/// ends say, and softer by the hinge at the spine.
pub(super) fn plate_at(
    nodes: &[usize; 3],
    plate: &Rigidity,
    weights: &[Vec<f64>; 2],
    settings: &SheetSettings,
    material: &Material,
) -> Rigidity {
    let columns = material.columns;
    let mut plate = *plate;
    for k in 0..3 {
        let (from, to) = (nodes[k], nodes[(k + 1) % 3]);
        let weight = |axis: usize| weights[axis][from].midpoint(weights[axis][to]);
        if from % columns == to % columns {
            plate.d11 *= weight(0);
        } else if from / columns == to / columns {
            plate.d22 *= weight(1);
        }
        let is_at_spine = from.is_multiple_of(columns) && to.is_multiple_of(columns);
        if let (true, Root::Hinged(stiffness)) = (is_at_spine, settings.root) {
            let half_cell = 2.0 * plate.d11 / material.along_u(from.min(to));
            plate = plate.behind_hinge(stiffness / (stiffness + half_cell));
        }
    }
    plate
}
