//! This module keeps what the stock looks like at steps of a run, for drawings that follow a slider.

use super::stock_height_field::HeightFieldLayout;
use crate::simulation_run::StockObserver;
use crate::stock::Dexels;
use std::cell::Cell;

/// The number of steps at which the stock is kept while it is cut, at equal distances along the path.
const STEPS: usize = 24;

/// The stock after some motions.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::report) struct StockState {
    /// The number of motions that are done; first points are not counted.
    pub motions: usize,
    /// The highest material of each cell above the base, mm, row by row. It is NaN if the cell has no material.
    pub heights: Vec<f32>,
}

/// The stock at steps of a run: before the first motion, on the way, and after the last one.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::report) struct StockStates {
    /// The grid of the heights.
    pub layout: HeightFieldLayout,
    /// The states in order.
    pub states: Vec<StockState>,
}

/// Keeps the states while a program is simulated.
pub(super) struct StockStateKeeper<'c> {
    /// The number of motions so far, which the receiver of motions counts.
    motions: &'c Cell<usize>,
    states: Option<StockStates>,
}

impl<'c> StockStateKeeper<'c> {
    pub(super) fn new(motions: &'c Cell<usize>) -> Self {
        Self { motions, states: None }
    }

    /// Returns the states, with the stock that is left as the last one.
    pub(super) fn into_states(mut self, left: &Dexels) -> Option<StockStates> {
        self.observe_stock(left);
        self.states
    }
}

impl StockObserver for StockStateKeeper<'_> {
    fn wants_stock_at(&self, path_fraction: f64) -> bool {
        let kept = self.states.as_ref().map_or(0, |states| states.states.len());
        kept < STEPS && path_fraction * STEPS as f64 >= kept as f64
    }

    fn observe_stock(&mut self, stock: &Dexels) {
        let empty = || StockStates { layout: HeightFieldLayout::of_grid(stock.grid()), states: Vec::new() };
        let kept = self.states.get_or_insert_with(empty);
        let motions = self.motions.get();
        // Two places with the same motions before them have the same stock.
        if kept.states.last().is_none_or(|last| last.motions < motions) {
            let heights = kept.layout.highest_material(stock);
            kept.states.push(StockState { motions, heights });
        }
    }
}
