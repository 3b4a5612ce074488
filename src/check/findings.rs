//! This module gives lints what they report with: facts about the whole file, and exact places in it.

use crate::diagnostic::{Diagnostic, DiagnosticCode};
use crate::number::format_trimmed_number;
use crate::parse;
use crate::program::geometry::{MotionPath, SAME_POINT};
use crate::program::motion::Motion;
use crate::program::record::ToolWord;
use crate::program::{
    LengthUnit, NumberRole, Program, Record, RecordKind, StatementChange, StatementId, StatementSyntax,
};
use crate::source::Span;
use std::ops::Range;

/// The facts about the whole file that a lint may need before it sees the statement in question.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct ProgramFacts {
    /// Whether a SPINDL occurs in the file.
    pub(crate) spindle: bool,
    /// Whether a tool is loaded, named or described in the file.
    pub(crate) tool: bool,
    /// Whether coolant is switched on in the file.
    pub(crate) coolant: bool,
    /// Whether it is a wire-erosion path, which has no spindle, no feed and no cutting edge.
    pub(crate) wire: bool,
    /// The unit of lengths, if the file states it.
    pub(crate) units: Option<LengthUnit>,
}

impl ProgramFacts {
    fn from_program(program: &Program) -> Self {
        let mut facts = Self::default();
        const KINDS: &[RecordKind] =
            &[RecordKind::Spindle, RecordKind::Tool, RecordKind::Structure, RecordKind::Other];
        for (_, statement) in program.live_statements_of(KINDS) {
            match statement.record() {
                Record::Spindle(_) => facts.spindle = true,
                Record::ToolCall(_) => facts.tool = true,
                Record::ToolData(data) => {
                    facts.tool = true;
                    facts.wire |= data.word == ToolWord::TlDataOther
                        && memchr::memmem::find(program.statement_text(statement), b"WEDM").is_some();
                }
                Record::Known => {
                    facts.coolant |= coolant_switch(program.statement_text(statement)) == Some(true)
                }
                Record::Units(units) => facts.units = facts.units.or(Some(*units)),
                _ => {}
            }
        }
        facts
    }
}

/// Returns whether a statement switches coolant on or off. Returns `None` if it is no COOLNT, or one with an
/// empty list (CATIA through ICAM), whose meaning only the post knows.
pub(crate) fn coolant_switch(text: &[u8]) -> Option<bool> {
    let rest = text.trim_ascii_start().strip_prefix(b"COOLNT")?;
    let word = rest.trim_ascii_start().strip_prefix(b"/").unwrap_or_default().trim_ascii();
    (!word.is_empty()).then_some(word != b"OFF")
}

/// The findings so far, and the places of statements.
#[derive(Debug)]
pub(crate) struct LintFindings<'p> {
    pub(crate) program: &'p Program,
    pub(crate) facts: ProgramFacts,
    list: Vec<Diagnostic>,
}

impl<'p> LintFindings<'p> {
    pub(crate) fn new(program: &'p Program) -> Self {
        Self::with_facts(program, ProgramFacts::from_program(program))
    }

    /// Makes an empty list for a program whose facts are known.
    pub(crate) fn with_facts(program: &'p Program, facts: ProgramFacts) -> Self {
        Self { program, facts, list: Vec::new() }
    }

    /// Takes the findings of other lints on the same program.
    pub(crate) fn append(&mut self, other: Self) {
        self.list.extend(other.list);
    }

    /// Returns the findings in the order of the file. Those about the whole file come last.
    pub(crate) fn finish(mut self) -> Vec<Diagnostic> {
        sort_findings(&mut self.list);
        self.list
    }

    pub(crate) fn push(&mut self, found: Diagnostic) {
        self.list.push(found);
    }

    /// Reports a finding at one place.
    pub(crate) fn report(
        &mut self,
        code: DiagnosticCode,
        span: Span,
        message: impl Into<String>,
        label: impl Into<String>,
    ) {
        let found = Diagnostic::new(code, message).with_label(self.program.source(), span, label);
        self.push(found);
    }

    /// Reports a finding at two places, the first of which is the primary one.
    pub(crate) fn report_at_two_spans(
        &mut self,
        code: DiagnosticCode,
        message: impl Into<String>,
        first: (Span, &str),
        second: (Span, &str),
    ) {
        let source = self.program.source();
        let found = Diagnostic::new(code, message)
            .with_label(source, first.0, first.1)
            .with_label(source, second.0, second.1);
        self.push(found);
    }

