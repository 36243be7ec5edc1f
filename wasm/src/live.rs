//! Handles of what is alive: the address of a boxed value, by which JavaScript
//! knows it. A number that is no such address, or not any more, is rejected.

use std::sync::{Mutex, PoisonError};

/// The values of one kind that are alive, by their addresses.
pub struct Live<T> {
    addresses: Mutex<Vec<usize>>,
    kind: core::marker::PhantomData<fn() -> T>,
}

impl<T> Live<T> {
    /// None yet.
    pub const fn new() -> Live<T> {
        Live {
            addresses: Mutex::new(Vec::new()),
            kind: core::marker::PhantomData,
        }
    }

    fn with_addresses<R>(&self, act: impl FnOnce(&mut Vec<usize>) -> R) -> R {
        act(&mut self
            .addresses
            .lock()
            .unwrap_or_else(PoisonError::into_inner))
    }

    /// Keeps a value alive. Returns its handle.
    pub fn keep(&self, value: T) -> *mut T {
        let handle = Box::into_raw(Box::new(value));
        self.with_addresses(|all| all.push(handle as usize));
        handle
    }

    /// Takes a value out, which ends its handle; None where there is no such handle.
    ///
    /// # Safety
    /// No reference of [`get`](Self::get) to it is in use.
    pub unsafe fn take(&self, handle: *mut T) -> Option<T> {
        let is_alive = self.with_addresses(|all| {
            let at = all.iter().position(|known| *known == handle as usize);
            at.map(|at| all.swap_remove(at)).is_some()
        });
        // SAFETY: it was boxed by `keep`, and only now its address is forgotten.
        is_alive.then(|| unsafe { *Box::from_raw(handle) })
    }

    /// The value of a handle; None where there is no such handle.
    ///
    /// # Safety
    /// No other reference to it is in use: all calls with one handle come from one thread.
    pub unsafe fn get<'a>(&self, handle: *mut T) -> Option<&'a mut T> {
        let is_alive = self.with_addresses(|all| all.contains(&(handle as usize)));
        // SAFETY: it was boxed by `keep` and is not freed while its address is known.
        is_alive.then(|| unsafe { &mut *handle })
    }
}

/// What an exported function returns for a handle that is none: 0.
pub trait Nothing {
    /// It.
    const NOTHING: Self;
}

macro_rules! nothing {
    ($($type:ty: $value:expr),*) => {$(
        impl Nothing for $type {
            const NOTHING: Self = $value;
        }
    )*};
}

nothing!((): (), u32: 0, u64: 0, usize: 0, f32: 0.0, f64: 0.0);

impl<T> Nothing for *const T {
    const NOTHING: Self = core::ptr::null();
}

impl<T> Nothing for *mut T {
    const NOTHING: Self = core::ptr::null_mut();
}

/// Declares exported functions on what a [`Live`] keeps, each a call to the engine.
#[cfg(any(feature = "creases", test))]
macro_rules! live_functions {
    ($live:ident: $kind:ty; $($(#[$doc:meta])* fn $name:ident($own:ident $(, $arg:ident: $type:ty)*) $(-> $result:ty)? $body:block)*) => {$(
        $(#[$doc])*
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name($own: *mut $kind $(, $arg: $type)*) $(-> $result)? {
            // SAFETY: from one thread by the crate's contract, so that no other call uses it.
            let Some($own) = (unsafe { $live.get($own) }) else {
                return $crate::live::Nothing::NOTHING;
            };
            $body
        }
    )*};
}
#[cfg(any(feature = "creases", test))]
pub(crate) use live_functions;
