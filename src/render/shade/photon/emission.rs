//! Photon emission from lights towards targets (docs/povray-facts.md, section 12.2).
//!
//! From each light, rings of photons are emitted around the centre of a target, until the target's bounding box is
//! covered or a ring has missed it. The order of all random numbers is POV-Ray's.

use super::path::{PhotonPath, PhotonTally};
use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::base::math::conditioning::Normalization;
use crate::base::math::sampling::mersenne::Stream;
use crate::base::memory;
use crate::render::photons::{self, Map, Photon, PhotonMaps};
use crate::render::shade::Scratch;
use crate::render::shade::{InteriorStack, Path, Tracer};
use crate::scene::light::Light;
use crate::world::RayKind;
use crate::world::{PhotonMapping, PhotonTarget};
use glam::{DMat3, DVec3};
use std::f64::consts::{PI, TAU};

/// A ring of a smaller angle is the centre of the target.
const MIDDLE: f64 = 1e-10;
/// Photons with a smaller share of light are not emitted.
const MIN_SHARE: f64 = 1e-5;
/// Photons take this part of the memory that is left: they are copied when their list grows, and into a map.
const SHARE_OF_MEMORY: u64 = 4;
/// Within this of one, the direction to the target counts as that of an axis.
const ALONG_AXIS: f64 = 0.1;

/// The view of a target from a light position.
struct PhotonAim {
    /// The light position.
    from: DVec3,
    /// The centre of the target.
    middle: DVec3,
    /// The unit direction to the centre of the target.
    forward: DVec3,
    /// A unit direction across it.
    left: DVec3,
    distance: f64,
    normalization: Normalization,
}

/// The position of a photon on a ring.
#[derive(Clone, Copy)]
struct RingPosition {
    /// The angle off the centre of the target; a length for parallel light.
    off: f64,
    /// The angle around it.
    around: f64,
}

/// The rings of photons around a target.
struct Rings {
    /// The spacing of neighbouring photons at unit distance; at any distance for parallel light.
    spread: f64,
    step: f64,
    end: f64,
}

impl PhotonAim {
    fn new(light: &Light, from: DVec3, middle: DVec3, normalization: Normalization) -> PhotonAim {
        let to_middle = middle - from;
        let distance = to_middle.length();
        let forward = match normalization.unit_or_zero(to_middle) {
            DVec3::ZERO => DVec3::Z,
            forward => forward,
        };
        let aside = if (forward.z.abs() - 1.0).abs() < ALONG_AXIS {
            DVec3::Y
        } else {
            DVec3::Z
        };
        let along = if light.is_parallel {
            light.parallel_dir()
        } else {
            forward
        };
        PhotonAim {
            from,
            middle,
            forward,
            left: normalization.unit_or_zero(along.cross(aside)),
            distance,
            normalization,
        }
    }

    fn ray(&self, light: &Light, at: RingPosition) -> Ray {
        let &PhotonAim { from, middle, .. } = self;
        let RingPosition { off, around } = at;
        if light.is_parallel {
            let dir = light.parallel_dir();
            let start = middle - self.distance * self.forward.dot(dir) * dir;
            let turn = turn_about(dir, around, self.normalization);
            return Ray::new(start + turn * (self.left * off), dir);
        }
        let (sine, cosine) = off.sin_cos();
        let turn = turn_about(self.forward, around, self.normalization);
        let dir = turn * (-sine * self.left + cosine * self.forward);
        Ray::new(from, dir)
    }
}

impl Rings {
    fn new(
        light: &Light,
        target: &PhotonTarget,
        spacing: f64,
        aim: &PhotonAim,
        radius: f64,
    ) -> Rings {
        let mut spread = target.density * spacing;
        if !light.is_parallel {
            spread /= aim.distance;
        }
        if let Some([columns, rows]) = emitting_grid(light) {
            spread *= (f64::from(columns) * f64::from(rows)).sqrt();
        }
        let (step, end) = if light.is_parallel {
            (spread, radius)
        } else if aim.distance >= radius {
            (spread.atan(), (radius / aim.distance).asin())
        } else {
            (spread.atan(), PI)
        };
        Rings { spread, step, end }
    }
}

