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

use super::crease::SheetCrease;
use super::hinge_angles::{Hinge, Slopes, angles, measure};
use super::hinge_triangle::HingeTriangle;
use super::material::{Material, cut};
use super::plates::{plate_at, weights};
use super::settings::{Root, SheetSettings};
use super::system::System;
use crate::lanes::Four;
use crate::models::plastic_hinge::Plasticity;
use crate::real::bounded;
use crate::rigidity::Rigidity;
use core::f32::consts::PI;

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

/// The bending of a creased sheet.
#[derive(Clone, Debug)]
pub(super) struct Hinges {
    columns: usize,
    /// By the numbers of nodes, after which come those beyond the spine that the clamp's tangent
    /// stands for, one a row. The last hinges, at least one, repeat the first and never turn.
    hinges: Vec<Hinge>,
    /// For each four hinges and each of their vertices 1 where that moves, else 0.
    moves: Vec<[Four; 4]>,
    triangles: Vec<HingeTriangle>,
    /// Stiffness of each triangle by itself while it is [stiffened](Self::stiffen).
    single: Vec<[[f32; 3]; 3]>,
    folds: Vec<Fold>,
    /// Folds' hinges, in fours; the last is repeated.
    folded: Vec<[Hinge; 4]>,
    places: Vec<Four>,
    angles: Vec<f32>,
    slopes: Vec<Slopes>,
    moments: Vec<f32>,
    forces: Vec<Four>,
    /// Whether creases that are turned further than they yield keep the difference.
    pub may_yield: bool,
    /// Work done in yielding since it was last taken, J.
    pub yielded: f32,
}

impl Hinges {
    /// Of a sheet that is flat now.
    pub fn new(settings: &SheetSettings, material: &Material, creases: &[SheetCrease]) -> Self {
        let nodes = material.places.len();
        let mut hinges = Self {
            columns: material.columns,
            hinges: Vec::new(),
            moves: Vec::new(),
            triangles: Vec::new(),
            single: Vec::new(),
            folds: Vec::new(),
            folded: Vec::new(),
            places: vec![Four::splat(0.0); nodes + material.rows],
            angles: Vec::new(),
            slopes: Vec::new(),
            moments: Vec::new(),
            forces: vec![Four::splat(0.0); nodes + material.rows],
            may_yield: true,
            yielded: 0.0,
        };
        let mut corners = Vec::new();
        for rising in [false, true] {
            hinges.triangulate(settings, material, rising, &mut corners);
        }
        let own = hinges.hinges.len();
        let all = (own + 1).next_multiple_of(4);
        hinges.hinges.resize(all, hinges.hinges[0]);
        hinges.make_triangles(settings, material, &corners, own);
        if material.crumples {
            hinges.fold_everywhere(settings, material, own);
        } else {
            hinges.fold(material, creases, own);
        }
        let first = settings.first();
        for (four, hinges_of) in hinges.hinges.as_chunks::<4>().0.iter().enumerate() {
            let moves = [0, 1, 2, 3].map(|vertex| {
                Four::new([0, 1, 2, 3].map(|lane| {
                    let node = hinges_of[lane][vertex];
                    let moves = node < nodes && node % hinges.columns >= first;
                    if moves && 4 * four + lane < own {
                        1.0
                    } else {
                        0.0
                    }
                }))
            });
            hinges.moves.push(moves);
        }
        let folded: Vec<Hinge> = hinges
            .folds
            .iter()
            .map(|fold| hinges.hinges[fold.hinge])
            .collect();
        hinges.folded = folded
            .chunks(4)
            .map(|four| core::array::from_fn(|lane| four[lane.min(four.len() - 1)]))
            .collect();
        hinges.angles = vec![0.0; all];
        hinges.slopes = vec![[Four::splat(0.0); 4]; all];
        hinges.moments = vec![0.0; all];
        hinges
    }

    /// Has triangles be so many times as stiff as they are, by their corners, until they are
    /// [relieved](Self::relieve).
    pub fn stiffen(&mut self, times: impl Fn([usize; 3]) -> f32) {
        self.relieve();
        for triangle in &mut self.triangles {
            let times = times(triangle.corners);
            self.single.push(triangle.stiffness);
            triangle.stiffness = triangle.stiffness.map(|row| row.map(|one| times * one));
        }
    }

    /// Has triangles be as stiff as each is by itself.
    pub fn relieve(&mut self) {
        for (triangle, single) in self.triangles.iter_mut().zip(self.single.drain(..)) {
            triangle.stiffness = single;
        }
    }

    /// Finds where in the matrix of a system its triangles add.
    pub fn find_places(&mut self, system: &System) {
        for triangle in &mut self.triangles {
            triangle.find_places(system);
        }
    }

