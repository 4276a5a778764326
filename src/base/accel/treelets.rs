//! Trees of many items: clusters of what lies together, a tree in each, and one over all clusters.
//!
//! Items are brought together by halving space, which looks at each once and asks for no bins (Garanzha, Pantaleoni and
//! McAllister 2011, "Simpler and faster HLBVH with work queues"). Clusters depend on the items alone, so the tree is the
//! same for any number of threads.

use super::build::{Aabb4, BuildRange, Entry, GrowingBvh, VERY_MANY, few, index};
use super::node::Child;
use rayon::prelude::*;

/// So few items are a cluster.
const CLUSTER: usize = 256;

/// What space has been halved so often is a cluster too, however many items are left.
const MOST_HALVINGS: u32 = 40;

/// So many clusters are built by one thread. Their nodes take more memory than the allocator puts between small pieces: it
/// goes back when they are in the list of all.
const AT_ONCE: usize = 24;

/// How many nodes or blocks come into the list of all at a time.
const TOGETHER: u32 = 65_536;

/// Some trees on their way into the lists of all: they name each other by their places here.
struct Treelets {
    trees: GrowingBvh,
    roots: Vec<Child>,
}

/// The tree of a list of many items.
pub(super) fn build(mut entries: Vec<Entry>) -> GrowingBvh {
    let all = BuildRange::new(&mut entries);
    let space = all.middles;
    let clusters = clusters(all.entries, space, 0);
    let mut boxes: Vec<Entry> = (0..)
        .zip(&clusters)
        .map(|(item, part)| Entry::new(part.whole.cell(), item, false))
        .collect();
    let mut top = few(BuildRange::new(&mut boxes));
    // The clusters in the order of the tree over them.
    let mut order = vec![0; clusters.len()];
    let mut next = 0;
    for node in &mut top.nodes {
        next += node.renumber(next, &mut order[next as usize..]);
    }
    let mut clusters: Vec<Option<BuildRange>> = clusters.into_iter().map(Some).collect();
    let clusters = order.iter().map(|&at| clusters[at as usize].take());
    let clusters: Vec<BuildRange> = clusters.flatten().collect();
    let mut lots = Vec::with_capacity(clusters.len().div_ceil(AT_ONCE));
    let mut clusters = clusters.into_iter();
    while clusters.len() > 0 {
        lots.push(clusters.by_ref().take(AT_ONCE).collect::<Vec<BuildRange>>());
    }
    let pieces: Vec<Treelets> = lots.into_par_iter().map(Treelets::of).collect();
    // In large scenes the room is needed.
    drop(entries);
    joined(top, pieces)
}