/// A rotation around a unit vector, with the rounding of POV-Ray.
fn turn_about(axis: DVec3, angle: f64, normalization: Normalization) -> DMat3 {
    let axis = normalization.unit_or_zero(axis);
    let squares = axis * axis;
    let diagonal = squares + angle.cos() * (1.0 - squares);
    let mut turn = DMat3::from_axis_angle(axis, angle);
    turn.x_axis.x = diagonal.x;
    turn.y_axis.y = diagonal.y;
    turn.z_axis.z = diagonal.z;
    turn
}

/// The grid size of an area light, if each of its grid lights emits photons.
fn emitting_grid(light: &Light) -> Option<[u32; 2]> {
    let area = light.area.as_ref().filter(|_| light.photons.from_area);
    area.map(|area| area.sizes)
}

/// The bounding sphere of a target's box: centre and radius.
fn bounding_sphere(target: &PhotonTarget) -> (DVec3, f64) {
    let half = 0.5 * target.bounds.sides;
    (target.bounds.min + half, half.length())
}

/// The end of an emission.
#[derive(Debug)]
pub enum Emission {
    /// The photons.
    Maps(Box<PhotonMaps>),
    /// There is no memory for all photons.
    OutOfMemory,
}

impl<'w> Tracer<'w> {
    /// Emits and traces all photons of the scene.
    #[must_use]
    pub fn emit_photons(&self) -> Option<Emission> {
        let photons = self.world.photons.as_ref()?;
        if let Some(bytes) = &photons.settings.load_file {
            let maps = PhotonMaps::new(photons, 0, photons::read(bytes)?);
            return Some(Emission::Maps(Box::new(maps)));
        }
        let spacing = photons.spacing(|spacing| self.expected(photons, spacing));
        let mut tally = PhotonTally::new(photons);
        let mut scratch = Scratch::default();
        let mut start = (u32::MAX, InteriorStack::new());
        for (number, target) in self.pairs(photons) {
            if self.stop.is_cancelled() || tally.is_full() {
                break;
            }
            if start.0 != number {
                start = (number, self.inside_at(self.world.lights.get(number).centre));
            }
            self.emit_at(
                (number, &start.1),
                target,
                spacing,
                &mut tally,
                &mut scratch,
            );
        }
        if tally.is_full() {
            return Some(Emission::OutOfMemory);
        }
        let maps = [Map::new(tally.on_surfaces), Map::new(tally.in_media)];
        let maps = PhotonMaps::new(photons, tally.count, maps);
        Some(Emission::Maps(Box::new(maps)))
    }

    /// The pairs of lights and targets with photons between them, by index.
    fn pairs(&self, photons: &PhotonMapping) -> Vec<(u32, u32)> {
        let lights = (0u32..).take(self.world.lights.len());
        let lights = lights.filter(|&number| {
            let is_global = self.world.lights.is_outside_groups(number);
            is_global && !self.world.lights.get(number).is_shadowless()
        });
        let pairs = lights.flat_map(|light| {
            let own = &self.world.lights.get(light).photons;
            let targets = (0u32..).zip(&photons.targets);
            let sent = targets
                .filter(|(_, target)| target.role.refracts(own) || target.role.reflects(own));
            sent.map(move |(target, _)| (light, target))
        });
        pairs.collect()
    }

    /// The estimated number of stored photons for a spacing.
    fn expected(&self, photons: &PhotonMapping, spacing: f64) -> f64 {
        let of_pair = |(light, target): (u32, u32)| {
            let target = &photons.targets[target as usize];
            let own = &self.world.lights.get(light).photons;
            let (_, radius) = bounding_sphere(target);
            let (refracts, reflects) = (target.role.refracts(own), target.role.reflects(own));
            let ratio = radius / (target.density * spacing);
            let mut count = ratio * ratio * PI * 0.5;
            if refracts && reflects {
                count *= 1.5;
            }
            if !target.role.collects_none && refracts {
                count *= if reflects { 3.0 } else { 2.0 };
            }
            count
        };
        self.pairs(photons).into_iter().map(of_pair).sum()
    }

