//! `light_source`: where light comes from, how much of it arrives, and over which lamps it is spread.
//!
//! A light has a beam, one file each; beside it stand what any light may have: parallel rays ([`Light::is_parallel`]),
//! fading with the distance ([`Fade`]) and an area of lamps ([`Area`]). `looks_like` and `projected_through` hold
//! objects and are read by the language.

mod area;
mod cylinder;
mod fade;
mod part;
pub mod photon_file;
mod photons;
mod spotlight;

pub use area::{Area, Axes};
pub use cylinder::Cylinder;
pub use fade::Fade;
pub use part::Part;
pub use photons::{ObjectPhotons, PhotonRole, Photons};
pub use spotlight::Spotlight;

use crate::base::args::{Args, Parse, Word};
use crate::base::color::Rgb;
use crate::base::math::noise::smooth;
use crate::base::math::{Ray, Step};
use crate::base::source::{Diagnostic, Span};
use crate::base::word::Class;
use glam::DVec3;

/// A source of light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Where it is, in the world.
    pub centre: DVec3,
    /// Its light; more than 1 and less than 0 are allowed.
    pub color: Rgb,
    /// The form of what it gives.
    pub beam: Beam,
    /// Whether all its light comes from one direction, that from `points_at` to `centre`.
    pub is_parallel: bool,
    /// How its light fades.
    pub fade: Fade,
    /// The lamps over which its shadows are averaged.
    pub area: Option<Box<Area>>,
    /// Whether media scatter its light.
    pub media_interaction: bool,
    /// Whether media and fog weaken its light on the way.
    pub media_attenuation: bool,
    /// What it does with photons.
    pub photons: Photons,
    points_at: DVec3,
    /// The unit direction from `centre` to `points_at`; zero where they are the same.
    axis: DVec3,
    /// The unit direction of parallel rays.
    rays: DVec3,
    /// The centre of the whole light, where this is one of its lamps.
    middle: DVec3,
}

/// The form of a light's beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Beam {
    /// The same to all sides.
    Point,
    /// `shadowless`: the same to all sides. Nothing stops it, and it makes no highlights.
    Shadowless,
    /// A cone.
    Spotlight(Spotlight),
    /// A round beam of parallel light.
    Cylinder(Cylinder),
}

/// How light arrives at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    /// The unit direction to the light.
    pub to_light: DVec3,
    /// How far it has come, also the distance within which things cast shadows.
    pub distance: f64,
}

/// The words that a light's kind must stand before.
const OF_BEAMS: [Word; 4] = [Word::PointAt, Word::Radius, Word::Falloff, Word::Tightness];

impl Light {
    /// A light that shines to all sides.
    #[must_use]
    pub fn point(centre: DVec3, color: Rgb) -> Light {
        let mut light = Light {
            centre,
            color,
            beam: Beam::Point,
            is_parallel: false,
            fade: Fade::default(),
            area: None,
            media_interaction: true,
            media_attenuation: false,
            photons: Photons::default(),
            points_at: DVec3::Z,
            axis: DVec3::ZERO,
            rays: DVec3::ZERO,
            middle: centre,
        };
        light.aim();
        light
    }

    /// The centre and the colour, with which the inside of each block begins.
    ///
    /// # Errors
    /// A malformed value.
    pub fn begin(args: &mut dyn Args) -> Parse<Light> {
        let centre = args.vector()?;
        args.comma()?;
        let is_color = |word: Word| word.class() == Class::Color;
        let is_over = args.at_mark('}')?
            || args.word()?.is_some_and(|word| !is_color(word)) && !args.at_expression()?;
        if is_over {
            let warning =
                Diagnostic::warning(args.last_span(), "a light without a colour is black");
            args.warn(warning.with_hint("Write `rgb 1` behind its place."));
            return Ok(Light::point(centre, Rgb::BLACK));
        }
        Ok(Light::point(centre, args.color()?.rgb))
    }

    /// Takes one parameter other than a transform and says whether there was one.
    ///
    /// # Errors
    /// A malformed value, or a parameter that the light cannot have.
    pub fn read_item(&mut self, args: &mut dyn Args) -> Parse<bool> {
        let Some(word) = args.word()? else {
            return Ok(false);
        };
        let at = args.span();
        match word {
            Word::Shadowless => self.beam = Beam::Shadowless,
            Word::Spotlight => self.beam = Beam::Spotlight(Spotlight::default()),
            Word::Cylinder => {
                self.beam = Beam::Cylinder(Cylinder::default());
                self.is_parallel = true;
            }
            Word::Parallel => self.is_parallel = true,
            Word::MediaInteraction | Word::MediaAttenuation => {
                args.accept(word)?;
                let is_on = args.float_or(1.0)? != 0.0;
                if word == Word::MediaInteraction {
                    self.media_interaction = is_on;
                } else {
                    self.media_attenuation = is_on;
                }
                return Ok(true);
            }
            Word::Photons => {
                args.accept(word)?;
                self.photons.read(args)?;
                return Ok(true);
            }
            _ if OF_BEAMS.contains(&word) => return self.read_beam(word, at, args),
            _ if self.fade.read_item(word, args)? => return Ok(true),
            _ => return Area::read_item(&mut self.area, word, args),
        }
        args.accept(word)
    }

