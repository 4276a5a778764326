//! `lemon { <base>, base radius, <apex>, apex radius, inner radius [open] }`: an arc of a circle, turned about the axis
//! between two caps, since version 3.8.
//!
//! The circle passes through the rims of both caps and has its centre on the axis or beyond it, so the solid is convex,
//! and so is the distance from the circle along a ray. Newton's iteration from both ends of the ray's chord of a sphere
//! about the whole spindle finds the sides, as for an `ovus`; the caps are planes. The smallest circle has its centre
//! on the axis; POV-Ray takes it instead of a smaller one.

use super::axial::{APEX, Axis, BASE};
use crate::base::args::{Args, Parse, Word};
use crate::base::math::conditioning::{RescaledRay, is_comfortable};
use crate::base::math::roots::interval_roots::first_below_zero;
use crate::base::math::roots::ray_sphere::sphere_span;
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::shape::{
    Geometry, Root, Start, SurfaceSide, first_visible, original_span, push_span, read,
    uniform_scale,
};
use glam::DVec3;

/// The bounding sphere is enlarged by this factor, so that rays enter it outside the lemon.
const CLIP: f64 = 1.001;

/// A lemon. Face 0 is the side, 1 the base cap, 2 the apex cap.
#[derive(Clone, Debug, PartialEq)]
pub struct Lemon {
    axis: Axis,
    circle: Box<Circle>,
    is_open: bool,
}

/// The circle whose arc is turned about the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Circle {
    /// Height of the centre above the base.
    height: f64,
    /// Distance of the centre beyond the axis; not negative.
    beyond: f64,
    radius: f64,
    /// Radius of the larger cap.
    cap_radius: f64,
}

impl Lemon {
    /// A closed lemon, or `None` if the ends of its axis coincide. The radii are not negative. A circle that is too small
    /// for the caps is replaced by the smallest.
    #[must_use]
    pub fn new(base: DVec3, caps: [f64; 2], apex: DVec3, inner_radius: f64) -> Option<Self> {
        let axis = Axis::new(base, apex)?;
        let length = axis.length();
        let [base_radius, apex_radius] = caps;
        let on_axis =
            0.5 * (length + (apex_radius - base_radius) * (apex_radius + base_radius) / length);
        let smallest = base_radius.hypot(on_axis);
        let chord = DVec3::new(apex_radius - base_radius, length, 0.0);
        let half = 0.5 * chord.length();
        let to_centre = ((inner_radius - half) * (inner_radius + half))
            .max(0.0)
            .sqrt();
        let mut circle = Circle {
            height: 0.5 * length + to_centre * chord.x / (2.0 * half),
            beyond: to_centre * chord.y / (2.0 * half) - 0.5 * (base_radius + apex_radius),
            radius: inner_radius,
            cap_radius: base_radius.max(apex_radius),
        };
        if !(inner_radius > smallest && circle.beyond >= 0.0) {
            circle.height = on_axis;
            circle.beyond = 0.0;
            circle.radius = smallest;
        }
        Some(Lemon {
            axis,
            circle: Box::new(circle),
            is_open: false,
        })
    }

