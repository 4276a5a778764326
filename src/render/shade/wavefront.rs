//! What surfaces show of others, in their mirror images and through them, for all places of a block together: the rays
//! that go on from what the camera sees are followed, lit and coloured as those of the camera are ([`super::block`]), then
//! those that go on from what these meet, and so on. Rays that split, surfaces of several textures or mirror images, and
//! scenes whose random numbers come one after the other are left to the way for single rays.

use super::atmosphere::{AirTint, End};
use super::block::{AROUND, MANY_LIGHTS};
use super::direct::block::BlockHits;
use super::direct::light::{LightSamples, ViewPoint};
use super::direct::packet::{RadiancePacket4, RaySource, SecondarySurface, viewed};
use super::direct::shadow_cache::ShadowCache;
use super::interior_stack::{Refraction, bend};
use super::shade_cache::ShadeCache;
use super::surface::{Mirror, TextureUse, facing_normal, mirror, mirrored_off};
use super::{Inside, MOST_PASSED, Path, Sample, Tracer};
use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::base::math::simd::with_widest;
use crate::scene::texture::{Irid, Look};
use crate::world::{Hit, HitPacket4, InteriorId, Query, RayKind, Scratch, SpawnSurface};
use glam::DVec3;

/// So many surfaces that show others are looked at together; behind those rays are followed one by one, which needs no
/// room for all the branches of a tree at once.
const MOST_SHOWN: usize = 1 << 13;

/// So many rays of a wave are searched for, lit and coloured together.
const MOST_AT_ONCE: usize = 1 << 10;

/// Buffers for what surfaces show.
#[derive(Debug, Default)]
pub(super) struct Wavefront {
    all: BlockHits,
    /// The rays that are followed now.
    rays: Vec<SecondaryRay>,
    /// Those that go on from what these meet.
    next: Vec<SecondaryRay>,
    shown: Vec<PendingSurface>,
    /// What a few of these need besides.
    filters: Vec<Filters>,
    /// What rays are in, those around the camera first.
    insides: Vec<Inside>,
}

/// A ray that goes on from a surface.
#[derive(Clone, Copy, Debug)]
struct SecondaryRay {
    query: Query,
    /// How many bends and mirrors lie behind it.
    level: u32,
    /// How many surfaces it has passed since then without a bend.
    passed: usize,
    /// The largest share that its colour can have in the sample.
    weight: f64,
    /// The number of what it is in.
    inside: usize,
    to: Destination,
}

/// Up to four of the rays of a wave.
struct RaySlice<'a> {
    rays: &'a [SecondaryRay],
    insides: &'a [Inside],
}

/// Where a sample goes.
#[derive(Clone, Copy, Debug)]
enum Destination {
    /// To the place of this number.
    Place(usize),
    /// It is the mirror image in the surface of this number.
    Image(usize),
    /// It is behind the surface of this number.
    Behind(usize),
}

/// A surface that shows others.
#[derive(Clone, Copy, Debug)]
struct PendingSurface {
    to: Destination,
    /// Its own light.
    own: Rgb,
    /// The factor on light from behind.
    factor: Rgb,
    /// The factor on the transparency of what is behind.
    transmit: f32,
    reflectivity: Rgb,
    behind: Sample,
    image: Rgb,
    /// The number of its filters, if it has any.
    filters: Option<u32>,
}

/// What colours light that a surface shows, besides its reflectivity and transmission.
#[derive(Clone, Copy, Debug)]
struct Filters {
    /// The factor of a thin film on the mirror image, and on what is behind.
    on_image: Rgb,
    on_behind: Rgb,
    /// The exponent of the mirror image.
    exponent: f32,
    /// The air before the surface.
    air: Option<AirTint>,
}

impl Filters {
    const NONE: Filters = Filters {
        on_image: Rgb::WHITE,
        on_behind: Rgb::WHITE,
        exponent: 1.0,
        air: None,
    };
}

