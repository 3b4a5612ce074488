//! This module finds the contacts of a tilted cutter: the point of the cutter that reached a point of a
//! column first, and how fast the surface advances there.

use super::leg::{SweepLeg, normal_and_distance, unit_vector_across};
use super::revolved_solid::RevolvedSolid;
use crate::cutter::Meridian;
use crate::engagement::sweep::band_engagement::{BandEngagement, BinContact};
use nalgebra::Vector3;

/// The number of samples over a column's height if forces are needed.
const SAMPLES: usize = 4;

/// The lower ends of slices of a column, as shares of its depth, whose contacts are looked for if it is asked where
/// material is taken. They are heights on a quarter of a circle at equal angles: the underside of a ball over a column
/// is nearly that.
const SLICE_ENDS: [f64; 5] = [0.741, 0.5, 0.293, 0.134, 0.034];

/// A point counts as reached when the cutter is this close, mm.
const REACHED: f64 = 1e-5;

/// The data of a piece from which contacts are found.
#[derive(Debug, Clone)]
pub(super) struct TiltedContactFinder {
    pub profile: Meridian,
    /// The length of path during one leg that advance ratios refer to, mm.
    pub pace: f64,
    /// The unit direction of the tip's path; `None` if the tip stands still.
    pub direction: Option<Vector3<f64>>,
    pub cell: f64,
    pub detail: bool,
    /// Whether the piece before ended here, so that no material can be in the cutter at the start.
    pub continues: bool,
}

/// A contact in the cutter's frame at the time of contact.
#[derive(Debug, Clone, Copy)]
struct TiltedContact {
    /// The position ahead of the axis and to its left, the distance from it, and the height above the tip,
    /// mm.
    ahead: f64,
    left: f64,
    rho: f64,
    height: f64,
    /// The normal's components away from the axis and along it.
    radial: f64,
    axial: f64,
    /// The unit vectors straight ahead, to the left, and up the axis.
    frame: [Vector3<f64>; 3],
    /// The tip's displacement and the rotation vector of the leg.
    travel: Vector3<f64>,
    spin: Vector3<f64>,
    /// The position on the piece, as a fraction.
    way: f64,
}

impl TiltedContactFinder {
    /// Adds the contacts of a column at x, y from which `low..top` was removed.
    pub(super) fn add_column_contacts(
        &self,
        [x, y]: [f64; 2],
        [low, top]: [f64; 2],
        legs: &[(SweepLeg, RevolvedSolid)],
        partial: &mut BandEngagement,
    ) {
        let at = |height: f64| self.first_contact(Vector3::new(x, y, height), legs);
        let (Some(bottom), Some(upper)) = (at(low), at(top)) else { return };
        let cap = self.max_ratio_between(&bottom, &upper);
        let still = |touch: &TiltedContact| self.advance_ratio(touch, touch.ahead, touch.left) <= 0.0;
        if self.continues && cap <= 0.0 && still(&bottom) && still(&upper) {
            // Nothing advances into this material: it is a film within the tolerance that the piece before
            // left.
            partial.removed += top - low;
            return;
        }
        let vertical =
            |touch: &TiltedContact| touch.outward_normal(touch.ahead, touch.left, touch.rho).z.abs();
        // The normal's component along z may vanish at one end; a chip is never thicker than at the other
        // one.
        let steep = vertical(&bottom).min(vertical(&upper));
        let thickness = if steep > 1e-3 { (top - low) / steep } else { f64::INFINITY };
        let heights = [bottom.height.min(upper.height), bottom.height.max(upper.height)];
        partial.add_column((top - low) as f32, upper.left as f32, heights.map(|height| height as f32));
        partial.add_column(0.0, bottom.left as f32, heights.map(|height| height as f32));
        if !self.continues && is_inside_at_start(Vector3::new(x, y, top), legs) {
            partial.removal.add_at_start((top - low) as f32);
            // How the material was reached is not known, so it gets the largest advance ratio there can be.
            let known = self.bin_contact(&upper, f64::INFINITY, 1.0);
            partial.add_contact(&BinContact { advance_ratio_bound: 1.0, ..known });
            return;
        }
        if partial.removal.is_divided() {
            let ways =
                SLICE_ENDS.iter().filter_map(|share| Some((*share, at(low + (top - low) * share)?.way)));
            add_removal((top - low) as f32, upper.way, ways.chain([(0.0, bottom.way)]), partial);
        }
        let mut give =
            |touch: &TiltedContact, cap: f64| partial.add_contact(&self.bin_contact(touch, thickness, cap));
        give(&bottom, 0.0);
        give(&upper, cap);
        if self.detail {
            for sample in 0..SAMPLES {
                let height = low + (top - low) * (sample as f64 + 0.5) / SAMPLES as f64;
                if let Some(touch) = at(height) {
                    give(&touch, 0.0);
                }
            }
        }
    }

