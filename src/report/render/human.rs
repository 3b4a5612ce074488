//! This module writes findings for people, drawn by miette.

use super::excerpt::{ExcerptMark, ExcerptOptions, SourceExcerpt};
use super::finding_groups::group_findings;
use super::{NO_FILE, SeverityCounts, describe_counts, line};
use crate::diagnostic::{Diagnostic, Severity};
use crate::presentation::safe_text;
use miette::{GraphicalReportHandler, GraphicalTheme, LabeledSpan, SourceCode};
use std::fmt;
use std::io::{self, Write};

/// Options about how findings are drawn. The caller sets them for its terminal, because this module does not
/// know of one.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub struct HumanRenderOptions {
    /// Whether to write ANSI colours.
    pub color: bool,
    /// Whether lines and arrows may be other than ASCII.
    pub unicode: bool,
    /// Columns of the terminal.
    pub width: usize,
    /// How many findings are shown of a group of more than three; 0 shows all.
    pub per_code: usize,
    /// Lines shown before and after a labelled one.
    pub context_lines: usize,
}

impl Default for HumanRenderOptions {
    fn default() -> Self {
        Self { color: false, unicode: true, width: 100, per_code: 1, context_lines: 1 }
    }
}

impl HumanRenderOptions {
    /// Returns the options with or without ANSI colours.
    #[must_use]
    pub fn with_color(mut self, color: bool) -> Self {
        self.color = color;
        self
    }

    /// Returns the options for lines and arrows in Unicode, or in ASCII.
    #[must_use]
    pub fn with_unicode(mut self, unicode: bool) -> Self {
        self.unicode = unicode;
        self
    }

    /// Returns the options for a terminal of so many columns.
    #[must_use]
    pub fn with_width(mut self, width: usize) -> Self {
        self.width = width;
        self
    }

    /// Returns the options that show so many findings of one code; 0 shows all.
    #[must_use]
    pub fn with_per_code(mut self, per_code: usize) -> Self {
        self.per_code = per_code;
        self
    }

    /// Returns the options that show so many lines before and after a labelled one.
    #[must_use]
    pub fn with_context_lines(mut self, context_lines: usize) -> Self {
        self.context_lines = context_lines;
        self
    }
}

/// Writes the findings with the lines that they are about. Of a large group, only the worst findings are
/// written, and then a line about those that are left out. A summary line follows, which also counts the
/// findings that were allowed by hand.
///
/// `file` is the file of the run, which the summary names.
///
/// ```
/// use clsmith::check::read_and_check;
/// use clsmith::report::render::human::{HumanRenderOptions, render_human};
/// use clsmith::source::Source;
///
/// let source = Source::new("part.cls", b"RAPID\nGOTO/10.000,12.5O00,-4.0000\n".to_vec())?;
/// let (_, findings) = read_and_check(&source, None);
/// let mut text = Vec::new();
/// render_human(&mut text, &findings, Some("part.cls"), &HumanRenderOptions::default())?;
/// let text = String::from_utf8(text)?;
/// assert!(text.contains("`12.5O00` is not a number"), "{text}");
/// assert!(text.contains("part.cls:2:13"), "{text}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Returns the errors of the writer.
pub fn render_human(
    out: &mut dyn Write,
    diagnostics: &[Diagnostic],
    file: Option<&str>,
    options: &HumanRenderOptions,
) -> io::Result<()> {
    let handler = build_miette_handler(options);
    let groups = group_findings(diagnostics);
    let standing = groups.iter().filter(|group| !group.worst().is_allowed);
    // Findings keep their order even if that mixes groups, because people correct a file from its beginning
    // to its end.
    let mut shown: Vec<(&Diagnostic, Option<String>)> = Vec::new();
    for group in standing {
        let mut of_group: Vec<_> =
            group.shown(options.per_code).into_iter().map(|found| (found, None)).collect();
        if let Some((_, hidden)) = of_group.last_mut() {
            *hidden = group.describe_hidden(options.per_code);
        }
        shown.extend(of_group);
    }
    // The findings are in one slice, so the order of their addresses is their order.
    shown.sort_by_key(|(found, _)| std::ptr::from_ref(*found));
    for (found, hidden) in shown {
        let mut drawn = String::new();
        match handler.render_report(&mut drawn, &MietteFinding::new(found, options)) {
            Ok(()) => writeln!(out, "{drawn}")?,
            Err(fmt::Error) => writeln!(out, "{}\n", line::format_finding_line(found, file))?,
        }
        if let Some(hidden) = hidden {
            writeln!(out, "{hidden} (--max-per-code 0 shows all)\n")?;
        }
    }
    writeln!(out, "{}", format_summary(diagnostics, file, options.color))
}

