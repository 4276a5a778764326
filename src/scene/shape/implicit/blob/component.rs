//! One component of a blob, and the parts of a ray on which its field is one polynomial.

use crate::base::args::{Args, Parse, Word, transform_step};
use crate::base::math::conditioning::{RescaledRay, is_comfortable, unit};
use crate::base::math::roots::ray_sphere::ball_chord;
use crate::base::math::{Bounds, Ray, Step, Transform};
use crate::base::source::Diagnostic;
use crate::scene::shape::{FaceTexture, TextureWeight, read};
use crate::scene::texture::Texture;
use glam::{DAffine3, DMat3, DVec3};
use smallvec::SmallVec;

/// A field around a centre, or around the stretch between two ends.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Component {
    pub(super) strength: f64,
    /// Which of the textures of the blob it has.
    pub(super) skin: u32,
    /// Takes the blob to the space in which the radius is 1, one end is the origin and the other above it.
    unit_from_blob: DAffine3,
    /// The height of the other end; zero for a sphere.
    length: f64,
    bounds: Bounds,
    /// Centre and radius of a ball around it.
    ball: (DVec3, f64),
}

/// A stretch of a ray on which `d = |origin + t · dir|`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub(super) from: f64,
    pub(super) to: f64,
    origin: DVec3,
    dir: DVec3,
    strength: f64,
    most: f64,
}

pub(super) type Parts = SmallVec<[Part; 12]>;

impl Part {
    /// Nowhere on the ray its field is above this.
    pub(super) fn most(&self) -> f64 {
        self.most
    }

    /// The field at a place of the ray.
    pub(super) fn field(&self, t: f64) -> f64 {
        let p = self.origin + t * self.dir;
        let rest = 1.0 - p.dot(p);
        self.strength * rest * rest
    }

