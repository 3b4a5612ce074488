//! This module prints cells as text for people.

use super::column::{Column, ColumnDecimals};
use super::table_looks::{TableLooks, TableStyle};
use super::table_value::{PeakPlace, TableValue};
use crate::presentation::display_units::ColumnUnit;
use crate::presentation::safe_text::to_safe_line;
use crate::report::text_format::{format_count, format_duration, format_fixed, format_trimmed};

impl TableLooks {
    /// Prints the cell of a row.
    pub(crate) fn print_cell<R>(self, column: &Column<R>, row: &R) -> String {
        let number = |value: f64| self.print_number(column, value);
        match column.value(row) {
            TableValue::Missing => self.missing_text(column),
            TableValue::Text(text) | TableValue::Reference { name: text, .. } => to_safe_line(&text),
            TableValue::Flag(flag) => if flag { "yes" } else { "no" }.to_owned(),
            TableValue::Count(count) => format_count(count as u64),
            TableValue::Number(value) | TableValue::Peak { value, .. } => number(value),
            TableValue::Range([low, high]) => self.join_range(number(low), number(high)),
            TableValue::Duration { seconds, is_lower_bound } => {
                format!("{}{}", if is_lower_bound { "> " } else { "" }, format_duration(seconds))
            }
            TableValue::Intervals(intervals) => {
                let print = |[from, to]: &[f64; 2]| format!("{} {}", number(*from), number(*to));
                intervals.iter().map(print).collect::<Vec<_>>().join("; ")
            }
        }
    }

    /// Prints a number of a column in the reader's unit.
    pub(crate) fn print_number<R>(self, column: &Column<R>, value: f64) -> String {
        let value = self.units.convert(column.unit(), value);
        match column.shown_decimals(self.units) {
            ColumnDecimals::Fixed(decimals) => format_fixed(value, decimals),
            ColumnDecimals::Trimmed(most) => format_trimmed(value, most),
        }
    }

    /// Words a largest value as a sentence: `thickest chip: 0.0512 mm on line 17`. Returns `None` if it is
    /// not known, or if the column is not for sentences.
    pub(crate) fn word_peak<R>(self, column: &Column<R>, row: &R) -> Option<String> {
        let sentence = column.sentence()?;
        let TableValue::Peak { value, place } = column.value(row) else { return None };
        let value = self.units.convert(column.unit(), value);
        let number = format_fixed(value, self.units.decimals(column.unit(), sentence.decimals));
        let unit = match self.unit_symbol(column.unit()) {
            "" => String::new(),
            symbol => format!(" {symbol}"),
        };
        let place = match place {
            PeakPlace::Line(line) => line.map_or_else(String::new, |line| format!(" on line {line}")),
            PeakPlace::Layer { line, z_mm: None } => format!(" on line {line}"),
            PeakPlace::Layer { line, z_mm: Some(z) } => {
                let decimals = self.units.decimals(ColumnUnit::Length, 3);
                let z = format_trimmed(self.units.convert(ColumnUnit::Length, z), decimals);
                format!(" on line {line} at z {z}")
            }
        };
        Some(format!("{}: {number}{unit}{place}", sentence.words))
    }

    fn missing_text<R>(self, column: &Column<R>) -> String {
        match self.style {
            TableStyle::Plain => column.missing_text().to_owned(),
            TableStyle::Markup => String::new(),
        }
    }

    fn join_range(self, low: String, high: String) -> String {
        match self.style {
            _ if low == high => low,
            TableStyle::Plain => format!("{low} .. {high}"),
            TableStyle::Markup => format!("{low} to {high}"),
        }
    }
}
