//! This module defines columns: name, unit, the value of a row and its printing, all in one place.

use super::table_looks::TableLooks;
use super::table_value::TableValue;
use crate::presentation::display_units::{ColumnUnit, DisplayUnits};
use std::borrow::Cow;

/// One column of a table whose rows are of type `R`.
pub(crate) struct Column<R> {
    key: &'static str,
    json_key: Option<&'static str>,
    medium: ColumnMedium,
    title: Option<&'static str>,
    sentence: Option<ColumnSentence>,
    unit: ColumnUnit,
    decimals: ColumnDecimals,
    is_left_aligned: bool,
    missing: &'static str,
    value: for<'r> fn(&'r R) -> TableValue<'r>,
}

/// How a value is worded in a sentence.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct ColumnSentence {
    /// The words before the value.
    pub words: &'static str,
    /// The decimals of the value.
    pub decimals: usize,
}

/// How numbers of a column are printed for people. Machines get all digits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ColumnDecimals {
    /// Always so many decimals.
    Fixed(usize),
    /// At most so many decimals, without trailing zeros.
    Trimmed(usize),
}

/// The outputs for machines that a column is in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ColumnMedium {
    Csv,
    Json,
    Both,
}

impl<R> Column<R> {
    /// Makes a column. `key` is its name for machines, to which the unit is added.
    pub(crate) fn new(
        key: &'static str,
        unit: ColumnUnit,
        value: for<'r> fn(&'r R) -> TableValue<'r>,
    ) -> Self {
        Self {
            key,
            json_key: None,
            medium: ColumnMedium::Both,
            title: None,
            sentence: None,
            unit,
            decimals: ColumnDecimals::Trimmed(3),
            is_left_aligned: false,
            missing: "-",
            value,
        }
    }

    /// Sets the head of the column in tables for people, without unit. An empty one leaves the unit alone as
    /// the head.
    pub(crate) fn titled(mut self, title: &'static str) -> Self {
        self.title = Some(title);
        self
    }

    /// Sets how the value is worded in a sentence: `thickest chip: 0.0512 mm`.
    pub(crate) fn worded_as(mut self, words: &'static str, decimals: usize) -> Self {
        self.sentence = Some(ColumnSentence { words, decimals });
        self
    }

    /// Prints numbers for people with a fixed number of decimals.
    pub(crate) fn decimals(mut self, decimals: usize) -> Self {
        self.decimals = ColumnDecimals::Fixed(decimals);
        self
    }

    /// Aligns the column to the left in HTML. In plain text and Markdown, always the first column alone is
    /// aligned to the left.
    pub(crate) fn left_aligned(mut self) -> Self {
        self.is_left_aligned = true;
        self
    }

    /// Sets what stands for a value that is not known, in plain text. CSV has an empty cell, JSON `null`.
    pub(crate) fn missing(mut self, text: &'static str) -> Self {
        self.missing = text;
        self
    }

    /// Keeps a JSON key that is older than this model and does not end with the column's unit.
    pub(crate) fn old_json_key(mut self, key: &'static str) -> Self {
        self.json_key = Some(key);
        self
    }

    /// Leaves the column out of JSON.
    pub(crate) fn only_in_csv(mut self) -> Self {
        self.medium = ColumnMedium::Csv;
        self
    }

    /// Leaves the column out of CSV.
    pub(crate) fn only_in_json(mut self) -> Self {
        self.medium = ColumnMedium::Json;
        self
    }

    /// Returns the unit.
    pub(crate) fn unit(&self) -> ColumnUnit {
        self.unit
    }

    /// Returns how numbers are printed for people, once they are converted.
    pub(crate) fn shown_decimals(&self, units: DisplayUnits) -> ColumnDecimals {
        match self.decimals {
            ColumnDecimals::Fixed(decimals) => ColumnDecimals::Fixed(units.decimals(self.unit, decimals)),
            ColumnDecimals::Trimmed(most) => ColumnDecimals::Trimmed(units.decimals(self.unit, most)),
        }
    }

    /// Returns what stands for a value that is not known, in plain text.
    pub(crate) fn missing_text(&self) -> &'static str {
        self.missing
    }

    /// Returns how the value is worded in a sentence, if it ever is.
    pub(crate) fn sentence(&self) -> Option<ColumnSentence> {
        self.sentence
    }

    /// Returns whether the column is aligned to the left in HTML.
    pub(crate) fn is_left_aligned(&self) -> bool {
        self.is_left_aligned
    }

    /// Returns whether the column is one of a CSV table.
    pub(crate) fn is_in_csv(&self) -> bool {
        self.medium != ColumnMedium::Json
    }

    /// Returns whether the column is a key of JSON objects.
    pub(crate) fn is_in_json(&self) -> bool {
        self.medium != ColumnMedium::Csv
    }

    /// Returns the value of a row.
    pub(crate) fn value<'r>(&self, row: &'r R) -> TableValue<'r> {
        (self.value)(row)
    }

    /// Returns the head of the column in CSV: its key and its unit.
    pub(crate) fn csv_head(&self, units: DisplayUnits) -> String {
        units.key(self.key, self.unit).into_owned()
    }

    /// Returns the key of the column in JSON.
    pub(crate) fn json_key(&self, units: DisplayUnits) -> Cow<'static, str> {
        self.json_key.map_or_else(|| units.key(self.key, self.unit), Cow::Borrowed)
    }

    /// Returns the head of the column in tables for people: its title and its unit, `at feed, mm`.
    pub(crate) fn head(&self, looks: TableLooks) -> String {
        join_unit(self.title.unwrap_or(self.key), self.unit, looks)
    }

    /// Returns the head of a row that gives the column's values, if rows and columns are swapped: the words
    /// of the sentence and the unit.
    pub(crate) fn row_head(&self, looks: TableLooks) -> String {
        let words = self.sentence.map(|sentence| sentence.words);
        join_unit(words.or(self.title).unwrap_or(self.key), self.unit, looks)
    }
}

fn join_unit(words: &str, unit: ColumnUnit, looks: TableLooks) -> String {
    let symbol = if looks.has_units_in_heads { looks.unit_symbol(unit) } else { "" };
    match (words, symbol) {
        (words, "") => words.to_owned(),
        ("", symbol) => symbol.to_owned(),
        (words, symbol) => format!("{words}, {symbol}"),
    }
}

/// Returns the columns of these names, in this order. A key that no column has is a mistake in this program's
/// code.
pub(crate) fn pick_columns<R>(columns: &[Column<R>], keys: &[&str]) -> Vec<Column<R>> {
    let find = |key: &&str| {
        let found = columns.iter().find(|column| column.key == *key).copied();
        debug_assert!(found.is_some(), "no column is called {key}");
        found
    };
    keys.iter().filter_map(find).collect()
}

// A derived `Clone` would require that rows can be copied.
impl<R> Clone for Column<R> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<R> Copy for Column<R> {}
