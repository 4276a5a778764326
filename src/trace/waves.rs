//! What surfaces show of others, in their mirror images and through them, for all places of a block together: the rays
//! that go on from what the camera sees are followed, lit and coloured as those of the camera are ([`super::block`]), then
//! those that go on from what these meet, and so on. Rays that split, surfaces of several textures or mirror images, and
//! scenes whose random numbers come one after the other are left to the way for single rays.

use super::air::{Air, End};
use super::arrived::Arrived;
use super::block::{AROUND, MANY_LIGHTS};
use super::coats::Coats;
use super::light::{KnownLights, Viewed};
use super::passage::{Bend, bend};
use super::plain_four::{FourSeen, Looking, Showing, viewed};
use super::shadows::Together;
use super::surface::{Mirror, Sight, facing_normal, mirror, mirrored_off};
use super::{Inside, MOST_PASSED, Path, Sample, Tracer};
use crate::color::Rgb;
use crate::compile::{Departure, FourHits, Hit, InteriorId, Query, Scratch, Seen};
use crate::math::Ray;
use crate::math::lanes::with_widest;
use crate::texture::{Irid, Look};
use glam::DVec3;

/// So many surfaces that show others are looked at together; behind those rays are followed one by one, which needs no
/// room for all the branches of a tree at once.
const MOST_SHOWN: usize = 1 << 13;

/// So many rays of a wave are searched for, lit and coloured together.
const MOST_AT_ONCE: usize = 1 << 10;

/// Buffers for what surfaces show.
#[derive(Debug, Default)]
pub(super) struct Waves {
    all: Together,
    /// The rays that are followed now.
    rays: Vec<Onward>,
    /// Those that go on from what these meet.
    next: Vec<Onward>,
    shown: Vec<Shown>,
    /// What a few of these need besides.
    filters: Vec<Filters>,
    /// What rays are in, those around the camera first.
    insides: Vec<Inside>,
}

/// A ray that goes on from a surface.
#[derive(Clone, Copy, Debug)]
struct Onward {
    query: Query,
    /// How many bends and mirrors lie behind it.
    level: u32,
    /// How many surfaces it has passed since then without a bend.
    passed: usize,
    /// The largest share that its colour can have in the sample.
    weight: f64,
    /// The number of what it is in.
    inside: usize,
    to: To,
}

/// Up to four of the rays of a wave.
struct Few<'a> {
    rays: &'a [Onward],
    insides: &'a [Inside],
}

/// Where a sample goes.
#[derive(Clone, Copy, Debug)]
enum To {
    /// To the place of this number.
    Place(usize),
    /// It is the mirror image in the surface of this number.
    Image(usize),
    /// It is behind the surface of this number.
    Behind(usize),
}

/// A surface that shows others.
#[derive(Clone, Copy, Debug)]
struct Shown {
    to: To,
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
    air: Option<Air>,
}

impl Filters {
    const NONE: Filters = Filters {
        on_image: Rgb::WHITE,
        on_behind: Rgb::WHITE,
        exponent: 1.0,
        air: None,
    };
}

impl Shown {
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
struct Surfaced {
    /// The point as it is viewed, with the normal of the top layer.
    at: Viewed,
    /// The normal without bumps.
    flat: DVec3,
    departure: Departure,
    /// How far the ray came to it.
    t: f64,
    surface: u32,
}

/// What a surface shows of itself, and how it shows others.
struct Light<'t> {
    /// Its own light.
    own: Rgb,
    /// The share of light that passes all layers, if that is worth following.
    passing: Option<Rgb>,
    mirror: Option<&'t Mirror<'t>>,
    /// The film on the top layer.
    film: Option<&'t Irid>,
    /// The air before it.
    air: Option<Air>,
}

impl Waves {
    /// Whether there is room for one more surface.
    #[inline(always)]
    pub(super) fn have_room(&self) -> bool {
        self.shown.len() < MOST_SHOWN
    }

