//! `camera`: which ray each point of the picture sends into the scene.
//!
//! The kinds of camera have one file each; all stand in the same frame of vectors, which `read` sets up. A lens
//! ([`FocalBlur`]) may blur what a camera shows, and bumps bend it.

mod bumps;
mod cylinder;
mod fisheye;
mod focal_blur;
mod four;
mod lens_points;
mod mesh_camera;
mod omnimax;
mod orthographic;
mod panoramic;
mod perspective;
mod read;
mod spherical;
#[cfg(test)]
mod tests;
mod ultra_wide_angle;

pub use focal_blur::{FocalBlur, Lens, LensRay, Spread};

use crate::base::args::Word;
use crate::base::math::conditioning::unit;
use crate::base::math::{Ray, Transform};
use crate::scene::pattern::Settings;
use bumps::Bumps;
use glam::{DVec2, DVec3};
use mesh_camera::{MeshCamera, Place};
use std::f64::consts::PI;

/// The projection of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Straight lines stay straight, what is far is small.
    Perspective,
    /// All rays are parallel.
    Orthographic,
    /// The distance from the middle counts the angle.
    Fisheye,
    /// Both directions of the picture count angles, with the middle undistorted.
    UltraWideAngle,
    /// Half around to both sides, straight in height.
    Panoramic,
    /// The map of a globe; the angle from top to bottom in radians.
    Spherical(f64),
    /// The dome of a cinema.
    Omnimax,
    /// A rolled-up picture of one of four types.
    Cylinder(cylinder::Roll),
    /// The triangles of meshes send the rays.
    Mesh,
}

/// The kinds of camera by their words, for the first of the kind.
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
];

/// A camera. But for its [`Lens`] it needs no preparation: its vectors are what rays are made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    projection: Projection,
    frame: Frame,
    /// The `angle` of cameras that count angles, in radians.
    angle: Option<f64>,
    look_at: DVec3,
    sky: DVec3,
    /// The lens, if it has any width.
    blur: FocalBlur,
    /// What bends its rays.
    bumps: Option<Bumps>,
    /// The meshes that it looks out of.
    meshes: Option<MeshCamera>,
}

/// The vectors of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Frame {
    location: DVec3,
    direction: DVec3,
    up: DVec3,
    right: DVec3,
}

/// A point of the picture: -0.5 to 0.5 to the right and upwards.
#[derive(Clone, Copy, Debug)]
struct Screen {
    u: f64,
    v: f64,
}

/// The start and the direction of a ray, the direction of any length.
type Start = (DVec3, DVec3);

impl Default for Camera {
    /// The camera of a scene without one; its width is 1.33 whatever the shape of the picture.
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
        }
    }
}

impl Camera {
    /// A perspective camera at `location` that looks at `look_at`, with a picture `aspect` times as wide as high. `None` if
    /// the two are the same point.
    #[must_use]
    pub fn perspective(location: DVec3, look_at: DVec3, aspect: f64) -> Option<Camera> {
        let mut camera = Camera::default();
        camera.frame.location = location;
        camera.frame.right = DVec3::X * aspect;
        camera.turn_to(look_at)?;
        Some(camera)
    }

    /// The ray through a point of a picture of `width` by `height` pixels, its direction of length 1.
    ///
    /// Whole `x` (to the right) and `y` (down) are the centres of pixels. `None` where the camera sees nothing: its
    /// vectors leave no direction, or the point lies outside of a round picture.
    #[must_use]
    #[inline]
    pub fn primary_ray(&self, x: f64, y: f64, width: u32, height: u32) -> Option<Ray> {
        let (origin, dir) = self.start(x, y, width, height)?;
        let ray = ray(origin, dir)?;
        Some(match &self.bumps {
            None => ray,
            Some(bumps) => bumps.bent(self.measure(Screen::new(x, y, width, height)), ray),
        })
    }

    /// How many rays a point of the picture has; [`Camera::primary_ray`] is the first.
    #[must_use]
    pub fn rays(&self) -> u32 {
        self.meshes.as_ref().map_or(1, MeshCamera::rays)
    }

    /// One of the rays through a point of a picture, as [`Camera::primary_ray`].
    #[must_use]
    #[cold]
    pub fn numbered_ray(
        &self,
        number: u32,
        (x, y): (f64, f64),
        (width, height): (u32, u32),
    ) -> Option<Ray> {
        let meshes = self.meshes.as_ref().filter(|_| number > 0);
        let Some(meshes) = meshes else {
            return self.primary_ray(x, y, width, height);
        };
        let (origin, dir) = meshes.start(number, Place::new(x, y, width, height))?;
        ray(origin, dir)
    }

