//! The way of a ray through the squares of a grid (Amanatides and Woo 1987, "A fast voxel traversal algorithm for ray
//! tracing"); no border is summed up, so that no error grows along the ray.

use crate::base::math::Ray;

/// The steps of a ray through a grid: the cell, and the parameters where the ray enters and leaves it.
pub(super) struct Steps {
    along: [Axis; 2],
    near: f64,
    last: f64,
    is_over: bool,
}

/// A ray and the cells of a grid along one axis.
struct Axis {
    origin: f64,
    dir: f64,
    /// The cell at hand.
    cell: usize,
    /// The last one on the way of the ray.
    last: usize,
    /// The border at which the ray leaves it, and the distance from there to the next.
    border: f64,
    stride: f64,
    /// Where the ray is there.
    exit: f64,
}

impl Axis {
    /// Of cells of `size` from `first` up to but not including `end`, counted from zero; the ray is at `at`.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "cut to the cells there are"
    )]
    #[inline]
    fn new(at: f64, [origin, dir]: [f64; 2], size: f64, [first, end]: [usize; 2]) -> Self {
        let place = at / size;
        let whole = place.max(0.0) as usize;
        // On a border the ray is in the cell it goes to.
        let is_before = dir < 0.0 && whole as f64 == place;
        let cell = whole
            .saturating_sub(usize::from(is_before))
            .clamp(first, end - 1);
        let last = if dir > 0.0 {
            end - 1
        } else if dir < 0.0 {
            first
        } else {
            cell
        };
        let mut axis = Axis {
            origin,
            dir,
            cell,
            last,
            border: (cell + usize::from(dir > 0.0)) as f64 * size,
            stride: size.copysign(dir),
            exit: f64::INFINITY,
        };
        if dir != 0.0 {
            axis.exit = (axis.border - origin) / dir;
        }
        axis
    }

    /// Goes on to the next cell; says whether there is one.
    #[inline]
    fn go_on(&mut self) -> bool {
        if self.cell == self.last {
            return false;
        }
        self.cell = if self.dir > 0.0 {
            self.cell + 1
        } else {
            self.cell - 1
        };
        self.border += self.stride;
        self.exit = (self.border - self.origin) / self.dir;
        true
    }
}

impl Steps {
    /// Through the cells of `size` from `grid[0]` up to but not including `grid[1]`, counted from the origin.
    #[allow(clippy::cast_precision_loss, reason = "counts of pixels are exact")]
    pub(super) fn new(
        ray: &Ray,
        (near, last): (f64, f64),
        size: usize,
        grid: [[usize; 2]; 2],
    ) -> Self {
        let size = size as f64;
        let Ray { origin, dir } = *ray;
        let at = if near.is_finite() {
            ray.at(near)
        } else {
            origin
        };
        let [first, end] = grid;
        Steps {
            along: [
                Axis::new(at.x, [origin.x, dir.x], size, [first[0], end[0]]),
                Axis::new(at.z, [origin.z, dir.z], size, [first[1], end[1]]),
            ],
            near,
            last,
            is_over: near > last,
        }
    }

    #[inline]
    /// The next cell, and the parameters where the ray enters and leaves it.
    pub(super) fn next(&mut self) -> Option<(usize, usize, f64, f64)> {
        if self.is_over {
            return None;
        }
        let [x, z] = &mut self.along;
        let cell = [x.cell, z.cell];
        let leave = if x.exit < z.exit { x.exit } else { z.exit };
        let before = if leave < self.last { leave } else { self.last };
        let far = if before > self.near {
            before
        } else {
            self.near
        };
        let (leaves_x, leaves_z) = (x.exit <= leave, z.exit <= leave);
        let goes_on = (!leaves_x || x.go_on()) & (!leaves_z || z.go_on());
        self.is_over = leave >= self.last || !goes_on;
        let near = std::mem::replace(&mut self.near, far);
        Some((cell[0], cell[1], near, far))
    }
}
