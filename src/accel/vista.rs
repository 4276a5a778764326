//! What lies around a point from which many rays go out or at which many arrive, a camera or a lamp: a grid of cells
//! across the view, each with the items that a ray through it may meet, the nearest first (Haines and Greenberg 1986, "The
//! light buffer: a shadow-testing accelerator").
//!
//! A ray looks up its cell and walks no tree. Cells are found, and items tried, in single precision with every doubt in
//! favour of being met: what is visited is more than what is met, never less. So answers are those of the tree, to the bit.

use super::Bvh;
use super::bundle::{
    Ball, DOUBT, FARTHEST, Group, GroupAndBall, GroupAndBox, LANES, Slab, all, dot, frame_end, load,
};
use super::node::{Cell, Frame};
use super::raster::{Grid, Raster, Rect};
use crate::math::lanes::{Eight, Kernel, Lanes, eight};
use crate::math::rounding::nearest;
use glam::{DMat3, DVec3, Vec3};

/// Adding and subtracting this rounds a small number to a whole one.
const WHOLE: f32 = 8_388_608.0;
/// The view of a camera goes on beside the picture for so many times as many pixels as lie together.
const BESIDE: f64 = 2.0;
/// No rounding of a ray may move it by more than this share of a cell.
const SHARP: f64 = 1.0 / 32.0;
/// A direction from a lamp to its items has at least this cosine with the middle one, or a flat grid is no use.
const LEAST_COSINE: f64 = 0.4;

/// What lies around a point.
#[derive(Clone, Debug)]
pub struct Vista {
    /// The frame of the tree, and the point in it.
    frame: Frame,
    origin: DVec3,
    /// How slopes are measured: those across and up are `axes[0] · dir / axes[2] · dir` and `axes[1] · dir / axes[2] · dir`.
    axes: [[f32; 3]; 3],
    raster: Raster,
    known: Vec<Known>,
    slabs: Vec<Slab>,
    /// Whether all items are in view, so that a ray that leaves it meets none.
    is_whole: bool,
}

/// An item as it is seen.
#[derive(Clone, Copy, Debug)]
struct Known {
    /// A ball around it, relative to the point.
    centre: [f32; 3],
    radius: f32,
    /// Nothing of it is nearer.
    near: f32,
    /// Its box; [`NO_SLAB`] where the ball tells as much.
    slab: u32,
}

const NO_SLAB: u32 = u32::MAX;

impl Known {
    /// Out of view.
    const NOTHING: Known = Known {
        centre: [0.0; 3],
        radius: 0.0,
        near: f32::INFINITY,
        slab: NO_SLAB,
    };
}

impl Known {
    fn new(ball: Option<Ball>, cell: &Cell, origin: DVec3, slabs: &mut Vec<Slab>) -> Self {
        let slab = match ball {
            Some(ball) if ball.is_filled => NO_SLAB,
            _ => u32::try_from(slabs.len()).unwrap_or(NO_SLAB),
        };
        if slab != NO_SLAB {
            slabs.push(Slab::new(cell, origin));
        }
        let ball = ball.unwrap_or_else(|| Ball::around(cell));
        let (centre, radius, distance) = ball.seen_from(origin);
        Known {
            centre: centre.to_array(),
            radius,
            near: (distance * (1.0 - 4.0 * DOUBT) - radius).max(0.0),
            slab,
        }
    }
}

/// How a point looks at a tree.
#[derive(Clone, Copy)]
struct View {
    /// In the frame of the tree.
    origin: DVec3,
    /// By which slopes are measured.
    axes: [DVec3; 3],
}

impl View {
    /// The slopes between which lies what is in a box, and in a ball if one is given.
    fn rect(&self, ball: Option<&Ball>, cell: &Cell) -> Extent {
        let ball = ball.map_or(Extent::Everywhere, |ball| self.rect_of_ball(ball));
        match (ball, self.rect_of_cell(cell)) {
            (Extent::Nowhere, _) | (_, Extent::Nowhere) => Extent::Nowhere,
            (Extent::Everywhere, one) | (one, Extent::Everywhere) => one,
            (Extent::Within(a), Extent::Within(b)) => Extent::Within(a.both(&b)),
        }
    }

