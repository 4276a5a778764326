//! `camera`: generation of camera rays.
//!
//! Each projection has its own file. All of them use the same camera frame (`Frame`), which `read` sets up. A lens
//! ([`FocalBlur`]) adds depth of field; a `normal` perturbs the ray directions.

mod bumps;
mod by_functions;
mod cylinder;
mod fisheye;
mod focal_blur;
mod lens_points;
mod mesh_camera;
mod omnimax;
mod orthographic;
mod panoramic;
mod perspective;
mod ray_packet;
mod read;
mod spherical;
#[cfg(test)]
mod tests;
mod ultra_wide_angle;
mod view;

pub use focal_blur::{FocalBlur, Lens, LensRay, Spread};
pub use view::{Movement, View};

use crate::base::args::Word;
use crate::base::math::conditioning::{Normalization, unit};
use crate::base::math::{Ray, Transform};
use crate::scene::pattern::Settings;
use bumps::Bumps;
use by_functions::CameraFunctions;
use glam::{DVec2, DVec3};
use mesh_camera::{MeshCamera, RasterPoint};
use std::f64::consts::PI;
use std::sync::Arc;

/// The projection of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Pinhole projection onto a plane: straight lines stay straight.
    Perspective,
    /// Parallel rays.
    Orthographic,
    /// The distance from the centre of the image is proportional to the angle from the axis.
    Fisheye,
    /// Horizontal and vertical positions are proportional to angles; the centre is undistorted.
    UltraWideAngle,
    /// A half turn from left to right, perspective in height.
    Panoramic,
    /// Longitude and latitude; holds the vertical angle in radians.
    Spherical(f64),
    /// Dome projection.
    Omnimax,
    /// Projection onto a cylinder, of one of four types.
    Cylinder(cylinder::Roll),
    /// Rays start at the triangles of meshes.
    Mesh,
    /// Rays are given by functions.
    Functions,
}

/// The projections by keyword, with their default parameters.
const KINDS: &[(Word, Projection)] = &[
    (Word::Perspective, Projection::Perspective),
    (Word::Orthographic, Projection::Orthographic),
    (Word::Fisheye, Projection::Fisheye),
    (Word::UltraWideAngle, Projection::UltraWideAngle),
    (Word::Panoramic, Projection::Panoramic),
    (Word::Spherical, Projection::Spherical(spherical::HEIGHT)),
    (Word::Omnimax, Projection::Omnimax),
    (
        Word::Cylinder,
        Projection::Cylinder(cylinder::Roll::Upright),
    ),
    (Word::MeshCamera, Projection::Mesh),
    (Word::UserDefined, Projection::Functions),
];

/// A camera. Only its [`Lens`] and its bumps need preparation: rays are computed directly from its vectors.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    projection: Projection,
    frame: Frame,
    /// The `angle` of angular projections, in radians.
    angle: Option<f64>,
    look_at: DVec3,
    sky: DVec3,
    /// Lens parameters for depth of field.
    blur: FocalBlur,
    /// The `normal` that perturbs ray directions.
    bumps: Option<Bumps>,
    /// The meshes of a `mesh_camera`.
    meshes: Option<MeshCamera>,
    /// The functions of a `user_defined` camera.
    functions: Option<Arc<CameraFunctions>>,
    /// The rounding of the directions of rays.
    normalization: Normalization,
}

/// The camera frame: location and the three vectors of the view.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Frame {
    location: DVec3,
    direction: DVec3,
    up: DVec3,
    right: DVec3,
}

/// A point of the image plane: -0.5 to 0.5, `u` to the right and `v` upwards.
#[derive(Clone, Copy, Debug)]
struct Screen {
    u: f64,
    v: f64,
}

/// The origin of a ray and its direction, of any length.
type Start = (DVec3, DVec3);

impl Default for Camera {
    /// The camera of a scene without one; its `right` has length 1.33 whatever the aspect ratio of the image.
    fn default() -> Self {
        Camera {
            projection: Projection::Perspective,
            frame: Frame {
                location: DVec3::ZERO,
                direction: DVec3::Z,
                up: DVec3::Y,
                right: DVec3::new(1.33, 0.0, 0.0),
            },
            angle: None,
            look_at: DVec3::Z,
            sky: DVec3::Y,
            blur: FocalBlur::default(),
            bumps: None,
            meshes: None,
            functions: None,
            normalization: Normalization::default(),
        }
    }
}

