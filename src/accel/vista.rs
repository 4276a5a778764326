//! What lies around a point from which many rays go out or at which many arrive, a camera or a lamp: a grid of cells
//! across the view, each with the items that a ray through it may meet, the nearest first (Haines and Greenberg 1986, "The
//! light buffer: a shadow-testing accelerator").
//!
//! A ray looks up its cell and walks no tree. Cells are found, and items tried, in single precision with every doubt in
//! favour of being met: what is visited is more than what is met, never less. So answers are those of the tree, to the bit.

use super::Bvh;
use super::bundle::{
    Ball, DOUBT, FARTHEST, Group, GroupAndBall, GroupAndBox, LANES, Slab, all, cross, dot,
    frame_end, length_sq, load,
};
use super::node::{Cell, Frame};
use super::raster::{Grid, Raster, Rect};
use super::view::{Extent, View};
use crate::math::lanes::{Eight, Kernel, Lanes, eight};
use crate::math::rounding::{f32_above, nearest};
use glam::{DVec3, Vec3};

/// Adding and subtracting this rounds a small number to a whole one.
const WHOLE: f32 = 8_388_608.0;
/// The view of a camera goes on beside the picture for so many times as many pixels as lie together.
const BESIDE: f64 = 2.0;
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
    rods: Vec<SeenRod>,
}

/// An item as it is seen.
#[derive(Clone, Copy, Debug)]
struct Known {
    /// A ball around it, relative to the point.
    centre: [f32; 3],
    radius: f32,
    /// Nothing of it is nearer.
    near: f32,
    /// Its box, and the rod around it; [`NONE`] where the ball tells as much.
    slab: u32,
    rod: u32,
}

const NONE: u32 = u32::MAX;

/// A round rod without ends that holds an item: a point of its axis, the direction of that, and its radius.
pub type Rod = (DVec3, DVec3, f64);

/// The same as seen from a point.
#[derive(Clone, Copy, Debug)]
struct SeenRod {
    from: [f32; 3],
    way: [f32; 3],
    /// The square of the radius, and of what rounding may add to a distance from it, with room for the sum of both.
    radius_sq: f32,
    slack_sq: f32,
}

impl SeenRod {
    fn new((from, way, radius): Rod, frame: &Frame, origin: DVec3) -> Option<Self> {
        let from = frame.place(from) - origin;
        let way = way.try_normalize()?;
        // The point of the axis that is nearest tells it best.
        let from = from - from.dot(way) * way;
        let radius = f64::from(f32_above(radius * frame.scale() * (1.0 + 1e-6)));
        let slack = 16.0 * f64::from(DOUBT) * (from.length() + radius);
        // (a + b)² is at most 1.01 a² + 101 b².
        let rod = SeenRod {
            from: [from.x, from.y, from.z].map(nearest),
            way: [way.x, way.y, way.z].map(nearest),
            radius_sq: f32_above(1.01 * radius * radius),
            slack_sq: f32_above(101.0 * slack * slack),
        };
        (rod.radius_sq.is_finite() && rod.slack_sq.is_finite()).then_some(rod)
    }
}

/// Which rays of a group may come as near to the axis of a rod as its radius, one bit each.
struct GroupAndRod<'a> {
    group: &'a Group,
    rod: &'a SeenRod,
}

impl Kernel for GroupAndRod<'_> {
    type Answer = u32;

    #[inline(always)]
    fn run<E: Eight>(&self) -> u32 {
        let across: [E; 3] = cross(load(&self.group.dir), all(self.rod.way));
        let off = dot(across, all(self.rod.from));
        let limit = length_sq(across).times(E::all(self.rod.radius_sq));
        off.times(off)
            .not_above(limit.plus(E::all(self.rod.slack_sq)))
    }
}

impl Known {
    /// Out of view.
    const NOTHING: Known = Known {
        centre: [0.0; 3],
        radius: 0.0,
        near: f32::INFINITY,
        slab: NONE,
        rod: NONE,
    };
}

impl Known {
    fn new(ball: Option<Ball>, cell: &Cell, origin: DVec3, slabs: &mut Vec<Slab>) -> Self {
        let slab = match ball {
            Some(ball) if ball.is_filled => NONE,
            _ => u32::try_from(slabs.len()).unwrap_or(NONE),
        };
        if slab != NONE {
            slabs.push(Slab::new(cell, origin));
        }
        let ball = ball.unwrap_or_else(|| Ball::around(cell));
        let (centre, radius, distance) = ball.seen_from(origin);
        Known {
            centre: centre.to_array(),
            radius,
            near: (distance * (1.0 - 4.0 * DOUBT) - radius).max(0.0),
            slab,
            rod: NONE,
        }
    }
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
    pub fn from_outside(
        tree: &Bvh,
        point: DVec3,
        rods: impl Fn(u32) -> Option<Rod>,
    ) -> Option<Vista> {
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
        let mut slopes = window.low.iter().chain(&window.high);
        let is_narrow = slopes.all(|slope| slope.abs() <= reach);
        is_narrow.then(|| Vista::new(tree, (&view, window), rods, None))?
    }

    /// What a camera at a point sees: slopes are measured by `axes` and go from -0.5 to 0.5 across and up the picture, of
    /// which pixels of so many slopes lie together.
    #[must_use]
    pub fn of_picture(
        tree: &Bvh,
        point: DVec3,
        (axes, together): ([DVec3; 3], [f64; 2]),
        rods: impl Fn(u32) -> Option<Rod>,
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
        Vista::new(tree, (&view, window), rods, Some(together))
    }

    fn new(
        tree: &Bvh,
        (view, window): (&View, Rect),
        rods: impl Fn(u32) -> Option<Rod>,
        together: Option<[f64; 2]>,
    ) -> Option<Vista> {
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
        let (mut slabs, mut seen_rods) = (Vec::new(), Vec::new());
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
            let known = &mut known[item as usize];
            *known = Known::new(ball, &cell, view.origin, &mut slabs);
            let rod = rods(item).and_then(|rod| SeenRod::new(rod, &tree.frame, view.origin));
            if let Some(rod) = rod {
                known.rod = u32::try_from(seen_rods.len()).unwrap_or(NONE);
                seen_rods.push(rod);
            }
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
            rods: seen_rods,
        })
    }

    /// The memory it takes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of::<Self>()
            + self.raster.bytes()
            + self.known.capacity() * size_of::<Known>()
            + self.slabs.capacity() * size_of::<Slab>()
            + self.rods.capacity() * size_of::<SeenRod>()
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
                if may_meet != 0 && known.slab != NONE {
                    let slab = &self.slabs[known.slab as usize];
                    may_meet &= eight(lanes, &GroupAndBox { group, slab });
                }
                if may_meet != 0 && known.rod != NONE {
                    let rod = &self.rods[known.rod as usize];
                    may_meet &= eight(lanes, &GroupAndRod { group, rod });
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
            if known.slab != NONE && !self.slabs[known.slab as usize].is_met(dir, end) {
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
