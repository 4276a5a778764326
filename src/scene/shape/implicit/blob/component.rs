//! One component of a blob, and the segments of a ray on which its field is one polynomial.

use crate::base::args::{Args, Parse, Word, transform_step};
use crate::base::math::conditioning::{RescaledRay, is_comfortable, unit};
use crate::base::math::roots::ray_sphere::sphere_span;
use crate::base::math::{Bounds, Ray, Step, Transform};
use crate::base::source::Diagnostic;
use crate::scene::shape::{FaceTexture, TextureWeight, read};
use crate::scene::texture::Texture;
use glam::{DAffine3, DMat3, DVec3};
use smallvec::SmallVec;

/// A field around a centre, or around the segment between two ends.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Component {
    pub(super) strength: f64,
    /// Index of its texture in the blob, or [`TextureWeight::OF_THE_OBJECT`].
    pub(super) skin: u32,
    /// Transform from the blob to unit space, in which the radius is 1, one end is the origin and the other lies above
    /// it.
    unit_from_blob: DAffine3,
    /// Height of the other end in unit space; zero for a sphere.
    length: f64,
    bounds: Bounds,
    /// Centre and radius of a bounding sphere.
    bounding_sphere: (DVec3, f64),
    /// True if the bounding sphere is where the field ends.
    is_sphere: bool,
}

/// An interval of a ray on which `d = |origin + t · dir|`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment {
    pub(super) from: f64,
    pub(super) to: f64,
    origin: DVec3,
    dir: DVec3,
    strength: f64,
    max_field: f64,
}

pub(super) type Segments = SmallVec<[Segment; 12]>;

impl Segment {
    /// Upper bound of the field on the segment.
    pub(super) fn max_field(&self) -> f64 {
        self.max_field
    }

    /// The field at `t`.
    pub(super) fn field(&self, t: f64) -> f64 {
        let p = self.origin + t * self.dir;
        let falloff = 1.0 - p.dot(p);
        self.strength * falloff * falloff
    }

    /// Subtracts the field along `middle + half · x` from a quartic in `x`.
    pub(super) fn subtract_from(&self, quartic: &mut [f64; 5], middle: f64, half: f64) {
        let p = self.origin + middle * self.dir;
        let h = half * self.dir;
        let (a, b, c) = (1.0 - p.dot(p), -2.0 * p.dot(h), -h.dot(h));
        let s = self.strength;
        quartic[0] -= s * a * a;
        quartic[1] -= s * (2.0 * a * b);
        quartic[2] -= s * (b * b + 2.0 * a * c);
        quartic[3] -= s * (2.0 * b * c);
        quartic[4] -= s * c * c;
    }
}

impl Component {
    /// Reads the component that begins at the next keyword, if one does, with the texture of its own.
    pub(super) fn read(args: &mut dyn Args) -> Parse<Option<(Self, Option<Texture>)>> {
        if args.accept(Word::Component)? {
            let strength = read::number(args, "the strength of the component")?;
            let radius = read::number(args, "the radius of the component")?;
            let centre = read::vector(args, "the centre of the component")?;
            let component = Component::sphere(centre, radius, strength, &[]);
            return Ok(Some((component, None)));
        }
        if args.accept(Word::Sphere)? {
            args.open()?;
            let centre = read::vector(args, "the centre of the component")?;
            let radius = read::number(args, "the radius of the component")?;
            let strength = read_strength(args)?;
            let (steps, texture) = read_modifiers(args)?;
            let component = Component::sphere(centre, radius, strength, &steps);
            return Ok(Some((component, texture)));
        }
        if !args.accept(Word::Cylinder)? {
            return Ok(None);
        }
        args.open()?;
        let at = args.span();
        let end = read::vector(args, "an end of the component")?;
        let other = read::vector(args, "an end of the component")?;
        let at = at.to(args.last_span());
        let radius = read::number(args, "the radius of the component")?;
        let strength = read_strength(args)?;
        let (steps, texture) = read_modifiers(args)?;
        let component = Component::cylinder([end, other], radius, strength, &steps);
        match component {
            Some(component) => Ok(Some((component, texture))),
            None => Err(Box::new(
                Diagnostic::error(at, "degenerate cylindrical component in blob")
                    .with_hint("Its two ends are one point: write a `sphere` instead."),
            )),
        }
    }

