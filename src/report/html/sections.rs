//! This module writes the parts of the page that are plain text and tables.

use crate::diagnostic::{Diagnostic, Severity};
use crate::presentation::safe_text::to_safe_line;
use crate::report::comparison::{
    ComparedFile, Comparison, build_operation_table, build_step_table, build_whole_table,
};
use crate::report::escaping::escape_html;
use crate::report::render::describe_counts;
use crate::report::render::finding_groups::group_findings;
use crate::report::render::human::{self, HumanRenderOptions};
use crate::report::table::{Column, ColumnUnit, DisplayUnits, PrintedTable, TableLooks, TableValue};
use crate::report::text_format::format_count;
use crate::source::Source;
use std::io::{self, Write};
use std::sync::Arc;

/// The largest number of findings of a group that are shown in full. Of the others, only the lines are
/// listed.
const PER_GROUP: usize = 10;

/// Writes a section by its name in the template. `drawing` are sentences about what is not drawn or is
/// simplified.
///
/// # Errors
/// Returns the errors of `out`, and an error for a section that does not exist.
pub(super) fn write_section(
    section: &str,
    comparison: &Comparison<'_>,
    drawing: &[String],
    out: &mut dyn Write,
) -> io::Result<()> {
    match section {
        "lead" => write_lead(comparison, out),
        "parts" => write_compared_files(comparison, out),
        "whole" => build_whole_table(comparison).write_html(out),
        "units" => write_units(comparison, out),
        "steps" => write_steps(comparison, out),
        "operations" => build_operation_table(comparison).write_html(out),
        "findings" => write_findings(comparison, out),
        "assumptions" => write_assumptions(comparison, drawing, out),
        "texts" => write_source_texts(comparison, out),
        _ => Err(io::Error::other(format!("the page has no section {section}"))),
    }
}

fn write_lead(comparison: &Comparison<'_>, out: &mut dyn Write) -> io::Result<()> {
    let subject = &comparison.subject;
    let name = escape_html(&to_safe_line(subject.program.source().name()));
    let dialect = escape_html(subject.program.dialect().display_name());
    match &comparison.changes {
        Some(changes) if changes.is_empty() => {
            write!(out, "{dialect}. Nothing was changed: every byte of {name} is as it was.")
        }
        Some(changes) => {
            write!(out, "{dialect}. {} statements are as they were.", format_count(changes.untouched as u64))
        }
        None => write!(out, "{dialect}."),
    }
}

fn write_compared_files(comparison: &Comparison<'_>, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "<p>clsmith {}</p>", env!("CARGO_PKG_VERSION"))?;
    if let Some(print) = comparison.subject.print {
        writeln!(out, "<p>Recipe and files: SHA-256 {}</p>", escape_html(print))?;
    }
    PrintedTable::from_rows(&file_columns(), &comparison.parts, TableLooks::markup(DisplayUnits::MM))
        .write_html(out)
}

fn file_columns() -> [Column<ComparedFile>; 4] {
    let unit = ColumnUnit::None;
    [
        Column::new("what", unit, |part: &ComparedFile| TableValue::text(part.what.display_name()))
            .titled("")
            .left_aligned(),
        Column::new("file", unit, |part: &ComparedFile| TableValue::text(&part.name)).left_aligned(),
        Column::new("bytes", unit, |part: &ComparedFile| TableValue::Count(part.bytes as usize)),
        Column::new("sha256", unit, |part: &ComparedFile| TableValue::text(&part.sha256)).titled("SHA-256"),
    ]
}

fn write_units(comparison: &Comparison<'_>, out: &mut dyn Write) -> io::Result<()> {
    let [length, feed] =
        [ColumnUnit::Length, ColumnUnit::FeedPerMinute].map(|unit| unit.symbol(comparison.units().shown_in));
    write!(out, "Lengths in {length}, feeds in {feed}.")
}

fn write_steps(comparison: &Comparison<'_>, out: &mut dyn Write) -> io::Result<()> {
    let Some(table) = build_step_table(comparison) else { return Ok(()) };
    out.write_all(b"<h2>Steps</h2>\n")?;
    table.write_html(out)?;
    for report in comparison.subject.reports {
        writeln!(out, "<pre>{}</pre>", escape_html(report.to_text(comparison.units()).trim_matches('\n')))?;
    }
    Ok(())
}

