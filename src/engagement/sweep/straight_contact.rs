//! This module finds contacts: the point of the cutter that reached a point of a column first, and how fast
//! the surface advances there.

use super::band_engagement::{BandEngagement, BinContact, CrossPathPosition};
use super::cutter_underside::CutterUnderside;
use crate::cutter::Meridian;

/// Material thinner than this (mm) is the rounding that the piece before left, not a chip.
const FILM: f64 = 2e-4;

/// The number of samples over a column's height if forces are needed.
const SAMPLES: usize = 4;

/// The data of a straight piece from which contacts are found. Heights count from the grid's base.
#[derive(Debug, Clone)]
pub(super) struct StraightContactFinder {
    pub profile: Meridian,
    /// The components of the unit direction of travel across the axis, and along it (positive upwards).
    pub across: f64,
    pub along: f64,
    /// The height of the tip at the start; for a piece straight along the axis, at its lower end.
    pub start: f64,
    /// The height of the tip at the start, also for a piece along the axis.
    pub first: f64,
    /// The length of the piece across the axis, mm.
    pub length: f64,
    /// How much lower the tip is at the end than at the start, mm; 0 for a piece that does not descend.
    pub drop: f64,
    /// The length of the parts for which the removal is known, mm; see [`crate::engagement::RemovalProfile`].
    pub part: f64,
    /// The distance of columns, mm.
    pub cell: f64,
    /// Whether the bins must be filled finely enough for forces.
    pub detail: bool,
    /// Whether no piece before has cleared the ground at the start.
    pub fresh: bool,
}

/// A column from which `low..top` was removed, with its position along the path and to the left of it, mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct RemovedColumn {
    pub along: f64,
    pub left: f64,
    pub low: f64,
    pub top: f64,
}

/// A point of the cutter that is in contact.
#[derive(Debug, Clone, Copy)]
struct StraightContact {
    /// The distance ahead of the axis, mm.
    ahead: f64,
    /// The distance from the axis, mm.
    rho: f64,
    /// The height above the tip, mm.
    height: f64,
    /// The sine and cosine of the normal's angle from straight down.
    sin: f64,
    cos: f64,
}

impl StraightContactFinder {
    /// Adds a column's contacts.
    ///
    /// The sweep is the same all along the path, so the advance ratio of a contact depends only on its
    /// position across the path: on `rise`, its height measured square to the path, and on its lateral
    /// distance. The ratio grows inwards, and it grows upwards unless the path descends. A column is
    /// dominated by another one that is further in and higher, or on a descent further in with a wider range
    /// of rise. Without detail, dominated columns are not examined more closely.
    #[inline]
    pub(super) fn add_column_contacts(
        &self,
        column: RemovedColumn,
        surface: &CutterUnderside,
        partial: &mut BandEngagement,
    ) {
        let depth = column.top - column.low;
        let place = self.cross_path_position(&column);
        if self.fresh && self.is_inside_at_start(&column) {
            partial.removal.add_at_start(depth as f32);
            partial.add_volume(depth as f32, column.left as f32);
            partial.add_contact(&self.unknown_contact(&column));
            return;
        }
        if partial.removal.is_divided() {
            self.add_removal(&column, surface, partial);
        }
        if depth < FILM || (!self.detail && partial.is_dominated(&place, self.along >= 0.0, depth)) {
            partial.add_volume(depth as f32, column.left as f32);
        } else {
            self.examine_column(column, place, surface, partial);
        }
    }

    /// Returns whether a column's material is in the cutter before it moves. How the cutter reached it is
    /// then not known.
    fn is_inside_at_start(&self, column: &RemovedColumn) -> bool {
        let rho = hypot_fast(column.along, column.left);
        rho < self.profile.radius_mm() && column.top > self.start_height_mm(rho) + 1e-3
    }

    /// Returns the height of the cutter's surface at the start, at a distance from the axis.
    fn start_height_mm(&self, rho: f64) -> f64 {
        self.first + self.profile.height_at_radius_mm(rho)
    }

    /// Makes a contact for material that was reached in an unknown way. It gets the largest advance ratio
    /// there can be.
    fn unknown_contact(&self, column: &RemovedColumn) -> BinContact {
        let rho = hypot_fast(column.along, column.left);
        BinContact {
            angle: atan2_fast(column.left as f32, column.along as f32),
            length: self.profile.arc_length_of_contact_mm(rho, self.profile.height_at_radius_mm(rho), 1.0)
                as f32,
            advance_ratio: 1.0,
            advance_ratio_bound: 1.0,
            radial: 1.0,
            thickness: f32::INFINITY,
        }
    }

    /// Examines a column and adds its contacts to the bins.
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
        // From a surface whose normal has the angle psi from the vertical up to a level surface at `depth`
        // above it, the thickness along the normal is depth / cos(psi).
        let steepness = if upper.cos > 1e-3 { 1.0 / upper.cos } else { f64::INFINITY };
        let thickness = depth * steepness;
        let heights = [bottom.height.min(upper.height), upper.height.max(bottom.height)];
        partial.add_column(depth as f32, left as f32, heights.map(|height| height as f32));
        let angle = atan2_fast(left as f32, upper.ahead as f32);
        // Material that was in the cutter from the start tells nothing about the material on its path.
        if along - upper.ahead > 1e-6 {
            partial.remember_contact(place, self.along >= 0.0, steepness, angle);
        }
        let mut give = |touch: &StraightContact, cap: f64| {
            partial.add_contact(&self.bin_contact(touch, left, thickness, cap))
        };
        // On a descent the largest ratio may be between the two contacts, where the normal points along the
        // path.
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

