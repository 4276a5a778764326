//! Upsampling of subsampled components, with libjpeg's choices.
//!
//! Half resolution uses a triangle filter (libjpeg's "fancy upsampling"): along each halved axis, a pixel is three
//! quarters of the sample that covers it plus one quarter of the nearest neighbour. Rounding alternates between up and
//! down to avoid a bias. Other ratios, and components one or two samples wide, replicate samples.

use super::super::handling::Fault;
use super::header::{Component, Frame};
use super::scan::Plane;

/// The upsampling method of a component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Upsampling {
    /// Triangle filter along x, along y or along both.
    Triangle { x: bool, y: bool },
    /// Replication by these factors along x and y.
    Repeat([usize; 2]),
}

impl Upsampling {
    fn of(frame: &Frame, component: &Component) -> Result<Self, Fault> {
        let [x, y] = [0, 1].map(|axis| {
            let (max, factor) = (
                frame.sampling_factors[axis],
                component.sampling_factors[axis],
            );
            max.is_multiple_of(factor).then_some(max / factor)
        });
        let (Some(x), Some(y)) = (x, y) else {
            return Err("the resolutions of its channels do not divide each other".to_owned());
        };
        let is_wide = component.size[0] > 2;
        Ok(match (x, y) {
            (2, 1 | 2) if is_wide => Upsampling::Triangle { x: true, y: y == 2 },
            (1, 2) => Upsampling::Triangle { x: false, y: true },
            _ => Upsampling::Repeat([x, y]),
        })
    }
}

/// Interleaved bytes of all pixels. `convert` appends one row of pixels, given a row of samples per component.
pub(super) fn pixels(
    frame: &Frame,
    planes: &[Plane],
    convert: impl Fn(&[&[u8]], &mut Vec<u8>),
) -> Result<Vec<u8>, Fault> {
    let [width, height] = [frame.width, frame.height].map(usize::from);
    let methods: Result<Vec<Upsampling>, Fault> = frame
        .components
        .iter()
        .map(|component| Upsampling::of(frame, component))
        .collect();
    let methods = methods?;
    let mut upsampled_rows = vec![Vec::new(); planes.len()];
    let mut out = Vec::with_capacity(width * height * planes.len());
    for y in 0..height {
        let components = frame.components.iter().zip(planes).zip(&methods);
        for (((component, plane), method), row) in components.zip(&mut upsampled_rows) {
            row.clear();
            method.row(component, plane, y, row);
        }
        let pixel_rows: Vec<&[u8]> = upsampled_rows.iter().map(|row| &row[..width]).collect();
        convert(&pixel_rows, &mut out);
    }
    Ok(out)
}

impl Upsampling {
    /// Appends row `y` at full resolution; it may be longer than the image is wide.
    fn row(self, component: &Component, plane: &Plane, y: usize, out: &mut Vec<u8>) {
        let [width, height] = component.size;
        let samples = |row: usize| {
            let from = row.min(height - 1) * plane.stride;
            &plane.samples[from..from + width]
        };
        match self {
            Upsampling::Repeat([1, repeat_y]) => out.extend(samples(y / repeat_y)),
            Upsampling::Repeat([repeat_x, repeat_y]) => {
                for sample in samples(y / repeat_y) {
                    out.extend(std::iter::repeat_n(sample, repeat_x));
                }
            }
            Upsampling::Triangle { x: true, y: false } => {
                let row = samples(y).iter().map(|sample| u16::from(*sample));
                upsample_row(row, 1, [1, 2], out);
            }
            Upsampling::Triangle { x, .. } => {
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
                    upsample_row(sums, 4, [8, 7], out);
                } else {
                    let bias = if is_upper { 1 } else { 2 };
                    out.extend(sums.map(|sum| divide_to_byte(sum + bias, 4)));
                }
            }
        }
    }
}

/// Upsamples a row by two with the triangle filter. The samples are scaled by `scale`; `left_bias` and `right_bias` are
/// the rounding terms of the left and right pixel of a sample.
fn upsample_row(
    row: impl Iterator<Item = u16>,
    scale: u16,
    [left_bias, right_bias]: [u16; 2],
    out: &mut Vec<u8>,
) {
    let mut row = row.peekable();
    let mut previous = None;
    while let Some(sample) = row.next() {
        let following = row.peek().copied();
        // At the ends the sample is its own neighbour.
        let weighted = |neighbour: Option<u16>| 3 * sample + neighbour.unwrap_or(sample);
        out.push(divide_to_byte(weighted(previous) + left_bias, 4 * scale));
        out.push(divide_to_byte(weighted(following) + right_bias, 4 * scale));
        previous = Some(sample);
    }
}

fn divide_to_byte(sum: u16, divisor: u16) -> u8 {
    u8::try_from(sum / divisor).unwrap_or(u8::MAX)
}
