//! What only creased paper has.

/// A value that only creased paper has. Without the feature `creases` there is never one: the
/// compiler then leaves out whatever would be done with it, and the file that a page loads for a
/// book of whole leaves is a third of the other. Beside this only the steps of a sheet's solver ask
/// for the feature.
#[derive(Clone, Copy, Debug)]
pub struct CreasedOnly<T>(Option<T>);

impl<T> CreasedOnly<T> {
    /// Of paper that is not creased.
    pub const NONE: Self = Self(None);

    /// Of paper that is creased now; dropped where none can be.
    pub fn some(value: T) -> Self {
        if cfg!(feature = "creases") {
            Self(Some(value))
        } else {
            Self::NONE
        }
    }

    /// The value, if there is one.
    pub fn as_ref(&self) -> Option<&T> {
        if cfg!(feature = "creases") {
            self.0.as_ref()
        } else {
            None
        }
    }

    /// The same, to be changed.
    pub fn as_mut(&mut self) -> Option<&mut T> {
        if cfg!(feature = "creases") {
            self.0.as_mut()
        } else {
            None
        }
    }

    /// Takes the value, if there is one, and leaves none.
    pub fn take(&mut self) -> Option<T> {
        if cfg!(feature = "creases") {
            self.0.take()
        } else {
            None
        }
    }

    /// Whether there is none.
    pub fn is_none(&self) -> bool {
        self.as_ref().is_none()
    }
}

impl<T> Default for CreasedOnly<T> {
    fn default() -> Self {
        Self::NONE
    }
}

impl<T> From<Option<T>> for CreasedOnly<T> {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::NONE, Self::some)
    }
}
