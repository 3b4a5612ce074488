//! A comparison as Markdown, for merge requests and change notes.

use super::{Comparison, ComparisonFigures, ComparisonPeak, ComparisonRow};
use crate::diagnostic::{Diagnostic, DiagnosticLabel};
use crate::presentation::safe_text::to_safe_line;
use crate::program::RecordKind;
use crate::report::changes::StepChanges;
use crate::report::text_format::{format_count, format_counted, format_duration, format_fixed, format_short};
use crate::transform::PROVENANCE;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Findings that are listed; the rest is counted.
const MOST_FINDINGS: usize = 50;

/// The comparison as Markdown (GitHub's and GitLab's tables). The same comparison makes the same bytes.
pub fn to_markdown(comparison: &Comparison<'_>) -> String {
    let mut out = format!("## {}\n\n", escape_markdown(comparison.subject.program.source().name()));
    match &comparison.changes {
        Some(changes) if changes.is_empty() => out.push_str("Nothing was changed.\n\n"),
        Some(changes) => {
            let sum = |comments: bool| -> usize {
                let steps = changes.steps.iter().filter(|step| (step.name == PROVENANCE) == comments);
                steps.flat_map(change_maps).map(|map| map.values().sum::<usize>()).sum()
            };
            let said = match sum(true) {
                0 => String::new(),
                said => format!("{} about the run, ", format_counted(said, "comment", "comments")),
            };
            let _ = writeln!(
                out,
                "{} changed, {said}{} untouched.\n",
                format_counted(sum(false), "statement", "statements"),
                format_count(changes.untouched as u64)
            );
        }
        None => {}
    }
    append_whole_program(&mut out, comparison);
    append_steps(&mut out, comparison);
    append_operations(&mut out, comparison);
    append_findings(&mut out, comparison.subject.findings);
    append_list(&mut out, "Not shown", &comparison.runs.missing);
    append_list(&mut out, "Assumed", &comparison.assumptions);
    let _ = writeln!(out, "<sub>clsmith {}", env!("CARGO_PKG_VERSION"));
    for part in &comparison.parts {
        let _ = writeln!(
            out,
            "<br>{} {} sha256 {}",
            part.what.display_name(),
            escape_markdown(&part.name),
            part.sha256
        );
    }
    if let Some(print) = comparison.subject.print {
        let _ = writeln!(out, "<br>recipe and files sha256 {}", escape_markdown(print));
    }
    out.push_str("</sub>\n");
    out
}

