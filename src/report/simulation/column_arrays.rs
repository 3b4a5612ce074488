//! This module hands out the table of motions column by column, for programs that work with arrays.

use super::SimulationReport;
use super::motion_row::motion_columns;
use crate::report::table::{ColumnUnit, TableValue};

/// A column of the table of motions, under its name in the CSV.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnArray {
    /// Its name, which ends with the unit: `chip_thickness_mm`.
    pub name: String,
    /// Its values, one for each motion.
    pub values: ColumnValues,
}

/// The values of a column.
#[derive(Debug, Clone, PartialEq)]
pub enum ColumnValues {
    /// Numbers in the unit of the name; NaN where a value is not known.
    Numbers(Vec<f64>),
    /// Names.
    Texts(Vec<String>),
}

impl SimulationReport {
    /// Returns the columns that [`super::write_csv`] writes, in the same units and the same order.
    pub fn to_column_arrays(&self) -> Vec<ColumnArray> {
        let columns = motion_columns();
        let in_csv = columns.iter().filter(|column| column.is_in_csv());
        let arrays = in_csv.map(|column| {
            let convert = |value: f64| self.units.convert(column.unit(), value);
            let mut numbers = Vec::with_capacity(self.motions.rows.len());
            let mut texts = Vec::new();
            for row in self.motions.named_rows() {
                match column.value(&row) {
                    TableValue::Text(text) => texts.push(text.into_owned()),
                    value => numbers.push(value.as_number().map_or(f64::NAN, convert)),
                }
            }
            debug_assert!(texts.is_empty() || numbers.is_empty(), "a column has one kind of value");
            let is_text = column.unit() == ColumnUnit::None && numbers.is_empty() && !texts.is_empty();
            let values = if is_text { ColumnValues::Texts(texts) } else { ColumnValues::Numbers(numbers) };
            ColumnArray { name: column.csv_head(self.units), values }
        });
        arrays.collect()
    }
}
