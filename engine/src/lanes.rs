//! Four numbers at a time. Lanes never mix and nothing is fused, so every target
//! computes the same bits.
//!
//! For WASM and x86-64 the instructions are named, because the compiler, left to
//! itself, regroups loops over fours and takes several times as long. Elsewhere,
//! and for doubles, it is plain Rust, which it does turn into 128-bit instructions.

use core::ops::{Add, Div, Mul, Sub};

/// Lanes of a padded row are a multiple of this.
pub(crate) const ROW_LANES: usize = 8;

#[cfg(not(any(
    target_arch = "x86_64",
    all(target_arch = "wasm32", target_feature = "simd128")
)))]
mod target {
    /// Four numbers, as this target holds them.
    pub type Lanes = [f32; 4];

    /// Puts an array into lanes.
    #[inline(always)]
    pub fn from(array: [f32; 4]) -> Lanes {
        array
    }

    /// Takes an array out of lanes.
    #[inline(always)]
    pub fn array(lanes: Lanes) -> [f32; 4] {
        lanes
    }

    /// Lane by lane the sum.
    #[inline(always)]
    pub fn add(a: Lanes, b: Lanes) -> Lanes {
        core::array::from_fn(|i| a[i] + b[i])
    }

    /// Lane by lane the difference.
    #[inline(always)]
    pub fn sub(a: Lanes, b: Lanes) -> Lanes {
        core::array::from_fn(|i| a[i] - b[i])
    }

    /// Lane by lane the product.
    #[inline(always)]
    pub fn mul(a: Lanes, b: Lanes) -> Lanes {
        core::array::from_fn(|i| a[i] * b[i])
    }

    /// Lane by lane the quotient.
    #[inline(always)]
    pub fn div(a: Lanes, b: Lanes) -> Lanes {
        core::array::from_fn(|i| a[i] / b[i])
    }

    /// Lane by lane the square root.
    #[inline(always)]
    pub fn sqrt(a: Lanes) -> Lanes {
        a.map(f32::sqrt)
    }

    /// Lane by lane the absolute value.
    #[inline(always)]
    pub fn abs(a: Lanes) -> Lanes {
        a.map(f32::abs)
    }

    /// `b` where it is greater than `a`, else `a`.
    #[inline(always)]
    pub fn greater(a: Lanes, b: Lanes) -> Lanes {
        core::array::from_fn(|i| if a[i] < b[i] { b[i] } else { a[i] })
    }

    /// A bit for each lane in which `a` is greater than `b`, the first the lowest.
    #[inline(always)]
    pub fn exceeding(a: Lanes, b: Lanes) -> u32 {
        (0..4).fold(0, |bits, i| bits | u32::from(a[i] > b[i]) << i)
    }

    /// Four rows as four columns.
    #[inline(always)]
    pub fn transpose(rows: [Lanes; 4]) -> [Lanes; 4] {
        core::array::from_fn(|column| rows.map(|row| row[column]))
    }
}

#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod target {
    pub use core::arch::wasm32::{
        f32x4_abs as abs, f32x4_add as add, f32x4_div as div, f32x4_mul as mul,
        f32x4_pmax as greater, f32x4_sqrt as sqrt, f32x4_sub as sub,
    };
    use core::arch::wasm32::{f32x4_gt, i32x4_bitmask, i32x4_shuffle, v128};

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

    #[inline(always)]
    pub fn exceeding(a: Lanes, b: Lanes) -> u32 {
        u32::from(i32x4_bitmask(f32x4_gt(a, b)))
    }

    #[inline(always)]
    pub fn transpose([a, b, c, d]: [Lanes; 4]) -> [Lanes; 4] {
        let (low, high) = (
            i32x4_shuffle::<0, 4, 1, 5>(a, b),
            i32x4_shuffle::<2, 6, 3, 7>(a, b),
        );
        let (next_low, next_high) = (
            i32x4_shuffle::<0, 4, 1, 5>(c, d),
            i32x4_shuffle::<2, 6, 3, 7>(c, d),
        );
        [
            i32x4_shuffle::<0, 1, 4, 5>(low, next_low),
            i32x4_shuffle::<2, 3, 6, 7>(low, next_low),
            i32x4_shuffle::<0, 1, 4, 5>(high, next_high),
            i32x4_shuffle::<2, 3, 6, 7>(high, next_high),
        ]
    }
}

#[cfg(target_arch = "x86_64")]
mod target {
    use core::arch::x86_64::{
        __m128, _mm_add_ps, _mm_andnot_ps, _mm_cmpgt_ps, _mm_div_ps, _mm_max_ps, _mm_movehl_ps,
        _mm_movelh_ps, _mm_movemask_ps, _mm_mul_ps, _mm_set1_ps, _mm_sqrt_ps, _mm_sub_ps,
        _mm_unpackhi_ps, _mm_unpacklo_ps,
    };

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

    #[inline(always)]
    pub fn div(a: Lanes, b: Lanes) -> Lanes {
        // SAFETY: SSE2 is part of x86-64.
        unsafe { _mm_div_ps(a, b) }
    }

    #[inline(always)]
    pub fn sqrt(a: Lanes) -> Lanes {
        // SAFETY: SSE2 is part of x86-64.
        unsafe { _mm_sqrt_ps(a) }
    }

