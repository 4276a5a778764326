//! What rays need and no more: prepared surfaces, a tree over them, lights, camera, and the settings of shading.

use crate::camera::Camera;
use crate::color::{Color, Rgb};
use crate::interior::Interior;
use crate::light::Light;
use crate::math::Ray;
use crate::shape::{Crossing, Geometry, Root, Start};
use crate::texture::PreparedTexture;
use glam::DVec3;
use smallvec::SmallVec;
use std::fmt;
use std::sync::Arc;

/// Which interior: objects that share one, share the number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct InteriorId(pub u32);

/// The object switches that matter while tracing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Flags {
    /// Casts no shadow.
    pub no_shadow: bool,
    /// Not seen by camera rays and their straight or refracted continuations.
    pub no_image: bool,
    /// Not seen by reflected rays.
    pub no_reflection: bool,
    /// Does not displace the atmosphere around it.
    pub hollow: bool,
    /// Lit from both sides.
    pub double_illuminate: bool,
}

/// How the surface of an object looks and what lies behind it.
#[derive(Clone, Debug)]
pub struct Surface {
    /// The layers, with all transforms of the object taken in.
    pub texture: Arc<PreparedTexture>,
    /// The texture seen from inside, if the scene gives one.
    pub inside_texture: Option<Arc<PreparedTexture>>,
    /// The interior of the object.
    pub interior: InteriorId,
    /// Its switches.
    pub flags: Flags,
}

impl Surface {
    /// Whether no light passes, from whichever side it comes.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        let inside = self.inside_texture.as_ref();
        self.texture.is_opaque() && inside.is_none_or(|texture| texture.is_opaque())
    }

    /// Whether it shows itself to this kind of ray.
    #[must_use]
    pub fn is_seen(&self, seen: Seen) -> bool {
        !match seen {
            Seen::Image => self.flags.no_image,
            Seen::Reflection => self.flags.no_reflection,
            Seen::Shadow => self.flags.no_shadow,
        }
    }
}

/// The root that a spawned ray left, so that it does not find it again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
    /// The leaf.
    pub leaf: u32,
    /// The piece of its surface.
    pub face: u16,
    /// The outward geometric normal there, in the world.
    pub normal: DVec3,
    /// What the old ray did there.
    pub crossing: Crossing,
    /// A bound on the error of coordinates at the point: below this distance nothing can be told apart.
    pub blur: f64,
}

impl Departure {
    /// The error of a point, relative to its largest coordinate or its distance along the ray: twelve bits more than
    /// the rounding of one operation, for all that is summed up on the way to it.
    pub const RELATIVE_BLUR: f64 = 1.0 / (1u64 << 40) as f64;

    /// A bound on the error of coordinates at a point that lies `t` along a ray.
    #[must_use]
    pub fn blur_at(point: DVec3, t: f64) -> f64 {
        Departure::RELATIVE_BLUR * point.abs().max_element().max(t)
    }

    /// Whether a root of the spawned ray is the one it left.
    fn is_same(&self, leaf: u32, root: &Root, ray: &Ray) -> bool {
        let rise = (root.t * ray.dir.dot(self.normal)).abs();
        self.leaf == leaf && self.face == root.face && rise <= self.blur
    }
}

/// What a ray found.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Distance along the (unit) ray.
    pub t: f64,
    /// The point in the world.
    pub point: DVec3,
    /// The unit outward geometric normal in the world.
    pub normal: DVec3,
    /// The unit normal for shading, before any `normal` pattern; differs on smooth triangles only.
    pub shading_normal: DVec3,
    /// Index into [`World::surfaces`].
    pub surface: u32,
    /// For the rays that leave from here.
    pub departure: Departure,
}

/// Who looks: decides between `no_image`, `no_reflection` and `no_shadow`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seen {
    /// A camera ray, or its straight or refracted continuation.
    Image,
    /// A reflected ray and what comes of it.
    Reflection,
    /// A ray to a light.
    Shadow,
}

/// One question to the world.
#[derive(Clone, Copy, Debug)]
pub struct Query {
    /// The ray; its direction has length 1.
    pub ray: Ray,
    /// The root it left, for all but camera rays.
    pub from: Option<Departure>,
    /// Nothing at or beyond this distance counts; infinite for none.
    pub far: f64,
    /// Who asks.
    pub seen: Seen,
}

