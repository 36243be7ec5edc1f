//! A mesh over the points of a grid, packed: what version 3 of the files adds.
//!
//! Six runs in Rice's code (`bits.rs`) follow each other. Of every point, u and then v in
//! 65535 parts, each less that of its column or row. Of every triangle the first, the second
//! and the third corner, each less that of the triangle that a grid has there whose cells are
//! cut from their foot at the spine; and its part, less that of the triangle before.

use super::bits::{BitReader, BitWriter};
use crate::grid::cut_cell;
use crate::paper_mesh::PaperMesh;

/// Parts of the leaf's width or height of which the place of a point is a whole number.
const PARTS: f32 = u16::MAX as f32;

/// The mesh with places as they are kept; None where it is none of so many columns and rows.
pub(super) fn rounded(mesh: &PaperMesh, columns: usize, rows: usize) -> Option<PaperMesh> {
    let points = columns * rows;
    let count = mesh.triangles.len();
    let is_mesh = mesh.places.len() == points
        && mesh.tears.is_empty()
        && mesh.parts.len() == count
        && (1..=most_triangles(columns, rows)).contains(&count)
        && mesh
            .triangles
            .iter()
            .flatten()
            .all(|at| (*at as usize) < points)
        && mesh
            .places
            .iter()
            .flatten()
            .all(|at| (0.0..=1.0).contains(at));
    is_mesh.then(|| PaperMesh {
        places: mesh
            .places
            .iter()
            .map(|at| at.map(kept).map(place))
            .collect(),
        ..mesh.clone()
    })
}

/// Packs a [rounded] mesh of points in columns at `u` and rows at `v`.
pub(super) fn pack(mesh: &PaperMesh, u: &[f32], v: &[f32]) -> Vec<u8> {
    let mut writer = BitWriter::default();
    for axis in 0..2 {
        let even = evens(u, v, axis);
        let places = mesh.places.iter().zip(even);
        writer.run(
            &places
                .map(|(at, even)| kept(at[axis]) - even)
                .collect::<Vec<_>>(),
        );
    }
    for corner in 0..3 {
        let corners = mesh.triangles.iter().enumerate();
        let apart = |(at, own): (usize, &[u32; 3])| {
            own[corner] as i32 - grid_triangle(at, u.len())[corner] as i32
        };
        writer.run(&corners.map(apart).collect::<Vec<_>>());
    }
    let mut before = 0;
    let parts = mesh.parts.iter().map(|part| {
        let part = i32::from(*part);
        part - core::mem::replace(&mut before, part)
    });
    writer.run(&parts.collect::<Vec<_>>());
    writer.finish()
}

/// The mesh of so many triangles that [`pack`] packed; None where the bytes are none.
pub(super) fn unpack(packed: &[u8], u: &[f32], v: &[f32], count: usize) -> Option<PaperMesh> {
    let (columns, points) = (u.len(), u.len() * v.len());
    if !(1..=most_triangles(columns, v.len())).contains(&count) {
        return None;
    }
    let mut reader = BitReader::new(packed);
    let mut run = vec![0; points];
    let mut places = vec![[0.0; 2]; points];
    for axis in 0..2 {
        reader.run(&mut run)?;
        for ((at, apart), even) in places.iter_mut().zip(&run).zip(evens(u, v, axis)) {
            let own = u16::try_from(apart + even).ok()?;
            at[axis] = place(i32::from(own));
        }
    }
    let mut run = vec![0; count];
    let mut triangles = vec![[0; 3]; count];
    for corner in 0..3 {
        reader.run(&mut run)?;
        for (at, (own, apart)) in triangles.iter_mut().zip(&run).enumerate() {
            let point = grid_triangle(at, columns)[corner] as i32 + apart;
            own[corner] = u32::try_from(point)
                .ok()
                .filter(|at| (*at as usize) < points)?;
        }
    }
    reader.run(&mut run)?;
    let mut part = 0i32;
    let parts: Option<Vec<u16>> = run
        .iter()
        .map(|apart| {
            part = i32::from(u16::try_from(part + apart).ok()?);
            Some(part as u16)
        })
        .collect();
    let mesh = PaperMesh {
        places,
        triangles,
        parts: parts?,
        tears: Vec::new(),
    };
    reader.is_at_end().then_some(mesh)
}

/// Triangles of a grid whose cells are each cut in two.
fn most_triangles(columns: usize, rows: usize) -> usize {
    2 * (columns - 1) * (rows - 1)
}

/// A place in whole parts, and back.
fn kept(place: f32) -> i32 {
    (f64::from(place) * f64::from(PARTS)).round() as i32
}

fn place(kept: i32) -> f32 {
    kept as f32 / PARTS
}

/// Of each point the place of its column (axis 0) or of its row (1), in whole parts.
fn evens(u: &[f32], v: &[f32], axis: usize) -> Vec<i32> {
    let rows = v.iter();
    rows.flat_map(|v| u.iter().map(move |u| kept(if axis == 0 { *u } else { *v })))
        .collect()
}

/// The corners of a triangle, by its number, of a grid whose cells are cut from their foot at
/// the spine.
fn grid_triangle(number: usize, columns: usize) -> [u32; 3] {
    let cell = number / 2;
    let foot = cell + cell / (columns - 1);
    cut_cell(foot, columns, false)[number % 2].map(|corner| corner as u32)
}
