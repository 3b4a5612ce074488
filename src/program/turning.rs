//! This module tells turning programs from milling programs.

use super::record::ToolWord;
use super::{Program, Record};

impl Program {
    /// Returns whether the program turns: it describes a turning tool or cuts a thread with one, and no point
    /// lies beside the plane y = 0 of a lathe.
    pub fn is_turning(&self) -> bool {
        let mut tool = false;
        for (_, statement) in self.live_statements() {
            match statement.record() {
                Record::Goto(goto) if goto.point.y != 0.0 => return false,
                Record::Threading(_) => tool = true,
                Record::ToolData(data) if data.word == ToolWord::TlDataOther => {
                    let text = self.statement_text(statement);
                    tool |= memchr::memmem::find(text, b"WEDM").is_none();
                }
                Record::ToolCall(call) if !call.loads => {
                    tool |= memchr::memmem::find(self.statement_text(statement), b"TURN").is_some();
                }
                _ => {}
            }
        }
        tool
    }
}
