//! Whether two leaves go through each other.
//!
//! Tested where leaves have come deep into each other, of the leaves as they are
//! simulated and as they are drawn.

use super::aabb::Aabb;
use super::mesh::Mesh;
use super::work::Work;
use crate::creased_only::CreasedOnly;
use crate::grid::cut_cell;
use crate::triangle::{Triangle, area_normal};
use crate::vector::{dot, sub};

/// Cells along a side of a tile that one box bounds, and points along it.
const TILE: usize = 3;
const SIDE: usize = TILE + 1;

/// Part of a facet's size by which an edge may miss it and still go through it:
/// rounding leaves no gap between facets.
const SEAM: f32 = 1e-4;

/// The inverse of the part of a leaf, next to the spine, in which the order of leaves
/// is looked at: what has passed another there has done so all along it, and meets no
/// edge of it any more.
const ROOT: usize = 4;

/// Work of looking at two boxes, at two tiles whose boxes overlap, at their facets, and of
/// finding a tile's cone, nanoseconds.
const BOXES: u32 = 2;
const PLANES: u32 = 100;
const FACETS: u32 = 1300;
const CONE: u32 = 100;

type Point = [f32; 3];
type Node = [u8; 2];

/// Cosine of the angle from one direction within which all normals of two tiles that are
/// next to each other are, where these do not go through each other. A right angle would
/// do if their outlines did not (Volino and Magnenat Thalmann 1994), but crumpled ones do.
const EVEN: f32 = 0.5;

/// Tiles along a side of a group, which one box bounds.
const GROUP: usize = 4;

/// A leaf, drawn or as paper, cut into tiles of cells and these gathered in groups; cut
/// anew, it takes the same room.
#[derive(Clone, Debug, Default)]
pub struct Tiles {
    tiles: Vec<Tile>,
    groups: Vec<(Aabb, core::ops::Range<usize>)>,
    cones: Vec<Cone>,
}

#[derive(Clone, Debug)]
struct Tile {
    bounds: Aabb,
    /// Its column and its row among the tiles.
    place: [usize; 2],
    /// Column and row of its points.
    nodes: [Node; SIDE * SIDE],
    /// Of its points those of cells that are cut along their other diagonal, as a set of bits.
    falling: CreasedOnly<u16>,
    /// x, y, z of its points, row by row; where the leaf has fewer the last again.
    points: [[f32; SIDE * SIDE]; 3],
    /// The middle one's normal, and how far along it the points reach.
    normal: Point,
    reach: [f32; 2],
}

/// The normals of a tile's facets: an axis among them, and the square of the cosine of
/// the widest angle from it; less than 0 where that is more than a right angle.
#[derive(Clone, Copy, Debug)]
struct Cone {
    axis: Point,
    square: f32,
}

impl Tiles {
    /// Cuts a leaf.
    pub fn cut(&mut self, leaf: Mesh<'_>) {
        let (columns, rows) = (leaf.columns, leaf.points.len() / leaf.columns);
        self.tiles.clear();
        self.groups.clear();
        let side = TILE * GROUP;
        for row in (0..rows - 1).step_by(side) {
            for column in (0..columns - 1).step_by(side) {
                let from = self.tiles.len();
                for r in (row..(row + side).min(rows - 1)).step_by(TILE) {
                    for c in (column..(column + side).min(columns - 1)).step_by(TILE) {
                        self.tiles.push(Tile::of(leaf, c, r));
                    }
                }
                let mut around = Aabb::EMPTY;
                let inside = self.tiles[from..].iter();
                inside.for_each(|tile| around.unite(&tile.bounds));
                self.groups.push((around, from..self.tiles.len()));
            }
        }
    }

    /// Whether two leaves go through each other by more than `tolerance`, metres: edges of
    /// which both ends are farther than that from the plane of a facet go through it.
    pub fn cross(&self, other: &Tiles, tolerance: f32, work: &mut Work) -> bool {
        work.spend(BOXES * (self.groups.len() * other.groups.len()) as u32);
        self.groups.iter().any(|(around, inside)| {
            let groups = other.groups.iter();
            let mut groups = groups.filter(|group| around.overlaps(&group.0));
            groups.any(|(around, others)| {
                work.spend(BOXES * inside.len() as u32);
                let own = self.tiles[inside.clone()].iter();
                let mut own = own.filter(|own| own.bounds.overlaps(around));
                own.any(|own| {
                    work.spend(BOXES * others.len() as u32);
                    let mut others = other.tiles[others.clone()].iter();
                    others.any(|other| own.crosses(other, tolerance, false, work))
                })
            })
        })
    }

