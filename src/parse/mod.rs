//! This module reads bytes to a [`Program`], one statement at a time. The grammar defines how statements are read;
//! plain ones, which are nearly all, take shortcuts that agree with it.
//!
//! pest keeps a line index of its whole input, so it gets one statement at a time. If the grammar reports
//! that a statement continues past its window of lines, the window is doubled.

pub(crate) mod agreement;
pub(crate) mod columns;
mod foreign_files;
mod grammar;
mod plain_statement;
mod shortcut;
mod statement_limit;
mod statement_numbers;
mod statement_split;

use crate::diagnostic::{Diagnostic, codes};
use crate::program::record::{self, BadRecord};
use crate::program::{
    Dialect, DialectDetector, NumberRole, Program, Record, ShopVocabulary, StatementField, StatementKind,
    StatementSyntax,
};
use crate::source::{Source, Span};
use crate::threads::{both_ways, has_several_threads};
pub(crate) use statement_numbers::StatementNumbers;
use statement_split::{split_by_grammar, split_statement};
use std::ops::Range;
use std::sync::Arc;

/// The result of reading a file: always a program, and the findings on the way.
#[derive(Debug)]
#[non_exhaustive]
pub struct ParsedProgram {
    /// The program; its statements tile the source.
    pub program: Program,
    /// The findings, in the order of the file.
    pub diagnostics: Vec<Diagnostic>,
    /// Whether the file is not CL data at all. Then the only finding says so, and nothing else about the file
    /// is worth reporting.
    pub refused: bool,
}

/// Reads a whole file. `dialect` forces a dialect; otherwise it is detected.
///
/// No statement is refused: one that cannot be read is kept and reported. A file that is not CL data at all
/// (an APT part program, G-code, UTF-16 text) is kept as one statement with one finding.
///
/// ```
/// use clsmith::parse::parse;
/// use clsmith::source::Source;
///
/// let source = Source::new("part.cls", b"GOTO/1,2,3\nGOTO/4,,6)\n".to_vec())?;
/// let parsed = parse(&source, None);
/// assert!(!parsed.refused);
/// // What is wrong is reported where it stands, and it is kept byte for byte all the same.
/// assert_eq!(source.line_column(parsed.diagnostics[0].labels[0].span.start), (2, 10));
/// assert_eq!(parsed.program.to_bytes(), source.bytes());
/// # Ok::<(), clsmith::source::SourceTooLarge>(())
/// ```
pub fn parse(source: &Arc<Source>, dialect: Option<Dialect>) -> ParsedProgram {
    read_program(source, dialect)
}

/// Reads a whole file as [`parse()`] does, and gives the shop's own words their meanings.
pub fn parse_with_vocabulary(
    source: &Arc<Source>,
    dialect: Option<Dialect>,
    vocabulary: &Arc<ShopVocabulary>,
) -> ParsedProgram {
    let mut parsed = read_program(source, dialect);
    if vocabulary.is_empty() || parsed.refused {
        return parsed;
    }
    let mut found = Vec::new();
    parsed.program.set_vocabulary(vocabulary, |text, span| {
        // Only statements that begin with such a word are read again.
        vocabulary.find_word(text)?;
        match Record::read_shop_word(vocabulary, &split_statement(text, &mut Vec::new()).0)? {
            Ok(record) => Some(record),
            Err(problem) => {
                found.push(bad_record_finding(source, span, problem));
                None
            }
        }
    });
    if !found.is_empty() {
        parsed.diagnostics.extend(found);
        parsed.diagnostics.sort_by_key(|finding| finding.labels.first().map(|label| label.span.start));
    }
    parsed
}