    /// Checks what can be known only at the end of the block.
    ///
    /// # Errors
    /// A round area with a single lamp on one of its axes.
    pub fn end(&mut self, args: &mut dyn Args) -> Parse<()> {
        if let Some(area) = &mut self.area {
            area.end(args)?;
        }
        Ok(())
    }

    /// A parameter of a beam, which the beam must stand before.
    fn read_beam(&mut self, word: Word, at: Span, args: &mut dyn Args) -> Parse<bool> {
        args.accept(word)?;
        if word == Word::PointAt {
            if !self.is_parallel && !matches!(self.beam, Beam::Spotlight(_)) {
                return Err(lacks_beam(
                    word,
                    at,
                    "`spotlight`, `cylinder` or `parallel`",
                ));
            }
            self.points_at = args.vector()?;
            self.aim();
            return Ok(true);
        }
        match &mut self.beam {
            Beam::Spotlight(spotlight) => spotlight.set(word, args.float()?),
            Beam::Cylinder(cylinder) => cylinder.set(word, args.float()?),
            Beam::Point | Beam::Shadowless => {
                return Err(lacks_beam(word, at, "`spotlight` or `cylinder`"));
            }
        }
        Ok(true)
    }

    /// Moves the light and its lamps; distances and widths stay.
    pub fn transform(&mut self, step: &Step) {
        let to_world = step.transform().world_from_object;
        self.centre = to_world.transform_point3(self.centre);
        self.points_at = to_world.transform_point3(self.points_at);
        if let Some(area) = &mut self.area {
            area.transform(&to_world);
        }
        self.aim();
    }

    /// One lamp of its area, so far from its centre, as a light by itself. Its cone keeps the direction of the
    /// whole, its cylinder the place too, and its parallel rays run to the same point.
    #[must_use]
    pub fn lamp(&self, offset: DVec3) -> Light {
        let centre = self.centre + offset;
        Light {
            centre,
            area: None,
            rays: (self.points_at - centre).normalize_or_zero(),
            ..*self
        }
    }

    fn aim(&mut self) {
        self.axis = (self.points_at - self.centre).normalize_or_zero();
        self.rays = self.axis;
        self.middle = self.centre;
    }

    /// The point at which it is aimed.
    #[must_use]
    pub fn points_at(&self) -> DVec3 {
        self.points_at
    }

    /// The unit direction in which it is aimed.
    #[must_use]
    pub fn axis(&self) -> DVec3 {
        self.axis
    }

    /// Whether nothing stops its light. Such a light makes no highlights.
    #[must_use]
    pub fn is_shadowless(&self) -> bool {
        self.beam == Beam::Shadowless
    }

    /// The way of its light to a point, from its centre.
    #[must_use]
    #[inline]
    pub fn arrival(&self, point: DVec3) -> Arrival {
        let offset = self.centre - point;
        if self.is_parallel {
            return Arrival {
                to_light: -self.rays,
                distance: -offset.dot(self.rays),
            };
        }
        let distance = offset.length();
        Arrival {
            to_light: offset / distance,
            distance,
        }
    }

    /// Whether all of its light arrives everywhere, but for what stands in the way.
    #[must_use]
    pub fn has_even_share(&self) -> bool {
        let is_even = matches!(self.beam, Beam::Point | Beam::Shadowless);
        is_even && !self.fade.fades()
    }

    /// The share of its light that arrives at a point, without regard to what stands in the way.
    #[must_use]
    #[inline]
    pub fn share(&self, point: DVec3, arrival: &Arrival) -> f64 {
        self.share_in_beam(point, arrival.to_light) * self.fade.share(arrival.distance)
    }

    /// The same without fading.
    #[inline]
    fn share_in_beam(&self, point: DVec3, to_light: DVec3) -> f64 {
        match &self.beam {
            Beam::Point | Beam::Shadowless => 1.0,
            Beam::Spotlight(spotlight) => spotlight.share(-to_light.dot(self.axis)),
            Beam::Cylinder(cylinder) => cylinder.share(point - self.middle, self.axis),
        }
    }

