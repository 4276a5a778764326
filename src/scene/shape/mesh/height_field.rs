//! `height_field { [type] "file" [smooth] [water_level height] }`: a landscape over the unit square, the heights of
//! which are the pixels of a picture.
//!
//! A ray is followed through squares of cells and then cell by cell (Musgrave 1988, "Grid tracing"). Each cell is two
//! triangles, on which the height above the ground changes evenly along the ray, so a change of its sign is a hit. Error
//! bound: roots lie within 2 roundings of the problem's size from the surface (`tests/stability`, item 51); neighbours share
//! the sign at the line between them, so no ray slips through (item 52).
//!
//! In CSG it is the column below the surface, without end: POV-Ray counts all that lies lower as inside, and so too
//! all below the water level. Of that only the surface above the water can be seen.
//!
//! The normals of a smooth one are 16-bit integers in POV-Ray, and are turned into the world before they are mixed;
//! both shows in the picture.

mod image;
mod steps;
mod walk;

use crate::base::args::{Args, Parse, Word};
use crate::base::math::{Bounds, Ray, Step, Transform, normal_from_inverse};
use crate::base::source::Diagnostic;
use crate::scene::shape::{Geometry, Root, Start, read};
use glam::{DVec3, Vec3};
use image::{Kind, Reading};
use std::sync::{Arc, OnceLock};

/// Heights of one unit.
const HEIGHT: f64 = 65536.0;
/// Two triangles of each cell have numbers, and the walls and the water two more.
const MOST_CELLS: usize = (1 << 31) - 2;
/// The normals of a smooth height field are kept in so many steps.
const NORMAL_STEPS: f64 = 32767.0;
/// Of larger pictures the normals are not kept: those of this many pixels take 48 megabytes.
const MOST_NORMALS: usize = 1 << 22;
/// The walls around the solid, which cannot be seen.
const WALL: u32 = u32::MAX;
/// The water level, which cannot be seen.
const WATER: u32 = u32::MAX - 1;

/// A landscape. Copies share the heights.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightField {
    field: Arc<Field>,
    place: Box<Transform>,
}

/// The heights. Its space has cells of size one, and heights in steps of the picture.
#[derive(Clone, Debug, PartialEq)]
struct Field {
    /// Cells along x and along z.
    cells: [usize; 2],
    /// Rows of `cells[0] + 1` heights, from z = 0 on.
    heights: Vec<u16>,
    /// Least and largest height of squares of `square` by `square` cells, in rows.
    squares: Vec<[u16; 2]>,
    square: usize,
    squares_along_x: usize,
    water: f64,
    /// The range of heights that can be seen.
    low: f64,
    high: f64,
    is_smooth: bool,
    normals: Normals,
}

/// The normals at the pixels of a smooth field, square by square, as they are first asked for.
#[derive(Clone, Debug)]
struct Normals(Vec<OnceLock<Box<[Vec3]>>>);

impl PartialEq for Normals {
    /// They follow from the heights.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl HeightField {
    /// Reads the picture and the words of the height field.
    ///
    /// # Errors
    /// A picture that is missing, damaged, too large or of an unknown kind; a malformed or non-finite parameter.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let heights = match args.sampled()? {
            Some(sampled) => image::Heights::of_function(&sampled),
            None => read_picture(args)?,
        };
        let mut is_smooth = false;
        let mut water = 0.0;
        loop {
            if args.accept(Word::Smooth)? {
                is_smooth = true;
            } else if args.accept(Word::WaterLevel)? {
                water = read::number(args, "the water level of the height field")?;
            } else if args.accept(Word::Hierarchy)? {
                args.float_or(1.0)?;
            } else {
                break;
            }
        }
        Ok(HeightField {
            field: Arc::new(Field::new(heights, water * HEIGHT, is_smooth)),
            place: Box::new(Transform::IDENTITY),
        })
    }

    /// The ray in the space of the heights.
    fn to_field(&self, ray: &Ray) -> Ray {
        let local = ray.to_object(&self.place.object_from_world);
        let scale = self.field.scale();
        Ray::new(local.origin * scale, local.dir * scale)
    }

    fn point_to_field(&self, point: DVec3) -> DVec3 {
        self.place.object_from_world.transform_point3(point) * self.field.scale()
    }

    /// A normal of the space of the heights, turned into the world.
    fn to_world(&self, normal: DVec3) -> DVec3 {
        normal_from_inverse(&self.place.object_from_world, normal * self.field.scale())
    }

    fn first(&self, ray: &Ray, from: f64, to: f64, but: u32) -> Option<Root> {
        let mut found = None;
        self.field
            .walk(&self.to_field(ray), (from, to), &mut |root| {
                if root.is_visible && root.face != but && from < root.t && root.t < to {
                    found = Some(root);
                }
                found.is_none() && root.t < to
            });
        found
    }
}

