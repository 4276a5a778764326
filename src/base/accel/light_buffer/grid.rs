//! The grid of a [`crate::base::accel::LightBuffer`]: which items each cell may show, in the order of their distance.

use crate::base::accel::node::{larger, smaller};
use crate::base::math::rounding::nearest;

/// Slopes, or cells, between which something lies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rect {
    pub(crate) low: [f64; 2],
    pub(crate) high: [f64; 2],
}

/// The slopes between which an item lies, kept until the grid is made: their rounding is nothing against [`MARGIN`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct SlopeRange {
    low: [f32; 2],
    high: [f32; 2],
}

/// The cells that an item may share something with: the first and the last column, then rows.
type CellRange = [[u16; 2]; 2];

/// Of an item that is not seen.
const NO_CELLS: CellRange = [[u16::MAX, 0]; 2];

/// Cells of a grid, and the items in each.
#[derive(Clone, Debug)]
pub(crate) struct CellGrid {
    pub(crate) grid: Grid,
    /// Where the items of each cell begin, and at last where those of the last end.
    begins: Vec<u32>,
    items: Vec<u32>,
    /// The nearest of all distances, and how much farther each step is.
    least: f32,
    step: f32,
}

/// Cells are so much of the mean width of an item: smaller ones hold fewer items that are not met, but each item is in more.
const FINENESS: f64 = 0.7;
/// No more cells than this for each item, and some.
const CELLS_OF_ITEM: f64 = 4.0;
const SOME_CELLS: f64 = 64.0;
/// No more cells than this in a row or column.
const LONGEST: f64 = 1024.0;
/// No more entries than this for each item, and some.
const ENTRIES_OF_ITEM: usize = 24;
const SOME_ENTRIES: usize = 4096;
/// Items count as so much of a cell larger than they are, far above the rounding of a ray's cell.
const MARGIN: f64 = 1.0 / 16.0;
/// A grid over no more than its items goes on for so much of a cell.
const EDGE: f64 = 2.0 * MARGIN;
/// Distances are told apart in so many steps. Items of one step come in the order of the tree, which is kind to caches.
const STEPS: usize = 128;
const LAST_STEP: f32 = 127.0;

impl Rect {
    /// Nothing.
    pub(crate) const EMPTY: Rect = Rect {
        low: [f64::INFINITY; 2],
        high: [f64::NEG_INFINITY; 2],
    };

    /// What lies in both, by way of which nothing may be lost if neither is exact.
    pub(crate) fn both(&self, other: &Rect) -> Rect {
        let mut both = *self;
        for side in 0..2 {
            both.low[side] = self.low[side].max(other.low[side]);
            both.high[side] = self.high[side].min(other.high[side]);
        }
        both
    }

    /// The part in a window; `None` beside it.
    pub(crate) fn shared(&self, window: &Rect) -> Option<Rect> {
        let is_beside = |side: usize| {
            let slack = 1e-3 * (window.high[side] - window.low[side]);
            self.low[side] > window.high[side] + slack || self.high[side] < window.low[side] - slack
        };
        if is_beside(0) || is_beside(1) {
            return None;
        }
        let mut shared = *self;
        for side in 0..2 {
            // What is not a number reaches as far as the window.
            let (low, high) = (window.low[side], window.high[side]);
            shared.low[side] = self.low[side].max(low).min(high);
            shared.high[side] = self.high[side].min(high).max(low);
        }
        Some(shared)
    }

    /// Whether no slope is larger than this.
    pub(crate) fn is_within(&self, slope: f64) -> bool {
        let mut slopes = self.low.iter().chain(&self.high);
        slopes.all(|one| one.abs() <= slope)
    }

    /// The rectangle around both.
    pub(crate) fn around(&self, other: &Rect) -> Rect {
        let mut around = *self;
        for side in 0..2 {
            around.low[side] = self.low[side].min(other.low[side]);
            around.high[side] = self.high[side].max(other.high[side]);
        }
        around
    }

    /// The same in few bytes.
    #[inline(always)]
    pub(crate) fn narrow(&self) -> SlopeRange {
        SlopeRange {
            low: self.low.map(nearest),
            high: self.high.map(nearest),
        }
    }
}

impl SlopeRange {
    /// Of an item that is not seen.
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
    /// The cell of a slope: its whole part when times `rate` plus `start`.
    pub(crate) rate: [f32; 2],
    pub(crate) start: [f32; 2],
    /// How many columns and rows there are.
    pub(crate) size: [u32; 2],
}

