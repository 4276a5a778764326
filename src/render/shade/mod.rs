//! Recursive ray tracing: radiance along a ray from direct light, shadows, reflection, refraction and atmosphere.
//!
//! POV-Ray 3.7 is the model, down to the order of sums and the precision of colours. A ray is a chain of straight
//! segments: a surface passed without refraction is one step of a loop. Only reflected and refracted rays recurse, at
//! most `max_trace_level` deep.

mod ahead;
mod atmosphere;
mod block;
mod bsdf;
mod direct;
mod features;
mod indirect;
mod many_rays;
mod media;
mod photon;
mod quality;
mod scratch;
mod shade_cache;
mod shading_point;
mod subsurface;
mod surface;
#[cfg(test)]
mod tests;
mod thin_film;
mod transmission;
mod wavefront;

use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::base::math::sampling::mersenne::{Stream, seed_of_sample};
use crate::base::options::CancelToken;
use crate::render::photons::PhotonMaps;
use crate::render::radiosity::{Mode, Radiosity, Session};
use crate::world::{Hit, InteriorId, Query, RayKind, SpawnSurface, World};
pub use ahead::Ahead;
use atmosphere::{AtmosphereTint, End, SegmentEnd};
pub use block::{BLOCK, BlockScratch, FirstHit};
use features::{FastPaths, Features};
use glam::DVec3;
pub use photon::emission::Emission;
use quality::Quality;
pub use scratch::Scratch;
use shading_point::LightSamples;
use smallvec::SmallVec;
use subsurface::{SubsurfaceStreams, SubsurfaceTransport};

/// Limit on surfaces that a ray passes without refraction. Passing does not use up a trace level, so a scene with a
/// surface at every rounding step would never end. No picture of a thousand panes comes near the limit.
const MAX_STRAIGHT: usize = 1 << 16;

/// The stack of interiors around a ray, the one entered last at the end.
type InteriorStack = SmallVec<[InteriorId; 4]>;

/// Radiance and transparency at one point of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Linear radiance, premultiplied by coverage.
    pub rgb: Rgb,
    /// Transmittance to behind the whole scene: 1 - alpha.
    pub transmit: f32,
}

impl Sample {
    /// No light, and nothing transparent.
    const BLACK: Sample = Sample {
        rgb: Rgb::BLACK,
        transmit: 0.0,
    };
    /// The sample where the camera has no ray.
    const OUTSIDE: Sample = Sample {
        rgb: Rgb::BLACK,
        transmit: 1.0,
    };
}

/// A ray with its path state.
#[derive(Clone, Debug)]
struct Path {
    ray: Ray,
    from: Option<SpawnSurface>,
    kind: RayKind,
    /// The number of refractions and reflections before it.
    level: u32,
    /// The path throughput: the largest share that its colour can have in the sample.
    weight: f64,
    /// The number of irradiance samples nested before it ([`radiosity`]).
    irradiance_depth: usize,
    /// The number of bodies that it has crossed unscattered ([`subsurface`]).
    subsurface_depth: u8,
    inside: InteriorStack,
    /// Its wavelength in nanometres, if it comes from dispersed light.
    wavelength: Option<f64>,
}

/// A surface passed without refraction: `rgb + factor · behind + reflected`.
struct PassedSurface {
    rgb: Rgb,
    factor: Rgb,
    transmit: f32,
    reflected: Rgb,
    atmosphere: Option<AtmosphereTint>,
}

/// The ray tracer of one world at one quality.
#[derive(Debug)]
pub struct Tracer<'w> {
    world: &'w World,
    quality: Quality,
    features: Features,
    fast_paths: FastPaths,
    /// The interiors around the camera, if all rays start at one point.
    around_camera: InteriorStack,
    background: Background,
    reflected_background: Background,
    /// Radiosity, if it is on.
    radiosity: Option<Radiosity>,
    /// The irradiance samples for threads that have no session of their own.
    session: Option<Box<Session>>,
    /// The photon maps, once photons are traced and some are stored.
    photon_maps: Option<Box<PhotonMaps>>,
    /// Subsurface light transport, if some surface uses it.
    subsurface: Option<Box<SubsurfaceTransport>>,
    stop: CancelToken,
}

impl<'w> Tracer<'w> {
    /// Creates a tracer of `world`; `quality` is that of `+Q`, 9 and more for every feature.
    #[must_use]
    pub fn new(world: &'w World, quality: u8) -> Self {
        let features = Features::new(world, quality);
        let around_camera = if features.needs_interiors && world.camera.has_one_origin() {
            world.interiors_at(world.camera.location())
        } else {
            InteriorStack::new()
        };
        let (background, reflected_background) = backgrounds(world);
        let quality = Quality::new(quality);
        Tracer {
            world,
            quality,
            features,
            fast_paths: FastPaths::new(world, quality, features),
            around_camera,
            background,
            reflected_background,
            radiosity: world
                .radiosity
                .map(|settings| Radiosity::new(settings, world.globals.importance)),
            session: None,
            photon_maps: None,
            subsurface: SubsurfaceTransport::new(world).map(Box::new),
            stop: CancelToken::default(),
        }
    }

