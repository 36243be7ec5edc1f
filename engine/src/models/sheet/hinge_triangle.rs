//! A triangle of a creased sheet: what couples the angles of its three hinges.
//!
//! Its corners are vertices of all three hinges, the apex across a hinge of that one alone.
//! So the Hessian's block of two corners is a sum of three products of slopes, and one with
//! an apex is a single product.

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

/// A triangle with its corners in rising order, and its hinges in that of the apexes across.
#[derive(Clone, Debug)]
pub(super) struct Triangle {
    corners: [usize; 3],
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
}

impl Triangle {
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
        let mut order = [0, 1, 2];
        order.sort_by_key(|k| apex_of(hinges[*k].1));
        let apexes = order.map(|k| apex_of(hinges[k].1));
        let vertices = order.map(|k| {
            let of = |node: usize| {
                let found = hinges[k].1.iter().position(|known| *known == node);
                // Of another hinge: anyone will do.
                found.unwrap_or(0) as u8
            };
            let [a, b, c] = corners.map(of);
            [a, b, c, of(apex_of(hinges[k].1))]
        });
        Self {
            corners,
            apexes,
            hinges: order.map(|k| hinges[k].0),
            vertices,
            stiffness: order.map(|i| order.map(|j| stiffness[i][j])),
            places: [0; PAIRS],
            is_corner_later: apexes.map(|apex| {
                let later = |bits, k: usize| bits | u8::from(corners[k] > apex) << k;
                (0..3).fold(0, later)
            }),
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

    /// Which of its hinges one is, if it is of them.
    pub fn side(&self, hinge: usize) -> Option<usize> {
        self.hinges.iter().position(|own| *own == hinge)
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
                let [first, second, third] =
                    [0, 1, 2].map(|k| product(own[k][later], turned[k][earlier]));
                let block = core::array::from_fn(|i| first[i] + second[i] + third[i]);
                let block = if later == earlier {
                    lower(block)
                } else {
                    block
                };
                matrix.add_block(self.places[pair] as usize, block);
                pair += 1;
            }
        }
        for k in 0..3 {
            for corner in 0..3 {
                let (apex, moment) = (across[k], turned[k][corner]);
                let block = if self.is_corner_later[k] >> corner & 1 == 1 {
                    product(moment, apex)
                } else {
                    product(apex, moment)
                };
                matrix.add_block(self.places[CORNERS + 3 * k + corner] as usize, block);
            }
        }
        for k in 0..3 {
            let block = lower(product(across[k], stiff[k][k] * across[k]));
            matrix.add_block(self.places[MIXED + k] as usize, block);
        }
        for (k, [a, b]) in TWO.into_iter().enumerate() {
            let block = product(across[a], stiff[a][b] * across[b]);
            matrix.add_block(self.places[APEXES + k] as usize, block);
        }
    }
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
