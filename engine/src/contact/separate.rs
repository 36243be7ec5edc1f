//! DrawnLeaf leaves kept clear of each other.
//!
//! The leaves that meet in the engine are coarser than what is drawn of them:
//! between their nodes a sliver of overlap is left, and along a sharp fold more
//! than a sliver. What is drawn of one leaf is moved off the other here: its
//! points and the middles of its edges off the other's facets, and its facets
//! off the points and the middles of the edges of the other. A few rounds of
//! such projections (Bridson, Fedkiw and Anderson 2002 use the same weights)
//! leave nothing that can be seen.

use super::mesh::{Facet, Folds, Mesh};
use super::tolerance::{BENT, NOT_UPON, ROOM_FROM_SPINE, SLACK, SLIVER, WELL_CLEAR};
use super::work::Work;
use crate::surface::Surface;
use crate::vector::{dot, sub};

/// Rounds of projections, at most.
const ROUNDS: usize = 4;

/// Work of looking at a point or an edge, and at a facet next to one, nanoseconds.
const PROBE: u32 = 40;
const FACET: u32 = 20;

/// Steps from a point to the other end of an edge, in columns and rows: along a
/// row, along a column, along the diagonal of a cell as it is drawn.
const EDGES: [[usize; 2]; 3] = [[1, 0], [0, 1], [1, 1]];

/// What is drawn of a leaf, to be kept clear of another.
pub struct DrawnLeaf<'a> {
    pub surface: &'a Surface,
    /// How much it bends at each of its points (see [`find_bends`]), metres.
    pub bends: &'a [f32],
    /// What its creases change of it.
    pub folds: Folds<'a>,
}

/// Finds for every point of a surface how far off it the surface would be if it
/// were straight or even there, metres.
pub fn find_bends(surface: &Surface, bends: &mut [f32]) {
    let (columns, rows) = (surface.columns, surface.rows);
    let points = surface.positions.as_chunks::<3>().0;
    let twist = |node: usize| {
        let next = node + columns;
        if node % columns + 1 == columns || next >= points.len() {
            return 0.0;
        }
        let [a, b, c, d] = [node, node + 1, next, next + 1].map(|node| points[node]);
        let twist: [f32; 3] = core::array::from_fn(|i| a[i] - b[i] - c[i] + d[i]);
        dot(twist, twist)
    };
    for (node, own) in bends.iter_mut().enumerate() {
        let across = bend(points, node, [node % columns, columns], 1);
        let along = bend(points, node, [node / columns, rows], columns);
        *own = across.max(along).max(twist(node)).sqrt();
    }
}

/// The square of how far a point is off the line between those a step before it and after
/// it; the point is the `at`-th of `count` in that direction.
#[inline(never)]
fn bend(points: &[[f32; 3]], node: usize, [at, count]: [usize; 2], step: usize) -> f32 {
    if at == 0 || at + 1 == count {
        return 0.0;
    }
    let [a, b, c] = [node - step, node, node + step].map(|node| points[node]);
    // The columns are not even: what counts is the distance from the chord.
    let (chord, away) = (sub(c, a), sub(b, a));
    let part = dot(away, chord) / dot(chord, chord).max(1e-12);
    let off: [f32; 3] = core::array::from_fn(|i| away[i] - part * chord[i]);
    dot(off, off)
}

