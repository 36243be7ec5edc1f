//! The drawn surface of a creased sheet: curved triangles between its nodes.
//!
//! Each triangle of a cell becomes a cubic patch through its corners that leaves them along
//! their normals (Vlachos, Peters, Boyd and Mitchell 2001, "Curved PN triangles"). A node on
//! a crease has a normal of its own on either side, so that the surface is smooth but there.
//! What is drawn is the mean of the patches of both ways to cut a cell.

use super::crease::SheetCrease;
use super::material::{Material, cut};
use crate::vector::{cross, dot, sub, unit};

/// A corner's normal is found by its triangle's number times three and its own.
const CORNERS: usize = 3;

/// A triangle of nodes.
#[derive(Clone, Copy, Debug)]
struct Patch {
    nodes: [usize; 3],
    /// For each corner, and for each side from that corner to the next, where its normal and
    /// its control points are.
    normals: [usize; 3],
    sides: [usize; 3],
}

/// A drawn point: a patch of each way to cut cells, and its place on it.
type Sample = [(usize, [f32; 3]); 2];

/// Draws a creased sheet.
#[derive(Clone, Debug)]
pub(super) struct Patches {
    /// Where the drawn points lie on the flat paper, and which of their cells are folded.
    pub drawn: Material,
    patches: Vec<Patch>,
    samples: Vec<Sample>,
    normals: Vec<[f32; 3]>,
    /// For each side two control points, next to its lower and to its higher node, and how
    /// many patches have it.
    sides: Vec<[[f32; 3]; 2]>,
    patch_counts: Vec<f32>,
    middles: Vec<[f32; 3]>,
}

impl Patches {
    /// Draws the sheet of a material at a grid of points, as columns and rows at their
    /// distances from spine and foot, metres. None where creases lie too near each other for
    /// the grid.
    pub fn new(
        material: &Material,
        columns: Vec<f64>,
        rows: Vec<f64>,
        creases: &[SheetCrease],
    ) -> Option<Self> {
        let drawn = Material::over(columns, rows).creased(creases)?;
        Some(Self::over(material, drawn))
    }

    /// Draws the sheet of a material at the points of another on the same paper, in as many runs
    /// of rows.
    pub fn over(material: &Material, drawn: Material) -> Self {
        let mut triangles: Vec<[usize; 3]> = Vec::new();
        for rising in [false, true] {
            triangles.extend(
                material
                    .cells()
                    .flat_map(|foot| cut(material, foot, rising)),
            );
        }
        let normals = smooth_corners(material, &triangles);
        let mut edges: Vec<[usize; 2]> = triangles
            .iter()
            .flat_map(|nodes| [0, 1, 2].map(|k| side(nodes, k)))
            .collect();
        edges.sort_unstable();
        edges.dedup();
        let mut patch_counts = vec![0.0; edges.len()];
        let mut patches = Vec::with_capacity(triangles.len());
        for (number, nodes) in triangles.iter().enumerate() {
            let sides = [0, 1, 2].map(|k| {
                let found = edges.binary_search(&side(nodes, k));
                found.expect("the list has every triangle's sides")
            });
            for side in sides {
                patch_counts[side] += 1.0;
            }
            patches.push(Patch {
                nodes: *nodes,
                normals: [0, 1, 2].map(|k| normals[CORNERS * number + k]),
                sides,
            });
        }
        let half = triangles.len() / 2;
        let boxes: Vec<Bounds> = triangles
            .iter()
            .map(|nodes| bounds(nodes.map(|node| material.places[node])))
            .collect();
        // A point beside a tear is of the piece of its row, also where it lies beyond it.
        let seam = material.columns * material.run_of(0).end;
        let drawn_seam = drawn.columns * drawn.run_of(0).end;
        let samples = drawn
            .places
            .iter()
            .enumerate()
            .map(|(point, place)| {
                let is_of_piece = |nodes: &[usize; 3]| (nodes[0] < seam) == (point < drawn_seam);
                [0, half].map(|first| {
                    let best_of = |numbers: &mut dyn Iterator<Item = usize>| {
                        numbers
                            .map(|number| (number, material.weights(&triangles[number], *place)))
                            .max_by(|a, b| least(&a.1).total_cmp(&least(&b.1)))
                    };
                    let mut all = (first..first + half).filter(|at| is_of_piece(&triangles[*at]));
                    let mut around = all.clone().filter(|at| is_in(*place, &boxes[*at]));
                    // Beside all of them by rounding, it belongs to the nearest.
                    let (at, weights) = best_of(&mut around)
                        .filter(|(_, weights)| least(weights) >= 0.0)
                        .or_else(|| best_of(&mut all))
                        .expect("a grid has triangles");
                    (at, weights.map(|weight| weight as f32))
                })
            })
            .collect();
        let count = normals.iter().max().map_or(0, |last| last + 1);
        Self {
            drawn,
            normals: vec![[0.0; 3]; count],
            sides: vec![[[0.0; 3]; 2]; edges.len()],
            middles: vec![[0.0; 3]; patches.len()],
            patch_counts,
            samples,
            patches,
        }
    }