    /// Returns the contact with which the cutter first reaches a point. The distance from a moving convex
    /// solid is convex in time, so Newton's steps from an earlier time do not overshoot.
    fn first_contact(
        &self,
        point: Vector3<f64>,
        legs: &[(SweepLeg, RevolvedSolid)],
    ) -> Option<TiltedContact> {
        let mut nearest: Option<(f64, usize, f64)> = None;
        'legs: for (index, (leg, solid)) in legs.iter().enumerate() {
            let mut at = 0.0;
            for _ in 0..24 {
                let pose = leg.pose_at(at);
                let here = point - pose.tip;
                let (normal, gap) = normal_and_distance(solid, &here, &pose.axis);
                if nearest.is_none_or(|(least, ..)| gap < least) {
                    nearest = Some((gap, index, at));
                }
                if gap <= REACHED {
                    break 'legs;
                }
                let speed = leg.velocity_of(&here).dot(&normal);
                if speed <= 0.0 || at >= 1.0 {
                    break;
                }
                at = (at + gap / speed).min(1.0);
            }
        }
        let (_, index, at) = nearest?;
        let (leg, solid) = legs.get(index)?;
        let way = (index as f64 + at) / legs.len() as f64;
        Some(TiltedContact { way, ..self.contact_at(leg, solid, point, at) })
    }

    /// Returns the contact of a point with the cutter at a time of a leg.
    fn contact_at(
        &self,
        leg: &SweepLeg,
        solid: &RevolvedSolid,
        point: Vector3<f64>,
        at: f64,
    ) -> TiltedContact {
        let pose = leg.pose_at(at);
        let axis = pose.axis;
        let here = point - pose.tip;
        let direction = self.direction.unwrap_or_else(|| leg.spin.cross(&axis));
        let aside = direction - axis * direction.dot(&axis);
        let ahead = if aside.norm() > 1e-6 * direction.norm() {
            aside.normalize()
        } else {
            unit_vector_across(&axis)
        };
        let left = axis.cross(&ahead);
        let height = here.dot(&axis);
        let rho = (here - axis * height).norm();
        let gap = solid.surface_distance(rho, height);
        TiltedContact {
            ahead: here.dot(&ahead),
            left: here.dot(&left),
            rho,
            height: height.clamp(0.0, self.profile.height_mm()),
            radial: gap.radial,
            axial: gap.axial,
            frame: [ahead, left, axis],
            travel: leg.travel,
            spin: leg.spin,
            way: 0.0,
        }
    }

    /// Converts a contact for the bins. `cap` is an advance ratio that is reached between this contact and
    /// another one.
    fn bin_contact(&self, touch: &TiltedContact, thickness: f64, cap: f64) -> BinContact {
        // The boundary of the material is half a cell further in than the last column on average, and at most
        // a whole cell.
        let share = |shift: f64| self.shifted_advance_ratio(touch, shift).max(cap) as f32;
        BinContact {
            angle: (touch.left as f32).atan2(touch.ahead as f32),
            length: self.profile.arc_length_of_contact_mm(touch.rho, touch.height, touch.radial) as f32,
            advance_ratio: share(self.cell / 2.0),
            advance_ratio_bound: share(self.cell).max(self.raised_advance_ratio(touch) as f32),
            radial: touch.radial as f32,
            thickness: thickness as f32,
        }
    }

    /// Returns the advance ratio of a contact that is moved around the axis towards the middle of the path by
    /// a lateral distance.
    fn shifted_advance_ratio(&self, touch: &TiltedContact, shift: f64) -> f64 {
        let left = (touch.left.abs() - shift).max(0.0).copysign(touch.left);
        let ahead = (touch.rho * touch.rho - left * left).max(0.0).sqrt().copysign(touch.ahead);
        self.advance_ratio(touch, ahead, left)
    }

    /// Returns the advance ratio of a contact that is moved by a cell around the axis, and up the meridian as
    /// far as a cell reaches along the tilted axis. On a tilted cutter the boundary between two columns is
    /// also a boundary in height.
    fn raised_advance_ratio(&self, touch: &TiltedContact) -> f64 {
        let [_, start] = self.profile.flank_start();
        let axis = &touch.frame[2];
        let lean = (axis.x * axis.x + axis.y * axis.y).sqrt();
        if touch.height >= start || touch.axial > 0.0 || lean < 1e-6 {
            return 0.0;
        }
        let height = (touch.height + self.cell * lean).min(start);
        let [radial, down] = self.profile.normal_at_height(height);
        let rho = self.profile.radius_at_height_mm(height);
        let turned = if touch.rho > 1e-9 { rho / touch.rho } else { 1.0 };
        let (ahead, left) = if touch.rho > 1e-9 { (touch.ahead, touch.left) } else { (rho, 0.0) };
        let (ahead, left) = (ahead * turned, left * turned);
        self.shifted_advance_ratio(
            &TiltedContact { ahead, left, rho, height, radial, axial: -down, ..*touch },
            self.cell,
        )
    }

    /// Returns the advance ratio: the surface's speed along its normal `v.n`, divided by the reference speed.
    fn advance_ratio(&self, touch: &TiltedContact, ahead: f64, left: f64) -> f64 {
        let normal = touch.outward_normal(ahead, left, touch.rho);
        touch.surface_velocity(ahead, left).dot(&normal).max(0.0) / self.pace
    }

    /// Returns the largest advance ratio between two contacts of one column, where the corner's normal may
    /// point straight along the velocity. Returns 0 if it does not.
    fn max_ratio_between(&self, bottom: &TiltedContact, upper: &TiltedContact) -> f64 {
        if self.profile.corner_radius_mm() <= 0.0
            || upper.rho <= 1e-9
            || upper.axial > 0.0
            || bottom.axial > 0.0
        {
            return 0.0;
        }
        let velocity = upper.surface_velocity(upper.ahead, upper.left);
        let [ahead, left, axis] = &upper.frame;
        // Over the angle psi of the normal from straight down the ratio is forward sin psi + down cos psi, as
        // for straight pieces.
        let outward = (ahead * upper.ahead + left * upper.left) / upper.rho;
        let (forward, down) = (velocity.dot(&outward), -velocity.dot(axis));
        // The lower contact's angle is negative if it is on the other side of the axis.
        let best = forward.atan2(down);
        let opposite = upper.ahead * bottom.ahead + upper.left * bottom.left < 0.0;
        let from = bottom.radial.atan2(-bottom.axial) * if opposite { -1.0 } else { 1.0 };
        let to = upper.radial.atan2(-upper.axial);
        if (from.min(to)..=from.max(to)).contains(&best) {
            (forward * forward + down * down).sqrt() / self.pace
        } else {
            0.0
        }
    }
}

