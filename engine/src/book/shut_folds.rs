//! A creased leaf whose folds are held shut: what is folded over lies along what it is folded onto.
//!
//! A hand that turns a folded page keeps its folds shut. Parts that lie upon each other all the way
//! are then one packet that bends as the part next to the spine does, so none of them can come
//! through another: each of their points has a place over that part, found once for the flat paper.

use crate::book::book_space_leaf::WIDTH;
use crate::contact::flaps::{Flaps, PARTS_GAP};
use crate::contact::separate_parts::LEAST_WEIGHT;
use crate::contact::tolerance::ROOM_FROM_SPINE;
use crate::models::sheet::Sheet;
use crate::triangle::{Triangle, area_normal, nearest_weights, place_of};
use crate::vector::{dot, sub, unit};

/// Part of the page's width by which what is folded over may reach beyond the spine or another edge
/// of what it lies upon. What reaches beyond the spine is pressed together before it, where it is not
/// seen; what reaches farther lies upon the page across, and cannot be held shut with its own.
const OVERHANG: f32 = 0.05;

/// Part of the page's width from the spine in which it is pressed together.
const PRESSED: f32 = 0.45;

/// Layers of a letter. What is folded over ends so many times as far from the spine as there is room
/// for one leaf, so that all its layers have as much.
const LAYERS: f32 = 3.0;

/// By so much of the page's width shut folds may be longer or shorter than the paper: creases that
/// cross each other, and cannot all be shut, miss by more.
const TRUE_TO_PAPER: f32 = 1e-4;

/// Where the points of a creased leaf lie while its folds are shut.
#[derive(Clone, Debug)]
pub struct ShutFolds {
    /// Those of its nodes, and of what is drawn of it.
    pub nodes: Layers,
    pub drawn: Layers,
    /// Where its nodes are once it lies flat on the right, x, y, z of each, metres.
    pub places: Vec<f32>,
}

impl ShutFolds {
    /// Those of a leaf's sheet, with its flaps; `None` where no fold is to be shut, or none can.
    pub fn of(sheet: &Sheet, flaps: &Flaps) -> Option<ShutFolds> {
        let [width, height] = [sheet.settings().width, sheet.settings().height].map(|x| x as f32);
        let shut = flaps.resting_shut();
        if shut == 0 {
            return None;
        }
        let [places, drawn_places] = sheet.folded_flat(shut)?;
        let mesh = sheet.paper_mesh()?;
        let flat: Vec<[f32; 2]> = (sheet.flat_places().as_chunks::<3>().0.iter())
            .map(|[x, y, _]| [*x, *y])
            .collect();
        let drawn_flat: Vec<[f32; 2]> = (mesh.places.iter())
            .map(|[u, v]| [u * width, v * height])
            .collect();
        let drawn: Vec<_> = mesh.parted_triangles().collect();
        let lie = |flat: &[[f32; 2]], places: &[[f32; 2]], triangles: &[([usize; 3], u16)]| {
            Layers::of(flat, places, triangles, (flaps, shut), width)
        };
        Some(ShutFolds {
            nodes: lie(&flat, &places, &sheet.node_triangles())?,
            drawn: lie(&drawn_flat, &drawn_places, &drawn)?,
            places: places.iter().flat_map(|[x, y]| [*x, *y, 0.0]).collect(),
        })
    }
}

/// A point that lies over a triangle: its number, and the corners and its weights there.
pub type Carried = (usize, [usize; 3], [f32; 3]);

/// Points that lie over others.
#[derive(Clone, Debug)]
pub struct Layers {
    over: Vec<Over>,
    /// The triangles that nothing shut lies between and the spine.
    base: Vec<[usize; 3]>,
    /// For each point of these what part of a layer's height there is room for, so near to the spine; of
    /// others none.
    room: Vec<f32>,
    /// Most layers over a triangle of these, on the side of the recto and of the verso.
    most: [f32; 2],
    /// The parts that lie there.
    parts: [Vec<u16>; 2],
}

/// A point that lies over a triangle.
#[derive(Clone, Copy, Debug)]
struct Over {
    point: usize,
    corners: [usize; 3],
    weights: [f32; 3],
    /// Layers from the triangle, on the side of its recto or, below 0, of its verso; the less, the nearer
    /// to the spine, where all that fly meet in one line.
    layers: f32,
}

impl Over {
    /// Where it lies so far over its triangle, metres, and the normal there.
    fn place(&self, points: &[[f32; 3]], normals: &[[f32; 3]], height: f32) -> [f32; 3] {
        let at = place_of(self.weights, self.corners.map(|corner| points[corner]));
        let normals = self.corners.map(|corner| unit(normals[corner]));
        let normal = unit(place_of(self.weights, normals));
        core::array::from_fn(|axis| at[axis] + height * normal[axis])
    }
}

