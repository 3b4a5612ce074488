//! This module holds the cutter as a solid and intersects it with vertical lines.
//!
//! The solid is a convex solid of revolution. It is the union of three convex parts: the cone of the bottom,
//! the corner (all points within the corner radius of a disc; a sphere for a ball) and the flank. So a line
//! meets the solid in the interval that spans its intersections with the parts. Cones, cylinders, planes and
//! spheres lead to quadratic equations; only the corner's torus needs iteration.

use super::column_line::ColumnLine;
use crate::cutter::{Meridian, NonCuttingCylinder};

/// The distance along the normal (mm) to which the corner's torus is found.
const CLOSE: f64 = 1e-7;

/// A part of a cone or cylinder around the axis.
#[derive(Debug, Clone, Copy)]
struct Frustum {
    from: f64,
    to: f64,
    /// The radius at `from`, and its growth with height.
    radius: f64,
    slope: f64,
}

impl Frustum {
    #[inline]
    fn intersect_line(&self, line: &ColumnLine) -> Option<[f64; 2]> {
        let [first, last] = line.clip_to_heights(self.from, self.to)?;
        let k = self.slope;
        let radius = self.radius + k * (line.height - self.from);
        // With r the radius of the cone, rho^2 - r^2 = a s^2 + 2 b s + c; the inside is where it is negative
        // between the planes.
        let a = line.lean2 - k * k * line.rise * line.rise;
        let b = -line.rise * (line.height + k * radius);
        let c = line.across2 - radius * radius;
        let out = |s: f64| (a * s + 2.0 * b) * s + c > 0.0;
        let (out_first, out_last) = (out(first), out(last));
        if !out_first && !out_last {
            return Some([first, last]);
        }
        let apart = b * b - a * c;
        if apart < 0.0 {
            return None;
        }
        // This form of the roots does not subtract nearly equal numbers.
        let q = -(b + apart.sqrt().copysign(b));
        let (one, two) = (q / a, c / q);
        match (out_first, out_last) {
            (true, true) => {
                let (low, high) = (one.min(two), one.max(two));
                (a > 0.0 && low >= first && high <= last).then_some([low, high])
            }
            // Exactly one root is between the planes; rounding may have put it slightly outside.
            (false, _) => Some([first, root_between(one, two, first, last)]),
            (true, false) => Some([root_between(one, two, first, last), last]),
        }
    }
}

/// Returns the one of two roots that is between two numbers.
#[inline]
fn root_between(one: f64, two: f64, low: f64, high: f64) -> f64 {
    let root = if (low..=high).contains(&one) { one } else { two };
    if root.is_nan() { low } else { root.clamp(low, high) }
}

/// All points within a radius of a disc across the axis.
#[derive(Debug, Clone, Copy)]
struct RoundedCorner {
    disc: f64,
    height: f64,
    radius: f64,
    /// Whether the solid ends below the upper end of the corner.
    cropped: bool,
}

impl RoundedCorner {
    #[inline]
    fn intersect_line(&self, line: &ColumnLine, top: f64) -> Option<[f64; 2]> {
        let whole = if self.disc <= 0.0 { self.intersect_sphere(line)? } else { self.intersect_torus(line)? };
        if !self.cropped {
            return Some(whole);
        }
        let [low, high] = line.clip_to_heights(f64::MIN / 4.0, top)?;
        let cut = [whole[0].max(low), whole[1].min(high)];
        (cut[0] <= cut[1]).then_some(cut)
    }

    #[inline]
    fn intersect_sphere(&self, line: &ColumnLine) -> Option<[f64; 2]> {
        // |p - c|^2 = R^2 with c at `height` on the axis, solved for s.
        let middle = self.height * line.rise;
        let below = self.height - line.height;
        let half2 = middle * middle + self.radius * self.radius - line.across2 - below * below;
        (half2 >= 0.0).then(|| [middle - half2.sqrt(), middle + half2.sqrt()])
    }