    /// Whether a leaf goes through itself, or comes nearer to it than `apart` metres where an
    /// edge ends. Parts that are next to each other can do so only where they are bent.
    pub fn cross_themselves(&mut self, apart: f32, work: &mut Work) -> bool {
        self.cones.clear();
        self.cones.extend(self.tiles.iter().map(Tile::cone));
        work.spend(CONE * self.tiles.len() as u32);
        let middle = self.cones[self.cones.len() / 2].axis;
        if self
            .cones
            .iter()
            .all(|cone| cone.is_within_right_angle_of(middle))
        {
            return false;
        }
        let count = self.groups.len();
        (0..count).any(|k| {
            (k..count).any(|j| {
                work.spend(BOXES);
                self.groups[k].0.overlaps(&self.groups[j].0)
                    && self.groups_cross([k, j], -apart, work)
            })
        })
    }

    fn groups_cross(&self, [k, j]: [usize; 2], tolerance: f32, work: &mut Work) -> bool {
        let (inside, others) = (&self.groups[k].1, &self.groups[j].1);
        inside.clone().any(|a| {
            let from = if k == j { a } else { others.start };
            work.spend(BOXES * (others.end - from) as u32);
            (from..others.end).any(|b| {
                let (own, other) = (&self.tiles[a], &self.tiles[b]);
                let apart = |i: usize| own.place[i].abs_diff(other.place[i]) > 1;
                let is_even = || self.cones[a].is_along(&self.cones[b]);
                (apart(0) || apart(1) || !is_even()) && own.crosses(other, tolerance, true, work)
            })
        })
    }
}

impl Cone {
    /// Whether all its normals are within a right angle of a direction.
    fn is_within_right_angle_of(&self, direction: Point) -> bool {
        let along = dot(self.axis, direction);
        self.square > 0.0 && along > 0.0 && along * along > 1.0 - self.square
    }

    /// Whether the normals of both are nearly along one direction.
    fn is_along(&self, other: &Cone) -> bool {
        // Half the angle between the axes, and the wider of both cones beside it.
        let half = 0.5 * (1.0 + dot(self.axis, other.axis));
        let square = self.square.min(other.square);
        let sines = (1.0 - half).max(0.0) * (1.0 - square);
        square > 0.0 && (half * square).sqrt() - sines.sqrt() > EVEN
    }
}

/// Whether all of a leaf's root has passed that of the one on its right, by `tolerance`
/// metres or more somewhere.
#[inline(never)]
pub fn is_past(left: Mesh<'_>, right: Mesh<'_>, tolerance: f32) -> bool {
    let root = 1..=left.columns / ROOT;
    let nodes = (0..left.points.len()).filter(|node| root.contains(&(node % left.columns)));
    let ahead = nodes.map(|node| {
        let away = sub(left.points[node], right.points[node]);
        dot(away, right.normals[node])
    });
    let [least, most] = ahead.fold([f32::MAX, f32::MIN], |[a, b], h| [a.min(h), b.max(h)]);
    most < 0.0 && least < -tolerance
}

/// Whether a leaf's fore-edge has passed another leaf by more than the first of two lengths, metres, and
/// less than the second, as what is farther has come round its rim. `side` is 1 where the leaf lies on
/// the recto's side of the other, else -1.
#[inline(never)]
pub fn is_fore_edge_past(
    leaf: Mesh<'_>,
    other: Mesh<'_>,
    side: f32,
    [least, most]: [f32; 2],
) -> bool {
    let columns = leaf.columns;
    let mut fore_edge = (columns - 1..leaf.points.len()).step_by(columns);
    fore_edge.any(|node| {
        let place = leaf.points[node];
        let near = other.nearest_node(place, node);
        let facet = other.facet_next_to(place, near, true);
        let past = -side * facet.height;
        past > least && past < most && !facet.beyond
    })
}

