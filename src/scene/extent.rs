//! The boxes that `min_extent` and `max_extent` return: POV-Ray's own, which are not the smallest.
//!
//! All rules here were measured with POV-Ray 3.7.0.10. Boxes are stored in single precision, as a corner and side
//! lengths. The box of a CSG object is transformed as a box at each step, so it grows. Subtracted objects shrink a box
//! only if they are axis-aligned planes. An inverse object has the box of the object itself.

use super::{Attached, Kind, Object, Operation};
use crate::base::math::{Bounds, Step, Transform};
use crate::scene::shape::{Geometry, Plane, Quadric, Shape};
use glam::DVec3;
use std::sync::Arc;

/// Half the side of the box of an unbounded object in POV-Ray.
const POVRAY_UNBOUNDED: f64 = 1e10;
/// The same here, out of reach of scenes in small units of length.
const UNBOUNDED: f64 = POVRAY_UNBOUNDED * FARTHER;
const FARTHER: f64 = (1u128 << 70) as f64;
const EVERYTHING: ExtentBox = ExtentBox {
    min: DVec3::splat(-UNBOUNDED),
    sides: DVec3::splat(2.0 * UNBOUNDED),
};
/// Largest other component of the unit normal of a plane that counts as axis-aligned.
const NORMAL_TOLERANCE: f64 = 1e-9;

/// A box as POV-Ray stores it, in single precision.
#[derive(Clone, Copy, Debug)]
pub struct ExtentBox {
    /// The lower corner.
    pub min: DVec3,
    /// The lengths of its sides.
    pub sides: DVec3,
}

impl ExtentBox {
    fn new(bounds: &Bounds) -> ExtentBox {
        ExtentBox {
            min: single(bounds.min),
            sides: single(bounds.max - bounds.min),
        }
    }

    /// The box of a shape moved by `steps`, as a pair of corners, infinite if the shape is unbounded.
    pub(crate) fn of_shape(shape: &Shape, steps: &[Step]) -> Bounds {
        limited(shape_box(shape, steps))
    }

    /// The box as a pair of corners, the upper one in double precision.
    pub(crate) fn bounds(&self) -> Bounds {
        Bounds {
            min: self.min,
            max: self.min + self.sides,
        }
    }

    fn volume(&self) -> f64 {
        self.sides.element_product()
    }
}

impl Object {
    /// The bounding box that the language returns for the object.
    #[must_use]
    pub fn extent(&self) -> Bounds {
        let bounds = self.single_extent();
        if is_limited(&bounds) {
            return bounds;
        }
        let nearer = |corner: DVec3| {
            let is_far = corner.abs().cmpge(DVec3::splat(0.5 * UNBOUNDED));
            DVec3::select(is_far, corner / FARTHER, corner)
        };
        Bounds {
            min: nearer(bounds.min),
            max: nearer(bounds.max),
        }
    }

    /// The bounding box with both corners in single precision; larger than [`UNBOUNDED`] where POV-Ray knows no limit.
    pub(super) fn single_extent(&self) -> Bounds {
        let bounds = self.extent_box().bounds();
        Bounds {
            max: single(bounds.max),
            ..bounds
        }
    }

    /// The same box as POV-Ray stores it.
    #[must_use]
    pub fn extent_box(&self) -> ExtentBox {
        let bare = match self.extent_so_far() {
            Some(known) => transformed_by_steps(known.what, &self.steps[known.after..]),
            None => self.bare_extent(),
        };
        let clipped = self.shrunk(bare, self.clipped_by());
        self.shrunk(clipped, self.bounded_by())
    }

    /// The box of the object without what clips or bounds it.
    fn bare_extent(&self) -> ExtentBox {
        match &self.kind {
            Kind::Shape(shape) => self.shape_box(shape, &[]),
            Kind::Csg {
                operation,
                children,
            } => {
                let combined = match operation {
                    Operation::Union | Operation::Merge => {
                        let boxes = children.iter().map(|child| child.extent_box().bounds());
                        ExtentBox::new(&boxes.fold(Bounds::EMPTY, |sum, child| sum.union(&child)))
                    }
                    Operation::Intersection | Operation::Difference => {
                        csg_box(*operation, children)
                    }
                };
                transformed_by_steps(combined, &self.steps)
            }
            Kind::Light { .. } => EVERYTHING,
        }
    }

