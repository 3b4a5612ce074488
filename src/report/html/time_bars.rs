//! This module draws operations and tools as bars of time, before as an outline and after filled.

use super::page_tools::PageTool;
use crate::presentation::safe_text::to_safe_line;
use crate::report::comparison::{Comparison, OperationTimes, operation_times};
use crate::report::escaping::escape_html;
use crate::report::table::DisplayUnits;
use crate::report::text_format::format_duration;
use std::io::{self, Write};

/// The width of the longest bar, in pixels.
const LONGEST: f64 = 300.0;

/// Writes a row for each operation: its tools, its time before and after, and both as bars.
pub(super) fn write_operation_bars(comparison: &Comparison<'_>, out: &mut dyn Write) -> io::Result<()> {
    let times = operation_times(comparison);
    let longest = longest_time(times.iter().flat_map(|times| [times.before, times.after]));
    let has_before = comparison.subject.before.is_some();
    out.write_all(b"<table class=\"bars\"><thead><tr><th>operation</th><th>tool</th>")?;
    out.write_all(if has_before {
        b"<th class=\"n\">before</th><th class=\"n\">after</th>".as_slice()
    } else {
        b"<th class=\"n\">time</th>"
    })?;
    out.write_all(b"<th></th></tr></thead><tbody>\n")?;
    for (row, times) in comparison.operations.iter().zip(&times) {
        let name = if row.name.is_empty() { "(no name)".to_owned() } else { to_safe_line(&row.name) };
        let tools = to_safe_line(&row.tools.join(", "));
        write!(out, "<tr><td>{}</td><td>{}</td>", escape_html(&name), escape_html(&tools))?;
        let [before, after] = &times.printed;
        if has_before {
            write!(out, "<td class=\"n\">{}</td>", escape_html(before))?;
        }
        write!(out, "<td class=\"n\">{}</td><td>", escape_html(after))?;
        write_bars(out, [times.before.filter(|_| has_before), times.after], longest)?;
        out.write_all(b"</td></tr>\n")?;
    }
    out.write_all(b"</tbody></table>\n")
}

/// Writes a row for each tool: its picture, its shape, the operations that use it, and its time where each of these
/// uses no other tool.
pub(super) fn write_tool_rows(
    comparison: &Comparison<'_>,
    tools: &[PageTool],
    units: DisplayUnits,
    out: &mut dyn Write,
) -> io::Result<()> {
    let times = operation_times(comparison);
    let sums: Vec<[Option<f64>; 2]> =
        tools.iter().map(|tool| sum_tool_times(comparison, &times, &tool.name)).collect();
    let longest = longest_time(sums.iter().flatten().copied());
    out.write_all(b"<table class=\"tools\"><thead><tr><th></th><th>tool</th><th class=\"n\">operations</th><th class=\"n\">time</th><th></th></tr></thead><tbody>\n")?;
    for (tool, [before, after]) in tools.iter().zip(sums) {
        out.write_all(b"<tr><td>")?;
        tool.write_picture(out)?;
        let uses = comparison.operations.iter().filter(|row| row.tools.contains(&tool.name)).count();
        let time = after.map_or_else(|| "not known alone".to_owned(), format_duration);
        write!(
            out,
            "</td><td><b>{}</b><br>{}</td><td class=\"n\">{uses}</td><td class=\"n\">{}</td><td>",
            escape_html(&to_safe_line(&tool.name)),
            escape_html(&tool.describe_shape(units)),
            escape_html(&time)
        )?;
        write_bars(out, [before, after], longest)?;
        out.write_all(b"</td></tr>\n")?;
    }
    out.write_all(b"</tbody></table>\n")
}

/// Returns the time of all operations with a tool, before and after. An operation with several tools does not tell the
/// time of each, so the sum is not known then.
fn sum_tool_times(comparison: &Comparison<'_>, times: &[OperationTimes], name: &str) -> [Option<f64>; 2] {
    let mut sums = [Some(0.0), Some(0.0)];
    for (row, times) in comparison.operations.iter().zip(times) {
        if !row.tools.iter().any(|tool| tool == name) {
            continue;
        }
        let is_alone = row.tools.len() == 1;
        for ((sum, seconds), figures) in
            sums.iter_mut().zip([times.before, times.after]).zip([&row.before, &row.after])
        {
            if figures.is_some() {
                *sum = sum.zip(seconds.filter(|_| is_alone)).map(|(sum, more)| sum + more);
            }
        }
    }
    if comparison.subject.before.is_none() {
        sums[0] = None;
    }
    sums
}

fn longest_time(times: impl Iterator<Item = Option<f64>>) -> f64 {
    times.flatten().fold(0.0, f64::max)
}

fn write_bars(out: &mut dyn Write, [before, after]: [Option<f64>; 2], longest: f64) -> io::Result<()> {
    if longest <= 0.0 || (before.is_none() && after.is_none()) {
        return Ok(());
    }
    let width = |seconds: f64| (seconds / longest * LONGEST).max(1.0);
    write!(
        out,
        "<svg role=\"img\" aria-label=\"bars of the times\" width=\"{0}\" height=\"16\" viewBox=\"0 0 {0} 16\">",
        LONGEST + 2.0
    )?;
    if let Some(after) = after {
        write!(out, "<rect class=\"after\" x=\"1\" y=\"4\" width=\"{:.1}\" height=\"8\"/>", width(after))?;
    }
    if let Some(before) = before {
        write!(
            out,
            "<rect class=\"before\" x=\"1\" y=\"1.5\" width=\"{:.1}\" height=\"13\"/>",
            width(before)
        )?;
    }
    out.write_all(b"</svg>")
}
