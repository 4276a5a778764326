//! Four rays at once: the spans of simple solids, to the bit what [`super::Geometry::roots`] gives for each.

use super::Shape;
use super::packet_search::{FourAsked, FourFound};
use crate::base::math::Ray;
use crate::base::math::conditioning::{COMFORTABLE_SQUARE, FAR_SQUARE, is_comfortable_size};
use crate::base::math::roots::ray_sphere::MARGIN;
use crate::base::math::simd::F64Lanes;
pub(crate) use crate::base::math::simd::vec3::Vec3Lanes;
pub(super) use crate::base::math::simd::vec3::{add, dot, scale, splat, sub};
use glam::DAffine3;

/// Places for roots: a torus has up to four on each of two stretches.
pub(super) const MOST_ROOTS: usize = 8;

/// Four rays.
#[derive(Clone, Copy)]
pub(crate) struct RayPacket<F> {
    pub(crate) origin: Vec3Lanes<F>,
    pub(crate) dir: Vec3Lanes<F>,
}

/// Where four lines are inside of a solid that each enters and leaves once, or not at all. What a line enters or leaves
/// nowhere it enters or leaves infinitely far away.
pub(crate) struct SpanPacket<F: F64Lanes> {
    pub(crate) enter: F,
    pub(crate) leave: F,
    /// Which lines meet it.
    pub(crate) is_met: F::Mask,
    /// The lines, one bit each, of which no more is known than that they must be asked for singly.
    pub(crate) unknown: u32,
}

impl<F: F64Lanes> SpanPacket<F> {
    /// Spans of lines of which those with `is_known` need no care by this shape's own reckoning.
    #[inline(always)]
    pub(super) fn new((enter, leave): (F, F), is_met: F::Mask, is_known: F::Mask) -> Self {
        let endless = F::splat(f64::INFINITY);
        let is_finite = enter.abs().lt(endless) & leave.abs().lt(endless);
        // A span without length is left to the rules of single rays, too.
        let is_plain = is_finite & (enter.lt(leave) | leave.lt(enter));
        SpanPacket {
            enter,
            leave,
            is_met: is_met & enter.lt(leave),
            unknown: 0b1111
                & (!F::bitmask(is_known) | (F::bitmask(is_met) & !F::bitmask(is_plain))),
        }
    }
}

impl<F: F64Lanes> SpanPacket<F> {
    /// The first ends with `from < t <= far`.
    #[inline(always)]
    pub(super) fn nearest(&self, from: F, far: F) -> NearestPacket<F> {
        let within = from.lt(self.enter) & self.enter.le(far);
        let enters = self.is_met & within;
        let within = from.lt(self.leave) & self.leave.le(far);
        let leaves = self.is_met & within;
        let enters_bits = F::bitmask(enters);
        NearestPacket {
            t: F::select(enters, self.enter, self.leave),
            leaves: F::bitmask(leaves) & !enters_bits,
            met: enters_bits | F::bitmask(leaves),
            unknown: self.unknown,
        }
    }
}

/// All roots of four lines with a shape, all visible and of face 0, in order: they enter and leave in turn. Places may be
/// left out.
pub(crate) struct RootPacket<F: F64Lanes> {
    pub(super) t: [F; MOST_ROOTS],
    /// For each place, which lines have a root there, one bit each.
    pub(super) met: [u32; MOST_ROOTS],
    /// Which lines must be asked for singly.
    pub(super) unknown: u32,
}

/// The first roots of four rays.
pub(crate) struct NearestPacket<F: F64Lanes> {
    pub(crate) t: F,
    /// Which of the roots that were found leave the solid, one bit each; the others enter.
    pub(crate) leaves: u32,
    /// Which rays have one.
    pub(crate) met: u32,
    /// Which rays must be asked for singly.
    pub(crate) unknown: u32,
}

impl<F: F64Lanes> NearestPacket<F> {
    #[inline(always)]
    fn load(found: &FourFound) -> Self {
        NearestPacket {
            t: F::from_array(&found.t),
            leaves: 0,
            met: found.met,
            unknown: found.unknown,
        }
    }
}

impl<F: F64Lanes> RootPacket<F> {
    #[inline(always)]
    pub(super) fn none(unknown: u32) -> Self {
        RootPacket {
            t: [F::splat(f64::INFINITY); MOST_ROOTS],
            met: [0; MOST_ROOTS],
            unknown,
        }
    }

