//! Four numbers at a time. Lanes never mix and nothing is fused, so every target
//! computes the same bits.
//!
//! For WASM and x86-64 the instructions are named, because the compiler, left to
//! itself, regroups loops over fours and takes several times as long. Elsewhere,
//! and for doubles, it is plain Rust, which it does turn into 128-bit instructions.

use core::ops::{Add, Mul, Sub};

/// Lanes of a padded row are a multiple of this.
pub(crate) const ROW_LANES: usize = 8;

#[cfg(not(any(
    target_arch = "x86_64",
    all(target_arch = "wasm32", target_feature = "simd128")
)))]
mod target {
    pub type Lanes = [f32; 4];

    #[inline(always)]
    pub fn from(array: [f32; 4]) -> Lanes {
        array
    }

    #[inline(always)]
    pub fn array(lanes: Lanes) -> [f32; 4] {
        lanes
    }

    #[inline(always)]
    pub fn add(a: Lanes, b: Lanes) -> Lanes {
        core::array::from_fn(|i| a[i] + b[i])
    }

    #[inline(always)]
    pub fn sub(a: Lanes, b: Lanes) -> Lanes {
        core::array::from_fn(|i| a[i] - b[i])
    }

    #[inline(always)]
    pub fn mul(a: Lanes, b: Lanes) -> Lanes {
        core::array::from_fn(|i| a[i] * b[i])
    }
}

#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod target {
    use core::arch::wasm32::v128;
    pub use core::arch::wasm32::{f32x4_add as add, f32x4_mul as mul, f32x4_sub as sub};

    pub type Lanes = v128;

    #[inline(always)]
    pub fn from(array: [f32; 4]) -> Lanes {
        // SAFETY: both are 16 bytes, for which every pattern is valid.
        unsafe { core::mem::transmute(array) }
    }

    #[inline(always)]
    pub fn array(lanes: Lanes) -> [f32; 4] {
        // SAFETY: both are 16 bytes, for which every pattern is valid.
        unsafe { core::mem::transmute(lanes) }
    }
}

#[cfg(target_arch = "x86_64")]
mod target {
    use core::arch::x86_64::{__m128, _mm_add_ps, _mm_mul_ps, _mm_sub_ps};

    pub type Lanes = __m128;

    #[inline(always)]
    pub fn from(array: [f32; 4]) -> Lanes {
        // SAFETY: both are 16 bytes, for which every pattern is valid.
        unsafe { core::mem::transmute(array) }
    }

    #[inline(always)]
    pub fn array(lanes: Lanes) -> [f32; 4] {
        // SAFETY: both are 16 bytes, for which every pattern is valid.
        unsafe { core::mem::transmute(lanes) }
    }

    #[inline(always)]
    pub fn add(a: Lanes, b: Lanes) -> Lanes {
        // SAFETY: SSE2 is part of x86-64.
        unsafe { _mm_add_ps(a, b) }
    }

    #[inline(always)]
    pub fn sub(a: Lanes, b: Lanes) -> Lanes {
        // SAFETY: SSE2 is part of x86-64.
        unsafe { _mm_sub_ps(a, b) }
    }

    #[inline(always)]
    pub fn mul(a: Lanes, b: Lanes) -> Lanes {
        // SAFETY: SSE2 is part of x86-64.
        unsafe { _mm_mul_ps(a, b) }
    }
}

/// Four numbers, as [`crate::real::Real`] knows them.
pub trait Lanes<T>: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// From an array.
    fn of(array: [T; 4]) -> Self;
    /// One number four times.
    fn repeat(value: T) -> Self;
    /// As an array.
    fn to_array(self) -> [T; 4];
}

/// Four floats.
#[derive(Clone, Copy, Debug)]
pub struct Four(target::Lanes);

impl Four {
    #[inline(always)]
    pub fn new(array: [f32; 4]) -> Self {
        Self(target::from(array))
    }

    #[inline(always)]
    pub fn splat(value: f32) -> Self {
        Self::new([value; 4])
    }

    #[inline(always)]
    pub fn array(self) -> [f32; 4] {
        target::array(self.0)
    }
}

impl Add for Four {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(target::add(self.0, other.0))
    }
}

impl Sub for Four {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(target::sub(self.0, other.0))
    }
}

impl Mul for Four {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(target::mul(self.0, other.0))
    }
}

impl Lanes<f32> for Four {
    #[inline(always)]
    fn of(array: [f32; 4]) -> Self {
        Self::new(array)
    }
    #[inline(always)]
    fn repeat(value: f32) -> Self {
        Self::splat(value)
    }
    #[inline(always)]
    fn to_array(self) -> [f32; 4] {
        self.array()
    }
}

/// Four doubles.
#[derive(Clone, Copy, Debug)]
pub struct FourDoubles([f64; 4]);

impl Add for FourDoubles {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(core::array::from_fn(|i| self.0[i] + other.0[i]))
    }
}

impl Sub for FourDoubles {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(core::array::from_fn(|i| self.0[i] - other.0[i]))
    }
}

impl Mul for FourDoubles {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(core::array::from_fn(|i| self.0[i] * other.0[i]))
    }
}

impl Lanes<f64> for FourDoubles {
    #[inline(always)]
    fn of(array: [f64; 4]) -> Self {
        Self(array)
    }
    #[inline(always)]
    fn repeat(value: f64) -> Self {
        Self([value; 4])
    }
    #[inline(always)]
    fn to_array(self) -> [f64; 4] {
        self.0
    }
}
