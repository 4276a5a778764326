//! `torus { major radius, minor radius [spindle mode] [sturm] }`: a ring about the y axis.
//!
//! With `ρ = √(x² + z²)` the surface is `g = (ρ − R)² + y² − r² = 0`. The quartic of a ray is the product of `g` and
//! `k = (ρ + R)² + y² − r²`. Written with `a = ρ² − R²` and `b = y² − r²`, both small near the tube, that product is
//! `(a + b)² + 4R²·b`: nothing large cancels, however thin the torus is.
//!
//! The ray is clipped to the slab and the annulus around the tube, which leaves one or two short segments; on each the
//! quartic is centred and scaled to -1..1, rejected by its Bernstein coefficients or searched for sign changes
//! ([`quartic_sign_changes`]), and every root is refined on the distance from the tube itself.
//!
//! Error bound: every root lies within 16 roundings of the problem's size (`|O| + |t·D| + R + r`, by coordinates) of
//! the surface, and no root deeper than that is lost (`shape/oracle.rs` tests it in exact integer arithmetic). On this
//! path 999 in a thousand of 360,000 rays in 36 families (`tools/stability`) have 0.44 roundings at most, and the
//! worst, which leaves the surface at a grazing angle, 12.1; the fast path was not measured on those.
//!
//! That is the robust path. Most rays take a fast path to the same roots, which also runs on ray packets
//! ([`super::torus_packet`]).
//!
//! A spindle torus (`r > R`) is solid where `g <= 0`. Its inner lemon, `k = 0`, lies in the solid and is visible, as in
//! POV-Ray: a crossing that does not change the inside. The modes of POV-Ray 3.8 hide the lemon, cut it away or leave it
//! alone ([`Spindle`]). `sturm` is accepted and ignored; there is one solver. A torus
//! with a negative radius is never hit; POV-Ray draws nothing of one with a negative minor radius alone, and of the
//! others what its bounding boxes leave.

use crate::base::args::{Args, Parse, Word, since_3_8};
use crate::base::math::conditioning::{RescaledRay, is_comfortable, is_comfortable_size};
use crate::base::math::roots::bracket::Roots;
use crate::base::math::roots::polynomial::is_quartic_positive;
use crate::base::math::roots::quartic::quartic_sign_changes;
use crate::base::math::roots::ray_sphere::sphere_span;
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::shape::ray_packet::RayPacket;
use crate::scene::shape::{Crossing, Geometry, Root, Start, first_visible, read, uniform_scale};
use glam::{DAffine3, DMat3, DVec3};
use smallvec::SmallVec;
use std::f64::consts::{PI, TAU};

/// The tube is clipped a little wide, so that the ends of a segment lie well outside and rounding cannot hide a root.
pub(crate) const CLIP: f64 = 1.001;

/// With a major radius below this share of the minor one, apple and lemon are closer than the quartic can resolve; they
/// are then drawn as the sphere between them.
pub(crate) const SPHERE_RATIO: f64 = 1e-7;

/// A refinement step larger than this share of the segment is rejected.
pub(crate) const REFINEMENT: f64 = 1e-6;

const TUBE: u32 = 0;
const LEMON: u32 = 1;

/// A torus about a line parallel to the y axis. Face 0 is the tube, 1 the inner lemon of a spindle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torus {
    /// The centre.
    pub centre: DVec3,
    /// Distance from the centre to the middle of the tube.
    pub major: f64,
    /// Distance from the middle of the tube to the surface.
    pub minor: f64,
    /// Treatment of the inner lemon.
    pub spindle: Spindle,
}

/// Treatment of the lemon in which a spindle torus intersects itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Spindle {
    /// A part of the solid; its surface is visible.
    #[default]
    Union,
    /// A part of the solid without a surface of its own.
    Merge,
    /// Cut out of the solid.
    Difference,
    /// The whole solid.
    Intersection,
}

/// The roots on one ray.
pub(crate) type Crossings = SmallVec<[Root; 4]>;

/// A segment of a ray about the origin, in units of the minor radius: `middle + x · half` for `-1 <= x <= 1`.
struct Segment {
    middle: DVec3,
    half: DVec3,
    /// The major radius in units of the minor one.
    major: f64,
}