    /// Tells a surface what it shows.
    fn tell(&mut self, to: To, sample: Sample, take: &mut impl FnMut(usize, Sample)) {
        match to {
            To::Place(place) => take(place, sample),
            To::Image(number) => self.shown[number].image = sample.rgb,
            To::Behind(number) => self.shown[number].behind = sample,
        }
    }
}

impl Looking for Few<'_> {
    fn seen(&self, lane: usize) -> Seen {
        self.rays[lane].query.seen
    }

    fn all_seen(&self) -> Option<Seen> {
        let first = self.rays[0].query.seen;
        let are_same = self.rays.iter().all(|onward| onward.query.seen == first);
        are_same.then_some(first)
    }

    fn inside(&self, lane: usize) -> &[InteriorId] {
        &self.insides[self.rays[lane].inside]
    }

    fn path(&self, lane: usize, _dir: DVec3) -> Path {
        self.rays[lane].path(self.insides)
    }
}

impl Onward {
    /// A question about the nearest surface on a ray.
    fn query(ray: Ray, from: Option<Departure>, seen: Seen) -> Query {
        Query {
            ray,
            from,
            far: f64::INFINITY,
            seen,
        }
    }

    fn path(&self, insides: &[Inside]) -> Path {
        Path {
            ray: self.query.ray,
            from: self.query.from,
            seen: self.query.seen,
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
    pub(super) fn begin_wave(
        &self,
        waves: &mut Waves,
        place: usize,
        (hits, lane): (&FourHits, usize),
        showing: &Showing,
        scratch: &mut Scratch,
    ) {
        let onward = self.camera_ray(waves, place, hits.dir(lane));
        self.show(waves, &onward, (hits, lane), showing, scratch);
    }

    /// The ray of the camera in this direction, which has met something at a place.
    fn camera_ray(&self, waves: &mut Waves, place: usize, dir: DVec3) -> Onward {
        if waves.insides.is_empty() {
            waves.insides.push(Inside::from_slice(&self.around_camera));
        }
        let ray = Ray::new(self.world.camera.location(), dir);
        Onward {
            query: Onward::query(ray, None, Seen::Image),
            level: 0,
            passed: 0,
            weight: 1.0,
            inside: 0,
            to: To::Place(place),
        }
    }

    /// Notes a ray of the camera, which is followed with those that go on from surfaces.
    pub(super) fn begin_ray(&self, waves: &mut Waves, place: usize, ray: Ray) {
        let path = self.camera_path(ray);
        if waves.insides.last() != Some(&path.inside) {
            waves.insides.push(path.inside);
        }
        waves.next.push(Onward {
            query: Onward::query(ray, None, path.seen),
            level: path.level,
            passed: 0,
            weight: path.weight,
            inside: waves.insides.len() - 1,
            to: To::Place(place),
        });
    }

    /// What a ray of the camera in this direction sees at a place, where something is known of its hit; nothing if it is
    /// noted what goes on from there.
    pub(super) fn seen_by_camera(
        &self,
        waves: &mut Waves,
        place: usize,
        (dir, hit, known): (DVec3, Option<Hit>, KnownLights),
        scratch: &mut Scratch,
    ) -> Option<Sample> {
        let onward = self.camera_ray(waves, place, dir);
        self.seen_by(waves, &onward, (hit, known), scratch)
    }

    /// Notes the rays that go on from a plain surface that such a ray meets.
    fn show(
        &self,
        waves: &mut Waves,
        met: &Onward,
        (hits, lane): (&FourHits, usize),
        showing: &Showing,
        scratch: &mut Scratch,
    ) {
        let finish = showing.finish;
        let at = viewed(hits, lane);
        let surfaced = Surfaced {
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
            let mut mirror = mirror(&at, at.normal, (finish, showing.pigment), ior);
            mirror.weight *= f64::from(filter.grey());
            if finish.conserve_energy {
                filter *= mirror.reflectivity.map(|r| (1.0 - r).min(1.0));
            }
            image = Some(mirror);
        }
        filter *= showing.through;
        let light = Light {
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
    fn go_on(&self, waves: &mut Waves, met: &Onward, from: &Surfaced, light: &Light) {
        let at = &from.at;
        let mut filters = light.air.map(|air| Filters {
            air: Some(air),
            ..Filters::NONE
        });
        let number = waves.shown.len();
        let mut shown = Shown {
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
        let onward =
            |dir: DVec3, seen: Seen| Onward::query(Ray::new(at.point, dir), departure, seen);
        let seen_in_mirror = met.query.seen.mirrored();
        let level = met.level + 1;
        let mut mirror = light.mirror;
        if let Some(filter) = light.passing {
            let before = (&waves.insides[met.inside], from.t);
            let interior = self.world.surfaces[from.surface as usize].interior;
            let through = self.through(before, interior, filter, None);
            shown.factor = through.factor;
            shown.transmit = through.transmit;
            let weight = met.weight * through.weight;
            let to = To::Behind(number);
            let bend = bend(at.view, at.normal, through.passage.ratio);
            match bend {
                Bend::None | Bend::To(_) => {
                    let (dir, level, passed) = match bend {
                        Bend::To(dir) => (dir, level, 0),
                        _ => (at.view, met.level, met.passed + 1),
                    };
                    waves.next.push(Onward {
                        query: onward(dir, met.query.seen),
                        level,
                        passed,
                        weight,
                        inside: waves.insides.len(),
                        to,
                    });
                    waves.insides.push(through.passage.inside);
                }
                Bend::Total => {
                    shown.factor = through.thrown_back;
                    shown.transmit = 0.0;
                    mirror = None;
                    let dir = mirrored_off(at.view, at.normal, from.flat);
                    if let Some(film) = light.film.filter(|film| film.amount > 0.0) {
                        let film = self.film(film, at, dir);
                        filters.get_or_insert(Filters::NONE).on_behind = film;
                    }
                    waves.next.push(Onward {
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
            waves.next.push(Onward {
                query: onward(mirror.dir, seen_in_mirror),
                level,
                passed: 0,
                weight: met.weight * mirror.weight,
                inside: met.inside,
                to: To::Image(number),
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
    pub(super) fn follow_waves(
        &self,
        waves: &mut Waves,
        (scratch, coats): (&mut Scratch, &mut Coats),
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
                self.follow_wave(rays, waves, (scratch, coats), &mut take);
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
    fn follow_wave(
        &self,
        rays: &[Onward],
        waves: &mut Waves,
        (scratch, coats): (&mut Scratch, &mut Coats),
        take: &mut impl FnMut(usize, Sample),
    ) {
        let mut all = std::mem::take(&mut waves.all);
        all.hits.resize(rays.len().div_ceil(4), FourHits::NOTHING);
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
                let mut seen = FourSeen::NOTHING;
                for (four, onwards) in rays.chunks(4).enumerate() {
                    let few = Few {
                        rays: onwards,
                        insides: &waves.insides,
                    };
                    let kept = (&mut *scratch, &mut *coats);
                    self.plain_four(&few, (four, rays.len()), &all, kept, &mut seen);
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
                                let known = KnownLights::at(&all, 4 * four + lane);
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
        waves: &mut Waves,
        met: &Onward,
        (hit, known): (Option<Hit>, KnownLights),
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
        let looks = self.looks(surface, &hit, path.ray.dir, Sight::Drawn);
        let [only @ Look { weight: 1.0, .. }] = looks.as_slice() else {
            return Some(self.trace(path, Some((Some(hit), known)), scratch));
        };
        let arrived = (only.texture.layers().len() > 1).then(Arrived::default);
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
        let surfaced = Surfaced {
            at: lit.at,
            flat: facing_normal(&hit, path.ray.dir),
            departure: hit.departure,
            t: hit.t,
            surface: hit.surface,
        };
        let light = Light {
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