    /// Stores the box of a clipped or bounded CSG object. Called at the end of each statement about it: only there are
    /// boxes shrunk, and later transforms move the shrunk box.
    pub(crate) fn keep_extent(&mut self) {
        if matches!(self.kind, Kind::Csg { .. }) && self.clips_and_bounds().next().is_some() {
            let extent = self.extent_box();
            self.set_extent_so_far(extent);
        }
    }

    /// The box of the object after transforms of enclosing unions, infinite if it is unbounded.
    pub(crate) fn extent_below(&self, steps: &[Step]) -> Bounds {
        limited(self.transformed_box(steps))
    }

    /// The intersection of all non-inverse clipping or bounding objects, if it is smaller than the box; otherwise the
    /// box.
    fn shrunk(&self, bounds: ExtentBox, by: &[Attached<Arc<Object>>]) -> ExtentBox {
        if by.iter().all(|held| held.what.is_inverse) {
            return bounds;
        }
        let common_box = ExtentBox::new(&common_box(by, &self.steps));
        if common_box.volume() < bounds.volume() {
            common_box
        } else {
            bounds
        }
    }

    /// The box after transforms of an enclosing object. The box of a CSG object is transformed; the box of a shape is
    /// computed anew, without its clipping and bounding objects.
    fn transformed_box(&self, by: &[Step]) -> ExtentBox {
        match &self.kind {
            _ if by.is_empty() => self.extent_box(),
            Kind::Shape(shape) => self.shape_box(shape, by),
            _ => transformed_by_steps(self.extent_box(), by),
        }
    }

    /// The box of the object's shape, after its own steps and more. A quadric takes its clipping objects into account.
    fn shape_box(&self, shape: &Shape, more: &[Step]) -> ExtentBox {
        if let Shape::Quadric(quadric) = shape
            && let Some(limits) = self.clipped_quadric(quadric)
        {
            return transformed_by_steps(limits, more);
        }
        let steps: Vec<Step> = self.steps.iter().chain(more).cloned().collect();
        shape_box(shape, &steps)
    }

    /// The box of a quadric after the last clipping object that was added while all steps were axis-aligned.
    fn clipped_quadric(&self, quadric: &Quadric) -> Option<ExtentBox> {
        let clips = self.clipped_by();
        let along = |steps: &[Step]| {
            let is_along = |step: &Step| matches!(step, Step::Translate(_) | Step::Scale(_));
            steps.iter().all(is_along)
        };
        let count = clips.partition_point(|clip| along(&self.steps[..clip.after]));
        let last = clips[..count].last()?;
        let (before, after) = self.steps.split_at(last.after);
        let mut around = common_box(&clips[..count], before);
        for clip in &clips[..count] {
            if let Kind::Shape(shape) = &clip.what.kind
                && let Shape::Plane(plane) = &**shape
            {
                let steps = [&clip.what.steps[..], &before[clip.after..]].concat();
                clip_at(
                    &mut around,
                    &transformed_plane(plane, &steps),
                    clip.what.is_inverse,
                );
            }
        }
        let to_world = Transform::from_steps(before);
        let mut limits = around;
        if !before.is_empty() {
            limits = limits.transformed(&to_world.object_from_world);
        }
        limits = quadric.known_limits(&limits);
        if !before.is_empty() {
            limits = limits.transformed(&to_world.world_from_object);
        }
        let is_known = limits.is_finite() && is_limited(&limits);
        is_known.then(|| transformed_by_steps(ExtentBox::new(&limits), after))
    }
}

/// The intersection of the boxes of all non-inverse clipping or bounding objects, after these steps of the object they
/// apply to.
fn common_box(by: &[Attached<Arc<Object>>], steps: &[Step]) -> Bounds {
    by.iter()
        .filter(|held| !held.what.is_inverse)
        .map(|held| held.what.transformed_box(&steps[held.after..]).bounds())
        .fold(EVERYTHING.bounds(), |sum, held| sum.intersection(&held))
}

