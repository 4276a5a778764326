//! Rays and points at single objects, before there is a world.

use super::{Query, RayKind, Scratch};
use crate::base::math::Ray;
use crate::base::options::{LeastDistance, RenderOptions};
use crate::scene::atmosphere::Atmosphere;
use crate::scene::camera::Camera;
use crate::scene::pattern::Solid;
use crate::scene::shape::Shape;
use crate::scene::{Background, Globals, Object, Objects, Scene};
use crate::world::compiled::World;
use crate::world::lower::flatten::Lowering;
use crate::world::surface::Surface;
use glam::DVec3;
use std::any::Any;
use std::sync::Arc;

/// How many objects stay compiled: a scene asks about a few objects again and again, or about each new one once.
const KEPT: usize = 32;

/// Objects compiled for questions of the scene that makes them.
#[derive(Debug, Default)]
pub struct ProbeModel {
    /// The object asked last comes last.
    worlds: Vec<(Arc<Object>, World)>,
    scratch: Scratch,
}

impl ProbeModel {
    /// The first surface of an object on a ray: the point, and the unit normal there before any `normal` pattern,
    /// which points out of the solid. What hides from some rays (`no_image`) is met.
    ///
    /// POV-Ray's least distance holds, 1/10000 of a unit, for scenes that trace on from where they were.
    pub fn trace(
        &mut self,
        object: &Arc<Object>,
        from: DVec3,
        dir: DVec3,
    ) -> Option<(DVec3, DVec3)> {
        let dir = dir.try_normalize()?;
        if !from.is_finite() {
            return None;
        }
        self.prepare(object);
        let (_, world) = self.worlds.last()?;
        let query = Query {
            ray: Ray::new(from, dir),
            origin_surface: None,
            t_max: f64::INFINITY,
            kind: RayKind::Camera,
        };
        let hit = world.nearest(&query, &mut self.scratch)?;
        let leaf = hit.departure.leaf;
        // POV-Ray gives those of single triangles as they are.
        let is_triangle = matches!(
            world.shape(leaf),
            Shape::Triangle(_) | Shape::SmoothTriangle(_)
        );
        let is_turned = world.is_inverse(leaf) && !is_triangle;
        let normal = hit.shading_normal;
        Some((hit.point, if is_turned { -normal } else { normal }))
    }

    /// Whether a point lies in an object.
    pub fn is_inside(&mut self, object: &Arc<Object>, point: DVec3) -> bool {
        self.prepare(object);
        let world = self.worlds.last();
        point.is_finite() && world.is_some_and(|(_, world)| world.holds(point))
    }

    /// Makes the object the last of those that are compiled.
    fn prepare(&mut self, object: &Arc<Object>) {
        let known = |(known, _): &(Arc<Object>, World)| Arc::ptr_eq(known, object);
        match self.worlds.iter().rposition(known) {
            Some(at) if at + 1 == self.worlds.len() => {}
            Some(at) => self.worlds[at..].rotate_left(1),
            None => {
                if self.worlds.len() == KEPT {
                    self.worlds.remove(0);
                }
                self.worlds.push((Arc::clone(object), compiled(object)));
            }
        }
    }
}

/// An object as patterns ask for it.
#[derive(Debug)]
struct ProbedObject(World);

impl Solid for ProbedObject {
    fn holds(&self, point: DVec3) -> bool {
        point.is_finite() && self.0.holds(point)
    }
}

/// An object of a scene ready for points.
pub fn solid_of(object: &Arc<dyn Any + Send + Sync>) -> Option<Arc<dyn Solid>> {
    let object = Arc::clone(object).downcast::<Object>().ok()?;
    Some(Arc::new(ProbedObject(compiled(&object))))
}

/// A world of one object that hides from nobody.
pub(in crate::world) fn compiled(object: &Arc<Object>) -> World {
    let mut flat = Lowering::default();
    flat.asks_insides = true;
    flat.add(object);
    flat.surfaces.iter_mut().for_each(Surface::show);
    let scene = Scene {
        camera: Camera::default(),
        objects: Objects::default(),
        background: Background { color: None },
        atmosphere: Atmosphere::default(),
        globals: Globals::default(),
        version: 3.7,
    };
    let options = RenderOptions {
        least_distance: LeastDistance::PovRay,
        ..RenderOptions::default()
    };
    World::new(&scene, flat, &options)
}
