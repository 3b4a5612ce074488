//! This module writes rows for machines: as CSV tables and as JSON objects.

use super::column::Column;
use super::table_value::{PeakPlace, TableValue};
use crate::presentation::display_units::{ColumnUnit, DisplayUnits};
use crate::presentation::safe_text::{is_hidden_character, to_safe_line};
use crate::report::rounding::round_to_micro;
use serde::ser::{SerializeMap, SerializeSeq};
use serde::{Serialize, Serializer};
use std::borrow::Cow;
use std::io::{self, Write};

/// The numbers of a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RecordNumbers {
    /// Numbers have at most six decimals.
    Rounded,
    /// Numbers have all their digits.
    Exact,
}

/// A list of columns that makes JSON objects of rows.
pub(crate) struct JsonColumns<R> {
    columns: Vec<Column<R>>,
    keys: Vec<Cow<'static, str>>,
    format: RecordFormat,
}

#[derive(Debug, Clone, Copy)]
struct RecordFormat {
    units: DisplayUnits,
    numbers: RecordNumbers,
}

impl<R> JsonColumns<R> {
    /// Takes the columns that JSON has, with their keys.
    pub(crate) fn new(columns: &[Column<R>], units: DisplayUnits, numbers: RecordNumbers) -> Self {
        let columns: Vec<Column<R>> = columns.iter().filter(|column| column.is_in_json()).copied().collect();
        let keys = columns.iter().map(|column| column.json_key(units)).collect();
        Self { columns, keys, format: RecordFormat { units, numbers } }
    }

    /// Makes a JSON list of rows.
    pub(crate) fn serialize_rows<S: Serializer>(
        &self,
        rows: impl Iterator<Item = R>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        let mut list = serializer.serialize_seq(None)?;
        for row in rows {
            list.serialize_element(&self.object(&row))?;
        }
        list.end()
    }

    /// Returns a row as something that becomes a JSON object.
    pub(crate) fn object<'a>(&'a self, row: &'a R) -> JsonObject<'a, R> {
        let (columns, keys) = (self.columns.as_slice(), self.keys.as_slice());
        JsonObject { columns, keys, row, format: self.format }
    }
}

/// A row that becomes a JSON object.
pub(crate) struct JsonObject<'a, R> {
    columns: &'a [Column<R>],
    keys: &'a [Cow<'static, str>],
    row: &'a R,
    format: RecordFormat,
}

impl<R> JsonObject<'_, R> {
    /// Adds the columns to an object that may hold other keys as well.
    pub(crate) fn serialize_entries<M: SerializeMap>(&self, map: &mut M) -> Result<(), M::Error> {
        for (column, key) in self.columns.iter().zip(self.keys) {
            let value = JsonValue { value: column.value(self.row), unit: column.unit(), format: self.format };
            map.serialize_entry(key.as_ref(), &value)?;
        }
        Ok(())
    }
}

impl<R> Serialize for JsonObject<'_, R> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        self.serialize_entries(&mut map)?;
        map.end()
    }
}

/// A value as JSON has it.
struct JsonValue<'r> {
    value: TableValue<'r>,
    unit: ColumnUnit,
    format: RecordFormat,
}

impl RecordFormat {
    fn number(self, unit: ColumnUnit, value: f64) -> f64 {
        let value = self.units.convert(unit, value);
        match self.numbers {
            RecordNumbers::Rounded => round_to_micro(value),
            RecordNumbers::Exact => value,
        }
    }
}

impl Serialize for JsonValue<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let number = |value: f64| self.format.number(self.unit, value);
        match &self.value {
            TableValue::Missing => serializer.serialize_none(),
            TableValue::Text(text) => serializer.serialize_str(text),
            TableValue::Flag(flag) => serializer.serialize_bool(*flag),
            TableValue::Count(count) => serializer.serialize_u64(*count as u64),
            TableValue::Number(value) => serializer.serialize_f64(number(*value)),
            TableValue::Duration { seconds, .. } => serializer.serialize_f64(number(*seconds)),
            TableValue::Range([min, max]) => {
                let mut map = serializer.serialize_map(Some(2))?;
                map.serialize_entry("min", &number(*min))?;
                map.serialize_entry("max", &number(*max))?;
                map.end()
            }
            TableValue::Peak { value, place } => {
                let mut map = serializer.serialize_map(None)?;
                map.serialize_entry("value", &number(*value))?;
                match place {
                    PeakPlace::Line(line) => map.serialize_entry("line", line)?,
                    PeakPlace::Layer { line, z_mm } => {
                        map.serialize_entry("line", line)?;
                        map.serialize_entry("z", &z_mm.map(|z| self.format.number(ColumnUnit::Length, z)))?;
                    }
                }
                map.end()
            }
            TableValue::Intervals(intervals) => {
                serializer.collect_seq(intervals.iter().map(|interval| interval.map(number)))
            }
            TableValue::Reference { index, .. } => index.serialize(serializer),
        }
    }
}

