//! This module finds the cutter of a ramp in the step, the setup and the CL file.

use super::parameters::CorrectRamp;
use super::ramp_limits::IndexableCutter;
use crate::diagnostic::{Diagnostic, codes};
use crate::parameters::Positive;
use crate::program::LengthUnit;
use crate::program::motion::ActiveTool;
use crate::transform::StepContext;

/// The data that is known about a tool.
pub(super) enum RampCutter {
    /// All dimensions are known.
    Indexable(IndexableCutter),
    /// Nothing says that the tool has inserts.
    Solid,
    /// A dimension is missing.
    Unknown(Box<Diagnostic>),
}

/// Finds the cutter that a tool is, in mm.
pub(super) fn resolve_ramp_cutter(
    step: &CorrectRamp,
    tool: &ActiveTool,
    file: LengthUnit,
    context: &StepContext<'_>,
) -> RampCutter {
    let recipe = context.units.mm_per_unit();
    let own = |value: Option<Positive>| value.map(|value| value.get() * recipe);
    let (told, entry) = (step.tool, context.setup.find_tool_entry(tool));
    let data = tool.data.as_ref();
    let of_file =
        |value: Option<f64>| value.map(|value| value * file.mm_per_unit()).filter(|value| *value > 0.0);
    let diameter = told
        .and_then(|tool| own(tool.diameter))
        .or(entry.and_then(|entry| entry.diameter_mm))
        .or(of_file(data.and_then(|data| data.diameter)));
    // Without a diameter, catalogue data says nothing about the inserts themselves.
    let insert =
        entry.and_then(|entry| entry.insert).map(|insert| insert.of_cutter(diameter.unwrap_or_default()));
    let height = told.and_then(|tool| own(tool.insert_height)).or(insert.map(|insert| insert.height_mm));
    let radius = told
        .and_then(|tool| own(tool.insert_radius))
        .or(insert.map(|insert| insert.radius_mm))
        .or(of_file(data.and_then(|data| data.corner_radius)));
    if height.is_none() && told.is_none() {
        return RampCutter::Solid;
    }
    let missing = |what: &str, key: &str| {
        let called = tool.display_name();
        let message = format!("{what} of {called} is not known, and its ramps cannot be judged without it");
        let help = format!(
            "Add `tool: {{ {key}: ... }}` to the step, or complete the tool under `setup.tools`, there as \
             `diameter` and `insert: {{ height, radius }}`."
        );
        RampCutter::Unknown(Box::new(
            context.step_finding(codes::STEP_FAILED, message, &["tool"], "asked for here").with_help(help),
        ))
    };
    match (diameter, radius, height) {
        (Some(diameter), Some(insert_radius), Some(insert_height)) => {
            RampCutter::Indexable(IndexableCutter { diameter, insert_radius, insert_height })
        }
        (None, _, _) => missing("the diameter", "diameter"),
        (_, None, _) => missing("the insert's radius", "insert_radius"),
        (_, _, None) => missing("the cutting height of the insert", "insert_height"),
    }
}
