//! This module checks tools: none, without a shape, with an impossible one, with two, with two numbers.

use super::{Lint, LintFindings};
use crate::diagnostic::{DiagnosticCode, codes};
use crate::program::motion::{ActiveTool, Motion};
use crate::program::record::ToolData;
use crate::program::{NumberRole, Record, Statement, StatementId};
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

pub(super) const CODES: &[DiagnosticCode] = &[
    codes::CUT_WITHOUT_TOOL,
    codes::NO_TOOL,
    codes::TOOL_SHAPE_MISSING,
    codes::IMPOSSIBLE_TOOL,
    codes::TOOL_SHAPES_DIFFER,
];

/// Dimensions that differ by less than this (in the file's unit) are equal. It is the fourth decimal.
const SAME_SHAPE: f64 = 1e-4;

/// Checks the tools that cut, once each time they change.
#[derive(Default)]
pub(super) struct ToolShapeLint {
    none_reported: bool,
    last: Option<Arc<ActiveTool>>,
    /// The statement that gives the shape in force.
    data: Option<StatementId>,
    /// Whether the tool has cut with the shape in force.
    used: bool,
    /// Whether the shape in force belongs to an earlier tool.
    outdated: bool,
    /// Whether a turret has turned since the last tool number.
    turret: bool,
    shapes: HashMap<u32, (ToolData, StatementId)>,
    without_shape: HashSet<Option<u32>>,
}

impl Lint for ToolShapeLint {
    fn check_statement(&mut self, id: StatementId, statement: &Statement, found: &mut LintFindings<'_>) {
        match statement.record() {
            Record::ToolData(_) => (self.data, self.used, self.outdated) = (Some(id), false, false),
            Record::ToolCall(call) => {
                let other = self.last.as_ref().is_none_or(|tool| tool.number != Some(call.number));
                self.outdated |= self.used && other;
                self.turret = false;
            }
            // The turret of a lathe turns to a tool without a number here, so the number in force belongs to
            // another tool.
            Record::Known
                if found.program.statement_text(statement).trim_ascii_start().starts_with(b"TURRET") =>
            {
                self.turret = true;
            }
            _ => {}
        }
    }

    fn check_motion(&mut self, motion: &Motion, found: &mut LintFindings<'_>) {
        let Some(tool) = &motion.tool else { return self.report_no_tool(motion, found) };
        let same = self.last.as_ref().is_some_and(|last| Arc::ptr_eq(last, tool));
        if same || !found.is_cutting_motion(motion) {
            return;
        }
        self.last = Some(Arc::clone(tool));
        self.used = true;
        match (&tool.data, self.data) {
            (Some(data), Some(at)) if !data.word.is_no_mill() && !self.outdated => {
                report_impossible_shape(data, at, found);
                self.compare_shapes(tool, data, at, found);
            }
            (None, _) if self.without_shape.insert(tool.number) => {
                let name =
                    tool.number.map_or_else(|| "this tool".to_owned(), |number| format!("tool {number}"));
                let message = format!("the file does not give the shape of {name}");
                found.report(
                    codes::TOOL_SHAPE_MISSING,
                    found.end_point_span(motion),
                    message,
                    "its first cut",
                );
            }
            _ => {}
        }
    }
}

impl ToolShapeLint {
    fn report_no_tool(&mut self, motion: &Motion, found: &mut LintFindings<'_>) {
        if self.none_reported || !found.is_cutting_motion(motion) {
            return;
        }
        self.none_reported = true;
        let span = found.end_point_span(motion);
        if found.facts.tool {
            found.report(
                codes::CUT_WITHOUT_TOOL,
                span,
                "no tool is in force at this motion",
                "the first cut",
            );
        } else {
            found.report(codes::NO_TOOL, span, "the program never names a tool", "the first cut");
        }
    }

    fn compare_shapes(
        &mut self,
        tool: &ActiveTool,
        data: &ToolData,
        at: StatementId,
        found: &mut LintFindings<'_>,
    ) {
        let Some(number) = tool.number.filter(|_| !self.turret) else { return };
        let Some((before, place)) = self.shapes.get(&number) else {
            self.shapes.insert(number, (data.clone(), at));
            return;
        };
        let differ = |now: Option<f64>, before: Option<f64>| match (now, before) {
            (Some(now), Some(before)) => (now - before).abs() > SAME_SHAPE,
            _ => false,
        };
        let (what, now, was) = if differ(data.diameter, before.diameter) {
            ("diameter", data.diameter, before.diameter)
        } else if differ(data.corner_radius, before.corner_radius) {
            ("corner radius", data.corner_radius, before.corner_radius)
        } else {
            return;
        };
        let text = |value: Option<f64>| found.format_length(value.unwrap_or_default());
        let message = format!("tool {number} has the {what} {} here, and {} before", text(now), text(was));
        let first = (found.role_span(at, NumberRole::Length), "now");
        let second = (found.role_span(*place, NumberRole::Length), "before");
        found.report_at_two_spans(codes::TOOL_SHAPES_DIFFER, message, first, second);
        self.shapes.insert(number, (data.clone(), at));
    }
}

fn report_impossible_shape(data: &ToolData, at: StatementId, found: &mut LintFindings<'_>) {
    let Some(diameter) = data.diameter else { return };
    // A cone that stands on its tip has no diameter there: engravers, chamfer mills, conical mills.
    let pointed = data.taper_degrees.is_some_and(|taper| taper > 0.0);
    if diameter <= 0.0 && pointed {
        return;
    }
    if diameter <= 0.0 {
        let span = found.role_span(at, NumberRole::Length);
        found.report(codes::IMPOSSIBLE_TOOL, span, "a tool without a diameter cuts", "no diameter");
    } else if let Some(corner) =
        data.corner_radius.filter(|corner| is_corner_too_large(*corner, diameter, data))
    {
        let message = format!(
            "a corner radius of {} is impossible for a diameter of {}",
            found.format_length(corner),
            found.format_length(diameter)
        );
        found.report(
            codes::IMPOSSIBLE_TOOL,
            found.numbers_span(at, 1..2),
            message,
            "more than half the diameter",
        );
    }
}

/// Returns whether no cutter has a corner of this radius. The ball at the tip of a cone reaches beyond the diameter, which
/// is measured where the lines of bottom and flank meet.
fn is_corner_too_large(corner: f64, diameter: f64, data: &ToolData) -> bool {
    let taper = data.taper_degrees.unwrap_or_default().clamp(0.0, 89.0).to_radians();
    corner * (1.0 - taper.sin()) / taper.cos() > diameter / 2.0 + SAME_SHAPE
}

/// Compares TOOLNO with the load after it.
#[derive(Default)]
pub(super) struct ToolNumberLint {
    named: Option<(u32, StatementId)>,
}

impl Lint for ToolNumberLint {
    fn check_statement(&mut self, id: StatementId, statement: &Statement, found: &mut LintFindings<'_>) {
        let Record::ToolCall(call) = statement.record() else { return };
        if !call.loads {
            self.named = Some((call.number, id));
            return;
        }
        if let Some((number, at)) = self.named.take().filter(|(number, _)| *number != call.number) {
            let message = format!("tool {} is loaded, but tool {number} was described", call.number);
            let first = (found.numbers_span(id, 0..1), "loaded");
            let second = (found.numbers_span(at, 0..1), "described");
            found.report_at_two_spans(codes::TOOL_NUMBERS_DIFFER, message, first, second);
        }
    }

    fn check_motion(&mut self, motion: &Motion, found: &mut LintFindings<'_>) {
        if self.named.is_some() && found.is_cutting_motion(motion) {
            self.named = None;
        }
    }
}
