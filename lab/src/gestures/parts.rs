//! How deep parts of a folded leaf that lies are drawn in each other, by the sides to which its
//! creases are folded.

use std::f64::consts::FRAC_PI_2;

use turnleaf_engine::PaperMesh;
use turnleaf_engine::{SheetCrease, Surface};

use super::triangle::{Point, cross, dot, sub};

/// Farther off each other than this, as a part of the page's width, parts are not looked at: what
/// is drawn so far on the wrong side of a fold has been folded there.
const NEAR: f32 = 0.07;

/// Farther from a point than this, in page widths, no triangle reaches over it.
const REACH: f32 = 0.22;

/// The deepest that a drawn point of one part of a leaf is in a triangle of another, metres. Only
/// what is folded by more than a right angle is looked at: less may lie on either side.
pub fn inside_parts(
    surface: &Surface,
    mesh: &PaperMesh,
    creases: &[SheetCrease],
    width: f32,
) -> f32 {
    let points = surface.positions.as_chunks::<3>().0;
    let corners = &mesh.triangles;
    let triangles = || corners.iter().zip(&mesh.parts);
    // Those on creases belong to no part.
    let mut parts: Vec<Option<Option<u16>>> = vec![None; points.len()];
    for (corners, part) in triangles() {
        for corner in corners {
            let own = parts[*corner as usize].get_or_insert(Some(*part));
            if *own != Some(*part) {
                *own = None;
            }
        }
    }
    // The way that a part faces at each of its points: limp paper curls, and lies with either face
    // toward what it is folded onto.
    let mut facing: Vec<Point> = vec![[0.0; 3]; points.len()];
    for (corners, _) in triangles() {
        let [a, b, c] = corners.map(|corner| points[corner as usize]);
        let normal = cross(sub(b, a), sub(c, a));
        for corner in corners {
            let sum = &mut facing[*corner as usize];
            *sum = [0, 1, 2].map(|axis| sum[axis] + normal[axis]);
        }
    }
    let mut deepest = 0.0f32;
    let parts = parts.iter().map(|part| part.flatten());
    for ((point, faces), own) in points.iter().zip(&facing).zip(parts) {
        let Some(own) = own else { continue };
        for (corners, part) in triangles() {
            let away = sub(*point, points[corners[0] as usize]);
            if *part == own || dot(away, away) > (REACH * width).powi(2) {
                continue;
            }
            let corners = corners.map(|corner| points[corner as usize]);
            let [a, b, c] = corners;
            let is_alike = dot(cross(sub(b, a), sub(c, a)), *faces) > 0.0;
            if let Some(side) = side(creases, *part, own, is_alike) {
                let height = height(*point, corners);
                if let Some(height) = height.filter(|height| height.abs() < NEAR * width) {
                    deepest = deepest.max(-side * height);
                }
            }
        }
    }
    deepest
}

/// The side of a triangle of the part `under` on which another part lies, 1 that of its normal or
/// -1; None where it may lie on either: where neither lies beyond the other, or the first crease
/// between them, as seen from the spine, is not folded by more than a right angle. What is folded
/// over has the page on the side of its recto, or where the normals of both are alike of its verso.
fn side(creases: &[SheetCrease], under: u16, part: u16, is_alike: bool) -> Option<f32> {
    let [own, other] = [part & !under, under & !part];
    if own != 0 && other != 0 {
        return None;
    }
    let between = (own | other).trailing_zeros() as usize;
    let rest = creases.get(between)?.rest;
    let is_turned_back = other != 0 && is_alike;
    let side = rest.signum() as f32;
    (rest.abs() > FRAC_PI_2).then_some(if is_turned_back { -side } else { side })
}

/// Height of a point over a triangle that it lies over, on the side of its normal, metres.
fn height(point: Point, [a, b, c]: [Point; 3]) -> Option<f32> {
    let (u, v, away) = (sub(b, a), sub(c, a), sub(point, a));
    let across = cross(u, v);
    let all = dot(across, across).max(1e-30);
    let on_b = dot(cross(away, v), across) / all;
    let on_c = dot(cross(u, away), across) / all;
    let is_over = on_b > 0.0 && on_c > 0.0 && on_b + on_c < 1.0;
    is_over.then(|| dot(away, across) / all.sqrt())
}

