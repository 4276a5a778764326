//! `ovus { bottom radius, top radius [distance d] [radius r] [precision p] }`: an egg, made of a sphere about the origin, a
//! sphere about `<0, d, 0>`, and between them the arc of a larger circle of radius `r` tangent to both, turned about the y
//! axis. The words are those of version 3.8; `d` is the bottom radius without them, and `r` twice the larger radius.
//! `precision` is accepted and ignored: there is one solver.
//!
//! The egg is convex, and outside of it the distance to it is a convex function of `t` along a ray: Newton's iteration
//! from where the ray enters a bounding sphere finds the near root or turns away, and the far one from the other end.
//! The directions from the centre of the arc tell which of the three pieces is nearest.
//!
//! Error bound: roots lie within 2 roundings of the problem's size from the surface (`shape/roundings.rs`).

use crate::base::args::{Args, Parse, Word, since_3_8};
use crate::base::math::conditioning::{RescaledRay, is_comfortable};
use crate::base::math::roots::interval_roots::first_below_zero;
use crate::base::math::roots::ray_sphere::sphere_span;
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::{Diagnostic, Span};
use crate::base::version::Novelty;
use crate::scene::shape::{Geometry, Root, SpanEnd, Start, first_visible, push_span, read, span};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// The bounding sphere is enlarged by this factor, so that rays enter it outside the egg.
const CLIP: f64 = 1.001;

/// The arc's centre lies on the axis if its distance from there is below a rounding of the radius, squared.
const ON_AXIS: f64 = 16.0 * f64::EPSILON;

/// An egg. It is one piece, face 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ovus {
    bottom: f64,
    top: f64,
    /// Height of the centre of the top.
    distance: f64,
    /// Centre of the arc, beyond the axis, in the half-plane of distance from the axis and height.
    arc_centre: DVec2,
    /// Radius of the arc.
    arc_radius: f64,
}

impl Ovus {
    /// An egg with two positive radii. If the top is at least twice as wide as the bottom, it is the sphere of the top.
    #[must_use]
    pub fn new(bottom: f64, top: f64) -> Self {
        if top >= 2.0 * bottom {
            // The arc and the bottom lie within the sphere.
            return Ovus {
                bottom: 0.0,
                top,
                distance: bottom,
                arc_centre: DVec2::new(0.0, bottom),
                arc_radius: top,
            };
        }
        // In units of the larger radius.
        let (height, width, arc_radius) = if bottom > top {
            let share = top / bottom;
            let height = 2.0 * share - 1.0 - 0.5 * share * share;
            let width = ((1.0 - height) * (1.0 + height)).max(0.0).sqrt();
            (height * bottom, width * bottom, 2.0 * bottom)
        } else {
            let share = top / bottom;
            let rise = 1.5 * share - 2.0;
            let width = ((1.0 - rise) * (1.0 + rise)).max(0.0).sqrt();
            (bottom + rise * top, width * top, 2.0 * top)
        };
        Ovus {
            bottom,
            top,
            distance: bottom,
            arc_centre: DVec2::new(-width, height),
            arc_radius,
        }
    }

    /// An egg whose spheres are `distance` apart, joined by an arc of radius `arc_radius`. It is empty if no arc touches
    /// both, and a sphere of that radius if the arc's centre lies on the axis; in POV-Ray 3.8 it lies lower by `distance` if
    /// the top is larger than the bottom.
    #[must_use]
    pub fn with_arc(bottom: f64, top: f64, distance: f64, arc_radius: f64) -> Self {
        let (to_bottom, to_top) = (arc_radius - bottom, arc_radius - top);
        let height = 0.5 * ((to_bottom - to_top) * (to_bottom + to_top) / distance + distance);
        let width_sq = (to_bottom - height) * (to_bottom + height);
        let is_sphere = width_sq.abs() <= ON_AXIS * arc_radius * arc_radius;
        let sphere = |radius: f64, height: f64| Ovus {
            bottom: 0.0,
            top: radius,
            distance: height,
            arc_centre: DVec2::new(0.0, height),
            arc_radius: radius,
        };
        if is_sphere {
            return sphere(
                arc_radius,
                if top > bottom {
                    height - distance
                } else {
                    height
                },
            );
        }
        if width_sq < 0.0 {
            return sphere(0.0, 0.0);
        }
        Ovus {
            bottom,
            top,
            distance,
            arc_centre: DVec2::new(-width_sq.sqrt(), height),
            arc_radius,
        }
    }

