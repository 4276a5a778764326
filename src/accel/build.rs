//! Building: binned surface area heuristic (Wald 2007, "On fast construction of SAH-based bounding volume hierarchies"),
//! eight children at once.
//!
//! A node begins as one range of items. Its range with the largest surface is split until there are eight, or until none
//! has more than eight items: splitting those, too, would leave nodes half empty and the tree 60 % larger. Each split
//! depends on the items of its range alone, so the tree is the same for any number of threads.

use super::node::{Cell, Child, Node, WIDTH};

/// How many places for a split are weighed on each axis.
const BINS: usize = 16;

/// Below this depth ranges are halved by number alone: no arrangement of boxes makes the tree much deeper.
const MAX_DEPTH: u32 = 64;

/// Ranges with more items are built by several threads.
const PARALLEL: usize = 4096;

/// Of more items not all parts of the tree are built at once.
const VERY_MANY: usize = PARALLEL * WIDTH;

/// Ends beyond this are infinite; finite boxes are near one.
const INFINITE: f32 = 1e18;

/// An item with its box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) cell: Cell,
    pub(super) item: u32,
}

/// Where to split: the first bin of the upper part on an axis.
struct Split {
    axis: usize,
    bin: usize,
    low: f32,
    bins_per_length: f32,
}

/// The nodes for a list of items, the root first.
pub(super) fn build(mut entries: Vec<Entry>) -> Vec<Node> {
    let mut nodes = Vec::with_capacity(expected(entries.len()));
    if entries.len() > VERY_MANY {
        part_by_part(entries, &mut nodes);
    } else if !entries.is_empty() {
        subtree(&mut entries, 0, &mut nodes);
    }
    // Shrinking copies all of them; where they are many, what is not used is no memory.
    if nodes.capacity() - nodes.len() > nodes.len() / 2 {
        nodes.shrink_to_fit();
    }
    nodes
}

/// How many nodes so many items mostly have; hardly ever more.
fn expected(items: usize) -> usize {
    items / 4
}

/// The same for very many items. The parts are built one after the other, so that they need not all be kept twice, and
/// from the end of the list on, which is given back piece by piece.
fn part_by_part(mut entries: Vec<Entry>, nodes: &mut Vec<Node>) {
    let list = entries.as_ptr().addr();
    let ranges = split_to_width(&mut entries, 0);
    let start = |range: &[Entry]| (range.as_ptr().addr() - list) / size_of::<Entry>();
    let mut parts: Vec<(usize, usize)> = ranges
        .iter()
        .enumerate()
        .map(|(place, range)| (start(range), place))
        .collect();
    parts.sort_unstable();
    let root = nodes.len();
    nodes.push(Node::empty());
    while let Some((start, place)) = parts.pop() {
        let range = &mut entries[start..];
        let part = build_part(range, 0);
        append(part, range, (root, place), nodes);
        entries.truncate(start);
        entries.shrink_to_fit();
    }
}

/// Appends the node of a range and all below it.
fn subtree(entries: &mut [Entry], depth: u32, nodes: &mut Vec<Node>) {
    use rayon::prelude::*;
    let is_large = entries.len() > PARALLEL;
    let mut ranges = split_to_width(entries, depth);
    let root = nodes.len();
    nodes.push(Node::empty());
    if is_large {
        let parts: Vec<Vec<Node>> = ranges
            .par_iter_mut()
            .map(|range| build_part(range, depth))
            .collect();
        for (place, (range, part)) in ranges.iter().zip(parts).enumerate() {
            append(part, range, (root, place), nodes);
        }
        return;
    }
    for (place, range) in ranges.into_iter().enumerate() {
        let cell = whole(range);
        let child = if range.len() == 1 {
            Child::of_item(range[0].item)
        } else {
            let first = index(nodes.len());
            subtree(range, depth + 1, nodes);
            Child::of_node(first)
        };
        nodes[root].set(place, &cell, child);
    }
}

/// The nodes of a range below a node at this depth; none for a single item.
fn build_part(range: &mut [Entry], depth: u32) -> Vec<Node> {
    let mut nodes = Vec::new();
    if range.len() > 1 {
        nodes.reserve_exact(expected(range.len()));
        subtree(range, depth + 1, &mut nodes);
    }
    nodes
}

/// Appends the nodes of a range, and hangs them or its single item below a place in a node.
fn append(
    mut part: Vec<Node>,
    range: &[Entry],
    (above, place): (usize, usize),
    nodes: &mut Vec<Node>,
) {
    let first = index(nodes.len());
    for node in &mut part {
        node.shift(first);
    }
    let child = if part.is_empty() {
        Child::of_item(range[0].item)
    } else {
        Child::of_node(first)
    };
    nodes.append(&mut part);
    nodes[above].set(place, &whole(range), child);
}

fn index(i: usize) -> u32 {
    u32::try_from(i).expect("a tree has fewer nodes than items, and these are counted in 31 bits")
}

