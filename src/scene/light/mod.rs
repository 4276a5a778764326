//! `light_source`: position, colour, attenuation and area of a light.
//!
//! The [`Beam`] is the angular form of the light, one file for each kind. Any kind may have parallel rays
//! ([`Light::is_parallel`]), distance attenuation ([`Fade`]) and an area light's grid ([`Area`]). `looks_like` and
//! `projected_through` contain objects, so the language reads them.

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
pub use photons::{ObjectPhotons, PhotonRole, PhotonSettings};
pub use spotlight::Spotlight;

use crate::base::args::{Args, Parse, Word};
use crate::base::color::Rgb;
use crate::base::math::conditioning::Normalization;
use crate::base::math::noise::smooth;
use crate::base::math::{Ray, Step};
use crate::base::source::{Diagnostic, Span};
use crate::base::word::Class;
use glam::DVec3;

/// A light source.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// The position in world space.
    pub centre: DVec3,
    /// The emitted colour. Channels may exceed 1 or be negative.
    pub color: Rgb,
    /// The angular form of the emission.
    pub beam: Beam,
    /// True for parallel light, which travels from `centre` towards `points_at`.
    pub is_parallel: bool,
    /// The attenuation with distance.
    pub fade: Fade,
    /// The grid of point lights over which shadows are averaged.
    pub area: Option<Box<Area>>,
    /// True if media scatter the light.
    pub media_interaction: bool,
    /// True if media and fog attenuate the light between its source and the shading point.
    pub media_attenuation: bool,
    /// The `photons` settings.
    pub photons: PhotonSettings,
    /// The rounding of the directions to it.
    pub normalization: Normalization,
    points_at: DVec3,
    /// Unit direction from `centre` to `points_at`; zero where they are the same.
    axis: DVec3,
    /// Unit direction in which parallel rays travel.
    parallel_dir: DVec3,
    /// The apex of the cone or a point on the axis of the cylinder: for a grid light the centre of the whole area
    /// light.
    beam_origin: DVec3,
}

/// The form of a light's beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Beam {
    /// Uniform in all directions.
    Point,
    /// `shadowless`: uniform in all directions, never occluded, and without highlights.
    Shadowless,
    /// A cone.
    Spotlight(Spotlight),
    /// A cylindrical beam of parallel light.
    Cylinder(Cylinder),
}

/// Direction and distance from a shading point to a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    /// The unit direction to the light.
    pub to_light: DVec3,
    /// The distance over which the light fades, and the length of the shadow ray.
    pub distance: f64,
}

/// Keywords that are valid only after the keyword of the light's kind.
const BEAM_PARAMETERS: [Word; 4] = [Word::PointAt, Word::Radius, Word::Falloff, Word::Tightness];