impl Torus {
    /// Reads `major radius, minor radius [union | merge | difference | intersection] [sturm]`.
    ///
    /// # Errors
    /// Malformed or non-finite parameters; a mode before version 3.8.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let at = args.span();
        let major = read::number(args, "the major radius of the torus")?;
        let minor = read::number(args, "the minor radius of the torus")?;
        let spindle = Spindle::read(args)?;
        if spindle == Spindle::Intersection && minor <= major {
            args.warn(Diagnostic::warning(
                at.to(args.last_span()),
                "a torus with a hole has no spindle: its `intersection` is empty",
            ));
        }
        if args.accept(Word::Sturm)? {
            args.float_or(1.0)?;
        }
        Ok(Torus {
            centre: DVec3::ZERO,
            major,
            minor,
            spindle,
        })
    }

    fn is_empty(&self) -> bool {
        let has_no_spindle = self.spindle == Spindle::Intersection && self.minor <= self.major;
        self.major < 0.0 || self.minor <= 0.0 || has_no_spindle
    }

    /// The upper corner of its bounds around its centre.
    fn reach(&self) -> DVec3 {
        let rim = self.major + self.minor;
        DVec3::new(rim, self.minor, rim)
    }

    fn crossings(&self, ray: &Ray) -> Crossings {
        if self.is_empty() {
            return Crossings::new();
        }
        if self.supports_packets()
            && let Some(roots) = self.fast_crossings(ray)
        {
            return roots;
        }
        self.robust_crossings(ray)
    }

    /// The roots by the fast path, or `None` if it is inconclusive.
    #[inline]
    pub(crate) fn fast_crossings(&self, ray: &Ray) -> Option<Crossings> {
        let packet = self.root_packet(&RayPacket::<f64>::of(ray));
        let mut roots = Crossings::new();
        for (slot, &t) in packet.t.iter().enumerate() {
            if packet.hit_masks[slot] != 0 {
                let crossing = [Crossing::Enter, Crossing::Leave][slot % 2];
                roots.push(root(t, crossing, TUBE));
            }
        }
        (packet.unknown == 0).then_some(roots)
    }

    #[inline(never)]
    pub(crate) fn robust_crossings(&self, ray: &Ray) -> Crossings {
        let about = Ray::new(ray.origin - self.centre, ray.dir);
        let size = self.major + self.minor;
        if is_comfortable(size, ray.dir.dot(ray.dir), about.origin.dot(about.origin)) {
            return self.comfortable_crossings(&about);
        }
        self.far_crossings(&about, size)
    }

    #[cold]
    fn far_crossings(&self, about: &Ray, size: f64) -> Crossings {
        let Some(rescaled) = RescaledRay::new(about, size) else {
            return Crossings::new();
        };
        let small = Torus {
            centre: DVec3::ZERO,
            major: self.major / rescaled.size,
            minor: self.minor / rescaled.size,
            spindle: self.spindle,
        };
        let mut roots = small.comfortable_crossings(&rescaled.ray);
        for root in &mut roots {
            root.t = rescaled.t(root.t);
        }
        if roots.iter().all(|root| root.t.is_finite()) {
            roots
        } else {
            Crossings::new()
        }
    }

    fn comfortable_crossings(&self, ray: &Ray) -> Crossings {
        let mut roots = Crossings::new();
        if self.major < SPHERE_RATIO * self.minor {
            if self.spindle == Spindle::Difference {
                return roots;
            }
            if let Some((enter, leave)) = sphere_span(ray.origin, ray.dir, self.minor) {
                roots.push(root(enter, Crossing::Enter, TUBE));
                roots.push(root(leave, Crossing::Leave, TUBE));
            }
            return roots;
        }
        let Some((from, to)) = self.clip(ray) else {
            return roots;
        };
        match self.hole(ray, from, to) {
            Some((enter, leave)) => {
                self.solve(ray, from, enter, &mut roots);
                self.solve(ray, leave, to, &mut roots);
            }
            None => self.solve(ray, from, to, &mut roots),
        }
        roots
    }

    /// The interval between the planes and within the cylinder around the tube.
    fn clip(&self, ray: &Ray) -> Option<(f64, f64)> {
        let height = self.minor * CLIP;
        let (mut from, mut to) = if ray.dir.y == 0.0 {
            if ray.origin.y.abs() > height {
                return None;
            }
            (f64::NEG_INFINITY, f64::INFINITY)
        } else {
            let down = (-height - ray.origin.y) / ray.dir.y;
            let up = (height - ray.origin.y) / ray.dir.y;
            (down.min(up), down.max(up))
        };
        let (p, dir) = (flat(ray.origin), flat(ray.dir));
        let rim = self.major + height;
        if dir.dot(dir) > 0.0 {
            let (enter, leave) = sphere_span(p, dir, rim)?;
            (from, to) = (from.max(enter), to.min(leave));
        } else if p.dot(p) > rim * rim {
            return None;
        }
        (from < to && to - from < f64::INFINITY).then_some((from, to))
    }

    /// The part of an interval in the hole of the ring; out of order, and so without effect, where it lies outside.
    fn hole(&self, ray: &Ray, from: f64, to: f64) -> Option<(f64, f64)> {
        let radius = self.major - self.minor * CLIP;
        if radius <= 0.0 {
            return None;
        }
        let (p, dir) = (flat(ray.origin), flat(ray.dir));
        if dir.dot(dir) == 0.0 {
            return (p.dot(p) < radius * radius).then_some((from, to));
        }
        let (enter, leave) = sphere_span(p, dir, radius)?;
        Some((enter.min(to), leave.max(from)))
    }

    /// Appends the roots on one segment, whose ends lie outside the torus.
    fn solve(&self, ray: &Ray, from: f64, to: f64, roots: &mut Crossings) {
        if to <= from {
            return;
        }
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let segment = Segment {
            middle: ray.at(middle) / self.minor,
            half: ray.dir * half / self.minor,
            major: self.major / self.minor,
        };
        let quartic = segment.quartic();
        if is_quartic_positive(&quartic) {
            return;
        }
        let params = segment.refined(outside_at_ends(&quartic, quartic_sign_changes(&quartic)));
        let t = |i: usize| middle + half * params[i];
        let count = params.len();
        let has_lemon = count == 4 && segment.is_in_lemon(0.5 * (params[1] + params[2]));
        for i in 0..count {
            let is_lemon = has_lemon && (i == 1 || i == 2);
            let alternating = [Crossing::Enter, Crossing::Leave][i % 2];
            let crossing = match (self.spindle, is_lemon) {
                (Spindle::Merge, true) | (Spindle::Intersection, false) => continue,
                (Spindle::Union, true) => Crossing::Touch,
                (Spindle::Intersection, true) if i == 1 => Crossing::Enter,
                (Spindle::Intersection, true) => Crossing::Leave,
                (Spindle::Difference, _) | (_, false) => alternating,
            };
            roots.push(root(t(i), crossing, if is_lemon { LEMON } else { TUBE }));
        }
    }
}