fn format_summary(diagnostics: &[Diagnostic], file: Option<&str>, color: bool) -> String {
    let counts = describe_counts(diagnostics);
    let name = safe_text::to_safe_line(file.unwrap_or(NO_FILE));
    let paint = match SeverityCounts::from_findings(diagnostics) {
        _ if !color => return format!("{name}: {counts}"),
        SeverityCounts { errors: 1.., .. } => 31,
        SeverityCounts { warnings: 1.., .. } => 33,
        SeverityCounts { notes: 1.., .. } | SeverityCounts { allowed: 1.., .. } => 36,
        _ => 32,
    };
    format!("{name}: \u{1b}[{paint}m{counts}\u{1b}[0m")
}

fn build_miette_handler(options: &HumanRenderOptions) -> GraphicalReportHandler {
    let theme = match (options.unicode, options.color) {
        (true, true) => GraphicalTheme::unicode(),
        (true, false) => GraphicalTheme::unicode_nocolor(),
        (false, true) => GraphicalTheme::ascii(),
        (false, false) => GraphicalTheme::none(),
    };
    GraphicalReportHandler::new_themed(theme)
        .with_width(usable_width(options))
        .with_context_lines(options.context_lines)
        .without_syntax_highlighting()
}

/// The columns for line numbers, frame and a small margin.
const LINE_NUMBERS: usize = 16;

/// Returns the usable width. In a smaller one, text would be broken after every word.
fn usable_width(options: &HumanRenderOptions) -> usize {
    options.width.max(40)
}

/// A finding in miette's terms.
#[derive(Debug)]
struct MietteFinding<'a> {
    found: &'a Diagnostic,
    unicode: bool,
    excerpt: SourceExcerpt,
    marks: Vec<ExcerptMark>,
}

impl<'a> MietteFinding<'a> {
    fn new(found: &'a Diagnostic, options: &HumanRenderOptions) -> Self {
        // Lines that the terminal would wrap are cut instead, because an underline only fits a line that
        // stays whole.
        let columns = usable_width(options).saturating_sub(LINE_NUMBERS);
        let margin = (columns / 2).min(120);
        let view = ExcerptOptions {
            context: options.context_lines,
            whole_line: columns,
            margin,
            unicode: options.unicode,
        };
        let (excerpt, marks) = SourceExcerpt::new(&found.labels, &view);
        Self { found, unicode: options.unicode, excerpt, marks }
    }
}

impl fmt::Display for MietteFinding<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&safe_text::to_safe_paragraph(&self.found.message, self.unicode))
    }
}

impl std::error::Error for MietteFinding<'_> {}

impl miette::Diagnostic for MietteFinding<'_> {
    fn code<'b>(&'b self) -> Option<Box<dyn fmt::Display + 'b>> {
        let (severity, code) = (self.found.severity, self.found.code);
        Some(match self.found.step {
            Some(step) => Box::new(format!("{severity}[{code}] in step {step}")),
            None => Box::new(format!("{severity}[{code}]")),
        })
    }

    fn severity(&self) -> Option<miette::Severity> {
        Some(match self.found.severity {
            Severity::Error => miette::Severity::Error,
            Severity::Warning => miette::Severity::Warning,
            Severity::Note => miette::Severity::Advice,
        })
    }

    fn help<'b>(&'b self) -> Option<Box<dyn fmt::Display + 'b>> {
        let help = self.found.help.as_deref()?;
        Some(Box::new(safe_text::to_safe_paragraph(help, self.unicode)))
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        (!self.marks.is_empty()).then_some(&self.excerpt as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        Some(Box::new(self.marks.iter().map(|mark| {
            let message = (!mark.message.is_empty()).then(|| mark.message.clone());
            let span = (mark.range.start, mark.range.len());
            if mark.primary {
                LabeledSpan::new_primary_with_span(message, span)
            } else {
                LabeledSpan::new_with_span(message, span)
            }
        })))
    }
}
