//! BVH construction: binned surface area heuristic (Wald 2007, "On fast construction of SAH-based bounding volume
//! hierarchies"), eight children at once.
//!
//! A node begins as one range of items. Its range with the largest surface area is split until there are eight, or
//! until none has more than eight items: splitting those as well would leave nodes half empty and the tree 60 % larger.
//! Each split depends on the items of its range alone, so the tree is the same for any number of threads.
//!
//! Each split reads the items twice: once to bin them, and once to partition them, which also computes all that the
//! splits of both halves need.
//!
//! Large lists are first divided into clusters; see [`treelets`](super::treelets).

use super::LeafItems;
use super::node::{Aabb32, Child, Node, WIDTH, max_f32, min_f32};
use super::sphere_leaf::SphereLeaf;
use rayon::prelude::*;

/// Number of bins per axis.
const BINS: usize = 16;

/// Number of bins for small ranges, where evaluating the bins costs more than reading the items.
const SMALL_RANGE_BINS: usize = 8;

/// Maximum number of items of a small range.
const SMALL_RANGE: usize = 64;

/// Below this depth ranges are halved by count alone: no arrangement of boxes makes the tree much deeper.
const MAX_DEPTH: u32 = 64;

/// Ranges with more items are processed by several threads.
pub(super) const PARALLEL_THRESHOLD: usize = 32_768;

/// Doubled box centres are clamped to this; those of finite boxes are near one.
const MAX_COORDINATE: f32 = 2e18;

/// 2²³: adding it to a float leaves no bits for the fraction, so the low bits hold the nearest integer.
const ROUND_TO_INTEGER: f32 = 8_388_608.0;

/// An item with its box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) aabb: Aabb32,
    /// The number of the item, and a flag in the top bit if it is a sphere.
    item_and_flag: u32,
}

/// A tree under construction.
#[derive(Debug, Default)]
pub(super) struct GrowingBvh {
    pub(super) root: Option<Child>,
    pub(super) nodes: Vec<Node>,
    pub(super) sphere_leaves: Vec<SphereLeaf>,
    /// The items of the sphere leaves.
    pub(super) leaf_items: Vec<LeafItems>,
}

/// A box in four lanes, which one instruction processes; the last lane is unused.
#[derive(Clone, Copy)]
pub(super) struct Aabb4 {
    pub(super) low: [f32; 4],
    pub(super) high: [f32; 4],
}

/// A range of items with its bounds.
pub(super) struct BuildRange<'e> {
    pub(super) entries: &'e mut [Entry],
    pub(super) whole: Aabb4,
    /// Bounds of the doubled box centres.
    pub(super) middles: Aabb4,
}

/// The bins of a range: where they begin on each axis, and their number per unit of length.
struct Bins {
    start: [f32; 4],
    per_length: [f32; 4],
    last: f32,
}

/// The items in the bins of each axis: their bounding boxes and their counts.
struct BinTotals<const COUNT: usize> {
    boxes: [[Aabb4; COUNT]; 3],
    counts: [[u32; COUNT]; 3],
}

/// A split: the first bin of the upper part on an axis, and the boxes of both parts.
struct Split {
    cost: f32,
    axis: usize,
    bin: usize,
    lower: Aabb4,
    upper: Aabb4,
}

/// Builds the tree of a range in a single thread, without treelets.
pub(super) fn build_small(part: BuildRange) -> GrowingBvh {
    let mut tree = GrowingBvh::with_capacity_for(
        part.entries.len(),
        part.entries.iter().all(Entry::is_sphere),
    );
    tree.root = Some(tree.add(part, 0));
    tree
}

impl GrowingBvh {
    /// An empty tree with capacity for as many nodes and sphere leaves as that many items mostly need; they hardly ever
    /// need more.
    pub(super) fn with_capacity_for(items: usize, are_spheres: bool) -> Self {
        let leaf_count = items / 4 + 1;
        let (nodes, sphere_leaves) = if are_spheres {
            (leaf_count / 5 + 1, leaf_count)
        } else {
            (leaf_count, 0)
        };
        GrowingBvh {
            nodes: Vec::with_capacity(nodes),
            sphere_leaves: Vec::with_capacity(sphere_leaves),
            leaf_items: Vec::with_capacity(sphere_leaves),
            ..GrowingBvh::default()
        }
    }

