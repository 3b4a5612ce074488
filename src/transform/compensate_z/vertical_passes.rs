//! This module finds passes in vertical planes: which motions form them, and what lies between them.

use crate::program::MotionClass;
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::surface::profile::ProfilePlane;
use nalgebra::{Point3, Vector3};
use std::ops::Range;

/// Points that are this near to a plane (mm) lie in it. That is a few of the last digits that files print.
const IN_PLANE: f64 = 2e-3;

/// Moves that are shorter than this across the axis (mm) go straight up or down.
pub(super) const STRAIGHT_DOWN: f64 = 1e-3;

/// Directions that differ by less than this angle (radians) are parallel.
const PARALLEL: f64 = 0.02;

/// A pass in a vertical plane.
#[derive(Debug, Clone)]
pub(super) struct VerticalPass {
    /// Its motions.
    pub motions: Range<usize>,
    /// Its plane, in mm, with u along the pass.
    pub plane: ProfilePlane,
}

/// The reason why a path does not consist of passes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NoPassReason {
    /// A motion leaves the plane of its pass.
    LeavesPlane(usize),
    /// A motion goes back over its pass.
    TurnsBack(usize),
    /// The tool axis turns within the pass.
    AxisTurns(usize),
}

/// Finds the passes among motions. `meant` tells which motions cut. All other motions are links.
///
/// # Errors
/// Returns [`NoPassReason`] if the cutting motions do not keep to vertical planes.
pub(super) fn find_vertical_passes(
    motions: &[Motion],
    meant: &[bool],
    mm_per_unit: f64,
) -> Result<Vec<VerticalPass>, NoPassReason> {
    let mut found = Vec::new();
    for run in find_cutting_runs(motions, meant, mm_per_unit) {
        found.extend(passes_of_run(motions, run, mm_per_unit)?);
    }
    Ok(found)
}

/// Finds the runs of consecutive cutting motions. Straight plunges and retracts at their ends are left out,
/// unless the file marks them as cuts.
pub(super) fn find_cutting_runs(motions: &[Motion], meant: &[bool], mm_per_unit: f64) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut index = 0;
    let means = |index: usize| meant.get(index).copied().unwrap_or(false);
    while index < motions.len() {
        if !means(index) {
            index += 1;
            continue;
        }
        let operation = motions.get(index).map(|motion| motion.operation);
        let mut end = index;
        while means(end) && motions.get(end).map(|motion| motion.operation) == operation {
            end += 1;
        }
        let run = trim_plunge_and_retract(motions, index..end, mm_per_unit);
        if !run.is_empty() {
            found.push(run);
        }
        index = end;
    }
    found
}

/// Removes straight plunges and retracts from the ends of a run. They are removed where the file does not
/// mark what motions are for, and where they adjoin a rapid.
fn trim_plunge_and_retract(motions: &[Motion], mut run: Range<usize>, mm_per_unit: f64) -> Range<usize> {
    let rapid = |index: Option<usize>| {
        index
            .and_then(|index| motions.get(index))
            .is_none_or(|motion| motion.rapid || matches!(motion.path, MotionPath::Start))
    };
    let vertical = |index: usize, up: bool, beside_rapid: bool| {
        motions.get(index).is_some_and(|motion| {
            let displacement = (motion.to.point - motion.from.point) * mm_per_unit;
            let along = displacement.dot(&motion.to.axis);
            (!motion.class_is_stated || beside_rapid)
                && matches!(motion.path, MotionPath::Line)
                && (displacement - motion.to.axis * along).norm() <= STRAIGHT_DOWN
                && (if up { along >= 0.0 } else { along <= 0.0 })
        })
    };
    while !run.is_empty() && vertical(run.start, false, rapid(run.start.checked_sub(1))) {
        run.start += 1;
    }
    while !run.is_empty() && vertical(run.end - 1, true, rapid(Some(run.end))) {
        run.end -= 1;
    }
    run
}

/// A segment of a run that lies in one vertical plane. It has no plane if it is an arc across every vertical
/// plane.
struct PlanarRun {
    motions: Range<usize>,
    plane: Option<(ProfilePlane, Vector3<f64>)>,
    length: f64,
}