    /// Reads both radii and the words of version 3.8.
    ///
    /// # Errors
    /// Malformed, non-finite or negative parameters.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let at = args.span();
        let bottom = read::number(args, "the bottom radius of the ovus")?;
        let top = read::number(args, "the top radius of the ovus")?;
        let at = at.to(args.last_span());
        if args.is_for_3_8() {
            return Self::read_arc(args, at, bottom, top);
        }
        if bottom < 0.0 || top < 0.0 {
            let error = Diagnostic::error(at, "both ovus radii must be positive");
            return Err(Box::new(error));
        }
        let ovus = Ovus::new(bottom, top);
        if top >= 2.0 * bottom {
            args.warn(Diagnostic::warning(
                at,
                "the top radius of the ovus is at least twice the bottom radius; a sphere is drawn",
            ));
        }
        for word in [Word::Radius, Word::Distance, Word::Precision] {
            if args.accept(word)? {
                since_3_8(args, word, Word::Ovus)?;
            }
        }
        Ok(ovus)
    }

    /// Reads what follows the radii in version 3.8.
    fn read_arc(args: &mut dyn Args, at: Span, bottom: f64, top: f64) -> Parse<Self> {
        let (mut distance, mut arc_radius) = (bottom, 2.0 * bottom.max(top));
        loop {
            let words = [Word::Radius, Word::Distance, Word::Precision];
            if let Some(word) = args.word()?.filter(|word| words.contains(word)) {
                args.note_novelty(Novelty::Word(word));
            }
            if args.accept(Word::Radius)? {
                arc_radius = read::number(args, "the radius of the ovus")?;
            } else if args.accept(Word::Distance)? {
                distance = read::number(args, "the distance of the ovus")?;
            } else if args.accept(Word::Precision)? {
                read::number(args, "the precision of the ovus")?;
            } else {
                break;
            }
        }
        let error = |message: String| Err(Box::new(Diagnostic::error(at, message)));
        let smallest = 0.5 * (bottom + top + distance);
        if bottom <= 0.0 || top < 0.0 {
            return error("both ovus radii must be positive".to_owned());
        }
        if distance < bottom {
            return error(format!(
                "the distance of the ovus must be at least its bottom radius, {bottom}"
            ));
        }
        if arc_radius < smallest {
            return error(format!(
                "the radius of the ovus must be at least {smallest}, half the sum of its radii and distance"
            ));
        }
        let ovus = Ovus::with_arc(bottom, top, distance, arc_radius);
        let drawn = match (ovus.is_sphere(), ovus.top > 0.0) {
            (true, true) => "a sphere is drawn",
            (true, false) => "no arc joins its spheres and nothing is drawn",
            _ => return Ok(ovus),
        };
        args.warn(Diagnostic::warning(
            at,
            format!("the ovus is no egg: {drawn}"),
        ));
        Ok(ovus)
    }

    fn is_sphere(&self) -> bool {
        self.bottom == 0.0
    }

    /// Centre and radius of the circle whose piece is nearest to a point of the half-plane.
    fn circle(&self, point: DVec2) -> (DVec2, f64) {
        let top = DVec2::new(0.0, self.distance);
        if self.is_sphere() {
            return (top, self.top);
        }
        let offset = point - self.arc_centre;
        if (-self.arc_centre).perp_dot(offset) < 0.0 {
            (DVec2::ZERO, self.bottom)
        } else if (top - self.arc_centre).perp_dot(offset) > 0.0 {
            (top, self.top)
        } else {
            (self.arc_centre, self.arc_radius)
        }
    }

    /// Distance from the surface and the unit normal; exact outside the egg.
    fn distance(&self, point: DVec3) -> (f64, DVec3) {
        let from_axis = point.x.hypot(point.z);
        let flat = DVec2::new(from_axis, point.y);
        let (middle, radius) = self.circle(flat);
        let offset = flat - middle;
        let length = offset.length();
        let outward = if from_axis > 0.0 {
            offset.x / from_axis
        } else {
            0.0
        };
        let normal = DVec3::new(point.x * outward, offset.y, point.z * outward) / length;
        (length - radius, normal)
    }

    /// Lowest and highest point, and the largest distance from the axis.
    fn extent(&self) -> (f64, f64, f64) {
        let top = self.distance;
        if self.is_sphere() {
            return (top - self.top, top + self.top, self.top);
        }
        let is_widest_on_arc = self
            .circle(DVec2::new(self.arc_radius, self.arc_centre.y))
            .1
            == self.arc_radius;
        let width = if is_widest_on_arc {
            self.arc_radius + self.arc_centre.x
        } else {
            self.bottom.max(self.top)
        };
        (-self.bottom, top + self.top, width)
    }

    fn span(&self, ray: &Ray) -> Option<[Root; 2]> {
        let (low, high, width) = self.extent();
        let size = width.hypot(0.5 * (high - low));
        let centre = DVec3::new(0.0, 0.5 * (low + high), 0.0);
        let about = Ray::new(ray.origin - centre, ray.dir);
        if is_comfortable(size, ray.dir.dot(ray.dir), about.origin.dot(about.origin)) {
            let (enter, leave) = self.chord(&about, centre, size)?;
            return span(SpanEnd::new(enter, 0), SpanEnd::new(leave, 0));
        }
        let rescaled = RescaledRay::new(&about, size)?;
        let small = Ovus {
            bottom: self.bottom / rescaled.size,
            top: self.top / rescaled.size,
            distance: self.distance / rescaled.size,
            arc_centre: self.arc_centre / rescaled.size,
            arc_radius: self.arc_radius / rescaled.size,
        };
        let (enter, leave) =
            small.chord(&rescaled.ray, centre / rescaled.size, size / rescaled.size)?;
        span(
            SpanEnd::new(rescaled.t(enter), 0),
            SpanEnd::new(rescaled.t(leave), 0),
        )
    }

    /// Interval of a ray inside the egg; `about` is the ray relative to the centre of a bounding sphere of radius
    /// `size`.
    fn chord(&self, about: &Ray, centre: DVec3, size: f64) -> Option<(f64, f64)> {
        let (from, to) = sphere_span(about.origin, about.dir, CLIP * size)?;
        // Relative to the middle of that chord, so that its length loses no digits to a far origin.
        let middle = 0.5 * (from + to);
        let near = Ray::new(about.at(middle) + centre, about.dir);
        let half = 0.5 * (to - from);
        let distance = |t: f64| {
            let (distance, normal) = self.distance(near.at(t));
            (distance, normal.dot(near.dir))
        };
        let enter = first_below_zero(distance, -half, half)?;
        let leave = first_below_zero(distance, half, -half)?;
        (enter < leave).then_some((middle + enter, middle + leave))
    }
}

