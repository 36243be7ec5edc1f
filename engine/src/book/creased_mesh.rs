//! The drawn mesh of a creased sheet: where its points are on the flat paper, and its parts.

use crate::contact::mesh::{find_beyond, find_falling};
use crate::contact::separate_parts::DrawnParts;
use crate::models::sheet::Sheet;

/// How the drawn mesh of a creased leaf lies on its flat paper.
#[derive(Clone, Debug, Default)]
pub struct CreasedMesh {
    /// u and v of each point, row by row from the foot.
    pub places: Vec<f32>,
    /// The points of each triangle, three by three; no triangle reaches over a crease.
    pub triangles: Vec<u32>,
    /// The part of the leaf that each triangle belongs to: see [`Sheet::drawn_triangles`](crate::Sheet::drawn_triangles).
    pub parts: Vec<u16>,
    /// See [`Folds::falling`](crate::contact::mesh::Folds::falling).
    pub(super) falling: Vec<bool>,
    /// Whether each point lies beyond a crease as seen from the spine.
    pub(super) beyond: Vec<bool>,
}

impl CreasedMesh {
    /// The mesh of a creased sheet, and its parts between the creases; None of another sheet.
    pub(super) fn of(sheet: &Sheet) -> Option<(CreasedMesh, DrawnParts)> {
        let places = sheet.drawn_places()?;
        let triangles = sheet.drawn_triangles();
        let columns = sheet.drawn_columns();
        let corners = triangles.iter().flat_map(|(corners, _)| corners);
        let cells = triangles.iter().map(|(corners, _)| *corners);
        let mesh = CreasedMesh {
            falling: find_falling(cells, columns, places.len()),
            beyond: find_beyond(&triangles, places.len()),
            triangles: corners.map(|corner| *corner as u32).collect(),
            parts: triangles.iter().map(|(_, part)| *part).collect(),
            places: places.iter().flatten().copied().collect(),
        };
        let parts = DrawnParts::new(columns, places.len(), &triangles);
        Some((mesh, parts))
    }
}
