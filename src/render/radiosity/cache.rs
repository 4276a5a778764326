//! The irradiance cache.
//!
//! Samples lie in an octree (Ward, Rubinstein and Clear 1988), in a cell about as large as the distance within which
//! they are used, so the cell of twice the size finds them. The cells are POV-Ray's. It does not search neighbouring
//! cells, so samples beyond the first depth may be lost; the same ones are lost here.

use super::cell::{Cell, Cube};
use crate::base::color::Rgb;
use glam::DVec3;

/// No sample or node.
const NONE: u32 = u32::MAX;
/// Points closer than this coincide.
const SAME: f64 = 1e-6;
/// The largest distance of a point behind a sample's plane, as a sine.
const BEHIND: f64 = 0.05;
/// Samples of less weight are ignored.
const MIN_WEIGHT: f64 = 0.001;
/// Roundings, more than those by which two squares with equal roots differ.
const ROUNDINGS: f64 = 8.0;
/// Samples farther from the origin are not stored.
const FARTHEST: f64 = (1u64 << 40) as f64;

/// Irradiance at a point.
#[derive(Clone, Copy, Debug)]
pub struct IrradianceSample {
    /// The point.
    pub point: DVec3,
    /// The unit normal on the receiving side.
    pub normal: DVec3,
    /// The cosine-weighted mean of the light over the hemisphere.
    pub light: Rgb,
    /// The harmonic mean distance of the hits, within the limits of reuse.
    pub radius: f64,
    /// The distance of the nearest hit.
    pub nearest: f64,
    /// The unit direction to it; zero without a hit.
    pub to_nearest: DVec3,
    /// The quality of the light that was gathered, up to 1.
    pub quality: f64,
    /// The number of diffuse reflections before it.
    pub depth: usize,
}

/// A lookup of irradiance at a point.
#[derive(Clone, Copy, Debug)]
pub struct CacheQuery {
    /// The point.
    pub point: DVec3,
    /// The unit normal on the side that is seen.
    pub normal: DVec3,
    /// The largest error of a sample that counts.
    pub error: f64,
    /// The depth of the samples.
    pub depth: usize,
    /// Weights fall off smoothly rather than linearly.
    pub is_smooth: bool,
}

/// The weighted mean of the samples that count at a point.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mean {
    /// The sum of the weights.
    pub weight: f64,
    /// The weighted sum of the light.
    pub sum: Rgb,
}

#[derive(Clone, Debug)]
struct Node {
    cell: Cell,
    cube: Cube,
    children: [u32; 8],
    /// The last row that was begun here.
    last: u32,
    /// Mask of the depths of the samples here and in the children.
    depths: u32,
}

/// The number of samples in a row.
const ROW: usize = 8;

/// Samples of one cell and depth in the order in which they were added, with the data that rejects most of them early.
#[derive(Clone, Debug)]
struct Row {
    depth: usize,
    count: usize,
    /// The previous row of the same cell.
    earlier: u32,
    samples: [u32; ROW],
    /// x, y and z of their points; infinite for empty slots.
    points: [[f64; ROW]; 3],
    radii: [f64; ROW],
}

impl Row {
    /// Mask of the samples that may be near enough to a point to count.
    #[inline]
    fn near(&self, query: &CacheQuery) -> u32 {
        let [x, y, z] = &self.points;
        let mut near = [false; ROW];
        for slot in 0..ROW {
            let point = DVec3::new(x[slot], y[slot], z[slot]);
            near[slot] = !query.is_far_from(point, self.radii[slot]);
        }
        (0..ROW).fold(0, |bits, slot| bits | u32::from(near[slot]) << slot)
    }
}

/// The cache of irradiance samples.
#[derive(Clone, Debug)]
pub struct Cache {
    samples: Vec<IrradianceSample>,
    rows: Vec<Row>,
    nodes: Vec<Node>,
    root: u32,
    /// The length of the scene's unit.
    unit: f64,
}

impl IrradianceSample {
    /// The weight of the sample at a point; 0 where it does not count. `unit` is the length of the scene's unit.
    #[must_use]
    pub fn weight_at(&self, query: &CacheQuery, unit: f64) -> f64 {
        if query.is_far_from(self.point, self.radius) {
            return 0.0;
        }
        let offset = query.point - self.point;
        let farthest = self.radius * query.error;
        let distance = offset.length();
        if distance >= farthest {
            return 0.0;
        }
        let (mut radius, mut front) = (self.radius, 1.0);
        if distance > SAME * unit {
            let to_nearest = self.to_nearest.dot(offset) / distance;
            if to_nearest > 0.0 {
                radius = to_nearest * self.nearest + (1.0 - to_nearest) * radius;
                if distance >= radius * query.error {
                    return 0.0;
                }
            }
            let between = query.normal + self.normal;
            front = offset.dot(between) / (distance * between.length());
        }
        let turn = (1.0 - query.normal.dot(self.normal)).abs().sqrt();
        let error = distance / radius + 2.0 * turn;
        // Points behind the sample are lit by light that it cannot see.
        if !(error < query.error && front > -BEHIND) {
            return 0.0;
        }
        let share = error / query.error;
        let mut weight = match (query.is_smooth, share < 0.5) {
            (false, _) => 1.0 - share,
            (true, true) => 1.0 - 2.0 * share * share,
            (true, false) => 2.0 * (1.0 - share) * (1.0 - share),
        };
        if front <= 0.0 {
            weight *= 1.0 + front / BEHIND;
        }
        if weight > MIN_WEIGHT {
            weight * self.quality
        } else {
            0.0
        }
    }
}

