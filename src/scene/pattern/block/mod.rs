//! Patterns that tile space with blocks of one value each.

pub(super) mod brick;
pub(super) mod cells;
pub(super) mod checker;
pub(super) mod hexagon;
pub(super) mod square;
pub(super) mod tiling;
pub(super) mod triangular;
