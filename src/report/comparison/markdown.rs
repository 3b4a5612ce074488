//! This module writes a comparison as Markdown, for merge requests and change notes.

use super::Comparison;
use super::figure_columns::{build_operation_table, build_whole_table};
use crate::diagnostic::{Diagnostic, DiagnosticLabel};
use crate::program::RecordKind;
use crate::report::changes::{RecipeChanges, StepChanges};
use crate::report::escaping::escape_markdown;
use crate::report::render::describe_counts;
use crate::report::render::finding_groups::group_findings;
use crate::report::table::{Column, ColumnUnit, DisplayUnits, PrintedTable, TableLooks, TableValue};
use crate::report::text_format::format_counted;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Returns the comparison as Markdown, with tables as GitHub and GitLab read them. The same comparison gives
/// the same bytes.
pub fn to_markdown(comparison: &Comparison<'_>) -> String {
    let mut out = format!("## {}\n\n", escape_markdown(comparison.subject.program.source().name()));
    let _ = writeln!(out, "**{}**\n", escape_markdown(&comparison.verdict().sentence));
    let is_refused = comparison.subject.recipe.is_some() && comparison.subject.is_refused();
    let is_unchanged = comparison.changes.as_ref().is_some_and(RecipeChanges::is_empty);
    if let Some(changed) = comparison.describe_changes().filter(|_| !(is_refused && is_unchanged)) {
        let _ = writeln!(out, "{changed}\n");
    }
    append_findings(&mut out, comparison.subject.findings);
    out.push_str(&build_whole_table(comparison).to_markdown());
    append_steps(&mut out, comparison);
    append_operations(&mut out, comparison);
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

/// A step of the recipe and its number from 1.
struct NumberedStep<'a> {
    number: usize,
    step: &'a StepChanges,
}

fn step_columns<'a>() -> [Column<NumberedStep<'a>>; 4] {
    let unit = ColumnUnit::None;
    [
        Column::new("step", unit, |row: &NumberedStep<'a>| {
            TableValue::Text(format!("{}. {}", row.number, row.step.name).into())
        }),
        Column::new("edited", unit, |row: &NumberedStep<'a>| count_kinds(&row.step.edited)),
        Column::new("inserted", unit, |row: &NumberedStep<'a>| count_kinds(&row.step.inserted)),
        Column::new("deleted", unit, |row: &NumberedStep<'a>| count_kinds(&row.step.deleted)),
    ]
    .map(Column::left_aligned)
}

fn count_kinds(map: &BTreeMap<RecordKind, usize>) -> TableValue<'static> {
    let count = |(kind, number): (&RecordKind, &usize)| {
        format_counted(*number, kind.display_name(1), kind.display_name(2))
    };
    TableValue::Text(map.iter().map(count).collect::<Vec<_>>().join(", ").into())
}

/// Makes the table of the steps: what each edited, inserted and deleted, in words. Returns `None` if no step
/// ran, or the run stopped before any did.
pub(in crate::report) fn build_step_table(comparison: &Comparison<'_>) -> Option<PrintedTable> {
    let changes = comparison.changes.as_ref().filter(|changes| !changes.steps.is_empty())?;
    if comparison.subject.is_refused() && changes.is_empty() {
        return None;
    }
    let numbered = |(index, step)| NumberedStep { number: index + 1, step };
    let steps: Vec<NumberedStep<'_>> = changes.steps.iter().enumerate().map(numbered).collect();
    Some(PrintedTable::from_rows(&step_columns(), &steps, TableLooks::markup(DisplayUnits::MM)))
}

fn append_steps(out: &mut String, comparison: &Comparison<'_>) {
    if let Some(table) = build_step_table(comparison) {
        let _ = write!(out, "### Steps\n\n{}", table.to_markdown());
    }
}

fn append_operations(out: &mut String, comparison: &Comparison<'_>) {
    let _ = write!(out, "### Operations\n\n{}", build_operation_table(comparison).to_markdown());
}

fn append_findings(out: &mut String, findings: &[Diagnostic]) {
    out.push_str("### Findings\n\n");
    if findings.is_empty() {
        out.push_str("None.\n\n");
        return;
    }
    let _ = writeln!(out, "{}.\n", describe_counts(findings));
    for group in group_findings(findings) {
        for found in group.shown(1) {
            let place = found.labels.first().map(format_place).unwrap_or_default();
            let message = escape_markdown(&found.message);
            let allowed = if found.is_allowed { ", allowed by hand" } else { "" };
            let _ = writeln!(out, "- **{}{allowed}** {}{place}: {message}", found.severity, found.code);
        }
        if let Some(hidden) = group.describe_hidden(1) {
            let _ = writeln!(out, "  - {}", escape_markdown(&hidden));
        }
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
