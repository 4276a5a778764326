//! Shared parts of cylinders and cones: an axis between two caps, and the interval of a ray between the planes of the
//! caps.

use crate::base::math::conditioning::unit;
use crate::base::math::simd::F64Lanes;
use crate::base::math::simd::vec3::{dot, splat, sub};
use crate::base::math::{Bounds, Ray, Step, rotation};
use crate::scene::shape::ray_packet::RayPacket;
use crate::scene::shape::{
    CLEAR_MARGIN, Crossing, Root, SpanEnd, WELL_INSIDE, along, span, uniform_scale,
};
use glam::{DAffine3, DVec3};

pub(crate) const SIDE: u32 = 0;
pub(crate) const BASE: u32 = 1;
pub(crate) const APEX: u32 = 2;

/// An axis from the centre of one cap to the centre of the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Axis {
    pub(crate) base: DVec3,
    pub(crate) apex: DVec3,
    /// Unit direction from base to apex.
    pub(crate) unit: DVec3,
}

/// Interval of a ray between the planes of the caps, each end with the face that it lies on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slab {
    pub(crate) enter: SpanEnd,
    pub(crate) leave: SpanEnd,
}

impl Axis {
    /// `None` if the ends coincide.
    pub(crate) fn new(base: DVec3, apex: DVec3) -> Option<Self> {
        let unit = unit(apex - base)?;
        Some(Axis { base, apex, unit })
    }

    /// The box in which POV-Ray stores a cylinder or cone: along the axis from the narrower end to the wider one, with
    /// the wider radius throughout. Lengths are 1 for the wider radius and for the whole cone with its tip; a cylinder
    /// has none.
    pub(crate) fn held_box(&self, base_radius: f64, apex_radius: f64) -> (Bounds, DAffine3) {
        let (start, dir, [narrow, wide]) = if apex_radius > base_radius {
            (self.base, self.unit, [base_radius, apex_radius])
        } else {
            (self.apex, -self.unit, [apex_radius, base_radius])
        };
        let length = self.length();
        let tip = if narrow < wide {
            narrow * length / (wide - narrow)
        } else {
            0.0
        };
        let whole = tip + length;
        let stored = Bounds::new(DVec3::new(-1.0, -1.0, tip / whole), DVec3::ONE);
        let scale = DAffine3::from_scale(DVec3::new(wide, wide, whole));
        (stored, along(dir, start - tip * dir) * scale)
    }

    pub(crate) fn length(&self) -> f64 {
        self.unit.dot(self.apex - self.base)
    }

    /// The component of a vector perpendicular to the axis.
    #[inline]
    pub(crate) fn across(&self, v: DVec3) -> DVec3 {
        v - self.unit.dot(v) * self.unit
    }

    /// True if a ray starts on or outside the surface of a cone and goes away from it. The cone has this radius at the
    /// base, growing by `slope` towards the apex.
    pub(crate) fn is_exiting(&self, ray: &Ray, base_radius: f64, slope: f64) -> bool {
        let p = ray.origin - self.base;
        let (height, length) = (self.unit.dot(p), self.length());
        let dir_height = self.unit.dot(ray.dir);
        let margin = (1.0 - WELL_INSIDE) * length;
        if height > length - margin && dir_height > 0.0 || height < margin && dir_height < 0.0 {
            return true;
        }
        let radial = self.across(p);
        let distance = radial.length();
        let radius = base_radius + slope * height;
        distance > WELL_INSIDE * radius && radial.dot(ray.dir) > slope * dir_height * distance
    }

    /// The root that a ray is known to have at `t` on a closed cone; `None` unless it lies clearly on the side or on one
    /// cap. The cone has `base_radius` at the base, growing by `slope` towards the apex, and at most `max_radius`.
    #[inline(always)]
    pub(crate) fn root_at(
        &self,
        ray: &Ray,
        t: f64,
        base_radius: f64,
        max_radius: f64,
        slope: f64,
    ) -> Option<Root> {
        let (from_base, displacement) = (ray.origin - self.base, t * ray.dir);
        let p = from_base + displacement;
        let to_apex = self.apex - self.base;
        let height = self.unit.dot(p);
        let to_top = self.unit.dot(to_apex) - height;
        let radial = p - height * self.unit;
        let radius = base_radius + slope * height;
        let lengths = from_base.abs() + displacement.abs() + to_apex.abs();
        let margin = CLEAR_MARGIN * (lengths.max_element() + max_radius) * (1.0 + slope * slope);
        let is_on_cap = radial.length_squared() < (radius - margin) * (radius - margin);
        let rise = self.unit.dot(ray.dir);
        let outward = radial.dot(ray.dir) - radius * slope * rise;
        let (enters, is_sure, face) = match (height > margin, to_top > margin) {
            (true, true) => {
                let is_sure = outward.abs() > margin * ray.dir.abs().max_element();
                (outward < 0.0, is_sure, SIDE)
            }
            (false, true) => (rise > 0.0, is_on_cap && rise != 0.0, BASE),
            (true, false) => (rise < 0.0, is_on_cap && rise != 0.0, APEX),
            (false, false) => return None,
        };
        (is_sure && radius > margin).then_some(Root {
            t,
            crossing: match enters {
                true => Crossing::Enter,
                false => Crossing::Leave,
            },
            face,
            is_visible: true,
        })
    }

