//! Decoding of Huffman codes.

use super::super::decode::Fault;
use super::bits::Bits;
use super::tables::Codes;

/// Codes of up to so many bits are looked up.
const LOOKED_UP: u32 = 9;

/// A Huffman code ready to decode.
#[derive(Debug)]
pub(super) struct Huffman {
    /// Length and symbol by the first bits; length 0 for longer codes.
    short: Box<[(u8, u8); 1 << LOOKED_UP]>,
    /// For each length the first number of 17 bits behind its codes, and what the number of a symbol is above its code.
    ends: [u32; 17],
    offsets: [i32; 17],
    symbols: Vec<u8>,
}

/// True if a code is for the first coefficients of blocks or for the others.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum For {
    First,
    Others,
}

impl Huffman {
    /// The code, if it is one; a length of more than 15 bits is none for a first coefficient.
    #[allow(
        clippy::cast_possible_wrap,
        reason = "codes have at most 16 bits, and there are at most 256 symbols"
    )]
    pub(super) fn new(codes: Option<&Codes>, purpose: For) -> Result<Self, Fault> {
        let codes = codes.ok_or("a Huffman table is missing")?;
        if purpose == For::First && codes.symbols.iter().any(|symbol| *symbol > 15) {
            return Err("a Huffman table is wrong".to_owned());
        }
        let mut huffman = Huffman {
            short: Box::new([(0, 0); 1 << LOOKED_UP]),
            ends: [0; 17],
            offsets: [0; 17],
            symbols: codes.symbols.clone(),
        };
        let mut code = 0_u32;
        let mut symbols = (0_i32..).zip(codes.symbols.iter());
        for (bits, count) in (1_u32..).zip(codes.counts) {
            let length = bits as usize;
            let mut next = symbols.clone();
            huffman.offsets[length] = next.next().map_or(0, |(at, _)| at) - code as i32;
            for (_, symbol) in symbols.by_ref().take(usize::from(count)) {
                if bits <= LOOKED_UP {
                    let spare = LOOKED_UP - bits;
                    let first = (code << spare) as usize;
                    let entries = huffman.short.iter_mut().skip(first).take(1 << spare);
                    for entry in entries {
                        *entry = (u8::try_from(bits).unwrap_or(0), *symbol);
                    }
                }
                code += 1;
            }
            // No code is all ones.
            if count > 0 && code >= 1 << bits {
                return Err("a Huffman table is wrong".to_owned());
            }
            huffman.ends[length] = if count > 0 { code << (17 - bits) } else { 0 };
            code <<= 1;
        }
        Ok(huffman)
    }

    /// The next symbol; 0 for bits that are none.
    #[inline]
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        reason = "at most 17 bits are left"
    )]
    pub(super) fn symbol(&self, bits: &mut Bits<'_, '_>) -> u8 {
        let ahead = bits.peek();
        let (length, symbol) = self.short[(ahead >> (64 - LOOKED_UP)) as usize];
        if length > 0 {
            bits.pass(u32::from(length));
            return symbol;
        }
        let ahead = (ahead >> 47) as u32;
        for length in LOOKED_UP + 1..=16 {
            if ahead < self.ends[length as usize] {
                bits.pass(length);
                let code = (ahead >> (17 - length)) as i32;
                let at = code + self.offsets[length as usize];
                let symbol = usize::try_from(at).ok().and_then(|at| self.symbols.get(at));
                return symbol.copied().unwrap_or(0);
            }
        }
        bits.pass(17);
        0
    }
}
