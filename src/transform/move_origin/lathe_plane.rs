//! A lathe's path lies in one plane: a turn or mirror that takes it out of that plane, or turns the plane over, makes no
//! path. A shift across the plane only sets another zero, so it is told and done.

use super::move_tracker::MoveRefusal;
use crate::diagnostic::{Diagnostic, codes};
use crate::program::{Program, StatementId, TurningPlane};
use crate::transform::{Affine, SelectedStatements, StepContext};

/// How far a point may leave the plane for having been rounded, in the file's unit.
const SAME_PLANE: f64 = 1e-4;

/// Checks that the points of a turning program stay in their plane, on its side. Returns the finding of a shift that takes
/// them to another plane.
///
/// # Errors
/// The first point that a turn or mirror takes out of the plane, or that would be seen from its other side.
pub(super) fn check_lathe_plane(
    program: &Program,
    place: &Affine,
    scope: &SelectedStatements,
    context: &StepContext<'_>,
) -> Result<Option<Diagnostic>, MoveRefusal> {
    let Some(plane) = program.turning_plane() else { return Ok(None) };
    let turned_over = !place.keeps_direction(plane.normal());
    let mut found = None;
    program.for_each_turned_point(|id, point| {
        if found.is_some() || !scope.contains(id) || plane.offset(point) != 0.0 {
            return;
        }
        let leaves = plane.offset(place.transform_point(point)).abs() > SAME_PLANE;
        if leaves || turned_over {
            found = Some((id, leaves));
        }
    });
    match found {
        None => Ok(None),
        Some((statement, _)) if !place.changes_directions() => {
            Ok(Some(describe_shift(program, plane, statement, context)))
        }
        Some((statement, leaves)) => Err(describe_refusal(plane, statement, leaves)),
    }
}

fn describe_shift(
    program: &Program,
    plane: TurningPlane,
    statement: StatementId,
    context: &StepContext<'_>,
) -> Diagnostic {
    let message = match plane {
        TurningPlane::Zx => "this program turns, and its path leaves the plane y = 0 in which a lathe moves",
        TurningPlane::Xy => {
            "this program turns, and its path leaves the plane z = 0 in which this lathe moves"
        }
    };
    let span = program.statement(statement).origin();
    let finding = Diagnostic::new(codes::LATHE_PLANE_LEFT, message).with_label(
        program.source(),
        span,
        "leaves the plane",
    );
    context.label_step(finding, "by this step")
}

fn describe_refusal(plane: TurningPlane, statement: StatementId, leaves: bool) -> MoveRefusal {
    let message = match (plane, leaves) {
        (TurningPlane::Zx, true) => {
            "this program turns, and its path would leave the plane y = 0 in which a lathe moves. Move along x and z, or \
             mirror in x"
        }
        (TurningPlane::Xy, true) => {
            "this program turns, and its path would leave the plane z = 0 in which this lathe moves. Move along x and y, or \
             mirror in x or y"
        }
        (TurningPlane::Zx, false) => {
            "this program turns in the plane y = 0, which would be turned over: left and right of the path and the sense of its \
             arcs would no longer fit. Mirror in x"
        }
        (TurningPlane::Xy, false) => {
            "this program turns in the plane z = 0, which would be turned over: left and right of the path and the sense of its \
             arcs would no longer fit. Mirror in x or y"
        }
    };
    let label = if leaves { "would leave the plane" } else { "would be seen from the other side" };
    MoveRefusal { message, statement, label }
}