    #[inline(always)]
    pub fn abs(a: Lanes) -> Lanes {
        // SAFETY: SSE2 is part of x86-64.
        unsafe { _mm_andnot_ps(_mm_set1_ps(-0.0), a) }
    }

    #[inline(always)]
    pub fn greater(a: Lanes, b: Lanes) -> Lanes {
        // SAFETY: SSE2 is part of x86-64. The first operand only where it is greater.
        unsafe { _mm_max_ps(b, a) }
    }

    #[inline(always)]
    pub fn exceeding(a: Lanes, b: Lanes) -> u32 {
        // SAFETY: SSE2 is part of x86-64.
        unsafe { _mm_movemask_ps(_mm_cmpgt_ps(a, b)) as u32 }
    }

    #[inline(always)]
    pub fn transpose([a, b, c, d]: [Lanes; 4]) -> [Lanes; 4] {
        // SAFETY: SSE2 is part of x86-64.
        unsafe {
            let (low, high) = (_mm_unpacklo_ps(a, b), _mm_unpackhi_ps(a, b));
            let (next_low, next_high) = (_mm_unpacklo_ps(c, d), _mm_unpackhi_ps(c, d));
            [
                _mm_movelh_ps(low, next_low),
                _mm_movehl_ps(next_low, low),
                _mm_movelh_ps(high, next_high),
                _mm_movehl_ps(next_high, high),
            ]
        }
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
    /// Of an array.
    #[inline(always)]
    pub fn new(array: [f32; 4]) -> Self {
        Self(target::from(array))
    }

    /// One number four times.
    #[inline(always)]
    pub fn splat(value: f32) -> Self {
        Self::new([value; 4])
    }

    /// As an array.
    #[inline(always)]
    pub fn array(self) -> [f32; 4] {
        target::array(self.0)
    }

    /// The four numbers of a list from a place on.
    ///
    /// # Panics
    /// Where the list ends before.
    #[inline(always)]
    pub fn load(list: &[f32], from: usize) -> Self {
        let four: &[f32; 4] = list[from..].first_chunk().expect("four numbers");
        Self::new(*four)
    }

    /// Writes them into a list from a place on.
    ///
    /// # Panics
    /// Where the list ends before.
    #[inline(always)]
    pub fn store(self, list: &mut [f32], from: usize) {
        let four: &mut [f32; 4] = list[from..].first_chunk_mut().expect("four numbers");
        *four = self.array();
    }

    /// The square roots.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self(target::sqrt(self.0))
    }

    /// The absolute values.
    #[inline(always)]
    pub fn abs(self) -> Self {
        Self(target::abs(self.0))
    }

    /// Lane by lane the other where it is greater, else its own: of another that is no number,
    /// its own.
    #[inline(always)]
    pub fn greater(self, other: Self) -> Self {
        Self(target::greater(self.0, other.0))
    }

    /// A bit for each lane in which it is greater than the other, the first lane's the lowest.
    #[inline(always)]
    pub fn exceeding(self, other: Self) -> u32 {
        target::exceeding(self.0, other.0)
    }

    /// Four rows of numbers as four columns.
    #[inline(always)]
    pub fn transpose(rows: [Self; 4]) -> [Self; 4] {
        let [a, b, c, d] = rows;
        let [a, b, c, d] = target::transpose([a.0, b.0, c.0, d.0]);
        [Self(a), Self(b), Self(c), Self(d)]
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

impl Div for Four {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(target::div(self.0, other.0))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lanes_compute_what_single_numbers_do() {
        let a = [2.0f32, -0.0, f32::NAN, 1e30];
        let b = [0.3f32, 3.0, 1.0, -7.0];
        let (fours, others) = (Four::new(a), Four::new(b));
        let pairs = |call: fn(f32, f32) -> f32| [0, 1, 2, 3].map(|i| call(a[i], b[i]).to_bits());
        let bits = |four: Four| four.array().map(f32::to_bits);
        assert_eq!(bits(fours / others)[..2], pairs(|a, b| a / b)[..2]);
        assert_eq!(bits(fours.sqrt())[3], a[3].sqrt().to_bits());
        assert_eq!(bits(others.abs()), b.map(|b| b.abs().to_bits()));
        // Of what is no number the other.
        assert_eq!(bits(others.greater(fours)), pairs(f32::max));
        assert_eq!(fours.exceeding(others), 0b1001);
    }

    #[test]
    fn rows_become_columns() {
        let row = |i: usize| Four::new([0, 1, 2, 3].map(|k| (4 * i + k) as f32));
        let columns = Four::transpose([0, 1, 2, 3].map(row)).map(Four::array);
        for (k, column) in columns.iter().enumerate() {
            assert_eq!(*column, [0, 1, 2, 3].map(|i| (4 * i + k) as f32));
        }
    }

    #[test]
    fn four_numbers_of_a_list_are_loaded_and_stored() {
        let mut list = [1.0f32, 2.0, 3.0, 4.0, 5.0, 6.0];
        (Four::load(&list, 1) * Four::splat(2.0)).store(&mut list, 2);
        assert_eq!(list, [1.0, 2.0, 4.0, 6.0, 8.0, 10.0]);
    }
}
