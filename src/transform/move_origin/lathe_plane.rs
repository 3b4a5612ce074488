//! A lathe's path lies in one plane: a turn or mirror that takes it out of that plane makes no path.

use super::move_tracker::MoveRefusal;
use crate::program::{Program, Record};
use crate::transform::{Affine, SelectedStatements};

/// How far a point may leave the plane for having been rounded, in the file's unit.
const SAME_PLANE: f64 = 1e-4;

/// Checks that the points of a turning program stay in their plane, which is y = 0 in all dialects.
///
/// # Errors
/// The first point that would leave it.
pub(super) fn check_lathe_plane(
    program: &Program,
    place: &Affine,
    scope: &SelectedStatements,
) -> Result<(), MoveRefusal> {
    if !program.is_turning() {
        return Ok(());
    }
    for (id, statement) in program.live_statements().filter(|(id, _)| scope.contains(*id)) {
        let Record::Goto(goto) = statement.record() else { continue };
        if goto.point.y == 0.0 && place.transform_point(goto.point).y.abs() > SAME_PLANE {
            return Err(MoveRefusal {
                message: "this program turns, and its path would leave the plane y = 0 in which a lathe moves. Move along x and z, \
                          or mirror in x or z",
                statement: id,
                label: "would leave the plane",
            });
        }
    }
    Ok(())
}