impl Camera {
    /// The camera of a scene without one from version 3.8 on, for images of this width over height.
    #[must_use]
    pub fn with_aspect(aspect: f64) -> Camera {
        let mut camera = Camera::default();
        camera.frame.right.x = aspect;
        camera
    }

    /// A perspective camera at `location` that looks at `look_at`, with aspect ratio `aspect` (width over height).
    /// `None` if the two points are the same.
    #[must_use]
    pub fn perspective(location: DVec3, look_at: DVec3, aspect: f64) -> Option<Camera> {
        let mut camera = Camera::default();
        camera.frame.location = location;
        camera.frame.right = DVec3::X * aspect;
        camera.turn_to(look_at, Normalization::default())?;
        Some(camera)
    }

    /// The ray through a point of an image of `width` by `height` pixels, with a unit direction.
    ///
    /// Integer `x` (to the right) and `y` (down) are pixel centres. `None` where the camera sees nothing: its vectors
    /// give no direction, or the point lies outside a round image.
    #[must_use]
    #[inline]
    pub fn primary_ray(&self, x: f64, y: f64, width: u32, height: u32) -> Option<Ray> {
        let (origin, dir) = self.start(x, y, width, height)?;
        let ray = ray(origin, dir, self.normalization)?;
        Some(match &self.bumps {
            None => ray,
            Some(bumps) => {
                let screen = Screen::new(x, y, [width, height], self.normalization);
                bumps.bend(self.bump_point(screen), ray)
            }
        })
    }

    /// Appends the rays of [`Camera::primary_ray`] through some points, up to the first that has none.
    pub fn add_primary_rays(
        &self,
        points: &[(f64, f64)],
        (width, height): (u32, u32),
        rays: &mut Vec<Ray>,
    ) {
        if self.projection == Projection::Orthographic
            && self.bumps.is_none()
            && let Some(Ray { dir, .. }) =
                ray(DVec3::ZERO, self.frame.direction, self.normalization)
        {
            rays.extend(points.iter().map(|&(x, y)| {
                let screen = Screen::new(x, y, [width, height], self.normalization);
                Ray::new(orthographic::start(&self.frame, screen).0, dir)
            }));
            return;
        }
        let ray_at = |&(x, y): &(f64, f64)| self.primary_ray(x, y, width, height);
        rays.extend(points.iter().map_while(ray_at));
    }

    /// True for a `mesh_camera`, whose rays start on surfaces.
    #[must_use]
    pub fn is_mesh(&self) -> bool {
        self.meshes.is_some()
    }

    /// Number of rays per image point; [`Camera::primary_ray`] is the first.
    #[must_use]
    pub fn rays_per_pixel(&self) -> usize {
        self.meshes.as_ref().map_or(1, MeshCamera::rays_per_pixel)
    }

    /// One of the rays through an image point, as [`Camera::primary_ray`].
    #[must_use]
    pub fn ray_by_index(
        &self,
        index: usize,
        (x, y): (f64, f64),
        (width, height): (u32, u32),
    ) -> Option<Ray> {
        let meshes = self.meshes.as_ref().filter(|_| index > 0);
        let Some(meshes) = meshes else {
            return self.primary_ray(x, y, width, height);
        };
        let (origin, dir) = meshes.start(index, RasterPoint::new(x, y, width, height))?;
        ray(origin, dir, self.normalization)
    }

