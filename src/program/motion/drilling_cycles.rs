//! This module resolves drilling cycles: it plans one hole as a group of motions.

use crate::program::geometry::{MotionPath, Pose, SAME_POINT};
use crate::program::record::{CycleKind, DrillingCycle};

/// One move in a hole.
pub(super) struct HoleMove {
    pub(super) from: Pose,
    pub(super) to: Pose,
    pub(super) path: MotionPath,
    pub(super) rapid: bool,
}

/// Plans the moves of one hole: at rapid to above the hole and down to the clearance, at feed to the depth,
/// and back.
///
/// Distances are along the tool axis from the hole's point. NX prints a coordinate after FEDTO (negative is
/// below the point); all other forms print a depth (measured: SolidWorks `FEDTO,5.4` for a hole 5.4 deep).
/// The tool comes back to the retract height if one is given, else to the clearance.
pub(super) fn plan_hole_moves(
    cycle: &DrillingCycle,
    nx: bool,
    at: Option<Pose>,
    hole: Pose,
) -> Vec<HoleMove> {
    let above = |height: f64| Pose { point: hole.point + hole.axis * height, axis: hole.axis };
    let depth = cycle.depth.unwrap_or(0.0);
    let bottom = above(if nx && cycle.depth_is_fedto { depth } else { -depth.abs() });
    let clearance_height = cycle.clearance.unwrap_or(0.0);
    let clearance = above(clearance_height);
    // A retract height below the clearance would leave the tool in the hole.
    let retract = above(cycle.retract.map_or(clearance_height, |retract| retract.max(clearance_height)));
    let mut legs = Vec::with_capacity(4);
    let mut position = at;
    // A move without length is left out, except the first one of a file, which sets the position.
    let mut go = |to: Pose, rapid: bool| {
        let from = position.unwrap_or(to);
        let path = if position.is_some() { MotionPath::Line } else { MotionPath::Start };
        if position.is_none() || (to.point - from.point).norm() > SAME_POINT {
            legs.push(HoleMove { from, to, path, rapid });
            position = Some(to);
        }
    };
    // The approach is at the tool's current height if that is above the clearance.
    let height = at.map_or(clearance_height, |pose| (pose.point - hole.point).dot(&hole.axis));
    if height > clearance_height {
        go(above(height), true);
    }
    go(clearance, true);
    go(bottom, false);
    // Only a drill may leave its hole at rapid. A tap would tear the thread, and a reamer mark the wall.
    go(retract, cycle.kind == CycleKind::Drill);
    legs
}
