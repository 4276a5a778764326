//! `density_file df3`: a grid of samples in the unit cube.
//!
//! The file holds the three sizes, two bytes each, and then the samples, x running fastest. Samples have one, two or
//! four bytes, which follows from the length of the file. All numbers are big-endian. Samples are at the lower corners
//! of their cells.

use crate::base::args::{Args, Parse, Word};
use crate::base::source::Diagnostic;
use crate::scene::pattern::{Pattern, PatternEval, PrepareContext, SurfacePoint};
use glam::DVec3;
use std::sync::Arc;

/// Bytes of the header, which holds the three sizes.
const HEADER: usize = 6;

/// `interpolate`: the interpolation between samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Interpolation {
    /// 0: the sample of the cell.
    None,
    /// 1: linear along each axis.
    Trilinear,
    /// 2: Catmull-Rom splines along each axis.
    Tricubic,
}

#[derive(Clone, Debug)]
struct DensityFile {
    grid: Arc<Grid>,
    interpolation: Interpolation,
}

/// The samples of a file.
#[derive(Debug)]
struct Grid {
    size: [usize; 3],
    cells: Cells,
}

#[derive(Debug)]
enum Cells {
    Bytes(Vec<u8>),
    Words(Vec<u16>),
    Longs(Vec<u32>),
}

pub(crate) fn new(args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    if !args.accept(Word::Df3)? {
        return Err(args.expected("`df3` after `density_file`"));
    }
    let (_, bytes) = args.file("the density file", &[".df3", ".DF3"])?;
    let Some(grid) = Grid::new(&bytes) else {
        let message = "this is not a density file: its length does not match the sizes it states";
        return Err(Box::new(Diagnostic::error(args.last_span(), message)));
    };
    Ok(Box::new(DensityFile {
        grid: Arc::new(grid),
        interpolation: Interpolation::None,
    }))
}

impl Pattern for DensityFile {
    fn prepare(&self, _context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(self.clone())
    }

    fn sample_counts(&self) -> Option<DVec3> {
        Some(DVec3::from(self.grid.size.map(|count| count as f64)))
    }

    fn read_modifier(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        if word != Word::Interpolate {
            return Ok(false);
        }
        args.accept(word)?;
        // The last digit counts (measured with POV-Ray 3.7).
        self.interpolation = match args.float()?.trunc() % 10.0 {
            0.0 => Interpolation::None,
            1.0 => Interpolation::Trilinear,
            _ => Interpolation::Tricubic,
        };
        Ok(true)
    }
}

impl PatternEval for DensityFile {
    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        let is_inside = |c: f64| (0.0..1.0).contains(&c);
        if !point.to_array().into_iter().all(is_inside) {
            return 0.0;
        }
        match self.interpolation {
            Interpolation::None => {
                let [x, y, z] = [0, 1, 2].map(|axis| split(point[axis], self.grid.size[axis]).0);
                self.grid.sample(x, y, z)
            }
            Interpolation::Trilinear => self.grid.trilinear(point),
            Interpolation::Tricubic => self.grid.tricubic(point),
        }
    }
}

impl Grid {
    fn new(bytes: &[u8]) -> Option<Self> {
        let (header, samples) = bytes.split_at_checked(HEADER)?;
        let size =
            [0, 2, 4].map(|at| usize::from(u16::from_be_bytes([header[at], header[at + 1]])));
        let count = size.iter().product::<usize>();
        if count == 0 {
            return None;
        }
        let words = |b: &[u8]| u16::from_be_bytes([b[0], b[1]]);
        let longs = |b: &[u8]| u32::from_be_bytes([b[0], b[1], b[2], b[3]]);
        let cells = match samples.len() / count {
            0 => return None,
            1 => Cells::Bytes(samples[..count].to_vec()),
            2 | 3 => Cells::Words(samples.chunks_exact(2).take(count).map(words).collect()),
            _ => Cells::Longs(samples.chunks_exact(4).take(count).map(longs).collect()),
        };
        Some(Grid { size, cells })
    }

    /// The sample of a cell, from 0 to 1; indices wrap around.
    fn sample(&self, x: usize, y: usize, z: usize) -> f64 {
        let [nx, ny, nz] = self.size;
        let at = ((z % nz) * ny + y % ny) * nx + x % nx;
        match &self.cells {
            Cells::Bytes(cells) => f64::from(cells[at]) / 255.0,
            Cells::Words(cells) => f64::from(cells[at]) / 65535.0,
            Cells::Longs(cells) => f64::from(cells[at]) / 4_294_967_295.0,
        }
    }

