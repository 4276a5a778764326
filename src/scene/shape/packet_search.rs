//! Nearest roots and spans of ray packets by iterative searches. They are too long to inline, so arguments and results pass
//! through memory. Bit for bit what each ray finds by itself.

use super::Shape;
use super::ray_packet::RayPacket;
use crate::base::math::Ray;
use crate::base::math::simd::F64Lanes;
use crate::base::math::simd::vec3::{from_arrays, to_arrays};
use glam::DVec3;

/// Query of a ray packet for nearest roots, or for spans.
pub(crate) struct NearestQuery4 {
    pub(super) origin: [[f64; 4]; 3],
    pub(super) dir: [[f64; 4]; 3],
    pub(super) from: [f64; 4],
    pub(super) far: [f64; 4],
    /// Bit mask of the lanes that have just left the shape.
    pub(super) left: u32,
    /// Bit mask of the active lanes.
    pub(super) active: u32,
}

/// Nearest roots of a ray packet; all enter the shape.
#[derive(Default)]
pub(crate) struct NearestResult4 {
    pub(super) t: [f64; 4],
    /// Bit mask of the lanes that have a root.
    pub(super) hit_mask: u32,
    /// Bit mask of the lanes that take the scalar path.
    pub(super) unknown: u32,
}

/// Inside spans of a ray packet.
#[derive(Default)]
pub(crate) struct SpanResult4 {
    pub(super) enter: [f64; 4],
    pub(super) leave: [f64; 4],
    /// Bit mask of the lanes that hit the shape.
    pub(super) hit_mask: u32,
    /// Bit mask of the lanes that take the scalar path.
    pub(super) unknown: u32,
}

impl NearestQuery4 {
    #[inline(always)]
    pub(super) fn new<F: F64Lanes>(
        rays: &RayPacket<F>,
        from: F,
        far: F,
        left: [u32; 2],
        active: u32,
    ) -> Self {
        NearestQuery4 {
            origin: to_arrays(rays.origin),
            dir: to_arrays(rays.dir),
            from: from.to_array(),
            far: far.to_array(),
            left: left[0] | left[1],
            active,
        }
    }

    #[inline(always)]
    pub(super) fn rays<F: F64Lanes>(&self) -> RayPacket<F> {
        RayPacket {
            origin: from_arrays(&self.origin),
            dir: from_arrays(&self.dir),
        }
    }

    /// The ray of one lane.
    pub(super) fn ray(&self, lane: usize) -> Ray {
        let one_of = |of: &[[f64; 4]; 3]| DVec3::new(of[0][lane], of[1][lane], of[2][lane]);
        Ray::new(one_of(&self.origin), one_of(&self.dir))
    }
}

impl Shape {
    /// Nearest roots of a ray packet, for the shapes that need an iterative search.
    #[inline(never)]
    pub(super) fn search_packet(&self, query: &NearestQuery4) -> NearestResult4 {
        match self {
            Shape::Superellipsoid(superellipsoid) => superellipsoid.nearest_packet(query),
            Shape::JuliaFractal(fractal) => fractal.nearest_packet(query),
            _ => NearestResult4 {
                unknown: query.active,
                ..NearestResult4::default()
            },
        }
    }
}

