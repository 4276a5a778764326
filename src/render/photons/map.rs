//! The photon map: a balanced k-d tree in an array, and its nearest-neighbour search.

use super::columns::{BLOCK, Columns, Distances};
use super::near::Near;
use super::photon::Unpacking;
use super::{Photon, order};
use crate::base::color::Rgb;
use glam::DVec3;

/// The factor on the radius of a second search.
const EXPANSION: f64 = 3.0;
/// The density of a search without photons.
const NO_DENSITY: f64 = 1e-16;

/// A photon map.
#[derive(Clone, Debug, Default)]
pub struct Map {
    photons: Vec<Photon>,
    columns: Columns,
    unpacking: Unpacking,
}

/// The parameters of a radiance estimate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Search {
    /// The radius of the first search.
    pub radius: f64,
    /// The least number of photons, below which the search is repeated with a larger radius; then the largest number
    /// that is gathered.
    pub gather: [u32; 2],
    /// The relative growth of the density that the larger radius may bring.
    pub tolerance: f64,
    /// Fewer photons than this are used in any case.
    pub min_expanded: u32,
    /// The photons lie on a surface.
    pub is_flat: bool,
}

/// A nearest-neighbour query.
struct PhotonQuery<'n> {
    point: DVec3,
    /// The normal of the surface; zero in space.
    normal: DVec3,
    most: usize,
    /// The current search radius.
    radius: f64,
    /// Its square.
    radius_sq: f64,
    near: &'n mut Near,
}

impl PhotonQuery<'_> {
    /// Adds a photon if it is near enough.
    #[inline]
    fn take(&mut self, number: usize, distance_sq: f64) {
        if distance_sq < self.radius_sq {
            #[allow(clippy::cast_possible_truncation, reason = "maps hold fewer photons")]
            let number = number as u32;
            if let Some(farthest_sq) = self.near.take(distance_sq, number, self.most) {
                self.radius_sq = farthest_sq;
                self.radius = farthest_sq.sqrt();
            }
        }
    }

    /// Returns true if the range behind the plane at `split` is near enough to the coordinate `at` before it, or that
    /// before the plane to the coordinate behind it.
    #[inline]
    fn crosses(&self, [at, split]: [f64; 2]) -> bool {
        if at < split {
            at + self.radius > split
        } else {
            at - self.radius < split
        }
    }
}

impl Map {
    /// Builds a map from photons in the order in which they were stored.
    #[must_use]
    pub fn new(mut photons: Vec<Photon>) -> Map {
        order::sort(&mut photons);
        Map::of_sorted(photons)
    }

    /// A map of photons that are in tree order already.
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

    /// All photons in tree order.
    #[must_use]
    pub fn photons(&self) -> &[Photon] {
        &self.photons
    }

