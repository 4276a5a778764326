//! Light that was gathered, by place.
//!
//! Samples lie in an octree (Ward, Rubinstein and Clear 1988): in a cell about as large as the distance to which they may
//! be used, so that they are found from its double. POV-Ray's cells are these, and as it looks no further samples beyond
//! the first depth may be lost; so the same are lost here.

use super::cell::{Cell, Cube};
use crate::base::color::Rgb;
use glam::DVec3;

/// No sample, no node.
const NONE: u32 = u32::MAX;
/// Nearer than this two points are one.
const SAME: f64 = 1e-6;
/// How far behind a sample's plane a point may lie, as a sine.
const BEHIND: f64 = 0.05;
/// Samples of less weight do not count.
const LEAST_WEIGHT: f64 = 0.001;
/// More roundings than two squares differ by whose roots are the same.
const ROUNDINGS: f64 = 8.0;
/// Farther from the origin nothing is kept.
const FARTHEST: f64 = (1u64 << 40) as f64;

/// Light that arrives at a point.
#[derive(Clone, Copy, Debug)]
pub struct IrradianceSample {
    /// Where.
    pub point: DVec3,
    /// The unit normal on the side where it arrives.
    pub normal: DVec3,
    /// How much, as the mean over the half sphere by the cosine.
    pub light: Rgb,
    /// The harmonic mean of the distances of what it comes from, within the limits of reuse.
    pub radius: f64,
    /// The distance of the nearest of that.
    pub nearest: f64,
    /// The unit direction to it.
    pub to_nearest: DVec3,
    /// The quality of the light that it was gathered from, up to 1.
    pub quality: f64,
    /// How many mirrors of diffuse light lie before it.
    pub depth: usize,
}

/// A place at which light is asked for.
#[derive(Clone, Copy, Debug)]
pub struct CacheQuery {
    /// Where.
    pub point: DVec3,
    /// The unit normal on the side that is seen.
    pub normal: DVec3,
    /// The largest error of a sample that counts.
    pub error: f64,
    /// Of which depth.
    pub depth: usize,
    /// Whether samples fade out smoothly rather than evenly.
    pub is_smooth: bool,
}

/// The weighted mean of the samples that count at a place.
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
    /// The depths of the samples here and in the children, one bit each.
    depths: u32,
}

/// So many samples lie in a row.
const ROW: usize = 8;

/// Samples of one cell and depth in the order in which they came, and what tells most of them to be too far away.
#[derive(Clone, Debug)]
struct Row {
    depth: usize,
    count: usize,
    /// The row that was begun in the same cell before it.
    earlier: u32,
    samples: [u32; ROW],
    /// x, y and z of their points; nowhere where there is no sample.
    points: [[f64; ROW]; 3],
    radii: [f64; ROW],
}

impl Row {
    /// The samples that are not too far from a place to count, one bit each.
    #[inline]
    fn near(&self, look: &CacheQuery) -> u32 {
        let [x, y, z] = &self.points;
        let mut near = [false; ROW];
        for place in 0..ROW {
            let point = DVec3::new(x[place], y[place], z[place]);
            near[place] = !look.is_far_from(point, self.radii[place]);
        }
        (0..ROW).fold(0, |bits, place| bits | u32::from(near[place]) << place)
    }
}

/// The samples.
#[derive(Clone, Debug)]
pub struct Cache {
    samples: Vec<IrradianceSample>,
    rows: Vec<Row>,
    nodes: Vec<Node>,
    root: u32,
    /// The length in which the scene's own lengths count.
    unit: f64,
}

impl IrradianceSample {
    /// The weight with which the sample counts at a place; 0 where it does not. `unit`: that of the scene.
    #[must_use]
    pub fn weight_at(&self, look: &CacheQuery, unit: f64) -> f64 {
        if look.is_far_from(self.point, self.radius) {
            return 0.0;
        }
        let way = look.point - self.point;
        let farthest = self.radius * look.error;
        let distance = way.length();
        if distance >= farthest {
            return 0.0;
        }
        let (mut radius, mut front) = (self.radius, 1.0);
        if distance > SAME * unit {
            let to_nearest = self.to_nearest.dot(way) / distance;
            if to_nearest > 0.0 {
                radius = to_nearest * self.nearest + (1.0 - to_nearest) * radius;
                if distance >= radius * look.error {
                    return 0.0;
                }
            }
            let between = look.normal + self.normal;
            front = way.dot(between) / (distance * between.length());
        }
        let turn = (1.0 - look.normal.dot(self.normal)).abs().sqrt();
        let error = distance / radius + 2.0 * turn;
        // Points behind the sample are lit by what it cannot see.
        if !(error < look.error && front > -BEHIND) {
            return 0.0;
        }
        let share = error / look.error;
        let mut weight = match (look.is_smooth, share < 0.5) {
            (false, _) => 1.0 - share,
            (true, true) => 1.0 - 2.0 * share * share,
            (true, false) => 2.0 * (1.0 - share) * (1.0 - share),
        };
        if front <= 0.0 {
            weight *= 1.0 + front / BEHIND;
        }
        if weight > LEAST_WEIGHT {
            weight * self.quality
        } else {
            0.0
        }
    }
}

