//! A ray through the cells of a height field.

use super::steps::Steps;
use super::{Field, WALL, WATER};
use crate::base::math::Ray;
use crate::scene::shape::{Crossing, Root, Start};
use glam::DVec3;

/// A ray this much above all heights of a square, or below, does not meet them whatever is rounded; in steps of the
/// picture.
const SLACK: f64 = 1.0 / (1 << 20) as f64;

/// What has been found on a ray.
struct Walk<'a> {
    field: &'a Field,
    ray: Ray,
    /// Whether the place at hand is inside; unknown where the walk begins in the middle.
    inside: Option<bool>,
    /// The height of the place at hand above the ground, if it is known.
    above: Option<f64>,
    emit: &'a mut dyn FnMut(Root) -> bool,
    is_over: bool,
}

/// A stretch of the ray above one triangle: the parameters of its ends.
#[derive(Clone, Copy)]
struct Stretch {
    from: f64,
    to: f64,
    cell: [usize; 2],
    is_far: bool,
}

/// The plane of a triangle.
struct Ground {
    /// Where its cell begins.
    corner: [f64; 2],
    /// Its heights at the corner of the cell that is its own, and at those beside along x and along z.
    own: f64,
    right: f64,
    up: f64,
    is_far: bool,
}

impl Ground {
    #[inline]
    fn height(&self, point: DVec3) -> f64 {
        let (u, v) = (point.x - self.corner[0], point.z - self.corner[1]);
        let Ground { own, right, up, .. } = *self;
        if self.is_far {
            own + (1.0 - u) * (up - own) + (1.0 - v) * (right - own)
        } else {
            own + u * (right - own) + v * (up - own)
        }
    }
}

impl Field {
    /// Gives the roots of a ray in order, until `emit` says to stop. Those outside of `span` may be missing, and then
    /// the first of those given may be too.
    pub(super) fn walk(
        &self,
        ray: &Ray,
        (from, to): (f64, f64),
        emit: &mut dyn FnMut(Root) -> bool,
    ) -> Start {
        let size = self.scale();
        let (enter, leave) = slab(ray.origin.x, ray.dir.x, 0.0, size.x);
        let (enter_z, leave_z) = slab(ray.origin.z, ray.dir.z, 0.0, size.z);
        let (enter, leave) = (enter.max(enter_z), leave.min(leave_z));
        let is_met = enter <= leave && ray.origin.is_finite() && ray.dir.is_finite();
        if self.is_empty() || !is_met {
            return Start::Outside;
        }
        let rises = ray.dir.y > 0.0;
        let bottom = self.low;
        let (near, far) = slab(ray.origin.y, ray.dir.y, bottom, self.high.max(bottom));
        // Before it comes to the heights, and after it has passed them.
        let (below_before, below_after) = if ray.dir.y == 0.0 {
            (ray.origin.y < bottom, ray.origin.y < bottom)
        } else {
            (rises, !rises)
        };
        let mut walk = Walk {
            field: self,
            ray: *ray,
            inside: Some(false),
            above: None,
            emit,
            is_over: false,
        };
        if near > leave || near > far {
            walk.wall(enter, below_before);
            walk.wall(leave, false);
        } else if far < enter {
            walk.wall(enter, below_after);
            walk.wall(leave, false);
        } else {
            if near > enter {
                walk.wall(enter, below_before);
            } else {
                let face = walk.face_at(enter);
                let is_inside = walk.is_inside(enter, walk.height_above(enter, face));
                walk.wall(enter, is_inside);
            }
            let end = leave.min(far);
            walk.squares((enter.max(near), end), (from, to));
            if far < leave {
                if bottom == self.water && below_after {
                    let face = walk.face_at(far);
                    walk.level(far, true, face);
                } else {
                    walk.change(far, below_after, None);
                }
            }
            walk.wall(leave, false);
        }
        let is_below = enter == f64::NEG_INFINITY && below_before;
        if is_below {
            Start::Inside
        } else {
            Start::Outside
        }
    }

    /// Whether a point lies below the surface or the water.
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

    fn face(&self, x: usize, z: usize, is_far: bool) -> u32 {
        let cell = u32::try_from(z * self.cells[0] + x).expect("cells are counted in 31 bits");
        2 * cell + u32::from(is_far)
    }

