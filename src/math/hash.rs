//! POV-Ray's hash table of 4096 numbers, which its noise, patterns and jitter draw from.
//!
//! The table is a shuffle of 0 to 4095 by a linear congruential generator that starts at 0 (measured: the first
//! values are 2291, 2574, 3654, 1557; the last is 3088).

use std::sync::LazyLock;

/// How many numbers there are.
const SIZE: usize = 4096;

static TABLE: LazyLock<Box<[u16; SIZE]>> = LazyLock::new(|| {
    let mut table = Box::new([0u16; SIZE]);
    for (number, entry) in (0u16..).zip(table.iter_mut()) {
        *entry = number;
    }
    let mut state = 0u32;
    for i in (0..SIZE).rev() {
        state = next(state);
        table.swap(i, (state >> 16 & 0x7FFF) as usize % SIZE);
    }
    table
});

/// One step of the generator.
#[must_use]
pub fn next(state: u32) -> u32 {
    state.wrapping_mul(1_812_433_253).wrapping_add(12345)
}

/// The entry for a number; only its lowest twelve bits count.
#[must_use]
pub fn hashed(number: i32) -> i32 {
    i32::from(TABLE[(number & 0xFFF) as usize])
}

#[cfg(test)]
mod tests {
    use super::hashed;

    #[test]
    fn the_table_is_that_of_pov_ray() {
        let first: Vec<i32> = (0..8).map(hashed).collect();
        assert_eq!(first, [2291, 2574, 3654, 1557, 1196, 3388, 2637, 1820]);
        assert_eq!(hashed(4095), 3088);
        assert_eq!(hashed(-1), 3088);
    }
}