    fn trilinear(&self, point: DVec3) -> f64 {
        let [(x, fx), (y, fy), (z, fz)] = [0, 1, 2].map(|axis| split(point[axis], self.size[axis]));
        let along_x = |y, z| mix(fx, self.sample(x, y, z), self.sample(x + 1, y, z));
        let along_y = |z| mix(fy, along_x(y, z), along_x(y + 1, z));
        mix(fz, along_y(z), along_y(z + 1))
    }

    /// Interpolates in single precision, as POV-Ray does; negative results of the splines become 0.
    #[allow(
        clippy::cast_possible_truncation,
        reason = "single precision is wanted here"
    )]
    fn tricubic(&self, point: DVec3) -> f64 {
        let [(x, fx), (y, fy), (z, fz)] = [0, 1, 2].map(|axis| split(point[axis], self.size[axis]));
        let xs = neighbours(x, self.size[0]);
        let ys = neighbours(y, self.size[1]);
        let zs = neighbours(z, self.size[2]);
        let along_z = |x, y| {
            let of_cell = |z| self.sample(x, y, z) as f32;
            catmull_rom(zs.map(of_cell), fz as f32)
        };
        let along_y = |x| catmull_rom(ys.map(|y| along_z(x, y)), fy as f32);
        f64::from(catmull_rom(xs.map(along_y), fx as f32).max(0.0))
    }
}

/// The cell that contains a coordinate from 0 to 1, and the fractional position in the cell.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the coordinate is below 1 and the size below 65536"
)]
fn split(coordinate: f64, size: usize) -> (usize, f64) {
    let at = coordinate * size as f64;
    let cell = at.floor();
    (cell as usize, at - cell)
}

/// Indices of a cell, the one before and the two after it. For the cell before the first, POV-Ray wraps around an
/// unsigned 64-bit number, which gives the last cell only if the size is a power of two.
fn neighbours(cell: usize, size: usize) -> [usize; 4] {
    let before = match cell.checked_sub(1) {
        Some(before) => before,
        None => usize::MAX % size,
    };
    [before, cell, cell + 1, cell + 2]
}

fn mix(t: f64, from: f64, to: f64) -> f64 {
    from * (1.0 - t) + to * t
}

/// The Catmull-Rom spline between the middle two of four values.
fn catmull_rom(v: [f32; 4], t: f32) -> f32 {
    let [a, b, c, d] = v;
    0.5 * (2.0 * b
        + (c - a) * t
        + (2.0 * a - 5.0 * b + 4.0 * c - d) * t * t
        + (3.0 * b - 3.0 * c + d - a) * t * t * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(samples: &[u8]) -> Option<Grid> {
        let mut bytes = vec![0, 2, 0, 1, 0, 1];
        bytes.extend(samples);
        Grid::new(&bytes)
    }

    #[test]
    fn the_file_length_determines_the_sample_size() {
        assert_eq!(grid(&[0, 255]).unwrap().sample(1, 0, 0), 1.0);
        assert_eq!(grid(&[0, 0, 255, 255]).unwrap().sample(1, 0, 0), 1.0);
        let longs = grid(&[0, 0, 0, 0, 255, 255, 255, 255]).unwrap();
        assert_eq!(longs.sample(1, 0, 0), 1.0);
        assert!(grid(&[0]).is_none() && Grid::new(&[0; 6]).is_none() && Grid::new(&[1]).is_none());
    }

    #[test]
    fn samples_are_at_the_lower_corners_and_wrap() {
        let grid = grid(&[0, 255]).unwrap();
        let at = |x| grid.trilinear(DVec3::new(x, 0.0, 0.0));
        assert_eq!((at(0.0), at(0.25), at(0.5), at(0.75)), (0.0, 0.5, 1.0, 0.5));
    }

    #[test]
    fn splines_interpolate_their_samples() {
        assert_eq!(catmull_rom([0.0, 1.0, 2.0, 3.0], 0.0), 1.0);
        assert_eq!(catmull_rom([0.0, 1.0, 2.0, 3.0], 1.0), 2.0);
        assert_eq!(neighbours(0, 4)[0], 3);
        assert_eq!(neighbours(0, 3)[0], 0);
    }
}