#[inline(never)]
fn range(values: &[f32; SIDE * SIDE]) -> [f32; 2] {
    // Compared by hand: a library's least and most mind what is no number, and are slow.
    let mut range = [f32::MAX, f32::MIN];
    for &value in values {
        range[0] = if value < range[0] { value } else { range[0] };
        range[1] = if value > range[1] { value } else { range[1] };
    }
    range
}

impl Tile {
    /// The tile of a leaf from a column and a row on.
    fn of(leaf: Mesh<'_>, column: usize, row: usize) -> Tile {
        let (columns, rows) = (leaf.columns, leaf.points.len() / leaf.columns);
        let node = |k: usize| {
            let row = (row + k / SIDE).min(rows - 1);
            row * columns + (column + k % SIDE).min(columns - 1)
        };
        let points: [[f32; SIDE * SIDE]; 3] =
            core::array::from_fn(|axis| core::array::from_fn(|k| leaf.points[node(k)][axis]));
        let normal = leaf.normals[node(SIDE + 1)];
        let falling = (0..SIDE * SIDE).filter(|k| leaf.folds.is_falling(node(*k)));
        let [x, y, z] = points.each_ref().map(range);
        Tile {
            bounds: Aabb {
                low: [x[0], y[0], z[0]],
                high: [x[1], y[1], z[1]],
            },
            place: [column / TILE, row / TILE],
            nodes: core::array::from_fn(|k| {
                let node = node(k);
                [(node % columns) as u8, (node / columns) as u8]
            }),
            falling: CreasedOnly::some(falling.fold(0, |set, k| set | 1 << k)),
            reach: range(&heights(&points, normal, 0.0)),
            points,
            normal,
        }
    }

    /// The facets by their corners, two a cell. Each cell's diagonal runs, as it is drawn,
    /// from its corner next to the spine and the foot; along a crease also the other way.
    fn facets(&self) -> impl Iterator<Item = [usize; 3]> {
        (0..2 * TILE * TILE).map(move |number| {
            let cell = number / 2;
            let here = cell / TILE * SIDE + cell % TILE;
            cut_cell(here, SIDE, self.is_falling(here))[number % 2]
        })
    }

    fn is_falling(&self, cell: usize) -> bool {
        let falling = self.falling.as_ref();
        falling.is_some_and(|falling| falling >> cell & 1 == 1)
    }

    fn cone(&self) -> Cone {
        let mut square = f32::MAX;
        for corners in self.facets() {
            let normal = area_normal(corners.map(|k| self.point(k)));
            let (along, length) = (dot(normal, self.normal), dot(normal, normal));
            // Where the leaf has fewer points a facet is none.
            if length > 1e-20 {
                let own = along * along.abs() / length;
                square = if own < square { own } else { square };
            }
        }
        let axis = self.normal;
        Cone { axis, square }
    }

    /// Whether two tiles go through each other by more than `tolerance`. Where both are `of_one`
    /// leaf an edge does not go through facets that it ends at.
    fn crosses(&self, other: &Tile, tolerance: f32, of_one: bool, work: &mut Work) -> bool {
        if !self.bounds.overlaps(&other.bounds) {
            return false;
        }
        work.spend(PLANES);
        if self.is_beside(other, tolerance) || other.is_beside(self, tolerance) {
            return false;
        }
        work.spend(FACETS);
        self.pierces(other, tolerance, of_one) || other.pierces(self, tolerance, of_one)
    }

    /// Whether all of another tile is over this one, or under it, but for `tolerance` metres.
    fn is_beside(&self, other: &Tile, tolerance: f32) -> bool {
        let [low, high] = range(&heights(&other.points, self.normal, 0.0));
        low >= self.reach[1] - tolerance || high <= self.reach[0] + tolerance
    }

    fn point(&self, k: usize) -> Point {
        [0, 1, 2].map(|axis| self.points[axis][k])
    }

    /// Whether an edge of this tile goes through a facet of another.
    fn pierces(&self, other: &Tile, tolerance: f32, of_one: bool) -> bool {
        other.facets().any(|corners| {
            let facet = corners.map(|k| other.point(k));
            let ends_at = |node: Node| of_one && corners.iter().any(|&k| other.nodes[k] == node);
            Aabb::around(facet).overlaps(&self.bounds)
                && self.pierces_facet(facet, tolerance, ends_at)
        })
    }

