//! Photons on their way from lights to targets: in which directions they are sent (facts 2, section 3.2).
//!
//! From each light a ring after the other is sent around the middle of a target, until the target's box is filled or a ring
//! has missed it. The order of all random numbers is POV-Ray's.

use super::path::{PhotonPath, PhotonTally};
use crate::base::math::Ray;
use crate::base::math::sampling::mersenne::Stream;
use crate::render::photons::{self, Map, PhotonMaps, PhotonTarget, Photons};
use crate::render::shade::{Inside, Path, Tracer};
use crate::scene::light::Light;
use crate::world::{RayKind, Scratch};
use glam::{DMat3, DVec3};
use std::f64::consts::{PI, TAU};

/// A ring of less is the middle of the target.
const MIDDLE: f64 = 1e-10;
/// Photons of less light are not sent.
const LEAST_SHARE: f64 = 1e-5;
/// Within this of one, the direction to the target counts as that of an axis.
const ALONG_AXIS: f64 = 0.1;

/// A light and a target, seen from one of its lamps.
struct PhotonAim {
    /// The unit direction to the middle of the target.
    forward: DVec3,
    /// A unit direction across it.
    left: DVec3,
    distance: f64,
}

/// The rings of one target.
struct Rings {
    /// The distance of neighbours one unit away; that of parallel ones.
    spread: f64,
    step: f64,
    end: f64,
}

impl PhotonAim {
    fn new(light: &Light, from: DVec3, middle: DVec3) -> PhotonAim {
        let way = middle - from;
        let distance = way.length();
        let forward = if distance == 0.0 {
            DVec3::Z
        } else {
            way / distance
        };
        let aside = if (forward.z.abs() - 1.0).abs() < ALONG_AXIS {
            DVec3::Y
        } else {
            DVec3::Z
        };
        let along = if light.is_parallel {
            light.rays()
        } else {
            forward
        };
        PhotonAim {
            forward,
            left: along.cross(aside).normalize_or_zero(),
            distance,
        }
    }

    /// The ray of a photon: an angle off the middle, or a length for parallel light, and an angle around it.
    fn ray(&self, light: &Light, from: DVec3, middle: DVec3, off: f64, around: f64) -> Ray {
        if light.is_parallel {
            let dir = light.rays();
            let start = middle - (middle - from).dot(dir) * dir;
            let turn = DMat3::from_axis_angle(dir, around);
            return Ray::new(start + turn * (self.left * off), dir);
        }
        let (sine, cosine) = off.sin_cos();
        let turn = DMat3::from_axis_angle(self.forward, around);
        let dir = turn * (-sine * self.left + cosine * self.forward);
        Ray::new(from, dir)
    }
}