    /// Reads `<base>, base radius, <apex>, apex radius, inner radius [open]`.
    ///
    /// # Errors
    /// Malformed, non-finite or negative parameters; ends that coincide.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let at = args.span();
        let base = read::vector(args, "the base point of the lemon")?;
        let base_radius = read::number(args, "the base radius of the lemon")?;
        let apex = read::vector(args, "the apex point of the lemon")?;
        let apex_radius = read::number(args, "the apex radius of the lemon")?;
        let inner_at = args.span();
        let inner_radius = read::number(args, "the inner radius of the lemon")?;
        let at = at.to(args.last_span());
        if base_radius < 0.0 || apex_radius < 0.0 || inner_radius < 0.0 {
            let error = Diagnostic::error(at, "all radii of a lemon must be positive");
            return Err(Box::new(error));
        }
        let Some(mut lemon) = Lemon::new(base, [base_radius, apex_radius], apex, inner_radius)
        else {
            let error = Diagnostic::error(at, "degenerate lemon: base point = apex point")
                .with_hint("Place its two ends apart.");
            return Err(Box::new(error));
        };
        let radius = lemon.circle.radius;
        if radius > inner_radius {
            let message =
                format!("the inner radius of the lemon is too small; {radius:.6} is taken");
            args.warn(Diagnostic::warning(inner_at.to(args.last_span()), message));
        }
        lemon.is_open = args.accept(Word::Open)?;
        Ok(lemon)
    }

    /// Largest distance of the side from the axis.
    fn width(&self) -> f64 {
        let Circle {
            height,
            beyond,
            radius,
            cap_radius,
        } = *self.circle;
        if 0.0 < height && height < self.axis.length() {
            radius - beyond
        } else {
            cap_radius
        }
    }

    /// Half the length of the whole spindle, tip to tip.
    fn reach(&self) -> f64 {
        let Circle { beyond, radius, .. } = *self.circle;
        let squared = (radius - beyond) * (radius + beyond);
        squared.max(0.0).sqrt()
    }

    /// The point of the axis nearest to the circle's centre.
    fn centre(&self) -> DVec3 {
        self.axis.base + self.circle.height * self.axis.unit
    }

    /// Distance from the circle and the unit normal, for a point relative to the centre.
    fn distance(&self, p: DVec3) -> (f64, DVec3) {
        let height = self.axis.unit.dot(p);
        let across = self.axis.across(p);
        let from_axis = across.length();
        let offset = from_axis + self.circle.beyond;
        let length = offset.hypot(height);
        let outward = if from_axis > 0.0 {
            across * (offset / from_axis)
        } else {
            DVec3::ZERO
        };
        let normal = (outward + height * self.axis.unit) / length;
        (length - self.circle.radius, normal)
    }

    fn span(&self, ray: &Ray) -> Option<[Root; 2]> {
        let p = ray.origin - self.centre();
        if is_comfortable(self.reach(), ray.dir.dot(ray.dir), p.dot(p)) {
            return self.span_in_range(ray);
        }
        let to_apex = self.axis.apex - self.axis.base;
        let about = Ray::new(ray.origin - self.axis.base, ray.dir);
        let rescaled = RescaledRay::new(&about, self.reach())?;
        let small = Lemon {
            axis: Axis {
                base: DVec3::ZERO,
                apex: to_apex / rescaled.size,
                unit: self.axis.unit,
            },
            ..self.resized(1.0 / rescaled.size)
        };
        original_span(&rescaled, small.span_in_range(&rescaled.ray)?)
    }

    fn span_in_range(&self, ray: &Ray) -> Option<[Root; 2]> {
        let slab = self.axis.slab(ray)?;
        let p = ray.origin - self.centre();
        let (from, to) = sphere_span(p, ray.dir, CLIP * self.reach())?;
        // Relative to the middle of that chord, so that its length loses no digits to a far origin.
        let middle = 0.5 * (from + to);
        let near = Ray::new(p + middle * ray.dir, ray.dir);
        let half = 0.5 * (to - from);
        let distance = |t: f64| {
            let (distance, normal) = self.distance(near.at(t));
            (distance, normal.dot(near.dir))
        };
        let enter = first_below_zero(distance, -half, half)?;
        let leave = first_below_zero(distance, half, -half)?;
        if enter >= leave {
            return None;
        }
        slab.clip(middle + enter, middle + leave, self.is_open)
    }

    /// The same lemon with all lengths but those of the axis multiplied.
    fn resized(&self, factor: f64) -> Lemon {
        let Circle {
            height,
            beyond,
            radius,
            cap_radius,
        } = *self.circle;
        Lemon {
            circle: Box::new(Circle {
                height: height * factor,
                beyond: beyond * factor,
                radius: radius * factor,
                cap_radius: cap_radius * factor,
            }),
            ..*self
        }
    }
}

