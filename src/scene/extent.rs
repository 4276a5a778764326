//! The boxes that `min_extent` and `max_extent` tell: POV-Ray's own, which are not the smallest.
//!
//! All rules here were measured with POV-Ray 3.7.0.10. Boxes are kept in single precision, as a corner and lengths. A
//! combination's box is turned as a box at each step, so it grows; what is cut away shrinks it only where a plane along
//! the axes cuts. An inverse object has the box of the object itself.

use super::{Attached, Kind, Object, Operation};
use crate::base::math::{Bounds, Step, Transform};
use crate::scene::shape::{Geometry, Plane, Quadric, Shape};
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
            Kind::Shape(shape) => self.of_shape(shape, &[]),
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
        let clipped = self.narrowed(bare, self.clipped_by());
        self.narrowed(clipped, self.bounded_by())
    }

    /// What all clips or bounds that are not inverse share takes the place of the box if it is smaller.
    fn narrowed(&self, bounds: Stored, by: &[Attached<Arc<Object>>]) -> Stored {
        if by.iter().all(|held| held.what.is_inverse) {
            return bounds;
        }
        let shared = Stored::new(&shared(by, &self.steps));
        if shared.volume() < bounds.volume() {
            shared
        } else {
            bounds
        }
    }

    /// The box once what holds the object has moved it: that of a combination is turned with it, while what clips or
    /// bounds a shape counts no more.
    fn moved_box(&self, by: &[Step]) -> Stored {
        match &self.kind {
            _ if by.is_empty() => self.stored_box(),
            Kind::Shape(shape) => self.of_shape(shape, by),
            _ => turned(self.stored_box(), by),
        }
    }

    /// The box of the shape that the object is, after its own and more steps. What clips a quadric is known to it.
    fn of_shape(&self, shape: &Shape, more: &[Step]) -> Stored {
        if let Shape::Quadric(quadric) = shape
            && let Some(kept) = self.clipped_quadric(quadric)
        {
            return turned(kept, more);
        }
        let steps: Vec<Step> = self.steps.iter().chain(more).cloned().collect();
        of_shape(shape, &steps)
    }

    /// The box of a quadric as the last of its clips has left it that found it along the axes.
    fn clipped_quadric(&self, quadric: &Quadric) -> Option<Stored> {
        let clips = self.clipped_by();
        let along = |steps: &[Step]| {
            let is_along = |step: &Step| matches!(step, Step::Translate(_) | Step::Scale(_));
            steps.iter().all(is_along)
        };
        let count = clips.partition_point(|clip| along(&self.steps[..clip.after]));
        let last = clips[..count].last()?;
        let (before, after) = self.steps.split_at(last.after);
        let mut around = shared(&clips[..count], before);
        for clip in &clips[..count] {
            if let Kind::Shape(shape) = &clip.what.kind
                && let Shape::Plane(plane) = &**shape
            {
                let steps = [&clip.what.steps[..], &before[clip.after..]].concat();
                clip_at(&mut around, &moved(plane, &steps), clip.what.is_inverse);
            }
        }
        let to_world = Transform::from_steps(before);
        let mut kept = around;
        if !before.is_empty() {
            kept = kept.transformed(&to_world.object_from_world);
        }
        kept = quadric.known_limits(&kept);
        if !before.is_empty() {
            kept = kept.transformed(&to_world.world_from_object);
        }
        let is_known = kept.is_finite() && is_limited(&kept);
        is_known.then(|| turned(Stored::new(&kept), after))
    }
}

/// What the boxes of clips or bounds share that are not inverse, as they are after these steps of what they clip.
fn shared(by: &[Attached<Arc<Object>>], steps: &[Step]) -> Bounds {
    by.iter()
        .filter(|held| !held.what.is_inverse)
        .map(|held| held.what.moved_box(&steps[held.after..]).bounds())
        .fold(EVERYTHING.bounds(), |sum, held| sum.intersection(&held))
}

fn of_shape(shape: &Shape, steps: &[Step]) -> Stored {
    if let Some((held, from_held)) = shape.povray_box() {
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

/// Tells whether a box has ends on all sides.
pub(super) fn is_limited(bounds: &Bounds) -> bool {
    (bounds.max - bounds.min).max_element() < UNBOUNDED
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
            clip_at(&mut sum, &moved(plane, &child.steps), is_inverse);
        } else if !is_inverse && !is_height_field(child) {
            sum = sum.intersection(&child.extent());
        }
    }
    if !is_limited(&sum) || sum.is_empty() {
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

/// Tells whether an object is one of those whose boxes count for nothing in an intersection or a difference.
fn is_height_field(object: &Object) -> bool {
    matches!(&object.kind, Kind::Shape(shape) if matches!(**shape, Shape::HeightField(_)))
}

/// Cuts a box at a plane along the axes; others do nothing.
fn clip_at(bounds: &mut Bounds, plane: &Plane, is_inverse: bool) {
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
    if steps.is_empty() {
        return kept;
    }
    let bounds = kept.bounds();
    if !is_limited(&bounds) || bounds.is_empty() {
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
