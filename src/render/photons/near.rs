//! Photons found around a point, in the order in which POV-Ray keeps them: its sums run in it.

/// Photons around a point.
#[derive(Clone, Debug, Default)]
pub struct Near {
    /// The bits of the squares of their distances, which lie in the same order, and their numbers. If all that may be taken
    /// are there, the farthest comes first.
    found: Vec<(u64, u32)>,
    /// How far away they may lie.
    pub radius: f64,
}

impl Near {
    /// None, with room for so many.
    pub(super) fn with_room(most: usize) -> Near {
        Near {
            found: Vec::with_capacity(most),
            radius: 0.0,
        }
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.found.len()
    }

    /// Their numbers.
    pub(super) fn numbers(&self) -> impl Iterator<Item = usize> {
        self.found.iter().map(|&(_, number)| number as usize)
    }

    /// Forgets them.
    pub(super) fn clear(&mut self) {
        self.found.clear();
    }

    /// Takes one more, or one instead of the farthest of `most`. The square of the distance of the farthest, once one had
    /// to go.
    #[inline]
    pub(super) fn take(&mut self, (distance_sq, number): (f64, u32), most: usize) -> Option<f64> {
        let photon = (distance_sq.to_bits(), number);
        if self.found.len() < most {
            self.found.push(photon);
            if self.found.len() == most {
                for parent in (0..most / 2).rev() {
                    let photon = self.found[parent];
                    sink(&mut self.found, parent, photon);
                }
            }
            return None;
        }
        sink(&mut self.found, 0, photon);
        self.found
            .first()
            .map(|farthest| f64::from_bits(farthest.0))
    }
}

/// Puts a photon in the place of another in the heap of the farthest, or below it.
#[inline]
fn sink(heap: &mut [(u64, u32)], mut at: usize, photon: (u64, u32)) {
    loop {
        let mut child = 2 * at + 1;
        if child + 1 < heap.len() {
            child += usize::from(heap[child + 1].0 > heap[child].0);
        } else if child >= heap.len() {
            break;
        }
        if photon.0 >= heap[child].0 {
            break;
        }
        heap[at] = heap[child];
        at = child;
    }
    heap[at] = photon;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_farthest_comes_first_and_goes_first() {
        let mut near = Near::default();
        let far = |number: u32| f64::from(number * 7 % 10);
        for number in 0..10 {
            let farthest = near.take((far(number), number), 4);
            assert_eq!(farthest.is_some(), number >= 4);
            if let Some(farthest) = farthest {
                let most = near.numbers().map(|n| far(u32::try_from(n).expect("few")));
                assert_eq!(most.fold(0.0, f64::max), farthest);
            }
        }
        assert_eq!(near.count(), 4);
    }
}
