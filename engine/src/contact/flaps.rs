//! The parts of a creased leaf between its creases, and where they meet each other.

use super::tolerance::{CURLED, DEEPEST, GAP};
use crate::models::sheet::{Sheet, Touching};
use crate::triangle::{BESIDE, area_normal};
use crate::turn::TurnModel;
use crate::vector::{dot, sub, unit};

/// How much longer than at rest a triangle's sides may be, and what lies over it still be found.
const STRETCHED: f32 = 1.1;

/// Distance that parts of a leaf keep, metres: both bend between their nodes, and each is drawn
/// as it bends.
pub const PARTS_GAP: f32 = 2.0 * GAP;

/// A triangle of a creased leaf.
#[derive(Clone, Debug)]
struct PartTriangle {
    nodes: [usize; 3],
    /// A set of bits, one for each crease that it lies beyond.
    part: u16,
    /// How far from its first node something may be that touches it, metres.
    reach: f32,
}

impl PartTriangle {
    /// Its normal, twice as long as it is large.
    fn normal(&self, points: &[[f32; 3]]) -> [f32; 3] {
        area_normal(self.nodes.map(|node| points[node]))
    }
}

/// Whether a part, the creases that it lies beyond, faces the other way than the rest of its
/// leaf, of which some creases are [shut](Flaps::shut).
pub fn is_turned_over(part: u16, shut: u16) -> bool {
    (part & shut).count_ones() % 2 == 1
}

/// The parts of a creased leaf.
#[derive(Clone, Debug)]
pub struct Flaps {
    triangles: Vec<PartTriangle>,
    /// The part of each node; None for those on creases.
    parts: Vec<Option<u16>>,
    /// The creases, each as the only bit of a set, from the one with the most beyond it to the
    /// one with the least, and the angle at which it rests, radians.
    creases: Vec<(u16, f32)>,
    /// Triangles on both sides of an edge of each crease, by their numbers.
    across: Vec<(u16, [usize; 2])>,
}

impl Flaps {
    /// The parts of a sheet; None where it is not creased.
    pub fn of(sheet: &Sheet) -> Option<Flaps> {
        let triangles = sheet.node_triangles();
        if triangles.is_empty() {
            return None;
        }
        let mut parts: Vec<Option<Option<u16>>> = vec![None; sheet.positions().len() / 3];
        for (corners, part) in &triangles {
            for &corner in corners {
                let own = parts[corner].get_or_insert(Some(*part));
                if *own != Some(*part) {
                    *own = None;
                }
            }
        }
        let (places, _) = sheet.positions().as_chunks::<3>();
        let of_reach = |nodes: [usize; 3]| {
            let [a, b, c] = nodes.map(|node| places[node]);
            let side = |way: [f32; 3]| dot(way, way).sqrt();
            let longest = side(sub(b, a)).max(side(sub(c, a)));
            (1.0 + 2.0 * BESIDE) * STRETCHED * longest + CURLED + PARTS_GAP
        };
        let mut across = Vec::new();
        for (number, (corners, part)) in triangles.iter().enumerate() {
            for (other, (others, beyond)) in triangles[..number].iter().enumerate() {
                let crease = part ^ beyond;
                let common = corners.iter().filter(|node| others.contains(node));
                if crease.is_power_of_two() && common.count() == 2 {
                    across.push((crease, [other, number]));
                }
            }
        }
        let lines = sheet.creases().into_iter().enumerate();
        let mut creases: Vec<(u16, f32)> = lines
            .map(|(number, line)| (1 << number, line.rest as f32))
            .collect();
        let beyond = |crease: u16| triangles.iter().filter(move |(_, part)| part & crease != 0);
        creases.sort_by_key(|(crease, _)| core::cmp::Reverse(beyond(*crease).count()));
        Some(Flaps {
            across,
            triangles: triangles
                .iter()
                .map(|&(nodes, part)| PartTriangle {
                    nodes,
                    part,
                    reach: of_reach(nodes),
                })
                .collect(),
            parts: parts.into_iter().map(Option::flatten).collect(),
            creases,
        })
    }

