//! This module converts the pieces of a profile file to curves.
//!
//! People who write files by hand round their numbers. So a centre may be off by [`ROUNDED`], and an ellipse
//! is moved by as much. A curve always starts exactly at the end of the one before, and the next one starts
//! where it really ends.

use super::piece_fault::PieceFault;
use super::text::{ArcText, CurveTurnText, EllipseText, NurbsText, PieceText};
use crate::parameters::Finite;
use crate::surface::profile::{ChainPiece, EllipseArc, LARGEST, NurbsCurve, ParametricCurve, Point};
use crate::surface_milling::ProfileCurve;
use std::f64::consts::{PI, TAU};

/// The distance within which points of a file written by hand count as the same, mm.
const ROUNDED: f64 = 2e-3;

/// The length below which there is no curve, mm.
const SHORTEST: f64 = 1e-6;

/// Builds the curves of a piece that starts at a point. `scale` converts the file's unit to mm.
pub(super) fn build_curves(
    piece: &PieceText,
    start: Point,
    scale: f64,
) -> Result<Vec<ProfileCurve>, PieceFault> {
    match piece {
        PieceText::Line(to) => Ok(vec![build_line(start, build_point(*to, scale)?)?]),
        PieceText::Polyline(places) => {
            if places.is_empty() {
                return Err(PieceFault::new("the polyline has no place to go to", "empty"));
            }
            let mut from = start;
            let mut lines = Vec::with_capacity(places.len());
            for (index, to) in places.iter().enumerate() {
                let at = |fault: PieceFault| PieceFault { index: Some(index), ..fault };
                let to = build_point(*to, scale).map_err(at)?;
                lines.push(build_line(from, to).map_err(at)?);
                from = to;
            }
            Ok(lines)
        }
        PieceText::Arc(text) => build_arc(text, start, scale).map(|arc| vec![arc]),
        PieceText::Ellipse(text) => build_ellipse(text, start, scale).map(|ellipse| vec![ellipse]),
        PieceText::Nurbs(text) => build_nurbs(text, start, scale).map(|nurbs| vec![nurbs]),
    }
}

/// Returns the end of a curve.
pub(super) fn curve_end(curve: &ProfileCurve) -> Point {
    match curve {
        ProfileCurve::Piece(piece) => piece.end(),
        ProfileCurve::Ellipse(ellipse) => ellipse.point_at(1.0),
        ProfileCurve::Nurbs(nurbs) => nurbs.point_at(nurbs.knots().last().copied().unwrap_or_default()),
    }
}

/// Returns the end of a piece as its text gives it, also if the piece has a fault.
pub(super) fn meant_end(piece: &PieceText, scale: f64) -> Option<Point> {
    let to = match piece {
        PieceText::Line(to) => to,
        PieceText::Polyline(places) => places.last()?,
        PieceText::Arc(text) => &text.to,
        PieceText::Ellipse(text) => &text.to,
        PieceText::Nurbs(text) => text.points.last()?,
    };
    build_point(*to, scale).ok()
}

fn build_point(place: [Finite; 2], scale: f64) -> Result<Point, PieceFault> {
    let [u, z] = place.map(|value| value.get() * scale);
    // The limit is a thousandth of that of chains, so that offsets and sums still fit.
    if u.abs().max(z.abs()) > LARGEST / 1e3 {
        return Err(PieceFault::new("this is more than ten metres away", "too far")
            .with_help("Compare it with `units:`."));
    }
    Ok(Point::new(u, z))
}

fn build_line(from: Point, to: Point) -> Result<ProfileCurve, PieceFault> {
    if from.distance(to) < SHORTEST {
        return Err(PieceFault::new("this line has no length: it ends where it starts", "the place before"));
    }
    Ok(ProfileCurve::Piece(ChainPiece::line(from, to)))
}

fn build_arc(text: &ArcText, start: Point, scale: f64) -> Result<ProfileCurve, PieceFault> {
    let to = build_point(text.to, scale).map_err(|fault| fault.at_key("to"))?;
    let chord = start.distance(to);
    if chord < SHORTEST {
        let fault = PieceFault::new("this arc ends where it starts", "the place before").at_key("to");
        return Err(fault.with_help("Make a full circle of two arcs."));
    }
    let left = text.turn == CurveTurnText::Left;
    // The unit normal to the left of the chord.
    let (nu, nz) = (-(to.z - start.z) / chord, (to.u - start.u) / chord);
    let middle = start.lerp(to, 0.5);
    let off = match (text.radius, text.centre) {
        (Some(radius), None) => {
            let radius = radius.get() * scale;
            // The centre is sqrt(R^2 - (chord / 2)^2) from the chord.
            let square = radius * radius - chord * chord / 4.0;
            // Half a turn is often intended to be exact, so a radius slightly too small is accepted.
            if square < -ROUNDED * radius {
                let message = format!("an arc of radius {} does not reach {:.4} mm", radius / scale, chord);
                return Err(PieceFault::new(message, "too small for this arc")
                    .at_key("radius")
                    .with_help(format!("It must be {} or more.", chord / 2.0 / scale)));
            }
            // The shorter arc has its centre on the side to which it turns.
            square.max(0.0).sqrt() * if left == text.long { -1.0 } else { 1.0 }
        }
        (None, Some(centre)) => {
            let centre = build_point(centre, scale).map_err(|fault| fault.at_key("centre"))?;
            let (one, other) = (centre.distance(start), centre.distance(to));
            if (one - other).abs() > ROUNDED {
                let message =
                    format!("the arc's centre is {one:.4} mm from its start and {other:.4} mm from its end");
                return Err(PieceFault::new(message, "not as far from both")
                    .at_key("centre")
                    .with_help("Both must be the radius; or give `radius` instead."));
            }
            (centre.u - middle.u) * nu + (centre.z - middle.z) * nz
        }
        _ => {
            return Err(PieceFault::new("an arc needs either `radius` or `centre`", "one of both, not two"));
        }
    };
    let centre = Point::new(middle.u + nu * off, middle.z + nz * off);
    let angle = |point: Point| (point.z - centre.z).atan2(point.u - centre.u);
    let from = angle(start);
    let turned = (angle(to) - from).rem_euclid(TAU);
    let sweep = if left { turned } else { turned - TAU };
    Ok(ProfileCurve::Piece(ChainPiece::arc(centre, centre.distance(start), from, sweep)))
}