impl Shape {
    /// Spans of a ray packet, for the shapes of which they are long to find; ends outside the query's interval may be
    /// missing.
    #[inline(never)]
    pub(super) fn search_spans(&self, query: &NearestQuery4) -> SpanResult4 {
        match self {
            Shape::Torus(torus) if torus.supports_packets() => torus.spans(query),
            Shape::Superellipsoid(superellipsoid) if superellipsoid.supports_packets() => {
                superellipsoid.spans(query)
            }
            _ => SpanResult4 {
                unknown: query.active,
                ..SpanResult4::default()
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::math::sampling::random::Random;
    use crate::scene::shape::{Crossing, Geometry, JuliaFractal, Root, Superellipsoid, Torus};

    #[test]
    fn packets_find_the_roots_of_each_ray() {
        let fractal =
            |text: &str| Shape::JuliaFractal(JuliaFractal::read(&mut TextArgs::new(text)).unwrap());
        let shapes = [
            Shape::Superellipsoid(Superellipsoid::new(0.3, 0.25)),
            Shape::Superellipsoid(Superellipsoid::new(2.0, 1.0)),
            fractal("<-0.083, 0, -0.83, -0.025> max_iteration 8 precision 15"),
            fractal("<-0.2, 0.1, 0.6, 0.1> cube max_iteration 6"),
            fractal("<-0.745, 0, 0.113, 0.05> hypercomplex max_iteration 7"),
        ];
        let mut rng = Random::new(77);
        for shape in &shapes {
            let (mut known, mut hits) = (0, 0);
            for round in 0..200 {
                let rays = [(); 4].map(|()| rng.ray_near(&shape.bounds()));
                let of =
                    |part: fn(&Ray) -> DVec3| [0, 1, 2].map(|axis| rays.map(|r| part(&r)[axis]));
                let query = NearestQuery4 {
                    origin: of(|ray| ray.origin),
                    dir: of(|ray| ray.dir),
                    from: [0.0; 4],
                    far: [[f64::INFINITY, 3.0][round % 2]; 4],
                    left: 0,
                    active: 0b1111,
                };
                let result = shape.search_packet(&query);
                for (lane, ray) in rays.iter().enumerate() {
                    if result.unknown >> lane & 1 == 1 {
                        continue;
                    }
                    let scalar = shape.nearest(ray, 0.0, f64::INFINITY);
                    let scalar = scalar.filter(|root| root.t <= query.far[lane]);
                    let packet = (result.hit_mask >> lane & 1 == 1)
                        .then_some((result.t[lane], Crossing::Enter));
                    assert_eq!(
                        packet,
                        scalar.map(|root| (root.t, root.crossing)),
                        "{shape:?} {ray:?}"
                    );
                    known += 1;
                    hits += usize::from(packet.is_some());
                }
            }
            assert!(known > 400 && hits > 20, "{shape:?} {known} {hits}");
        }
    }

    #[test]
    fn packets_that_leave_a_fractal_of_many_iterations_end_as_each_ray() {
        let fractals = [
            "<-0.083, 0, -0.83, -0.025> max_iteration 30 precision 40",
            "<-0.2, 0.1, 0.6, 0.1> cube max_iteration 25 slice <0.1, 0.2, 0.3, 0.9>, 0.1",
        ];
        let mut rng = Random::new(79);
        for text in fractals {
            let shape = Shape::JuliaFractal(JuliaFractal::read(&mut TextArgs::new(text)).unwrap());
            let (mut hits, mut misses) = (0, 0);
            for round in 0..400 {
                let rays = [(); 4].map(|()| {
                    let ray = rng.ray_near(&shape.bounds());
                    let t = shape
                        .nearest(&ray, 0.0, f64::INFINITY)
                        .map_or(1.0, |root| root.t);
                    Ray::new(ray.at(t), 0.7 * rng.vector(1.0))
                });
                let of =
                    |part: fn(&Ray) -> DVec3| [0, 1, 2].map(|axis| rays.map(|r| part(&r)[axis]));
                let query = NearestQuery4 {
                    origin: of(|ray| ray.origin),
                    dir: of(|ray| ray.dir),
                    from: [0.0; 4],
                    far: [[f64::INFINITY, 0.5][round % 2]; 4],
                    left: 0b1111,
                    active: 0b1111,
                };
                let result = shape.search_packet(&query);
                for (lane, ray) in rays.iter().enumerate() {
                    if result.unknown >> lane & 1 == 1 {
                        continue;
                    }
                    let scalar = shape.nearest_beside(ray, 0.0, query.far[lane], 0);
                    let packet = (result.hit_mask >> lane & 1 == 1).then_some(result.t[lane]);
                    assert_eq!(packet, scalar.map(|root| root.t), "{text} {ray:?}");
                    hits += usize::from(packet.is_some());
                    misses += usize::from(packet.is_none());
                }
            }
            assert!(hits > 50 && misses > 200, "{text} {hits} {misses}");
        }
    }

    #[test]
    fn spans_have_the_ends_of_each_ray_within_the_interval() {
        let shapes = [
            Shape::Superellipsoid(Superellipsoid::new(0.3, 0.25)),
            Shape::Superellipsoid(Superellipsoid::new(2.0, 1.0)),
            Shape::Torus(Torus::read(&mut TextArgs::new("1, 0.3")).unwrap()),
        ];
        let mut rng = Random::new(78);
        for shape in &shapes {
            let (mut known, mut ends, mut starts_inside) = (0, 0, 0);
            for _ in 0..2000 {
                let rays = [(); 4].map(|()| rng.ray_near(&shape.bounds()));
                let roots = rays.map(|ray| {
                    let mut roots = Vec::new();
                    shape.roots(&ray, &mut roots);
                    roots
                });
                let near = |roots: &Vec<Root>, share: f64| {
                    roots.first().map_or(1.0, |root| root.t) + share
                };
                let from = [0, 1, 2, 3].map(|lane| near(&roots[lane], rng.uniform() - 0.5));
                let far = from.map(|from| from + rng.uniform());
                let of =
                    |part: fn(&Ray) -> DVec3| [0, 1, 2].map(|axis| rays.map(|r| part(&r)[axis]));
                let query = NearestQuery4 {
                    origin: of(|ray| ray.origin),
                    dir: of(|ray| ray.dir),
                    from,
                    far,
                    left: 0,
                    active: 0b1111,
                };
                let result = shape.search_spans(&query);
                for (lane, roots) in roots.iter().enumerate() {
                    if result.unknown >> lane & 1 == 1 {
                        continue;
                    }
                    let is_hit = result.hit_mask >> lane & 1 == 1;
                    let (enter, leave) = (result.enter[lane], result.leave[lane]);
                    let within = |t: &f64| (from[lane]..=far[lane]).contains(t);
                    for (end, crossing) in [(enter, Crossing::Enter), (leave, Crossing::Leave)] {
                        let own = roots.iter().filter(|root| root.crossing == crossing);
                        let expected = own.map(|root| root.t).find(within);
                        let end = is_hit.then_some(end).filter(within);
                        assert_eq!(end, expected, "{shape:?} {:?}", rays[lane]);
                        ends += usize::from(end.is_some());
                    }
                    let passed = roots.iter().filter(|root| root.t < from[lane]).count();
                    let is_inside = is_hit && enter < from[lane] && from[lane] < leave;
                    assert_eq!(is_inside, passed % 2 == 1, "{shape:?} {:?}", rays[lane]);
                    starts_inside += usize::from(is_inside);
                    known += 1;
                }
            }
            assert!(known > 4000 && ends > 500, "{shape:?} {known} {ends}");
            assert!(starts_inside > 200, "{shape:?} {starts_inside}");
        }
    }
}
