//! What a ray is inside of, of a combination; and how it is brought back to rest for the next ray.
//!
//! A ray crosses a handful of the parts of a large combination, and copying what is known of all of them would cost more
//! than everything else. So what it changes is noted and put back.

use smallvec::SmallVec;
use std::sync::atomic::{AtomicU64, Ordering};

/// Numbers the states at rest.
static PROGRAMS: AtomicU64 = AtomicU64::new(1);

/// From so many operands on, a ray puts back what it has changed of the state instead of copying all of it.
const LARGE: usize = 64;

/// What a ray is inside of, of a combination, where it is outside of all leaves. Small combinations, of which there may
/// be many, keep it in place.
#[derive(Clone, Debug, Default)]
pub(crate) struct InsideInit {
    leaf_in: SmallVec<[bool; 16]>,
    pub(crate) counts: SmallVec<[u32; 4]>,
    /// None has 0.
    number: u64,
}

impl InsideInit {
    /// By operand and by node, as in [`InsideState`].
    pub(crate) fn new(leaf_in: impl Iterator<Item = bool>, counts: &[u32]) -> InsideInit {
        InsideInit {
            leaf_in: leaf_in.collect(),
            counts: SmallVec::from_slice(counts),
            number: PROGRAMS.fetch_add(1, Ordering::Relaxed),
        }
    }
}

/// What a ray is inside of at a place.
#[derive(Clone, Debug, Default)]
pub(crate) struct InsideState {
    /// For each operand, whether the ray is inside of what it stands for.
    pub(crate) leaf_in: Vec<bool>,
    /// For each node, how many children hold the ray.
    pub(crate) counts: Vec<u32>,
    /// The number of the [`InsideInit`] from which it comes.
    of: u64,
    /// Operands and nodes of a large combination that are no longer as they are at rest.
    changed: Vec<u32>,
    changed_nodes: Vec<u32>,
}

impl InsideState {
    /// Makes this the state at rest again.
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
                let leaf_in = (0..operands).map(|_| rng.share() < 0.5);
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
                state.set(u32::try_from(operand).unwrap(), rng.share() < 0.5);
                let node = number(&mut rng, rest.counts.len());
                state.count(u32::try_from(node).unwrap(), rng.share() < 0.5);
            }
        }
    }
}
