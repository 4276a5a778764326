//! What lies around a point from which many rays go out or at which many arrive, a camera or a lamp: a grid of cells
//! across the view, each with the items that a ray through it may meet, the nearest first (Haines and Greenberg 1986, "The
//! light buffer: a shadow-testing accelerator").
//!
//! A ray looks up its cell and walks no tree. Cells are found, and items tried, in single precision with every doubt in
//! favour of being met: what is visited is more than what is met, never less. So answers are those of the tree, to the bit.

pub(super) mod grid;
pub(super) mod lookup;
pub(super) mod projection;

use super::Bvh;
use super::bounding_cylinder::{BoundingCylinder, ViewedCylinder};
use super::bounding_sphere::BoundingSphere;
use super::bundle::FARTHEST;
use super::light_buffer::grid::{CellGrid, Rect, SlopeRange};
use super::light_buffer::projection::{Projection, ViewExtent};
use super::node::Frame;
use super::packet::{DOUBT, ViewBox};
use crate::base::math::rounding::nearest;
use glam::{DVec3, Vec3};

/// The view of a camera goes on beside the picture for so many times as many pixels as lie together.
const BESIDE: f64 = 2.0;
/// A direction from a lamp to its items has at least this cosine with the middle one, or a flat grid is no use.
const LEAST_COSINE: f64 = 0.4;
/// So many items may lie around the point or beside the grid: every ray asks about them.
const MOST_AROUND: usize = 8;
/// So many nodes tell well enough in which direction the items lie.
const NODES_THAT_TELL: usize = 1024;

/// What lies around a point.
#[derive(Clone, Debug)]
pub struct LightBuffer {
    /// The frame of the tree, and the point in it.
    pub(super) frame: Frame,
    pub(super) origin: DVec3,
    /// How slopes are measured: those across and up are `axes[0] · dir / axes[2] · dir` and `axes[1] · dir / axes[2] · dir`.
    pub(super) axes: [[f32; 3]; 3],
    pub(super) raster: CellGrid,
    /// The items that are no part of the picture that the grid holds: those around the point, and beside it.
    pub(super) around: Vec<u32>,
    pub(super) known: Vec<ItemProxy>,
    /// More of items that are not balls; empty if all are, or if of each no more is known than its slab.
    forms: Vec<ItemBounds>,
    pub(super) slabs: Vec<ViewBox>,
    pub(super) rods: Vec<ViewedCylinder>,
}

/// An item as it is seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct ItemProxy {
    /// A ball around it, relative to the point.
    pub(super) centre: [f32; 3],
    pub(super) radius: f32,
    /// Nothing of it is nearer.
    pub(super) near: f32,
}

/// The box of an item, and the rod around it; [`NONE`] where the ball tells as much.
#[derive(Clone, Copy, Debug)]
pub(super) struct ItemBounds {
    pub(super) slab: u32,
    pub(super) rod: u32,
}

pub(super) const NONE: u32 = u32::MAX;

impl ItemBounds {
    const BALL: ItemBounds = ItemBounds {
        slab: NONE,
        rod: NONE,
    };
}

impl ItemProxy {
    /// Out of view.
    const NOTHING: ItemProxy = ItemProxy {
        centre: [0.0; 3],
        radius: 0.0,
        near: f32::INFINITY,
    };

    /// Within a ball of this centre and radius at such a distance.
    #[inline(always)]
    fn new((centre, radius, distance): (Vec3, f32, f32)) -> Self {
        ItemProxy {
            centre: centre.to_array(),
            radius,
            near: (distance * (1.0 - 4.0 * DOUBT) - radius).max(0.0),
        }
    }
}

impl LightBuffer {
    /// What a lamp at a point sees of all items; `None` where a flat grid is no use, since they lie all around.
    #[must_use]
    pub fn from_outside(
        tree: &Bvh,
        point: DVec3,
        rods: impl Fn(u32) -> Option<BoundingCylinder>,
    ) -> Option<LightBuffer> {
        let origin = tree.frame.place(point);
        let mut sum = DVec3::ZERO;
        let step = ((tree.nodes.len() + tree.blocks.len()) / NODES_THAT_TELL).max(1);
        tree.some_items(step, |_, cell| {
            let (low, high) = cell.ends();
            if !(low.cmple(origin) & origin.cmple(high)).all() {
                sum += (0.5 * low + 0.5 * high - origin).normalize_or_zero();
            }
        });
        let along = sum.try_normalize()?;
        let (across, up) = along.any_orthonormal_pair();
        let view = Projection {
            origin,
            axes: [across, up, along],
        };
        LightBuffer::new(tree, (&view, None), rods, None)
    }

    /// What a camera at a point sees: slopes are measured by `axes` and go from -0.5 to 0.5 across and up the picture, of
    /// which pixels of so many slopes lie together.
    #[must_use]
    pub fn of_picture(
        tree: &Bvh,
        point: DVec3,
        (axes, together): ([DVec3; 3], [f64; 2]),
        rods: impl Fn(u32) -> Option<BoundingCylinder>,
    ) -> Option<LightBuffer> {
        let size = axes[2].length();
        let view = Projection {
            origin: tree.frame.place(point),
            axes: axes.map(|axis| axis / size),
        };
        // Rays may go a little beside the picture.
        let beside = together.map(|together| BESIDE * together);
        let window = Rect {
            low: beside.map(|beside| -0.5 - beside),
            high: beside.map(|beside| 0.5 + beside),
        };
        LightBuffer::new(tree, (&view, Some(window)), rods, Some(together))
    }