impl Spindle {
    /// Reads the mode, if there is one.
    fn read(args: &mut dyn Args) -> Parse<Self> {
        let modes = [
            (Word::Union, Spindle::Union),
            (Word::Merge, Spindle::Merge),
            (Word::Difference, Spindle::Difference),
            (Word::Intersection, Spindle::Intersection),
        ];
        for (word, spindle) in modes {
            if args.accept(word)? {
                since_3_8(args, word, Word::Torus)?;
                return Ok(spindle);
            }
        }
        Ok(Spindle::Union)
    }
}

/// For rays from so far away that clipping has no digits left an end may lie inside; then the end of the segment closes
/// the span.
fn outside_at_ends(quartic: &[f64; 5], mut params: Roots) -> Roots {
    if params.len() % 2 == 1 {
        let [c0, c1, c2, c3, c4] = *quartic;
        if c0 - c1 + c2 - c3 + c4 < 0.0 {
            params.insert(0, -1.0);
        } else {
            params.push(1.0);
        }
    }
    params
}

impl Segment {
    /// The coefficients of `((a + b) / 2R)² + b` by rising power, with r = 1.
    fn quartic(&self) -> [f64; 5] {
        let (p, v) = (self.middle, self.half);
        let axis_distance = flat(p).length();
        let b = [(p.y - 1.0) * (p.y + 1.0), 2.0 * p.y * v.y, v.y * v.y];
        let a = [
            (axis_distance - self.major) * (axis_distance + self.major),
            2.0 * flat(p).dot(flat(v)),
            flat(v).dot(flat(v)),
        ];
        let s = [0, 1, 2].map(|i| (a[i] + b[i]) / (2.0 * self.major));
        [
            s[0] * s[0] + b[0],
            2.0 * s[0] * s[1] + b[1],
            s[1] * s[1] + 2.0 * s[0] * s[2] + b[2],
            2.0 * s[1] * s[2],
            s[2] * s[2],
        ]
    }

