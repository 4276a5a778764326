//! Bounds of unbounded shapes that planes cut off: a cone between two planes is bounded, though none of the three is.
//! Without a box every ray would have to test such a CSG object.

use crate::base::math::Bounds;
use crate::scene::shape::Geometry;
use crate::world::primitive::Leaf;
use arrayvec::ArrayVec;
use glam::{DAffine3, DVec3};
use smallvec::SmallVec;

/// Largest other component of an axis-aligned normal, relative to the main one.
const AXIS_TOLERANCE: f64 = 1e-12;
/// Relative enlargement of boxes, more than the rounding errors here.
const SLACK: f64 = 1e-9;
/// Rounds of clipping: a limit on one axis may limit another in the next round.
const ROUNDS: u32 = 3;

/// Planes that are taken into account where none of the operands is bounded.
const MAX_PLANES: usize = 12;
/// The sine of an angle below which directions count as parallel.
const PARALLEL: f64 = 1e-6;
/// The same for planes whose line of intersection is unknown.
const ALIGNED: f64 = 1e-9;
/// Relative error of a corner on three planes that are nearly parallel to each other, and more.
const CORNER_SLACK: f64 = 1e-8;

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
    if !limited.is_finite() {
        limited = limited.touching_intersection(&polyhedron(&half_spaces(leaves, factors)));
    }
    limited
}

/// The planes of a polyhedron, by unit normal and distance: it lies below all of them.
type HalfSpaces = ArrayVec<(DVec3, f64), MAX_PLANES>;

/// The first planes among the factors; any of them hold the intersection.
fn half_spaces(leaves: &[Leaf], factors: &Factors) -> HalfSpaces {
    let half_space = |&(number, is_inverse): &(u32, bool)| {
        let leaf = &leaves[number as usize];
        let (normal, distance) = leaf.shape.half_space()?;
        let sign = if is_inverse { -1.0 } else { 1.0 };
        let scale = sign / normal.length();
        let is_known =
            leaf.object_from_world.is_none() && scale.is_normal() && distance.is_finite();
        is_known.then_some((normal * scale, distance * scale.abs() * sign))
    };
    factors
        .iter()
        .filter_map(half_space)
        .take(MAX_PLANES)
        .collect()
}

/// Bounds of the polyhedron below these planes: those of its corners, each on three of them; everything if it is
/// unbounded.
fn polyhedron(planes: &HalfSpaces) -> Bounds {
    let edges = |first: usize| {
        let (a, _) = planes[first];
        let second =
            (first + 1..planes.len()).map(move |second| (second, a.cross(planes[second].0)));
        second.filter(|(_, along)| along.length() > ALIGNED)
    };
    let goes_on = |along: DVec3| {
        planes
            .iter()
            .all(|(normal, _)| normal.dot(along) < PARALLEL * along.length())
    };
    let mut corners = Bounds::EMPTY;
    for first in 0..planes.len() {
        for (second, along) in edges(first) {
            if goes_on(along) || goes_on(-along) {
                return Bounds::EVERYTHING;
            }
            for &(c, at_c) in &planes[second + 1..] {
                let ((a, at_a), (b, at_b)) = (planes[first], planes[second]);
                let volume = along.dot(c);
                if volume.abs() < PARALLEL {
                    continue;
                }
                let corner = (at_a * b.cross(c) + at_b * c.cross(a) + at_c * along) / volume;
                let slack = CORNER_SLACK * (corner.length() + at_a.abs() + at_b.abs() + at_c.abs());
                if planes
                    .iter()
                    .all(|(normal, at)| normal.dot(corner) <= at + slack)
                {
                    corners = corners.union(&Bounds::new(corner - slack, corner + slack));
                }
            }
        }
    }
    match corners.is_finite() && !corners.is_empty() {
        true => corners,
        false => Bounds::EVERYTHING,
    }
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
        leaf(Shape::Plane(Plane::new(normal, distance)), steps)
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
    fn tilted_planes_that_enclose_a_polyhedron_bound_it() {
        let mut rng = Random::new(5);
        let (mut bounded, mut inside) = (0, 0);
        for round in 0..300 {
            let count = 4 + round % 5;
            let leaves: Vec<Leaf> = (0..count)
                .map(|_| plane(rng.vector(1.0), rng.uniform() - 0.1, &[]))
                .collect();
            let factors: Factors = (0..)
                .take(count)
                .map(|number| (number, round % 2 == 0))
                .collect();
            let around = clip_to_planes(&leaves, &factors, Bounds::EVERYTHING);
            bounded += usize::from(around.is_finite());
            for _ in 0..2_000 {
                let point = rng.vector(5.0);
                if leaves
                    .iter()
                    .all(|leaf| leaf.contains(point) != (round % 2 == 0))
                {
                    inside += 1;
                    assert!((around.min.cmple(point) & point.cmple(around.max)).all());
                }
            }
        }
        assert!(bounded > 30 && inside > 10_000, "{bounded} {inside}");
        let tetrahedron = [
            DVec3::new(1.0, 1.0, 1.0),
            DVec3::new(-1.0, -1.0, 1.0),
            DVec3::new(-1.0, 1.0, -1.0),
            DVec3::new(1.0, -1.0, -1.0),
        ];
        let leaves = tetrahedron.map(|normal| plane(normal, 3.0_f64.sqrt(), &[]));
        let around = |count| {
            let factors: Factors = (0..count).map(|number| (number, false)).collect();
            clip_to_planes(&leaves, &factors, Bounds::EVERYTHING)
        };
        let size = around(4).max - around(4).min;
        assert!(around(4).is_finite() && size.max_element() < 11.0, "{size}");
        assert!(!around(3).is_finite());
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
