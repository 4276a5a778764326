//! A scene in another place: everything in it moved, the camera with it.
//!
//! Doubles lie closest to each other around the origin. Where a scene stands so far from it that the places of things near
//! the camera are known to less than a 2^32nd of their size, it is drawn around the camera instead. What stands there is
//! moved without a rounding (Sterbenz 1974), and so are things that only a chain of translations has brought there: a
//! scene looks the same wherever it stands, as far as its own numbers go.

use super::{Kind, Object, Scene};
use crate::base::math::{Bounds, Step, Transform};
use crate::scene::shape::Geometry;
use glam::DVec3;
use std::sync::Arc;

/// A scene is far from the origin if the camera is so many times farther from it than from a thing and its far end.
const FAR: f64 = (1u64 << 20) as f64;

/// Things that are looked at to find a near one.
const LOOKED_AT: u32 = 1 << 10;

/// The sum of two numbers and what it lacks (Møller 1965, Knuth 1969).
fn two_sum(a: DVec3, b: DVec3) -> (DVec3, DVec3) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

impl Scene {
    /// The scene around its camera if it is far from the origin; as it is where it is not. Fogs and media
    /// of the whole scene know places of the world.
    #[must_use]
    pub(crate) fn recentered(mut self) -> Scene {
        let air = &self.atmosphere;
        let knows_places = !air.fogs.is_empty() || !air.media.is_empty();
        if knows_places || !self.is_far() {
            return self;
        }
        let by = -self.camera.location();
        let moved = |object: Arc<Object>| {
            let mut own = Arc::unwrap_or_clone(object);
            own.move_by(by);
            Arc::new(own)
        };
        self.objects = self.objects.one_by_one().map(moved).collect();
        self.camera = self.camera.moved(by);
        self.globals.origin += by;
        self
    }

    /// Whether something near the camera is much nearer than the origin.
    fn is_far(&self) -> bool {
        let location = self.camera.location();
        let distance = location.abs().max_element();
        let mut left = LOOKED_AT;
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
                .take(LOOKED_AT as usize)
                .any(|object| object.holds_near(&Transform::IDENTITY, &mut left, &mut is_near))
    }
}

impl Object {
    /// Whether a shape of it, as `outer` moves it, has such bounds; no more than `left` shapes are asked.
    fn holds_near(
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
                .any(|child| child.holds_near(&to_world, left, is_near)),
        }
    }

    /// Adds a translation; the last ones become one with it, whose sum is rounded once.
    fn move_by(&mut self, by: DVec3) {
        let textures = self.textures().map(|texture| texture.after);
        let boxes = self.seen_in().map(|bounds| bounds.after);
        let taken = textures
            .chain(self.around().map(|held| held.after))
            .chain(boxes);
        let kept = taken.max().unwrap_or(0);
        let (mut sum, mut rest) = (by, DVec3::ZERO);
        while self.steps.len() > kept
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

    fn ball(centre: DVec3, steps: &[f64]) -> Object {
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
        let mut object = ball(DVec3::ZERO, &[0.3, 1e15, 0.1]);
        object.move_by(DVec3::splat(-1e15));
        assert_eq!(object.steps, [Step::Translate(DVec3::splat(0.3 + 0.1))]);
    }

    #[test]
    fn translations_before_an_attached_thing_stay() {
        let mut clipped = ball(DVec3::ZERO, &[1.0, 2.0]);
        let held = clipped.attach(Arc::new(ball(DVec3::ZERO, &[])));
        clipped.clip(held);
        clipped.steps.push(Step::Translate(DVec3::X));
        clipped.move_by(DVec3::Y);
        let sum = Step::Translate(DVec3::new(1.0, 1.0, 0.0));
        assert_eq!(clipped.steps[2..], [sum]);
    }
}
