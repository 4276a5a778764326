//! Construction of large trees: clusters of neighbouring items, a tree for each (a treelet), and one over all clusters.
//!
//! Clusters come from recursive halving of space, which reads each item once and needs no bins (Garanzha, Pantaleoni
//! and McAllister 2011, "Simpler and faster HLBVH with work queues"). They depend on the items alone, so the tree is
//! the same for any number of threads.

use super::build::{Aabb4, BuildRange, Entry, GrowingBvh, PARALLEL_THRESHOLD, build_small, index};
use super::node::Child;
use super::treelets;
use rayon::prelude::*;

/// Maximum number of items of a cluster.
const MAX_CLUSTER_SIZE: usize = 256;

/// Maximum depth of halving: at this depth the items left form a cluster, whatever their number.
const MAX_HALVINGS: u32 = 40;

/// Number of clusters that a task builds. The memory of their nodes exceeds the allocator's threshold for mappings of
/// their own, so that it returns to the system once they are copied to the final list.
const CLUSTERS_PER_TASK: usize = 24;

/// Number of nodes or leaves that are appended to the final list at a time.
const APPEND_CHUNK: u32 = 65_536;

/// Some treelets before they are appended to the final lists: their children are indices into their own lists.
struct Treelets {
    trees: GrowingBvh,
    roots: Vec<Child>,
}

/// Builds the tree of a long list of items.
pub(super) fn build_from_treelets(mut entries: Vec<Entry>) -> GrowingBvh {
    let all = BuildRange::new(&mut entries);
    let space = all.middles;
    let clusters = clusters(all.entries, space, 0);
    let mut boxes: Vec<Entry> = (0..)
        .zip(&clusters)
        .map(|(item, part)| Entry::new(part.whole.aabb(), item, false))
        .collect();
    let mut top = build_small(BuildRange::new(&mut boxes));
    // The clusters in the order of the tree over them.
    let mut order = vec![0; clusters.len()];
    let mut next = 0;
    for node in &mut top.nodes {
        next += node.renumber(next, &mut order[next as usize..]);
    }
    let mut clusters: Vec<Option<BuildRange>> = clusters.into_iter().map(Some).collect();
    let clusters = order.iter().map(|&at| clusters[at as usize].take());
    let clusters: Vec<BuildRange> = clusters.flatten().collect();
    let mut batches = Vec::with_capacity(clusters.len().div_ceil(CLUSTERS_PER_TASK));
    let mut clusters = clusters.into_iter();
    while clusters.len() > 0 {
        batches.push(
            clusters
                .by_ref()
                .take(CLUSTERS_PER_TASK)
                .collect::<Vec<BuildRange>>(),
        );
    }
    let pieces: Vec<Treelets> = batches.into_par_iter().map(Treelets::of).collect();
    // Large scenes need the memory.
    drop(entries);
    concatenate(top, pieces)
}

/// Divides items into clusters of neighbours, by halving the box from `space.low` to `space.high`, which contains their
/// centres.
fn clusters(entries: &mut [Entry], space: Aabb4, halvings: u32) -> Vec<BuildRange<'_>> {
    if entries.len() <= MAX_CLUSTER_SIZE || halvings == MAX_HALVINGS {
        return if entries.is_empty() {
            Vec::new()
        } else {
            vec![BuildRange::new(entries)]
        };
    }
    let size = |axis: usize| space.high[axis] - space.low[axis];
    let axis = (0..3)
        .max_by(|&a, &b| size(a).total_cmp(&size(b)))
        .unwrap_or(0);
    let middle = 0.5 * space.low[axis] + 0.5 * space.high[axis];
    let is_below = |entry: &Entry| entry.middle()[axis] < middle;
    let is_large = entries.len() > PARALLEL_THRESHOLD;
    let front = if is_large {
        let size = PARALLEL_THRESHOLD / 2;
        let parts = entries.par_chunks_mut(size);
        let fronts: Vec<usize> = parts.map(|part| partition(part, is_below)).collect();
        merge_partitions(entries, size, &fronts)
    } else {
        partition(entries, is_below)
    };
    if front == 0 || front == entries.len() {
        // They fill a small part of it.
        let part = BuildRange::new(entries);
        let space = part.middles;
        return if space.is_point() {
            vec![part]
        } else {
            clusters(part.entries, space, halvings + 1)
        };
    }
    let (below, above) = entries.split_at_mut(front);
    let (mut lower, mut upper) = (space, space);
    lower.high[axis] = middle;
    upper.low[axis] = middle;
    let next = halvings + 1;
    let (mut lower, upper) = if is_large {
        rayon::join(
            || clusters(below, lower, next),
            || clusters(above, upper, next),
        )
    } else {
        (clusters(below, lower, next), clusters(above, upper, next))
    };
    lower.extend(upper);
    lower
}

