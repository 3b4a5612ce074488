//! This module makes an excerpt of the few lines of a large file that a finding is about.
//!
//! miette finds lines by scanning a source from its start, which takes a second per finding in a file of 100
//! MB. So it gets an excerpt instead: the labelled lines and their neighbours, decoded, in one text with its
//! own offsets. An excerpt may contain lines of several files, each under its own name, because a single
//! finding can point into a CL file and into a recipe.

use crate::diagnostic::DiagnosticLabel;
use crate::presentation::safe_text;
use crate::source::{Source, Span};
use miette::{MietteError, SourceCode, SourceSpan, SpanContents};
use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::Arc;

/// Labels over more lines than this are shown by their first and last line.
const WHOLE_LABEL: usize = 8;

/// The options of an excerpt.
pub(super) struct ExcerptOptions {
    /// Lines before and after a labelled one.
    pub context: usize,
    /// Lines up to this many bytes are shown completely.
    pub whole_line: usize,
    /// The number of bytes on either side of a label's ends that are kept in a longer line.
    pub margin: usize,
    /// Whether replacements may be other than ASCII.
    pub unicode: bool,
}

/// Lines of one or more files in the form that miette reads.
#[derive(Debug)]
pub(super) struct SourceExcerpt {
    text: String,
    lines: Vec<ExcerptLine>,
    /// The starts of marks, with their column in the file.
    columns: Vec<(usize, usize)>,
}

/// A label in the offsets of the excerpt.
#[derive(Debug)]
pub(super) struct ExcerptMark {
    pub range: Range<usize>,
    pub message: String,
    pub primary: bool,
}

#[derive(Debug)]
struct ExcerptLine {
    /// Its start in the excerpt.
    at: usize,
    /// Its line number in its file, counted from 1.
    number: usize,
    /// Lines of one block are consecutive lines of a file.
    block: usize,
    file: String,
    /// Offsets in the file with their offsets in the excerpt, both ascending.
    places: Vec<(usize, usize)>,
}

/// A label, or one end of a long one.
struct ExcerptLabelPart<'a> {
    source: &'a Arc<Source>,
    span: Span,
    lines: (usize, usize),
    message: String,
    primary: bool,
}

impl SourceExcerpt {
    /// Makes the excerpt of the lines around the labels, with the labels as marks.
    pub(super) fn new(labels: &[DiagnosticLabel], view: &ExcerptOptions) -> (Self, Vec<ExcerptMark>) {
        let pieces: Vec<ExcerptLabelPart<'_>> =
            labels.iter().enumerate().flat_map(|(index, label)| split_label(label, index == 0)).collect();
        let mut excerpt = Self { text: String::new(), lines: Vec::new(), columns: Vec::new() };
        let mut marks = Vec::new();
        let mut files: Vec<&Arc<Source>> = Vec::new();
        for piece in &pieces {
            if files.iter().any(|file| Arc::ptr_eq(file, piece.source)) {
                continue;
            }
            files.push(piece.source);
            let here: Vec<&ExcerptLabelPart<'_>> =
                pieces.iter().filter(|other| Arc::ptr_eq(other.source, piece.source)).collect();
            excerpt.add_file(piece.source, &here, view, &mut marks);
        }
        (excerpt, marks)
    }

