//! From rays to colours: what a ray sees, light and shadow, mirror images, what shines through.
//!
//! POV-Ray 3.7 is the model, to the order of sums and the precision of colours. A ray is a chain of straight
//! segments: passing a surface without a bend is a step of a loop, only mirror images and bent light call themselves,
//! at most `max_trace_level` deep. Missing: light below the surface.

mod atmosphere;
mod block;
mod caustics;
mod direct;
mod interior_stack;
mod irradiance;
mod lens;
mod media;
mod photon;
mod radiosity;
mod refraction;
mod shade_cache;
mod spectrum;
mod surface;
#[cfg(test)]
mod tests;
mod thin_film;
mod wavefront;

use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::base::math::sampling::mersenne::{Stream, seed_of_sample};
use crate::base::options::CancelToken;
use crate::render::photons::PhotonMaps;
use crate::render::radiosity::{Mode, Session};
use crate::world::{Hit, InteriorId, Query, RayKind, Scratch, SpawnSurface, World};
use atmosphere::{AirTint, End};
pub use block::{BLOCK, BlockScratch, FirstHit};
use direct::light::LightSamples;
use glam::DVec3;
use smallvec::SmallVec;

/// How many surfaces light may pass straight on. Passing uses up no trace level, so something must stop a scene that
/// puts a surface at every rounding step; no picture of a thousand panes comes near it.
const MOST_PASSED: usize = 1 << 16;

/// The interiors that a ray is in, the one entered last at the end.
type Inside = SmallVec<[InteriorId; 4]>;

/// What one point of the picture shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Linear light, what shines through the background not counted.
    pub rgb: Rgb,
    /// The share of light that would come through from behind the whole scene.
    pub transmit: f32,
}

impl Sample {
    /// Nothing to be seen, and nothing behind.
    const BLACK: Sample = Sample {
        rgb: Rgb::BLACK,
        transmit: 0.0,
    };
    /// Seen where the camera has no ray.
    const OUTSIDE: Sample = Sample {
        rgb: Rgb::BLACK,
        transmit: 1.0,
    };
}

/// What a quality leaves out (`+Q`); measured with POV-Ray 3.7.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Quality {
    /// From 2 on: light; before, the pigment of the lowest layer is the colour.
    has_light: bool,
    /// From 4 on: shadows.
    has_shadows: bool,
    /// From 5 on: area lights.
    has_area_lights: bool,
    /// From 6 on: the real pigments rather than `quick_color`, and what shines through.
    has_transparency: bool,
    /// From 8 on: mirror images.
    has_reflection: bool,
    /// From 8 on: bumps.
    has_normals: bool,
}

impl Quality {
    /// Nothing.
    const FULL: Quality = Quality {
        has_light: true,
        has_shadows: true,
        has_area_lights: true,
        has_transparency: true,
        has_reflection: true,
        has_normals: true,
    };
}

/// A ray on its way.
#[derive(Clone, Debug)]
struct Path {
    ray: Ray,
    from: Option<SpawnSurface>,
    seen: RayKind,
    /// How many bends and mirrors lie behind it.
    level: u32,
    /// The largest share that its colour can have in the sample.
    weight: f64,
    /// How often light was gathered on the way ([`radiosity`]).
    gathered: usize,
    inside: Inside,
    /// Its wavelength in nanometres, if it comes of light that was split.
    wavelength: Option<f64>,
}

/// A surface passed straight on: `rgb + factor · behind + reflected`.
struct Passed {
    rgb: Rgb,
    factor: Rgb,
    transmit: f32,
    reflected: Rgb,
    air: Option<AirTint>,
}

/// The tracer of one world at one quality.
#[derive(Debug)]
pub struct Tracer<'w> {
    world: &'w World,
    quality: Quality,
    /// Whether it matters in which interiors a ray is.
    minds_interiors: bool,
    /// Whether rays meet media.
    has_media: bool,
    /// Whether light from a source fades in some interior.
    light_fades: bool,
    /// Whether light that arrives from behind may matter to some surface.
    minds_backs: bool,
    /// Whether it hangs on the surface to which light matters besides those that face it.
    minds_surfaces: bool,
    /// Whether what plain surfaces show of others may be looked for together: not if light splits, nor if
    /// something takes random numbers one after the other.
    sends_waves: bool,
    /// Whether that may be done for all surfaces: not if radiosity is gathered in the order of the rays either.
    queues: bool,
    /// Whether what is plain may be coloured the short way.
    takes_plain: bool,
    /// The interiors around the camera, if all rays start in one point.
    around_camera: Inside,
    background: Background,
    reflected_background: Background,
    /// The samples of gathered light for threads that have no others.
    samples: Option<Box<Session>>,
    /// The photons, once they are shot, if any lie on surfaces.
    kept: Option<Box<PhotonMaps>>,
    stop: CancelToken,
}

