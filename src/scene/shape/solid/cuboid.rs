//! `box { <corner>, <opposite corner> }`, named `Cuboid` here because `Box` is Rust's.
//!
//! Slab method: on each axis the ray lies between the two faces for an interval of `t`; the box is the intersection of
//! the three. Every depth is `(corner − origin) / dir` and nothing else, so coplanar faces get the same bits, whatever
//! box they belong to. Error bound: two roundings of the difference and one of the quotient. Edges have no tolerance. A
//! box without thickness is visible, as in POV-Ray.

use crate::base::args::{Args, Parse};
use crate::base::math::simd::F64Lanes;
use crate::base::math::{Bounds, Ray, Step};
use crate::scene::shape::packet::{SpanPacket, Vec3Lanes, splat, sub};
use crate::scene::shape::ray_packet::RayPacket;
use crate::scene::shape::{
    CLEAR_MARGIN, Crossing, FlatFace, Geometry, Root, SpanEnd, Start, WELL_INSIDE, first_visible,
    push_span, read, span,
};
use glam::DVec3;

/// An axis-aligned box. Face `2·axis` is the one with the smaller coordinate, `2·axis + 1` the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    /// The corner with the smallest coordinates.
    pub min: DVec3,
    /// The corner with the largest coordinates.
    pub max: DVec3,
}

/// Relative enlargement of the bounding sphere, more than the rounding errors of its radius.
const SPHERE_MARGIN: f64 = 1e-9;

impl Cuboid {
    /// The box between two opposite corners, in any order.
    #[must_use]
    pub fn new(a: DVec3, b: DVec3) -> Self {
        Cuboid {
            min: a.min(b),
            max: a.max(b),
        }
    }

    /// Reads `<corner>, <corner>`, in any order.
    ///
    /// # Errors
    /// Malformed or non-finite parameters.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let first = read::vector(args, "the first corner of the box")?;
        let second = read::vector(args, "the second corner of the box")?;
        Ok(Cuboid::new(first, second))
    }

    #[inline]
    fn span(&self, ray: &Ray) -> Option<[Root; 2]> {
        let to_min = (self.min - ray.origin) / ray.dir;
        let to_max = (self.max - ray.origin) / ray.dir;
        let (mut near, mut far) = (to_min.min(to_max), to_min.max(to_max));
        let is_parallel = ray.dir.cmpeq(DVec3::ZERO);
        if is_parallel.any() {
            let is_between = ray.origin.cmpge(self.min) & ray.origin.cmple(self.max);
            if (is_parallel & !is_between).any() {
                return None;
            }
            near = DVec3::select(is_parallel, DVec3::NEG_INFINITY, near);
            far = DVec3::select(is_parallel, DVec3::INFINITY, far);
        }
        let (enter, leave) = (near.max_element(), far.min_element());
        if enter > leave {
            return None;
        }
        let enter_axis = squarest(near, enter, ray.dir);
        let leave_axis = squarest(far, leave, ray.dir);
        span(
            SpanEnd::new(enter, face(enter_axis, ray.dir[enter_axis] < 0.0)),
            SpanEnd::new(leave, face(leave_axis, ray.dir[leave_axis] > 0.0)),
        )
    }

    /// Spans of a ray packet. Lanes parallel to a face take the scalar path.
    #[inline(always)]
    pub(crate) fn span_packet<F: F64Lanes>(&self, rays: &RayPacket<F>) -> SpanPacket<F> {
        let to_min = depths(sub(splat(self.min), rays.origin), rays.dir);
        let to_max = depths(sub(splat(self.max), rays.origin), rays.dir);
        let [x, y, z] = [
            min_max(to_min[0], to_max[0]),
            min_max(to_min[1], to_max[1]),
            min_max(to_min[2], to_max[2]),
        ];
        let enter = x.0.lane_max(y.0.lane_max(z.0));
        let leave = x.1.lane_min(y.1.lane_min(z.1));
        let zero = F::splat(0.0);
        let is_slanted =
            zero.lt(rays.dir[0].abs()) & (zero.lt(rays.dir[1].abs()) & zero.lt(rays.dir[2].abs()));
        SpanPacket::new(enter, leave, enter.le(leave), is_slanted)
    }

    /// Position between the corners, 0 to 1 on each axis; an axis without thickness counts as 0.
    fn fractions(&self, point: DVec3) -> DVec3 {
        let size = self.max - self.min;
        DVec3::select(
            size.cmpgt(DVec3::ZERO),
            (point - self.min) / size,
            DVec3::ZERO,
        )
    }
}

