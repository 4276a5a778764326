//! Ray and point queries on single objects while the scene is read: `trace`, `inside` and `object` patterns.

use crate::base::args::AnyObject;
use crate::base::math::Ray;
use crate::base::math::conditioning::Normalization;
use crate::base::options::{RenderOptions, TMinRule};
use crate::scene::pattern::{Settings, Solid};
use crate::scene::shape::Shape;
use crate::scene::{Object, Scene};
use crate::world::compiled::World;
use crate::world::lower::lowering::Lowering;
use crate::world::query::QueryScratch;
use crate::world::ray::{Query, RayKind};
use crate::world::surface::Surface;
use glam::DVec3;
use std::sync::Arc;

/// Capacity of the cache of compiled objects: a scene queries a few objects repeatedly, or each new one once.
const CACHED: usize = 32;

/// Cache of compiled objects, for queries of the scene that is being read.
#[derive(Debug, Default)]
pub struct ProbeModel {
    /// The most recently used object is last.
    worlds: Vec<(Arc<Object>, World)>,
    scratch: QueryScratch,
}

impl ProbeModel {
    /// The first hit of a ray on an object: the point, and the unit normal there before any `normal` pattern, out of
    /// the solid. Objects hidden from some rays (`no_image`) are hit.
    ///
    /// POV-Ray's distances apply: 1/10000 of a unit for scenes that trace on from the hit point, and 1e7 units for most
    /// shapes.
    pub fn trace(
        &mut self,
        object: &Arc<Object>,
        from: DVec3,
        dir: DVec3,
        normalization: Normalization,
    ) -> Option<(DVec3, DVec3)> {
        let dir = normalization.unit_or_zero(dir);
        if dir == DVec3::ZERO || !from.is_finite() {
            return None;
        }
        self.prepare(object, Some(normalization));
        let (_, world) = self.worlds.last()?;
        let query = Query {
            ray: Ray::new(from, dir),
            origin_surface: None,
            t_max: f64::INFINITY,
            kind: RayKind::Camera,
        };
        let hit = world.nearest(&query, &mut self.scratch)?;
        let leaf = hit.spawn_surface.leaf;
        let is_turned = world.turns_normals(leaf);
        let (point, normal) = match world.rounded_hit(&query.ray, &hit) {
            Some(rounded) => (rounded.point, rounded.normal),
            None => (hit.point, hit.shading_normal),
        };
        Some((point, if is_turned { -normal } else { normal }))
    }

    /// Returns true if a point lies in an object.
    pub fn is_inside(&mut self, object: &Arc<Object>, point: DVec3) -> bool {
        self.prepare(object, None);
        let world = self.worlds.last();
        point.is_finite() && world.is_some_and(|(_, world)| world.holds(point))
    }

    /// Returns true if no part of an object transmits light.
    pub fn is_opaque(&mut self, object: &Arc<Object>) -> bool {
        self.prepare(object, None);
        self.worlds
            .last()
            .is_some_and(|(_, world)| world.is_opaque())
    }

    /// Moves the object to the end of the cache, and compiles it if needed: with the given rounding of unit vectors, or
    /// with any.
    fn prepare(&mut self, object: &Arc<Object>, normalization: Option<Normalization>) {
        let known = |(known, world): &(Arc<Object>, World)| {
            let own = world.globals.normalization();
            Arc::ptr_eq(known, object) && normalization.is_none_or(|wanted| wanted == own)
        };
        match self.worlds.iter().rposition(known) {
            Some(at) if at + 1 == self.worlds.len() => {}
            Some(at) => self.worlds[at..].rotate_left(1),
            None => {
                if self.worlds.len() == CACHED {
                    self.worlds.remove(0);
                }
                let world = compiled_for_queries(object, normalization.unwrap_or_default());
                self.worlds.push((Arc::clone(object), world));
            }
        }
    }
}

/// A compiled object for `object` patterns.
#[derive(Debug)]
struct ProbedObject(World);

impl Solid for ProbedObject {
    fn contains(&self, point: DVec3) -> bool {
        point.is_finite() && self.0.holds(point)
    }
}

/// Compiles an object for point queries.
pub fn solid_of(object: &Arc<dyn AnyObject + Send + Sync>) -> Option<Arc<dyn Solid>> {
    let object = Arc::clone(object).downcast::<Object>()?;
    let world = compiled_for_queries(&object, Normalization::default());
    Some(Arc::new(ProbedObject(world)))
}

/// The solid of an object in the world.
pub(super) fn solid(object: &Arc<Object>) -> Arc<dyn Solid> {
    Arc::new(ProbedObject(compiled(object, Normalization::default())))
}

/// A world of one object, visible to all rays.
fn compiled(object: &Arc<Object>, normalization: Normalization) -> World {
    let is_3_8 = normalization == Normalization::Quotient;
    let mut flat = Lowering {
        needs_insides: true,
        rounds: true,
        ..Lowering::new(Settings {
            is_3_8,
            ..Settings::default()
        })
    };
    flat.add(object);
    flat.surfaces.iter_mut().for_each(Surface::show);
    let mut scene = Scene::default();
    scene.globals.is_for_3_8 = is_3_8;
    let options = RenderOptions {
        t_min_rule: TMinRule::PovRay,
        ..RenderOptions::default()
    };
    World::new(&scene, flat, &options)
}

/// The same for points that the scene's text queries.
fn compiled_for_queries(object: &Arc<Object>, normalization: Normalization) -> World {
    let mut world = compiled(object, normalization);
    for leaf in &mut world.model.leaves {
        if let Shape::Plane(plane) = &mut leaf.shape {
            plane.use_inside_tolerance();
        }
    }
    world
}
