//! This module makes JSON objects of statistics, from their columns.

use super::stats_columns::{NamedOperation, feed_columns, operation_columns, tool_columns, totals_columns};
use super::{FeedRow, MotionTotals, OperationStats, ToolStats};
use crate::report::table::{Column, DisplayUnits, JsonColumns, RecordNumbers};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// Returns what makes JSON objects of rows. Values keep all their digits and stay in the file's unit. The
/// keys are older than the columns and name no unit.
fn json_columns<R>(columns: &[Column<R>]) -> JsonColumns<R> {
    JsonColumns::new(columns, DisplayUnits::MM, RecordNumbers::Exact)
}

impl Serialize for MotionTotals {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        json_columns(&totals_columns()).object(self).serialize_entries(&mut map)?;
        map.serialize_entry("unknown_time", &self.unknown_time)?;
        map.end()
    }
}

impl Serialize for ToolStats {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        json_columns(&tool_columns()).object(self).serialize_entries(&mut map)?;
        map.serialize_entry("totals", &self.totals)?;
        map.end()
    }
}

impl Serialize for OperationStats {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        // JSON gives the tool's index in the list of tools, not its name.
        let named = NamedOperation { operation: self, tools: &[] };
        let [name, tool, feed] = operation_columns();
        let mut map = serializer.serialize_map(None)?;
        json_columns(&[name, tool]).object(&named).serialize_entries(&mut map)?;
        map.serialize_entry("totals", &self.totals)?;
        json_columns(&[feed]).object(&named).serialize_entries(&mut map)?;
        map.end()
    }
}

impl Serialize for FeedRow {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        json_columns(&feed_columns()).object(self).serialize(serializer)
    }
}