    /// The world that is traced.
    #[must_use]
    pub fn world(&self) -> &'w World {
        self.world
    }

    /// Radiosity, if it is on.
    #[must_use]
    pub fn radiosity(&self) -> Option<&Radiosity> {
        self.radiosity.as_ref()
    }

    /// The same tracer with a cancellation token: once it is cancelled, all further rays are black.
    #[must_use]
    pub fn with_cancel_token(self, stop: &CancelToken) -> Self {
        Tracer {
            stop: stop.clone(),
            ..self
        }
    }

    /// The same tracer with irradiance samples. It adds none, so points of the picture may be traced in any order.
    #[must_use]
    pub fn with_irradiance_cache(self, session: &Session) -> Self {
        let session = Some(Box::new(session.in_mode(Mode::Isolated)));
        Tracer { session, ..self }
    }

    /// The same tracer with photon maps.
    #[must_use]
    pub fn with_photons(self, photon_maps: PhotonMaps) -> Self {
        Tracer {
            fast_paths: FastPaths {
                packets: false,
                ..self.fast_paths
            },
            photon_maps: Some(Box::new(photon_maps)),
            ..self
        }
    }

    /// Traces a point of a picture of `width` by `height` pixels; integral `x` and `y` are pixel centres. Where the
    /// camera has no ray the sample is black and fully transparent.
    #[must_use]
    pub fn pixel(&self, x: f64, y: f64, width: u32, height: u32, scratch: &mut Scratch) -> Sample {
        if self.radiosity.is_some() {
            let see = |scratch: &mut Scratch| self.fresh_pixel(x, y, width, height, scratch);
            return self.recall_or_trace(x, y, scratch, see);
        }
        begin_sample(x, y, scratch);
        self.fresh_pixel(x, y, width, height, scratch)
    }

    fn fresh_pixel(
        &self,
        x: f64,
        y: f64,
        width: u32,
        height: u32,
        scratch: &mut Scratch,
    ) -> Sample {
        if !self.has_many_rays() {
            let ray = self.world.camera.primary_ray(x, y, width, height);
            return self.sample(ray, scratch);
        }
        let mut mean = Sample::OUTSIDE;
        self.trace_many_rays(
            &[(x, y)],
            (width, height),
            |rays, samples| {
                for (sample, ray) in samples.iter_mut().zip(rays) {
                    *sample = self.sample(*ray, scratch);
                }
            },
            |_, sample| mean = sample,
        );
        mean
    }

    /// Traces a camera ray, if there is one.
    fn sample(&self, ray: Option<Ray>, scratch: &mut Scratch) -> Sample {
        match ray {
            Some(ray) => self.trace(self.camera_path(ray, None), None, scratch),
            None => Sample::OUTSIDE,
        }
    }

    /// The path of a camera ray, with the interiors around its start if they are known.
    fn camera_path(&self, ray: Ray, inside: Option<&InteriorStack>) -> Path {
        let inside = match inside {
            Some(inside) => inside.clone(),
            None if self.has_stacks_of_rays() => self.world.interiors_at(ray.origin),
            None => InteriorStack::from_slice(&self.around_camera),
        };
        Path {
            ray,
            from: None,
            kind: RayKind::Camera,
            level: 0,
            weight: 1.0,
            irradiance_depth: 0,
            subsurface_depth: 0,
            inside,
            wavelength: None,
        }
    }

    /// Returns true if the interiors around camera rays matter and differ from ray to ray.
    fn has_stacks_of_rays(&self) -> bool {
        self.features.needs_interiors && !self.world.camera.has_one_origin()
    }

    /// Traces a ray. `first` is its closest hit with the light samples there, if the caller has queried them.
    fn trace(
        &self,
        mut path: Path,
        mut first: Option<(Option<Hit>, LightSamples)>,
        scratch: &mut Scratch,
    ) -> Sample {
        let mut passed: SmallVec<[PassedSurface; 4]> = SmallVec::new();
        let was_first = scratch.query.set_first(path.level == 0);
        let end = loop {
            if !self.is_above_bailout(path.level, path.weight, path.irradiance_depth)
                || passed.len() == MAX_STRAIGHT
            {
                break Sample::BLACK;
            }
            let (hit, known) = first.take().unwrap_or_else(|| {
                let query = Query {
                    ray: path.ray,
                    origin_surface: path.from,
                    t_max: f64::INFINITY,
                    kind: path.kind,
                };
                (
                    self.world.nearest(&query, &mut scratch.query),
                    LightSamples::NONE,
                )
            });
            let Some(hit) = hit else {
                let atmosphere = self.atmosphere(&path, End::Nothing, scratch);
                break self
                    .background_radiance(path.ray.dir, path.kind)
                    .behind_atmosphere(atmosphere);
            };
            let lights = self.world.surfaces[hit.surface as usize].lights;
            let end = End::Surface(SegmentEnd {
                length: hit.t,
                surface: hit.spawn_surface,
                lights,
            });
            if let Some(sample) = self.shade_plain(&hit, path.ray.dir, known, scratch) {
                break sample.behind_atmosphere(self.atmosphere(&path, end, scratch));
            }
            // POV-Ray traces the light behind the atmosphere first, which matters only where it draws random numbers.
            let is_last = scratch.order_dependent();
            let atmosphere = (!is_last).then(|| self.atmosphere(&path, end, scratch));
            let view = self.shade(&path, &hit, known, scratch);
            let atmosphere = atmosphere.unwrap_or_else(|| self.atmosphere(&path, end, scratch));
            let Some(transmission) = view.straight else {
                break Sample {
                    rgb: view.rgb + view.reflected,
                    transmit: view.transmit,
                }
                .behind_atmosphere(atmosphere);
            };
            passed.push(PassedSurface {
                rgb: view.rgb,
                factor: transmission.factor,
                transmit: transmission.transmit,
                reflected: view.reflected,
                atmosphere,
            });
            // At the last level nothing is seen through a surface, refracted or not.
            if path.level + 1 >= self.world.globals.max_trace_level {
                break Sample::BLACK;
            }
            path.ray = Ray::new(hit.point, path.ray.dir);
            path.from = Some(hit.spawn_surface);
            path.weight *= transmission.weight;
            path.inside = transmission.inside;
        };
        scratch.query.set_first(was_first);
        passed.iter().rev().fold(end, |behind, here| {
            let seen = Sample {
                rgb: here.rgb + here.factor * behind.rgb + here.reflected,
                transmit: here.transmit * behind.transmit,
            };
            seen.behind_atmosphere(here.atmosphere)
        })
    }

    /// Returns true if a ray of this trace level and weight, behind `irradiance_depth` nested irradiance samples, is traced.
    fn is_above_bailout(&self, level: u32, weight: f64, irradiance_depth: usize) -> bool {
        level < self.world.globals.max_trace_level
            && weight >= self.bailout(irradiance_depth)
            && !self.stop.is_cancelled()
    }

    /// Radiance of a ray that hits nothing.
    fn background_radiance(&self, dir: DVec3, kind: RayKind) -> Sample {
        let background = self.background_of(kind);
        match &self.world.sky {
            None => background.seen,
            Some(sky) => background.behind(sky.radiance(dir)),
        }
    }

    /// The background for rays of this kind.
    #[inline]
    fn background_of(&self, kind: RayKind) -> &Background {
        match kind {
            RayKind::Reflection | RayKind::Radiosity | RayKind::RadiosityReflection => {
                &self.reflected_background
            }
            RayKind::Camera
            | RayKind::Shadow
            | RayKind::Photon
            | RayKind::PhotonReflection
            | RayKind::Subsurface => &self.background,
        }
    }
}

