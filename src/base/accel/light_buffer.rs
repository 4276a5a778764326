//! Light buffers: the items around a point from which many rays start or at which many end, a camera or a light. A grid
//! of cells across the view lists for each cell the items that a ray through it may hit, the nearest first (Haines and
//! Greenberg 1986, "The light buffer: a shadow-testing accelerator").
//!
//! A ray looks up its cell and traverses no tree. Cells and candidate items are determined in single precision and
//! conservatively: more items are visited than are hit, never fewer. So the results are those of the tree, bit for bit.

pub(super) mod grid;
pub(super) mod lookup;
pub(super) mod projection;

use super::Bvh;
use super::bounding_cylinder::{BoundingCylinder, ViewedCylinder};
use super::bounding_sphere::{BoundingSphere, ViewedSphere};
use super::light_buffer::grid::{CellGrid, Rect, SlopeRange};
use super::light_buffer::projection::{Projection, ViewExtent};
use super::node::Frame;
use super::packet::{REL_ERROR, ViewBox};
use crate::base::math::rounding::nearest;
use glam::DVec3;

/// The grid of a camera extends beyond the picture by this many pixel blocks.
const MARGIN_IN_BLOCKS: f64 = 2.0;
/// Minimum cosine between the mean direction from a light to its items and the direction to each; below it a flat grid
/// does not work.
const MIN_COSINE: f64 = 0.4;
/// Maximum number of items around the point or outside of the grid: every ray is tested against them.
const MAX_ALWAYS_TESTED: usize = 8;
/// Number of nodes sampled for the mean direction to the items.
const MAX_SAMPLED_NODES: usize = 1024;

/// The light buffer of a camera or a light.
#[derive(Clone, Debug)]
pub struct LightBuffer {
    /// The frame of the tree, and the point in it.
    pub(super) frame: Frame,
    pub(super) origin: DVec3,
    /// Axes by which slopes are measured. Those across and up are
    /// `axes[0] · dir / axes[2] · dir` and `axes[1] · dir / axes[2] · dir`.
    pub(super) axes: [[f32; 3]; 3],
    pub(super) cell_grid: CellGrid,
    /// The items that are not in the grid, since they are around the point or outside of the grid.
    pub(super) always_tested: Vec<u32>,
    pub(super) proxies: Vec<ItemProxy>,
    /// Indices of the boxes and cylinders of items that are not spheres. Empty if all items are spheres, or if each has
    /// a box and no cylinder.
    item_bounds: Vec<ItemBounds>,
    pub(super) view_boxes: Vec<ViewBox>,
    pub(super) cylinders: Vec<ViewedCylinder>,
}

/// An item as seen from the point.
#[derive(Clone, Copy, Debug)]
pub(super) struct ItemProxy {
    /// The bounding sphere, relative to the point.
    pub(super) centre: [f32; 3],
    pub(super) radius: f32,
    /// A lower bound on its distance.
    pub(super) near: f32,
}

/// The indices of the box and the bounding cylinder of an item; [`NONE`] where the sphere is as tight.
#[derive(Clone, Copy, Debug)]
pub(super) struct ItemBounds {
    pub(super) view_box: u32,
    pub(super) cylinder: u32,
}

pub(super) const NONE: u32 = u32::MAX;

impl ItemBounds {
    const SPHERE_ONLY: ItemBounds = ItemBounds {
        view_box: NONE,
        cylinder: NONE,
    };
}

impl ItemProxy {
    /// An item out of view.
    const EMPTY: ItemProxy = ItemProxy {
        centre: [0.0; 3],
        radius: 0.0,
        near: f32::INFINITY,
    };

    /// The proxy of a bounding sphere, given by its centre, radius and distance.
    #[inline(always)]
    fn new(sphere: ViewedSphere) -> Self {
        let ViewedSphere {
            centre,
            radius,
            distance,
        } = sphere;
        ItemProxy {
            centre: centre.to_array(),
            radius,
            near: (distance * (1.0 - 4.0 * REL_ERROR) - radius).max(0.0),
        }
    }
}

