//! With `change: frame`, the points stay, and the frame in which they are printed moves them.
//!
//! The transform `T` is given in printed coordinates. A frame `F` that maps printed coordinates to outside
//! ones becomes `F * T`. A frame `M` that has already mapped outside coordinates to the printed ones (Creo)
//! becomes `T^-1 * M`.

use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::program::record::{FrameRecord, FrameWord};
use crate::program::{Dialect, Program, Record, StatementId};
use crate::transform::statement_numbers::{MatrixRowCounter, set_matrix_row};
use crate::transform::{Affine, SelectedStatements, StepContext};
use crate::write::ProgramEditor;
use nalgebra::{Matrix3, Vector3};

/// Moves the frames of the selected operations.
///
/// # Errors
/// Returns an error if there is no frame, or if one cannot take the transform.
pub(super) fn move_frames(
    program: Program,
    place: &Affine,
    scope: &SelectedStatements,
    context: &mut StepContext<'_>,
) -> Result<Program, Failure> {
    if place.has_mirror() {
        return Err(context.step_failure(
            "a frame is right-handed and cannot hold a mirror; mirror the points (`change: points`)",
            &["mirror"],
        ));
    }
    check_motions_in_frames(&program, place, scope, context)?;
    let mut editor = ProgramEditor::new(program, context.step);
    let mut rows = MatrixRowCounter::default();
    let mut comment_frame = None;
    for id in editor.program().statement_ids() {
        let statement = editor.program().statement(id);
        if !statement.is_live() {
            continue;
        }
        let row = rows.observe_record(statement.record());
        if !scope.contains(id) {
            continue;
        }
        match (statement.record(), row) {
            (Record::Frame(frame), _) => {
                let edits = compute_frame_edits(frame, place);
                editor.set_numbers(id, &edits)?;
            }
            (Record::MatrixRow(numbers), Some(_)) => {
                let edits = compute_row_edits(numbers, place);
                set_matrix_row(&mut editor, id, &edits)?;
                comment_frame.get_or_insert(id);
            }
            _ => {}
        }
    }
    if let Some(id) = comment_frame {
        let message =
            "the matrix stands in comments: a post that does not read them moves the tool as before";
        let span = editor.program().statement(id).origin();
        let finding = Diagnostic::new(codes::COMMENT_FRAME, message);
        context.findings.push(finding.with_label(editor.program().source(), span, "changed here"));
    }
    editor.finish()
}

/// Checks that every selected motion is in a frame that changes, and no other motion is.
fn check_motions_in_frames(
    program: &Program,
    place: &Affine,
    scope: &SelectedStatements,
    context: &StepContext<'_>,
) -> Result<(), Failure> {
    if program.dialect() == Dialect::SolidWorks {
        return Err(context.step_failure(
            "SolidWorks CAM prints its points in world coordinates (TRNTYP/WORLD): its CSYS says how the setup stands and does \
             not map the points; use `change: points`",
            &["change"],
        ));
    }
    let mut rows = MatrixRowCounter::default();
    let mut frame = None;
    for (id, statement) in program.live_statements() {
        let record = statement.record();
        let row = rows.observe_record(record);
        if let (Record::Frame(found), true) = (record, scope.contains(id)) {
            check_frame(found, place, program, id, context)?;
        }
        match record {
            Record::Frame(found) if matches!(found.word, FrameWord::Msys | FrameWord::Csys) => {
                frame = Some(id);
            }
            _ if row == Some(2) => frame = Some(id),
            _ if record.is_motion() || matches!(record, Record::From(_)) => {
                let moved = scope.contains(id);
                match frame {
                    None if moved => return Err(missing_frame_error(program, id, context)),
                    Some(frame) if scope.contains(frame) != moved => {
                        let message = "the same frame governs selected operations and others; select all of them, or use \
                                       `change: points`";
                        return Err(context.statement_failure(
                            message,
                            program,
                            id,
                            "stands in the same frame",
                        ));
                    }
                    _ => {}
                }
            }
            _ => {}
        }
    }
    if frame.is_none() {
        let finding = context.step_finding(codes::STEP_FAILED, NO_FRAME, &["change"], "asked for here");
        return Err(finding.with_help(HELP).into());
    }
    Ok(())
}