impl Grid {
    /// Over a window, for items of such mean widths; cells are multiples of `together`, if that is given, which begin at
    /// the middle.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the number of cells is limited"
    )]
    fn new(window: &Rect, cell: [f64; 2], together: Option<[f64; 2]>) -> Grid {
        let mut grid = Grid {
            rate: [0.0; 2],
            start: [0.0; 2],
            size: [1; 2],
        };
        for side in 0..2 {
            let (mut low, mut high) = (window.low[side], window.high[side]);
            let wide = (high - low).max(f64::MIN_POSITIVE);
            let mut cell = cell[side].max(wide / LONGEST);
            if let Some(together) = together {
                let together = together[side];
                cell = together * (cell / together).round().max(1.0);
                // The edges of cells lie where the picture begins.
                low = -0.5 - cell * ((-0.5 - low) / cell).ceil();
            } else {
                // A ray past the outermost edge of an item must not be rounded out of the grid.
                low -= EDGE * cell;
                high += EDGE * cell;
            }
            let count = ((high - low) / cell).ceil().clamp(1.0, 2.0 * LONGEST);
            grid.rate[side] = nearest(1.0 / cell);
            grid.start[side] = nearest(-low / cell);
            grid.size[side] = count as u32;
        }
        grid
    }

    /// The cells that a rectangle may share something with: from the first to the last, in columns and in rows.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "cast to the nearest number of a cell"
    )]
    #[inline(always)]
    fn cells(&self, rect: &Rect) -> [[u32; 2]; 2] {
        [0, 1].map(|side| {
            let (rate, start) = (f64::from(self.rate[side]), f64::from(self.start[side]));
            let last = self.size[side] - 1;
            let low = rect.low[side] * rate + start - MARGIN;
            let high = rect.high[side] * rate + start + MARGIN;
            [low, high].map(|at| (at as u32).min(last))
        })
    }

    /// Calls `visit` with the number of each cell of a span.
    #[inline(always)]
    fn each(&self, [columns, rows]: &CellRange, mut visit: impl FnMut(usize)) {
        for row in rows[0]..=rows[1] {
            for column in columns[0]..=columns[1] {
                visit(usize::from(row) * self.size[0] as usize + usize::from(column));
            }
        }
    }

    /// Finds the cells of items that are seen; says how many they are together.
    fn find(&self, rects: &[SlopeRange], spans: &mut [CellRange]) -> usize {
        let mut entries = 0;
        for (rect, span) in rects.iter().zip(spans) {
            if rect.is_empty() {
                *span = NO_CELLS;
                continue;
            }
            #[allow(clippy::cast_possible_truncation, reason = "a row has few cells")]
            let cells = self
                .cells(&rect.rect())
                .map(|ends| ends.map(|end| end as u16));
            *span = cells;
            let [columns, rows] = cells.map(|[first, last]| usize::from(last - first) + 1);
            entries += columns * rows;
        }
        entries
    }

    fn count(&self) -> usize {
        self.size[0] as usize * self.size[1] as usize
    }
}

impl CellGrid {
    /// The grid over a window that items are seen in, each in a rectangle, an empty one if it is not seen, and at a
    /// distance. Cells are multiples of `together` if that is given. `None` if none is seen.
    pub(crate) fn new(
        rects: Vec<SlopeRange>,
        near: impl Fn(usize) -> f32,
        window: Rect,
        together: Option<[f64; 2]>,
    ) -> Option<CellGrid> {
        let mut sum = [0.0; 2];
        let mut seen = 0usize;
        let (mut least, mut most) = (f32::INFINITY, f32::NEG_INFINITY);
        for (item, rect) in rects.iter().enumerate() {
            if rect.is_empty() {
                continue;
            }
            seen += 1;
            for (side, sum) in sum.iter_mut().enumerate() {
                *sum += f64::from(rect.high[side] - rect.low[side]);
            }
            least = smaller(near(item), least);
            most = larger(near(item), most);
        }
        if seen == 0 || !least.is_finite() || !most.is_finite() {
            return None;
        }
        #[allow(clippy::cast_precision_loss, reason = "a mean has few digits")]
        let number = seen as f64;
        let mut cell = sum.map(|sum| FINENESS * sum / number);
        let mut grid = Grid::new(&window, cell, together);
        let mut spans = vec![NO_CELLS; rects.len()];
        loop {
            #[allow(clippy::cast_precision_loss, reason = "a ratio has few digits")]
            let excess = grid.count() as f64 / (CELLS_OF_ITEM * number + SOME_CELLS);
            let is_dense = excess > 1.0;
            let is_single = grid.count() == 1;
            let is_sparse = (is_single || !is_dense) && {
                let entries = grid.find(&rects, &mut spans);
                entries <= ENTRIES_OF_ITEM * seen + SOME_ENTRIES
            };
            if is_sparse || is_single {
                break;
            }
            let factor = if is_dense {
                excess.sqrt().max(1.1)
            } else {
                1.5
            };
            for (side, cell) in cell.iter_mut().enumerate() {
                let wide = window.high[side] - window.low[side];
                *cell = (cell.max(wide / LONGEST) * factor).min(2.0 * wide);
            }
            grid = Grid::new(&window, cell, together);
        }
        drop(rects);
        let mut raster = CellGrid {
            grid,
            begins: Vec::new(),
            items: Vec::new(),
            least,
            step: (most - least) / LAST_STEP,
        };
        raster.fill(&spans, near);
        Some(raster)
    }

