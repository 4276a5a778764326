//! Intersection of a ray with the cells of a height field.

use super::steps::Steps;
use super::{Field, WALL, WATER};
use crate::base::math::Ray;
use crate::base::math::simd::with_widest;
use crate::scene::shape::{Crossing, Root, Start};
use glam::DVec3;

/// A ray this much above or below all heights of a block misses them, whatever is rounded; in height steps of the
/// image.
const SLACK: f64 = 1.0 / (1 << 20) as f64;

/// State of the traversal of a ray.
struct Traversal<'a> {
    field: &'a Field,
    ray: Ray,
    /// Inside state at the current point; `None` until the first cell if the traversal begins in the middle.
    inside: Option<bool>,
    /// Height of the current point above the ground, if known.
    above: Option<f64>,
    emit: &'a mut dyn FnMut(Root) -> bool,
    is_done: bool,
}

/// Interval of the ray above one triangle.
#[derive(Clone, Copy)]
struct TriangleInterval {
    from: f64,
    to: f64,
    cell: [usize; 2],
    is_far: bool,
}

/// The plane of a triangle.
struct Ground {
    /// Lower corner of its cell, in x and z.
    corner: [f64; 2],
    /// Heights at the triangle's right-angled corner, and at the two corners where the diagonal ends: at greater x and
    /// at greater z.
    corner_height: f64,
    right_height: f64,
    up_height: f64,
    is_far: bool,
}

impl Ground {
    #[inline(always)]
    fn height(&self, point: DVec3) -> f64 {
        let (u, v) = (point.x - self.corner[0], point.z - self.corner[1]);
        let Ground {
            corner_height,
            right_height,
            up_height,
            ..
        } = *self;
        if self.is_far {
            corner_height
                + (1.0 - u) * (up_height - corner_height)
                + (1.0 - v) * (right_height - corner_height)
        } else {
            corner_height + u * (right_height - corner_height) + v * (up_height - corner_height)
        }
    }
}

impl Field {
    /// Passes the roots of a ray in order to `emit` until it returns false. Roots outside of `from..to` may be missing,
    /// and so may the first root inside.
    pub(super) fn traverse(
        &self,
        ray: &Ray,
        from: f64,
        to: f64,
        emit: &mut dyn FnMut(Root) -> bool,
    ) -> Start {
        with_widest(
            #[inline(always)]
            |_| self.traverse_wide(ray, from, to, emit),
        )
    }

    #[inline(always)]
    fn traverse_wide(
        &self,
        ray: &Ray,
        from: f64,
        to: f64,
        emit: &mut dyn FnMut(Root) -> bool,
    ) -> Start {
        let size = self.scale();
        let (enter, leave) = slab(ray.origin.x, ray.dir.x, 0.0, size.x);
        let (enter_z, leave_z) = slab(ray.origin.z, ray.dir.z, 0.0, size.z);
        let (enter, leave) = (enter.max(enter_z), leave.min(leave_z));
        let is_hit = enter <= leave && ray.origin.is_finite() && ray.dir.is_finite();
        if self.is_empty() || !is_hit {
            return Start::Outside;
        }
        let goes_up = ray.dir.y > 0.0;
        let lowest = self.low;
        let (near, far) = slab(ray.origin.y, ray.dir.y, lowest, self.high.max(lowest));
        // Inside state before the ray reaches the range of heights, and after it has left it.
        let (below_before, below_after) = if ray.dir.y == 0.0 {
            (ray.origin.y < lowest, ray.origin.y < lowest)
        } else {
            (goes_up, !goes_up)
        };
        let mut traversal = Traversal {
            field: self,
            ray: *ray,
            inside: Some(false),
            above: None,
            emit,
            is_done: false,
        };
        if near > leave || near > far {
            traversal.cross_wall(enter, below_before);
            traversal.cross_wall(leave, false);
        } else if far < enter {
            traversal.cross_wall(enter, below_after);
            traversal.cross_wall(leave, false);
        } else {
            if near > enter {
                traversal.cross_wall(enter, below_before);
            } else {
                let face = traversal.face_at(enter);
                let is_inside = traversal.is_inside(enter, traversal.height_above(enter, face));
                traversal.cross_wall(enter, is_inside);
            }
            let end = leave.min(far);
            traversal.walk_blocks(enter.max(near), end, from, to);
            if far < leave {
                if lowest == self.water && below_after {
                    let face = traversal.face_at(far);
                    traversal.cross_water_level(far, true, face);
                } else {
                    traversal.set_inside(far, below_after, None);
                }
            }
            traversal.cross_wall(leave, false);
        }
        let is_below = enter == f64::NEG_INFINITY && below_before;
        if is_below {
            Start::Inside
        } else {
            Start::Outside
        }
    }

