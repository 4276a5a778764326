//! The wavefront of reflected and refracted rays of a block. Secondary rays of all pixels are traced, lit and shaded
//! together, as camera rays are ([`super::block`]), then the rays that leave their hits, and so on. Dispersed light,
//! surfaces with several textures or reflections, and scenes with sequential random numbers are left to the scalar
//! path.

use super::ahead::BUNDLE;
use super::atmosphere::{AtmosphereTint, End, SegmentEnd};
use super::bsdf::{ViewPoint, facing_normal};
use super::direct::block_hits::{BlockHits, RaySource};
use super::direct::packet::{RadiancePacket4, SecondarySurface, ShadeBuffers};
use super::direct::shadow_cache::ShadowCache;
use super::shading_point::LightSamples;
use super::surface::{Mirror, TextureShading, TextureUse, mirrored_off};
use super::transmission::interior_stack::{Refraction, bend};
use super::{InteriorStack, MAX_STRAIGHT, Path, Sample, Scratch, Tracer};
use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::base::math::sampling::mersenne::Stream;
use crate::base::math::simd::with_widest;
use crate::scene::texture::{Irid, WeightedTexture};
use crate::world::{Hit, HitPacket4, InteriorId, Query, RayKind, SpawnSurface};
use glam::DVec3;

/// Limit on queued surfaces. Beyond it rays are traced one by one, which does not hold all branches of the ray tree in
/// memory at once.
const MAX_PENDING: usize = 1 << 13;

/// The number of rays of a wave that are traced, lit and shaded together.
const WAVE_BATCH: usize = 1 << 10;

/// Samples with the indices of their pixels, in the order in which they are finished.
///
/// Written by code that is compiled once, where a callback would compile the whole wavefront for each caller.
pub(super) type PixelSamples = Vec<(usize, Sample)>;

/// Buffers of the wavefront.
#[derive(Debug, Default)]
pub(super) struct Wavefront {
    all: BlockHits,
    /// The rays of the current wave.
    rays: Vec<SecondaryRay>,
    /// The rays of the next wave.
    next: Vec<SecondaryRay>,
    pending: Vec<PendingSurface>,
    /// The filters of pending surfaces; most have none.
    filters: Vec<Filters>,
    /// The interior stacks of rays, that of the camera first.
    interior_stacks: Vec<InteriorStack>,
}

/// A reflected or refracted ray.
#[derive(Clone, Copy, Debug)]
struct SecondaryRay {
    query: Query,
    /// The number of refractions and reflections before it.
    level: u32,
    /// The number of surfaces passed since then without refraction.
    passed: usize,
    /// The path throughput: the largest share that its colour can have in the sample.
    weight: f64,
    /// The index of its interior stack.
    inside: usize,
    to: Destination,
}

/// Up to four rays of a wave.
struct RaySlice<'a> {
    rays: &'a [SecondaryRay],
    interior_stacks: &'a [InteriorStack],
}

/// The receiver of a sample.
#[derive(Clone, Copy, Debug)]
enum Destination {
    /// The pixel with this index.
    Pixel(usize),
    /// The reflection of the pending surface with this index.
    Image(usize),
    /// The transmitted light of the pending surface with this index.
    Behind(usize),
}

/// A surface that waits for its secondary rays.
#[derive(Clone, Copy, Debug)]
struct PendingSurface {
    to: Destination,
    /// Its own light.
    own: Rgb,
    /// The factor on light from behind.
    factor: Rgb,
    /// The factor on the transparency behind.
    transmit: f32,
    reflectivity: Rgb,
    behind: Sample,
    image: Rgb,
    /// The index of its filters, if it has any.
    filters: Option<u32>,
}

/// Filters on secondary light besides reflectivity and transmittance.
#[derive(Clone, Copy, Debug)]
struct Filters {
    /// The factor of a thin film on the reflection, and on the transmitted light.
    on_image: Rgb,
    on_behind: Rgb,
    /// The exponent of the reflection.
    exponent: f32,
    /// The atmosphere before the surface.
    atmosphere: Option<AtmosphereTint>,
}

impl Filters {
    const NONE: Filters = Filters {
        on_image: Rgb::WHITE,
        on_behind: Rgb::WHITE,
        exponent: 1.0,
        atmosphere: None,
    };
}