fn build_ellipse(text: &EllipseText, start: Point, scale: f64) -> Result<ProfileCurve, PieceFault> {
    let to = build_point(text.to, scale).map_err(|fault| fault.at_key("to"))?;
    let centre = build_point(text.centre, scale).map_err(|fault| fault.at_key("centre"))?;
    let [a, b] = text.semi_axes.map(|axis| axis.get() * scale);
    let tilt = text.tilt.map_or(0.0, |tilt| tilt.radians());
    let whole = EllipseArc { centre, a, b, tilt_rad: tilt, start_rad: 0.0, sweep_rad: TAU };
    let from = ellipse_parameter(&whole, start);
    let until = ellipse_parameter(&whole, to);
    for (at, parameter, key) in [(start, from, "centre"), (to, until, "to")] {
        let off = whole.point_at(parameter / TAU).distance(at);
        // Measured in the direction of the centre, this is the distance from the ellipse or a little more.
        if off.is_nan() || off > ROUNDED * (a / b).max(b / a) {
            let which = if key == "to" { "end" } else { "start" };
            let message = format!("the {which} of this piece is {off:.4} mm from the ellipse");
            let label = if key == "to" { "not on the ellipse" } else { "does not go through the start" };
            return Err(PieceFault::new(message, label).at_key(key));
        }
    }
    let turned = (until - from).rem_euclid(TAU);
    let turned = if (1e-9..=TAU - 1e-9).contains(&turned) { turned } else { 0.0 };
    let sweep = match text.turn {
        CurveTurnText::Left if turned > 0.0 => turned,
        CurveTurnText::Right if turned > 0.0 => turned - TAU,
        CurveTurnText::Left => TAU,
        CurveTurnText::Right => -TAU,
    };
    let mut ellipse = EllipseArc { start_rad: from, sweep_rad: sweep, ..whole };
    let first = ellipse.point_at(0.0);
    ellipse.centre = Point::new(centre.u + start.u - first.u, centre.z + start.z - first.z);
    Ok(ProfileCurve::Ellipse(ellipse))
}

/// Returns the parameter of an ellipse in the direction of a point, after scaling the ellipse to a circle.
fn ellipse_parameter(ellipse: &EllipseArc, at: Point) -> f64 {
    let (sin, cos) = ellipse.tilt_rad.sin_cos();
    let (u, z) = (at.u - ellipse.centre.u, at.z - ellipse.centre.z);
    let angle = ((z * cos - u * sin) / ellipse.b).atan2((u * cos + z * sin) / ellipse.a);
    // The result is from 0 to a turn, so that it can be taken as a fraction of the whole ellipse.
    if angle < 0.0 { angle + 2.0 * PI } else { angle }
}

fn build_nurbs(text: &NurbsText, start: Point, scale: f64) -> Result<ProfileCurve, PieceFault> {
    let mut controls = vec![start];
    for (index, place) in text.points.iter().enumerate() {
        let at = |fault: PieceFault| PieceFault { index: Some(index), ..fault.at_key("points") };
        controls.push(build_point(*place, scale).map_err(at)?);
    }
    let degree = usize::from(text.degree.unwrap_or(3));
    let count = controls.len();
    if degree == 0 || count <= degree {
        let message = format!(
            "a curve of degree {degree} needs {} points after its start, not {}",
            degree.max(1),
            count - 1
        );
        return Err(PieceFault::new(message, "too few").at_key(if degree == 0 {
            "degree"
        } else {
            "points"
        }));
    }
    let weights = match &text.weights {
        Some(weights) => weights.iter().map(|weight| weight.get()).collect(),
        None => vec![1.0; count],
    };
    let knots = match &text.knots {
        Some(knots) => knots.iter().map(|knot| knot.get()).collect(),
        None => make_even_knots(degree, count),
    };
    let key = if weights.len() == count { "knots" } else { "weights" };
    let curve = NurbsCurve::new(degree, &controls, &weights, knots).map_err(|error| {
        PieceFault::new(format!("this is no NURBS curve: {error}"), "does not fit").at_key(key)
    })?;
    let first = curve.point_at(curve.knots().first().copied().unwrap_or_default());
    if first.distance(start) > SHORTEST {
        let message =
            format!("the curve starts {:.4} mm from its first control point", first.distance(start));
        let help = "Begin the knots with as many equal ones as the degree and 1, or leave them out.";
        return Err(PieceFault::new(message, "the curve must start where the piece does")
            .at_key("knots")
            .with_help(help));
    }
    Ok(ProfileCurve::Nurbs(curve))
}

/// Makes the knots of a curve that starts at its first control point and ends at its last, with even knots
/// between.
fn make_even_knots(degree: usize, count: usize) -> Vec<f64> {
    let spans = count - degree;
    (0..count + degree + 1).map(|index| index.saturating_sub(degree).min(spans) as f64).collect()
}