    /// Appends the subtree of a range; returns its root.
    pub(super) fn add(&mut self, part: BuildRange, depth: u32) -> Child {
        let entries = &part.entries;
        let is_leaf = entries.len() <= WIDTH;
        if is_leaf && entries.iter().all(Entry::is_sphere) {
            return self.add_block(entries);
        }
        let number = self.nodes.len();
        self.nodes.push(Node::empty());
        if is_leaf {
            for (slot, entry) in entries.iter().enumerate() {
                self.nodes[number].set(slot, &entry.aabb, Child::of_item(entry.item()));
            }
        } else {
            for (slot, part) in split_to_width(part, depth).into_iter().enumerate() {
                let whole = part.whole.aabb();
                let child = self.add(part, depth + 1);
                self.nodes[number].set(slot, &whole, child);
            }
        }
        Child::of_node(index(number))
    }

    fn add_block(&mut self, entries: &[Entry]) -> Child {
        let (mut leaf, mut leaf_items) = (SphereLeaf::EMPTY, [0; WIDTH]);
        for (slot, entry) in entries.iter().enumerate() {
            leaf.set(slot, &entry.aabb);
            leaf_items[slot] = entry.item();
        }
        self.sphere_leaves.push(leaf);
        self.leaf_items.push(leaf_items);
        Child::of_leaf(index(self.sphere_leaves.len() - 1))
    }
}

pub(super) fn index(i: usize) -> u32 {
    u32::try_from(i).expect("a tree has fewer nodes than items, and these are counted in 30 bits")
}

/// Splits a range of more than eight items into at most eight ranges, none of them empty.
fn split_to_width(part: BuildRange, depth: u32) -> Vec<BuildRange> {
    let mut parts = Vec::with_capacity(WIDTH);
    parts.push((0.0, part));
    while parts.len() < WIDTH {
        let widest = (0..parts.len())
            .filter(|&i| parts[i].1.entries.len() > WIDTH)
            .max_by(|&a, &b| f32::total_cmp(&parts[a].0, &parts[b].0));
        let Some(widest) = widest else {
            break;
        };
        let (_, part) = parts.swap_remove(widest);
        for half in part.halve(depth) {
            parts.push((half.whole.half_area(), half));
        }
    }
    parts.into_iter().map(|(_, part)| part).collect()
}

impl Aabb4 {
    const EMPTY: Aabb4 = Aabb4 {
        low: [f32::INFINITY; 4],
        high: [f32::NEG_INFINITY; 4],
    };

    #[inline(always)]
    fn of(aabb: &Aabb32) -> Self {
        let ([a, b, c], [d, e, f]) = (aabb.low, aabb.high);
        Aabb4 {
            low: [a, b, c, 0.0],
            high: [d, e, f, 0.0],
        }
    }

    pub(super) fn aabb(&self) -> Aabb32 {
        let ([a, b, c, _], [d, e, f, _]) = (self.low, self.high);
        Aabb32 {
            low: [a, b, c],
            high: [d, e, f],
        }
    }

    #[inline(always)]
    fn add(&mut self, other: &Aabb4) {
        for lane in 0..4 {
            self.low[lane] = min_f32(other.low[lane], self.low[lane]);
            self.high[lane] = max_f32(other.high[lane], self.high[lane]);
        }
    }

    #[inline(always)]
    fn add_point(&mut self, point: [f32; 4]) {
        self.add(&Aabb4 {
            low: point,
            high: point,
        });
    }

    /// Adds a point if the condition holds, without a branch.
    #[inline(always)]
    fn add_point_if(&mut self, condition: bool, point: [f32; 4]) {
        let mask = 0_u32.wrapping_sub(u32::from(condition));
        let (mut low, mut high) = ([0.0; 4], [0.0; 4]);
        for (lane, point) in point.iter().enumerate() {
            let point = point.to_bits() & mask;
            low[lane] = f32::from_bits(point | f32::INFINITY.to_bits() & !mask);
            high[lane] = f32::from_bits(point | f32::NEG_INFINITY.to_bits() & !mask);
        }
        self.add(&Aabb4 { low, high });
    }

