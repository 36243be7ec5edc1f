//! A sheet that is torn across: two pieces in one, tied along the tear, then two sheets.
//!
//! The [grid](super::torn_grid) has the nodes of the path twice. Ties hold them together, one
//! for each, and stand for the paper there: when a tie is gone, the tear has opened by so much.
//! Paper bends freely along what still holds, as along a perforation. Once nothing holds, the
//! pieces have nothing to do with each other, and each goes on as a sheet of its own.

use super::creased::Creased;
use super::hinges::Hinges;
use super::material::Material;
use super::patches::Patches;
use super::torn_grid::{Frame, TornGrid, length, spread_evenly};
use super::{Sheet, SheetSettings, Tie};
use crate::interpolate::uniform_samples;

/// Drawn cells along a side of one of the grid.
const PARTS: usize = 3;

/// By how much either piece is drawn beyond the path, metres: the picture cuts both along one
/// ragged line that wanders by less.
const BEYOND: f64 = 0.001;

/// How a sheet is torn across, or was.
#[derive(Clone, Debug)]
pub(super) struct Torn {
    frame: Frame,
    path: Vec<[f64; 2]>,
    is_from_end: bool,
    /// The piece that the sheet is; None while it is both.
    piece: Option<Piece>,
}

/// A piece of a torn page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Piece {
    /// What lies to the right of the path.
    Foot,
    /// What lies to the left of it.
    Head,
}

/// How a torn sheet's drawn points lie on the page.
#[derive(Clone, Debug, Default)]
pub struct TornMesh {
    /// u and v of each point on the page.
    pub places: Vec<[f32; 2]>,
    /// The points of each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// For each point how far it lies on its own side of the path, and how far along it from
    /// where the tear begins, metres; then 1 for the piece on the left of the path, and -1.
    pub tears: Vec<[f32; 3]>,
}

impl Sheet {
    /// Makes a sheet of the same paper that is torn along a path of its page, u and v of places,
    /// from the edge next to the first to the edge next to the last: its pieces hang together
    /// by what ties are added to it. It lies flat, and nothing holds it.
    ///
    /// None where [`TornGrid::new`] has none, and of a sheet that is creased, crumpled or torn.
    pub(crate) fn torn_along(&self, path: &[[f64; 2]], tick: f64) -> Option<(Sheet, TornGrid)> {
        if self.is_creased() {
            return None;
        }
        let page = [self.settings.width, self.settings.height];
        let [du, dv] = self.settings.cell();
        let grid = TornGrid::new(page, path, du.midpoint(dv))?;
        let material = Material::torn(&grid);
        let torn = Torn {
            frame: grid.frame,
            path: grid.path.clone(),
            is_from_end: grid.is_from_end,
            piece: None,
        };
        let mut settings = self.settings.clone();
        if grid.frame.is_turned() {
            settings.grain = settings.grain.turned();
        }
        let settings = settings
            .over(grid.columns, material.rows, grid.cell())
            .bearable(tick);
        Some((Sheet::of_torn(settings, material, torn)?, grid))
    }

    /// Parts a torn sheet of which nothing is tied any more: returns the piece on the right of the
    /// path and the one on the left, each as it moves. None of any other.
    pub(crate) fn parted(&self) -> Option<[Sheet; 2]> {
        let torn = self.torn().filter(|torn| torn.piece.is_none())?;
        if !self.ties.is_empty() {
            return None;
        }
        let [foot, head] = [Piece::Foot, Piece::Head].map(|piece| {
            let [before, beyond] = self.material.runs();
            let rows = if piece == Piece::Foot { before } else { beyond };
            let numbers =
                3 * rows.start * self.settings.columns..3 * rows.end * self.settings.columns;
            let material = self.material.piece(rows);
            let settings = &self.settings;
            let settings = settings
                .clone()
                .over(settings.columns, material.rows, settings.cell());
            let torn = Torn {
                piece: Some(piece),
                ..torn.clone()
            };
            let mut sheet = Sheet::of_torn(settings, material, torn)?;
            sheet.write_nodes(&self.positions[numbers.clone()], &self.velocities[numbers]);
            Some(sheet)
        });
        Some([foot?, head?])
    }

    fn of_torn(settings: SheetSettings, material: Material, torn: Torn) -> Option<Sheet> {
        let mut sheet = Sheet::new(settings).ok()?;
        let drawn = torn.drawn(&material);
        sheet.draw_samples(
            &uniform_samples(drawn.columns),
            &uniform_samples(drawn.rows),
        );
        sheet.creased = Some(Box::new(Creased {
            lines: Vec::new(),
            hinges: Hinges::new(&sheet.settings, &material, &[]),
            patches: Some(Patches::over(&material, drawn)),
            torn: Some(torn),
        }));
        sheet.take(material);
        sheet.lay_flat(crate::grid::Side::Right);
        Some(sheet)
    }

    /// How it is torn across, if it is.
    pub(super) fn torn(&self) -> Option<&Torn> {
        self.creased()?.torn.as_ref()
    }

    /// Whether it is torn across, or a piece of a torn sheet.
    pub(crate) fn is_torn(&self) -> bool {
        self.torn().is_some()
    }

    /// Returns u and v along the grid of a place at u and v of the page.
    pub(super) fn in_frame(&self, at: [f32; 2]) -> [f32; 2] {
        self.torn().map_or(at, |torn| torn.frame.of_page(at))
    }

    /// The springs between nodes that tie it, to be added and removed.
    pub(crate) fn ties_mut(&mut self) -> &mut Vec<Tie> {
        &mut self.ties
    }

    /// Returns u and v on the page of each of a torn sheet's nodes.
    pub(crate) fn torn_places(&self) -> Vec<[f64; 2]> {
        let places = &self.material.places;
        self.torn().map_or_else(Vec::new, |torn| {
            places.iter().map(|at| torn.frame.on_page(*at)).collect()
        })
    }

    /// Returns how its drawn points lie on the page; nothing of one that is not torn.
    pub(crate) fn torn_mesh(&self) -> TornMesh {
        let patches = self.creased().and_then(|creased| creased.patches.as_ref());
        let (Some(torn), Some(patches)) = (self.torn(), patches) else {
            return TornMesh::default();
        };
        let triangles = self.drawn_triangles().into_iter();
        let drawn = &patches.drawn;
        let on_page = |at: &[f64; 2]| torn.frame.on_page(*at).map(|at| at as f32);
        TornMesh {
            places: drawn.places.iter().map(on_page).collect(),
            triangles: triangles
                .map(|(corners, _)| corners.map(|corner| corner as u32))
                .collect(),
            tears: (0..drawn.places.len())
                .map(|point| torn.tear_at(drawn, point))
                .collect(),
        }
    }
}

impl Torn {
    /// The points at which a sheet of a material is drawn: those beside the path lie on the other
    /// side of it.
    fn drawn(&self, material: &Material) -> Material {
        let mut drawn = material.refined(PARTS);
        let columns = drawn.columns;
        let path = spread_evenly(&self.path, columns);
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
                    .map(|axis| (place[axis] + by * along[axis]).clamp(0.0, drawn.size[axis]));
            }
        }
        drawn
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

    /// Where a drawn point lies by the tear: see [`TornMesh::tears`].
    fn tear_at(&self, drawn: &Material, point: usize) -> [f32; 3] {
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
