//! Cutter compensation: left on, switched in an arc, on at rapid, changing sides.

use super::{Findings, Lint};
use crate::diagnostic::{Code, codes};
use crate::program::geometry::Path;
use crate::program::motion::Motion;
use crate::program::record::{CutterCompensation, Side};
use crate::program::{Record, Statement};

pub(super) const CODES: &[Code] =
    &[codes::CUTCOM_LEFT_ON, codes::CUTCOM_AT_ARC, codes::CUTCOM_RAPID, codes::CUTCOM_CHANGES_SIDE];

/// Follows CUTCOM through the program.
#[derive(Default)]
pub(super) struct Compensation {
    on: Option<(Side, usize)>,
    /// The CUTCOM that the next motion carries out.
    switched: Option<usize>,
    rapid_reported: bool,
}

impl Compensation {
    fn set(&mut self, index: usize, to: CutterCompensation, found: &mut Findings<'_>) {
        match to {
            CutterCompensation::On(side) => {
                if let Some((_, before)) = self.on.filter(|(before, _)| *before != side) {
                    let message = "cutter compensation changes its side without being switched off";
                    let second = (found.whole(before), "switched on here");
                    found.report_two(
                        codes::CUTCOM_CHANGES_SIDE,
                        message,
                        (found.whole(index), "the other side"),
                        second,
                    );
                }
                if self.on.is_none() {
                    self.switched = Some(index);
                }
                self.on = Some((side, index));
                self.rapid_reported = false;
            }
            CutterCompensation::Off => self.switched = self.on.take().map(|_| index),
            // The side comes with the next CUTCOM.
            CutterCompensation::Armed => {}
        }
    }

    fn end(&mut self, what: &str, found: &mut Findings<'_>) {
        if let Some((_, at)) = self.on.take() {
            let message = format!("cutter compensation is still on at the end of {what}");
            found.report(codes::CUTCOM_LEFT_ON, found.whole(at), message, "switched on here");
        }
        self.switched = None;
    }
}

impl Lint for Compensation {
    fn statement(&mut self, index: usize, statement: &Statement, found: &mut Findings<'_>) {
        match statement.record() {
            Record::CutterCompensation(to) => self.set(index, *to, found),
            Record::OperationStart(_) | Record::OperationEnd => self.end("the operation", found),
            Record::ProgramEnd => self.end("the program", found),
            _ => {}
        }
    }

    fn motion(&mut self, motion: &Motion, found: &mut Findings<'_>) {
        if let Some(at) = self.switched.take()
            && let Path::Arc(_) = motion.path
        {
            let first = (found.whole(at), "switched here");
            let second = (found.end_point(motion), "the end of the arc");
            let message = "cutter compensation is switched in an arc";
            found.report_two(codes::CUTCOM_AT_ARC, message, first, second);
        }
        if motion.rapid
            && !self.rapid_reported
            && let Some((_, at)) = self.on
        {
            self.rapid_reported = true;
            let first = (found.end_point(motion), "a rapid");
            let second = (found.whole(at), "switched on here");
            found.report_two(codes::CUTCOM_RAPID, "cutter compensation is on in this rapid", first, second);
        }
    }

    fn finish(&mut self, found: &mut Findings<'_>) {
        self.end("the program", found);
    }
}
