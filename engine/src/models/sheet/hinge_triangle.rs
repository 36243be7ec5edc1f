//! A triangle of a creased sheet: what couples the angles of its three hinges.
//!
//! Its corners are vertices of all three hinges, the apex across a hinge of that one alone.
//! So the Hessian's block of two corners is a sum of three products of slopes, and one whose
//! earlier node is an apex is a single product: the others are zero, and are left out.

use super::hinge_angles::Slopes;
use super::system::System;
use crate::band::Band;
use crate::lanes::Four;

/// Pairs of its corners and apexes, each with itself too: of corners, of an apex and a corner,
/// of an apex with itself, of two apexes.
const CORNERS: usize = 6;
const MIXED: usize = CORNERS + 9;
const APEXES: usize = MIXED + 3;
const PAIRS: usize = APEXES + 3;

/// Two of three, the second before the first.
const TWO: [[usize; 2]; 3] = [[1, 0], [2, 0], [2, 1]];

/// A triangle with its corners in rising order.
#[derive(Clone, Debug)]
pub(super) struct HingeTriangle {
    /// Numbers of its nodes, rising.
    pub corners: [usize; 3],
    /// Across each of its hinges.
    apexes: [usize; 3],
    /// Its hinges; one that there is not is another, whose slopes are zero.
    hinges: [usize; 3],
    /// Which vertex of each hinge each corner is, and the apex.
    vertices: [[u8; 4]; 3],
    /// Energy is half of the angles' product with this, N m.
    pub stiffness: [[f32; 3]; 3],
    /// Where each pair's block begins in the matrix.
    places: [u32; PAIRS],
    /// For each apex a bit for each corner that comes after it.
    is_corner_later: [u8; 3],
    /// For each of [`TWO`] apexes whether the first of them comes after the second.
    is_first_later: [bool; 3],
}

impl HingeTriangle {
    /// A triangle of some corners. Each of its hinges is given with its four vertices, which
    /// are of another hinge where it has none. `stiffness` is of the angles of its hinges.
    pub fn new(
        mut corners: [usize; 3],
        hinges: [(usize, [usize; 4]); 3],
        stiffness: [[f32; 3]; 3],
    ) -> Self {
        corners.sort_unstable();
        let apex_of = |vertices: [usize; 4]| {
            let apex = vertices.into_iter().find(|node| !corners.contains(node));
            apex.expect("a hinge has an apex across")
        };
        let apexes = hinges.map(|(_, vertices)| apex_of(vertices));
        let vertices = [0, 1, 2].map(|k| {
            let of = |node: usize| {
                let found = hinges[k].1.iter().position(|known| *known == node);
                // Of another hinge: anyone will do.
                found.unwrap_or(0) as u8
            };
            let [a, b, c] = corners.map(of);
            [a, b, c, of(apexes[k])]
        });
        Self {
            corners,
            apexes,
            hinges: hinges.map(|(hinge, _)| hinge),
            vertices,
            stiffness,
            places: [0; PAIRS],
            is_corner_later: apexes.map(|apex| {
                let later = |bits, k: usize| bits | u8::from(corners[k] > apex) << k;
                (0..3).fold(0, later)
            }),
            is_first_later: TWO.map(|[a, b]| apexes[a] > apexes[b]),
        }
    }

    /// Finds where its blocks are in the matrix of a system. Those of nodes that do not move
    /// are zero, and added to what is before the first row.
    pub fn find_places(&mut self, system: &System) {
        let (corners, apexes) = (self.corners, self.apexes);
        let place = |a: usize, b: usize| system.block_place(a.max(b), a.min(b)) as u32;
        let mut places = [0; PAIRS];
        let mut pairs = Vec::with_capacity(PAIRS);
        for (k, corner) in corners.iter().enumerate() {
            pairs.extend(corners[..=k].iter().map(|other| (*corner, *other)));
        }
        for apex in apexes {
            pairs.extend(corners.iter().map(|corner| (apex, *corner)));
        }
        pairs.extend(apexes.iter().map(|apex| (*apex, *apex)));
        pairs.extend(TWO.iter().map(|[a, b]| (apexes[*a], apexes[*b])));
        for (to, (a, b)) in places.iter_mut().zip(pairs) {
            *to = place(a, b);
        }
        self.places = places;
    }

