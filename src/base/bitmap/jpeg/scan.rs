//! Scans: from Huffman codes to the samples of each channel.
//!
//! A sequential file gives the coefficients of a block at once, and they are transformed at once. A progressive one
//! gives them in bands and bit by bit, so they are kept until all scans are read.

use super::super::decode::Fault;
use super::bits::{Bits, Rest};
use super::block::{self, Block};
use super::header::{Component, Frame, Part, Scan};
use super::huffman::{For, Huffman};
use super::tables::{Steps, Tables};
use super::transform;

/// Visits of blocks that a progressive file may need for each block it has, and beyond those. Programs write ten scans;
/// a file of a few bytes could ask for thousands that hold nothing.
const VISITS_FOR_BLOCK: u64 = 24;
const VISITS: u64 = 1 << 24;

/// The samples of a channel, `stride` in a row.
#[derive(Debug)]
pub(super) struct Plane {
    pub(super) samples: Vec<u8>,
    pub(super) stride: usize,
}

/// A channel as far as it is decoded.
#[derive(Debug)]
struct Channel {
    component: Component,
    /// The steps in force when the first scan of it began.
    steps: Option<Steps>,
    plane: Plane,
    /// The coefficients of a progressive file.
    blocks: Vec<Block>,
}

/// The decoder of the scans of a file.
#[derive(Debug)]
pub(super) struct Decoder {
    channels: Vec<Channel>,
    /// True if one scan held all there is.
    is_complete: bool,
    visits: u64,
}

impl Decoder {
    pub(super) fn new(frame: &Frame) -> Result<Self, Fault> {
        let channel = |component: &Component| {
            let [across, down] = component.blocks;
            let count = if frame.is_progressive {
                across * down
            } else {
                0
            };
            Channel {
                component: component.clone(),
                steps: None,
                plane: Plane {
                    // Grey, as of blocks without coefficients.
                    samples: vec![128; if count == 0 { across * down * 64 } else { 0 }],
                    stride: across * 8,
                },
                blocks: vec![[0; 64]; count],
            }
        };
        let blocks = frame.components.iter().map(Component::blocks_in_all);
        Ok(Decoder {
            channels: frame.components.iter().map(channel).collect(),
            is_complete: false,
            visits: VISITS + VISITS_FOR_BLOCK * blocks.sum::<u64>(),
        })
    }

    /// Tells whether no more scans may follow.
    pub(super) fn is_complete(&self) -> bool {
        self.is_complete
    }

    /// Reads a scan.
    pub(super) fn scan(
        &mut self,
        frame: &Frame,
        scan: &Scan,
        tables: &Tables,
        rest: &mut Rest<'_>,
    ) -> Result<(), Fault> {
        let step = Step::new(frame, scan)?;
        let mut codes = Vec::new();
        for part in &scan.parts {
            let channel = &mut self.channels[part.component];
            if channel.steps.is_none() {
                let steps = tables.steps.get(channel.component.steps).copied();
                channel.steps = steps.flatten();
                channel
                    .steps
                    .as_ref()
                    .ok_or("a table of quantisation is missing")?;
            }
            codes.push(step.codes(part, tables)?);
        }
        let mut run = Run {
            step,
            codes,
            bits: Bits::new(rest),
            before: [0; 4],
            empty: 0,
        };
        self.is_complete = !frame.is_progressive && scan.parts.len() == self.channels.len();
        run.units(self, frame, scan, tables.restart)
    }

    /// The samples of all channels.
    pub(super) fn planes(self) -> Vec<Plane> {
        self.channels.into_iter().map(Channel::finish).collect()
    }
}

impl Channel {
    fn put(&mut self, [x, y]: [usize; 2], block: &Block) {
        let Some(steps) = &self.steps else {
            return;
        };
        let samples = transform::samples(block, steps);
        let stride = self.plane.stride;
        let from = y * 8 * stride + x * 8;
        let rows = self.plane.samples[from..].chunks_mut(stride);
        for (row, samples) in rows.zip(samples.chunks_exact(8)) {
            row[..8].copy_from_slice(samples);
        }
    }

    fn finish(mut self) -> Plane {
        let blocks = std::mem::take(&mut self.blocks);
        if !blocks.is_empty() {
            self.plane.samples = vec![128; blocks.len() * 64];
            let across = self.component.blocks[0];
            for (at, block) in blocks.iter().enumerate() {
                self.put([at % across, at / across], block);
            }
        }
        self.plane
    }
}

/// What a scan does to a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Step {
    /// All coefficients of a sequential file.
    All,
    /// The first coefficient without its lowest bits.
    First { low: u8 },
    /// One more bit of it.
    FirstBit { low: u8 },
    /// A band of the others without their lowest bits.
    Band { band: [u8; 2], low: u8 },
    /// One more bit of them.
    BandBit { band: [u8; 2], low: u8 },
}