impl<'w> Tracer<'w> {
    /// A tracer of `world`; `quality` is that of `+Q`, 9 and more for all there is.
    #[must_use]
    pub fn new(world: &'w World, quality: u8) -> Self {
        let is_all_opaque = world.is_opaque();
        let has_fresnel = world.has_fresnel();
        let has_media = quality >= 9 && (!world.media.is_empty() || world.interiors.have_media());
        let minds_interiors = !is_all_opaque || has_fresnel || has_media || !world.has_clear_air();
        let around_camera = if minds_interiors && world.camera.has_one_origin() {
            world.interiors_at(world.camera.location())
        } else {
            Inside::new()
        };
        let (background, reflected_background) = backgrounds(world);
        let quality = Quality {
            has_light: quality >= 2,
            has_shadows: quality >= 4,
            has_area_lights: quality >= 5,
            has_transparency: quality >= 6,
            has_reflection: quality >= 8,
            has_normals: quality >= 8,
        };
        Tracer {
            world,
            quality,
            has_media,
            light_fades: world.interiors.fade_light(),
            minds_backs: world.needs_backface_light(),
            minds_surfaces: world.needs_backface_light() || world.has_unlit(),
            sends_waves: !world.interiors.split_light() && !world.uses_random(),
            queues: !world.interiors.split_light()
                && !world.uses_random()
                && world.radiosity.is_none(),
            takes_plain: !has_media
                && world.radiosity.is_none()
                && direct::opaque::suits(world, quality),
            minds_interiors,
            around_camera,
            background,
            reflected_background,
            samples: None,
            kept: None,
            stop: CancelToken::default(),
        }
    }

    /// What is traced.
    #[must_use]
    pub fn world(&self) -> &'w World {
        self.world
    }

    /// The same, which sees nothing more as soon as it is to stop.
    #[must_use]
    pub fn until(self, stop: &CancelToken) -> Self {
        Tracer {
            stop: stop.clone(),
            ..self
        }
    }

    /// The same with samples of gathered light, to which it adds none: points of the picture may be asked for in any
    /// order.
    #[must_use]
    pub fn with_samples(self, samples: &Session) -> Self {
        let samples = Some(Box::new(samples.in_mode(Mode::Lone)));
        Tracer { samples, ..self }
    }

    /// The same with photons.
    #[must_use]
    pub fn with_photons(self, kept: PhotonMaps) -> Self {
        Tracer {
            takes_plain: false,
            kept: Some(Box::new(kept)),
            ..self
        }
    }

    /// What the camera sees at a point of a picture of `width` by `height` pixels; whole `x` and `y` are centres of
    /// pixels. Where the camera has no ray the sample is black and lets everything through.
    #[must_use]
    pub fn pixel(&self, x: f64, y: f64, width: u32, height: u32, scratch: &mut Scratch) -> Sample {
        if self.world.radiosity.is_some() {
            let see = |scratch: &mut Scratch| self.fresh_pixel((x, y), (width, height), scratch);
            return self.noted((x, y), scratch, see);
        }
        begin_sample(x, y, scratch);
        self.fresh_pixel((x, y), (width, height), scratch)
    }

    fn fresh_pixel(
        &self,
        (x, y): (f64, f64),
        (width, height): (u32, u32),
        scratch: &mut Scratch,
    ) -> Sample {
        match &self.world.lens {
            Some(lens) => self.through_lens(lens, (x, y), (width, height), scratch),
            None if self.world.camera.rays() > 1 => self.several((x, y), (width, height), scratch),
            None => {
                let ray = self.world.camera.primary_ray(x, y, width, height);
                self.sample(ray, scratch)
            }
        }
    }

    /// What a ray of the camera sees, or nothing where the camera has none.
    fn sample(&self, ray: Option<Ray>, scratch: &mut Scratch) -> Sample {
        match ray {
            Some(ray) => self.trace(self.camera_path(ray), None, scratch),
            None => Sample::OUTSIDE,
        }
    }

    fn camera_path(&self, ray: Ray) -> Path {
        let inside = if self.minds_interiors && !self.world.camera.has_one_origin() {
            self.world.interiors_at(ray.origin)
        } else {
            Inside::from_slice(&self.around_camera)
        };
        Path {
            ray,
            from: None,
            seen: RayKind::Camera,
            level: 0,
            weight: 1.0,
            gathered: 0,
            inside,
            wavelength: None,
        }
    }

    /// What a ray sees. `first` is what it meets first, and what is known of the lights there, where that was asked.
    fn trace(
        &self,
        mut path: Path,
        mut first: Option<(Option<Hit>, LightSamples)>,
        scratch: &mut Scratch,
    ) -> Sample {
        let mut passed: SmallVec<[Passed; 4]> = SmallVec::new();
        let end = loop {
            if !self.is_above_bailout((path.level, path.weight), path.gathered)
                || passed.len() == MOST_PASSED
            {
                break Sample::BLACK;
            }
            let (hit, known) = first.take().unwrap_or_else(|| {
                let query = Query {
                    ray: path.ray,
                    origin_surface: path.from,
                    t_max: f64::INFINITY,
                    kind: path.seen,
                };
                (self.world.nearest(&query, scratch), LightSamples::NONE)
            });
            let Some(hit) = hit else {
                let air = self.air(&path, End::Nothing, scratch);
                break self
                    .background_radiance(path.ray.dir, path.seen)
                    .through(air);
            };
            let lights = self.world.surfaces[hit.surface as usize].lights;
            let end = End::Surface(hit.t, lights);
            if let Some(plain) = self.plain(&hit, path.ray.dir, known, scratch) {
                break plain.through(self.air(&path, end, scratch));
            }
            // POV-Ray looks at what is behind the air first, which counts only where it takes random numbers.
            let is_last = scratch.order_dependent();
            let air = (!is_last).then(|| self.air(&path, end, scratch));
            let view = self.shade(&path, &hit, known, scratch);
            let air = air.unwrap_or_else(|| self.air(&path, end, scratch));
            let Some(passage) = view.straight_on else {
                break Sample {
                    rgb: view.rgb + view.reflected,
                    transmit: view.transmit,
                }
                .through(air);
            };
            passed.push(Passed {
                rgb: view.rgb,
                factor: passage.factor,
                transmit: passage.transmit,
                reflected: view.reflected,
                air,
            });
            // At the last level nothing is seen through a surface, bent or not.
            if path.level + 1 >= self.world.globals.max_trace_level {
                break Sample::BLACK;
            }
            path.ray = Ray::new(hit.point, path.ray.dir);
            path.from = Some(hit.departure);
            path.weight *= passage.weight;
            path.inside = passage.inside;
        };
        passed.iter().rev().fold(end, |behind, here| {
            let seen = Sample {
                rgb: here.rgb + here.factor * behind.rgb + here.reflected,
                transmit: here.transmit * behind.transmit,
            };
            seen.through(here.air)
        })
    }

    /// Whether a ray of this weight behind so many bends and mirrors, on which light was gathered so often, is followed.
    fn is_above_bailout(&self, (level, weight): (u32, f64), gathered: usize) -> bool {
        level < self.world.globals.max_trace_level
            && weight >= self.bailout(gathered)
            && !self.stop.is_asked()
    }

    /// What a ray sees that meets nothing.
    fn background_radiance(&self, dir: DVec3, seen: RayKind) -> Sample {
        let background = self.background_of(seen);
        match &self.world.sky {
            None => background.seen,
            Some(sky) => background.behind(sky.seen(dir)),
        }
    }

    /// The background as these rays see it.
    #[inline]
    fn background_of(&self, seen: RayKind) -> &Background {
        match seen {
            RayKind::Reflection | RayKind::Radiosity | RayKind::RadiosityReflection => {
                &self.reflected_background
            }
            RayKind::Camera | RayKind::Shadow => &self.background,
        }
    }
}