impl PendingSurface {
    /// The sample of the surface, once its secondary rays are traced.
    fn sample(&self, filters: &[Filters]) -> Sample {
        let (mut image, mut behind, mut atmosphere) = (self.image, self.behind.rgb, None);
        if let Some(filters) = self.filters.and_then(|number| filters.get(number as usize)) {
            image *= filters.on_image;
            if filters.exponent != 1.0 {
                image = image.map(|c| c.powf(1.0 / filters.exponent));
            }
            behind *= filters.on_behind;
            atmosphere = filters.atmosphere;
        }
        let reflected = Rgb::BLACK + image * self.reflectivity;
        Sample {
            rgb: self.own + self.factor * behind + reflected,
            transmit: self.transmit * self.behind.transmit,
        }
        .behind_atmosphere(atmosphere)
    }
}

/// The origin of secondary rays on a surface.
struct SpawnPoint {
    /// The viewed point, with the normal of the top layer.
    at: ViewPoint,
    /// The normal without bump mapping.
    flat: DVec3,
    spawn_surface: SpawnSurface,
    /// The distance of the hit.
    t: f64,
    surface: u32,
}

/// The light of a surface, and the properties of its secondary rays.
struct SurfaceLight<'t> {
    /// Its own light.
    own: Rgb,
    /// The transmittance of all layers, if it is worth tracing.
    passing: Option<Rgb>,
    mirror: Option<&'t Mirror<'t>>,
    /// The film on the top layer.
    film: Option<&'t Irid>,
    /// The atmosphere before it.
    atmosphere: Option<AtmosphereTint>,
}

impl Wavefront {
    /// Returns true if one more surface may be queued.
    #[inline(always)]
    pub(super) fn has_capacity(&self) -> bool {
        self.pending.len() < MAX_PENDING
    }

    /// Delivers a sample to its receiver.
    fn deliver(&mut self, to: Destination, sample: Sample, samples: &mut PixelSamples) {
        match to {
            Destination::Pixel(pixel) => samples.push((pixel, sample)),
            Destination::Image(number) => self.pending[number].image = sample.rgb,
            Destination::Behind(number) => self.pending[number].behind = sample,
        }
    }
}

impl RaySource for RaySlice<'_> {
    fn kind(&self, lane: usize) -> RayKind {
        self.rays[lane].query.kind
    }

    fn common_kind(&self) -> Option<RayKind> {
        let first = self.rays[0].query.kind;
        let are_same = self.rays.iter().all(|onward| onward.query.kind == first);
        are_same.then_some(first)
    }

    fn inside(&self, lane: usize) -> &[InteriorId] {
        &self.interior_stacks[self.rays[lane].inside]
    }

    fn stream(&self, _lane: usize) -> Option<Stream> {
        None
    }

    fn path(&self, lane: usize, _dir: DVec3) -> Path {
        self.rays[lane].path(self.interior_stacks)
    }
}

impl SecondaryRay {
    /// A closest-hit query.
    fn query(ray: Ray, from: Option<SpawnSurface>, ray_kind: RayKind) -> Query {
        Query {
            ray,
            origin_surface: from,
            t_max: f64::INFINITY,
            kind: ray_kind,
        }
    }

    /// True if no surface was hit before it.
    fn is_camera_ray(&self) -> bool {
        self.query.kind == RayKind::Camera && self.query.origin_surface.is_none()
    }

    fn path(&self, interior_stacks: &[InteriorStack]) -> Path {
        Path {
            ray: self.query.ray,
            from: self.query.origin_surface,
            kind: self.query.kind,
            level: self.level,
            weight: self.weight,
            irradiance_depth: 0,
            subsurface_depth: 0,
            inside: InteriorStack::from_slice(&interior_stacks[self.inside]),
            wavelength: None,
        }
    }
}