/// Reads a whole file in the words of its dialect.
fn read_program(source: &Arc<Source>, dialect: Option<Dialect>) -> ParsedProgram {
    let bytes = source.bytes();
    let mut reader = StatementReader::new(source);
    // What a file is says more than that it is binary.
    let is_known = foreign_files::detect_foreign_file(bytes).is_some();
    if let Some(problem) = detect_non_text(bytes).filter(|_| !is_known) {
        return reader.refuse_file(Diagnostic::new(codes::NOT_TEXT, problem).with_label(
            source,
            Span::new(0, bytes.len().min(2)),
            "",
        ));
    }
    if let Some(problem) = foreign_files::detect_foreign_file(bytes) {
        let first = bytes.iter().take_while(|byte| !matches!(byte, b'\n' | b'\r')).count();
        let diagnostic = Diagnostic::new(codes::NOT_CL_DATA, problem);
        return reader.refuse_file(diagnostic.with_label(source, Span::new(0, first.min(80)), ""));
    }
    let mut start = 0;
    if bytes.starts_with(BYTE_ORDER_MARK) {
        reader.program.push(Record::ByteOrderMark, Span::new(0, 3));
        start = 3;
    }
    reader.read_all(start);
    if let Some(refusal) = reader.detect_part_program() {
        return reader.refuse_file(refusal);
    }
    reader.report_definitions();
    let dialect = dialect.unwrap_or_else(|| reader.detector.detected_dialect());
    reader.program.set_dialect(dialect);
    ParsedProgram { program: reader.program, diagnostics: reader.diagnostics, refused: false }
}

/// Returns all numbers of a statement with their places in its text, in the order of the text.
///
/// ```
/// use clsmith::parse::statement_numbers;
///
/// let numbers = statement_numbers(b"FEDRAT/MMPM,1200.0000\n");
/// assert_eq!(numbers, [(12..21, 1200.0)]);
/// ```
pub fn statement_numbers(text: &[u8]) -> Vec<(Range<usize>, f64)> {
    shortcut::plain_goto_numbers(text).unwrap_or_else(|| split_statement(text, &mut Vec::new()).0.numbers())
}

/// Returns the same for a text that is one plain GOTO line, as most statements are. Returns `None` for any
/// other text, which only the grammar can read.
pub(crate) fn plain_goto_numbers(text: &[u8]) -> Option<Vec<(Range<usize>, f64)>> {
    shortcut::plain_goto_numbers(text)
}

/// Returns the roles of those numbers; `record` is the meaning of the text.
pub fn number_roles(record: &Record, text: &[u8]) -> Vec<NumberRole> {
    match record {
        Record::Goto(goto) => record::path_roles(goto.axis.is_some()),
        _ => record.number_roles(&split_statement(text, &mut Vec::new()).0),
    }
}

/// Returns the meaning of a text that must be one whole statement.
///
/// # Errors
/// Returns the errors of [`read_record`], and an error if the text holds more than one statement.
pub(crate) fn read_whole_record(text: &[u8], vocabulary: &ShopVocabulary) -> Result<Record, BadRecord> {
    read_whole_record_in(text, vocabulary, &mut Vec::new())
}

/// Does the same for one text after the other: the fields may take the memory of `spare`, which is empty before and
/// after it.
pub(crate) fn read_whole_record_in(
    text: &[u8],
    vocabulary: &ShopVocabulary,
    spare: &mut Vec<StatementField>,
) -> Result<Record, BadRecord> {
    if let Some((goto, length)) = shortcut::read_plain_goto(text)
        && length == text.len()
    {
        return Ok(Record::Goto(goto));
    }
    if shortcut::provenance_comment_length(text) == Some(text.len()) {
        return Ok(Record::Comment);
    }
    let (record, mut syntax) = read_record_in(text, spare)?;
    let length = syntax.text.len();
    if length == text.len() && !syntax.open {
        let own = record.may_be_shop_word().then(|| Record::read_shop_word(vocabulary, &syntax)).flatten();
        *spare = std::mem::take(&mut syntax.fields);
        spare.clear();
        return own.unwrap_or(Ok(record));
    }
    let problem = "a statement ends before the text does, or goes on after it".to_owned();
    Err(BadRecord { at: length..text.len(), problem, is_number: false })
}

/// Reads the words and the meaning of one statement's text, which comes from an edit or a rewrite rule.
///
/// # Errors
/// Returns what is wrong with the text; refused text is an error too.
pub fn read_record(text: &[u8]) -> Result<(Record, StatementSyntax<'_>), BadRecord> {
    read_record_in(text, &mut Vec::new())
}