    /// The point at which bumps are evaluated: the coordinates from which the projection computes a direction, so each
    /// projection has its own (checked with POV-Ray).
    #[cold]
    fn bump_point(&self, screen: Screen) -> DVec2 {
        let Screen { u, v } = screen;
        let unit = self.bumps.as_ref().map_or(1.0, |bumps| bumps.unit);
        let width = self.frame.right.length() / unit;
        let height = self.frame.up.length() / unit;
        let (x, y) = match self.projection {
            Projection::Perspective
            | Projection::Orthographic
            | Projection::Mesh
            | Projection::Functions => (u, v),
            Projection::Fisheye => fisheye::bump_point(&self.frame, screen, self.angle),
            Projection::UltraWideAngle => {
                let angle = self.angle.unwrap_or(ultra_wide_angle::ANGLE);
                (u * angle, v * angle * height / width)
            }
            Projection::Panoramic => ((0.5 - u) * PI, v * PI),
            Projection::Spherical(vertical) => {
                (u * self.angle.unwrap_or(spherical::WIDTH), v * vertical)
            }
            Projection::Omnimax => omnimax::bump_point(&self.frame, screen),
            Projection::Cylinder(roll) => {
                let angle = self.angle.unwrap_or(cylinder::ANGLE);
                match roll {
                    cylinder::Roll::Upright | cylinder::Roll::UprightFlat => {
                        (u * angle, v * height)
                    }
                    cylinder::Roll::Lying | cylinder::Roll::LyingFlat => (u * width, v * angle),
                }
            }
        };
        DVec2::new(x, y)
    }

    /// Projects a point onto an image of `width` by `height` pixels, in the pixel coordinates of
    /// [`Camera::primary_ray`]. `None` behind the camera, and for projections that bend straight lines.
    #[must_use]
    pub fn project(&self, point: DVec3, width: u32, height: u32) -> Option<(f64, f64)> {
        let Frame {
            location,
            direction,
            up,
            right,
        } = self.frame;
        let offset = point - location;
        let size = direction.dot(right.cross(up));
        let depth = offset.dot(right.cross(up)) / size;
        let scale = match self.projection {
            Projection::Perspective => depth,
            Projection::Orthographic => 1.0,
            _ => return None,
        };
        let u = offset.dot(up.cross(direction)) / size / scale;
        let v = offset.dot(direction.cross(right)) / size / scale;
        let is_seen = depth > 0.0 && u.is_finite() && v.is_finite();
        is_seen.then(|| {
            let (width, height) = (f64::from(width), f64::from(height));
            ((u + 0.5) * width - 0.5, height - 0.5 - (v + 0.5) * height)
        })
    }

    /// For a perspective camera without bumps, the dual vectors of its frame. A direction projects to
    /// `u = (dir · axes[0]) / (dir · axes[2])` and `v = (dir · axes[1]) / (dir · axes[2])`, as in [`Screen`].
    #[must_use]
    pub(crate) fn axes(&self) -> Option<[DVec3; 3]> {
        let Frame {
            direction,
            up,
            right,
            ..
        } = self.frame;
        let is_flat = self.projection == Projection::Perspective && self.bumps.is_none();
        let size = direction.dot(right.cross(up));
        let axes = [up.cross(direction), direction.cross(right), right.cross(up)];
        is_flat.then(|| axes.map(|axis| axis / size))
    }

    fn start(&self, x: f64, y: f64, width: u32, height: u32) -> Option<Start> {
        let screen = Screen::new(x, y, [width, height], self.normalization);
        let frame = &self.frame;
        match self.projection {
            Projection::Perspective => Some(perspective::start(frame, screen)),
            Projection::Orthographic => Some(orthographic::start(frame, screen)),
            Projection::Fisheye => fisheye::start(frame, screen, self.angle),
            Projection::UltraWideAngle => Some(ultra_wide_angle::start(frame, screen, self.angle)),
            Projection::Panoramic => Some(panoramic::start(frame, screen)),
            Projection::Spherical(vertical) => {
                Some(spherical::start(frame, screen, self.angle, vertical))
            }
            Projection::Omnimax => omnimax::start(frame, screen),
            Projection::Cylinder(roll) => Some(roll.start(frame, screen, self.angle)),
            Projection::Mesh => {
                let meshes = self.meshes.as_ref()?;
                meshes.start(0, RasterPoint::new(x, y, width, height))
            }
            Projection::Functions => {
                let functions = self.functions.as_ref()?;
                Some(functions.start(frame, screen))
            }
        }
    }

