//! This module holds an index over the boxes of steps, which finds the earlier steps near a place.
//!
//! Every step is in one cell: the cell of its box's middle, in a grid for boxes up to a size. So no step is
//! found twice, and a search looks half that size further than its own box. Within a cell steps stand in the
//! order of time, and every run of them knows its lowest z, so runs that are wholly above a place are passed
//! over.

use nalgebra::Vector3;

/// A box between its lowest and its highest corner.
pub(super) type StepBounds = [Vector3<f64>; 2];

/// The number of steps in a run.
const RUN: usize = 32;
/// The number of grids; the largest boxes are in the last one.
const LEVELS: usize = 12;
/// The largest number of cells of a grid along one side.
const MOST_CELLS: f64 = 256.0;
/// The number of cells across the largest box of a grid.
const CELLS_OF_A_BOX: f64 = 4.0;

/// One grid of cells of a size.
#[derive(Debug, Clone)]
struct CellLevel {
    /// The largest box.
    size: f64,
    /// The size of a cell.
    cell: f64,
    columns: usize,
    rows: usize,
    cells: Vec<Vec<BoxedStep>>,
    chunks: Vec<Vec<StepChunk>>,
    is_used: bool,
}

/// What is known of some steps of a cell together.
#[derive(Debug, Clone, Copy)]
struct StepChunk {
    /// The lowest z.
    lowest: f64,
    /// All are replaced by steps up to this one.
    replaced: u32,
}

/// A step with its box.
#[derive(Debug, Clone, Copy)]
struct BoxedStep {
    step: u32,
    /// The number of the step, or of the first one of a run.
    first: u32,
    /// The step from which on this one adds nothing.
    replaced: u32,
    bounds: StepBounds,
}

/// The index.
#[derive(Debug, Clone)]
pub(super) struct StepIndex {
    bounds: StepBounds,
    levels: Vec<CellLevel>,
}

impl StepIndex {
    /// Makes an index for the surroundings of the stock; steps outside of them are not kept. `smallest` is
    /// the size of the smallest steps' boxes, mm.
    pub(super) fn new(bounds: StepBounds, smallest: f64) -> Self {
        let extent = bounds[1] - bounds[0];
        let floor = extent.x.max(extent.y) / MOST_CELLS * CELLS_OF_A_BOX;
        let first = smallest.max(floor).max(1e-3);
        let levels = (0..LEVELS).map(|level| {
            let size = first * f64::from(1_u32 << level);
            let cell = size / CELLS_OF_A_BOX;
            let count = |length: f64| ((length / cell).ceil().max(1.0)) as usize;
            let (columns, rows) = (count(extent.x), count(extent.y));
            let cells = vec![Vec::new(); columns * rows];
            let chunks = vec![Vec::new(); columns * rows];
            CellLevel { size, cell, columns, rows, cells, chunks, is_used: false }
        });
        Self { bounds, levels: levels.collect() }
    }

    /// Adds a step, or a run of steps that begins with `first`, later than all before, and from which step on it adds
    /// nothing. A step outside the stock's surroundings is left out.
    pub(super) fn add(&mut self, step: u32, first: u32, bounds: StepBounds, replaced: u32) {
        let Some((clipped, number, at)) = self.place_of(&bounds) else { return };
        let Some(level) = self.levels.get_mut(number) else { return };
        level.is_used = true;
        if let (Some(cell), Some(chunks)) = (level.cells.get_mut(at), level.chunks.get_mut(at)) {
            if cell.len() % RUN == 0 {
                chunks.push(StepChunk { lowest: f64::INFINITY, replaced: 0 });
            }
            cell.push(BoxedStep { step, first, replaced, bounds: clipped });
            if let Some(chunk) = chunks.last_mut() {
                chunk.lowest = chunk.lowest.min(clipped[0].z);
                chunk.replaced = chunk.replaced.max(replaced);
            }
        }
    }

