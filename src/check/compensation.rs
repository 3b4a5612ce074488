//! This module checks cutter compensation: left on, switched in an arc, on at rapid, changing sides.

use super::{Lint, LintFindings};
use crate::diagnostic::{DiagnosticCode, codes};
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::record::{CompensationSide, CutterCompensation};
use crate::program::{Record, Statement, StatementId};

pub(super) const CODES: &[DiagnosticCode] =
    &[codes::CUTCOM_LEFT_ON, codes::CUTCOM_AT_ARC, codes::CUTCOM_RAPID, codes::CUTCOM_CHANGES_SIDE];

/// Follows CUTCOM through the program.
#[derive(Default)]
pub(super) struct CompensationLint {
    on: Option<(CompensationSide, StatementId)>,
    /// The CUTCOM that the next motion carries out.
    switched: Option<StatementId>,
    rapid_reported: bool,
}

impl CompensationLint {
    fn apply_compensation(&mut self, id: StatementId, to: CutterCompensation, found: &mut LintFindings<'_>) {
        match to {
            CutterCompensation::On(side) => {
                if let Some((_, before)) = self.on.filter(|(before, _)| *before != side) {
                    let message = "cutter compensation changes its side without being switched off";
                    let second = (found.statement_span(before), "switched on here");
                    found.report_at_two_spans(
                        codes::CUTCOM_CHANGES_SIDE,
                        message,
                        (found.statement_span(id), "the other side"),
                        second,
                    );
                }
                if self.on.is_none() {
                    self.switched = Some(id);
                }
                self.on = Some((side, id));
                self.rapid_reported = false;
            }
            CutterCompensation::Off => self.switched = self.on.take().map(|_| id),
            // The next CUTCOM states the side.
            CutterCompensation::Armed => {}
        }
    }

    fn report_left_on(&mut self, what: &str, found: &mut LintFindings<'_>) {
        if let Some((_, at)) = self.on.take() {
            let message = format!("cutter compensation is still on at the end of {what}");
            found.report(codes::CUTCOM_LEFT_ON, found.statement_span(at), message, "switched on here");
        }
        self.switched = None;
    }
}

impl Lint for CompensationLint {
    fn check_statement(&mut self, id: StatementId, statement: &Statement, found: &mut LintFindings<'_>) {
        match statement.record() {
            Record::CutterCompensation(to) => self.apply_compensation(id, *to, found),
            Record::OperationStart(_) | Record::OperationEnd => self.report_left_on("the operation", found),
            Record::ProgramEnd => self.report_left_on("the program", found),
            _ => {}
        }
    }

    fn check_motion(&mut self, motion: &Motion, found: &mut LintFindings<'_>) {
        if let Some(at) = self.switched.take()
            && let MotionPath::Arc(_) = motion.path
        {
            let first = (found.statement_span(at), "switched here");
            let second = (found.end_point_span(motion), "the end of the arc");
            let message = "cutter compensation is switched in an arc";
            found.report_at_two_spans(codes::CUTCOM_AT_ARC, message, first, second);
        }
        if motion.rapid
            && !self.rapid_reported
            && let Some((_, at)) = self.on
        {
            self.rapid_reported = true;
            let first = (found.end_point_span(motion), "a rapid");
            let second = (found.statement_span(at), "switched on here");
            found.report_at_two_spans(
                codes::CUTCOM_RAPID,
                "cutter compensation is on in this rapid",
                first,
                second,
            );
        }
    }

    fn finish(&mut self, found: &mut LintFindings<'_>) {
        self.report_left_on("the program", found);
    }
}