impl CacheQuery {
    /// Whether a sample at a point is too far away to count, by its radius: most are, and need no root.
    #[inline(always)]
    fn is_far_from(&self, point: DVec3, radius: f64) -> bool {
        let farthest = radius * self.error;
        let distance_sq = (self.point - point).length_squared();
        distance_sq > farthest * farthest * (1.0 + ROUNDINGS * f64::EPSILON)
    }
}

impl Cache {
    /// An empty one. `unit`: the length in which the scene's own lengths count.
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

    /// The samples in the order in which they came.
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

    /// The length in which the scene's own lengths count.
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

    /// The last row of a node and a depth, with a place in it.
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

    /// The node of a cell, made if there is none; it and those around it get samples of these depths.
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
            self.nodes[above as usize].children[root.place()] = self.root;
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
            let place = child.place();
            if self.nodes[at].children[place] == NONE {
                self.nodes[at].children[place] = self.push(child);
            }
            at = self.nodes[at].children[place] as usize;
        }
    }

    /// What the samples say of a place.
    #[must_use]
    pub fn mean(&self, look: &CacheQuery) -> Mean {
        let mut mean = Mean::default();
        if self.root != NONE {
            let point = look.point / self.unit;
            self.add_from(self.root, point, look, &mut mean);
        }
        mean
    }

    /// Adds what the samples of a node and its children say.
    fn add_from(&self, number: u32, point: DVec3, look: &CacheQuery, mean: &mut Mean) {
        let node = &self.nodes[number as usize];
        if node.depths >> look.depth & 1 == 0 || number != self.root && !node.cube.holds(point) {
            return;
        }
        let mut next = node.last;
        while next != NONE {
            let row = &self.rows[next as usize];
            next = row.earlier;
            if row.depth != look.depth {
                continue;
            }
            let mut near = row.near(look);
            // The last that came is the first that counts.
            while let Some(place) = near.checked_ilog2() {
                near ^= 1 << place;
                let sample = &self.samples[row.samples[place as usize] as usize];
                let weight = sample.weight_at(look, self.unit);
                if weight > 0.0 {
                    mean.weight += weight;
                    mean.sum += sample.light * weight;
                }
            }
        }
        for &child in node.children.iter().filter(|&&child| child != NONE) {
            self.add_from(child, point, look, mean);
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

    fn look(point: DVec3) -> CacheQuery {
        CacheQuery {
            point,
            normal: DVec3::Y,
            error: 1.5,
            depth: 0,
            is_smooth: false,
        }
    }

    /// The weights of the fact sheet, by hand.
    #[test]
    fn weights_fall_with_distance_and_turn() {
        let sample = sample(DVec3::ZERO, 2.0);
        let weight = |look: &CacheQuery| sample.weight_at(look, 1.0);
        assert_eq!(weight(&look(DVec3::ZERO)), 1.0);
        assert!((weight(&look(DVec3::X)) - (1.0 - 0.5 / 1.5)).abs() < 1e-12);
        assert_eq!(weight(&look(DVec3::X * 3.0)), 0.0);
        let smooth = CacheQuery {
            is_smooth: true,
            ..look(DVec3::X)
        };
        assert!((weight(&smooth) - (1.0 - 2.0 / 9.0)).abs() < 1e-12);
        // Behind the plane of both nothing counts, just behind it little does.
        assert_eq!(weight(&look(DVec3::new(1.0, -0.2, 0.0))), 0.0);
        let behind = look(DVec3::new(1.0, -0.025, 0.0));
        let share = 1.0 - 1.0003f64 / 2.0 / 1.5;
        assert!((weight(&behind) - share * 0.5).abs() < 1e-3);
    }

    #[test]
    fn no_sample_of_the_first_depth_is_lost() {
        let mut rng = Random::new(7);
        let mut cache = Cache::new(1.0);
        let place = |rng: &mut Random| {
            DVec3::new(rng.share(), 0.1 * rng.share(), rng.share()) * 20.0 - 10.0
        };
        for _ in 0..500 {
            let (point, radius) = (place(&mut rng), 0.01 + rng.share() * rng.share() * 3.0);
            cache.add(sample(point, radius), radius * 1.5);
        }
        for _ in 0..500 {
            let look = look(place(&mut rng));
            let all = cache
                .samples
                .iter()
                .map(|sample| sample.weight_at(&look, 1.0));
            let sum: f64 = all.sum();
            assert!((cache.mean(&look).weight - sum).abs() < 1e-9);
            assert_eq!(cache.mean(&CacheQuery { depth: 1, ..look }).weight, 0.0);
        }
    }

    #[test]
    fn places_of_all_sizes_are_kept_and_what_is_none_is_not() {
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
