//! Channels of less resolution, spread over the pixels.
//!
//! Half the resolution is spread by a triangle filter: a pixel takes three quarters of the sample it lies in and one
//! quarter of the nearest one beside it, along each axis that is halved. Rounding goes up and down in turns, so that it
//! is even on the whole. Other ratios, and channels one or two samples wide, repeat their samples (libjpeg's choices).

use super::super::decode::Fault;
use super::header::{Component, Frame};
use super::scan::Plane;

/// How the samples of a channel become those of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Spread {
    /// By triangles along x, along y or along both.
    Triangle { x: bool, y: bool },
    /// Each sample so often along x and y.
    Repeat([usize; 2]),
}

impl Spread {
    fn of(frame: &Frame, component: &Component) -> Result<Self, Fault> {
        let [x, y] = [0, 1].map(|axis| {
            let (all, own) = (frame.factors[axis], component.factors[axis]);
            all.is_multiple_of(own).then_some(all / own)
        });
        let (Some(x), Some(y)) = (x, y) else {
            return Err("the resolutions of its channels do not divide each other".to_owned());
        };
        let is_wide = component.size[0] > 2;
        Ok(match (x, y) {
            (2, 1 | 2) if is_wide => Spread::Triangle { x: true, y: y == 2 },
            (1, 2) => Spread::Triangle { x: false, y: true },
            _ => Spread::Repeat([x, y]),
        })
    }
}

/// The bytes of all pixels, which `convert` adds row by row from one row of samples for each channel.
pub(super) fn rows(
    frame: &Frame,
    planes: &[Plane],
    convert: impl Fn(&[&[u8]], &mut Vec<u8>),
) -> Result<Vec<u8>, Fault> {
    let [width, height] = [frame.width, frame.height].map(usize::from);
    let spreads: Result<Vec<Spread>, Fault> = frame
        .components
        .iter()
        .map(|component| Spread::of(frame, component))
        .collect();
    let spreads = spreads?;
    let mut spread_rows = vec![Vec::new(); planes.len()];
    let mut out = Vec::with_capacity(width * height * planes.len());
    for y in 0..height {
        let channels = frame.components.iter().zip(planes).zip(&spreads);
        for (((component, plane), spread), row) in channels.zip(&mut spread_rows) {
            row.clear();
            spread.row(component, plane, y, row);
        }
        let of_pixels: Vec<&[u8]> = spread_rows.iter().map(|row| &row[..width]).collect();
        convert(&of_pixels, &mut out);
    }
    Ok(out)
}

impl Spread {
    /// Adds a row of pixels, at least as many as there are.
    fn row(self, component: &Component, plane: &Plane, y: usize, out: &mut Vec<u8>) {
        let [width, height] = component.size;
        let samples = |row: usize| {
            let from = row.min(height - 1) * plane.stride;
            &plane.samples[from..from + width]
        };
        match self {
            Spread::Repeat([1, often]) => out.extend(samples(y / often)),
            Spread::Repeat([often, down]) => {
                for sample in samples(y / down) {
                    out.extend(std::iter::repeat_n(sample, often));
                }
            }
            Spread::Triangle { x: true, y: false } => {
                let row = samples(y).iter().map(|sample| u16::from(*sample));
                along_x(row, 1, [1, 2], out);
            }
            Spread::Triangle { x, .. } => {
                let near = samples(y / 2);
                let is_upper = y.is_multiple_of(2);
                let far = if is_upper {
                    samples((y / 2).saturating_sub(1))
                } else {
                    samples(y / 2 + 1)
                };
                let sums = near.iter().zip(far);
                let sums = sums.map(|(near, far)| 3 * u16::from(*near) + u16::from(*far));
                if x {
                    along_x(sums, 4, [8, 7], out);
                } else {
                    let half = if is_upper { 1 } else { 2 };
                    out.extend(sums.map(|sum| quotient(sum + half, 4)));
                }
            }
        }
    }
}

/// Spreads a row of samples, each `unit` times its value, over twice as many pixels; the halves are added to the left
/// and the right pixel of a sample before the division.
fn along_x(row: impl Iterator<Item = u16>, unit: u16, [left, right]: [u16; 2], out: &mut Vec<u8>) {
    let mut row = row.peekable();
    let mut before = None;
    while let Some(sample) = row.next() {
        let after = row.peek().copied();
        // At an end there is nothing beside the sample but itself.
        let mix = |beside: Option<u16>| 3 * sample + beside.unwrap_or(sample);
        out.push(quotient(mix(before) + left, 4 * unit));
        out.push(quotient(mix(after) + right, 4 * unit));
        before = Some(sample);
    }
}

fn quotient(sum: u16, by: u16) -> u8 {
    u8::try_from(sum / by).unwrap_or(u8::MAX)
}