/// Moves the entries that satisfy a predicate to the front; returns their number. The predicate is unpredictable, so
/// the loop has no branch that depends on it.
fn partition(entries: &mut [Entry], predicate: impl Fn(&Entry) -> bool) -> usize {
    let mut front = 0;
    for at in 0..entries.len() {
        let entry = entries[at];
        let is_front = predicate(&entry);
        entries[at] = entries[front];
        entries[front] = entry;
        front += usize::from(is_front);
    }
    front
}

/// Merges the partitions of the pieces of a list, all but the last of this size, into one: the first `fronts[i]`
/// elements of each piece move to the front of the list. Returns their number.
fn merge_partitions<T>(list: &mut [T], size: usize, fronts: &[usize]) -> usize {
    let all: usize = fronts.iter().sum();
    let pieces = || {
        fronts
            .iter()
            .enumerate()
            .map(|(i, front)| (i * size, front))
    };
    let len = list.len();
    // The runs on the wrong side of the border: there are as many elements before it as behind it.
    let before = pieces().map(|(start, front)| start + front..all.min(start + size));
    let behind = pieces().map(|(start, front)| all.max(start)..len.min(start + front));
    let mut before = before.filter(|run| !run.is_empty());
    let (lower, upper) = list.split_at_mut(all);
    let mut wrong = 0..0;
    for mut run in behind.filter(|run| !run.is_empty()) {
        while !run.is_empty() {
            if wrong.is_empty() {
                wrong = before.next().expect("both sides miss as many");
            }
            let count = wrong.len().min(run.len());
            let those = &mut upper[run.start - all..][..count];
            lower[wrong.start..][..count].swap_with_slice(those);
            wrong.start += count;
            run.start += count;
        }
    }
    all
}

impl Treelets {
    /// Builds the trees of these clusters.
    fn of(clusters: Vec<BuildRange>) -> Self {
        let items = clusters.iter().map(|part| part.entries.len()).sum();
        let are_spheres = clusters
            .iter()
            .all(|part| part.entries.iter().all(Entry::is_sphere));
        let mut trees = GrowingBvh::with_capacity_for(items, are_spheres);
        let roots = clusters.into_iter().map(|part| trees.add(part, 0));
        let roots = roots.collect();
        Treelets { trees, roots }
    }
}

/// Joins the tree over clusters, which are its items, and the trees of the clusters, in this order.
fn concatenate(top: GrowingBvh, mut pieces: Vec<Treelets>) -> GrowingBvh {
    let starts = |mut next: usize, len: fn(&GrowingBvh) -> usize| {
        let mut starts = Vec::with_capacity(pieces.len());
        for piece in &pieces {
            starts.push(index(next));
            next += len(&piece.trees);
        }
        starts
    };
    let nodes = starts(top.nodes.len(), |trees| trees.nodes.len());
    let sphere_leaves = starts(0, |trees| trees.sphere_leaves.len());
    let mut roots = Vec::new();
    for (piece, (&nodes, &sphere_leaves)) in pieces.iter().zip(nodes.iter().zip(&sphere_leaves)) {
        roots.extend(
            piece
                .roots
                .iter()
                .map(|root| root.shifted(nodes, sphere_leaves)),
        );
    }
    let mut all = top;
    for node in &mut all.nodes {
        node.replace_items(&roots);
    }
    append(
        &mut all.nodes,
        &mut pieces,
        &nodes,
        |trees| &mut trees.nodes,
        |node, piece| node.shifted(nodes[piece], sphere_leaves[piece]),
    );
    append(
        &mut all.sphere_leaves,
        &mut pieces,
        &sphere_leaves,
        |trees| &mut trees.sphere_leaves,
        |leaf, _| leaf.clone(),
    );
    append(
        &mut all.leaf_items,
        &mut pieces,
        &sphere_leaves,
        |trees| &mut trees.leaf_items,
        |leaf_items, _| *leaf_items,
    );
    all
}

