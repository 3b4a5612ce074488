//! The exact tooth mode: each edge's path against what the edges before it left. Slow; the reference for the fast model.
//!
//! No grid and no approximation of the trochoid: whether a tooth swept a point is asked at the moment when it pointed at it
//! (M. E. Martellotti, An analysis of the milling process, Trans. ASME 63 (1941), 677-700, for the true tooth path).

use nalgebra::{Point3, Vector3};
use std::f64::consts::TAU;

use super::edge_elements::lag_rad_per_mm;
use super::{Meridian, Teeth};
use crate::program::record::SpindleDirection;

/// A straight motion of a turning cutter whose axis stands along z; lengths in mm in any frame with such a z.
///
/// At its start the first tooth's tip points along x, and the cutter has already turned there: what its envelope holds is gone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToothMotion {
    /// Tip at the start.
    pub from: Point3<f64>,
    /// Tip at the end.
    pub to: Point3<f64>,
    /// Feed in mm/min, above 0.
    pub feed_mm_min: f64,
    /// Spindle speed in rev/min, above 0.
    pub rpm: f64,
    /// Sense of rotation seen from above.
    pub spindle: SpindleDirection,
}

/// How closely teeth are looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToothSampling {
    /// Looks per revolution.
    pub looks: u32,
    /// Points on each edge, from the tip to `height`, both ends included; a single one is at `height`.
    pub points: u32,
    /// Height above the tip up to which the edges are looked at, mm.
    pub height: f64,
    /// Tolerance of a chip's ends along its normal, mm.
    pub tolerance: f64,
}

/// What the teeth cut.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactChipThickness {
    /// The thickest chip, mm.
    pub largest: f64,
    /// The thickest chip of each edge, mm.
    pub by_edge: Vec<f64>,
}

/// Pieces into which the search along a normal is cut; material and gaps thinner than one may be missed.
const PIECES: u32 = 24;

/// Most rounds until a tooth's passage is found; each gains a factor of 2 pi r / feed per revolution, so a few do.
const ROUNDS: usize = 60;

/// A passage is found when a round moves it by less, in revolutions: a millionth of a micron of travel for any feed.
const SETTLED: f64 = 1e-9;

/// Cuts with every tooth along a motion, and measures the chips.
///
/// At each look and each point of an edge the chip is the length of material along the inward normal that is in the stock
/// (`material`, before the motion) and that no pass before swept; N + 2 passes back are asked, one more than a full turn. The path
/// before the motion, up to a couple of revolutions, is not steady: there only the envelope at the start is known.
///
/// Tolerance: `tolerance` for each chip; a maximum between looks or points is missed by their distance. Not looked at are points
/// nearer to the axis than a third of the feed per revolution (there a tooth's passage is not a moment), and in a slanted motion
/// points within a revolution's travel of a sharp edge of the profile (there the inward normal runs along the chip of the
/// other side). A chip is sought over 1.2 times the turn's advance and the runout.
pub fn measure_exact_chips(
    profile: &Meridian,
    teeth: &Teeth,
    motion: &ToothMotion,
    fineness: ToothSampling,
    material: impl Fn(Point3<f64>) -> bool,
) -> ExactChipThickness {
    let mill = TrochoidMotion::new(profile, teeth, motion);
    let mut by_edge = vec![0.0_f64; teeth.count()];
    let looks = f64::from(fineness.looks.max(1));
    let end = profile.arc_length_at_height_mm(fineness.height);
    let points = fineness.points.max(1);
    for look in 0..=(mill.turns * looks) as u64 {
        let time = look as f64 / looks;
        for (edge, largest) in by_edge.iter_mut().enumerate() {
            for point in 0..points {
                // Exactly at an end rounding would decide what is material.
                let part = if points > 1 { f64::from(point) / f64::from(points - 1) } else { 1.0 };
                let length = end * part.clamp(1e-6, 1.0 - 1e-6);
                *largest =
                    largest.max(mill.chip_thickness_mm(edge, time, length, fineness.tolerance, &material));
            }
        }
    }
    ExactChipThickness { largest: by_edge.iter().copied().fold(0.0, f64::max), by_edge }
}

/// A motion in revolutions.
struct TrochoidMotion<'a> {
    profile: &'a Meridian,
    teeth: &'a Teeth,
    trail: Vec<f64>,
    lag: f64,
    left: f64,
    from: Point3<f64>,
    /// Travel per revolution.
    advance: Vector3<f64>,
    turns: f64,
    /// Largest offset of a tooth, and how much further in the lowest is.
    highest: f64,
    spread: f64,
}

impl<'a> TrochoidMotion<'a> {
    fn new(profile: &'a Meridian, teeth: &'a Teeth, motion: &ToothMotion) -> Self {
        let way = motion.to - motion.from;
        let turns = way.norm() / motion.feed_mm_min * motion.rpm;
        let turning = turns.is_finite() && turns > 0.0;
        let highest = teeth.runout_offsets_mm().iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let lowest = teeth.runout_offsets_mm().iter().copied().fold(f64::INFINITY, f64::min);
        Self {
            profile,
            teeth,
            trail: teeth.trail_angles_rad(),
            lag: lag_rad_per_mm(profile, teeth.helix),
            left: if motion.spindle == SpindleDirection::Clockwise { 1.0 } else { -1.0 },
            from: motion.from,
            advance: if turning { way / turns } else { Vector3::zeros() },
            turns: if turning { turns } else { 0.0 },
            highest,
            spread: highest - lowest,
        }
    }

