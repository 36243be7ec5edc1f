//! Four floats at a time, in plain Rust that compilers turn into 128-bit
//! instructions: SSE2, NEON, simd128. Lanes never mix and nothing is fused, so
//! every target computes the same bits.

use core::ops::{Add, Mul, Sub};

/// Lanes of a padded row are a multiple of this.
pub(crate) const ROW_LANES: usize = 8;

/// Four floats.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(16))]
pub(crate) struct Four(pub [f32; 4]);

impl Four {
    pub const ZERO: Self = Self([0.0; 4]);

    #[inline(always)]
    pub fn splat(value: f32) -> Self {
        Self([value; 4])
    }
}

impl Add for Four {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(core::array::from_fn(|i| self.0[i] + other.0[i]))
    }
}

impl Sub for Four {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(core::array::from_fn(|i| self.0[i] - other.0[i]))
    }
}

impl Mul for Four {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(core::array::from_fn(|i| self.0[i] * other.0[i]))
    }
}
