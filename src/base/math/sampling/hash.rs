//! POV-Ray's hash table of 4096 numbers, used by its noise, patterns and jitter.
//!
//! The table is the numbers 0 to 4095, shuffled by a linear congruential generator with seed 0 (measured: the first
//! values are 2291, 2574, 3654, 1557; the last is 3088).

/// The number of entries.
pub const SIZE: usize = 4096;

/// The shuffled numbers, twice in a row, so that the sum of an entry and a small number needs no wrapping.
pub static TABLE: [u16; 2 * SIZE] = table();

#[allow(
    clippy::cast_possible_truncation,
    reason = "the entries are below 4096"
)]
const fn table() -> [u16; 2 * SIZE] {
    let mut table = [0; 2 * SIZE];
    let mut i = 0;
    while i < SIZE {
        table[i] = i as u16;
        i += 1;
    }
    let mut state = 0;
    while i > 0 {
        i -= 1;
        state = next(state);
        let j = bits(state) as usize % SIZE;
        let swapped = table[i];
        table[i] = table[j];
        table[j] = swapped;
    }
    while i < SIZE {
        table[SIZE + i] = table[i];
        i += 1;
    }
    table
}

/// The next state of the generator.
#[must_use]
pub const fn next(state: u32) -> u32 {
    state.wrapping_mul(1_812_433_253).wrapping_add(12345)
}

/// The 15 random bits of a generator state.
#[must_use]
pub const fn bits(state: u32) -> u32 {
    (state >> 16) & 0x7fff
}

/// The entry at the lowest twelve bits of `number`.
#[must_use]
pub fn hashed(number: i32) -> i32 {
    i32::from(TABLE[(number & 0xFFF) as usize])
}

/// The hash of a cell of space, below 4096.
#[must_use]
pub fn hashed_cell(cell: [i64; 3]) -> u32 {
    let [x, y, z] = cell.map(wrapped);
    let row = usize::from(TABLE[x]) ^ y;
    u32::from(TABLE[usize::from(TABLE[row]) ^ z])
}

/// The lowest twelve bits of `number`.
#[must_use]
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "twelve bits are kept"
)]
pub const fn wrapped(number: i64) -> usize {
    number as usize & (SIZE - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_that_of_pov_ray() {
        let first: Vec<i32> = (0..8).map(hashed).collect();
        assert_eq!(first, [2291, 2574, 3654, 1557, 1196, 3388, 2637, 1820]);
        assert_eq!(hashed(4095), 3088);
        assert_eq!(hashed(-1), 3088);
        assert_eq!(TABLE[SIZE], 2291);
    }
}
