//! Records that a step has left behind: they describe where the points were before it moved them.
//!
//! What counts as left behind is decided by what the step did to the points, seen by comparing them with the file as it was
//! read, and by what the record means:
//!
//! - MSYS: never. Points are printed in it, and moving them inside it is what such a step is for.
//! - `$$*CATIA0`, `$$-> CSYS`, CAMERA: after any move. They tie the printed coordinates to the part and are already applied
//!   in them (measured for Creo: two files of one path differ by the translation of the matrix).
//! - SolidWorks' CSYS: when its z axis no longer is the tool axis of the points after it (measured: it always is). A shift in
//!   the world does not touch it.
//! - Heights (CLEARP with a plane, Makino's ESCAPE-HEIGHT and PART-LEAST): when a z changed. BOX: after any move. The size of
//!   the stock, which has no place: when the points did not all move alike.
//! - Distances in a CYCLE: when the points were scaled. The side of CUTCOM: when they were mirrored.
//!
//! A record that the step itself edited was handled and is not reported.

use super::displacement::Displacement;
use super::findings::Findings;
use crate::diagnostic::{Code, Diagnostic, codes};
use crate::program::record::{CutterCompensation, FrameWord};
use crate::program::{Dialect, Program, Record, Statement, StepId};
use std::collections::BTreeSet;

/// The codes that [`stale`] reports.
pub const STALE_CODES: &[Code] =
    &[codes::STALE_FRAME, codes::STALE_HEIGHT, codes::STALE_CYCLE, codes::STALE_COMPENSATION];

/// The records that `step` should have changed with the points, and did not. Empty when it moved no point.
///
/// Call it directly after the step: a later step signs what it edits anew. Points are compared with the file as it was read,
/// not with the program before the step.
pub fn stale(program: &Program, step: StepId) -> Vec<Diagnostic> {
    let displacement = Displacement::of(program, step);
    let mut found = Findings::new(program);
    if !displacement.moved {
        return Vec::new();
    }
    for (index, statement) in program.live() {
        if statement.edited_by() == Some(step) {
            continue;
        }
        if let Some((code, message)) = left_behind(program, statement, &displacement) {
            found.report(code, found.whole(index), message, "");
        }
    }
    turned_frames(step, &mut found);
    found.finish()
}

fn left_behind(program: &Program, statement: &Statement, did: &Displacement) -> Option<(Code, &'static str)> {
    let creo = matches!(program.dialect(), Dialect::Creo | Dialect::CreoGpost);
    let record = match statement.record() {
        Record::FrameMark => {
            (codes::STALE_FRAME, "the points were moved, the matrix after this mark was not")
        }
        Record::Frame(frame) if frame.word == FrameWord::Csys && creo => {
            (codes::STALE_FRAME, "the points were moved, this frame was not")
        }
        Record::Cycle(_) if did.scaled => {
            (codes::STALE_CYCLE, "the points were scaled, the distances of this cycle were not")
        }
        Record::CutterCompensation(CutterCompensation::On(_)) if did.mirrored => {
            (codes::STALE_COMPENSATION, "the path was mirrored, the side of its compensation was not")
        }
        Record::Known | Record::Text => (codes::STALE_HEIGHT, extent(program.text(statement), did)?),
        _ => return None,
    };
    Some(record)
}

/// Whether a record with coordinates of its own no longer fits the points.
fn extent(text: &[u8], did: &Displacement) -> Option<&'static str> {
    let text = crate::program::folded(text.trim_ascii());
    let (word, rest) = text.split_once('/')?;
    let (word, rest) = (word.trim(), rest.trim());
    let height = "the points were moved, this height was not";
    match word {
        "BOX" => Some("the points were moved, this box was not"),
        "CLEARP" if did.raised || !rest.starts_with("XYPLAN") => Some(height),
        "PPRINT" if did.raised && (rest.starts_with("ESCAPE-HEIGHT") || rest.starts_with("PART-LEAST")) => {
            Some(height)
        }
        "INSERT" if did.uneven && rest.starts_with("STOCK SIZE") => {
            Some("the points were turned or scaled, this stock size was not")
        }
        _ => None,
    }
}

/// Cosine of about half a degree.
const SAME_AXIS: f64 = 0.999_96;

/// SolidWorks' frames whose z axis no longer is the tool axis of the points.
fn turned_frames(step: StepId, found: &mut Findings<'_>) {
    let program = found.program;
    if program.dialect() != Dialect::SolidWorks {
        return;
    }
    let mut turned = BTreeSet::new();
    for motion in program.motions() {
        let by_step = |index| program.statement(index).and_then(Statement::edited_by) == Some(step);
        if let Some(frame) = &motion.frame
            && by_step(motion.last_statement())
            && !by_step(frame.statement)
            && frame.axes.column(2).dot(&motion.to.axis) < SAME_AXIS
        {
            turned.insert(frame.statement);
        }
    }
    for at in turned {
        let message = "the tool axes were turned, this frame was not";
        found.report(codes::STALE_FRAME, found.whole(at), message, "its z axis was the tool axis");
    }
}
