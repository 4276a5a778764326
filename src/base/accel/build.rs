//! Building: binned surface area heuristic (Wald 2007, "On fast construction of SAH-based bounding volume hierarchies"),
//! eight children at once.
//!
//! A node begins as one range of items. Its range with the largest surface is split until there are eight, or until none
//! has more than eight items: splitting those, too, would leave nodes half empty and the tree 60 % larger. Each split
//! depends on the items of its range alone, so the tree is the same for any number of threads.
//!
//! Items are looked at twice for each split: once to put them into bins, and once to bring them to their sides, which
//! leaves both halves with all that their own splits need.
//!
//! Many items are first brought together in [`treelets`].

use super::node::{Aabb32, Child, Node, WIDTH, larger, smaller};
use super::sphere_leaf::SphereLeaf;
use super::{LeafItems, treelets};
use rayon::prelude::*;

/// How many places for a split are weighed on each axis.
const BINS: usize = 16;

/// The same for ranges of few items, for which it costs more to look at the places than at the items.
const FEW_BINS: usize = 8;

/// Ranges of so many items are few.
const FEW: usize = 64;

/// Below this depth ranges are halved by number alone: no arrangement of boxes makes the tree much deeper.
const MAX_DEPTH: u32 = 64;

/// More items than this are many.
const MANY: usize = 4096;

/// Ranges with more items are split by several threads.
pub(super) const VERY_MANY: usize = 32_768;

/// Twice a middle beyond this is infinite; finite boxes are near one.
const INFINITE: f32 = 2e18;

/// Sums with this have no room for fractions: the nearest whole number stands in their last bits.
const WHOLE: f32 = 8_388_608.0;

/// An item with its box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) cell: Aabb32,
    /// Its number, and a bit more if it is a ball.
    named: u32,
}

/// A tree as it grows.
#[derive(Debug, Default)]
pub(super) struct GrowingBvh {
    pub(super) root: Option<Child>,
    pub(super) nodes: Vec<Node>,
    pub(super) blocks: Vec<SphereLeaf>,
    /// The items of the blocks.
    pub(super) held: Vec<LeafItems>,
}

/// A box in four lanes, which one instruction works on; the last of them means nothing.
#[derive(Clone, Copy)]
pub(super) struct Aabb4 {
    pub(super) low: [f32; 4],
    pub(super) high: [f32; 4],
}

/// A range of items with what is known of it.
pub(super) struct BuildRange<'e> {
    pub(super) entries: &'e mut [Entry],
    pub(super) whole: Aabb4,
    /// Around twice the middles of the boxes.
    pub(super) middles: Aabb4,
}

/// The bins of a range: where they begin on each axis, and how many there are for a length.
struct Bins {
    start: [f32; 4],
    per_length: [f32; 4],
    last: f32,
}

/// What lies in the bins on each axis: the box around it, and how much it is.
struct BinTotals<const COUNT: usize> {
    cells: [[Aabb4; COUNT]; 3],
    counts: [[u32; COUNT]; 3],
}

/// Where to split: the first bin of the upper part on an axis, and the boxes of both parts.
struct Split {
    cost: f32,
    axis: usize,
    bin: usize,
    lower: Aabb4,
    upper: Aabb4,
}

/// The tree of a list of items.
pub(super) fn build(mut entries: Vec<Entry>) -> GrowingBvh {
    if entries.is_empty() {
        return GrowingBvh::default();
    }
    if entries.len() > MANY {
        return treelets::build(entries);
    }
    let mut tree = few(BuildRange::new(&mut entries));
    tree.nodes.shrink_to_fit();
    tree.blocks.shrink_to_fit();
    tree
}

/// The tree of few items.
pub(super) fn few(part: BuildRange) -> GrowingBvh {
    let mut tree =
        GrowingBvh::with_room(part.entries.len(), part.entries.iter().all(Entry::is_ball));
    tree.root = Some(tree.add(part, 0));
    tree
}

impl GrowingBvh {
    /// With room for as many nodes and blocks as so many items mostly have; they hardly ever have more.
    pub(super) fn with_room(items: usize, are_balls: bool) -> Self {
        let leaves = items / 4 + 1;
        let (nodes, blocks) = if are_balls {
            (leaves / 5 + 1, leaves)
        } else {
            (leaves, 0)
        };
        GrowingBvh {
            nodes: Vec::with_capacity(nodes),
            blocks: Vec::with_capacity(blocks),
            held: Vec::with_capacity(blocks),
            ..GrowingBvh::default()
        }
    }

