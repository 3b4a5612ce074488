//! This module turns a pass into a profile and computes the path of the ball over it.

use super::vertical_passes::{NoPassReason, VerticalPass};
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::surface::profile::ChordSide;
use crate::surface::profile::{
    ArcPiece, Chain, ChainPiece, NurbsCurve, Point, ProfileDeviation, ProfilePlane, UnreachablePart,
    check_tip_path, compensate_profile, find_unreachable_parts, fit_chords, recover_profile, to_chords,
};
use std::fmt;

/// Curves become chords within this fraction of the tolerance. The path that is made of them has the rest.
const CURVES: f64 = 0.1;

/// Chords stay within this fraction of the tolerance. Printing and curves have the rest.
const CHORDS: f64 = 0.8;

/// Steep lines that lean by no more than this (mm) are vertical.
const PRINTED_WALL: f64 = 2e-3;

/// The data by which a pass is compensated, in mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct CompensatingBall {
    /// The radius of the ball.
    pub radius: f64,
    /// The radius of the ball whose tip the path is. It is `None` for a path of contact points.
    pub was: Option<f64>,
    /// Whether the points of the path are the centres of that ball.
    pub was_centre: bool,
    /// Whether the result is the path of the ball's centre.
    pub centre: bool,
    /// The allowed gouge and gap.
    pub tolerance: f64,
    /// Whether arcs stay arcs.
    pub arcs: bool,
}

/// A compensated pass.
#[derive(Debug, Clone)]
pub(super) struct CompensatedPass {
    /// The profile of the part where the ball has to touch it.
    pub contact: Chain,
    /// The exact path of the tip, before it was approximated by chords.
    pub exact: Chain,
    /// The path as it is to be written.
    pub path: Chain,
    /// The parts of the profile that the ball cannot touch.
    pub unreachable: Vec<UnreachablePart>,
}

/// The reason why a pass cannot be compensated.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum PassFault {
    Pass(NoPassReason),
    Geometry(String),
}

impl fmt::Display for PassFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pass(_) => f.write_str("it does not lie in a vertical plane"),
            Self::Geometry(why) => f.write_str(why),
        }
    }
}

/// Builds the chain of a pass in its plane. Returns the chain, and for each of its pieces the motion that it
/// comes from.
///
/// # Errors
/// Returns [`PassFault`] at an arc that is no arc of the plane, and at a spline that cannot be read.
pub(super) fn build_chain(
    motions: &[Motion],
    pass: &VerticalPass,
    mm_per_unit: f64,
    tolerance: f64,
) -> Result<(Chain, Vec<usize>), PassFault> {
    let mut pieces: Vec<ChainPiece> = Vec::new();
    let mut owners = Vec::new();
    let mut reached: Option<Point> = None;
    for index in pass.motions.clone() {
        let Some(motion) = motions.get(index) else { continue };
        let flat = |point: nalgebra::Point3<f64>| pass.plane.to_plane(point * mm_per_unit);
        // Each piece begins exactly where the previous one ends. Printed ends may be up to a last digit
        // apart.
        let from = reached.unwrap_or_else(|| flat(motion.from.point));
        let mut to = flat(motion.to.point);
        match &motion.path {
            MotionPath::Line | MotionPath::Start => {
                // A wall that leans by printed digits only is vertical. A wall that leans backwards would
                // belong to another pass.
                if (to.u - from.u).abs() <= PRINTED_WALL && (to.z - from.z).abs() > 10.0 * PRINTED_WALL {
                    to.u = from.u;
                }
                pieces.push(ChainPiece::line(from, to));
            }
            MotionPath::Arc(arc) => {
                let round = project_arc(arc, &pass.plane, mm_per_unit)
                    .ok_or(PassFault::Pass(NoPassReason::LeavesPlane(index)))?;
                pieces.push(ChainPiece::Arc(fit_arc_to_ends(&round, from, to)));
            }
            MotionPath::Spline(spline) => {
                let mut scaled = spline.as_ref().clone();
                scaled.controls.iter_mut().for_each(|point| *point *= mm_per_unit);
                let curve = NurbsCurve::from_spline(&scaled, &pass.plane)
                    .map_err(|why| PassFault::Geometry(why.to_string()))?;
                let made = to_chords(&curve, tolerance * CURVES)
                    .map_err(|why| PassFault::Geometry(why.to_string()))?;
                let start = made.start();
                if start.distance(from) > 0.0 {
                    pieces.push(ChainPiece::line(from, start));
                }
                pieces.extend_from_slice(made.pieces());
                to = made.end();
            }
        }
        owners.resize(pieces.len(), index);
        reached = Some(to);
    }
    let chain = Chain::new(pieces).map_err(|why| PassFault::Geometry(why.to_string()))?;
    Ok((chain, owners))
}

