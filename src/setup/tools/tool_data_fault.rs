//! This module reports which data of a tool is missing for a simulation, and what to write where.

use super::tool_entry::ToolEntry;
use crate::cutter::MeridianError;
use crate::diagnostic::{Diagnostic, codes};
use crate::number::format_trimmed_number;
use crate::presentation::display_units::{ColumnUnit, DisplayUnits};
use crate::program::LengthUnit;
use crate::program::motion::ActiveTool;
use crate::setup::{Setup, YamlLocation};
use crate::source::{Source, Span};
use std::fmt::Write;
use std::sync::Arc;

/// The reason why a tool cannot be simulated.
#[derive(Debug, Clone, PartialEq)]
pub struct ToolDataFault {
    /// The fault of the data.
    pub kind: ToolDataFaultKind,
    tool: Box<ToolGapSubject>,
    /// The unit of the CL file, in which lengths are told.
    units: LengthUnit,
}

/// The tool that a finding is about.
#[derive(Debug, Clone, PartialEq)]
struct ToolGapSubject {
    /// The tool in words: `tool 3`.
    called: String,
    /// The entry that matches it: `{ number: 3 }`.
    matches: String,
    /// The setup's entry for the tool.
    entry: Option<YamlLocation>,
}

/// The fault of a tool's data.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum ToolDataFaultKind {
    /// Neither file states the diameter.
    Diameter,
    /// The CL file describes a lathe tool, a wire or the like.
    NoMillingCutter,
    /// The numbers make no cutter. Lengths are in mm, angles in degrees.
    Shape {
        /// The reason.
        error: MeridianError,
        /// The diameter.
        diameter: f64,
        /// The corner radius.
        corner_radius: f64,
        /// The length of the flutes.
        flute_length: f64,
        /// The angle between flank and axis.
        taper: f64,
        /// The angle between the bottom and the plane across the axis.
        tip: f64,
    },
    /// The shank ends below the end of the flutes. Lengths are in mm from the tip.
    Shank {
        /// The length of the flutes.
        flute_length: f64,
        /// The end of the shank.
        length: f64,
    },
    /// The tool is clamped below the end of the flutes. Lengths are in mm from the tip.
    StickOut {
        /// The length of the flutes.
        flute_length: f64,
        /// The clamp.
        length: f64,
    },
}

impl ToolDataFault {
    pub(super) fn new(
        tool: &ActiveTool,
        entry: Option<&ToolEntry>,
        kind: ToolDataFaultKind,
        units: LengthUnit,
    ) -> Self {
        Self { kind, tool: Box::new(ToolGapSubject::new(tool, entry)), units }
    }

    /// Makes a finding ([`codes::TOOL_SHAPE`]) at the statement of the CL file that needs the tool, and at
    /// the setup's entry for it.
    pub fn diagnostic(&self, source: &Arc<Source>, span: Span) -> Diagnostic {
        let called = &self.tool.called;
        let length_of = |mm: f64| format_length_in(mm, self.units);
        let (message, keys) = match self.kind {
            ToolDataFaultKind::Diameter => {
                (format!("the diameter of {called} is not known"), "diameter: …".to_owned())
            }
            ToolDataFaultKind::NoMillingCutter => {
                let message = format!("{called} is no milling cutter, and only those can be simulated");
                (message, "diameter: …".to_owned())
            }
            ToolDataFaultKind::Shape { error, diameter, corner_radius, flute_length, taper, tip } => {
                let (key, numbers) = match error {
                    MeridianError::Diameter => ("diameter: …", format!("diameter {}", length_of(diameter))),
                    MeridianError::Corner => (
                        "corner_radius: …",
                        format!(
                            "corner radius {}, diameter {}",
                            length_of(corner_radius),
                            length_of(diameter)
                        ),
                    ),
                    MeridianError::Angle => (
                        "taper: …, tip: …",
                        format!("taper {}, tip {} degrees", format_dimension(taper), format_dimension(tip)),
                    ),
                    MeridianError::Narrow => (
                        "dovetail_angle: …, flute_length: …",
                        format!("diameter {}, flute length {}", length_of(diameter), length_of(flute_length)),
                    ),
                    MeridianError::Height => (
                        "flute_length: …",
                        format!("flute length {}, diameter {}", length_of(flute_length), length_of(diameter)),
                    ),
                };
                (format!("no cutter is like {called}: {error} ({numbers})"), key.to_owned())
            }
            ToolDataFaultKind::Shank { flute_length, length } => {
                let message = format!(
                    "the shank of {called} ends {} above its tip, below the end of its flutes at {}",
                    length_of(length),
                    length_of(flute_length)
                );
                (message, "shank: { diameter: …, length: … }, flute_length: …".to_owned())
            }
            ToolDataFaultKind::StickOut { flute_length, length } => {
                let message = format!(
                    "{called} is clamped {} above its tip, below the end of its flutes at {}",
                    length_of(length),
                    length_of(flute_length)
                );
                (message, "stick_out: …, flute_length: …".to_owned())
            }
        };
        let help = match self.kind {
            ToolDataFaultKind::NoMillingCutter => format!(
                "Simulate its operations elsewhere. If it is a milling cutter after all, describe it: {}",
                self.tool.yaml_snippet(&keys)
            ),
            _ => self.tool.word_help(&keys),
        };
        let diagnostic =
            Diagnostic::new(codes::TOOL_SHAPE, message).with_help(help).with_label(source, span, "used here");
        self.tool.label_entry(diagnostic)
    }
}

