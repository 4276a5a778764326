//! The grid of a [`crate::base::accel::LightBuffer`]: for each cell the items that may be visible in it, sorted by
//! distance.

use crate::base::accel::node::{max_f32, min_f32};
use crate::base::math::rounding::nearest;

/// A rectangle of slopes or of cells.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rect {
    pub(crate) low: [f64; 2],
    pub(crate) high: [f64; 2],
}

/// The slopes that bound an item, stored until the grid is built; their rounding is negligible against [`MARGIN`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct SlopeRange {
    low: [f32; 2],
    high: [f32; 2],
}

/// The range of cells that an item may overlap: the first and the last column, then the first and the last row.
type CellRange = [[u16; 2]; 2];

/// The range of an item out of view.
const NO_CELLS: CellRange = [[u16::MAX, 0]; 2];

/// The cells of a grid, and the items in each.
#[derive(Clone, Debug)]
pub(crate) struct CellGrid {
    pub(crate) grid: Grid,
    /// Start of the items of each cell in `items`, and the end of those of the last cell.
    cell_starts: Vec<u32>,
    items: Vec<u32>,
    /// The smallest distance, and the size of a step of distance.
    min_distance: f32,
    step: f32,
}

/// Size of cells relative to the mean size of items: smaller cells hold fewer items that are not hit, but each item is
/// in more cells.
const CELL_SIZE: f64 = 0.7;
/// Maximum number of cells: this number per item, and a constant.
const CELLS_PER_ITEM: f64 = 4.0;
const EXTRA_CELLS: f64 = 64.0;
/// Maximum number of cells in a row or column.
const MAX_CELLS_PER_SIDE: f64 = 1024.0;
/// Maximum number of entries: this number per item, and a constant.
const ENTRIES_PER_ITEM: usize = 24;
const EXTRA_ENTRIES: usize = 4096;
/// Items are enlarged by this part of a cell, far above the rounding error of the cell of a ray.
const MARGIN: f64 = 1.0 / 16.0;
/// A grid that just covers its items is extended by this part of a cell.
const BORDER: f64 = 2.0 * MARGIN;
/// Number of steps of distance. Items of the same step are in the order of the tree, for the sake of caches.
const DISTANCE_STEPS: usize = 128;
const LAST_STEP: f32 = 127.0;

impl Rect {
    /// The empty rectangle.
    pub(crate) const EMPTY: Rect = Rect {
        low: [f64::INFINITY; 2],
        high: [f64::NEG_INFINITY; 2],
    };

    /// The intersection. It is never reported as empty: where rounding makes the rectangles disagree `low` may exceed
    /// `high`.
    pub(crate) fn intersection(&self, other: &Rect) -> Rect {
        let mut intersection = *self;
        for side in 0..2 {
            intersection.low[side] = self.low[side].max(other.low[side]);
            intersection.high[side] = self.high[side].min(other.high[side]);
        }
        intersection
    }

    /// Clips it to a window; `None` if it is outside.
    pub(crate) fn clipped(&self, window: &Rect) -> Option<Rect> {
        let is_beside = |side: usize| {
            let slack = 1e-3 * (window.high[side] - window.low[side]);
            self.low[side] > window.high[side] + slack || self.high[side] < window.low[side] - slack
        };
        if is_beside(0) || is_beside(1) {
            return None;
        }
        let mut clipped = *self;
        for side in 0..2 {
            // NaN extends to the edge of the window.
            let (low, high) = (window.low[side], window.high[side]);
            clipped.low[side] = self.low[side].max(low).min(high);
            clipped.high[side] = self.high[side].min(high).max(low);
        }
        Some(clipped)
    }

    /// True if no slope exceeds this.
    pub(crate) fn is_within(&self, slope: f64) -> bool {
        let mut slopes = self.low.iter().chain(&self.high);
        slopes.all(|one| one.abs() <= slope)
    }

