//! What the creases of a leaf change of the facets that are drawn of it.

use std::collections::BTreeMap;

use turnleaf_engine::PaperMesh;

use super::triangle::{Point, cross, dot, sub};

/// What the creases of a leaf change of its facets, by the first point of each cell.
pub struct Folds {
    /// Whether the cell's diagonal runs the other way.
    pub falling: Vec<bool>,
    /// Whether either facet of the cell is folded over, so that its recto faces to the side to
    /// which the verso of the rest of the leaf does.
    pub turned_over: Vec<[bool; 2]>,
}

impl Folds {
    /// Those of a drawn mesh of so many columns, whose points are now there.
    pub fn of(columns: usize, points: &[Point], mesh: &PaperMesh) -> Folds {
        let corners = &mesh.triangles;
        let all = || corners.iter().map(|all| all.map(|corner| corner as usize));
        let mut falling = vec![false; points.len()];
        let of_cell = |corners: [usize; 3]| {
            let row = corners.map(|node| node / columns).into_iter().min();
            let column = corners.map(|node| node % columns).into_iter().min();
            row.unwrap_or(0) * columns + column.unwrap_or(0)
        };
        for corners in all() {
            let foot = of_cell(corners);
            falling[foot] = !(corners.contains(&foot) && corners.contains(&(foot + columns + 1)));
        }
        let shut = shut(points, mesh);
        let mut turned_over = vec![[false; 2]; points.len()];
        for (corners, part) in all().zip(&mesh.parts) {
            let foot = of_cell(corners);
            let first = if falling[foot] { foot } else { foot + 1 };
            let second = usize::from(!corners.contains(&first));
            turned_over[foot][second] = (part & shut).count_ones() % 2 == 1;
        }
        Folds {
            falling,
            turned_over,
        }
    }
}

/// The creases of a drawn leaf that are folded beyond a right angle in the mean over their
/// length, as a set of bits.
fn shut(points: &[Point], mesh: &PaperMesh) -> u16 {
    let normal = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| points[corner as usize]);
        cross(sub(b, a), sub(c, a))
    };
    let mut even = [0.0f32; u16::BITS as usize];
    let mut beside: BTreeMap<[u32; 2], (u16, Point)> = BTreeMap::new();
    let corners = &mesh.triangles;
    for (corners, part) in corners.iter().zip(&mesh.parts) {
        let own = normal(corners);
        for k in 0..3 {
            let [a, b] = [corners[k], corners[(k + 1) % 3]];
            if let Some((other, normal)) = beside.insert([a.min(b), a.max(b)], (*part, own)) {
                let crease = part ^ other;
                if crease.is_power_of_two() {
                    even[crease.trailing_zeros() as usize] += dot(own, normal);
                }
            }
        }
    }
    let shut = even.iter().enumerate().filter(|(_, even)| **even < 0.0);
    shut.fold(0, |set, (crease, _)| set | 1 << crease)
}

#[cfg(test)]
mod tests {
    use turnleaf_engine::book::Book;
    use turnleaf_engine::{SheetCrease, Side, Stock};

    use super::super::facets::Facets;
    use super::super::overlap::inside_itself;

    const PAGE: [f64; 2] = [0.14, 0.21];

    /// What lies over a flap is on the same side of its leaf as what lies over the rest, and a
    /// leaf folded in two does not go through itself.
    #[test]
    fn a_flap_has_the_side_of_its_leaf() {
        for rest in [3.0, -3.0] {
            let line = SheetCrease::pressed([[0.6, 0.0], [0.6, 1.0]], rest, &Stock::BOOK, PAGE[0]);
            let mut book = Book::new(PAGE[0], PAGE[1], 40, 0.004).expect("a book's figures");
            book.lay(5);
            assert!(book.crease(5, &[line]) && book.lies_creased(Side::Right));
            let leaf = Facets::of(&book, 0).expect("it lies uppermost");
            let folds = leaf.folds().expect("it is folded");
            let turned_over = folds.turned_over.iter().filter(|cell| cell[0] && cell[1]);
            assert!(turned_over.count() > 100);
            let highest = |x: f32| {
                let near = leaf.points().iter().filter(|p| (p[0] - x).abs() < 0.004);
                near.map(|point| point[2]).fold(0.0, f32::max)
            };
            // Over the flap, and next to the spine.
            for x in [0.06, 0.02] {
                let over = [x, 0.1, highest(x) + 0.002];
                let near = leaf.near(over, 0.02).expect("it is near");
                assert!(near.recto, "{rest}, {x}: {near:?}");
            }
            assert!(inside_itself(&leaf, 0.012) < 1e-4);
        }
    }
}
