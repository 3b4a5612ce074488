//! This module finds the direction and sweep of arcs, from the record that announces an arc and the points
//! before and after it.

use super::modal_state::MotionProblemKind;
use crate::program::dialect::ArcRule;
use crate::program::geometry::{CircularArc, SAME_POINT};
use crate::program::record::{ArcSense, AxialArc, Circle, DriveArc, MoveArc};
use nalgebra::{Point3, Unit, Vector3};
use std::f64::consts::{PI, TAU};

/// The largest difference of radii. Both points and the centre are rounded (measured: at most 0.0001 in every
/// NX arc).
const RADIUS_TOLERANCE: f64 = 2e-3;

/// The tolerance of MOVARC angles in radians: twice their rounding, since they are printed with three
/// decimals of a degree.
const ANGLE_TOLERANCE: f64 = 2e-5;

/// The largest difference between the angle of a helix and its turns, in degrees: turns are printed with few decimals.
const SAME_TURNS: f64 = 1.0;

/// An arc that waits for its end point.
#[derive(Debug, Clone)]
pub(super) enum PendingArc {
    Circle(Circle),
    MoveArc(MoveArc),
    Drive(DriveArc),
    Axial(AxialArc),
}

/// The arc, if there is one, and the problems found with it.
pub(super) struct ResolvedArc {
    pub(super) arc: Option<CircularArc>,
    pub(super) problems: Vec<MotionProblemKind>,
}

impl PendingArc {
    /// Returns whether points after the announcement may all lie on the arc, as Creo writes them.
    pub(super) fn takes_points(&self) -> bool {
        matches!(self, Self::Circle(_))
    }

    /// Returns whether the record itself tells how far the arc turns.
    pub(super) fn tells_turns(&self) -> bool {
        match self {
            Self::Circle(circle) => circle.times > 1,
            Self::MoveArc(arc) => arc.sweep_degrees.is_some() || arc.times > 1,
            Self::Drive(arc) => arc.beyond_half,
            Self::Axial(arc) => {
                arc.sweep_degrees.or(arc.turns).is_some() || arc.beyond_half.unwrap_or_default()
            }
        }
    }

    /// Returns how far a point is from the circle of a CIRCLE that starts at `start`.
    pub(super) fn distance_of(&self, start: Point3<f64>, point: Point3<f64>) -> Option<f64> {
        let Self::Circle(circle) = self else { return None };
        let axis = Unit::new_normalize(circle.axis);
        Some(CircularArc::from_endpoints(start, point, circle.center, axis, 0).end_deviation(point))
    }

    /// Resolves the arc. `direction` is that of INDIRV, and `before` tells the unit tangent of the feed motion
    /// before, if there is one.
    pub(super) fn resolve(
        self,
        rule: ArcRule,
        start: Point3<f64>,
        end: Point3<f64>,
        direction: Option<Vector3<f64>>,
        before: impl FnOnce() -> Option<Vector3<f64>>,
    ) -> ResolvedArc {
        match self {
            Self::Circle(circle) => resolve_circle(&circle, rule, start, end, before),
            Self::MoveArc(arc) => resolve_move_arc(&arc, start, end),
            Self::Drive(arc) => resolve_drive_arc(&arc, start, end, direction),
            Self::Axial(arc) => resolve_axial_arc(&arc, start, end, arc.start_direction.or(direction)),
        }
    }
}