/// A name of a column, the value in it, and its decimals.
type FigureRow = (&'static str, fn(&ComparisonFigures) -> Option<f64>, fn(f64) -> String);

/// What is told of the whole program after its time at feed.
const WHOLE: &[FigureRow] = &[
    ("time at rapid", |figures| figures.rapid_seconds, format_duration),
    ("length at feed, mm", |figures| Some(figures.feed_mm), |value| format_fixed(value, 1)),
    ("length at rapid, mm", |figures| Some(figures.rapid_mm), |value| format_fixed(value, 1)),
    ("slowest feed, mm/min", |figures| figures.feed_range_mm_min.map(|[low, _]| low), format_short),
    ("fastest feed, mm/min", |figures| figures.feed_range_mm_min.map(|[_, high]| high), format_short),
    ("thickest chip, mm", |figures| peak_value(figures.chip_thickness_mm), |value| format_fixed(value, 4)),
    (
        "largest removal rate, mm³/min",
        |figures| peak_value(figures.removal_rate_mm3_min),
        |value| format_fixed(value, 0),
    ),
    ("largest force, N", |figures| peak_value(figures.force_n), |value| format_fixed(value, 0)),
    ("largest torque, N m", |figures| peak_value(figures.torque_nm), |value| format_fixed(value, 2)),
    ("largest power, kW", |figures| peak_value(figures.power_kw), |value| format_fixed(value, 3)),
];

fn peak_value(peak: Option<ComparisonPeak>) -> Option<f64> {
    peak.map(|peak| peak.value)
}

/// The rows of the table of the whole program: name, before, after, change. Rows nobody knows anything of are left out.
pub(in crate::report) fn build_whole_rows(comparison: &Comparison<'_>) -> Vec<[String; 4]> {
    let row = &comparison.whole;
    let told = |(name, value, print): &FigureRow| {
        let (before, after) = (row.before.as_ref().and_then(value), row.after.as_ref().and_then(value));
        let cell = |value: Option<f64>| value.map(print).unwrap_or_default();
        (before.is_some() || after.is_some())
            .then(|| [(*name).to_owned(), cell(before), cell(after), format_percent_change(before, after)])
    };
    let seconds = |side: &Option<ComparisonFigures>| side.as_ref().map(|figures| figures.feed_seconds);
    let timed = |side: &Option<ComparisonFigures>| side.as_ref().map(format_feed_time).unwrap_or_default();
    let change = format_percent_change(seconds(&row.before), seconds(&row.after));
    let feed = ["time at feed".to_owned(), timed(&row.before), timed(&row.after), change];
    std::iter::once(feed).chain(WHOLE.iter().filter_map(told)).collect()
}

/// `+12.5 %`; nothing where that means nothing.
pub(in crate::report) fn format_percent_change(before: Option<f64>, after: Option<f64>) -> String {
    let Some((before, after)) = before.zip(after) else { return String::new() };
    let change = (after / before - 1.0) * 100.0;
    if change.is_finite() && change.abs() >= 0.05 { format!("{change:+.1} %") } else { String::new() }
}

/// A column of the table of operations: its name, and its text for one program.
type FigureColumn = (&'static str, fn(&ComparisonFigures) -> String);

const FEEDS: FigureColumn = ("feed, mm/min", format_feed_range);
const CHIP: FigureColumn = ("thickest chip, mm", |figures| format_peak(figures.chip_thickness_mm, 4));
const POWER: FigureColumn = ("power, kW", |figures| format_peak(figures.power_kw, 3));

/// The head of the table of operations, and its rows. What is known of both programs takes two columns.
pub(in crate::report) fn build_operation_rows(
    comparison: &Comparison<'_>,
) -> (Vec<String>, Vec<Vec<String>>) {
    let both = comparison.subject.before.is_some();
    let mut columns = vec![("time", format_feed_time as fn(&ComparisonFigures) -> String), FEEDS];
    columns.extend(has_figure(comparison, |figures| figures.chip_thickness_mm.is_some()).then_some(CHIP));
    columns.extend(has_figure(comparison, |figures| figures.power_kw.is_some()).then_some(POWER));
    let mut head = ["operation", "tool", "motions"].map(str::to_owned).to_vec();
    for (name, _) in &columns {
        head.push((*name).to_owned());
        if both {
            head.push("after".to_owned());
        }
    }
    if both {
        head.insert(5, "change".to_owned());
    }
    let row = |name: &str, row: &ComparisonRow| {
        let motions = row.after.as_ref().or(row.before.as_ref()).map_or(0, |figures| figures.motions);
        let mut cells =
            vec![to_safe_line(name), to_safe_line(&row.tools.join(", ")), format_count(motions as u64)];
        for (_, text) in &columns {
            let told = |side: &Option<ComparisonFigures>| side.as_ref().map(text).unwrap_or_default();
            cells.extend(both.then(|| told(&row.before)));
            cells.push(told(&row.after));
        }
        if both {
            let seconds =
                |side: &Option<ComparisonFigures>| side.as_ref().map(|figures| figures.feed_seconds);
            cells.insert(5, format_percent_change(seconds(&row.before), seconds(&row.after)));
        }
        cells
    };
    let mut rows: Vec<Vec<String>> = comparison.operations.iter().map(|one| row(&one.name, one)).collect();
    if rows.len() > 1 {
        rows.push(row("all", &comparison.whole));
    }
    (head, rows)
}

fn format_peak(peak: Option<ComparisonPeak>, decimals: usize) -> String {
    peak.map(|peak| format_fixed(peak.value, decimals)).unwrap_or_default()
}

fn has_figure(comparison: &Comparison<'_>, what: impl Fn(&ComparisonFigures) -> bool) -> bool {
    [&comparison.whole.before, &comparison.whole.after].into_iter().flatten().any(what)
}

/// A time that leaves motions out is a lower bound, and says so.
fn format_feed_time(figures: &ComparisonFigures) -> String {
    format!("{}{}", if figures.untimed > 0 { "> " } else { "" }, format_duration(figures.feed_seconds))
}

fn format_feed_range(figures: &ComparisonFigures) -> String {
    match figures.feed_range_mm_min {
        Some([low, high]) if format_short(low) == format_short(high) => format_short(low),
        Some([low, high]) => format!("{} to {}", format_short(low), format_short(high)),
        None => String::new(),
    }
}

fn append_whole_program(out: &mut String, comparison: &Comparison<'_>) {
    let rows = build_whole_rows(comparison);
    if comparison.subject.before.is_some() {
        append_table(out, &["", "before", "after", "change"], rows.iter().map(|row| row.to_vec()));
    } else {
        append_table(
            out,
            &["", "value"],
            rows.iter().map(|[name, _, after, _]| vec![name.clone(), after.clone()]),
        );
    }
}

fn change_maps(step: &StepChanges) -> [&BTreeMap<RecordKind, usize>; 3] {
    [&step.edited, &step.inserted, &step.deleted]
}

/// What a step edited, inserted and deleted, in words.
pub(in crate::report) fn build_step_row(step: &StepChanges) -> [String; 3] {
    change_maps(step).map(|map| {
        let words = map
            .iter()
            .map(|(kind, number)| format_counted(*number, kind.display_name(1), kind.display_name(2)));
        words.collect::<Vec<_>>().join(", ")
    })
}

fn append_steps(out: &mut String, comparison: &Comparison<'_>) {
    let Some(changes) = comparison.changes.as_ref().filter(|changes| !changes.steps.is_empty()) else {
        return;
    };
    out.push_str("### Steps\n\n");
    let rows = changes.steps.iter().enumerate().map(|(index, step)| {
        let mut row = vec![format!("{}. {}", index + 1, step.name)];
        row.extend(build_step_row(step));
        row
    });
    append_table(out, &["step", "edited", "inserted", "deleted"], rows);
}

fn append_operations(out: &mut String, comparison: &Comparison<'_>) {
    out.push_str("### Operations\n\n");
    let (head, rows) = build_operation_rows(comparison);
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    append_table(out, &head, rows.into_iter());
}

fn append_findings(out: &mut String, findings: &[Diagnostic]) {
    out.push_str("### Findings\n\n");
    if findings.is_empty() {
        out.push_str("None.\n\n");
        return;
    }
    for found in findings.iter().take(MOST_FINDINGS) {
        let place = found.labels.first().map(format_place).unwrap_or_default();
        let message = escape_markdown(&found.message);
        let _ = writeln!(out, "- **{}** {}{place}: {message}", found.severity, found.code);
    }
    if findings.len() > MOST_FINDINGS {
        let _ = writeln!(out, "- and {} more", findings.len() - MOST_FINDINGS);
    }
    out.push('\n');
}

fn format_place(label: &DiagnosticLabel) -> String {
    let (line, column) = label.source.line_column(label.span.start);
    format!(" {}:{line}:{column}", escape_markdown(label.source.name()))
}

fn append_list(out: &mut String, title: &str, sentences: &[String]) {
    if sentences.is_empty() {
        return;
    }
    let _ = writeln!(out, "### {title}\n");
    for sentence in sentences {
        let _ = writeln!(out, "- {}", escape_markdown(sentence));
    }
    out.push('\n');
}

/// A table; numbers stand to the right.
fn append_table(out: &mut String, head: &[&str], rows: impl Iterator<Item = Vec<String>>) {
    let line = |cells: &mut dyn Iterator<Item = String>| {
        let cells: Vec<String> = cells.collect();
        format!("| {} |\n", cells.join(" | "))
    };
    out.push_str(&line(&mut head.iter().map(|cell| (*cell).to_owned())));
    out.push_str(&line(
        &mut (0..head.len()).map(|column| if column == 0 { "---" } else { "---:" }.to_owned()),
    ));
    for row in rows {
        out.push_str(&line(&mut row.iter().map(|cell| escape_markdown(cell))));
    }
    out.push('\n');
}

/// Text of a file as Markdown that shows it and does nothing else.
fn escape_markdown(text: &str) -> String {
    let mut out = String::new();
    for c in to_safe_line(text).chars() {
        if matches!(
            c,
            '\\' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '|' | '~' | '#' | '&' | '$' | '@' | '!'
        ) {
            out.push('\\');
        }
        out.push(c);
    }
    out
}
