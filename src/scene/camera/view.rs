//! A camera that is moved by hand: around the point it looks at, sideways, nearer, and on foot.
//!
//! It is written as a `camera` statement, and pictures are drawn with the camera that is read from this text, so a scene
//! with the text draws the same picture. Numbers are rounded to what shows.

use super::cylinder::Roll;
use super::{Camera, Projection};
use glam::{DMat3, DQuat, DVec3};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use std::fmt::{self, Display};

/// The largest cosine between two vectors of a camera that count as perpendicular.
const PERPENDICULAR: f64 = 1e-6;
/// The least angle between the view direction and `sky`, which must not be parallel.
const LEAST_TILT: f64 = 0.02;
/// Digits of a coordinate after that of the distance to the point in the centre.
const DIGITS: i32 = 5;
/// Digits of a length after its first: the last ones are roundings of the vectors.
const LENGTH: i32 = 11;
/// Digits of an angle after its first.
const ANGLE: i32 = 7;
/// The distance to the point in the centre where nothing is seen there.
const NO_DISTANCE: f64 = 10.0;

/// A camera to be moved. Angles are in degrees, as in the statement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct View {
    /// The keyword of the projection, with the number of a cylinder.
    projection: String,
    location: [f64; 3],
    /// The point in the centre, around which the camera orbits.
    look_at: [f64; 3],
    sky: [f64; 3],
    /// The length of `right`; negative in right-handed scenes.
    width: f64,
    /// The length of `up`.
    height: f64,
    /// The length of `direction`, for projections without an angle.
    depth: f64,
    /// The values of `angle`; empty for none.
    angles: Vec<f64>,
    /// The parameters of focal blur.
    blur: String,
}

/// A movement of a camera. Lengths are parts of the picture: 1 is its width or height.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Movement {
    /// Turns the scene around the point in the centre, as if it were dragged to the right and down; half a turn for the
    /// width of the picture.
    Orbit([f64; 2]),
    /// Shifts the scene to the right and down.
    Pan([f64; 2]),
    /// Divides the distance to the point in the centre by a factor.
    Zoom(f64),
    /// Turns the picture, in turns to the left.
    Roll(f64),
    /// Goes to the right, up and ahead, in parts of the distance to the point in the centre.
    Walk([f64; 3]),
}

impl Movement {
    /// True if all numbers are of use.
    fn is_valid(self) -> bool {
        let numbers = match self {
            Movement::Orbit([x, y]) | Movement::Pan([x, y]) => [x, y, 0.0],
            Movement::Zoom(by) if by <= 0.0 => return false,
            Movement::Zoom(by) | Movement::Roll(by) => [by, 0.0, 0.0],
            Movement::Walk([x, y, z]) => [x, y, z],
        };
        numbers.iter().all(|number| number.abs() <= 1e3)
    }
}

