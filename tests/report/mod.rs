//! Rendering of findings, and the choice of those that are rendered.

mod calibration;
mod changes;
mod chips;
mod corpus;
mod diff;
mod explain;
mod html;
mod human;
mod human_lines;
mod json;
mod line;
mod machine_times;
mod markdown;
mod plot;
mod policy;
mod sarif;
pub mod simulation;
mod stats;
mod unified;

use clsmith::diagnostic::{Diagnostic, DiagnosticCode};
use clsmith::source::{Source, Span};
use std::sync::Arc;

pub const PART: &[u8] = b"TOOL PATH/POCKET,TOOL,MILL_10\n\
    TLDATA/MILL,10.0000,0.0000,50.0000,0.0000,0.0000\n\
    RAPID\n\
    GOTO/0.0000,0.0000,50.0000,0.0000,0.0000,1.0000\n\
    FEDRAT/MMPM,800.0000\n\
    GOTO/0.0000,0..0000,5.0000\n\
    GOTO/10.0000,0.0000,5.0000\n\
    END-OF-PATH\n";

pub fn source(name: &str, bytes: impl Into<Vec<u8>>) -> Arc<Source> {
    Source::new(name, bytes.into()).unwrap()
}

/// The place of a text that occurs in the source once.
pub fn at(source: &Source, text: impl AsRef<[u8]>) -> Span {
    let text = text.as_ref();
    let mut found = source.bytes().windows(text.len()).enumerate().filter(|(_, window)| *window == text);
    let (start, _) = found.next().expect("the text occurs");
    assert!(found.next().is_none(), "the text occurs once");
    Span::new(start, start + text.len())
}

/// A finding with one label at a text.
pub fn finding(code: DiagnosticCode, source: &Arc<Source>, text: impl AsRef<[u8]>) -> Diagnostic {
    Diagnostic::new(code, "something is the matter").with_label(source, at(source, text), "here")
}