    fn add_file(
        &mut self,
        source: &Source,
        pieces: &[&ExcerptLabelPart<'_>],
        view: &ExcerptOptions,
        marks: &mut Vec<ExcerptMark>,
    ) {
        let first = self.lines.len();
        let mut before = None;
        for number in choose_lines(source, pieces, view.context) {
            let block =
                self.lines.last().map_or(0, |line| line.block + usize::from(before != Some(number - 1)));
            self.add_line(source, number, block, pieces, view);
            before = Some(number);
        }
        let lines = self.lines.get(first..).unwrap_or_default();
        for piece in pieces {
            let range = piece.span.to_range();
            let on = |number| lines.iter().find(|line| line.number == number);
            let (Some(start), Some(end)) = (on(piece.lines.0), on(piece.lines.1)) else { continue };
            let start = start.excerpt_offset_before(range.start);
            let end = if range.is_empty() { start } else { end.excerpt_offset_after(range.end) };
            self.columns.push((start, source.line_column(piece.span.start).1));
            marks.push(ExcerptMark {
                range: start..end.max(start),
                message: safe_text::to_safe_paragraph(&piece.message, view.unicode),
                primary: piece.primary,
            });
        }
    }

    fn add_line(
        &mut self,
        source: &Source,
        number: usize,
        block: usize,
        pieces: &[&ExcerptLabelPart<'_>],
        view: &ExcerptOptions,
    ) {
        let Some(line) = source.line_span(number).map(Span::to_range) else { return };
        let at = self.text.len();
        let mut places = Vec::new();
        let mut shown = line.start;
        let dots = if view.unicode { "…" } else { "..." };
        for part in choose_line_parts(source, line.clone(), pieces, view) {
            if part.start > shown {
                self.text.push_str(dots);
            }
            shown = part.start;
            for (c, length) in
                safe_text::decode_characters(source.bytes().get(part.clone()).unwrap_or_default())
            {
                places.push((shown, self.text.len()));
                self.text.push(safe_text::to_visible_character(c, view.unicode));
                shown += length;
            }
            places.push((part.end, self.text.len()));
        }
        if shown < line.end {
            self.text.push_str(dots);
        }
        self.text.push('\n');
        let file = safe_text::to_safe_paragraph(source.name(), view.unicode).replace('\n', " ");
        self.lines.push(ExcerptLine { at, number, block, file, places });
    }

    fn line_index_at(&self, offset: usize) -> Option<usize> {
        self.lines.partition_point(|line| line.at <= offset).checked_sub(1)
    }
}

impl ExcerptLine {
    /// Returns the start of the character that contains this byte.
    fn excerpt_offset_before(&self, offset: usize) -> usize {
        let after = self.places.partition_point(|&(from, _)| from <= offset);
        after.checked_sub(1).and_then(|index| self.places.get(index)).map_or(self.at, |&(_, to)| to)
    }

    /// Returns the start of the first character at or after this byte. Beyond the last one, it is the end of
    /// the line.
    fn excerpt_offset_after(&self, offset: usize) -> usize {
        let index = self.places.partition_point(|&(from, _)| from < offset);
        self.places.get(index).or(self.places.last()).map_or(self.at, |&(_, to)| to)
    }
}

fn split_label(label: &DiagnosticLabel, primary: bool) -> Vec<ExcerptLabelPart<'_>> {
    let source = &label.source;
    let span = safe_text::trim_line_end(source, label.span);
    let first = source.line_column(span.start).0;
    let last = if span.is_empty() { first } else { source.line_column(span.end - 1).0 };
    let piece = |span, lines, message: &str, primary| ExcerptLabelPart {
        source,
        span,
        lines,
        message: message.to_owned(),
        primary,
    };
    match (source.line_span(first), source.line_span(last)) {
        (Some(head), Some(tail)) if last - first >= WHOLE_LABEL => vec![
            piece(
                Span { start: span.start, end: head.end.max(span.start) },
                (first, first),
                &label.message,
                primary,
            ),
            piece(Span { start: tail.start, end: span.end }, (last, last), "up to here", false),
        ],
        _ => vec![piece(span, (first, last), &label.message, primary)],
    }
}

fn choose_lines(source: &Source, pieces: &[&ExcerptLabelPart<'_>], context: usize) -> BTreeSet<usize> {
    let labelled = |number| pieces.iter().any(|piece| (piece.lines.0..=piece.lines.1).contains(&number));
    // A file that ends in a line end has an empty line after it, which is only shown if a label points at it.
    let shown = |number: &usize| {
        labelled(*number)
            || source
                .line_span(*number)
                .is_some_and(|line| !line.is_empty() || source.line_span(*number + 1).is_some())
    };
    pieces
        .iter()
        .flat_map(|piece| {
            piece.lines.0.saturating_sub(context).max(1)..=piece.lines.1.saturating_add(context)
        })
        .filter(shown)
        .collect()
}

/// Returns the parts of a line to show: all of a short line, and the surroundings of the labels' ends in a
/// long one.
fn choose_line_parts(
    source: &Source,
    line: Range<usize>,
    pieces: &[&ExcerptLabelPart<'_>],
    view: &ExcerptOptions,
) -> Vec<Range<usize>> {
    if line.len() <= view.whole_line {
        return vec![line];
    }
    let ends = pieces.iter().flat_map(|piece| [piece.span.to_range().start, piece.span.to_range().end]);
    let mut ends: Vec<usize> = ends.filter(|end| (line.start..=line.end).contains(end)).collect();
    ends.sort_unstable();
    if ends.is_empty() {
        ends.push(line.start);
    }
    let mut parts: Vec<Range<usize>> = Vec::new();
    for end in ends {
        let from = floor_to_character(source, end.saturating_sub(view.margin).max(line.start), line.start);
        let to = (end + view.margin).min(line.end);
        match parts.last_mut() {
            Some(last) if from <= last.end => last.end = last.end.max(to),
            _ => parts.push(from..to),
        }
    }
    for part in &mut parts {
        part.end = floor_to_character(source, part.end, part.start);
    }
    parts
}

/// Moves a cut from inside a UTF-8 character back to its start.
fn floor_to_character(source: &Source, at: usize, lowest: usize) -> usize {
    let inside = |at: usize| source.bytes().get(at).is_some_and(|byte| (0x80..0xc0).contains(byte));
    (0..4).map(|back| at.saturating_sub(back)).find(|&at| !inside(at)).map_or(at, |start| start.max(lowest))
}

impl SourceCode for SourceExcerpt {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let lines = self.line_index_at(span.offset()).zip(self.line_index_at(span.offset() + span.len()));
        let (mut first, mut last) = lines.ok_or(MietteError::OutOfBounds)?;
        let block = |index: usize| self.lines.get(index).map(|line| line.block);
        // miette asks for two labels at once to find out whether they are in the same snippet.
        if block(first) != block(last) {
            return Err(MietteError::OutOfBounds);
        }
        for _ in 0..before {
            first -= usize::from(first > 0 && block(first - 1) == block(first));
        }
        for _ in 0..after {
            last += usize::from(block(last + 1) == block(last));
        }
        let start = self.lines.get(first).ok_or(MietteError::OutOfBounds)?;
        let end = self.lines.get(last + 1).map_or(self.text.len(), |next| next.at);
        let column =
            self.columns.iter().find(|(at, _)| *at == span.offset()).map_or(0, |(_, column)| column - 1);
        Ok(Box::new(ExcerptContents {
            data: self.text.as_bytes().get(start.at..end).ok_or(MietteError::OutOfBounds)?,
            span: (start.at, end - start.at).into(),
            line: start,
            column,
            lines: last + 1 - first,
        }))
    }
}

struct ExcerptContents<'a> {
    data: &'a [u8],
    span: SourceSpan,
    line: &'a ExcerptLine,
    column: usize,
    lines: usize,
}

impl<'a> SpanContents<'a> for ExcerptContents<'a> {
    fn data(&self) -> &'a [u8] {
        self.data
    }
    fn span(&self) -> &SourceSpan {
        &self.span
    }
    fn name(&self) -> Option<&str> {
        Some(&self.line.file)
    }
    fn line(&self) -> usize {
        self.line.number - 1
    }
    fn column(&self) -> usize {
        self.column
    }
    fn line_count(&self) -> usize {
        self.lines
    }
}