    /// True if all rays start at [`Camera::location`], apart from the aperture of a lens.
    #[must_use]
    pub fn has_one_origin(&self) -> bool {
        !matches!(
            self.projection,
            Projection::Orthographic
                | Projection::Mesh
                | Projection::Functions
                | Projection::Cylinder(cylinder::Roll::UprightFlat | cylinder::Roll::LyingFlat)
        )
    }

    /// The viewpoint; for an orthographic camera the centre of the ray origins.
    #[must_use]
    pub fn location(&self) -> DVec3 {
        self.frame.location
    }

    fn transform(&mut self, transform: &Transform) {
        let to_world = &transform.world_from_object;
        let frame = &mut self.frame;
        frame.location = to_world.transform_point3(frame.location);
        frame.direction = to_world.transform_vector3(frame.direction);
        frame.up = to_world.transform_vector3(frame.up);
        frame.right = to_world.transform_vector3(frame.right);
    }
}

impl Screen {
    #[inline]
    fn new(x: f64, y: f64, [width, height]: [u32; 2], version: Normalization) -> Self {
        let height = f64::from(height);
        Screen {
            u: (x + 0.5) / f64::from(width) - 0.5,
            // With this order of operations, a ray through an edge that lies on a pixel centre falls on the same side
            // as in POV-Ray.
            v: match version {
                Normalization::Reciprocal => (height - 1.0 - (y - 0.5)) / height - 0.5,
                Normalization::Quotient => 0.5 - (y + 0.5) / height,
            },
        }
    }
}

impl Camera {
    /// A copy prepared for ray generation; `settings` are the scene-wide settings of patterns.
    #[must_use]
    pub fn prepared(&self, settings: &Settings) -> Camera {
        let mut camera = self.clone();
        camera.normalization = Normalization::of_version(settings.is_3_8);
        if let Some(bumps) = &mut camera.bumps {
            bumps.prepare(settings);
        }
        camera
    }

    /// A copy with all lengths multiplied by a factor.
    #[must_use]
    pub(crate) fn scaled(mut self, factor: f64) -> Camera {
        self.frame.location *= factor;
        self.look_at *= factor;
        // For the other projections these only give directions or angles.
        if !self.has_one_origin() {
            self.frame.right *= factor;
            self.frame.up *= factor;
            if let Some(bumps) = &mut self.bumps {
                bumps.unit *= factor;
            }
        }
        self.blur.scale(factor);
        if let Some(meshes) = &mut self.meshes {
            meshes.scale(factor);
        }
        if let Some(functions) = &mut self.functions {
            Arc::make_mut(functions).transform(&Transform::scaling(DVec3::splat(factor)));
        }
        self
    }

    /// A copy moved by a vector.
    #[must_use]
    pub(crate) fn moved(mut self, by: DVec3) -> Camera {
        self.frame.location += by;
        self.look_at += by;
        if let Some(meshes) = &mut self.meshes {
            meshes.transform(&Transform::translation(by));
        }
        if let Some(functions) = &mut self.functions {
            Arc::make_mut(functions).transform(&Transform::translation(by));
        }
        self
    }
}

impl Frame {
    /// A copy with unit vectors, as used by angular projections.
    fn unit(&self) -> Frame {
        Frame {
            location: self.location,
            direction: self.direction.normalize_or_zero(),
            up: self.up.normalize_or_zero(),
            right: self.right.normalize_or_zero(),
        }
    }
}

/// The polar angle of a point of a round image in POV-Ray's range: from -90 degrees (down) through 0 (right) to 270.
fn polar_angle(x: f64, y: f64) -> f64 {
    let rise = (y / x.hypot(y)).asin();
    if x < 0.0 { PI - rise } else { rise }
}

/// The ray from a point in a nonzero direction of any length. Its direction equals POV-Ray's to the bit (measured for 3.7 by
/// how often media intervals fall short).
fn ray(origin: DVec3, dir: DVec3, normalization: Normalization) -> Option<Ray> {
    let length = dir.length();
    if length.is_normal() {
        return Some(Ray::new(origin, normalization.divided(dir, length)));
    }
    // The squares overflow or underflow, but the direction may still be valid.
    unit(dir).map(|dir| Ray::new(origin, dir))
}