impl Geometry for Lemon {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        push_span(self.span(ray), roots)
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        first_visible(&self.span(ray)?, from, to)
    }

    fn normal(&self, point: DVec3, face: u32) -> DVec3 {
        match face {
            BASE => -self.axis.unit,
            APEX => self.axis.unit,
            _ => self.distance(point - self.centre()).1,
        }
    }

    fn contains(&self, point: DVec3) -> bool {
        let (above, below) = self.axis.heights(point);
        above > 0.0 && below > 0.0 && self.distance(point - self.centre()).0 < 0.0
    }

    fn surface_side(&self) -> SurfaceSide {
        if self.is_open {
            SurfaceSide::Inside
        } else {
            SurfaceSide::Outside
        }
    }

    fn bounds(&self) -> Bounds {
        let width = self.width();
        if width == 0.0 {
            return Bounds::EMPTY;
        }
        self.axis.bounds(width, width)
    }

    fn absorb(&mut self, step: &Step) -> bool {
        if let Step::Scale(by) = step
            && uniform_scale(*by).is_none()
        {
            return false;
        }
        let factor = self.axis.absorb(step);
        *self = self.resized(factor.unwrap_or(1.0));
        factor.is_some()
    }

    fn takes_sturm(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::scene::shape::tests::check;

    fn lemon(text: &str) -> Lemon {
        Lemon::read(&mut TextArgs::new(text)).unwrap()
    }

    #[test]
    fn a_scale_by_a_power_of_two_is_absorbed_exactly() {
        check::absorbs_scales_exactly(&lemon("<-0.7,0,0>, 0.2, <0.7,0,0>, 0.1, 3"));
    }

    #[test]
    fn it_is_a_solid() {
        for text in [
            "<1,2,3>, 1.5, <-2,3,5>, 0.3, 6",
            "<0,-1,0>, 0, <0,1,0>, 0, 1.5",
            "<0,-1,0>, 0.2, <0,1,0>, 0.7, 20 open",
            "<0,0,0>, 1, <0,1,0>, 3, 0",
        ] {
            check::solid(&lemon(text));
        }
        let tilted = lemon("<1,2,3>, 1.5, <-2,3,5>, 0.3, 6");
        check::scales_exactly(&tilted, |k| {
            let (base, apex) = (tilted.axis.base * k, tilted.axis.apex * k);
            Lemon {
                axis: Axis::new(base, apex).unwrap(),
                ..tilted.resized(k)
            }
        });
    }

    #[test]
    fn the_smallest_circle_makes_a_sphere() {
        let mut args = TextArgs::new("<0,-1,0>, 1, <0,1,0>, 1, 0.5");
        let round = Lemon::read(&mut args).unwrap();
        assert_eq!(args.warnings().len(), 1);
        let ray = Ray::new(DVec3::new(-5.0, 0.0, 0.0), DVec3::X);
        let depths = round.span(&ray).unwrap().map(|root| root.t);
        assert!((depths[0] - (5.0 - 2_f64.sqrt())).abs() < 1e-14);
        assert!((depths[1] - (5.0 + 2_f64.sqrt())).abs() < 1e-14);
    }

    #[test]
    fn the_rims_lie_on_the_circle() {
        let lemon = lemon("<0,0,0>, 0.5, <0,3,0>, 1, 4");
        for rim in [DVec3::new(0.5, 0.0, 0.0), DVec3::new(1.0, 3.0, 0.0)] {
            assert!(lemon.distance(rim - lemon.centre()).0.abs() < 1e-14);
        }
    }

    #[test]
    fn negative_radii_and_equal_ends_are_errors() {
        for text in ["0, 1, y, -1, 3", "<0,1,0>, 1, <0,1,0>, 1, 3"] {
            assert!(Lemon::read(&mut TextArgs::new(text)).is_err());
        }
    }
}