    /// Writes x, y, z of every drawn point of a sheet whose nodes are at `positions`.
    pub fn apply(&mut self, positions: &[f32], out: &mut [f32]) {
        let x = positions.as_chunks::<3>().0;
        self.find_normals(x);
        self.find_sides(x);
        self.find_middles(x);
        for (out, sample) in out.as_chunks_mut::<3>().0.iter_mut().zip(&self.samples) {
            let [a, b] = [&sample[0], &sample[1]].map(|(patch, at)| self.point(*patch, *at, x));
            *out = core::array::from_fn(|axis| 0.5 * (a[axis] + b[axis]));
        }
    }

    fn find_normals(&mut self, x: &[[f32; 3]]) {
        self.normals.fill([0.0; 3]);
        for Patch { nodes, normals, .. } in &self.patches {
            let [a, b, c] = nodes.map(|node| x[node]);
            let across = cross(sub(b, a), sub(c, a));
            for &normal in normals {
                for axis in 0..3 {
                    self.normals[normal][axis] += across[axis];
                }
            }
        }
        for normal in &mut self.normals {
            *normal = unit(*normal);
        }
    }

    /// Finds the control points on sides: on a crease the mean of those of both its sides.
    fn find_sides(&mut self, x: &[[f32; 3]]) {
        self.sides.fill([[0.0; 3]; 2]);
        for patch in &self.patches {
            for k in 0..3 {
                let next = (k + 1) % 3;
                let ends = [k, next].map(|corner| (patch.nodes[corner], patch.normals[corner]));
                let [near, far] = ends.map(|(node, _)| x[node]);
                let points = [
                    toward(near, far, self.normals[ends[0].1]),
                    toward(far, near, self.normals[ends[1].1]),
                ];
                let rises = patch.nodes[k] < patch.nodes[next];
                let side = patch.sides[k];
                let part = 1.0 / self.patch_counts[side];
                for (end, point) in points.iter().enumerate() {
                    let slot = if rises { end } else { 1 - end };
                    for axis in 0..3 {
                        self.sides[side][slot][axis] += part * point[axis];
                    }
                }
            }
        }
    }

    /// The control points on a side, next to its corner and next to the next.
    fn side(&self, patch: &Patch, k: usize) -> [[f32; 3]; 2] {
        let [low, high] = self.sides[patch.sides[k]];
        if patch.nodes[k] < patch.nodes[(k + 1) % 3] {
            [low, high]
        } else {
            [high, low]
        }
    }

    fn find_middles(&mut self, x: &[[f32; 3]]) {
        for number in 0..self.patches.len() {
            let patch = &self.patches[number];
            let mut middle = [0.0; 3];
            for k in 0..3 {
                let [near, far] = self.side(patch, k);
                for axis in 0..3 {
                    // A quarter of the six points on sides, less a sixth of the corners.
                    middle[axis] += 0.25 * (near[axis] + far[axis]) - x[patch.nodes[k]][axis] / 6.0;
                }
            }
            self.middles[number] = middle;
        }
    }

    fn point(&self, number: usize, [a, b, c]: [f32; 3], x: &[[f32; 3]]) -> [f32; 3] {
        let patch = &self.patches[number];
        let mut point = [0.0; 3];
        let mut add = |weight: f32, of: [f32; 3]| {
            for axis in 0..3 {
                point[axis] += weight * of[axis];
            }
        };
        let at = [a, b, c];
        for k in 0..3 {
            let (own, next) = (at[k], at[(k + 1) % 3]);
            let [near, far] = self.side(patch, k);
            add(own * own * own, x[patch.nodes[k]]);
            add(3.0 * own * own * next, near);
            add(3.0 * own * next * next, far);
        }
        add(6.0 * a * b * c, self.middles[number]);
        point
    }
}