/// Does the same; the fields may take the memory of `spare`, which is empty.
fn read_record_in<'t>(
    text: &'t [u8],
    spare: &mut Vec<StatementField>,
) -> Result<(Record, StatementSyntax<'t>), BadRecord> {
    let syntax = split_statement(text, spare).0;
    if syntax.form == StatementKind::Refused {
        let at = grammar::find_refusal_offset(text).min(text.len().saturating_sub(1));
        let problem = "this is no CL statement".to_owned();
        return Err(BadRecord { at: at..text.len(), problem, is_number: false });
    }
    Record::read(&syntax).map(|record| (record, syntax))
}

/// The number of bytes at the start of a file that tell whether it is CL data; a byte order mark may stand before them.
pub(crate) const HEAD_LENGTH: usize = foreign_files::LOOKED_AT + BYTE_ORDER_MARK.len();

/// The mark that some editors put before UTF-8 text.
pub(crate) const BYTE_ORDER_MARK: &[u8] = b"\xEF\xBB\xBF";

/// Returns whether a file with such a head, of [`HEAD_LENGTH`] bytes or all that it has, is read statement by statement.
pub(crate) fn may_be_cl_data(head: &[u8]) -> bool {
    detect_non_text(head).is_none() && foreign_files::detect_foreign_file(head).is_none()
}

/// The number of bytes from which a second thread gains more than it costs.
const WORTH_A_THREAD: usize = 1 << 20;

/// The number of parts in which the second half of a long file is read.
const PARTS: usize = 8;

/// Finds a place behind `from` at which a statement begins, whatever stands before it: a word at the start of a
/// line, behind a line without `$`, for nothing else continues a statement. Such a statement needs no point before it.
fn find_border(bytes: &[u8], from: usize) -> Option<usize> {
    let mut line = from + memchr::memchr(b'\n', bytes.get(from..)?)? + 1;
    // A file without such a place near its middle has lines of another kind than clsmith knows.
    for _ in 0..1000 {
        let next = line + memchr::memchr(b'\n', bytes.get(line..)?)? + 1;
        let whole = memchr::memchr(b'$', bytes.get(line..next)?).is_none();
        if whole && bytes.get(next).is_some_and(u8::is_ascii_uppercase) {
            return Some(next);
        }
        line = next;
    }
    None
}

/// The state of reading a file.
struct StatementReader<'s> {
    source: &'s Arc<Source>,
    program: Program,
    diagnostics: Vec<Diagnostic>,
    detector: DialectDetector,
    last_was_points: bool,
    /// The places of definitions of an APT part program, without blanks and line ends.
    definitions: Vec<Span>,
    /// An empty list, whose memory the next statement's fields take.
    spare_fields: Vec<StatementField>,
}

impl<'s> StatementReader<'s> {
    fn new(source: &'s Arc<Source>) -> Self {
        Self {
            source,
            program: Program::new(Arc::clone(source)),
            diagnostics: Vec::new(),
            detector: DialectDetector::default(),
            last_was_points: false,
            definitions: Vec::new(),
            spare_fields: Vec::new(),
        }
    }

    /// Reads all statements from `start` on, a long file in two halves at once.
    fn read_all(&mut self, start: usize) {
        let bytes = self.source.bytes();
        let is_worth = bytes.len() >= WORTH_A_THREAD && has_several_threads();
        let border = if is_worth { find_border(bytes, bytes.len() / 2) } else { None };
        let Some(border) = border.filter(|border| *border > start) else {
            self.read_statements(start..bytes.len());
            return;
        };
        let source = self.source;
        let (end, behind) = both_ways(
            true,
            || self.read_statements(start..border),
            || Self::read_in_parts(source, border..bytes.len()),
        );
        if end == border {
            behind.into_iter().for_each(|part| self.append(part));
        } else {
            // A statement that is too long to be read reaches over the border.
            self.read_statements(end..bytes.len());
        }
    }

