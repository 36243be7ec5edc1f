//! How deep the parts of a creased sheet are drawn in each other, for tests.

use crate::models::sheet::SheetCrease;
use crate::paper_mesh::PaperMesh;
use crate::surface::Surface;
use crate::vector::{cross, dot, sub, unit};

/// Farther off each other than this, metres, parts of a leaf that lies are not looked at.
const NEAR: f32 = 0.01;

/// Farther from a point than this, metres, no triangle of the drawn leaf reaches over it.
const REACH: f32 = 0.03;

/// The deepest that a drawn point of one part of a sheet is in a triangle of another, metres.
/// `creases` are those of the sheet.
pub(super) fn depth_of_parts(surface: &Surface, mesh: &PaperMesh, creases: &[SheetCrease]) -> f32 {
    let points = surface.positions.as_chunks::<3>().0;
    let corners = &mesh.triangles;
    let mut parts: Vec<Option<Option<u16>>> = vec![None; points.len()];
    for (corners, part) in corners.iter().zip(&mesh.parts) {
        for corner in corners {
            let own = parts[*corner as usize].get_or_insert(Some(*part));
            if *own != Some(*part) {
                *own = None;
            }
        }
    }
    let mut deepest: f32 = 0.0;
    let normals = surface.normals.as_chunks::<3>().0;
    let parts = parts.iter().map(|part| part.flatten());
    for ((point, faces), own) in points.iter().zip(normals).zip(parts) {
        let Some(own) = own else { continue };
        for (corners, part) in corners.iter().zip(&mesh.parts) {
            if *part == own {
                continue;
            }
            let between = (part ^ own).trailing_zeros() as usize;
            let [a, b, c] = corners.map(|corner| points[corner as usize]);
            if dot(sub(*point, a), sub(*point, a)) > REACH * REACH {
                continue;
            }
            let (u, v, away) = (sub(b, a), sub(c, a), sub(*point, a));
            let across = cross(u, v);
            // What is folded over, and faces as what it lies upon does, lies on it with its other side.
            let is_turned = own & !part == 0 && dot(*faces, across) > 0.0;
            let turned = if is_turned { -1.0 } else { 1.0 };
            let side = turned * creases[between].rest.signum() as f32;
            let height = side * dot(away, unit(across));
            if height.abs() > NEAR {
                continue;
            }
            let all = 1.0 / dot(across, across);
            let on_b = all * dot(cross(away, v), across);
            let on_c = all * dot(cross(u, away), across);
            if on_b > 0.0 && on_c > 0.0 && on_b + on_c < 1.0 {
                deepest = deepest.max(-height);
            }
        }
    }
    deepest
}
