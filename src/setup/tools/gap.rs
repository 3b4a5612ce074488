//! What is missing before a tool can be simulated, and what to write where to fill it.

use super::cutter::short;
use super::entry::ToolEntry;
use crate::diagnostic::{Diagnostic, codes};
use crate::program::motion::Tool;
use crate::setup::{Place, Setup};
use crate::sim::ProfileError;
use crate::source::{Source, Span};
use std::fmt::Write;
use std::sync::Arc;

/// Why a tool cannot be simulated.
#[derive(Debug, Clone, PartialEq)]
pub struct ToolGap {
    /// What is missing or wrong.
    pub kind: ToolGapKind,
    tool: Box<Subject>,
}

/// The tool that a finding is about.
#[derive(Debug, Clone, PartialEq)]
struct Subject {
    /// `tool 3`.
    called: String,
    /// `{ number: 3 }`.
    matches: String,
    /// The setup's entry for the tool.
    entry: Option<Place>,
}

/// What is missing or wrong.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ToolGapKind {
    /// Nobody says the diameter.
    Diameter,
    /// The CL file describes a lathe tool, a wire or the like.
    NoMillingCutter,
    /// The numbers make no cutter; lengths in mm, angles in degrees.
    Shape {
        /// Why.
        error: ProfileError,
        /// The diameter.
        diameter: f64,
        /// The corner radius.
        corner_radius: f64,
        /// The length of the flutes.
        flute_length: f64,
        /// The flank's angle against the axis.
        taper: f64,
        /// The bottom's angle against the plane.
        tip: f64,
    },
    /// The shank ends below the end of the flutes; lengths in mm from the tip.
    Shank {
        /// The length of the flutes.
        flute_length: f64,
        /// Where the shank ends.
        length: f64,
    },
}

impl ToolGap {
    pub(super) fn new(tool: &Tool, entry: Option<&ToolEntry>, kind: ToolGapKind) -> Self {
        Self { kind, tool: Box::new(Subject::new(tool, entry)) }
    }

    /// The gap as a finding ([`codes::TOOL_SHAPE`]) at the statement of the CL file that needs the tool, and at the
    /// setup's entry for it.
    pub fn diagnostic(&self, source: &Arc<Source>, span: Span) -> Diagnostic {
        let called = &self.tool.called;
        let (message, keys) = match self.kind {
            ToolGapKind::Diameter => {
                (format!("the diameter of {called} is not known"), "diameter: …".to_owned())
            }
            ToolGapKind::NoMillingCutter => {
                let message = format!("{called} is no milling cutter, and only those can be simulated");
                (message, "diameter: …".to_owned())
            }
            ToolGapKind::Shape { error, diameter, corner_radius, flute_length, taper, tip } => {
                let (key, numbers) = match error {
                    ProfileError::Diameter => ("diameter: …", format!("diameter {} mm", short(diameter))),
                    ProfileError::Corner => (
                        "corner_radius: …",
                        format!("corner radius {} mm, diameter {} mm", short(corner_radius), short(diameter)),
                    ),
                    ProfileError::Angle => {
                        ("taper: …, tip: …", format!("taper {}, tip {} degrees", short(taper), short(tip)))
                    }
                    ProfileError::Height => (
                        "flute_length: …",
                        format!("flutes {} mm, diameter {} mm", short(flute_length), short(diameter)),
                    ),
                };
                (format!("no cutter is like {called}: {error} ({numbers})"), key.to_owned())
            }
            ToolGapKind::Shank { flute_length, length } => {
                let message = format!(
                    "the shank of {called} ends {} mm above its tip, below the end of its flutes at {} mm",
                    short(length),
                    short(flute_length)
                );
                let keys = format!("shank: {{ diameter: …, length: … }}, flute_length: {}", short(length));
                (message, keys)
            }
        };
        let help = match self.kind {
            ToolGapKind::NoMillingCutter => format!(
                "Simulate its operations elsewhere; or, if it is one after all, describe it: {}",
                self.tool.snippet(&keys)
            ),
            _ => self.tool.help(&keys),
        };
        let diagnostic =
            Diagnostic::new(codes::TOOL_SHAPE, message).help(help).label(source, span, "used here");
        self.tool.at_entry(diagnostic)
    }
}

impl Subject {
    fn new(tool: &Tool, entry: Option<&ToolEntry>) -> Self {
        let entry = entry.map(|entry| entry.place.clone());
        Self { called: tool.called(), matches: matches(tool), entry }
    }

    /// What to write where.
    fn help(&self, keys: &str) -> String {
        match &self.entry {
            Some(_) => format!("Say `{keys}` in the entry that fits this tool."),
            None => format!("Say it under `setup:`: {}", self.snippet(keys)),
        }
    }

    fn snippet(&self, keys: &str) -> String {
        format!("`tools: [ {{ match: {}, {keys} }} ]`.", self.matches)
    }

    fn at_entry(&self, diagnostic: Diagnostic) -> Diagnostic {
        match &self.entry {
            Some(place) => diagnostic.label(place.source(), place.span(), "the entry for this tool"),
            None => diagnostic,
        }
    }
}

impl Setup {
    /// That chip thickness or forces need the number of teeth of a tool ([`codes::TEETH_MISSING`]), at the statement of
    /// the CL file that uses it.
    pub fn teeth_gap(&self, tool: &Tool, source: &Arc<Source>, span: Span) -> Diagnostic {
        let tool = Subject::new(tool, self.tool_entry(tool));
        let message = format!("chip thickness needs the number of teeth of {}", tool.called);
        let help = match &tool.entry {
            Some(_) => {
                "Add `teeth: 4`, or as many as there are, to the entry that fits this tool.".to_owned()
            }
            None => format!("Say it under `setup:`: {}", tool.snippet("teeth: 4")),
        };
        tool.at_entry(Diagnostic::new(codes::TEETH_MISSING, message).help(help).label(
            source,
            span,
            "used here",
        ))
    }
}

/// What `match` fits exactly this tool.
fn matches(tool: &Tool) -> String {
    match (tool.number, &tool.name) {
        (Some(number), _) => format!("{{ number: {number} }}"),
        (None, Some(name)) => {
            let mut pattern = String::new();
            for character in name.chars() {
                // In single quotes a quote is written twice; wildcards take a backslash.
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