impl Light {
    /// A point light.
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
            photons: PhotonSettings::default(),
            normalization: Normalization::default(),
            points_at: DVec3::Z,
            axis: DVec3::ZERO,
            parallel_dir: DVec3::ZERO,
            beam_origin: centre,
        };
        light.aim();
        light
    }

    /// Parses the centre and the colour that open every `light_source` block.
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
            args.warn(warning.with_hint("Write a colour after the location: `rgb 1`."));
            return Ok(Light::point(centre, Rgb::BLACK));
        }
        Ok(Light::point(centre, args.color()?.rgb))
    }

    /// Parses one parameter other than a transform. Returns false if the next token is none.
    ///
    /// # Errors
    /// A malformed value, or a parameter that this kind of light lacks.
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
            _ if BEAM_PARAMETERS.contains(&word) => {
                return self.read_beam_parameter(word, at, args);
            }
            _ if self.fade.read_item(word, args)? => return Ok(true),
            _ => return Area::read_item(&mut self.area, word, args),
        }
        args.accept(word)
    }

    /// Checks conditions that depend on the whole block.
    ///
    /// # Errors
    /// A circular area light with a single light along one of its axes.
    pub fn end(&mut self, args: &mut dyn Args) -> Parse<()> {
        if let Some(area) = &mut self.area {
            area.end(args)?;
        }
        Ok(())
    }

    /// Parses a parameter of the beam, which must follow the keyword of the beam.
    fn read_beam_parameter(&mut self, word: Word, at: Span, args: &mut dyn Args) -> Parse<bool> {
        args.accept(word)?;
        if word == Word::PointAt {
            if !self.is_parallel && !matches!(self.beam, Beam::Spotlight(_)) {
                return Err(wrong_kind_error(
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
                return Err(wrong_kind_error(word, at, "`spotlight` or `cylinder`"));
            }
        }
        Ok(true)
    }

    /// Transforms the positions of the light and its grid. Radii and distances do not scale.
    pub fn transform(&mut self, step: &Step) {
        let to_world = step.transform().world_from_object;
        self.centre = to_world.transform_point3(self.centre);
        self.points_at = to_world.transform_point3(self.points_at);
        if let Some(area) = &mut self.area {
            area.transform(&to_world);
        }
        self.aim();
    }

    /// The light of the area grid at `offset` from the centre, as an independent light. Cones and cylinders keep axis
    /// and origin of the whole light in [`Light::beam_interval`]; the attenuation of a cone is about the grid light.
    /// Parallel rays aim at the same `point_at`.
    #[must_use]
    pub fn grid_light(&self, offset: DVec3) -> Light {
        let centre = self.centre + offset;
        Light {
            centre,
            area: None,
            parallel_dir: (self.points_at - centre).normalize_or_zero(),
            ..*self
        }
    }

    fn aim(&mut self) {
        self.axis = (self.points_at - self.centre).normalize_or_zero();
        self.parallel_dir = self.axis;
        self.beam_origin = self.centre;
    }

    /// The target of `point_at`, in world space.
    #[must_use]
    pub fn points_at(&self) -> DVec3 {
        self.points_at
    }

    /// The unit direction from the centre to `point_at`; zero where they coincide.
    #[must_use]
    pub fn axis(&self) -> DVec3 {
        self.axis
    }

    /// True if the light is never occluded. Such a light makes no highlights.
    #[must_use]
    pub fn is_shadowless(&self) -> bool {
        self.beam == Beam::Shadowless
    }

    /// Direction and distance from `point` to the light's centre.
    #[must_use]
    #[inline]
    pub fn arrival(&self, point: DVec3) -> Arrival {
        let offset = self.centre - point;
        if self.is_parallel {
            return Arrival {
                to_light: -self.parallel_dir,
                distance: -offset.dot(self.parallel_dir),
            };
        }
        let distance = offset.length();
        Arrival {
            to_light: self.normalization.divided(offset, distance),
            distance,
        }
    }

    /// True if the unoccluded light arrives at full strength everywhere.
    #[must_use]
    pub fn is_unattenuated(&self) -> bool {
        let is_even = matches!(self.beam, Beam::Point | Beam::Shadowless);
        is_even && !self.fade.fades()
    }

    /// The fraction of the light that arrives at `point`, ignoring occlusion.
    #[must_use]
    #[inline]
    pub fn attenuation(&self, point: DVec3, arrival: &Arrival) -> f64 {
        if arrival.distance < 0.0 && matches!(self.beam, Beam::Spotlight(_)) {
            // Parallel light of a spotlight shines before it only, all other parallel light behind it as well.
            return 0.0;
        }
        self.beam_attenuation(point, arrival.to_light) * self.fade.attenuation(arrival.distance)
    }

    /// The beam's factor of the attenuation, without fading.
    #[inline]
    fn beam_attenuation(&self, point: DVec3, to_light: DVec3) -> f64 {
        match &self.beam {
            Beam::Point | Beam::Shadowless => 1.0,
            Beam::Spotlight(spotlight) => spotlight.attenuation(-to_light.dot(self.axis)),
            Beam::Cylinder(cylinder) => cylinder.attenuation(point - self.beam_origin, self.axis),
        }
    }

    /// The fraction of the light that a ray leaving the light carries. It is evaluated at the parameter `at`: rays of
    /// parallel light start beside the light, where the beam has not begun yet.
    #[must_use]
    pub fn attenuation_along_ray(&self, ray: &Ray, at: f64) -> f64 {
        self.beam_attenuation(ray.at(at), -ray.dir)
    }

    /// The unit direction in which parallel rays travel.
    #[must_use]
    pub fn parallel_dir(&self) -> DVec3 {
        self.parallel_dir
    }
}

impl Light {
    /// The interval of ray parameters inside the beam; `None` if the ray misses the beam. In a cone that it never leaves
    /// the interval ends at `endless`.
    #[must_use]
    pub fn beam_interval(&self, ray: &Ray, endless: f64) -> Option<(f64, f64)> {
        match &self.beam {
            Beam::Point | Beam::Shadowless => Some((f64::NEG_INFINITY, f64::INFINITY)),
            Beam::Spotlight(spotlight) => {
                let (from, to) = spotlight.interval(ray, self.beam_origin, self.axis)?;
                Some((from, if to.is_finite() { to } else { endless }))
            }
            Beam::Cylinder(cylinder) => cylinder.interval(ray, self.beam_origin, self.axis),
        }
    }
}

/// Smooth step across the penumbra of a beam: 0 at the outer edge, 1 at the inner edge.
fn edge(at: f64, outer: f64, inner: f64) -> f64 {
    smooth(((at - outer) / (inner - outer)).clamp(0.0, 1.0))
}

fn wrong_kind_error(word: Word, at: Span, kinds: &str) -> Box<Diagnostic> {
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
    fn a_light_has_a_centre_and_a_colour() {
        let light = read("<1, 2, 3>, rgb <1, 0.5, 0>").unwrap();
        assert_eq!(light.centre, DVec3::new(1.0, 2.0, 3.0));
        assert_eq!(light.color, Rgb::new(1.0, 0.5, 0.0));
        assert!(!light.is_shadowless() && light.media_interaction && !light.media_attenuation);
    }

    #[test]
    fn transforms_move_a_light_and_its_target() {
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
        assert!((light.attenuation(point, &arrival) - 0.97621 / 0.93632).abs() < 2e-5);
    }

    #[test]
    fn shadowless_after_spotlight_removes_the_cone() {
        // As in POV-Ray 3.7, where `shadowless` is one of the kinds.
        assert!(read("0, 1 spotlight shadowless").unwrap().is_shadowless());
        let light = read("0, 1 shadowless spotlight point_at <1, 0, 0>").unwrap();
        assert!(!light.is_shadowless());
    }

    #[test]
    fn parameters_must_follow_their_kind() {
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
    fn unknown_words_are_not_consumed() {
        let error = read("0, rgb 1 ior 2").expect_err("`ior` has no place in a light");
        assert_eq!(error.message, "expected the end, found `ior`");
    }
}
