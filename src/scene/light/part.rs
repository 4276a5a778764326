//! Rectangular parts of an area light's grid, for adaptive subdivision.

/// A part of the grid: the first and last index along each side.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// First and last column.
    pub u: [u32; 2],
    /// First and last row.
    pub v: [u32; 2],
}

impl Part {
    /// The whole grid. No size may be 0.
    #[must_use]
    pub fn all(sizes: [u32; 2]) -> Part {
        let [u, v] = sizes.map(|size| [0, size - 1]);
        Part { u, v }
    }

    /// The four quarters. Along a side with an odd number of lights they share the middle line.
    #[must_use]
    pub fn quarters(self) -> [Part; 4] {
        let halves = |[low, high]: [u32; 2]| {
            let sum = low + high;
            [[low, sum / 2], [sum.div_ceil(2), high]]
        };
        let ([low_u, high_u], [low_v, high_v]) = (halves(self.u), halves(self.v));
        let part = |u, v| Part { u, v };
        [
            part(low_u, low_v),
            part(high_u, low_v),
            part(low_u, high_v),
            part(high_u, high_v),
        ]
    }

    /// The indices of the lights at the corners; a part one light wide repeats some.
    #[must_use]
    pub fn corners(self) -> [[u32; 2]; 4] {
        let ([low_u, high_u], [low_v, high_v]) = (self.u, self.v);
        [
            [low_u, low_v],
            [high_u, low_v],
            [low_u, high_v],
            [high_u, high_v],
        ]
    }

    /// True if there are lights between the corners.
    #[must_use]
    pub fn can_be_divided(self) -> bool {
        self.u[1] - self.u[0] > 1 || self.v[1] - self.v[0] > 1
    }
}

/// The lights at the corners of all parts down to `depth`, where the grid is always subdivided. Each occurs once, in
/// the order of the recursive traversal.
pub(super) fn initial_grid_lights(sizes: [u32; 2], depth: u32) -> Vec<[u32; 2]> {
    let mut is_added = vec![false; sizes[0] as usize * sizes[1] as usize];
    let mut lights = Vec::new();
    let mut add = |[u, v]: [u32; 2]| {
        let added = &mut is_added[u as usize + sizes[0] as usize * v as usize];
        if !std::mem::replace(added, true) {
            lights.push([u, v]);
        }
    };
    add_corners(Part::all(sizes), depth, &mut add);
    lights
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