impl ToolGapSubject {
    fn new(tool: &ActiveTool, entry: Option<&ToolEntry>) -> Self {
        let entry = entry.map(|entry| entry.place.clone());
        Self { called: tool.display_name(), matches: exact_tool_match(tool), entry }
    }

    /// Words what to write where.
    fn word_help(&self, keys: &str) -> String {
        match &self.entry {
            Some(_) => format!("Add `{keys}` to the entry that matches this tool."),
            None => format!("Add it under `setup:`: {}", self.yaml_snippet(keys)),
        }
    }

    fn yaml_snippet(&self, keys: &str) -> String {
        format!("`tools: [ {{ match: {}, {keys} }} ]`.", self.matches)
    }

    fn label_entry(&self, diagnostic: Diagnostic) -> Diagnostic {
        match &self.entry {
            Some(place) => {
                diagnostic.with_label(place.source(), place.value_span(), "the entry for this tool")
            }
            None => diagnostic,
        }
    }
}

impl Setup {
    /// Reports that chip thickness or forces need the number of teeth of a tool ([`codes::TEETH_MISSING`]),
    /// at the statement of the CL file that uses it.
    pub fn report_missing_teeth(&self, tool: &ActiveTool, source: &Arc<Source>, span: Span) -> Diagnostic {
        let tool = ToolGapSubject::new(tool, self.find_tool_entry(tool));
        let message = format!("chip thickness needs the number of teeth of {}", tool.called);
        let help = match &tool.entry {
            Some(_) => {
                "Add `teeth: 4`, with the real number, to the entry that matches this tool.".to_owned()
            }
            None => format!("Add it under `setup:`: {}", tool.yaml_snippet("teeth: 4")),
        };
        tool.label_entry(Diagnostic::new(codes::TEETH_MISSING, message).with_help(help).with_label(
            source,
            span,
            "used here",
        ))
    }
}

impl Setup {
    /// Reports what is missing of a tool for its deflection and its bending stress ([`codes::STIFFNESS_MISSING`]), at the
    /// statement of the CL file that uses it.
    pub fn report_missing_stiffness(
        &self,
        tool: &ActiveTool,
        source: &Arc<Source>,
        span: Span,
    ) -> Diagnostic {
        let entry = self.find_tool_entry(tool);
        let subject = ToolGapSubject::new(tool, entry);
        let clamp_mm = entry.and_then(ToolEntry::clamp_mm);
        let has_modulus = entry.is_some_and(|entry| entry.stiffness.youngs_modulus_gpa.is_some());
        let mut gaps = Vec::new();
        if clamp_mm.is_none() {
            gaps.push(("`stick_out` (from the tip to the clamp)", "stick_out: 45"));
        }
        if !has_modulus {
            gaps.push(("`tool_material` (carbide or hss), or `youngs_modulus`", "tool_material: carbide"));
        }
        if entry.is_none_or(|entry| entry.shank.is_empty()) && (clamp_mm.is_some() || gaps.is_empty()) {
            gaps.push((
                "`shank` (how thick the tool is from the flutes to the clamp)",
                "shank: { diameter: 10, length: 60 }",
            ));
        } else if gaps.is_empty() {
            gaps.push(("`shank` up to the clamp", "shank: { diameter: 10, length: 60 }"));
        }
        let [missing, keys] = [0, 1].map(|which| {
            let words = gaps.iter().map(|(missing, key)| if which == 0 { *missing } else { *key });
            words.collect::<Vec<_>>().join(if which == 0 { " and " } else { ", " })
        });
        let message = format!("deflection and bending stress of {} need {missing}", subject.called);
        let help = match &subject.entry {
            Some(_) => format!("Add `{keys}`, with the real numbers, to the entry that matches this tool."),
            None => format!("Add it under `setup:`: {}", subject.yaml_snippet(&keys)),
        };
        let finding = Diagnostic::new(codes::STIFFNESS_MISSING, message).with_help(help);
        subject.label_entry(finding.with_label(source, span, "used here"))
    }
}

/// Returns the `match` that only matches this tool.
fn exact_tool_match(tool: &ActiveTool) -> String {
    match (tool.number, &tool.name) {
        (Some(number), _) => format!("{{ number: {number} }}"),
        (None, Some(name)) => {
            let mut pattern = String::new();
            for character in name.chars() {
                // Within single quotes, a quote is written twice. Wildcards get a backslash.
                let _ = match character {
                    '\'' => write!(pattern, "''"),
                    '*' | '?' | '[' | ']' | '{' | '}' | '\\' => write!(pattern, "\\{character}"),
                    other => write!(pattern, "{other}"),
                };
            }
            format!("{{ name: '{pattern}' }}")
        }
        (None, None) => "{}".to_owned(),
    }
}

/// Formats a length or an angle of a tool with at most four decimals.
fn format_dimension(value: f64) -> String {
    format_trimmed_number(value, 4)
}

/// Prints a length in mm as a reader of a CL file in `units` knows it: `12.5 mm`, `0.5 in`.
pub(super) fn format_length_in(mm: f64, units: LengthUnit) -> String {
    DisplayUnits::from_mm(units).tell_trimmed(ColumnUnit::Length, mm, 4)
}