    /// Returns the position of a column's contacts across the path. On a path straight down, the advance
    /// ratio only depends on the distance from the axis.
    #[inline]
    fn cross_path_position(&self, column: &RemovedColumn) -> CrossPathPosition {
        let RemovedColumn { along, left, low, top } = *column;
        if self.across <= 1e-9 {
            let rho = hypot_fast(along, left);
            return CrossPathPosition { least: rho, greatest: -rho, side: 0.0 };
        }
        // The height square to the path: z times the cosine of the slope minus the distance times its sine.
        let rise = |z: f64| (z - self.start) * self.across - along * self.along;
        CrossPathPosition { least: rise(low), greatest: rise(top), side: left.abs() }
    }

    /// Converts a contact for the bins. `cap` is an advance ratio that is reached between this contact and
    /// another one.
    fn bin_contact(&self, touch: &StraightContact, left: f64, thickness: f64, cap: f64) -> BinContact {
        // The boundary of the material is half a cell further in than the last column on average, and at most
        // a whole cell.
        let share = |shift: f64| {
            let q = (left.abs() - shift).max(0.0);
            let ahead = (touch.rho * touch.rho - q * q).max(0.0).sqrt();
            let ahead = if touch.ahead < 0.0 { -ahead } else { ahead };
            let turned = if touch.rho > 0.0 { ahead / touch.rho } else { 1.0 };
            // The advance ratio v.n / |v| with n = (sin psi cos theta, sin psi sin theta, -cos psi).
            (self.across * turned * touch.sin - self.along * touch.cos).max(cap).clamp(0.0, 1.0) as f32
        };
        let angle = atan2_fast(left as f32, touch.ahead as f32);
        BinContact {
            angle,
            length: self.profile.arc_length_of_contact_mm(touch.rho, touch.height, touch.sin) as f32,
            advance_ratio: share(self.cell / 2.0),
            advance_ratio_bound: share(self.cell),
            radial: touch.sin as f32,
            // Between two columns, material may be thicker by the rise of the surface over half a cell.
            thickness: (thickness + self.cell / 2.0 * touch.sin) as f32,
        }
    }

    /// Returns the largest advance ratio between two contacts of one column on a descent, where the corner's
    /// normal may point straight along the path. Returns 0 if it does not.
    fn max_ratio_between(&self, bottom: &StraightContact, upper: &StraightContact) -> f64 {
        if self.profile.corner_radius_mm() <= 0.0 || upper.rho <= 0.0 {
            return 0.0;
        }
        // Over the angle psi of the normal the ratio is forward sin psi + down cos psi. Its maximum, at tan
        // psi = forward / down, is the root of the sum of squares.
        let forward = self.across * upper.ahead / upper.rho;
        let down = -self.along;
        // Angles from straight down are compared by their tangents. The lower contact's angle is negative if
        // the contact is behind the axis.
        let behind = if bottom.ahead < 0.0 { -bottom.sin } else { bottom.sin };
        let after_bottom = forward * bottom.cos >= down * behind;
        let before_upper = forward * upper.cos <= down * upper.sin;
        if after_bottom && before_upper { (forward * forward + down * down).sqrt() } else { 0.0 }
    }

    /// Returns the contact that leaves the final surface over a column.
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

    /// Returns the contact with which the cutter first reaches the point of a column at height `z`. `lowest`
    /// is the column's last contact.
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
            // The cylinder comes first wherever the point is above the corner radius when the cylinder
            // arrives.
            let at = along - (flank_radius * flank_radius - left * left).max(0.0).sqrt();
            let height = z - tip(at);
            // Heights are `f32`, so a point slightly below the flank's lower end counts as at it.
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
        // On a level path a point keeps its height on the cutter, so the circle of that height arrives first.
        if slope == 0.0 {
            let height = z - self.start;
            let radius = self.profile.radius_at_height_mm(height);
            return on((along - (radius * radius - left * left).max(0.0).sqrt()).max(0.0), height);
        }
        let at = self.first_contact_distance_mm(along, left, z, slope, along - lowest.ahead);
        on(at, (z - tip(at)).max(0.0))
    }

    /// Returns the distance across at which a ball first reaches a point, which is given relative to the
    /// ball's centre at the start.
    fn ball_contact_distance_mm(&self, along: f64, left: f64, up: f64, radius: f64) -> f64 {
        // The smaller root s of |p - s u|^2 = R^2: s = p.u - sqrt((p.u)^2 - |p|^2 + R^2).
        let travelled = along * self.across + up * self.along;
        let apart2 = along * along + left * left + up * up - radius * radius;
        (travelled - (travelled * travelled - apart2).max(0.0).sqrt()) * self.across
    }

    /// Returns the first distance across at which a point is inside the cutter. The height of the point over
    /// the cutter's surface is concave along the path, so its first zero is between the cutter's arrival and
    /// the lowest contact. It is found by the method of false position (Illinois variant).
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

/// Returns the length of a vector without the care of `hypot`, since no value here is near the ends of the
/// range of `f64`.
fn hypot_fast(a: f64, b: f64) -> f64 {
    (a * a + b * b).sqrt()
}

/// Computes `atan2` to 2e-4 radians with an odd polynomial of degree 7. That is a 250th of a bin, and takes
/// only a few instructions.
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
