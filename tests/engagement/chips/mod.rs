//! Chips and forces, on engagements that are known in closed form.

mod angles;
mod chip;
mod chip_load;
mod exact;
mod force;
mod load_feed;

use clsmith::cutter::Meridian;
use clsmith::engagement::engagement_bins::BINS;
use clsmith::engagement::{Engagement, EngagementBin};
use std::f64::consts::{PI, TAU};

/// Ample: material in which no chip is as thick as what is there.
const THICK: f32 = 1e3;

/// A cylindrical or ball cutter.
fn cutter(diameter: f64, corner_radius: f64) -> Meridian {
    Meridian::new(diameter, corner_radius, 0.0, 0.0, 40.0).unwrap()
}

/// What a cutter engages that moves across its axis into material up to `depth` mm above its tip, between two angles from ahead
/// to the left, in degrees (multiples of 3), and what it then removes, by integration over the front half.
fn milling(profile: &Meridian, depth: f64, from: f64, to: f64) -> Engagement {
    let mut engagement = Engagement::empty_along(1.0, 0.0, 10.0);
    let (low, high) = (profile.bottom_arc_length_mm(), profile.arc_length_at_height_mm(depth));
    engagement.bins = vec![EngagementBin::EMPTY; BINS];
    for (index, bin) in engagement.bins.iter_mut().enumerate() {
        let [right, left] = [0.0, 1.0].map(|end| (index as f64 + end) * TAU / BINS as f64 - PI);
        let middle = (right + left).to_degrees() / 2.0;
        if middle > from && middle < to {
            // The largest share of the bin: where it is nearest to ahead, and highest.
            let nearest = 0_f64.clamp(right, left);
            let psi = profile.normal_angle_at_height_rad(depth);
            let share = (psi.sin() * nearest.cos()) as f32;
            *bin = EngagementBin {
                low: low as f32,
                high: high as f32,
                advance_ratio: share,
                advance_ratio_bound: share,
                radial: psi.sin() as f32,
                thickness: THICK,
            };
        }
    }
    let radius = profile.radius_at_height_mm(depth);
    engagement.height_mm = [0.0, depth];
    engagement.lateral_mm = [radius * from.to_radians().sin(), radius * to.to_radians().sin()];
    let steps = 20_000;
    let area: f64 = (0..steps)
        .map(|step| {
            let r = profile.radius_at_height_mm((f64::from(step) + 0.5) * depth / f64::from(steps));
            r * (to.to_radians().sin() - from.to_radians().sin()) * depth / f64::from(steps)
        })
        .sum();
    engagement.removed_mm3 = area * engagement.length_mm;
    engagement
}

/// What a flat cutter engages that goes straight down into full material.
fn plunge(profile: &Meridian) -> Engagement {
    let mut engagement = Engagement::empty_along(0.0, -1.0, 2.0);
    let bin = EngagementBin {
        low: 0.0,
        high: profile.bottom_arc_length_mm() as f32,
        advance_ratio: 1.0,
        advance_ratio_bound: 1.0,
        radial: 0.0,
        thickness: THICK,
    };
    engagement.bins = vec![bin; BINS];
    engagement.height_mm = [0.0, 2.0];
    engagement.lateral_mm = [-profile.radius_mm(), profile.radius_mm()];
    engagement.removed_mm3 = PI * profile.radius_mm().powi(2) * engagement.length_mm;
    engagement
}

/// Whether two numbers agree to a relative tolerance.
#[track_caller]
fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * expected.abs(), "{found} is not {expected}");
}
