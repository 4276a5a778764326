//! The segments of a file: what stands around the scans.

use super::super::decode::Fault;
use super::bits::{Ended, Rest};
use super::tables::Tables;

/// Most components of a scan.
const MOST_IN_SCAN: u8 = 4;
/// Most components of a frame that libjpeg reads.
const MOST_COMPONENTS: u8 = 10;
/// Most blocks of all components in one unit of a scan.
const MOST_BLOCKS: usize = 10;

/// A channel of the picture.
#[derive(Clone, Debug)]
pub(super) struct Component {
    pub(super) id: u8,
    /// Samples across and down for each unit of the frame.
    pub(super) factors: [usize; 2],
    /// Which table of quantisation.
    pub(super) steps: usize,
    /// Samples across and down, without those that fill up the last blocks.
    pub(super) size: [usize; 2],
    /// Blocks across and down, with those that fill up the last unit.
    pub(super) blocks: [usize; 2],
}

/// The contents of the file.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    pub(super) width: u16,
    pub(super) height: u16,
    pub(super) is_progressive: bool,
    /// The largest factors of any component.
    pub(super) factors: [usize; 2],
    pub(super) components: Vec<Component>,
}

/// The meaning of the samples of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Coding {
    /// Grey, or red, green and blue.
    Plain,
    /// Luminance and two differences.
    Ycc,
}

/// What the segments of other programs say about colours.
#[derive(Debug, Default)]
pub(super) struct Marks {
    is_jfif: bool,
    /// The transform of Adobe's segment.
    adobe: Option<u8>,
}

/// The part of a component in a scan.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    /// Which component of the frame.
    pub(super) component: usize,
    pub(super) first_table: usize,
    pub(super) other_table: usize,
}

/// The head of a scan.
#[derive(Debug)]
pub(super) struct Scan {
    pub(super) parts: Vec<Part>,
    /// The first and last coefficient.
    pub(super) band: [u8; 2],
    /// The bits left out by the scan before this one, and by this one.
    pub(super) high: u8,
    pub(super) low: u8,
}

/// What ends a stretch of segments.
#[derive(Debug)]
pub(super) enum Segment {
    Frame,
    Scan(Scan),
    End,
}

/// A reader of segments, with what they have set.
#[derive(Debug)]
pub(super) struct Reader<'a> {
    pub(super) rest: Rest<'a>,
    pub(super) tables: Tables,
    pub(super) frame: Option<Frame>,
    pub(super) marks: Marks,
}

impl From<Ended> for Fault {
    fn from(Ended: Ended) -> Fault {
        "it ends early".to_owned()
    }
}