    /// Inside test: below the surface or the water.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the point lies above the cells"
    )]
    pub(super) fn contains(&self, point: DVec3) -> bool {
        let size = self.scale();
        let is_above_cells =
            point.x >= 0.0 && point.x < size.x && point.z >= 0.0 && point.z < size.z;
        if !is_above_cells || !point.is_finite() {
            return false;
        }
        let (x, z) = (point.x as usize, point.z as usize);
        let is_far = point.x.fract() + point.z.fract() > 1.0;
        let face = self.face(x, z, is_far);
        point.y < self.water || point.y < self.ground(point, face)
    }

    #[inline(always)]
    fn face(&self, x: usize, z: usize, is_far: bool) -> u32 {
        let cell = u32::try_from(z * self.cells[0] + x).expect("cells are counted in 31 bits");
        2 * cell + u32::from(is_far)
    }

    /// Height of the plane of a triangle.
    pub(super) fn ground(&self, point: DVec3, face: u32) -> f64 {
        let (x, z, is_far) = self.cell(face);
        self.plane_of([x, z], is_far).height(point)
    }

    #[allow(clippy::cast_precision_loss, reason = "counts of pixels are exact")]
    #[inline(always)]
    fn plane_of(&self, [x, z]: [usize; 2], is_far: bool) -> Ground {
        let offset = usize::from(is_far);
        Ground {
            corner: [x as f64, z as f64],
            corner_height: self.height(x + offset, z + offset),
            right_height: self.height(x + 1, z),
            up_height: self.height(x, z + 1),
            is_far,
        }
    }
}

