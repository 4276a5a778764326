//! `smooth_triangle { <corner>, <normal>, <corner>, <normal>, <corner>, <normal> }`: a flat triangle with interpolated
//! shading normals. Roots and error bound are those of the flat triangle.
//!
//! The shading normal is the barycentric mean of the corner normals, each normalised first. `scale` keeps them unit
//! vectors; `matrix` and `transform` leave them as long as the inverse transpose makes them, and so change their
//! weights in the mean (measured with `trace`). A transform after which the normals do not all lie on one side makes
//! the triangle empty, as in POV-Ray: `scale` can do so, because it turns normals differently than the face.

use crate::base::args::{Args, Parse};
use crate::base::math::conditioning::{power_of_two, unit};
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::shape::{Geometry, Root, Start, Triangle, read};
use glam::{DVec2, DVec3};

/// A triangle with a normal at each corner.
#[derive(Clone, Debug, PartialEq)]
pub struct SmoothTriangle {
    /// The triangle.
    pub flat: Triangle,
    /// The corner normals: unit vectors, until a `matrix` transforms them.
    pub normals: Box<[DVec3; 3]>,
}

impl SmoothTriangle {
    /// Reads three corners, each followed by its normal. Corners on one line, or normals that do not all lie on one
    /// side of the face, give a warning and a triangle that is never hit.
    ///
    /// # Errors
    /// Malformed or non-finite parameters.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let at = args.span();
        let (mut corners, mut normals) = ([DVec3::ZERO; 3], [DVec3::ZERO; 3]);
        for (i, name) in ["first", "second", "third"].into_iter().enumerate() {
            corners[i] = read::vector(args, &format!("the {name} corner of the smooth triangle"))?;
            normals[i] = read::vector(args, &format!("the {name} normal of the smooth triangle"))?;
        }
        let mut flat = Triangle { corners };
        let fault = if flat.is_degenerate() {
            Some("its corners lie on one line")
        } else if !are_on_one_side(flat.normal(corners[0], 0), &normals) {
            Some("its normals do not all lie on one side of it")
        } else {
            None
        };
        if let Some(fault) = fault {
            flat = flat.collapsed();
            args.warn(
                Diagnostic::warning(
                    at.to(args.last_span()),
                    format!("degenerate triangle: {fault}; it is left out"),
                )
                .with_hint("Remove the triangle."),
            );
        }
        let normals = normals.map(|normal| unit(normal).unwrap_or(DVec3::ZERO));
        Ok(SmoothTriangle {
            flat,
            normals: Box::new(normals),
        })
    }
}

fn are_on_one_side(face: DVec3, normals: &[DVec3; 3]) -> bool {
    let sides = normals.map(|normal| unit(normal).map_or(0.0, |normal| normal.dot(face)));
    sides.iter().all(|side| *side > 0.0) || sides.iter().all(|side| *side < 0.0)
}

/// Barycentric coordinates of a point of the triangle, from areas projected along the dominant axis of its normal.
pub(crate) fn weights(corners: &[DVec3; 3], normal: DVec3, point: DVec3) -> [f64; 3] {
    let steep = normal.abs();
    let flatten = |v: DVec3| {
        if steep.x >= steep.y && steep.x >= steep.z {
            DVec2::new(v.y, v.z)
        } else if steep.y >= steep.z {
            DVec2::new(v.z, v.x)
        } else {
            DVec2::new(v.x, v.y)
        }
    };
    let (ab, ac) = (corners[1] - corners[0], corners[2] - corners[0]);
    let size = power_of_two(ab.abs().max(ac.abs()).max_element());
    let [ab, ac, p] = [ab, ac, point - corners[0]].map(|v| flatten(v / size));
    let area = ab.perp_dot(ac);
    let (second, third) = (p.perp_dot(ac) / area, ab.perp_dot(p) / area);
    [1.0 - second - third, second, third]
}

