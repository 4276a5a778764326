//! Nearest roots of ray packets by iterative searches. They are too long to inline, so arguments and results pass
//! through memory. Bit for bit what each ray finds by itself.

use super::Shape;
use super::ray_packet::RayPacket;
use crate::base::math::Ray;
use crate::base::math::simd::F64Lanes;
use crate::base::math::simd::vec3::{from_arrays, to_arrays};
use glam::DVec3;

/// Nearest-root query of a ray packet.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::math::sampling::random::Random;
    use crate::scene::shape::{Crossing, Geometry, JuliaFractal, Superellipsoid};

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
}
