//! `camera`: which ray each point of the picture sends into the scene.
//!
//! Built are `perspective` and `orthographic`. Missing: the other projections, focal blur, `normal`.
//!
//! From version 3.5 on the order of the words does not matter: vectors first, then `angle`, `look_at`, the scale of
//! an orthographic view, and all transforms together at the end. Before, each word acts where it stands.

use crate::args::{Args, Parse, Word, declared, not_built, transform_step};
use crate::math::{Ray, Transform};
use crate::source::{Diagnostic, Span};
use glam::DVec3;

/// The first language version in which the order of the words does not matter.
const FIRST_WITHOUT_ORDER: f64 = 3.5;
/// A vector whose components are all below this has no direction; POV-Ray's value.
const NO_DIRECTION: f64 = 1e-10;

/// Words of a camera that are missing here.
const MISSING: &[Word] = &[
    Word::BlurSamples,
    Word::Bokeh,
    Word::Confidence,
    Word::Cylinder,
    Word::Fisheye,
    Word::MeshCamera,
    Word::Normal,
    Word::Omnimax,
    Word::Panoramic,
    Word::Spherical,
    Word::UltraWideAngle,
    Word::Variance,
];

/// The projection of a camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Projection {
    Perspective,
    Orthographic,
}

/// A camera. It needs no preparation: its vectors are what rays are made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    projection: Projection,
    location: DVec3,
    direction: DVec3,
    up: DVec3,
    right: DVec3,
    sky: DVec3,
    look_at: DVec3,
}

/// What a block asks for that takes effect at its end.
#[derive(Default)]
struct Pending {
    angle_deg: Option<f64>,
    look_at: Option<(DVec3, Span)>,
    has_frame: bool,
    transform: Option<Transform>,
}

impl Default for Camera {
    /// The camera of a scene without one; its width is 1.33 whatever the shape of the picture.
    fn default() -> Self {
        Camera {
            projection: Projection::Perspective,
            location: DVec3::ZERO,
            direction: DVec3::Z,
            up: DVec3::Y,
            right: DVec3::new(1.33, 0.0, 0.0),
            sky: DVec3::Y,
            look_at: DVec3::Z,
        }
    }
}

impl Camera {
    /// The camera of a block. `base` is the default camera; before version 3.5 it is the camera written before.
    ///
    /// # Errors
    /// A malformed value, a word that is not built yet, `angle` outside 0 to 180, or `look_at` equal to `location`.
    pub fn read(args: &mut dyn Args, base: &Camera) -> Parse<Camera> {
        args.open()?;
        let mut is_named = false;
        let mut camera = match declared::<Camera>(args)? {
            Some(known) => {
                is_named = true;
                Camera::clone(&known)
            }
            None => base.clone(),
        };
        if args.version() < FIRST_WITHOUT_ORDER {
            camera.read_in_order(args)?;
            return Ok(camera);
        }
        let mut pending = Pending::default();
        if let (false, Some(word)) = (is_named, args.word()?) {
            camera.read_projection(word, args)?;
        }
        while !args.accept_close()? {
            if let Some(step) = transform_step(args)? {
                let before = pending.transform.unwrap_or(Transform::IDENTITY);
                pending.transform = Some(before.then(&step.transform()));
            } else if is_named {
                return Err(args.expected("a transform or `}` after the name of a camera"));
            } else {
                camera.read_item(args, &mut pending)?;
            }
        }
        if !is_named {
            camera.finish(args, &pending)?;
        }
        if let Some(transform) = &pending.transform {
            camera.transform(transform);
        }
        Ok(camera)
    }

    /// The ray through a point of a picture of `width` by `height` pixels, its direction of length 1.
    ///
    /// Whole `x` (to the right) and `y` (down) are the centres of pixels. `None` where the camera sees nothing:
    /// its vectors leave no direction.
    #[must_use]
    pub fn primary_ray(&self, x: f64, y: f64, width: u32, height: u32) -> Option<Ray> {
        let u = (x + 0.5) / f64::from(width) - 0.5;
        // In this order of operations a ray through an edge that lies on a pixel's centre goes to POV-Ray's side.
        let v = (f64::from(height) - 1.0 - (y - 0.5)) / f64::from(height) - 0.5;
        let (origin, dir) = match self.projection {
            Projection::Perspective => {
                (self.location, self.direction + u * self.right + v * self.up)
            }
            Projection::Orthographic => {
                (self.location + u * self.right + v * self.up, self.direction)
            }
        };
        let length = dir.length();
        (length > 0.0 && length.is_finite()).then(|| Ray::new(origin, dir / length))
    }