    /// The numbers from which a camera works out a direction, which differ from kind to kind: where bumps are asked for
    /// (checked with POV-Ray).
    #[cold]
    fn measure(&self, screen: Screen) -> DVec2 {
        let Screen { u, v } = screen;
        let unit = self.bumps.as_ref().map_or(1.0, |bumps| bumps.unit);
        let width = self.frame.right.length() / unit;
        let height = self.frame.up.length() / unit;
        let (x, y) = match self.projection {
            Projection::Perspective | Projection::Orthographic | Projection::Mesh => (u, v),
            Projection::Fisheye => fisheye::measure(&self.frame, screen, self.angle),
            Projection::UltraWideAngle => {
                let angle = self.angle.unwrap_or(ultra_wide_angle::ANGLE);
                (u * angle, v * angle * height / width)
            }
            Projection::Panoramic => ((0.5 - u) * PI, v * PI),
            Projection::Spherical(vertical) => {
                (u * self.angle.unwrap_or(spherical::WIDTH), v * vertical)
            }
            Projection::Omnimax => omnimax::measure(&self.frame, screen),
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

    /// Where in a picture of `width` by `height` pixels a point is seen, in the measure of [`Camera::primary_ray`]. `None`
    /// behind a camera, and where straight lines are bent.
    #[must_use]
    pub fn place_of(&self, point: DVec3, width: u32, height: u32) -> Option<(f64, f64)> {
        let Frame {
            location,
            direction,
            up,
            right,
        } = self.frame;
        let way = point - location;
        let size = direction.dot(right.cross(up));
        let depth = way.dot(right.cross(up)) / size;
        let scale = match self.projection {
            Projection::Perspective => depth,
            Projection::Orthographic => 1.0,
            _ => return None,
        };
        let u = way.dot(up.cross(direction)) / size / scale;
        let v = way.dot(direction.cross(right)) / size / scale;
        let is_seen = depth > 0.0 && u.is_finite() && v.is_finite();
        is_seen.then(|| {
            let (width, height) = (f64::from(width), f64::from(height));
            ((u + 0.5) * width - 0.5, height - 0.5 - (v + 0.5) * height)
        })
    }

    /// For a flat picture the vectors that tell where in it a direction lies: how far across and up, from -0.5 to 0.5, are
    /// its products with the first and the second by that with the third.
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
        let screen = Screen::new(x, y, width, height);
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
                meshes.start(0, Place::new(x, y, width, height))
            }
        }
    }

    /// Whether all rays start at [`Camera::location`], but for the width of a lens.
    #[must_use]
    pub fn has_one_origin(&self) -> bool {
        !matches!(
            self.projection,
            Projection::Orthographic
                | Projection::Mesh
                | Projection::Cylinder(cylinder::Roll::UprightFlat | cylinder::Roll::LyingFlat)
        )
    }

    /// The point from which the camera looks, or around which the origins of an orthographic view lie.
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
    fn new(x: f64, y: f64, width: u32, height: u32) -> Self {
        Screen {
            u: (x + 0.5) / f64::from(width) - 0.5,
            // In this order of operations a ray through an edge that lies on a pixel's centre goes to POV-Ray's side.
            v: (f64::from(height) - 1.0 - (y - 0.5)) / f64::from(height) - 0.5,
        }
    }
}

impl Camera {
    /// The same ready for rays; `settings` are what patterns take from the whole scene.
    #[must_use]
    pub fn prepared(&self, settings: &Settings) -> Camera {
        let mut camera = self.clone();
        if let Some(bumps) = &mut camera.bumps {
            bumps.prepare(settings);
        }
        camera
    }

    /// The same with every length times a factor.
    #[must_use]
    pub(crate) fn scaled(mut self, factor: f64) -> Camera {
        self.frame.location *= factor;
        self.look_at *= factor;
        // Elsewhere these are directions, or count angles.
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
        self
    }

    /// The same in another place.
    #[must_use]
    pub(crate) fn moved(mut self, by: DVec3) -> Camera {
        self.frame.location += by;
        self.look_at += by;
        if let Some(meshes) = &mut self.meshes {
            meshes.transform(&Transform::translation(by));
        }
        self
    }
}

impl Frame {
    /// The same with vectors of length 1, in which cameras count that measure angles.
    fn unit(&self) -> Frame {
        Frame {
            location: self.location,
            direction: self.direction.normalize_or_zero(),
            up: self.up.normalize_or_zero(),
            right: self.right.normalize_or_zero(),
        }
    }
}

/// The angle to a point of a round picture as POV-Ray counts it, from -90 degrees downwards over the right to 270.
fn turn(x: f64, y: f64) -> f64 {
    let rise = (y / x.hypot(y)).asin();
    if x < 0.0 { PI - rise } else { rise }
}

/// The ray from a point in a direction of any length but none, which is multiplied by one over that: rounded so it
/// is POV-Ray's to the bit, which a quotient is not (measured by how often intervals of media fall short).
fn ray(origin: DVec3, dir: DVec3) -> Option<Ray> {
    let length = dir.length();
    if length.is_normal() {
        return Some(Ray::new(origin, dir * length.recip()));
    }
    // Squares that cannot be held say nothing about a direction.
    unit(dir).map(|dir| Ray::new(origin, dir))
}
