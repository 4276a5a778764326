//! Bounds of unbounded shapes that planes cut off: a cone between two planes is bounded, though none of the three is.
//! Without a box every ray would have to test such a CSG object.

use crate::base::math::Bounds;
use crate::scene::shape::Geometry;
use crate::world::primitive::Leaf;
use glam::{DAffine3, DVec3};
use smallvec::SmallVec;

/// Largest other component of an axis-aligned normal, relative to the main one.
const AXIS_TOLERANCE: f64 = 1e-12;
/// Relative enlargement of boxes, more than the rounding errors here.
const SLACK: f64 = 1e-9;
/// Rounds of clipping: a limit on one axis may limit another in the next round.
const ROUNDS: u32 = 3;

/// Factors of an intersection: primitives by index, marked if inverse.
pub(crate) type Factors = SmallVec<[(u32, bool); 8]>;

/// Bounds of the intersection of all factors within a box.
pub(crate) fn clip_to_planes(leaves: &[Leaf], factors: &Factors, around: Bounds) -> Bounds {
    let mut limited = around;
    for &(number, is_inverse) in factors {
        let leaf = &leaves[number as usize];
        limited = limited.touching_intersection(&of_plane(leaf, is_inverse));
        if leaf.shape.limited(&limited, is_inverse).is_some() {
            let in_world = of_unbounded(leaf, is_inverse, leaves, factors, &limited);
            limited = limited.touching_intersection(&in_world);
        }
    }
    limited
}

/// Bounds of the inside of an unbounded primitive, or of its outside, within a box and the planes among the factors.
fn of_unbounded(
    unbounded: &Leaf,
    is_inverse: bool,
    leaves: &[Leaf],
    factors: &Factors,
    around: &Bounds,
) -> Bounds {
    let object_from_world = unbounded.object_from_world.as_deref();
    let object_from_world = object_from_world.copied().unwrap_or(DAffine3::IDENTITY);
    let world_from_object = object_from_world.inverse();
    if !world_from_object.is_finite() {
        return Bounds::EVERYTHING;
    }
    let mut here = around.transformed(&object_from_world);
    for &(number, is_inverse) in factors {
        let leaf = &leaves[number as usize];
        if leaf.object_from_world.is_none()
            && let Some((normal, distance)) = leaf.shape.half_space()
        {
            let sign = if is_inverse { -1.0 } else { 1.0 };
            here = here.intersection(&half_space(normal, distance, sign, &world_from_object));
        }
    }
    for _ in 0..ROUNDS {
        here = unbounded.shape.limited(&here, is_inverse).unwrap_or(here);
    }
    if here.is_empty() || !here.is_finite() {
        return Bounds::EVERYTHING;
    }
    let slack = SLACK * here.min.abs().max(here.max.abs()).max_element();
    let wide = Bounds {
        min: here.min - slack,
        max: here.max + slack,
    };
    wide.transformed(&world_from_object)
}

/// A half-space, as POV-Ray bounds intersections with it: everything if its plane is not exactly axis-aligned.
fn of_plane(leaf: &Leaf, is_inverse: bool) -> Bounds {
    match (leaf.shape.half_space(), &leaf.object_from_world) {
        (Some((normal, distance)), None)
            if (0..3).filter(|&axis| normal[axis] != 0.0).count() == 1 =>
        {
            let sign = if is_inverse { -1.0 } else { 1.0 };
            half_space(normal, distance, sign, &DAffine3::IDENTITY)
        }
        _ => Bounds::EVERYTHING,
    }
}