fn passes_of_run(
    motions: &[Motion],
    run: Range<usize>,
    mm_per_unit: f64,
) -> Result<Vec<VerticalPass>, NoPassReason> {
    let first = motions.get(run.start);
    let turns = |motion: &&Motion| {
        first.is_some_and(|first| {
            (motion.from.axis - first.from.axis).amax() > 1e-6
                || (motion.to.axis - first.from.axis).amax() > 1e-6
        })
    };
    let all = motions.get(run.clone());
    debug_assert!(all.is_some(), "a run consists of motions of the program");
    let all = all.unwrap_or_default();
    // The profile of a pass has a single axis. Where the tool turns, no vertical plane tells what the ball
    // touches.
    if let Some(at) = all.iter().position(|motion| turns(&motion)) {
        return Err(NoPassReason::AxisTurns(run.start + at));
    }
    let segments = split_into_planar_runs(motions, run, mm_per_unit);
    let main = find_main_direction(&segments);
    let along =
        |segment: &PlanarRun| segment.plane.is_some_and(|(_, direction)| is_parallel(direction, main));
    let (passes, links): (Vec<&PlanarRun>, Vec<&PlanarRun>) =
        segments.iter().partition(|segment| along(segment));
    let sum = |all: &[&PlanarRun]| all.iter().map(|segment| segment.length).sum::<f64>();
    // Links are short compared with passes. Where they are not, the path has no passes.
    if sum(&links) > 0.5 * sum(&passes)
        && let Some(link) = links.first()
    {
        return Err(NoPassReason::LeavesPlane(link.motions.start));
    }
    let mut found = Vec::new();
    for segment in passes {
        let Some((plane, _)) = segment.plane else { continue };
        let motions_of = trim_plunge_and_retract(motions, segment.motions.clone(), mm_per_unit);
        if let Some(back) = find_turn_back(motions, &motions_of, &plane, mm_per_unit) {
            return Err(NoPassReason::TurnsBack(back));
        }
        if !motions_of.is_empty() {
            found.push(VerticalPass { motions: motions_of, plane });
        }
    }
    Ok(found)
}

/// Returns the motion at which a pass runs back over more than a quarter of its width. A shorter return is an
/// overhang of its profile.
fn find_turn_back(
    motions: &[Motion],
    range: &Range<usize>,
    plane: &ProfilePlane,
    mm_per_unit: f64,
) -> Option<usize> {
    let ends =
        |motion: &Motion| [motion.from, motion.to].map(|pose| plane.to_plane(pose.point * mm_per_unit).u);
    let all = motions.get(range.clone())?;
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let (mut forward, mut back) = (0.0, 0.0);
    for [from, to] in all.iter().map(ends) {
        (low, high) = (low.min(from.min(to)), high.max(from.max(to)));
        if to > from { forward += to - from } else { back += from - to }
    }
    // The profile of an undercut also runs back a little, which is no second pass.
    if f64::min(forward, back) <= 0.25 * (high - low) {
        return None;
    }
    let direction = if all
        .iter()
        .map(ends)
        .find(|[from, to]| (to - from).abs() > STRAIGHT_DOWN)
        .is_some_and(|[from, to]| to > from)
    {
        1.0
    } else {
        -1.0
    };
    let first = all.iter().map(ends).position(|[from, to]| (to - from) * direction < -STRAIGHT_DOWN)?;
    Some(range.start + first)
}

/// Returns the direction in which the segments have the largest total length.
fn find_main_direction(segments: &[PlanarRun]) -> Vector3<f64> {
    let mut sums: Vec<(Vector3<f64>, f64)> = Vec::new();
    for segment in segments {
        let Some((_, direction)) = segment.plane else { continue };
        match sums.iter_mut().find(|(known, _)| is_parallel(*known, direction)) {
            Some((_, sum)) => *sum += segment.length,
            None => sums.push((direction, segment.length)),
        }
    }
    // Of equal sums the first counts, so that the same path always has the same passes.
    let longest = sums.into_iter().reduce(|one, next| if next.1 > one.1 * (1.0 + 1e-9) { next } else { one });
    longest.map_or_else(Vector3::zeros, |(direction, _)| direction)
}

