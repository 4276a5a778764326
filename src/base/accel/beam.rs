//! Beams: all segments from the points of one box to the points of another, such as the shadow rays from neighbouring
//! points to an area light (Heckbert and Hanrahan 1984, "Beam tracing polygonal objects").
//!
//! One traversal finds the items that any of these segments may hit, in single precision and conservatively. Mostly
//! they are few or none, which spares every segment a traversal of its own.

use super::Bvh;
use super::node::{Frame, Node, WIDTH};
use super::packet::REL_ERROR;
use super::sphere_leaf::SphereLeaf;
use crate::base::math::Bounds;
use crate::base::math::rounding::{loose_above, loose_below, nearest};
use crate::base::math::simd::{F32x8, F64x4, SimdKernel, SimdLevel};
use arrayvec::ArrayVec;
use glam::DVec3;

/// Maximum number of items of a beam; with more, a traversal for each segment culls better.
pub const MAX_BEAM_ITEMS: usize = 16;

/// Directions below this carry no information about an axis in single precision.
const FLAT: f32 = 1e-30;

/// Maximum coordinate of either end in the frame of the tree: from farther away single precision separates no items.
const MAX_DISTANCE: f64 = 1e4;

/// Bound on the relative error of a parameter at which a segment passes a plane: three roundings, with a margin.
const ERROR: f32 = 4.0 * REL_ERROR;

/// A beam in the frame of a tree. Segment parameters go from 0 at the first box to 1 at the second.
struct Beam {
    /// The first box.
    low: [f32; 3],
    high: [f32; 3],
    /// By axis, the inverses of the smallest and of the largest direction.
    inverse: [[f32; 2]; 3],
    /// The centre of the first box, the direction to that of the second, and the square of its length.
    from: [f32; 3],
    dir: [f32; 3],
    dir_sq: f32,
    /// Bound on the length of a segment.
    length: f32,
    /// Bounds on the distance of a segment from the one between the centres, at parameters 0 and 1.
    spreads: [f32; 2],
}

impl Beam {
    /// The beam from a box to the one with this centre and these half sides; `None` if it cannot be represented.
    fn new(frame: &Frame, points: &Bounds, centre: DVec3, half_sides: DVec3) -> Option<Beam> {
        let [least_from, largest_from] = [points.min, points.max].map(|end| frame.in_frame(end));
        let (from, to) = (0.5 * (least_from + largest_from), frame.in_frame(centre));
        let half = half_sides * frame.scale();
        let extent = least_from.abs().max(largest_from.abs());
        let size = extent.max(to.abs() + half).max_element();
        // The largest element of a vector passes over NaN.
        let is_known = from.is_finite() && to.is_finite() && half.is_finite();
        if !(is_known && size < MAX_DISTANCE && frame.scale().is_normal()) {
            return None;
        }
        let error = 8.0 * f64::EPSILON * size;
        let dir = to - from;
        let (least, largest) = (
            to - half - largest_from - error,
            to + half - least_from + error,
        );
        let spread = |half: DVec3| loose_above(half.length() + error) * (1.0 + ERROR);
        let mut beam = Beam {
            low: [0.0; 3],
            high: [0.0; 3],
            inverse: [[0.0; 2]; 3],
            from: [nearest(from.x), nearest(from.y), nearest(from.z)],
            dir: [nearest(dir.x), nearest(dir.y), nearest(dir.z)],
            dir_sq: 0.0,
            length: 0.0,
            spreads: [spread(0.5 * (largest_from - least_from)), spread(half)],
        };
        for axis in 0..3 {
            beam.low[axis] = loose_below(least_from[axis] - error);
            beam.high[axis] = loose_above(largest_from[axis] + error);
            let (mut least, mut largest) = (loose_below(least[axis]), loose_above(largest[axis]));
            if least.abs() < FLAT {
                least = -FLAT;
            }
            if largest.abs() < FLAT {
                largest = FLAT;
            }
            beam.inverse[axis] = [1.0 / least, 1.0 / largest];
        }
        let [u, v, w] = beam.dir;
        beam.dir_sq = u * u + v * v + w * w;
        let [at_start, at_end] = beam.spreads;
        beam.length = (beam.dir_sq.sqrt() + at_start + at_end) * (1.0 + ERROR);
        Some(beam)
    }