impl Layers {
    /// Those of points that are at `flat` on the paper, and at `places` once folds are shut, metres;
    /// of triangles, each with its part.
    fn of(
        flat: &[[f32; 2]],
        places: &[[f32; 2]],
        triangles: &[([usize; 3], u16)],
        (flaps, shut): (&Flaps, u16),
        width: f32,
    ) -> Option<Layers> {
        let ranks = flaps.ranks(shut);
        let rank_of = |part: u16| {
            let at = ranks.partition_point(|(known, _)| *known < part);
            ranks.get(at).map_or(0.0, |(_, rank)| *rank as f32)
        };
        let is_base = |part: &u16| part & shut == 0;
        let mut is_over = vec![true; flat.len()];
        // Sum and number of the ranks of what a point belongs to.
        let mut of_point = vec![[0.0f32; 2]; flat.len()];
        let apart = |points: &[[f32; 2]], a: usize, b: usize| {
            let [x, y] = [0, 1].map(|axis| points[b][axis] - points[a][axis]);
            (x * x + y * y).sqrt()
        };
        for (corners, part) in triangles {
            for (k, &corner) in corners.iter().enumerate() {
                let next = corners[(k + 1) % 3];
                let off = apart(flat, corner, next) - apart(places, corner, next);
                if off.abs() > TRUE_TO_PAPER * width {
                    return None;
                }
                is_over[corner] &= !is_base(part);
                of_point[corner][0] += rank_of(*part);
                of_point[corner][1] += 1.0;
            }
        }
        let base: Vec<([usize; 3], u16)> = triangles
            .iter()
            .filter(|(_, part)| is_base(part))
            .copied()
            .collect();
        // What reaches beyond the spine, or nearer to it than there is room for layers, is pressed
        // together evenly.
        let most = OVERHANG * width;
        let room = PRESSED * width;
        let clear = LAYERS * ROOM_FROM_SPINE * width / WIDTH;
        let nearest = (places.iter().zip(&is_over))
            .filter(|(_, is_over)| **is_over)
            .fold(clear, |least, ([x, _], _)| least.min(*x));
        if nearest < -most {
            return None;
        }
        let pressed = (room - clear) / (room - nearest);
        let mut over = Vec::new();
        for point in (0..flat.len()).filter(|point| is_over[*point]) {
            let [mut x, y] = places[point];
            if x < room {
                x = room - (room - x) * pressed;
            }
            let at = [x, y, 0.0];
            let mut nearest = (f32::MAX, 0);
            for (number, (corners, _)) in base.iter().enumerate() {
                let corners = corners.map(|corner| [flat[corner][0], flat[corner][1], 0.0]);
                let beside = |axis: usize| {
                    let [a, b, c] = corners.map(|corner| corner[axis]);
                    (a.min(b).min(c) - at[axis])
                        .max(at[axis] - a.max(b).max(c))
                        .max(0.0)
                };
                let [u, v] = [beside(0), beside(1)];
                if u * u + v * v >= nearest.0 {
                    continue;
                }
                let away = sub(at, place_of(nearest_weights(at, corners), corners));
                let square = dot(away, away);
                if square < nearest.0 {
                    nearest = (square, number);
                }
                if square == 0.0 {
                    break;
                }
            }
            if nearest.0 > most * most {
                return None;
            }
            let (corners, part) = *base.get(nearest.1)?;
            let triangle = corners.map(|corner| [flat[corner][0], flat[corner][1], 0.0]);
            let [sum, count] = of_point[point];
            let rank = sum / count.max(1.0) - rank_of(part);
            let apart = (x / clear).min(1.0);
            over.push(Over {
                point,
                corners,
                weights: Triangle::of(triangle, 1.0).weights(at),
                layers: rank * apart,
            });
        }
        let room = flat.iter().zip(&is_over).map(|([x, _], is_over)| {
            let room = (x / clear).min(1.0);
            if *is_over { 0.0 } else { room }
        });
        let most = [1.0, -1.0].map(|side| {
            let layers = over.iter().map(|over| side * over.layers);
            layers.fold(0.0, f32::max)
        });
        let [on_recto, on_verso]: [fn(f32, f32) -> bool; 2] = [|a, b| a > b, |a, b| a < b];
        let parts = [on_recto, on_verso].map(|lies_there| {
            let parts = ranks.iter().map(|(part, _)| *part);
            let over = parts.filter(|part| !is_base(part));
            over.filter(|part| lies_there(rank_of(*part), rank_of(0)))
                .collect()
        });
        Some(Layers {
            room: room.collect(),
            most,
            parts,
            over,
            base: base.into_iter().map(|(corners, _)| corners).collect(),
        })
    }

