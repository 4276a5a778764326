//! The irradiance cache.
//!
//! Samples lie in an octree (Ward, Rubinstein and Clear 1988), in a cell about as large as the distance within which
//! they are used, so the cell of twice the size finds them. The cells are POV-Ray's. It does not search neighbouring
//! cells, so samples beyond the first depth may be lost; the same ones are lost here.

use super::cell::{Cell, Cube};
use super::lists::Mean;
use super::sample::{CacheQuery, IrradianceSample};
use glam::DVec3;

/// No sample or node.
const NONE: u32 = u32::MAX;
/// Samples farther from the origin are not stored.
const FARTHEST: f64 = (1u64 << 40) as f64;

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

/// Samples of one cell and depth in the order in which they were added.
#[derive(Clone, Debug)]
struct Row {
    depth: usize,
    count: usize,
    /// The previous row of the same cell.
    earlier: u32,
    samples: [u32; ROW],
}

/// The cache of irradiance samples.
#[derive(Clone, Debug)]
pub struct Cache {
    samples: Vec<IrradianceSample>,
    /// The sum of the levels of the cells, and the number, of the samples of each depth.
    levels: Vec<[i64; 2]>,
    rows: Vec<Row>,
    nodes: Vec<Node>,
    root: u32,
    /// The length of the scene's unit.
    unit: f64,
}

impl Cache {
    /// An empty cache; `unit` is the length of the scene's unit.
    #[must_use]
    pub fn new(unit: f64) -> Self {
        Cache {
            samples: Vec::new(),
            levels: Vec::new(),
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
        let depths = self.levels.len().max(sample.depth + 1);
        self.levels.resize(depths, [0; 2]);
        let [levels, count] = &mut self.levels[sample.depth];
        *levels += i64::from(cell.level);
        *count += 1;
        let at = self.node(cell, 1 << sample.depth);
        let row = self.row(at, sample.depth);
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
    pub(super) fn mean(&self, query: &CacheQuery) -> Mean {
        let point = query.point / self.unit;
        let mut mean = Mean::default();
        self.visit(query.depth, [point, DVec3::ZERO], &mut |number, cube| {
            let sample = &self.samples[number as usize];
            let weight = sample.weight_at(query, self.unit);
            if weight > 0.0 && cube.holds(point) {
                mean.weight += weight;
                mean.sum += sample.light * weight;
            }
        });
        mean
    }

    /// The number of the root node.
    pub(super) fn root(&self) -> u32 {
        self.root
    }

    /// The level of the cell of a sample of a depth, on average.
    pub(super) fn mean_level(&self, depth: usize) -> i32 {
        let [levels, count] = self.levels.get(depth).copied().unwrap_or_default();
        i32::try_from(levels / count.max(1)).unwrap_or(0)
    }

    /// Calls `each` for the samples of a depth that a lookup in a box may find, in the order of a lookup, with the cube
    /// in which they are found. `centre` and `half`, half the edge, are in units of the scene's unit.
    pub(super) fn visit(
        &self,
        depth: usize,
        [centre, half]: [DVec3; 2],
        each: &mut impl FnMut(u32, Cube),
    ) {
        if self.root != NONE {
            self.visit_from(self.root, depth, [centre, half], each);
        }
    }

    /// Visits the samples of a node and its children.
    fn visit_from(
        &self,
        number: u32,
        depth: usize,
        area: [DVec3; 2],
        each: &mut impl FnMut(u32, Cube),
    ) {
        let node = &self.nodes[number as usize];
        // The root is searched for all points.
        let cube = if number == self.root {
            Cube::EVERYTHING
        } else {
            node.cube
        };
        if node.depths >> depth & 1 == 0 || !cube.may_hold(area) {
            return;
        }
        let mut next = node.last;
        while next != NONE {
            let row = &self.rows[next as usize];
            next = row.earlier;
            if row.depth == depth {
                // The newest sample comes first.
                for &sample in row.samples[..row.count].iter().rev() {
                    each(sample, cube);
                }
            }
        }
        // Others are not even read.
        let near = node.cube.octants_near(area);
        for (index, &child) in node.children.iter().enumerate() {
            if child != NONE && near >> index & 1 == 1 {
                self.visit_from(child, depth, area, each);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::sampling::random::Random;
    use crate::render::radiosity::SampleLists;
    use crate::render::radiosity::sample::tests::sample;

    #[test]
    fn lists_have_the_samples_of_a_traversal_and_none_of_the_first_depth_is_lost() {
        let mut rng = Random::new(7);
        let mut cache = Cache::new(1.0);
        let mut lists = SampleLists::default();
        for number in 0..3000 {
            // The octree grows with the region.
            let size = f64::from(number / 100) + 1.0;
            let mut random_point = || {
                DVec3::new(rng.uniform(), 0.1 * rng.uniform(), rng.uniform()) * size - 0.5 * size
            };
            let depth = number % 2;
            let query = CacheQuery {
                point: random_point(),
                normal: DVec3::Y,
                error: if number % 7 == 0 { 1.5 } else { 1.2 },
                depth: usize::from(depth == 1),
                brilliance: if number % 11 == 0 { 2.0 } else { 1.0 },
                is_smooth: number % 3 == 0,
            };
            let mean = lists.mean(&cache, &query);
            let expected = cache.mean(&query);
            assert_eq!(mean.weight.to_bits(), expected.weight.to_bits());
            assert_eq!(mean.sum, expected.sum);
            if depth == 0 {
                let all = cache.samples.iter().filter(|sample| sample.depth == 0);
                let sum: f64 = all.map(|sample| sample.weight_at(&query, 1.0)).sum();
                assert!((mean.weight - sum).abs() < 1e-9);
            }
            if number % 5 < 2 {
                let point = random_point();
                let radius = 0.01 + rng.uniform() * rng.uniform() * 3.0;
                let depth = usize::from(number % 5 == 1);
                let reach = radius * if depth == 0 { 1.5 } else { 1.5 / 8.0 };
                let sample = sample(point, radius);
                let brilliance = if number % 3 == 0 { 2.0 } else { 1.0 };
                let sample = IrradianceSample {
                    depth,
                    brilliance,
                    ..sample
                };
                cache.add(sample, reach);
            }
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