    fn intersect_torus(&self, line: &ColumnLine) -> Option<[f64; 2]> {
        let (from, to) = (self.height - self.radius, self.height + self.radius);
        let around = Frustum { from, to, radius: self.disc + self.radius, slope: 0.0 };
        let [low, high] = around.intersect_line(line)?;
        Some([self.approach_surface(line, low, 1.0)?, self.approach_surface(line, high, -1.0)?])
    }

    /// Moves along the line from a point outside until the distance from the disc is the radius. The distance
    /// is convex along a line, so Newton's steps never overshoot.
    fn approach_surface(&self, line: &ColumnLine, from: f64, way: f64) -> Option<f64> {
        let mut s = from;
        for _ in 0..40 {
            let up = line.axial_height_at(s) - self.height;
            let rho = line.squared_radius_at(s).sqrt();
            let out = (rho - self.disc).max(0.0);
            let distance = (out * out + up * up).sqrt();
            if distance - self.radius <= CLOSE {
                return Some(s);
            }
            // The derivative of the distance along the line, from those of rho and of the height.
            let growth = if out > 0.0 { (line.lean2 * s - line.height * line.rise) / rho } else { 0.0 };
            let slope = way * (up * line.rise + out * growth) / distance;
            if slope >= -1e-9 {
                return None;
            }
            s -= way * (distance - self.radius) / slope;
        }
        None
    }
}

/// The distance of a point outside the solid, and the components of the nearest face's unit normal away from
/// the axis and along it.
#[derive(Debug, Clone, Copy)]
pub(super) struct SurfaceDistance {
    pub gap: f64,
    pub radial: f64,
    pub axial: f64,
}

/// A convex solid of revolution with its tip at the origin.
#[derive(Debug, Clone)]
pub(super) struct RevolvedSolid {
    cone: Option<Frustum>,
    corner: Option<RoundedCorner>,
    flank: Frustum,
    floor: f64,
    /// The sine and cosine of the bottom's angle against the plane, and of the flank's angle against the
    /// axis.
    bottom: [f64; 2],
    taper: [f64; 2],
    /// The vertices of the meridian: distance from the axis and height.
    points: [[f64; 2]; 4],
}

impl RevolvedSolid {
    /// Makes the cutting part of a cutter up to a height above the tip, or at least to slightly above the
    /// start of its flank.
    pub(super) fn from_meridian(profile: &Meridian, limit: f64) -> Self {
        let [radius, start] = profile.flank_start();
        let top = profile.height_mm().min(limit.max(start + 1e-3));
        let slope = profile.taper_rad().tan();
        let tangent = profile.bottom_angle_rad().tan();
        let [bottom, below] = [profile.bottom_radius_mm(), profile.bottom_radius_mm() * tangent];
        let rounding = profile.corner_radius_mm();
        let [disc, height] = profile.corner_center();
        let corner = RoundedCorner { disc, height, radius: rounding, cropped: height + rounding > top };
        Self {
            cone: (below > 0.0).then(|| Frustum { from: 0.0, to: below, radius: 0.0, slope: 1.0 / tangent }),
            corner: (rounding > 0.0).then_some(corner),
            flank: Frustum { from: start, to: top, radius, slope },
            floor: 0.0,
            bottom: profile.bottom_angle_rad().sin_cos().into(),
            taper: profile.taper_rad().sin_cos().into(),
            points: [[0.0, 0.0], [bottom, below], [radius, start], [radius + slope * (top - start), top]],
        }
    }

    /// Makes the solid of a shank or holder.
    pub(super) fn from_non_cutting(collar: &NonCuttingCylinder) -> Self {
        let NonCuttingCylinder { radius_mm: radius, from_mm: from, to_mm: to, .. } = *collar;
        Self {
            cone: None,
            corner: None,
            flank: Frustum { from, to, radius, slope: 0.0 },
            floor: from,
            bottom: [0.0, 1.0],
            taper: [0.0, 1.0],
            points: [[0.0, from], [radius, from], [radius, to], [0.0, to]],
        }
    }