impl TiltedContact {
    /// Returns the outward unit normal at a position around the axis.
    fn outward_normal(&self, ahead: f64, left: f64, rho: f64) -> Vector3<f64> {
        let [forward, leftward, axis] = &self.frame;
        let outward = if rho > 1e-9 { (forward * ahead + leftward * left) / rho } else { *forward };
        outward * self.radial + axis * self.axial
    }

    /// Returns the velocity of the surface point: the tip's plus the turn's.
    fn surface_velocity(&self, ahead: f64, left: f64) -> Vector3<f64> {
        let [forward, leftward, axis] = &self.frame;
        self.travel + self.spin.cross(&(forward * ahead + leftward * left + axis * self.height))
    }
}

/// Adds where on the piece a column's material is taken, from the position at which its upper end is touched and those
/// at which the lower ends of its slices are. Within a slice it counts as even.
fn add_removal(
    depth: f32,
    upper: f64,
    lower_ends: impl Iterator<Item = (f64, f64)>,
    partial: &mut BandEngagement,
) {
    let (mut above, mut from) = (1.0, upper);
    for (share, way) in lower_ends {
        // A point may be touched a rounding before the one above it.
        let to = f64::max(from, way);
        partial.removal.add_volume(depth * (above - share) as f32, [from, to]);
        (above, from) = (share, to);
    }
}

/// Returns whether a point is in the cutter before it moves.
fn is_inside_at_start(point: Vector3<f64>, legs: &[(SweepLeg, RevolvedSolid)]) -> bool {
    legs.first().is_some_and(|(leg, solid)| {
        let pose = leg.pose_at(0.0);
        normal_and_distance(solid, &(point - pose.tip), &pose.axis).1 < -1e-3
    })
}
