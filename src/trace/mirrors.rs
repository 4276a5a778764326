//! What plain mirrors show, for all places of a block together: the rays off the mirrors that the camera sees are followed,
//! lit and coloured as those of the camera are ([`super::block`]), then those off the mirrors seen in these, and so on.
//! What is met that is not plain is left to the way for single rays.

use super::light::Viewed;
use super::shadows::Together;
use super::surface::mirror;
use super::{Path, Sample, Tracer, begin_sample};
use crate::color::Rgb;
use crate::compile::{Departure, FourHits, Query, Scratch, Seen};
use crate::math::Ray;
use crate::math::lanes::with_widest;
use crate::texture::Finish;
use smallvec::SmallVec;

/// The number of no mirror.
const NO_MIRROR: u32 = u32::MAX;

/// Buffers for what mirrors show.
#[derive(Debug, Default)]
pub(super) struct Mirrored {
    all: Together,
    /// The rays off the mirrors of one level.
    rays: Vec<Off>,
    /// Those off the mirrors that these meet.
    next: Vec<Off>,
    mirrors: Vec<Mirror>,
}

/// A ray off a mirror.
#[derive(Clone, Copy, Debug)]
struct Off {
    ray: Ray,
    from: Departure,
    /// The largest share that its colour can have in the sample.
    weight: f64,
    /// The number of the mirror.
    mirror: u32,
}

/// A mirror that is seen.
#[derive(Clone, Copy, Debug)]
struct Mirror {
    /// The number of the place.
    place: usize,
    /// The number of the mirror in which it is seen.
    within: u32,
    /// What is seen of it without its image.
    own: Rgb,
    reflectivity: Rgb,
}

impl Mirrored {
    /// Notes that the camera sees a mirror at a place, in this lane of these hits: its colour without its image, its finish
    /// and the colour of its pigment.
    pub(super) fn begin(
        &mut self,
        place: usize,
        at: (&FourHits, usize),
        seen: (Rgb, &Finish, Rgb),
    ) {
        self.note((place, NO_MIRROR, 1.0), at, seen);
    }

    /// The same of one that is seen within another, or none, by a ray of this weight.
    #[inline(never)]
    fn note(
        &mut self,
        (place, within, weight): (usize, u32, f64),
        (hits, lane): (&FourHits, usize),
        (own, finish, pigment): (Rgb, &Finish, Rgb),
    ) {
        let at = Viewed {
            point: hits.point(lane),
            normal: hits.facing(lane),
            view: hits.dir(lane),
        };
        // The images of plain mirrors do not hang on what lies behind them.
        let image = mirror(&at, at.normal, (finish, pigment), || 1.0);
        #[allow(
            clippy::cast_possible_truncation,
            reason = "a block has few places, and a ray few levels"
        )]
        let number = self.mirrors.len() as u32;
        self.next.push(Off {
            ray: Ray::new(at.point, image.dir),
            from: hits.departure(lane),
            weight: weight * (image.weight * f64::from(Rgb::WHITE.grey())),
            mirror: number,
        });
        self.mirrors.push(Mirror {
            place,
            within,
            own,
            reflectivity: image.reflectivity,
        });
    }
}

/// Where a sample that is seen in the mirror of this number is seen after all, and as what.
fn seen_in(mirrors: &[Mirror], mut number: u32, mut sample: Sample) -> (usize, Sample) {
    loop {
        let mirror = &mirrors[number as usize];
        sample = Sample {
            rgb: mirror.own + (Rgb::BLACK + sample.rgb * mirror.reflectivity),
            transmit: 0.0,
        };
        number = mirror.within;
        if number == NO_MIRROR {
            return (mirror.place, sample);
        }
    }
}

impl Tracer<'_> {
    /// Finds out what the mirrors show that have been noted. `take` gets the number of each of their places and what is
    /// seen there.
    pub(super) fn look_into(
        &self,
        mirrored: &mut Mirrored,
        places: &[(f64, f64)],
        scratch: &mut Scratch,
        mut take: impl FnMut(usize, Sample),
    ) {
        let mut level = 0;
        while !mirrored.next.is_empty() {
            level += 1;
            std::mem::swap(&mut mirrored.rays, &mut mirrored.next);
            mirrored.next.clear();
            let (worth, mirrors) = (&mut mirrored.rays, &mirrored.mirrors);
            worth.retain(|off| {
                let is_worth = self.is_worth((level, off.weight), 0);
                if !is_worth {
                    let (place, sample) = seen_in(mirrors, off.mirror, Sample::BLACK);
                    take(place, sample);
                }
                is_worth
            });
            self.look_into_level(level, mirrored, places, scratch, &mut take);
        }
        mirrored.mirrors.clear();
    }

    /// The same for the mirrors of one level.
    fn look_into_level(
        &self,
        level: u32,
        mirrored: &mut Mirrored,
        places: &[(f64, f64)],
        scratch: &mut Scratch,
        take: &mut impl FnMut(usize, Sample),
    ) {
        let rays = std::mem::take(&mut mirrored.rays);
        let hits = &mut mirrored.all.hits;
        hits.resize(rays.len().div_ceil(4), FourHits::NOTHING);
        for (rays, hits) in rays.chunks(4).zip(hits) {
            let queries: SmallVec<[Query; 4]> = rays.iter().map(Off::query).collect();
            self.world.nearest_of_four(&queries, hits, scratch);
        }
        self.light_all(rays.len(), &mut mirrored.all, scratch);
        with_widest(
            #[inline(always)]
            |_| {
                for (four, offs) in rays.chunks(4).enumerate() {
                    let seen = self.plain_four(Off::SEEN, four, rays.len(), &mirrored.all);
                    for (lane, off) in offs.iter().enumerate() {
                        let place = mirrored.mirrors[off.mirror as usize].place;
                        let sample = match (seen.sample(lane), seen.mirror(lane)) {
                            (Some(sample), _) => sample,
                            (None, Some(mirror)) => {
                                let hits = mirrored.all.hits[four];
                                let of = (place, off.mirror, off.weight);
                                mirrored.note(of, (&hits, lane), mirror);
                                continue;
                            }
                            (None, None) => {
                                begin_sample(places[place].0, places[place].1, scratch);
                                let all = (&mirrored.all, 4 * four + lane);
                                self.seen_off(off, level, all, scratch)
                            }
                        };
                        let (place, sample) = seen_in(&mirrored.mirrors, off.mirror, sample);
                        take(place, sample);
                    }
                }
            },
        );
        mirrored.rays = rays;
    }

    /// What a ray off a mirror sees that has met what these hits say at this place.
    #[inline(never)]
    fn seen_off(
        &self,
        off: &Off,
        level: u32,
        (all, number): (&Together, usize),
        scratch: &mut Scratch,
    ) -> Sample {
        let path = Path {
            from: Some(off.from),
            seen: Off::SEEN,
            level,
            weight: off.weight,
            ..self.camera_path(off.ray)
        };
        let hit = all.hits[number / 4].hit(number % 4);
        self.trace(path, Some((hit, &all.known(number))), scratch)
    }
}

impl Off {
    /// What such rays see.
    const SEEN: Seen = Seen::Reflection;

    fn query(&self) -> Query {
        Query {
            ray: self.ray,
            from: Some(self.from),
            far: f64::INFINITY,
            seen: Off::SEEN,
        }
    }
}
