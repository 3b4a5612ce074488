//! This module computes where on a straight piece the cutter takes what a column loses.
//!
//! At the distance s along the path, the surface over a column at the distance `along` ahead of the start and
//! `left` of the path is at the height u(s) = tip(s) + h(r), with r the column's distance from the axis and h the
//! height of the cutter's underside. A convex cutter lowers u from its arrival to the column's last contact, and
//! never again. So between two distances the column loses the difference of u there, limited to what it had. At
//! its arrival the cutter takes at once all that stands above its underside: a flat end the whole depth of a level
//! cut, a ball what is above its middle.
//!
//! A column stands for the material of a cell, so what it loses counts evenly over a cell of path. Without that,
//! the rows of columns would show as waves.

use super::band_engagement::BandEngagement;
use super::cutter_underside::CutterUnderside;
use super::straight_contact::{RemovedColumn, StraightContactFinder};

/// The underside over a column is looked at so many times at most on its way down. Between two looks it counts
/// as straight.
const MOST_LOOKS: f64 = 8.0;

impl StraightContactFinder {
    /// Adds where on the piece a column's material is taken.
    pub(super) fn add_removal(
        &self,
        column: &RemovedColumn,
        surface: &CutterUnderside,
        partial: &mut BandEngagement,
    ) {
        let RemovedColumn { along, left, low, top } = *column;
        if self.across <= 1e-9 {
            self.add_plunged(column, partial);
            return;
        }
        let half = self.cell / 2.0;
        let radius = self.profile.radius_mm();
        let slope = self.along / self.across;
        let height = |at: f64| {
            let ahead = along - at;
            let rho = (ahead * ahead + left * left).sqrt().min(radius);
            self.start + slope * at + self.profile.height_at_radius_mm(rho)
        };
        let mut give = |volume: f64, [from, to]: [f64; 2]| {
            if volume > 0.0 {
                let between = [(from - half) / self.length, (to + half) / self.length];
                partial.removal.add_volume(volume as f32, between);
            }
        };
        let arrival = (along - (radius * radius - left * left).max(0.0).sqrt()).clamp(0.0, self.length);
        let mut reached = height(arrival).clamp(low, top);
        give(top - reached, [arrival, arrival]);
        let contact = along - f64::from(surface.contact_ahead_mm(left.abs() as f32));
        let end = contact.clamp(arrival, self.length);
        // A flat end's underside goes straight down with the tip.
        let looks = match surface {
            CutterUnderside::Flat { .. } => 1.0,
            _ => ((end - arrival) / self.part * 4.0).ceil().clamp(1.0, MOST_LOOKS),
        };
        let mut at = arrival;
        for look in 1..=looks as usize {
            if reached <= low {
                return;
            }
            // The closer to the arrival, the steeper a round underside is, and the closer are the looks.
            let share = look as f64 / looks;
            let next = arrival + (end - arrival) * share * share;
            // The last contact leaves the column as it is; its own rounding leaves nothing over.
            let under = if look == looks as usize { low } else { height(next).clamp(low, reached) };
            give(reached - under, [at, next]);
            (at, reached) = (next, under);
        }
    }

    /// Adds a column that a piece straight down takes: the surface over it meets one height after the other.
    fn add_plunged(&self, column: &RemovedColumn, partial: &mut BandEngagement) {
        let rho = (column.along * column.along + column.left * column.left).sqrt();
        let surface = self.first + self.profile.height_at_radius_mm(rho.min(self.profile.radius_mm()));
        let lowered = |z: f64| if self.drop > 0.0 { (surface - z) / self.drop } else { 0.0 };
        partial
            .removal
            .add_volume((column.top - column.low) as f32, [lowered(column.top), lowered(column.low)]);
    }
}
