//! A hash of exact bits, for golden tests.

/// FNV-1a, 64 bits (Fowler, Noll, Vo), over the little-endian bytes of floats:
/// two runs have the same hash if and only if (but for chance) they have the
/// same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BitHash(u64);

impl Default for BitHash {
    fn default() -> Self {
        Self::new()
    }
}

impl BitHash {
    /// The hash of nothing.
    pub const fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    /// Takes in bytes.
    pub fn bytes(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    /// Takes in the bits of floats.
    pub fn floats(&mut self, values: &[f32]) {
        for value in values {
            self.bytes(&value.to_bits().to_le_bytes());
        }
    }

    /// The hash so far.
    pub const fn value(self) -> u64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Test vectors of the FNV reference: "" and "foobar".
    #[test]
    fn reference_vectors() {
        let mut hash = BitHash::new();
        assert_eq!(hash.value(), 0xcbf2_9ce4_8422_2325);
        hash.bytes(b"foobar");
        assert_eq!(hash.value(), 0x8594_4171_f739_67e8);
    }

    #[test]
    fn zero_and_minus_zero_differ() {
        let hash = |value: f32| {
            let mut hash = BitHash::new();
            hash.floats(&[value]);
            hash.value()
        };
        assert_ne!(hash(0.0), hash(-0.0));
    }
}
