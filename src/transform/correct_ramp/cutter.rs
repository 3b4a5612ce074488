//! The cutter of a ramp: from the step, the setup, and the CL file.

use super::limits::Indexable;
use super::parameters::CorrectRamp;
use crate::diagnostic::Diagnostic;
use crate::program::LengthUnit;
use crate::program::motion::Tool;
use crate::transform::Context;
use crate::values::Positive;

/// What is known about a tool.
pub(super) enum Cutter {
    /// Everything.
    Indexable(Indexable),
    /// Nothing says that it has inserts.
    Solid,
    /// Something is missing.
    Unknown(Box<Diagnostic>),
}

/// The cutter that a tool is; mm.
pub(super) fn of(step: &CorrectRamp, tool: &Tool, file: LengthUnit, context: &Context<'_>) -> Cutter {
    let recipe = context.recipe.units.in_mm();
    let own = |value: Option<Positive>| value.map(|value| value.get() * recipe);
    let (told, entry) = (step.tool, context.setup.tool_entry(tool));
    let insert = entry.and_then(|entry| entry.insert);
    let data = tool.data.as_ref();
    let of_file = |value: Option<f64>| value.map(|value| value * file.in_mm()).filter(|value| *value > 0.0);
    let height = told.and_then(|tool| own(tool.insert_height)).or(insert.map(|insert| insert.height));
    let diameter = told
        .and_then(|tool| own(tool.diameter))
        .or(entry.and_then(|entry| entry.diameter))
        .or(of_file(data.and_then(|data| data.diameter)));
    let radius = told
        .and_then(|tool| own(tool.insert_radius))
        .or(insert.map(|insert| insert.radius))
        .or(of_file(data.and_then(|data| data.corner_radius)));
    if height.is_none() && told.is_none() {
        return Cutter::Solid;
    }
    let missing = |what: &str, key: &str| {
        let called = tool.called();
        let message = format!("{what} of {called} is not known, and its ramps cannot be judged without it");
        let help = format!(
            "Say `tool: {{ {key}: ... }}` in the step, or complete `setup.tools` for the tool, there as \
             `diameter` and `insert: {{ height, radius }}`."
        );
        Cutter::Unknown(Box::new(context.fail(message, &["tool"]).help(help)))
    };
    match (diameter, radius, height) {
        (Some(diameter), Some(insert_radius), Some(insert_height)) => {
            Cutter::Indexable(Indexable { diameter, insert_radius, insert_height })
        }
        (None, _, _) => missing("the diameter", "diameter"),
        (_, None, _) => missing("the insert's radius", "insert_radius"),
        (_, _, None) => missing("the cutting height of the insert", "insert_height"),
    }
}
