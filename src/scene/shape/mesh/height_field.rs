//! `height_field { [type] "file" [gamma g] [smooth] [water_level height] }`: a landscape over the unit square, with its
//! heights from the pixels of an image.
//!
//! A ray is traced through blocks of cells and then cell by cell (Musgrave 1988, "Grid tracing"). Each cell is two
//! triangles, on each of which the height of the ray above the ground is linear in `t`, so a change of its sign is a
//! hit. Error bound: roots lie within 2 roundings of the problem's size from the surface (`tests/stability`);
//! neighbouring triangles share the sign at their common edge, so no ray slips through.
//!
//! In CSG it is the infinite column below the surface: POV-Ray counts everything lower as inside, also everything below
//! the water level. Only the surface above the water is visible.
//!
//! Smooth normals are 16-bit integers in POV-Ray, and are transformed to the world before they are interpolated; both
//! are visible in the image.

mod image;
mod rounded;
mod steps;
mod walk;

use crate::base::args::{Args, Parse, Word};
use crate::base::bitmap;
use crate::base::color::Gamma;
use crate::base::derived::Derived;
use crate::base::math::{Bounds, Ray, Step, Transform, normal_from_inverse};
use crate::base::source::Diagnostic;
use crate::scene::shape::{Geometry, Root, Rounded, Start, Steps, read};
use glam::{DAffine3, DVec3, Vec3};
use image::{Decoder, Kind, Samples};
pub(in crate::scene::shape) use rounded::RoundedField;
use std::sync::Arc;

/// Height steps per unit.
const HEIGHT: f64 = 65536.0;
/// The steps by which POV-Ray's box is higher and lower than the field.
const BOX_MARGIN: f64 = 1e-3;
/// Face numbers are 32 bits: two triangles per cell, the walls and the water.
const MAX_CELLS: usize = (1 << 31) - 2;
/// Quantisation steps of the components of a smooth normal.
const NORMAL_STEPS: f64 = 32767.0;
/// Normals of larger images are not cached: those of this many pixels take 48 megabytes.
const MAX_CACHED_NORMALS: usize = 1 << 22;
/// Face of the walls around the solid, which are invisible.
const WALL: u32 = u32::MAX;
/// Face of the water level, which is invisible.
const WATER: u32 = u32::MAX - 1;

/// A height field. Copies share the heights.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightField {
    field: Arc<Field>,
    transform: Box<Transform>,
}

/// The heights. In field space, cells have size one and heights are in steps of the image.
#[derive(Clone, Debug, PartialEq)]
struct Field {
    /// Number of cells along x and along z.
    cells: [usize; 2],
    /// Rows of `cells[0] + 1` heights, from z = 0 on.
    heights: Vec<u16>,
    /// Least and greatest height of each block of `block_size` by `block_size` cells, in rows.
    block_ranges: Vec<[u16; 2]>,
    block_size: usize,
    blocks_along_x: usize,
    water: f64,
    /// The range of visible heights.
    low: f64,
    high: f64,
    is_smooth: bool,
    normals: Normals,
}

/// Normals at the pixels of a smooth field, block by block.
#[derive(Clone, Debug, PartialEq)]
struct Normals(Vec<Derived<Box<[Vec3]>>>);

impl HeightField {
    /// Reads the image and the keywords of the height field.
    ///
    /// # Errors
    /// An image that is missing, damaged, too large or of an unknown kind; a malformed or non-finite parameter.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let heights = match args.sampled_function()? {
            Some(sampled) => image::Heights::from_function(&sampled, args.is_for_3_8()),
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
            transform: Box::new(Transform::IDENTITY),
        })
    }

    /// Transforms a ray to field space.
    fn to_field(&self, ray: &Ray) -> Ray {
        let local = ray.to_object(&self.transform.object_from_world);
        let scale = self.field.scale();
        Ray::new(local.origin * scale, local.dir * scale)
    }

    fn point_to_field(&self, point: DVec3) -> DVec3 {
        self.transform.object_from_world.transform_point3(point) * self.field.scale()
    }

    /// Transforms a normal from field space to the world.
    fn to_world(&self, normal: DVec3) -> DVec3 {
        normal_from_inverse(
            &self.transform.object_from_world,
            normal * self.field.scale(),
        )
    }

    fn first_hit(&self, ray: &Ray, from: f64, to: f64, skip: u32) -> Option<Root> {
        let mut hit = None;
        self.field
            .traverse(&self.to_field(ray), from, to, &mut |root| {
                if root.is_visible && root.face != skip && from < root.t && root.t < to {
                    hit = Some(root);
                }
                hit.is_none() && root.t < to
            });
        hit
    }
}