    /// Tangent planes of a ball: those of slope `s` have the normal `n = axis - s · axes[2]`, and `n · centre = ± radius · |n|`.
    fn rect_of_ball(&self, ball: &Ball) -> Extent {
        let (centre, radius, _) = ball.seen_from(self.origin);
        let (centre, radius) = (centre.as_dvec3(), f64::from(radius));
        let along = self.axes[2];
        let depth = along.dot(centre);
        let a = depth * depth - radius * radius * along.length_squared();
        if depth <= 0.0 && a > 0.0 {
            return Extent::Nowhere;
        }
        if a <= 1e-6 * depth * depth {
            return Extent::Everywhere;
        }
        let mut rect = Rect::EMPTY;
        for (side, axis) in self.axes[..2].iter().enumerate() {
            let place = axis.dot(centre);
            let b = place * depth - radius * radius * axis.dot(along);
            let c = place * place - radius * radius * axis.length_squared();
            let spread = (b * b - a * c).max(0.0).sqrt();
            rect.low[side] = (b - spread) / a;
            rect.high[side] = (b + spread) / a;
        }
        Extent::Within(rect)
    }

    /// Whether single precision tells the cells of a grid over a window apart.
    fn is_sharp(&self, window: &Rect, grid: &Grid) -> bool {
        let [across, up, along] = self.axes;
        let dirs = DMat3::from_cols(across, up, along).transpose().inverse();
        let mut least = f64::INFINITY;
        for x in [window.low[0], window.high[0]] {
            for y in [window.low[1], window.high[1]] {
                let dir = dirs * DVec3::new(x, y, 1.0);
                least = least.min(along.dot(dir) / (along.length() * dir.length()));
            }
        }
        let is_sharp = |side: usize| {
            let farthest = window.low[side].abs().max(window.high[side].abs());
            let size = self.axes[side].length() / along.length() + farthest;
            let error = 2.0 * f64::from(DOUBT) * size / least * f64::from(grid.rate[side])
                + f64::from(DOUBT * grid.start[side].abs());
            error < SHARP
        };
        // Not a number is not enough.
        least > 0.0 && is_sharp(0) && is_sharp(1)
    }

    fn rect_of_cell(&self, cell: &Cell) -> Extent {
        let low = DVec3::from(cell.low.map(f64::from)) - self.origin;
        let high = DVec3::from(cell.high.map(f64::from)) - self.origin;
        let size = low.abs().max(high.abs()).max_element() * self.axes[2].length();
        let mut rect = Rect::EMPTY;
        let (mut nearest, mut farthest) = (f64::INFINITY, f64::NEG_INFINITY);
        for corner in 0..8 {
            let pick = |axis: usize| [low[axis], high[axis]][corner >> axis & 1];
            let corner = DVec3::new(pick(0), pick(1), pick(2));
            let depth = self.axes[2].dot(corner);
            nearest = nearest.min(depth);
            farthest = farthest.max(depth);
            for side in 0..2 {
                let slope = self.axes[side].dot(corner) / depth;
                rect.low[side] = rect.low[side].min(slope);
                rect.high[side] = rect.high[side].max(slope);
            }
        }
        // NaN is everywhere.
        if nearest > 1e-6 * size {
            Extent::Within(rect)
        } else if farthest < -1e-6 * size {
            Extent::Nowhere
        } else {
            Extent::Everywhere
        }
    }
}

/// Where something is seen.
enum Extent {
    Nowhere,
    Within(Rect),
    Everywhere,
}

/// Eight rays from the point of a vista, or to it.
#[derive(Debug)]
pub(crate) struct EightRays {
    group: Group,
    scale: f64,
    farthest: f32,
    /// Which of them are there, one bit each.
    there: u32,
}

impl EightRays {
    /// Lets a ray end sooner: at this distance, or before it begins if that is negative.
    #[inline(always)]
    pub(crate) fn end(&mut self, ray: usize, end: f64) {
        self.group.end[ray % LANES] = frame_end(end, self.scale);
        self.farthest = self.group.farthest();
    }
}

impl Vista {
    /// What a lamp at a point sees of all items; `None` where a flat grid is no use.
    #[must_use]
    pub fn from_outside(tree: &Bvh, point: DVec3) -> Option<Vista> {
        let origin = tree.frame.place(point);
        let along = (-origin).try_normalize()?;
        let (across, up) = along.any_orthonormal_pair();
        let view = View {
            origin,
            axes: [across, up, along],
        };
        let whole = tree.whole()?;
        let reach = (1.0 / (LEAST_COSINE * LEAST_COSINE) - 1.0).sqrt();
        let Extent::Within(window) = view.rect_of_cell(&whole) else {
            return None;
        };
        let slopes = window.low.iter().chain(&window.high);
        let is_narrow = slopes.fold(true, |narrow, slope| narrow && slope.abs() <= reach);
        is_narrow.then(|| Vista::new(tree, &view, window, None))?
    }