    /// Subtracts the field along `middle + half · x` from a quartic in `x`.
    pub(super) fn take_from(&self, quartic: &mut [f64; 5], middle: f64, half: f64) {
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
    /// The component that begins at the next word, if one does, with the texture that it has of its own.
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
                    .with_hint("its two ends are one point: write a `sphere` instead"),
            )),
        }
    }

    pub(super) fn sphere(centre: DVec3, radius: f64, strength: f64, steps: &[Step]) -> Self {
        let own = DAffine3::from_translation(centre) * DAffine3::from_scale(DVec3::splat(radius));
        let inverse = DAffine3 {
            matrix3: DMat3::from_diagonal(DVec3::splat(1.0 / radius)),
            translation: -centre / radius,
        };
        Component::placed((own, inverse), 0.0, strength, steps)
    }

    pub(super) fn cylinder(
        [end, other]: [DVec3; 2],
        radius: f64,
        strength: f64,
        steps: &[Step],
    ) -> Option<Self> {
        let axis = unit(other - end)?;
        let across = axis.any_orthonormal_vector();
        let turn = DMat3::from_cols(across, axis, across.cross(axis));
        let own = DAffine3 {
            matrix3: turn * radius.abs(),
            translation: end,
        };
        let back = turn.transpose() * (1.0 / radius.abs());
        let inverse = DAffine3 {
            matrix3: back,
            translation: -(back * end),
        };
        let length = (other - end).length() / radius.abs();
        Some(Component::placed((own, inverse), length, strength, steps))
    }

    /// `own` takes the unit space to that of the component before its steps, and back.
    fn placed(own: (DAffine3, DAffine3), length: f64, strength: f64, steps: &[Step]) -> Self {
        let moved = Transform::from_steps(steps);
        let blob_from_unit = moved.world_from_object * own.0;
        let unit_from_blob = own.1 * moved.object_from_world;
        // A ball of radius 1 reaches along an axis as far as the row of its matrix is long.
        let rows = blob_from_unit.matrix3.transpose();
        let reach = DVec3::new(
            rows.x_axis.length(),
            rows.y_axis.length(),
            rows.z_axis.length(),
        );
        // No matrix stretches by more than the mean, in products, of its largest column and row in sums of sizes.
        let sums = |m: DMat3| m.abs() * DVec3::ONE;
        let stretch =
            (sums(rows).max_element() * sums(blob_from_unit.matrix3).max_element()).sqrt();
        let ends = [DVec3::ZERO, length * DVec3::Y].map(|end| blob_from_unit.transform_point3(end));
        let slack = 8.0 * f64::EPSILON * (ends[0].abs().max(ends[1].abs()) + reach);
        let [low, high] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        let bounds = Bounds::new(low - reach - slack, high + reach + slack);
        let is_empty = reach == DVec3::ZERO || strength == 0.0 || !unit_from_blob.is_finite();
        Component {
            strength,
            skin: TextureWeight::OF_THE_OBJECT,
            unit_from_blob,
            length,
            bounds: if is_empty { Bounds::EMPTY } else { bounds },
            ball: (
                ends[0].midpoint(ends[1]),
                0.5 * ends[0].distance(ends[1]) + stretch,
            ),
        }
    }

    pub(super) fn ball(&self) -> (DVec3, f64) {
        self.ball
    }

    pub(super) fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Appends the parts of a ray within reach.
    pub(super) fn parts(&self, ray: &Ray, parts: &mut Parts) {
        if self.bounds.is_empty() {
            return;
        }
        let local = ray.to_object(&self.unit_from_blob);
        if self.length == 0.0 {
            self.push(&local, (f64::NEG_INFINITY, f64::INFINITY), parts);
            return;
        }
        let above = Ray::new(local.origin - self.length * DVec3::Y, local.dir);
        let flat = |v: DVec3| DVec3::new(v.x, 0.0, v.z);
        let between = Ray::new(flat(local.origin), flat(local.dir));
        if local.dir.y == 0.0 {
            let piece = if local.origin.y < 0.0 {
                &local
            } else if above.origin.y > 0.0 {
                &above
            } else {
                &between
            };
            self.push(piece, (f64::NEG_INFINITY, f64::INFINITY), parts);
            return;
        }
        let bottom = -local.origin.y / local.dir.y;
        let top = -above.origin.y / local.dir.y;
        let (first, second, pieces) = if local.dir.y > 0.0 {
            (bottom, top, [&local, &between, &above])
        } else {
            (top, bottom, [&above, &between, &local])
        };
        self.push(pieces[0], (f64::NEG_INFINITY, first), parts);
        self.push(pieces[1], (first, second), parts);
        self.push(pieces[2], (second, f64::INFINITY), parts);
    }

    /// Appends the part of a ray, given about a centre, that lies in the ball of radius 1 and in a stretch.
    fn push(&self, about: &Ray, stretch: (f64, f64), parts: &mut Parts) {
        let Some((enter, leave)) = unit_chord(about, stretch) else {
            return;
        };
        let (from, to) = (enter.max(stretch.0), leave.min(stretch.1));
        if from < to {
            parts.push(Part {
                from,
                to,
                origin: about.origin,
                dir: about.dir,
                strength: self.strength,
                most: self.most_along(about, (from, to)),
            });
        }
    }

    /// A bound on the field along a part of a ray that is given about a centre.
    fn most_along(&self, about: &Ray, (from, to): (f64, f64)) -> f64 {
        if self.strength <= 0.0 {
            return 0.0;
        }
        let nearest = -about.origin.dot(about.dir) / about.dir.dot(about.dir);
        let p = about.at(if nearest.is_finite() {
            nearest.max(from).min(to)
        } else {
            from
        });
        let rest = (1.0 - p.dot(p)).max(0.0);
        self.strength * rest * rest
    }

    /// The field at a point.
    pub(super) fn field(&self, point: DVec3) -> f64 {
        let p = self.off_axis(self.unit_from_blob.transform_point3(point));
        let rest = 1.0 - p.dot(p);
        if rest > 0.0 {
            self.strength * rest * rest
        } else {
            0.0
        }
    }

    /// The direction and half the rate in which the field falls at a point.
    pub(super) fn outward(&self, point: DVec3) -> DVec3 {
        let p = self.off_axis(self.unit_from_blob.transform_point3(point));
        let rest = 1.0 - p.dot(p);
        if rest > 0.0 {
            self.unit_from_blob.matrix3.transpose() * (p * (2.0 * self.strength * rest))
        } else {
            DVec3::ZERO
        }
    }

    /// From the nearest point of the stretch between the ends.
    fn off_axis(&self, p: DVec3) -> DVec3 {
        DVec3::new(p.x, p.y - p.y.clamp(0.0, self.length), p.z)
    }
}

/// Where a ray is in the ball of radius 1 about the origin; one without direction is there always or never.
fn unit_chord(about: &Ray, stretch: (f64, f64)) -> Option<(f64, f64)> {
    let dir_sq = about.dir.dot(about.dir);
    let origin_sq = about.origin.dot(about.origin);
    if about.dir == DVec3::ZERO {
        return (origin_sq < 1.0).then_some(stretch);
    }
    if is_comfortable(1.0, dir_sq, origin_sq) {
        return ball_chord(about.origin, about.dir, 1.0);
    }
    let eased = RescaledRay::new(about, 1.0)?;
    let (enter, leave) = ball_chord(eased.ray.origin, eased.ray.dir, 1.0 / eased.size)?;
    Some((eased.t(enter), eased.t(leave)))
}

fn read_strength(args: &mut dyn Args) -> Parse<f64> {
    args.comma()?;
    args.accept(Word::Strength)?;
    read::number(args, "the strength of the component")
}

/// Transforms and textures up to the closing brace; the transforms move the textures before them.
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
