//! Memory in blocks of powers of two: each size has a list of those that were
//! freed, and what none has comes from the end of memory. A book allocates its
//! leaves when it is made and for a few more while they fly, always of the same
//! sizes, so this wastes less than half and is a tenth of the standard one.

use core::alloc::{GlobalAlloc, Layout};
use core::arch::wasm32::{memory_grow, memory_size};
use core::cell::UnsafeCell;
use core::ptr::null_mut;

/// Bytes of the smallest block, and what every block is aligned to.
const LEAST: usize = 16;

/// Bytes of WASM's unit of memory.
const PAGE: usize = 65536;

/// By how many units memory grows at least.
const GROWTH: usize = 16;

struct State {
    /// For each power of two the first block that is free; it holds the address of the next.
    free: [*mut u8; usize::BITS as usize],
    /// What was never given out yet, and where memory ends.
    next: usize,
    end: usize,
}

/// The allocator.
pub struct Blocks(UnsafeCell<State>);

// SAFETY: the module has one thread; it is built without atomics.
unsafe impl Sync for Blocks {}

impl Blocks {
    /// One that has given out nothing.
    pub const fn new() -> Blocks {
        Blocks(UnsafeCell::new(State {
            free: [null_mut(); usize::BITS as usize],
            next: 0,
            end: 0,
        }))
    }
}

/// The power of two that is the size of the block for `bytes`; beyond half of
/// all memory there is none.
fn power(bytes: usize) -> usize {
    (usize::BITS - (bytes.max(LEAST) - 1).leading_zeros()) as usize
}

impl State {
    #[inline(never)]
    fn take(&mut self, bytes: usize) -> *mut u8 {
        let power = power(bytes);
        if power + 1 >= usize::BITS as usize {
            return null_mut();
        }
        let block = self.free[power];
        if !block.is_null() {
            // SAFETY: a free block holds the address of the next one.
            self.free[power] = unsafe { *block.cast() };
            return block;
        }
        let size = 1 << power;
        if self.end - self.next < size {
            let pages = size.div_ceil(PAGE).max(GROWTH);
            let end = memory_size(0) * PAGE;
            if memory_grow(0, pages) == usize::MAX {
                return null_mut();
            }
            if end != self.end {
                self.next = end;
            }
            self.end = end + pages * PAGE;
        }
        let block = self.next;
        self.next += size;
        block as *mut u8
    }

    /// Kept in one place: what a book drops is many dozen blocks, each where it is dropped.
    #[inline(never)]
    unsafe fn give(&mut self, block: *mut u8, bytes: usize) {
        let first = &mut self.free[power(bytes)];
        // SAFETY: the block is not used any more and is long enough for an address.
        unsafe { *block.cast() = *first };
        *first = block;
    }
}

// SAFETY: blocks never overlap, are at least as long as requested and aligned to
// LEAST, and more is rejected.
unsafe impl GlobalAlloc for Blocks {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if layout.align() > LEAST {
            return null_mut();
        }
        // SAFETY: one thread, and nothing in `take` allocates.
        unsafe { (*self.0.get()).take(layout.size()) }
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        // SAFETY: as above; and the block was taken with this size.
        unsafe { (*self.0.get()).give(block, layout.size()) }
    }

    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        if power(size) == power(layout.size()) {
            return block;
        }
        // SAFETY: the new block is as long as the shorter of both, by the caller's promise.
        unsafe {
            let to = self.alloc(Layout::from_size_align_unchecked(size, layout.align()));
            if !to.is_null() {
                block.copy_to_nonoverlapping(to, size.min(layout.size()));
                self.dealloc(block, layout);
            }
            to
        }
    }
}