impl CacheQuery {
    /// Returns true if a sample is too far away to count, by its radius. Most are, and this needs no square root.
    #[inline(always)]
    fn is_far_from(&self, point: DVec3, radius: f64) -> bool {
        let farthest = radius * self.error;
        let distance_sq = (self.point - point).length_squared();
        distance_sq > farthest * farthest * (1.0 + ROUNDINGS * f64::EPSILON)
    }
}

impl Cache {
    /// An empty cache; `unit` is the length of the scene's unit.
    #[must_use]
    pub fn new(unit: f64) -> Self {
        Cache {
            samples: Vec::new(),
            rows: Vec::new(),
            nodes: Vec::new(),
            root: NONE,
            unit,
        }
    }

    /// The samples in the order in which they were added.
    #[must_use]
    pub fn samples(&self) -> &[IrradianceSample] {
        &self.samples
    }

    /// Its memory in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.samples.len() * size_of::<IrradianceSample>()
            + self.rows.len() * size_of::<Row>()
            + self.nodes.len() * size_of::<Node>()
    }

    /// The length of the scene's unit.
    #[must_use]
    pub fn unit(&self) -> f64 {
        self.unit
    }

    /// Adds a sample that may be used within a distance.
    pub fn add(&mut self, sample: IrradianceSample, reach: f64) {
        let number = u32::try_from(self.samples.len()).unwrap_or(NONE);
        let (point, reach) = (sample.point / self.unit, reach / self.unit);
        let is_sound = point.abs().max_element() < FARTHEST && reach > 0.0;
        if number == NONE || !is_sound {
            return;
        }
        let cell = Cell::around(point, reach);
        let at = self.node(cell, 1 << sample.depth);
        let row = self.row(at, sample.depth);
        for (points, x) in row.points.iter_mut().zip(sample.point.to_array()) {
            points[row.count] = x;
        }
        row.radii[row.count] = sample.radius;
        row.samples[row.count] = number;
        row.count += 1;
        self.samples.push(sample);
    }

    /// The last row of a node and a depth, with a free slot.
    fn row(&mut self, node: usize, depth: usize) -> &mut Row {
        let mut at = self.nodes[node].last;
        while at != NONE && self.rows[at as usize].depth != depth {
            at = self.rows[at as usize].earlier;
        }
        if at == NONE || self.rows[at as usize].count == ROW {
            at = u32::try_from(self.rows.len()).unwrap_or(NONE);
            self.rows.push(Row {
                depth,
                count: 0,
                earlier: self.nodes[node].last,
                samples: [NONE; ROW],
                points: [[f64::INFINITY; ROW]; 3],
                radii: [0.0; ROW],
            });
            self.nodes[node].last = at;
        }
        &mut self.rows[at as usize]
    }

    fn push(&mut self, cell: Cell) -> u32 {
        let number = u32::try_from(self.nodes.len()).unwrap_or(NONE);
        self.nodes.push(Node {
            cell,
            cube: cell.cube(),
            children: [NONE; 8],
            last: NONE,
            depths: 0,
        });
        number
    }

    /// The node of a cell, created on demand; marks it and its ancestors with these depths.
    fn node(&mut self, cell: Cell, depths: u32) -> usize {
        if self.root == NONE {
            self.root = self.push(cell);
        }
        loop {
            let root = self.nodes[self.root as usize].cell;
            if root.level >= cell.level && cell.at_level(root.level) == root {
                break;
            }
            let above = self.push(root.parent());
            self.nodes[above as usize].children[root.child_index()] = self.root;
            self.nodes[above as usize].depths = self.nodes[self.root as usize].depths;
            self.root = above;
        }
        let mut at = self.root as usize;
        loop {
            self.nodes[at].depths |= depths;
            let level = self.nodes[at].cell.level;
            if level == cell.level {
                return at;
            }
            let child = cell.at_level(level - 1);
            let slot = child.child_index();
            if self.nodes[at].children[slot] == NONE {
                self.nodes[at].children[slot] = self.push(child);
            }
            at = self.nodes[at].children[slot] as usize;
        }
    }

    /// The weighted mean of the samples at a point.
    #[must_use]
    pub fn mean(&self, query: &CacheQuery) -> Mean {
        let mut mean = Mean::default();
        if self.root != NONE {
            let point = query.point / self.unit;
            self.add_from(self.root, point, query, &mut mean);
        }
        mean
    }

    /// Adds the samples of a node and its children.
    fn add_from(&self, number: u32, point: DVec3, query: &CacheQuery, mean: &mut Mean) {
        let node = &self.nodes[number as usize];
        if node.depths >> query.depth & 1 == 0 || number != self.root && !node.cube.holds(point) {
            return;
        }
        let mut next = node.last;
        while next != NONE {
            let row = &self.rows[next as usize];
            next = row.earlier;
            if row.depth != query.depth {
                continue;
            }
            let mut near = row.near(query);
            // The newest sample comes first.
            while let Some(slot) = near.checked_ilog2() {
                near ^= 1 << slot;
                let sample = &self.samples[row.samples[slot as usize] as usize];
                let weight = sample.weight_at(query, self.unit);
                if weight > 0.0 {
                    mean.weight += weight;
                    mean.sum += sample.light * weight;
                }
            }
        }
        for &child in node.children.iter().filter(|&&child| child != NONE) {
            self.add_from(child, point, query, mean);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::sampling::random::Random;

    fn sample(point: DVec3, radius: f64) -> IrradianceSample {
        IrradianceSample {
            point,
            normal: DVec3::Y,
            light: Rgb::WHITE,
            radius,
            nearest: radius,
            to_nearest: DVec3::Y,
            quality: 1.0,
            depth: 0,
        }
    }

    fn query(point: DVec3) -> CacheQuery {
        CacheQuery {
            point,
            normal: DVec3::Y,
            error: 1.5,
            depth: 0,
            is_smooth: false,
        }
    }

    /// The weights of the fact sheet, computed by hand.
    #[test]
    fn weights_fall_with_distance_and_angle() {
        let sample = sample(DVec3::ZERO, 2.0);
        let weight = |query: &CacheQuery| sample.weight_at(query, 1.0);
        assert_eq!(weight(&query(DVec3::ZERO)), 1.0);
        assert!((weight(&query(DVec3::X)) - (1.0 - 0.5 / 1.5)).abs() < 1e-12);
        assert_eq!(weight(&query(DVec3::X * 3.0)), 0.0);
        let smooth = CacheQuery {
            is_smooth: true,
            ..query(DVec3::X)
        };
        assert!((weight(&smooth) - (1.0 - 2.0 / 9.0)).abs() < 1e-12);
        // Behind the common plane nothing counts; just behind it weights are small.
        assert_eq!(weight(&query(DVec3::new(1.0, -0.2, 0.0))), 0.0);
        let behind = query(DVec3::new(1.0, -0.025, 0.0));
        let share = 1.0 - 1.0003f64 / 2.0 / 1.5;
        assert!((weight(&behind) - share * 0.5).abs() < 1e-3);
    }

    #[test]
    fn no_sample_of_the_first_depth_is_lost() {
        let mut rng = Random::new(7);
        let mut cache = Cache::new(1.0);
        let random_point = |rng: &mut Random| {
            DVec3::new(rng.uniform(), 0.1 * rng.uniform(), rng.uniform()) * 20.0 - 10.0
        };
        for _ in 0..500 {
            let (point, radius) = (
                random_point(&mut rng),
                0.01 + rng.uniform() * rng.uniform() * 3.0,
            );
            cache.add(sample(point, radius), radius * 1.5);
        }
        for _ in 0..500 {
            let query = query(random_point(&mut rng));
            let all = cache
                .samples
                .iter()
                .map(|sample| sample.weight_at(&query, 1.0));
            let sum: f64 = all.sum();
            assert!((cache.mean(&query).weight - sum).abs() < 1e-9);
            assert_eq!(cache.mean(&CacheQuery { depth: 1, ..query }).weight, 0.0);
        }
    }

    #[test]
    fn points_of_all_sizes_are_stored_but_no_invalid_ones() {
        let mut cache = Cache::new(1.0);
        for (at, reach) in [(0.0, 1e-30), (-3e7, 1.0), (4e9, 1e30), (1.0, f64::MAX)] {
            cache.add(sample(DVec3::splat(at), 1.0), reach);
        }
        assert_eq!(cache.samples().len(), 4);
        for (at, reach) in [(f64::NAN, 1.0), (1e13, 1.0), (0.0, f64::NAN), (0.0, -1.0)] {
            cache.add(sample(DVec3::splat(at), 1.0), reach);
        }
        assert_eq!(cache.samples().len(), 4);
    }
}