impl Rings {
    fn new(
        light: &Light,
        target: &PhotonTarget,
        spacing: f64,
        (aim, radius): (&PhotonAim, f64),
    ) -> Rings {
        let mut spread = target.density * spacing;
        if !light.is_parallel {
            spread /= aim.distance;
        }
        if let Some([columns, rows]) = lamps_of(light) {
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

/// How many lamps of a light send photons along its sides, if they do so by themselves.
fn lamps_of(light: &Light) -> Option<[u32; 2]> {
    let area = light.area.as_ref().filter(|_| light.photons.from_area);
    area.map(|area| area.sizes)
}

/// The middle of the box around a target, and half its diagonal.
fn ball_around(target: &PhotonTarget) -> (DVec3, f64) {
    let half = 0.5 * target.around.sides;
    (target.around.min + half, half.length())
}

impl<'w> Tracer<'w> {
    /// Shoots all photons of the scene.
    #[must_use]
    pub fn emit_photons(&self) -> Option<PhotonMaps> {
        let photons = self.world.photons.as_ref()?;
        if let Some(bytes) = &photons.settings.load_file {
            return Some(PhotonMaps::new(photons, 0, photons::read(bytes)?));
        }
        let spacing = photons.spacing(|spacing| self.expected(photons, spacing));
        let mut shot = PhotonTally::new(photons);
        let mut scratch = Scratch::default();
        for (number, target) in self.pairs(photons) {
            if self.stop.is_asked() {
                break;
            }
            self.shoot_at(number, target, spacing, &mut shot, &mut scratch);
        }
        let maps = [Map::new(shot.on_surfaces), Map::new(shot.in_media)];
        Some(PhotonMaps::new(photons, shot.count, maps))
    }

    /// The lights and the targets to which they send photons, by their numbers.
    fn pairs(&self, photons: &Photons) -> Vec<(u32, u32)> {
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

    /// About how many photons come to rest with a spacing.
    fn expected(&self, photons: &Photons, spacing: f64) -> f64 {
        let of_pair = |(light, target): (u32, u32)| {
            let target = &photons.targets[target as usize];
            let own = &self.world.lights.get(light).photons;
            let (_, radius) = ball_around(target);
            let (refracts, reflects) = (target.role.refracts(own), target.role.reflects(own));
            let ratio = radius / (target.density * spacing);
            let mut count = 0.5 * PI * ratio * ratio;
            if refracts && reflects {
                count *= 1.5;
            }
            if !target.role.keeps_none && refracts {
                count *= if reflects { 3.0 } else { 2.0 };
            }
            count
        };
        self.pairs(photons).into_iter().map(of_pair).sum()
    }

    /// Sends photons from a light to a target.
    fn shoot_at(
        &self,
        number: u32,
        target: u32,
        spacing: f64,
        shot: &mut PhotonTally<'w>,
        scratch: &mut Scratch,
    ) {
        let light = self.world.lights.get(number);
        let settings = &shot.photons.settings;
        let (middle, radius) = ball_around(&shot.photons.targets[target as usize]);
        let aim = PhotonAim::new(light, light.centre, middle);
        let of_target = &shot.photons.targets[target as usize];
        let rings = Rings::new(light, of_target, spacing, (&aim, radius));
        if !(rings.step > 0.0 && rings.end.is_finite()) {
            return;
        }
        let (jitter, autostop) = (settings.jitter, settings.autostop);
        shot.begin(light, target, rings.spread);
        let inside = self.inside_at(light.centre);
        // Of parallel light rings have lengths instead of angles.
        let middle_below = if light.is_parallel {
            MIDDLE * shot.photons.unit
        } else {
            MIDDLE
        };
        let mut has_ever_hit = false;
        let mut off = 0.0;
        while off < rings.end {
            shot.has_hit = false;
            let turn = if off < middle_below {
                TAU
            } else if light.is_parallel {
                rings.step / off
            } else {
                rings.step / off.sin()
            };
            let first = -PI + turn * shot.random.next_number() * 0.5;
            let last = PI - 0.5 * turn + (first + PI);
            let mut around = first;
            while around < last {
                let around_now = around + turn * (shot.random.next_number() - 0.5) * jitter;
                let off_now = off + rings.step * (shot.random.next_number() - 0.5) * jitter;
                self.shoot_one(
                    light,
                    (&aim, middle),
                    (off_now, around_now),
                    &inside,
                    shot,
                    scratch,
                );
                around += turn;
            }
            has_ever_hit |= shot.has_hit;
            if has_ever_hit && !shot.has_hit && off > autostop * rings.end || self.stop.is_asked() {
                break;
            }
            off += rings.step;
        }
    }

    /// Sends one photon, or one from each lamp.
    fn shoot_one(
        &self,
        light: &Light,
        (aim, middle): (&PhotonAim, DVec3),
        (off, around): (f64, f64),
        inside: &Inside,
        shot: &mut PhotonTally<'w>,
        scratch: &mut Scratch,
    ) {
        let (Some([columns, rows]), Some(area)) = (lamps_of(light), &light.area) else {
            let ray = aim.ray(light, light.centre, middle, off, around);
            self.fly_from(light, (ray, aim.distance), 1.0, inside, shot, scratch);
            return;
        };
        let share = 1.0 / (f64::from(columns) * f64::from(rows));
        for u in 0..columns {
            for v in 0..rows {
                let lamp = area.lamp(&area.axes, f64::from(u), f64::from(v));
                let from = light.centre + lamp;
                let aim = PhotonAim::new(light, from, middle);
                let ray = aim.ray(light, from, middle, off, around);
                self.fly_from(light, (ray, aim.distance), share, inside, shot, scratch);
            }
        }
    }

    fn fly_from(
        &self,
        light: &Light,
        (ray, reach): (Ray, f64),
        share: f64,
        inside: &Inside,
        shot: &mut PhotonTally<'w>,
        scratch: &mut Scratch,
    ) {
        shot.count += 1;
        let share = share * light.share_of_ray(&ray, reach);
        if share < LEAST_SHARE {
            return;
        }
        let path = Path {
            ray,
            from: None,
            seen: RayKind::Shadow,
            level: 0,
            weight: 1.0,
            gathered: 0,
            inside: Inside::from_slice(inside),
            wavelength: None,
        };
        let flight = PhotonPath {
            path,
            light: light.color * share,
            way: 0.0,
            has_met: false,
        };
        self.fly(flight, shot, scratch);
    }

    fn inside_at(&self, point: DVec3) -> Inside {
        if self.minds_interiors {
            self.world.interiors_at(point)
        } else {
            Inside::new()
        }
    }
}

impl<'p> PhotonTally<'p> {
    fn new(photons: &'p Photons) -> Self {
        PhotonTally {
            photons,
            light: None,
            target: 0,
            spread: 0.0,
            random: Stream::default(),
            has_hit: false,
            count: 0,
            on_surfaces: Vec::new(),
            in_media: Vec::new(),
        }
    }
}