/// Resolves a CIRCLE: finds its direction from the record, the dialect or the motion before.
fn resolve_circle(
    circle: &Circle,
    rule: ArcRule,
    start: Point3<f64>,
    end: Point3<f64>,
    before: impl FnOnce() -> Option<Vector3<f64>>,
) -> ResolvedArc {
    let mut problems = Vec::new();
    let printed = Unit::new_normalize(circle.axis);
    let counter_clockwise = match (circle.sense, rule) {
        (ArcSense::Clockwise, _) => false,
        (ArcSense::CounterClockwise, _) => true,
        (ArcSense::OfDialect, ArcRule::LeftHand) => false,
        (ArcSense::OfDialect, ArcRule::RightHand | ArcRule::ByWord) => true,
        (ArcSense::OfDialect, ArcRule::FromTangent) => {
            // A counter-clockwise arc leaves in the direction axis x spoke; a motion before it that goes the
            // same way confirms it.
            let tangent = printed.cross(&(start - circle.center));
            match before().map(|before| before.dot(&tangent)) {
                // 0.9 is the cosine of about 26 degrees. A motion at a larger angle to the tangent is no
                // smooth entry, so it tells nothing about the sense of the arc.
                Some(along) if along.abs() > 0.9 * tangent.norm() => along > 0.0,
                _ => {
                    problems.push(MotionProblemKind::AssumedSense);
                    true
                }
            }
        }
    };
    let axis = if counter_clockwise { printed } else { -printed };
    // `TIMES,n` counts how often the direction of the end point is reached, so n - 1 full turns are added.
    let arc = CircularArc::from_endpoints(start, end, circle.center, axis, circle.times - 1);
    if let Some(radius) = circle.radius {
        let off = (radius - arc.radius).abs();
        if off > RADIUS_TOLERANCE {
            problems.push(MotionProblemKind::ArcStartOffCircle(off));
        }
    }
    check_arc_end(&arc, end, &mut problems);
    ResolvedArc { arc: Some(arc), problems }
}

/// Resolves a MOVARC, whose angle and end point both give the sweep.
fn resolve_move_arc(record: &MoveArc, start: Point3<f64>, end: Point3<f64>) -> ResolvedArc {
    let mut problems = Vec::new();
    let mut arc = CircularArc::from_endpoints(
        start,
        end,
        record.center,
        Unit::new_normalize(record.axis),
        record.times - 1,
    );
    if let Some(degrees) = record.sweep_degrees {
        let told = degrees.abs().to_radians();
        let tolerance = RADIUS_TOLERANCE + ANGLE_TOLERANCE * arc.radius;
        let differs =
            |arc: &CircularArc| 2.0 * arc.radius * ((told - arc.sweep) / 2.0).sin().abs() > tolerance;
        // Older posts print one normal for both senses, and only the angle tells them apart.
        let other = CircularArc::from_endpoints(start, end, record.center, -arc.axis, record.times - 1);
        // An angle below 0 turns against the axis, unless only the axis fits the end.
        let fits_other = !differs(&other) && (differs(&arc) || degrees < 0.0);
        if fits_other {
            arc = other;
            problems.push(MotionProblemKind::SenseFromAngle);
        }
        // Both the end point and the angle give the end of the arc, but only the angle gives whole turns.
        // Ends that coincide, or change their order by rounding, are either a full circle or an arc too short
        // to show in the decimals.
        // The sweep from the end points is from 0 to a turn, so an angle near 0 may have become a full turn.
        let missing = TAU - (arc.sweep - told);
        if (0.0..PI).contains(&told) && missing.abs() * arc.radius < RADIUS_TOLERANCE {
            arc.sweep = told;
        }
        arc.sweep += ((told - arc.sweep) / TAU).round().clamp(0.0, 10_000.0) * TAU;
        // The ends are apart by the chord 2 R sin(a / 2) of the angle a between them. The sine of half a
        // whole turn is 0, so only the remainder counts.
        let off = 2.0 * arc.radius * ((told - arc.sweep) / 2.0).sin().abs();
        if off > tolerance {
            problems.push(MotionProblemKind::ArcEndOffCircle(off));
        }
    }
    let off = (record.radius - arc.radius).abs();
    if off > RADIUS_TOLERANCE {
        problems.push(MotionProblemKind::ArcStartOffCircle(off));
    }
    check_arc_end(&arc, end, &mut problems);
    ResolvedArc { arc: Some(arc), problems }
}

