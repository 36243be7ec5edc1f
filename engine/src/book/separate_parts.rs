//! Parts of a folded leaf, as they are drawn, kept clear of each other.
//!
//! Contact between parts is of nodes with triangles between nodes (`flaps.rs`); the drawn parts
//! bend between their nodes, and so a little into each other. Here each drawn point of a part is
//! brought to the side of the triangles of another on which its creases have it lie, by the same
//! projections as leaves are kept clear of each other by ([`separate`](super::separate)). Of two
//! parts the one that is farther up moves, as the other lies on something.

use super::flaps::{BESIDE, add_facing, facing_of};
use super::tolerance::{NOT_UPON, OVER_PILE, SLACK};
use crate::vector::{cross, dot, sub};

/// Rounds of projections, at most.
const ROUNDS: usize = 4;

/// Cells along a side of a block of triangles that one box bounds.
const BLOCK: usize = 6;

/// The triangles of a folded leaf's drawn mesh, by the parts between its creases.
#[derive(Clone, Debug, Default)]
pub struct DrawnParts {
    /// The part of each point; None for those on creases and at the spine.
    points: Vec<Option<u16>>,
    triangles: Vec<[usize; 3]>,
    blocks: Vec<Block>,
    columns: usize,
}

/// Triangles of one part that are near each other.
#[derive(Clone, Debug)]
struct Block {
    part: u16,
    triangles: core::ops::Range<usize>,
    /// The box around them now.
    low: [f32; 3],
    high: [f32; 3],
}

impl Block {
    /// Finds the box around its triangles.
    fn bound(&mut self, points: &[[f32; 3]], triangles: &[[usize; 3]]) {
        (self.low, self.high) = ([f32::MAX; 3], [f32::MIN; 3]);
        for node in triangles[self.triangles.clone()].as_flattened() {
            for axis in 0..3 {
                self.low[axis] = self.low[axis].min(points[*node][axis]);
                self.high[axis] = self.high[axis].max(points[*node][axis]);
            }
        }
    }

    fn is_near(&self, point: [f32; 3], within: f32) -> bool {
        (0..3).all(|axis| {
            let x = point[axis];
            x > self.low[axis] - within && x < self.high[axis] + within
        })
    }
}

/// Where a point is too low over a triangle of another part.
struct Overlap {
    corners: [usize; 3],
    /// How near the point is to each corner, 0 to 1.
    weights: [f32; 3],
    /// The direction in which the point is to go, and by how much, metres.
    normal: [f32; 3],
    missing: f32,
}

impl DrawnParts {
    /// Those of a mesh with so many columns and points, whose triangles each belong to a part.
    pub fn new(columns: usize, count: usize, triangles: &[([usize; 3], u16)]) -> DrawnParts {
        let mut points: Vec<Option<Option<u16>>> = vec![None; count];
        for (corners, part) in triangles {
            for corner in corners {
                let own = points[*corner].get_or_insert(Some(*part));
                if *own != Some(*part) {
                    *own = None;
                }
            }
        }
        // The column at the spine is everyone's.
        let of = |(node, part): (usize, Option<Option<u16>>)| {
            part.flatten().filter(|_| !node.is_multiple_of(columns))
        };
        let points = points.into_iter().enumerate().map(of).collect();
        let block_of = |corners: &[usize; 3]| {
            let [a, ..] = *corners;
            (a / columns / BLOCK, a % columns / BLOCK)
        };
        let mut order: Vec<&([usize; 3], u16)> = triangles.iter().collect();
        order.sort_by_key(|(corners, part)| (*part, block_of(corners)));
        let mut blocks: Vec<Block> = Vec::new();
        for (at, (corners, part)) in order.iter().enumerate() {
            let goes_on = at > 0 && {
                let (before, of) = order[at - 1];
                of == part && block_of(before) == block_of(corners)
            };
            match blocks.last_mut() {
                Some(block) if goes_on => block.triangles.end = at + 1,
                _ => blocks.push(Block {
                    part: *part,
                    triangles: at..at + 1,
                    low: [0.0; 3],
                    high: [0.0; 3],
                }),
            }
        }
        DrawnParts {
            points,
            triangles: order.into_iter().map(|(corners, _)| *corners).collect(),
            blocks,
            columns,
        }
    }

    /// Moves parts out of each other that overlap. `side` says on which side of a triangle of a
    /// part another lies, 1 that of its normal or -1, if the normals of both are along each other
    /// or not; None where it may lie on either. Lengths are those of a page 0.14 m wide; its own
    /// is wider by `scale`.
    pub fn separate(
        &mut self,
        points: &mut [[f32; 3]],
        scale: f32,
        side: impl Fn(u16, u16, bool) -> Option<f32>,
    ) {
        let within = NOT_UPON * scale;
        for _ in 0..ROUNDS {
            for block in &mut self.blocks {
                block.bound(points, &self.triangles);
            }
            let facing = self.facing(points);
            let mut moved = false;
            for node in 0..self.points.len() {
                let Some(part) = self.points[node] else {
                    continue;
                };
                let mut under = None;
                // Of each part at most one triangle is next to the point.
                for block in &self.blocks {
                    if block.part == part || !block.is_near(points[node], within) {
                        continue;
                    }
                    let [own, other] = [part, block.part].map(|part| facing_of(&facing, part));
                    let Some(side) = side(block.part, part, dot(own, other) > 0.0) else {
                        continue;
                    };
                    for corners in &self.triangles[block.triangles.clone()] {
                        let found = overlap(points, node, *corners, side, scale);
                        let is_nearer = |found: &Overlap| {
                            under
                                .as_ref()
                                .is_none_or(|known: &Overlap| found.missing < known.missing)
                        };
                        if let Some(found) = found.filter(is_nearer) {
                            under = Some(found);
                        }
                    }
                }
                if let Some(overlap) = under {
                    self.push_apart(points, node, &overlap);
                    moved = true;
                }
            }
            if !moved {
                return;
            }
        }
    }