    /// Returns the height of the upper end above the tip, mm.
    pub(super) fn top_mm(&self) -> f64 {
        self.flank.to
    }

    /// Returns the height of the lower end above the tip, mm.
    pub(super) fn floor_mm(&self) -> f64 {
        self.floor
    }

    /// Returns whether the solid is a ball-end mill: only a sphere and a cylinder.
    pub(super) fn is_ball(&self) -> bool {
        self.cone.is_none() && self.flank.slope == 0.0 && self.corner.is_some_and(|corner| corner.disc <= 0.0)
    }

    /// Returns the largest distance from the axis, mm.
    pub(super) fn radius_mm(&self) -> f64 {
        self.points.iter().fold(0.0, |most, [r, _]| most.max(*r))
    }

    /// Returns where a vertical line enters and leaves, counted upwards from the tip's height.
    #[inline]
    pub(super) fn intersect_line(&self, line: &ColumnLine) -> Option<[f64; 2]> {
        let mut found = self.flank.intersect_line(line);
        if let Some(corner) = &self.corner {
            found = hull_of_spans(found, corner.intersect_line(line, self.flank.to));
        }
        if let Some(cone) = &self.cone {
            found = hull_of_spans(found, cone.intersect_line(line));
        }
        found
    }

    /// Returns the distance of a point outside the solid (negative inside); the point is given by its
    /// distance from the axis and its height. The distance is convex. At a sharp edge it is the larger of the
    /// distances from the two faces.
    #[inline]
    pub(super) fn surface_distance(&self, rho: f64, z: f64) -> SurfaceDistance {
        let ([sin_bottom, cos_bottom], [sin, cos]) = (self.bottom, self.taper);
        let lid = z - self.flank.to;
        let side = (rho - self.flank.radius) * cos - (z - self.flank.from) * sin;
        let below = rho * sin_bottom - (z - self.floor) * cos_bottom;
        let mut found = if side >= below {
            SurfaceDistance { gap: side, radial: cos, axial: -sin }
        } else {
            SurfaceDistance { gap: below, radial: sin_bottom, axial: -cos_bottom }
        };
        // In the wedge between the normals of bottom and flank, the corner's arc is the nearest face.
        if let Some(corner) = &self.corner {
            let (out, up) = (rho - corner.disc, z - corner.height);
            if out * cos_bottom + up * sin_bottom > 0.0 && out * sin + up * cos < 0.0 {
                let distance = (out * out + up * up).sqrt();
                found = SurfaceDistance {
                    gap: distance - corner.radius,
                    radial: out / distance,
                    axial: up / distance,
                };
            }
        }
        if lid > found.gap { SurfaceDistance { gap: lid, radial: 0.0, axial: 1.0 } } else { found }
    }

    /// Returns how far the meridian reaches in a direction, and the height of that point. The direction is
    /// given by its components across the axis and along it, together of length 1.
    pub(super) fn furthest_meridian_point(&self, across: f64, along: f64) -> [f64; 2] {
        let mut best = [f64::NEG_INFINITY, 0.0];
        let mut add = |value: f64, height: f64| {
            if value > best[0] {
                best = [value, height];
            }
        };
        for [r, z] in self.points {
            add(across * r + along * z, z);
        }
        if let Some(corner) = self.corner.filter(|_| along <= 0.0) {
            let RoundedCorner { disc, height, radius, .. } = corner;
            add(across * disc + along * height + radius, height + radius * along);
        }
        best
    }
}

#[inline]
fn hull_of_spans(one: Option<[f64; 2]>, two: Option<[f64; 2]>) -> Option<[f64; 2]> {
    match (one, two) {
        (Some([a, b]), Some([c, d])) => Some([a.min(c), b.max(d)]),
        (found, None) | (None, found) => found,
    }
}