/// Resolves CATIA's drive arc. CATIA gives the start tangent. The arc's plane contains it and the spoke from
/// the centre to the start, and the axis turns the spoke into the tangent.
fn resolve_drive_arc(
    record: &DriveArc,
    start: Point3<f64>,
    end: Point3<f64>,
    direction: Option<Vector3<f64>>,
) -> ResolvedArc {
    let mut problems = Vec::new();
    let spoke = start - record.center;
    let Some(direction) = direction.filter(|direction| direction.norm() > 1e-6) else {
        return ResolvedArc { arc: None, problems: vec![MotionProblemKind::TangentMismatch] };
    };
    let normal = spoke.cross(&direction);
    // The length of the cross product is |spoke| |direction| sin(angle). A tangent is at 90 degrees to its
    // spoke; less than 30 degrees (or more than 150) is no tangent at all.
    if normal.norm() < 0.5 * spoke.norm() * direction.norm() || spoke.norm() < SAME_POINT {
        return ResolvedArc { arc: None, problems: vec![MotionProblemKind::TangentMismatch] };
    }
    // The five printed decimals tilt the normal slightly. If start, end and centre define a plane, that plane
    // is exact.
    let through_end = spoke.cross(&(end - record.center));
    let exact = if through_end.norm() > 1e-3 * spoke.norm_squared() {
        through_end * through_end.dot(&normal).signum()
    } else {
        normal
    };
    let arc = CircularArc::from_endpoints(start, end, record.center, Unit::new_normalize(exact), 0);
    let off = (record.radius - arc.radius).abs();
    if off > RADIUS_TOLERANCE {
        problems.push(MotionProblemKind::ArcStartOffCircle(off));
    }
    check_arc_end(&arc, end, &mut problems);
    // Very close to half a turn, rounding alone decides on which side of it an arc lies.
    if record.beyond_half != (arc.sweep > PI + 1e-4) && (arc.sweep - PI).abs() > 1e-3 {
        problems.push(MotionProblemKind::TangentMismatch);
    }
    ResolvedArc { arc: Some(arc), problems }
}

/// Resolves an arc about an axis. Its start direction tells its sense, and its angle how many turns it has.
fn resolve_axial_arc(
    record: &AxialArc,
    start: Point3<f64>,
    end: Point3<f64>,
    direction: Option<Vector3<f64>>,
) -> ResolvedArc {
    let mut problems = Vec::new();
    let spoke = start - record.center;
    let turned = direction.map(|direction| spoke.cross(&direction));
    let axis = match (record.axis, turned) {
        (Some(axis), Some(turned)) => {
            let along = axis.dot(&turned);
            let expected = axis.norm() * turned.norm();
            (along.abs() > 0.5 * expected && expected > 0.0).then(|| axis * along.signum())
        }
        (None, Some(turned)) => Some(turned),
        _ => None,
    };
    let Some(axis) = axis.and_then(|axis| Unit::try_new(axis, 1e-9)) else {
        return ResolvedArc { arc: None, problems: vec![MotionProblemKind::TangentMismatch] };
    };
    let mut arc = CircularArc::from_endpoints(start, end, record.center, axis, 0);
    if let (Some(degrees), Some(turns)) = (record.sweep_degrees, record.turns)
        && (degrees.abs() - turns.abs() * 360.0).abs() > SAME_TURNS
    {
        problems.push(MotionProblemKind::TurnsDiffer { turns, degrees });
    }
    if let Some(degrees) = record.sweep_degrees.or(record.turns.map(|turns| turns * 360.0)) {
        let told = degrees.abs().to_radians();
        arc.sweep += ((told - arc.sweep) / TAU).round().clamp(0.0, 10_000.0) * TAU;
        let off = 2.0 * arc.radius * ((told - arc.sweep) / 2.0).sin().abs();
        if off > RADIUS_TOLERANCE + ANGLE_TOLERANCE * arc.radius {
            problems.push(MotionProblemKind::ArcEndOffCircle(off));
        }
    }
    if let Some(off) = record.radius.map(|radius| (radius - arc.radius).abs())
        && off > RADIUS_TOLERANCE
    {
        problems.push(MotionProblemKind::ArcStartOffCircle(off));
    }
    check_arc_end(&arc, end, &mut problems);
    let half = (arc.sweep - PI).abs() <= 1e-3;
    if record.beyond_half.is_some_and(|beyond| beyond != (arc.sweep > PI + 1e-4) && !half) {
        problems.push(MotionProblemKind::TangentMismatch);
    }
    ResolvedArc { arc: Some(arc), problems }
}

/// Reports an end that is off the circle.
fn check_arc_end(arc: &CircularArc, end: Point3<f64>, problems: &mut Vec<MotionProblemKind>) {
    let off = arc.end_deviation(end);
    if off > RADIUS_TOLERANCE {
        problems.push(MotionProblemKind::ArcEndOffCircle(off));
    }
}
