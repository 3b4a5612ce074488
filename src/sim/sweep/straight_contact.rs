//! Contacts: where on the cutter a point of a column was reached first, and how fast the surface advances there.

use super::band_engagement::{BandEngagement, BinContact, CrossPathPosition};
use super::cutter_underside::CutterUnderside;
use crate::sim::Meridian;

/// Thinner material (mm) is what rounding left of the piece before: no chip to speak of.
const FILM: f64 = 2e-4;

/// Samples of a column's height when forces are asked for.
const SAMPLES: usize = 4;

/// A straight piece as its contacts see it. Heights count from the grid's base.
#[derive(Debug, Clone)]
pub(super) struct StraightContactFinder {
    pub profile: Meridian,
    /// Direction of travel: part across the axis, and along it (up is positive).
    pub across: f64,
    pub along: f64,
    /// Height of the tip at the start; of a piece straight along the axis, at its lower end.
    pub start: f64,
    /// Height of the tip at the start, always.
    pub first: f64,
    /// Length across.
    pub length: f64,
    /// Distance of columns.
    pub cell: f64,
    /// Whether the bins must be filled finely enough for forces.
    pub detail: bool,
    /// Whether the ground at the start has not been cleared by a piece before.
    pub fresh: bool,
}

/// A column from which `low..top` was removed: its place along the path and to the left of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct RemovedColumn {
    pub along: f64,
    pub left: f64,
    pub low: f64,
    pub top: f64,
}

/// A point of the cutter in contact.
#[derive(Debug, Clone, Copy)]
struct StraightContact {
    /// Ahead of the axis.
    ahead: f64,
    /// From the axis.
    rho: f64,
    /// Above the tip.
    height: f64,
    /// Sine and cosine of the normal's angle from straight down.
    sin: f64,
    cos: f64,
}

impl StraightContactFinder {
    /// Adds a column's contacts.
    ///
    /// The sweep looks the same all along the path, so the share of a contact depends only on its place across the path: on
    /// `rise`, its height measured square to the path, and on its distance to the side. It grows inwards, and upwards unless the
    /// path descends. Without detail, columns that another one dominates (further in and higher; on a descent, over a
    /// wider range of rise) are not looked at more closely.
    #[inline]
    pub fn add_column_contacts(
        &self,
        column: RemovedColumn,
        surface: &CutterUnderside,
        partial: &mut BandEngagement,
    ) {
        let depth = column.top - column.low;
        let place = self.cross_path_position(&column);
        if self.fresh && self.is_inside_at_start(&column) {
            partial.add_volume(depth as f32, column.left as f32);
            partial.add_contact(&self.unknown_contact(&column));
        } else if depth < FILM || (!self.detail && partial.is_dominated(&place, self.along >= 0.0, depth)) {
            partial.add_volume(depth as f32, column.left as f32);
        } else {
            self.examine_column(column, place, surface, partial);
        }
    }

    /// Whether a column's material is in the cutter before it moves: how it was reached is not known.
    fn is_inside_at_start(&self, column: &RemovedColumn) -> bool {
        let rho = hypot_fast(column.along, column.left);
        rho < self.profile.radius_mm() && column.top > self.start_height_mm(rho) + 1e-3
    }

    fn start_height_mm(&self, rho: f64) -> f64 {
        self.first + self.profile.height_at_radius_mm(rho)
    }

    /// A contact of which nothing is known but that it is: it has the largest share there can be.
    fn unknown_contact(&self, column: &RemovedColumn) -> BinContact {
        let rho = hypot_fast(column.along, column.left);
        BinContact {
            angle: atan2_fast(column.left as f32, column.along as f32),
            length: self.profile.arc_length_of_contact_mm(rho, self.profile.height_at_radius_mm(rho), 1.0)
                as f32,
            share: 1.0,
            share_bound: 1.0,
            radial: 1.0,
            thickness: f32::INFINITY,
        }
    }