fn read_picture(args: &mut dyn Args) -> Parse<image::Heights> {
    let written = match args.word()? {
        Some(word) => image::KINDS.iter().find(|kind| kind.word == word),
        None => None,
    };
    if let Some(kind) = written {
        if kind.reading == Reading::NotBuilt {
            return Err(crate::base::args::not_built(args, kind.word));
        }
        args.accept(kind.word)?;
    }
    let name = args.string()?;
    let at = args.last_span();
    let kind = match written {
        Some(kind) => kind,
        None => kind_of_name(&name).ok_or_else(|| {
            Diagnostic::error(at, format!("the kind of the picture `{name}` is unknown"))
                .with_hint("write it before the name: `height_field { png \"name\" }`")
        })?,
    };
    if kind.reading == Reading::NotBuilt {
        let message = format!("a height field of a `{}` file is not built yet", kind.word);
        return Err(Box::new(
            Diagnostic::error(at, message).with_hint("convert the picture to `png`"),
        ));
    }
    let bytes = args.file_named("the picture", &name, kind.endings)?;
    let fault = |fault| Box::new(Diagnostic::error(at, fault));
    let unreadable = |why| fault(format!("cannot read the picture `{name}`: {why}"));
    let wanted = image::bytes_to_read(kind.reading, &bytes).map_err(unreadable)?;
    args.make_room("this picture", wanted, at)?;
    let heights = image::heights(kind.reading, &bytes).map_err(unreadable)?;
    if heights.rows.len() >= MOST_CELLS {
        let most = MOST_CELLS;
        return Err(fault(format!("a height field has at most {most} pixels")));
    }
    for word in [Word::Gamma, Word::Premultiplied] {
        if args.word()? == Some(word) {
            return Err(crate::base::args::not_built(args, word));
        }
    }
    Ok(heights)
}

fn kind_of_name(name: &str) -> Option<&'static Kind> {
    let mut kinds = image::KINDS.iter();
    kinds.find(|kind| kind.endings.iter().any(|ending| name.ends_with(ending)))
}

impl Field {
    fn new(picture: image::Heights, water: f64, is_smooth: bool) -> Self {
        let width = picture.width.max(1);
        let rows = picture.rows.len() / width;
        let heights: Vec<u16> = picture
            .rows
            .chunks_exact(width)
            .rev()
            .flatten()
            .copied()
            .collect();
        let cells = [width - 1, rows.saturating_sub(1)];
        let square = match cells[0].max(cells[1]) {
            0..128 => 4,
            128..512 => 8,
            512..2048 => 16,
            _ => 32,
        };
        let mut field = Field {
            cells,
            squares: Vec::new(),
            square,
            squares_along_x: cells[0].div_ceil(square),
            water,
            low: heights
                .iter()
                .min()
                .map_or(0.0, |low| f64::from(*low))
                .max(water),
            high: heights.iter().max().map_or(0.0, |high| f64::from(*high)),
            heights,
            is_smooth,
            normals: Normals(Vec::new()),
        };
        for row in 0..cells[1].div_ceil(square) {
            for column in 0..field.squares_along_x {
                field
                    .squares
                    .push(field.range(row * square, column * square));
            }
        }
        if is_smooth && field.heights.len() <= MOST_NORMALS {
            let unknown = field.squares.iter().map(|_| OnceLock::new());
            field.normals = Normals(unknown.collect());
        }
        field
    }

    /// Least and largest height of the square of cells that begins here.
    fn range(&self, z: usize, x: usize) -> [u16; 2] {
        let mut range = [u16::MAX, 0];
        for z in z..=(z + self.square).min(self.cells[1]) {
            for x in x..=(x + self.square).min(self.cells[0]) {
                let height = self.heights[z * (self.cells[0] + 1) + x];
                range = [range[0].min(height), range[1].max(height)];
            }
        }
        range
    }

    fn is_empty(&self) -> bool {
        self.cells.contains(&0)
    }

    /// The size of its space in units of the object.
    #[allow(clippy::cast_precision_loss, reason = "counts of pixels are exact")]
    fn scale(&self) -> DVec3 {
        DVec3::new(self.cells[0] as f64, HEIGHT, self.cells[1] as f64)
    }

    fn height(&self, x: usize, z: usize) -> f64 {
        f64::from(self.heights[z * (self.cells[0] + 1) + x])
    }

    /// The least and the most height at the corners of a cell.
    #[inline]
    fn heights_of(&self, x: usize, z: usize) -> [u16; 2] {
        let across = self.cells[0] + 1;
        let at = z * across + x;
        let [near, far] = [at, at + across].map(|at| &self.heights[at..at + 2]);
        let (low, high) = (near[0].min(near[1]), near[0].max(near[1]));
        [low.min(far[0]).min(far[1]), high.max(far[0]).max(far[1])]
    }

    /// The cell of a face, and whether it is the triangle away from the origin.
    fn cell(&self, face: u32) -> (usize, usize, bool) {
        let cell = (face / 2) as usize;
        (cell % self.cells[0], cell / self.cells[0], face % 2 == 1)
    }