#[cfg(test)]
mod tests {
    use super::super::facets::Facets;
    use super::super::overlap::inside_itself;
    use super::*;
    use turnleaf_engine::Stock;
    use turnleaf_engine::book::Book;

    /// A book whose open page on the right is folded over onto itself, and the fold.
    fn folded_page() -> (Book, [SheetCrease; 1]) {
        let through = [[0.6, 0.0], [0.6, 1.0]];
        let lines = [SheetCrease::pressed(through, 3.0, &Stock::BOOK, 0.14)];
        let mut book = Book::new(0.14, 0.21, 40, 0.004).expect("a book's figures");
        book.lay(5);
        assert!(book.crease(5, &lines));
        (book, lines)
    }

    /// A page folded in two lies clear of itself; its flap pushed down is found under it. Pushed
    /// farther it counts as no deeper than parts are looked at: it may have been folded there, as it
    /// lies around its crease and goes through nothing.
    #[test]
    fn a_flap_pushed_into_its_page_is_found_there() {
        let (book, lines) = folded_page();
        let (surface, mesh) = (book.surface(0).unwrap(), book.paper_mesh(0).unwrap());
        assert!(inside_parts(surface, mesh, &lines, 0.14) < 1e-4);
        let lowest = surface.positions.as_chunks::<3>().0.iter();
        let lowest = lowest.map(|point| point[2]).fold(f32::MAX, f32::min);
        let pushed = |down: f32| {
            let mut sunken = surface.clone();
            let points = sunken.positions.as_chunks_mut::<3>().0;
            let flap = mesh.places.iter();
            let mut most = 0.0f32;
            for (point, _) in points
                .iter_mut()
                .zip(flap)
                .filter(|(_, place)| place[0] > 0.61)
            {
                most = most.max(point[2] - lowest);
                point[2] -= down;
            }
            assert!(most < 0.02, "the flap stands {most} m high");
            let by_side = inside_parts(&sunken, mesh, &lines, 0.14);
            let through = inside_itself(&Facets::folded(&sunken, mesh), 0.012);
            [by_side, through]
        };
        let [near, far] = [pushed(0.005), pushed(0.05)];
        assert!((4e-3..7e-3).contains(&near[0]), "{near:?}");
        assert!(near[0] < far[0] && far[0] < NEAR * 0.14, "{far:?}");
        assert_eq!([near[1], far[1]], [0.0; 2], "nothing is gone through");
    }

    /// A flap of limp paper whose end curls back over itself, and so has its other face down, lies
    /// clear of the page.
    #[test]
    fn a_flap_whose_end_is_curled_lies_clear_of_its_page() {
        let (book, lines) = folded_page();
        let (surface, mesh) = (book.surface(0).unwrap(), book.paper_mesh(0).unwrap());
        let mut curled = surface.clone();
        let points = curled.positions.as_chunks_mut::<3>().0;
        let (fold, level, radius) = (0.6 * 0.14, 0.025, 0.002);
        for (point, [u, v]) in points.iter_mut().zip(&mesh.places) {
            let [x, y] = [u * 0.14, v * 0.21];
            let beyond = x - fold;
            let around = ((beyond - level) / radius).clamp(0.0, core::f32::consts::PI);
            let back = (beyond - level - core::f32::consts::PI * radius).max(0.0);
            let (sin, cos) = around.sin_cos();
            *point = match beyond {
                ..0.0 => [x, y, 0.0],
                _ => [
                    fold - beyond.min(level) - radius * sin + back,
                    y,
                    0.1 * beyond.min(level) + radius * (1.0 - cos),
                ],
            };
        }
        assert!(inside_parts(&curled, mesh, &lines, 0.14) < 1e-4);
    }
}