    /// Whether all rays start at [`Camera::location`].
    #[must_use]
    pub fn has_one_origin(&self) -> bool {
        self.projection == Projection::Perspective
    }

    /// The point from which the camera looks, or around which the origins of an orthographic view lie.
    #[must_use]
    pub fn location(&self) -> DVec3 {
        self.location
    }

    /// One parameter of a block in which the order does not matter.
    fn read_item(&mut self, args: &mut dyn Args, pending: &mut Pending) -> Parse<()> {
        let Some(word) = args.word()? else {
            return Err(args.expected("a parameter of `camera` or `}`"));
        };
        match word {
            Word::Angle => pending.angle_deg = angle(args)?,
            Word::LookAt => pending.look_at = Some(look_at(args)?),
            Word::Up | Word::Right => {
                self.read_vector(word, args)?;
                pending.has_frame = true;
            }
            Word::Perspective | Word::Orthographic => {
                return Err(Box::new(
                    Diagnostic::error(args.span(), format!("`{word}` must come first in `camera`"))
                        .with_hint("write it right after `camera {`"),
                ));
            }
            _ if self.read_vector(word, args)? => {}
            _ => no_blur(word, args)?,
        }
        Ok(())
    }

    /// A parameter that is a plain vector.
    fn read_vector(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        let slot = match word {
            Word::Location => &mut self.location,
            Word::Direction => &mut self.direction,
            Word::Up => &mut self.up,
            Word::Right => &mut self.right,
            Word::Sky => &mut self.sky,
            _ => return Ok(false),
        };
        args.accept(word)?;
        *slot = args.vector()?;
        Ok(true)
    }

    fn read_projection(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        self.projection = match word {
            Word::Perspective => Projection::Perspective,
            Word::Orthographic => Projection::Orthographic,
            _ => return Ok(false),
        };
        args.accept(word)
    }

    /// Applies what waits for the end of the block, except the transforms.
    fn finish(&mut self, args: &mut dyn Args, pending: &Pending) -> Parse<()> {
        if let Some(degrees) = pending.angle_deg {
            self.open_to(degrees);
        }
        if let Some((point, at)) = pending.look_at {
            self.aim(args, point, at)?;
        }
        let is_orthographic = self.projection == Projection::Orthographic;
        if is_orthographic && (pending.angle_deg.is_some() || !pending.has_frame) {
            self.fit_orthographic();
        }
        Ok(())
    }

    /// A block in which each word acts where it stands, as before version 3.5.
    fn read_in_order(&mut self, args: &mut dyn Args) -> Parse<()> {
        while !args.accept_close()? {
            if let Some(step) = transform_step(args)? {
                let transform = step.transform();
                self.look_at = transform.world_from_object.transform_point3(self.look_at);
                self.transform(&transform);
                continue;
            }
            let Some(word) = args.word()? else {
                return Err(args.expected("a parameter of `camera` or `}`"));
            };
            match word {
                Word::Angle => {
                    let degrees = angle(args)?;
                    if let (Some(degrees), Projection::Perspective) = (degrees, self.projection) {
                        self.open_to(degrees);
                    }
                }
                Word::LookAt => {
                    let (point, at) = look_at(args)?;
                    self.aim(args, point, at)?;
                }
                Word::Orthographic => {
                    self.read_projection(word, args)?;
                    self.fit_orthographic();
                }
                _ if self.read_vector(word, args)? || self.read_projection(word, args)? => {}
                _ => no_blur(word, args)?,
            }
        }
        Ok(())
    }

    /// Makes the picture span `degrees` from left to right.
    fn open_to(&mut self, degrees: f64) {
        let length = self.right.length() / (2.0 * (0.5 * degrees).to_radians().tan());
        self.direction = self.direction.normalize_or(DVec3::Z) * length;
    }

    /// Turns the camera so that `point` is in the middle and `sky` upwards; lengths and handedness stay.
    fn aim(&mut self, args: &mut dyn Args, point: DVec3, at: Span) -> Parse<()> {
        let handedness = self.up.cross(self.direction).dot(self.right);
        let Some(forward) = (point - self.location).try_normalize() else {
            return Err(Box::new(
                Diagnostic::error(at, "`look_at` is the same point as `location`")
                    .with_hint("Move one of the two: the camera needs a direction."),
            ));
        };
        let mut sideways = self.sky.cross(forward);
        if sideways.abs().cmplt(DVec3::splat(NO_DIRECTION)).all() {
            args.warn(Diagnostic::warning(
                at,
                "the camera looks along `sky`; it keeps its `right`",
            ));
            sideways = self.right;
        }
        let sideways = sideways.normalize_or(DVec3::X);
        let upward = forward.cross(sideways);
        let width = self.right.length();
        self.direction = forward * self.direction.length();
        self.up = upward * self.up.length();
        self.right = sideways * if handedness > 0.0 { width } else { -width };
        self.look_at = point;
        Ok(())
    }

