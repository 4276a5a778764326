//! `disc { <centre>, <normal>, radius [, hole radius] }`: a flat ring, edges included.
//!
//! In CSG it is the whole half-space on the side opposite to its normal, of which only the ring is visible. Error
//! bound: as for a plane (`shape/roundings.rs`). Negative radii work like their absolute values; a hole wider than the
//! disc leaves nothing (checked with POV-Ray).

use crate::base::args::{Args, Parse};
use crate::base::math::conditioning::Normalization;
use crate::base::math::{Bounds, Ray, Step, rotation};
use crate::base::source::Diagnostic;
use crate::scene::shape::{
    Geometry, Plane, Root, Rounded, Start, Steps, along, first_visible, read, uniform_scale,
};
use glam::{DAffine3, DVec3};

/// Half the height of POV-Ray's bounding box of a disc.
const HALF_HEIGHT: f64 = 1e-3_f32 as f64;

/// A flat ring and the half-space behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// The centre.
    pub centre: DVec3,
    /// A unit vector that points out of the half-space; zero for a disc that is not drawn.
    pub normal: DVec3,
    /// The outer radius, not negative.
    pub radius: f64,
    /// The radius of the hole, zero for none.
    pub hole: f64,
}

impl Disc {
    /// Reads `<centre>, <normal>, radius [, hole radius]`.
    ///
    /// # Errors
    /// Malformed or non-finite parameters. A normal of length zero only gives a warning, since POV-Ray draws nothing.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let centre = read::vector(args, "the centre of the disc")?;
        let at = args.span();
        let normal = read::vector(args, "the normal of the disc")?;
        let at = at.to(args.last_span());
        let radius = read::number(args, "the radius of the disc")?.abs();
        args.comma()?;
        let hole = args.float_or(0.0)?.abs();
        let normalization = Normalization::of_version(args.is_for_3_8());
        let unit = normalization.unit_at_any_scale(normal);
        if unit.is_none() {
            args.warn(Diagnostic::warning(
                at,
                "the normal of the disc has no direction; the disc is not drawn",
            ));
        }
        Ok(Disc {
            centre,
            normal: unit.unwrap_or(DVec3::ZERO),
            radius,
            hole,
        })
    }

    fn cross(&self, ray: &Ray) -> (Start, Option<Root>) {
        // Relative to the centre, so that a disc across an axis gets the depth (centre - origin) / dir to the bit.
        let about_centre = Plane::new(self.normal, 0.0);
        let (start, root) = about_centre.cross(&Ray::new(ray.origin - self.centre, ray.dir));
        let root = root.map(|root| Root {
            is_visible: self.is_in_ring(ray.at(root.t) - self.centre),
            ..root
        });
        (start, root)
    }

    fn is_in_ring(&self, from_centre: DVec3) -> bool {
        let radius_sq = (from_centre / self.radius).length_squared();
        let inner = self.hole / self.radius;
        radius_sq <= 1.0 && radius_sq >= inner * inner
    }
}