    /// The bounding rectangle of both.
    pub(crate) fn union(&self, other: &Rect) -> Rect {
        let mut bounds = *self;
        for side in 0..2 {
            bounds.low[side] = self.low[side].min(other.low[side]);
            bounds.high[side] = self.high[side].max(other.high[side]);
        }
        bounds
    }

    /// The same in single precision.
    #[inline(always)]
    pub(crate) fn single(&self) -> SlopeRange {
        SlopeRange {
            low: self.low.map(nearest),
            high: self.high.map(nearest),
        }
    }
}

impl SlopeRange {
    /// The range of an item out of view.
    pub(crate) const EMPTY: SlopeRange = SlopeRange {
        low: [f32::INFINITY; 2],
        high: [f32::NEG_INFINITY; 2],
    };

    #[inline(always)]
    fn is_empty(&self) -> bool {
        self.low[0] == f32::INFINITY
    }

    #[inline(always)]
    fn rect(&self) -> Rect {
        Rect {
            low: self.low.map(f64::from),
            high: self.high.map(f64::from),
        }
    }
}

/// The cells of a window, row by row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    /// The cell of a slope is the integer part of the slope times `rate` plus `start`.
    pub(crate) rate: [f32; 2],
    pub(crate) start: [f32; 2],
    /// Number of columns and rows.
    pub(crate) size: [u32; 2],
}

impl Grid {
    /// The grid over a window with cells of about this size. If `pixel_block` is given cells are multiples of it and
    /// aligned with the edge of the picture.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the number of cells is limited"
    )]
    fn new(window: &Rect, cell: [f64; 2], pixel_block: Option<[f64; 2]>) -> Grid {
        let mut grid = Grid {
            rate: [0.0; 2],
            start: [0.0; 2],
            size: [1; 2],
        };
        for side in 0..2 {
            let (mut low, mut high) = (window.low[side], window.high[side]);
            let wide = (high - low).max(f64::MIN_POSITIVE);
            let mut cell = cell[side].max(wide / MAX_CELLS_PER_SIDE);
            if let Some(pixel_block) = pixel_block {
                let pixel_block = pixel_block[side];
                cell = pixel_block * (cell / pixel_block).round().max(1.0);
                // Cells are aligned with the edge of the picture.
                low = -0.5 - cell * ((-0.5 - low) / cell).ceil();
            } else {
                // A ray just outside of the outermost edge of an item must not be rounded out of the grid.
                low -= BORDER * cell;
                high += BORDER * cell;
            }
            let count = ((high - low) / cell)
                .ceil()
                .clamp(1.0, 2.0 * MAX_CELLS_PER_SIDE);
            grid.rate[side] = nearest(1.0 / cell);
            grid.start[side] = nearest(-low / cell);
            grid.size[side] = count as u32;
        }
        grid
    }

    /// The range of cells that a rectangle may overlap: the first and the last column, then the first and the last row.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "cast to the nearest number of a cell"
    )]
    #[inline(always)]
    fn cells(&self, rect: &Rect) -> [[u32; 2]; 2] {
        // A loop: `map` is not always inlined.
        let mut cells = [[0; 2]; 2];
        for (side, [first, end]) in cells.iter_mut().enumerate() {
            let (rate, start) = (f64::from(self.rate[side]), f64::from(self.start[side]));
            let last = self.size[side] - 1;
            let low = rect.low[side] * rate + start - MARGIN;
            let high = rect.high[side] * rate + start + MARGIN;
            (*first, *end) = ((low as u32).min(last), (high as u32).min(last));
        }
        cells
    }

    /// Calls `visit` with the index of each cell of a range.
    #[inline(always)]
    fn each(&self, [columns, rows]: &CellRange, mut visit: impl FnMut(usize)) {
        for row in rows[0]..=rows[1] {
            for column in columns[0]..=columns[1] {
                visit(usize::from(row) * self.size[0] as usize + usize::from(column));
            }
        }
    }

    /// Computes the range of cells of each item in view; returns the total number of cells.
    fn assign_cells(&self, rects: &[SlopeRange], cell_ranges: &mut [CellRange]) -> usize {
        let mut entries = 0;
        for (rect, cell_range) in rects.iter().zip(cell_ranges) {
            if rect.is_empty() {
                *cell_range = NO_CELLS;
                continue;
            }
            #[allow(clippy::cast_possible_truncation, reason = "a row has few cells")]
            let range = self
                .cells(&rect.rect())
                .map(|ends| ends.map(|end| end as u16));
            *cell_range = range;
            let [columns, rows] = range.map(|[first, last]| usize::from(last - first) + 1);
            entries += columns * rows;
        }
        entries
    }

    fn count(&self) -> usize {
        self.size[0] as usize * self.size[1] as usize
    }
}

