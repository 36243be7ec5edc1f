//! What a sheet that is torn across has beside any other: where its tear runs on the page, and how
//! it is drawn beside it.

use super::flat::length;
use super::material::Material;
use super::torn_grid::{Frame, TornGrid};
use super::torn_path::{even_stations, places_along};
use crate::real::bounded;

/// Drawn cells along a side of one of the grid.
const PARTS: usize = 3;

/// By how much either piece is drawn beyond the path, metres: the picture cuts both along one
/// ragged line that wanders by less.
const BEYOND: f64 = 0.001;

/// How a sheet is torn across, or was.
#[derive(Clone, Debug)]
pub(super) struct Torn {
    /// How its page's places are counted.
    pub frame: Frame,
    path: Vec<[f64; 2]>,
    /// How far along the path its nodes lie, metres; None where they do evenly.
    stations: Option<Vec<f64>>,
    is_from_end: bool,
    /// The piece that the sheet is; None while it is both.
    pub piece: Option<Piece>,
}

/// A piece of a torn page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Piece {
    /// What lies to the right of the path.
    Foot,
    /// What lies to the left of it.
    Head,
}

impl Torn {
    /// The tear of a grid of which both pieces are there.
    pub fn of(grid: &TornGrid) -> Self {
        Self {
            frame: grid.frame,
            path: grid.path.clone(),
            stations: grid.stations.clone(),
            is_from_end: grid.is_from_end,
            piece: None,
        }
    }

    /// The tear of one of its pieces.
    pub fn of_piece(&self, piece: Piece) -> Self {
        Self {
            piece: Some(piece),
            ..self.clone()
        }
    }

    /// The points at which a sheet of a material is drawn: those beside the path lie on the other
    /// side of it.
    pub fn drawn(&self, material: &Material) -> Material {
        let mut drawn = material.refined(PARTS);
        let columns = drawn.columns;
        let path = places_along(&self.path, &self.drawn_stations(columns));
        for (row, sign) in self.rims(&drawn) {
            for column in 0..columns {
                let place = path[column];
                let [a, b] = [column.saturating_sub(1), (column + 1).min(columns - 1)];
                let way = [path[b][0] - path[a][0], path[b][1] - path[a][1]];
                let long = libm::hypot(way[0], way[1]);
                let normal = [-way[1] / long, way[0] / long];
                // At its ends the page's edge is kept.
                let along = if column == 0 || column + 1 == columns {
                    edge_at(place, drawn.size)
                } else {
                    normal
                };
                let rise = along[0] * normal[0] + along[1] * normal[1];
                let by = sign * BEYOND
                    / if rise.abs() < 0.3 {
                        0.3f64.copysign(rise)
                    } else {
                        rise
                    };
                drawn.places[row * columns + column] = [0, 1]
                    .map(|axis| bounded(place[axis] + by * along[axis], 0.0, drawn.size[axis]));
            }
        }
        drawn
    }

    /// How far along the path so many drawn columns lie, metres.
    fn drawn_stations(&self, columns: usize) -> Vec<f64> {
        let Some(stations) = &self.stations else {
            return even_stations(length(&self.path), columns);
        };
        let between = |column: usize| {
            let left = (column / PARTS).min(stations.len() - 2);
            let part = (column - PARTS * left) as f64 / PARTS as f64;
            stations[left] + part * (stations[left + 1] - stations[left])
        };
        (0..columns).map(between).collect()
    }

    /// The drawn rows on the path, each with the sign of the side of it that lies beyond its own
    /// piece: 1 is the left.
    fn rims(&self, drawn: &Material) -> Vec<(usize, f64)> {
        match self.piece {
            None => vec![(drawn.run_of(0).end - 1, 1.0), (drawn.run_of(0).end, -1.0)],
            Some(Piece::Foot) => vec![(drawn.rows - 1, 1.0)],
            Some(Piece::Head) => vec![(0, -1.0)],
        }
    }

    /// Where a drawn point lies by the tear: see [`PaperMesh::tears`](crate::PaperMesh::tears).
    pub fn tear_at(&self, drawn: &Material, point: usize) -> [f32; 3] {
        let row = point / drawn.columns;
        let is_head = match self.piece {
            None => !drawn.run_of(0).contains(&row),
            Some(piece) => piece == Piece::Head,
        };
        let is_rim = self.rims(drawn).iter().any(|(rim, _)| *rim == row);
        let place = drawn.places[point];
        let (mut nearest, mut along, mut before) = (f64::INFINITY, 0.0, 0.0);
        for pair in self.path.windows(2) {
            let way = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
            let long = libm::hypot(way[0], way[1]);
            let off = [place[0] - pair[0][0], place[1] - pair[0][1]];
            let part = ((off[0] * way[0] + off[1] * way[1]) / (long * long)).clamp(0.0, 1.0);
            let away = libm::hypot(off[0] - part * way[0], off[1] - part * way[1]);
            if away < nearest {
                (nearest, along) = (away, before + part * long);
            }
            before += long;
        }
        let own = if is_rim { -BEYOND } else { nearest };
        let along = if self.is_from_end {
            length(&self.path) - along
        } else {
            along
        };
        [own as f32, along as f32, if is_head { 1.0 } else { -1.0 }]
    }
}

/// The direction of the page's edge on which a place lies.
fn edge_at([x, _]: [f64; 2], [width, _]: [f64; 2]) -> [f64; 2] {
    if x <= 0.0 || x >= width {
        [0.0, 1.0]
    } else {
        [1.0, 0.0]
    }
}