    /// The parameters at which segments may enter and leave boxes with these planes. They miss a box that they leave
    /// before they enter it.
    #[inline(always)]
    fn range<F: F32x8>(&self, planes: [[F; 2]; 3]) -> [F; 2] {
        let (mut enter, mut leave) = (F::splat(0.0), F::splat(1.0 + ERROR));
        for (axis, [low, high]) in planes.into_iter().enumerate() {
            // Some segment has passed the low plane, and some has not passed the high one.
            let to_low = low - F::splat(self.high[axis]);
            let to_high = high - F::splat(self.low[axis]);
            let [least, largest] = self.inverse[axis];
            let past_low = to_low * F::splat(largest);
            if largest > 0.0 {
                enter = past_low.lane_max(enter);
            } else {
                leave = past_low.lane_min(leave);
            }
            let past_high = to_high * F::splat(least);
            if least > 0.0 {
                leave = past_high.lane_min(leave);
            } else {
                enter = past_high.lane_max(enter);
            }
        }
        [
            enter,
            leave + leave.abs() * F::splat(2.0 * ERROR) + F::splat(f32::MIN_POSITIVE),
        ]
    }
}

/// Computes the mask of the boxes of a node that a beam may hit.
struct BeamAndNode<'a> {
    beam: &'a Beam,
    node: &'a Node,
}

impl SimdKernel for BeamAndNode<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let [x, y, z] = self.node.planes();
        let load = |from: &[f32; WIDTH]| <F::F32>::from_array(from);
        let [enter, leave] = self.beam.range([
            [load(&x[0]), load(&x[1])],
            [load(&y[0]), load(&y[1])],
            [load(&z[0]), load(&z[1])],
        ]);
        enter.le(leave)
    }
}

/// Computes the mask of the spheres of a leaf that a beam may hit.
struct BeamAndSphereLeaf<'a> {
    beam: &'a Beam,
    leaf: &'a SphereLeaf,
}

impl SimdKernel for BeamAndSphereLeaf<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let (beam, leaf) = (self.beam, self.leaf);
        let load = |from: &[f32; WIDTH]| <F::F32>::from_array(from);
        let [x, y, z] = &leaf.centre;
        let (x, y, z) = (load(x), load(y), load(z));
        let size = x.abs() + y.abs() + z.abs();
        let radius = load(&leaf.radius);
        let radius = radius + (size + radius.abs()) * <F::F32>::splat(ERROR);
        let [enter, leave] = beam.range([
            [x - radius, x + radius],
            [y - radius, y + radius],
            [z - radius, z + radius],
        ]);
        // The axis of the beam passes a sphere no farther away than its radius and the width of the beam there.
        let [x, y, z] = [
            x - <F::F32>::splat(beam.from[0]),
            y - <F::F32>::splat(beam.from[1]),
            z - <F::F32>::splat(beam.from[2]),
        ];
        let [u, v, w] = [
            <F::F32>::splat(beam.dir[0]),
            <F::F32>::splat(beam.dir[1]),
            <F::F32>::splat(beam.dir[2]),
        ];
        let a = y * w - z * v;
        let b = z * u - x * w;
        let c = x * v - y * u;
        let [at_start, at_end] = beam.spreads.map(<F::F32>::splat);
        let width = at_start + leave.lane_min(<F::F32>::splat(1.0 + ERROR)) * at_end;
        let error = (x.abs() + y.abs() + z.abs() + size) * <F::F32>::splat(2.0 * ERROR);
        let reach = radius + width + error;
        let is_near = (a * a + b * b + c * c).le(reach * reach * <F::F32>::splat(beam.dir_sq));
        // Segments that all go away from a sphere they start outside of do not hit it.
        let extent = x.abs() + y.abs() + z.abs();
        let ahead = x * u
            + y * v
            + z * w
            + (extent + error) * (at_start + at_end)
            + (at_start + error) * <F::F32>::splat(beam.length);
        let outside = radius + at_start + error;
        let is_behind = ahead.le(<F::F32>::splat(0.0))
            & (outside * outside).le((x * x + y * y + z * z) * <F::F32>::splat(1.0 - ERROR));
        <F::F32>::splat(0.0).le(load(&leaf.radius)) & enter.le(leave) & is_near & !is_behind
    }
}

