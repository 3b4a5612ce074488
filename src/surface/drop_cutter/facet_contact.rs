//! This module lowers a cutter onto one triangle: its facet, edges and vertices.

use super::DropCutterShape;

/// A facet whose vertices are further than this from its plane, in mm along the normal, is a sliver whose
/// plane cannot be known. Then only its edges count, which are as near everywhere.
const FLAT: f64 = 1e-9;

/// An edge that is shorter than this in the view from above, in mm, counts as vertical, and its upper end
/// counts.
const UPRIGHT: f64 = 1e-12;

/// A triangle with the values that are needed to lower a cutter onto it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Facet {
    /// The vertices, counter-clockwise seen from above.
    pub(super) corners: [[f64; 3]; 3],
    /// The slope of the plane along x and along y; 0 for a vertical triangle.
    pub(super) slope: [f64; 2],
    /// The vector from the axis to where the plane touches the cutter, and below it the height of the
    /// cutter's bottom there.
    ahead: [f64; 2],
    fall: f64,
    /// By how much rounding may make the triangle higher than the plane. It is infinite for a vertical
    /// triangle, which has no plane to compare with.
    slack: f64,
}

/// The highest touch that is known so far.
#[derive(Debug, Clone, Copy)]
pub(super) struct HighestTouch {
    pub(super) tip: f64,
    pub(super) contact: [f64; 3],
    /// The slope of the touched facet; `None` at an edge or vertex.
    slope: Option<[f64; 2]>,
}

impl HighestTouch {
    pub(super) const NONE: Self = Self { tip: f64::NEG_INFINITY, contact: [0.0; 3], slope: None };

    /// Returns the upward unit normal at the contact: that of the facet, or at an edge or vertex that of the
    /// cutter, towards its inside.
    pub(super) fn unit_normal(&self, cutter: &DropCutterShape, [x, y]: [f64; 2]) -> [f64; 3] {
        if let Some([a, b]) = self.slope {
            let length = (1.0 + a * a + b * b).sqrt();
            return [-a / length, -b / length, 1.0 / length];
        }
        let [dx, dy] = [self.contact[0] - x, self.contact[1] - y];
        let r = dx.hypot(dy);
        let sine = cutter.lean_sine(r);
        if sine <= 0.0 {
            return [0.0, 0.0, 1.0];
        }
        [-dx / r * sine, -dy / r * sine, (1.0 - sine * sine).max(0.0).sqrt()]
    }

    /// Keeps a touch if it is higher than the known one.
    fn raise_to(&mut self, tip: f64, contact: [f64; 3], slope: Option<[f64; 2]>) {
        if tip > self.tip {
            *self = Self { tip, contact, slope };
        }
    }
}

impl Facet {
    /// Prepares a triangle for a cutter.
    pub(super) fn new(corners: [[f64; 3]; 3], cutter: &DropCutterShape) -> Self {
        let [a, mut b, mut c] = corners;
        let mut area = twice_area_from_above(a, b, c);
        if area < 0.0 {
            (b, c, area) = (c, b, -area);
        }
        let upright =
            Self { corners: [a, b, c], slope: [0.0; 2], ahead: [0.0; 2], fall: 0.0, slack: f64::INFINITY };
        // The plane's slopes solve z = sx x + sy y at both edges (Cramer's rule with the area as
        // determinant).
        let ([bx, by, bz], [cx, cy, cz]) = (vector_between(a, b), vector_between(a, c));
        let [sx, sy] = [(bz * cy - cz * by) / area, (cz * bx - bz * cx) / area];
        let steep = sx.hypot(sy);
        let length = steep.hypot(1.0);
        let off = (bz - sx * bx - sy * by).abs().max((cz - sx * cx - sy * cy).abs());
        // This is also false if the area is zero, since the slopes are then not numbers.
        if !(off <= FLAT * length && length < 1.0 / FLAT) {
            return upright;
        }
        let far = cutter.plane_contact_radius(steep);
        let ahead = if steep > 0.0 { [far * sx / steep, far * sy / steep] } else { [0.0; 2] };
        Self {
            slope: [sx, sy],
            ahead,
            fall: cutter.height_at(far),
            // This is the rounding of a plane's height over some metres.
            slack: off + 1e-12 * length,
            ..upright
        }
    }

