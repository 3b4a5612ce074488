//! This module writes findings as SARIF 2.1.0, for code hosts and review tools.
//!
//! SARIF counts columns in characters, while [`line`](super::line) and [`json`](super::json) count bytes. The
//! byte offsets are given as well.

use crate::diagnostic::{Diagnostic, DiagnosticCode, DiagnosticLabel, Severity};
use crate::presentation::safe_json::write_json_pretty;
use crate::presentation::safe_text;
use crate::source::Source;
use serde_sarif::sarif::{
    ArtifactLocation, Location, Message, MultiformatMessageString, PhysicalLocation, Region,
    ReportingConfiguration, ReportingDescriptor, Result as Finding, ResultLevel, Run, Sarif, Suppression,
    Tool, ToolComponent,
};
use std::collections::BTreeSet;
use std::io::{self, Write};

const SCHEMA: &str = "https://json.schemastore.org/sarif-2.1.0.json";

/// Writes all findings as a SARIF log with one run, indented and with a line end.
///
/// `file` is the file of the run. It is the location of findings without a place.
///
/// # Errors
/// Returns the errors of the writer.
pub fn render_sarif(out: &mut dyn Write, diagnostics: &[Diagnostic], file: Option<&str>) -> io::Result<()> {
    let codes: Vec<DiagnosticCode> =
        diagnostics.iter().map(|found| found.code).collect::<BTreeSet<_>>().into_iter().collect();
    let driver = ToolComponent::builder()
        .name("clsmith")
        .version(env!("CARGO_PKG_VERSION"))
        .semantic_version(env!("CARGO_PKG_VERSION"))
        .rules(codes.iter().copied().map(to_sarif_rule).collect::<Vec<_>>())
        .build();
    let run = Run::builder()
        .tool(Tool::builder().driver(driver).build())
        .column_kind("unicodeCodePoints")
        .results(diagnostics.iter().map(|found| to_sarif_result(found, &codes, file)).collect::<Vec<_>>())
        .build();
    let log = Sarif::builder().schema(SCHEMA).version("2.1.0").runs(vec![run]).build();
    write_json_pretty(&mut *out, &log)?;
    writeln!(out)
}

fn to_sarif_rule(code: DiagnosticCode) -> ReportingDescriptor {
    let mut rule = ReportingDescriptor::builder()
        .id(code.id())
        .short_description(to_multiformat_string(code.meaning()))
        .full_description(to_multiformat_string(code.explanation()))
        .default_configuration(ReportingConfiguration::builder().level(code.severity().to_string()).build())
        .build();
    rule.help = (!code.help().is_empty()).then(|| to_multiformat_string(code.help()));
    rule
}

fn to_sarif_result(found: &Diagnostic, codes: &[DiagnosticCode], file: Option<&str>) -> Finding {
    let mut labels = found.labels.iter();
    let primary = labels.next().map(to_sarif_location).or_else(|| file.map(file_location));
    let related: Vec<Location> = labels.map(to_sarif_location).collect();
    let mut finding = Finding::builder()
        .rule_id(found.code.id())
        .level(to_sarif_level(found.severity))
        .message(to_sarif_message(&message_with_help(found)))
        .locations(primary.into_iter().collect::<Vec<_>>())
        .build();
    finding.rule_index = codes.binary_search(&found.code).ok().map(|index| index as i64);
    finding.related_locations = (!related.is_empty()).then_some(related);
    // A suppression is SARIF's term for a finding that somebody decided to accept: it stays in the log, but
    // viewers do not count it.
    finding.suppressions = found.is_allowed.then(|| vec![allowed_by_hand()]);
    finding
}

fn allowed_by_hand() -> Suppression {
    Suppression::builder()
        .kind(serde_json::Value::from("external"))
        .justification("allowed by hand (--allow)")
        .build()
}

/// Returns the message, and the help of the finding if it differs from the help of its rule.
fn message_with_help(found: &Diagnostic) -> String {
    match &found.help {
        Some(help) if help != found.code.help() => format!("{}\nhelp: {help}", found.message),
        _ => found.message.clone(),
    }
}

fn to_sarif_level(severity: Severity) -> ResultLevel {
    match severity {
        Severity::Error => ResultLevel::Error,
        Severity::Warning => ResultLevel::Warning,
        Severity::Note => ResultLevel::Note,
    }
}

fn to_sarif_location(label: &DiagnosticLabel) -> Location {
    let place = PhysicalLocation::builder()
        .artifact_location(artifact_location(label.source.name()))
        .region(to_sarif_region(label))
        .build();
    let mut location = Location::builder().physical_location(place).build();
    location.message = (!label.message.is_empty()).then(|| to_sarif_message(&label.message));
    location
}

fn file_location(name: &str) -> Location {
    let place = PhysicalLocation::builder().artifact_location(artifact_location(name)).build();
    Location::builder().physical_location(place).build()
}

fn to_sarif_region(label: &DiagnosticLabel) -> Region {
    let span = safe_text::trim_line_end(&label.source, label.span);
    let (start_line, start_column) = line_and_character(&label.source, span.start);
    let (end_line, end_column) = line_and_character(&label.source, span.end);
    Region::builder()
        .start_line(start_line)
        .start_column(start_column)
        .end_line(end_line)
        .end_column(end_column)
        .byte_offset(i64::from(span.start))
        .byte_length(span.len() as i64)
        .build()
}

/// Returns the line, counted from 1, and the column in characters.
fn line_and_character(source: &Source, offset: u32) -> (i64, i64) {
    let (line, column) = source.line_column(offset);
    let before = source.bytes().get(offset as usize + 1 - column..offset as usize).unwrap_or_default();
    (line as i64, safe_text::decode_characters(before).count() as i64 + 1)
}

fn artifact_location(name: &str) -> ArtifactLocation {
    ArtifactLocation::builder().uri(to_artifact_uri(name)).build()
}

/// Returns a file name as a URI. Relative names stay relative, and absolute ones become `file:` URIs.
fn to_artifact_uri(name: &str) -> String {
    let drive = matches!(name.as_bytes(), [letter, b':', b'\\' | b'/', ..] if letter.is_ascii_alphabetic());
    let name = if drive || cfg!(windows) { name.replace('\\', "/") } else { name.to_owned() };
    let mut uri = String::from(match (drive, name.starts_with('/')) {
        (true, _) => "file:///",
        (_, true) => "file://",
        _ => "",
    });
    for (at, byte) in name.bytes().enumerate() {
        match byte {
            b'/' | b'-' | b'.' | b'_' | b'~' | b'0'..=b'9' | b'a'..=b'z' | b'A'..=b'Z' => {
                uri.push(char::from(byte));
            }
            b':' if drive && at == 1 => uri.push(':'),
            _ => uri.push_str(&format!("%{byte:02X}")),
        }
    }
    uri
}

fn to_sarif_message(text: &str) -> Message {
    Message::builder().text(text).build()
}

fn to_multiformat_string(text: &str) -> MultiformatMessageString {
    MultiformatMessageString::builder().text(text).build()
}
