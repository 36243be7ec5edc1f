//! Random numbers for tests: small, seeded, and printed when a test fails.

/// SplitMix64 (Steele, Lea and Flood 2014).
pub(crate) struct Random(u64);

impl Random {
    /// Numbers of a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Between `low` and `high`.
    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * (self.next() >> 40) as f32 / (1u64 << 24) as f32
    }

    /// Below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
}

/// Runs a property for eight seeds, or as many as `TURNLEAF_SEEDS` says, or for the one in
/// `TURNLEAF_SEED`. The seed is printed, which is seen when the property does not hold.
pub(crate) fn for_seeds(property: impl Fn(&mut Random)) {
    let number = |name: &str| {
        let text = std::env::var(name).ok()?;
        Some(
            text.parse()
                .unwrap_or_else(|_| panic!("{name} is a number")),
        )
    };
    let seeds = match number("TURNLEAF_SEED") {
        Some(seed) => seed..seed + 1,
        None => 0..number("TURNLEAF_SEEDS").unwrap_or(8),
    };
    for seed in seeds {
        println!("TURNLEAF_SEED={seed}");
        property(&mut Random(seed));
    }
}