    /// The first with `from < t <= far`, without the root that a ray has just left: of the roots of that crossing the one
    /// nearest to its start. `left` tells which rays have left a root that enters, and which one that leaves.
    #[inline(always)]
    pub(crate) fn nearest(&self, from: F, far: F, left: [u32; 2]) -> NearestPacket<F> {
        let mut nearest = NearestPacket {
            t: F::splat(f64::INFINITY),
            leaves: 0,
            met: 0,
            unknown: self.unknown,
        };
        let mut hidden = F::splat(f64::NAN);
        if left != [0, 0] {
            let mut size = F::splat(f64::INFINITY);
            for place in 0..MOST_ROOTS {
                let own = F::mask_from_bits(self.met[place] & left[place % 2]);
                let is_nearer = own & self.t[place].abs().lt(size);
                size = F::select(is_nearer, self.t[place].abs(), size);
                hidden = F::select(is_nearer, self.t[place], hidden);
            }
        }
        let mut passed = 0;
        for place in 0..MOST_ROOTS {
            if self.met[place] == 0 {
                continue;
            }
            let is_hidden = F::bitmask(self.t[place].eq(hidden)) & self.met[place];
            nearest.unknown |= is_hidden & passed;
            passed |= is_hidden;
            let is_within = from.lt(self.t[place]) & self.t[place].le(far);
            let new = F::bitmask(is_within) & self.met[place] & !is_hidden & !nearest.met;
            nearest.t = F::select(F::mask_from_bits(new), self.t[place], nearest.t);
            if place % 2 == 1 {
                nearest.leaves |= new;
            }
            nearest.met |= new;
        }
        nearest
    }
}

impl<F: F64Lanes> RayPacket<F> {
    /// These rays.
    #[cfg(test)]
    pub(super) fn of_each(rays: &[Ray; 4]) -> Self {
        let axis = |of: fn(&Ray) -> glam::DVec3, axis: usize| {
            F::from_array(&[0, 1, 2, 3].map(|i| of(&rays[i])[axis]))
        };
        RayPacket {
            origin: [0, 1, 2].map(|i| axis(|ray| ray.origin, i)),
            dir: [0, 1, 2].map(|i| axis(|ray| ray.dir, i)),
        }
    }
}

impl RayPacket<f64> {
    /// One ray.
    #[inline(always)]
    pub(super) fn of(ray: &Ray) -> Self {
        RayPacket {
            origin: ray.origin.to_array(),
            dir: ray.dir.to_array(),
        }
    }
}

impl<F: F64Lanes> RayPacket<F> {
    /// The same rays in an object space.
    #[inline(always)]
    pub(crate) fn to_object(self, matrix: &DAffine3) -> Self {
        let turned = turned(self.origin, matrix);
        RayPacket {
            origin: add(turned, splat(matrix.translation)),
            dir: self::turned(self.dir, matrix),
        }
    }
}

/// The part of a matrix that turns and scales, applied to four vectors.
#[inline(always)]
fn turned<F: F64Lanes>(v: Vec3Lanes<F>, matrix: &DAffine3) -> Vec3Lanes<F> {
    let (x, y, z) = (
        matrix.matrix3.x_axis,
        matrix.matrix3.y_axis,
        matrix.matrix3.z_axis,
    );
    let [x, y, z] = [
        scale(splat(x), v[0]),
        scale(splat(y), v[1]),
        scale(splat(z), v[2]),
    ];
    add(add(x, y), z)
}

impl Shape {
    /// Whether it has spans for four rays at once.
    pub(crate) fn has_four(&self) -> bool {
        match self {
            Shape::Sphere(sphere) => is_comfortable_size(sphere.radius),
            Shape::Cuboid(_) => true,
            Shape::Cylinder(cylinder) => cylinder.has_four(),
            Shape::Plane(_) | Shape::Quadric(_) => true,
            _ => false,
        }
    }

    /// Whether the first roots of four rays can be asked for at once.
    pub(crate) fn has_roots_of_four(&self) -> bool {
        match self {
            Shape::Sphere(sphere) => is_comfortable_size(sphere.radius),
            Shape::Torus(torus) => torus.has_four(),
            Shape::Superellipsoid(superellipsoid) => superellipsoid.has_four(),
            Shape::JuliaFractal(fractal) => fractal.has_four(),
            Shape::Plane(_) | Shape::Cuboid(_) | Shape::Quadric(_) => true,
            Shape::Cylinder(cylinder) => cylinder.has_four(),
            _ => false,
        }
    }

