//! The work that one picture may take.

/// Work done for a picture and the most that it may take, in nanoseconds. It is counted by
/// what is looked at, not by a clock: the same leaves are drawn on every machine.
pub struct Work {
    done: u32,
    most: u32,
}

impl Work {
    /// At most so much work, nanoseconds.
    pub fn new(most: u32) -> Work {
        Work { done: 0, most }
    }

    /// Counts work that is done, nanoseconds.
    pub fn spend(&mut self, work: u32) {
        self.done = self.done.saturating_add(work);
    }

    /// Allows so much more than is done, nanoseconds.
    pub fn allow(&mut self, more: u32) {
        self.most = self.done.saturating_add(more);
    }

    /// Whether none is left.
    pub fn is_spent(&self) -> bool {
        self.done >= self.most
    }

    /// Work done, nanoseconds.
    pub fn done(&self) -> u32 {
        self.done
    }
}