impl<'a> Reader<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Result<Self, Fault> {
        let Some(bytes) = bytes.strip_prefix(&[0xff, 0xd8]) else {
            return Err("it is no JPEG file".to_owned());
        };
        Ok(Reader {
            rest: Rest::new(bytes),
            tables: Tables::default(),
            frame: None,
            marks: Marks::default(),
        })
    }

    /// Reads segments up to a frame, a scan or the end.
    pub(super) fn next_segment(&mut self) -> Result<Segment, Fault> {
        loop {
            let marker = self.rest.next_marker()?;
            match marker {
                0xd9 => return Ok(Segment::End),
                0x01 | 0xd0..=0xd7 => continue,
                0xc0..=0xcf | 0xda..=0xdf | 0xe0..=0xef | 0xfe => {}
                _ => return Err(format!("it has an unknown marker {marker:#04x}")),
            }
            let length = usize::from(self.rest.word()?);
            let body = length.checked_sub(2).ok_or("a segment is too short")?;
            let mut segment = Rest::new(self.rest.take(body)?);
            match marker {
                0xc4 => self.tables.read_codes(segment)?,
                0xdb => self.tables.read_steps(segment)?,
                0xdd => self.tables.restart = segment.word()?,
                0xc0..=0xc2 => {
                    self.read_frame(segment, marker == 0xc2)?;
                    return Ok(Segment::Frame);
                }
                0xda => return self.read_scan(segment).map(Segment::Scan),
                0xcc | 0xc9 | 0xca => return Err("arithmetic codes are not built yet".to_owned()),
                0xc3 | 0xc5..=0xcf | 0xde | 0xdf => {
                    return Err("it is neither baseline nor progressive".to_owned());
                }
                0xe0 => self.marks.is_jfif |= body >= 14 && segment.take(5)? == b"JFIF\0",
                0xee if body >= 12 && segment.take(5)? == b"Adobe" => {
                    self.marks.adobe = Some(segment.take(7)?[6]);
                }
                _ => {}
            }
        }
    }

    fn read_frame(&mut self, mut segment: Rest<'_>, is_progressive: bool) -> Result<(), Fault> {
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
        if count > MOST_COMPONENTS {
            return Err("it has too many channels".to_owned());
        }
        let mut components = Vec::new();
        for _ in 0..count {
            let [id, factors, steps] = [segment.byte()?, segment.byte()?, segment.byte()?];
            let factors = [factors >> 4, factors & 15].map(usize::from);
            if factors.iter().any(|factor| !(1..=4).contains(factor)) {
                return Err("its channels have wrong resolutions".to_owned());
            }
            components.push(Component {
                id,
                factors,
                steps: usize::from(steps),
                size: [0; 2],
                blocks: [0; 2],
            });
        }
        let largest = |axis: usize| {
            let factors = components.iter().map(|component| component.factors[axis]);
            factors.max().unwrap_or(1)
        };
        let factors = [largest(0), largest(1)];
        let size = [width, height].map(usize::from);
        for component in &mut components {
            for axis in 0..2 {
                let factor = component.factors[axis];
                component.size[axis] = (size[axis] * factor).div_ceil(factors[axis]);
                component.blocks[axis] = size[axis].div_ceil(8 * factors[axis]) * factor;
            }
        }
        self.frame = Some(Frame {
            width,
            height,
            is_progressive,
            factors,
            components,
        });
        Ok(())
    }

    fn read_scan(&mut self, mut segment: Rest<'_>) -> Result<Scan, Fault> {
        let frame = self.frame.as_ref().ok_or("its frame is missing")?;
        let count = segment.byte()?;
        if !(1..=MOST_IN_SCAN).contains(&count) {
            return Err("a scan has a wrong number of channels".to_owned());
        }
        let mut parts: Vec<Part> = Vec::new();
        let mut blocks = 0;
        for _ in 0..count {
            let [id, tables] = [segment.byte()?, segment.byte()?];
            let is_new = |at: &usize| parts.iter().all(|part| part.component != *at);
            let mut places = 0..frame.components.len();
            let found = places.find(|at| frame.components[*at].id == id && is_new(at));
            let component = found.ok_or("a scan has an unknown channel")?;
            blocks += frame.components[component]
                .factors
                .iter()
                .product::<usize>();
            parts.push(Part {
                component,
                first_table: usize::from(tables >> 4),
                other_table: usize::from(tables & 15),
            });
        }
        if count > 1 && blocks > MOST_BLOCKS {
            return Err("the units of a scan are too large".to_owned());
        }
        let band = [segment.byte()?, segment.byte()?];
        let bits = segment.byte()?;
        Ok(Scan {
            parts,
            band,
            high: bits >> 4,
            low: bits & 15,
        })
    }
}

impl Frame {
    /// What the samples are, by what the file says or by the names of the channels.
    pub(super) fn coding(&self, marks: &Marks) -> Result<Coding, Fault> {
        let ids: Vec<u8> = self.components.iter().map(|it| it.id).collect();
        match ids[..] {
            [_] => Ok(Coding::Plain),
            [_, _, _] if marks.is_jfif => Ok(Coding::Ycc),
            [_, _, _] if marks.adobe == Some(0) => Ok(Coding::Plain),
            [b'R', b'G', b'B'] if marks.adobe.is_none() => Ok(Coding::Plain),
            [_, _, _] => Ok(Coding::Ycc),
            _ => Err(format!("it has {} channels, not 1 or 3", ids.len())),
        }
    }

    /// About how many bytes decoding takes: coefficients of two bytes, samples, and the pixels made of them.
    pub(super) fn bytes(&self) -> u64 {
        let blocks: u64 = self.components.iter().map(Component::blocks_in_all).sum();
        let samples = blocks * 64;
        let pixels = u64::from(self.width) * u64::from(self.height);
        let coefficients = if self.is_progressive { 2 * samples } else { 0 };
        coefficients + samples + pixels * self.components.len() as u64
    }
}

impl Component {
    pub(super) fn blocks_in_all(&self) -> u64 {
        self.blocks[0] as u64 * self.blocks[1] as u64
    }
}
