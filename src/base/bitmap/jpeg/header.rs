//! Marker segments: frame and scan headers, and the dispatch to tables.

use super::super::handling::Fault;
use super::bits::{ByteReader, UnexpectedEnd};
use super::tables::Tables;

/// Maximum number of components of a scan.
const MAX_SCAN_COMPONENTS: u8 = 4;
/// Maximum number of components of a frame in libjpeg.
const MAX_COMPONENTS: u8 = 10;
/// Maximum number of blocks in an MCU (minimum coded unit).
const MAX_MCU_BLOCKS: usize = 10;

/// A component (colour channel) of the frame.
#[derive(Clone, Debug)]
pub(super) struct Component {
    pub(super) id: u8,
    /// Horizontal and vertical sampling factors: blocks per MCU.
    pub(super) sampling_factors: [usize; 2],
    /// Index of the quantisation table.
    pub(super) quant_table: usize,
    /// Width and height in samples, without padding to full blocks.
    pub(super) size: [usize; 2],
    /// Width and height in blocks, padded to full MCUs.
    pub(super) blocks: [usize; 2],
}

/// The frame header.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    pub(super) width: u16,
    pub(super) height: u16,
    pub(super) is_progressive: bool,
    /// The largest sampling factors over all components.
    pub(super) sampling_factors: [usize; 2],
    pub(super) components: Vec<Component>,
}

/// The colour model of the samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ColorModel {
    /// Grey, or red, green and blue.
    Direct,
    /// Luma and two colour differences.
    YCbCr,
}

/// Application markers that determine the colour model.
#[derive(Debug, Default)]
pub(super) struct ColorMarkers {
    is_jfif: bool,
    /// The transform code of Adobe's APP14 segment.
    adobe: Option<u8>,
}

/// A component of a scan, with its Huffman tables.
#[derive(Clone, Copy, Debug)]
pub(super) struct ScanComponent {
    /// Index of the component in the frame.
    pub(super) index: usize,
    pub(super) dc_table: usize,
    pub(super) ac_table: usize,
}

/// The scan header.
#[derive(Debug)]
pub(super) struct Scan {
    pub(super) scan_components: Vec<ScanComponent>,
    /// Spectral selection: the first and last coefficient in zigzag order.
    pub(super) band: [u8; 2],
    /// Successive approximation: the number of low bits omitted by the previous scan and by this scan.
    pub(super) approx_high: u8,
    pub(super) approx_low: u8,
}

/// The segments that [`Reader::next_segment`] returns.
#[derive(Debug)]
pub(super) enum Segment {
    Frame,
    Scan(Scan),
    End,
}

/// A reader of marker segments, with the state that they define.
#[derive(Debug)]
pub(super) struct Reader<'a> {
    pub(super) input: ByteReader<'a>,
    pub(super) tables: Tables,
    pub(super) frame: Option<Frame>,
    pub(super) color_markers: ColorMarkers,
}

impl From<UnexpectedEnd> for Fault {
    fn from(UnexpectedEnd: UnexpectedEnd) -> Fault {
        "it ends early".to_owned()
    }
}