    /// Computes `t` at the caps from their own centres, so that the cap of an upright cylinder gets the same bits as
    /// the face of a box at that height.
    #[inline]
    pub(crate) fn slab(&self, ray: &Ray) -> Option<Slab> {
        let slope = self.unit.dot(ray.dir);
        let to_base = self.unit.dot(self.base - ray.origin);
        let to_apex = self.unit.dot(self.apex - ray.origin);
        if slope == 0.0 {
            return (to_base <= 0.0 && to_apex >= 0.0).then_some(Slab {
                enter: SpanEnd::new(f64::NEG_INFINITY, BASE),
                leave: SpanEnd::new(f64::INFINITY, APEX),
            });
        }
        let (base, apex) = (
            SpanEnd::new(to_base / slope, BASE),
            SpanEnd::new(to_apex / slope, APEX),
        );
        let (enter, leave) = if slope > 0.0 {
            (base, apex)
        } else {
            (apex, base)
        };
        Some(Slab { enter, leave })
    }

    /// Same for a ray packet: where each ray enters and leaves, and the component of its direction along the axis.
    #[inline(always)]
    pub(crate) fn slab_packet<F: F64Lanes>(&self, rays: &RayPacket<F>) -> (F, F, F) {
        let unit = splat(self.unit);
        let slope = dot(unit, rays.dir);
        let to_base = dot(unit, sub(splat(self.base), rays.origin)) / slope;
        let to_apex = dot(unit, sub(splat(self.apex), rays.origin)) / slope;
        let is_up = F::splat(0.0).lt(slope);
        let enter = F::select(is_up, to_base, to_apex);
        let leave = F::select(is_up, to_apex, to_base);
        (enter, leave, slope)
    }

    /// The height of a point above the base, and its depth below the apex.
    pub(crate) fn heights(&self, point: DVec3) -> (f64, f64) {
        (
            self.unit.dot(point - self.base),
            self.unit.dot(self.apex - point),
        )
    }

    /// Bounding box of the discs of these radii at both ends.
    pub(crate) fn bounds(&self, base_radius: f64, apex_radius: f64) -> Bounds {
        let u = self.unit;
        let radial = |a: f64, b: f64| (a * a + b * b).sqrt();
        let reach = DVec3::new(radial(u.y, u.z), radial(u.z, u.x), radial(u.x, u.y));
        // The axis is a unit vector only to rounding.
        let size =
            self.base.abs().max(self.apex.abs()).max_element() + base_radius.max(apex_radius);
        let slack = 8.0 * f64::EPSILON * size;
        let disc = |centre: DVec3, radius: f64| {
            let reach = reach * radius + slack;
            Bounds::new(centre - reach, centre + reach)
        };
        disc(self.base, base_radius).union(&disc(self.apex, apex_radius))
    }

    /// Applies a step that maps circles across the axis to circles, and returns the factor of their radii. `None`, and
    /// no change, for any other step.
    pub(crate) fn absorb(&mut self, step: &Step) -> Option<f64> {
        let (moved, factor) = match step {
            Step::Translate(by) => {
                let moved = Axis {
                    base: self.base + *by,
                    apex: self.apex + *by,
                    unit: self.unit,
                };
                (Some(moved), 1.0)
            }
            Step::Rotate(degrees) => {
                let rotated = rotation(*degrees);
                (Axis::new(rotated * self.base, rotated * self.apex), 1.0)
            }
            Step::Scale(by) => {
                let factor = uniform_scale(*by).or_else(|| self.round_scale(*by))?;
                // The unit vector is not that of the ends, which a step before may have rounded: a scale by a power of
                // two would change its last bits.
                let scaled = Axis::new(self.base * *by, self.apex * *by).map(|ends| Axis {
                    unit: self.unit * by.signum(),
                    ..ends
                });
                (scaled, factor)
            }
            Step::General(_) => return None,
        };
        *self = moved?;
        Some(factor)
    }

    /// The factor of the radii if the axis lies along a coordinate axis and both perpendicular axes scale equally.
    fn round_scale(&self, by: DVec3) -> Option<f64> {
        let size = by.abs();
        let (across, other) = match self.unit.abs().to_array() {
            [1.0, 0.0, 0.0] => (size.y, size.z),
            [0.0, 1.0, 0.0] => (size.z, size.x),
            [0.0, 0.0, 1.0] => (size.x, size.y),
            _ => return None,
        };
        (across == other).then_some(across)
    }
}

impl Slab {
    /// The slab between two heights above the xz plane; equal heights still give a slab.
    pub(crate) fn between(ray: &Ray, low: f64, high: f64) -> Option<Self> {
        let (slope, height) = (ray.dir.y, ray.origin.y);
        if slope == 0.0 {
            return (low <= height && height <= high).then_some(Slab {
                enter: SpanEnd::new(f64::NEG_INFINITY, BASE),
                leave: SpanEnd::new(f64::INFINITY, APEX),
            });
        }
        let (base, apex) = (
            SpanEnd::new((low - height) / slope, BASE),
            SpanEnd::new((high - height) / slope, APEX),
        );
        let (enter, leave) = if slope > 0.0 {
            (base, apex)
        } else {
            (apex, base)
        };
        Some(Slab { enter, leave })
    }

    /// Intersects the interval `from` to `to` inside the infinite side surface with the slab. On a rim the side is
    /// taken. One entry and one exit keep the parity right by construction.
    #[inline]
    pub(crate) fn clip(&self, from: f64, to: f64, is_open: bool) -> Option<[Root; 2]> {
        let enter = if self.enter.t > from {
            self.enter
        } else {
            SpanEnd::new(from, SIDE)
        };
        let leave = if self.leave.t < to {
            self.leave
        } else {
            SpanEnd::new(to, SIDE)
        };
        // A slab without height is visible; an interval of length zero on the side is not.
        let is_hit =
            enter.t < leave.t || enter.t == leave.t && enter.face != SIDE && leave.face != SIDE;
        let roots = if is_hit { span(enter, leave) } else { None }?;
        Some(roots.map(|root| Root {
            is_visible: !is_open || root.face == SIDE,
            ..root
        }))
    }
}
