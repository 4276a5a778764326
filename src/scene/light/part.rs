//! Parts of the grid of an area light, which are divided where more must be known.

/// A part of a grid: the first and last indices along both sides.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// Of the columns.
    pub u: [u32; 2],
    /// Of the rows.
    pub v: [u32; 2],
}

impl Part {
    /// The whole of a grid with so many lamps along both sides, none zero.
    #[must_use]
    pub fn all(sizes: [u32; 2]) -> Part {
        let [u, v] = sizes.map(|size| [0, size - 1]);
        Part { u, v }
    }

    /// Its quarters, which share their edges where the number of lamps is odd.
    #[must_use]
    pub fn quarters(self) -> [Part; 4] {
        let halves = |[low, high]: [u32; 2]| {
            let sum = low + high;
            [[low, sum / 2], [sum.div_ceil(2), high]]
        };
        let (u, v) = (halves(self.u), halves(self.v));
        [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| Part { u: u[i], v: v[j] })
    }

    /// The indices of the lamps at its corners; some more than once where it is narrow.
    #[must_use]
    pub fn corners(self) -> [[u32; 2]; 4] {
        [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| [self.u[i], self.v[j]])
    }

    /// Tells whether there are lamps between the corners.
    #[must_use]
    pub fn can_be_divided(self) -> bool {
        self.u[1] - self.u[0] > 1 || self.v[1] - self.v[0] > 1
    }
}

/// The lamps at the corners of all parts down to the depth to which a grid is divided whatever comes from them, in the
/// order in which they are asked about, each once.
pub(super) fn first_lamps(sizes: [u32; 2], depth: u32) -> Vec<[u32; 2]> {
    let mut is_known = vec![false; sizes[0] as usize * sizes[1] as usize];
    let mut lamps = Vec::new();
    let mut add = |[u, v]: [u32; 2]| {
        let known = &mut is_known[u as usize + sizes[0] as usize * v as usize];
        if !std::mem::replace(known, true) {
            lamps.push([u, v]);
        }
    };
    add_corners(Part::all(sizes), depth, &mut add);
    lamps
}

fn add_corners(part: Part, depth: u32, add: &mut impl FnMut([u32; 2])) {
    part.corners().into_iter().for_each(&mut *add);
    if part.can_be_divided() && depth > 0 {
        for quarter in part.quarters() {
            add_corners(quarter, depth - 1, add);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Part;

    #[test]
    fn quarters_of_odd_grids_share_their_middle() {
        let quarters = Part {
            u: [0, 2],
            v: [0, 4],
        }
        .quarters();
        assert_eq!((quarters[0].u, quarters[0].v), ([0, 1], [0, 2]));
        assert_eq!((quarters[3].u, quarters[3].v), ([1, 2], [2, 4]));
        let even = Part {
            u: [0, 3],
            v: [0, 0],
        };
        assert_eq!(
            even.quarters().map(|part| part.u),
            [[0, 1], [2, 3], [0, 1], [2, 3]]
        );
    }
}