    fn pierces_facet(
        &self,
        facet: [Point; 3],
        tolerance: f32,
        ends_at: impl Fn(Node) -> bool,
    ) -> bool {
        let normal = area_normal(facet);
        let tolerance = tolerance * dot(normal, normal).sqrt();
        let heights = heights(&self.points, normal, dot(normal, facet[0]));
        let [low, high] = range(&heights);
        if low >= -tolerance || high <= tolerance {
            return false;
        }
        let triangle = Triangle::of(facet, 1.0);
        (0..SIDE * SIDE).any(|k| {
            let (right, up) = (k % SIDE < TILE, k / SIDE < TILE);
            let across = if self.is_falling(k) {
                [1, SIDE]
            } else {
                [0, SIDE + 1]
            };
            let ends = [(right, [0, 1]), (up, [0, SIDE]), (right && up, across)];
            ends.into_iter().any(|(is_edge, steps)| {
                if !is_edge {
                    return false;
                }
                let [k, end] = steps.map(|step| k + step);
                let (h, g) = (heights[k], heights[end]);
                if h.min(g) >= -tolerance || h.max(g) <= tolerance {
                    return false;
                }
                if ends_at(self.nodes[k]) || ends_at(self.nodes[end]) {
                    return false;
                }
                let (p, q) = (self.point(k), self.point(end));
                let at = if h == g {
                    0.5
                } else {
                    (h / (h - g)).clamp(0.0, 1.0)
                };
                let place = core::array::from_fn(|i| p[i] + at * (q[i] - p[i]));
                triangle
                    .weights(place)
                    .iter()
                    .all(|weight| *weight >= -SEAM)
            })
        })
    }
}

