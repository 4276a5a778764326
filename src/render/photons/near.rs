//! The photons near a point, in POV-Ray's order: sums depend on it.

/// The result of a photon search.
#[derive(Clone, Debug, Default)]
pub struct Near {
    /// The photons gathered so far, as a max-heap by distance.
    photons: Vec<NearPhoton>,
    /// The search radius.
    pub radius: f64,
}

/// A gathered photon.
#[derive(Clone, Copy, Debug)]
struct NearPhoton {
    /// The squared distance as bits, which have the same order.
    distance_bits: u64,
    number: u32,
}

impl Near {
    /// An empty result with capacity for `most` photons.
    pub(super) fn with_capacity(most: usize) -> Near {
        Near {
            photons: Vec::with_capacity(most),
            radius: 0.0,
        }
    }

    /// The number of photons.
    #[must_use]
    pub fn count(&self) -> usize {
        self.photons.len()
    }

    /// Their indices.
    pub(super) fn numbers(&self) -> impl Iterator<Item = usize> {
        self.photons.iter().map(|photon| photon.number as usize)
    }

    /// Removes all photons.
    pub(super) fn clear(&mut self) {
        self.photons.clear();
    }

    /// Adds a photon, or replaces the farthest of `most`. Returns the squared distance of the farthest once one was
    /// replaced.
    #[inline]
    pub(super) fn take(&mut self, distance_sq: f64, number: u32, most: usize) -> Option<f64> {
        let photon = NearPhoton {
            distance_bits: distance_sq.to_bits(),
            number,
        };
        if self.photons.len() < most {
            rise(&mut self.photons, photon);
            return None;
        }
        sink(&mut self.photons, 0, photon);
        self.photons
            .first()
            .map(|farthest| f64::from_bits(farthest.distance_bits))
    }
}

/// Adds a photon to the max-heap, above others at the same distance.
#[inline]
fn rise(heap: &mut Vec<NearPhoton>, photon: NearPhoton) {
    let mut at = heap.len();
    heap.push(photon);
    while at > 0 {
        let parent = (at - 1) / 2;
        if photon.distance_bits < heap[parent].distance_bits {
            break;
        }
        heap[at] = heap[parent];
        at = parent;
    }
    heap[at] = photon;
}

/// Replaces a photon in the max-heap and restores the heap order.
#[inline]
fn sink(heap: &mut [NearPhoton], mut at: usize, photon: NearPhoton) {
    loop {
        let mut child = 2 * at + 1;
        if child + 1 < heap.len() {
            child += usize::from(heap[child + 1].distance_bits > heap[child].distance_bits);
        } else if child >= heap.len() {
            break;
        }
        if photon.distance_bits >= heap[child].distance_bits {
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
    fn a_full_heap_replaces_the_farthest() {
        let mut near = Near::default();
        let far = |number: u32| f64::from(number * 7 % 10);
        for number in 0..10 {
            let farthest = near.take(far(number), number, 4);
            assert_eq!(farthest.is_some(), number >= 4);
            if let Some(farthest) = farthest {
                let most = near.numbers().map(|n| far(u32::try_from(n).expect("few")));
                assert_eq!(most.fold(0.0, f64::max), farthest);
            }
        }
        assert_eq!(near.count(), 4);
    }
}
