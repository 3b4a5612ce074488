//! This module holds tools: what the setup states about them, and the cutters that follow from it and the CL
//! file.

mod beam_resolver;
mod beam_text;
mod cutter_resolver;
mod file_tool_data;
mod insert_data;
mod insert_text;
mod shank_text;
mod teeth;
mod tool_data_fault;
mod tool_entry;
mod tool_profile;
mod tool_text;
mod unlike_diameter;

pub use beam_text::ToolStiffness;
pub use cutter_resolver::ResolvedCutter;
pub use insert_data::{CutterInsert, InsertClearance, InsertData, InsertWidth};
pub use tool_data_fault::{ToolDataFault, ToolDataFaultKind};
pub use tool_entry::{ToolCylinder, ToolEntry};
pub(super) use tool_text::ToolText;
