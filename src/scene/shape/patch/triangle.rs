//! `triangle { <corner>, <corner>, <corner> }`: a patch without volume, edges included, two-sided.
//!
//! Neighbours that share an edge leave no gap (see [`RayFrame`]). Error bound: roots lie within 2 roundings of the
//! problem's size from the plane of the corners (`shape/roundings.rs`). Every transform moves the corners themselves,
//! so triangles that share corners in a scene still share them bit for bit in the world.

use crate::base::args::{Args, Parse};
use crate::base::math::conditioning::{Normalization, power_of_two};
use crate::base::math::watertight::{RayFrame, TriangleHit};
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::shape::{Crossing, Geometry, Root, Rounded, Start, Steps, first_visible, read};
use glam::DVec3;

/// A flat triangle. One whose corners all coincide is never hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// The corners.
    pub corners: [DVec3; 3],
}

impl Triangle {
    /// Reads three corners. Corners on one line give a warning and a triangle that is never hit.
    ///
    /// # Errors
    /// Malformed or non-finite parameters.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let at = args.span();
        let mut corners = [DVec3::ZERO; 3];
        for (corner, name) in corners.iter_mut().zip(["first", "second", "third"]) {
            *corner = read::vector(args, &format!("the {name} corner of the triangle"))?;
        }
        let triangle = Triangle { corners };
        if !triangle.is_degenerate() {
            return Ok(triangle);
        }
        args.warn(
            Diagnostic::warning(
                at.to(args.last_span()),
                "degenerate triangle: its corners lie on one line; it is left out",
            )
            .with_hint("Remove the triangle."),
        );
        Ok(triangle.collapsed())
    }

    /// True if the corners are collinear to within rounding.
    pub(crate) fn is_degenerate(&self) -> bool {
        let [a, b, c] = self.corners;
        let size = power_of_two((b - a).abs().max((c - a).abs()).max_element());
        let (ab, ac) = ((b - a) / size, (c - a) / size);
        // The cross product of parallel edges is only the rounding error of its terms.
        ab.cross(ac).length() <= 4.0 * f64::EPSILON * ab.length() * ac.length()
    }

    /// A triangle that is never hit.
    pub(crate) fn collapsed(&self) -> Self {
        Triangle {
            corners: [self.corners[0]; 3],
        }
    }

    pub(crate) fn hit(&self, ray: &Ray) -> Option<TriangleHit> {
        RayFrame::new(ray).hit(&self.corners)
    }

    /// Moves the corners.
    pub(super) fn move_by(&mut self, step: &Step) {
        let moved = step.transform().world_from_object;
        self.corners = self.corners.map(|corner| moved.transform_point3(corner));
    }

    /// Winds the corners as POV-Ray does before each transform; returns true if that turns the triangle over.
    fn wind(&mut self) -> bool {
        let [a, b, c] = self.corners;
        let size = power_of_two((a - b).abs().max((c - b).abs()).max_element());
        let across = ((a - b) / size).cross((c - b) / size);
        let small = self.corners.map(|corner| corner / size);
        let is_turned = turns_over(&small, Normalization::default().unit(across));
        if is_turned {
            self.corners.swap(0, 1);
        }
        is_turned
    }

    fn touch(&self, ray: &Ray) -> Option<Root> {
        self.hit(ray).map(|hit| Root {
            t: hit.t,
            crossing: Crossing::Touch,
            face: 0,
            is_visible: true,
        })
    }
}

/// True if POV-Ray exchanges the first two corners of a triangle: projected along the largest component of its normal
/// they are wound the other way (docs/povray-shapes.md, section 5.4).
pub(in crate::scene::shape) fn turns_over([a, b, c]: &[DVec3; 3], normal: DVec3) -> bool {
    let turn = |i: usize, j: usize| (b[i] - c[i]) * (b[j] - a[j]) < (b[j] - c[j]) * (b[i] - a[i]);
    let size = normal.abs();
    if size.x >= size.y && size.x >= size.z {
        turn(1, 2)
    } else if size.y >= size.z {
        turn(0, 2)
    } else {
        turn(0, 1)
    }
}