fn write_findings(comparison: &Comparison<'_>, out: &mut dyn Write) -> io::Result<()> {
    write_finding_list(out, "Of the run", comparison.subject.findings, comparison)?;
    // The findings of simulating the current program are already among the findings of the run.
    match &comparison.runs.before {
        Some(before) if !before.findings.is_empty() => {
            write_finding_list(out, "Of the simulation of the program before", &before.findings, comparison)
        }
        _ => Ok(()),
    }
}

fn write_finding_list(
    out: &mut dyn Write,
    title: &str,
    findings: &[Diagnostic],
    comparison: &Comparison<'_>,
) -> io::Result<()> {
    writeln!(out, "<h3>{}: {}</h3>", escape_html(title), escape_html(&describe_counts(findings)))?;
    for group in group_findings(findings) {
        for found in group.shown(PER_GROUP) {
            write_finding(out, found, comparison)?;
        }
        if let Some(hidden) = group.describe_hidden(PER_GROUP) {
            writeln!(out, "<p>{}</p>", escape_html(&hidden))?;
        }
    }
    Ok(())
}

/// Writes one finding. Its element carries the line, so that the scripts can jump to it.
fn write_finding(out: &mut dyn Write, found: &Diagnostic, comparison: &Comparison<'_>) -> io::Result<()> {
    let options = HumanRenderOptions { width: 120, ..HumanRenderOptions::default() };
    let mut drawn = Vec::new();
    let standing = Diagnostic { is_allowed: false, ..found.clone() };
    human::render_human(&mut drawn, std::slice::from_ref(&standing), None, &options)?;
    let drawn = String::from_utf8_lossy(&drawn);
    // The last line counts findings, here always one.
    let drawn = drawn.trim_end().rsplit_once('\n').map_or("", |(drawn, _)| drawn.trim_matches('\n'));
    let allowed = if found.is_allowed { "<b>Allowed by hand.</b> " } else { "" };
    writeln!(
        out,
        "<div class=\"finding {severity}\"{line}>{allowed}<pre>{drawn}</pre></div>",
        severity = if found.is_allowed { Severity::Note } else { found.severity },
        line = format_line_attribute(found, comparison),
        drawn = escape_html(drawn)
    )
}

/// Returns the attribute with the line that a finding is about, for the scripts. It is empty if the finding
/// is about no line of the program.
fn format_line_attribute(found: &Diagnostic, comparison: &Comparison<'_>) -> String {
    let source = comparison.subject.program.source();
    let Some(label) = found.labels.iter().find(|label| is_program_source(&label.source, source)) else {
        return String::new();
    };
    let (line, _) = label.source.line_column(label.span.start);
    let side = if Arc::ptr_eq(&label.source, source) { "old" } else { "new" };
    format!(" data-{side}-line=\"{line}\"")
}

/// Returns whether a source is the program's: as it was read, or as it was written and read back.
fn is_program_source(source: &Arc<Source>, program: &Arc<Source>) -> bool {
    Arc::ptr_eq(source, program) || source.name() == format!("{} (corrected)", program.name())
}

fn write_assumptions(comparison: &Comparison<'_>, drawing: &[String], out: &mut dyn Write) -> io::Result<()> {
    let runs = comparison.runs;
    let mut missing: Vec<String> = Vec::new();
    if runs.after.is_none() {
        missing.push(
            "chips, loads and the stock that is left are not shown, since there was no simulation".to_owned(),
        );
    }
    missing.extend(runs.missing.iter().cloned());
    for (title, list) in [
        ("Not shown", &missing),
        ("Taken for granted", &comparison.assumptions),
        ("How it is drawn", &drawing.to_vec()),
    ] {
        if list.is_empty() {
            continue;
        }
        writeln!(out, "<h3>{title}</h3><ul>")?;
        for sentence in list {
            writeln!(out, "<li>{}</li>", escape_html(sentence))?;
        }
        out.write_all(b"</ul>\n")?;
    }
    Ok(())
}

fn write_source_texts(comparison: &Comparison<'_>, out: &mut dyn Write) -> io::Result<()> {
    let subject = &comparison.subject;
    let recipe = subject.recipe.map(|recipe| ("Recipe", &recipe.source));
    for (what, source) in recipe.into_iter().chain(subject.setup_files.iter().map(|source| ("Setup", source)))
    {
        let text = String::from_utf8_lossy(source.bytes());
        writeln!(
            out,
            "<h3>{what}: {}</h3><pre>{}</pre>",
            escape_html(&to_safe_line(source.name())),
            escape_html(&text)
        )?;
    }
    Ok(())
}
