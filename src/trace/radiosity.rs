//! Light that a surface gathers from others: what samples near a point know of it, or what a new sample finds.
//!
//! The numbers are those of [`crate::radiosity`]. Rays that gather start anew: they know of no interiors around them,
//! meet no fog, and see lights as points and no highlights.

use super::light::Lit;
use super::{Inside, Path, Sample, Tracer, begin_sample};
use crate::atmosphere::WAY_TO_NOTHING;
use crate::color::{Color, Rgb};
use crate::compile::{Departure, Hit, Query, Scratch, Seen};
use crate::math::Ray;
use crate::radiosity::{self, Frame, Known, Look, Mode, Radiosity};
use crate::scene::Importance;
use crate::texture::PreparedLayer;
use glam::DVec3;

/// A sample whose nearest neighbour is nearer than this share of its largest radius is not kept.
const TOO_NEAR: f64 = 1e-4;

/// Light that arrives at the front and at the back of a surface, where it was asked for.
#[derive(Clone, Copy, Default)]
pub(super) struct Gathered {
    front: Option<Rgb>,
    back: Option<Rgb>,
}

/// A point that gathers light.
pub(super) struct Gathering<'r> {
    radiosity: &'r Radiosity,
    point: DVec3,
    departure: Option<Departure>,
    /// The unit normals on the side of the viewer: with bumps, if those count, and without.
    normal: DVec3,
    flat: DVec3,
    depth: usize,
    /// The weight of the ray that came here.
    weight: f64,
}

impl<'r> Gathering<'r> {
    /// Where a ray meets a surface of this normal without bumps.
    pub(super) fn new(radiosity: &'r Radiosity, lit: &Lit, flat: DVec3) -> Self {
        let has_normals = radiosity.settings.has_normals;
        Gathering {
            radiosity,
            point: lit.at.point,
            departure: lit.departure.copied(),
            normal: if has_normals { lit.at.normal } else { flat },
            flat,
            depth: lit.path.gathered,
            weight: lit.path.weight,
        }
    }
}

