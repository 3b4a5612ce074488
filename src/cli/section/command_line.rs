//! This module holds the command line as a text, so that findings can point at what was typed.

use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::program::LengthUnit;
use clsmith::source::{Source, Span};
use std::sync::Arc;

/// The arguments as they were typed, with the place of each.
pub(super) struct CommandLine {
    source: Option<Arc<Source>>,
    words: Vec<(String, Span)>,
    units: LengthUnit,
    found: Vec<Diagnostic>,
}

impl CommandLine {
    /// Reads the arguments of the process.
    pub(super) fn from_process(units: LengthUnit) -> Self {
        let mut text = String::from("clsmith");
        let mut words = Vec::new();
        for word in std::env::args_os().skip(1) {
            let word = word.to_string_lossy().into_owned();
            let shown = if word.contains([' ', '\t']) { format!("\"{word}\"") } else { word.clone() };
            text.push(' ');
            let from = text.len();
            text.push_str(&shown.replace(char::is_control, " "));
            words.push((word, Span::new(from, text.len())));
        }
        Self { source: Source::new("command line", text.into_bytes()).ok(), words, units, found: Vec::new() }
    }

    /// Reads a length above 0 in mm.
    pub(super) fn parse_size_mm(&mut self, option: &'static str, text: Option<&str>) -> Option<f64> {
        let unit = self.units.mm_per_unit();
        self.parse_positive(option, text).map(|value| value * unit)
    }

    /// Reads a length of 0 or more in mm.
    pub(super) fn parse_distance_mm(&mut self, option: &'static str, text: Option<&str>) -> Option<f64> {
        let unit = self.units.mm_per_unit();
        let value = self.parse_checked(option, text, "a number, 0 or more", |value| value >= 0.0)?;
        Some(value * unit)
    }

    /// Reads a coordinate in mm.
    pub(super) fn parse_coordinate_mm(&mut self, option: &'static str, text: Option<&str>) -> Option<f64> {
        let unit = self.units.mm_per_unit();
        self.parse_number(option, text).map(|value| value * unit)
    }

    /// Reads a number above 0.
    pub(super) fn parse_positive(&mut self, option: &'static str, text: Option<&str>) -> Option<f64> {
        self.parse_checked(option, text, "a number above 0", |value| value > 0.0)
    }

    /// Reads a number.
    pub(super) fn parse_number(&mut self, option: &'static str, text: Option<&str>) -> Option<f64> {
        self.parse_checked(option, text, "a number", |_| true)
    }

    /// Reads a name that a CL program can contain.
    pub(super) fn parse_name(&mut self, option: &'static str, text: Option<&str>) -> Option<String> {
        let text = text?;
        let fits = |c: char| c.is_ascii_graphic() && !matches!(c, ',' | '$' | '/');
        let fine = !text.is_empty() && text.len() <= 40 && text.chars().all(|c| fits(c) || c == ' ');
        if fine && text.trim() == text {
            return Some(text.to_owned());
        }
        let message =
            "a name in a CL program is up to 40 ASCII letters, digits and signs, no comma, slash or $";
        self.add_fault(option, message, "cannot be written");
        None
    }

    /// Adds a fault at an option's value.
    pub(super) fn add_fault(&mut self, option: &'static str, message: impl Into<String>, label: &str) {
        let found = Diagnostic::new(codes::SURFACE_OPTION, message);
        let span = self.option_span(option);
        self.found.push(match &self.source {
            Some(source) => found.with_label(source, span, label),
            None => found,
        });
    }

    /// Adds a fault for a required option that is missing.
    pub(super) fn add_missing(&mut self, option: &'static str, what: &str) {
        self.add_fault(option, format!("{option} is missing: {what}"), &format!("without {option}"));
    }

    /// Returns the findings.
    pub(super) fn into_findings(self) -> Vec<Diagnostic> {
        self.found
    }

    fn parse_checked(
        &mut self,
        option: &'static str,
        text: Option<&str>,
        phrase: &str,
        fits: impl Fn(f64) -> bool,
    ) -> Option<f64> {
        let text = text?;
        // A number beyond a million is a typing mistake. Below it, sums stay precise enough.
        let value = text.trim().parse::<f64>().ok().filter(|value| value.abs() <= 1e6 && fits(*value));
        if value.is_none() {
            self.add_fault(
                option,
                format!("{option} must be {phrase}, not `{text}`"),
                &format!("not {phrase}"),
            );
        }
        value
    }

    /// Returns the place of an option's value, or that of the command's name if the option was not given.
    fn option_span(&self, option: &str) -> Span {
        let with_value = format!("{option}=");
        let mut words = self.words.iter();
        while let Some((word, span)) = words.next() {
            if word == option {
                return words.next().map_or(*span, |(_, span)| *span);
            }
            if let Some(value) = word.strip_prefix(&with_value) {
                let end = span.to_range().end;
                return Span::new(end.saturating_sub(value.len()), end);
            }
        }
        self.words.first().map(|(_, span)| *span).unwrap_or_default()
    }
}