    fn new(
        tree: &Bvh,
        (view, window): (&Projection, Option<Rect>),
        rods: impl Fn(u32) -> Option<BoundingCylinder>,
        together: Option<[f64; 2]>,
    ) -> Option<LightBuffer> {
        let is_near = view.origin.abs().max_element() < FARTHEST;
        let is_fit = view.axes.iter().all(|axis| axis.is_finite());
        if !is_near || !is_fit || !tree.frame.scale().is_normal() {
            return None;
        }
        let axes = view.axes.map(|axis| [axis.x, axis.y, axis.z].map(nearest));
        // Slopes are measured as they will be.
        let view = Projection {
            axes: axes.map(|axis| DVec3::from(axis.map(f64::from))),
            ..*view
        };
        let is_ball = |ball: &Option<BoundingSphere>| ball.is_some_and(|ball| ball.is_filled);
        let mut count = tree.balls.len();
        let are_balls = tree.has_only_spheres();
        if count == 0 {
            tree.each_item(|item, _| count = count.max(item as usize + 1));
        }
        let mut rects = vec![SlopeRange::EMPTY; count];
        let mut known = vec![ItemProxy::NOTHING; count];
        let mut around = Vec::new();
        let mut seen = Rect::EMPTY;
        let reach = (1.0 / (LEAST_COSINE * LEAST_COSINE) - 1.0).sqrt();
        // Takes note of an item that is seen there; says whether it is.
        let mut note = |item: u32, extent: ViewExtent| {
            match (extent, &window) {
                (ViewExtent::Nowhere, Some(_)) => return false,
                (ViewExtent::Within(rect), Some(window)) => match rect.shared(window) {
                    Some(rect) => rects[item as usize] = rect.narrow(),
                    None => return false,
                },
                (ViewExtent::Within(rect), None) if rect.is_within(reach) => {
                    rects[item as usize] = rect.narrow();
                    seen = seen.around(&rect);
                }
                _ => around.push(item),
            }
            true
        };
        let mut forms = Vec::new();
        let (mut slabs, mut seen_rods) = (Vec::new(), Vec::new());
        if are_balls {
            tree.some_balls(1, |item, ball| {
                let ball = ball.seen_from(view.origin);
                if note(item, view.rect_of_ball(&ball)) {
                    known[item as usize] = ItemProxy::new(ball);
                }
            });
        } else {
            let is_mixed = tree.balls.iter().any(is_ball)
                || (0..).take(count).any(|item: u32| rods(item).is_some());
            if is_mixed {
                forms.resize(count, ItemBounds::BALL);
            } else {
                slabs.resize(count, ViewBox::NOTHING);
            }
            tree.each_item(|item, cell| {
                let ball = tree.balls.get(item as usize).copied().flatten();
                let from_here = ball.map(|ball| ball.seen_from(view.origin));
                let is_filled = is_ball(&ball);
                if !note(item, view.rect((from_here, is_filled), &cell)) {
                    return;
                }
                let around_it = || BoundingSphere::around(&cell).seen_from(view.origin);
                known[item as usize] = ItemProxy::new(from_here.unwrap_or_else(around_it));
                if is_filled {
                    return;
                }
                let slab = ViewBox::new(&cell, view.origin);
                let Some(form) = forms.get_mut(item as usize) else {
                    slabs[item as usize] = slab;
                    return;
                };
                form.slab = number_of_next(&slabs);
                slabs.push(slab);
                let rod =
                    rods(item).and_then(|rod| ViewedCylinder::new(rod, &tree.frame, view.origin));
                if let Some(rod) = rod {
                    form.rod = number_of_next(&seen_rods);
                    seen_rods.push(rod);
                }
            });
        }
        if around.len() > MOST_AROUND {
            return None;
        }
        let window = window.unwrap_or(seen);
        let raster = CellGrid::new(rects, |item| known[item].near, window, together)?;
        if !view.is_sharp(&window, &raster.grid) {
            return None;
        }
        for known in &mut known {
            known.near = raster.rounded(known.near);
        }
        for &item in &around {
            known[item as usize].near = 0.0;
        }
        Some(LightBuffer {
            frame: tree.frame,
            origin: view.origin,
            axes,
            raster,
            around,
            known,
            forms,
            slabs,
            rods: seen_rods,
        })
    }

    /// Whether nothing is seen between these slopes.
    #[must_use]
    pub fn is_empty(&self, low: [f64; 2], high: [f64; 2]) -> bool {
        self.around.is_empty() && self.raster.is_empty(&Rect { low, high })
    }

    /// What more is known of an item than its ball.
    #[inline(always)]
    pub(super) fn form(&self, item: u32) -> ItemBounds {
        match self.forms.get(item as usize) {
            Some(form) => *form,
            None if self.slabs.is_empty() => ItemBounds::BALL,
            None => ItemBounds {
                slab: item,
                rod: NONE,
            },
        }
    }

    /// The memory it takes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of::<Self>()
            + self.raster.bytes()
            + self.around.capacity() * size_of::<u32>()
            + self.known.capacity() * size_of::<ItemProxy>()
            + self.forms.capacity() * size_of::<ItemBounds>()
            + self.slabs.capacity() * size_of::<ViewBox>()
            + self.rods.capacity() * size_of::<ViewedCylinder>()
    }
}

/// The number of what comes next in a list; [`NONE`] if that is too large.
fn number_of_next<T>(list: &[T]) -> u32 {
    u32::try_from(list.len()).unwrap_or(NONE)
}
