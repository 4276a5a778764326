//! Decoding the DCT coefficients of a block. Any input bits terminate, and no write goes outside the block.

use super::bits::BitReader;
use super::huffman::HuffmanDecoder;
use super::tables::ZIGZAG;

/// DCT coefficients in row-major order.
pub(super) type Block = [i16; 64];

#[allow(
    clippy::cast_possible_truncation,
    reason = "what is beyond 16 bits is lost in libjpeg too"
)]
fn truncate_to_i16(value: i32) -> i16 {
    value as i16
}

/// Decodes the DC coefficient of a block without its `approx_low` lowest bits (T.81, F.2.2.1). `dc_predictor` is the DC
/// coefficient of the previous block and is updated.
pub(super) fn decode_dc(
    bits: &mut BitReader<'_, '_>,
    huffman: &HuffmanDecoder,
    dc_predictor: &mut i32,
    approx_low: u8,
    block: &mut Block,
) {
    let length = huffman.symbol(bits);
    *dc_predictor = dc_predictor.wrapping_add(bits.take_signed(length.into()));
    block[0] = truncate_to_i16(*dc_predictor << approx_low);
}

/// Decodes the AC coefficients of a block (T.81, F.2.2.2).
pub(super) fn decode_ac(bits: &mut BitReader<'_, '_>, huffman: &HuffmanDecoder, block: &mut Block) {
    let mut index = 1;
    while index < 64 {
        let symbol = huffman.symbol(bits);
        let (zero_run, length) = (usize::from(symbol >> 4), symbol & 15);
        if length == 0 {
            if zero_run != 15 {
                break;
            }
            index += 16;
        } else {
            index += zero_run;
            block[usize::from(ZIGZAG[index])] = truncate_to_i16(bits.take_signed(length.into()));
            index += 1;
        }
    }
}

/// Decodes a band of AC coefficients (T.81, G.1.2.2). Returns the end-of-band run: the number of following blocks
/// without coefficients in the band.
pub(super) fn decode_ac_band(
    bits: &mut BitReader<'_, '_>,
    huffman: &HuffmanDecoder,
    band: [u8; 2],
    approx_low: u8,
    block: &mut Block,
) -> u32 {
    let [mut index, last] = band.map(usize::from);
    while index <= last {
        let symbol = huffman.symbol(bits);
        let (zero_run, length) = (symbol >> 4, symbol & 15);
        if length > 0 {
            index += usize::from(zero_run);
            let value = bits.take_signed(length.into());
            block[usize::from(ZIGZAG[index])] = truncate_to_i16(value << approx_low);
            index += 1;
        } else if zero_run == 15 {
            index += 16;
        } else {
            return read_eob_run(bits, zero_run) - 1;
        }
    }
    0
}

/// Reads the length of an end-of-band run, which includes the current block.
fn read_eob_run(bits: &mut BitReader<'_, '_>, length: u8) -> u32 {
    let extra_bits = bits.take(length.into());
    (1 << length) + extra_bits.unsigned_abs()
}

/// Refines a band of AC coefficients by one bit (T.81, G.1.2.3). While `eob_run` blocks, including this one, remain in
/// the end-of-band run, no coefficient becomes nonzero. Returns the rest of the run.
pub(super) fn refine_ac_band(
    bits: &mut BitReader<'_, '_>,
    huffman: &HuffmanDecoder,
    band: [u8; 2],
    approx_low: u8,
    mut eob_run: u32,
    block: &mut Block,
) -> u32 {
    let [mut index, last] = band.map(usize::from);
    let bit = 1_i16 << approx_low;
    if eob_run == 0 {
        while index <= last {
            let symbol = huffman.symbol(bits);
            let (mut zero_run, length) = (symbol >> 4, symbol & 15);
            let mut new_value = 0;
            if length > 0 {
                new_value = if bits.take(1) == 1 { bit } else { -bit };
            } else if zero_run < 15 {
                eob_run = read_eob_run(bits, zero_run);
                break;
            }
            while index <= last {
                let coefficient = &mut block[usize::from(ZIGZAG[index])];
                if *coefficient != 0 {
                    refine(bits, bit, coefficient);
                } else if zero_run == 0 {
                    break;
                } else {
                    zero_run -= 1;
                }
                index += 1;
            }
            if new_value != 0 {
                block[usize::from(ZIGZAG[index])] = new_value;
            }
            index += 1;
        }
    }
    if eob_run == 0 {
        return 0;
    }
    while index <= last {
        let coefficient = &mut block[usize::from(ZIGZAG[index])];
        if *coefficient != 0 {
            refine(bits, bit, coefficient);
        }
        index += 1;
    }
    eob_run - 1
}

/// Refines a nonzero coefficient by one bit.
fn refine(bits: &mut BitReader<'_, '_>, bit: i16, coefficient: &mut i16) {
    if bits.take(1) == 1 && *coefficient & bit == 0 {
        let step = if *coefficient >= 0 { bit } else { -bit };
        *coefficient = coefficient.wrapping_add(step);
    }
}
