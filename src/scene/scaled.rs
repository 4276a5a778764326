//! A scene in another unit of length: everything in it larger or smaller by a factor, the camera with it.
//!
//! With a power of two no number loses a digit, and neither does anything that is worked out from it: the picture stays
//! the same to the last bit. So a scene whose lengths are so small or large that their squares cannot be held is drawn
//! as a larger or smaller one.

use super::{Kind, Object, Scene};
use crate::base::math::conditioning::power_of_two;
use crate::base::math::{Step, Transform};
use crate::scene::interior::Interior;
use crate::scene::light::{Beam, Light};
use crate::scene::shape::Geometry;
use glam::DVec3;
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// Fourth powers of lengths within 2^-200 and 2^200 can be held, which is all that drawing asks for.
const COMFORTABLE: f64 = f64::from_bits((1023 + 200) << 52);

/// What has been made of what, by the address of what it was made of, which is kept so that it stays taken.
type Made<T> = FxHashMap<usize, (Arc<T>, Arc<T>)>;

/// What has been made of shared children.
#[derive(Default)]
struct Known {
    objects: Made<Object>,
    lists: Made<Vec<Arc<Object>>>,
}

impl Scene {
    /// The same with every length times `factor`, which is to be positive and finite.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Scene {
        let mut known = Known::default();
        let objects = std::mem::take(&mut self.objects).one_by_one();
        self.objects = objects
            .map(|object| {
                let mut own = (*object).clone();
                own.scale_own_lengths(factor, &mut known);
                own.steps.push(Step::Scale(DVec3::splat(factor)));
                Arc::new(own)
            })
            .collect();
        self.camera = self.camera.scaled(factor);
        for fog in &mut self.atmosphere.fogs {
            fog.distance *= factor;
            fog.alt *= factor;
            fog.offset *= factor;
            fog.turbulence /= factor;
        }
        for rainbow in &mut self.atmosphere.rainbows {
            rainbow.distance *= factor;
        }
        for media in &mut self.atmosphere.media {
            media.change_unit(factor);
            media.transform(&Step::Scale(DVec3::splat(factor)));
        }
        self.globals.unit *= factor;
        self.globals.origin *= factor;
        self
    }

    /// The scene in a unit in which its lengths and their squares can be held; as it is where they can.
    #[must_use]
    pub(crate) fn rescaled(self) -> Scene {
        let size = self.size();
        if size == 0.0 || (1.0 / COMFORTABLE..COMFORTABLE).contains(&size) {
            return self;
        }
        let unit = power_of_two(size).clamp(1.0 / f64::MAX, f64::MAX / 2.0);
        self.scaled(1.0 / unit)
    }

    /// About how far the camera and the lights are from the origin.
    fn size(&self) -> f64 {
        let place = self.camera.location().abs().max_element();
        let places = self.objects.whole().map(|object| match &object.kind {
            Kind::Light { light, .. } => {
                let to_world = Transform::from_steps(&object.steps).world_from_object;
                let place = to_world.transform_point3(light.centre);
                place.abs().max_element()
            }
            _ => 0.0,
        });
        let size = places.fold(place, f64::max);
        if size.is_finite() { size } else { place }
    }
}

impl Object {
    /// Scales the lengths that transforms do not: those over which light fades, and the width of its beams.
    fn scale_own_lengths(&mut self, factor: f64, known: &mut Known) {
        if let Some(interior) = &mut self.interior {
            scale_interior(interior, factor);
        }
        for bound in self.around_mut() {
            bound.what = scaled_child(&bound.what, factor, known);
        }
        match &mut self.kind {
            Kind::Shape(shape) => Arc::make_mut(shape).scale_scene_lengths(factor),
            Kind::Light {
                light,
                looks_like,
                projected_through,
            } => {
                scale_light(Arc::make_mut(light), factor);
                for held in looks_like.iter_mut().chain(projected_through) {
                    *held = scaled_child(held, factor, known);
                }
            }
            Kind::Csg { children, .. } => {
                *children = scaled_children(children, factor, known);
            }
        }
    }
}

fn scaled_child(child: &Arc<Object>, factor: f64, known: &mut Known) -> Arc<Object> {
    let key = Arc::as_ptr(child).addr();
    if let Some((_, made)) = known.objects.get(&key) {
        return Arc::clone(made);
    }
    let mut own = (**child).clone();
    own.scale_own_lengths(factor, known);
    let made = Arc::new(own);
    known
        .objects
        .insert(key, (Arc::clone(child), Arc::clone(&made)));
    made
}

type Children = Arc<Vec<Arc<Object>>>;

fn scaled_children(children: &Children, factor: f64, known: &mut Known) -> Children {
    let key = Arc::as_ptr(children).addr();
    if let Some((_, made)) = known.lists.get(&key) {
        return Arc::clone(made);
    }
    let all = children.iter();
    let made = Arc::new(
        all.map(|child| scaled_child(child, factor, known))
            .collect(),
    );
    known
        .lists
        .insert(key, (Arc::clone(children), Arc::clone(&made)));
    made
}

fn scale_interior(interior: &mut Arc<Interior>, factor: f64) {
    if interior.fade_distance != 0.0 {
        let distance = f64::from(interior.fade_distance) * factor;
        Arc::make_mut(interior).fade_distance = single(distance);
    }
    if !interior.media.is_empty() {
        let media = Arc::make_mut(interior).media.iter_mut();
        media.for_each(|media| media.change_unit(factor));
    }
}

#[allow(
    clippy::cast_possible_truncation,
    reason = "the distance is kept in single precision, as POV-Ray does"
)]
fn single(distance: f64) -> f32 {
    distance as f32
}

fn scale_light(light: &mut Light, factor: f64) {
    light.fade.distance *= factor;
    if let Beam::Cylinder(beam) = &mut light.beam {
        beam.radius *= factor;
        beam.falloff *= factor;
    }
}
