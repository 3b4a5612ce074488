//! `change: points`: every number of the path gets its new value.

use super::scope::Scope;
use super::walk::{Refusal, Walk};
use super::{axes, sides};
use crate::diagnostic::Diagnostic;
use crate::parse;
use crate::program::record::{ArcSense, CutterCompensation};
use crate::program::{Program, Record, Role};
use crate::transform::numbers::{self, word};
use crate::transform::{Affine, Context};
use crate::write::{self, Editor};
use nalgebra::Vector3;

/// Moves the points of the operations in scope.
///
/// # Errors
/// Where the file does not allow it; nothing is half done, because the program is gone.
pub fn change(
    program: Program,
    place: &Affine,
    scope: &Scope,
    context: &mut Context<'_>,
) -> Result<Program, Box<Diagnostic>> {
    let mut walk = Walk::new(place, program.dialect());
    let six_values_seen =
        program.live().any(|(_, it)| matches!(it.record(), Record::Goto(goto) if goto.axis.is_some()));
    let mut editor = Editor::new(program, context.step);
    let mut plane_reported = false;
    for index in 0..editor.program().statements().len() {
        let program = editor.program();
        let Some(statement) = program.statement(index).filter(|statement| statement.is_live()) else {
            continue;
        };
        let moved = scope.contains(index);
        let text = program.text(statement);
        let record = statement.record();
        let refused =
            |refusal: Refusal| context.fail_at(refusal.message, program, refusal.statement, refusal.label);
        let need = walk.read(index, record, text, moved).map_err(refused)?;
        if moved {
            if let Some(refusal) = unmovable(record, text, index) {
                return Err(refused(refusal));
            }
            let edits = edits(record, text, place, walk.multi_axis());
            let words = Words::of(record, text);
            if words == Words::Sides && !plane_kept(program, index, record, place, &walk).map_err(refused)? {
                if !plane_reported {
                    let message = "this CUTCOM names no plane, and the tool axis it works about turns";
                    context.not_changed(message, editor.program(), index);
                }
                plane_reported = true;
            }
            if !edits.is_empty() {
                editor.set_numbers(index, &edits)?;
            }
            if place.mirrors() {
                match words {
                    Words::Sides => sides::swap_sides(&mut editor, index)?,
                    Words::Senses => sides::swap_senses(&mut editor, index)?,
                    Words::None => {}
                }
            }
        }
        if let Some(need) = need {
            match axes::write(&mut editor, index, need, walk.multi_axis(), six_values_seen)? {
                axes::Written::Done => {}
                axes::Written::WithMultax => walk.multax_inserted(),
                axes::Written::Impossible => {
                    let message = "the transform turns the tool axis, and this motion cannot state one in this dialect: nothing \
                                   before it does either";
                    let label = "has the axis 0,0,1 only by default";
                    return Err(context.fail_at(message, editor.program(), index, label));
                }
            }
        }
    }
    walk.finish().map_err(|refusal| {
        context.fail_at(refusal.message, editor.program(), refusal.statement, refusal.label)
    })?;
    editor.finish()
}

/// The new values of a statement's numbers.
fn edits(record: &Record, text: &[u8], place: &Affine, multi_axis: bool) -> Vec<(usize, f64)> {
    let in_words = matches!(record, Record::Circle(circle) if circle.sense != ArcSense::OfDialect);
    let change = |role: Role, value: Vector3<f64>| match role {
        Role::Point(_) => Some(place.point(value.into()).coords),
        _ if !place.turns() => None,
        // The word of the sense is swapped instead, and the axis is a plain direction.
        Role::ArcAxis(_) if !in_words => Some(place.arc_axis(value)),
        Role::ArcAxis(_) | Role::Step(_) | Role::Direction(_) => Some(place.vector(value)),
        _ => None,
    };
    match record {
        Record::Goto(goto) => {
            let axis = goto.axis.unwrap_or_default();
            let values = [goto.point.x, goto.point.y, goto.point.z, axis.x, axis.y, axis.z];
            let roles = [Role::Point(0), Role::Plain, Role::Plain, Role::Direction(0)];
            let count = if goto.axis.is_some() { 4 } else { 1 };
            numbers::change_triples(&values, roles.get(..count).unwrap_or_default(), change)
        }
        Record::Points(_)
        | Record::From(_)
        | Record::GoHome(Some(_))
        | Record::GoDelta(_)
        | Record::Circle(_)
        | Record::MoveArc(_)
        | Record::StartDirection(_)
        | Record::DriveArc(_)
        | Record::Control(_)
        | Record::ToolAxis(_) => {
            let values: Vec<f64> = parse::numbers(text).into_iter().map(|(_, value)| value).collect();
            numbers::change_triples(&values, &numbers::roles(record, text, multi_axis), change)
        }
        _ => Vec::new(),
    }
}

/// Words of left and right in a statement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Words {
    None,
    Sides,
    Senses,
}

impl Words {
    fn of(record: &Record, text: &[u8]) -> Self {
        match record {
            Record::CutterCompensation(_) => Self::Sides,
            Record::Known if word(text) == "CUTCOM" => Self::Sides,
            Record::Circle(circle) if circle.sense != ArcSense::OfDialect => Self::Senses,
            _ => Self::None,
        }
    }
}

/// Whether the plane that compensation works in is still the one that its record means; a named plane has to be.
fn plane_kept(
    program: &Program,
    index: usize,
    record: &Record,
    place: &Affine,
    walk: &Walk<'_>,
) -> Result<bool, Refusal> {
    let normal = write::syntax(program, index).as_ref().and_then(sides::plane_normal);
    match normal {
        Some(normal) if !sides::keeps_plane(place, normal) => Err(Refusal {
            message: "the transform turns the plane of cutter compensation away from the one that CUTCOM names",
            statement: index,
            label: "names its plane",
        }),
        Some(_) => Ok(true),
        None => {
            Ok(!matches!(record, Record::CutterCompensation(CutterCompensation::On(_))) || walk.keeps_axis())
        }
    }
}

/// Motions of part programs that no record describes: their places cannot be changed, and leaving them would cut across.
fn unmovable(record: &Record, text: &[u8], index: usize) -> Option<Refusal> {
    const MOTIONS: &[&str] =
        &["TLON", "TLLFT", "TLRGT", "GOFWD", "GOBACK", "GOLFT", "GORGT", "GOUP", "GODOWN", "POCKET"];
    let stands_in_the_way = *record == Record::Other && {
        let word = word(text);
        MOTIONS.iter().any(|motion| word.starts_with(motion))
    };
    stands_in_the_way.then_some(Refusal {
        message: "this motion has a form that clsmith does not understand, so it cannot be moved with the others",
        statement: index,
        label: "would stay where it is",
    })
}