    /// True if its extent is zero on all axes.
    pub(super) fn is_point(&self) -> bool {
        (0..3).all(|axis| self.low[axis] == self.high[axis])
    }

    /// Half the surface area.
    #[inline(always)]
    fn half_area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|axis| self.high[axis] - self.low[axis]);
        x * y + y * z + z * x
    }
}

impl Entry {
    /// Set where the item is a sphere.
    const IS_SPHERE: u32 = 1 << 31;

    pub(super) fn new(aabb: Aabb32, item: u32, is_sphere: bool) -> Self {
        // An infinite sphere has no usable centre.
        let is_known = || {
            aabb.low
                .iter()
                .chain(&aabb.high)
                .all(|end| end.abs() < MAX_COORDINATE)
        };
        let flag = if is_sphere && is_known() {
            Entry::IS_SPHERE
        } else {
            0
        };
        Entry {
            aabb,
            item_and_flag: item | flag,
        }
    }

    pub(super) fn item(&self) -> u32 {
        self.item_and_flag & !Entry::IS_SPHERE
    }

    pub(super) fn is_sphere(&self) -> bool {
        self.item_and_flag & Entry::IS_SPHERE != 0
    }

    /// Twice the centre of the box, clamped to finite values.
    #[inline(always)]
    pub(super) fn middle(&self) -> [f32; 4] {
        let wide = Aabb4::of(&self.aabb);
        let mut middle = [0.0; 4];
        for (lane, middle) in middle.iter_mut().enumerate() {
            *middle = min_f32(
                max_f32(wide.low[lane] + wide.high[lane], -MAX_COORDINATE),
                MAX_COORDINATE,
            );
        }
        middle
    }
}

impl<'e> BuildRange<'e> {
    pub(super) fn new(entries: &'e mut [Entry]) -> Self {
        let around = |entries: &[Entry]| {
            let (mut whole, mut middles) = (Aabb4::EMPTY, Aabb4::EMPTY);
            for entry in entries {
                whole.add(&Aabb4::of(&entry.aabb));
                middles.add_point(entry.middle());
            }
            (whole, middles)
        };
        let (whole, middles) = if entries.len() > PARALLEL_THRESHOLD {
            let parts = entries.par_chunks(PARALLEL_THRESHOLD / 2).map(around);
            parts.reduce(
                || (Aabb4::EMPTY, Aabb4::EMPTY),
                |mut all, more| {
                    all.0.add(&more.0);
                    all.1.add(&more.1);
                    all
                },
            )
        } else {
            around(entries)
        };
        BuildRange {
            entries,
            whole,
            middles,
        }
    }

    /// Splits it in two, at the bin border of least cost, or in the middle of the list if the bins do not separate the
    /// items.
    fn halve(self, depth: u32) -> [BuildRange<'e>; 2] {
        let split = if depth >= MAX_DEPTH {
            None
        } else if self.entries.len() <= SMALL_RANGE {
            self.cheapest::<SMALL_RANGE_BINS>()
        } else {
            self.cheapest::<BINS>()
        };
        match split {
            Some((bins, split)) => self.split_at(&bins, &split),
            None => {
                let middle = self.entries.len() / 2;
                let (lower, upper) = self.entries.split_at_mut(middle);
                [BuildRange::new(lower), BuildRange::new(upper)]
            }
        }
    }

    /// The split with the least sum of surface area times item count; none if all centres coincide.
    fn cheapest<const COUNT: usize>(&self) -> Option<(Bins, Split)> {
        let bins = Bins::new::<COUNT>(&self.middles);
        let BinTotals { boxes, counts } = &BinTotals::<COUNT>::new(&bins, self.entries);
        let mut best: Option<Split> = None;
        for axis in (0..3).filter(|&axis| bins.per_length[axis] > 0.0) {
            let least = best.as_ref().map_or(f32::INFINITY, |best| best.cost);
            if let Some(split) = cheapest_border(axis, &boxes[axis], &counts[axis], least) {
                best = Some(split);
            }
        }
        best.map(|split| (bins, split))
    }