impl Geometry for Disc {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        let (start, root) = self.cross(ray);
        roots.extend(root);
        start
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        first_visible(self.cross(ray).1.as_slice(), from, to)
    }

    fn normal(&self, _: DVec3, _: u32) -> DVec3 {
        self.normal
    }

    fn contains(&self, point: DVec3) -> bool {
        self.normal.dot(point - self.centre) < 0.0
    }

    fn bounds(&self) -> Bounds {
        if self.normal == DVec3::ZERO || self.radius == 0.0 || self.hole > self.radius {
            return Bounds::EMPTY;
        }
        // A circle perpendicular to n extends r * sqrt(1 - n_i^2) along axis i.
        let n = self.normal;
        let reach = DVec3::new(n.y.hypot(n.z), n.z.hypot(n.x), n.x.hypot(n.y));
        // The normal is a unit vector only up to rounding, and the points of the ring lie in its plane only up to
        // rounding.
        let slack = 8.0 * f64::EPSILON * (self.centre.abs().max_element() + self.radius);
        let reach = reach * self.radius + slack;
        Bounds::new(self.centre - reach, self.centre + reach)
    }

    fn extends_beyond_bounds(&self) -> bool {
        true
    }

    fn povray_box(&self) -> Option<(Bounds, DAffine3)> {
        let corner = DVec3::new(self.radius, self.radius, HALF_HEIGHT);
        let stored = Bounds::new(-corner, corner);
        Some((stored, along(self.normal, self.centre)))
    }

    fn rounded(&self, steps: &Steps<'_>) -> Option<Rounded> {
        Some(Rounded::of_disc(self, steps))
    }

    fn decides_ties(&self) -> bool {
        true
    }

    fn absorb(&mut self, step: &Step) -> bool {
        match step {
            Step::Translate(by) => self.centre += *by,
            Step::Rotate(degrees) => {
                let turn = rotation(*degrees);
                self.centre = turn * self.centre;
                self.normal = turn * self.normal;
            }
            Step::Scale(by) => {
                let Some(factor) = uniform_scale(*by) else {
                    return false;
                };
                self.centre *= *by;
                self.normal *= by.signum();
                self.radius *= factor;
                self.hole *= factor;
            }
            Step::General(_) => return false,
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::math::Transform;
    use crate::scene::shape::Crossing;
    use crate::scene::shape::tests::check;

    fn disc(text: &str) -> Disc {
        Disc::read(&mut TextArgs::new(text)).unwrap()
    }

    fn is_hit(disc: &Disc, x: f64) -> bool {
        let ray = Ray::new(DVec3::new(x, 0.0, -3.0), DVec3::Z);
        disc.nearest(&ray, 0.0, f64::INFINITY).is_some()
    }

    #[test]
    fn a_scale_by_a_power_of_two_is_absorbed_exactly() {
        check::absorbs_scales_exactly(&disc("<1,2,-3>, <1,3,2>, 2, 0.5"));
    }

    #[test]
    fn it_is_a_half_space_with_a_ring() {
        let ring = disc("<1,2,3>, <1,-1,2>, 2, 0.5");
        check::half_space(&ring);
        check::scales_exactly(&ring, |k| Disc {
            centre: ring.centre * k,
            radius: ring.radius * k,
            hole: ring.hole * k,
            ..ring
        });
    }

    #[test]
    fn both_edges_of_the_ring_are_hit() {
        let ring = disc("<0,0,0>, <0,0,1>, 2, 1");
        let seen = [0.5, 1.0, 1.5, 2.0, 2.1].map(|x| is_hit(&ring, x));
        assert_eq!(seen, [false, true, true, true, false]);
    }

    #[test]
    fn negative_radii_are_absolute_values() {
        assert_eq!(
            disc("<0,0,0>, <0,0,1>, -1, -.5"),
            disc("<0,0,0>, <0,0,1>, 1, .5")
        );
        assert!(!is_hit(&disc("<0,0,0>, <0,0,1>, 1, 1.5"), 1.2));
    }

    #[test]
    fn outside_the_ring_the_half_space_is_crossed_invisibly() {
        let mut roots = Vec::new();
        let ray = Ray::new(DVec3::new(5.0, 0.0, -3.0), DVec3::Z);
        let start = disc("<0,0,1>, <0,0,1>, 1").roots(&ray, &mut roots);
        assert_eq!(start, Start::Inside);
        assert_eq!(
            (roots[0].t, roots[0].crossing, roots[0].is_visible),
            (4.0, Crossing::Leave, false)
        );
    }

    #[test]
    fn a_disc_without_a_normal_gives_a_warning_and_is_empty() {
        let mut args = TextArgs::new("<0,0,0>, <0,0,0>, 1");
        assert!(Disc::read(&mut args).unwrap().bounds().is_empty());
        assert_eq!(args.warnings().len(), 1);
    }

    #[test]
    fn an_absorbed_mirroring_flips_the_normal() {
        let steps = [
            Step::Scale(DVec3::new(2.0, 2.0, -2.0)),
            Step::Rotate(DVec3::new(10.0, 20.0, 30.0)),
            Step::Translate(DVec3::new(0.3, 0.2, 0.1)),
        ];
        let original = disc("<1,2,3>, <1,-1,2>, 2, 0.5");
        let mut moved = original;
        assert!(steps.iter().all(|step| moved.absorb(step)));
        check::same_inside(&original, &moved, &Transform::from_steps(&steps));
    }
}
