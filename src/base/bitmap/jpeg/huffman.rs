//! Decoding of Huffman codes.

use super::super::handling::Fault;
use super::bits::BitReader;
use super::tables::HuffmanTable;

/// Codes of at most this many bits are decoded by a table lookup.
const LOOKUP_BITS: u32 = 9;

/// Decoding tables of a Huffman code.
#[derive(Debug)]
pub(super) struct HuffmanDecoder {
    /// Code length and symbol by the next [`LOOKUP_BITS`] bits; length 0 for longer codes.
    lookup: Box<[(u8, u8); 1 << LOOKUP_BITS]>,
    /// For each code length, the exclusive upper limit of its codes, left-aligned to 17 bits.
    limits: [u32; 17],
    /// For each code length, the symbol index minus the code.
    offsets: [i32; 17],
    symbols: Vec<u8>,
}

/// The table class: for DC or AC coefficients.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum TableClass {
    Dc,
    Ac,
}

impl HuffmanDecoder {
    /// Builds the decoding tables. Rejects invalid codes, and DC symbols above 15.
    #[allow(
        clippy::cast_possible_wrap,
        reason = "codes have at most 16 bits, and there are at most 256 symbols"
    )]
    pub(super) fn new(table: Option<&HuffmanTable>, class: TableClass) -> Result<Self, Fault> {
        let table = table.ok_or("a Huffman table is missing")?;
        if class == TableClass::Dc && table.symbols.iter().any(|symbol| *symbol > 15) {
            return Err("a Huffman table is wrong".to_owned());
        }
        let mut huffman = HuffmanDecoder {
            lookup: Box::new([(0, 0); 1 << LOOKUP_BITS]),
            limits: [0; 17],
            offsets: [0; 17],
            symbols: table.symbols.clone(),
        };
        let mut code = 0_u32;
        let mut symbols = (0_i32..).zip(table.symbols.iter());
        for (bits, count) in (1_u32..).zip(table.counts) {
            let length = bits as usize;
            let mut next = symbols.clone();
            huffman.offsets[length] = next.next().map_or(0, |(at, _)| at) - code as i32;
            for (_, symbol) in symbols.by_ref().take(usize::from(count)) {
                if bits <= LOOKUP_BITS {
                    let free_bits = LOOKUP_BITS - bits;
                    let first = (code << free_bits) as usize;
                    let entries = huffman.lookup.iter_mut().skip(first).take(1 << free_bits);
                    for entry in entries {
                        *entry = (u8::try_from(bits).unwrap_or(0), *symbol);
                    }
                }
                code += 1;
            }
            // The code of all ones is reserved.
            if count > 0 && code >= 1 << bits {
                return Err("a Huffman table is wrong".to_owned());
            }
            huffman.limits[length] = if count > 0 { code << (17 - bits) } else { 0 };
            code <<= 1;
        }
        Ok(huffman)
    }

    /// Decodes the next symbol; 0 for an invalid code.
    #[inline]
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        reason = "at most 17 bits are left"
    )]
    pub(super) fn symbol(&self, bits: &mut BitReader<'_, '_>) -> u8 {
        let ahead = bits.peek();
        let (length, symbol) = self.lookup[(ahead >> (64 - LOOKUP_BITS)) as usize];
        if length > 0 {
            bits.consume(u32::from(length));
            return symbol;
        }
        let ahead = (ahead >> 47) as u32;
        for length in LOOKUP_BITS + 1..=16 {
            if ahead < self.limits[length as usize] {
                bits.consume(length);
                let code = (ahead >> (17 - length)) as i32;
                let at = code + self.offsets[length as usize];
                let symbol = usize::try_from(at).ok().and_then(|at| self.symbols.get(at));
                return symbol.copied().unwrap_or(0);
            }
        }
        bits.consume(17);
        0
    }
}
