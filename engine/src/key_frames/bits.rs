//! Whole numbers that grow smaller along a run, in few bits: Rice's code, whose
//! parameter follows the numbers before.

/// Bits of the length of a run, without the noughts at its end.
const LENGTH: u32 = 17;

/// Bits of the parameter that a run begins with.
const PARAMETER: u32 = 5;

/// Ones that a number begins with at most; so many say that it follows plainly.
const ESCAPE: u32 = 24;
const PLAIN: u32 = 32;

/// The mean of the numbers before, in sixteenths, and the parameter that follows.
struct Mean(u32);

impl Mean {
    fn of(parameter: u32) -> Self {
        Self(16 << parameter)
    }

    fn parameter(&self) -> u32 {
        u32::BITS - (self.0 >> 5).leading_zeros()
    }

    fn take(&mut self, code: u32) {
        self.0 = self.0 - (self.0 >> 2) + (code << 2);
    }
}

/// Writes bits, the lowest first.
#[derive(Clone, Default)]
pub(super) struct BitWriter {
    bytes: Vec<u8>,
    used: usize,
}

impl BitWriter {
    /// Writes the lowest `count` bits of a number, at most 32.
    pub fn bits(&mut self, value: u32, count: u32) {
        for bit in 0..count {
            if self.used.is_multiple_of(8) {
                self.bytes.push(0);
            }
            self.bytes[self.used / 8] |= ((value >> bit & 1) as u8) << (self.used % 8);
            self.used += 1;
        }
    }

    /// Writes a run of at most 2^17 - 1 numbers, each less than 2^26 from 0.
    pub fn run(&mut self, values: &[i32]) {
        let length = values.iter().rposition(|v| *v != 0).map_or(0, |at| at + 1);
        self.bits(length as u32, LENGTH);
        let first = values.first().map_or(0, |first| zigzag(*first));
        let parameter = (u32::BITS - first.leading_zeros()).saturating_sub(1);
        self.bits(parameter, PARAMETER);
        let mut mean = Mean::of(parameter);
        for value in &values[..length] {
            let (code, k) = (zigzag(*value), mean.parameter());
            let ones = code >> k;
            if ones >= ESCAPE {
                self.bits(u32::MAX, ESCAPE);
                self.bits(code, PLAIN);
            } else {
                self.bits((1 << ones) - 1, ones + 1);
                self.bits(code, k);
            }
            mean.take(code);
        }
    }

    /// Bits so far.
    pub fn length(&self) -> usize {
        self.used
    }

    /// The bytes, the last filled up with zeros.
    pub fn finish(self) -> Vec<u8> {
        self.bytes
    }
}

/// Reads what [`BitWriter`] wrote; None where it ends early or cannot be.
pub(super) struct BitReader<'a> {
    bytes: &'a [u8],
    used: usize,
}

impl<'a> BitReader<'a> {
    /// A reader at the first bit.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, used: 0 }
    }

    /// Reads `count` bits, at most 32, as a number; None where there are fewer.
    pub fn bits(&mut self, count: u32) -> Option<u32> {
        let mut value = 0;
        for bit in 0..count {
            let byte = self.bytes.get(self.used / 8)?;
            value |= u32::from(byte >> (self.used % 8) & 1) << bit;
            self.used += 1;
        }
        Some(value)
    }

    /// Reads a run into `values`.
    pub fn run(&mut self, values: &mut [i32]) -> Option<()> {
        values.fill(0);
        let length = self.bits(LENGTH)? as usize;
        let parameter = self.bits(PARAMETER)?;
        if parameter > 26 {
            return None;
        }
        let mut mean = Mean::of(parameter);
        for value in values.get_mut(..length)? {
            let k = mean.parameter();
            let mut ones = 0;
            while ones < ESCAPE && self.bits(1)? == 1 {
                ones += 1;
            }
            let code = if ones == ESCAPE {
                self.bits(PLAIN)?
            } else {
                ones.checked_mul(1 << k)? | self.bits(k)?
            };
            if code >= 1 << 27 {
                return None;
            }
            mean.take(code);
            *value = (code >> 1) as i32 ^ -((code & 1) as i32);
        }
        Some(())
    }

    /// Whether no whole byte is left.
    pub fn is_at_end(&self) -> bool {
        self.used.div_ceil(8) == self.bytes.len()
    }
}

/// 0, -1, 1, -2 ... as 0, 1, 2, 3 ...
fn zigzag(value: i32) -> u32 {
    (value << 1 ^ value >> 31) as u32
}
