//! This module holds what a step reports about itself besides findings.

use crate::presentation::display_units::DisplayUnits;
use crate::presentation::path_panel::PathPanel;
use serde::ser::{Serialize, SerializeMap, Serializer};
use std::any::Any;
use std::fmt::Debug;

/// The report of a transform about one run. It makes the report in `apply` and passes it to
/// [`StepContext::add_report`](super::StepContext::add_report). A transform without a report makes none.
///
/// The serialized form is `{ step name: value }`.
pub trait TransformReport: Any + Debug + Send + Sync {
    /// Returns the name of the step in recipes, under which the report stands in JSON.
    fn step_name(&self) -> &'static str;

    /// The report for people in the units that they see: lines that end in a line end, the first of them empty.
    fn to_text(&self, units: DisplayUnits) -> String;

    /// Returns the report as a JSON value. [`to_json_value`] makes it from what serde can write.
    fn to_json(&self) -> serde_json::Value;

    /// What it draws, in the units that people see.
    fn build_panels(&self, _units: DisplayUnits) -> Vec<PathPanel> {
        Vec::new()
    }
}

impl dyn TransformReport {
    /// Returns the report as its own type. Returns `None` if it belongs to another step.
    pub fn downcast_ref<T: TransformReport>(&self) -> Option<&T> {
        (self as &dyn Any).downcast_ref()
    }
}

impl Serialize for dyn TransformReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(1))?;
        map.serialize_entry(self.step_name(), &self.to_json())?;
        map.end()
    }
}

/// Converts a value to JSON.
pub fn to_json_value(value: &impl Serialize) -> serde_json::Value {
    let json = serde_json::to_value(value);
    // Reports are structs of numbers, names and lists. Only a map whose keys are no text could fail.
    debug_assert!(json.is_ok(), "{json:?}");
    json.unwrap_or_default()
}