/// Moves what is drawn of a leaf off another. Lengths are those of a page 0.14 m wide; its own
/// is wider by `scale`. `side` is 1 where the leaf lies on
/// the recto's side of the other; `own_close` and `other_close` say of a point of
/// either, by its column and row, whether it may touch the other leaf.
///
/// Leaves that no grab has crumpled are alike where they touch: their points are
/// enough. Otherwise the work is `thorough`, for as long as there is any left.
pub fn separate(
    (own, own_bends, own_folds): (&mut Surface, &[f32], Folds<'_>),
    other: &DrawnLeaf<'_>,
    [side, scale]: [f32; 2],
    thorough: bool,
    [own_close, other_close]: [&dyn Fn(usize, usize) -> bool; 2],
    work: &mut Work,
) {
    if work.is_spent() {
        return;
    }
    let mut own_probes = probes(own, own_bends, [true, thorough], scale, own_close);
    let mut other_probes = probes(
        other.surface,
        other.bends,
        [false, thorough],
        scale,
        other_close,
    );
    let columns = own.columns;
    let rounds = if thorough { ROUNDS } else { 1 };
    let mut moved = Vec::new();
    for round in 0..rounds {
        // A round looks only at what moved since the one before it.
        if round > 0 {
            own_probes.retain(|probe| probe.ends.iter().any(|end| moved[usize::from(*end)]));
            other_probes.retain(|probe| is_any_next_to(&moved, columns, probe.near));
        }
        moved.clear();
        moved.resize(own.positions.len() / 3, false);
        for (probes, by_facets) in [(&mut own_probes, false), (&mut other_probes, true)] {
            if work.is_spent() {
                return;
            }
            push_apart(
                (own, own_bends, own_folds),
                other,
                [side, scale],
                probes,
                by_facets,
                &mut moved,
                work,
            );
        }
        if !moved.contains(&true) {
            return;
        }
    }
}

/// A point that is looked at, or the middle of an edge: a point is an edge between it and itself.
struct Probe {
    ends: [u16; 2],
    /// The node of the other leaf nearest to it when it was last looked at.
    near: u16,
}

/// Whether one of a set of nodes is a corner of a cell around a node.
fn is_any_next_to(set: &[bool], columns: usize, node: u16) -> bool {
    let (column, row) = (usize::from(node) % columns, usize::from(node) / columns);
    let columns_next = column.saturating_sub(1)..(column + 2).min(columns);
    (row.saturating_sub(1)..(row + 2).min(set.len() / columns))
        .any(|row| set[row * columns..][columns_next.clone()].contains(&true))
}

/// Whether a point of a surface, by its column and row, is on its rim: all around it but at the spine.
pub fn is_rim(surface: &Surface, column: usize, row: usize) -> bool {
    column + 1 == surface.columns || row == 0 || row + 1 == surface.rows
}

/// The points of a surface that are to be looked at, and the ends of the edges: of
/// its points `all`, or its rim and where it is bent, and of these the edges if `thorough`. A rim
/// lies between two points of the other leaf, and so none of them need be over or under it.
fn probes(
    surface: &Surface,
    bends: &[f32],
    [all, thorough]: [bool; 2],
    scale: f32,
    close: &dyn Fn(usize, usize) -> bool,
) -> Vec<Probe> {
    let (columns, rows) = (surface.columns, surface.rows);
    let mut found = Vec::new();
    for node in 0..columns * rows {
        let (column, row) = (node % columns, node / columns);
        let edges = thorough && bends[node] > BENT * scale;
        // The column at the spine is everyone's.
        if column == 0 || !(all || edges || is_rim(surface, column, row)) || !close(column, row) {
            continue;
        }
        let mut push = |end: usize| {
            found.push(Probe {
                ends: [node as u16, end as u16],
                near: node as u16,
            });
        };
        push(node);
        for [right, up] in EDGES {
            if edges && column + right < columns && row + up < rows {
                push(node + up * columns + right);
            }
        }
    }
    found
}

fn middle(points: &[[f32; 3]], [a, b]: [u16; 2]) -> [f32; 3] {
    let (p, q) = (points[a as usize], points[b as usize]);
    core::array::from_fn(|axis| 0.5 * (p[axis] + q[axis]))
}

/// The facet of a mesh next to a place of another, where that could overlap it.
fn near(
    mesh: &Mesh<'_>,
    place: [f32; 3],
    probe: &mut Probe,
    ahead: &mut usize,
    [side, scale]: [f32; 2],
    [own_bends, bends]: [&[f32]; 2],
    work: &mut Work,
) -> Option<Facet> {
    // What is next to a point is as far along as what was next to the one before.
    let (at, count) = (usize::from(probe.ends[0]), mesh.points.len());
    let start = (at + *ahead) % count;
    let node = mesh.nearest_node(place, start);
    *ahead = (node + count - at) % count;
    probe.near = node as u16;
    let height = side * dot(sub(place, mesh.points[node]), mesh.normal(node));
    let clear = WELL_CLEAR * scale + 2.0 * (own_bends[at] + bends[node]);
    (height < clear).then(|| {
        let is_bent = bends[node] > BENT * scale;
        work.spend(FACET * if is_bent { 8 } else { 2 });
        mesh.facet_next_to(place, node, is_bent)
    })
}

/// How far a place is from being clear of a facet, metres; None where it is, or
/// where it was never next to it.
fn missing(place: [f32; 3], facet: &Facet, [side, scale]: [f32; 2]) -> Option<f32> {
    let away = (place[0] * place[0] + place[2] * place[2]).sqrt();
    let room = (away / (ROOM_FROM_SPINE * scale)).min(1.0) * scale;
    let missing = SLIVER * room - side * facet.height;
    (missing > SLACK * room && missing < NOT_UPON * scale && !facet.beyond).then_some(missing)
}

/// Pushes points and edges of a leaf off the facets of another, or where `by_facets` its
/// facets off points and edges of the other. Notes which of its points moved.
fn push_apart(
    (own, own_bends, own_folds): (&mut Surface, &[f32], Folds<'_>),
    other: &DrawnLeaf<'_>,
    [side, scale]: [f32; 2],
    probes: &mut [Probe],
    by_facets: bool,
    moved: &mut [bool],
    work: &mut Work,
) {
    let columns = own.columns;
    work.spend(PROBE * probes.len() as u32);
    let mut ahead = 0;
    let facing = if by_facets { -side } else { side };
    for probe in probes {
        let mut meshes = [Mesh::of(own), Mesh::of(other.surface)];
        meshes[0].folds = own_folds;
        meshes[1].folds = other.folds;
        let bends = [own_bends, other.bends];
        let (mover, met) = (usize::from(by_facets), usize::from(!by_facets));
        let place = middle(meshes[mover].points, probe.ends);
        let bends = [bends[mover], bends[met]];
        let facing = [facing, scale];
        let Some(facet) = near(&meshes[met], place, probe, &mut ahead, facing, bends, work) else {
            continue;
        };
        let Some(missing) = missing(place, &facet, facing) else {
            continue;
        };
        let points = own.positions.as_chunks_mut::<3>().0;
        let mut push = |node: usize, by: f32| {
            moved[node] |= by != 0.0;
            for axis in 0..3 {
                points[node][axis] += side * missing * by * facet.normal[axis];
            }
        };
        if by_facets {
            // The spine stays.
            let parts = facet.corners.into_iter().zip(facet.parts);
            let parts = parts.map(|(node, part)| {
                let is_bound = node.is_multiple_of(columns);
                (node, if is_bound { 0.0 } else { part })
            });
            let whole: f32 = parts.clone().map(|(_, part)| part * part).sum();
            parts.for_each(|(node, part)| push(node, part / whole.max(0.1)));
        } else {
            // An edge moves with both its ends, a point counts as both.
            let [a, b] = probe.ends.map(usize::from);
            let part = if a == b { 0.5 } else { 1.0 };
            push(a, part);
            push(b, part);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A surface of 9 x 7 points a centimetre apart, at a height that depends on the
    /// column.
    fn surface(height: impl Fn(usize) -> f32) -> Surface {
        let mut surface = Surface::new(9, 7);
        for (node, point) in surface.positions.chunks_exact_mut(3).enumerate() {
            let (column, row) = (node % 9, node / 9);
            point.copy_from_slice(&[column as f32 * 0.01, row as f32 * 0.01, height(column)]);
        }
        surface.update_normals();
        surface
    }

    fn bends(surface: &Surface) -> Vec<f32> {
        let mut bends = vec![0.0; 63];
        find_bends(surface, &mut bends);
        bends
    }

    /// Moves a leaf off one under it, all of which may touch; how either bends counts if `thorough`.
    fn separate_whole(upper: &mut Surface, lower: &Surface, thorough: bool) {
        let (own, other) = (bends(upper), bends(lower));
        let drawn = DrawnLeaf {
            surface: lower,
            bends: &other,
            folds: Folds::default(),
        };
        separate(
            (upper, &own, Folds::default()),
            &drawn,
            [1.0; 2],
            thorough,
            [&|_, _| true; 2],
            &mut Work::new(u32::MAX),
        );
    }

    /// The fore-edge of a lower leaf, bent up through an upper one between two columns of that.
    #[test]
    fn facets_are_pushed_off_a_rim_that_ends_between_their_points() {
        let mut upper = surface(|_| 0.0);
        let mut lower = surface(|column| if column == 8 { 4e-4 } else { -1e-3 });
        for point in lower.positions.chunks_exact_mut(3) {
            point[0] -= 0.005;
        }
        lower.update_normals();
        separate_whole(&mut upper, &lower, false);
        let points = upper.positions.as_chunks::<3>().0;
        for row in 0..7 {
            let over = 0.5 * (points[9 * row + 7][2] + points[9 * row + 8][2]);
            assert!(over > 4e-4, "row {row}: {over} m");
        }
    }

    #[test]
    fn a_fold_is_found_and_a_plane_is_none() {
        assert!(
            bends(&surface(|column| 0.002 * column as f32))
                .iter()
                .all(|b| *b < 1e-6)
        );
        let folded = bends(&surface(|column| if column == 4 { 0.004 } else { 0.0 }));
        assert!((folded[31] - 0.004).abs() < 1e-6, "{}", folded[31]);
    }

    /// A ridge of the lower leaf between the points of the upper one: no point of the
    /// upper leaf is under it, and its facets are all the same.
    #[test]
    fn facets_are_pushed_off_a_ridge_between_their_points() {
        let mut upper = surface(|_| 0.0);
        let mut lower = surface(|column| if column == 4 { -2e-4 } else { -2e-3 });
        for point in lower.positions.chunks_exact_mut(3) {
            point[0] += 0.005;
            point[2] += 1e-3;
        }
        lower.update_normals();
        let highest = |surface: &Surface| surface.positions[3 * 31 + 2];
        assert!(highest(&lower) > 5e-4);
        separate_whole(&mut upper, &lower, true);
        let points = upper.positions.as_chunks::<3>().0;
        for row in 1..6 {
            let over = 0.5 * (points[9 * row + 4][2] + points[9 * row + 5][2]);
            assert!(over > highest(&lower), "row {row}: {over} m");
        }
    }
}