/// Fits an arc to exact ends: its centre is moved onto their perpendicular bisector by the shortest distance.
/// If the ends coincide, the arc is returned unchanged.
fn fit_arc_to_ends(arc: &ArcPiece, from: Point, to: Point) -> ArcPiece {
    let (du, dz) = (to.u - from.u, to.z - from.z);
    let chord = du.hypot(dz);
    if chord < 1e-3 {
        return *arc;
    }
    let middle = from.lerp(to, 0.5);
    let (nu, nz) = (-dz / chord, du / chord);
    // The projection of the old centre onto the bisector is the nearest point that is equally far from both
    // ends.
    let aside = (arc.centre.u - middle.u) * nu + (arc.centre.z - middle.z) * nz;
    let centre = Point::new(middle.u + nu * aside, middle.z + nz * aside);
    let angle = |at: Point| (at.z - centre.z).atan2(at.u - centre.u);
    let start = angle(from);
    // The sense of the arc stays, even if rounding has moved its ends past each other.
    let turn = (angle(to) - start).rem_euclid(std::f64::consts::TAU);
    let sweep = if arc.sweep_rad > 0.0 { turn } else { turn - std::f64::consts::TAU };
    ArcPiece { centre, radius_mm: from.distance(centre), start_rad: start, sweep_rad: sweep }
}

/// Projects an arc of space into the plane. Returns `None` if its axis is not the plane's normal, or if it
/// climbs along its axis.
fn project_arc(
    arc: &crate::program::geometry::CircularArc,
    plane: &ProfilePlane,
    mm_per_unit: f64,
) -> Option<ArcPiece> {
    let (start, centre) = (plane.to_plane(arc.start * mm_per_unit), plane.to_plane(arc.center * mm_per_unit));
    let ahead = plane.to_plane((arc.start + arc.axis.cross(&(arc.start - arc.center))) * mm_per_unit);
    let (spoke, tangent) = ((start.u - centre.u, start.z - centre.z), (ahead.u - start.u, ahead.z - start.z));
    let turn = spoke.0 * tangent.1 - spoke.1 * tangent.0;
    let radius = start.distance(centre);
    // In its own plane, the tangent is perpendicular to the spoke and as long. So |spoke x tangent| = R^2,
    // and it is smaller by the cosine of the tilt when the arc lies in another plane.
    let lies = (turn.abs() - radius * radius).abs() <= 1e-4 * radius * radius;
    (lies && arc.rise.abs() * mm_per_unit <= 1e-3).then(|| ArcPiece {
        centre,
        radius_mm: radius,
        start_rad: spoke.1.atan2(spoke.0),
        sweep_rad: arc.sweep * turn.signum(),
    })
}

/// Compensates a pass.
///
/// Returns [`PassFault`] if the profile cannot be recovered, compensated or approximated.
pub(super) fn compensate_pass(path: &Chain, ball: &CompensatingBall) -> Result<CompensatedPass, PassFault> {
    let geometry = |why: String| PassFault::Geometry(why);
    let contact = match ball.was {
        None => path.clone(),
        Some(was) => {
            let tip = if ball.was_centre { path.centre_to_tip(was) } else { path.clone() };
            recover_profile(&tip, was).map_err(|why| geometry(why.to_string()))?
        }
    };
    // The tip's path is the envelope of the ball rolling on the profile, not the offset of its points: the
    // offset would gouge concave corners.
    let exact = compensate_profile(&contact, ball.radius).map_err(|why| geometry(why.to_string()))?;
    let path = fit_chords(&exact, ball.tolerance * CHORDS, ball.arcs, ChordSide::Both)
        .map_err(|why| geometry(why.to_string()))?;
    let unreachable = find_unreachable_parts(&contact, ball.radius, ball.tolerance)
        .map_err(|why| geometry(why.to_string()))?;
    Ok(CompensatedPass { contact, exact, path, unreachable })
}

/// Returns the chain of the tip for a path that was written for the ball's tip or centre.
pub(super) fn tip_chain(path: &Chain, ball: &CompensatingBall) -> Chain {
    if ball.centre { path.centre_to_tip(ball.radius) } else { path.clone() }
}

/// Measures a written path by another method than the one that made it. The points are half a chord apart: a
/// chord with the tolerance as its sagitta has the length sqrt(8 R t).
pub(super) fn measure_tip_chain(contact: &Chain, tip: &Chain, ball: &CompensatingBall) -> ProfileDeviation {
    let step = (2.0 * ball.radius * ball.tolerance).sqrt() / 4.0;
    check_tip_path(contact, tip, ball.radius, step)
}

/// Returns the sine of the profile's slope angle at a point, as the mean of both sides. A ball's tip is
/// displaced along the pass by R times this sine.
pub(super) fn slope_sine(from: Point, at: Point, to: Point) -> f64 {
    let angle = |a: Point, b: Point| {
        let (du, dz) = (b.u - a.u, b.z - a.z);
        let length = du.hypot(dz);
        if length > 0.0 { dz * du.signum() / length } else { 0.0 }
    };
    0.5 * (angle(from, at) + angle(at, to))
}