    /// How high the layers are, over and under what they lie upon, metres for a page 0.14 m wide.
    pub fn height(&self) -> f32 {
        PARTS_GAP * (self.most[0] + self.most[1])
    }

    /// Raises what others lie over by a part, 0 to 1, of the height of the layers under it: of those on the
    /// verso's side where the leaf lies on the right, on the recto's once it has `turned`, 0 to 1. So it is
    /// the lowest layer that lies upon a pile, also where that is steep.
    pub fn raise(&self, points: &mut [[f32; 3]], part: f32, turned: f32, scale: f32) {
        let [recto, verso] = self.most;
        let by = part * scale * PARTS_GAP * ((1.0 - turned) * verso - turned * recto);
        let normals = self.normals(points);
        for ((point, normal), room) in points.iter_mut().zip(normals).zip(&self.room) {
            let normal = unit(normal);
            for axis in 0..3 {
                point[axis] += by * room * normal[axis];
            }
        }
    }

    /// Brings points a part of the way, 0 to 1, to where they lie, on a page `scale` times as wide as usual.
    pub fn lay(&self, points: &mut [[f32; 3]], part: f32, scale: f32) {
        let normals = self.normals(points);
        for over in &self.over {
            let to = over.place(points, &normals, scale * over.layers * PARTS_GAP);
            let own = &mut points[over.point];
            for axis in 0..3 {
                own[axis] += part * (to[axis] - own[axis]);
            }
        }
    }

    /// Has points that were moved one by one from `before` move as one packet: what moved a point that
    /// lies over others moves those, and it goes where they go. Points that are bound stay.
    pub fn move_as_one(
        &self,
        points: &mut [[f32; 3]],
        before: &[[f32; 3]],
        is_bound: impl Fn(usize) -> bool,
    ) {
        let mut moves: Vec<[f32; 3]> = points
            .iter()
            .zip(before)
            .map(|(p, q)| sub(*p, *q))
            .collect();
        for over in &self.over {
            let by = moves[over.point];
            if by == [0.0; 3] {
                continue;
            }
            let free = |k: &usize| !is_bound(over.corners[*k]);
            let whole: f32 = (0..3).filter(free).map(|k| over.weights[k].powi(2)).sum();
            for k in (0..3).filter(free) {
                // Of all that lie over a corner the one that was moved most.
                let wanted = by.map(|by| by * over.weights[k] / whole.max(LEAST_WEIGHT));
                let own = &mut moves[over.corners[k]];
                if dot(wanted, wanted) > dot(*own, *own) {
                    *own = wanted;
                }
            }
        }
        for over in &self.over {
            moves[over.point] = place_of(over.weights, over.corners.map(|corner| moves[corner]));
        }
        for ((point, before), by) in points.iter_mut().zip(before).zip(&moves) {
            *point = core::array::from_fn(|axis| before[axis] + by[axis]);
        }
    }

    /// At each point the sum of the normals of the triangles below.
    fn normals(&self, points: &[[f32; 3]]) -> Vec<[f32; 3]> {
        debug_assert_eq!(points.len(), self.room.len());
        let mut normals = vec![[0.0f32; 3]; points.len()];
        for corners in &self.base {
            let normal = area_normal(corners.map(|corner| points[corner]));
            for corner in corners {
                for axis in 0..3 {
                    normals[*corner][axis] += normal[axis];
                }
            }
        }
        normals
    }

    /// The parts that lie over others on the side of the recto, or of the verso: a leaf on the other side
    /// meets none of them.
    pub fn parts_on(&self, is_recto: bool) -> &[u16] {
        &self.parts[usize::from(!is_recto)]
    }

    /// The points that lie over others, each with the corners and the weights of what it lies over.
    pub fn carried(&self) -> impl Iterator<Item = Carried> {
        let over = self.over.iter();
        over.map(|over| (over.point, over.corners, over.weights))
    }

    /// Brings what nodes have, such as velocities, a part of the way, 0 to 1, to what those have that they
    /// lie over.
    pub fn follow<const N: usize>(&self, values: &mut [[f32; N]], part: f32) {
        for over in &self.over {
            let of = over.corners.map(|corner| values[corner]);
            let own = &mut values[over.point];
            for axis in 0..N {
                let to: f32 = (0..3).map(|k| over.weights[k] * of[k][axis]).sum();
                own[axis] += part * (to - own[axis]);
            }
        }
    }
}

#[cfg(all(test, feature = "creases"))]
mod tests;
