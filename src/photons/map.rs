//! Photons in an order by which those around a point are found.

use super::{Photon, order};
use glam::DVec3;

/// By this the distance of photons counts more that lie above or below the surface.
const FLATTENING: f64 = 16.0;
/// A second search goes so many times as far.
const FARTHER: f64 = 3.0;
/// Photons beside none.
const NO_DENSITY: f64 = 1e-16;

/// Photons to be looked up.
#[derive(Clone, Debug, Default)]
pub struct Map {
    photons: Vec<Photon>,
}

/// How photons are looked up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Search {
    /// How far, first.
    pub radius: f64,
    /// With fewer than the first of these the search goes farther; no more than the second are taken.
    pub gather: [u32; 2],
    /// By which share the density of photons may grow when it does.
    pub tolerance: f64,
    /// Fewer than this are taken in any case.
    pub few: u32,
    /// Whether they lie on a surface.
    pub is_flat: bool,
}

/// Photons around a point.
#[derive(Clone, Debug, Default)]
pub struct Near {
    /// The squares of their distances, and their numbers. If all that may be taken are there, the farthest comes first.
    found: Vec<(f64, u32)>,
    /// How far away they may lie.
    pub radius: f64,
}

impl Near {
    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.found.len()
    }

    /// Takes one more, or one instead of the farthest of `most`; whether there are `most` now.
    fn take(&mut self, photon: (f64, u32), most: usize) -> bool {
        if self.found.len() < most {
            self.found.push(photon);
            if self.found.len() == most {
                for parent in (0..most / 2).rev() {
                    self.sink(parent);
                }
            }
        } else if let Some(farthest) = self.found.first_mut() {
            *farthest = photon;
            self.sink(0);
        }
        self.found.len() == most
    }

    /// Lets one sink in the heap of the farthest.
    fn sink(&mut self, mut at: usize) {
        loop {
            let mut child = 2 * at + 1;
            if child >= self.found.len() {
                return;
            }
            if child + 1 < self.found.len() && self.found[child + 1].0 > self.found[child].0 {
                child += 1;
            }
            if self.found[at].0 >= self.found[child].0 {
                return;
            }
            self.found.swap(at, child);
            at = child;
        }
    }
}

/// A question for photons around a point.
struct Question<'n> {
    point: DVec3,
    /// The normal of the surface on which they lie; zero for none.
    normal: DVec3,
    most: usize,
    /// The square of how far they may lie away.
    reach_sq: f64,
    near: &'n mut Near,
}

impl Map {
    /// Photons in the order in which they came to rest.
    #[must_use]
    pub fn new(mut photons: Vec<Photon>) -> Map {
        order::sort(&mut photons);
        Map { photons }
    }

    /// Photons that lie in the order of a map.
    #[must_use]
    pub fn of_sorted(photons: Vec<Photon>) -> Map {
        Map { photons }
    }

    /// All of them in their order.
    #[must_use]
    pub fn photons(&self) -> &[Photon] {
        &self.photons
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.photons.is_empty()
    }

