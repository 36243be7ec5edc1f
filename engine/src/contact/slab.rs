//! Two parallel planes between which triangles lie: what is beyond them is clear of all of these.

use super::aabb::Aabb;
use crate::triangle::{BESIDE, area_normal};
use crate::vector::{dot, unit};

/// Two parallel planes between which triangles lie, as far beyond their sides as points still
/// count as over them.
#[derive(Clone, Copy, Debug)]
pub struct Slab {
    /// The planes' unit normal: the mean of the triangles'.
    pub normal: [f32; 3],
    low: f32,
    high: f32,
    /// How far a point at most is along each axis from the triangle that it is one metre over.
    pub(super) lean: [f32; 3],
    /// Whether all triangles face along the normal. What is outside of the slab is then at least
    /// as far from each triangle that it is over.
    pub(super) is_even: bool,
}

impl Slab {
    pub fn around(points: &[[f32; 3]], triangles: &[[usize; 3]]) -> Slab {
        let normal_of = |corners: &[usize; 3]| area_normal(corners.map(|corner| points[corner]));
        let normals = triangles.iter().map(normal_of);
        let sum = normals.clone().fold([0.0; 3], |sum: [f32; 3], normal| {
            core::array::from_fn(|axis| sum[axis] + normal[axis])
        });
        let normal = unit(sum);
        let heights = triangles.as_flattened().iter();
        let heights = heights.map(|node| dot(points[*node], normal));
        // Compared by hand, as a library's least and most are slow.
        let [low, high] = heights.fold([f32::MAX, f32::MIN], |[low, high], height| {
            [
                if height < low { height } else { low },
                if height > high { height } else { high },
            ]
        });
        // A corner's weight is up to twice as much beyond 1 as the others' are below 0.
        let beyond = 2.0 * BESIDE * (high - low);
        Slab {
            normal,
            low: low - beyond,
            high: high + beyond,
            lean: normals.clone().fold([0.0; 3], |lean: [f32; 3], normal| {
                let normal = unit(normal).map(f32::abs);
                core::array::from_fn(|i| {
                    if lean[i] > normal[i] {
                        lean[i]
                    } else {
                        normal[i]
                    }
                })
            }),
            is_even: normals.into_iter().all(|own| dot(own, normal) > 0.0),
        }
    }

    /// How far a point is outside of it on a side, metres; less than 0 where it is not, or nothing
    /// is known by that.
    pub fn distance_of(&self, point: [f32; 3], side: f32) -> f32 {
        if !self.is_even {
            return f32::MIN;
        }
        side * dot(point, self.normal) - if side > 0.0 { self.high } else { -self.low }
    }

    /// How far a box is outside of it on a side, metres; less than 0 where it is not, or nothing
    /// is known by that.
    pub fn distance(&self, bounds: &Aabb, side: f32) -> f32 {
        if !self.is_even {
            return f32::MIN;
        }
        let along = |axis: usize| {
            let normal = side * self.normal[axis];
            let nearest = if normal > 0.0 {
                bounds.low
            } else {
                bounds.high
            };
            normal * nearest[axis]
        };
        let nearest = along(0) + along(1) + along(2);
        nearest - if side > 0.0 { self.high } else { -self.low }
    }
}