    /// Emits photons from a light within these interiors to a target.
    fn emit_at(
        &self,
        (number, inside): (u32, &InteriorStack),
        target: u32,
        spacing: f64,
        tally: &mut PhotonTally<'w>,
        scratch: &mut Scratch,
    ) {
        let light = self.world.lights.get(number);
        let settings = &tally.photons.settings;
        let (middle, radius) = bounding_sphere(&tally.photons.targets[target as usize]);
        let aim = PhotonAim::new(
            light,
            light.centre,
            middle,
            self.world.globals.normalization(),
        );
        let of_target = &tally.photons.targets[target as usize];
        let rings = Rings::new(light, of_target, spacing, &aim, radius);
        if !(rings.step > 0.0 && rings.end.is_finite()) {
            return;
        }
        let (jitter, autostop) = (settings.jitter, settings.autostop);
        tally.begin(light, target, rings.spread);
        // For parallel light rings have lengths instead of angles.
        let middle_below = if light.is_parallel {
            MIDDLE * tally.photons.unit
        } else {
            MIDDLE
        };
        let mut has_ever_hit = false;
        let mut off = 0.0;
        while off < rings.end {
            tally.has_hit = false;
            let turn = if off < middle_below {
                TAU
            } else if light.is_parallel {
                rings.step / off
            } else {
                rings.step / off.sin()
            };
            let first = -PI + turn * tally.random.next_number() * 0.5;
            let last = PI - 0.5 * turn + (first + PI);
            let mut around = first;
            while around < last {
                let around_now = around + turn * (tally.random.next_number() - 0.5) * jitter;
                let off_now = off + rings.step * (tally.random.next_number() - 0.5) * jitter;
                let at = RingPosition {
                    off: off_now,
                    around: around_now,
                };
                self.emit_one(light, &aim, at, inside, tally, scratch);
                around += turn;
            }
            has_ever_hit |= tally.has_hit;
            if has_ever_hit && !tally.has_hit && off > autostop * rings.end
                || self.stop.is_cancelled()
                || tally.is_full()
            {
                break;
            }
            off += rings.step;
        }
    }

    /// Emits one photon, or one from each grid light.
    fn emit_one(
        &self,
        light: &Light,
        aim: &PhotonAim,
        at: RingPosition,
        inside: &InteriorStack,
        tally: &mut PhotonTally<'w>,
        scratch: &mut Scratch,
    ) {
        let (Some([columns, rows]), Some(area)) = (emitting_grid(light), &light.area) else {
            let ray = aim.ray(light, at);
            let share = light.attenuation_along_ray(&ray, aim.distance);
            self.trace_from(light, ray, share, inside, tally, scratch);
            return;
        };
        let count = f64::from(columns) * f64::from(rows);
        for u in 0..columns {
            for v in 0..rows {
                let offset = area.rectangle_offset(f64::from(u), f64::from(v));
                let from = light.centre + offset;
                let aim = PhotonAim::new(light, from, aim.middle, aim.normalization);
                let ray = aim.ray(light, at);
                let share = light.attenuation_along_ray(&ray, aim.distance) / count;
                self.trace_from(light, ray, share, inside, tally, scratch);
            }
        }
    }

    /// Traces a photon with this share of the light.
    fn trace_from(
        &self,
        light: &Light,
        ray: Ray,
        share: f64,
        inside: &InteriorStack,
        tally: &mut PhotonTally<'w>,
        scratch: &mut Scratch,
    ) {
        tally.count += 1;
        if share < MIN_SHARE {
            return;
        }
        let path = Path {
            ray,
            from: None,
            kind: RayKind::Photon,
            level: 0,
            weight: 1.0,
            irradiance_depth: 0,
            subsurface_depth: 0,
            inside: InteriorStack::from_slice(inside),
            wavelength: None,
        };
        let photon = PhotonPath {
            path,
            light: light.color * share,
            has_hit_target: false,
        };
        tally.path_length = 0.0;
        self.trace_photon(photon, tally, scratch);
    }

    fn inside_at(&self, point: DVec3) -> InteriorStack {
        if self.features.needs_interiors {
            self.world.interiors_at_light(point)
        } else {
            InteriorStack::new()
        }
    }
}

impl<'p> PhotonTally<'p> {
    fn new(photons: &'p PhotonMapping) -> Self {
        PhotonTally {
            photons,
            light: None,
            target: 0,
            spread: 0.0,
            path_length: 0.0,
            filter: Rgb::WHITE,
            random: Stream::default(),
            has_hit: false,
            count: 0,
            max_bytes: memory::left() / SHARE_OF_MEMORY,
            on_surfaces: Vec::new(),
            in_media: Vec::new(),
        }
    }

    /// True if there is no memory for more photons.
    fn is_full(&self) -> bool {
        let count = self.on_surfaces.len() + self.in_media.len();
        (count * size_of::<Photon>()) as u64 > self.max_bytes
    }
}