impl View {
    /// The view of a camera; `hit` is the point that it sees in the centre of the picture. `None` for cameras that
    /// its parameters do not describe: with skewed vectors, meshes, functions or a `normal`.
    #[must_use]
    pub fn of(camera: &Camera, hit: Option<DVec3>) -> Option<View> {
        let frame = camera.frame.unit();
        let are_skewed = |a: DVec3, b: DVec3| a.dot(b).abs() > PERPENDICULAR;
        let (right, up, forward) = (frame.right, frame.up, frame.direction);
        if camera.bumps.is_some()
            || are_skewed(right, up)
            || are_skewed(up, forward)
            || are_skewed(forward, right)
            || [right, up, forward].contains(&DVec3::ZERO)
        {
            return None;
        }
        let projection = match camera.projection {
            Projection::Mesh | Projection::Functions => return None,
            Projection::Perspective => "perspective",
            Projection::Orthographic => "orthographic",
            Projection::Fisheye => "fisheye",
            Projection::UltraWideAngle => "ultra_wide_angle",
            Projection::Panoramic => "panoramic",
            Projection::Spherical(_) => "spherical",
            Projection::Omnimax => "omnimax",
            Projection::Cylinder(Roll::Upright) => "cylinder 1",
            Projection::Cylinder(Roll::Lying) => "cylinder 2",
            Projection::Cylinder(Roll::UprightFlat) => "cylinder 3",
            Projection::Cylinder(Roll::LyingFlat) => "cylinder 4",
        };
        let length = |vector: DVec3| rounded(vector.length(), unit_of(vector.length(), LENGTH));
        let [width, height, depth] =
            [camera.frame.right, camera.frame.up, camera.frame.direction].map(length);
        let angles = match camera.projection {
            Projection::Perspective => vec![2.0 * (0.5 * width / depth).atan().to_degrees()],
            Projection::Orthographic => Vec::new(),
            Projection::Spherical(vertical) => {
                let across = camera.angle.unwrap_or(super::spherical::WIDTH);
                vec![across.to_degrees(), vertical.to_degrees()]
            }
            _ => camera.angle.map(f64::to_degrees).into_iter().collect(),
        };
        let location = camera.frame.location;
        let ahead = camera.look_at - location;
        let is_aimed = ahead.normalize_or_zero().dot(forward) > 1.0 - PERPENDICULAR;
        let distance = match (hit, is_aimed) {
            (_, true) => ahead.length(),
            (Some(hit), false) => (hit - location).dot(forward),
            (None, false) => NO_DISTANCE,
        };
        let is_right_handed = up.cross(forward).dot(right) < 0.0;
        // `sky` only counts for the roll: the scene's own is retained if it gives this roll.
        let sky = camera.sky.normalize_or_zero();
        let keeps_sky = sky.cross(forward).length() > LEAST_TILT
            && are_parallel(sky.cross(forward), up.cross(forward));
        Some(View {
            projection: projection.to_owned(),
            location: location.into(),
            look_at: (location + forward * distance).into(),
            sky: if keeps_sky { sky } else { up }.into(),
            width: if is_right_handed { -width } else { width },
            height,
            depth,
            angles,
            blur: camera.blur.text()?,
        })
    }

    /// Moves the camera; numbers out of range have no effect.
    pub fn apply(&mut self, movement: Movement) {
        if !movement.is_valid() {
            return;
        }
        let before = self.clone();
        let [mut location, mut look_at, mut sky] =
            [self.location, self.look_at, self.sky].map(DVec3::from);
        let away = location - look_at;
        let distance = away.length();
        let forward = -away / distance;
        let side = sky.cross(forward).normalize_or_zero() * self.width.signum();
        let up = side.cross(forward).normalize_or_zero() * -self.width.signum();
        match movement {
            Movement::Orbit([x, y]) => {
                let around = DQuat::from_axis_angle(sky.normalize(), x * PI * self.width.signum());
                let tilt = away.angle_between(sky);
                let least = LEAST_TILT.min(tilt).min(PI - tilt);
                let to = (tilt - y * PI).clamp(least, PI - least);
                let axis = sky.cross(forward).normalize_or_zero();
                let over = DQuat::from_axis_angle(axis, tilt - to);
                location = look_at + around * (over * away);
            }
            Movement::Pan([x, y]) => {
                let (width, height) = self.size_at(distance);
                let by = side * (-x * width) + up * (y * height);
                location += by;
                look_at += by;
            }
            Movement::Zoom(by) if self.projection == "orthographic" => {
                self.width /= by;
                self.height /= by;
            }
            Movement::Zoom(by) => location = look_at + away / by,
            Movement::Roll(by) => {
                let turn = -by * 2.0 * PI * self.width.signum();
                sky = DMat3::from_axis_angle(forward, turn) * up;
            }
            Movement::Walk([x, y, z]) => {
                let by = (side * x + up * y + forward * z) * distance;
                location += by;
                look_at += by;
            }
        }
        (self.location, self.look_at, self.sky) = (location.into(), look_at.into(), sky.into());
        let numbers = [
            self.location,
            self.look_at,
            self.sky,
            [self.width, 0.0, 0.0],
        ];
        let moved = DVec3::from(self.look_at) - DVec3::from(self.location);
        let is_usable = numbers
            .as_flattened()
            .iter()
            .all(|number| number.is_finite())
            && moved.length() > f64::EPSILON * DVec3::from(self.look_at).length()
            && moved.length().is_normal();
        if !is_usable {
            *self = before;
        }
    }