/// Buffers that a thread keeps between questions.
#[derive(Debug, Default)]
pub struct Scratch {
    roots: Vec<Root>,
}

/// A shape in the world, without a transform.
pub struct Solid {
    /// Where its surface is.
    pub geometry: Box<dyn Geometry + Send + Sync>,
    /// Index into [`World::surfaces`].
    pub surface: u32,
}

impl fmt::Debug for Solid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Solid of surface {}", self.surface)
    }
}

/// The settings of shading.
#[derive(Clone, Debug)]
pub struct Globals {
    /// `adc_bailout`.
    pub adc_bailout: f64,
    /// `max_trace_level`.
    pub max_trace_level: u32,
    /// `ambient_light`.
    pub ambient_light: Rgb,
    /// Whether the rules of version 3.7 and later hold for transparency and background (the effective version).
    pub rules_37: bool,
    /// Whether the picture gets an alpha channel, through which the background may be seen.
    pub has_alpha: bool,
}

/// A scene, ready for rays.
#[derive(Debug)]
pub struct World {
    /// The camera.
    pub camera: Camera,
    /// The shapes.
    pub solids: Vec<Solid>,
    /// The lights, in the order of the scene.
    pub lights: Vec<Light>,
    /// The looks of the objects, by [`Hit::surface`].
    pub surfaces: Vec<Surface>,
    /// The interiors, by [`InteriorId`].
    pub interiors: Vec<Interior>,
    /// The colour of rays that hit nothing.
    pub background: Color,
    /// The settings of shading.
    pub globals: Globals,
}

impl World {
    /// The nearest visible surface on a ray.
    #[must_use]
    pub fn nearest(&self, query: &Query, scratch: &mut Scratch) -> Option<Hit> {
        let mut best: Option<(f64, u32, Root)> = None;
        for (leaf, solid) in (0u32..).zip(&self.solids) {
            if !self.surfaces[solid.surface as usize].is_seen(query.seen) {
                continue;
            }
            let far = best.map_or(query.far, |best| best.0);
            if let Some(root) = first_root(leaf, solid, query, far, scratch) {
                best = Some((root.t, leaf, root));
            }
        }
        let (t, leaf, root) = best?;
        let solid = &self.solids[leaf as usize];
        let point = query.ray.at(t);
        let normal = solid
            .geometry
            .normal(point, root.face)
            .normalize_or(DVec3::Y);
        let shading_normal = solid.geometry.shading_normal(point, root.face);
        Some(Hit {
            t,
            point,
            normal,
            shading_normal: shading_normal.normalize_or(normal),
            surface: solid.surface,
            departure: Departure {
                leaf,
                face: root.face,
                normal,
                crossing: root.crossing,
                blur: Departure::blur_at(point, t),
            },
        })
    }

    /// Whether an opaque surface lies on a ray.
    #[must_use]
    pub fn is_blocked(&self, query: &Query, scratch: &mut Scratch) -> bool {
        (0u32..).zip(&self.solids).any(|(leaf, solid)| {
            let surface = &self.surfaces[solid.surface as usize];
            surface.is_opaque()
                && surface.is_seen(query.seen)
                && first_root(leaf, solid, query, query.far, scratch).is_some()
        })
    }

    /// The interiors of all objects that hold a point.
    #[must_use]
    pub fn interiors_at(&self, point: DVec3) -> SmallVec<[InteriorId; 4]> {
        let holding = self.solids.iter().filter(|s| s.geometry.contains(point));
        holding
            .map(|solid| self.surfaces[solid.surface as usize].interior)
            .collect()
    }
}

/// The first visible root of a solid on a ray, before `far`, that is not the one from which the ray starts.
fn first_root(
    leaf: u32,
    solid: &Solid,
    query: &Query,
    far: f64,
    scratch: &mut Scratch,
) -> Option<Root> {
    scratch.roots.clear();
    let _: Start = solid.geometry.roots(&query.ray, &mut scratch.roots);
    let left = |root: &Root| {
        query
            .from
            .is_some_and(|from| from.is_same(leaf, root, &query.ray))
    };
    let ahead = |root: &&Root| root.is_visible && root.t > 0.0 && root.t < far && !left(root);
    scratch.roots.iter().find(ahead).copied()
}