impl CellGrid {
    /// Builds the grid over a window from the slopes of each item, empty if it is out of view, and its distance. Cells
    /// are multiples of `pixel_block` if that is given, and large enough for `is_sharp`. `None` if no item is in view, or
    /// no grid is sharp.
    pub(crate) fn new(
        rects: Vec<SlopeRange>,
        near: impl Fn(usize) -> f32,
        window: Rect,
        pixel_block: Option<[f64; 2]>,
        is_sharp: impl Fn(&Grid) -> bool,
    ) -> Option<CellGrid> {
        let mut sum = [0.0; 2];
        let mut seen = 0usize;
        let (mut min_distance, mut max_distance) = (f32::INFINITY, f32::NEG_INFINITY);
        for (item, rect) in rects.iter().enumerate() {
            if rect.is_empty() {
                continue;
            }
            seen += 1;
            for (side, sum) in sum.iter_mut().enumerate() {
                *sum += f64::from(rect.high[side] - rect.low[side]);
            }
            min_distance = min_f32(near(item), min_distance);
            max_distance = max_f32(near(item), max_distance);
        }
        if seen == 0 || !min_distance.is_finite() || !max_distance.is_finite() {
            return None;
        }
        #[allow(clippy::cast_precision_loss, reason = "a mean has few digits")]
        let count_f64 = seen as f64;
        let mut cell = sum.map(|sum| CELL_SIZE * sum / count_f64);
        let mut grid = Grid::new(&window, cell, pixel_block);
        let mut cell_ranges = vec![NO_CELLS; rects.len()];
        loop {
            #[allow(clippy::cast_precision_loss, reason = "a ratio has few digits")]
            let excess = grid.count() as f64 / (CELLS_PER_ITEM * count_f64 + EXTRA_CELLS);
            let is_dense = excess > 1.0;
            let is_single = grid.count() == 1;
            let is_sparse = (is_single || !is_dense) && {
                let entries = grid.assign_cells(&rects, &mut cell_ranges);
                entries <= ENTRIES_PER_ITEM * seen + EXTRA_ENTRIES
            };
            if (is_sparse || is_single) && is_sharp(&grid) {
                break;
            }
            let coarsest = [0, 1].map(|side| 2.0 * (window.high[side] - window.low[side]));
            let is_coarsest = |side: usize| cell[side] >= coarsest[side] || coarsest[side].is_nan();
            if is_single || (is_coarsest(0) && is_coarsest(1)) {
                return None;
            }
            let factor = if is_dense {
                excess.sqrt().max(1.1)
            } else {
                1.5
            };
            for (cell, coarsest) in cell.iter_mut().zip(coarsest) {
                let finest = 0.5 * coarsest / MAX_CELLS_PER_SIDE;
                *cell = (cell.max(finest) * factor).min(coarsest);
            }
            grid = Grid::new(&window, cell, pixel_block);
        }
        drop(rects);
        let mut cell_grid = CellGrid {
            grid,
            cell_starts: Vec::new(),
            items: Vec::new(),
            min_distance,
            step: (max_distance - min_distance) / LAST_STEP,
        };
        cell_grid.fill(&cell_ranges, near);
        Some(cell_grid)
    }

