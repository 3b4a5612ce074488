//! This module chooses the few figures that a reader sees first, printed as the tables print them.

use super::figure_columns::{figure_columns, headline_time_key};
use super::{Comparison, ComparisonFigures};
use crate::report::table::{Column, TableLooks, pick_columns, print_change};

/// A figure before and after, as text.
#[derive(Debug, Clone, PartialEq)]
pub struct HeadlineFigure {
    /// What it is, with its unit.
    pub title: String,
    /// The value of the current program.
    pub now: String,
    /// The value of the program before; empty without one, or where it is not known.
    pub was: String,
    /// The change in percent; empty where there is none.
    pub change: String,
}

/// The keys of the figures after the time, in this order, as far as they are known.
const SHOWN: [&str; 6] = ["chip_thickness", "chip_thickness_bound", "feed", "force", "power", "removal_rate"];

/// The most figures that are shown.
const MOST: usize = 5;

/// Returns the figures that a reader sees first: the time, the thickest chip, the feed, the largest loads.
pub(in crate::report) fn choose_headlines(comparison: &Comparison<'_>) -> Vec<HeadlineFigure> {
    let keys = [[headline_time_key(&comparison.whole)].as_slice(), &SHOWN].concat();
    let looks = TableLooks::markup(comparison.units());
    let before = comparison.whole.before.as_ref();
    let Some(after) = comparison.whole.after.as_ref() else { return Vec::new() };
    let known = |column: &Column<ComparisonFigures>, figures| !column.value(figures).is_missing();
    let columns = pick_columns(&figure_columns(), &keys);
    let shown = columns.iter().filter(|column| known(column, after)).take(MOST);
    let figure = |column: &Column<ComparisonFigures>| HeadlineFigure {
        title: column.row_head(looks),
        now: looks.print_cell(column, after),
        was: before
            .filter(|before| known(column, before))
            .map_or_else(String::new, |before| looks.print_cell(column, before)),
        change: print_change(column, before, Some(after)),
    };
    shown.map(figure).collect()
}

/// The time of an operation in s, before and after; `None` where it does not exist or its time is not known.
pub(in crate::report) struct OperationTimes {
    pub before: Option<f64>,
    pub after: Option<f64>,
    /// Both as the tables print them.
    pub printed: [String; 2],
}

/// Returns the times of all operations, in the order of the comparison. They are the figure that headlines show.
pub(in crate::report) fn operation_times(comparison: &Comparison<'_>) -> Vec<OperationTimes> {
    let key = headline_time_key(&comparison.whole);
    let looks = TableLooks::markup(comparison.units());
    let columns = pick_columns(&figure_columns(), &[key]);
    let Some(column) = columns.first() else { return Vec::new() };
    let seconds = |figures: &Option<ComparisonFigures>| {
        figures.as_ref().and_then(|figures| column.value(figures).as_number())
    };
    let print = |figures: &Option<ComparisonFigures>| {
        figures.as_ref().map(|figures| looks.print_cell(column, figures)).unwrap_or_default()
    };
    let times = comparison.operations.iter().map(|row| OperationTimes {
        before: seconds(&row.before),
        after: seconds(&row.after),
        printed: [print(&row.before), print(&row.after)],
    });
    times.collect()
}