    /// The upward normal of a triangle.
    fn flat_normal(&self, face: u32) -> DVec3 {
        if face >= WATER {
            return DVec3::Y;
        }
        let (x, z, is_far) = self.cell(face);
        let (right, up) = (self.height(x + 1, z), self.height(x, z + 1));
        if is_far {
            let corner = self.height(x + 1, z + 1);
            DVec3::new(up - corner, 1.0, right - corner)
        } else {
            let corner = self.height(x, z);
            DVec3::new(corner - right, 1.0, corner - up)
        }
    }

    /// The mean normals at the corners of a cell: of one row along x, and of the next.
    fn corner_normals(&self, x: usize, z: usize) -> [[DVec3; 2]; 2] {
        let (square, bits) = (self.square, self.square.trailing_zeros());
        let number = (z >> bits) * self.squares_along_x + (x >> bits);
        let Some(normals) = self.normals.0.get(number) else {
            return [0, 1].map(|dz| [0, 1].map(|dx| self.pixel_normal(x + dx, z + dz)));
        };
        let (first_x, first_z) = (x >> bits << bits, z >> bits << bits);
        let across = (self.cells[0] - first_x).min(square) + 1;
        let normals = normals.get_or_init(|| {
            let rows = first_z..=(first_z + square).min(self.cells[1]);
            let pixels = rows.flat_map(|z| (0..across).map(move |x| (first_x + x, z)));
            // Single precision holds them as they are: they are whole, and short.
            pixels
                .map(|(x, z)| self.pixel_normal(x, z).as_vec3())
                .collect()
        });
        let at = (z - first_z) * across + x - first_x;
        let [near, far] = [at, at + across].map(|at| &normals[at..at + 2]);
        [near, far].map(|row| [row[0].as_dvec3(), row[1].as_dvec3()])
    }

    /// The mean normal at a pixel, as coarse as POV-Ray keeps it.
    fn pixel_normal(&self, x: usize, z: usize) -> DVec3 {
        let here = self.height(x, z);
        let right = (x < self.cells[0]).then(|| here - self.height(x + 1, z));
        let left = (x > 0).then(|| self.height(x - 1, z) - here);
        let up = (z < self.cells[1]).then(|| here - self.height(x, z + 1));
        let down = (z > 0).then(|| self.height(x, z - 1) - here);
        let mut sum = DVec3::ZERO;
        for (along_x, along_z) in [(right, up), (left, up), (left, down), (right, down)] {
            if let (Some(x), Some(z)) = (along_x, along_z) {
                sum += DVec3::new(x, 1.0, z).normalize();
            }
        }
        (sum.normalize() * NORMAL_STEPS).trunc()
    }
}

impl Geometry for HeightField {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        let everywhere = (f64::NEG_INFINITY, f64::INFINITY);
        self.field
            .walk(&self.to_field(ray), everywhere, &mut |root| {
                roots.push(root);
                true
            })
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        self.first(ray, from, to, WALL)
    }

    fn nearest_beside(&self, ray: &Ray, from: f64, to: f64, face: u32) -> Option<Root> {
        self.first(ray, from, to, face)
    }

    fn normal(&self, _: DVec3, face: u32) -> DVec3 {
        self.to_world(self.field.flat_normal(face))
    }

    fn shading_normal(&self, point: DVec3, face: u32) -> Option<DVec3> {
        if !self.field.is_smooth || face >= WATER {
            return None;
        }
        let (x, z, _) = self.field.cell(face);
        let at = self.point_to_field(point);
        #[allow(clippy::cast_precision_loss, reason = "counts of pixels are exact")]
        let (u, v) = (
            (at.x - x as f64).clamp(0.0, 1.0),
            (at.z - z as f64).clamp(0.0, 1.0),
        );
        let [near, far] = self.field.corner_normals(x, z);
        let corner = |normal: DVec3| self.to_world(normal).normalize_or_zero();
        let low = (1.0 - u) * corner(near[0]) + u * corner(near[1]);
        let high = (1.0 - u) * corner(far[0]) + u * corner(far[1]);
        Some((1.0 - v) * low + v * high)
    }

    fn contains(&self, point: DVec3) -> bool {
        self.field.contains(self.point_to_field(point))
    }

    fn bounds(&self) -> Bounds {
        let field = &self.field;
        if field.is_empty() || field.low > field.high {
            return Bounds::EMPTY;
        }
        let bounds = Bounds {
            min: DVec3::new(0.0, field.low / HEIGHT, 0.0),
            max: DVec3::new(1.0, field.high / HEIGHT, 1.0),
        };
        bounds.transformed(&self.place.world_from_object)
    }

    fn solid_bounds(&self) -> Bounds {
        Bounds::EVERYTHING
    }

    fn reaches_out(&self) -> bool {
        true
    }

    fn absorb(&mut self, step: &Step) -> bool {
        *self.place = self.place.then(&step.transform());
        true
    }

    fn is_faceted(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests;