    /// What a camera at a point sees: slopes are measured by `axes` and go from -0.5 to 0.5 across and up the picture, of
    /// which pixels of so many slopes lie together.
    #[must_use]
    pub fn of_picture(
        tree: &Bvh,
        point: DVec3,
        axes: [DVec3; 3],
        together: [f64; 2],
    ) -> Option<Vista> {
        let size = axes[2].length();
        let view = View {
            origin: tree.frame.place(point),
            axes: axes.map(|axis| axis / size),
        };
        // Rays may go a little beside the picture.
        let beside = together.map(|together| BESIDE * together);
        let window = Rect {
            low: beside.map(|beside| -0.5 - beside),
            high: beside.map(|beside| 0.5 + beside),
        };
        Vista::new(tree, &view, window, Some(together))
    }

    fn new(tree: &Bvh, view: &View, window: Rect, together: Option<[f64; 2]>) -> Option<Vista> {
        let is_near = view.origin.abs().max_element() < FARTHEST;
        let is_fit = view.axes.iter().all(|axis| axis.is_finite());
        if !is_near || !is_fit || !tree.frame.scale().is_normal() {
            return None;
        }
        let axes = view.axes.map(|axis| [axis.x, axis.y, axis.z].map(nearest));
        // Slopes are measured as they will be.
        let view = View {
            axes: axes.map(|axis| DVec3::from(axis.map(f64::from))),
            ..*view
        };
        let mut count = 0;
        tree.each_item(|item, _| count = count.max(item as usize + 1));
        let mut rects = vec![Rect::EMPTY; count];
        let mut known = vec![Known::NOTHING; count];
        let mut slabs = Vec::new();
        tree.each_item(|item, cell| {
            let ball = tree.balls.get(item as usize).copied().flatten();
            let rect = match view.rect(ball.as_ref(), &cell) {
                Extent::Nowhere => return,
                Extent::Within(rect) => rect,
                Extent::Everywhere => window,
            };
            let Some(rect) = rect.shared(&window) else {
                return;
            };
            rects[item as usize] = rect;
            known[item as usize] = Known::new(ball, &cell, view.origin, &mut slabs);
        });
        let raster = Raster::new(&rects, |item| known[item].near, window, together)?;
        if !view.is_sharp(&window, &raster.grid) {
            return None;
        }
        for known in &mut known {
            known.near = raster.rounded(known.near);
        }
        Some(Vista {
            frame: tree.frame,
            origin: view.origin,
            axes,
            raster,
            known,
            slabs,
            is_whole: together.is_none(),
        })
    }