    /// True if its roots lie on several faces.
    #[inline(always)]
    pub(crate) fn has_faces(&self) -> bool {
        matches!(self, Shape::Cuboid(_) | Shape::Cylinder(_))
    }

    /// The first roots of those of four rays that are `there`, as [`RootPacket::nearest`] finds them. If `ANY` will do the
    /// distance may be that of some place within the solid.
    #[inline(always)]
    pub(crate) fn nearest_of_four<F: F64Lanes, const ANY: bool>(
        &self,
        rays: &RayPacket<F>,
        (from, far): (F, F),
        left: [u32; 2],
        there: u32,
    ) -> NearestPacket<F> {
        match self {
            Shape::Sphere(sphere) if left == [0, 0] && ANY => {
                sphere.any_of_four(rays, (from, far), there)
            }
            Shape::Sphere(sphere) if left == [0, 0] => sphere.nearest_of_four(rays, from, far),
            Shape::Torus(torus) => torus.nearest_of_four::<F, ANY>(rays, (from, far), left, there),
            Shape::Superellipsoid(_) | Shape::JuliaFractal(_) => NearestPacket::load(
                &self.search_of_four(&FourAsked::new(rays, (from, far), left, there)),
            ),
            Shape::Cuboid(_) | Shape::Cylinder(_) | Shape::Quadric(_) => {
                // The first end is enough.
                let mut nearest = self.four(rays, (from, from)).nearest(from, far);
                nearest.unknown |= left[0] | left[1];
                nearest
            }
            _ => self.roots_of_four(rays).nearest(from, far, left),
        }
    }

    /// Which of four rays that go out from the surface leave behind all that they enter, as
    /// [`super::Geometry::is_exiting`] tells of each.
    #[inline(always)]
    pub(crate) fn four_left_behind<F: F64Lanes>(&self, rays: &RayPacket<F>) -> F::Mask {
        match self {
            Shape::Sphere(sphere) => sphere.four_left_behind(rays),
            Shape::Torus(torus) => torus.four_left_behind(rays),
            Shape::Superellipsoid(superellipsoid) => {
                let none = F::splat(0.0);
                let rays = FourAsked::new(rays, (none, none), [0, 0], 0b1111);
                F::mask_from_bits(superellipsoid.four_left_behind(&rays))
            }
            Shape::Plane(plane) => plane.four_left_behind(rays),
            _ => F::mask_from_bits(0),
        }
    }

    /// Whether [`Shape::four_left_behind`] knows anything.
    #[inline(always)]
    pub(crate) fn tells_left_behind(&self) -> bool {
        match self {
            Shape::Sphere(_) | Shape::Torus(_) | Shape::Plane(_) => true,
            Shape::Superellipsoid(superellipsoid) => superellipsoid.has_four(),
            _ => false,
        }
    }

    /// The roots of four rays; all unknown for a shape that is not asked for four.
    #[inline(always)]
    pub(crate) fn roots_of_four<F: F64Lanes>(&self, rays: &RayPacket<F>) -> RootPacket<F> {
        match self {
            Shape::Sphere(sphere) => {
                let spans = sphere.four(rays);
                let mut roots = RootPacket::none(spans.unknown);
                (roots.t[0], roots.t[1]) = (spans.enter, spans.leave);
                roots.met[0] = F::bitmask(spans.is_met);
                roots.met[1] = roots.met[0];
                roots
            }
            Shape::Torus(torus) => torus.roots_of_four(rays),
            Shape::Plane(plane) => plane.roots_of_four(rays),
            _ => RootPacket::none(0b1111),
        }
    }

    /// Spans of four rays, all unknown for a shape that has none; ends outside of the intervals `within` may be missing.
    #[inline(always)]
    pub(crate) fn four<F: F64Lanes>(&self, rays: &RayPacket<F>, within: (F, F)) -> SpanPacket<F> {
        match self {
            Shape::Sphere(sphere) => sphere.four(rays),
            Shape::Cuboid(cuboid) => cuboid.four(rays),
            Shape::Cylinder(cylinder) => cylinder.four(rays),
            Shape::Plane(plane) => plane.four(rays),
            Shape::Quadric(quadric) => quadric.four(rays, within),
            _ => {
                let nothing = F::splat(0.0);
                SpanPacket::new(
                    (nothing, nothing),
                    F::mask_from_bits(0),
                    F::mask_from_bits(0),
                )
            }
        }
    }
}

/// The parts of four vectors across an axis.
#[inline(always)]
pub(super) fn across<F: F64Lanes>(unit: Vec3Lanes<F>, v: Vec3Lanes<F>) -> Vec3Lanes<F> {
    sub(v, scale(unit, dot(unit, v)))
}