impl Traversal<'_> {
    #[inline(always)]
    fn at(&self, t: f64) -> DVec3 {
        if t.is_finite() {
            self.ray.at(t)
        } else {
            // A vertical ray has constant x and z.
            self.ray.origin
        }
    }

    fn height_above(&self, t: f64, face: u32) -> f64 {
        let point = self.at(t);
        point.y - self.field.ground(point, face)
    }

    fn is_inside(&self, t: f64, above: f64) -> bool {
        above < 0.0 || self.at(t).y < self.field.water
    }

    /// The triangle below a point of the ray.
    #[inline(never)]
    fn face_at(&self, t: f64) -> u32 {
        let point = self.at(t);
        let (x, u) = cell(point.x, self.field.cells[0]);
        let (z, v) = cell(point.z, self.field.cells[1]);
        self.field.face(x, z, u + v > 1.0)
    }

    /// Height of a point of the ray.
    #[inline(always)]
    fn height(&self, t: f64) -> f64 {
        self.at(t).y
    }

    /// Sets the inside state from `t` on, and emits a visible root if it changes; `on` is the triangle, if known.
    #[inline(never)]
    fn set_inside(&mut self, t: f64, is_inside: bool, triangle: Option<u32>) {
        if self.inside == Some(is_inside) || self.is_done {
            return;
        }
        let was_known = self.inside.replace(is_inside).is_some();
        if !was_known || !t.is_finite() {
            return;
        }
        let face = triangle.unwrap_or_else(|| self.face_at(t));
        self.root(t, is_inside, face, true);
    }

    #[inline(never)]
    fn cross_wall(&mut self, t: f64, is_inside: bool) {
        let was_inside = self.inside.replace(is_inside);
        if was_inside != Some(is_inside) && t.is_finite() {
            self.root(t, is_inside, WALL, false);
        }
    }

    fn root(&mut self, t: f64, enters: bool, face: u32, is_visible: bool) {
        if self.is_done {
            return;
        }
        let crossing = if enters {
            Crossing::Enter
        } else {
            Crossing::Leave
        };
        self.is_done = !(self.emit)(Root {
            t,
            crossing,
            face,
            is_visible,
        });
    }

    /// Traverses the blocks of cells.
    #[inline(always)]
    fn walk_blocks(&mut self, start: f64, end: f64, from: f64, to: f64) {
        let field = self.field;
        let blocks = [
            field.blocks_along_x,
            field.cells[1].div_ceil(field.block_size),
        ];
        let mut steps = Steps::new(&self.ray, start, end, field.block_size, [[0, 0], blocks]);
        let mut end_height = self.height(start);
        while let Some((x, z, near, far)) = steps.next() {
            let heights = [end_height, self.height(far)];
            end_height = heights[1];
            if far < from {
                self.inside = None;
                self.above = None;
                continue;
            }
            if near > to || self.is_done {
                self.is_done = true;
                return;
            }
            let range = field.block_ranges[z * field.blocks_along_x + x];
            if !self.skip_clear(range, heights, near) {
                self.walk_cells([x, z], near, far);
            }
        }
    }

    /// Skips ground with heights in `low..=high` if the ray, at heights `a` and `b` at its ends, is entirely above or
    /// below it; returns true if so.
    #[inline(always)]
    fn skip_clear(&mut self, [low, high]: [u16; 2], [a, b]: [f64; 2], near: f64) -> bool {
        let water = self.field.water;
        let above_water = |height: u16| {
            let height = f64::from(height);
            if height > water { height } else { water }
        };
        let (low, high) = (above_water(low), above_water(high));
        let (lowest, highest) = if a < b { (a, b) } else { (b, a) };
        let is_above = lowest > high + SLACK;
        let is_below = highest < low - SLACK;
        let is_clear = is_above || is_below;
        if is_clear {
            self.above = None;
            if self.inside != Some(is_below) {
                self.set_inside(near, is_below, None);
            }
        }
        is_clear
    }

    /// Traverses the cells of a block.
    #[allow(clippy::cast_precision_loss, reason = "counts of pixels are exact")]
    #[inline(always)]
    fn walk_cells(&mut self, [x, z]: [usize; 2], start: f64, end: f64) {
        let size = self.field.block_size;
        let first = [x * size, z * size];
        let last_along = |axis: usize| (first[axis] + size).min(self.field.cells[axis]);
        let last = [last_along(0), last_along(1)];
        let mut steps = Steps::new(&self.ray, start, end, 1, [first, last]);
        let Ray { origin, dir } = self.ray;
        let mut end_height = self.height(start);
        while let Some((x, z, near, far)) = steps.next() {
            let heights = [end_height, self.height(far)];
            end_height = heights[1];
            if self.skip_clear(self.field.heights_of(x, z), heights, near) {
                if self.is_done {
                    return;
                }
                continue;
            }
            let diagonal = ((x + z + 1) as f64 - origin.x - origin.z) / (dir.x + dir.z);
            let is_split = near < diagonal && diagonal < far;
            let ends = if is_split {
                [(near, diagonal), (diagonal, far)]
            } else {
                [(near, far), (far, far)]
            };
            for (from, to) in &ends[..1 + usize::from(is_split)] {
                let middle = if *to == *from {
                    self.at(*from)
                } else {
                    self.at(0.5 * (from + to))
                };
                let is_far = middle.x - x as f64 + (middle.z - z as f64) > 1.0;
                self.intersect_triangle(TriangleInterval {
                    from: *from,
                    to: *to,
                    cell: [x, z],
                    is_far,
                });
                if self.is_done {
                    return;
                }
            }
        }
    }

    /// Intersects one triangle.
    #[inline(always)]
    fn intersect_triangle(&mut self, interval: TriangleInterval) {
        let TriangleInterval { from, to, .. } = interval;
        let [x, z] = interval.cell;
        let face = self.field.face(x, z, interval.is_far);
        let plane = self.field.plane_of([x, z], interval.is_far);
        let (start, end) = (self.at(from), self.at(to));
        let above = match self.above {
            Some(above) => above,
            None => start.y - plane.height(start),
        };
        let above_after = end.y - plane.height(end);
        self.above = Some(above_after);
        let water = self.field.water;
        let is_inside = above < 0.0 || start.y < water;
        let (above_water, above_water_after) = (start.y - water, end.y - water);
        match self.inside {
            None => self.inside = Some(is_inside),
            // The end of the previous interval was rounded to the other side.
            Some(was_inside) if was_inside != is_inside => {
                if above_water.abs() < above.abs() {
                    self.cross_water_level(from, is_inside, face);
                } else {
                    self.set_inside(from, is_inside, Some(face));
                }
            }
            Some(_) => {}
        }
        let ground_t = sign_change(interval, above, above_after);
        let water_t = sign_change(interval, above_water, above_water_after);
        let is_inside_after = above_after < 0.0 || above_water_after < 0.0;
        match (is_inside, is_inside_after) {
            (false, true) => match (ground_t, water_t) {
                (Some(ground_t), Some(water_t)) if water_t < ground_t => {
                    self.cross_water_level(water_t, true, face)
                }
                (Some(ground_t), _) => self.set_inside(ground_t, true, Some(face)),
                (None, Some(water_t)) => self.cross_water_level(water_t, true, face),
                (None, None) => {}
            },
            (true, false) => match (ground_t, water_t) {
                (Some(ground_t), Some(water_t)) if water_t > ground_t => {
                    self.cross_water_level(water_t, false, face)
                }
                (Some(ground_t), _) => self.set_inside(ground_t, false, Some(face)),
                (None, Some(water_t)) => self.cross_water_level(water_t, false, face),
                (None, None) => {}
            },
            (true, true) => {
                if let (Some(ground_t), Some(water_t)) = (ground_t, water_t) {
                    // From the ground into the water or back, with air between.
                    if above < 0.0 && ground_t < water_t {
                        self.set_inside(ground_t, false, Some(face));
                        self.cross_water(water_t, true);
                    } else if above >= 0.0 && water_t < ground_t {
                        self.cross_water(water_t, false);
                        self.set_inside(ground_t, true, Some(face));
                    }
                }
            }
            (false, false) => {}
        }
    }

    /// Crosses the water level: ground of the same height is hit instead (measured with POV-Ray).
    #[inline(never)]
    fn cross_water_level(&mut self, t: f64, is_inside: bool, face: u32) {
        if self.field.ground(self.at(t), face) >= self.field.water {
            self.set_inside(t, is_inside, Some(face));
        } else {
            self.cross_water(t, is_inside);
        }
    }

    fn cross_water(&mut self, t: f64, is_inside: bool) {
        if self.inside.replace(is_inside) != Some(is_inside) {
            self.root(t, is_inside, WATER, false);
        }
    }
}

/// The zero of a height that is linear over the interval, if its sign changes.
#[inline(always)]
fn sign_change(interval: TriangleInterval, before: f64, after: f64) -> Option<f64> {
    let TriangleInterval { from, to, .. } = interval;
    ((before < 0.0) != (after < 0.0))
        .then(|| (from + (to - from) * (before / (before - after))).clamp(from, to))
}

/// Interval of a line between two planes across an axis; the first end is the larger if there is none.
fn slab(origin: f64, dir: f64, low: f64, high: f64) -> (f64, f64) {
    if dir == 0.0 {
        return if low <= origin && origin <= high {
            (f64::NEG_INFINITY, f64::INFINITY)
        } else {
            (f64::INFINITY, f64::NEG_INFINITY)
        };
    }
    let (a, b) = ((low - origin) / dir, (high - origin) / dir);
    (a.min(b), a.max(b))
}

/// The cell of a coordinate and the position in it.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "cut to the cells there are"
)]
fn cell(at: f64, cells: usize) -> (usize, f64) {
    let cell = (at.max(0.0) as usize).min(cells - 1);
    (cell, at - cell as f64)
}