    /// Cuts every cell along its falling or its rising diagonal, but folded ones along
    /// their fold, and adds the hinges between the triangles. Lists the triangles' corners, and
    /// their hinges: that of each corner leads to the next.
    fn triangulate(
        &mut self,
        settings: &SheetSettings,
        material: &Material,
        rising: bool,
        listed: &mut Vec<([usize; 3], [Option<usize>; 3])>,
    ) {
        let (columns, count) = (material.columns, material.places.len());
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
                        [to, from, count + to / columns, own]
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
        for nodes in triangles {
            let own = core::array::from_fn(|k| hinge_at(nodes[k], nodes[(k + 1) % 3]));
            listed.push((nodes, own));
        }
    }

    /// Makes the triangles of some corners and hinges.
    fn make_triangles(
        &mut self,
        settings: &SheetSettings,
        material: &Material,
        listed: &[([usize; 3], [Option<usize>; 3])],
        none: usize,
    ) {
        let plate = Rigidity::of(&settings.stock, settings.grain);
        let weights = weights(settings, material);
        for (corners, own) in listed {
            let plate = plate_at(corners, &plate, &weights, settings, material);
            let stiffness = self.stiffness(corners, *own, material, &plate);
            let hinges = own.map(|hinge| {
                let hinge = hinge.unwrap_or(none);
                (hinge, self.hinges[hinge])
            });
            self.triangles
                .push(HingeTriangle::new(*corners, hinges, stiffness));
        }
    }

