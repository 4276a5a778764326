//! Decoding scans to the samples of each component.
//!
//! A sequential scan holds all coefficients of a block, and each block is transformed as it is decoded. Progressive
//! scans deliver coefficients in bands and bit planes, so they are stored until all scans are read.

use super::super::handling::Fault;
use super::bits::{BitReader, ByteReader};
use super::block::{self, Block};
use super::header::{Component, Frame, Scan, ScanComponent};
use super::huffman::{HuffmanDecoder, TableClass};
use super::tables::{QuantTable, Tables};
use super::transform;

/// Limit of MCUs decoded over all scans, per block of the file. Encoders write about ten scans; without a limit, a tiny
/// file could request thousands of empty ones.
const MAX_MCUS_PER_BLOCK: u64 = 24;
/// Additional MCUs that any file may have decoded.
const EXTRA_MCUS: u64 = 1 << 24;

/// The samples of a component, with `stride` samples per row.
#[derive(Debug)]
pub(super) struct Plane {
    pub(super) samples: Vec<u8>,
    pub(super) stride: usize,
}

/// The decoding state of a component.
#[derive(Debug)]
struct Channel {
    component: Component,
    /// The quantisation table in effect at the component's first scan.
    quant_table: Option<QuantTable>,
    plane: Plane,
    /// The coefficients; empty unless the file is progressive.
    blocks: Vec<Block>,
}

/// The decoder of the scans of a file.
#[derive(Debug)]
pub(super) struct Decoder {
    channels: Vec<Channel>,
    /// True once a sequential scan has covered all components.
    is_complete: bool,
    remaining_mcus: u64,
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
                quant_table: None,
                plane: Plane {
                    // Blocks without coefficients are mid-grey.
                    samples: vec![128; if count == 0 { across * down * 64 } else { 0 }],
                    stride: across * 8,
                },
                blocks: vec![[0; 64]; count],
            }
        };
        let blocks = frame.components.iter().map(Component::block_count);
        Ok(Decoder {
            channels: frame.components.iter().map(channel).collect(),
            is_complete: false,
            remaining_mcus: EXTRA_MCUS + MAX_MCUS_PER_BLOCK * blocks.sum::<u64>(),
        })
    }

    /// True if no more scans may follow.
    pub(super) fn is_complete(&self) -> bool {
        self.is_complete
    }

    /// Decodes a scan.
    pub(super) fn scan(
        &mut self,
        frame: &Frame,
        scan: &Scan,
        tables: &Tables,
        input: &mut ByteReader<'_>,
    ) -> Result<(), Fault> {
        let kind = ScanKind::new(frame, scan)?;
        let mut huffman_decoders = Vec::new();
        for scan_component in &scan.scan_components {
            let channel = &mut self.channels[scan_component.index];
            if channel.quant_table.is_none() {
                let quant_table = tables
                    .quant_tables
                    .get(channel.component.quant_table)
                    .copied();
                channel.quant_table = quant_table.flatten();
                channel
                    .quant_table
                    .as_ref()
                    .ok_or("a table of quantisation is missing")?;
            }
            huffman_decoders.push(kind.huffman_decoders(scan_component, tables)?);
        }
        let mut reader = ScanReader {
            kind,
            huffman_decoders,
            bits: BitReader::new(input),
            dc_predictors: [0; 4],
            eob_run: 0,
        };
        self.is_complete =
            !frame.is_progressive && scan.scan_components.len() == self.channels.len();
        reader.read_mcus(self, frame, scan, tables.restart_interval)
    }

    /// Returns the samples of all components.
    pub(super) fn into_planes(self) -> Vec<Plane> {
        self.channels.into_iter().map(Channel::into_plane).collect()
    }
}

impl Channel {
    fn store_block(&mut self, [x, y]: [usize; 2], block: &Block) {
        let Some(quant_table) = &self.quant_table else {
            return;
        };
        let samples = transform::inverse_dct(block, quant_table);
        let stride = self.plane.stride;
        let start = y * 8 * stride + x * 8;
        let rows = self.plane.samples[start..].chunks_mut(stride);
        for (row, samples) in rows.zip(samples.chunks_exact(8)) {
            row[..8].copy_from_slice(samples);
        }
    }

    fn into_plane(mut self) -> Plane {
        let blocks = std::mem::take(&mut self.blocks);
        if !blocks.is_empty() {
            self.plane.samples = vec![128; blocks.len() * 64];
            let across = self.component.blocks[0];
            for (index, block) in blocks.iter().enumerate() {
                self.store_block([index % across, index / across], block);
            }
        }
        self.plane
    }
}

/// The kind of coefficient data in a scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ScanKind {
    /// All coefficients of a sequential file.
    Sequential,
    /// DC coefficients without their low bits.
    DcFirst { approx_low: u8 },
    /// One more bit of the DC coefficients.
    DcRefine { approx_low: u8 },
    /// A band of AC coefficients without their low bits.
    AcFirst { band: [u8; 2], approx_low: u8 },
    /// One more bit of a band of AC coefficients.
    AcRefine { band: [u8; 2], approx_low: u8 },
}

impl ScanKind {
    fn new(frame: &Frame, scan: &Scan) -> Result<Self, Fault> {
        let Scan {
            band,
            approx_high,
            approx_low,
            ..
        } = *scan;
        if !frame.is_progressive {
            return Ok(ScanKind::Sequential);
        }
        let is_valid = if band[0] == 0 {
            band[1] == 0
        } else {
            band[0] <= band[1] && band[1] < 64 && scan.scan_components.len() == 1
        };
        if !is_valid || (approx_high != 0 && approx_low + 1 != approx_high) || approx_low > 13 {
            return Err("a scan has wrong numbers".to_owned());
        }
        Ok(match (band[0], approx_high) {
            (0, 0) => ScanKind::DcFirst { approx_low },
            (0, _) => ScanKind::DcRefine { approx_low },
            (_, 0) => ScanKind::AcFirst { band, approx_low },
            (_, _) => ScanKind::AcRefine { band, approx_low },
        })
    }

