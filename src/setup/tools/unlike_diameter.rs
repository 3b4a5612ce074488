//! This module tells a tool to which the setup gives a diameter that is far from the program's: mostly a slip of units.

use super::file_tool_data::FileToolData;
use super::tool_data_fault::format_length_in;
use crate::diagnostic::{Diagnostic, codes};
use crate::program::LengthUnit;
use crate::program::motion::ActiveTool;
use crate::setup::Setup;
use crate::source::{Source, Span};
use std::sync::Arc;

/// Diameters of one tool that are so many times apart are a slip of units (25.4) or of a decimal point. Reground and
/// exchanged cutters are far nearer to each other.
const SLIP_FACTOR: f64 = 8.0;

impl Setup {
    /// Reports a tool whose diameter in the setup is eight times that of the program or more, or an eighth of it or less.
    /// `units` is the unit of the program, and `span` a place in `source` that uses the tool. Returns `None` if the
    /// diameters are nearer, or one of them is not known.
    pub fn report_unlike_diameter(
        &self,
        tool: &ActiveTool,
        units: LengthUnit,
        source: &Arc<Source>,
        span: Span,
    ) -> Option<Diagnostic> {
        let by_setup = self.find_tool_entry(tool)?.diameter_mm?;
        let by_program = FileToolData::from_tool_data(tool.data.as_ref(), units).diameter_mm?;
        let is_known = by_setup > 0.0 && by_program > 0.0;
        if !is_known || (by_setup / by_program).ln().abs() < SLIP_FACTOR.ln() {
            return None;
        }
        let [setup, program] = [by_setup, by_program].map(|mm| format_length_in(mm, units));
        let name = tool.display_name();
        let message =
            format!("{name} has a diameter of {setup} in the setup, and of {program} in the program");
        let help = "Lengths of a setup are in its `units`, millimetres when it says none. The setup's diameter counts.";
        Some(
            Diagnostic::new(codes::UNUSUAL_VALUE, message)
                .with_label(source, span, "used here")
                .with_help(help),
        )
    }
}
