//! The random numbers of MT19937 (Matsumoto and Nishimura 1998) with its default seed. As in POV-Ray, the first 32768
//! are a table that random streams read cyclically.

use std::sync::LazyLock;

/// The number of entries of the table.
pub const SIZE: u32 = 1 << 15;

const SEED: u32 = 5489;
const WORDS: usize = 624;
const SHIFTED: usize = 397;

static TABLE: LazyLock<Vec<f64>> = LazyLock::new(|| Twister::new().take(SIZE as usize).collect());

/// Entry `index` modulo [`SIZE`], in `[0, 1)`.
#[must_use]
pub fn random(index: u32) -> f64 {
    TABLE[(index % SIZE) as usize]
}

/// The entries at three consecutive indices.
#[must_use]
pub fn random_triple(first: u32) -> [f64; 3] {
    match TABLE[(first % SIZE) as usize..].first_chunk() {
        Some(numbers) => *numbers,
        None => [0, 1, 2].map(|i| random(first + i)),
    }
}

/// The sequence of the generator, which continues beyond the table.
pub fn numbers() -> impl Iterator<Item = f64> {
    Twister::new()
}

/// The MT19937 generator.
struct Twister {
    state: Vec<u32>,
    next: usize,
}

impl Twister {
    fn new() -> Self {
        let mut state = vec![SEED];
        for i in 1u32..624 {
            let last = state[state.len() - 1];
            state.push(
                1_812_433_253u32
                    .wrapping_mul(last ^ (last >> 30))
                    .wrapping_add(i),
            );
        }
        Twister { state, next: WORDS }
    }

    fn twist(&mut self) {
        for i in 0..WORDS {
            let joined =
                (self.state[i] & 0x8000_0000) | (self.state[(i + 1) % WORDS] & 0x7fff_ffff);
            let odd = if joined & 1 == 1 { 0x9908_b0df } else { 0 };
            self.state[i] = self.state[(i + SHIFTED) % WORDS] ^ (joined >> 1) ^ odd;
        }
        self.next = 0;
    }
}

impl Iterator for Twister {
    type Item = f64;

    fn next(&mut self) -> Option<f64> {
        if self.next == WORDS {
            self.twist();
        }
        let mut y = self.state[self.next];
        self.next += 1;
        y ^= y >> 11;
        y ^= (y << 7) & 0x9d2c_5680;
        y ^= (y << 15) & 0xefc6_0000;
        y ^= y >> 18;
        Some(f64::from(y) / f64::from(1u32 << 16) / f64::from(1u32 << 16))
    }
}

/// A random stream: a cyclic walk through the table.
///
/// Each of POV-Ray's threads uses one stream for the whole render, so the numbers of a pixel depend on all pixels that
/// the thread rendered before. Images rendered in POV-Ray's order do the same here. Otherwise each sample has a stream
/// of its own.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stream {
    last: u32,
}

impl Stream {
    /// The stream of a sample at an image position.
    #[must_use]
    pub fn of_sample(x: f64, y: f64) -> Self {
        Stream {
            last: seed_of_sample(x, y) % SIZE,
        }
    }

    /// Leaves out the next numbers.
    #[allow(
        clippy::cast_possible_truncation,
        reason = "the position wraps around, as it does number by number"
    )]
    pub fn skip(&mut self, count: usize) {
        self.last = self.last.wrapping_add(count as u32);
    }

    /// The next number.
    pub fn next_number(&mut self) -> f64 {
        self.last = self.last.wrapping_add(1);
        random(self.last)
    }
}

/// A random seed for a sample at an image position; 0 for the upper left pixel.
#[must_use]
#[allow(
    clippy::cast_possible_truncation,
    reason = "the upper half of the mixed bits is taken"
)]
pub fn seed_of_sample(x: f64, y: f64) -> u32 {
    // The finalizer of MurmurHash3 (Appleby 2011), which maps 0 to 0.
    let mut bits = (x + 0.0).to_bits() ^ (y + 0.0).to_bits().rotate_left(21);
    bits = (bits ^ (bits >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
    bits = (bits ^ (bits >> 33)).wrapping_mul(0xc4ce_b9fe_1a85_ec53);
    (bits >> 32) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_that_of_pov_ray() {
        let expected = [
            0.814_723_691_9,
            0.135_477_004_1,
            0.905_791_934_1,
            0.835_008_589_8,
        ];
        for (index, expected) in (0..).zip(expected) {
            assert!((random(index) - expected).abs() < 1e-9);
        }
        assert!((random(32_767) - 0.752_209_920_7).abs() < 1e-9);
        assert_eq!(random(SIZE), random(0));
        assert_eq!(numbers().nth(1), Some(random(1)));
    }

    #[test]
    fn the_stream_of_the_corner_begins_with_the_second_number() {
        assert_eq!(Stream::of_sample(0.0, -0.0).next_number(), random(1));
        assert_ne!(seed_of_sample(1.0, 2.0), seed_of_sample(2.0, 1.0));
    }
}
