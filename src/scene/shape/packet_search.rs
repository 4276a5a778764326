//! The first roots of four rays by searches so long that they are not made part of whoever asks: what goes in and comes
//! out lies in memory. To the bit what each ray finds by itself.

use super::Shape;
use super::packet::RayPacket;
use crate::base::math::Ray;
use crate::base::math::simd::F64Lanes;
use crate::base::math::simd::vec3::{from_arrays, to_arrays};
use glam::DVec3;

/// Four rays that look for the first root of a shape.
pub(crate) struct FourAsked {
    pub(super) origin: [[f64; 4]; 3],
    pub(super) dir: [[f64; 4]; 3],
    pub(super) from: [f64; 4],
    pub(super) far: [f64; 4],
    /// Which have just left it.
    pub(super) left: u32,
    /// Which rays there are.
    pub(super) there: u32,
}

/// The first roots of four rays; all enter.
#[derive(Default)]
pub(crate) struct FourFound {
    pub(super) t: [f64; 4],
    /// Which rays have one, one bit each.
    pub(super) met: u32,
    /// Which rays must be asked for singly.
    pub(super) unknown: u32,
}

impl FourAsked {
    #[inline(always)]
    pub(super) fn new<F: F64Lanes>(
        rays: &RayPacket<F>,
        (from, far): (F, F),
        left: [u32; 2],
        there: u32,
    ) -> Self {
        FourAsked {
            origin: to_arrays(rays.origin),
            dir: to_arrays(rays.dir),
            from: from.to_array(),
            far: far.to_array(),
            left: left[0] | left[1],
            there,
        }
    }

    #[inline(always)]
    pub(super) fn rays<F: F64Lanes>(&self) -> RayPacket<F> {
        RayPacket {
            origin: from_arrays(&self.origin),
            dir: from_arrays(&self.dir),
        }
    }

    /// One of the rays.
    pub(super) fn ray(&self, lane: usize) -> Ray {
        let one_of = |of: &[[f64; 4]; 3]| DVec3::new(of[0][lane], of[1][lane], of[2][lane]);
        Ray::new(one_of(&self.origin), one_of(&self.dir))
    }
}

impl Shape {
    /// The first roots of four rays, for the shapes that are searched so.
    #[inline(never)]
    pub(super) fn search_of_four(&self, asked: &FourAsked) -> FourFound {
        match self {
            Shape::Superellipsoid(superellipsoid) => superellipsoid.nearest_of_four(asked),
            Shape::JuliaFractal(fractal) => fractal.nearest_of_four(asked),
            _ => FourFound {
                unknown: asked.there,
                ..FourFound::default()
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
    fn four_rays_find_what_each_finds() {
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
            let (mut known, mut met) = (0, 0);
            for round in 0..200 {
                let rays = [(); 4].map(|()| rng.ray_near(&shape.bounds()));
                let of =
                    |part: fn(&Ray) -> DVec3| [0, 1, 2].map(|axis| rays.map(|r| part(&r)[axis]));
                let asked = FourAsked {
                    origin: of(|ray| ray.origin),
                    dir: of(|ray| ray.dir),
                    from: [0.0; 4],
                    far: [[f64::INFINITY, 3.0][round % 2]; 4],
                    left: 0,
                    there: 0b1111,
                };
                let found = shape.search_of_four(&asked);
                for (lane, ray) in rays.iter().enumerate() {
                    if found.unknown >> lane & 1 == 1 {
                        continue;
                    }
                    let alone = shape.nearest(ray, 0.0, f64::INFINITY);
                    let alone = alone.filter(|root| root.t <= asked.far[lane]);
                    let four =
                        (found.met >> lane & 1 == 1).then_some((found.t[lane], Crossing::Enter));
                    assert_eq!(
                        four,
                        alone.map(|root| (root.t, root.crossing)),
                        "{shape:?} {ray:?}"
                    );
                    known += 1;
                    met += usize::from(four.is_some());
                }
            }
            assert!(known > 400 && met > 20, "{shape:?} {known} {met}");
        }
    }
}
