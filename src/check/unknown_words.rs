//! This module reports words that clsmith does not know.

use super::{Lint, LintFindings};
use crate::diagnostic::codes;
use crate::program::{Record, Statement, StatementId};

/// Words without which the machine would do something else.
const IMPORTANT_WORDS: &[&str] = &[
    "GOTO",
    "FROM",
    "GOHOME",
    "GODLTA",
    "CIRCLE",
    "MOVARC",
    "INDIRV",
    "RAPID",
    "NURBS",
    "KNOT",
    "CNTRL",
    "FEDRAT",
    "SPINDL",
    "CUTCOM",
    "COOLNT",
    "CYCLE",
    "LOADTL",
    "LOAD",
    "TOOLNO",
    "TLDATA",
    "CUTTER",
    "TLAXIS",
    "MULTAX",
    "MSYS",
    "CSYS",
    "TRANS",
    "ORIGIN",
    "ROTABL",
    "UNITS",
    "DELAY",
    "FINI",
    "STOP",
    "END-OF-PATH",
];

/// Reports unknown words, and those that are probably misspelt.
#[derive(Default)]
pub(super) struct UnknownWordLint {
    ended: bool,
}

impl Lint for UnknownWordLint {
    fn check_statement(&mut self, id: StatementId, statement: &Statement, found: &mut LintFindings<'_>) {
        self.ended |= matches!(statement.record(), Record::ProgramEnd);
        // Statements after the end of the program have a finding of their own.
        if self.ended || !matches!(statement.record(), Record::Other) {
            return;
        }
        let syntax = found.statement_syntax(id);
        let major = syntax.major_word();
        let span = found.text_span(id, &syntax.word);
        let meant = IMPORTANT_WORDS.iter().find(|word| strsim::osa_distance(&major, word) == 1);
        match meant {
            Some(word) => {
                let message = format!("`{major}` is not known; did you mean `{word}`?");
                found.report(codes::MISSPELT_WORD, span, message, "");
            }
            None => found.report(codes::UNKNOWN_WORD, span, format!("the word `{major}` is not known"), ""),
        }
    }
}