/// Whether four rays can be worked on without rescaling, besides the size of the body.
#[inline(always)]
pub(super) fn is_comfortable<F: F64Lanes>(dir_sq: F, origin_sq: F) -> F::Mask {
    let least = F::splat(1.0 / COMFORTABLE_SQUARE);
    let is_way = least.le(dir_sq) & dir_sq.lt(F::splat(COMFORTABLE_SQUARE));
    is_way & origin_sq.lt(F::splat(FAR_SQUARE))
}

/// Four chords of a sphere about the origin, as [`crate::base::math::roots::ray_sphere::ball_chord`] finds each: enter, leave, and which
/// lines meet it.
#[inline(always)]
pub(super) fn chords<F: F64Lanes>(
    p: Vec3Lanes<F>,
    dir: Vec3Lanes<F>,
    radius: f64,
) -> (F, F, F::Mask) {
    let a = dot(dir, dir);
    let b = dot(p, dir);
    let from_centre_sq = dot(p, p);
    let (r, r_sq) = (F::splat(radius), F::splat(radius * radius));
    let size = from_centre_sq * a;
    let off = size - size * F::splat(MARGIN) - b * b;
    let is_far = (r_sq * a).lt(off);
    if F::bitmask(is_far) == 0b1111 {
        return (a, a, F::mask_from_bits(0));
    }
    let along = -b / a;
    let nearest = add(p, scale(dir, along));
    let nearest_sq = dot(nearest, nearest);
    let distance = nearest_sq.sqrt();
    let half_sq = (r - distance) * (r + distance);
    let from_centre = from_centre_sq.sqrt();
    let c = (from_centre - r) * (from_centre + r);
    let root = (a * half_sq).sqrt();
    let is_ahead = b.lt(F::splat(0.0));
    let q = F::select(is_ahead, root - b, -(root + b));
    let (t, other) = (q / a, c / q);
    let is_met = nearest_sq.lt(r_sq) & F::splat(0.0).lt(half_sq);
    (t.lane_min(other), t.lane_max(other), is_met)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::math::Bounds;
    use crate::base::math::sampling::random::Random;
    use crate::base::math::simd::{SimdKernel, SimdLevel};
    use crate::scene::shape::{Crossing, Cuboid, Cylinder, Geometry, Plane, Root, Sphere, Torus};
    use glam::DVec3;

    /// What is known of the roots of four rays, as single rays know it.
    #[derive(Clone, Copy)]
    struct Asked<'a> {
        shape: &'a Shape,
        rays: [Ray; 4],
    }

    impl SimdKernel for Asked<'_> {
        type Output = [Option<Vec<(f64, Crossing)>>; 4];

        fn run<F: F64Lanes>(self) -> Self::Output {
            let rays = RayPacket::<F>::of_each(&self.rays);
            let roots = if self.shape.has_four() {
                let all = F::splat(f64::INFINITY);
                let spans = self.shape.four(&rays, (-all, all));
                let met = F::bitmask(spans.is_met);
                let mut roots = RootPacket::none(spans.unknown);
                (roots.t[0], roots.t[1]) = (spans.enter, spans.leave);
                (roots.met[0], roots.met[1]) = (met, met);
                roots
            } else {
                self.shape.roots_of_four(&rays)
            };
            [0, 1, 2, 3].map(|lane| {
                let has = |bits: u32| bits >> lane & 1 == 1;
                let crossing = |place| [Crossing::Enter, Crossing::Leave][place % 2];
                let there = (0..MOST_ROOTS).filter(|&place| has(roots.met[place]));
                let known = there.map(|place| (roots.t[place].to_array()[lane], crossing(place)));
                let known = known.filter(|(t, _)| t.is_finite());
                (!has(roots.unknown)).then(|| known.collect())
            })
        }
    }

    #[test]
    fn four_rays_find_what_each_finds() {
        let read = |text: &str| TextArgs::new(text);
        let shapes = [
            Shape::Sphere(Sphere::read(&mut read("<1, 2, 3>, 1.5")).unwrap()),
            Shape::Cuboid(Cuboid::new(DVec3::NEG_ONE, DVec3::new(2.0, 0.5, 3.0))),
            Shape::Cuboid(Cuboid::new(DVec3::NEG_ONE, DVec3::new(1.0, -1.0, 1.0))),
            Shape::Cylinder(Cylinder::read(&mut read("<-1, 0.5, 0>, <1, 1, 2>, 0.7")).unwrap()),
            Shape::Cylinder(Cylinder::read(&mut read("<-2, 0, 0>, <2, 0, 0>, 0.6")).unwrap()),
            Shape::Torus(Torus::read(&mut read("1, 0.3")).unwrap()),
            Shape::Torus(Torus::read(&mut read("1, 0.01")).unwrap()),
            Shape::Torus(Torus::read(&mut read("1, 1")).unwrap()),
            Shape::Plane(Plane::read(&mut read("<1, 2, -0.5>, 0.25")).unwrap()),
            Shape::Plane(Plane::read(&mut read("<0, 1, 0>, -1")).unwrap()),
        ];
        let mut rng = Random::new(31);
        for shape in &shapes {
            let own: Bounds = shape.bounds();
            let bounds = if own.is_finite() {
                own
            } else {
                Bounds::new(DVec3::NEG_ONE, DVec3::ONE)
            };
            let (mut known, mut met) = (0, 0);
            for _ in 0..4000 {
                let rays = [(); 4].map(|()| rng.ray_near(&bounds));
                let asked = Asked { shape, rays };
                let (wide, narrow) = (SimdLevel::widest().run(asked), SimdLevel::NARROW.run(asked));
                assert_eq!(wide, narrow);
                for (ray, found) in rays.iter().zip(wide) {
                    let Some(found) = found else { continue };
                    let mut roots: Vec<Root> = Vec::new();
                    shape.roots(ray, &mut roots);
                    let alone: Vec<_> = roots.iter().map(|root| (root.t, root.crossing)).collect();
                    assert_eq!(found, alone, "{shape:?} {ray:?}");
                    known += 1;
                    met += usize::from(!alone.is_empty());
                }
            }
            assert!(known > 3000, "{shape:?} {known} {met}");
        }
    }

    /// Asks whether a ball lies on four rays, with and without its roots: `(met, unknown)` each, and whether the places
    /// that are told differ.
    #[derive(Clone, Copy)]
    struct InTheWay<'a> {
        sphere: &'a Sphere,
        rays: [Ray; 4],
        from: [f64; 4],
        far: [f64; 4],
    }

    impl SimdKernel for InTheWay<'_> {
        type Output = ([(u32, u32); 2], bool);

        fn run<F: F64Lanes>(self) -> Self::Output {
            let rays = RayPacket::<F>::of_each(&self.rays);
            let (from, far) = (F::from_array(&self.from), F::from_array(&self.far));
            let any = self.sphere.any_of_four(&rays, (from, far), 0b1111);
            let first = self.sphere.nearest_of_four(&rays, from, far);
            let differs = any.t.to_array() != first.t.to_array() && any.met != 0;
            (
                [(any.met, any.unknown), (first.met, first.unknown)],
                differs,
            )
        }
    }

    #[test]
    fn a_ball_lies_in_the_way_without_roots_where_it_does_with_them() {
        let sphere = Sphere {
            centre: DVec3::new(1.0, -2.0, 0.5),
            radius: 1.5,
        };
        let bounds = sphere.bounds();
        let mut rng = Random::new(51);
        let (mut met, mut quick) = (0, 0);
        for round in 0..40_000 {
            let rays = [(); 4].map(|()| {
                let ray = rng.ray_near(&bounds);
                // Some start on the ball, or near it.
                let out = (ray.origin - sphere.centre).normalize_or(DVec3::X);
                let near = 1.0 + 1e-15 * f64::from(round % 7 - 3);
                let on_it = sphere.centre + near * sphere.radius * out;
                let dir = ray.dir.normalize_or(DVec3::Y);
                Ray::new(if round % 3 == 0 { on_it } else { ray.origin }, dir)
            });
            let from = [(); 4].map(|()| 1e-13 * rng.share());
            let far = [(); 4].map(|()| 12.0 * rng.share());
            let sphere = &sphere;
            let asked = InTheWay {
                sphere,
                rays,
                from,
                far,
            };
            let (wide, narrow) = (SimdLevel::widest().run(asked), SimdLevel::NARROW.run(asked));
            assert_eq!(wide, narrow);
            let ([any, first], differs) = wide;
            let known = 0b1111 & !any.1 & !first.1;
            assert_eq!(
                any.0 & known,
                first.0 & known,
                "{asked:?}",
                asked = asked.rays
            );
            met += (any.0 & known).count_ones();
            quick += u32::from(differs);
        }
        assert!(met > 10_000 && quick > 3_000, "{met} {quick}");
    }
}
