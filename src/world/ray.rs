//! Rays as the world sees them: queries, kinds of rays, hits and the surfaces that spawned rays leave.

use crate::base::math::Ray;
use crate::scene::shape::Crossing;
use glam::DVec3;

/// The surface point that a spawned ray leaves, so that the ray does not hit it again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpawnSurface {
    /// The leaf.
    pub leaf: u32,
    /// The face of the leaf.
    pub face: u32,
    /// The outward geometric normal there, in world space.
    pub normal: DVec3,
    /// The crossing of the incoming ray there.
    pub crossing: Crossing,
    /// Error bound on the coordinates of the point: distances below it are not significant.
    pub blur: f64,
}

/// A closest hit.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Distance along the (unit) ray.
    pub t: f64,
    /// The point in world space.
    pub point: DVec3,
    /// The unit normal for shading, before any `normal` pattern; differs on smooth triangles only.
    pub shading_normal: DVec3,
    /// Index into [`super::World::surfaces`].
    pub surface: u32,
    /// Origin surface of the rays spawned here.
    pub spawn_surface: SpawnSurface,
}

/// Kind of ray: selects between `no_image`, `no_reflection`, `no_radiosity` and `no_shadow`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// A camera ray, or its straight or refracted continuation.
    Camera,
    /// A reflected ray and its continuations.
    Reflection,
    /// A radiosity sample ray, or its straight or refracted continuation.
    Radiosity,
    /// A reflection of such a ray.
    RadiosityReflection,
    /// A shadow ray.
    Shadow,
    /// A photon from a light, or its straight or refracted continuation.
    Photon,
    /// A mirrored photon and its continuations.
    PhotonReflection,
    /// A search below a surface that scatters light.
    Subsurface,
}

impl RayKind {
    /// The kind of a ray after a mirror reflection.
    #[must_use]
    pub fn mirrored(self) -> RayKind {
        match self {
            RayKind::Camera | RayKind::Reflection | RayKind::Shadow | RayKind::Subsurface => {
                RayKind::Reflection
            }
            RayKind::Radiosity | RayKind::RadiosityReflection => RayKind::RadiosityReflection,
            RayKind::Photon | RayKind::PhotonReflection => RayKind::PhotonReflection,
        }
    }
}

/// A ray query.
#[derive(Clone, Copy, Debug)]
pub struct Query {
    /// The ray; its direction has length 1.
    pub ray: Ray,
    /// The surface point it leaves; `None` for camera rays.
    pub origin_surface: Option<SpawnSurface>,
    /// Far limit: hits at or beyond it are ignored; infinite for none.
    pub t_max: f64,
    /// The kind of ray.
    pub kind: RayKind,
}

/// Occlusion between a point and a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Occlusion {
    /// Nothing.
    Clear,
    /// Only transmissive surfaces.
    Transmissive,
    /// At least one opaque surface.
    Opaque,
}

/// Distance along a ray, relative to the size of the coordinates, within which rounding can make the ray hit the
/// surface it starts on: 4096 roundings of a double.
pub(in crate::world) const BLUR: f64 = 1.0 / (1u64 << 40) as f64;