    fn is_in_lemon(&self, x: f64) -> bool {
        let p = self.middle + x * self.half;
        (flat(p).length() + self.major).hypot(p.y) < 1.0
    }

    /// The roots after two Newton steps on the distance from the surface; unchanged if that breaks their order.
    fn refined(&self, params: Roots) -> Roots {
        let mut moved = Roots::new();
        for x in &params {
            moved.push(self.refine(self.refine(*x)));
        }
        let is_in_order = moved.windows(2).all(|pair| pair[0] < pair[1]);
        if is_in_order { moved } else { params }
    }

    /// One Newton step on the distance from the nearer of tube and lemon.
    fn refine(&self, x: f64) -> f64 {
        let p = self.middle + x * self.half;
        let axis_distance = flat(p).length();
        let outward = flat(p).dot(flat(self.half)) / axis_distance;
        let off_axis = |middle: f64| {
            let across = axis_distance - middle;
            let from_middle = (across * across + p.y * p.y).sqrt();
            let slope = (across * outward + p.y * self.half.y) / from_middle;
            (from_middle - 1.0, slope)
        };
        let (tube, lemon) = (off_axis(self.major), off_axis(-self.major));
        let (distance, slope) = if lemon.0.abs() < tube.0.abs() {
            lemon
        } else {
            tube
        };
        let step = distance / slope;
        if step.abs() < REFINEMENT { x - step } else { x }
    }
}

/// Component perpendicular to the axis.
fn flat(v: DVec3) -> DVec3 {
    DVec3::new(v.x, 0.0, v.z)
}

fn root(t: f64, crossing: Crossing, face: u32) -> Root {
    Root {
        t,
        crossing,
        face,
        is_visible: true,
    }
}