    /// The creases that are folded beyond a right angle, as a set of bits.
    pub fn shut(&self, points: &[[f32; 3]]) -> u16 {
        let mut even = [0.0; u16::BITS as usize];
        for (crease, sides) in &self.across {
            let [one, other] = sides.map(|side| self.triangles[side].normal(points));
            even[crease.trailing_zeros() as usize] += dot(one, other);
        }
        let shut = even.iter().enumerate().filter(|(_, even)| **even < 0.0);
        shut.fold(0, |set, (crease, _)| set | 1 << crease)
    }

    /// Turns the normals of what is folded over, so that those of the whole leaf point to the
    /// side to which the recto of what is not folded over faces: there a neighbour on the
    /// recto's side lies, whichever face of a flap it meets. Returns whether anything is.
    pub fn face_as_the_rest(&self, points: &[[f32; 3]], normals: &mut [[f32; 3]]) -> bool {
        let shut = self.shut(points);
        let turned = self.triangles.iter().map(|triangle| {
            let sign = if is_turned_over(triangle.part, shut) {
                -1.0
            } else {
                1.0
            };
            triangle.normal(points).map(|along| sign * along)
        });
        let sums = self.sums_at_nodes(turned, normals.len());
        for (normal, sum) in normals.iter_mut().zip(sums) {
            if dot(sum, sum) > 0.0 {
                *normal = unit(sum);
            }
        }
        shut != 0
    }

    /// Whether any part of the leaf is folded more than once.
    pub fn overlap(&self) -> bool {
        self.triangles
            .iter()
            .any(|triangle| triangle.part.count_ones() > 1)
    }

    /// The creases that rest beyond a right angle, as a set of bits.
    pub fn resting_shut(&self) -> u16 {
        let is_shut = |(_, rest): &&(u16, f32)| rest.abs() > core::f32::consts::FRAC_PI_2;
        let shut = self.creases.iter().filter(is_shut);
        shut.fold(0, |set, (crease, _)| set | crease)
    }

    /// The parts, each with its place from below in the leaf pressed flat, recto up: stacked in the
    /// order in which the creases fold them; those that creases divide which are not `shut` lie side
    /// by side.
    pub fn ranks(&self, shut: u16) -> Vec<(u16, usize)> {
        let mut parts: Vec<u16> = self.triangles.iter().map(|one| one.part).collect();
        parts.sort_unstable();
        parts.dedup();
        // Of each two parts that one lies upon the other, the lower and the upper.
        let mut upon = Vec::new();
        for (at, under) in parts.iter().enumerate() {
            let under_is_turned = is_turned_over(*under, shut);
            for (over, part) in parts.iter().enumerate().skip(at + 1) {
                let is_alike = is_turned_over(*part, shut) == under_is_turned;
                match self.drawn_side(*under, *part, is_alike) {
                    Some(side) if (side > 0.0) != under_is_turned => upon.push([at, over]),
                    Some(_) => upon.push([over, at]),
                    None => {}
                }
            }
        }
        // Folds that no paper could be in may have parts lie upon each other in a ring.
        let mut ranks = vec![0usize; parts.len()];
        for _ in 0..parts.len() {
            let before = ranks.clone();
            for [lower, upper] in &upon {
                ranks[*upper] = ranks[*upper].max(ranks[*lower] + 1).min(parts.len());
            }
            if ranks == before {
                break;
            }
        }
        parts.into_iter().zip(ranks).collect()
    }

    /// How high each node lies in the leaf pressed flat, recto up, metres: parts are stacked by
    /// their [ranks](Self::ranks), the distance that they keep apart. Nodes on creases are at the
    /// mean of what they join.
    pub fn stacked(&self) -> Vec<f32> {
        let ranks = self.ranks(self.resting_shut());
        let mut sums = vec![(0.0, 0.0); self.parts.len()];
        for triangle in &self.triangles {
            let at = ranks.partition_point(|(part, _)| *part < triangle.part);
            for node in triangle.nodes {
                sums[node].0 += ranks[at].1 as f32;
                sums[node].1 += 1.0;
            }
        }
        let height = |(sum, count): (f32, f32)| PARTS_GAP * sum / count.max(1.0);
        sums.into_iter().map(height).collect()
    }