/// Splits a range into at most eight, none of them empty.
fn split_to_width(entries: &mut [Entry], depth: u32) -> Vec<&mut [Entry]> {
    let least = if entries.len() > WIDTH { WIDTH } else { 1 };
    let mut ranges: Vec<(f32, &mut [Entry])> = vec![(0.0, entries)];
    while ranges.len() < WIDTH {
        let widest = (0..ranges.len())
            .filter(|&i| ranges[i].1.len() > least)
            .max_by(|&a, &b| ranges[a].0.total_cmp(&ranges[b].0));
        let Some(widest) = widest else {
            break;
        };
        let (_, range) = ranges.swap_remove(widest);
        let (lower, upper) = halve(range, depth);
        ranges.push((whole(lower).area(), lower));
        ranges.push((whole(upper).area(), upper));
    }
    ranges.into_iter().map(|(_, range)| range).collect()
}

fn whole(entries: &[Entry]) -> Cell {
    entries
        .iter()
        .fold(Cell::EMPTY, |sum, entry| sum.union(&entry.cell))
}

/// Splits a range of two or more in two, by the cheapest of the bins' borders, or in the middle of the list if the bins
/// cannot tell the items apart.
fn halve(entries: &mut [Entry], depth: u32) -> (&mut [Entry], &mut [Entry]) {
    let mut middle = entries.len() / 2;
    if entries.len() > 2
        && depth < MAX_DEPTH
        && let Some(split) = cheapest(entries)
    {
        middle = partition(entries, |entry| split.is_lower(entry));
    }
    entries.split_at_mut(middle)
}

/// Moves the entries for which `is_lower` holds to the front and counts them.
fn partition(entries: &mut [Entry], is_lower: impl Fn(&Entry) -> bool) -> usize {
    let mut count = 0;
    for i in 0..entries.len() {
        if is_lower(&entries[i]) {
            entries.swap(i, count);
            count += 1;
        }
    }
    count
}

impl Entry {
    /// Twice the middle of the box, finite.
    fn middle(&self, axis: usize) -> f32 {
        let finite = |end: f32| end.clamp(-INFINITE, INFINITE);
        finite(self.cell.low[axis]) + finite(self.cell.high[axis])
    }
}

impl Split {
    fn on(axis: usize, middles: &Cell) -> Option<Self> {
        let low = middles.low[axis];
        let length = middles.high[axis] - low;
        #[allow(clippy::cast_precision_loss, reason = "16 is exact")]
        let bins_per_length = BINS as f32 / length;
        (length > 0.0 && bins_per_length.is_finite()).then_some(Split {
            axis,
            bin: 0,
            low,
            bins_per_length,
        })
    }

    #[inline]
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 0 and 16"
    )]
    fn bin_of(&self, entry: &Entry) -> usize {
        let bin = (entry.middle(self.axis) - self.low) * self.bins_per_length;
        (bin as usize).min(BINS - 1)
    }

    fn is_lower(&self, entry: &Entry) -> bool {
        self.bin_of(entry) < self.bin
    }
}

/// The split with the least sum of surface times number, `None` if all middles are the same.
fn cheapest(entries: &[Entry]) -> Option<Split> {
    let middles = middles(entries);
    let splits = [0, 1, 2].map(|axis| Split::on(axis, &middles));
    let mut cells = [[Cell::EMPTY; BINS]; 3];
    let mut counts = [[0_u32; BINS]; 3];
    for entry in entries {
        for (axis, split) in splits.iter().enumerate() {
            if let Some(split) = split {
                let bin = split.bin_of(entry) % BINS;
                cells[axis][bin] = cells[axis][bin].union(&entry.cell);
                counts[axis][bin] += 1;
            }
        }
    }
    let mut best: Option<(f32, Split)> = None;
    for (axis, split) in splits.into_iter().enumerate() {
        let Some(mut split) = split else {
            continue;
        };
        let (cost, bin) = cheapest_border(&cells[axis], &counts[axis]);
        split.bin = bin;
        if best.as_ref().is_none_or(|(least, _)| cost < *least) {
            best = Some((cost, split));
        }
    }
    best.map(|(_, split)| split)
}

/// The box of twice the middles.
fn middles(entries: &[Entry]) -> Cell {
    entries.iter().fold(Cell::EMPTY, |sum, entry| {
        let middle = [0, 1, 2].map(|axis| entry.middle(axis));
        sum.union(&Cell {
            low: middle,
            high: middle,
        })
    })
}

/// The cost and the first bin above the cheapest border with items on both sides. The lowest and the highest bin are
/// never empty.
#[allow(
    clippy::cast_precision_loss,
    reason = "a cost needs no more than seven digits"
)]
fn cheapest_border(cells: &[Cell; BINS], counts: &[u32; BINS]) -> (f32, usize) {
    let mut above = [0.0; BINS];
    let (mut cell, mut count) = (Cell::EMPTY, 0);
    for bin in (1..BINS).rev() {
        cell = cell.union(&cells[bin]);
        count += counts[bin];
        above[bin] = cell.area() * count as f32;
    }
    let (mut cell, mut count) = (Cell::EMPTY, 0);
    let mut best = (f32::INFINITY, 1);
    for bin in 1..BINS {
        cell = cell.union(&cells[bin - 1]);
        count += counts[bin - 1];
        let cost = cell.area() * count as f32 + above[bin];
        if cost < best.0 {
            best = (cost, bin);
        }
    }
    best
}
