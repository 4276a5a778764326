//! Quantisation tables and Huffman tables.

use super::super::handling::Fault;
use super::bits::{ByteReader, UnexpectedEnd};

/// Zigzag order: the row-major index of each stored coefficient. A damaged file may run up to 15 entries past the end.
pub(super) const ZIGZAG: [u8; 80] = {
    let mut order = [63; 80];
    let (mut x, mut y) = (0_u8, 0_u8);
    let mut at = 0;
    while at < 64 {
        order[at] = y * 8 + x;
        let goes_up = (x + y).is_multiple_of(2);
        (x, y) = match (goes_up, x, y) {
            (true, 7, _) => (7, y + 1),
            (true, _, 0) => (x + 1, 0),
            (true, _, _) => (x + 1, y - 1),
            (false, _, 7) => (x + 1, 7),
            (false, 0, _) => (0, y + 1),
            (false, _, _) => (x - 1, y + 1),
        };
        at += 1;
    }
    order
};

/// Quantisation steps in row-major order.
pub(super) type QuantTable = [u16; 64];

/// A Huffman table as stored: the number of codes of each length from 1 to 16, and their symbols.
#[derive(Clone, Debug)]
pub(super) struct HuffmanTable {
    pub(super) counts: [u8; 16],
    pub(super) symbols: Vec<u8>,
}

/// The tables defined by the segments read so far.
#[derive(Debug, Default)]
pub(super) struct Tables {
    pub(super) quant_tables: [Option<QuantTable>; 4],
    /// Huffman tables for DC coefficients.
    pub(super) dc: [Option<HuffmanTable>; 4],
    /// Huffman tables for AC coefficients.
    pub(super) ac: [Option<HuffmanTable>; 4],
    /// Number of MCUs between restart markers; 0 without restart markers.
    pub(super) restart_interval: u16,
}

impl Tables {
    /// Reads a DQT segment.
    pub(super) fn read_quant_tables(&mut self, mut segment: ByteReader<'_>) -> Result<(), Fault> {
        while let Ok(head) = segment.byte() {
            let mut quant_table = [0; 64];
            for at in &ZIGZAG[..64] {
                let step = if head >> 4 == 0 {
                    segment.byte().map(u16::from)
                } else {
                    segment.word()
                };
                quant_table[usize::from(*at)] =
                    step.map_err(|UnexpectedEnd| "a table is too short")?;
            }
            let table = self.quant_tables.get_mut(usize::from(head & 15));
            *table.ok_or("a table of quantisation has a wrong number")? = Some(quant_table);
        }
        Ok(())
    }

    /// Reads a DHT segment.
    pub(super) fn read_huffman_tables(&mut self, mut segment: ByteReader<'_>) -> Result<(), Fault> {
        while let Ok(head) = segment.byte() {
            let too_short = |UnexpectedEnd| "a Huffman table is too short";
            let mut counts = [0; 16];
            counts.copy_from_slice(segment.take(16).map_err(too_short)?);
            let count: usize = counts.iter().map(|count| usize::from(*count)).sum();
            if count > 256 {
                return Err("a Huffman table has too many codes".to_owned());
            }
            let symbols = segment.take(count).map_err(too_short)?.to_vec();
            let tables = match head >> 4 {
                0 => &mut self.dc,
                1 => &mut self.ac,
                _ => return Err("a Huffman table has a wrong number".to_owned()),
            };
            let table = tables.get_mut(usize::from(head & 15));
            *table.ok_or("a Huffman table has a wrong number")? =
                Some(HuffmanTable { counts, symbols });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::ZIGZAG;

    #[test]
    fn the_zigzag_visits_each_coefficient_once() {
        let mut visited = ZIGZAG[..64].to_vec();
        assert_eq!(visited[..10], [0, 1, 8, 16, 9, 2, 3, 10, 17, 24]);
        assert_eq!(visited[60..], [47, 55, 62, 63]);
        visited.sort_unstable();
        assert!(visited.into_iter().eq(0..64));
    }
}