/// The background for some kinds of rays.
#[derive(Debug)]
struct Background {
    seen: Sample,
    /// The transmittance to transparency behind it.
    transmission: Rgb,
    /// It hides the sky: before version 3.7, in pictures with an alpha channel.
    hides_sky: bool,
}

impl Background {
    fn behind(&self, sky: crate::scene::atmosphere::SkyRadiance) -> Sample {
        if self.hides_sky {
            return self.seen;
        }
        Sample {
            rgb: sky.rgb + sky.factor * self.seen.rgb,
            transmit: (sky.factor * self.transmission).grey(),
        }
    }
}

/// Seeds the random numbers of a sample, unless they continue from sample to sample.
fn begin_sample(x: f64, y: f64, scratch: &mut Scratch) {
    if scratch.random.continues {
        return;
    }
    scratch.random.lights = Stream::of_sample(x, y);
    scratch.random.media = scratch.random.lights;
    scratch.random.crand = seed_of_sample(x, y);
    scratch.random.subsurface = SubsurfaceStreams::of_seed(scratch.random.crand);
}

/// The backgrounds of camera rays and of reflected rays.
///
/// Measured with `background { rgbft <.5, .6, .7, .1, .25> }`: version 3.7 shows the colour less its transmit, and with
/// an alpha channel, or from version 3.8 on, less its filter too. Before 3.7 it is opaque, and absent with an alpha
/// channel. Mirrors show the unchanged colour, except from 3.7 on without an alpha channel.
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
            let filter = if globals.is_3_8 { color.filter } else { 0.0 };
            let rgb = color.rgb * (1.0 - filter - color.transmit);
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
