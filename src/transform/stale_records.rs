//! This module reports records that a step makes untrue: heights, boxes and frames that only the CAM system
//! or the post understands.
//!
//! A step that moves or rescales the path reports them, with one finding for each kind at its first record.

use super::statement_numbers::major_word;
use super::{Affine, StepContext};
use crate::diagnostic::{Diagnostic, codes};
use crate::parse;
use crate::program::record::{FrameRecord, FrameWord};
use crate::program::{NumberRole, Program, Record, StatementId};
use std::borrow::Cow;

/// A kind of record that has become stale, and the reason.
type StaleRecord = (&'static str, &'static str);

/// Reports records that do not fit any more after the points have moved.
pub(super) fn report_stale_after_move(program: &Program, place: &Affine, context: &mut StepContext<'_>) {
    let turns = place.changes_directions();
    let height = place.linear.row(2) != nalgebra::RowVector3::new(0.0, 0.0, 1.0) || place.offset.z != 0.0;
    report_stale_records(program, context, |record, text| match record {
        Record::FrameMark => Some((
            "CATIA0",
            "the matrix in these comments still says where the points were in the part before they moved",
        )),
        Record::Frame(frame) => explain_stale_frame(frame, turns),
        Record::Known => match major_word(text).as_ref() {
            "BOX" => Some(("BOX", "this box still bounds the path as it was before the points moved")),
            "CLEARP" | "RETRCT" | "SAFETY" | "CLRSRF" if has_number(text) => {
                Some(("CLEARP", "this height or plane was set for the path before the points moved"))
            }
            "PSIS" if has_plain_number(text) => {
                Some(("PSIS", "this part surface was set for the path before the points moved"))
            }
            "TRACUT" if has_number(text) => {
                Some(("TRACUT", "the post transforms the points by this matrix after they have moved"))
            }
            _ => None,
        },
        Record::Text if height && is_escape_height(text) => {
            Some(("ESCAPE-HEIGHT", "this escape height was set for the path before the points moved"))
        }
        Record::Text if turns && is_stock_size(text) => {
            Some(("STOCK", "this stock size names the sides as they lay before the points turned"))
        }
        _ => None,
    });
}

/// Reports records that are still in the old unit after lengths were converted.
pub(super) fn report_stale_after_conversion(program: &Program, context: &mut StepContext<'_>) {
    report_stale_records(program, context, |record, text| match record {
        Record::Text if is_escape_height(text) => {
            Some(("ESCAPE-HEIGHT", "this escape height is still in the old unit"))
        }
        Record::Text if text_behind_slash(text).starts_with("PART-LEAST") => {
            Some(("PART-LEAST", "this resolution is still in the old unit"))
        }
        Record::Text if is_stock_size(text) => Some(("STOCK", "this stock size is still in the old unit")),
        _ => None,
    });
}

fn explain_stale_frame(frame: &FrameRecord, turns: bool) -> Option<StaleRecord> {
    match frame.word {
        // Points that move within their frame are intended.
        FrameWord::Msys => None,
        FrameWord::Csys => Some((
            "CSYS",
            "this matrix was written for the points as they were; it is left as it is, since the points moved",
        )),
        FrameWord::Trans | FrameWord::Origin if turns => Some((
            "TRANS",
            "the post shifts the points by this after they have turned; the shift itself did not turn",
        )),
        FrameWord::Trans | FrameWord::Origin => None,
        FrameWord::Rotary if frame.numbers.iter().any(|number| *number != 0.0) => Some((
            "ROTABL",
            "the table turns here; the points after it moved in the turned frame, in which they are printed",
        )),
        FrameWord::Rotary => None,
    }
}

fn report_stale_records(
    program: &Program,
    context: &mut StepContext<'_>,
    stale: impl Fn(&Record, &[u8]) -> Option<StaleRecord>,
) {
    let mut seen: Vec<&'static str> = Vec::new();
    for (id, statement) in program.live_statements() {
        if matches!(statement.record(), Record::Goto(_)) {
            continue;
        }
        if let Some((kind, message)) = stale(statement.record(), program.statement_text(statement))
            && !seen.contains(&kind)
        {
            seen.push(kind);
            let finding = stale_finding(program, id, message, context);
            context.findings.push(finding);
        }
    }
}

fn stale_finding(program: &Program, id: StatementId, message: &str, context: &StepContext<'_>) -> Diagnostic {
    let span = program.statement(id).origin();
    let finding =
        Diagnostic::new(codes::STALE_RECORD, message).with_label(program.source(), span, "left unchanged");
    context.label_step(finding, "by this step")
}

/// Returns whether a PSIS has a number, not zero, that no geometry in it explains.
fn has_plain_number(text: &[u8]) -> bool {
    let roles = parse::number_roles(&Record::Known, text);
    let mut numbers = parse::statement_numbers(text).into_iter().zip(roles);
    numbers.any(|((_, value), role)| value != 0.0 && role == NumberRole::Plain)
}

fn has_number(text: &[u8]) -> bool {
    !parse::statement_numbers(text).is_empty()
}

fn is_escape_height(text: &[u8]) -> bool {
    text_behind_slash(text).starts_with("ESCAPE-HEIGHT")
}

fn is_stock_size(text: &[u8]) -> bool {
    text_behind_slash(text).starts_with("STOCK SIZE")
}

/// Returns the text after the word of a free text (`PPRINT/ESCAPE-HEIGHT,50.0`), in upper case.
fn text_behind_slash(text: &[u8]) -> Cow<'_, str> {
    let rest = text.iter().position(|byte| *byte == b'/').and_then(|at| text.get(at + 1..));
    crate::program::fold_text(rest.unwrap_or_default().trim_ascii())
}
