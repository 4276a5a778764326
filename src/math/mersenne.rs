//! The Mersenne Twister MT19937 (Matsumoto and Nishimura 1998) with its usual seed: the numbers from which POV-Ray
//! scatters points and jitters rays.

use std::sync::LazyLock;

/// How many numbers are kept.
pub const COUNT: usize = 32768;

/// The seed of the authors' program.
const SEED: u32 = 5489;
/// Words of the state.
const WORDS: usize = 624;
/// The distance of the words that are mixed.
const MIDDLE: usize = 397;

/// The number of this index, repeated after [`COUNT`], in `[0, 1)`.
#[must_use]
pub fn uniform(index: usize) -> f64 {
    table()[index % COUNT]
}

/// The first numbers of the stream, each in `[0, 1)`.
#[must_use]
pub fn table() -> &'static [f64; COUNT] {
    static TABLE: LazyLock<Box<[f64; COUNT]>> = LazyLock::new(|| {
        let mut state = seeded();
        let mut table = Box::new([0.0; COUNT]);
        for numbers in table.chunks_mut(WORDS) {
            advance(&mut state);
            for (number, &word) in numbers.iter_mut().zip(&state) {
                *number = f64::from(tempered(word)) / 4_294_967_296.0;
            }
        }
        table
    });
    &TABLE
}

fn seeded() -> [u32; WORDS] {
    let mut state = [SEED; WORDS];
    for (i, number) in (1..WORDS).zip(1u32..) {
        let last = state[i - 1];
        state[i] = (last ^ (last >> 30))
            .wrapping_mul(1_812_433_253)
            .wrapping_add(number);
    }
    state
}

fn advance(state: &mut [u32; WORDS]) {
    for i in 0..WORDS {
        let mixed = (state[i] & 0x8000_0000) | (state[(i + 1) % WORDS] & 0x7fff_ffff);
        let twist = if mixed & 1 == 1 { 0x9908_b0df } else { 0 };
        state[i] = state[(i + MIDDLE) % WORDS] ^ (mixed >> 1) ^ twist;
    }
}

fn tempered(word: u32) -> u32 {
    let word = word ^ (word >> 11);
    let word = word ^ ((word << 7) & 0x9d2c_5680);
    let word = word ^ ((word << 15) & 0xefc6_0000);
    word ^ (word >> 18)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_numbers_are_those_of_pov_ray() {
        // Facts, appendix A.
        let expected = [
            0.814_723_691_9,
            0.135_477_004_1,
            0.905_791_934_1,
            0.835_008_589_8,
        ];
        for (number, expected) in table().iter().zip(expected) {
            assert!((number - expected).abs() < 1e-10);
        }
        assert!((table()[COUNT - 1] - 0.752_209_920_7).abs() < 1e-10);
        assert_eq!(uniform(COUNT), table()[0]);
    }
}