/// A half-space in object space, as a box; everything if its plane is not axis-aligned there.
fn half_space(normal: DVec3, distance: f64, sign: f64, world_from_object: &DAffine3) -> Bounds {
    let distance = sign * (distance - normal.dot(world_from_object.translation));
    let normal = sign * (world_from_object.matrix3.transpose() * normal);
    let mut bounds = Bounds::EVERYTHING;
    let size = normal.abs().max_element();
    let large = (0..3).filter(|&axis| normal[axis].abs() > AXIS_TOLERANCE * size);
    if let [axis] = large.collect::<SmallVec<[usize; 3]>>()[..] {
        let end = distance / normal[axis];
        if normal[axis] > 0.0 {
            bounds.max[axis] = end;
        } else {
            bounds.min[axis] = end;
        }
    }
    // NaN limits nothing.
    let known = |end: DVec3, unknown: f64| end.map(|end| if end.is_nan() { unknown } else { end });
    Bounds {
        min: known(bounds.min, f64::NEG_INFINITY),
        max: known(bounds.max, f64::INFINITY),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::sampling::random::Random;
    use crate::base::math::{Step, Transform};
    use crate::scene::shape::{Plane, Quadric, Shape};
    use crate::world::{Extent, primitive::Absorb};

    fn leaf(shape: Shape, steps: &[Step]) -> Leaf {
        Leaf::new(shape, steps, Absorb::AllItCan, 0, Extent::Solid).0
    }

    fn plane(normal: DVec3, distance: f64, steps: &[Step]) -> Leaf {
        leaf(Shape::Plane(Plane { normal, distance }), steps)
    }

    fn quadric(squares: DVec3, linear: DVec3, constant: f64, steps: &[Step]) -> Leaf {
        let quadric = Quadric::new(squares, DVec3::ZERO, linear, constant);
        leaf(Shape::Quadric(quadric), steps)
    }

    #[test]
    fn what_planes_leave_of_a_quadric_has_a_box_wherever_it_stands() {
        let turned = [
            Step::Scale(DVec3::new(0.5, 3.0, 2.0)),
            Step::Rotate(DVec3::new(20.0, -50.0, 130.0)),
            Step::Translate(DVec3::new(7.0, -3.0, 1e3)),
        ];
        let mut rng = Random::new(11);
        for steps in [&[][..], &turned] {
            for (squares, linear, constant) in [
                (DVec3::new(1.0, 0.0, 1.0), DVec3::ZERO, -1.0),
                (DVec3::new(1.0, -1.0, 1.0), DVec3::ZERO, -0.2),
                (DVec3::new(1.0, 0.0, 2.0), DVec3::new(0.5, -1.0, 0.0), 0.0),
            ] {
                let leaves = [
                    plane(DVec3::Y, 2.0, steps),
                    plane(DVec3::Y, -1.0, steps),
                    quadric(squares, linear, constant, steps),
                ];
                let factors = Factors::from_slice(&[(0, false), (1, true), (2, false)]);
                let around = clip_to_planes(&leaves, &factors, Bounds::EVERYTHING);
                assert!(around.is_finite(), "{squares}");
                let to_world = Transform::from_steps(steps).world_from_object;
                let mut inside = 0;
                for _ in 0..20_000 {
                    let point = to_world.transform_point3(rng.vector(4.0));
                    let holds = |leaf: &Leaf| leaf.contains(point);
                    if holds(&leaves[0]) && !holds(&leaves[1]) && holds(&leaves[2]) {
                        inside += 1;
                        assert!((around.min.cmple(point) & point.cmple(around.max)).all());
                    }
                }
                assert!(inside > 20, "{inside}");
            }
        }
    }

    #[test]
    fn what_no_planes_close_has_none() {
        let cylinder = quadric(DVec3::new(1.0, 0.0, 1.0), DVec3::ZERO, -1.0, &[]);
        let leaves = [plane(DVec3::Y, 2.0, &[]), cylinder];
        let factors = Factors::from_slice(&[(0, false), (1, false)]);
        let around = clip_to_planes(&leaves, &factors, Bounds::EVERYTHING);
        assert!(!around.is_finite());
        // The outside of a cylinder between planes is unbounded too.
        let leaves = [
            plane(DVec3::Y, 2.0, &[]),
            plane(DVec3::Y, -1.0, &[]),
            quadric(DVec3::new(1.0, 0.0, 1.0), DVec3::ZERO, -1.0, &[]),
        ];
        let factors = Factors::from_slice(&[(0, false), (1, true), (2, true)]);
        let around = clip_to_planes(&leaves, &factors, Bounds::EVERYTHING);
        assert!(!around.is_finite() && !leaves[2].shape.bounds().is_finite());
    }
}