impl Tracer<'_> {
    /// The weight below which a ray is not followed.
    pub(super) fn bailout(&self, path: &Path) -> f64 {
        self.bailout_at(path.gathered)
    }

    fn bailout_at(&self, depth: usize) -> f64 {
        match &self.world.radiosity {
            Some(radiosity) if depth > 0 => radiosity.settings.adc_bailout,
            _ => self.world.globals.adc_bailout,
        }
    }

    /// Whether a ray meets neither fog nor media.
    pub(super) fn is_airless(&self, path: &Path) -> bool {
        let radiosity = self.world.radiosity.as_ref();
        path.gathered > 0 && !radiosity.is_some_and(|radiosity| radiosity.settings.has_media)
    }

    /// What is seen at a point of the picture; what was noted of it and still holds is not looked at again.
    pub(super) fn noted(
        &self,
        (x, y): (f64, f64),
        scratch: &mut Scratch,
        see: impl FnOnce(&mut Scratch) -> Sample,
    ) -> Sample {
        if let Some(session) = &mut scratch.radiosity {
            match session.mode {
                Mode::Watch => session.notes.begin(),
                Mode::Grow => {
                    if let Some((rgb, transmit)) = session.notes.recall(x, y, &session.cache) {
                        return Sample { rgb, transmit };
                    }
                }
                Mode::Lone => {}
            }
        } else {
            scratch.radiosity.clone_from(&self.samples);
        }
        begin_sample(x, y, scratch);
        let seen = see(scratch);
        if let Some(session) = &mut scratch.radiosity
            && session.mode == Mode::Watch
        {
            session.notes.end(x, y, (seen.rgb, seen.transmit));
        }
        seen
    }

    /// What a layer throws back of the light that its surface gathers.
    pub(super) fn gathered(
        &self,
        gathering: &Gathering,
        (layer, color, filter): (&PreparedLayer, Color, Rgb),
        known: &mut Gathered,
        scratch: &mut Scratch,
    ) -> Rgb {
        let settings = &gathering.radiosity.settings;
        if gathering.depth >= settings.recursion_limit as usize || scratch.radiosity.is_none() {
            return Rgb::BLACK;
        }
        let (_, coat) = self.coat(layer, color);
        let [front, back] = layer.finish.diffuse_as_given;
        let mut sum = Rgb::BLACK;
        let sides = [
            (front, &mut known.front, 1.0),
            (back, &mut known.back, -1.0),
        ];
        for (diffuse, known, side) in sides {
            let share = coat.opacity * f64::from(diffuse);
            let weight = f64::from((filter * coat.rgb).grey()) * share;
            let light = match *known {
                Some(light) => light,
                None if weight > self.bailout_at(gathering.depth) => {
                    let weight = gathering.weight * weight;
                    *known.insert(self.light_around(gathering, side, weight, scratch))
                }
                None => continue,
            };
            sum += coat.rgb * light * share;
        }
        sum
    }

    /// The light that arrives at a point in front (1) or at the back (-1).
    fn light_around(
        &self,
        gathering: &Gathering,
        side: f64,
        weight: f64,
        scratch: &mut Scratch,
    ) -> Rgb {
        let &Gathering {
            radiosity, depth, ..
        } = gathering;
        let Some(session) = scratch.radiosity.as_deref_mut() else {
            return Rgb::BLACK;
        };
        let at = (gathering.point, side * gathering.normal);
        let look = session.look(radiosity, at, depth, weight);
        let mut mean = match session.known(radiosity, depth, &look) {
            Known::Unknown => return Rgb::BLACK,
            Known::Enough(mean) => mean,
            Known::Short(mut mean) => {
                let quality = session.quality;
                session.begin(depth);
                let (sample, is_kept) = self.gather(gathering, (&look, side), scratch);
                mean.weight += sample.quality;
                mean.sum += sample.light * sample.quality;
                if let Some(session) = scratch.radiosity.as_deref_mut() {
                    session.quality = quality;
                    if is_kept {
                        session.keep(radiosity, sample);
                    }
                }
                mean
            }
        };
        if let Some(session) = scratch.radiosity.as_deref_mut() {
            session.used(radiosity, depth, &mean);
        }
        mean.sum = mean.sum * (1.0 / mean.weight);
        let settings = &radiosity.settings;
        let grey = settings.gray_threshold;
        if grey > 0.0 {
            let light = mean.sum;
            mean.sum = light * (1.0 - grey) + Rgb::splat(light.grey()) * grey;
        }
        mean.sum * settings.brightness
    }

    /// A new sample; whether it is to be kept.
    fn gather(
        &self,
        gathering: &Gathering,
        (look, side): (&Look, f64),
        scratch: &mut Scratch,
    ) -> (radiosity::Sample, bool) {
        let &Gathering {
            radiosity, depth, ..
        } = gathering;
        let count = radiosity.rays(depth);
        let mut aim = Aim::new(look.normal, side * gathering.flat, count);
        let nothing = WAY_TO_NOTHING * self.world.globals.unit;
        let (mut nearest, mut to_nearest) = (nothing, look.normal);
        let (mut nearness, mut weights, mut qualities) = (0.0, 0.0, 0.0);
        let mut sum = Rgb::BLACK;
        for number in 0..count {
            let Some(session) = scratch.radiosity.as_deref_mut() else {
                break;
            };
            let dir = aim.next(|| session.direction(radiosity, depth));
            session.quality = 1.0;
            let path = Path {
                ray: Ray::new(look.point, dir),
                from: gathering.departure,
                seen: Seen::Gathering,
                level: radiosity.level(depth, self.world.globals.max_trace_level),
                weight: radiosity.weight(depth),
                gathered: depth + 1,
                inside: Inside::new(),
                wavelength: None,
            };
            let query = Query {
                ray: path.ray,
                from: path.from,
                far: f64::INFINITY,
                seen: path.seen,
            };
            let hit = self.world.nearest(&query, scratch);
            if let Some(hit) = &hit {
                nearness += 1.0 / hit.t;
                if hit.t < nearest {
                    (nearest, to_nearest) = (hit.t, dir);
                }
            }
            let weight = self.weight_of(hit.as_ref(), radiosity, number, count);
            if weight == 0.0 {
                continue;
            }
            let seen = self.trace(path, Some((hit, &[])), scratch);
            let quality = scratch.radiosity.as_deref().map_or(1.0, |session| session.quality);
            qualities += quality * weight;
            weights += weight;
            sum += self.limited(seen.rgb, radiosity) * (quality * weight);
        }
        let eye = self.world.camera.location().distance(look.point);
        let [least, most] = radiosity.reuse(depth).map(|reuse| reuse * eye);
        let count = f64::from(count);
        let sample = radiosity::Sample {
            point: look.point,
            normal: look.normal,
            light: sum * (1.0 / qualities),
            radius: single((count / nearness).clamp(least, most)),
            nearest: single(nearest),
            to_nearest,
            quality: qualities / weights,
            depth,
        };
        (sample, nearest > TOO_NEAR * most)
    }

    /// How much the ray of this number counts for what it met: those of less important objects stand for more of them.
    fn weight_of(&self, hit: Option<&Hit>, radiosity: &Radiosity, number: u32, count: u32) -> f64 {
        let own = hit.and_then(|hit| self.world.surfaces[hit.surface as usize].flags.importance);
        let importance = own.map_or(radiosity.importance, Importance::share);
        if importance >= 1.0 {
            return 1.0;
        }
        let last = f64::from(count - 1);
        if f64::from(number) > importance * last {
            return 0.0;
        }
        f64::from(count) / ((importance * last).floor() + 1.0)
    }

    /// Light no brighter than `max_sample`.
    fn limited(&self, light: Rgb, radiosity: &Radiosity) -> Rgb {
        let most = radiosity.settings.max_sample;
        let brightest = f64::from(light.max());
        if most > 0.0 && brightest > most {
            light * (most / brightest)
        } else {
            light
        }
    }
}

/// Chooses the directions of a sample.
struct Aim {
    frame: Frame,
    flat: DVec3,
    /// How many directions below the surface may still be skipped; none are looked for where there are no bumps.
    skips: Option<u32>,
}

/// So many directions are tried for each that is wanted.
const TRIES: u32 = 5;

impl Aim {
    fn new(normal: DVec3, flat: DVec3, count: u32) -> Self {
        Aim {
            frame: Frame::about(normal),
            flat,
            skips: (normal != flat).then(|| count.saturating_mul(TRIES)),
        }
    }

    fn next(&mut self, mut direction: impl FnMut() -> DVec3) -> DVec3 {
        loop {
            let dir = self.frame.turned(direction());
            let Some(skips) = &mut self.skips else {
                return dir;
            };
            if dir.dot(self.flat) > 0.0 {
                return dir;
            }
            *skips = skips.saturating_sub(1);
            if *skips == 0 {
                self.skips = None;
                self.frame = Frame::about(self.flat);
            }
        }
    }
}

/// POV-Ray keeps distances of samples in single precision.
#[allow(clippy::cast_possible_truncation, reason = "it is asked for")]
fn single(distance: f64) -> f64 {
    f64::from(distance as f32)
}
