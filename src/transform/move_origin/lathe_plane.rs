//! A lathe's path lies in one plane: a turn or mirror that takes it out of that plane, or turns the plane over, makes no
//! path.

use super::move_tracker::MoveRefusal;
use crate::program::{Program, TurningPlane};
use crate::transform::{Affine, SelectedStatements};

/// How far a point may leave the plane for having been rounded, in the file's unit.
const SAME_PLANE: f64 = 1e-4;

/// Checks that the points of a turning program stay in their plane, on its side.
///
/// # Errors
/// The first point that would leave it, or that would be seen from the plane's other side.
pub(super) fn check_lathe_plane(
    program: &Program,
    place: &Affine,
    scope: &SelectedStatements,
) -> Result<(), MoveRefusal> {
    let Some(plane) = program.turning_plane() else { return Ok(()) };
    let turned_over = !place.keeps_direction(plane.normal());
    let mut refused = None;
    program.for_each_turned_point(|id, point| {
        if refused.is_some() || !scope.contains(id) || plane.offset(point) != 0.0 {
            return;
        }
        let leaves = plane.offset(place.transform_point(point)).abs() > SAME_PLANE;
        if leaves || turned_over {
            refused = Some((id, leaves));
        }
    });
    let Some((statement, leaves)) = refused else { return Ok(()) };
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
    Err(MoveRefusal { message, statement, label })
}