impl Geometry for Torus {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        roots.extend_from_slice(&self.crossings(ray));
        Start::Outside
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        if self.supports_packets() {
            let rays = RayPacket::<f64>::of(ray);
            let nearest = self.nearest_packet::<f64, false>(&rays, from, to, [0, 0], 0b1111);
            if nearest.unknown == 0 {
                let crossing =
                    [Crossing::Enter, Crossing::Leave][usize::from(nearest.exit_mask != 0)];
                let is_hit = nearest.hit_mask != 0 && nearest.t < to;
                return is_hit.then(|| root(nearest.t, crossing, TUBE));
            }
            return first_visible(&self.robust_crossings(ray), from, to);
        }
        first_visible(&self.crossings(ray), from, to)
    }

    /// Only from the outer half of a ring, which is a part of its convex hull.
    fn is_exiting(&self, ray: &Ray) -> bool {
        self.is_exiting_packet(&RayPacket::<f64>::of(ray))
    }

    fn bounding_sphere(&self) -> Option<(DVec3, f64)> {
        Some((self.centre, self.major + self.minor))
    }

    fn tight_extent(&self, matrix: &DMat3) -> Option<(DVec3, DVec3)> {
        let rows = matrix.transpose();
        let mut reach = [0.0; 3];
        for (reach, row) in reach
            .iter_mut()
            .zip([rows.x_axis, rows.y_axis, rows.z_axis])
        {
            let size = row.length();
            if !is_comfortable_size(size) {
                return None;
            }
            let across = (row.x * row.x + row.z * row.z).sqrt();
            *reach = self.major * across + self.minor * size;
        }
        Some((self.centre, DVec3::from_array(reach)))
    }

    fn normal(&self, point: DVec3, face: u32) -> DVec3 {
        let p = point - self.centre;
        let outward = flat(p).normalize_or_zero();
        let major = if face == LEMON {
            -self.major
        } else {
            self.major
        };
        let normal = match (self.spindle, face) {
            (Spindle::Difference, LEMON) => major * outward - p,
            _ => p - major * outward,
        };
        // Zero only in the point where a horn torus touches itself.
        if normal == DVec3::ZERO {
            DVec3::Y
        } else {
            normal
        }
    }

    /// The side of the lemon towards its inside has the `interior_texture`, cut out or not.
    fn shading_normal(&self, point: DVec3, face: u32) -> Option<DVec3> {
        let is_turned = self.spindle == Spindle::Difference && face == LEMON;
        is_turned.then(|| -self.normal(point, face))
    }

    fn contains(&self, point: DVec3) -> bool {
        if self.is_empty() {
            return false;
        }
        let p = (point - self.centre) / self.minor;
        let is_within = |major: f64| {
            let across = p.x.hypot(p.z) - major / self.minor;
            across * across + p.y * p.y <= 1.0
        };
        match self.spindle {
            Spindle::Union | Spindle::Merge => is_within(self.major),
            Spindle::Difference => is_within(self.major) && !is_within(-self.major),
            Spindle::Intersection => is_within(-self.major),
        }
    }

    fn bounds(&self) -> Bounds {
        if self.is_empty() {
            return Bounds::EMPTY;
        }
        let reach = self.reach();
        Bounds::new(self.centre - reach, self.centre + reach)
    }

    fn povray_box(&self) -> Option<(Bounds, DAffine3)> {
        let reach = self.reach();
        let to_centre = DAffine3::from_translation(self.centre);
        (!self.is_empty()).then(|| (Bounds::new(-reach, reach), to_centre))
    }

    fn absorb(&mut self, step: &Step) -> bool {
        match step {
            Step::Translate(by) => self.centre += *by,
            Step::Scale(by) => {
                let Some(factor) = uniform_scale(*by) else {
                    return false;
                };
                self.centre *= *by;
                self.major *= factor;
                self.minor *= factor;
            }
            Step::Rotate(_) | Step::General(_) => return false,
        }
        true
    }

    /// `u` goes around the axis from -x over +z to +x, `v` around the tube from its inside over the bottom.
    fn uv(&self, point: DVec3, _face: u32) -> Option<[f64; 2]> {
        let p = point - self.centre;
        let around_tube = p.y.atan2(p.x.hypot(p.z) - self.major);
        Some([1.0 - (p.z.atan2(p.x) + PI) / TAU, (around_tube + PI) / TAU])
    }

    fn loses_uv(&self) -> bool {
        true
    }

    fn takes_sturm(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::math::Transform;
    use crate::scene::shape::tests::check;

    fn torus(major: f64, minor: f64) -> Torus {
        Torus {
            centre: DVec3::ZERO,
            major,
            minor,
            spindle: Spindle::Union,
        }
    }

    #[test]
    fn spindle_modes_are_solids_and_differ_in_the_lemon() {
        let ray = Ray::new(DVec3::new(-5.0, 0.0, 0.0), DVec3::X);
        for (mode, depths, holds_centre) in [
            ("union", vec![3.5, 4.5, 5.5, 6.5], true),
            ("merge", vec![3.5, 6.5], true),
            ("difference", vec![3.5, 4.5, 5.5, 6.5], false),
            ("intersection", vec![4.5, 5.5], true),
        ] {
            let text = format!("0.5, 1 {mode}");
            let spindle = Torus::read(&mut TextArgs::new(&text).at_version(3.8)).unwrap();
            check::solid(&spindle);
            let roots = spindle.crossings(&ray);
            assert_eq!(roots.iter().map(|root| root.t).collect::<Vec<_>>(), depths);
            assert_eq!(spindle.contains(DVec3::ZERO), holds_centre);
            assert!(Torus::read(&mut TextArgs::new(&text)).is_err());
        }
    }

    #[test]
    fn ring_horn_and_spindle_are_solids() {
        for (major, minor) in [(1.0, 0.3), (1.0, 1.0), (0.5, 1.0), (0.02, 1.0), (1.0, 0.01)] {
            check::solid(&torus(major, minor));
        }
    }

    #[test]
    fn it_scales_exactly() {
        let centre = DVec3::new(0.3, -0.2, 0.1);
        check::scales_exactly(&torus(1.0, 0.3), |k| torus(k, 0.3 * k));
        let moved = |k: f64| Torus {
            centre: centre * k,
            ..torus(0.5 * k, 0.8 * k)
        };
        check::scales_exactly(&moved(1.0), moved);
    }

    #[test]
    fn a_ray_through_the_ring_enters_and_leaves_twice() {
        let ray = Ray::new(DVec3::new(-5.0, 0.0, 0.0), DVec3::X);
        let roots = torus(1.0, 0.25).crossings(&ray);
        let depths: Vec<f64> = roots.iter().map(|root| root.t).collect();
        assert_eq!(depths, [3.75, 4.25, 5.75, 6.25]);
    }

    #[test]
    fn the_lemon_of_a_spindle_is_seen_inside_the_solid() {
        let ray = Ray::new(DVec3::new(-5.0, 0.0, 0.0), DVec3::X);
        let roots = torus(0.5, 1.0).crossings(&ray);
        let hits: Vec<_> = roots.iter().map(|r| (r.t, r.crossing, r.face)).collect();
        assert_eq!(
            hits,
            [
                (3.5, Crossing::Enter, TUBE),
                (4.5, Crossing::Touch, LEMON),
                (5.5, Crossing::Touch, LEMON),
                (6.5, Crossing::Leave, TUBE)
            ]
        );
        assert!(torus(0.5, 1.0).contains(DVec3::ZERO));
        assert!(!torus(1.0, 0.5).contains(DVec3::ZERO));
    }

    #[test]
    fn a_ray_along_the_axis_hits_the_tips_or_nothing() {
        for zero in [0.0, -0.0] {
            let ray = Ray::new(DVec3::new(0.0, 5.0, 0.0), DVec3::new(zero, -1.0, zero));
            assert!(torus(1.0, 0.3).crossings(&ray).is_empty());
            let beside = Ray::new(DVec3::new(1.0, 5.0, 0.0), ray.dir);
            let roots = torus(1.0, 0.25).crossings(&beside);
            assert_eq!(roots.iter().map(|r| r.t).collect::<Vec<_>>(), [4.75, 5.25]);
        }
    }

    #[test]
    fn negative_and_zero_radii_are_never_hit() {
        let ray = Ray::new(DVec3::new(-5.0, 0.0, 0.0), DVec3::X);
        for (major, minor) in [(1.0, -0.3), (1.0, 0.0), (-1.0, 0.3)] {
            assert!(torus(major, minor).crossings(&ray).is_empty());
            assert!(torus(major, minor).bounds().is_empty());
            assert!(!torus(major, minor).contains(DVec3::X));
        }
    }

    #[test]
    fn extreme_units_change_nothing() {
        for scale in [1e-300, 1e-150, 1e150, 1e300] {
            let ray = Ray::new(DVec3::new(-5.0, 0.0, 0.0) * scale, DVec3::X);
            let roots = torus(scale, 0.25 * scale).crossings(&ray);
            for (root, expected) in roots.iter().zip([3.75, 4.25, 5.75, 6.25]) {
                assert!((root.t / scale - expected).abs() < 4e-15);
            }
            assert_eq!(roots.len(), 4);
        }
    }

    #[test]
    fn sturm_is_read_with_and_without_a_value() {
        for text in ["1, .3 sturm", "1 .3 sturm 0", "1, .3"] {
            let mut args = TextArgs::new(text);
            assert_eq!(Torus::read(&mut args).unwrap(), torus(1.0, 0.3));
            assert!(args.is_done());
        }
    }

    #[test]
    fn moves_and_even_scalings_are_absorbed() {
        let steps = [
            Step::Translate(DVec3::new(0.3, 0.2, 0.1)),
            Step::Scale(DVec3::new(2.0, -2.0, 2.0)),
        ];
        let mut moved = torus(3.0, 1.0);
        assert!(steps.iter().all(|step| moved.absorb(step)));
        check::same_inside(&torus(3.0, 1.0), &moved, &Transform::from_steps(&steps));
        assert!(!moved.absorb(&Step::Rotate(DVec3::X)));
    }

    #[test]
    fn u_turns_around_the_axis_and_v_around_the_tube() {
        assert_eq!(
            torus(1.0, 0.5).uv(DVec3::new(1.5, 0.0, 0.0), 0),
            Some([0.5, 0.5])
        );
        assert_eq!(
            torus(1.0, 0.5).uv(DVec3::new(0.0, 0.5, 1.0), 0),
            Some([0.25, 0.75])
        );
    }
}
