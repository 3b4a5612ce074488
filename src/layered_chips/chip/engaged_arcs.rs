//! This module finds where the last edge is engaged, and how fast it advances there.

use crate::layered_chips::Polygon;
use crate::layered_chips::boundary_diagram::BoundaryDiagram;
use crate::layered_chips::layer_ellipse::LayerEllipse;
use crate::layered_chips::section_family::{DiagramCurve, SectionFamily};
use crate::layered_chips::swept_area::RimDirections;
use crate::layered_chips::trig_polynomial::{AngleSinCos, TrigPolynomial};
use std::f64::consts::TAU;

/// Angles that are closer than this (radians) are equal.
const SAME: f64 = 1e-4;

/// Returns the arcs of the last edge that touch the chip, in degrees, and the largest advance of the engaged
/// edge; see [`super::LayerChip`].
///
/// An edge of the chip's boundary is on the last edge of the cutter if both its ends are, within twice the
/// rim's tolerance, and if it goes in the same direction around the centre. In a chip that is thinner than
/// that tolerance, the opposite side goes in the other direction, so it does not count.
pub(super) fn find_engaged_arcs(
    diagram: &BoundaryDiagram,
    rim: &RimDirections,
    pieces: &[Polygon],
) -> (Vec<[f64; 2]>, f64) {
    let family = diagram.family();
    let ellipse = family.ellipse_at(1.0);
    // If the layer no longer meets the mill at this angle at the end of the step, no point of the last edge
    // is there.
    let ends = [DiagramCurve::Bottom, DiagramCurve::Top]
        .map(|curve| family.has_curve(curve).then(|| family.curve_at(curve, 1.0)));
    let there = |theta: f64| {
        let angle = AngleSinCos::from_radians(theta);
        ends.iter().flatten().all(|end| end.value_at(&angle) >= -1e-9)
    };
    let edge = family.curve_at(DiagramCurve::Edge, 1.0);
    let near = 2.0 * rim.tolerance_mm() + 1e-5;
    let mut arcs: Vec<[f64; 2]> = Vec::new();
    let mut advance: f64 = 0.0;
    let face = BottomDiscChord::from_family(family, &ellipse);
    for border in pieces.iter().flat_map(|piece| std::iter::once(&piece.outer).chain(&piece.holes)) {
        let next = border.iter().cycle().skip(1);
        for (a, b) in border.iter().zip(next) {
            if let (Some(from), Some(to)) =
                (angle_on_ellipse(&ellipse, *a, near), angle_on_ellipse(&ellipse, *b, near))
            {
                let width = (to - from).rem_euclid(TAU);
                let middle = from + 0.5 * width;
                let between = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
                // A straight side between two points of the ellipse, such as the chord of the bottom disc, is
                // not part of the ellipse.
                let along = angle_on_ellipse(&ellipse, between, near).is_some();
                if width < 0.5 * TAU
                    && along
                    && there(middle)
                    && edge.value_at(&AngleSinCos::from_radians(middle)) < 0.0
                {
                    arcs.push([from.rem_euclid(TAU), from.rem_euclid(TAU) + width]);
                    for theta in [from, middle, to] {
                        advance = advance.max(family.edge_advance_mm(&ellipse, &edge, theta));
                    }
                    continue;
                }
            }
            if let Some(face) = &face {
                advance = advance.max(face.chord_advance_mm(*a, *b, near));
            }
        }
    }
    let zero = travel_angle(&ellipse);
    let mut arcs: Vec<[f64; 2]> =
        join_arcs(arcs).into_iter().map(|[from, to]| arc_in_degrees(from - zero, to - from)).collect();
    arcs.sort_by(|[a, _], [b, _]| a.total_cmp(b));
    (arcs, advance)
}