    /// Gives an orthographic view the size of what a perspective one shows at `look_at`.
    fn fit_orthographic(&mut self) {
        let scale = (self.look_at - self.location).length() / self.direction.length();
        if scale.is_finite() {
            self.right *= scale;
            self.up *= scale;
        }
    }

    fn transform(&mut self, transform: &Transform) {
        let to_world = &transform.world_from_object;
        self.location = to_world.transform_point3(self.location);
        self.direction = to_world.transform_vector3(self.direction);
        self.up = to_world.transform_vector3(self.up);
        self.right = to_world.transform_vector3(self.right);
    }
}

/// `angle` and its degrees; 0 is as if it were not there.
fn angle(args: &mut dyn Args) -> Parse<Option<f64>> {
    let at = args.span();
    args.accept(Word::Angle)?;
    let degrees = args.float()?;
    if (0.0..180.0).contains(&degrees) {
        return Ok((degrees > 0.0).then_some(degrees));
    }
    let bound = if degrees < 0.0 {
        "must not be negative"
    } else {
        "must be less than 180 degrees"
    };
    Err(Box::new(Diagnostic::error(
        at.to(args.last_span()),
        format!("`angle` {bound}, but it is {degrees}"),
    )))
}

/// `look_at` with its point, and where it stands.
fn look_at(args: &mut dyn Args) -> Parse<(DVec3, Span)> {
    let at = args.span();
    args.accept(Word::LookAt)?;
    let point = args.vector()?;
    Ok((point, at.to(args.last_span())))
}