    /// The share of its light that a ray from it has, told so far along it: a ray of parallel light starts beside the light,
    /// where a beam has not begun yet.
    #[must_use]
    pub fn share_of_ray(&self, ray: &Ray, at: f64) -> f64 {
        self.share_in_beam(ray.at(at), -ray.dir)
    }

    /// The unit direction of parallel rays.
    #[must_use]
    pub fn rays(&self) -> DVec3 {
        self.rays
    }
}

impl Light {
    /// The stretch of a ray that lies in its beam, by the parameter of the ray; `None` where none does.
    #[must_use]
    pub fn crossed_by(&self, ray: &Ray) -> Option<(f64, f64)> {
        match &self.beam {
            Beam::Point | Beam::Shadowless => Some((f64::NEG_INFINITY, f64::INFINITY)),
            Beam::Spotlight(spotlight) => spotlight.crossed_by(ray, self.middle, self.axis),
            Beam::Cylinder(cylinder) => cylinder.crossed_by(ray, self.middle, self.axis),
        }
    }
}

/// How a beam ends: nothing at its outer edge, all at its inner edge.
fn edge(at: f64, outer: f64, inner: f64) -> f64 {
    smooth(((at - outer) / (inner - outer)).clamp(0.0, 1.0))
}

fn lacks_beam(word: Word, at: Span, kinds: &str) -> Box<Diagnostic> {
    Box::new(
        Diagnostic::error(at, format!("`{word}` has no meaning in this light"))
            .with_hint(format!("Write {kinds} before it.")),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::args::transform_step;

    fn read(text: &str) -> Parse<Light> {
        let mut args = TextArgs::new(text);
        let mut light = Light::begin(&mut args)?;
        loop {
            if let Some(step) = transform_step(&mut args)? {
                light.transform(&step);
            } else if !light.read_item(&mut args)? {
                break;
            }
        }
        light.end(&mut args)?;
        if args.is_done() {
            Ok(light)
        } else {
            Err(args.expected("the end"))
        }
    }

    #[test]
    fn a_light_has_a_place_and_a_colour() {
        let light = read("<1, 2, 3>, rgb <1, 0.5, 0>").unwrap();
        assert_eq!(light.centre, DVec3::new(1.0, 2.0, 3.0));
        assert_eq!(light.color, Rgb::new(1.0, 0.5, 0.0));
        assert!(!light.is_shadowless() && light.media_interaction && !light.media_attenuation);
    }

    #[test]
    fn transforms_move_it_and_what_it_points_at() {
        let text = "<1, 0, 0>, 0.5 spotlight point_at <1, -4, 0> scale 2 translate <0, 1, 0>";
        let light = read(text).unwrap();
        assert_eq!(light.centre, DVec3::new(2.0, 1.0, 0.0));
        assert_eq!(light.points_at(), DVec3::new(2.0, -7.0, 0.0));
        assert_eq!(light.axis(), DVec3::NEG_Y);
    }

    #[test]
    fn parallel_light_comes_from_one_direction() {
        let light = read("<0, 8, 0>, 1 parallel point_at <3, 0, 0> fade_distance 8 fade_power 2");
        let light = light.unwrap();
        let point = DVec3::new(0.5, 0.0, 0.0);
        let arrival = light.arrival(point);
        assert_eq!(arrival.to_light, DVec3::new(-3.0, 8.0, 0.0).normalize());
        // POV-Ray 3.7 fades parallel light by the distance along its direction.
        assert!((arrival.distance - 7.6663).abs() < 2e-4);
        assert!((light.share(point, &arrival) - 0.97621 / 0.93632).abs() < 2e-5);
    }

    #[test]
    fn shadowless_after_spotlight_takes_the_cone_away() {
        // As in POV-Ray 3.7, where being shadowless is one of the kinds.
        assert!(read("0, 1 spotlight shadowless").unwrap().is_shadowless());
        let light = read("0, 1 shadowless spotlight point_at <1, 0, 0>").unwrap();
        assert!(!light.is_shadowless());
    }

    #[test]
    fn parameters_need_their_kind_before_them() {
        for (text, word) in [
            ("0, 1 point_at 0 spotlight", "point_at"),
            ("0, 1 parallel radius 3", "radius"),
            ("0, 1 tightness 3", "tightness"),
        ] {
            let error = read(text).expect_err("the kind comes too late");
            assert_eq!(
                error.message,
                format!("`{word}` has no meaning in this light")
            );
        }
    }

    #[test]
    fn other_words_are_left() {
        let error = read("0, rgb 1 ior 2").expect_err("`ior` has no place in a light");
        assert_eq!(error.message, "expected the end, found `ior`");
    }
}
