//! Bending of a creased sheet, by the angles between the triangles of its cells.
//!
//! As the shell's triangles (see [`Shell`](crate::Shell)), on cells of any shape and in
//! single precision: the curvature of a triangle follows from the angles of its three
//! hinges (Grinspun, Gingold, Reisman and Zorin 2006, "Computing discrete shape operators
//! on general meshes"), each cell is cut along both diagonals, and bending is the mean of
//! both. A cell that is folded along a diagonal is cut along that one alone. A hinge on a
//! crease turns by the crease's angle and by what the paper beside it bends; the same
//! moment goes through both, so they are springs in series.
//!
//! Of the Hessian the part is left out that moments have by the angles' second
//! derivatives: what remains is never negative.

use super::crease::FoldLine;
use super::material::{Material, cut};
use super::plates::{plate_at, weights};
use super::settings::{Root, SheetSettings};
use super::system::System;
use crate::lanes::Four;
use crate::models::plastic_hinge::Plasticity;
use crate::rigidity::Rigidity;
use crate::vector::{cross, dot, sub};
use core::f32::consts::PI;

/// Marks the node beyond the spine that the clamp's tangent stands for.
const GHOST: usize = usize::MAX;

/// An edge's two ends and the apexes on its left and on its right.
type Hinge = [usize; 4];

/// A triangle: its hinges, and the stiffness between their angles.
#[derive(Clone, Debug)]
struct Triangle {
    hinges: [Option<usize>; 3],
    /// Its nodes and the apexes across its edges, rising; as many as `count`.
    nodes: [usize; 6],
    count: usize,
    /// Where among them the four vertices of each hinge are; 6 where there is none.
    vertices: [[usize; 4]; 3],
    /// Energy is half of the angles' product with this, N m.
    stiffness: [[f32; 3]; 3],
    /// For each pair of its nodes, the second not after the first, which block it adds to.
    blocks: [u16; PAIRS],
}

/// A hinge on a crease.
#[derive(Clone, Copy, Debug)]
struct Fold {
    hinge: usize,
    crease: usize,
    /// Angle of the hinge without moment, and when it was looked at last, radians:
    /// above 0 where the sheet bulges toward its normals.
    rest: f32,
    last: f32,
    /// Part of the turn from rest that bends the paper beside the crease.
    fraction: f32,
    /// Energy in the crease is half of this times the square of that part, N m.
    stiffness: f32,
    /// Moment of the crease by its angle from rest, N m.
    spring: f32,
    plasticity: Plasticity,
    /// Greatest angle at which it comes to rest by yielding, radians.
    tightest: f32,
}

/// The angle of a hinge, and its slopes by the places of its vertices.
#[derive(Clone, Copy, Debug, Default)]
struct Angle {
    value: f32,
    slopes: [[f32; 3]; 4],
}

/// A part of the matrix: rows x, y, z of a node, columns x, y, z of another, and a fourth
/// column of zeros.
type Block = [Four; 3];

/// Pairs of a triangle's six nodes, each with itself too.
const PAIRS: usize = 21;

/// The bending of a creased sheet.
#[derive(Clone, Debug)]
pub(super) struct Hinges {
    columns: usize,
    hinges: Vec<Hinge>,
    triangles: Vec<Triangle>,
    folds: Vec<Fold>,
    angles: Vec<Angle>,
    moments: Vec<f32>,
    /// Pairs of nodes that triangles couple, the second not after the first, and what they
    /// add to the matrix: each is added there once.
    pairs: Vec<[usize; 2]>,
    blocks: Vec<Block>,
    /// Whether creases that are turned further than they yield keep the difference.
    pub may_yield: bool,
    /// Work done in yielding since it was last taken, J.
    pub yielded: f32,
}

impl Hinges {
    /// Of a sheet that is flat now.
    pub fn new(settings: &SheetSettings, material: &Material, creases: &[FoldLine]) -> Self {
        let mut hinges = Self {
            columns: material.columns,
            hinges: Vec::new(),
            triangles: Vec::new(),
            folds: Vec::new(),
            angles: Vec::new(),
            moments: Vec::new(),
            pairs: Vec::new(),
            blocks: Vec::new(),
            may_yield: true,
            yielded: 0.0,
        };
        for rising in [false, true] {
            hinges.triangulate(settings, material, rising);
        }
        hinges.pair(settings.first());
        if material.crumples {
            hinges.fold_everywhere(settings, material);
        } else {
            hinges.fold(material, creases);
        }
        hinges.angles = vec![Angle::default(); hinges.hinges.len()];
        hinges.moments = vec![0.0; hinges.hinges.len()];
        hinges
    }