/// The words of focal blur that change nothing by themselves; any other word is an error.
fn no_blur(word: Word, args: &mut dyn Args) -> Parse<()> {
    let missing = not_built(args, word);
    match word {
        Word::Aperture => {
            args.accept(word)?;
            if args.float()? == 0.0 {
                Ok(())
            } else {
                Err(missing)
            }
        }
        Word::FocalPoint => {
            args.accept(word)?;
            args.vector().map(|_| ())
        }
        _ if MISSING.contains(&word) => Err(missing),
        _ => Err(args.expected("a parameter of `camera` or `}`")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::text::TextArgs;

    fn camera(text: &str, version: f64) -> Camera {
        let mut args = TextArgs::new(text).at_version(version);
        let camera = Camera::read(&mut args, &Camera::default()).unwrap();
        assert!(args.is_done());
        camera
    }

    fn error(text: &str) -> String {
        let read = Camera::read(&mut TextArgs::new(text), &Camera::default());
        read.expect_err("the text is faulty").message
    }

    /// Where the rays of a picture of 5 by 1 pixels meet the plane z = 0.
    fn columns(camera: &Camera) -> Vec<f64> {
        let ray = |x: u8| camera.primary_ray(f64::from(x), 0.0, 5, 1);
        let meet = |ray: Ray| ray.origin.x - ray.origin.z / ray.dir.z * ray.dir.x;
        (0..5)
            .map(|x| meet(ray(x).expect("it has a direction")))
            .collect()
    }

    /// Compares with what POV-Ray 3.7 draws of a plane `z, 0` with a gradient over 100 units, in 16 bits.
    fn check(text: &str, version: f64, expected: [f64; 5]) {
        for (found, expected) in columns(&camera(text, version)).iter().zip(expected) {
            assert!(
                (found - expected).abs() < 0.002,
                "{text}: {found}, not {expected}"
            );
        }
    }

    #[test]
    fn the_picture_is_as_wide_as_right() {
        check(
            "{ location <0,0,-5> }",
            3.7,
            [-2.66, -1.33, 0.0, 1.33, 2.66],
        );
    }

    #[test]
    fn an_orthographic_view_is_scaled_by_the_distance_of_look_at() {
        let text = "{ orthographic location <1,0,-5> look_at <1,0,0> }";
        check(text, 3.7, [-1.659, -0.33, 1.0, 2.329, 3.66]);
    }

    #[test]
    fn an_orthographic_view_with_right_is_not_scaled() {
        let text = "{ orthographic location <1,0,-5> look_at <1,0,0> right <2,0,0> }";
        check(text, 3.7, [0.201, 0.6, 1.0, 1.4, 1.8]);
    }

    #[test]
    fn an_orthographic_view_with_angle_is_scaled() {
        let text = "{ orthographic location <1,0,-5> look_at <1,0,0> angle 40 }";
        check(text, 3.7, [-0.455, 0.272, 1.0, 1.728, 2.456]);
    }

    #[test]
    fn the_order_of_words_does_not_matter() {
        let text = "{ location <1,0,-5> angle 60 right <2,0,0> look_at <2,0,0> }";
        check(text, 3.7, [-0.199, 0.852, 2.0, 3.259, 4.646]);
    }

    #[test]
    fn transforms_come_after_look_at() {
        let text = "{ location <1,0,-5> right <2,0,0> angle 60 rotate <0,20,0> look_at <2,0,0> }";
        check(text, 3.7, [-0.195, 0.896, 2.296, 4.151, 6.732]);
    }

    #[test]
    fn before_version_3_5_each_word_acts_where_it_stands() {
        let angle = "{ location <1,0,-5> angle 60 right <2,0,0> look_at <2,0,0> }";
        check(angle, 3.1, [-1.171, 0.312, 2.0, 3.941, 6.194]);
        let turn = "{ location <1,0,-5> right <2,0,0> angle 60 rotate <0,20,0> look_at <2,0,0> }";
        check(turn, 3.1, [-0.417, 0.655, 2.0, 3.736, 6.063]);
        let early = "{ orthographic location <1,0,-5> look_at <1,0,0> }";
        check(early, 3.1, [0.468, 0.735, 1.0, 1.266, 1.531]);
        let late = "{ location <1,0,-5> look_at <1,0,0> orthographic }";
        check(late, 3.1, [-1.659, -0.33, 1.0, 2.329, 3.66]);
        let moved = "{ location <1,0,-5> look_at <2,0,0> orthographic translate <3,0,0> }";
        check(moved, 3.1, [2.233, 3.617, 5.0, 6.384, 7.766]);
        let unopened = "{ orthographic angle 40 location <1,0,-5> look_at <1,0,0> }";
        check(unopened, 3.1, [0.468, 0.735, 1.0, 1.266, 1.531]);
    }

    #[test]
    fn a_mirrored_right_stays_mirrored() {
        let text = "{ location <0,0,-5> right <-1,0,0> look_at 0 }";
        check(text, 3.7, [2.0, 1.0, 0.0, -1.0, -2.0]);
    }

    #[test]
    fn a_named_camera_takes_transforms_only() {
        let known = camera("{ location <0,0,-5> }", 3.7);
        let mut args = TextArgs::new("{ C translate <1,0,0> }").with("C", known.clone());
        let moved = Camera::read(&mut args, &Camera::default()).unwrap();
        assert_eq!(moved.location(), DVec3::new(1.0, 0.0, -5.0));
        let mut args = TextArgs::new("{ C angle 30 }").with("C", known);
        let error = Camera::read(&mut args, &Camera::default()).expect_err("no room for `angle`");
        assert_eq!(
            error.message,
            "expected a transform or `}` after the name of a camera, found `angle`"
        );
    }

    #[test]
    fn looking_along_sky_is_doubtful() {
        let mut args = TextArgs::new("{ location <0,-5,0> look_at 0 }");
        let camera = Camera::read(&mut args, &Camera::default()).unwrap();
        assert_eq!(
            args.warnings(),
            ["the camera looks along `sky`; it keeps its `right`"]
        );
        assert_eq!(camera.right, DVec3::new(1.33, 0.0, 0.0));
    }

    #[test]
    fn a_camera_without_direction_sees_nothing() {
        let camera = camera("{ direction 0 right 0 up 0 }", 3.7);
        assert!(camera.primary_ray(0.0, 0.0, 1, 1).is_none());
    }

    #[test]
    fn faults_are_told() {
        assert_eq!(
            error("{ angle 180 }"),
            "`angle` must be less than 180 degrees, but it is 180"
        );
        assert_eq!(
            error("{ angle -10 }"),
            "`angle` must not be negative, but it is -10"
        );
        assert_eq!(
            error("{ look_at 0 }"),
            "`look_at` is the same point as `location`"
        );
        assert_eq!(error("{ fisheye }"), "`fisheye` is not built yet");
        assert_eq!(error("{ aperture 0.5 }"), "`aperture` is not built yet");
        assert_eq!(
            error("{ location 0 orthographic }"),
            "`orthographic` must come first in `camera`"
        );
    }
}