    /// The memory that it takes, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.photons.capacity() * size_of::<Photon>()
    }

    /// Those that were found.
    pub fn of<'m>(&'m self, near: &'m Near) -> impl Iterator<Item = &'m Photon> {
        let found = near.found.iter();
        found.map(|&(_, number)| &self.photons[number as usize])
    }

    /// Finds the nearest photons, `most` at most, that are nearer than `radius`.
    pub fn find(&self, point: DVec3, normal: DVec3, radius: f64, most: usize, near: &mut Near) {
        near.found.clear();
        near.radius = radius;
        if self.photons.is_empty() || most == 0 {
            return;
        }
        let mut question = Question {
            point,
            normal,
            most,
            reach_sq: radius * radius,
            near,
        };
        self.look((0, self.photons.len() - 1), &mut question);
        let reach_sq = question.reach_sq;
        near.radius = reach_sq.sqrt();
    }

    fn look(&self, (first, last): (usize, usize), question: &mut Question) {
        let middle = usize::midpoint(first, last);
        let photon = &self.photons[middle];
        let axis = usize::from(photon.axis % 3);
        let to_photon = photon.at() - question.point;
        let beyond = -to_photon[axis];
        let before = (middle > first).then(|| (first, middle - 1));
        let behind = (middle < last).then(|| (middle + 1, last));
        let (near_side, far_side) = if beyond < 0.0 {
            (before, behind)
        } else {
            (behind, before)
        };
        if let Some(part) = near_side {
            self.look(part, question);
        }
        if let Some(part) = far_side
            && beyond * beyond < question.reach_sq
        {
            self.look(part, question);
        }
        let mut distance_sq = to_photon.length_squared();
        if question.normal != DVec3::ZERO {
            distance_sq *= 1.0 + FLATTENING * question.normal.dot(to_photon).abs();
        }
        if distance_sq < question.reach_sq {
            #[allow(
                clippy::cast_possible_truncation,
                reason = "so many photons there are not"
            )]
            let found = (distance_sq, middle as u32);
            let was_full = question.near.found.len() == question.most;
            let is_full = question.near.take(found, question.most);
            if was_full && is_full {
                question.reach_sq = question.near.found[0].0;
            }
        }
    }

    /// Finds the photons that count at a point: those within the radius, or if they are few and the density does not grow
    /// too much, those somewhat farther.
    pub fn gather(&self, search: &Search, point: DVec3, normal: DVec3, near: &mut Near) {
        let most = search.gather[1] as usize;
        let least = search.gather[0] as usize;
        let few = search.few as usize;
        self.find(point, normal, search.radius, most, near);
        let count = near.count();
        if count >= least {
            return;
        }
        let density = |near: &Near| near.count() as f64 / (near.radius * near.radius);
        let before = density(near).max(NO_DENSITY);
        let mut farther = Near {
            found: Vec::with_capacity(most),
            radius: 0.0,
        };
        self.find(point, normal, FARTHER * search.radius, most, &mut farther);
        let growth = (density(&farther) - before) / before;
        let is_few = farther.count() > 0 && farther.count() < few;
        if growth < search.tolerance || is_few {
            *near = farther;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;

    fn line(count: u32) -> Map {
        let place = |number: u32| DVec3::new(f64::from(number * 7 % count), 0.0, 0.0);
        let photons = (0..count).map(|number| Photon::new(place(number), Rgb::WHITE, DVec3::Y));
        Map::new(photons.collect())
    }

    fn found(map: &Map, near: &Near) -> Vec<f64> {
        let mut places: Vec<f64> = map.of(near).map(|photon| photon.at().x).collect();
        places.sort_by(f64::total_cmp);
        places
    }

    #[test]
    fn all_within_the_radius_are_found_or_the_nearest() {
        let (map, mut near) = (line(100), Near::default());
        map.find(DVec3::new(50.2, 0.0, 0.0), DVec3::Y, 2.0, 9, &mut near);
        assert_eq!(found(&map, &near), [49.0, 50.0, 51.0, 52.0]);
        assert_eq!(near.radius, 2.0);
        map.find(DVec3::new(50.2, 0.0, 0.0), DVec3::Y, 30.0, 3, &mut near);
        assert_eq!(found(&map, &near), [49.0, 50.0, 51.0]);
        assert!((near.radius - 1.2).abs() < 1e-12);
    }

    #[test]
    fn what_lies_above_the_surface_counts_as_farther() {
        let (map, mut near) = (line(3), Near::default());
        let above = DVec3::new(1.0, 0.4, 0.0);
        map.find(above, DVec3::Y, 0.5, 9, &mut near);
        assert_eq!(near.count(), 0);
        map.find(above, DVec3::ZERO, 0.5, 9, &mut near);
        assert_eq!(near.count(), 1);
    }

    #[test]
    fn with_few_photons_the_search_goes_farther() {
        let (map, mut near) = (line(100), Near::default());
        let mut search = Search {
            radius: 2.0,
            gather: [6, 100],
            tolerance: 0.2,
            few: 35,
            is_flat: true,
        };
        let point = DVec3::new(50.2, 0.0, 0.0);
        map.gather(&search, point, DVec3::Y, &mut near);
        assert_eq!((near.count(), near.radius), (12, 6.0));
        search.gather[0] = 4;
        map.gather(&search, point, DVec3::Y, &mut near);
        assert_eq!((near.count(), near.radius), (4, 2.0));
    }
}
