//! The engine's face for the browser: `extern "C"` functions over numbers and
//! flat arrays in linear memory, no bindings generator.
//!
//! Features choose what is exported: books, loose leaves, scenes for benches. What
//! a function makes is a handle: the address of a box, 0 where it could not be made.
//!
//! Every function takes every number. With a handle that was not returned, or that
//! was freed, it does nothing and returns 0. A figure that is not finite or beyond
//! what the function says is rejected, which changes nothing, or counts as the
//! nearest that is not, as the function says. Whole numbers are unsigned: -1 is
//! 4294967295.
//!
//! # Safety
//! All calls with one handle come from one thread.

#![allow(clippy::missing_safety_doc, reason = "said once, above")]

#[cfg(target_arch = "wasm32")]
mod allocator;
#[cfg(any(feature = "books", test))]
mod books;
#[cfg(any(feature = "creases", test))]
mod creases;
#[cfg(any(feature = "books", feature = "models", test))]
mod drawn;
#[cfg(any(feature = "creases", test))]
mod fold_outs;
mod live;
#[cfg(any(feature = "models", test))]
mod models;
#[cfg(test)]
mod tests;
#[cfg(any(feature = "creases", test))]
mod torn_leaves;
#[cfg(any(feature = "trials", test))]
mod trials;

use turnleaf_engine::Side;

#[cfg(target_arch = "wasm32")]
#[global_allocator]
static ALLOCATOR: allocator::Blocks = allocator::Blocks::new();

/// The right for 0, the left for every other number.
fn side(number: u32) -> Side {
    if number == 0 { Side::Right } else { Side::Left }
}