    /// The way that the normals of each part are, by parts.
    fn facing(&self, points: &[[f32; 3]]) -> Vec<(u16, [f32; 3])> {
        let mut found = Vec::new();
        for block in &self.blocks {
            for corners in &self.triangles[block.triangles.clone()] {
                let [a, b, c] = corners.map(|corner| points[corner]);
                add_facing(&mut found, block.part, cross(sub(b, a), sub(c, a)));
            }
        }
        found
    }

    fn push_apart(&self, points: &mut [[f32; 3]], node: usize, overlap: &Overlap) {
        let Overlap {
            corners,
            weights,
            normal,
            missing,
        } = overlap;
        let up = (0.5 + normal[2]).clamp(0.0, 1.0);
        let mut push = |node: usize, by: f32| {
            for axis in 0..3 {
                points[node][axis] += by * missing * normal[axis];
            }
        };
        push(node, up);
        let is_bound = |corner: &usize| corner.is_multiple_of(self.columns);
        let free = corners
            .iter()
            .zip(weights)
            .filter(|(corner, _)| !is_bound(corner));
        let whole: f32 = free.clone().map(|(_, weight)| weight * weight).sum();
        for (corner, weight) in free {
            push(*corner, (up - 1.0) * weight / whole.max(0.1));
        }
    }
}

/// How a point lies too low over a triangle, or in it; None where it does not lie over it.
fn overlap(
    points: &[[f32; 3]],
    node: usize,
    corners: [usize; 3],
    side: f32,
    scale: f32,
) -> Option<Overlap> {
    let [a, b, c] = corners.map(|corner| points[corner]);
    let away = sub(points[node], a);
    let (u, v) = (sub(b, a), sub(c, a));
    let across = cross(u, v);
    let square = dot(across, across).max(f32::MIN_POSITIVE);
    let inverse = side / square.sqrt();
    let missing = OVER_PILE * scale - dot(away, across) * inverse;
    if missing < SLACK * scale || missing > NOT_UPON * scale {
        return None;
    }
    let on_b = dot(cross(away, v), across) / square;
    let on_c = dot(cross(u, away), across) / square;
    let weights = [1.0 - on_b - on_c, on_b, on_c];
    weights
        .iter()
        .all(|weight| *weight > -BESIDE)
        .then(|| Overlap {
            corners,
            weights: weights.map(|weight| weight.max(0.0)),
            normal: across.map(|x| x * inverse),
            missing,
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMNS: usize = 9;
    const ROWS: usize = 7;

    /// Two level parts of points a centimetre apart, the second folded over the first: what is
    /// folded at column 4 comes back to 20 mm, `over` metres above it.
    fn folded(over: f32) -> (Vec<[f32; 3]>, DrawnParts) {
        let points = (0..COLUMNS * ROWS).map(|node| {
            let (column, y) = (node % COLUMNS, (node / COLUMNS) as f32 * 0.01);
            match column {
                0..=4 => [column as f32 * 0.01, y, 0.0],
                // Half a cell beside those under it.
                _ => [0.04 - (column - 4) as f32 * 0.01 + 0.005, y, over],
            }
        });
        let mut triangles = Vec::new();
        for row in 0..ROWS - 1 {
            for column in 0..COLUMNS - 1 {
                let here = row * COLUMNS + column;
                let above = here + COLUMNS;
                let part = u16::from(column >= 4);
                triangles.push(([here, here + 1, above + 1], part));
                triangles.push(([here, above + 1, above], part));
            }
        }
        let parts = DrawnParts::new(COLUMNS, COLUMNS * ROWS, &triangles);
        (points.collect(), parts)
    }

    fn heights(points: &[[f32; 3]], columns: core::ops::Range<usize>) -> [f32; 2] {
        let of = points.iter().enumerate();
        let of = of.filter(|(node, _)| columns.contains(&(node % COLUMNS)));
        of.fold([f32::MAX, f32::MIN], |[low, high], (_, point)| {
            [low.min(point[2]), high.max(point[2])]
        })
    }

    #[test]
    fn a_flap_that_is_drawn_into_its_page_is_raised_out_of_it() {
        for over in [5e-5f32, 0.0, -1e-3] {
            let (mut points, mut parts) = folded(over);
            parts.separate(&mut points, 1.0, |_, _, _| Some(1.0));
            assert_eq!(heights(&points, 0..5), [0.0; 2], "the page stays");
            let [low, _] = heights(&points, 5..9);
            assert!(low > 0.5 * OVER_PILE, "{low} from {over}");
        }
    }

    #[test]
    fn a_page_is_raised_off_a_flap_that_lies_under_it() {
        let (mut points, mut parts) = folded(5e-4);
        parts.separate(&mut points, 1.0, |_, _, _| Some(-1.0));
        let [low, high] = heights(&points, 5..9);
        assert_eq!([low, high], [5e-4; 2], "the flap stays");
        let middle = heights(&points, 2..4)[0];
        assert!(middle > 5e-4, "{middle}");
    }

    #[test]
    fn what_lies_clear_or_on_either_side_stays() {
        let (before, mut parts) = folded(1e-3);
        let mut points = before.clone();
        parts.separate(&mut points, 1.0, |_, _, _| Some(1.0));
        assert_eq!(points, before);
        let (before, mut parts) = folded(-1e-3);
        let mut points = before.clone();
        parts.separate(&mut points, 1.0, |_, _, _| None);
        assert_eq!(points, before);
    }
}
