//! This module formats numbers and tables for people.

use crate::number::{format_fixed_number, format_trimmed_number, group_thousands};
use crate::program::LengthUnit;
use std::fmt::Write;

/// Joins cells to columns. The first column is left-aligned, the others are right-aligned. Rows are indented
/// by two blanks.
pub(crate) fn format_table(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut out = String::new();
    for row in rows {
        let mut line = String::new();
        for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
            let _ = match column {
                0 => write!(line, "  {cell:<width$}"),
                _ => write!(line, "  {cell:>width$}"),
            };
        }
        out.push_str(line.trim_end());
        out.push('\n');
    }
    out
}

/// Formats `1234567` as `1,234,567`.
pub(crate) fn format_count(value: u64) -> String {
    group_thousands(&value.to_string())
}

/// Formats a number with a fixed number of decimals and grouped thousands. The result is never `-0`.
pub(crate) fn format_fixed(value: f64, decimals: usize) -> String {
    group_thousands(&format_fixed_number(value, decimals))
}

/// Formats a number without trailing zeros, with grouped thousands.
pub(crate) fn format_trimmed(value: f64, most_decimals: usize) -> String {
    group_thousands(&format_trimmed_number(value, most_decimals))
}

/// Formats a number with at most three decimals and no trailing zeros, with grouped thousands.
pub(crate) fn format_short(value: f64) -> String {
    format_trimmed(value, 3)
}

/// Formats a length in the file's unit for a sentence. In metric files, lengths of 10 m and more are in
/// metres.
pub(crate) fn format_length(value: f64, unit: LengthUnit) -> String {
    match unit {
        LengthUnit::Mm if value.abs() >= 10_000.0 => format!("{} m", format_fixed(value / 1000.0, 1)),
        LengthUnit::Mm | LengthUnit::Inch => format!("{} {}", format_short(value), unit_name(unit)),
    }
}

/// Returns `mm` or `in`.
pub(crate) fn unit_name(unit: LengthUnit) -> &'static str {
    match unit {
        LengthUnit::Mm => "mm",
        LengthUnit::Inch => "in",
    }
}

/// Formats seconds as `4.2 s`, `29:55` or `1:02:03`.
pub(crate) fn format_duration(seconds: f64) -> String {
    if !seconds.is_finite() {
        return "?".to_owned();
    }
    if seconds < 59.95 {
        return format!("{seconds:.1} s");
    }
    let whole = seconds.round() as u64;
    let (hours, minutes, seconds) = (whole / 3600, whole / 60 % 60, whole % 60);
    match hours {
        0 => format!("{minutes}:{seconds:02}"),
        _ => format!("{}:{minutes:02}:{seconds:02}", format_count(hours)),
    }
}

/// Formats a number with its noun: `3 arcs`, `1 arc`.
pub(crate) fn format_counted(number: usize, one: &str, many: &str) -> String {
    format!("{} {}", format_count(number as u64), if number == 1 { one } else { many })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_for_people() {
        assert_eq!(format_count(1_234_567), "1,234,567");
        assert_eq!(format_fixed(-1234.5, 2), "-1,234.50");
        assert_eq!(format_fixed(-0.001, 2), "0.00");
        assert_eq!(format_short(1000.0), "1,000");
        assert_eq!(format_duration(59.97), "1:00");
        assert_eq!(format_duration(3723.0), "1:02:03");
        assert_eq!(format_length(12_345.0, LengthUnit::Mm), "12.3 m");
    }
}
