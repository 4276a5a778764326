//! Scaling of a scene by a factor, together with its camera.
//!
//! With a power of two no number loses a digit, and neither does any result computed from it: the picture is the same
//! to the last bit. So a scene whose lengths are too small or too large for their squares to be representable is
//! rendered at another scale.

use super::{Kind, Object, Scene};
use crate::base::math::conditioning::power_of_two;
use crate::base::math::{Step, Transform};
use crate::scene::camera::Camera;
use crate::scene::interior::Interior;
use crate::scene::light::{Beam, Light};
use crate::scene::shape::Geometry;
use glam::DVec3;
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// Fourth powers of lengths between 2^-200 and 2^200 are representable, which suffices for rendering.
const MAX_SIZE: f64 = f64::from_bits((1023 + 200) << 52);

/// Scaled copies by the address of the original, which is retained so that its address stays unique.
type Copies<T> = FxHashMap<usize, (Arc<T>, Arc<T>)>;

/// Scaled copies of shared children.
#[derive(Default)]
struct ScaledChildren {
    objects: Copies<Object>,
    lists: Copies<Vec<Arc<Object>>>,
}

impl Scene {
    /// The scene with every length multiplied by `factor`, which must be positive and finite.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Scene {
        let mut copies = ScaledChildren::default();
        let objects = std::mem::take(&mut self.objects).into_objects();
        self.objects = objects
            .map(|object| {
                let mut own = (*object).clone();
                own.scale_own_lengths(factor, &mut copies);
                own.steps.push(Step::Scale(DVec3::splat(factor)));
                Arc::new(own)
            })
            .collect();
        self.camera = self.camera.scaled(factor);
        for fog in &mut self.atmosphere.fogs {
            fog.distance *= factor;
            fog.alt *= factor;
            fog.offset *= factor;
            fog.turbulence = fog.turbulence.map(|turbulence| turbulence / factor);
        }
        for rainbow in &mut self.atmosphere.rainbows {
            rainbow.distance *= factor;
        }
        for media in &mut self.atmosphere.media {
            media.scale_scene_lengths(factor);
            media.transform(&Step::Scale(DVec3::splat(factor)));
        }
        self.globals.unit *= factor;
        self.globals.origin *= factor;
        self
    }

    /// The scene in a unit in which its lengths and their squares are representable; unchanged if they already are.
    #[must_use]
    pub(crate) fn rescaled(self) -> Scene {
        let size = self.size();
        if is_representable(size) {
            return self;
        }
        let unit = power_of_two(size).clamp(1.0 / f64::MAX, f64::MAX / 2.0);
        self.scaled(1.0 / unit)
    }

    /// The cameras for which this scene is drawn in its own coordinates and unit; none if it is not with its own camera.
    pub(crate) fn camera_limit(&self) -> CameraLimit {
        let limit = CameraLimit {
            far: self.far_distance(),
            lights: self.size_of_lights(),
        };
        match limit.allows(&self.camera) {
            true => limit,
            false => CameraLimit {
                far: f64::NEG_INFINITY,
                ..limit
            },
        }
    }

    /// Approximate distance of the camera and the lights from the origin.
    fn size(&self) -> f64 {
        let distance = distance_of(&self.camera);
        let size = self.size_of_lights().max(distance);
        if size.is_finite() { size } else { distance }
    }

    /// Approximate distance of the lights from the origin; 0 without any.
    fn size_of_lights(&self) -> f64 {
        let distances = self.objects.whole().map(|object| match &object.kind {
            Kind::Light { light, .. } => {
                let to_world = Transform::from_steps(&object.steps).world_from_object;
                let centre = to_world.transform_point3(light.centre);
                centre.abs().max_element()
            }
            _ => 0.0,
        });
        distances.fold(0.0, f64::max)
    }
}

/// The cameras with which a scene is drawn in its own coordinates and unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CameraLimit {
    /// The distance from the origin from which the scene may be drawn in coordinates around the camera.
    far: f64,
    /// The distance of the lights from the origin.
    lights: f64,
}

impl CameraLimit {
    pub(crate) fn allows(&self, camera: &Camera) -> bool {
        let distance = distance_of(camera);
        let size = self.lights.max(distance);
        distance < self.far && size.is_finite() && is_representable(size)
    }
}

fn distance_of(camera: &Camera) -> f64 {
    camera.location().abs().max_element()
}

/// True for a scene of this size if its lengths and their squares are representable.
fn is_representable(size: f64) -> bool {
    size == 0.0 || (1.0 / MAX_SIZE..MAX_SIZE).contains(&size)
}

impl Object {
    /// Scales the lengths that transforms leave alone: fade distances and the widths of cylindrical lights.
    fn scale_own_lengths(&mut self, factor: f64, copies: &mut ScaledChildren) {
        if let Some(interior) = &mut self.interior {
            scale_interior(interior, factor);
        }
        for bound in self.clips_and_bounds_mut() {
            bound.what = scaled_child(&bound.what, factor, copies);
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
                    *held = scaled_child(held, factor, copies);
                }
            }
            Kind::Csg { children, .. } => {
                *children = scaled_children(children, factor, copies);
            }
        }
    }
}

fn scaled_child(child: &Arc<Object>, factor: f64, copies: &mut ScaledChildren) -> Arc<Object> {
    let key = Arc::as_ptr(child).addr();
    if let Some((_, copy)) = copies.objects.get(&key) {
        return Arc::clone(copy);
    }
    let mut own = (**child).clone();
    own.scale_own_lengths(factor, copies);
    let copy = Arc::new(own);
    copies
        .objects
        .insert(key, (Arc::clone(child), Arc::clone(&copy)));
    copy
}

type Children = Arc<Vec<Arc<Object>>>;

fn scaled_children(children: &Children, factor: f64, copies: &mut ScaledChildren) -> Children {
    let key = Arc::as_ptr(children).addr();
    if let Some((_, copy)) = copies.lists.get(&key) {
        return Arc::clone(copy);
    }
    let all = children.iter();
    let copy = Arc::new(
        all.map(|child| scaled_child(child, factor, copies))
            .collect(),
    );
    copies
        .lists
        .insert(key, (Arc::clone(children), Arc::clone(&copy)));
    copy
}

fn scale_interior(interior: &mut Arc<Interior>, factor: f64) {
    if interior.fade_distance != 0.0 {
        let distance = f64::from(interior.fade_distance) * factor;
        Arc::make_mut(interior).fade_distance = single(distance);
    }
    if !interior.media.is_empty() {
        let media = Arc::make_mut(interior).media.iter_mut();
        media.for_each(|media| media.scale_scene_lengths(factor));
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