    /// Reads the statements behind a border in several parts, one after the other. So the memory of each part is free
    /// as soon as it was appended.
    fn read_in_parts(source: &'s Arc<Source>, all: Range<usize>) -> Vec<Self> {
        let most = (all.len() / PARTS).max(WORTH_A_THREAD);
        let mut parts: Vec<Self> = Vec::with_capacity(PARTS + 1);
        let mut at = all.start;
        while at < all.end {
            let mut part = Self::new(source);
            part.last_was_points = parts.last().is_some_and(|before| before.last_was_points);
            at = part.read_statements(at..(at + most).min(all.end));
            parts.push(part);
        }
        parts
    }

    /// Reads the statements that begin in a part of the file; returns the end of the last one.
    fn read_statements(&mut self, part: Range<usize>) -> usize {
        // A GOTO with six values has about 62 bytes, one with three values about 32.
        self.program.reserve(part.len() / 40);
        let bytes = self.source.bytes();
        let mut at = part.start;
        while let Some(rest) = bytes.get(at..).filter(|rest| !rest.is_empty() && at < part.end) {
            at += self.read_next(at, rest);
        }
        at
    }

    /// Reads one statement, plain ones by a shorter way, and returns its length.
    // Not a part of the loop, because a browser compiles a function anew, and better, once it was called often.
    #[inline(never)]
    fn read_next(&mut self, at: usize, rest: &[u8]) -> usize {
        // A plain GOTO is no mark of any dialect and neither are our own comments, so the detector need not see
        // them.
        if let Some((goto, length)) = shortcut::read_plain_goto(rest) {
            self.program.push(Record::Goto(goto), Span::new(at, at + length));
            self.last_was_points = true;
            return length;
        }
        if let Some(length) = shortcut::provenance_comment_length(rest) {
            self.program.push(Record::Comment, Span::new(at, at + length));
            self.last_was_points = false;
            return length;
        }
        self.read_statement(at, rest)
    }

    /// Adds what was read behind the end of this reader's part.
    fn append(&mut self, behind: Self) {
        self.program.append(behind.program);
        self.diagnostics.extend(behind.diagnostics);
        self.detector.append(&behind.detector);
        self.last_was_points = behind.last_was_points;
        self.definitions.extend(behind.definitions);
    }

    /// Reads one statement and returns its length.
    fn read_statement(&mut self, at: usize, rest: &[u8]) -> usize {
        let (mut syntax, length) = split_statement(rest, &mut self.spare_fields);
        let span = Span::new(at, at + length);
        let record = self.interpret_syntax(&syntax, span);
        if record == Record::Definition {
            let text = rest.get(..length).unwrap_or_default();
            let shown = span.sub_span(length - text.trim_ascii_start().len(), trimmed_length(text));
            self.definitions.push(shown);
        }
        if syntax.open {
            self.diagnostics.push(
                Diagnostic::new(codes::CONTINUES_PAST_END, "the statement continues, but the file ends here")
                    .with_label(self.source, Span::new(at, at + trimmed_length(rest)), "continued with `$`"),
            );
        }
        self.detector.observe_statement(&syntax, &record);
        // A line of bare numbers may only follow points, which it continues.
        self.last_was_points = matches!(record, Record::Goto(_) | Record::Points(_));
        self.program.push(record, span);
        self.spare_fields = std::mem::take(&mut syntax.fields);
        self.spare_fields.clear();
        length
    }

    /// Returns the finding that refuses an APT part program: a file of which no system is known, with as many
    /// definitions as motions or more. A stray definition among motions is a finding on its line.
    fn detect_part_program(&self) -> Option<Diagnostic> {
        let first = *self.definitions.first()?;
        let motions = self.program.statements().iter().filter(|statement| statement.record().is_motion());
        if self.detector.has_mark() || motions.count() > self.definitions.len() {
            return None;
        }
        let message = "this is an APT part program, not cutter-location data";
        let diagnostic = Diagnostic::new(codes::APT_PART_PROGRAM, message);
        Some(diagnostic.with_label(self.source, first, "geometry and variables are defined here"))
    }

