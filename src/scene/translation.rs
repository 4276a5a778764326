//! Translation of a scene to the origin, together with its camera.
//!
//! Doubles are densest around the origin. If a scene is so far from it that the error of coordinates near the camera
//! exceeds 2^-32 of the size of objects there, it is rendered in coordinates around the camera. The translation of
//! objects near the camera is exact (Sterbenz 1974), also if only a chain of translations has moved them there. So a
//! scene renders the same wherever it is, within the precision of its own numbers.

use super::{Kind, Object, Scene};
use crate::base::math::{Bounds, Step, Transform};
use crate::scene::shape::Geometry;
use glam::DVec3;
use std::sync::Arc;

/// Ratio of the distances to the origin and to the far end of a near object, from which the scene counts as far from
/// the origin.
const FAR: f64 = (1u64 << 20) as f64;

/// Number of objects tested in the search for a near one.
const MAX_TESTED: u32 = 1 << 10;

/// The rounded sum of two numbers and its rounding error (Møller 1965, Knuth 1969).
fn two_sum(a: DVec3, b: DVec3) -> (DVec3, DVec3) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

impl Scene {
    /// The scene in coordinates around its camera if it is far from the origin; otherwise unchanged. Global fogs and
    /// media depend on world coordinates, so scenes with these stay unchanged, too.
    #[must_use]
    pub(crate) fn recentered(mut self) -> Scene {
        if self.is_position_dependent() || !self.is_far() {
            return self;
        }
        let by = -self.camera.location();
        let moved = |object: Arc<Object>| {
            let mut own = Arc::unwrap_or_clone(object);
            own.translate(by);
            Arc::new(own)
        };
        self.objects = self.objects.into_objects().map(moved).collect();
        self.camera = self.camera.moved(by);
        self.globals.origin += by;
        self
    }

    fn is_position_dependent(&self) -> bool {
        !self.atmosphere.fogs.is_empty() || !self.atmosphere.media.is_empty()
    }

    /// The distance of a camera from the origin from which the scene may be drawn in coordinates around it; infinite if
    /// there is none.
    pub(super) fn far_distance(&self) -> f64 {
        if self.is_position_dependent() {
            return f64::INFINITY;
        }
        let (mut left, mut smallest) = (MAX_TESTED, f64::INFINITY);
        let mut note = |bounds: &Bounds| {
            smallest = smallest.min((bounds.max - bounds.min).max_element());
            false
        };
        for object in self.objects.iter().take(MAX_TESTED as usize) {
            object.has_near_shape(&Transform::IDENTITY, &mut left, &mut note);
        }
        smallest * FAR
    }

    /// Returns true if an object is much nearer to the camera than the origin.
    fn is_far(&self) -> bool {
        let location = self.camera.location();
        let distance = location.abs().max_element();
        let mut left = MAX_TESTED;
        let mut is_near = |bounds: &Bounds| {
            let away = (bounds.min - location).max(location - bounds.max);
            let gap = away.max_element().max(0.0);
            let size = (bounds.max - bounds.min).max_element();
            (gap + size) * FAR <= distance
        };
        distance.is_finite()
            && distance > 0.0
            && self
                .objects
                .iter()
                .take(MAX_TESTED as usize)
                .any(|object| object.has_near_shape(&Transform::IDENTITY, &mut left, &mut is_near))
    }
}

impl Object {
    /// Returns true if a shape of the object, transformed by `outer`, has bounds that pass `is_near`. Tests at most
    /// `left` shapes.
    fn has_near_shape(
        &self,
        outer: &Transform,
        left: &mut u32,
        is_near: &mut impl FnMut(&Bounds) -> bool,
    ) -> bool {
        if *left == 0 {
            return false;
        }
        *left -= 1;
        let to_world = Transform::from_steps(&self.steps).then(outer);
        match &self.kind {
            Kind::Shape(shape) => {
                let bounds = shape.bounds();
                bounds.is_finite()
                    && !bounds.is_empty()
                    && is_near(&bounds.transformed(&to_world.world_from_object))
            }
            Kind::Light { .. } => false,
            Kind::Csg { children, .. } => children
                .iter()
                .any(|child| child.has_near_shape(&to_world, left, is_near)),
        }
    }

    /// Appends a translation. Trailing translations are merged with it and their sum is rounded once.
    fn translate(&mut self, by: DVec3) {
        let fixed = self.fixed_steps();
        let (mut sum, mut rest) = (by, DVec3::ZERO);
        while self.steps.len() > fixed
            && let Some(Step::Translate(last)) = self.steps.last()
        {
            let (more, lost) = two_sum(sum, *last);
            sum = more;
            rest += lost;
            self.steps.pop();
        }
        self.steps.push(Step::Translate(sum + rest));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::shape::{Shape, Sphere};

    fn sphere(centre: DVec3, steps: &[f64]) -> Object {
        let shape = Shape::Sphere(Sphere {
            centre,
            radius: 1.0,
        });
        let mut object = Object::new(Kind::Shape(Arc::new(shape)));
        let translations = steps.iter().map(|x| Step::Translate(DVec3::splat(*x)));
        object.steps = translations.collect();
        object
    }

    #[test]
    fn a_chain_of_translations_is_summed_without_loss() {
        let mut object = sphere(DVec3::ZERO, &[0.3, 1e15, 0.1]);
        object.translate(DVec3::splat(-1e15));
        assert_eq!(object.steps, [Step::Translate(DVec3::splat(0.3 + 0.1))]);
    }

    #[test]
    fn translations_before_an_attachment_stay() {
        let mut clipped = sphere(DVec3::ZERO, &[1.0, 2.0]);
        let held = clipped.attach(Arc::new(sphere(DVec3::ZERO, &[])));
        clipped.clip(held);
        clipped.steps.push(Step::Translate(DVec3::X));
        clipped.translate(DVec3::Y);
        let sum = Step::Translate(DVec3::new(1.0, 1.0, 0.0));
        assert_eq!(clipped.steps[2..], [sum]);
    }
}
