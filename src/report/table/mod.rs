//! This module is the only model of tables. A column states its name, unit, value and printing once, and
//! every output is made from that.
//!
//! A `Column` takes its value from a row as a `TableValue`. For people, `TableLooks` prints cells in the
//! reader's unit, and `PrintedTable` makes plain text, Markdown and HTML of them. `compare_figures` swaps
//! rows and columns for a comparison before and after. For machines, `CsvTable` writes CSV and `JsonColumns`
//! makes JSON objects. Names for machines end with the unit of the [`ColumnUnit`], and all values are
//! converted in [`DisplayUnits::convert`] and nowhere else.

mod before_after;
mod column;
mod printed_cell;
mod printed_table;
mod record;
mod table_looks;
mod table_value;
#[cfg(test)]
mod tests;

pub(crate) use crate::presentation::display_units::{ColumnUnit, DisplayUnits};
pub(crate) use before_after::{compare_figures, list_figures, print_change};
pub(crate) use column::{Column, pick_columns};
pub(crate) use printed_table::PrintedTable;
pub(crate) use record::{CsvTable, JsonColumns, RecordNumbers, to_csv_text};
pub(crate) use table_looks::TableLooks;
pub(crate) use table_value::{PeakPlace, TableValue};