fn read_picture(args: &mut dyn Args) -> Parse<image::Heights> {
    let keyword = match args.word()? {
        Some(word) => image::KINDS.iter().find(|kind| kind.word == word),
        None => None,
    };
    if let Some(kind) = keyword {
        if kind.decoder == Decoder::Unsupported {
            return Err(crate::base::args::not_built(args, kind.word));
        }
        args.accept(kind.word)?;
    }
    let name = args.string()?;
    let at = args.last_span();
    let kind = match keyword {
        Some(kind) => kind,
        None => kind_of_name(&name).ok_or_else(|| {
            Diagnostic::error(
                at,
                format!("cannot tell the image format from the file name `{name}`"),
            )
            .with_hint("Write it before the name: `height_field { png \"name\" }`.")
        })?,
    };
    if kind.decoder == Decoder::Unsupported {
        let message = format!(
            "a height field of a `{}` file is not supported yet",
            kind.word
        );
        return Err(Box::new(
            Diagnostic::error(at, message).with_hint("Convert the image to `png`."),
        ));
    }
    let bytes = args.file_named("the image", &name, kind.endings)?;
    let error = |error| Box::new(Diagnostic::error(at, error));
    let unreadable = |why| error(format!("cannot read the image `{name}`: {why}"));
    let needed = image::bytes_to_read(kind.decoder, &bytes).map_err(unreadable)?;
    args.reserve_memory("this image", needed, at)?;
    let samples = Samples {
        gamma: read_gamma(args)?,
        is_3_8: args.is_for_3_8(),
    };
    let heights = image::heights(kind.decoder, &bytes, samples).map_err(unreadable)?;
    if heights.rows.len() >= MAX_CELLS {
        let max = MAX_CELLS;
        return Err(error(format!("a height field has at most {max} pixels")));
    }
    Ok(heights)
}

/// Reads `gamma g` and `premultiplied`, which has no effect, in any order.
fn read_gamma(args: &mut dyn Args) -> Parse<Gamma> {
    let mut gamma = Gamma::LINEAR;
    loop {
        if args.accept(Word::Gamma)? {
            gamma = bitmap::read_gamma(Word::Gamma, args)?;
        } else if args.accept(Word::Premultiplied)? {
            args.float()?;
        } else {
            return Ok(gamma);
        }
    }
}

fn kind_of_name(name: &str) -> Option<&'static Kind> {
    let mut kinds = image::KINDS.iter();
    kinds.find(|kind| kind.endings.iter().any(|ending| name.ends_with(ending)))
}