#[inline(always)]
fn depths<F: F64Lanes>(to: Vec3Lanes<F>, dir: Vec3Lanes<F>) -> Vec3Lanes<F> {
    [to[0] / dir[0], to[1] / dir[1], to[2] / dir[2]]
}

#[inline(always)]
fn min_max<F: F64Lanes>(a: F, b: F) -> (F, F) {
    (a.lane_min(b), a.lane_max(b))
}

/// The axis on which `all` equals `one`; on an edge the one whose face the ray hits more squarely.
#[inline]
fn squarest(all: DVec3, one: f64, dir: DVec3) -> usize {
    let steepness = DVec3::select(all.cmpeq(DVec3::splat(one)), dir.abs(), DVec3::NEG_ONE);
    if steepness.x >= steepness.y && steepness.x >= steepness.z {
        0
    } else if steepness.y >= steepness.z {
        1
    } else {
        2
    }
}

/// The axis of a face.
#[inline]
fn axis(face: u32) -> usize {
    (face as usize / 2).min(2)
}

/// The number of the lower or the upper face across an axis.
#[inline]
fn face(axis: usize, is_upper: bool) -> u32 {
    [0, 2, 4][axis] + u32::from(is_upper)
}

impl Geometry for Cuboid {
    fn flat_face(&self, face: u32) -> Option<FlatFace> {
        let is_low = face.is_multiple_of(2);
        let corner = if is_low { self.min } else { self.max };
        let axis = axis(face);
        Some(FlatFace {
            axis,
            coordinate: corner[axis],
            is_low,
            is_closed: true,
        })
    }

    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        push_span(self.span(ray), roots)
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        first_visible(&self.span(ray)?, from, to)
    }

    /// True from a face, or from outside it, away from the box.
    fn is_exiting(&self, ray: &Ray) -> bool {
        let margin = (1.0 - WELL_INSIDE) * (self.max - self.min);
        let above = ray.origin.cmpgt(self.max - margin) & ray.dir.cmpgt(DVec3::ZERO);
        let below = ray.origin.cmplt(self.min + margin) & ray.dir.cmplt(DVec3::ZERO);
        (above | below).any()
    }

    fn tests_well_inside(&self) -> bool {
        true
    }

    #[inline]
    fn is_well_inside(&self, ray: &Ray, to: f64) -> bool {
        let margin = (1.0 - WELL_INSIDE) * self.min.abs().max(self.max.abs());
        let (low, high) = (self.min + margin, self.max - margin);
        let is_inside = |point: DVec3| (point.cmpgt(low) & point.cmplt(high)).all();
        is_inside(ray.origin) && is_inside(ray.at(to))
    }

    /// `None` unless it lies clearly on one face.
    #[inline]
    fn root_at(&self, ray: &Ray, t: f64) -> Option<Root> {
        let point = ray.at(t);
        let (low, high) = ((point - self.min).abs(), (point - self.max).abs());
        let gap = low.min(high);
        let (axis, dir, is_upper) = if gap.x <= gap.y && gap.x <= gap.z {
            (0, ray.dir.x, high.x < low.x)
        } else if gap.y <= gap.z {
            (1, ray.dir.y, high.y < low.y)
        } else {
            (2, ray.dir.z, high.z < low.z)
        };
        let lengths = ray.origin.abs() + (t * ray.dir).abs() + self.min.abs() + self.max.abs();
        let margin = CLEAR_MARGIN * lengths.max_element();
        // The second smallest gap.
        let median = gap.x.min(gap.y).max(gap.x.max(gap.y).min(gap.z));
        let is_sure = median > margin && low.max(high).min_element() > margin && dir != 0.0;
        is_sure.then_some(Root {
            t,
            crossing: match is_upper == (dir < 0.0) {
                true => Crossing::Enter,
                false => Crossing::Leave,
            },
            face: face(axis, is_upper),
            is_visible: true,
        })
    }

    fn bounding_sphere(&self) -> Option<(DVec3, f64)> {
        let half = 0.5 * self.max - 0.5 * self.min;
        Some((self.min + half, half.length() * (1.0 + SPHERE_MARGIN)))
    }

    fn normal(&self, _: DVec3, face: u32) -> DVec3 {
        let mut normal = DVec3::ZERO;
        normal[axis(face)] = if face.is_multiple_of(2) { -1.0 } else { 1.0 };
        normal
    }

    fn contains(&self, point: DVec3) -> bool {
        point.cmpge(self.min).all() && point.cmple(self.max).all()
    }

    fn bounds(&self) -> Bounds {
        Bounds {
            min: self.min,
            max: self.max,
        }
    }

    fn absorb(&mut self, step: &Step) -> bool {
        match step {
            Step::Translate(by) => *self = Cuboid::new(self.min + *by, self.max + *by),
            Step::Scale(by) => *self = Cuboid::new(self.min * *by, self.max * *by),
            Step::Rotate(_) | Step::General(_) => return false,
        }
        true
    }

    /// The cross of an unfolded cube: left, back, right and front in the middle row, top and bottom at the back.
    fn uv(&self, point: DVec3, _face: u32) -> Option<[f64; 2]> {
        let p = self.fractions(point);
        let off_centre = (p - 0.5).abs();
        let [quarter, third] = [0.25, 1.0 / 3.0];
        if off_centre.y >= off_centre.x && off_centre.y >= off_centre.z {
            let v = if p.y < 0.5 {
                p.z * third
            } else {
                1.0 - p.z * third
            };
            return Some([quarter + p.x * quarter, v]);
        }
        let u = match (off_centre.x >= off_centre.z, p.x < 0.5, p.z < 0.5) {
            (true, true, _) => p.z * quarter,
            (true, false, _) => 3.0 * quarter - p.z * quarter,
            (false, _, true) => 1.0 - p.x * quarter,
            (false, _, false) => quarter + p.x * quarter,
        };
        Some([u, third + p.y * third])
    }

    fn loses_uv(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::math::sampling::random::Random;
    use crate::scene::shape::SurfaceSide;
    use crate::scene::shape::tests::check;
    use std::cmp::Ordering;

    fn cube() -> Cuboid {
        Cuboid::new(DVec3::splat(-1.0), DVec3::ONE)
    }

    #[test]
    fn it_is_a_solid() {
        let cuboid = Cuboid::new(DVec3::new(-1.0, 0.5, 3.0), DVec3::new(0.3, -2.0, 4.5));
        check::solid(&cuboid);
        check::scales_exactly(&cuboid, |k| Cuboid::new(cuboid.min * k, cuboid.max * k));
    }

    #[test]
    fn a_point_beyond_a_face_is_outside() {
        use Ordering::{Equal, Greater, Less};
        let sides = |face: u32| {
            let face = cube().flat_face(face).unwrap();
            [Less, Equal, Greater].map(|position| face.side(position))
        };
        let (inside, outside) = (SurfaceSide::Inside, SurfaceSide::Outside);
        assert_eq!(sides(4), [outside, inside, inside]);
        assert_eq!(sides(5), [inside, inside, outside]);
    }

    #[test]
    fn corners_come_in_any_order() {
        let cuboid = Cuboid::read(&mut TextArgs::new("<1,-1,1>, <-1,1,-1>")).unwrap();
        assert_eq!(cuboid, cube());
    }

    #[test]
    fn the_depth_of_a_face_is_the_plain_quotient() {
        let ray = Ray::new(DVec3::new(0.1, 0.2, -7.3), DVec3::new(0.01, 0.02, 0.997));
        let root = cube().nearest(&ray, 0.0, f64::INFINITY).unwrap();
        assert_eq!(root.t, (-1.0 + 7.3) / 0.997);
        assert_eq!(root.face, 4);
    }

    #[test]
    fn a_ray_in_the_plane_of_a_face_hits_and_one_beside_it_misses() {
        let beside = 1.0 + f64::EPSILON;
        for (x, is_hit) in [(1.0, true), (-1.0, true), (beside, false)] {
            for zero in [0.0, -0.0] {
                let ray = Ray::new(DVec3::new(x, 0.0, -5.0), DVec3::new(zero, zero, 2.0));
                assert_eq!(cube().span(&ray).is_some(), is_hit);
            }
        }
    }

    #[test]
    fn a_box_without_thickness_is_visible() {
        let sheet = Cuboid::new(DVec3::new(-1.0, -1.0, 0.0), DVec3::new(1.0, 1.0, 0.0));
        let ray = Ray::new(DVec3::new(0.0, 0.0, -2.0), DVec3::Z);
        assert_eq!(sheet.span(&ray).unwrap().map(|root| root.t), [2.0, 2.0]);
    }

    #[test]
    fn root_at_identifies_the_root_by_its_point() {
        let mut rng = Random::new(12);
        let (mut known, mut all) = (0, 0);
        for number in 0..20_000 {
            let corner = rng.vector(1.0);
            let cuboid = Cuboid::new(corner, corner + rng.vector(1.0));
            let away = 2.0_f64.powi(number % 20 - 2);
            let origin = away * rng.vector(1.0);
            let aim = corner + rng.vector(0.5);
            let mut dir = (0.1 + rng.uniform()) * (aim - origin);
            if number % 7 == 0 {
                dir.x = 0.0;
            }
            let ray = Ray::new(origin, dir);
            for root in cuboid.span(&ray).into_iter().flatten() {
                let result = cuboid.root_at(&ray, root.t);
                assert!(
                    result.is_none_or(|result| result == root),
                    "{ray:?} {root:?}"
                );
                known += usize::from(result.is_some());
                all += 1;
            }
        }
        assert!(all > 5000 && known * 10 > all * 8, "{known} of {all}");
    }

    #[test]
    fn on_an_edge_the_squarer_face_is_taken() {
        let ray = Ray::new(DVec3::new(-2.0, 0.0, -3.0), DVec3::new(1.0, 0.0, 2.0));
        let root = cube().nearest(&ray, 0.0, 10.0).unwrap();
        assert_eq!((root.t, root.face), (1.0, 4));
    }

    #[test]
    fn a_ray_without_direction_misses() {
        assert!(cube().span(&Ray::new(DVec3::ZERO, DVec3::ZERO)).is_none());
    }

    #[test]
    fn translations_and_scalings_are_absorbed_and_rotations_are_not() {
        let mut cuboid = cube();
        assert!(cuboid.absorb(&Step::Scale(DVec3::new(-2.0, 1.0, 3.0))));
        assert!(cuboid.absorb(&Step::Translate(DVec3::X)));
        assert!(!cuboid.absorb(&Step::Rotate(DVec3::Y)));
        assert_eq!(cuboid.min, DVec3::new(-1.0, -1.0, -3.0));
        assert_eq!(cuboid.max, DVec3::new(3.0, 1.0, 3.0));
    }

    #[test]
    fn the_faces_lie_on_an_unfolded_cross() {
        let third = 1.0 / 3.0;
        let near = |p: DVec3, u: f64, v: f64| {
            let uv = Cuboid::new(DVec3::ZERO, DVec3::ONE).uv(p, 0).unwrap();
            assert!((uv[0] - u).abs() + (uv[1] - v).abs() < 1e-15, "{p}: {uv:?}");
        };
        near(DVec3::new(0.0, 0.4, 0.4), 0.1, third * 1.4);
        near(DVec3::new(1.0, 0.4, 0.4), 0.65, third * 1.4);
        near(DVec3::new(0.4, 0.4, 1.0), 0.35, third * 1.4);
        near(DVec3::new(0.4, 0.4, 0.0), 0.9, third * 1.4);
        near(DVec3::new(0.4, 0.0, 0.4), 0.35, third * 0.4);
        near(DVec3::new(0.4, 1.0, 0.4), 0.35, 1.0 - third * 0.4);
    }
}
