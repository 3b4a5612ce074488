//! This module computes the heights of a sweep over a row of columns. This is the inner loop of the
//! simulation.
//!
//! There is one loop for each family of cutters. None has branches, so that the compiler can turn it into
//! vector instructions.

use super::silhouette::Silhouette;
use crate::cutter::Meridian;

/// A row of columns in coordinates from the start of a piece, mm: the x of the first column, the y of the
/// row, and the distance of the columns.
#[derive(Debug, Clone, Copy)]
pub(super) struct SweepRow {
    pub x: f32,
    pub y: f32,
    pub cell: f32,
}

/// A straight piece: its horizontal unit direction, its horizontal length, its rise per horizontal distance,
/// and the height of the tip at its start.
#[derive(Debug, Clone, Copy)]
pub(super) struct SweepPath {
    pub ux: f32,
    pub uy: f32,
    pub length: f32,
    pub slope: f32,
    pub start: f32,
}

/// The underside of a cutter, by what its sweep needs.
#[derive(Debug, Clone)]
pub(super) enum CutterUnderside {
    /// A flat end with a sharp edge. `side` is the distance of the contact ahead of the axis, divided by the
    /// half chord (-1, 0 or 1).
    Flat { radius2: f32, side: f32 },
    /// A ball. `side` is the same ratio, which here is the sine of the slope.
    Ball { radius: f32, radius2: f32, side: f32 },
    /// A bull-nose cutter on a level path.
    LevelBull { center: f32, corner: f32, corner2: f32, radius2: f32 },
    /// A bull-nose cutter on a sloped path.
    Bull { center: f32, corner: f32, corner2: f32, radius2: f32, silhouette: Box<Silhouette> },
    /// Any other cutter, with a cone at the bottom or at the flank.
    Any { profile: Meridian, radius2: f32, silhouette: Box<Silhouette> },
}

impl CutterUnderside {
    /// Makes the underside of a cutter for paths with one slope.
    pub(super) fn new(profile: &Meridian, slope: f64) -> Self {
        let radius2 = (profile.radius_mm() * profile.radius_mm()) as f32;
        let (corner, [center, _]) = (profile.corner_radius_mm(), profile.corner_center());
        let plain = profile.taper_rad() == 0.0 && profile.bottom_angle_rad() == 0.0;
        let silhouette = || Box::new(Silhouette::new(profile, slope));
        let corner2 = (corner * corner) as f32;
        let (center, corner) = (center as f32, corner as f32);
        match () {
            () if plain && corner == 0.0 => {
                let side = if slope == 0.0 { 0.0 } else { slope.signum() as f32 };
                Self::Flat { radius2, side }
            }
            // The contact's normal must have the path's slope, so on a ball it is R sin(slope angle) ahead of
            // the centre.
            () if plain && center == 0.0 => {
                Self::Ball { radius: corner, radius2, side: (slope / slope.hypot(1.0)) as f32 }
            }
            () if plain && slope == 0.0 => Self::LevelBull { center, corner, corner2, radius2 },
            () if plain => Self::Bull { center, corner, corner2, radius2, silhouette: silhouette() },
            () => Self::Any { profile: profile.clone(), radius2, silhouette: silhouette() },
        }
    }

    /// Makes the underside of a flat disc for paths with one slope.
    pub(super) fn flat_disc(radius: f64, slope: f64) -> Self {
        let side = if slope == 0.0 { 0.0 } else { slope.signum() as f32 };
        Self::Flat { radius2: (radius * radius) as f32, side }
    }

    /// Returns how far ahead of the axis the lowest contact over a column is, at lateral distance `q` from
    /// the path, mm.
    pub(super) fn contact_ahead_mm(&self, q: f32) -> f32 {
        match self {
            Self::Flat { radius2, side } | Self::Ball { radius2, side, .. } => {
                side * (radius2 - q * q).max(0.0).sqrt()
            }
            Self::LevelBull { .. } => 0.0,
            Self::Bull { silhouette, .. } | Self::Any { silhouette, .. } => silhouette.contact_ahead_mm(q),
        }
    }

    /// Computes the lowest height of the sweep over each column of a row; infinite where the sweep does not
    /// pass.
    pub(super) fn sweep_heights(&self, out: &mut [f32], row: SweepRow, path: SweepPath) {
        match self {
            Self::Flat { radius2, side } => {
                let (r2, side) = (*radius2, *side);
                if side == 0.0 {
                    sweep_row_heights(out, row, path, r2, |_| 0.0, |_| 0.0);
                } else {
                    sweep_row_heights(out, row, path, r2, |q2| side * (r2 - q2).max(0.0).sqrt(), |_| 0.0);
                }
            }
            Self::Ball { radius, radius2, side } => {
                // On a ball all contacts of one slope lie on a great circle, seen from above an ellipse with
                // the ratio `side`.
                let (radius, r2, side) = (*radius, *radius2, *side);
                let height = |rho2: f32| radius - (r2 - rho2).max(0.0).sqrt();
                if side == 0.0 {
                    sweep_row_heights(out, row, path, r2, |_| 0.0, height);
                } else {
                    sweep_row_heights(out, row, path, r2, |q2| side * (r2 - q2).max(0.0).sqrt(), height);
                }
            }
            Self::LevelBull { center, corner, corner2, radius2 } => {
                let (center, corner, corner2) = (*center, *corner, *corner2);
                sweep_row_heights(out, row, path, *radius2, |_| 0.0, torus_height(center, corner, corner2));
            }
            Self::Bull { center, corner, corner2, radius2, silhouette } => {
                let ahead = |q2: f32| silhouette.contact_ahead_mm(q2.sqrt());
                sweep_row_heights(out, row, path, *radius2, ahead, torus_height(*center, *corner, *corner2));
            }
            Self::Any { profile, radius2, silhouette } => {
                let ahead = |q2: f32| silhouette.contact_ahead_mm(q2.sqrt());
                let height = |rho2: f32| profile.height_at_radius_mm(f64::from(rho2.sqrt())) as f32;
                sweep_row_heights(out, row, path, *radius2, ahead, height);
            }
        }
    }
}

/// Returns the height of a bull-nose cutter's underside, as a function of the squared distance from the axis.
fn torus_height(center: f32, corner: f32, corner2: f32) -> impl Fn(f32) -> f32 {
    move |rho2| {
        let across = (rho2.sqrt() - center).max(0.0);
        corner - (corner2 - across * across).max(0.0).sqrt()
    }
}

/// Applies the closed form to a row. `ahead` gives the contact's distance ahead of the axis from q squared,
/// and `height` gives the height of the underside from rho squared.
#[inline(always)]
fn sweep_row_heights(
    out: &mut [f32],
    row: SweepRow,
    path: SweepPath,
    radius2: f32,
    ahead: impl Fn(f32) -> f32,
    height: impl Fn(f32) -> f32,
) {
    // A contact on the rim itself must not be lost to rounding.
    let reach2 = radius2 * (1.0 + 1e-5);
    for (index, out) in out.iter_mut().enumerate() {
        let x = row.x + index as i32 as f32 * row.cell;
        let along = x * path.ux + row.y * path.uy;
        let left = row.y * path.ux - x * path.uy;
        let q2 = left * left;
        // The tip's position at the contact, limited to the piece: beyond its ends the cutter at the end is
        // the lowest.
        let at = (along - ahead(q2)).max(0.0).min(path.length);
        let offset = along - at;
        let rho2 = offset * offset + q2;
        let z = path.start + path.slope * at + height(rho2);
        *out = if rho2 <= reach2 { z } else { f32::INFINITY };
    }
}