    /// Returns the text of a statement as it stands.
    pub(crate) fn statement_text(&self, id: StatementId) -> &'p [u8] {
        self.program.statement_text(self.program.statement(id))
    }

    /// Returns a statement, split into its parts by the grammar. It is slow, so it is only for statements
    /// with a finding.
    pub(crate) fn statement_syntax(&self, id: StatementId) -> StatementSyntax<'p> {
        parse::syntax(self.statement_text(id))
    }

    /// Returns a statement's bytes in the source, without the blanks and line ends around them.
    pub(crate) fn statement_span(&self, id: StatementId) -> Span {
        let statement = self.program.statement(id);
        let text = self.program.source().slice(statement.origin());
        let end = text.trim_ascii_end().len();
        let start = end - text.trim_ascii().len().min(end);
        statement.origin().sub_span(start, end)
    }

    /// Returns the place in the source of a range in a statement's text. A statement that a step has changed
    /// has no such place, so its whole place is returned.
    pub(crate) fn text_span(&self, id: StatementId, at: &Range<usize>) -> Span {
        let statement = self.program.statement(id);
        if statement.change() != StatementChange::Untouched || at.is_empty() {
            return self.statement_span(id);
        }
        statement.origin().sub_span(at.start, at.end)
    }

    /// Returns the place of a statement's major word.
    pub(crate) fn word_span(&self, id: StatementId) -> Span {
        self.text_span(id, &self.statement_syntax(id).word)
    }

    /// Returns the place from the first to the last of a range of a statement's numbers.
    pub(crate) fn numbers_span(&self, id: StatementId, range: Range<usize>) -> Span {
        let plain = plain_number_ranges(self.statement_text(id));
        let numbers = plain
            .unwrap_or_else(|| self.statement_syntax(id).numbers().into_iter().map(|(at, _)| at).collect());
        let last = range.end.min(numbers.len()).checked_sub(1);
        match (numbers.get(range.start), last.and_then(|last| numbers.get(last))) {
            (Some(first), Some(last)) => self.text_span(id, &(first.start..last.end)),
            _ => self.statement_span(id),
        }
    }

    /// Returns the place of a statement's first number with a role.
    pub(crate) fn role_span(&self, id: StatementId, role: NumberRole) -> Span {
        let syntax = self.statement_syntax(id);
        let roles = self.program.statement(id).record().number_roles(&syntax);
        match roles.iter().position(|&found| found == role) {
            Some(at) => self.numbers_span(id, at..at + 1),
            None => self.statement_span(id),
        }
    }

    /// Returns the place of the point at which a motion ends.
    pub(crate) fn end_point_span(&self, motion: &Motion) -> Span {
        let at = motion.last_statement();
        match self.program.statement(at).record() {
            // The numbers are centre, radius, the 2 of `2,INTOF` if there is one, and the two ends of the
            // LINE.
            Record::DriveArc(arc) if arc.beyond_half => self.numbers_span(at, 8..11),
            Record::DriveArc(_) => self.numbers_span(at, 7..10),
            record @ Record::AxialArc(_) => {
                let roles = record.number_roles(&self.statement_syntax(at));
                let end = roles.iter().rposition(|role| *role == NumberRole::Point(0)).unwrap_or(0);
                self.numbers_span(at, end..end + 3)
            }
            _ => self.numbers_span(at, 0..3),
        }
    }

    /// Returns whether a motion is at feed and goes somewhere. GOHOME does not count, because posts decide
    /// how to drive it.
    pub(crate) fn is_cutting_motion(&self, motion: &Motion) -> bool {
        if motion.rapid {
            return false;
        }
        match motion.path {
            MotionPath::Start => false,
            MotionPath::Line
                if (motion.to.point - motion.from.point).norm_squared() <= SAME_POINT * SAME_POINT =>
            {
                false
            }
            _ => !matches!(self.program.statement(motion.last_statement()).record(), Record::GoHome(_)),
        }
    }

    /// Formats a length with its unit, if the file states one.
    pub(crate) fn format_length(&self, value: f64) -> String {
        let unit = match self.facts.units {
            Some(LengthUnit::Mm) => " mm",
            Some(LengthUnit::Inch) => " in",
            None => "",
        };
        format!("{}{unit}", format_trimmed_number(value, 4))
    }

    /// Converts a length from millimetres to the file's unit.
    pub(crate) fn mm_to_file_unit(&self, value: f64) -> f64 {
        // A file that states no unit is measured in millimetres, as everywhere.
        value / self.facts.units.unwrap_or_default().mm_per_unit()
    }
}

/// Sorts findings by their places. Those about the whole file come last.
pub(super) fn sort_findings(list: &mut [Diagnostic]) {
    list.sort_by_key(|found| (found.labels.first().map_or(u32::MAX, |label| label.span.start), found.code));
}

/// Returns the places of the numbers of a plain GOTO without the grammar, because a file may have a finding
/// in each of a million statements. Returns `None` if there is anything but digits, commas and blanks after
/// the slash, or if the statement is continued.
fn plain_number_ranges(text: &[u8]) -> Option<Vec<Range<usize>>> {
    let slash = memchr::memchr(b'/', text)?;
    let rest = text.get(slash + 1..)?.trim_ascii_end();
    let mut numbers = Vec::with_capacity(6);
    let mut start = slash + 1;
    for field in rest.split(|byte| *byte == b',') {
        let number = field.trim_ascii();
        let plain = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'-');
        if number.is_empty() || !number.iter().all(plain) {
            return None;
        }
        let blank = field.len() - field.trim_ascii_start().len();
        numbers.push(start + blank..start + blank + number.len());
        start += field.len() + 1;
    }
    Some(numbers)
}

#[cfg(test)]
mod tests {
    use super::plain_number_ranges;

    #[test]
    fn plain_numbers_stand_where_the_grammar_finds_them() {
        for text in ["GOTO/1.5,-2,3\n", "GOTO  /    1.0,  2.0 , -.5  \r\n", "CIRCLE/ 1,2,3,0,0,1,5\n"] {
            let grammar: Vec<_> =
                crate::parse::syntax(text.as_bytes()).numbers().into_iter().map(|(at, _)| at).collect();
            assert_eq!(plain_number_ranges(text.as_bytes()), Some(grammar), "{text}");
        }
        for text in ["GOTO/1.0,$\n2.0,3.0\n", "SPINDL/RPM,1\n", "GOTO/1 2,3\n", "GOTO/1,,3\n", "RAPID\n"] {
            assert_eq!(plain_number_ranges(text.as_bytes()), None, "{text}");
        }
    }
}