    /// Cuts every cell along its falling or its rising diagonal, but folded ones along
    /// their fold, and adds what the triangles need.
    fn triangulate(&mut self, settings: &SheetSettings, material: &Material, rising: bool) {
        let columns = material.columns;
        let cells = material.cells();
        let triangles: Vec<[usize; 3]> =
            cells.flat_map(|foot| cut(material, foot, rising)).collect();
        // For each node the edges that lead from it, and the apexes on their left.
        let mut apexes: Vec<Vec<(usize, usize)>> = vec![Vec::new(); material.places.len()];
        for nodes in &triangles {
            for k in 0..3 {
                apexes[nodes[k]].push((nodes[(k + 1) % 3], nodes[(k + 2) % 3]));
            }
        }
        let left_of = |from: usize, to: usize| {
            let leading = apexes[from].iter().find(|(end, _)| *end == to);
            leading.map(|(_, apex)| *apex)
        };
        let clamped = settings.root != Root::Free;
        let mut of_edge: Vec<([usize; 2], usize)> = Vec::new();
        for nodes in &triangles {
            for k in 0..3 {
                let [from, to] = [nodes[k], nodes[(k + 1) % 3]];
                let own = nodes[(k + 2) % 3];
                let hinge = match left_of(to, from) {
                    Some(_) if from > to => continue,
                    Some(other) => [from, to, own, other],
                    // Against the clamp: the spine's edges go down on the left.
                    None if clamped && from % columns == 0 && to % columns == 0 => {
                        [to, from, GHOST, own]
                    }
                    None => continue,
                };
                of_edge.push(([from.min(to), from.max(to)], self.hinges.len()));
                self.hinges.push(hinge);
            }
        }
        of_edge.sort_unstable();
        let hinge_at = |a: usize, b: usize| {
            let edge = [a.min(b), a.max(b)];
            let found = of_edge.binary_search_by(|(known, _)| known.cmp(&edge));
            found.ok().map(|at| of_edge[at].1)
        };
        let plate = Rigidity::of(&settings.stock, settings.grain);
        let weights = weights(settings, material);
        for nodes in &triangles {
            let own = core::array::from_fn(|k| hinge_at(nodes[k], nodes[(k + 1) % 3]));
            let plate = plate_at(nodes, &plate, &weights, settings, material);
            let triangle = self.triangle(nodes, own, material, &plate);
            self.triangles.push(triangle);
        }
    }

    fn triangle(
        &self,
        nodes: &[usize; 3],
        hinges: [Option<usize>; 3],
        material: &Material,
        plate: &Rigidity,
    ) -> Triangle {
        let columns = self.columns;
        let places = nodes.map(|node| material.places[node]);
        let [a, b, c] = places;
        let area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
        // Curvatures along u and v, and twice the twist, by each angle.
        let mut shape = [[0.0; 3]; 3];
        let mut free = [false; 2];
        for k in 0..3 {
            let (from, to) = (places[k], places[(k + 1) % 3]);
            let edge = [to[0] - from[0], to[1] - from[1]];
            let length = (edge[0] * edge[0] + edge[1] * edge[1]).sqrt();
            let Some(hinge) = hinges[k] else {
                let stands = nodes[k] % columns == nodes[(k + 1) % 3] % columns;
                free[usize::from(!stands)] = true;
                continue;
            };
            // Half of an angle belongs to a triangle, against the clamp all.
            let part = if self.hinges[hinge].contains(&GHOST) {
                1.0
            } else {
                0.5
            };
            let scale = part / (area * length);
            let [x, y] = [edge[1], -edge[0]];
            shape[k] = [scale * x * x, scale * y * y, scale * 2.0 * x * y];
        }
        let plate = plate.moments(free);
        let mut stiffness = [[0.0f32; 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                let mut sum = 0.0;
                for a in 0..3 {
                    for b in 0..3 {
                        sum += shape[i][a] * plate[a][b] * shape[j][b];
                    }
                }
                // Every cell is cut twice.
                stiffness[i][j] = (0.5 * area * sum) as f32;
            }
        }
        let mut all: Vec<usize> = Vec::new();
        for hinge in hinges.into_iter().flatten() {
            all.extend(self.hinges[hinge].iter().filter(|node| **node != GHOST));
        }
        all.sort_unstable();
        all.dedup();
        let place = |node: usize| all.iter().position(|known| *known == node).unwrap_or(6);
        let mut listed = [0; 6];
        listed[..all.len()].copy_from_slice(&all);
        Triangle {
            hinges,
            nodes: listed,
            count: all.len(),
            vertices: hinges.map(|hinge| hinge.map_or([6; 4], |h| self.hinges[h].map(place))),
            stiffness,
            blocks: [0; PAIRS],
        }
    }