    /// Partitions the items, those below the split first. The side of an item is unpredictable, so the loop has no
    /// branch that depends on it.
    fn split_at(self, bins: &Bins, split: &Split) -> [BuildRange<'e>; 2] {
        let entries = self.entries;
        let (mut lower, mut upper) = (Aabb4::EMPTY, Aabb4::EMPTY);
        let mut front = 0;
        for at in 0..entries.len() {
            let entry = entries[at];
            let is_lower = (bins.of(&entry)[split.axis] as usize) < split.bin;
            let middle = entry.middle();
            lower.add_point_if(is_lower, middle);
            upper.add_point_if(!is_lower, middle);
            entries[at] = entries[front];
            entries[front] = entry;
            front += usize::from(is_lower);
        }
        let (below, above) = entries.split_at_mut(front);
        [
            BuildRange {
                entries: below,
                whole: split.lower,
                middles: lower,
            },
            BuildRange {
                entries: above,
                whole: split.upper,
                middles: upper,
            },
        ]
    }
}

impl<const COUNT: usize> BinTotals<COUNT> {
    fn empty() -> Self {
        BinTotals {
            boxes: [[Aabb4::EMPTY; COUNT]; 3],
            counts: [[0; COUNT]; 3],
        }
    }

    #[inline(always)]
    fn new(bins: &Bins, entries: &[Entry]) -> Self {
        let mut filled = Self::empty();
        for entry in entries {
            let wide = Aabb4::of(&entry.aabb);
            let [x, y, z, _] = bins.of(entry);
            for (axis, bin) in [x, y, z].into_iter().enumerate() {
                let bin = bin as usize % COUNT;
                filled.boxes[axis][bin].add(&wide);
                filled.counts[axis][bin] += 1;
            }
        }
        filled
    }
}

impl Bins {
    #[allow(clippy::cast_precision_loss, reason = "16 is exact")]
    fn new<const COUNT: usize>(middles: &Aabb4) -> Self {
        let last = (COUNT - 1) as f32;
        let mut per_length = [0.0; 4];
        for (axis, per_length) in per_length[..3].iter_mut().enumerate() {
            let by = last / (middles.high[axis] - middles.low[axis]);
            if by.is_finite() {
                *per_length = by;
            }
        }
        Bins {
            start: middles.low,
            per_length,
            last,
        }
    }

    /// The bins of an item on the three axes: those with the nearest centres.
    #[inline(always)]
    fn of(&self, entry: &Entry) -> [u32; 4] {
        let middle = entry.middle();
        let mut bins = [0; 4];
        for lane in 0..4 {
            let at = (middle[lane] - self.start[lane]) * self.per_length[lane];
            let at = min_f32(max_f32(at, 0.0), self.last);
            bins[lane] = (at + ROUND_TO_INTEGER).to_bits() & 0xff;
        }
        bins
    }
}

/// The cheapest border between two bins with items on both sides, if it costs less than `least`. The first and the last
/// bin are never empty.
#[allow(
    clippy::cast_precision_loss,
    reason = "a cost needs no more than seven digits"
)]
fn cheapest_border<const COUNT: usize>(
    axis: usize,
    boxes: &[Aabb4; COUNT],
    counts: &[u32; COUNT],
    mut least: f32,
) -> Option<Split> {
    let mut above = [(0.0, Aabb4::EMPTY); COUNT];
    let (mut aabb, mut count) = (Aabb4::EMPTY, 0);
    for bin in (1..COUNT).rev() {
        aabb.add(&boxes[bin]);
        count += counts[bin];
        above[bin] = (aabb.half_area() * count as f32, aabb);
    }
    let (mut aabb, mut count) = (Aabb4::EMPTY, 0);
    let mut best = None;
    for bin in 1..COUNT {
        aabb.add(&boxes[bin - 1]);
        count += counts[bin - 1];
        let cost = aabb.half_area() * count as f32 + above[bin].0;
        if cost < least {
            least = cost;
            best = Some((bin, aabb));
        }
    }
    best.map(|(bin, lower)| Split {
        cost: least,
        axis,
        bin,
        lower,
        upper: above[bin].1,
    })
}
