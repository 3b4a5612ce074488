//! This module finds records that a step has left behind: they describe where the points were before it moved
//! them.
//!
//! Whether a record counts as left behind depends on what the step did to the points, which is found by
//! comparing them with the file as it was read, and on what the record means:
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
//! A record that the step itself has edited is not reported. A step that corrects some points, each in its
//! own manner (ramps, leads), moves nothing in this sense. One that moves a whole operation does.

use super::displacement::Displacement;
use super::findings::LintFindings;
use crate::diagnostic::{Diagnostic, DiagnosticCode, codes};
use crate::program::record::{CutterCompensation, FrameWord};
use crate::program::{Dialect, Program, Record, Statement, StepId};
use std::collections::BTreeSet;

/// The codes that [`find_stale_records`] reports.
pub const STALE_CODES: &[DiagnosticCode] =
    &[codes::STALE_FRAME, codes::STALE_HEIGHT, codes::STALE_CYCLE, codes::STALE_COMPENSATION];

/// Returns the records that `step` should have changed together with the points, but did not. The list is
/// empty if it edited no point.
///
/// It should be called directly after the step, because later steps sign what they edit. Points are compared
/// with the file as it was read, not with the program before the step.
pub fn find_stale_records(program: &Program, step: StepId) -> Vec<Diagnostic> {
    let displacement = Displacement::measure_step(program, step);
    let mut found = LintFindings::new(program);
    for (id, statement) in program.live_statements() {
        if !displacement.moved || statement.edited_by() == Some(step) {
            continue;
        }
        if let Some((code, message)) = explain_stale_record(program, statement, &displacement) {
            found.report(code, found.statement_span(id), message, "");
        }
    }
    report_turned_frames(step, &mut found);
    found.finish()
}

fn explain_stale_record(
    program: &Program,
    statement: &Statement,
    did: &Displacement,
) -> Option<(DiagnosticCode, &'static str)> {
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
        Record::Known | Record::Text => {
            (codes::STALE_HEIGHT, explain_stale_coordinates(program.statement_text(statement), did)?)
        }
        _ => return None,
    };
    Some(record)
}

/// Returns why a record with coordinates of its own does not match the points any more.
fn explain_stale_coordinates(text: &[u8], did: &Displacement) -> Option<&'static str> {
    let text = crate::program::fold_text(text.trim_ascii());
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

/// The cosine of about half a degree.
const SAME_AXIS: f64 = 0.999_96;