impl Step {
    fn new(frame: &Frame, scan: &Scan) -> Result<Self, Fault> {
        let Scan {
            band, high, low, ..
        } = *scan;
        if !frame.is_progressive {
            return Ok(Step::All);
        }
        let is_right = if band[0] == 0 {
            band[1] == 0
        } else {
            band[0] <= band[1] && band[1] < 64 && scan.parts.len() == 1
        };
        if !is_right || (high != 0 && low + 1 != high) || low > 13 {
            return Err("a scan has wrong numbers".to_owned());
        }
        Ok(match (band[0], high) {
            (0, 0) => Step::First { low },
            (0, _) => Step::FirstBit { low },
            (_, 0) => Step::Band { band, low },
            (_, _) => Step::BandBit { band, low },
        })
    }

    /// The codes that it needs, for the first coefficient and for others.
    fn codes(self, part: &Part, tables: &Tables) -> Result<[Option<Huffman>; 2], Fault> {
        let first = || {
            let codes = tables.first.get(part.first_table).and_then(Option::as_ref);
            Huffman::new(codes, For::First).map(Some)
        };
        let others = || {
            let codes = tables.others.get(part.other_table).and_then(Option::as_ref);
            Huffman::new(codes, For::Others).map(Some)
        };
        Ok(match self {
            Step::All => [first()?, others()?],
            Step::First { .. } => [first()?, None],
            Step::FirstBit { .. } => [None, None],
            Step::Band { .. } | Step::BandBit { .. } => [None, others()?],
        })
    }
}

/// A scan being read.
struct Run<'r, 'a> {
    step: Step,
    codes: Vec<[Option<Huffman>; 2]>,
    bits: Bits<'r, 'a>,
    /// The first coefficients of the last blocks.
    before: [i32; 4],
    /// Blocks to come in which the band has nothing new.
    empty: u32,
}

impl Run<'_, '_> {
    /// Reads all units of the scan: blocks of one channel, or the blocks of all channels that share a place.
    fn units(
        &mut self,
        decoder: &mut Decoder,
        frame: &Frame,
        scan: &Scan,
        restart: u16,
    ) -> Result<(), Fault> {
        let count = |axis: usize| match scan.parts[..] {
            [part] => frame.components[part.component].size[axis].div_ceil(8),
            _ => {
                let component = &frame.components[0];
                component.blocks[axis] / component.factors[axis]
            }
        };
        let [across, down] = [count(0), count(1)];
        let (mut left, mut number) = (restart, 0);
        for unit in 0..across * down {
            if restart > 0 {
                if left == 0 {
                    self.bits.restart(number)?;
                    (self.before, self.empty) = ([0; 4], 0);
                    (left, number) = (restart, (number + 1) & 7);
                }
                left -= 1;
            }
            decoder.visits = decoder.visits.saturating_sub(1);
            if decoder.visits == 0 {
                return Err("it has too many scans".to_owned());
            }
            if self.bits.is_short {
                if restart == 0 {
                    break;
                }
                continue;
            }
            let place = [unit % across, unit / across];
            for (at, part) in scan.parts.iter().enumerate() {
                let channel = &mut decoder.channels[part.component];
                let factors = match scan.parts[..] {
                    [_] => [1, 1],
                    _ => channel.component.factors,
                };
                for inner in 0..factors[0] * factors[1] {
                    let inner = [inner % factors[0], inner / factors[0]];
                    let block = [0, 1].map(|axis| place[axis] * factors[axis] + inner[axis]);
                    self.block(at, channel, block);
                }
            }
        }
        Ok(())
    }

    /// Reads what the scan says about a block of its part `at`.
    fn block(&mut self, at: usize, channel: &mut Channel, place: [usize; 2]) {
        let [first, others] = &self.codes[at];
        let bits = &mut self.bits;
        if let Step::All = self.step {
            let mut coefficients = [0; 64];
            if let (Some(first), Some(others)) = (first, others) {
                let before = &mut self.before[at];
                block::first(bits, first, before, 0, &mut coefficients);
                block::others(bits, others, &mut coefficients);
            }
            channel.put(place, &coefficients);
            return;
        }
        let block = &mut channel.blocks[place[1] * channel.component.blocks[0] + place[0]];
        match (self.step, first, others) {
            (Step::First { low }, Some(first), _) => {
                block::first(bits, first, &mut self.before[at], low, block);
            }
            (Step::FirstBit { low }, ..) if bits.take(1) == 1 => block[0] |= 1 << low,
            (Step::Band { .. }, _, Some(_)) if self.empty > 0 => self.empty -= 1,
            (Step::Band { band, low }, _, Some(others)) => {
                self.empty = block::band(bits, others, (band, low), block);
            }
            (Step::BandBit { band, low }, _, Some(others)) => {
                self.empty = block::band_bit(bits, others, (band, low), self.empty, block);
            }
            _ => {}
        }
    }
}