    /// The height of the plane of a triangle.
    pub(super) fn ground(&self, point: DVec3, face: u32) -> f64 {
        let (x, z, is_far) = self.cell(face);
        self.ground_of([x, z], is_far).height(point)
    }

    #[allow(clippy::cast_precision_loss, reason = "counts of pixels are exact")]
    fn ground_of(&self, [x, z]: [usize; 2], is_far: bool) -> Ground {
        let own = usize::from(is_far);
        Ground {
            corner: [x as f64, z as f64],
            own: self.height(x + own, z + own),
            right: self.height(x + 1, z),
            up: self.height(x, z + 1),
            is_far,
        }
    }
}

impl Walk<'_> {
    #[inline]
    fn at(&self, t: f64) -> DVec3 {
        if t.is_finite() {
            self.ray.at(t)
        } else {
            // A vertical ray is in one place.
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

    /// The triangle below a place of the ray.
    fn face_at(&self, t: f64) -> u32 {
        let point = self.at(t);
        let (x, u) = cell(point.x, self.field.cells[0]);
        let (z, v) = cell(point.z, self.field.cells[1]);
        self.field.face(x, z, u + v > 1.0)
    }

    /// The height of a place of the ray.
    #[inline]
    fn height(&self, t: f64) -> f64 {
        self.at(t).y
    }

    /// The ray is inside from here on, or is not; `on` is the triangle it crosses, if the ground is what it crosses.
    fn change(&mut self, t: f64, is_inside: bool, on: Option<u32>) {
        if self.inside == Some(is_inside) || self.is_over {
            return;
        }
        let was_known = self.inside.replace(is_inside).is_some();
        if !was_known || !t.is_finite() {
            return;
        }
        let face = on.unwrap_or_else(|| self.face_at(t));
        self.root(t, is_inside, face, true);
    }

    fn wall(&mut self, t: f64, is_inside: bool) {
        let was_inside = self.inside.replace(is_inside);
        if was_inside != Some(is_inside) && t.is_finite() {
            self.root(t, is_inside, WALL, false);
        }
    }

    fn root(&mut self, t: f64, enters: bool, face: u32, is_visible: bool) {
        if self.is_over {
            return;
        }
        let crossing = if enters {
            Crossing::Enter
        } else {
            Crossing::Leave
        };
        self.is_over = !(self.emit)(Root {
            t,
            crossing,
            face,
            is_visible,
        });
    }

    /// Follows the ray through squares of cells.
    fn squares(&mut self, span: (f64, f64), (from, to): (f64, f64)) {
        let field = self.field;
        let across = [field.squares_along_x, field.cells[1].div_ceil(field.square)];
        let mut steps = Steps::new(&self.ray, span, field.square, [[0, 0], across]);
        let mut ahead = self.height(span.0);
        while let Some((x, z, near, far)) = steps.next() {
            let heights = [ahead, self.height(far)];
            ahead = heights[1];
            if far < from {
                self.inside = None;
                self.above = None;
                continue;
            }
            if near > to || self.is_over {
                self.is_over = true;
                return;
            }
            let range = field.squares[z * field.squares_along_x + x];
            if !self.passes(range, heights, near) {
                self.cells([x, z], (near, far));
            }
        }
    }

    /// Goes past ground between these heights if the ray, which is at other heights from `near` on, is above or below all of
    /// it; says whether it is.
    #[inline]
    fn passes(&mut self, [low, high]: [u16; 2], [a, b]: [f64; 2], near: f64) -> bool {
        let water = self.field.water;
        let [low, high] = [low, high].map(|height| {
            let height = f64::from(height);
            if height > water { height } else { water }
        });
        let (least, most) = if a < b { (a, b) } else { (b, a) };
        let is_above = least > high + SLACK;
        let is_below = most < low - SLACK;
        let is_passed = is_above || is_below;
        if is_passed {
            self.above = None;
            if self.inside != Some(is_below) {
                self.change(near, is_below, None);
            }
        }
        is_passed
    }

    /// Follows the ray through the cells of a square.
    #[allow(clippy::cast_precision_loss, reason = "counts of pixels are exact")]
    fn cells(&mut self, [x, z]: [usize; 2], span: (f64, f64)) {
        let size = self.field.square;
        let first = [x * size, z * size];
        let end = [0, 1].map(|axis| (first[axis] + size).min(self.field.cells[axis]));
        let mut steps = Steps::new(&self.ray, span, 1, [first, end]);
        let Ray { origin, dir } = self.ray;
        let mut ahead = self.height(span.0);
        while let Some((x, z, near, far)) = steps.next() {
            let heights = [ahead, self.height(far)];
            ahead = heights[1];
            if self.passes(self.field.heights_of(x, z), heights, near) {
                if self.is_over {
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
                self.pass(Stretch {
                    from: *from,
                    to: *to,
                    cell: [x, z],
                    is_far,
                });
                if self.is_over {
                    return;
                }
            }
        }
    }

    /// Passes over one triangle.
    fn pass(&mut self, stretch: Stretch) {
        let Stretch { from, to, .. } = stretch;
        let [x, z] = stretch.cell;
        let face = self.field.face(x, z, stretch.is_far);
        let ground = self.field.ground_of([x, z], stretch.is_far);
        let [start, end] = [from, to].map(|t| self.at(t));
        let above = match self.above {
            Some(above) => above,
            None => start.y - ground.height(start),
        };
        let above_after = end.y - ground.height(end);
        self.above = Some(above_after);
        let water = self.field.water;
        let is_inside = above < 0.0 || start.y < water;
        let (wet, wet_after) = (start.y - water, end.y - water);
        match self.inside {
            None => self.inside = Some(is_inside),
            // The end of the stretch before was rounded to the other side.
            Some(was_inside) if was_inside != is_inside => {
                if wet.abs() < above.abs() {
                    self.level(from, is_inside, face);
                } else {
                    self.change(from, is_inside, Some(face));
                }
            }
            Some(_) => {}
        }
        let ground = zero(stretch, above, above_after);
        let sea = zero(stretch, wet, wet_after);
        let is_inside_after = above_after < 0.0 || wet_after < 0.0;
        match (is_inside, is_inside_after) {
            (false, true) => match (ground, sea) {
                (Some(ground), Some(sea)) if sea < ground => self.level(sea, true, face),
                (Some(ground), _) => self.change(ground, true, Some(face)),
                (None, Some(sea)) => self.level(sea, true, face),
                (None, None) => {}
            },
            (true, false) => match (ground, sea) {
                (Some(ground), Some(sea)) if sea > ground => self.level(sea, false, face),
                (Some(ground), _) => self.change(ground, false, Some(face)),
                (None, Some(sea)) => self.level(sea, false, face),
                (None, None) => {}
            },
            (true, true) => {
                if let (Some(ground), Some(sea)) = (ground, sea) {
                    // Out of the ground and into the water, or the other way round, with air between.
                    if above < 0.0 && ground < sea {
                        self.change(ground, false, Some(face));
                        self.water(sea, true);
                    } else if above >= 0.0 && sea < ground {
                        self.water(sea, false);
                        self.change(ground, true, Some(face));
                    }
                }
            }
            (false, false) => {}
        }
    }

    /// At the level of the water: of ground that lies as high, the ground is met (measured with POV-Ray).
    fn level(&mut self, t: f64, is_inside: bool, face: u32) {
        if self.field.ground(self.at(t), face) >= self.field.water {
            self.change(t, is_inside, Some(face));
        } else {
            self.water(t, is_inside);
        }
    }

    fn water(&mut self, t: f64, is_inside: bool) {
        if self.inside.replace(is_inside) != Some(is_inside) {
            self.root(t, is_inside, WATER, false);
        }
    }
}

/// Where a height that changes evenly over a stretch changes its sign.
fn zero(stretch: Stretch, before: f64, after: f64) -> Option<f64> {
    let Stretch { from, to, .. } = stretch;
    ((before < 0.0) != (after < 0.0))
        .then(|| (from + (to - from) * (before / (before - after))).clamp(from, to))
}

/// The part of a line between two planes across an axis; the first end is the larger if there is none.
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

/// The cell of a coordinate and the place in it.
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
