//! This module writes the findings of a run as a table whose rows lead to their lines.

use super::markup::write_text;
use crate::diagnostic::{Diagnostic, Severity};
use crate::presentation::safe_text::to_safe_line;
use crate::report::comparison::Comparison;
use crate::report::escaping::escape_html;
use crate::report::render::describe_counts;
use crate::report::render::finding_groups::group_findings;
use crate::report::render::human::{self, HumanRenderOptions};
use crate::source::Source;
use std::io::{self, Write};
use std::sync::Arc;

/// The largest number of findings of a group that are shown in full. Of the others, only the lines are
/// listed.
const PER_GROUP: usize = 10;

/// Writes the findings of the run, and those of simulating the program before.
pub(super) fn write_findings(comparison: &Comparison<'_>, out: &mut dyn Write) -> io::Result<()> {
    write_table(out, "", comparison.subject.findings, comparison)?;
    // The findings of simulating the current program are already among the findings of the run.
    match &comparison.runs.before {
        Some(before) if !before.findings.is_empty() => {
            write_table(out, "The simulation of the program before: ", &before.findings, comparison)
        }
        _ => Ok(()),
    }
}

fn write_table(
    out: &mut dyn Write,
    title: &str,
    findings: &[Diagnostic],
    comparison: &Comparison<'_>,
) -> io::Result<()> {
    writeln!(
        out,
        "<p class=\"counts\">{}{}</p>",
        escape_html(title),
        escape_html(&describe_counts(findings))
    )?;
    if findings.is_empty() {
        return Ok(());
    }
    out.write_all(b"<table class=\"findings\"><thead><tr><th>code</th><th>what was found</th><th>place</th></tr></thead><tbody>\n")?;
    for group in group_findings(findings) {
        for found in group.shown(PER_GROUP) {
            write_row(out, found, comparison)?;
        }
        if let Some(hidden) = group.describe_hidden(PER_GROUP) {
            writeln!(out, "<tr><td></td><td class=\"dim\" colspan=\"2\">{}</td></tr>", escape_html(&hidden))?;
        }
    }
    out.write_all(b"</tbody></table>\n")
}

/// Writes one finding. Its row carries the line, so that the scripts can jump to it.
fn write_row(out: &mut dyn Write, found: &Diagnostic, comparison: &Comparison<'_>) -> io::Result<()> {
    let severity = if found.is_allowed { Severity::Note } else { found.severity };
    let step = found.step.map_or_else(String::new, |step| format!("step {step}: "));
    let help = found.help.as_deref().unwrap_or_default();
    write!(
        out,
        "<tr class=\"finding {severity}\"><td><b class=\"code\">{}</b><br>{}</td><td>{}{}<br><span class=\"dim\">{}</span>\
         <details><summary>where it stands</summary><pre>{}</pre></details></td><td>",
        found.code,
        if found.is_allowed { "allowed by hand".to_owned() } else { severity.to_string() },
        escape_html(&step),
        escape_html(&to_safe_line(&found.message)),
        escape_html(&to_safe_line(help)),
        escape_html(&render_excerpt(found)?)
    )?;
    write_place(out, found, comparison)?;
    out.write_all(b"</td></tr>\n")
}

/// Writes where a finding is: a link to its line of the program, or the place in another file.
pub(super) fn write_place(
    out: &mut dyn Write,
    found: &Diagnostic,
    comparison: &Comparison<'_>,
) -> io::Result<()> {
    if let Some((side, line)) = find_program_line(found, comparison) {
        return write!(out, "<a href=\"#work\" data-{side}-line=\"{line}\">line {line}</a>");
    }
    let Some(label) = found.labels.first() else { return Ok(()) };
    let (line, _) = label.source.line_column(label.span.start);
    write_text(out, &format!("{}:{line}", to_safe_line(label.source.name())))
}

/// Returns the line of the program that a finding is about, and whether it counts the lines of the program as it was
/// read (`old`) or as it is (`new`).
fn find_program_line(found: &Diagnostic, comparison: &Comparison<'_>) -> Option<(&'static str, usize)> {
    let source = comparison.subject.program.source();
    let label = found.labels.iter().find(|label| is_program_source(&label.source, source))?;
    let (line, _) = label.source.line_column(label.span.start);
    // Of two files, the program is the second.
    let as_read = Arc::ptr_eq(&label.source, source) && comparison.differences.is_none();
    Some((if as_read { "old" } else { "new" }, line))
}

/// Returns whether a source is the program's: as it was read, or as it was written and read back.
fn is_program_source(source: &Arc<Source>, program: &Arc<Source>) -> bool {
    Arc::ptr_eq(source, program) || source.name() == format!("{} (corrected)", program.name())
}

/// Returns a finding as the terminal shows it, with the lines of text around it.
fn render_excerpt(found: &Diagnostic) -> io::Result<String> {
    let options = HumanRenderOptions { width: 110, ..HumanRenderOptions::default() };
    let mut drawn = Vec::new();
    let standing = Diagnostic { is_allowed: false, ..found.clone() };
    human::render_human(&mut drawn, std::slice::from_ref(&standing), None, &options)?;
    let drawn = String::from_utf8_lossy(&drawn);
    // The last line counts findings, here always one.
    Ok(drawn.trim_end().rsplit_once('\n').map_or("", |(drawn, _)| drawn.trim_matches('\n')).to_owned())
}