    /// Width and height of the picture in the plane through the point in the centre.
    fn size_at(&self, distance: f64) -> (f64, f64) {
        let width = self.width.abs();
        match (self.projection.as_str(), self.angles.first()) {
            ("orthographic", _) => (width, self.height),
            ("perspective", Some(angle)) => {
                let across = 2.0 * distance * (0.5 * angle).to_radians().tan();
                (across, across * self.height / width)
            }
            _ => (distance, distance * self.height / width),
        }
    }
}

fn are_parallel(a: DVec3, b: DVec3) -> bool {
    a.normalize_or_zero().dot(b.normalize_or_zero()) > 1.0 - PERPENDICULAR
}

/// The unit of a number's last digit, this many after its first.
fn unit_of(number: f64, digits: i32) -> f64 {
    #[allow(clippy::cast_possible_truncation, reason = "an exponent of ten")]
    10f64.powi(number.log10().floor().clamp(-280.0, 280.0) as i32 - digits)
}

/// A number rounded to a multiple of a power of ten; 0 leaves it as it is.
fn rounded(number: f64, unit: f64) -> f64 {
    match (number / unit).round() * unit {
        _ if unit == 0.0 => number,
        // The sum turns a negative zero into a plain one.
        // Powers below one are no sums of powers of two: the shortest text is that of the quotient.
        _ if unit < 1.0 => (number / unit).round() / unit.recip().round() + 0.0,
        large => large + 0.0,
    }
}

fn vector([x, y, z]: [f64; 3], unit: f64) -> String {
    let [x, y, z] = [x, y, z].map(|number| rounded(number, unit));
    format!("<{x}, {y}, {z}>")
}