    /// The stiffness between the angles of a triangle's hinges, N m.
    fn stiffness(
        &self,
        nodes: &[usize; 3],
        hinges: [Option<usize>; 3],
        material: &Material,
        plate: &Rigidity,
    ) -> [[f32; 3]; 3] {
        let (columns, count) = (self.columns, material.places.len());
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
            let part = if self.hinges[hinge][2] >= count {
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
        stiffness
    }

    /// Makes folds of the hinges on creases.
    fn fold(&mut self, material: &Material, creases: &[SheetCrease], own: usize) {
        for (hinge, &[from, to, ..]) in self.hinges[..own].iter().enumerate() {
            let edge = [from.min(to), from.max(to)];
            let Some((_, crease)) = material.folds.iter().find(|(fold, _)| *fold == edge) else {
                continue;
            };
            let fold = self.fold_at(hinge, *crease, material, &creases[*crease]);
            self.folds.push(fold);
        }
    }

    /// Makes a fold of every hinge, flat at first, as if each were creased by hand.
    fn fold_everywhere(&mut self, settings: &SheetSettings, material: &Material, own: usize) {
        let line = SheetCrease::pressed([[0.0; 2]; 2], 0.0, &settings.stock, settings.width);
        let count = material.places.len();
        let inner = (0..own).filter(|hinge| self.hinges[*hinge][2] < count);
        let folds = inner.map(|hinge| Fold {
            // Shut but for what it springs back by: no facet is pressed through the next.
            tightest: PI - line.yields as f32,
            ..self.fold_at(hinge, 0, material, &line)
        });
        self.folds = folds.collect();
    }

    /// A hinge as part of a crease.
    fn fold_at(
        &self,
        hinge: usize,
        crease: usize,
        material: &Material,
        line: &SheetCrease,
    ) -> Fold {
        let triangles = self.triangles.iter();
        let paper: f64 = triangles
            .map(|triangle| f64::from(triangle.stiffness_at(hinge)))
            .sum();
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
    /// `tangents` are, for each row, the places to which the clamp's tangent points. The
    /// matrix becomes that of bending and of the nodes' `inertia`, mass over the square of a step.
    pub fn add_to(
        &mut self,
        positions: &[f32],
        tangents: &[f32],
        scale: f32,
        inertia: impl Iterator<Item = f32>,
        system: &mut System,
    ) {
        self.look(positions, tangents);
        let fours = self.hinges.as_chunks::<4>().0.iter().zip(&self.moves);
        let slopes = self.slopes.as_chunks_mut::<4>().0;
        let angles = self.angles.as_chunks_mut::<4>().0;
        for (((hinges, moves), slopes), angles) in fours.zip(slopes).zip(angles) {
            *angles = measure(hinges, &self.places, moves, slopes);
        }
        for fold in &mut self.folds {
            let angle = &mut self.angles[fold.hinge];
            fold.last = unwrapped(*angle, fold.last);
            *angle = fold.fraction * (fold.last - fold.rest);
            let slopes = &mut self.slopes[fold.hinge];
            *slopes = slopes.map(|slope| Four::splat(fold.fraction) * slope);
        }
        self.moments.fill(0.0);
        system.matrix.clear();
        for triangle in &self.triangles {
            triangle.add_moments(&self.angles, &mut self.moments);
            triangle.add_to(&self.slopes, scale, &mut system.matrix);
        }
        for (node, inertia) in inertia.enumerate() {
            if system.moves(node) {
                system.add_diagonal(node, inertia);
            }
        }
        for fold in &self.folds {
            self.moments[fold.hinge] += fold.stiffness * self.angles[fold.hinge];
            let hinge = &self.hinges[fold.hinge];
            let slopes = self.slopes[fold.hinge].map(|slope| {
                let [x, y, z, _] = slope.array();
                [x, y, z]
            });
            let scaled = slopes.map(|slope| slope.map(|s| scale * fold.stiffness * s));
            let nodes = positions.len() / 3;
            let moves = hinge.map(|node| node < nodes && system.moves(node));
            for i in 0..4 {
                for j in 0..4 {
                    let (a, b) = (hinge[i], hinge[j]);
                    if b <= a && moves[i] && moves[j] {
                        system.add_product(a, b, scaled[i], slopes[j]);
                    }
                }
            }
        }
        let forces = system.forces.as_chunks_mut::<3>().0;
        for (to, [x, y, z]) in self.forces.iter_mut().zip(&*forces) {
            *to = Four::new([*x, *y, *z, 0.0]);
        }
        let hinges = self.hinges.iter().zip(&self.slopes).zip(&self.moments);
        for ((hinge, slopes), moment) in hinges {
            let moment = Four::splat(*moment);
            for (node, slope) in hinge.iter().zip(slopes) {
                let force = &mut self.forces[*node];
                *force = *force - moment * *slope;
            }
        }
        for (to, force) in forces.iter_mut().zip(&self.forces) {
            let [x, y, z, _] = force.array();
            *to = [x, y, z];
        }
    }

    /// Takes over where nodes are, and those beyond the spine that the clamp's tangents stand for.
    fn look(&mut self, positions: &[f32], tangents: &[f32]) {
        let (x, tangents) = (positions.as_chunks::<3>().0, tangents.as_chunks::<3>().0);
        let nodes = x.iter().map(|[x, y, z]| Four::new([*x, *y, *z, 0.0]));
        let spine = x.iter().step_by(self.columns).zip(tangents);
        let beyond = spine.map(|(spine, tangent)| {
            let [x, y, z] = core::array::from_fn(|axis| 2.0 * spine[axis] - tangent[axis]);
            Four::new([x, y, z, 0.0])
        });
        for (place, at) in self.places.iter_mut().zip(nodes.chain(beyond)) {
            *place = at;
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
        self.look(positions, tangents);
        for (hinges, folds) in self.folded.iter().zip(self.folds.chunks_mut(4)) {
            for (fold, angle) in folds.iter_mut().zip(angles(hinges, &self.places)) {
                fold.last = unwrapped(angle, fold.last);
                self.yielded += fold.settle(self.may_yield, seconds);
            }
        }
    }

    /// Mean angle of a crease over its edges, and that of its rest, radians as
    /// [`SheetCrease::rest`]; None where there is no such crease.
    pub fn crease(&self, crease: usize) -> Option<[f32; 2]> {
        let (mut sum, mut count) = ([0.0; 2], 0.0);
        for fold in self.folds.iter().filter(|fold| fold.crease == crease) {
            sum[0] -= fold.crease_angle();
            sum[1] -= fold.rest;
            count += 1.0;
        }
        (count > 0.0).then(|| sum.map(|sum| sum / count))
    }

    /// Turns the rest of a crease to an angle, radians as [`SheetCrease::rest`].
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

    /// Lets the rest follow for so many seconds, beyond its yield at once if it may. Returns the
    /// work done in yielding, J.
    fn settle(&mut self, may_yield: bool, seconds: f32) -> f32 {
        let turned = self.crease_angle() - self.rest;
        let plasticity = &self.plasticity;
        let beyond = plasticity.follow(turned.into(), may_yield, seconds.into()) as f32;
        if beyond == 0.0 {
            return 0.0;
        }
        let rest = bounded(self.rest + beyond, -self.tightest, self.tightest);
        let moment = self.spring * turned.abs().min(plasticity.yields as f32);
        let work = moment * (rest - self.rest).abs();
        self.rest = rest;
        work
    }
}

/// The angle, known but for whole turns, that is next to what it was last.
fn unwrapped(angle: f32, last: f32) -> f32 {
    let turns = libm::roundf((last - angle) / (2.0 * PI));
    angle + 2.0 * PI * turns
}