    /// Notes the angle at which a crease rests now, radians.
    pub fn press(&mut self, crease: usize, rest: f32) {
        for (_, own) in self
            .creases
            .iter_mut()
            .filter(|(set, _)| set.trailing_zeros() as usize == crease)
        {
            *own = rest;
        }
    }

    /// The side of a triangle on which a node of another part lies, 1 for the recto's or -1, and
    /// how deep that may be in it, metres, and still be brought out of it: what is folded over
    /// by more than a right angle is there, and nothing else. `is_alike` says that the recto of the
    /// triangle faces the same way as that of the part at the node.
    fn side_of(&self, under: u16, part: u16, is_alike: bool) -> (f32, f32) {
        // The first crease between the two says on which, as seen from the spine: where both
        // are flaps, neither beyond the other's crease, the second lies upon the first.
        let first = |set: u16| {
            self.creases
                .iter()
                .position(|(crease, _)| set & crease != 0)
        };
        let [own, other] = [part & !under, under & !part].map(first);
        let crease = other.or(own);
        let rest = crease.map_or(0.0, |crease| self.creases[crease].1);
        // What is folded over lies on one side of what it is folded onto, and that on either face
        // of what is folded over, by how this is turned there: a letter's end stands with its recto
        // toward the page and lies in it with its verso, and limp paper curls.
        let is_turned = match (own, other) {
            (Some(own), Some(other)) => (own > other) == is_alike,
            (None, _) => is_alike,
            (Some(_), None) => false,
        };
        let side = if (rest > 0.0) != is_turned { 1.0 } else { -1.0 };
        let is_over = rest.abs() > core::f32::consts::FRAC_PI_2;
        (side, if is_over { CURLED } else { DEEPEST })
    }

    /// At each of so many nodes the sum of what is given of the triangles that have it.
    fn sums_at_nodes(
        &self,
        of_triangles: impl Iterator<Item = [f32; 3]>,
        nodes: usize,
    ) -> Vec<[f32; 3]> {
        let mut sums = vec![[0.0f32; 3]; nodes];
        for (triangle, own) in self.triangles.iter().zip(of_triangles) {
            for node in triangle.nodes {
                for axis in 0..3 {
                    sums[node][axis] += own[axis];
                }
            }
        }
        sums
    }

    /// Has parts of a sheet, the one that these are of, kept off each other in its next
    /// so many steps.
    pub fn touch(&self, sheet: &mut Sheet, steps: u32) {
        let seconds = steps as f32 * sheet.time_step();
        let points = sheet.positions().as_chunks::<3>().0;
        let velocities = sheet.velocities().as_chunks::<3>().0;
        sheet.touch(self.touching(points, velocities, seconds));
    }

    /// The side of a drawn triangle on which a point of another part lies, 1 for that of its normal
    /// or -1; None where the first crease between them is not folded by more than a right angle: it
    /// may be on either. `is_alike` says that the normals of both are along each other.
    pub fn drawn_side(&self, under: u16, part: u16, is_alike: bool) -> Option<f32> {
        let (side, deepest) = self.side_of(under, part, is_alike);
        (deepest == CURLED).then_some(side)
    }