/// How far points are along a normal, beyond `from`.
#[inline(never)]
fn heights([x, y, z]: &[[f32; SIDE * SIDE]; 3], n: Point, from: f32) -> [f32; SIDE * SIDE] {
    core::array::from_fn(|k| n[0] * x[k] + n[1] * y[k] + n[2] * z[k] - from)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::Surface;

    /// A surface of 9 x 7 points a centimetre apart, at a height by column and row.
    fn surface(height: impl Fn(f32, f32) -> f32) -> Surface {
        let mut surface = Surface::new(9, 7);
        for (node, point) in surface.positions.chunks_exact_mut(3).enumerate() {
            let (x, y) = ((node % 9) as f32 * 0.01, (node / 9) as f32 * 0.01);
            point.copy_from_slice(&[x, y, height(x, y)]);
        }
        surface.update_normals();
        surface
    }

    fn crosses(left: &Surface, right: &Surface) -> bool {
        let [mut a, mut b] = [Tiles::default(), Tiles::default()];
        a.cut(Mesh::of(left));
        b.cut(Mesh::of(right));
        let work = &mut Work::new(u32::MAX);
        assert_eq!(a.cross(&b, 1e-6, work), b.cross(&a, 1e-6, work));
        a.cross(&b, 1e-6, work)
    }

    #[test]
    fn leaves_upon_each_other_do_not_cross_however_they_bend() {
        let bent = |gap: f32| surface(move |x, y| 0.02 * (20.0 * x + 9.0 * y).sin() + gap);
        assert!(!crosses(&bent(0.0), &bent(5e-5)));
        assert!(!crosses(&bent(0.0), &bent(0.0)));
        assert!(crosses(&bent(0.0), &surface(|_, _| 0.01)));
    }

    #[test]
    fn a_crease_through_a_plane_is_found_wherever_it_is() {
        let level = surface(|_, _| 0.0);
        for row in 0..7 {
            for column in 0..9 {
                let (x, y) = (column as f32 * 0.01, row as f32 * 0.01);
                let at = |p: f32, q: f32| (p - x).abs() < 1e-4 && (q - y).abs() < 1e-4;
                let dented = surface(|p, q| if at(p, q) { -2e-5 } else { 2e-5 });
                assert!(crosses(&dented, &level), "{column} {row}");
            }
        }
    }

    /// Whether any edge of one of two surfaces goes through any triangle of the other.
    fn any_edge_pierces(left: &Surface, right: &Surface, tolerance: f32) -> bool {
        let of = [left, right].map(|surface| surface.positions.as_chunks::<3>().0);
        let triangles: Vec<[usize; 3]> = (0..6 * 9)
            .filter(|here| here % 9 < 8)
            .flat_map(|here| [[here, here + 1, here + 10], [here, here + 10, here + 9]])
            .collect();
        let pierces = |own: &[Point], other: &[Point]| {
            let edges = triangles
                .iter()
                .flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
            edges.into_iter().any(|edge| {
                let [p, q] = edge.map(|node| own[node]);
                triangles.iter().any(|corners| {
                    let facet = corners.map(|node| other[node]);
                    let normal = area_normal(facet);
                    let length = dot(normal, normal).sqrt();
                    let [h, g] = [p, q].map(|end| dot(normal, sub(end, facet[0])) / length);
                    let way = h / (h - g);
                    let place = core::array::from_fn(|i| p[i] + way * (q[i] - p[i]));
                    let weights = Triangle::of(facet, 1.0).weights(place);
                    let is_in = weights.iter().all(|weight| *weight >= -SEAM);
                    is_in && h.min(g) < -tolerance && h.max(g) > tolerance
                })
            })
        };
        pierces(of[0], of[1]) || pierces(of[1], of[0])
    }

    /// Leaves folded back at a column each, over each other and nearly touching.
    #[test]
    fn what_goes_through_what_is_found_as_by_looking_at_every_edge_and_triangle() {
        let mut state = 1u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / (1 << 24) as f32
        };
        let mut found = [0; 2];
        for _ in 0..400 {
            let gap = 8e-3 * random();
            let [left, right] = [0.0, gap].map(|over| {
                let (fold, slant) = (3.0 + 4.0 * random(), 0.4 * random());
                let mut surface = Surface::new(9, 7);
                for (node, point) in surface.positions.chunks_exact_mut(3).enumerate() {
                    let (u, v) = ((node % 9) as f32, (node / 9) as f32);
                    let beyond = u - fold - slant * v;
                    let x = if beyond > 0.0 { u - 2.0 * beyond } else { u };
                    let z = over + 1e-3 * random() + if beyond > 0.0 { 3e-3 } else { 0.0 };
                    point.copy_from_slice(&[0.01 * x, 0.01 * v, z]);
                }
                surface.update_normals();
                surface
            });
            let tolerance = 5e-5;
            let [mut a, mut b] = [Tiles::default(), Tiles::default()];
            a.cut(Mesh::of(&left));
            b.cut(Mesh::of(&right));
            let crosses = a.cross(&b, tolerance, &mut Work::new(u32::MAX));
            assert_eq!(crosses, any_edge_pierces(&left, &right, tolerance));
            found[usize::from(crosses)] += 1;
        }
        assert!(found.iter().all(|count| *count > 80), "{found:?}");
    }

    #[test]
    fn a_leaf_rolled_up_is_clear_of_itself_until_it_goes_through_itself() {
        // A spiral that comes round in 6 cells, and one of the same turn that shrinks
        // to less than nothing along the spine.
        let rolled = |growth: f32, lean: f32| {
            let mut surface = Surface::new(17, 7);
            for (node, point) in surface.positions.chunks_exact_mut(3).enumerate() {
                let (u, v) = ((node % 17) as f32, (node / 17) as f32);
                let (sin, cos) = libm::sincosf(u);
                let radius = 0.01 + growth * u + lean * u * (v - 3.0);
                point.copy_from_slice(&[radius * sin, 0.01 * v, radius * cos]);
            }
            surface.update_normals();
            let mut tiles = Tiles::default();
            tiles.cut(Mesh::of(&surface));
            tiles.cross_themselves(1e-6, &mut Work::new(u32::MAX))
        };
        assert!(!rolled(1e-3, 0.0));
        assert!(rolled(0.0, 1e-3));
        assert!(!rolled(1e-3, 1e-4));
    }

    #[test]
    fn a_leaf_swung_past_the_next_is_past_it_and_meets_no_edge_of_it() {
        let [left, right] = [1.0, -1.0].map(|slope| surface(move |x, _| slope * x));
        assert!(!is_past(Mesh::of(&left), Mesh::of(&right), 5e-5));
        assert!(is_past(Mesh::of(&right), Mesh::of(&left), 5e-5));
        assert!(!crosses(&left, &right));
    }
}