impl Bvh {
    /// The items that a segment from `points` to the box around `centre` with these half sides may hit; `None` if they
    /// are many, or unknown. An item for which `leave_out` is true is not listed.
    #[must_use]
    pub(crate) fn items_in_beam(
        &self,
        lanes: SimdLevel,
        points: &Bounds,
        centre: DVec3,
        half_sides: DVec3,
        leave_out: impl Fn(u32) -> bool,
    ) -> Option<ArrayVec<u32, MAX_BEAM_ITEMS>> {
        let beam = &Beam::new(&self.frame, points, centre, half_sides)?;
        let mut items = ArrayVec::new();
        let are_too_many = self.search(
            #[inline(always)]
            |node| lanes.run(BeamAndNode { beam, node }),
            #[inline(always)]
            |leaf| lanes.run(BeamAndSphereLeaf { beam, leaf }),
            |item| !leave_out(item) && items.try_push(item).is_err(),
        );
        (!are_too_many).then_some(items)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::sampling::random::Random;

    /// True if the segment from `a` to `b` hits a box.
    fn hits_box(bounds: &Bounds, a: DVec3, b: DVec3) -> bool {
        let (low, high) = ((bounds.min - a) / (b - a), (bounds.max - a) / (b - a));
        let (enter, leave) = (low.min(high), low.max(high));
        enter.max_element().max(0.0) <= leave.min_element().min(1.0)
    }

    /// True if the segment from `a` to `b` hits the sphere that touches all sides of a box.
    fn hits_sphere(bounds: &Bounds, a: DVec3, b: DVec3) -> bool {
        let centre = 0.5 * (bounds.min + bounds.max);
        let t = ((centre - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        a.lerp(b, t).distance(centre) <= 0.5 * (bounds.max.x - bounds.min.x)
    }

    #[test]
    fn a_beam_hits_all_that_one_of_its_segments_hits() {
        let mut rng = Random::new(3);
        let (mut hit_count, mut beam_count) = (0, 0);
        for are_spheres in [false, true] {
            let bounds: Vec<Bounds> = (0..300)
                .map(|_| {
                    let (centre, mut half) = (rng.vector(10.0), rng.vector(1.0).abs());
                    if are_spheres {
                        half = DVec3::splat(half.x);
                    }
                    Bounds::new(centre - half, centre + half)
                })
                .collect();
            let (tree, order) =
                Bvh::build_in_order(bounds.len(), |item| (bounds[item], are_spheres));
            let hits = if are_spheres { hits_sphere } else { hits_box };
            for round in 0..4_000 {
                let (point, mut centre) = (rng.vector(12.0), rng.vector(20.0));
                if round % 5 == 0 {
                    centre.x = point.x;
                }
                let half = rng.vector(1.0).abs() * [0.0, 0.1, 2.0][round % 3];
                let around = rng.vector(1.0).abs() * [0.0, 0.0, 0.2, 1.0][round % 4];
                let points = &Bounds::new(point - around, point + around);
                let [wide, narrow] = [SimdLevel::widest(), SimdLevel::NARROW]
                    .map(|lanes| tree.items_in_beam(lanes, points, centre, half, |_| false));
                assert_eq!(wide, narrow);
                let Some(items) = wide else { continue };
                beam_count += 1;
                for _ in 0..4 {
                    let start = point + around * rng.vector(1.0);
                    let end = centre + half * rng.vector(1.0);
                    for (item, &number) in (0..).zip(&order) {
                        if hits(&bounds[number as usize], start, end) {
                            hit_count += 1;
                            assert!(items.contains(&item));
                        }
                    }
                }
            }
        }
        assert!(
            hit_count > 10_000 && beam_count > 4_000,
            "{hit_count} of {beam_count}"
        );
    }

    #[test]
    fn narrow_beams_hit_single_items_and_far_ends_have_no_beam() {
        let bounds: Vec<Bounds> = (0..100)
            .map(|x| 3.0 * DVec3::new(f64::from(x), 0.0, 0.0))
            .map(|centre| Bounds::new(centre - 1.0, centre + 1.0))
            .collect();
        let (tree, order) = Bvh::build_in_order(bounds.len(), |item| (bounds[item], true));
        let beam = |from, to| {
            let half = DVec3::splat(0.5);
            let points = &Bounds::new(from, from);
            tree.items_in_beam(SimdLevel::widest(), points, to, half, |_| false)
        };
        let up = |x: f64, y: f64| DVec3::new(x, y, 0.0);
        let one = beam(up(30.0, -9.0), up(30.0, 9.0)).expect("a beam");
        assert_eq!(
            one.iter()
                .map(|&item| order[item as usize])
                .collect::<Vec<_>>(),
            [10]
        );
        assert!(beam(up(31.5, -2.0), up(31.5, 9.0)).is_some_and(|items| items.is_empty()));
        assert_eq!(beam(up(0.0, 0.0), up(290.0, 0.0)), None);
        for far in [DVec3::splat(1e12), DVec3::NAN, DVec3::INFINITY] {
            assert_eq!(beam(far, DVec3::ZERO), None);
            assert_eq!(beam(DVec3::ZERO, far), None);
        }
    }
}