    /// Finds where nodes of the leaf are over triangles of other parts of it, or in them: for
    /// each node and each other part at most one. A flap stays on the side to which its crease
    /// folds it.
    fn touching(
        &self,
        points: &[[f32; 3]],
        velocities: &[[f32; 3]],
        seconds: f32,
    ) -> Vec<Touching> {
        let mut found: Vec<(Touching, u16, f32)> = Vec::new();
        let triangles = self.triangles.iter();
        let normals: Vec<_> = triangles.map(|triangle| triangle.normal(points)).collect();
        // The way that the recto faces at each node; nothing is asked of those on creases.
        let facing = self.sums_at_nodes(normals.iter().copied(), points.len());
        for (node, part) in self.parts.iter().enumerate() {
            let Some(part) = *part else { continue };
            let point = points[node];
            let first = found.len();
            for (other, normal) in self.triangles.iter().zip(&normals) {
                let away = sub(point, points[other.nodes[0]]);
                let speed = sub(velocities[node], velocities[other.nodes[0]]);
                let nearer = seconds * dot(speed, speed).sqrt();
                let reach = other.reach + nearer;
                if other.part == part || dot(away, away) > reach * reach {
                    continue;
                }
                let is_alike = dot(facing[node], *normal) > 0.0;
                let (side, deepest) = self.side_of(other.part, part, is_alike);
                let mut touching = Touching {
                    node,
                    under: other.nodes,
                    is_joined: other.nodes.map(|corner| self.parts[corner].is_none()),
                    side,
                    distance: PARTS_GAP,
                    left: 0.0,
                };
                let near = PARTS_GAP - deepest..=PARTS_GAP + CURLED + nearer;
                let Some([_, gap]) = touching
                    .height_and_gap(|node| points[node])
                    .filter(|[height, _]| near.contains(height))
                else {
                    continue;
                };
                // What is deep in another part comes out of it over several ticks.
                touching.left = (-gap - GAP).max(0.0);
                match found[first..]
                    .iter_mut()
                    .find(|(_, known, _)| *known == other.part)
                {
                    Some((.., known)) if known.abs() <= gap.abs() => {}
                    Some(known) => *known = (touching, other.part, gap),
                    None => found.push((touching, other.part, gap)),
                }
            }
        }
        found.into_iter().map(|(touching, ..)| touching).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::book::Paper;
    use crate::grid::Side;
    use crate::models::sheet::SheetCrease;
    use crate::stock::Stock;

    /// Whatever is folded upon what, each part lies on the side of every other where it is once
    /// all creases are folded as they rest: as a letter with its end inside, in a zigzag, with
    /// two corners upon each other.
    #[test]
    fn parts_lie_where_their_creases_fold_them() {
        let page = [0.14, 0.21];
        let upright = |u: f64| [[u, 0.0], [u, 1.0]];
        let corners = [[[0.3, 0.0], [1.0, 0.6]], [[0.4, 1.0], [1.0, 0.5]]];
        let letter = [upright(0.36), upright(0.7)];
        let folds = [
            (letter, [160.0, 175.0]),
            (letter, [-160.0, -175.0]),
            (letter, [170.0, -160.0]),
            (letter, [-170.0, 160.0]),
            (corners, [165.0, 150.0]),
            (corners, [-165.0, -150.0]),
        ];
        for (lines, degrees) in folds {
            let mut sheet = Sheet::new(Paper::default().sheet(page)).expect("a leaf's sheet");
            let creases = [0, 1].map(|k| {
                SheetCrease::pressed(lines[k], f64::to_radians(degrees[k]), &Stock::BOOK, page[0])
            });
            sheet.crease(&creases).expect("these can be creased");
            sheet.lay_folded(Side::Right);
            let flaps = Flaps::of(&sheet).expect("it has parts");
            let points = sheet.positions().as_chunks::<3>().0;
            let normals = flaps.triangles.iter().map(|one| one.normal(points));
            let facing = flaps.sums_at_nodes(normals, points.len());
            let (mut found, mut parts) = (0, 0);
            for (node, part) in flaps.parts.iter().enumerate() {
                let Some(part) = *part else { continue };
                for other in flaps.triangles.iter().filter(|other| other.part != part) {
                    let normal = unit(other.normal(points));
                    let away = sub(points[node], points[other.nodes[0]]);
                    let height = dot(away, normal);
                    let level: [f32; 3] =
                        core::array::from_fn(|axis| away[axis] - height * normal[axis]);
                    // Near to its middle, and off it.
                    if dot(level, level) > 1e-4 || !(1e-3..0.03).contains(&height.abs()) {
                        continue;
                    }
                    let is_alike = dot(facing[node], normal) > 0.0;
                    let side = flaps.drawn_side(other.part, part, is_alike);
                    assert_eq!(
                        side,
                        Some(height.signum()),
                        "{degrees:?}: {part} over {} by {height}",
                        other.part
                    );
                    found += 1;
                    parts |= 1 << (4 * other.part + part);
                }
            }
            assert!(
                found > 50 && u32::count_ones(parts) >= 4,
                "{degrees:?}: {found}, {parts:b}"
            );
        }
    }
}