/// Brings items that lie near each other together, by halving space: the box from `space.low` to `space.high`, in which
/// their middles are.
fn clusters(entries: &mut [Entry], space: Aabb4, halvings: u32) -> Vec<BuildRange<'_>> {
    if entries.len() <= CLUSTER || halvings == MOST_HALVINGS {
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
    let is_large = entries.len() > VERY_MANY;
    let front = if is_large {
        let size = VERY_MANY / 2;
        let parts = entries.par_chunks_mut(size);
        let fronts: Vec<usize> = parts.map(|part| bring_forward(part, is_below)).collect();
        join(entries, size, &fronts)
    } else {
        bring_forward(entries, is_below)
    };
    if front == 0 || front == entries.len() {
        // They fill little of it.
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

/// Brings what is so to the front; gives its number. Nothing but numbers depends on what is so, which no
/// processor could foresee.
fn bring_forward(entries: &mut [Entry], is_so: impl Fn(&Entry) -> bool) -> usize {
    let mut front = 0;
    for at in 0..entries.len() {
        let entry = entries[at];
        let goes = is_so(&entry);
        entries[at] = entries[front];
        entries[front] = entry;
        front += usize::from(goes);
    }
    front
}

/// Brings to the front of a list what is at the front of each of its pieces, all but the last of this size. Gives the
/// number of those.
fn join<T>(list: &mut [T], size: usize, fronts: &[usize]) -> usize {
    let all: usize = fronts.iter().sum();
    let pieces = || {
        fronts
            .iter()
            .enumerate()
            .map(|(i, front)| (i * size, front))
    };
    let len = list.len();
    // On the wrong side of the border: as many before it as behind it.
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
    /// The trees of these clusters.
    fn of(clusters: Vec<BuildRange>) -> Self {
        let items = clusters.iter().map(|part| part.entries.len()).sum();
        let are_balls = clusters
            .iter()
            .all(|part| part.entries.iter().all(Entry::is_ball));
        let mut trees = GrowingBvh::with_room(items, are_balls);
        let roots = clusters.into_iter().map(|part| trees.add(part, 0));
        let roots = roots.collect();
        Treelets { trees, roots }
    }
}

/// The tree over clusters, which are its items, with those of the clusters, in this order.
fn joined(top: GrowingBvh, mut pieces: Vec<Treelets>) -> GrowingBvh {
    let starts = |mut next: usize, len: fn(&GrowingBvh) -> usize| {
        let mut starts = Vec::with_capacity(pieces.len());
        for piece in &pieces {
            starts.push(index(next));
            next += len(&piece.trees);
        }
        starts
    };
    let nodes = starts(top.nodes.len(), |trees| trees.nodes.len());
    let blocks = starts(0, |trees| trees.blocks.len());
    let mut roots = Vec::new();
    for (piece, (&nodes, &blocks)) in pieces.iter().zip(nodes.iter().zip(&blocks)) {
        roots.extend(piece.roots.iter().map(|root| root.shifted(nodes, blocks)));
    }
    let mut all = top;
    for node in &mut all.nodes {
        node.hang(&roots);
    }
    append(
        &mut all.nodes,
        (&mut pieces, &nodes),
        |trees| &mut trees.nodes,
        |node, piece| node.shifted(nodes[piece], blocks[piece]),
    );
    append(
        &mut all.blocks,
        (&mut pieces, &blocks),
        |trees| &mut trees.blocks,
        |block, _| block.clone(),
    );
    append(
        &mut all.held,
        (&mut pieces, &blocks),
        |trees| &mut trees.held,
        |held, _| *held,
    );
    all
}

/// Appends one of the lists of each piece, which go to these places, as `moved` makes of what is in it and the number of
/// the piece.
fn append<T: Send + Sync>(
    to: &mut Vec<T>,
    (pieces, starts): (&mut [Treelets], &[u32]),
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
        let many = done + starts[done..].partition_point(|&start| start - first < TOGETHER);
        let end = starts.get(many).copied().unwrap_or(len);
        let one = |place: u32| {
            let piece = starts.partition_point(|&start| start <= place) - 1;
            moved(&lists[piece][(place - starts[piece]) as usize], piece)
        };
        to.par_extend((first..end).into_par_iter().map(one));
        // Let go of before the next ones come.
        for list in &mut lists[done..many] {
            *list = Vec::new();
        }
        done = many;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::accel::Bvh;
    use crate::base::math::sampling::random::Random;
    use crate::base::math::{Bounds, Ray};
    use glam::DVec3;

    #[test]
    fn what_is_at_the_front_of_pieces_comes_to_the_front_of_all() {
        let mut rng = Random::new(5);
        for _ in 0..200 {
            let len = 1 + rng.bits() % 100;
            let size = usize::try_from(1 + rng.bits() % 20).unwrap();
            let mut list: Vec<u64> = (0..len).map(|i| 2 * i + rng.bits() % 2).collect();
            let mut sorted = list.clone();
            let is_so = |number: &u64| number.is_multiple_of(2);
            let fronts: Vec<usize> = list
                .chunks_mut(size)
                .map(|piece| {
                    piece.sort_by_key(|number| !is_so(number));
                    piece.iter().filter(|number| is_so(number)).count()
                })
                .collect();
            let front = join(&mut list, size, &fronts);
            assert!(list[..front].iter().all(is_so) && !list[front..].iter().any(is_so));
            list.sort_unstable();
            sorted.sort_unstable();
            assert_eq!(list, sorted);
        }
    }

    /// Small boxes around these places.
    fn boxes(places: &[DVec3]) -> Vec<Bounds> {
        let around = |place: &DVec3| Bounds::new(*place - 1e-3, *place + 1e-3);
        places.iter().map(around).collect()
    }

    /// Whether each box is met by a ray that goes through its middle.
    fn finds_all(boxes: &[Bounds]) -> bool {
        let tree = Bvh::build(boxes);
        boxes.iter().enumerate().step_by(97).all(|(item, bounds)| {
            let middle = 0.5 * bounds.min + 0.5 * bounds.max;
            let ray = Ray::new(middle - 3.0 * DVec3::X, DVec3::X);
            tree.any(&ray, 2.0, 4.0, |met| met as usize == item)
        })
    }

    #[test]
    fn many_boxes_are_all_found_wherever_they_lie() {
        let mut rng = Random::new(8);
        let even: Vec<DVec3> = (0..40_000).map(|_| rng.vector(1.0)).collect();
        // Most in a place so small that halving all space would not come to it, one far away.
        let clumped: Vec<DVec3> = even.iter().map(|place| 1e-2 * *place).collect();
        let far: Vec<DVec3> = clumped.iter().copied().chain([DVec3::splat(1e6)]).collect();
        let on_a_line: Vec<DVec3> = even.iter().map(|place| place.x * DVec3::X).collect();
        let alike: Vec<DVec3> = even.iter().map(|_| DVec3::ONE).collect();
        for places in [even, far, on_a_line, alike] {
            assert!(finds_all(&boxes(&places)));
        }
    }

    #[test]
    fn the_tree_of_very_many_boxes_is_the_same_for_any_number_of_threads() {
        let mut rng = Random::new(8);
        let places: Vec<DVec3> = (0..70_000).map(|_| rng.vector(1.0)).collect();
        let boxes = boxes(&places);
        assert!(boxes.len() > 2 * VERY_MANY);
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