    /// The DC and AC Huffman decoders that the scan needs.
    fn huffman_decoders(
        self,
        scan_component: &ScanComponent,
        tables: &Tables,
    ) -> Result<[Option<HuffmanDecoder>; 2], Fault> {
        let dc = || {
            let table = tables
                .dc
                .get(scan_component.dc_table)
                .and_then(Option::as_ref);
            HuffmanDecoder::new(table, TableClass::Dc).map(Some)
        };
        let ac = || {
            let table = tables
                .ac
                .get(scan_component.ac_table)
                .and_then(Option::as_ref);
            HuffmanDecoder::new(table, TableClass::Ac).map(Some)
        };
        Ok(match self {
            ScanKind::Sequential => [dc()?, ac()?],
            ScanKind::DcFirst { .. } => [dc()?, None],
            ScanKind::DcRefine { .. } => [None, None],
            ScanKind::AcFirst { .. } | ScanKind::AcRefine { .. } => [None, ac()?],
        })
    }
}

/// The decoding state of a scan.
struct ScanReader<'r, 'a> {
    kind: ScanKind,
    huffman_decoders: Vec<[Option<HuffmanDecoder>; 2]>,
    bits: BitReader<'r, 'a>,
    /// The DC coefficient of the previous block of each component.
    dc_predictors: [i32; 4],
    /// Remaining blocks of the end-of-band run.
    eob_run: u32,
}

impl ScanReader<'_, '_> {
    /// Decodes all MCUs of the scan: single blocks if it has one component, otherwise interleaved blocks of all
    /// components.
    fn read_mcus(
        &mut self,
        decoder: &mut Decoder,
        frame: &Frame,
        scan: &Scan,
        restart_interval: u16,
    ) -> Result<(), Fault> {
        let mcu_count = |axis: usize| match scan.scan_components[..] {
            [scan_component] => frame.components[scan_component.index].size[axis].div_ceil(8),
            _ => {
                let component = &frame.components[0];
                component.blocks[axis] / component.sampling_factors[axis]
            }
        };
        let [across, down] = [mcu_count(0), mcu_count(1)];
        let (mut until_restart, mut restart_number) = (restart_interval, 0);
        for mcu in 0..across * down {
            if restart_interval > 0 {
                if until_restart == 0 {
                    self.bits.restart(restart_number)?;
                    (self.dc_predictors, self.eob_run) = ([0; 4], 0);
                    (until_restart, restart_number) = (restart_interval, (restart_number + 1) & 7);
                }
                until_restart -= 1;
            }
            decoder.remaining_mcus = decoder.remaining_mcus.saturating_sub(1);
            if decoder.remaining_mcus == 0 {
                return Err("it has too many scans".to_owned());
            }
            if self.bits.is_past_end {
                if restart_interval == 0 {
                    break;
                }
                continue;
            }
            let position = [mcu % across, mcu / across];
            for (index, scan_component) in scan.scan_components.iter().enumerate() {
                let channel = &mut decoder.channels[scan_component.index];
                let sampling_factors = match scan.scan_components[..] {
                    [_] => [1, 1],
                    _ => channel.component.sampling_factors,
                };
                for offset in 0..sampling_factors[0] * sampling_factors[1] {
                    let offset = [offset % sampling_factors[0], offset / sampling_factors[0]];
                    let block =
                        [0, 1].map(|axis| position[axis] * sampling_factors[axis] + offset[axis]);
                    self.read_block(index, channel, block);
                }
            }
        }
        Ok(())
    }

    /// Decodes one block of the scan's component `index`.
    fn read_block(&mut self, index: usize, channel: &mut Channel, position: [usize; 2]) {
        let [dc, ac] = &self.huffman_decoders[index];
        let bits = &mut self.bits;
        if let ScanKind::Sequential = self.kind {
            let mut coefficients = [0; 64];
            if let (Some(dc), Some(ac)) = (dc, ac) {
                let dc_predictor = &mut self.dc_predictors[index];
                block::decode_dc(bits, dc, dc_predictor, 0, &mut coefficients);
                block::decode_ac(bits, ac, &mut coefficients);
            }
            channel.store_block(position, &coefficients);
            return;
        }
        let block = &mut channel.blocks[position[1] * channel.component.blocks[0] + position[0]];
        match (self.kind, dc, ac) {
            (ScanKind::DcFirst { approx_low }, Some(dc), _) => {
                block::decode_dc(bits, dc, &mut self.dc_predictors[index], approx_low, block);
            }
            (ScanKind::DcRefine { approx_low }, ..) if bits.take(1) == 1 => {
                block[0] |= 1 << approx_low;
            }
            (ScanKind::AcFirst { .. }, _, Some(_)) if self.eob_run > 0 => self.eob_run -= 1,
            (ScanKind::AcFirst { band, approx_low }, _, Some(ac)) => {
                self.eob_run = block::decode_ac_band(bits, ac, band, approx_low, block);
            }
            (ScanKind::AcRefine { band, approx_low }, _, Some(ac)) => {
                self.eob_run =
                    block::refine_ac_band(bits, ac, band, approx_low, self.eob_run, block);
            }
            _ => {}
        }
    }
}
