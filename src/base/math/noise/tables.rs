//! The random table of POV-Ray's noise, computed at compile time.

/// The number of entries of the random table. It is read up to eleven entries beyond the index from a hash.
pub(super) const RANDOMS: usize = 267;
/// Significant decimal digits of the entries.
const DIGITS: u32 = 6;

/// Random numbers from -1 to 1, rounded to six significant digits.
pub(super) static RANDOM: [f64; RANDOMS] = randoms();

const fn randoms() -> [f64; RANDOMS] {
    let mut table = [0.0; RANDOMS];
    let mut i = 0;
    while i < RANDOMS {
        table[i] = rounded(2 * crc(i) as i64 - 65535, 65535);
        i += 1;
    }
    table
}

/// The CRC-16 (reflected polynomial 0xA001) of the double `0.12345 · index` three times in a row, in big-endian bytes.
const fn crc(index: usize) -> u16 {
    let bytes = (0.12345 * index as f64).to_bits().to_be_bytes();
    let mut crc: u16 = 0;
    let mut i = 0;
    while i < 3 * bytes.len() {
        crc ^= bytes[i % bytes.len()] as u16;
        let mut bit = 0;
        while bit < 8 {
            crc = if crc & 1 == 1 {
                (crc >> 1) ^ 0xa001
            } else {
                crc >> 1
            };
            bit += 1;
        }
        i += 1;
    }
    crc
}

/// A quotient between -1 and 1 to six significant digits, as `%.6g` prints it.
const fn rounded(numerator: i64, denominator: i64) -> f64 {
    let size = numerator.abs();
    if size == 0 {
        return 0.0;
    }
    let mut power = 1;
    let mut decimals = 0;
    while size * power < denominator {
        power *= 10;
        decimals += 1;
    }
    // The first significant digit is decimal number `decimals`; five more follow.
    if decimals > 0 {
        power *= 10_i64.pow(DIGITS - 1);
    }
    let digits = (2 * size * power + denominator) / (2 * denominator);
    let value = digits as f64 / power as f64;
    if numerator < 0 { -value } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_random_numbers_are_those_of_pov_ray() {
        // docs/povray-shapes.md, section 14.
        let first = [
            -1.0,
            0.604_974,
            -0.937_102,
            0.414_115,
            0.576_226,
            -0.016_159_3,
            0.432_334,
            0.103_685,
        ];
        assert_eq!(RANDOM[..8], first);
        assert_eq!((RANDOM[100], RANDOM[266]), (0.176_349, 0.566_186));
    }
}