/// A side of a triangle from its corner `k`, the lower node first.
fn side(nodes: &[usize; 3], k: usize) -> [usize; 2] {
    let (a, b) = (nodes[k], nodes[(k + 1) % 3]);
    [a.min(b), a.max(b)]
}

fn least(weights: &[f64; 3]) -> f64 {
    weights[0].min(weights[1]).min(weights[2])
}

/// The least and the greatest of places along u and v, metres.
type Bounds = [[f64; 2]; 2];

fn bounds([a, b, c]: [[f64; 2]; 3]) -> Bounds {
    [0, 1].map(|axis| {
        let [a, b, c] = [a[axis], b[axis], c[axis]];
        [a.min(b).min(c), a.max(b).max(c)]
    })
}

fn is_in(place: [f64; 2], bounds: &Bounds) -> bool {
    (0..2).all(|axis| (bounds[axis][0]..=bounds[axis][1]).contains(&place[axis]))
}

/// A third of the way from a place to another, brought into the plane across its normal.
fn toward(near: [f32; 3], far: [f32; 3], normal: [f32; 3]) -> [f32; 3] {
    let way = sub(far, near);
    let out = dot(way, normal);
    core::array::from_fn(|axis| near[axis] + (way[axis] - out * normal[axis]) / 3.0)
}

/// Gives the corners of triangles numbers so that those have the same between which no
/// crease lies.
fn smooth_corners(material: &Material, triangles: &[[usize; 3]]) -> Vec<usize> {
    let count = CORNERS * triangles.len();
    let mut parent: Vec<usize> = (0..count).collect();
    fn root(parent: &mut [usize], mut of: usize) -> usize {
        while parent[of] != of {
            parent[of] = parent[parent[of]];
            of = parent[of];
        }
        of
    }
    let mut join = |a: usize, b: usize| {
        let (a, b) = (root(&mut parent, a), root(&mut parent, b));
        parent[a.max(b)] = a.min(b);
    };
    let half = triangles.len() / 2;
    let is_fold = |edge: [usize; 2]| material.folds.iter().any(|(fold, _)| *fold == edge);
    // Across sides: by edge, the corners at its lower and at its higher node.
    let mut open: Vec<([usize; 2], usize, [usize; 2])> = Vec::new();
    for (number, nodes) in triangles.iter().enumerate() {
        for k in 0..3 {
            let edge = side(nodes, k);
            let corners = [k, (k + 1) % 3].map(|corner| CORNERS * number + corner);
            let rises = nodes[k] == edge[0];
            let ends = if rises {
                corners
            } else {
                [corners[1], corners[0]]
            };
            if !is_fold(edge) {
                open.push((edge, number / half, ends));
            }
        }
    }
    open.sort_unstable();
    for pair in open.windows(2) {
        if (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1) {
            join(pair[0].2[0], pair[1].2[0]);
            join(pair[0].2[1], pair[1].2[1]);
        }
    }
    // Between both ways to cut a cell: whole cells, and the same triangles of folded ones.
    for (cell, foot) in material.cells().enumerate() {
        let own = [2 * cell, 2 * cell + 1, half + 2 * cell, half + 2 * cell + 1];
        let is_folded = material.folded_diagonal(foot).is_some();
        for a in own {
            for b in own {
                if is_folded && triangles[a] != triangles[b] {
                    continue;
                }
                for (k, node) in triangles[a].iter().enumerate() {
                    if let Some(other) = triangles[b].iter().position(|known| known == node) {
                        join(CORNERS * a + k, CORNERS * b + other);
                    }
                }
            }
        }
    }
    let mut numbers = vec![usize::MAX; count];
    let mut next = 0;
    for corner in 0..count {
        let first = root(&mut parent, corner);
        if numbers[first] == usize::MAX {
            numbers[first] = next;
            next += 1;
        }
        numbers[corner] = numbers[first];
    }
    numbers
}