fn shape_box(shape: &Shape, steps: &[Step]) -> ExtentBox {
    if let Some((held, from_held)) = shape.povray_box().filter(|(held, _)| held.is_finite()) {
        let steps = Transform::from_steps(steps).world_from_object;
        let held = ExtentBox::new(&held).bounds();
        return ExtentBox::new(&held.transformed(&(steps * from_held)));
    }
    if let Shape::Mesh(mesh) = shape {
        return transformed_by_steps(ExtentBox::new(&mesh.bounds()), steps);
    }
    let (bounds, absorbed) = shape.povray_box_after(steps).unwrap_or_else(|| {
        let mut shape = shape.clone();
        let absorbed = steps.iter().take_while(|step| shape.absorb(step)).count();
        (shape.bounds(), absorbed)
    });
    if !bounds.is_finite() {
        return EVERYTHING;
    }
    // The box of the shape itself is stored in single precision before it is transformed.
    let limits = ExtentBox::new(&bounds);
    if absorbed == steps.len() {
        return limits;
    }
    let rest = Transform::from_steps(&steps[absorbed..]);
    ExtentBox::new(&limits.bounds().transformed(&rest.world_from_object))
}

/// The corners of a box that is bounded on all sides; otherwise those of all space.
fn limited(held: ExtentBox) -> Bounds {
    let bounds = held.bounds();
    if is_limited(&bounds) {
        bounds
    } else {
        Bounds::EVERYTHING
    }
}

/// Returns true if a box is bounded on all sides.
pub(super) fn is_limited(bounds: &Bounds) -> bool {
    (bounds.max - bounds.min).max_element() < UNBOUNDED
}

/// The box of an intersection or difference, before its own steps.
fn csg_box(operation: Operation, children: &[Arc<Object>]) -> ExtentBox {
    let mut sum = EVERYTHING.bounds();
    for (at, child) in children.iter().enumerate() {
        let is_taken_away = operation == Operation::Difference && at > 0;
        let is_inverse = child.is_inverse != is_taken_away;
        if let Kind::Shape(shape) = &child.kind
            && let Shape::Plane(plane) = &**shape
        {
            clip_at(
                &mut sum,
                &transformed_plane(plane, &child.steps),
                is_inverse,
            );
        } else if !is_inverse && !is_height_field(child) {
            sum = sum.intersection(&child.extent_box().bounds());
        }
    }
    if !is_limited(&sum) || sum.is_empty() {
        EVERYTHING
    } else {
        ExtentBox::new(&sum)
    }
}

fn transformed_plane(plane: &Plane, steps: &[Step]) -> Plane {
    let transform = Transform::from_steps(steps);
    let point = transform
        .world_from_object
        .transform_point3(plane.distance * plane.normal);
    let normal = transform.normal(plane.normal).normalize_or_zero();
    Plane::new(normal, normal.dot(point))
}

/// Returns true for height fields, whose boxes do not shrink an intersection or difference.
fn is_height_field(object: &Object) -> bool {
    matches!(&object.kind, Kind::Shape(shape) if matches!(**shape, Shape::HeightField(_)))
}

/// Clips a box at an axis-aligned plane; other planes have no effect.
fn clip_at(bounds: &mut Bounds, plane: &Plane, is_inverse: bool) {
    for axis in 0..3 {
        let across = (0..3).filter(|&other| other != axis);
        let is_along = across
            .map(|other| plane.normal[other].abs())
            .all(|part| part < NORMAL_TOLERANCE);
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

/// Transforms a box by each step in turn.
fn transformed_by_steps(limits: ExtentBox, steps: &[Step]) -> ExtentBox {
    if steps.is_empty() {
        return limits;
    }
    let bounds = limits.bounds();
    if !is_limited(&bounds) || bounds.is_empty() {
        return EVERYTHING;
    }
    steps.iter().fold(limits, |limits, step| {
        let bounds = limits.bounds();
        ExtentBox::new(&bounds.transformed(&step.transform().world_from_object))
    })
}

/// Rounds a vector to single precision.
fn single(v: DVec3) -> DVec3 {
    DVec3::from(v.as_vec3())
}