    /// The memory it takes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of::<Self>()
            + self.raster.bytes()
            + self.known.capacity() * size_of::<Known>()
            + self.slabs.capacity() * size_of::<Slab>()
    }

    /// Rays from here of these unit directions, which end at such distances, four and four, of which those marked in `there`
    /// are there.
    #[inline(always)]
    pub(crate) fn rays(&self, halves: [(&[[f64; 4]; 3], &[f64; 4]); 2], there: u32) -> EightRays {
        let mut rays = EightRays {
            group: Group::EMPTY,
            scale: self.frame.scale(),
            farthest: 0.0,
            there,
        };
        rays.group.take(0, halves[0], rays.scale);
        rays.group.take(1, halves[1], rays.scale);
        for (ray, end) in rays.group.end.iter_mut().enumerate() {
            if there >> ray & 1 == 0 {
                *end = f32::NEG_INFINITY;
            }
        }
        rays.farthest = rays.group.farthest();
        rays
    }

    /// The same for rays to here, of which the distances tell where they begin.
    #[inline(always)]
    pub(crate) fn rays_back(
        &self,
        halves: [(&[[f64; 4]; 3], &[f64; 4]); 2],
        there: u32,
    ) -> EightRays {
        let mut rays = self.rays(halves, there);
        for dir in &mut rays.group.dir {
            for dir in dir {
                *dir = -*dir;
            }
        }
        rays
    }

    /// Visits, the nearest first, items with those of eight rays that may meet them before they end, one bit each; `visit` notes new ends. Gives the rays that leave the view.
    #[inline(always)]
    pub(crate) fn each(
        &self,
        lanes: Lanes,
        rays: &mut EightRays,
        mut visit: impl FnMut(u32, u32, &mut EightRays),
    ) -> u32 {
        let vista = self;
        let group = &rays.group;
        let (cells, inside) = eight(lanes, &CellsOf { vista, group });
        let there = rays.there;
        let mut left = inside & there;
        while left != 0 {
            let cell = cells[left.trailing_zeros() as usize % LANES];
            let cells = &cells;
            let alike = left & eight(lanes, &Alike { cells, cell });
            left &= !alike;
            for &item in self.raster.items(number_of(cell)) {
                let known = &self.known[item as usize];
                if known.near > rays.farthest {
                    break;
                }
                let group = &rays.group;
                let ball = GroupAndBall {
                    group,
                    centre: Vec3::from_array(known.centre),
                    radius: known.radius,
                };
                let mut may_meet = alike & eight(lanes, &ball);
                if may_meet != 0 && known.slab != NO_SLAB {
                    let slab = &self.slabs[known.slab as usize];
                    may_meet &= eight(lanes, &GroupAndBox { group, slab });
                }
                if may_meet != 0 {
                    visit(item, may_meet, rays);
                }
            }
        }
        there & !inside
    }

    /// Visits, the nearest first, the items that may lie between here and a point, until `visit` says to stop. Says
    /// whether it did.
    #[inline(always)]
    pub(crate) fn between(&self, point: DVec3, mut visit: impl FnMut(u32) -> bool) -> bool {
        let way = self.frame.place(point) - self.origin;
        let distance = way.length();
        let dir = (way / distance).as_vec3();
        let [across, up, along] = self.axes.map(Vec3::from_array);
        let depth = along.dot(dir);
        let grid = &self.raster.grid;
        let mut cell = 0;
        for (side, axis) in [up, across].into_iter().enumerate() {
            let side = 1 - side;
            let at = axis.dot(dir) / depth * grid.rate[side] + grid.start[side];
            let size = grid.size[side];
            if !(depth > 0.0 && at >= 0.0 && at < as_number(size)) {
                return false;
            }
            cell = cell * size as usize + number_of(at);
        }
        let end = nearest(distance) * (1.0 + 4.0 * DOUBT);
        for &item in self.raster.items(cell) {
            let known = &self.known[item as usize];
            if known.near > end {
                break;
            }
            let centre = Vec3::from_array(known.centre);
            let limit = known.radius * known.radius * (1.0 + 4.0 * DOUBT);
            let along = dir.dot(centre);
            if dir.cross(centre).length_squared() > limit
                || along - known.radius > end
                || along + known.radius < 0.0
            {
                continue;
            }
            if known.slab != NO_SLAB && !self.slabs[known.slab as usize].is_met(dir, end) {
                continue;
            }
            if visit(item) {
                return true;
            }
        }
        false
    }
}

/// The number of a cell that is there.
#[inline(always)]
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a small whole number"
)]
fn number_of(cell: f32) -> usize {
    cell as u32 as usize
}

#[inline(always)]
#[allow(clippy::cast_precision_loss, reason = "a grid has few rows")]
fn as_number(size: u32) -> f32 {
    size as f32
}

/// In which cells eight rays are, and which of them are in any, one bit each.
struct CellsOf<'a> {
    vista: &'a Vista,
    group: &'a Group,
}

impl Kernel for CellsOf<'_> {
    type Answer = ([f32; LANES], u32);

    #[inline(always)]
    fn run<E: Eight>(&self) -> ([f32; LANES], u32) {
        let Grid { rate, start, size } = self.vista.raster.grid;
        let dir: [E; 3] = load(&self.group.dir);
        let depth = dot(all(self.vista.axes[2]), dir);
        let mut inside = E::all(f32::MIN_POSITIVE).not_above(depth);
        let mut cells = E::all(0.0);
        for side in [1, 0] {
            let slope = dot(all(self.vista.axes[side]), dir).over(depth);
            let at = slope.times(E::all(rate[side])).plus(E::all(start[side]));
            // Rounded to the nearest of the middles of cells; which of two at their edge does not matter.
            let whole = at
                .minus(E::all(0.5))
                .plus(E::all(WHOLE))
                .minus(E::all(WHOLE));
            let size = as_number(size[side]);
            inside &= E::all(0.0).not_above(whole) & whole.not_above(E::all(size - 1.0));
            cells = cells.times(E::all(size)).plus(whole);
        }
        (cells.store(), inside)
    }
}

/// Which of eight cells are this one, one bit each.
struct Alike<'a> {
    cells: &'a [f32; LANES],
    cell: f32,
}

impl Kernel for Alike<'_> {
    type Answer = u32;

    #[inline(always)]
    fn run<E: Eight>(&self) -> u32 {
        let cells = E::load(self.cells);
        let cell = E::all(self.cell);
        cells.not_above(cell) & cell.not_above(cells)
    }
}
