//! The boxes that `min_extent` and `max_extent` tell: POV-Ray's own, which are not the smallest.
//!
//! All rules here were measured with POV-Ray 3.7.0.10. Boxes are kept in single precision, as a corner and lengths. A
//! combination's box is turned as a box at each step, so it grows; what is cut away shrinks it only where a plane along
//! the axes cuts. An inverse object has the box of the object itself.

use super::{Attached, Kind, Object, Operation};
use crate::math::{Bounds, Step, Transform};
use crate::shape::{Geometry, Plane, Shape};
use glam::DVec3;
use std::sync::Arc;

/// How far what has no bounds reaches.
const UNBOUNDED: f64 = 1e10;
const EVERYTHING: Stored = Stored {
    min: DVec3::splat(-UNBOUNDED),
    sides: DVec3::splat(2.0 * UNBOUNDED),
};
/// How large the other components of a plane's unit normal may be where it is along an axis.
const ACROSS: f64 = 1e-9;

/// A box as POV-Ray keeps it.
#[derive(Clone, Copy, Debug)]
pub struct Stored {
    /// The lower corner.
    pub min: DVec3,
    /// The lengths of its sides.
    pub sides: DVec3,
}

impl Stored {
    fn new(bounds: &Bounds) -> Stored {
        Stored {
            min: single(bounds.min),
            sides: single(bounds.max - bounds.min),
        }
    }

    /// The box from corner to corner.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        Bounds {
            min: self.min,
            max: single(self.min + self.sides),
        }
    }

    fn volume(&self) -> f64 {
        let bounds = self.bounds();
        (bounds.max - bounds.min).element_product()
    }
}

impl Object {
    /// The box around the object as the language tells it.
    #[must_use]
    pub fn extent(&self) -> Bounds {
        self.stored_box().bounds()
    }

    /// The same as it is kept.
    #[must_use]
    pub fn stored_box(&self) -> Stored {
        let bare = match &self.kind {
            Kind::Shape(shape) => of_shape(shape, &self.steps),
            Kind::Csg {
                operation,
                children,
            } => {
                let combined = match operation {
                    Operation::Union | Operation::Merge => {
                        let boxes = children.iter().map(|child| child.extent());
                        Stored::new(&boxes.fold(Bounds::EMPTY, |sum, child| sum.union(&child)))
                    }
                    Operation::Intersection | Operation::Difference => cut(*operation, children),
                };
                turned(combined, &self.steps)
            }
            Kind::Light { .. } => EVERYTHING,
        };
        self.around()
            .fold(bare, |bounds, attached| self.narrowed(bounds, attached))
    }

    /// A clip or a bound takes the place of the box if its own box is smaller.
    fn narrowed(&self, bounds: Stored, by: &Attached<Arc<Object>>) -> Stored {
        let mut by_then = (*by.what).clone();
        by_then.steps.extend_from_slice(&self.steps[by.after..]);
        let other = by_then.stored_box();
        if other.volume() < bounds.volume() {
            other
        } else {
            bounds
        }
    }
}

fn of_shape(shape: &Shape, steps: &[Step]) -> Stored {
    if let Some((held, from_held)) = shape.held_box() {
        let steps = Transform::from_steps(steps).world_from_object;
        return Stored::new(&held.transformed(&(steps * from_held)));
    }
    let mut shape = shape.clone();
    let taken_in = steps.iter().take_while(|step| shape.absorb(step)).count();
    let bounds = shape.bounds();
    if !bounds.is_finite() {
        return EVERYTHING;
    }
    let rest = Transform::from_steps(&steps[taken_in..]);
    Stored::new(&bounds.transformed(&rest.world_from_object))
}

/// The box of an intersection or a difference before its own steps.
fn cut(operation: Operation, children: &[Arc<Object>]) -> Stored {
    let mut sum = EVERYTHING.bounds();
    for (at, child) in children.iter().enumerate() {
        let is_taken_away = operation == Operation::Difference && at > 0;
        let is_inverse = child.is_inverse != is_taken_away;
        if let Kind::Shape(shape) = &child.kind
            && let Shape::Plane(plane) = &**shape
        {
            clip(&mut sum, &moved(plane, &child.steps), is_inverse);
        } else if !is_inverse {
            sum = sum.intersection(&child.extent());
        }
    }
    let is_open = (sum.max - sum.min).max_element() >= UNBOUNDED;
    if is_open || sum.is_empty() {
        EVERYTHING
    } else {
        Stored::new(&sum)
    }
}

fn moved(plane: &Plane, steps: &[Step]) -> Plane {
    let transform = Transform::from_steps(steps);
    let point = transform
        .world_from_object
        .transform_point3(plane.distance * plane.normal);
    let normal = transform.normal(plane.normal).normalize_or_zero();
    Plane {
        normal,
        distance: normal.dot(point),
    }
}

/// Cuts a box at a plane along the axes; others do nothing.
fn clip(bounds: &mut Bounds, plane: &Plane, is_inverse: bool) {
    for axis in 0..3 {
        let across = (0..3).filter(|&other| other != axis);
        let is_along = across
            .map(|other| plane.normal[other].abs())
            .all(|part| part < ACROSS);
        if !is_along || plane.normal == DVec3::ZERO {
            continue;
        }
        let at = plane.distance * plane.normal[axis].signum();
        if (plane.normal[axis] > 0.0) != is_inverse {
            bounds.max[axis] = bounds.max[axis].min(at);
        } else {
            bounds.min[axis] = bounds.min[axis].max(at);
        }
    }
}

/// A box after each step in turn.
fn turned(kept: Stored, steps: &[Step]) -> Stored {
    let bounds = kept.bounds();
    let is_unbounded = (bounds.max - bounds.min).max_element() >= UNBOUNDED;
    if is_unbounded || bounds.is_empty() {
        return EVERYTHING;
    }
    steps.iter().fold(kept, |kept, step| {
        let bounds = kept.bounds();
        Stored::new(&bounds.transformed(&step.transform().world_from_object))
    })
}

/// A vector in single precision.
fn single(v: DVec3) -> DVec3 {
    DVec3::from(v.as_vec3())
}
