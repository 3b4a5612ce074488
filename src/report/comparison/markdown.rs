//! A comparison as Markdown, for merge requests and change notes.

use super::{Comparison, Figures, Peak, Row};
use crate::diagnostic::{Diagnostic, Label};
use crate::report::changes::StepChanges;
use crate::report::kind::Kind;
use crate::report::render::text::one_line;
use crate::report::table::{count, counted, duration, fixed, short};
use crate::transform::PROVENANCE;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Findings that are listed; the rest is counted.
const MOST_FINDINGS: usize = 50;

/// The comparison as Markdown (GitHub's and GitLab's tables). The same comparison makes the same bytes.
pub fn to_markdown(comparison: &Comparison<'_>) -> String {
    let mut out = format!("## {}\n\n", escaped(comparison.subject.program.source().name()));
    match &comparison.changes {
        Some(changes) if changes.is_empty() => out.push_str("Nothing was changed.\n\n"),
        Some(changes) => {
            let sum = |comments: bool| -> usize {
                let steps = changes.steps.iter().filter(|step| (step.name == PROVENANCE) == comments);
                steps.flat_map(maps).map(|map| map.values().sum::<usize>()).sum()
            };
            let said = match sum(true) {
                0 => String::new(),
                said => format!("{} about the run, ", counted(said, "comment", "comments")),
            };
            let _ = writeln!(
                out,
                "{} changed, {said}{} untouched.\n",
                counted(sum(false), "statement", "statements"),
                count(changes.untouched as u64)
            );
        }
        None => {}
    }
    whole(&mut out, comparison);
    steps(&mut out, comparison);
    operations(&mut out, comparison);
    findings(&mut out, comparison.subject.findings);
    list(&mut out, "Not shown", &comparison.runs.missing);
    list(&mut out, "Assumed", &comparison.assumptions);
    let _ = writeln!(out, "<sub>clsmith {}", env!("CARGO_PKG_VERSION"));
    for part in &comparison.parts {
        let _ = writeln!(out, "<br>{} {} sha256 {}", part.what.name(), escaped(&part.name), part.sha256);
    }
    if let Some(print) = comparison.subject.print {
        let _ = writeln!(out, "<br>recipe and files sha256 {}", escaped(print));
    }
    out.push_str("</sub>\n");
    out
}

