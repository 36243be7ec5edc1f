//! Single or double precision: what the interactive sheet (f32) and the offline
//! shell (f64) share is written once, over this.

use crate::lanes::{Four, FourDoubles, Lanes};
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A floating-point number. Only operations that IEEE 754 rounds exactly, so
/// that every target computes the same bits.
pub trait Real:
    Copy
    + Default
    + PartialOrd
    + core::fmt::Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
{
    /// Four of them, worked on at once.
    type Four: Lanes<Self>;
    /// Zero.
    const ZERO: Self;
    /// One.
    const ONE: Self;
    /// The nearest number to a double.
    fn of(value: f64) -> Self;
    /// As a double, exactly.
    #[cfg(test)]
    fn to_f64(self) -> f64;
    /// Absolute value.
    #[cfg(test)]
    fn abs(self) -> Self;
    /// The smaller of two.
    fn min(self, other: Self) -> Self;
    /// The larger of two.
    fn max(self, other: Self) -> Self;
    /// Whether it is neither infinite nor no number.
    #[cfg(test)]
    fn is_finite(self) -> bool;
}

macro_rules! real {
    ($type:ty, $four:ty) => {
        impl Real for $type {
            type Four = $four;
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            #[inline(always)]
            fn of(value: f64) -> Self {
                value as $type
            }
            #[cfg(test)]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            #[cfg(test)]
            fn abs(self) -> Self {
                <$type>::abs(self)
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                <$type>::min(self, other)
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                <$type>::max(self, other)
            }
            #[cfg(test)]
            fn is_finite(self) -> bool {
                <$type>::is_finite(self)
            }
        }
    };
}

real!(f32, Four);
real!(f64, FourDoubles);

/// Returns `value`, or the bound that it lies beyond: `low` at the least, `high` at the most. As
/// `clamp`, whose check that the bounds are in order prints them: what prints numbers is 20 kB of WASM.
/// To be used where the bounds are not constants.
#[inline(always)]
pub fn bounded<T: PartialOrd>(value: T, low: T, high: T) -> T {
    if value < low {
        low
    } else if value > high {
        high
    } else {
        value
    }
}