impl Geometry for SmoothTriangle {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        self.flat.roots(ray, roots)
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        self.flat.nearest(ray, from, to)
    }

    fn keeps_normal(&self) -> bool {
        true
    }

    fn normal(&self, point: DVec3, face: u32) -> DVec3 {
        self.flat.normal(point, face)
    }

    fn contains(&self, _: DVec3) -> bool {
        false
    }

    fn bounds(&self) -> Bounds {
        self.flat.bounds()
    }

    fn absorb(&mut self, step: &Step) -> bool {
        let transform = step.transform();
        let moved = self.normals.map(|normal| {
            let moved = transform.normal(normal);
            let keeps_length = !matches!(step, Step::Scale(_));
            let is_usable = keeps_length && moved.is_finite() && moved != DVec3::ZERO;
            is_usable.then_some(moved).or_else(|| unit(moved))
        });
        let [Some(first), Some(second), Some(third)] = moved else {
            return false;
        };
        *self.normals = [first, second, third];
        self.flat.move_by(step);
        let face = self.flat.normal(self.flat.corners[0], 0);
        if !are_on_one_side(face, &self.normals) {
            self.flat = self.flat.collapsed();
        }
        true
    }

    fn shading_normal(&self, point: DVec3, face: u32) -> Option<DVec3> {
        let normal = self.flat.normal(point, face);
        let [a, b, c] = weights(&self.flat.corners, normal, point);
        let mean = a * self.normals[0] + b * self.normals[1] + c * self.normals[2];
        mean.is_finite().then_some(mean)
    }

    fn is_solid(&self) -> bool {
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::scene::shape::tests::check;

    const TEXT: &str = "<-1,-1,0>, <-1,0,-2>, <1,-1,0>, <1,0,-2>, <0,1,0>, <0,1,-1>";

    fn smooth(text: &str) -> SmoothTriangle {
        SmoothTriangle::read(&mut TextArgs::new(text)).unwrap()
    }

    #[test]
    fn it_is_a_patch() {
        check::patch(&smooth(TEXT));
    }

    #[test]
    fn the_shading_normal_is_the_mean_of_the_corners() {
        let triangle = smooth(TEXT);
        for i in 0..3 {
            let at_corner = triangle
                .shading_normal(triangle.flat.corners[i], 0)
                .unwrap();
            assert!((at_corner - triangle.normals[i]).length() < 1e-15);
        }
        let middle = triangle
            .shading_normal(DVec3::new(0.0, -1.0, 0.0), 0)
            .unwrap();
        let expected = 0.5 * (triangle.normals[0] + triangle.normals[1]);
        assert!((middle - expected).length() < 1e-15);
    }

    #[test]
    fn normals_not_on_one_side_are_warned_of() {
        // POV-Ray 3.7 also drops a triangle with a normal in its plane.
        for third in ["<0,1,1>", "<0,1,0>"] {
            let text = format!("<-1,-1,0>, <-1,0,-2>, <1,-1,0>, <1,0,-2>, <0,1,0>, {third}");
            let mut args = TextArgs::new(&text);
            assert!(SmoothTriangle::read(&mut args).unwrap().bounds().is_empty());
            assert_eq!(
                args.warnings()[0],
                "degenerate triangle: its normals do not all lie on one side of it; it is left out"
            );
        }
    }

    #[test]
    fn scaling_turns_the_normals_by_the_inverse_transpose() {
        let mut triangle = smooth(TEXT);
        assert!(triangle.absorb(&Step::Scale(DVec3::new(2.0, 1.0, 1.0))));
        let expected = DVec3::new(-0.5, 0.0, -2.0).normalize();
        assert!((triangle.normals[0] - expected).length() < 1e-15);
        assert_eq!(triangle.flat.corners[1], DVec3::new(2.0, -1.0, 0.0));
    }

    #[test]
    fn a_scale_that_moves_a_normal_to_the_other_side_empties_the_triangle() {
        // Measured with POV-Ray 3.7.
        let text =
            "<-1,-0.5,0>, <-0.3,0.5,-1>, <1,-0.3,0.3>, <0.3,0.5,-1>, <0.1,0.9,-0.2>, <0,1,-0.5>";
        let scaled = |by: [f64; 3]| {
            let mut triangle = smooth(text);
            assert!(triangle.absorb(&Step::Scale(DVec3::from(by))));
            assert!(triangle.absorb(&Step::Rotate(DVec3::X * 20.0)));
            triangle.bounds()
        };
        for is_left in [
            [1.1, 1.0, 1.0],
            [1.0, 1.0, 0.9],
            [1.0, 2.0, 1.0],
            [1.0, 0.999, 1.0],
        ] {
            assert!(!scaled(is_left).is_empty(), "{is_left:?}");
        }
        for is_gone in [[1.0, 0.7, 1.0], [1.0, 1.0, 2.0]] {
            assert!(scaled(is_gone).is_empty(), "{is_gone:?}");
        }
    }

    #[test]
    fn a_matrix_changes_the_weights_of_the_normals_and_a_scale_does_not() {
        use crate::base::math::Transform;
        use std::sync::Arc;
        // With `trace` in POV-Ray: `scale <1, 2, 1>`, and the same as a `matrix`.
        let text = "<-1, -0.8, 0>, <-0.3, -0.3, -1>, <1, -0.6, 0.2>, <0.4, -0.2, -1>, <-0.2, 1, -0.2>, <0, 0.5, -1>";
        let by = DVec3::new(1.0, 2.0, 1.0);
        let general = Step::General(Arc::new(Transform::scaling(by)));
        let expected = [
            (
                Step::Scale(by),
                DVec3::new(0.054613403, 0.032754759, -0.997970191),
            ),
            (general, DVec3::new(0.057724465, 0.027382014, -0.997956969)),
        ];
        for (step, expected) in expected {
            let mut shape = smooth(text);
            assert!(shape.absorb(&step));
            let ray = Ray::new(DVec3::new(0.0, 0.0, -5.0), DVec3::Z);
            let hit = shape.nearest(&ray, 0.0, f64::INFINITY).unwrap();
            let normal = shape
                .shading_normal(ray.at(hit.t), hit.face)
                .unwrap()
                .normalize();
            assert!((normal - expected).length() < 1e-9, "{step:?} {normal}");
        }
    }
}