/// A name of a column, the value in it, and its decimals.
type Measure = (&'static str, fn(&Figures) -> Option<f64>, fn(f64) -> String);

/// What is told of the whole program after its time at feed.
const WHOLE: &[Measure] = &[
    ("time at rapid", |figures| figures.rapid_seconds, duration),
    ("length at feed, mm", |figures| Some(figures.feed_mm), |value| fixed(value, 1)),
    ("length at rapid, mm", |figures| Some(figures.rapid_mm), |value| fixed(value, 1)),
    ("slowest feed, mm/min", |figures| figures.feed.map(|[low, _]| low), short),
    ("fastest feed, mm/min", |figures| figures.feed.map(|[_, high]| high), short),
    ("thickest chip, mm", |figures| peak(figures.chip_thickness_mm), |value| fixed(value, 4)),
    ("largest removal rate, mm³/min", |figures| peak(figures.removal_rate_mm3_min), |value| fixed(value, 0)),
    ("largest force, N", |figures| peak(figures.force_n), |value| fixed(value, 0)),
    ("largest torque, N m", |figures| peak(figures.torque_nm), |value| fixed(value, 2)),
    ("largest power, kW", |figures| peak(figures.power_kw), |value| fixed(value, 3)),
];

fn peak(peak: Option<Peak>) -> Option<f64> {
    peak.map(|peak| peak.value)
}

/// The rows of the table of the whole program: name, before, after, change. Rows nobody knows anything of are left out.
pub(in crate::report) fn whole_rows(comparison: &Comparison<'_>) -> Vec<[String; 4]> {
    let row = &comparison.whole;
    let told = |(name, value, print): &Measure| {
        let (before, after) = (row.before.as_ref().and_then(value), row.after.as_ref().and_then(value));
        let cell = |value: Option<f64>| value.map(print).unwrap_or_default();
        (before.is_some() || after.is_some())
            .then(|| [(*name).to_owned(), cell(before), cell(after), change(before, after)])
    };
    let seconds = |side: &Option<Figures>| side.as_ref().map(|figures| figures.feed_seconds);
    let timed = |side: &Option<Figures>| side.as_ref().map(time).unwrap_or_default();
    let change = change(seconds(&row.before), seconds(&row.after));
    let feed = ["time at feed".to_owned(), timed(&row.before), timed(&row.after), change];
    std::iter::once(feed).chain(WHOLE.iter().filter_map(told)).collect()
}

/// `+12.5 %`; nothing where that means nothing.
pub(in crate::report) fn change(before: Option<f64>, after: Option<f64>) -> String {
    let Some((before, after)) = before.zip(after) else { return String::new() };
    let change = (after / before - 1.0) * 100.0;
    if change.is_finite() && change.abs() >= 0.05 { format!("{change:+.1} %") } else { String::new() }
}

/// A column of the table of operations: its name, and its text for one program.
type Column = (&'static str, fn(&Figures) -> String);

const FEEDS: Column = ("feed, mm/min", feeds);
const CHIP: Column = ("thickest chip, mm", |figures| cell(figures.chip_thickness_mm, 4));
const POWER: Column = ("power, kW", |figures| cell(figures.power_kw, 3));

/// The head of the table of operations, and its rows. What is known of both programs takes two columns.
pub(in crate::report) fn operation_rows(comparison: &Comparison<'_>) -> (Vec<String>, Vec<Vec<String>>) {
    let both = comparison.subject.before.is_some();
    let mut columns = vec![("time", time as fn(&Figures) -> String), FEEDS];
    columns.extend(knows(comparison, |figures| figures.chip_thickness_mm.is_some()).then_some(CHIP));
    columns.extend(knows(comparison, |figures| figures.power_kw.is_some()).then_some(POWER));
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
    let row = |name: &str, row: &Row| {
        let motions = row.after.as_ref().or(row.before.as_ref()).map_or(0, |figures| figures.motions);
        let mut cells = vec![one_line(name), one_line(&row.tools.join(", ")), count(motions as u64)];
        for (_, text) in &columns {
            let told = |side: &Option<Figures>| side.as_ref().map(text).unwrap_or_default();
            cells.extend(both.then(|| told(&row.before)));
            cells.push(told(&row.after));
        }
        if both {
            let seconds = |side: &Option<Figures>| side.as_ref().map(|figures| figures.feed_seconds);
            cells.insert(5, change(seconds(&row.before), seconds(&row.after)));
        }
        cells
    };
    let mut rows: Vec<Vec<String>> = comparison.operations.iter().map(|one| row(&one.name, one)).collect();
    if rows.len() > 1 {
        rows.push(row("all", &comparison.whole));
    }
    (head, rows)
}

fn cell(peak: Option<Peak>, decimals: usize) -> String {
    peak.map(|peak| fixed(peak.value, decimals)).unwrap_or_default()
}

fn knows(comparison: &Comparison<'_>, what: impl Fn(&Figures) -> bool) -> bool {
    [&comparison.whole.before, &comparison.whole.after].into_iter().flatten().any(what)
}

/// A time that leaves motions out is a lower bound, and says so.
fn time(figures: &Figures) -> String {
    format!("{}{}", if figures.untimed > 0 { "> " } else { "" }, duration(figures.feed_seconds))
}

fn feeds(figures: &Figures) -> String {
    match figures.feed {
        Some([low, high]) if short(low) == short(high) => short(low),
        Some([low, high]) => format!("{} to {}", short(low), short(high)),
        None => String::new(),
    }
}

fn whole(out: &mut String, comparison: &Comparison<'_>) {
    let rows = whole_rows(comparison);
    if comparison.subject.before.is_some() {
        table(out, &["", "before", "after", "change"], rows.iter().map(|row| row.to_vec()));
    } else {
        table(out, &["", "value"], rows.iter().map(|[name, _, after, _]| vec![name.clone(), after.clone()]));
    }
}

fn maps(step: &StepChanges) -> [&BTreeMap<Kind, usize>; 3] {
    [&step.edited, &step.inserted, &step.deleted]
}

/// What a step edited, inserted and deleted, in words.
pub(in crate::report) fn step_row(step: &StepChanges) -> [String; 3] {
    maps(step).map(|map| {
        let words = map.iter().map(|(kind, number)| counted(*number, kind.name(1), kind.name(2)));
        words.collect::<Vec<_>>().join(", ")
    })
}

fn steps(out: &mut String, comparison: &Comparison<'_>) {
    let Some(changes) = comparison.changes.as_ref().filter(|changes| !changes.steps.is_empty()) else {
        return;
    };
    out.push_str("### Steps\n\n");
    let rows = changes.steps.iter().enumerate().map(|(index, step)| {
        let mut row = vec![format!("{}. {}", index + 1, step.name)];
        row.extend(step_row(step));
        row
    });
    table(out, &["step", "edited", "inserted", "deleted"], rows);
}

fn operations(out: &mut String, comparison: &Comparison<'_>) {
    out.push_str("### Operations\n\n");
    let (head, rows) = operation_rows(comparison);
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    table(out, &head, rows.into_iter());
}

fn findings(out: &mut String, findings: &[Diagnostic]) {
    out.push_str("### Findings\n\n");
    if findings.is_empty() {
        out.push_str("None.\n\n");
        return;
    }
    for found in findings.iter().take(MOST_FINDINGS) {
        let place = found.labels.first().map(place).unwrap_or_default();
        let message = escaped(&found.message);
        let _ = writeln!(out, "- **{}** {}{place}: {message}", found.severity, found.code);
    }
    if findings.len() > MOST_FINDINGS {
        let _ = writeln!(out, "- and {} more", findings.len() - MOST_FINDINGS);
    }
    out.push('\n');
}

fn place(label: &Label) -> String {
    let (line, column) = label.source.line_column(label.span.start);
    format!(" {}:{line}:{column}", escaped(label.source.name()))
}

fn list(out: &mut String, title: &str, sentences: &[String]) {
    if sentences.is_empty() {
        return;
    }
    let _ = writeln!(out, "### {title}\n");
    for sentence in sentences {
        let _ = writeln!(out, "- {}", escaped(sentence));
    }
    out.push('\n');
}

/// A table; numbers stand to the right.
fn table(out: &mut String, head: &[&str], rows: impl Iterator<Item = Vec<String>>) {
    let line = |cells: &mut dyn Iterator<Item = String>| {
        let cells: Vec<String> = cells.collect();
        format!("| {} |\n", cells.join(" | "))
    };
    out.push_str(&line(&mut head.iter().map(|cell| (*cell).to_owned())));
    out.push_str(&line(
        &mut (0..head.len()).map(|column| if column == 0 { "---" } else { "---:" }.to_owned()),
    ));
    for row in rows {
        out.push_str(&line(&mut row.iter().map(|cell| escaped(cell))));
    }
    out.push('\n');
}

/// Text of a file as Markdown that shows it and does nothing else.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in one_line(text).chars() {
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
