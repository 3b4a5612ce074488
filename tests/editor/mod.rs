//! What editors get: schemas, answers about programs, and the server that speaks with them.

mod changed_lines;
mod client;
mod colors;
mod hostile_input;
mod line_answers;
mod path_page;
mod recipes;
mod schemas;
mod typing;

use clsmith::editor::ProgramView;
use clsmith::source::Source;

/// A program with two operations, as NX writes it.
pub const PART: &str = "\
TOOL PATH/ROUGH,TOOL,MILL_10
TLDATA/MILL,10.0000,0.0000,75.0000,0.0000,0.0000
LOAD/TOOL,3
SPINDL/RPM,5000,CLW
COOLNT/FLOOD
RAPID
GOTO/0.0000,0.0000,10.0000,0.0000000,0.0000000,1.0000000
FEDRAT/MMPM,600.0000
GOTO/0.0000,0.0000,-2.0000
FEDRAT/1200.0000
GOTO/60.0000,0.0000,-2.0000
END-OF-PATH
TOOL PATH/FINISH,TOOL,MILL_6
TLDATA/MILL,6.0000,0.0000,75.0000,0.0000,0.0000
LOAD/TOOL,4
RAPID
GOTO/0.0000,20.0000,10.0000
FEDRAT/MMPM,300.0000
GOTO/0.0000,20.0000,-2.0000
GOTO/30.0000,20.0000,-2.0000
END-OF-PATH
";

pub fn view(text: &str) -> ProgramView {
    ProgramView::new(&Source::new("part.cls", text.as_bytes().to_vec()).unwrap(), None)
}