impl Geometry for Triangle {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        roots.extend(self.touch(ray));
        Start::Outside
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        first_visible(self.touch(ray).as_slice(), from, to)
    }

    fn keeps_normal(&self) -> bool {
        true
    }

    fn normal(&self, _: DVec3, _: u32) -> DVec3 {
        let [a, b, c] = self.corners;
        let size = power_of_two((b - a).abs().max((c - a).abs()).max_element());
        // With this winding `interior_texture` shows on the side where POV-Ray shows it.
        ((c - a) / size).cross((b - a) / size)
    }

    fn contains(&self, _: DVec3) -> bool {
        false
    }

    fn bounds(&self) -> Bounds {
        let [a, b, c] = self.corners;
        if a == b && b == c {
            return Bounds::EMPTY;
        }
        Bounds::new(a, b).with_point(c)
    }

    fn rounded(&self, steps: &Steps<'_>) -> Option<Rounded> {
        Some(Rounded::of_triangle(self, steps))
    }

    fn note_steps(&mut self, steps: &[Step]) {
        let mut moved = *self;
        let turns = steps.iter().filter(|step| {
            let is_turned = moved.wind();
            moved.move_by(step);
            is_turned
        });
        if turns.count() % 2 == 1 {
            self.corners.swap(0, 1);
        }
    }

    fn absorb(&mut self, step: &Step) -> bool {
        self.wind();
        self.move_by(step);
        true
    }

    fn is_solid(&self) -> bool {
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::math::sampling::random::Random;
    use crate::scene::shape::tests::check;

    fn triangle(text: &str) -> Triangle {
        Triangle::read(&mut TextArgs::new(text)).unwrap()
    }

    #[test]
    fn a_scale_by_a_power_of_two_is_absorbed_exactly() {
        check::absorbs_scales_exactly(&triangle("<1,2,-3>, <-1,3,2>, <2,0,1>"));
    }

    #[test]
    fn rounded_hits_follow_from_the_moved_corners() {
        let mut rng = Random::new(7);
        let mut vector = || DVec3::from_array([0; 3].map(|_| 2.0 * rng.uniform() - 1.0));
        let normalization = Normalization::default();
        for _ in 0..500 {
            let mut moved = Triangle {
                corners: [vector(), vector(), vector()],
            };
            let steps = [
                Step::Rotate(360.0 * vector()),
                Step::Translate(vector()),
                Step::Scale(vector()),
            ];
            let ray = Ray::new(5.0 * vector(), vector().normalize());
            let hit = |triangle: &Triangle, steps: &[Step]| {
                let steps = Steps {
                    steps,
                    normalization,
                };
                let hit = Rounded::of_triangle(triangle, &steps).hit(&ray, 0.0, 0);
                hit.map(|hit| (hit.t, hit.normal))
            };
            let expected = hit(&moved, &steps);
            assert!(steps.iter().all(|step| moved.absorb(step)));
            assert_eq!(hit(&moved, &[]), expected);
            let normal = moved.normal(DVec3::ZERO, 0);
            assert!(expected.is_some_and(|(_, rounded)| rounded.dot(normal) > 0.0));
        }
    }

    #[test]
    fn it_is_a_patch() {
        let tilted = triangle("<1,2,3>, <-2,3,5>, <0.5,-1,2>");
        check::patch(&tilted);
        check::scales_exactly(&tilted, |k| Triangle {
            corners: tilted.corners.map(|corner| corner * k),
        });
    }

    #[test]
    fn a_fan_has_no_gaps() {
        let mut rng = check::Random::new(11);
        for _ in 0..300 {
            let hub = rng.vector(2.0);
            let rim: Vec<DVec3> = (0..7)
                .map(|i| {
                    let (s, c) = (f64::from(i) * std::f64::consts::TAU / 7.0).sin_cos();
                    hub + DVec3::new(c, s, 0.3 * c) * (0.5 + rng.uniform())
                })
                .collect();
            let origin = rng.vector(1.0) + DVec3::new(0.0, 0.0, -6.0);
            for aim in 0..8 {
                // At the hub, and through the spokes between it and the rim.
                let target = if aim == 7 {
                    hub
                } else {
                    hub.lerp(rim[aim], rng.uniform())
                };
                let ray = Ray::new(origin, target - origin);
                let hits = (0..7).filter(|&i| {
                    let corners = [hub, rim[i], rim[(i + 1) % 7]];
                    Triangle { corners }.hit(&ray).is_some()
                });
                assert!(hits.count() >= 1);
            }
        }
    }

    #[test]
    fn edges_and_corners_belong_to_it() {
        let flat = triangle("<0,0,0>, <1,0,0>, <0,1,0>");
        for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.5, 0.5), (0.0, 0.3)] {
            let ray = Ray::new(DVec3::new(x, y, -2.0), DVec3::Z);
            assert_eq!(flat.nearest(&ray, 0.0, 9.0).unwrap().t, 2.0);
        }
        let outside = Ray::new(DVec3::new(0.5, 0.5 + f64::EPSILON, -2.0), DVec3::Z);
        assert!(flat.hit(&outside).is_none());
    }

    #[test]
    fn a_ray_in_its_plane_misses() {
        let flat = triangle("<0,0,0>, <1,0,0>, <0,1,0>");
        let ray = Ray::new(DVec3::new(-1.0, 0.2, 0.0), DVec3::X);
        assert!(flat.hit(&ray).is_none());
    }

    #[test]
    fn extreme_units_change_nothing() {
        for scale in [1e-300, 1e-170, 1e170, 1e300] {
            let corners = [DVec3::ZERO, DVec3::X, DVec3::Y].map(|corner| corner * scale);
            let ray = Ray::new(
                DVec3::new(0.2, 0.3, -2.0) * scale,
                DVec3::new(0.1, 0.0, 1.0),
            );
            let hit = Triangle { corners }.hit(&ray).unwrap();
            assert!((hit.t / scale - 2.0).abs() < 1e-15);
        }
    }

    #[test]
    fn corners_on_a_line_are_warned_of_and_never_hit() {
        let mut args = TextArgs::new("<0,0,0>, <.1,.1,.1>, <.3,.3,.3>");
        let nothing = Triangle::read(&mut args).unwrap();
        assert_eq!(
            args.warnings()[0],
            "degenerate triangle: its corners lie on one line; it is left out"
        );
        assert!(nothing.bounds().is_empty());
        let through = Ray::new(DVec3::new(0.0, 0.0, -1.0), DVec3::Z);
        assert!(nothing.hit(&through).is_none());
    }
}
