//! This module reports words that clsmith does not know.

use super::{Lint, LintFindings};
use crate::diagnostic::{DiagnosticCode, codes};
use crate::parse;
use crate::program::motion::Motion;
use crate::program::{Dialect, FieldKind, Program, Record, Statement, StatementId};

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

/// Words that only NX writes: in a file of another system they are no slip.
const OF_NX: &[&str] = &["TLDATA", "MSYS", "NURBS", "KNOT", "CNTRL", "END-OF-PATH"];

/// Drive motions of part programs, of which some forms are read.
const DRIVE_MOTIONS: &[&str] =
    &["TLON", "TLLFT", "TLRGT", "GOFWD", "GOBACK", "GOLFT", "GORGT", "GOUP", "GODOWN"];

/// Parts of words that name curves: `HELIX`, `SPIRAL`, `ARCDAT`, `CIRCUL`. With numbers, they may move the tool.
const CURVES: &[&str] = &["ARC", "CIRC", "HELI", "SPIRAL", "SPLIN", "NURB", "CURVE"];

pub(super) const CODES: &[DiagnosticCode] =
    &[codes::UNKNOWN_WORD, codes::MISSPELT_WORD, codes::POINTS_MISSING];

/// Unknown words, those that look like a slip, and those that may move the tool.
#[derive(Default)]
pub(super) struct UnknownWordLint {
    ended: bool,
    moved: bool,
    /// The unknown words in the order in which they appear, with their statements.
    words: Vec<(String, Vec<StatementId>)>,
    /// Statements since the last motion that may be points.
    since_motion: Vec<(String, StatementId)>,
    /// Statements that may be points between motions, by their words.
    points: Vec<(String, Vec<StatementId>)>,
}

impl Lint for UnknownWordLint {
    fn check_statement(&mut self, id: StatementId, statement: &Statement, found: &mut LintFindings<'_>) {
        self.ended |= matches!(statement.record(), Record::ProgramEnd);
        // Statements after the end of the program have a finding of their own.
        if self.ended {
            return;
        }
        if matches!(statement.record(), Record::Text) {
            report_taken_lines(id, found);
        }
        if !matches!(statement.record(), Record::Other) {
            return;
        }
        let syntax = found.statement_syntax(id);
        let major = syntax.major_word().into_owned();
        let slip = |word: &&&str| {
            strsim::osa_distance(&major, word) == 1
                && (found.program.dialect() == Dialect::Nx || !OF_NX.contains(word))
        };
        if let Some(word) = IMPORTANT_WORDS.iter().find(slip) {
            let message = format!("`{major}` is not known; did you mean `{word}`?");
            let span = found.text_span(id, &syntax.word);
            return found.report(codes::MISSPELT_WORD, span, message, "");
        }
        let numbers = syntax.fields.iter().all(|field| matches!(field.kind, FieldKind::Number(_)));
        let first = major.split(',').next().unwrap_or_default();
        if DRIVE_MOTIONS.contains(&first) {
            add_statement(&mut self.points, major.clone(), id);
        } else if numbers && matches!(syntax.fields.len(), 3 | 6)
            || syntax.count_numbers() >= 3 && CURVES.iter().any(|part| major.contains(part))
        {
            self.since_motion.push((major.clone(), id));
        }
        add_statement(&mut self.words, major, id);
    }

    fn check_motion(&mut self, _motion: &Motion, _found: &mut LintFindings<'_>) {
        for (word, id) in std::mem::take(&mut self.since_motion) {
            if self.moved {
                add_statement(&mut self.points, word, id);
            }
        }
        self.moved = true;
    }

    fn finish(&mut self, found: &mut LintFindings<'_>) {
        for (word, statements) in &self.words {
            let Some(first) = statements.first() else { continue };
            let message = match statements.len() {
                1 => format!("the word `{word}` is not known"),
                count => format!("the word `{word}` is not known ({count} statements)"),
            };
            found.report(codes::UNKNOWN_WORD, found.word_span(*first), message, "");
        }
        for (word, statements) in &self.points {
            let Some(first) = statements.first() else { continue };
            let message = match statements.len() {
                1 => format!("this `{word}` may be a point: the path may lack it"),
                count => format!(
                    "{count} statements `{word}` may be points: the path may lack them ({})",
                    list_lines(statements, found)
                ),
            };
            found.report(codes::POINTS_MISSING, found.statement_span(*first), message, "");
        }
    }
}

/// Records that a text which ends in `$` must not have taken for its own next line.
const OF_THE_PATH: &[&[u8]] =
    &[b"GOTO/", b"FROM/", b"GODLTA/", b"GOHOME/", b"CIRCLE/", b"MOVARC/", b"FEDRAT/", b"SPINDL/", b"CYCLE/"];

/// Reports lines that a text has taken since it ends in `$`, but that read like records of the path.
fn report_taken_lines(id: StatementId, found: &mut LintFindings<'_>) {
    let text = found.program.statement_text(found.program.statement(id));
    let mut from = 0;
    while let Some(end) = memchr::memchr(b'\n', text.get(from..).unwrap_or_default()) {
        from += end + 1;
        let line = text.get(from..).unwrap_or_default();
        let line = line.split(|byte| matches!(byte, b'\r' | b'\n')).next().unwrap_or_default();
        let inked = line.trim_ascii_start();
        let starts = |word: &&&[u8]| inked.len() > word.len() && inked.starts_with(word);
        if let Some(word) = OF_THE_PATH.iter().find(starts) {
            let word = String::from_utf8_lossy(word);
            let at = from + line.len() - inked.len();
            let span = found.text_span(id, &(at..at + inked.len()));
            let message = format!(
                "the text before ends in `$`, so this `{word}` is a part of it and not run: the path may lack it"
            );
            return found.report(codes::POINTS_MISSING, span, message, "");
        }
    }
}

/// Returns the words of a program that clsmith does not know, in the order in which they appear.
pub fn list_unknown_words(program: &Program) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    for (_, statement) in program.live_statements() {
        match statement.record() {
            Record::ProgramEnd => break,
            Record::Other => {
                let word = parse::syntax(program.statement_text(statement)).major_word();
                if !word.is_empty() && !words.iter().any(|known| *known == word) {
                    words.push(word.into_owned());
                }
            }
            _ => {}
        }
    }
    words
}

fn add_statement(list: &mut Vec<(String, Vec<StatementId>)>, word: String, id: StatementId) {
    match list.iter_mut().find(|(known, _)| *known == word) {
        Some((_, statements)) => statements.push(id),
        None => list.push((word, vec![id])),
    }
}

/// Lists the lines of statements, the first few of them.
fn list_lines(statements: &[StatementId], found: &LintFindings<'_>) -> String {
    const MOST: usize = 10;
    let line = |id: &StatementId| found.program.source().line_column(found.statement_span(*id).start).0;
    let lines: Vec<String> = statements.iter().take(MOST).map(|id| line(id).to_string()).collect();
    let more = if statements.len() > MOST { ", ..." } else { "" };
    format!("lines {}{more}", lines.join(", "))
}