impl<'a> Reader<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Result<Self, Fault> {
        let Some(bytes) = bytes.strip_prefix(&[0xff, 0xd8]) else {
            return Err("it is not a JPEG file".to_owned());
        };
        Ok(Reader {
            input: ByteReader::new(bytes),
            tables: Tables::default(),
            frame: None,
            color_markers: ColorMarkers::default(),
        })
    }

    /// Reads segments up to the next frame header, scan header or end marker.
    pub(super) fn next_segment(&mut self) -> Result<Segment, Fault> {
        loop {
            let marker = self.input.next_marker()?;
            match marker {
                0xd9 => return Ok(Segment::End),
                0x01 | 0xd0..=0xd7 => continue,
                0xc0..=0xcf | 0xda..=0xdf | 0xe0..=0xef | 0xfe => {}
                _ => return Err(format!("it has an unknown marker {marker:#04x}")),
            }
            let length = usize::from(self.input.word()?);
            let body = length.checked_sub(2).ok_or("a segment is too short")?;
            let mut segment = ByteReader::new(self.input.take(body)?);
            match marker {
                0xc4 => self.tables.read_huffman_tables(segment)?,
                0xdb => self.tables.read_quant_tables(segment)?,
                0xdd => self.tables.restart_interval = segment.word()?,
                0xc0..=0xc2 => {
                    self.read_frame(segment, marker == 0xc2)?;
                    return Ok(Segment::Frame);
                }
                0xda => return self.read_scan(segment).map(Segment::Scan),
                0xcc | 0xc9 | 0xca => {
                    return Err("arithmetic codes are not supported yet".to_owned());
                }
                0xc3 | 0xc5..=0xcf | 0xde | 0xdf => {
                    return Err("it is neither baseline nor progressive".to_owned());
                }
                0xe0 => self.color_markers.is_jfif |= body >= 14 && segment.take(5)? == b"JFIF\0",
                0xee if body >= 12 && segment.take(5)? == b"Adobe" => {
                    self.color_markers.adobe = Some(segment.take(7)?[6]);
                }
                _ => {}
            }
        }
    }

    fn read_frame(
        &mut self,
        mut segment: ByteReader<'_>,
        is_progressive: bool,
    ) -> Result<(), Fault> {
        if self.frame.is_some() {
            return Err("it has two frames".to_owned());
        }
        if segment.byte()? != 8 {
            return Err("its samples have other than eight bits".to_owned());
        }
        let [height, width] = [segment.word()?, segment.word()?];
        let count = segment.byte()?;
        if width == 0 || height == 0 || count == 0 {
            return Err("it has no pixels".to_owned());
        }
        if count > MAX_COMPONENTS {
            return Err("it has too many channels".to_owned());
        }
        let mut components = Vec::new();
        for _ in 0..count {
            let [id, sampling_factors, quant_table] =
                [segment.byte()?, segment.byte()?, segment.byte()?];
            let sampling_factors = [sampling_factors >> 4, sampling_factors & 15].map(usize::from);
            if sampling_factors
                .iter()
                .any(|sampling_factor| !(1..=4).contains(sampling_factor))
            {
                return Err("its channels have wrong resolutions".to_owned());
            }
            components.push(Component {
                id,
                sampling_factors,
                quant_table: usize::from(quant_table),
                size: [0; 2],
                blocks: [0; 2],
            });
        }
        let largest = |axis: usize| {
            let sampling_factors = components
                .iter()
                .map(|component| component.sampling_factors[axis]);
            sampling_factors.max().unwrap_or(1)
        };
        let sampling_factors = [largest(0), largest(1)];
        let size = [width, height].map(usize::from);
        for component in &mut components {
            for axis in 0..2 {
                let sampling_factor = component.sampling_factors[axis];
                component.size[axis] =
                    (size[axis] * sampling_factor).div_ceil(sampling_factors[axis]);
                component.blocks[axis] =
                    size[axis].div_ceil(8 * sampling_factors[axis]) * sampling_factor;
            }
        }
        self.frame = Some(Frame {
            width,
            height,
            is_progressive,
            sampling_factors,
            components,
        });
        Ok(())
    }

    fn read_scan(&mut self, mut segment: ByteReader<'_>) -> Result<Scan, Fault> {
        let frame = self.frame.as_ref().ok_or("its frame is missing")?;
        let count = segment.byte()?;
        if !(1..=MAX_SCAN_COMPONENTS).contains(&count) {
            return Err("a scan has a wrong number of channels".to_owned());
        }
        let mut scan_components: Vec<ScanComponent> = Vec::new();
        let mut blocks = 0;
        for _ in 0..count {
            let [id, tables] = [segment.byte()?, segment.byte()?];
            let is_unused = |at: &usize| {
                scan_components
                    .iter()
                    .all(|scan_component| scan_component.index != *at)
            };
            let mut indices = 0..frame.components.len();
            let matching = indices.find(|at| frame.components[*at].id == id && is_unused(at));
            let index = matching.ok_or("a scan has an unknown channel")?;
            blocks += frame.components[index]
                .sampling_factors
                .iter()
                .product::<usize>();
            scan_components.push(ScanComponent {
                index,
                dc_table: usize::from(tables >> 4),
                ac_table: usize::from(tables & 15),
            });
        }
        if count > 1 && blocks > MAX_MCU_BLOCKS {
            return Err("the units of a scan are too large".to_owned());
        }
        let band = [segment.byte()?, segment.byte()?];
        let bits = segment.byte()?;
        Ok(Scan {
            scan_components,
            band,
            approx_high: bits >> 4,
            approx_low: bits & 15,
        })
    }
}

impl Frame {
    /// The colour model, from application markers or component identifiers (libjpeg's rules).
    pub(super) fn color_model(&self, color_markers: &ColorMarkers) -> Result<ColorModel, Fault> {
        let ids: Vec<u8> = self.components.iter().map(|it| it.id).collect();
        match ids[..] {
            [_] => Ok(ColorModel::Direct),
            [_, _, _] if color_markers.is_jfif => Ok(ColorModel::YCbCr),
            [_, _, _] if color_markers.adobe == Some(0) => Ok(ColorModel::Direct),
            [b'R', b'G', b'B'] if color_markers.adobe.is_none() => Ok(ColorModel::Direct),
            [_, _, _] => Ok(ColorModel::YCbCr),
            _ => Err(format!("it has {} channels, not 1 or 3", ids.len())),
        }
    }

    /// Approximate bytes that decoding needs: 16-bit coefficients if progressive, samples, and pixels.
    pub(super) fn bytes_to_decode(&self) -> u64 {
        let blocks: u64 = self.components.iter().map(Component::block_count).sum();
        let samples = blocks * 64;
        let pixels = u64::from(self.width) * u64::from(self.height);
        let coefficients = if self.is_progressive { 2 * samples } else { 0 };
        coefficients + samples + pixels * self.components.len() as u64
    }
}

impl Component {
    pub(super) fn block_count(&self) -> u64 {
        self.blocks[0] as u64 * self.blocks[1] as u64
    }
}