    /// Returns true if the map is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.photons.is_empty()
    }

    /// The memory of the map in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.photons.capacity() * size_of::<Photon>() + self.columns.bytes()
    }

    /// The unit directions to the origins of the gathered photons, and their light.
    pub fn of<'m>(&'m self, near: &'m Near) -> impl Iterator<Item = (DVec3, Rgb)> {
        let unpacking = &self.unpacking;
        near.numbers().map(|number| {
            let photon = &self.photons[number];
            (unpacking.dir(photon), unpacking.light(photon))
        })
    }

    /// Finds the nearest photons within `radius`, `most` at most.
    pub fn find(&self, point: DVec3, normal: DVec3, radius: f64, most: usize, near: &mut Near) {
        near.clear();
        near.radius = radius;
        if self.photons.is_empty() || most == 0 {
            return;
        }
        let mut query = PhotonQuery {
            point,
            normal,
            most,
            radius,
            radius_sq: radius * radius,
            near,
        };
        self.search(0, self.photons.len() - 1, &mut query);
        let radius = query.radius;
        near.radius = radius;
    }

    /// Searches a subtree in POV-Ray's order, which decides what a search misses: the photon that divides it, the side of
    /// the point, and the other side if it is near enough.
    fn search(&self, first: usize, last: usize, query: &mut PhotonQuery) {
        if last - first < BLOCK {
            let (point, radius_sq) = (query.point, query.radius_sq);
            let distances = self
                .columns
                .distances(first, point, query.normal, radius_sq);
            return self.search_block(first, 0, last - first, &distances, query);
        }
        let middle = usize::midpoint(first, last);
        let split = self.columns.split(middle, query.point);
        let (before, behind) = ((first, middle - 1), (middle + 1, last));
        let ((near_first, near_last), (far_first, far_last)) = if split[0] < split[1] {
            (before, behind)
        } else {
            (behind, before)
        };
        let distance_sq = self.columns.distance_sq(middle, query.point, query.normal);
        query.take(middle, distance_sq);
        self.search(near_first, near_last, query);
        if query.crosses(split) {
            self.search(far_first, far_last, query);
        }
    }

    /// As [`Self::search`] from `low` to `high` behind `first`, with known distances: subtrees without a photon within
    /// the radius are skipped.
    fn search_block(
        &self,
        first: usize,
        low: usize,
        high: usize,
        distances: &Distances,
        query: &mut PhotonQuery,
    ) {
        let near = distances.near;
        let middle = usize::midpoint(low, high);
        // The photons before and behind the middle that are within the radius.
        let before = near & ((1 << middle) - (1 << low));
        let behind = near & ((2 << high) - (2 << middle));
        if near >> middle & 1 == 1 {
            query.take(first + middle, distances.squares[middle]);
        }
        if before | behind != 0 {
            let split = self.columns.split(first + middle, query.point);
            let sides = [(before, low, middle), (behind, middle + 1, high + 1)];
            let [
                (near_mask, near_low, near_end),
                (far_mask, far_low, far_end),
            ] = if split[0] < split[1] {
                sides
            } else {
                [sides[1], sides[0]]
            };
            self.search_side(first, near_mask, near_low, near_end, distances, query);
            if query.crosses(split) {
                self.search_side(first, far_mask, far_low, far_end, distances, query);
            }
        }
    }

    /// Searches one side of a split, with the mask of its photons within the radius.
    #[inline(always)]
    fn search_side(
        &self,
        first: usize,
        near: u32,
        low: usize,
        end: usize,
        distances: &Distances,
        query: &mut PhotonQuery,
    ) {
        if near == 0 {
            return;
        }
        if end - low == 1 {
            query.take(first + low, distances.squares[low]);
        } else {
            self.search_block(first, low, end - 1, distances, query);
        }
    }

    /// Gathers the photons for a radiance estimate: those within the radius, or if there are too few and the density
    /// does not grow too much, those within a larger radius.
    pub fn gather(&self, search: &Search, point: DVec3, normal: DVec3, near: &mut Near) {
        let most = search.gather[1] as usize;
        let least = search.gather[0] as usize;
        let min_expanded = search.min_expanded as usize;
        self.find(point, normal, search.radius, most, near);
        let count = near.count();
        if count >= least {
            return;
        }
        let density = |near: &Near| near.count() as f64 / (near.radius * near.radius);
        let before = density(near).max(NO_DENSITY);
        let mut farther = Near::with_capacity(most.min(self.photons.len()));
        self.find(point, normal, EXPANSION * search.radius, most, &mut farther);
        let growth = (density(&farther) - before) / before;
        let is_below_min = farther.count() > 0 && farther.count() < min_expanded;
        if growth < search.tolerance || is_below_min {
            *near = farther;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::color::Rgb;

    fn line(count: u32) -> Map {
        let position = |number: u32| DVec3::new(f64::from(number * 7 % count), 0.0, 0.0);
        let photons = (0..count).map(|number| Photon::new(position(number), Rgb::WHITE, DVec3::Y));
        Map::new(photons.collect())
    }

    fn sorted_x(map: &Map, near: &Near) -> Vec<f64> {
        let xs = near.numbers().map(|number| map.photons[number].at().x);
        let mut xs: Vec<f64> = xs.collect();
        xs.sort_by(f64::total_cmp);
        xs
    }

    #[test]
    fn all_within_the_radius_are_gathered_or_the_nearest() {
        let (map, mut near) = (line(100), Near::default());
        map.find(DVec3::new(50.2, 0.0, 0.0), DVec3::Y, 2.0, 9, &mut near);
        assert_eq!(sorted_x(&map, &near), [49.0, 50.0, 51.0, 52.0]);
        assert_eq!(near.radius, 2.0);
        map.find(DVec3::new(50.2, 0.0, 0.0), DVec3::Y, 30.0, 3, &mut near);
        assert_eq!(sorted_x(&map, &near), [49.0, 50.0, 51.0]);
        assert!((near.radius - 1.2).abs() < 1e-12);
    }

    #[test]
    fn photons_above_the_surface_count_as_farther() {
        let (map, mut near) = (line(3), Near::default());
        let above = DVec3::new(1.0, 0.4, 0.0);
        map.find(above, DVec3::Y, 0.5, 9, &mut near);
        assert_eq!(near.count(), 0);
        map.find(above, DVec3::ZERO, 0.5, 9, &mut near);
        assert_eq!(near.count(), 1);
    }

    #[test]
    fn with_too_sparse_photons_the_radius_grows() {
        let (map, mut near) = (line(100), Near::default());
        let mut search = Search {
            radius: 2.0,
            gather: [6, 100],
            tolerance: 0.2,
            min_expanded: 35,
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