impl LightBuffer {
    /// Builds the light buffer of a light at a point, with all items; `None` where a flat grid does not work because
    /// the items surround the light.
    #[must_use]
    pub fn for_light(
        tree: &Bvh,
        point: DVec3,
        cylinders: impl Fn(u32) -> Option<BoundingCylinder>,
    ) -> Option<LightBuffer> {
        let origin = tree.frame.in_frame(point);
        let mut sum = DVec3::ZERO;
        let step = ((tree.nodes.len() + tree.sphere_leaves.len()) / MAX_SAMPLED_NODES).max(1);
        tree.for_some_items(step, |_, aabb| {
            let (low, high) = aabb.ends();
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
        LightBuffer::new(tree, &view, None, cylinders, None)
    }

    /// Builds the light buffer of a camera at a point: slopes are measured by `axes` and go from -0.5 to 0.5 across and
    /// up the picture. `pixel_block` is the size in slopes of the blocks of pixels that are traced together.
    #[must_use]
    pub fn for_camera(
        tree: &Bvh,
        point: DVec3,
        (axes, pixel_block): ([DVec3; 3], [f64; 2]),
        cylinders: impl Fn(u32) -> Option<BoundingCylinder>,
    ) -> Option<LightBuffer> {
        let size = axes[2].length();
        let view = Projection {
            origin: tree.frame.in_frame(point),
            axes: axes.map(|axis| axis / size),
        };
        // Rays may pass slightly outside of the picture.
        let margin = pixel_block.map(|pixel_block| MARGIN_IN_BLOCKS * pixel_block);
        let window = Rect {
            low: margin.map(|margin| -0.5 - margin),
            high: margin.map(|margin| 0.5 + margin),
        };
        LightBuffer::new(tree, &view, Some(window), cylinders, Some(pixel_block))
    }

    fn new(
        tree: &Bvh,
        view: &Projection,
        window: Option<Rect>,
        cylinders: impl Fn(u32) -> Option<BoundingCylinder>,
        pixel_block: Option<[f64; 2]>,
    ) -> Option<LightBuffer> {
        let are_finite = view.axes.iter().all(|axis| axis.is_finite());
        if !view.origin.is_finite() || !are_finite || !tree.frame.scale().is_normal() {
            return None;
        }
        let axes = view.axes.map(|axis| [axis.x, axis.y, axis.z].map(nearest));
        // Slopes are measured with the same rounded axes as in lookups.
        let view = Projection {
            axes: axes.map(|axis| DVec3::from(axis.map(f64::from))),
            ..*view
        };
        let is_sphere =
            |sphere: &Option<BoundingSphere>| sphere.is_some_and(|sphere| sphere.is_filled);
        let mut count = tree.bounding_spheres.len();
        let are_spheres = tree.has_only_spheres();
        if count == 0 {
            tree.for_each_item(|item, _| count = count.max(item as usize + 1));
        }
        let mut rects = vec![SlopeRange::EMPTY; count];
        let mut proxies = vec![ItemProxy::EMPTY; count];
        let mut always_tested = Vec::new();
        let mut seen = Rect::EMPTY;
        let reach = (1.0 / (MIN_COSINE * MIN_COSINE) - 1.0).sqrt();
        // Adds an item with this extent; returns whether it is in view.
        let mut add_item = |item: u32, extent: ViewExtent| {
            match (extent, &window) {
                (ViewExtent::Nowhere, Some(_)) => return false,
                (ViewExtent::Within(rect), Some(window)) => match rect.clipped(window) {
                    Some(rect) => rects[item as usize] = rect.single(),
                    None => return false,
                },
                (ViewExtent::Within(rect), None) if rect.is_within(reach) => {
                    rects[item as usize] = rect.single();
                    seen = seen.union(&rect);
                }
                _ => always_tested.push(item),
            }
            true
        };
        let mut item_bounds = Vec::new();
        let (mut view_boxes, mut viewed_cylinders) = (Vec::new(), Vec::new());
        if are_spheres {
            tree.for_some_spheres(1, |item, sphere| {
                let sphere = sphere.viewed_from(view.origin);
                if add_item(item, view.rect_of_sphere(&sphere)) {
                    proxies[item as usize] = ItemProxy::new(sphere);
                }
            });
        } else {
            let is_mixed = tree.bounding_spheres.iter().any(is_sphere)
                || (0..).take(count).any(|item: u32| cylinders(item).is_some());
            if is_mixed {
                item_bounds.resize(count, ItemBounds::SPHERE_ONLY);
            } else {
                view_boxes.resize(count, ViewBox::EMPTY);
            }
            tree.for_each_item(|item, aabb| {
                let sphere = tree.bounding_spheres.get(item as usize).copied().flatten();
                let viewed_sphere = sphere.map(|sphere| sphere.viewed_from(view.origin));
                let is_filled = is_sphere(&sphere);
                if !add_item(item, view.rect(viewed_sphere, is_filled, &aabb)) {
                    return;
                }
                let sphere_of_box = || BoundingSphere::around(&aabb).viewed_from(view.origin);
                proxies[item as usize] =
                    ItemProxy::new(viewed_sphere.unwrap_or_else(sphere_of_box));
                if is_filled {
                    return;
                }
                let view_box = ViewBox::new(&aabb, view.origin);
                let Some(bounds) = item_bounds.get_mut(item as usize) else {
                    view_boxes[item as usize] = view_box;
                    return;
                };
                bounds.view_box = next_index(&view_boxes);
                view_boxes.push(view_box);
                let cylinder = cylinders(item)
                    .and_then(|cylinder| ViewedCylinder::new(cylinder, &tree.frame, view.origin));
                if let Some(cylinder) = cylinder {
                    bounds.cylinder = next_index(&viewed_cylinders);
                    viewed_cylinders.push(cylinder);
                }
            });
        }
        if always_tested.len() > MAX_ALWAYS_TESTED {
            return None;
        }
        let window = window.unwrap_or(seen);
        let cell_grid = CellGrid::new(
            rects,
            |item| proxies[item].near,
            window,
            pixel_block,
            |grid| view.is_sharp(&window, grid),
        )?;
        for proxy in &mut proxies {
            proxy.near = cell_grid.rounded(proxy.near);
        }
        for &item in &always_tested {
            proxies[item as usize].near = 0.0;
        }
        Some(LightBuffer {
            frame: tree.frame,
            origin: view.origin,
            axes,
            cell_grid,
            always_tested,
            proxies,
            item_bounds,
            view_boxes,
            cylinders: viewed_cylinders,
        })
    }

    /// True if no item is in view between these slopes.
    #[must_use]
    pub fn is_empty(&self, low: [f64; 2], high: [f64; 2]) -> bool {
        self.always_tested.is_empty() && self.cell_grid.is_empty(&Rect { low, high })
    }

    /// The indices of the box and the cylinder of an item.
    #[inline(always)]
    pub(super) fn bounds_of(&self, item: u32) -> ItemBounds {
        match self.item_bounds.get(item as usize) {
            Some(bounds) => *bounds,
            None if self.view_boxes.is_empty() => ItemBounds::SPHERE_ONLY,
            None => ItemBounds {
                view_box: item,
                cylinder: NONE,
            },
        }
    }

    /// The memory that it takes, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of::<Self>()
            + self.cell_grid.bytes()
            + self.always_tested.capacity() * size_of::<u32>()
            + self.proxies.capacity() * size_of::<ItemProxy>()
            + self.item_bounds.capacity() * size_of::<ItemBounds>()
            + self.view_boxes.capacity() * size_of::<ViewBox>()
            + self.cylinders.capacity() * size_of::<ViewedCylinder>()
    }
}

/// The index of the next element of a list; [`NONE`] if that is too large.
fn next_index<T>(list: &[T]) -> u32 {
    u32::try_from(list.len()).unwrap_or(NONE)
}
