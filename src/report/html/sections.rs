//! This module writes the parts of the page that are plain text and tables.

use super::page_arrays::PageArrays;
use super::{findings_table, shop_description, time_bars};
use crate::presentation::safe_text::to_safe_line;
use crate::report::comparison::{
    ComparedFile, Comparison, VerdictLevel, build_operation_table, build_step_table, build_whole_table,
    choose_headlines,
};
use crate::report::escaping::escape_html;
use crate::report::table::{Column, ColumnUnit, DisplayUnits, PrintedTable, TableLooks, TableValue};
use crate::report::text_format::format_count;
use std::io::{self, Write};

/// Writes a section by its name in the template. `arrays` are what the scripts draw.
///
/// # Errors
/// Returns the errors of `out`, and an error for a section that does not exist.
pub(super) fn write_section(
    section: &str,
    comparison: &Comparison<'_>,
    arrays: &PageArrays,
    out: &mut dyn Write,
) -> io::Result<()> {
    match section {
        "lead" => write_lead(comparison, out),
        "made" => write!(out, "clsmith {}", env!("CARGO_PKG_VERSION")),
        "verdict" => write_verdict(comparison, out),
        "headlines" => write_headlines(comparison, out),
        "parts" => write_compared_files(comparison, out),
        "whole" => build_whole_table(comparison).write_html(out),
        "units" => write_units(comparison, out),
        "steps" => write_steps(comparison, out),
        "bars" => time_bars::write_operation_bars(comparison, out),
        "operations" => build_operation_table(comparison).write_html(out),
        "tools" => time_bars::write_tool_rows(comparison, &arrays.tools, comparison.units(), out),
        "shop" => write_shop(comparison, out),
        "findings" => findings_table::write_findings(comparison, out),
        "assumptions" => write_assumptions(comparison, &arrays.missing, out),
        "texts" => write_source_texts(comparison, out),
        _ => Err(io::Error::other(format!("the page has no section {section}"))),
    }
}

/// Writes the verdict, with a link to the line of the finding that decided.
fn write_verdict(comparison: &Comparison<'_>, out: &mut dyn Write) -> io::Result<()> {
    let verdict = comparison.verdict();
    let (class, mark, word) = match verdict.level {
        VerdictLevel::Stop => ("stop", "\u{2715}", "stop"),
        VerdictLevel::Look => ("look", "!", "look"),
        VerdictLevel::Go => ("go", "\u{2713}", "go"),
    };
    write!(
        out,
        "<section id=\"verdict\" class=\"card {class}\"><span class=\"mark\" role=\"img\" aria-label=\"{word}\">{mark}</span>\
         <div><b>{}</b><br><span class=\"dim\">{}</span></div><span>",
        escape_html(&to_safe_line(&verdict.sentence)),
        escape_html(&to_safe_line(&verdict.details))
    )?;
    if let Some(found) = verdict.finding {
        findings_table::write_place(out, found, comparison)?;
    }
    out.write_all(b"</span></section>\n")
}

/// Writes the few figures that a reader sees first.
fn write_headlines(comparison: &Comparison<'_>, out: &mut dyn Write) -> io::Result<()> {
    for figure in choose_headlines(comparison) {
        write!(
            out,
            "<div class=\"card figure\"><h2>{}</h2><span class=\"big\">{}</span> <span class=\"change\">{}</span>",
            escape_html(&figure.title),
            escape_html(&figure.now),
            escape_html(&figure.change)
        )?;
        if !figure.was.is_empty() {
            write!(out, "<br><span class=\"dim\">was {}</span>", escape_html(&figure.was))?;
        }
        out.write_all(b"</div>\n")?;
    }
    Ok(())
}

fn write_shop(comparison: &Comparison<'_>, out: &mut dyn Write) -> io::Result<()> {
    out.write_all(b"<table>")?;
    for (title, text) in shop_description::describe_shop(comparison) {
        writeln!(out, "<tr><th>{title}</th><td>{}</td></tr>", escape_html(&to_safe_line(&text)))?;
    }
    out.write_all(b"</table>\n")
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
        None => match subject.other_file() {
            Some(other) => {
                let was = escape_html(other.dialect().display_name());
                let other = escape_html(&to_safe_line(other.source().name()));
                write!(out, "{dialect}. Compared with {other} ({was}), which is called before.")
            }
            None => write!(out, "{dialect}."),
        },
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
    out.write_all(b"<section class=\"card\" id=\"steps\"><h2>Steps</h2>\n")?;
    table.write_html(out)?;
    for report in comparison.subject.reports {
        writeln!(out, "<pre>{}</pre>", escape_html(report.to_text(comparison.units()).trim_matches('\n')))?;
    }
    out.write_all(b"</section>\n")
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