/// Appends one of the lists of each piece, which start at these indices; `moved` maps an element and the number of its
/// piece.
fn append<T: Send + Sync>(
    to: &mut Vec<T>,
    pieces: &mut [Treelets],
    starts: &[u32],
    list: fn(&mut GrowingBvh) -> &mut Vec<T>,
    moved: impl Fn(&T, usize) -> T + Sync,
) {
    let mut lists: Vec<Vec<T>> = pieces
        .iter_mut()
        .map(|piece| std::mem::take(list(&mut piece.trees)))
        .collect();
    let len = index(to.len() + lists.iter().map(Vec::len).sum::<usize>());
    to.reserve_exact(len as usize - to.len());
    let mut done = 0;
    while done < lists.len() {
        let first = starts[done];
        let next = done + starts[done..].partition_point(|&start| start - first < APPEND_CHUNK);
        let end = starts.get(next).copied().unwrap_or(len);
        let one = |position: u32| {
            let piece = starts.partition_point(|&start| start <= position) - 1;
            moved(&lists[piece][(position - starts[piece]) as usize], piece)
        };
        to.par_extend((first..end).into_par_iter().map(one));
        // Freed before the next ones are copied.
        for list in &mut lists[done..next] {
            *list = Vec::new();
        }
        done = next;
    }
}

/// Lists with more items are divided into treelets.
pub(crate) const TREELET_THRESHOLD: usize = 4096;

/// Builds the tree of a list of items.
pub(crate) fn build(mut entries: Vec<Entry>) -> GrowingBvh {
    if entries.is_empty() {
        return GrowingBvh::default();
    }
    if entries.len() > TREELET_THRESHOLD {
        return treelets::build_from_treelets(entries);
    }
    let mut tree = build_small(BuildRange::new(&mut entries));
    tree.nodes.shrink_to_fit();
    tree.sphere_leaves.shrink_to_fit();
    tree
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::accel::Bvh;
    use crate::base::math::sampling::random::Random;
    use crate::base::math::{Bounds, Ray};
    use glam::DVec3;

    #[test]
    fn merging_moves_the_fronts_of_all_pieces_to_the_front() {
        let mut rng = Random::new(5);
        for _ in 0..200 {
            let len = 1 + rng.bits() % 100;
            let size = usize::try_from(1 + rng.bits() % 20).unwrap();
            let mut list: Vec<u64> = (0..len).map(|i| 2 * i + rng.bits() % 2).collect();
            let mut sorted = list.clone();
            let predicate = |number: &u64| number.is_multiple_of(2);
            let fronts: Vec<usize> = list
                .chunks_mut(size)
                .map(|piece| {
                    piece.sort_by_key(|number| !predicate(number));
                    piece.iter().filter(|number| predicate(number)).count()
                })
                .collect();
            let front = merge_partitions(&mut list, size, &fronts);
            assert!(list[..front].iter().all(predicate) && !list[front..].iter().any(predicate));
            list.sort_unstable();
            sorted.sort_unstable();
            assert_eq!(list, sorted);
        }
    }

    /// Small boxes around these points.
    fn boxes(points: &[DVec3]) -> Vec<Bounds> {
        let box_around = |point: &DVec3| Bounds::new(*point - 1e-3, *point + 1e-3);
        points.iter().map(box_around).collect()
    }

    /// True if each box is hit by a ray through its centre.
    fn hits_all(boxes: &[Bounds]) -> bool {
        let tree = Bvh::build(boxes);
        boxes.iter().enumerate().step_by(97).all(|(item, bounds)| {
            let middle = 0.5 * bounds.min + 0.5 * bounds.max;
            let ray = Ray::new(middle - 3.0 * DVec3::X, DVec3::X);
            tree.any(&ray, 2.0, 4.0, |hit| hit as usize == item)
        })
    }

    #[test]
    fn many_boxes_are_all_hit_wherever_they_lie() {
        let mut rng = Random::new(8);
        let even: Vec<DVec3> = (0..40_000).map(|_| rng.vector(1.0)).collect();
        // Most in a region so small that halving all of space would not reach it, one far away.
        let clumped: Vec<DVec3> = even.iter().map(|point| 1e-2 * *point).collect();
        let far: Vec<DVec3> = clumped.iter().copied().chain([DVec3::splat(1e6)]).collect();
        let on_a_line: Vec<DVec3> = even.iter().map(|point| point.x * DVec3::X).collect();
        let alike: Vec<DVec3> = even.iter().map(|_| DVec3::ONE).collect();
        for points in [even, far, on_a_line, alike] {
            assert!(hits_all(&boxes(&points)));
        }
    }

    #[test]
    fn the_tree_of_very_many_boxes_is_the_same_for_any_number_of_threads() {
        let mut rng = Random::new(8);
        let points: Vec<DVec3> = (0..70_000).map(|_| rng.vector(1.0)).collect();
        let boxes = boxes(&points);
        assert!(boxes.len() > 2 * PARALLEL_THRESHOLD);
        let build = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let pool = pool.build().unwrap();
            pool.install(|| {
                format!(
                    "{:?}",
                    Bvh::build_in_order(boxes.len(), |item| (boxes[item], false))
                )
            })
        };
        assert!(build(1) == build(3));
    }
}
