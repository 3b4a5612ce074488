//! The parts of the page that are plain text and tables.

use super::markup::{escape_html, write_table};
use crate::diagnostic::Diagnostic;
use crate::presentation::safe_text::to_safe_line;
use crate::report::comparison::{Comparison, build_operation_rows, build_step_row, build_whole_rows};
use crate::report::render::SeverityCounts;
use crate::report::render::human::{self, HumanRenderOptions};
use crate::report::text_format::format_count;
use crate::source::Source;
use std::collections::BTreeMap;
use std::io::{self, Write};
use std::sync::Arc;

/// Findings of one code that are shown with their lines; the rest is counted.
const PER_CODE: usize = 40;

/// Writes a section by its name in the template.
pub fn write_section(
    section: &str,
    comparison: &Comparison<'_>,
    drawing: &[String],
    out: &mut dyn Write,
) -> io::Result<()> {
    match section {
        "lead" => write_lead(comparison, out),
        "parts" => write_compared_files(comparison, out),
        "whole" => write_whole_program(comparison, out),
        "steps" => write_steps(comparison, out),
        "operations" => write_operations(comparison, out),
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
    let row = |part: &crate::report::comparison::ComparedFile| {
        vec![
            part.what.display_name().to_owned(),
            to_safe_line(&part.name),
            format_count(part.bytes),
            part.sha256.clone(),
        ]
    };
    let rows: Vec<_> = comparison.parts.iter().map(row).collect();
    write_table(out, &["", "file", "bytes", "SHA-256"], 2, &rows)
}

fn write_whole_program(comparison: &Comparison<'_>, out: &mut dyn Write) -> io::Result<()> {
    let rows = build_whole_rows(comparison);
    if comparison.subject.before.is_some() {
        let rows: Vec<Vec<String>> = rows.into_iter().map(Vec::from).collect();
        return write_table(out, &["", "before", "after", "change"], 1, &rows);
    }
    let rows: Vec<Vec<String>> = rows.into_iter().map(|[name, _, after, _]| vec![name, after]).collect();
    write_table(out, &["", ""], 1, &rows)
}

fn write_steps(comparison: &Comparison<'_>, out: &mut dyn Write) -> io::Result<()> {
    let Some(changes) = comparison.changes.as_ref().filter(|changes| !changes.steps.is_empty()) else {
        return Ok(());
    };
    out.write_all(b"<h2>Steps</h2>\n")?;
    let row = |(index, step): (usize, _)| {
        let [edited, inserted, deleted] = build_step_row(step);
        vec![format!("{}. {}", index + 1, step.name), edited, inserted, deleted]
    };
    let rows: Vec<Vec<String>> = changes.steps.iter().enumerate().map(row).collect();
    write_table(out, &["step", "edited", "inserted", "deleted"], 4, &rows)?;
    for report in comparison.subject.reports {
        writeln!(out, "<pre>{}</pre>", escape_html(report.to_text().trim_matches('\n')))?;
    }
    Ok(())
}

fn write_operations(comparison: &Comparison<'_>, out: &mut dyn Write) -> io::Result<()> {
    let (head, rows) = build_operation_rows(comparison);
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    write_table(out, &head, 2, &rows)
}

fn write_findings(comparison: &Comparison<'_>, out: &mut dyn Write) -> io::Result<()> {
    let subject = &comparison.subject;
    let runs = [
        ("the program before", &comparison.runs.before),
        ("the program as it stands", &comparison.runs.after),
    ];
    let simulated = runs.into_iter().filter_map(|(of, run)| Some((of, run.as_ref()?)));
    write_finding_list(out, "Of the run", subject.findings, comparison)?;
    for (of, simulated) in simulated {
        if !simulated.findings.is_empty() {
            write_finding_list(out, &format!("Of the simulation of {of}"), &simulated.findings, comparison)?;
        }
    }
    Ok(())
}

fn write_finding_list(
    out: &mut dyn Write,
    title: &str,
    found: &[Diagnostic],
    comparison: &Comparison<'_>,
) -> io::Result<()> {
    writeln!(out, "<h3>{}: {}</h3>", escape_html(title), SeverityCounts::from_findings(found))?;
    let options = HumanRenderOptions { width: 120, ..HumanRenderOptions::default() };
    let mut seen: BTreeMap<&str, usize> = BTreeMap::new();
    for one in found {
        let count = seen.entry(one.code.id()).or_default();
        *count += 1;
        if *count > PER_CODE {
            continue;
        }
        let mut drawn = Vec::new();
        human::render_human(&mut drawn, std::slice::from_ref(one), None, &options)?;
        let drawn = String::from_utf8_lossy(&drawn);
        // The last line counts findings, here always one.
        let drawn = drawn.trim_end().rsplit_once('\n').map_or("", |(drawn, _)| drawn.trim_matches('\n'));
        let severity = one.severity;
        writeln!(
            out,
            "<div class=\"finding {severity}\"{}><pre>{}</pre></div>",
            format_line_attribute(one, comparison),
            escape_html(drawn)
        )?;
    }
    for (code, count) in seen.into_iter().filter(|(_, count)| *count > PER_CODE) {
        writeln!(out, "<p>{} more of {code} are not shown.</p>", count - PER_CODE)?;
    }
    Ok(())
}

/// The line that a finding is about, for the scripts.
fn format_line_attribute(found: &Diagnostic, comparison: &Comparison<'_>) -> String {
    let source = comparison.subject.program.source();
    let Some(label) = found.labels.iter().find(|label| is_program_source(&label.source, source)) else {
        return String::new();
    };
    let (line, _) = label.source.line_column(label.span.start);
    let side = if Arc::ptr_eq(&label.source, source) { "old" } else { "new" };
    format!(" data-{side}-line=\"{line}\"")
}

/// Whether a text is the program's: as it was read, or as it was read back.
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
