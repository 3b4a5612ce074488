//! What a step tells about itself beyond findings.

use crate::presentation::display_units::DisplayUnits;
use crate::presentation::path_panel::PathPanel;
use serde::ser::{Serialize, SerializeMap, Serializer};
use std::any::Any;
use std::fmt::Debug;

/// What a transform tells about one run of it. It makes one in `apply` and hands it to
/// [`StepContext::add_report`](super::StepContext::add_report); a transform that has nothing to tell makes none.
///
/// Serialized it is `{ step name: value }`.
pub trait TransformReport: Any + Debug + Send + Sync {
    /// The name of the step in recipes, under which the report stands in JSON.
    fn step_name(&self) -> &'static str;

    /// The report for people in the units that they see: lines that end in a line end, the first of them empty.
    fn to_text(&self, units: DisplayUnits) -> String;

    /// The report as a JSON value; [`to_json_value`] makes it from what serde can write.
    fn to_json(&self) -> serde_json::Value;

    /// What it draws, in the units that people see.
    fn build_panels(&self, _units: DisplayUnits) -> Vec<PathPanel> {
        Vec::new()
    }
}

impl dyn TransformReport {
    /// The report as its own type; `None` when it is of another step.
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

/// A value as JSON.
pub fn to_json_value(value: &impl Serialize) -> serde_json::Value {
    let json = serde_json::to_value(value);
    // Reports are structs of numbers, names and lists; only a map whose keys are no text could fail.
    debug_assert!(json.is_ok(), "{json:?}");
    json.unwrap_or_default()
}