    #[allow(
        clippy::cast_possible_truncation,
        reason = "items and entries are counted in 31 bits"
    )]
    fn fill(&mut self, spans: &[CellRange], near: impl Fn(usize) -> f32) {
        let grid = self.grid;
        // By distance, coarsely: counting sort.
        let steps: Vec<u8> = (0..spans.len())
            .map(|item| self.step_of(near(item)) as u8)
            .collect();
        let is_seen = |item: &usize| spans[*item] != NO_CELLS;
        let mut places = vec![0u32; STEPS + 1];
        for item in (0..spans.len()).filter(is_seen) {
            places[usize::from(steps[item]) + 1] += 1;
        }
        for step in 0..STEPS {
            places[step + 1] += places[step];
        }
        let mut order = vec![0u32; places[STEPS] as usize];
        for item in (0..spans.len()).filter(is_seen) {
            let place = &mut places[usize::from(steps[item])];
            order[*place as usize] = item as u32;
            *place += 1;
        }
        // Then into the cells, in that order.
        let mut begins = vec![0u32; grid.count() + 2];
        for span in spans.iter().filter(|span| **span != NO_CELLS) {
            grid.each(span, |cell| begins[cell + 2] += 1);
        }
        for cell in 1..begins.len() {
            begins[cell] += begins[cell - 1];
        }
        let mut items = vec![0u32; begins[begins.len() - 1] as usize];
        for &item in &order {
            grid.each(&spans[item as usize], |cell| {
                let at = &mut begins[cell + 1];
                items[*at as usize] = item;
                *at += 1;
            });
        }
        begins.pop();
        self.begins = begins;
        self.items = items;
    }

    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "cast to the nearest number of a step"
    )]
    fn step_of(&self, near: f32) -> usize {
        (((near - self.least) / self.step) as usize).min(STEPS - 1)
    }

    /// A distance rounded down so that in each cell the items stand in its order.
    #[allow(clippy::cast_precision_loss, reason = "steps are few")]
    pub(crate) fn rounded(&self, near: f32) -> f32 {
        near.min(self.least + self.step_of(near) as f32 * self.step)
    }

    /// The items in a cell, the nearest first.
    #[inline(always)]
    pub(crate) fn items(&self, cell: usize) -> &[u32] {
        let (begin, end) = (self.begins[cell], self.begins[cell + 1]);
        &self.items[begin as usize..end as usize]
    }

    /// Whether there are no items in any of the cells of a rectangle, all of which are there.
    pub(crate) fn is_empty(&self, rect: &Rect) -> bool {
        let grid = &self.grid;
        let is_within = |side: usize| {
            let cell =
                |slope: f64| slope * f64::from(grid.rate[side]) + f64::from(grid.start[side]);
            // Not a number is not within.
            cell(rect.low[side]) >= MARGIN
                && cell(rect.high[side]) <= f64::from(grid.size[side]) - MARGIN
        };
        if !(is_within(0) && is_within(1)) {
            return false;
        }
        let [columns, rows] = grid.cells(rect);
        (rows[0]..=rows[1]).all(|row| {
            let first = |column: u32| row as usize * grid.size[0] as usize + column as usize;
            self.begins[first(columns[0])] == self.begins[first(columns[1]) + 1]
        })
    }

    /// The memory it takes beyond itself.
    pub(crate) fn bytes(&self) -> usize {
        (self.begins.capacity() + self.items.capacity()) * size_of::<u32>()
    }
}