    /// Notes from which step on the step or run that begins with `first` and has these bounds adds nothing.
    pub(super) fn replace(&mut self, first: u32, bounds: &StepBounds, by: u32) {
        let Some((_, number, at)) = self.place_of(bounds) else { return };
        let Some(level) = self.levels.get_mut(number) else { return };
        let (Some(cell), Some(chunks)) = (level.cells.get_mut(at), level.chunks.get_mut(at)) else { return };
        let place = cell.partition_point(|boxed| boxed.first < first);
        if let Some(boxed) = cell.get_mut(place).filter(|boxed| boxed.first == first) {
            boxed.replaced = by;
        }
        let begin = place / RUN * RUN;
        let members = cell.get(begin..(begin + RUN).min(cell.len())).unwrap_or_default();
        if let Some(chunk) = chunks.get_mut(place / RUN) {
            chunk.replaced = members.iter().map(|boxed| boxed.replaced).max().unwrap_or(0);
        }
    }

    /// Returns the part of a box within the surroundings, the grid that it belongs to and its cell there.
    fn place_of(&self, bounds: &StepBounds) -> Option<(StepBounds, usize, usize)> {
        let clipped = [bounds[0].sup(&self.bounds[0]), bounds[1].inf(&self.bounds[1])];
        if (clipped[1] - clipped[0]).min() < 0.0 {
            return None;
        }
        let size = (clipped[1].xy() - clipped[0].xy()).max();
        let last = self.levels.len().saturating_sub(1);
        let number = self.levels.iter().position(|level| level.size >= size).unwrap_or(last);
        let level = self.levels.get(number)?;
        let middle = (clipped[0] + clipped[1]) / 2.0 - self.bounds[0];
        let column = ((middle.x / level.cell) as usize).min(level.columns - 1);
        let row = ((middle.y / level.cell) as usize).min(level.rows - 1);
        Some((clipped, number, row * level.columns + column))
    }

    /// Adds the steps before `before`, and the runs that begin before it, whose boxes meet a box, the latest of
    /// each cell first. What adds nothing to a step before `own` is passed over.
    pub(super) fn find(&self, bounds: &StepBounds, times: [u32; 2], out: &mut Vec<u32>) {
        let clipped = [bounds[0].sup(&self.bounds[0]), bounds[1].inf(&self.bounds[1])];
        if (clipped[1] - clipped[0]).min() < 0.0 {
            return;
        }
        for (number, level) in self.levels.iter().enumerate().filter(|(_, level)| level.is_used) {
            // A box is at most the level's size, except in the last grid, so its middle is at most half of
            // that away.
            let reach = if number + 1 == self.levels.len() { f64::INFINITY } else { level.size / 2.0 };
            let index = |at: f64, count: usize| (at / level.cell).clamp(0.0, (count - 1) as f64) as usize;
            let [low, high] = [clipped[0] - self.bounds[0], clipped[1] - self.bounds[0]];
            let columns = index(low.x - reach, level.columns)..=index(high.x + reach, level.columns);
            for row in index(low.y - reach, level.rows)..=index(high.y + reach, level.rows) {
                for column in columns.clone() {
                    let at = row * level.columns + column;
                    if let (Some(cell), Some(chunks)) = (level.cells.get(at), level.chunks.get(at)) {
                        find_in_cell(cell, chunks, &clipped, times, out);
                    }
                }
            }
        }
    }
}

fn find_in_cell(
    cell: &[BoxedStep],
    chunks: &[StepChunk],
    bounds: &StepBounds,
    [before, own]: [u32; 2],
    out: &mut Vec<u32>,
) {
    let earlier = cell.partition_point(|boxed| boxed.first < before);
    let Some(cell) = cell.get(..earlier) else { return };
    let [low, high] = bounds;
    for (run, chunk) in cell.chunks(RUN).zip(chunks).rev() {
        if chunk.lowest > high.z || chunk.replaced < own {
            continue;
        }
        for boxed in run.iter().rev().filter(|boxed| boxed.replaced >= own) {
            let [from, to] = &boxed.bounds;
            let apart = from.x > high.x
                || to.x < low.x
                || from.y > high.y
                || to.y < low.y
                || from.z > high.z
                || to.z < low.z;
            if !apart {
                out.push(boxed.step);
            }
        }
    }
}