/// Returns the angle of a point on the ellipse, radians, or `None` if the point is not on it.
fn angle_on_ellipse(ellipse: &LayerEllipse, place: [f64; 2], near: f64) -> Option<f64> {
    let [x, y] = ellipse.direction_to(place);
    let off = (x.hypot(y) - 1.0).abs() * ellipse.short_semi_axis_mm();
    (off <= near).then(|| y.atan2(x))
}

/// Returns the angle of the direction in which the ellipse's centre moves, radians.
fn travel_angle(ellipse: &LayerEllipse) -> f64 {
    let ([cx, cy], [vx, vy]) = (ellipse.centre, ellipse.velocity);
    if vx.hypot(vy) < 1e-9 {
        return 0.0;
    }
    let [x, y] = ellipse.direction_to([cx + vx, cy + vy]);
    y.atan2(x)
}

/// Joins arcs where they meet; a full turn becomes one arc.
fn join_arcs(mut arcs: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    arcs.sort_by(|[a, _], [b, _]| a.total_cmp(b));
    let mut whole: Vec<[f64; 2]> = Vec::new();
    for [from, to] in arcs {
        match whole.last_mut() {
            Some([_, end]) if from <= *end + SAME => *end = end.max(to),
            _ => whole.push([from, to]),
        }
    }
    // The last arc may continue in the first one across the full turn.
    if let (Some([first, first_end]), Some([last, end])) = (whole.first().copied(), whole.last().copied())
        && end + SAME >= first + TAU
    {
        if whole.len() == 1 {
            return vec![[first, first + TAU]];
        }
        whole.pop();
        if let Some(arc) = whole.first_mut() {
            *arc = [last - TAU, first_end.max(end - TAU)];
        }
    }
    whole
}

/// Converts an arc from radians to degrees, with its beginning from -180 to below 180.
fn arc_in_degrees(from: f64, width: f64) -> [f64; 2] {
    let from = (from.to_degrees() + 180.0).rem_euclid(360.0) - 180.0;
    [from, from + width.to_degrees()]
}

/// The chord in which the bottom disc cuts the layer at the end of the step.
struct BottomDiscChord {
    /// The direction of the disc's line: a point with the direction `v` of the ellipse is above the disc by
    /// `normal . v + offset`.
    normal: [f64; 2],
    offset: f64,
    ellipse: LayerEllipse,
    /// The function [`DiagramCurve::Face`].
    speed: TrigPolynomial<f64>,
}

impl BottomDiscChord {
    fn from_family(family: &SectionFamily, ellipse: &LayerEllipse) -> Option<Self> {
        let bottom = family.curve_at(DiagramCurve::Bottom, 1.0);
        let TrigPolynomial([k0, k1, k2, ..]) = bottom;
        let swing = k1.hypot(k2);
        if swing <= k0.abs() {
            return None;
        }
        Some(Self {
            normal: [k1 / swing, k2 / swing],
            offset: k0 / swing,
            ellipse: *ellipse,
            speed: family.curve_at(DiagramCurve::Face, 1.0),
        })
    }

    /// Returns the advance of a boundary edge that is on the disc's chord, mm; 0 for any other edge.
    fn chord_advance_mm(&self, a: [f64; 2], b: [f64; 2], near: f64) -> f64 {
        let on = |place: [f64; 2]| {
            let [x, y] = self.ellipse.direction_to(place);
            let [nx, ny] = self.normal;
            let off = (x * nx + y * ny + self.offset).abs() * self.ellipse.long_semi_axis_mm();
            (off <= near && x.hypot(y) <= 1.0 + near).then_some([x, y])
        };
        let (Some([ax, ay]), Some([bx, by])) = (on(a), on(b)) else { return 0.0 };
        // The speed is linear in the direction, so the same formula holds on the chord and on the circle.
        let TrigPolynomial([k0, k1, k2, ..]) = self.speed;
        let speed = |x: f64, y: f64| k0 + k1 * x + k2 * y;
        speed(ax, ay).max(speed(bx, by)).max(0.0)
    }
}