impl Field {
    fn new(image_heights: image::Heights, water: f64, is_smooth: bool) -> Self {
        let width = image_heights.width.max(1);
        let rows = image_heights.rows.len() / width;
        let heights: Vec<u16> = image_heights
            .rows
            .chunks_exact(width)
            .rev()
            .flatten()
            .copied()
            .collect();
        let cells = [width - 1, rows.saturating_sub(1)];
        let block_size = match cells[0].max(cells[1]) {
            0..128 => 4,
            128..512 => 8,
            512..2048 => 16,
            _ => 32,
        };
        let mut field = Field {
            cells,
            block_ranges: Vec::new(),
            block_size,
            blocks_along_x: cells[0].div_ceil(block_size),
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
        for row in 0..cells[1].div_ceil(block_size) {
            for column in 0..field.blocks_along_x {
                field
                    .block_ranges
                    .push(field.range(row * block_size, column * block_size));
            }
        }
        if is_smooth && field.heights.len() <= MAX_CACHED_NORMALS {
            let uncached = field.block_ranges.iter().map(|_| Derived::default());
            field.normals = Normals(uncached.collect());
        }
        field
    }

    /// Least and greatest height of the block of cells that begins here.
    fn range(&self, z: usize, x: usize) -> [u16; 2] {
        let mut range = [u16::MAX, 0];
        for z in z..=(z + self.block_size).min(self.cells[1]) {
            for x in x..=(x + self.block_size).min(self.cells[0]) {
                let height = self.heights[z * (self.cells[0] + 1) + x];
                range = [range[0].min(height), range[1].max(height)];
            }
        }
        range
    }

    fn is_empty(&self) -> bool {
        self.cells.contains(&0)
    }

    /// Scale from object space to field space.
    #[allow(clippy::cast_precision_loss, reason = "counts of pixels are exact")]
    fn scale(&self) -> DVec3 {
        DVec3::new(self.cells[0] as f64, HEIGHT, self.cells[1] as f64)
    }

    #[inline(always)]
    fn height(&self, x: usize, z: usize) -> f64 {
        f64::from(self.heights[z * (self.cells[0] + 1) + x])
    }

    /// Least and greatest height at the corners of a cell.
    #[inline(always)]
    fn heights_of(&self, x: usize, z: usize) -> [u16; 2] {
        let row_length = self.cells[0] + 1;
        let index = z * row_length + x;
        // Written out: `map` is not always inlined.
        let near = &self.heights[index..index + 2];
        let far = &self.heights[index + row_length..index + row_length + 2];
        let (low, high) = (near[0].min(near[1]), near[0].max(near[1]));
        [low.min(far[0]).min(far[1]), high.max(far[0]).max(far[1])]
    }

    /// The cell of a face, and true for the triangle away from the origin.
    #[inline(always)]
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

    /// Averaged normals at the corners of a cell: two of its row along x, and two of the next row.
    fn corner_normals(&self, x: usize, z: usize) -> [[DVec3; 2]; 2] {
        let (block_size, shift) = (self.block_size, self.block_size.trailing_zeros());
        let block = (z >> shift) * self.blocks_along_x + (x >> shift);
        let Some(normals) = self.normals.0.get(block) else {
            return [0, 1].map(|dz| [0, 1].map(|dx| self.pixel_normal(x + dx, z + dz)));
        };
        let (first_x, first_z) = (x >> shift << shift, z >> shift << shift);
        let row_length = (self.cells[0] - first_x).min(block_size) + 1;
        let normals = normals.get_or_init(|| {
            let rows = first_z..=(first_z + block_size).min(self.cells[1]);
            let pixels = rows.flat_map(|z| (0..row_length).map(move |x| (first_x + x, z)));
            // Single precision is exact here: the components are 16-bit integers.
            pixels
                .map(|(x, z)| self.pixel_normal(x, z).as_vec3())
                .collect()
        });
        let index = (z - first_z) * row_length + x - first_x;
        let [near, far] = [index, index + row_length].map(|index| &normals[index..index + 2]);
        [near, far].map(|row| [row[0].as_dvec3(), row[1].as_dvec3()])
    }

    /// The mixture of the normals at the corners of a cell, each taken to the world before; `None` if the field or the
    /// face is not smooth.
    #[allow(clippy::cast_precision_loss, reason = "counts of pixels are exact")]
    #[inline]
    fn smooth_normal(
        &self,
        at: DVec3,
        face: u32,
        to_world: impl Fn(DVec3) -> DVec3,
    ) -> Option<DVec3> {
        if !self.is_smooth || face >= WATER {
            return None;
        }
        let (x, z, _) = self.cell(face);
        let u = (at.x - x as f64).clamp(0.0, 1.0);
        let v = (at.z - z as f64).clamp(0.0, 1.0);
        let [near, far] = self.corner_normals(x, z);
        let near_normal = (1.0 - u) * to_world(near[0]) + u * to_world(near[1]);
        let far_normal = (1.0 - u) * to_world(far[0]) + u * to_world(far[1]);
        Some((1.0 - v) * near_normal + v * far_normal)
    }

    /// The averaged normal at a pixel, quantised as in POV-Ray.
    fn pixel_normal(&self, x: usize, z: usize) -> DVec3 {
        let centre = self.height(x, z);
        let right = (x < self.cells[0]).then(|| centre - self.height(x + 1, z));
        let left = (x > 0).then(|| self.height(x - 1, z) - centre);
        let up = (z < self.cells[1]).then(|| centre - self.height(x, z + 1));
        let down = (z > 0).then(|| self.height(x, z - 1) - centre);
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
        let (from, to) = (f64::NEG_INFINITY, f64::INFINITY);
        self.field
            .traverse(&self.to_field(ray), from, to, &mut |root| {
                roots.push(root);
                true
            })
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        self.first_hit(ray, from, to, WALL)
    }

    fn nearest_beside(&self, ray: &Ray, from: f64, to: f64, face: u32) -> Option<Root> {
        self.first_hit(ray, from, to, face)
    }

    fn normal(&self, _: DVec3, face: u32) -> DVec3 {
        self.to_world(self.field.flat_normal(face))
    }

    fn shading_normal(&self, point: DVec3, face: u32) -> Option<DVec3> {
        let corner = |normal: DVec3| self.to_world(normal).normalize_or_zero();
        self.field
            .smooth_normal(self.point_to_field(point), face, corner)
    }

    fn contains(&self, point: DVec3) -> bool {
        self.field.contains(self.point_to_field(point))
    }

    fn keeps_its_box(&self) -> bool {
        true
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
        bounds.transformed(&self.transform.world_from_object)
    }

    fn povray_box(&self) -> Option<(Bounds, DAffine3)> {
        let field = &self.field;
        let [columns, rows] = field.cells.map(|cells| cells as f64);
        let min = DVec3::new(0.0, field.low - BOX_MARGIN, 0.0);
        let max = DVec3::new(columns, field.high + BOX_MARGIN, rows);
        let scale = DAffine3::from_scale(DVec3::new(columns, HEIGHT, rows).recip());
        let to_world = self.transform.world_from_object * scale;
        let is_empty = field.is_empty() || field.low > field.high;
        (!is_empty).then(|| (Bounds::new(min, max), to_world))
    }

    fn extends_beyond_bounds(&self) -> bool {
        true
    }

    fn rounded(&self, steps: &Steps<'_>) -> Option<Rounded> {
        let has_triangles = !self.field.is_empty();
        has_triangles.then(|| Rounded::of_field(RoundedField::new(self, steps), steps))
    }

    fn absorb(&mut self, step: &Step) -> bool {
        *self.transform = self.transform.then(&step.transform());
        true
    }

    fn is_faceted(&self) -> bool {
        true
    }

    fn takes_hierarchy(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests;
