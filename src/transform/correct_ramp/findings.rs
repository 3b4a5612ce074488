//! This module words the findings about ramps.

use super::ramp_correction::{CorrectedRamp, LengtheningMethod};
use super::ramp_search::FoundRamp;
use super::report::RampReport;
use crate::diagnostic::{Diagnostic, DiagnosticCode, Failure, codes};
use crate::presentation::display_units::{ColumnUnit, DisplayUnits};
use crate::program::motion::{ActiveTool, Motion};
use crate::program::{Program, StatementId};
use crate::source::Span;
use crate::transform::StepContext;
use std::fmt::Display;

/// A ramp in its program.
pub(super) struct RampFindings<'a> {
    pub program: &'a Program,
    pub motions: &'a [Motion],
    pub found: &'a FoundRamp,
}

impl RampFindings<'_> {
    fn statement_span(&self, motion: usize, end: bool) -> Span {
        let Some(motion) = self.motions.get(motion) else {
            debug_assert!(false, "motion {motion} of {} does not exist", self.motions.len());
            return Span::default();
        };
        let statement = if end { motion.statements.last() } else { motion.statements.first() };
        self.program.statement(statement).origin()
    }

    /// Returns the place where the ramp begins in the source.
    pub(super) fn begin_span(&self) -> Span {
        self.statement_span(self.found.motions.start, false)
    }

    /// Returns the units in which findings tell lengths: those of the program.
    fn display_units(&self, context: &StepContext<'_>) -> DisplayUnits {
        DisplayUnits::from_mm(context.file_length_unit(self.program))
    }

    /// Builds a finding at the ramp's first and last statement, and at the step.
    fn build_finding(&self, code: DiagnosticCode, message: String, context: &StepContext<'_>) -> Diagnostic {
        let range = &self.found.motions;
        let last = range.end.saturating_sub(1);
        let source = self.program.source();
        let first = self.begin_span();
        let end = self.statement_span(last, true);
        let mut found = Diagnostic::new(code, message).with_label(source, first, "the ramp begins");
        if end != first {
            found = found.with_label(source, end, "and ends here");
        }
        context.label_step(found, "by this step")
    }
}

/// Words how a ramp violates its limits: `a zigzag of POCKET has a leg of 12.000 mm (at least 38.000 mm)
/// and descends at 9.2 degrees (at most 7.5)`.
fn describe_violation(report: &RampReport, units: DisplayUnits) -> String {
    let length_of = |mm: f64| units.tell_fixed(ColumnUnit::Length, mm, 3);
    let before = &report.before;
    let what = match report.kind {
        "along the shape" => "a ramp along the shape".to_owned(),
        kind => format!("a {kind}"),
    };
    let of = if report.operation.is_empty() { String::new() } else { format!(" of {}", report.operation) };
    let length = if report.kind == "helix" { "is" } else { "has a leg of" };
    let wide = if report.kind == "helix" { " wide" } else { "" };
    let mut faults = Vec::new();
    if let Some(pillar) = report.pillar_before.filter(|pillar| pillar.left_over_mm > 0.0) {
        faults.push(format!(
            "leaves a pillar of {} under the middle of the cutter, {} more than its inserts clear",
            length_of(pillar.height_mm),
            length_of(pillar.left_over_mm)
        ));
    }
    if report.before.shortest_leg_mm < report.limit_leg_mm && report.kind != "plunge" {
        faults.push(format!(
            "{length} {}{wide} (at least {})",
            length_of(before.shortest_leg_mm),
            length_of(report.limit_leg_mm)
        ));
    }
    if report.kind == "plunge" {
        faults.push(format!("goes straight down by {}", length_of(before.height_mm)));
    } else if before.steepest_degrees > report.limit_degrees {
        faults.push(format!(
            "descends at {:.2} degrees (at most {:.2})",
            before.steepest_degrees, report.limit_degrees
        ));
    }
    format!("{what}{of} {}", faults.join(" and "))
}

