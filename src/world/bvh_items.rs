//! The BVH over the items of a model.

use super::model::Item;
use crate::base::accel::Bvh;
use glam::DVec3;

/// An item with its index in file order.
#[derive(Clone, Copy, Debug)]
pub(super) struct IndexedItem {
    pub(super) number: u32,
    pub(super) item: Item,
}

/// The items of a model and the BVH over them.
#[derive(Debug)]
pub(super) struct ItemBvh {
    /// BVH over `bounded`.
    pub(super) tree: Bvh,
    /// In BVH order.
    pub(super) bounded: Vec<IndexedItem>,
    /// Items without a finite box.
    pub(super) unbounded: Vec<IndexedItem>,
}

impl ItemBvh {
    /// The items whose boxes contain a point.
    pub(super) fn around(&self, point: DVec3) -> Vec<IndexedItem> {
        let mut items = self.unbounded.clone();
        self.tree.around(point, |position| {
            items.push(self.bounded[position as usize]);
            false
        });
        items
    }
}