/// Reports SolidWorks' frames whose z axis is not the tool axis of the points any more.
fn report_turned_frames(step: StepId, found: &mut LintFindings<'_>) {
    let program = found.program;
    if program.dialect() != Dialect::SolidWorks {
        return;
    }
    let mut turned = BTreeSet::new();
    for motion in program.motions() {
        let by_step = |id| program.statement(id).edited_by() == Some(step);
        if let Some(frame) = &motion.frame
            && by_step(motion.last_statement())
            && !by_step(frame.statement)
            // Both are unit vectors, so their product is the cosine of the angle between them.
            && frame.axes.column(2).dot(&motion.to.axis) < SAME_AXIS
        {
            turned.insert(frame.statement);
        }
    }
    for at in turned {
        let message = "the tool axes were turned, this frame was not";
        found.report(codes::STALE_FRAME, found.statement_span(at), message, "its z axis was the tool axis");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parse::{parse, read_record};
    use crate::source::Source;

    const STEP: StepId = StepId(3);

    /// Returns the codes that are stale after each GOTO was put through `change`, and the texts they point
    /// at.
    fn after(text: &str, change: impl Fn([f64; 6]) -> [f64; 6]) -> Vec<(&'static str, String)> {
        let source = Source::new("part", text.as_bytes().to_vec()).unwrap();
        let mut program = parse(&source, None).program;
        for id in program.statement_ids() {
            let statement = program.statement(id);
            let Record::Goto(goto) = statement.record() else { continue };
            let axis = goto.axis.unwrap_or_default();
            let [x, y, z, i, j, k] =
                change([goto.point.x, goto.point.y, goto.point.z, axis.x, axis.y, axis.z]);
            let axis = if goto.axis.is_some() { format!(",{i:.7},{j:.7},{k:.7}") } else { String::new() };
            let text = format!("GOTO/{x:.4},{y:.4},{z:.4}{axis}\n");
            let (record, _) = read_record(text.as_bytes()).unwrap();
            program.replace_statement(id, text.as_bytes(), record, STEP);
        }
        let shown = |found: &Diagnostic| {
            String::from_utf8_lossy(source.slice(found.labels.first().unwrap().span)).into_owned()
        };
        find_stale_records(&program, STEP).iter().map(|found| (found.code.id(), shown(found))).collect()
    }

    fn shift([x, y, z, i, j, k]: [f64; 6]) -> [f64; 6] {
        [x + 1.0, y + 2.0, z, i, j, k]
    }

    fn raise([x, y, z, i, j, k]: [f64; 6]) -> [f64; 6] {
        [x, y, z + 5.0, i, j, k]
    }

    fn turn([x, y, z, i, j, k]: [f64; 6]) -> [f64; 6] {
        [x, -z, y, i, -k, j]
    }

    fn scale([x, y, z, i, j, k]: [f64; 6]) -> [f64; 6] {
        [x * 2.0, y * 2.0, z * 2.0, i, j, k]
    }

    fn mirror([x, y, z, i, j, k]: [f64; 6]) -> [f64; 6] {
        [-x, y, z, -i, j, k]
    }

    const SQUARE: &str = "GOTO/0.0,0.0,0.0\nGOTO/9.0,0.0,0.0\nGOTO/9.0,9.0,0.0\nGOTO/0.0,9.0,4.0\n";

    /// Returns which of the changes leave a record behind, in the order shift, raise, turn, scale, mirror.
    fn left_by(head: &str, code: &'static str) -> [bool; 5] {
        let text = format!("{head}{SQUARE}");
        let changes: [fn([f64; 6]) -> [f64; 6]; 5] = [shift, raise, turn, scale, mirror];
        changes.map(|change| {
            let found = after(&text, change);
            assert!(found.iter().all(|(id, _)| *id == code), "{head}: {found:?}");
            !found.is_empty()
        })
    }

    #[test]
    fn a_record_is_left_behind_by_the_moves_that_change_what_it_says() {
        let (no, yes) = (false, true);
        let rows = [
            ("$$*CATIA0\n$$ A\n$$ 1. 0. 0. 0.\n$$ 0. 1. 0. 0.\n$$ 0. 0. 1. 0.\n", "CL0180", [yes; 5]),
            ("CAMERA/1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.\n", "CL0180", [yes; 5]),
            ("PPRINT/ESCAPE-HEIGHT,50.0\n", "CL0181", [no, yes, yes, yes, no]),
            ("PPRINT/PART-LEAST,0.0000001\n", "CL0181", [no, yes, yes, yes, no]),
            ("CLEARP/XYPLAN,50.0\n", "CL0181", [no, yes, yes, yes, no]),
            ("CLEARP/YZPLAN,50.0\n", "CL0181", [yes; 5]),
            ("BOX/ 0.0,9.0,0.0,9.0,0.0,9.0\n", "CL0181", [yes; 5]),
            ("INSERT/Stock Size X9. Y9. Z9.\n", "CL0181", [no, no, yes, yes, yes]),
            ("CYCLE/DRILL,RAPTO,3.0,FEDTO,-9.0\nCYCLE/OFF\n", "CL0182", [no, no, no, yes, no]),
            ("CUTCOM/LEFT\n", "CL0183", [no, no, no, no, yes]),
            ("MSYS/0.,0.,0.,1.,0.,0.,0.,1.,0.\nINSERT/text\nPPRINT/text\nCOOLNT/ON\n", "", [no; 5]),
        ];
        for (head, code, expected) in rows {
            assert_eq!(left_by(head, code), expected, "{head}");
        }
    }

    #[test]
    fn the_whole_record_is_shown_without_its_line_end() {
        let text = format!("PPRINT/ESCAPE-HEIGHT,50.0 \r\n{SQUARE}");
        assert_eq!(after(&text, raise), [("CL0181", "PPRINT/ESCAPE-HEIGHT,50.0".to_owned())]);
    }

    #[test]
    fn a_frame_of_solidworks_is_left_behind_when_its_axis_is() {
        let text = "CSYS/1.,0,0,0,0,1.,0,0,0,0,1.,0\nTRNTYP/WORLD,0,0,0\nGOTO/0.,0.,0.,0.,0.,1.\n";
        assert_eq!(after(text, shift), []);
        // The point stays at 0,0,0; the axis alone turns.
        let found = after(text, turn);
        assert_eq!(found.iter().map(|(id, _)| *id).collect::<Vec<_>>(), ["CL0180"]);
    }

    #[test]
    fn a_correction_of_some_points_leaves_nothing_behind() {
        let text = format!("BOX/ 0.0,9.0,0.0,9.0,0.0,9.0\n{SQUARE}GOTO/1.0,2.0,3.0\n");
        let lower = |[x, y, z, i, j, k]: [f64; 6]| [x, y, if x > 1.0 { z - y - 1.0 } else { z }, i, j, k];
        assert_eq!(after(&text, lower), []);
    }

    #[test]
    fn nothing_is_stale_when_no_point_moved_or_the_step_edited_the_record() {
        let text = format!("PPRINT/ESCAPE-HEIGHT,50.0\n{SQUARE}");
        assert_eq!(after(&text, |same| same), []);
        let source = Source::new("part", text.into_bytes()).unwrap();
        let mut program = parse(&source, None).program;
        for text in ["PPRINT/ESCAPE-HEIGHT,55.0\n", "GOTO/0.0,0.0,5.0\n"] {
            let (record, _) = read_record(text.as_bytes()).unwrap();
            let id = program.statement_ids().nth(usize::from(text.starts_with('G'))).unwrap();
            program.replace_statement(id, text.as_bytes(), record, STEP);
        }
        assert!(find_stale_records(&program, STEP).is_empty());
        assert!(find_stale_records(&program, StepId(0)).is_empty());
    }
}
