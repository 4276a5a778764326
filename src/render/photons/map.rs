//! Photons in an order by which those around a point are found.

use super::columns::{BLOCK, Columns, Distances};
use super::near::Near;
use super::photon::Unpacking;
use super::{Photon, order};
use crate::base::color::Rgb;
use glam::DVec3;

/// A second search goes so many times as far.
const FARTHER: f64 = 3.0;
/// Photons beside none.
const NO_DENSITY: f64 = 1e-16;

/// Photons to be looked up.
#[derive(Clone, Debug, Default)]
pub struct Map {
    photons: Vec<Photon>,
    columns: Columns,
    unpacking: Unpacking,
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

/// A question for photons around a point.
struct PhotonQuery<'n> {
    point: DVec3,
    /// The normal of the surface on which they lie; zero for none.
    normal: DVec3,
    most: usize,
    /// The square of how far they may lie away.
    reach_sq: f64,
    near: &'n mut Near,
}

impl PhotonQuery<'_> {
    /// Takes a photon if it is near enough.
    #[inline]
    fn take(&mut self, number: usize, distance_sq: f64) {
        if distance_sq < self.reach_sq {
            #[allow(
                clippy::cast_possible_truncation,
                reason = "so many photons there are not"
            )]
            let photon = (distance_sq, number as u32);
            if let Some(farthest_sq) = self.near.take(photon, self.most) {
                self.reach_sq = farthest_sq;
            }
        }
    }
}

impl Map {
    /// Photons in the order in which they came to rest.
    #[must_use]
    pub fn new(mut photons: Vec<Photon>) -> Map {
        order::sort(&mut photons);
        Map::of_sorted(photons)
    }

    /// Photons that lie in the order of a map.
    #[must_use]
    pub fn of_sorted(photons: Vec<Photon>) -> Map {
        if photons.is_empty() {
            return Map::default();
        }
        Map {
            columns: Columns::new(&photons),
            unpacking: Unpacking::new(),
            photons,
        }
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
        self.photons.capacity() * size_of::<Photon>() + self.columns.bytes()
    }

    /// Those that were found: the unit directions to where they came from, and their light.
    pub fn of<'m>(&'m self, near: &'m Near) -> impl Iterator<Item = (DVec3, Rgb)> {
        let unpacking = &self.unpacking;
        near.numbers().map(|number| {
            let photon = &self.photons[number];
            (unpacking.dir(photon), unpacking.light(photon))
        })
    }

    /// Finds the nearest photons, `most` at most, that are nearer than `radius`.
    pub fn find(&self, point: DVec3, normal: DVec3, radius: f64, most: usize, near: &mut Near) {
        near.clear();
        near.radius = radius;
        if self.photons.is_empty() || most == 0 {
            return;
        }
        let mut question = PhotonQuery {
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

    /// Looks through a part of the map: the side on which the point lies, the other if it is near enough, the photon that
    /// divides them.
    fn look(&self, (first, last): (usize, usize), question: &mut PhotonQuery) {
        if last - first < BLOCK {
            let (point, reach_sq) = (question.point, question.reach_sq);
            let distances = self
                .columns
                .distances(first, (point, question.normal), reach_sq);
            return self.look_closely(first, (0, last - first), &distances, question);
        }
        let middle = usize::midpoint(first, last);
        let beyond = self.columns.beyond(middle, question.point);
        let (before, behind) = ((first, middle - 1), (middle + 1, last));
        let (near_side, far_side) = if beyond < 0.0 {
            (before, behind)
        } else {
            (behind, before)
        };
        self.look(near_side, question);
        if beyond * beyond < question.reach_sq {
            self.look(far_side, question);
        }
        let distance_sq = self
            .columns
            .distance_sq(middle, (question.point, question.normal));
        question.take(middle, distance_sq);
    }

    /// As [`Self::look`] from `low` to `high` behind `first`, where the distances are known: what holds no photon that is near
    /// enough is passed over.
    fn look_closely(
        &self,
        first: usize,
        (low, high): (usize, usize),
        distances: &Distances,
        question: &mut PhotonQuery,
    ) {
        let near = distances.near;
        let middle = usize::midpoint(low, high);
        // The photons before and behind that are near enough.
        let before = near & ((1 << middle) - (1 << low));
        let behind = near & ((2 << high) - (2 << middle));
        if before | behind != 0 {
            let beyond = self.columns.beyond(first + middle, question.point);
            let sides = [(before, (low, middle)), (behind, (middle + 1, high + 1))];
            let [near_side, far_side] = if beyond < 0.0 {
                sides
            } else {
                [sides[1], sides[0]]
            };
            self.look_aside(first, near_side, distances, question);
            if beyond * beyond < question.reach_sq {
                self.look_aside(first, far_side, distances, question);
            }
        }
        if near >> middle & 1 == 1 {
            question.take(first + middle, distances.squares[middle]);
        }
    }

    /// Looks through one side, of which it is known which are near enough and how far it goes.
    #[inline(always)]
    fn look_aside(
        &self,
        first: usize,
        (near, (low, end)): (u32, (usize, usize)),
        distances: &Distances,
        question: &mut PhotonQuery,
    ) {
        if near == 0 {
            return;
        }
        if end - low == 1 {
            question.take(first + low, distances.squares[low]);
        } else {
            self.look_closely(first, (low, end - 1), distances, question);
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
        let mut farther = Near::with_room(most);
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
    use crate::base::color::Rgb;

    fn line(count: u32) -> Map {
        let place = |number: u32| DVec3::new(f64::from(number * 7 % count), 0.0, 0.0);
        let photons = (0..count).map(|number| Photon::new(place(number), Rgb::WHITE, DVec3::Y));
        Map::new(photons.collect())
    }

    fn found(map: &Map, near: &Near) -> Vec<f64> {
        let places = near.numbers().map(|number| map.photons[number].at().x);
        let mut places: Vec<f64> = places.collect();
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
