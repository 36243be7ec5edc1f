//! By how much what is drawn of a loose sheet differs from the sheet, less from tick to tick.

/// By how much what is drawn differs from the sheet, less from tick to tick.
#[derive(Clone, Debug, Default)]
pub(super) struct DrawnOffset {
    /// At first, x, y, z of each point, metres.
    pub by: Vec<f32>,
    /// Ticks for which it does in all, and for how many more.
    ticks: u32,
    left: u32,
}

impl DrawnOffset {
    /// What is drawn at `shown` by a sheet that is at `own`, for so many ticks.
    pub fn new(shown: &[f32], own: &[f32], ticks: u32) -> Self {
        let by = shown.iter().zip(own).map(|(shown, own)| shown - own);
        Self {
            by: by.collect(),
            ticks,
            left: ticks,
        }
    }

    /// A tick has passed.
    pub fn tick(&mut self) {
        self.left = self.left.saturating_sub(1);
    }

    /// Moves drawn points of the sheet to where they are drawn.
    pub fn add_to(&self, positions: &mut [f32]) {
        if self.left > 0 {
            let part = self.left as f32 / self.ticks as f32;
            for (x, by) in positions.iter_mut().zip(&self.by) {
                *x += part * by;
            }
        }
    }

    /// Parts it into that of the first `count` coordinates and that of the others.
    pub fn parted(mut self, count: usize) -> [Self; 2] {
        let head = self.by.split_off(count.min(self.by.len()));
        let head = Self { by: head, ..self };
        [self, head]
    }
}
