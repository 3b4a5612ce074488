//! Records that a step makes untrue: heights, boxes and frames that only the CAM system or the post understands.
//!
//! A step that moves or rescales the path reports them, one finding for each kind, at the first record of it.

use super::numbers::word;
use super::{Affine, Context};
use crate::diagnostic::{Diagnostic, codes};
use crate::parse;
use crate::program::record::{FrameRecord, FrameWord};
use crate::program::{Program, Record};

/// A kind of record that has become stale, and why.
type Stale = (&'static str, &'static str);

/// Reports what no longer fits after the points moved.
pub fn after_move(program: &Program, place: &Affine, context: &mut Context<'_>) {
    let turns = place.turns();
    let height = place.linear.row(2) != nalgebra::RowVector3::new(0.0, 0.0, 1.0) || place.offset.z != 0.0;
    report(program, context, |record, text| match record {
        Record::FrameMark => Some((
            "CATIA0",
            "the matrix in these comments still says where the points were in the part before they moved",
        )),
        Record::Frame(frame) => stale_frame(frame, turns),
        Record::Known => match word(text).as_str() {
            "BOX" => Some(("BOX", "this box still bounds the path as it was before the points moved")),
            "CLEARP" | "RETRCT" | "SAFETY" | "CLRSRF" if has_number(text) => {
                Some(("CLEARP", "this height or plane was set for the path before the points moved"))
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

/// Reports what is still in the old unit after lengths were converted.
pub fn after_conversion(program: &Program, context: &mut Context<'_>) {
    report(program, context, |record, text| match record {
        Record::Text if is_escape_height(text) => {
            Some(("ESCAPE-HEIGHT", "this escape height is still in the old unit"))
        }
        Record::Text if word_of_text(text).starts_with("PART-LEAST") => {
            Some(("PART-LEAST", "this resolution is still in the old unit"))
        }
        Record::Text if is_stock_size(text) => Some(("STOCK", "this stock size is still in the old unit")),
        _ => None,
    });
}

fn stale_frame(frame: &FrameRecord, turns: bool) -> Option<Stale> {
    match frame.word {
        // Points that move in their frame are what was asked for.
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

fn report(program: &Program, context: &mut Context<'_>, stale: impl Fn(&Record, &[u8]) -> Option<Stale>) {
    let mut seen: Vec<&'static str> = Vec::new();
    for (index, statement) in program.live() {
        if matches!(statement.record(), Record::Goto(_)) {
            continue;
        }
        if let Some((kind, message)) = stale(statement.record(), program.text(statement))
            && !seen.contains(&kind)
        {
            seen.push(kind);
            let finding = finding(program, index, message, context);
            context.findings.push(finding);
        }
    }
}

fn finding(program: &Program, index: usize, message: &str, context: &Context<'_>) -> Diagnostic {
    let span = program.statement(index).map(crate::program::Statement::origin).unwrap_or_default();
    let step = context.recipe.step_place(usize::from(context.step.0));
    Diagnostic::new(codes::STALE_RECORD, message).label(program.source(), span, "left as it is").label(
        &context.recipe.source,
        step,
        "by this step",
    )
}

fn has_number(text: &[u8]) -> bool {
    !parse::numbers(text).is_empty()
}

fn is_escape_height(text: &[u8]) -> bool {
    word_of_text(text).starts_with("ESCAPE-HEIGHT")
}

fn is_stock_size(text: &[u8]) -> bool {
    word_of_text(text).starts_with("STOCK SIZE")
}

/// What stands behind the word of a free text (`PPRINT/ESCAPE-HEIGHT,50.0`), in upper case.
fn word_of_text(text: &[u8]) -> String {
    let rest = text.iter().position(|byte| *byte == b'/').and_then(|at| text.get(at + 1..));
    crate::program::folded(rest.unwrap_or_default().trim_ascii())
}