    pub(super) fn sphere(centre: DVec3, radius: f64, strength: f64, steps: &[Step]) -> Self {
        let own = DAffine3::from_translation(centre) * DAffine3::from_scale(DVec3::splat(radius));
        let inverse = DAffine3 {
            matrix3: DMat3::from_diagonal(DVec3::splat(1.0 / radius)),
            translation: -centre / radius,
        };
        Component::with_steps(own, inverse, 0.0, strength, steps)
    }

    pub(super) fn cylinder(
        [end, other]: [DVec3; 2],
        radius: f64,
        strength: f64,
        steps: &[Step],
    ) -> Option<Self> {
        let axis = unit(other - end)?;
        let across = axis.any_orthonormal_vector();
        let rotation = DMat3::from_cols(across, axis, across.cross(axis));
        let own = DAffine3 {
            matrix3: rotation * radius.abs(),
            translation: end,
        };
        let inverse_rotation = rotation.transpose() * (1.0 / radius.abs());
        let inverse = DAffine3 {
            matrix3: inverse_rotation,
            translation: -(inverse_rotation * end),
        };
        let length = (other - end).length() / radius.abs();
        Some(Component::with_steps(own, inverse, length, strength, steps))
    }

    /// The component with its own transform and its inverse, from unit space to the space before `steps`.
    fn with_steps(
        own: DAffine3,
        inverse: DAffine3,
        length: f64,
        strength: f64,
        steps: &[Step],
    ) -> Self {
        let transform = Transform::from_steps(steps);
        let blob_from_unit = transform.world_from_object * own;
        let unit_from_blob = inverse * transform.object_from_world;
        // The image of the unit sphere extends along an axis by the length of that row of its matrix.
        let transposed = blob_from_unit.matrix3.transpose();
        let half_extent = DVec3::new(
            transposed.x_axis.length(),
            transposed.y_axis.length(),
            transposed.z_axis.length(),
        );
        // The spectral norm of a matrix is at most the geometric mean of its largest column sum and row sum of absolute
        // values.
        let sums = |m: DMat3| m.abs() * DVec3::ONE;
        let max_scale =
            (sums(transposed).max_element() * sums(blob_from_unit.matrix3).max_element()).sqrt();
        let ends = [DVec3::ZERO, length * DVec3::Y].map(|end| blob_from_unit.transform_point3(end));
        let slack = 8.0 * f64::EPSILON * (ends[0].abs().max(ends[1].abs()) + half_extent);
        let [low, high] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        let bounds = Bounds::new(low - half_extent - slack, high + half_extent + slack);
        let is_empty = half_extent == DVec3::ZERO || strength == 0.0 || !unit_from_blob.is_finite();
        let radius = blob_from_unit.matrix3.x_axis.x;
        let is_uniform = blob_from_unit.matrix3 == DMat3::from_diagonal(DVec3::splat(radius));
        Component {
            strength,
            skin: TextureWeight::OF_THE_OBJECT,
            unit_from_blob,
            length,
            bounds: if is_empty { Bounds::EMPTY } else { bounds },
            bounding_sphere: (
                ends[0].midpoint(ends[1]),
                0.5 * ends[0].distance(ends[1]) + max_scale,
            ),
            is_sphere: is_uniform && length == 0.0 && !is_empty,
        }
    }

    pub(super) fn bounding_sphere(&self) -> (DVec3, f64) {
        self.bounding_sphere
    }

    pub(super) fn is_sphere(&self) -> bool {
        self.is_sphere
    }

    pub(super) fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Appends the segments of a ray inside the component.
    #[inline(always)]
    pub(super) fn segments(&self, ray: &Ray, segments: &mut Segments) {
        if self.bounds.is_empty() {
            return;
        }
        let local = ray.to_object(&self.unit_from_blob);
        if self.length == 0.0 {
            self.push(&local, f64::NEG_INFINITY, f64::INFINITY, segments);
        } else {
            self.cylinder_segments(&local, segments);
        }
    }

    #[inline(never)]
    fn cylinder_segments(&self, local: &Ray, segments: &mut Segments) {
        let above = &Ray::new(local.origin - self.length * DVec3::Y, local.dir);
        let flat = |v: DVec3| DVec3::new(v.x, 0.0, v.z);
        let between = &Ray::new(flat(local.origin), flat(local.dir));
        let (first, second, pieces) = if local.dir.y == 0.0 {
            let piece = if local.origin.y < 0.0 {
                local
            } else if above.origin.y > 0.0 {
                above
            } else {
                between
            };
            (f64::INFINITY, f64::INFINITY, [piece; 3])
        } else {
            let bottom = -local.origin.y / local.dir.y;
            let top = -above.origin.y / local.dir.y;
            if local.dir.y > 0.0 {
                (bottom, top, [local, between, above])
            } else {
                (top, bottom, [above, between, local])
            }
        };
        let ends = [f64::NEG_INFINITY, first, second, f64::INFINITY];
        for (piece, ends) in pieces.into_iter().zip(ends.windows(2)) {
            if ends[0] < ends[1] {
                self.push(piece, ends[0], ends[1], segments);
            }
        }
    }