impl PendingSurface {
    /// What is seen there, once it is known what it shows.
    fn sample(&self, filters: &[Filters]) -> Sample {
        let (mut image, mut behind, mut air) = (self.image, self.behind.rgb, None);
        if let Some(filters) = self.filters.and_then(|number| filters.get(number as usize)) {
            image *= filters.on_image;
            if filters.exponent != 1.0 {
                image = image.map(|c| c.powf(1.0 / filters.exponent));
            }
            behind *= filters.on_behind;
            air = filters.air;
        }
        let reflected = Rgb::BLACK + image * self.reflectivity;
        Sample {
            rgb: self.own + self.factor * behind + reflected,
            transmit: self.transmit * self.behind.transmit,
        }
        .through(air)
    }
}

/// A point of a surface from which rays go on.
struct SpawnPoint {
    /// The point as it is viewed, with the normal of the top layer.
    at: ViewPoint,
    /// The normal without bumps.
    flat: DVec3,
    departure: SpawnSurface,
    /// How far the ray came to it.
    t: f64,
    surface: u32,
}

/// What a surface shows of itself, and how it shows others.
struct SurfaceLight<'t> {
    /// Its own light.
    own: Rgb,
    /// The share of light that passes all layers, if that is worth following.
    passing: Option<Rgb>,
    mirror: Option<&'t Mirror<'t>>,
    /// The film on the top layer.
    film: Option<&'t Irid>,
    /// The air before it.
    air: Option<AirTint>,
}

impl Wavefront {
    /// Whether there is room for one more surface.
    #[inline(always)]
    pub(super) fn have_room(&self) -> bool {
        self.shown.len() < MOST_SHOWN
    }

    /// Tells a surface what it shows.
    fn tell(&mut self, to: Destination, sample: Sample, take: &mut impl FnMut(usize, Sample)) {
        match to {
            Destination::Place(place) => take(place, sample),
            Destination::Image(number) => self.shown[number].image = sample.rgb,
            Destination::Behind(number) => self.shown[number].behind = sample,
        }
    }
}

impl RaySource for RaySlice<'_> {
    fn seen(&self, lane: usize) -> RayKind {
        self.rays[lane].query.kind
    }

    fn all_seen(&self) -> Option<RayKind> {
        let first = self.rays[0].query.kind;
        let are_same = self.rays.iter().all(|onward| onward.query.kind == first);
        are_same.then_some(first)
    }

    fn inside(&self, lane: usize) -> &[InteriorId] {
        &self.insides[self.rays[lane].inside]
    }

    fn path(&self, lane: usize, _dir: DVec3) -> Path {
        self.rays[lane].path(self.insides)
    }
}

impl SecondaryRay {
    /// A question about the nearest surface on a ray.
    fn query(ray: Ray, from: Option<SpawnSurface>, seen: RayKind) -> Query {
        Query {
            ray,
            origin_surface: from,
            t_max: f64::INFINITY,
            kind: seen,
        }
    }

    fn path(&self, insides: &[Inside]) -> Path {
        Path {
            ray: self.query.ray,
            from: self.query.origin_surface,
            seen: self.query.kind,
            level: self.level,
            weight: self.weight,
            gathered: 0,
            inside: Inside::from_slice(&insides[self.inside]),
            wavelength: None,
        }
    }
}

