//! Inside state of a ray in a CSG program, and its reset for the next ray.
//!
//! A ray crosses a handful of the operands of a large program, and copying the state of all of them would cost more
//! than everything else. So changes are logged and undone.

use smallvec::SmallVec;
use std::sync::atomic::{AtomicU64, Ordering};

/// Source of unique ids for initial states.
static PROGRAMS: AtomicU64 = AtomicU64::new(1);

/// From this number of operands on, the log is undone instead of copying the whole state.
const LARGE: usize = 64;

/// Inside state outside all leaves. Small programs, of which there may be many, store it inline.
#[derive(Clone, Debug, Default)]
pub(crate) struct InsideInit {
    leaf_in: SmallVec<[bool; 16]>,
    pub(crate) counts: SmallVec<[u32; 4]>,
    /// Unique id; 0 for none.
    number: u64,
}

impl InsideInit {
    /// Initial state by operand and by node, as in [`InsideState`].
    pub(crate) fn new(leaf_in: impl Iterator<Item = bool>, counts: &[u32]) -> InsideInit {
        InsideInit {
            leaf_in: leaf_in.collect(),
            counts: SmallVec::from_slice(counts),
            number: PROGRAMS.fetch_add(1, Ordering::Relaxed),
        }
    }
}

/// Inside state at a point of the ray.
#[derive(Clone, Debug, Default)]
pub(crate) struct InsideState {
    /// For each operand, true if the ray is inside it, with inversion taken into account.
    pub(crate) leaf_in: Vec<bool>,
    /// For each node, the number of children that contain the ray.
    pub(crate) counts: Vec<u32>,
    /// The id of the [`InsideInit`] from which the state started.
    of: u64,
    /// Log for large programs: operands and nodes that may differ from the initial state.
    changed: Vec<u32>,
    changed_nodes: Vec<u32>,
}

impl InsideState {
    /// Resets to an initial state.
    #[inline(always)]
    pub(crate) fn rest(&mut self, rest: &InsideInit) {
        if self.of != rest.number || rest.leaf_in.len() < LARGE {
            self.leaf_in.clear();
            self.leaf_in.extend_from_slice(&rest.leaf_in);
            self.counts.clear();
            self.counts.extend_from_slice(&rest.counts);
            self.of = rest.number;
        } else {
            for operand in self.changed.iter().map(|&operand| operand as usize) {
                self.leaf_in[operand] = rest.leaf_in[operand];
            }
            for node in self.changed_nodes.iter().map(|&node| node as usize) {
                self.counts[node] = rest.counts[node];
            }
        }
        self.changed.clear();
        self.changed_nodes.clear();
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, operand: u32, is_in: bool) {
        self.leaf_in[operand as usize] = is_in;
        if self.leaf_in.len() >= LARGE {
            self.changed.push(operand);
        }
    }

    #[inline(always)]
    pub(crate) fn count(&mut self, node: u32, enters: bool) {
        let count = &mut self.counts[node as usize];
        if enters {
            *count += 1;
        } else {
            *count -= 1;
        }
        if self.leaf_in.len() >= LARGE {
            self.changed_nodes.push(node);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::sampling::random::Random;

    #[test]
    fn what_a_ray_changed_is_put_back_whatever_came_before() {
        let mut rng = Random::new(41);
        let all: Vec<InsideInit> = [3, 64, 200, 200]
            .into_iter()
            .map(|operands| {
                let leaf_in = (0..operands).map(|_| rng.uniform() < 0.5);
                InsideInit::new(leaf_in, &[100; 20])
            })
            .collect();
        let mut state = InsideState::default();
        for _ in 0..1000 {
            let number = |rng: &mut Random, below: usize| {
                usize::try_from(rng.bits()).expect("64 bits") % below
            };
            let rest = &all[number(&mut rng, all.len())];
            state.rest(rest);
            assert_eq!(state.leaf_in[..], rest.leaf_in[..]);
            assert_eq!(state.counts[..], rest.counts[..]);
            for _ in 0..number(&mut rng, 9) {
                let operand = number(&mut rng, rest.leaf_in.len());
                state.set(u32::try_from(operand).unwrap(), rng.uniform() < 0.5);
                let node = number(&mut rng, rest.counts.len());
                state.count(u32::try_from(node).unwrap(), rng.uniform() < 0.5);
            }
        }
    }
}
