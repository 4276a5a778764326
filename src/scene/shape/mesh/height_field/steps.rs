//! Grid traversal of a ray (Amanatides and Woo 1987, "A fast voxel traversal algorithm for ray tracing"). Each border
//! is computed exactly, so that no error accumulates along the ray.

use crate::base::math::Ray;

/// Iterator over the cells of a grid that a ray visits, with the parameters at which it enters and leaves them.
pub(super) struct Steps {
    along: [Axis; 2],
    near: f64,
    last: f64,
    is_done: bool,
}

/// A ray and the cells of a grid along one axis.
struct Axis {
    origin: f64,
    dir: f64,
    /// The current cell, the direction to the next one, and the number of cells on the ray behind it.
    cell: usize,
    step: isize,
    left: usize,
    /// Coordinate of the border at which the ray leaves the cell, and the distance from there to the next.
    border: f64,
    stride: f64,
    /// Ray parameter at the border.
    exit: f64,
}

impl Axis {
    /// The cells of `size` from `first` up to but not including `end`, counted from zero; the ray is at `at`.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "cut to the cells there are"
    )]
    #[inline(always)]
    fn new(at: f64, [origin, dir]: [f64; 2], size: f64, [first, end]: [usize; 2]) -> Self {
        let cell_at = at / size;
        let whole = cell_at.max(0.0) as usize;
        // On a border the ray is in the cell that it enters.
        let is_before = dir < 0.0 && whole as f64 == cell_at;
        let cell = whole
            .saturating_sub(usize::from(is_before))
            .clamp(first, end - 1);
        let (step, left) = if dir > 0.0 {
            (1, end - 1 - cell)
        } else if dir < 0.0 {
            (-1, cell - first)
        } else {
            (0, 0)
        };
        let mut axis = Axis {
            origin,
            dir,
            cell,
            step,
            left,
            border: (cell + usize::from(dir > 0.0)) as f64 * size,
            stride: size.copysign(dir),
            exit: f64::INFINITY,
        };
        if dir != 0.0 {
            axis.exit = (axis.border - origin) / dir;
        }
        axis
    }

    /// Advances to the next cell; false at the end.
    #[inline(always)]
    fn advance(&mut self) -> bool {
        let Some(left) = self.left.checked_sub(1) else {
            return false;
        };
        self.left = left;
        self.cell = self.cell.wrapping_add_signed(self.step);
        self.border += self.stride;
        self.exit = (self.border - self.origin) / self.dir;
        true
    }
}

impl Steps {
    /// Traverses the cells of `size` from `grid[0]` up to but not including `grid[1]`, counted from the origin.
    #[allow(clippy::cast_precision_loss, reason = "counts of pixels are exact")]
    #[inline(always)]
    pub(super) fn new(ray: &Ray, near: f64, last: f64, size: usize, grid: [[usize; 2]; 2]) -> Self {
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
            is_done: near > last,
        }
    }

    #[inline(always)]
    /// The next cell, and the parameters at which the ray enters and leaves it.
    pub(super) fn next(&mut self) -> Option<(usize, usize, f64, f64)> {
        if self.is_done {
            return None;
        }
        let [x, z] = &mut self.along;
        let cell = [x.cell, z.cell];
        let leave = if x.exit < z.exit { x.exit } else { z.exit };
        let end = if leave < self.last { leave } else { self.last };
        let far = if end > self.near { end } else { self.near };
        let (leaves_x, leaves_z) = (x.exit <= leave, z.exit <= leave);
        let has_next = (!leaves_x || x.advance()) & (!leaves_z || z.advance());
        self.is_done = leave >= self.last || !has_next;
        let near = std::mem::replace(&mut self.near, far);
        Some((cell[0], cell[1], near, far))
    }
}