    /// Raises the highest touch to where the cutter touches this triangle.
    pub(super) fn raise_touch(&self, cutter: &DropCutterShape, place: [f64; 2], best: &mut HighestTouch) {
        let [a, b, c] = self.corners;
        let [px, py] = [place[0] + self.ahead[0], place[1] + self.ahead[1]];
        let z = a[2] + self.slope[0] * (px - a[0]) + self.slope[1] * (py - a[1]);
        // All of the triangle is in the plane, so no part of it touches higher than the plane.
        if z - self.fall + self.slack <= best.tip {
            return;
        }
        let plane = self.slack < f64::INFINITY;
        let touching = [px, py, z];
        let sides = [(a, b), (b, c), (c, a)]
            .map(|(from, to)| (from, to, twice_area_from_above(from, to, touching) >= 0.0));
        if plane && sides.iter().all(|(_, _, inside)| *inside) {
            // On a steep plane rounding is large, so the height is limited by the vertices.
            let z = z.min(a[2].max(b[2]).max(c[2]));
            best.raise_to(z - self.fall, [px, py, z], Some(self.slope));
            return;
        }
        for (from, to, inside) in sides {
            // The height function is concave. If its maximum is outside the triangle, the triangle's maximum
            // is on a side that faces that point.
            if !(inside && plane) {
                raise_edge_touch(from, to, cutter, place, best);
            }
        }
    }
}

/// Raises the highest touch to where the cutter touches an edge with its ends. The height function over an
/// edge is concave. So the touching point of the endless line, moved to the nearest end if it is beyond, is
/// that of the edge.
fn raise_edge_touch(
    from: [f64; 3],
    to: [f64; 3],
    cutter: &DropCutterShape,
    [x, y]: [f64; 2],
    best: &mut HighestTouch,
) {
    if from[2].max(to[2]) <= best.tip {
        return;
    }
    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    let square = dx * dx + dy * dy;
    let reach = cutter.reach_mm();
    if square <= UPRIGHT * UPRIGHT {
        let upper = if from[2] > to[2] { from } else { to };
        let r = (upper[0] - x).hypot(upper[1] - y);
        if r <= reach {
            best.raise_to(upper[2] - cutter.height_at(r), upper, None);
        }
        return;
    }
    let [ax, ay] = [from[0] - x, from[1] - y];
    let off = ax * dy - ay * dx;
    let distance_square = off * off / square;
    let half_square = reach * reach - distance_square;
    if half_square < 0.0 {
        return;
    }
    let (length, half) = (square.sqrt(), half_square.sqrt());
    let start = (ax * dx + ay * dy) / length;
    let end = start + length;
    if start > half || end < -half {
        return;
    }
    let rise = to[2] - from[2];
    let slope = rise / length;
    // A tangent of the concave function at the middle bounds it from above; for short edges this often
    // decides.
    let middle = f64::midpoint(start, end);
    let r = (distance_square + middle * middle).sqrt();
    if r < reach {
        let (fall, tilt) = cutter.tangent_at(r);
        let most = f64::midpoint(from[2], to[2]) - fall + (slope - tilt * middle).abs() * (length / 2.0);
        if most <= best.tip {
            return;
        }
    }
    // The part under the cutter, with s counted towards the rising side.
    let (low, high) = (start.max(-half), end.min(half));
    let s = if rise < 0.0 {
        -cutter.find_line_contact(distance_square.sqrt(), -slope, -high, -low)
    } else {
        cutter.find_line_contact(distance_square.sqrt(), slope, low, high)
    };
    let share = ((s - start) / length).clamp(0.0, 1.0);
    let z = from[2] + rise * share;
    let tip = z - cutter.height_at((distance_square + s * s).sqrt());
    best.raise_to(tip, [from[0] + dx * share, from[1] + dy * share, z], None);
}

/// Returns the vector from one point to another.
fn vector_between([x, y, z]: [f64; 3], [u, v, w]: [f64; 3]) -> [f64; 3] {
    [u - x, v - y, w - z]
}

/// Returns twice the area of a triangle seen from above: positive if it is counter-clockwise.
fn twice_area_from_above(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