impl Tracer<'_> {
    /// Queues a surface that a camera ray hits, in this lane of these hits.
    #[inline(never)]
    pub(super) fn begin_wavefront(
        &self,
        wavefront: &mut Wavefront,
        pixel: usize,
        hits: &HitPacket4,
        lane: usize,
        secondary: &SecondarySurface,
        scratch: &mut Scratch,
    ) {
        let onward = self.camera_ray(wavefront, pixel, hits.dir(lane));
        self.queue_plain(wavefront, &onward, hits, lane, secondary, scratch);
    }

    /// The camera ray in this direction, for a pixel.
    fn camera_ray(&self, wavefront: &mut Wavefront, pixel: usize, dir: DVec3) -> SecondaryRay {
        if wavefront.interior_stacks.is_empty() {
            wavefront
                .interior_stacks
                .push(InteriorStack::from_slice(&self.around_camera));
        }
        let ray = Ray::new(self.world.camera.location(), dir);
        SecondaryRay {
            query: SecondaryRay::query(ray, None, RayKind::Camera),
            level: 0,
            passed: 0,
            weight: 1.0,
            inside: 0,
            to: Destination::Pixel(pixel),
        }
    }

    /// Queues a camera ray, to be traced with the secondary rays.
    pub(super) fn queue_camera_ray(&self, wavefront: &mut Wavefront, pixel: usize, ray: Ray) {
        let path = self.camera_path(ray, None);
        if wavefront.interior_stacks.last() != Some(&path.inside) {
            wavefront.interior_stacks.push(path.inside);
        }
        wavefront.next.push(SecondaryRay {
            query: SecondaryRay::query(ray, None, path.kind),
            level: path.level,
            passed: 0,
            weight: path.weight,
            inside: wavefront.interior_stacks.len() - 1,
            to: Destination::Pixel(pixel),
        });
    }

    /// Shades the hit of a camera ray for a pixel; `None` if its secondary rays are queued.
    pub(super) fn shade_or_queue_camera_hit(
        &self,
        wavefront: &mut Wavefront,
        pixel: usize,
        dir: DVec3,
        hit: Option<Hit>,
        known: LightSamples,
        scratch: &mut Scratch,
    ) -> Option<Sample> {
        let onward = self.camera_ray(wavefront, pixel, dir);
        self.shade_or_queue(wavefront, &onward, hit, known, scratch)
    }

    /// Queues the secondary rays of a plain surface.
    fn queue_plain(
        &self,
        wavefront: &mut Wavefront,
        incoming: &SecondaryRay,
        hits: &HitPacket4,
        lane: usize,
        secondary: &SecondarySurface,
        scratch: &mut Scratch,
    ) {
        let spawn_point = SpawnPoint {
            at: secondary.at,
            flat: hits.facing(lane),
            spawn_surface: hits.spawn_surface(lane),
            t: hits.t[lane],
            surface: hits.surface[lane],
        };
        let filter = secondary.transmittance;
        let light = SurfaceLight {
            own: secondary.own,
            passing: (!self.is_opaque(0, filter)).then_some(filter),
            mirror: secondary.mirror.as_ref(),
            film: None,
            atmosphere: self.atmosphere_before(
                hits,
                lane,
                || incoming.path(&wavefront.interior_stacks),
                scratch,
            ),
        };
        self.queue_secondary_rays(wavefront, incoming, &spawn_point, &light);
    }

    /// Queues the refracted and reflected ray of a surface.
    #[inline(always)]
    fn queue_secondary_rays(
        &self,
        wavefront: &mut Wavefront,
        incoming: &SecondaryRay,
        from: &SpawnPoint,
        light: &SurfaceLight,
    ) {
        let at = &from.at;
        let mut filters = light.atmosphere.map(|atmosphere| Filters {
            atmosphere: Some(atmosphere),
            ..Filters::NONE
        });
        let number = wavefront.pending.len();
        let mut pending = PendingSurface {
            to: incoming.to,
            own: light.own,
            factor: Rgb::BLACK,
            transmit: 0.0,
            reflectivity: Rgb::BLACK,
            behind: Sample::BLACK,
            image: Rgb::BLACK,
            filters: None,
        };
        let spawn_surface = Some(from.spawn_surface);
        let onward = |dir: DVec3, kind: RayKind| {
            SecondaryRay::query(Ray::new(at.point, dir), spawn_surface, kind)
        };
        let reflected_kind = incoming.query.kind.mirrored();
        let level = incoming.level + 1;
        let mut mirror = light.mirror;
        if let Some(filter) = light.passing {
            let stack = &wavefront.interior_stacks[incoming.inside];
            let interior = self.world.surfaces[from.surface as usize].interior;
            let transmission = self.layer_transmission(stack, from.t, interior, filter, None);
            pending.factor = transmission.factor;
            pending.transmit = transmission.transmit;
            let weight = incoming.weight * transmission.weight;
            let to = Destination::Behind(number);
            let bend = bend(at.view, at.normal, transmission.crossing.ratio);
            match bend {
                Refraction::None | Refraction::To(_) => {
                    let (dir, level, passed) = match bend {
                        Refraction::To(dir) => (dir, level, 0),
                        _ => (at.view, incoming.level, incoming.passed + 1),
                    };
                    wavefront.next.push(SecondaryRay {
                        query: onward(dir, incoming.query.kind),
                        level,
                        passed,
                        weight,
                        inside: wavefront.interior_stacks.len(),
                        to,
                    });
                    wavefront.interior_stacks.push(transmission.crossing.inside);
                }
                Refraction::Total => {
                    pending.factor = transmission.total_reflection;
                    pending.transmit = 0.0;
                    mirror = mirror.filter(|mirror| !mirror.is_replaced_by_total(at.normal));
                    let dir = mirrored_off(
                        self.world.globals.normalization(),
                        at.view,
                        at.normal,
                        from.flat,
                    );
                    if let Some(film) = light.film.filter(|film| film.amount > 0.0) {
                        let film = self.film(film, at, dir);
                        filters.get_or_insert(Filters::NONE).on_behind = film;
                    }
                    wavefront.next.push(SecondaryRay {
                        query: onward(dir, reflected_kind),
                        level,
                        passed: 0,
                        weight,
                        inside: incoming.inside,
                        to,
                    });
                }
            }
        }
        if let Some(mirror) = mirror {
            pending.reflectivity = mirror.reflectivity;
            let exponent = mirror.finish.reflection.exponent;
            if exponent != 1.0 {
                filters.get_or_insert(Filters::NONE).exponent = exponent;
            }
            let irid = &mirror.finish.irid;
            if irid.amount > 0.0 {
                filters.get_or_insert(Filters::NONE).on_image = self.film(irid, at, mirror.dir);
            }
            wavefront.next.push(SecondaryRay {
                query: onward(mirror.dir, reflected_kind),
                level,
                passed: 0,
                weight: incoming.weight * mirror.weight,
                inside: incoming.inside,
                to: Destination::Image(number),
            });
        }
        if let Some(filters) = filters {
            pending.filters = u32::try_from(wavefront.filters.len()).ok();
            wavefront.filters.push(filters);
        }
        wavefront.pending.push(pending);
    }

    /// Traces all queued rays, wave by wave, and appends the samples of their pixels.
    pub(super) fn trace_wavefronts(
        &self,
        wavefront: &mut Wavefront,
        buffers: ShadeBuffers,
        samples: &mut PixelSamples,
    ) {
        let ShadeBuffers { scratch, cache } = buffers;
        while !wavefront.next.is_empty() {
            std::mem::swap(&mut wavefront.rays, &mut wavefront.next);
            wavefront.next.clear();
            // Rays below the bailout stay black, as initialised. At the last level nothing is seen through a surface,
            // refracted or not.
            let (most, least) = (self.world.globals.max_trace_level, self.bailout(0));
            wavefront.rays.retain(|onward| {
                let is_past = onward.passed > 0 && onward.level + 1 >= most;
                let is_worth = onward.level < most && onward.weight >= least && !is_past;
                is_worth && onward.passed < MAX_STRAIGHT
            });
            if self.stop.is_cancelled() {
                wavefront.rays.clear();
            }
            // With many lights the shadow rays would take too much memory.
            let at_once = match self.world.lights.len() > MANY_LIGHTS {
                true => SMALL_BATCH,
                false => WAVE_BATCH,
            };
            let rays = std::mem::take(&mut wavefront.rays);
            for rays in rays.chunks(at_once) {
                let buffers = ShadeBuffers {
                    scratch: &mut *scratch,
                    cache: &mut *cache,
                };
                self.trace_wave(rays, wavefront, buffers, samples);
            }
            wavefront.rays = rays;
        }
        wavefront.interior_stacks.clear();
        // Surfaces are queued before those that they show.
        while let Some(pending) = wavefront.pending.pop() {
            let sample = pending.sample(&wavefront.filters);
            wavefront.deliver(pending.to, sample, samples);
        }
        wavefront.filters.clear();
    }

    /// Traces some rays of one wave.
    fn trace_wave(
        &self,
        rays: &[SecondaryRay],
        wavefront: &mut Wavefront,
        buffers: ShadeBuffers,
        samples: &mut PixelSamples,
    ) {
        let ShadeBuffers { scratch, cache } = buffers;
        let mut all = std::mem::take(&mut wavefront.all);
        all.hits.resize(rays.len().div_ceil(4), HitPacket4::NOTHING);
        for (rays, hits) in rays.chunks(BUNDLE).zip(all.hits.chunks_mut(BUNDLE / 4)) {
            let (world, scratch) = (self.world, &mut scratch.query);
            let are_first = rays.iter().all(SecondaryRay::is_camera_ray);
            let ray = |ray: usize| rays[ray].query.ray;
            if are_first && world.closest_hits_parallel(rays.len(), ray, hits, scratch) {
                continue;
            }
            for (rays, hits) in rays.chunks(8).zip(hits.chunks_mut(2)) {
                let query = |ray: usize| &rays[ray].query;
                world.nearest_of_stream(rays.len(), query, hits, scratch);
            }
        }
        // Otherwise each shadow ray is traced on its own.
        let traces = self.fast_paths.shadow_packets;
        self.light_all(rays.len(), traces, &mut all, scratch);
        with_widest(
            #[inline(always)]
            |_| {
                let mut seen = RadiancePacket4::NOTHING;
                for (packet, onwards) in rays.chunks(4).enumerate() {
                    let slice = RaySlice {
                        rays: onwards,
                        interior_stacks: &wavefront.interior_stacks,
                    };
                    let buffers = ShadeBuffers {
                        scratch: &mut *scratch,
                        cache: &mut *cache,
                    };
                    self.shade_packet4(&slice, packet, rays.len(), &all, buffers, &mut seen);
                    for (lane, onward) in onwards.iter().enumerate() {
                        let secondary = seen
                            .secondary(&all.hits[packet], lane)
                            .filter(|_| wavefront.has_capacity());
                        let sample = match (seen.sample(lane), secondary) {
                            (Some(sample), _) => sample,
                            (None, Some(secondary)) => {
                                self.queue_plain(
                                    wavefront,
                                    onward,
                                    &all.hits[packet],
                                    lane,
                                    &secondary,
                                    scratch,
                                );
                                continue;
                            }
                            (None, None) => {
                                let hit = all.hits[packet].hit(lane);
                                let known = LightSamples::at(&all, 4 * packet + lane);
                                match self.shade_or_queue(wavefront, onward, hit, known, scratch) {
                                    Some(sample) => sample,
                                    None => continue,
                                }
                            }
                        };
                        wavefront.deliver(onward.to, sample, samples);
                    }
                }
            },
        );
        wavefront.all = all;
    }

    /// Shades the hit of a secondary ray; `None` if its own secondary rays are queued.
    #[inline(never)]
    fn shade_or_queue(
        &self,
        wavefront: &mut Wavefront,
        incoming: &SecondaryRay,
        hit: Option<Hit>,
        known: LightSamples,
        scratch: &mut Scratch,
    ) -> Option<Sample> {
        let path = incoming.path(&wavefront.interior_stacks);
        let Some(hit) =
            hit.filter(|_| self.fast_paths.queues_all_surfaces && wavefront.has_capacity())
        else {
            return Some(self.trace(path, Some((hit, known)), scratch));
        };
        let surface = &self.world.surfaces[hit.surface as usize];
        let end = End::Surface(SegmentEnd {
            length: hit.t,
            surface: hit.spawn_surface,
            lights: surface.lights,
        });
        if let Some(plain) = self.shade_plain(&hit, path.ray.dir, known, scratch) {
            return Some(plain.behind_atmosphere(self.atmosphere(&path, end, scratch)));
        }
        let textures = self.textures_at(surface, &hit, path.ray.dir, TextureUse::Drawn);
        let [only @ WeightedTexture { weight: 1.0, .. }] = textures.as_slice() else {
            return Some(self.trace(path, Some((Some(hit), known)), scratch));
        };
        let shadow_cache = (only.texture.layers().len() > 1).then(ShadowCache::default);
        let of = TextureShading {
            texture: only,
            tilted: &mut None,
            shadow_cache: shadow_cache.as_ref(),
        };
        let (shaded, lit) = self.layers(&path, &hit, of, known, scratch);
        let atmosphere = self.atmosphere(&path, end, scratch);
        if !shaded.passes && shaded.mirrors.is_empty() {
            let sample = Sample {
                rgb: shaded.rgb + Rgb::BLACK,
                transmit: 0.0,
            };
            return Some(sample.behind_atmosphere(atmosphere));
        }
        if shaded.mirrors.len() > 1 {
            let again = incoming.path(&wavefront.interior_stacks);
            return Some(self.trace(again, Some((Some(hit), known)), scratch));
        }
        let spawn_point = SpawnPoint {
            at: lit.at,
            flat: facing_normal(&hit, path.ray.dir),
            spawn_surface: hit.spawn_surface,
            t: hit.t,
            surface: hit.surface,
        };
        let light = SurfaceLight {
            own: shaded.rgb,
            passing: shaded.passes.then_some(shaded.transmittance),
            mirror: shaded.mirrors.first(),
            film: shaded.film,
            atmosphere,
        };
        self.queue_secondary_rays(wavefront, incoming, &spawn_point, &light);
        None
    }
}

/// The number of pixels traced, lit and shaded together where the camera and all lights have light buffers.
pub(crate) const SMALL_BATCH: usize = 64;

/// The same batch size applies to scenes with more lights than this.
pub(crate) const MANY_LIGHTS: usize = 64;