    /// Appends a range and all below it; gives what it is.
    pub(super) fn add(&mut self, part: BuildRange, depth: u32) -> Child {
        let entries = &part.entries;
        let is_leaf = entries.len() <= WIDTH;
        if is_leaf && entries.iter().all(Entry::is_ball) {
            return self.add_block(entries);
        }
        let number = self.nodes.len();
        self.nodes.push(Node::empty());
        if is_leaf {
            for (place, entry) in entries.iter().enumerate() {
                self.nodes[number].set(place, &entry.cell, Child::of_item(entry.item()));
            }
        } else {
            for (place, part) in split_to_width(part, depth).into_iter().enumerate() {
                let whole = part.whole.cell();
                let child = self.add(part, depth + 1);
                self.nodes[number].set(place, &whole, child);
            }
        }
        Child::of_node(index(number))
    }

    fn add_block(&mut self, entries: &[Entry]) -> Child {
        let (mut block, mut held) = (SphereLeaf::EMPTY, [0; WIDTH]);
        for (place, entry) in entries.iter().enumerate() {
            block.set(place, &entry.cell);
            held[place] = entry.item();
        }
        self.blocks.push(block);
        self.held.push(held);
        Child::of_block(index(self.blocks.len() - 1))
    }
}

pub(super) fn index(i: usize) -> u32 {
    u32::try_from(i).expect("a tree has fewer nodes than items, and these are counted in 30 bits")
}

/// Splits a range of more items than a node has places into at most eight, none of them empty.
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
            parts.push((half.whole.area(), half));
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
    fn of(cell: &Aabb32) -> Self {
        let ([a, b, c], [d, e, f]) = (cell.low, cell.high);
        Aabb4 {
            low: [a, b, c, 0.0],
            high: [d, e, f, 0.0],
        }
    }

    pub(super) fn cell(&self) -> Aabb32 {
        let ([a, b, c, _], [d, e, f, _]) = (self.low, self.high);
        Aabb32 {
            low: [a, b, c],
            high: [d, e, f],
        }
    }

    #[inline(always)]
    fn add(&mut self, other: &Aabb4) {
        for lane in 0..4 {
            self.low[lane] = smaller(other.low[lane], self.low[lane]);
            self.high[lane] = larger(other.high[lane], self.high[lane]);
        }
    }

    #[inline(always)]
    fn add_point(&mut self, point: [f32; 4]) {
        self.add(&Aabb4 {
            low: point,
            high: point,
        });
    }

    /// Adds a point or nothing, which is not a branch.
    #[inline(always)]
    fn add_point_if(&mut self, is_so: bool, point: [f32; 4]) {
        let chosen = 0_u32.wrapping_sub(u32::from(is_so));
        let (mut low, mut high) = ([0.0; 4], [0.0; 4]);
        for (lane, point) in point.iter().enumerate() {
            let point = point.to_bits() & chosen;
            low[lane] = f32::from_bits(point | f32::INFINITY.to_bits() & !chosen);
            high[lane] = f32::from_bits(point | f32::NEG_INFINITY.to_bits() & !chosen);
        }
        self.add(&Aabb4 { low, high });
    }

    /// Whether it has no size on any axis.
    pub(super) fn is_point(&self) -> bool {
        (0..3).all(|axis| self.low[axis] == self.high[axis])
    }

    /// Half the surface.
    #[inline(always)]
    fn area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|axis| self.high[axis] - self.low[axis]);
        x * y + y * z + z * x
    }
}

impl Entry {
    /// Set where the item is a ball.
    const BALL: u32 = 1 << 31;

    pub(super) fn new(cell: Aabb32, item: u32, is_ball: bool) -> Self {
        // Of a ball without end nothing is known.
        let is_known = || {
            cell.low
                .iter()
                .chain(&cell.high)
                .all(|end| end.abs() < INFINITE)
        };
        let ball = if is_ball && is_known() {
            Entry::BALL
        } else {
            0
        };
        Entry {
            cell,
            named: item | ball,
        }
    }

    pub(super) fn item(&self) -> u32 {
        self.named & !Entry::BALL
    }

    pub(super) fn is_ball(&self) -> bool {
        self.named & Entry::BALL != 0
    }