    /// Reports definitions in CL data, each on its line.
    fn report_definitions(&mut self) {
        for place in std::mem::take(&mut self.definitions) {
            let message = "this statement defines something, which only APT part programs and posts do";
            let finding = Diagnostic::new(codes::MALFORMED, message);
            self.diagnostics.push(finding.with_label(self.source, place, "no CL data"));
        }
        self.diagnostics.sort_by_key(|finding| finding.labels.first().map(|label| label.span.start));
    }

    /// Returns the meaning of a statement, or [`Record::Unparsed`] with a finding if it has none.
    fn interpret_syntax(&mut self, syntax: &StatementSyntax<'_>, span: Span) -> Record {
        let problem = match syntax.form {
            StatementKind::Refused => {
                self.diagnostics.push(malformed_finding(self.source, syntax.text, span));
                return Record::Unparsed;
            }
            StatementKind::Numbers if !self.last_was_points => BadRecord {
                at: 0..trimmed_length(syntax.text),
                problem: "bare numbers, but no GOTO before them to continue".to_owned(),
                is_number: false,
            },
            _ => match Record::read(syntax) {
                Ok(record) => return record,
                Err(problem) => problem,
            },
        };
        self.diagnostics.push(bad_record_finding(self.source, span, problem));
        Record::Unparsed
    }

    /// Keeps the whole file as one unparsed statement with one finding.
    fn refuse_file(self, diagnostic: Diagnostic) -> ParsedProgram {
        let mut program = Program::new(Arc::clone(self.source));
        let bytes = self.source.bytes().len();
        if bytes > 0 {
            program.push(Record::Unparsed, Span::new(0, bytes));
        }
        ParsedProgram { program, diagnostics: vec![diagnostic], refused: true }
    }
}

/// Makes the finding for a word whose arguments do not fit.
fn bad_record_finding(source: &Arc<Source>, span: Span, problem: BadRecord) -> Diagnostic {
    let code = if problem.is_number { codes::BAD_NUMBER } else { codes::BAD_ARGUMENTS };
    let at = span.sub_span(problem.at.start, problem.at.end);
    Diagnostic::new(code, problem.problem).with_label(source, at, "")
}

/// Makes the finding for a statement that the grammar refuses.
fn malformed_finding(source: &Arc<Source>, text: &[u8], span: Span) -> Diagnostic {
    let end = trimmed_length(text);
    let at = grammar::find_refusal_offset(text).min(end.saturating_sub(1));
    Diagnostic::new(codes::MALFORMED, "this statement cannot be read").with_label(
        source,
        span.sub_span(at, end),
        "from here it makes no sense as CL data",
    )
}

/// Reads the statement at the start of `window`; the text of the result shows how many bytes it takes.
///
/// `window` holds whole lines. `StatementSyntax::open` says that the statement continues past the end of the
/// window. This never fails: text that fits no form of the grammar gets [`StatementKind::Refused`].
pub fn syntax(window: &[u8]) -> StatementSyntax<'_> {
    split_statement(window, &mut Vec::new()).0
}

/// Returns the length without the line end and the blanks before it.
fn trimmed_length(text: &[u8]) -> usize {
    text.trim_ascii_end().len()
}

/// Returns why bytes are not text, or `None` if they may be. More than a quarter of zero bytes means binary.
fn detect_non_text(bytes: &[u8]) -> Option<&'static str> {
    if bytes.starts_with(b"\xFF\xFE") || bytes.starts_with(b"\xFE\xFF") {
        return Some("the file is UTF-16 text");
    }
    // Zeros behind the last statement only fill a block of the disk.
    let filled = bytes.len() - bytes.iter().rev().take_while(|byte| **byte == 0).count();
    let length = if filled == 0 { bytes.len() } else { filled };
    let head = bytes.get(..length.min(4096)).unwrap_or(bytes);
    let zeros = memchr::memchr_iter(0, head).count();
    (zeros * 4 > head.len()).then_some("the file is binary, not text")
}