const NO_FRAME: &str =
    "there is no frame record (MSYS, CSYS, CAMERA, `$$*CATIA0`) that could move the points";
const HELP: &str = "Use `change: points`, which is also the default.";

fn missing_frame_error(program: &Program, id: StatementId, context: &StepContext<'_>) -> Failure {
    context.statement_finding(NO_FRAME, program, id, "stands in no frame").with_help(HELP).into()
}

fn check_frame(
    frame: &FrameRecord,
    place: &Affine,
    program: &Program,
    id: StatementId,
    context: &StepContext<'_>,
) -> Result<(), Failure> {
    let message = match (frame.word, program.dialect()) {
        (FrameWord::Csys, Dialect::Creo | Dialect::CreoGpost) if place.changes_directions() => {
            "the sense in which this matrix rotates is not known for Creo (it was only measured that its translation is \
             already in the points), so only `translate` can be put into it; use `change: points`"
        }
        (FrameWord::Csys, Dialect::Creo | Dialect::CreoGpost) if !has_identity_axes(frame) => {
            "this matrix rotates, in a sense that is not known for Creo, so a translation cannot be put into it; use `change: points`"
        }
        (FrameWord::Csys, Dialect::Creo | Dialect::CreoGpost) => return Ok(()),
        (FrameWord::Trans | FrameWord::Origin, _)
            if place.changes_directions() && frame.numbers.iter().any(|number| *number != 0.0) =>
        {
            "the post shifts the points by this before the frame rotates them, so a rotation cannot be put into the frame"
        }
        (FrameWord::Csys, _) => {
            "it is not known for this dialect in which direction this matrix maps the points; use `change: points`"
        }
        _ => return Ok(()),
    };
    Err(context.statement_failure(message, program, id, "the frame"))
}

fn has_identity_axes(frame: &FrameRecord) -> bool {
    matches!(frame.numbers.as_slice(), [a, b, c, _, d, e, f, _, g, h, i, _]
        if Matrix3::new(*a, *b, *c, *d, *e, *f, *g, *h, *i) == Matrix3::identity())
}

fn compute_frame_edits(frame: &FrameRecord, place: &Affine) -> Vec<(usize, f64)> {
    match (frame.word, frame.numbers.as_slice()) {
        (FrameWord::Msys, [ox, oy, oz, xi, xj, xk, yi, yj, yk]) => {
            let (x, y) = (Vector3::new(*xi, *xj, *xk), Vector3::new(*yi, *yj, *yk));
            let axes = Matrix3::from_columns(&[x, y, x.cross(&y)]);
            // F * T: the columns of F turn the offset of T into outside coordinates.
            let origin = Vector3::new(*ox, *oy, *oz) + axes * place.offset;
            let mut edits: Vec<_> = origin.iter().copied().enumerate().collect();
            if place.changes_directions() {
                let turned = axes * place.linear;
                // nalgebra stores columns one after the other, so the first six numbers are the two columns
                // that MSYS prints.
                edits.extend(turned.iter().take(6).enumerate().map(|(index, value)| (index + 3, *value)));
            }
            edits
        }
        // Creo has already applied the frame, and its own rotation is the identity here. So T^-1 * M only
        // subtracts the translation.
        (FrameWord::Csys, [_, _, _, x, _, _, _, y, _, _, _, z]) => {
            vec![(3, x - place.offset.x), (7, y - place.offset.y), (11, z - place.offset.z)]
        }
        _ => Vec::new(),
    }
}

/// Returns the edits of a row of CATIA's matrix: three numbers of the rotation and one of the translation.
fn compute_row_edits(row: &[f64; 4], place: &Affine) -> Vec<(usize, f64)> {
    let [a, b, c, d] = *row;
    // This is one row of the product F * T: its axes times T's directions, and its origin plus its axes times
    // T's offset.
    let axes = nalgebra::RowVector3::new(a, b, c);
    let mut edits = vec![(3, d + (axes * place.offset).x)];
    if place.changes_directions() {
        edits.extend((axes * place.linear).iter().copied().enumerate());
    }
    edits
}
