//! The coefficients of a block, from Huffman codes. Whatever the bits are, all comes to an end, and nothing is written
//! outside of the block.

use super::bits::Bits;
use super::huffman::Huffman;
use super::tables::ZIGZAG;

/// Coefficients, row by row.
pub(super) type Block = [i16; 64];

#[allow(
    clippy::cast_possible_truncation,
    reason = "what is beyond 16 bits is lost in libjpeg too"
)]
fn short(value: i32) -> i16 {
    value as i16
}

/// Reads the first coefficient of a block without its `low` lowest bits (T.81, F.2.2.1); `before` is that of the block
/// before.
pub(super) fn first(
    bits: &mut Bits<'_, '_>,
    codes: &Huffman,
    before: &mut i32,
    low: u8,
    block: &mut Block,
) {
    let length = codes.symbol(bits);
    *before = before.wrapping_add(bits.take_signed(length.into()));
    block[0] = short(*before << low);
}

/// Reads the other coefficients of a block (T.81, F.2.2.2).
pub(super) fn others(bits: &mut Bits<'_, '_>, codes: &Huffman, block: &mut Block) {
    let mut at = 1;
    while at < 64 {
        let symbol = codes.symbol(bits);
        let (zeros, length) = (usize::from(symbol >> 4), symbol & 15);
        if length == 0 {
            if zeros != 15 {
                break;
            }
            at += 16;
        } else {
            at += zeros;
            block[usize::from(ZIGZAG[at])] = short(bits.take_signed(length.into()));
            at += 1;
        }
    }
}

/// Reads a band of a block (T.81, G.1.2.2), and gives the number of blocks behind it that have none.
pub(super) fn band(
    bits: &mut Bits<'_, '_>,
    codes: &Huffman,
    (band, low): ([u8; 2], u8),
    block: &mut Block,
) -> u32 {
    let [mut at, end] = band.map(usize::from);
    while at <= end {
        let symbol = codes.symbol(bits);
        let (zeros, length) = (symbol >> 4, symbol & 15);
        if length > 0 {
            at += usize::from(zeros);
            let value = bits.take_signed(length.into());
            block[usize::from(ZIGZAG[at])] = short(value << low);
            at += 1;
        } else if zeros == 15 {
            at += 16;
        } else {
            return empty_blocks(bits, zeros) - 1;
        }
    }
    0
}

/// The number of blocks from this one on that have nothing more.
fn empty_blocks(bits: &mut Bits<'_, '_>, length: u8) -> u32 {
    let more = bits.take(length.into());
    (1 << length) + more.unsigned_abs()
}

/// Reads one more bit of a band of a block (T.81, G.1.2.3); `empty` blocks from this one on have no new coefficients.
pub(super) fn band_bit(
    bits: &mut Bits<'_, '_>,
    codes: &Huffman,
    (band, low): ([u8; 2], u8),
    mut empty: u32,
    block: &mut Block,
) -> u32 {
    let [mut at, end] = band.map(usize::from);
    let bit = 1_i16 << low;
    if empty == 0 {
        while at <= end {
            let symbol = codes.symbol(bits);
            let (mut zeros, length) = (symbol >> 4, symbol & 15);
            let mut new = 0;
            if length > 0 {
                new = if bits.take(1) == 1 { bit } else { -bit };
            } else if zeros < 15 {
                empty = empty_blocks(bits, zeros);
                break;
            }
            while at <= end {
                let coefficient = &mut block[usize::from(ZIGZAG[at])];
                if *coefficient != 0 {
                    refine(bits, bit, coefficient);
                } else if zeros == 0 {
                    break;
                } else {
                    zeros -= 1;
                }
                at += 1;
            }
            if new != 0 {
                block[usize::from(ZIGZAG[at])] = new;
            }
            at += 1;
        }
    }
    if empty == 0 {
        return 0;
    }
    while at <= end {
        let coefficient = &mut block[usize::from(ZIGZAG[at])];
        if *coefficient != 0 {
            refine(bits, bit, coefficient);
        }
        at += 1;
    }
    empty - 1
}

/// Reads one more bit of a coefficient.
fn refine(bits: &mut Bits<'_, '_>, bit: i16, coefficient: &mut i16) {
    if bits.take(1) == 1 && *coefficient & bit == 0 {
        let more = if *coefficient >= 0 { bit } else { -bit };
        *coefficient = coefficient.wrapping_add(more);
    }
}