/// The background as some rays see it.
#[derive(Debug)]
struct Background {
    seen: Sample,
    /// The factor on transparency behind it.
    transmission: Rgb,
    /// Whether it hides the sky, which is so before version 3.7 in pictures with an alpha channel.
    hides_sky: bool,
}

impl Background {
    fn behind(&self, sky: crate::scene::atmosphere::Seen) -> Sample {
        if self.hides_sky {
            return self.seen;
        }
        Sample {
            rgb: sky.rgb + sky.factor * self.seen.rgb,
            transmit: (sky.factor * self.transmission).grey(),
        }
    }
}

/// Starts the random numbers of a sample, unless they go on.
fn begin_sample(x: f64, y: f64, scratch: &mut Scratch) {
    if scratch.goes_on {
        return;
    }
    scratch.stream = Stream::of_sample(x, y);
    scratch.media_stream = scratch.stream;
    scratch.crand = seed_of_sample(x, y);
}

/// The background for camera rays and for mirror images.
///
/// Measured with `background { rgbft <.5, .6, .7, .1, .25> }`: version 3.7 shows the colour less its transmit, and
/// with an alpha channel less its filter too; before 3.7 it is opaque, and with an alpha channel not there at all.
/// Mirrors show the colour as it is, except in 3.7 without an alpha channel.
fn backgrounds(world: &World) -> (Background, Background) {
    let color = world.background;
    let globals = &world.globals;
    let (rgb, transmission, reflected) = match (globals.rules_37, globals.has_alpha) {
        (true, true) => (
            color.rgb * (1.0 - color.filter - color.transmit),
            color.transmission(),
            color.rgb,
        ),
        (true, false) => {
            let rgb = color.rgb * (1.0 - color.transmit);
            (rgb, Rgb::splat(color.transmit), rgb)
        }
        (false, true) => (Rgb::BLACK, Rgb::WHITE, color.rgb),
        (false, false) => (color.rgb, Rgb::BLACK, color.rgb),
    };
    let image = Background {
        seen: Sample {
            rgb,
            transmit: transmission.grey(),
        },
        transmission,
        hides_sky: !globals.rules_37 && globals.has_alpha,
    };
    let mirrored = Background {
        seen: Sample {
            rgb: reflected,
            transmit: 0.0,
        },
        transmission: Rgb::BLACK,
        hides_sky: false,
    };
    (image, mirrored)
}