    /// Finds which pairs of nodes triangles couple. Those of nodes that do not move, in columns
    /// before `first`, all have the last block, which no one reads.
    fn pair(&mut self, first: usize) {
        let columns = self.columns;
        let moves = |node: usize| node % columns >= first;
        let mut pairs: Vec<[usize; 2]> = Vec::new();
        for triangle in &self.triangles {
            triangle.each_pair(|a, b, _| pairs.push([a, b]));
        }
        pairs.retain(|[a, b]| moves(*a) && moves(*b));
        pairs.sort_unstable();
        pairs.dedup();
        for triangle in &mut self.triangles {
            let mut blocks = [0; PAIRS];
            triangle.each_pair(|a, b, pair| {
                let found = pairs.binary_search(&[a, b]);
                blocks[pair] = found.unwrap_or(pairs.len()) as u16;
            });
            triangle.blocks = blocks;
        }
        self.blocks = vec![[Four::splat(0.0); 3]; pairs.len() + 1];
        self.pairs = pairs;
    }

    /// Makes folds of the hinges on creases.
    fn fold(&mut self, material: &Material, creases: &[FoldLine]) {
        for (hinge, &[from, to, ..]) in self.hinges.iter().enumerate() {
            let edge = [from.min(to), from.max(to)];
            let Some((_, crease)) = material.folds.iter().find(|(fold, _)| *fold == edge) else {
                continue;
            };
            let fold = self.fold_at(hinge, *crease, material, &creases[*crease]);
            self.folds.push(fold);
        }
    }

    /// Makes a fold of every hinge, flat at first, as if each were creased by hand.
    fn fold_everywhere(&mut self, settings: &SheetSettings, material: &Material) {
        let line = FoldLine::pressed([[0.0; 2]; 2], 0.0, &settings.stock, settings.width);
        let inner = (0..self.hinges.len()).filter(|hinge| !self.hinges[*hinge].contains(&GHOST));
        let folds = inner.map(|hinge| Fold {
            // Shut but for what it springs back by: no facet is pressed through the next.
            tightest: PI - line.yields as f32,
            ..self.fold_at(hinge, 0, material, &line)
        });
        self.folds = folds.collect();
    }

    /// A hinge as part of a crease.
    fn fold_at(&self, hinge: usize, crease: usize, material: &Material, line: &FoldLine) -> Fold {
        let of_triangle = |triangle: &Triangle| {
            let side = triangle.hinges.iter().position(|own| *own == Some(hinge));
            side.map_or(0.0, |k| f64::from(triangle.stiffness[k][k]))
        };
        let paper: f64 = self.triangles.iter().map(of_triangle).sum();
        let [from, to, ..] = self.hinges[hinge];
        let [a, b] = [from, to].map(|node| material.places[node]);
        let d = [b[0] - a[0], b[1] - a[1]];
        let length = (d[0] * d[0] + d[1] * d[1]).sqrt();
        // Each edge is a hinge of both triangulations, with half of the crease.
        let spring = 0.5 * length * line.stiffness;
        Fold {
            hinge,
            crease,
            rest: -line.rest as f32,
            last: 0.0,
            fraction: (1.0 / (1.0 + paper / spring)) as f32,
            stiffness: (paper * paper / spring) as f32,
            spring: spring as f32,
            plasticity: Plasticity {
                // As single precision has it, in which the hinge is measured.
                yields: f64::from(line.yields as f32),
                creep: line.creep,
            },
            tightest: f32::INFINITY,
        }
    }