/// Writes rows as CSV: a head line, commas, numbers with a decimal point, empty cells for what is not known.
pub(crate) struct CsvTable<R, W: Write> {
    columns: Vec<Column<R>>,
    units: DisplayUnits,
    writer: csv::Writer<W>,
}

impl<R, W: Write> CsvTable<R, W> {
    /// Begins a table with its head line.
    ///
    /// # Errors
    /// Returns the errors of `out`.
    pub(crate) fn begin(columns: &[Column<R>], units: DisplayUnits, out: W) -> io::Result<Self> {
        let columns: Vec<Column<R>> = columns.iter().filter(|column| column.is_in_csv()).copied().collect();
        let mut writer = csv::WriterBuilder::new().has_headers(false).from_writer(out);
        writer.write_record(columns.iter().map(|column| column.csv_head(units))).map_err(to_io_error)?;
        Ok(Self { columns, units, writer })
    }

    /// Writes a row.
    ///
    /// # Errors
    /// Returns the errors of the output.
    pub(crate) fn write_row(&mut self, row: &R) -> io::Result<()> {
        let cells = CsvRow { columns: &self.columns, row, units: self.units };
        self.writer.serialize(cells).map_err(to_io_error)
    }

    /// Writes the rows that are still in the buffer.
    ///
    /// # Errors
    /// Returns the errors of the output.
    pub(crate) fn finish(mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

/// Returns a text as a cell that a spreadsheet shows and does not run as a formula. A text that begins with
/// `=`, `+`, `-`, `@` or a hidden character gets an apostrophe in front, which marks it as text. A text that
/// is a number stays a number, and hidden characters are replaced.
pub(crate) fn to_csv_text(text: &str) -> String {
    let begins_formula =
        text.starts_with(|first: char| matches!(first, '=' | '+' | '-' | '@') || is_hidden_character(first));
    let is_number = text.parse::<f64>().is_ok();
    let shown = to_safe_line(text);
    if begins_formula && !is_number { format!("'{shown}") } else { shown }
}

struct CsvRow<'a, R> {
    columns: &'a [Column<R>],
    row: &'a R,
    units: DisplayUnits,
}

impl<R> Serialize for CsvRow<'_, R> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut cells = serializer.serialize_seq(Some(self.columns.len()))?;
        let format = RecordFormat { units: self.units, numbers: RecordNumbers::Rounded };
        for column in self.columns {
            let number = |value: f64| format.number(column.unit(), value);
            match column.value(self.row) {
                TableValue::Missing => cells.serialize_element(&None::<f64>)?,
                TableValue::Text(text) | TableValue::Reference { name: text, .. } => {
                    cells.serialize_element(&to_csv_text(text.as_ref()))?;
                }
                TableValue::Flag(flag) => cells.serialize_element(&flag)?,
                TableValue::Count(count) => cells.serialize_element(&count)?,
                TableValue::Number(value) | TableValue::Peak { value, .. } => {
                    cells.serialize_element(&number(value))?;
                }
                TableValue::Duration { seconds, .. } => cells.serialize_element(&number(seconds))?,
                TableValue::Range(range) => {
                    let [low, high] = range.map(number);
                    cells.serialize_element(&format!("{low} {high}"))?;
                }
                TableValue::Intervals(intervals) => {
                    let print = |interval: &[f64; 2]| {
                        let [from, to] = interval.map(number);
                        format!("{from} {to}")
                    };
                    cells.serialize_element(&intervals.iter().map(print).collect::<Vec<_>>().join("; "))?;
                }
            }
        }
        cells.end()
    }
}

/// Returns the writer's own error, so that the caller recognizes a run that was stopped.
fn to_io_error(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}

#[cfg(test)]
mod tests {
    use super::to_csv_text;

    #[test]
    fn no_text_is_a_formula_and_numbers_stay_numbers() {
        for (text, cell) in [
            ("=1+2", "'=1+2"),
            ("+CHAMFER", "'+CHAMFER"),
            ("-2+3 FACE", "'-2+3 FACE"),
            ("@SUM(A1)", "'@SUM(A1)"),
            ("\t=1", "'=1"),
            ("\u{202e}REVERSED", "'\u{fffd}REVERSED"),
            ("POCKET-1", "POCKET-1"),
            ("-12.5", "-12.5"),
            ("+3", "+3"),
            ("", ""),
        ] {
            assert_eq!(to_csv_text(text), cell);
        }
    }
}