impl Tracer<'_> {
    /// Notes that a ray of the camera meets a surface that shows others at a place, in this lane of these hits.
    #[inline(never)]
    pub(super) fn begin_wavefront(
        &self,
        waves: &mut Wavefront,
        place: usize,
        (hits, lane): (&HitPacket4, usize),
        showing: &SecondarySurface,
        scratch: &mut Scratch,
    ) {
        let onward = self.camera_ray(waves, place, hits.dir(lane));
        self.show(waves, &onward, (hits, lane), showing, scratch);
    }

    /// The ray of the camera in this direction, which has met something at a place.
    fn camera_ray(&self, waves: &mut Wavefront, place: usize, dir: DVec3) -> SecondaryRay {
        if waves.insides.is_empty() {
            waves.insides.push(Inside::from_slice(&self.around_camera));
        }
        let ray = Ray::new(self.world.camera.location(), dir);
        SecondaryRay {
            query: SecondaryRay::query(ray, None, RayKind::Camera),
            level: 0,
            passed: 0,
            weight: 1.0,
            inside: 0,
            to: Destination::Place(place),
        }
    }

    /// Notes a ray of the camera, which is followed with those that go on from surfaces.
    pub(super) fn begin_ray(&self, waves: &mut Wavefront, place: usize, ray: Ray) {
        let path = self.camera_path(ray);
        if waves.insides.last() != Some(&path.inside) {
            waves.insides.push(path.inside);
        }
        waves.next.push(SecondaryRay {
            query: SecondaryRay::query(ray, None, path.seen),
            level: path.level,
            passed: 0,
            weight: path.weight,
            inside: waves.insides.len() - 1,
            to: Destination::Place(place),
        });
    }

    /// What a ray of the camera in this direction sees at a place, where something is known of its hit; nothing if it is
    /// noted what goes on from there.
    pub(super) fn seen_by_camera(
        &self,
        waves: &mut Wavefront,
        place: usize,
        (dir, hit, known): (DVec3, Option<Hit>, LightSamples),
        scratch: &mut Scratch,
    ) -> Option<Sample> {
        let onward = self.camera_ray(waves, place, dir);
        self.seen_by(waves, &onward, (hit, known), scratch)
    }

    /// Notes the rays that go on from a plain surface that such a ray meets.
    fn show(
        &self,
        waves: &mut Wavefront,
        met: &SecondaryRay,
        (hits, lane): (&HitPacket4, usize),
        showing: &SecondarySurface,
        scratch: &mut Scratch,
    ) {
        let finish = showing.finish;
        let at = viewed(hits, lane);
        let surfaced = SpawnPoint {
            at,
            flat: at.normal,
            departure: hits.departure(lane),
            t: hits.t[lane],
            surface: hits.surface[lane],
        };
        let mut filter = Rgb::WHITE;
        let mut image = None;
        if finish.has_reflection() {
            let interior = self.world.surfaces[surfaced.surface as usize].interior;
            let ior = || self.relative_ior(&waves.insides[met.inside], interior);
            let mirror = mirror(&at, at.normal, (finish, showing.pigment), ior);
            if finish.conserve_energy {
                filter *= mirror.reflectivity.map(|r| (1.0 - r).min(1.0));
            }
            image = Some(mirror);
        }
        filter *= showing.through;
        let light = SurfaceLight {
            own: showing.own,
            passing: (!self.is_opaque(0, filter)).then_some(filter),
            mirror: image.as_ref(),
            film: None,
            air: self.air_before(hits, lane, || met.path(&waves.insides), scratch),
        };
        self.go_on(waves, met, &surfaced, &light);
    }

    /// Notes the rays that go on from a surface that such a ray meets: through it and into its mirror image.
    #[inline(always)]
    fn go_on(
        &self,
        waves: &mut Wavefront,
        met: &SecondaryRay,
        from: &SpawnPoint,
        light: &SurfaceLight,
    ) {
        let at = &from.at;
        let mut filters = light.air.map(|air| Filters {
            air: Some(air),
            ..Filters::NONE
        });
        let number = waves.shown.len();
        let mut shown = PendingSurface {
            to: met.to,
            own: light.own,
            factor: Rgb::BLACK,
            transmit: 0.0,
            reflectivity: Rgb::BLACK,
            behind: Sample::BLACK,
            image: Rgb::BLACK,
            filters: None,
        };
        let departure = Some(from.departure);
        let onward = |dir: DVec3, seen: RayKind| {
            SecondaryRay::query(Ray::new(at.point, dir), departure, seen)
        };
        let seen_in_mirror = met.query.kind.mirrored();
        let level = met.level + 1;
        let mut mirror = light.mirror;
        if let Some(filter) = light.passing {
            let before = (&waves.insides[met.inside], from.t);
            let interior = self.world.surfaces[from.surface as usize].interior;
            let through = self.through(before, interior, filter, None);
            shown.factor = through.factor;
            shown.transmit = through.transmit;
            let weight = met.weight * through.weight;
            let to = Destination::Behind(number);
            let bend = bend(at.view, at.normal, through.passage.ratio);
            match bend {
                Refraction::None | Refraction::To(_) => {
                    let (dir, level, passed) = match bend {
                        Refraction::To(dir) => (dir, level, 0),
                        _ => (at.view, met.level, met.passed + 1),
                    };
                    waves.next.push(SecondaryRay {
                        query: onward(dir, met.query.kind),
                        level,
                        passed,
                        weight,
                        inside: waves.insides.len(),
                        to,
                    });
                    waves.insides.push(through.passage.inside);
                }
                Refraction::Total => {
                    shown.factor = through.thrown_back;
                    shown.transmit = 0.0;
                    mirror = None;
                    let dir = mirrored_off(at.view, at.normal, from.flat);
                    if let Some(film) = light.film.filter(|film| film.amount > 0.0) {
                        let film = self.film(film, at, dir);
                        filters.get_or_insert(Filters::NONE).on_behind = film;
                    }
                    waves.next.push(SecondaryRay {
                        query: onward(dir, seen_in_mirror),
                        level,
                        passed: 0,
                        weight,
                        inside: met.inside,
                        to,
                    });
                }
            }
        }
        if let Some(mirror) = mirror {
            shown.reflectivity = mirror.reflectivity;
            let exponent = mirror.finish.reflection.exponent;
            if exponent != 1.0 {
                filters.get_or_insert(Filters::NONE).exponent = exponent;
            }
            let irid = &mirror.finish.irid;
            if irid.amount > 0.0 {
                filters.get_or_insert(Filters::NONE).on_image = self.film(irid, at, mirror.dir);
            }
            waves.next.push(SecondaryRay {
                query: onward(mirror.dir, seen_in_mirror),
                level,
                passed: 0,
                weight: met.weight * mirror.weight,
                inside: met.inside,
                to: Destination::Image(number),
            });
        }
        if let Some(filters) = filters {
            shown.filters = u32::try_from(waves.filters.len()).ok();
            waves.filters.push(filters);
        }
        waves.shown.push(shown);
    }

    /// Finds out what the surfaces show that have been noted. `take` gets the number of each of their places and what is
    /// seen there.
    pub(super) fn follow_wavefronts(
        &self,
        waves: &mut Wavefront,
        (scratch, coats): (&mut Scratch, &mut ShadeCache),
        mut take: impl FnMut(usize, Sample),
    ) {
        while !waves.next.is_empty() {
            std::mem::swap(&mut waves.rays, &mut waves.next);
            waves.next.clear();
            // What is not worth following shows nothing, as is noted already. At the last level nothing is seen through a
            // surface, bent or not.
            let (most, least) = (self.world.globals.max_trace_level, self.bailout(0));
            waves.rays.retain(|onward| {
                let is_past = onward.passed > 0 && onward.level + 1 >= most;
                let is_worth = onward.level < most && onward.weight >= least && !is_past;
                is_worth && onward.passed < MOST_PASSED
            });
            if self.stop.is_asked() {
                waves.rays.clear();
            }
            // The ways to many lights would take much room.
            let at_once = match self.world.lights.len() > MANY_LIGHTS {
                true => AROUND,
                false => MOST_AT_ONCE,
            };
            let rays = std::mem::take(&mut waves.rays);
            for rays in rays.chunks(at_once) {
                self.follow_wavefront(rays, waves, (scratch, coats), &mut take);
            }
            waves.rays = rays;
        }
        waves.insides.clear();
        // Those that are shown come behind those that show them.
        while let Some(shown) = waves.shown.pop() {
            let sample = shown.sample(&waves.filters);
            waves.tell(shown.to, sample, &mut take);
        }
        waves.filters.clear();
    }

    /// Follows these rays of one wave.
    fn follow_wavefront(
        &self,
        rays: &[SecondaryRay],
        waves: &mut Wavefront,
        (scratch, coats): (&mut Scratch, &mut ShadeCache),
        take: &mut impl FnMut(usize, Sample),
    ) {
        let mut all = std::mem::take(&mut waves.all);
        all.hits.resize(rays.len().div_ceil(4), HitPacket4::NOTHING);
        for (rays, hits) in rays.chunks(8).zip(all.hits.chunks_mut(2)) {
            let query = |ray: usize| &rays[ray].query;
            self.world
                .nearest_of_stream(rays.len(), query, hits, scratch);
        }
        // Where much is filtered each way is looked at alone.
        self.light_all(rays.len(), self.world.is_opaque(), &mut all, scratch);
        with_widest(
            #[inline(always)]
            |_| {
                let mut seen = RadiancePacket4::NOTHING;
                for (four, onwards) in rays.chunks(4).enumerate() {
                    let few = RaySlice {
                        rays: onwards,
                        insides: &waves.insides,
                    };
                    let kept = (&mut *scratch, &mut *coats);
                    self.shade_packet4(&few, (four, rays.len()), &all, kept, &mut seen);
                    for (lane, onward) in onwards.iter().enumerate() {
                        let showing = seen.showing(lane).filter(|_| waves.have_room());
                        let sample = match (seen.sample(lane), showing) {
                            (Some(sample), _) => sample,
                            (None, Some(showing)) => {
                                self.show(
                                    waves,
                                    onward,
                                    (&all.hits[four], lane),
                                    &showing,
                                    scratch,
                                );
                                continue;
                            }
                            (None, None) => {
                                let hit = all.hits[four].hit(lane);
                                let known = LightSamples::at(&all, 4 * four + lane);
                                match self.seen_by(waves, onward, (hit, known), scratch) {
                                    Some(sample) => sample,
                                    None => continue,
                                }
                            }
                        };
                        waves.tell(onward.to, sample, take);
                    }
                }
            },
        );
        waves.all = all;
    }

    /// What a ray sees that has met this, where something is known of the lights there; nothing if it is noted what goes
    /// on from there.
    #[inline(never)]
    fn seen_by(
        &self,
        waves: &mut Wavefront,
        met: &SecondaryRay,
        (hit, known): (Option<Hit>, LightSamples),
        scratch: &mut Scratch,
    ) -> Option<Sample> {
        let path = met.path(&waves.insides);
        let Some(hit) = hit.filter(|_| self.queues && waves.have_room()) else {
            return Some(self.trace(path, Some((hit, known)), scratch));
        };
        let surface = &self.world.surfaces[hit.surface as usize];
        let end = End::Surface(hit.t, surface.lights);
        if let Some(plain) = self.plain(&hit, path.ray.dir, known, scratch) {
            return Some(plain.through(self.air(&path, end, scratch)));
        }
        let looks = self.looks(surface, &hit, path.ray.dir, TextureUse::Drawn);
        let [only @ Look { weight: 1.0, .. }] = looks.as_slice() else {
            return Some(self.trace(path, Some((Some(hit), known)), scratch));
        };
        let arrived = (only.texture.layers().len() > 1).then(ShadowCache::default);
        let of = (only, &mut None, arrived.as_ref());
        let (shaded, lit) = self.layers(&path, &hit, of, known, scratch);
        let air = self.air(&path, end, scratch);
        if !shaded.passes && shaded.mirrors.is_empty() {
            let sample = Sample {
                rgb: shaded.rgb + Rgb::BLACK,
                transmit: 0.0,
            };
            return Some(sample.through(air));
        }
        if shaded.mirrors.len() > 1 {
            let again = met.path(&waves.insides);
            return Some(self.trace(again, Some((Some(hit), known)), scratch));
        }
        let surfaced = SpawnPoint {
            at: lit.at,
            flat: facing_normal(&hit, path.ray.dir),
            departure: hit.departure,
            t: hit.t,
            surface: hit.surface,
        };
        let light = SurfaceLight {
            own: shaded.rgb,
            passing: shaded.passes.then_some(shaded.filter),
            mirror: shaded.mirrors.first(),
            film: shaded.film,
            air,
        };
        self.go_on(waves, met, &surfaced, &light);
        None
    }
}