    /// Twice the middle of the box, finite.
    #[inline(always)]
    pub(super) fn middle(&self) -> [f32; 4] {
        let wide = Aabb4::of(&self.cell);
        let mut middle = [0.0; 4];
        for (lane, middle) in middle.iter_mut().enumerate() {
            *middle = smaller(
                larger(wide.low[lane] + wide.high[lane], -INFINITE),
                INFINITE,
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
                whole.add(&Aabb4::of(&entry.cell));
                middles.add_point(entry.middle());
            }
            (whole, middles)
        };
        let (whole, middles) = if entries.len() > VERY_MANY {
            let parts = entries.par_chunks(VERY_MANY / 2).map(around);
            parts.reduce(|| (Aabb4::EMPTY, Aabb4::EMPTY), both)
        } else {
            around(entries)
        };
        BuildRange {
            entries,
            whole,
            middles,
        }
    }

    /// Splits it in two, by the cheapest of the bins' borders, or in the middle of the list if the bins cannot tell the
    /// items apart.
    fn halve(self, depth: u32) -> [BuildRange<'e>; 2] {
        let split = if depth >= MAX_DEPTH {
            None
        } else if self.entries.len() <= FEW {
            self.cheapest::<FEW_BINS>()
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

    /// The split with the least sum of surface times number; none if all middles are the same.
    fn cheapest<const COUNT: usize>(&self) -> Option<(Bins, Split)> {
        let bins = Bins::new::<COUNT>(&self.middles);
        let BinTotals { cells, counts } = &BinTotals::<COUNT>::new(&bins, self.entries);
        let mut best: Option<Split> = None;
        for axis in (0..3).filter(|&axis| bins.per_length[axis] > 0.0) {
            let least = best.as_ref().map_or(f32::INFINITY, |best| best.cost);
            if let Some(split) = cheapest_border(axis, &cells[axis], &counts[axis], least) {
                best = Some(split);
            }
        }
        best.map(|split| (bins, split))
    }

    /// Brings the items below the split to the front. On which side an item lies is as good as chance, so that nothing
    /// here depends on it but numbers.
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

/// Both pairs of boxes in one.
fn both(mut all: (Aabb4, Aabb4), more: (Aabb4, Aabb4)) -> (Aabb4, Aabb4) {
    all.0.add(&more.0);
    all.1.add(&more.1);
    all
}

impl<const COUNT: usize> BinTotals<COUNT> {
    fn empty() -> Self {
        BinTotals {
            cells: [[Aabb4::EMPTY; COUNT]; 3],
            counts: [[0; COUNT]; 3],
        }
    }

    #[inline(always)]
    fn new(bins: &Bins, entries: &[Entry]) -> Self {
        let mut filled = Self::empty();
        for entry in entries {
            let wide = Aabb4::of(&entry.cell);
            let [x, y, z, _] = bins.of(entry);
            for (axis, bin) in [x, y, z].into_iter().enumerate() {
                let bin = bin as usize % COUNT;
                filled.cells[axis][bin].add(&wide);
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

    /// The bins of an item on the three axes: the one whose middle is nearest.
    #[inline(always)]
    fn of(&self, entry: &Entry) -> [u32; 4] {
        let middle = entry.middle();
        let mut bins = [0; 4];
        for lane in 0..4 {
            let at = (middle[lane] - self.start[lane]) * self.per_length[lane];
            let at = smaller(larger(at, 0.0), self.last);
            bins[lane] = (at + WHOLE).to_bits() & 0xff;
        }
        bins
    }
}

/// The cheapest border between two bins with items on both sides, if it costs less than `least`. The lowest and the
/// highest bin are never empty.
#[allow(
    clippy::cast_precision_loss,
    reason = "a cost needs no more than seven digits"
)]
fn cheapest_border<const COUNT: usize>(
    axis: usize,
    cells: &[Aabb4; COUNT],
    counts: &[u32; COUNT],
    mut least: f32,
) -> Option<Split> {
    let mut above = [(0.0, Aabb4::EMPTY); COUNT];
    let (mut cell, mut count) = (Aabb4::EMPTY, 0);
    for bin in (1..COUNT).rev() {
        cell.add(&cells[bin]);
        count += counts[bin];
        above[bin] = (cell.area() * count as f32, cell);
    }
    let (mut cell, mut count) = (Aabb4::EMPTY, 0);
    let mut best = None;
    for bin in 1..COUNT {
        cell.add(&cells[bin - 1]);
        count += counts[bin - 1];
        let cost = cell.area() * count as f32 + above[bin].0;
        if cost < least {
            least = cost;
            best = Some((bin, cell));
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
