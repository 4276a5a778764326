//! The tables of a file: steps of quantisation, and Huffman codes.

use super::super::decode::Fault;
use super::bits::{Ended, Rest};

/// The order in which a block is stored, as places in rows of eight; a file may run over the end by fifteen.
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

/// Steps of quantisation, row by row.
pub(super) type Steps = [u16; 64];

/// A Huffman code as the file has it: how many codes there are of each length from 1 on, and what they stand for.
#[derive(Clone, Debug)]
pub(super) struct Codes {
    pub(super) counts: [u8; 16],
    pub(super) symbols: Vec<u8>,
}

/// What the segments of a file have set so far.
#[derive(Debug, Default)]
pub(super) struct Tables {
    pub(super) steps: [Option<Steps>; 4],
    /// For the first coefficient of blocks.
    pub(super) first: [Option<Codes>; 4],
    /// For the others.
    pub(super) others: [Option<Codes>; 4],
    /// The number of units of a scan between two restart markers; 0 for no markers.
    pub(super) restart: u16,
}

impl Tables {
    /// Reads steps of quantisation.
    pub(super) fn read_steps(&mut self, mut segment: Rest<'_>) -> Result<(), Fault> {
        while let Ok(head) = segment.byte() {
            let mut steps = [0; 64];
            for at in &ZIGZAG[..64] {
                let step = if head >> 4 == 0 {
                    segment.byte().map(u16::from)
                } else {
                    segment.word()
                };
                steps[usize::from(*at)] = step.map_err(|Ended| "a table is too short")?;
            }
            let table = self.steps.get_mut(usize::from(head & 15));
            *table.ok_or("a table of quantisation has a wrong number")? = Some(steps);
        }
        Ok(())
    }

    /// Reads Huffman codes.
    pub(super) fn read_codes(&mut self, mut segment: Rest<'_>) -> Result<(), Fault> {
        while let Ok(head) = segment.byte() {
            let short = |Ended| "a Huffman table is too short";
            let mut counts = [0; 16];
            counts.copy_from_slice(segment.take(16).map_err(short)?);
            let count: usize = counts.iter().map(|count| usize::from(*count)).sum();
            if count > 256 {
                return Err("a Huffman table has too many codes".to_owned());
            }
            let symbols = segment.take(count).map_err(short)?.to_vec();
            let tables = match head >> 4 {
                0 => &mut self.first,
                1 => &mut self.others,
                _ => return Err("a Huffman table has a wrong number".to_owned()),
            };
            let table = tables.get_mut(usize::from(head & 15));
            *table.ok_or("a Huffman table has a wrong number")? = Some(Codes { counts, symbols });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::ZIGZAG;

    #[test]
    fn the_zigzag_visits_all_places_once() {
        let mut seen = ZIGZAG[..64].to_vec();
        assert_eq!(seen[..10], [0, 1, 8, 16, 9, 2, 3, 10, 17, 24]);
        assert_eq!(seen[60..], [47, 55, 62, 63]);
        seen.sort_unstable();
        assert!(seen.into_iter().eq(0..64));
    }
}