/// Describes a ramp that violates its limits and is corrected, and how.
pub(super) fn describe_corrected_ramp(
    place: &RampFindings<'_>,
    report: &RampReport,
    done: &CorrectedRamp,
    context: &StepContext<'_>,
) -> Diagnostic {
    let units = place.display_units(context);
    let mut how = Vec::new();
    match done.lengthened {
        LengtheningMethod::No => {}
        LengtheningMethod::Circle => how.push("its turning points lie on a circle through its ends".to_owned()),
        LengtheningMethod::MirroredCircle => how.push(
            "its turning points lie on a circle through its ends, on the other side, because the near side leaves the region"
                .to_owned(),
        ),
        LengtheningMethod::WidenedHelix => how.push("the helix is wider".to_owned()),
        LengtheningMethod::AlongChord => how.push("it goes to and fro along the line between its ends".to_owned()),
        LengtheningMethod::AlongPass => how.push("it goes out along the first cutting pass and back".to_owned()),
        LengtheningMethod::OverHole => how.push(
            "it goes straight down over a hole that the program has drilled, which is as wide as the middle of the cutter"
                .to_owned(),
        ),
    }
    if done.compression < 1.0 {
        let height = units.tell_fixed(ColumnUnit::Length, done.ramp.height_mm(), 3);
        how.push(format!("it begins {height} above its end"));
    }
    if done.passes > 1 {
        how.push(match report.kind {
            "helix"
                if !matches!(
                    done.lengthened,
                    LengtheningMethod::AlongChord | LengtheningMethod::AlongPass
                ) =>
            {
                format!("{} turns are inserted", done.passes - 1)
            }
            _ => format!("it descends in {} passes", done.passes),
        });
    }
    let help = format!("Corrected: {}.", how.join("; "));
    place.build_finding(codes::RAMP_OUT_OF_LIMITS, describe_violation(report, units), context).with_help(help)
}

/// Describes a ramp that violates its limits and is not corrected.
pub(super) fn describe_impossible_ramp(
    place: &RampFindings<'_>,
    report: &RampReport,
    why: &str,
    keep: bool,
    context: &StepContext<'_>,
) -> Diagnostic {
    let code = if keep { codes::RAMP_KEPT } else { codes::RAMP_IMPOSSIBLE };
    place.build_finding(
        code,
        format!(
            "{}, and cannot be corrected: {why}",
            describe_violation(report, place.display_units(context))
        ),
        context,
    )
}

/// Describes a tool without known inserts. It is an error if no ramp can be judged, otherwise a note.
pub(super) fn describe_missing_inserts(
    program: &Program,
    first: StatementId,
    tool: Option<&ActiveTool>,
    error: bool,
    context: &StepContext<'_>,
) -> Diagnostic {
    let called = tool.map_or_else(|| "the tool".to_owned(), ActiveTool::display_name);
    if error {
        let message = format!(
            "neither the step nor `setup.tools` gives the inserts of {called}, so no ramp can be judged"
        );
        let found = context.statement_finding(message, program, first, "its first ramp");
        let help = "Add `tool: { insert_height: ..., insert_radius: ... }` to the step, or `insert: { height: ..., radius: ... }` \
                    to the tool under `setup.tools`.";
        return found.with_help(help);
    }
    let message =
        format!("the ramps of {called} are left unchanged, because nothing says that it has inserts");
    let span = program.statement(first).origin();
    Diagnostic::new(codes::NO_INSERTS, message).with_label(program.source(), span, "its first ramp")
}

/// Describes a ramp that could not be written or proven. `place` is where it begins in the source.
pub(super) fn describe_unproven_ramp(
    program: &Program,
    place: Span,
    why: impl Display,
    context: &StepContext<'_>,
) -> Failure {
    let message = format!("this ramp cannot be corrected: {why}");
    context.source_finding(message, program, place, "the ramp begins").into()
}