impl Geometry for Ovus {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        push_span(self.span(ray), roots)
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        first_visible(&self.span(ray)?, from, to)
    }

    fn normal(&self, point: DVec3, _: u32) -> DVec3 {
        self.distance(point).1
    }

    fn contains(&self, point: DVec3) -> bool {
        self.distance(point).0 < 0.0
    }

    fn bounds(&self) -> Bounds {
        let (low, high, width) = self.extent();
        if width == 0.0 {
            return Bounds::EMPTY;
        }
        let slack = 8.0 * f64::EPSILON * (high - low);
        let reach = width + slack;
        Bounds {
            min: DVec3::new(-reach, low - slack, -reach),
            max: DVec3::new(reach, high + slack, reach),
        }
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }

    /// Longitude and latitude as of a sphere about `<0, top radius / 2, 0>`.
    fn uv(&self, point: DVec3, _face: u32) -> Option<[f64; 2]> {
        let p = point - DVec3::Y * (0.5 * self.top);
        let around = p.z.atan2(p.x) / TAU;
        let around = if around < 0.0 { around + 1.0 } else { around };
        let rise = p.normalize_or_zero().y.clamp(-1.0, 1.0);
        Some([around, 0.5 + rise.asin() / PI])
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

    #[test]
    fn eggs_are_solids() {
        for (bottom, top) in [(1.0, 0.5), (1.0, 0.1), (0.7, 1.0), (1.0, 1.0), (0.6, 1.19)] {
            check::solid(&Ovus::new(bottom, top));
        }
    }

    #[test]
    fn an_arc_of_another_radius_is_tangent_as_well() {
        for (text, is_sphere) in [
            ("1, 0.5 distance 2 radius 3", false),
            ("1, 0.5 radius 2 precision 0.001", false),
            ("1, 0.5 distance 3 radius 2.25", true),
            ("1, 2", true),
        ] {
            let mut args = TextArgs::new(text).at_version(3.8);
            let egg = Ovus::read(&mut args).unwrap();
            assert!(args.is_done());
            assert_eq!(
                (egg.is_sphere(), args.warnings().len()),
                (is_sphere, usize::from(is_sphere))
            );
            check::solid(&egg);
            if !is_sphere {
                assert!((egg.arc_radius - egg.bottom - egg.arc_centre.length()).abs() < 1e-14);
                let to_top = DVec2::new(0.0, egg.distance) - egg.arc_centre;
                assert!((egg.arc_radius - egg.top - to_top.length()).abs() < 1e-14);
            }
        }
        let empty = Ovus::read(&mut TextArgs::new("1, 2.5").at_version(3.8)).unwrap();
        assert!(empty.bounds().is_empty());
        for text in ["1, 0.5 radius 1", "1, 0.5 distance 0.5", "0, 1"] {
            assert!(Ovus::read(&mut TextArgs::new(text).at_version(3.8)).is_err());
        }
        assert!(Ovus::read(&mut TextArgs::new("1, 0.5 radius 2")).is_err());
    }

    #[test]
    fn the_pieces_are_tangent() {
        for (bottom, top) in [(1.0, 0.5), (0.7, 1.0), (1.0, 1.0)] {
            let egg = Ovus::new(bottom, top);
            assert!((egg.arc_radius - bottom - egg.arc_centre.length()).abs() < 1e-14);
            let to_top = DVec2::new(0.0, bottom) - egg.arc_centre;
            assert!((egg.arc_radius - top - to_top.length()).abs() < 1e-14);
        }
    }

    #[test]
    fn the_ends_are_those_of_the_spheres() {
        let ray = Ray::new(DVec3::new(0.0, 9.0, 0.0), DVec3::NEG_Y);
        let [enter, leave] = Ovus::new(1.0, 0.5).span(&ray).unwrap();
        assert!((enter.t - 7.5).abs() < 2e-15 && (leave.t - 10.0).abs() < 2e-15);
    }

    #[test]
    fn a_wide_top_is_a_sphere_and_negative_radii_are_errors() {
        let mut args = TextArgs::new("0.5, 1.2");
        let sphere = Ovus::read(&mut args).unwrap();
        assert_eq!(args.warnings().len(), 1);
        check::solid(&sphere);
        let ray = Ray::new(DVec3::new(-5.0, 0.5, 0.0), DVec3::X);
        assert!((sphere.span(&ray).unwrap()[0].t - 3.8).abs() < 2e-15);
        let error = Ovus::read(&mut TextArgs::new("-0.5, 1")).unwrap_err();
        assert_eq!(error.message, "both ovus radii must be positive");
        assert!(Ovus::new(0.0, 0.0).bounds().is_empty());
    }

    #[test]
    fn extreme_units_change_nothing() {
        for scale in [1e-300, 1e-150, 1e150, 1e300] {
            let egg = Ovus::new(scale, 0.5 * scale);
            let ray = Ray::new(DVec3::new(-5.0, 0.0, 0.0) * scale, DVec3::X);
            let [enter, _] = egg.span(&ray).unwrap();
            assert!((enter.t / scale - 4.0).abs() < 1e-14);
        }
    }
}
