//! What plain surfaces show of others, in their mirror images and through them, for all places of a block together: the
//! rays that go on from what the camera sees are followed, lit and coloured as those of the camera are
//! ([`super::block`]), then those that go on from what these meet, and so on. What is not plain is left to the way for
//! single rays.

use super::block::{AROUND, MANY_LIGHTS};
use super::coats::Coats;
use super::passage::{Bend, bend};
use super::plain_four::{FourSeen, Looking, Showing, viewed};
use super::shadows::Together;
use super::surface::{mirror, mirrored_off};
use super::{Inside, MOST_PASSED, Path, Sample, Tracer};
use crate::color::Rgb;
use crate::compile::{Departure, FourHits, InteriorId, Query, Scratch, Seen};
use crate::math::Ray;
use crate::math::lanes::with_widest;
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
}

impl Shown {
    /// What is seen there, once it is known what it shows.
    fn sample(&self) -> Sample {
        let reflected = Rgb::BLACK + self.image * self.reflectivity;
        Sample {
            rgb: self.own + self.factor * self.behind.rgb + reflected,
            transmit: self.transmit * self.behind.transmit,
        }
    }
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
    ) {
        if waves.insides.is_empty() {
            waves.insides.push(Inside::from_slice(&self.around_camera));
        }
        let ray = Ray::new(self.world.camera.location(), hits.dir(lane));
        let onward = Onward {
            query: Onward::query(ray, None, Seen::Image),
            level: 0,
            passed: 0,
            weight: 1.0,
            inside: 0,
            to: To::Place(place),
        };
        self.show(waves, &onward, (hits, lane), showing);
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

    /// Notes the rays that go on from a surface that such a ray meets.
    fn show(
        &self,
        waves: &mut Waves,
        met: &Onward,
        (hits, lane): (&FourHits, usize),
        showing: &Showing,
    ) {
        let finish = showing.finish;
        let at = viewed(hits, lane);
        let number = waves.shown.len();
        let mut shown = Shown {
            to: met.to,
            own: showing.own,
            factor: Rgb::BLACK,
            transmit: 0.0,
            reflectivity: Rgb::BLACK,
            behind: Sample::BLACK,
            image: Rgb::BLACK,
        };
        let departure = Some(hits.departure(lane));
        let onward =
            |dir: DVec3, seen: Seen| Onward::query(Ray::new(at.point, dir), departure, seen);
        let seen_in_mirror = met.query.seen.mirrored();
        let level = met.level + 1;
        let interior = || self.world.surfaces[hits.surface[lane] as usize].interior;
        let mut filter = Rgb::WHITE;
        let mut image = None;
        if finish.has_reflection() {
            let ior = || self.relative_ior(&waves.insides[met.inside], interior());
            let mirror = mirror(&at, at.normal, (finish, showing.pigment), ior);
            let weight = mirror.weight * f64::from(filter.grey());
            image = Some(Onward {
                query: onward(mirror.dir, seen_in_mirror),
                level,
                passed: 0,
                weight: met.weight * weight,
                inside: met.inside,
                to: To::Image(number),
            });
            shown.reflectivity = mirror.reflectivity;
            if finish.conserve_energy {
                filter *= mirror.reflectivity.map(|r| (1.0 - r).min(1.0));
            }
        }
        filter *= showing.through;
        if !self.is_opaque(0, filter) {
            let before = (&waves.insides[met.inside], hits.t[lane]);
            let through = self.through(before, interior(), filter, None);
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
                    image = None;
                    let dir = mirrored_off(at.view, at.normal, at.normal);
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
        waves.next.extend(image);
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
            waves.tell(shown.to, shown.sample(), &mut take);
        }
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
        for (rays, hits) in rays.chunks(4).zip(&mut all.hits) {
            let queries = rays.iter().map(|onward| &onward.query);
            self.world.nearest_of_four(queries, hits, scratch);
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
                                self.show(waves, onward, (&all.hits[four], lane), &showing);
                                continue;
                            }
                            (None, None) => {
                                let path = onward.path(&waves.insides);
                                self.seen_by(path, (&all, 4 * four + lane), scratch)
                            }
                        };
                        waves.tell(onward.to, sample, take);
                    }
                }
            },
        );
        waves.all = all;
    }

    /// What a ray sees that has met what these hits say at this number.
    #[inline(never)]
    fn seen_by(
        &self,
        path: Path,
        (all, number): (&Together, usize),
        scratch: &mut Scratch,
    ) -> Sample {
        let hit = all.hits[number / 4].hit(number % 4);
        self.trace(path, Some((hit, &all.known(number))), scratch)
    }
}