    /// Its stiffness by the angle of a hinge alone, N m; 0 of one that it has not.
    pub fn stiffness_at(&self, hinge: usize) -> f32 {
        let side = self.hinges.iter().position(|own| *own == hinge);
        side.map_or(0.0, |k| self.stiffness[k][k])
    }

    /// Adds the moments of its hinges at angles, N m.
    #[inline(always)]
    pub fn add_moments(&self, angles: &[f32], moments: &mut [f32]) {
        let bent = self.hinges.map(|hinge| angles[hinge]);
        for (row, hinge) in self.stiffness.iter().zip(self.hinges) {
            moments[hinge] += row[0] * bent[0] + row[1] * bent[1] + row[2] * bent[2];
        }
    }

    /// Adds the products of the angles' slopes to the matrix, times `scale`.
    #[inline(always)]
    pub fn add_to(&self, slopes: &[Slopes], scale: f32, matrix: &mut Band<f32>) {
        let nothing = Four::splat(0.0);
        // By hinge and corner, and of the apex.
        let (mut own, mut across) = ([[nothing; 3]; 3], [nothing; 3]);
        for k in 0..3 {
            let slopes = &slopes[self.hinges[k]];
            let [a, b, c, apex] = self.vertices[k].map(|vertex| slopes[usize::from(vertex & 3)]);
            own[k] = [a, b, c];
            across[k] = apex;
        }
        // The moments' slopes.
        let mut turned = [[nothing; 3]; 3];
        let mut stiff = [[nothing; 3]; 3];
        for k in 0..3 {
            let [a, b, c] = self.stiffness[k];
            stiff[k] = [scale * a, scale * b, scale * c].map(Four::splat);
            for corner in 0..3 {
                turned[k][corner] = stiff[k][0] * own[0][corner]
                    + stiff[k][1] * own[1][corner]
                    + stiff[k][2] * own[2][corner];
            }
        }
        let mut pair = 0;
        for later in 0..3 {
            for earlier in 0..=later {
                let [a, b, c] = [0, 1, 2].map(|k| (turned[k][later], own[k][earlier]));
                let mask = later == earlier;
                add(matrix, self.places[pair], mask, &[a, b, c]);
                pair += 1;
            }
        }
        for k in 0..3 {
            let apex = across[k];
            let moments = [0, 1, 2].map(|other: usize| stiff[other][k] * apex);
            for corner in 0..3 {
                let place = self.places[CORNERS + 3 * k + corner];
                if self.is_corner_later[k] >> corner & 1 == 1 {
                    add(matrix, place, false, &[(turned[k][corner], apex)]);
                } else {
                    let [a, b, c] = [0, 1, 2].map(|other| (moments[other], own[other][corner]));
                    add(matrix, place, false, &[a, b, c]);
                }
            }
            add(matrix, self.places[MIXED + k], true, &[(moments[k], apex)]);
        }
        for (k, [a, b]) in TWO.into_iter().enumerate() {
            let [later, earlier] = if self.is_first_later[k] {
                [a, b]
            } else {
                [b, a]
            };
            let moment = stiff[earlier][later] * across[later];
            add(
                matrix,
                self.places[APEXES + k],
                false,
                &[(moment, across[earlier])],
            );
        }
    }
}

/// Adds products a b^T to a block one after another, of a node's own block the lower part.
#[inline(always)]
fn add<const N: usize>(
    matrix: &mut Band<f32>,
    place: u32,
    is_own: bool,
    products: &[(Four, Four); N],
) {
    let rows = products.map(|(a, b)| {
        let rows = product(a, b);
        if is_own { lower(rows) } else { rows }
    });
    matrix.add_blocks(place as usize, &rows);
}

/// The rows of a b^T.
#[inline(always)]
fn product(a: Four, b: Four) -> [Four; 3] {
    let [x, y, z, _] = a.array();
    [Four::splat(x) * b, Four::splat(y) * b, Four::splat(z) * b]
}

/// The lower part of a node's own block.
#[inline(always)]
fn lower([x, y, z]: [Four; 3]) -> [Four; 3] {
    [
        x * Four::new([1.0, 0.0, 0.0, 0.0]),
        y * Four::new([1.0, 1.0, 0.0, 0.0]),
        z,
    ]
}