impl Display for View {
    /// The statement, with a line for each parameter and no line break at the end.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let View {
            projection,
            width,
            height,
            depth,
            ..
        } = self;
        let distance = (DVec3::from(self.look_at) - DVec3::from(self.location)).length();
        let unit = unit_of(distance, DIGITS);
        writeln!(f, "camera {{\n  {projection}")?;
        writeln!(f, "  sky {}", vector(self.sky, 1e-9))?;
        writeln!(f, "  location {}", vector(self.location, unit))?;
        writeln!(f, "  right <{width}, 0, 0> up <0, {height}, 0>")?;
        match self.angles.as_slice() {
            [] => writeln!(f, "  direction <0, 0, {depth}>")?,
            [angle] => {
                let unit = unit_of(*angle, ANGLE).min(1e-6);
                writeln!(f, "  angle {}", rounded(*angle, unit))?;
            }
            [across, upwards, ..] => writeln!(f, "  angle {across} {upwards}")?,
        }
        writeln!(f, "  look_at {}", vector(self.look_at, unit))?;
        write!(f, "{}}}", self.blur)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;

    fn camera(text: &str) -> Camera {
        let text = text.trim().trim_start_matches("camera");
        let mut args = TextArgs::new(text).at_version(3.7);
        Camera::read(&mut args, &Camera::default()).expect("it is a camera")
    }

    fn view(text: &str) -> View {
        View::of(&camera(text), None).expect("it can be moved")
    }

    /// The pixel at which a camera sees a point, of a picture of 100 by 100.
    fn pixel(camera: &Camera, point: DVec3) -> (f64, f64) {
        camera.project(point, 100, 100).expect("it is seen")
    }

    #[test]
    fn the_statement_of_a_view_is_its_camera() {
        for text in [
            "{ location <1, 2, -5> look_at <0, 1, 0> angle 40 }",
            "{ location <1, 2, -5> direction <0, 0, 1.5> right <1.7777777, 0, 0> }",
            "{ orthographic location <0, 3, -4> look_at <0, 1, 0> right <5, 0, 0> up <0, 4, 0> }",
            "{ location <0, 0, -5e4> look_at 0 angle 0.0012345678 }",
            "{ location <1, 2, 5> right <-1.33, 0, 0> sky <0, 0, 1> look_at <0, 1, 0> }",
            "{ location <0, 5, 0> look_at <0, 0, 1> aperture 0.4 blur_samples 10 focal_point <0, 1, 0> }",
        ] {
            let before = camera(text);
            let after = camera(&view(text).to_string());
            for (x, y) in [(0.0, 0.0), (99.0, 20.0), (31.0, 74.0)] {
                let [a, b] = [&before, &after]
                    .map(|camera| camera.primary_ray(x, y, 100, 100).expect("a ray"));
                let differs = (a.origin - b.origin).length() + (a.dir - b.dir).length();
                assert!(differs < 1e-4, "{text}: {differs}");
            }
            assert_eq!(before.blur.is_active(), after.blur.is_active());
            // Reading the statement and writing it again changes nothing.
            let again = View::of(&after, None).expect("it can be moved");
            assert_eq!(again.to_string(), view(text).to_string());
        }
    }

    #[test]
    fn projections_are_written_as_they_are_read() {
        for text in [
            "{ fisheye location <0, 0, -1> angle 120 look_at <0, 0, 0> }",
            "{ spherical location <0, 0, -1> angle 200 70 look_at <0, 0, 0> }",
            "{ cylinder 2 location <0, 0, -1> angle 100 look_at <0, 0, 0> }",
            "{ panoramic location <0, 0, -1> look_at <0, 0, 0> }",
        ] {
            let (before, after) = (camera(text), camera(&view(text).to_string()));
            assert_eq!(before.projection, after.projection, "{text}");
        }
        for text in [
            "{ location <0, 0, -1> look_at <0, 0, 0> matrix <1, 0.5, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0> }",
            "{ location <0, 0, -1> look_at <0, 0, 0> normal { bumps 1 } }",
        ] {
            assert_eq!(View::of(&camera(text), None), None, "{text}");
        }
    }

    #[test]
    fn what_is_dragged_follows_in_scenes_of_both_hands() {
        for right in ["<1.33, 0, 0>", "<-1.33, 0, 0>"] {
            let text =
                format!("{{ location <0, 0, -5> right {right} look_at <0, 0, 0> angle 40 }}");
            let near = DVec3::new(0.0, 0.0, -0.5);
            let mut turned = view(&text);
            turned.apply(Movement::Orbit([0.02, 0.01]));
            let (x, y) = pixel(&camera(&turned.to_string()), near);
            assert!(x > 50.0 && y > 50.0, "{right}: {x} {y}");
            let mut shifted = view(&text);
            shifted.apply(Movement::Pan([0.1, 0.2]));
            let (x, y) = pixel(&camera(&shifted.to_string()), DVec3::ZERO);
            assert!(
                (x - 59.5).abs() < 1e-3 && (y - 69.5).abs() < 1e-3,
                "{x} {y}"
            );
            let mut rolled = view(&text);
            rolled.apply(Movement::Roll(0.25));
            let (x, y) = pixel(&camera(&rolled.to_string()), DVec3::new(0.0, 0.5, 0.0));
            assert!(x < 45.0 && (y - 49.5).abs() < 1e-3, "{right}: {x} {y}");
        }
    }

    #[test]
    fn an_orbit_ends_below_the_poles_and_a_zoom_before_the_point() {
        let mut view = view("{ location <0, 0, -5> look_at <0, 0, 0> }");
        for _ in 0..100 {
            view.apply(Movement::Orbit([0.03, 0.1]));
            view.apply(Movement::Zoom(1e3));
        }
        let seen = camera(&view.to_string());
        assert!(seen.primary_ray(0.0, 0.0, 9, 9).is_some());
        assert!(seen.location().y > 0.0 && seen.location().length() > 0.0);
    }

    #[test]
    fn movements_out_of_range_have_no_effect() {
        let still = view("{ location <0, 0, -5> look_at <0, 0, 0> }");
        for movement in [
            Movement::Orbit([f64::NAN, 0.0]),
            Movement::Zoom(0.0),
            Movement::Zoom(-1.0),
            Movement::Walk([0.0, 0.0, f64::INFINITY]),
        ] {
            let mut moved = still.clone();
            moved.apply(movement);
            assert_eq!(moved, still, "{movement:?}");
        }
    }
}