    /// Adds bending's forces and its Hessian times `scale`, both at `positions`.
    /// `tangents` are, for each row, the places to which the clamp's tangent points.
    pub fn add_to(&mut self, positions: &[f32], tangents: &[f32], scale: f32, system: &mut System) {
        let (x, tangents) = (positions.as_chunks::<3>().0, tangents.as_chunks::<3>().0);
        for (hinge, angle) in self.hinges.iter().zip(&mut self.angles) {
            *angle = measure(&vertices(hinge, x, tangents, self.columns));
        }
        for fold in &mut self.folds {
            let angle = &mut self.angles[fold.hinge];
            fold.last = unwrapped(angle.value, fold.last);
            angle.value = fold.fraction * (fold.last - fold.rest);
            angle.slopes = angle.slopes.map(|slope| slope.map(|s| fold.fraction * s));
        }
        self.moments.fill(0.0);
        self.blocks.fill([Four::splat(0.0); 3]);
        for triangle in &self.triangles {
            triangle.add_moments(&self.angles, &mut self.moments);
            triangle.add_to(&self.angles, scale, &mut self.blocks);
        }
        for ([a, b], block) in self.pairs.iter().zip(&self.blocks) {
            system.add_block(*a, *b, block.map(Four::array));
        }
        for fold in &self.folds {
            let angle = &self.angles[fold.hinge];
            self.moments[fold.hinge] += fold.stiffness * angle.value;
            let hinge = &self.hinges[fold.hinge];
            let scaled = angle
                .slopes
                .map(|slope| slope.map(|s| scale * fold.stiffness * s));
            for i in 0..4 {
                for j in 0..4 {
                    let (a, b) = (hinge[i], hinge[j]);
                    if a != GHOST && b != GHOST && b <= a && system.moves(a) && system.moves(b) {
                        system.add_product(a, b, scaled[i], angle.slopes[j]);
                    }
                }
            }
        }
        let hinges = self.hinges.iter().zip(&self.angles).zip(&self.moments);
        for ((hinge, angle), moment) in hinges {
            for (node, slope) in hinge.iter().zip(&angle.slopes) {
                if *node != GHOST {
                    system.push(*node, slope.map(|s| -moment * s));
                }
            }
        }
    }

    /// Takes the creases' angles for those of their rest until they are looked at next: whole turns
    /// more or less look the same.
    pub fn expect_rests(&mut self) {
        for fold in &mut self.folds {
            fold.last = fold.rest;
        }
    }

    /// Creases that are turned further from their rest than they yield keep what is
    /// beyond, where they may; those that creep do so for so many seconds.
    pub fn settle(&mut self, positions: &[f32], tangents: &[f32], seconds: f32) {
        let (x, tangents) = (positions.as_chunks::<3>().0, tangents.as_chunks::<3>().0);
        for fold in &mut self.folds {
            let hinge = &self.hinges[fold.hinge];
            let angle = measure(&vertices(hinge, x, tangents, self.columns)).value;
            fold.last = unwrapped(angle, fold.last);
            let turned = fold.crease_angle() - fold.rest;
            let plasticity = &fold.plasticity;
            let beyond = plasticity.follow(turned.into(), self.may_yield, seconds.into()) as f32;
            if beyond != 0.0 {
                let rest = fold.rest + beyond;
                let rest = rest.clamp(-fold.tightest, fold.tightest);
                let moment = fold.spring * turned.abs().min(plasticity.yields as f32);
                self.yielded += moment * (rest - fold.rest).abs();
                fold.rest = rest;
            }
        }
    }

    /// Mean angle of a crease over its edges, and that of its rest, radians as
    /// [`FoldLine::rest`]; None where there is no such crease.
    pub fn crease(&self, crease: usize) -> Option<[f32; 2]> {
        let (mut sum, mut count) = ([0.0; 2], 0.0);
        for fold in self.folds.iter().filter(|fold| fold.crease == crease) {
            sum[0] -= fold.crease_angle();
            sum[1] -= fold.rest;
            count += 1.0;
        }
        (count > 0.0).then(|| sum.map(|sum| sum / count))
    }

    /// Turns the rest of a crease to an angle, radians as [`FoldLine::rest`].
    pub fn set_rest(&mut self, crease: usize, rest: f32) {
        for fold in self.folds.iter_mut().filter(|fold| fold.crease == crease) {
            fold.rest = -rest;
        }
    }
}