    /// Appends the segment of a ray, relative to a centre, that lies in the unit sphere and between two parameters.
    #[inline(always)]
    fn push(&self, about: &Ray, start: f64, end: f64, segments: &mut Segments) {
        let Some((enter, leave)) = unit_chord(about, start, end) else {
            return;
        };
        let (from, to) = (enter.max(start), leave.min(end));
        if from < to {
            segments.push(Segment {
                from,
                to,
                origin: about.origin,
                dir: about.dir,
                strength: self.strength,
                max_field: self.max_field_along(about, from, to),
            });
        }
    }

    /// Upper bound of the field on an interval of a ray relative to a centre.
    #[inline(always)]
    fn max_field_along(&self, about: &Ray, from: f64, to: f64) -> f64 {
        if self.strength <= 0.0 {
            return 0.0;
        }
        let nearest = -about.origin.dot(about.dir) / about.dir.dot(about.dir);
        let p = about.at(if nearest.is_finite() {
            nearest.max(from).min(to)
        } else {
            from
        });
        let falloff = (1.0 - p.dot(p)).max(0.0);
        self.strength * falloff * falloff
    }

    /// The field at a point.
    pub(super) fn field(&self, point: DVec3) -> f64 {
        let p = self.off_axis(self.unit_from_blob.transform_point3(point));
        let falloff = 1.0 - p.dot(p);
        if falloff > 0.0 {
            self.strength * falloff * falloff
        } else {
            0.0
        }
    }

    /// The negative gradient of the field at a point, halved.
    pub(super) fn outward(&self, point: DVec3) -> DVec3 {
        let p = self.off_axis(self.unit_from_blob.transform_point3(point));
        let falloff = 1.0 - p.dot(p);
        if falloff > 0.0 {
            self.unit_from_blob.matrix3.transpose() * (p * (2.0 * self.strength * falloff))
        } else {
            DVec3::ZERO
        }
    }

    /// Offset from the nearest point of the axis segment.
    fn off_axis(&self, p: DVec3) -> DVec3 {
        DVec3::new(p.x, p.y - p.y.clamp(0.0, self.length), p.z)
    }
}

/// Interval of a ray inside the unit sphere about the origin; without a direction, `start..end` or nothing.
#[inline(always)]
fn unit_chord(about: &Ray, start: f64, end: f64) -> Option<(f64, f64)> {
    let dir_sq = about.dir.dot(about.dir);
    let origin_sq = about.origin.dot(about.origin);
    if about.dir == DVec3::ZERO {
        return (origin_sq < 1.0).then_some((start, end));
    }
    if is_comfortable(1.0, dir_sq, origin_sq) {
        return sphere_span(about.origin, about.dir, 1.0);
    }
    rescaled_chord(about)
}

#[cold]
fn rescaled_chord(about: &Ray) -> Option<(f64, f64)> {
    let rescaled = RescaledRay::new(about, 1.0)?;
    let (enter, leave) = sphere_span(rescaled.ray.origin, rescaled.ray.dir, 1.0 / rescaled.size)?;
    Some((rescaled.t(enter), rescaled.t(leave)))
}

fn read_strength(args: &mut dyn Args) -> Parse<f64> {
    args.comma()?;
    args.accept(Word::Strength)?;
    read::number(args, "the strength of the component")
}

/// Reads transforms and textures up to the closing brace; the transforms move the textures before them.
fn read_modifiers(args: &mut dyn Args) -> Parse<(Vec<Step>, Option<Texture>)> {
    let mut steps = Vec::new();
    let mut texture: Option<Texture> = None;
    loop {
        if args.accept_close()? {
            return Ok((steps, texture));
        }
        if let Some(step) = transform_step(args)? {
            if let Some(texture) = &mut texture {
                texture.transform(&step);
            }
            steps.push(step);
            continue;
        }
        let is_known = match args.word()? {
            Some(word) => FaceTexture::read_over(&mut texture, word, args)?,
            None => false,
        };
        if !is_known {
            return Err(args.expected("a transform, a texture or `}` in a component of a blob"));
        }
    }
}