    /// Looks at a column closely.
    #[inline(never)]
    fn examine_column(
        &self,
        column: RemovedColumn,
        place: CrossPathPosition,
        surface: &CutterUnderside,
        partial: &mut BandEngagement,
    ) {
        let RemovedColumn { along, left, low, top } = column;
        let depth = top - low;
        let bottom = self.last_contact(along, left, surface);
        let upper = self.first_contact(along, left, top, bottom);
        let steepness = if upper.cos > 1e-3 { 1.0 / upper.cos } else { f64::INFINITY };
        let thickness = depth * steepness;
        let heights = [bottom.height.min(upper.height), upper.height.max(bottom.height)];
        partial.add_column(depth as f32, left as f32, heights.map(|height| height as f32));
        let angle = atan2_fast(left as f32, upper.ahead as f32);
        // What was in the cutter from the start tells nothing about what it meets on its way.
        if along - upper.ahead > 1e-6 {
            partial.remember_contact(place, self.along >= 0.0, steepness, angle);
        }
        let mut give = |touch: &StraightContact, cap: f64| {
            partial.add_contact(&self.bin_contact(touch, left, thickness, cap))
        };
        let mut cap = 0.0;
        if self.along < 0.0 {
            cap = self.max_ratio_between(&bottom, &upper);
            give(&bottom, 0.0);
        }
        give(&upper, cap);
        if self.detail {
            for sample in 0..SAMPLES {
                let height = low + (top - low) * sample as f64 / SAMPLES as f64;
                give(&self.first_contact(along, left, height, bottom), 0.0);
            }
        }
    }

    /// Where a column's contacts lie across the path. Straight down, the share only depends on the distance from the axis.
    #[inline]
    fn cross_path_position(&self, column: &RemovedColumn) -> CrossPathPosition {
        let RemovedColumn { along, left, low, top } = *column;
        if self.across <= 1e-9 {
            let rho = hypot_fast(along, left);
            return CrossPathPosition { least: rho, greatest: -rho, side: 0.0 };
        }
        let rise = |z: f64| (z - self.start) * self.across - along * self.along;
        CrossPathPosition { least: rise(low), greatest: rise(top), side: left.abs() }
    }

    /// A contact as the bins take it. `cap` is a share that is reached between this touch and another.
    fn bin_contact(&self, touch: &StraightContact, left: f64, thickness: f64, cap: f64) -> BinContact {
        // The border of the ground lies half a cell further in than the last column on average, and at most a whole one.
        let share = |shift: f64| {
            let q = (left.abs() - shift).max(0.0);
            let ahead = (touch.rho * touch.rho - q * q).max(0.0).sqrt();
            let ahead = if touch.ahead < 0.0 { -ahead } else { ahead };
            let turned = if touch.rho > 0.0 { ahead / touch.rho } else { 1.0 };
            (self.across * turned * touch.sin - self.along * touch.cos).max(cap).clamp(0.0, 1.0) as f32
        };
        let angle = atan2_fast(left as f32, touch.ahead as f32);
        BinContact {
            angle,
            length: self.profile.arc_length_of_contact_mm(touch.rho, touch.height, touch.sin) as f32,
            share: share(self.cell / 2.0),
            share_bound: share(self.cell),
            radial: touch.sin as f32,
            // Between two columns material may be thicker by what the surface rises over half a cell.
            thickness: (thickness + self.cell / 2.0 * touch.sin) as f32,
        }
    }

    /// The largest share between two touches of one column on a descent: there the corner's normal may point straight ahead
    /// along the path.
    fn max_ratio_between(&self, bottom: &StraightContact, upper: &StraightContact) -> f64 {
        if self.profile.corner_radius_mm() <= 0.0 || upper.rho <= 0.0 {
            return 0.0;
        }
        let forward = self.across * upper.ahead / upper.rho;
        let down = -self.along;
        // Angles from straight down, compared by their tangents; the bottom's is negative where the contact lies behind the axis.
        let behind = if bottom.ahead < 0.0 { -bottom.sin } else { bottom.sin };
        let after_bottom = forward * bottom.cos >= down * behind;
        let before_upper = forward * upper.cos <= down * upper.sin;
        if after_bottom && before_upper { (forward * forward + down * down).sqrt() } else { 0.0 }
    }

    /// The contact that leaves the surface over a column.
    fn last_contact(&self, along: f64, left: f64, surface: &CutterUnderside) -> StraightContact {
        let at = if self.across > 0.0 {
            (along - f64::from(surface.contact_ahead_mm(left.abs() as f32))).clamp(0.0, self.length)
        } else {
            0.0
        };
        let ahead = along - at;
        let rho = hypot_fast(ahead, left).min(self.profile.radius_mm());
        let [sin, cos] = self.profile.normal_at_radius(rho);
        StraightContact { ahead, rho, height: self.profile.height_at_radius_mm(rho), sin, cos }
    }