    /// Chip of an edge's point at a time (revolutions), mm.
    fn chip_thickness_mm(
        &self,
        edge: usize,
        time: f64,
        length: f64,
        tolerance: f64,
        material: &impl Fn(Point3<f64>) -> bool,
    ) -> f64 {
        let (Some(trail), Some(offset)) = (self.trail.get(edge), self.teeth.runout_offsets_mm().get(edge))
        else {
            return 0.0;
        };
        let at = self.profile.point_at_arc_length(length);
        let (sin, cos) = (self.left * (trail - TAU * time + self.lag * at.z)).sin_cos();
        let (sin_psi, cos_psi) = at.psi.sin_cos();
        let normal = Vector3::new(sin_psi * cos, sin_psi * sin, -cos_psi);
        let r = at.r + offset;
        let point = self.from + self.advance * time + Vector3::new(r * cos, r * sin, at.z);
        let advance = self.advance.dot(&normal);
        let travel = self.advance.norm();
        if self.is_at_sharp_edge(length) {
            return 0.0;
        }
        let mut reach = 1.2 * (advance.max(0.0) + self.spread * sin_psi) + 0.02 * travel;
        if sin_psi > 0.0 {
            reach = reach.min((r - travel / 3.0) / sin_psi);
        }
        if r < travel / 3.0 || reach <= 0.0 || advance + self.spread * sin_psi < -0.02 * travel {
            return 0.0;
        }
        let left_over = |depth: f64| {
            let place = point - normal * depth;
            material(place) && !self.is_cleared_at_start(place) && !self.is_swept_before(edge, time, place)
        };
        let piece = reach / f64::from(PIECES);
        let mut sum = 0.0;
        let mut before = left_over(0.0);
        for index in 0..PIECES {
            let start = f64::from(index) * piece;
            let after = left_over(start + piece);
            sum += match (before, after) {
                (true, true) => piece,
                (false, false) => 0.0,
                (true, false) => bisect_end(start, start + piece, tolerance, &left_over) - start,
                (false, true) => start + piece - bisect_end(start + piece, start, tolerance, &left_over),
            };
            before = after;
        }
        sum
    }

    /// Whether a point of the meridian is within a turn's travel of where bottom and flank meet without a rounding to speak of.
    fn is_at_sharp_edge(&self, length: f64) -> bool {
        if self.profile.corner_radius_mm() >= self.advance.norm() {
            return false;
        }
        let (across, down) = (self.advance.xy().norm(), self.advance.z.abs());
        let bottom = self.profile.bottom_arc_length_mm();
        if length < bottom {
            length > bottom - across
        } else {
            length < self.profile.flank_start_arc_length_mm() + down && down > 0.0
        }
    }

    /// Whether the cutter's envelope at the start holds a point.
    fn is_cleared_at_start(&self, place: Point3<f64>) -> bool {
        self.is_in_cutter(place - self.from, self.highest)
    }

    /// Whether any tooth that passed before `edge` at `time` swept a point near it.
    fn is_swept_before(&self, edge: usize, time: f64, place: Point3<f64>) -> bool {
        let count = self.teeth.count();
        let mut ago = 0.0;
        let mut tooth = edge;
        for _ in 0..count + 2 {
            ago += self.teeth.pitch_angles_rad().get(tooth).copied().unwrap_or(TAU) / TAU;
            tooth = (tooth + count - 1) % count;
            let Some(passed) = self.find_passage_time(tooth, time - ago, place) else { continue };
            let offset = self.teeth.runout_offsets_mm().get(tooth).copied().unwrap_or(0.0);
            if passed >= 0.0 && self.is_in_cutter(place - self.tip_at(passed), offset) {
                return true;
            }
        }
        false
    }

    /// When (in revolutions, near a guess) a tooth's edge pointed at a place: the fixed point of the angle's equation
    /// `trail - 2 pi t + lag z(t) = angle(t)`, where angle and height are the place's, seen from the tip at t.
    fn find_passage_time(&self, tooth: usize, guess: f64, place: Point3<f64>) -> Option<f64> {
        let trail = self.trail.get(tooth)?;
        let mut time = guess;
        for _ in 0..ROUNDS {
            let seen = place - self.tip_at(time);
            let angle = self.left * seen.y.atan2(seen.x);
            let turned = (trail + self.lag * seen.z - angle) / TAU;
            let next = turned + (guess - turned).round();
            if (next - time).abs() < SETTLED {
                return Some(next);
            }
            time = next;
        }
        None
    }

    /// Tip at a time in revolutions.
    fn tip_at(&self, time: f64) -> Point3<f64> {
        self.from + self.advance * time
    }

    /// Whether the profile, widened by an offset, holds a point seen from its tip.
    fn is_in_cutter(&self, seen: Vector3<f64>, offset: f64) -> bool {
        (0.0..=self.profile.height_mm()).contains(&seen.z)
            && seen.x.hypot(seen.y) <= self.profile.radius_at_height_mm(seen.z) + offset
    }
}

/// Where what holds at `inside` and not at `outside` ends, by bisection to a tolerance.
fn bisect_end(mut inside: f64, mut outside: f64, tolerance: f64, holds: &impl Fn(f64) -> bool) -> f64 {
    while (outside - inside).abs() > tolerance.max(1e-12) {
        let middle = (inside + outside) / 2.0;
        if holds(middle) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    (inside + outside) / 2.0
}
