//! This module computes where a moving cutter touches the surface that it leaves.
//!
//! A convex solid of revolution moves with the slope m = dz/ds. Over a column at lateral distance q from the
//! path, the lowest point of the sweep is where the solid's own slope along the path equals m: `tan(psi)
//! cos(theta) = m`. Here psi is the angle of the normal from straight down, and theta is the angle around the
//! axis from straight ahead. Going up the meridian gives this curve as points `(q, w)`, where w = rho
//! cos(theta) is the distance of the contact ahead of the axis; q never falls on the way. The curve does not
//! depend on the column's position along the path, so one short table serves a whole straight piece.

use crate::cutter::Meridian;
use std::f64::consts::FRAC_PI_2;

/// The number of entries for a cutter with a corner radius but without cones, whose curve is smooth.
const SMOOTH: usize = 64;
/// The number of entries for a cutter with cones, whose curve has kinks.
const CORNERED: usize = 512;
/// The number of steps on the corner's arc and on the circle of a sharp edge.
const STEPS: usize = 24;

/// The distance w of the contact ahead of the axis as a function of the lateral distance q, for one slope.
#[derive(Debug, Clone)]
pub(crate) struct Silhouette {
    /// The values of w at `q = radius (1 - x^2)` for evenly spaced x from 0 to 1. They are dense near the
    /// rim, where w changes fastest.
    table: Vec<f32>,
    /// The number of entries minus one.
    steps: f32,
    inverse_radius: f32,
}

impl Silhouette {
    /// Computes the curve of a cutter that moves with a slope (rise per horizontal distance).
    pub(crate) fn new(profile: &Meridian, slope: f64) -> Self {
        let radius = profile.radius_mm();
        let cones = profile.taper_rad() > 0.0 || profile.bottom_angle_rad() > 0.0;
        let entries = if cones { CORNERED } else { SMOOTH };
        let mut table = vec![0.0; entries];
        let steps = (entries - 1) as f32;
        if slope == 0.0 {
            return Self { table, steps, inverse_radius: (1.0 / radius) as f32 };
        }
        let points = sample_silhouette(profile, slope.abs());
        // The table runs from the rim inwards, so q decreases.
        let mut upper = points.len().saturating_sub(1);
        for (index, entry) in table.iter_mut().enumerate() {
            let x = index as f64 / f64::from(steps);
            let q = radius * (1.0 - x * x);
            while upper > 1 && points.get(upper - 1).is_some_and(|(at, _)| *at > q) {
                upper -= 1;
            }
            let low = points.get(upper.saturating_sub(1)).copied().unwrap_or_default();
            let high = points.get(upper).copied().unwrap_or_default();
            let share = if high.0 > low.0 { ((q - low.0) / (high.0 - low.0)).clamp(0.0, 1.0) } else { 0.0 };
            *entry = ((low.1 + share * (high.1 - low.1)) * slope.signum()) as f32;
        }
        Self { table, steps, inverse_radius: (1.0 / radius) as f32 }
    }

    /// Returns how far ahead of the axis the contact is over a column at lateral distance `q` (below the
    /// radius), mm.
    #[inline]
    pub(crate) fn contact_ahead_mm(&self, q: f32) -> f32 {
        let x = (1.0 - q * self.inverse_radius).max(0.0).sqrt() * self.steps;
        let index = (x as usize).min(self.table.len() - 2);
        let share = x - index as f32;
        match self.table.get(index..index + 2) {
            Some([low, high]) => low + (high - low) * share,
            _ => 0.0,
        }
    }
}

/// Samples the curve by going up the meridian; q ascends.
fn sample_silhouette(profile: &Meridian, slope: f64) -> Vec<(f64, f64)> {
    let mut points = Vec::with_capacity(3 * STEPS + 8);
    let mut add = |rho: f64, psi: f64| {
        // From tan(psi) cos(theta) = m: cos(theta) = m / tan(psi), and (q, w) = rho (sin(theta), cos(theta)).
        let cos = if psi >= FRAC_PI_2 - 1e-12 { 0.0 } else { (slope / psi.tan()).min(1.0) };
        points.push((rho * (1.0 - cos * cos).max(0.0).sqrt(), rho * cos));
    };
    let steep = slope.atan();
    let bottom = profile.bottom_angle_rad();
    let flank = FRAC_PI_2 - profile.taper_rad();
    // On a cone below, psi is constant; only a path that is less steep than the cone has contacts there.
    if bottom > 0.0 && steep < bottom {
        add(0.0, bottom);
        add(profile.bottom_radius_mm(), bottom);
    }
    let [center, _] = profile.corner_center();
    let arc = |psi: f64| center + profile.corner_radius_mm() * psi.sin();
    if steep < flank {
        let from = steep.max(bottom);
        for step in 0..=STEPS {
            // Even steps in theta follow the circle of a sharp edge better than even steps in psi. So both
            // are used: psi = atan(m / cos(theta)) fills in where theta jumps.
            let share = step as f64 / STEPS as f64;
            let even = from + (flank - from) * share;
            add(arc(even.min(flank)), even);
            if step < STEPS {
                let next = from + (flank - from) * (share + 1.0 / STEPS as f64);
                let (theta, theta_next) =
                    ((slope / even.tan()).min(1.0).acos(), (slope / next.tan()).min(1.0).acos());
                let extra = ((theta_next - theta) / 0.12) as usize;
                for part in 1..=extra.min(STEPS) {
                    let theta = theta + (theta_next - theta) * part as f64 / (extra + 1) as f64;
                    let psi = (slope / theta.cos()).atan().clamp(even, next);
                    add(arc(psi), psi);
                }
            }
        }
        add(profile.radius_mm(), flank);
    }
    // The rest of the curve goes around the rim, where the flank ends.
    let from = steep.max(flank);
    for step in 0..=STEPS {
        let theta_from = (slope / from.tan()).min(1.0).acos();
        let theta = theta_from + (FRAC_PI_2 - theta_from) * step as f64 / STEPS as f64;
        let psi = if step == STEPS { FRAC_PI_2 } else { (slope / theta.cos()).atan() };
        add(profile.radius_mm(), psi);
    }
    points
}
