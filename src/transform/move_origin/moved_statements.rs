//! This module gives statements the numbers of their new place, many at once: printing and reading back numbers is
//! most of the work of a move, and no statement needs another one for it.

use crate::diagnostic::Failure;
use crate::parse::StatementNumbers;
use crate::program::record::ArcSense;
use crate::program::{NumberRole, Record, StatementId};
use crate::transform::Affine;
use crate::transform::statement_numbers;
use crate::write::ProgramEditor;
use nalgebra::Vector3;

/// So many statements wait at most. Their new texts and records take half a megabyte.
const MOST_WAITING: usize = 1 << 12;

/// Statements that wait for their new numbers, in the order of the program.
pub(super) struct MovedStatements<'p> {
    place: &'p Affine,
    /// Each with whether MULTAX is in force at it.
    waiting: Vec<(StatementId, bool)>,
}

impl<'p> MovedStatements<'p> {
    pub(super) fn new(place: &'p Affine) -> Self {
        Self { place, waiting: Vec::new() }
    }

    /// Returns whether a statement may hold points or directions.
    pub(super) fn has_place(record: &Record) -> bool {
        matches!(
            record,
            Record::Goto(_)
                | Record::Points(_)
                | Record::From(_)
                | Record::GoHome(Some(_))
                | Record::GoDelta(_)
                | Record::Circle(_)
                | Record::MoveArc(_)
                | Record::StartDirection(_)
                | Record::DriveArc(_)
                | Record::AxialArc(_)
                | Record::Known
                | Record::Control(_)
                | Record::ToolAxis(_)
        )
    }

    /// Lets a statement wait, and moves all that wait when they are many.
    ///
    /// # Errors
    /// Returns the errors of [`MovedStatements::move_waiting`].
    pub(super) fn add(
        &mut self,
        id: StatementId,
        multi_axis: bool,
        editor: &mut ProgramEditor,
    ) -> Result<(), Failure> {
        self.waiting.push((id, multi_axis));
        if self.waiting.len() < MOST_WAITING { Ok(()) } else { self.move_waiting(editor) }
    }

    /// Moves the statements that wait. It comes before any other edit of one of them.
    ///
    /// # Errors
    /// Returns an error if new numbers cannot be printed as a statement that reads back.
    pub(super) fn move_waiting(&mut self, editor: &mut ProgramEditor) -> Result<(), Failure> {
        let place = self.place;
        let moved = editor.set_numbers_of_many(&self.waiting, |multi_axis, record, numbers, edits| {
            add_edits(record, numbers, place, multi_axis, edits);
        });
        self.waiting.clear();
        moved
    }
}

/// Adds the new values of a statement's numbers.
fn add_edits(
    record: &Record,
    numbers: &StatementNumbers,
    place: &Affine,
    multi_axis: bool,
    edits: &mut Vec<(usize, f64)>,
) {
    let in_words = matches!(record, Record::Circle(circle) if circle.sense != ArcSense::OfDialect);
    let change = |role: NumberRole, value: Vector3<f64>| match role {
        NumberRole::Point(_) => Some(place.transform_point(value.into()).coords),
        _ if !place.changes_directions() => None,
        // When the sense of an arc is stated by a word, that word is swapped, and the axis is a plain
        // direction.
        NumberRole::ArcAxis(_) if !in_words => Some(place.transform_arc_axis(value)),
        NumberRole::ArcAxis(_) | NumberRole::Step(_) | NumberRole::Direction(_) => {
            Some(place.transform_vector(value))
        }
        _ => None,
    };
    let without_multax = statement_numbers::roles_without_multax(record, multi_axis);
    let roles = without_multax.as_deref().unwrap_or(&numbers.roles);
    let value = |index: usize| numbers.places.get(index).map(|(_, value)| *value);
    statement_numbers::add_triples(value, roles, change, edits);
    if *record == Record::Known {
        add_plane_distances(value, roles, place, edits);
    }
}

/// Adds the new distances of planes, which stand behind their normals: `PSIS/(PLANE/0,0,1,-12)`. A plane holds the points
/// whose product with the normal is the distance.
fn add_plane_distances(
    value: impl Fn(usize) -> Option<f64>,
    roles: &[NumberRole],
    place: &Affine,
    edits: &mut Vec<(usize, f64)>,
) {
    for (start, four) in roles.windows(4).enumerate() {
        let [
            NumberRole::Direction(0),
            NumberRole::Direction(1),
            NumberRole::Direction(2),
            NumberRole::Length,
        ] = four
        else {
            continue;
        };
        let (Some(x), Some(y), Some(z), Some(distance)) =
            (value(start), value(start + 1), value(start + 2), value(start + 3))
        else {
            continue;
        };
        let normal = place.transform_vector(Vector3::new(x, y, z));
        edits.push((start + 3, distance + normal.dot(&place.offset)));
    }
}