    /// The contact with which the cutter first reaches a point of a column at height `z`; `lowest` is its last.
    fn first_contact(&self, along: f64, left: f64, z: f64, lowest: StraightContact) -> StraightContact {
        if self.across <= 1e-9 {
            return lowest;
        }
        let slope = self.along / self.across;
        let [flank_radius, flank_height] = self.profile.flank_start();
        let tip = |at: f64| self.start + slope * at;
        let on = |at: f64, height: f64| {
            let ahead = along - at;
            let [sin, cos] = self.profile.normal_at_height(height);
            StraightContact { ahead, rho: hypot_fast(ahead, left), height, sin, cos }
        };
        if self.profile.taper_rad() <= 0.0 {
            // The cylinder comes first wherever the point is above the corner when it arrives.
            let at = along - (flank_radius * flank_radius - left * left).max(0.0).sqrt();
            let height = z - tip(at);
            // Heights are f32: what is a hair below the flank's lower end is at it.
            if at >= -1e-4 && height >= flank_height - 1e-4 {
                return on(at, height.max(flank_height));
            }
            if self.profile.corner_radius_mm() <= 0.0 {
                return lowest;
            }
            let center = self.profile.corner_center();
            if center[0] == 0.0 && self.profile.bottom_angle_rad() == 0.0 {
                let at = self
                    .ball_contact_distance_mm(along, left, z - self.start - center[1], center[1])
                    .max(0.0);
                return on(at, z - tip(at));
            }
        }
        if slope == 0.0 {
            let height = z - self.start;
            let radius = self.profile.radius_at_height_mm(height);
            return on((along - (radius * radius - left * left).max(0.0).sqrt()).max(0.0), height);
        }
        let at = self.first_contact_distance_mm(along, left, z, slope, along - lowest.ahead);
        on(at, (z - tip(at)).max(0.0))
    }

    /// Distance across at which a ball reaches a point, given relative to its centre at the start.
    fn ball_contact_distance_mm(&self, along: f64, left: f64, up: f64, radius: f64) -> f64 {
        let travelled = along * self.across + up * self.along;
        let apart2 = along * along + left * left + up * up - radius * radius;
        (travelled - (travelled * travelled - apart2).max(0.0).sqrt()) * self.across
    }

    /// First distance across at which the point is inside: the height of the point over the profile is concave along the path,
    /// so its first zero lies between the cutter's arrival and the lowest contact; found by false position (Illinois).
    fn first_contact_distance_mm(&self, along: f64, left: f64, z: f64, slope: f64, until: f64) -> f64 {
        let radius = self.profile.radius_mm();
        let over = |at: f64| {
            let rho = hypot_fast(along - at, left);
            z - self.start - slope * at - self.profile.height_at_radius_mm(rho.min(radius))
        };
        let mut low = (along - (radius * radius - left * left).max(0.0).sqrt()).clamp(0.0, until.max(0.0));
        let mut high = until.max(low);
        let (mut below, mut above) = (over(low), over(high));
        if below >= 0.0 || above <= 0.0 {
            return if below >= 0.0 { low } else { high };
        }
        for _ in 0..6 {
            let at = low + (high - low) * (below / (below - above));
            let value = over(at);
            if value.abs() < 1e-4 {
                return at;
            }
            if value < 0.0 {
                (low, below) = (at, value);
                above *= 0.5;
            } else {
                (high, above) = (at, value);
                below *= 0.5;
            }
        }
        high
    }
}

/// Length of a vector; plain, for nothing here is near the ends of `f64`'s range.
fn hypot_fast(a: f64, b: f64) -> f64 {
    (a * a + b * b).sqrt()
}

/// `atan2` to 2e-4 radians, a seventieth of the bins that it is for, in a few instructions (odd polynomial of degree 7).
fn atan2_fast(y: f32, x: f32) -> f32 {
    use std::f32::consts::{FRAC_PI_2, PI};
    let (small, large) = (x.abs().min(y.abs()), x.abs().max(y.abs()));
    let ratio = if large > 0.0 { small / large } else { 0.0 };
    let square = ratio * ratio;
    let eighth =
        ratio * (0.999_215_2 + square * (-0.321_181_9 + square * (0.146_264_46 - square * 0.038_986_51)));
    let quarter = if y.abs() > x.abs() { FRAC_PI_2 - eighth } else { eighth };
    let half = if x < 0.0 { PI - quarter } else { quarter };
    if y < 0.0 { -half } else { half }
}