    #[allow(
        clippy::cast_possible_truncation,
        reason = "items and entries are counted in 31 bits"
    )]
    fn fill(&mut self, cell_ranges: &[CellRange], near: impl Fn(usize) -> f32) {
        let grid = self.grid;
        // Counting sort by step of distance.
        let steps: Vec<u8> = (0..cell_ranges.len())
            .map(|item| self.step_of(near(item)) as u8)
            .collect();
        let is_seen = |item: &usize| cell_ranges[*item] != NO_CELLS;
        let mut step_starts = vec![0u32; DISTANCE_STEPS + 1];
        for item in (0..cell_ranges.len()).filter(is_seen) {
            step_starts[usize::from(steps[item]) + 1] += 1;
        }
        for step in 0..DISTANCE_STEPS {
            step_starts[step + 1] += step_starts[step];
        }
        let mut order = vec![0u32; step_starts[DISTANCE_STEPS] as usize];
        for item in (0..cell_ranges.len()).filter(is_seen) {
            let position = &mut step_starts[usize::from(steps[item])];
            order[*position as usize] = item as u32;
            *position += 1;
        }
        // Then the items of each cell, in that order.
        let mut cell_starts = vec![0u32; grid.count() + 2];
        for cell_range in cell_ranges
            .iter()
            .filter(|cell_range| **cell_range != NO_CELLS)
        {
            grid.each(cell_range, |cell| cell_starts[cell + 2] += 1);
        }
        for cell in 1..cell_starts.len() {
            cell_starts[cell] += cell_starts[cell - 1];
        }
        let mut items = vec![0u32; cell_starts[cell_starts.len() - 1] as usize];
        for &item in &order {
            grid.each(&cell_ranges[item as usize], |cell| {
                let at = &mut cell_starts[cell + 1];
                items[*at as usize] = item;
                *at += 1;
            });
        }
        cell_starts.pop();
        self.cell_starts = cell_starts;
        self.items = items;
    }

    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "cast to the nearest number of a step"
    )]
    fn step_of(&self, near: f32) -> usize {
        (((near - self.min_distance) / self.step) as usize).min(DISTANCE_STEPS - 1)
    }

    /// Rounds a distance down so that it never decreases along the items of a cell.
    #[allow(clippy::cast_precision_loss, reason = "steps are few")]
    pub(crate) fn rounded(&self, near: f32) -> f32 {
        near.min(self.min_distance + self.step_of(near) as f32 * self.step)
    }

    /// The items in a cell, the nearest first.
    #[inline(always)]
    pub(crate) fn items(&self, cell: usize) -> &[u32] {
        let (begin, end) = (self.cell_starts[cell], self.cell_starts[cell + 1]);
        &self.items[begin as usize..end as usize]
    }

    /// True if a rectangle is inside of the grid and no cell in it has items.
    pub(crate) fn is_empty(&self, rect: &Rect) -> bool {
        let grid = &self.grid;
        let is_within = |side: usize| {
            let cell =
                |slope: f64| slope * f64::from(grid.rate[side]) + f64::from(grid.start[side]);
            // NaN is not within.
            cell(rect.low[side]) >= MARGIN
                && cell(rect.high[side]) <= f64::from(grid.size[side]) - MARGIN
        };
        if !(is_within(0) && is_within(1)) {
            return false;
        }
        let [columns, rows] = grid.cells(rect);
        (rows[0]..=rows[1]).all(|row| {
            let first = |column: u32| row as usize * grid.size[0] as usize + column as usize;
            self.cell_starts[first(columns[0])] == self.cell_starts[first(columns[1]) + 1]
        })
    }

    /// The memory that it takes on the heap, in bytes.
    pub(crate) fn bytes(&self) -> usize {
        (self.cell_starts.capacity() + self.items.capacity()) * size_of::<u32>()
    }
}