impl Fold {
    /// The crease's part of the hinge's angle.
    fn crease_angle(&self) -> f32 {
        let turned = self.last - self.rest;
        self.rest + (1.0 - self.fraction) * turned
    }
}

impl Triangle {
    fn add_moments(&self, angles: &[Angle], moments: &mut [f32]) {
        let bent = self
            .hinges
            .map(|hinge| hinge.map_or(0.0, |hinge| angles[hinge].value));
        for (row, hinge) in self.stiffness.iter().zip(self.hinges) {
            if let Some(hinge) = hinge {
                moments[hinge] += row[0] * bent[0] + row[1] * bent[1] + row[2] * bent[2];
            }
        }
    }

    /// Calls with each pair of its nodes, the second not after the first, and its number.
    fn each_pair(&self, mut call: impl FnMut(usize, usize, usize)) {
        let mut pair = 0;
        for i in 0..self.count {
            for j in 0..=i {
                call(self.nodes[i], self.nodes[j], pair);
                pair += 1;
            }
        }
    }

    /// Adds the products of the angles' slopes.
    fn add_to(&self, angles: &[Angle], scale: f32, blocks: &mut [Block]) {
        // By node and hinge; the last node takes what there is none for.
        let mut slopes = [[[0.0f32; 4]; 3]; 7];
        for (side, (hinge, vertices)) in self.hinges.iter().zip(&self.vertices).enumerate() {
            let Some(hinge) = *hinge else { continue };
            for (vertex, [x, y, z]) in vertices.iter().zip(angles[hinge].slopes) {
                slopes[*vertex][side] = [x, y, z, 0.0];
            }
        }
        let slopes = slopes.map(|of_node| of_node.map(Four::new));
        let stiffness = self
            .stiffness
            .map(|row| row.map(|k| Four::splat(scale * k)));
        let mut pair = 0;
        for i in 0..self.count {
            let own = &slopes[i];
            let moments = stiffness.map(|[a, b, c]| (a * own[0] + b * own[1] + c * own[2]).array());
            for other in &slopes[..=i] {
                let block = &mut blocks[usize::from(self.blocks[pair])];
                for (axis, row) in block.iter_mut().enumerate() {
                    let [a, b, c] = [0, 1, 2].map(|k| Four::splat(moments[k][axis]));
                    *row = *row + a * other[0] + b * other[1] + c * other[2];
                }
                pair += 1;
            }
        }
    }
}

/// Places of a hinge's vertices.
fn vertices(hinge: &Hinge, x: &[[f32; 3]], tangents: &[[f32; 3]], columns: usize) -> [[f32; 3]; 4] {
    hinge.map(|node| {
        if node == GHOST {
            let (spine, tangent) = (x[hinge[0]], tangents[hinge[0] / columns]);
            core::array::from_fn(|axis| 2.0 * spine[axis] - tangent[axis])
        } else {
            x[node]
        }
    })
}

/// The angle over the edge from `x[0]` to `x[1]`, with the apex `x[2]` on the left and
/// `x[3]` on the right, seen from where the normals point: above 0 where the sheet bulges
/// towards them (as in Tamstorf and Grinspun 2013).
fn measure(x: &[[f32; 3]; 4]) -> Angle {
    let edge = sub(x[1], x[0]);
    let arms = [sub(x[2], x[0]), sub(x[3], x[0])];
    let normals = [cross(edge, arms[0]), cross(arms[1], edge)];
    let square = dot(edge, edge);
    let length = square.sqrt();
    let sine = dot(cross(normals[0], normals[1]), edge) / length;
    let mut slopes = [[0.0; 3]; 4];
    for (side, apex) in [2, 3].into_iter().enumerate() {
        let normal = normals[side];
        let scale = -length / dot(normal, normal).max(f32::MIN_POSITIVE);
        let foot = dot(arms[side], edge) / square;
        for axis in 0..3 {
            let slope = scale * normal[axis];
            slopes[0][axis] += (foot - 1.0) * slope;
            slopes[1][axis] -= foot * slope;
            slopes[apex][axis] += slope;
        }
    }
    Angle {
        value: libm::atan2f(sine, dot(normals[0], normals[1])),
        slopes,
    }
}

/// The angle, known but for whole turns, that is next to what it was last.
fn unwrapped(angle: f32, last: f32) -> f32 {
    let turns = libm::roundf((last - angle) / (2.0 * PI));
    angle + 2.0 * PI * turns
}
