//! Tools: what the setup says about them, and what comes of it together with the CL file.

mod cutter;
mod entry;
mod gap;
mod teeth;
mod text;
mod told;

pub use cutter::Resolved;
pub use entry::{Bar, Insert, ToolEntry};
pub use gap::{ToolGap, ToolGapKind};
pub(super) use text::ToolText;