fn is_parallel(one: Vector3<f64>, other: Vector3<f64>) -> bool {
    // For unit vectors, the cross product is the sine of the angle. So opposite directions are parallel, too.
    one.cross(&other).norm() <= PARALLEL
}

fn split_into_planar_runs(motions: &[Motion], run: Range<usize>, mm_per_unit: f64) -> Vec<PlanarRun> {
    let mut found = Vec::new();
    let mut start = run.start;
    while start < run.end {
        let (end, plane) = find_planar_run(motions, start, run.end, mm_per_unit);
        let part = motions.get(start..end);
        debug_assert!(part.is_some(), "a segment consists of motions of the program");
        let part = part.unwrap_or_default();
        let length = part.iter().map(|motion| motion.length() * mm_per_unit).sum();
        found.push(PlanarRun { motions: start..end, plane, length });
        start = end;
    }
    found
}

/// Returns the end of the longest segment from `start` that lies in one plane, and its plane. The segment has
/// at least one motion.
fn find_planar_run(
    motions: &[Motion],
    start: usize,
    end: usize,
    mm_per_unit: f64,
) -> (usize, Option<(ProfilePlane, Vector3<f64>)>) {
    let Some(first) = motions.get(start) else { return (start + 1, None) };
    let (origin, up) = (first.from.point * mm_per_unit, first.from.axis);
    let mut seen: Vec<Point3<f64>> = Vec::new();
    let mut plane: Option<(ProfilePlane, Vector3<f64>)> = None;
    let mut index = start;
    while let Some(motion) = motions.get(index).filter(|_| index < end) {
        let points: Vec<Point3<f64>> = motion
            .path
            .sample_points(motion.from.point, motion.to.point)
            .iter()
            .map(|point| point * mm_per_unit)
            .collect();
        if !is_in_plane(&plane, &points) {
            // A short beginning gives the direction inaccurately, so the plane is fitted again to a farther
            // point.
            let better = fit_plane(origin, up, &points);
            let vertical = plane.is_none() && better.is_none() && matches!(motion.path, MotionPath::Line);
            let fits = is_in_plane(&better, &points) && is_in_plane(&better, &seen);
            if !(vertical || fits) {
                break;
            }
            plane = better.or(plane);
        }
        seen.extend(points);
        index += 1;
    }
    (index.max(start + 1), plane.filter(|_| index > start))
}

fn is_in_plane(plane: &Option<(ProfilePlane, Vector3<f64>)>, points: &[Point3<f64>]) -> bool {
    let Some((plane, _)) = plane else { return false };
    points.iter().all(|point| plane.signed_distance_mm(*point).abs() <= IN_PLANE)
}

/// Returns the plane through a point that holds the axis and the farthest of some points. Returns `None` if
/// all points lie above each other.
fn fit_plane(
    origin: Point3<f64>,
    up: Vector3<f64>,
    points: &[Point3<f64>],
) -> Option<(ProfilePlane, Vector3<f64>)> {
    let across = |point: &Point3<f64>| {
        // Without its part along the axis, only the direction across is left, which decides the plane.
        let offset = point - origin;
        offset - up * offset.dot(&up)
    };
    let far =
        points.iter().map(across).reduce(|one, next| if next.norm() > one.norm() { next } else { one })?;
    if far.norm() <= STRAIGHT_DOWN {
        return None;
    }
    Some((ProfilePlane::new(origin, far, up)?, far.normalize()))
}

/// Returns whether a motion cuts, as far as its class tells. The file's marks count; without a mark, every
/// motion at feed cuts.
pub(super) fn is_cutting(motion: &Motion) -> bool {
    !motion.rapid
        && motion.hole.is_none()
        && !matches!(motion.path, MotionPath::Start)
        && (!motion.class_is_stated || motion.class == MotionClass::Cut)
}
