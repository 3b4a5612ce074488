//! This module measures exact chips: it compares the path of each cutting edge with the surface that the
//! edges before it left. It is slow and is the reference for the fast model.
//!
//! It uses no grid and does not approximate the trochoid: whether a tooth swept a point is decided at the
//! moment when the tooth pointed at it. For the true tooth path see M. E. Martellotti, An analysis of the
//! milling process, Trans. ASME 63 (1941), 677-700.

use nalgebra::{Point3, Vector3};
use std::f64::consts::TAU;

use crate::cutter::{Meridian, Teeth};
use crate::engagement::edge_elements::lag_rad_per_mm;
use crate::program::record::SpindleDirection;

/// A straight motion of a turning cutter whose axis is along z. Lengths are in mm, in any frame with such a z
/// axis.
///
/// At the start of the motion the tip of the first tooth points along x. The cutter has already turned there,
/// so the material inside its envelope is gone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToothMotion {
    /// The tip at the start.
    pub from: Point3<f64>,
    /// The tip at the end.
    pub to: Point3<f64>,
    /// The feed in mm/min, above 0.
    pub feed_mm_min: f64,
    /// The spindle speed in rev/min, above 0.
    pub rpm: f64,
    /// The direction of rotation, seen from above.
    pub spindle: SpindleDirection,
}

/// The resolution at which the teeth are sampled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToothSampling {
    /// The number of samples per revolution.
    pub looks: u32,
    /// The number of points on each edge, from the tip to `height` with both ends included. A single point is
    /// at `height`.
    pub points: u32,
    /// The height above the tip up to which the edges are sampled, mm.
    pub height_mm: f64,
    /// The tolerance of a chip's ends along its normal, mm.
    pub tolerance_mm: f64,
}

/// The measured chips.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ExactChipThickness {
    /// The thickest chip, mm.
    pub largest_mm: f64,
    /// The thickest chip of each edge, mm.
    pub by_edge_mm: Vec<f64>,
}

/// The number of pieces into which the search along a normal is divided. Material and gaps that are thinner
/// than one piece may be missed.
const PIECES: u32 = 24;

/// The most iterations until a tooth's passage is found. Each iteration reduces the error by a factor of 2 pi
/// r / feed per revolution, so a few are enough.
const ROUNDS: usize = 60;

/// A passage is found when an iteration moves it by less than this, in revolutions. That is a millionth of a
/// micron of travel at any feed.
const SETTLED: f64 = 1e-9;

/// Moves every tooth along a motion and measures the chips.
///
/// The chip of a point of an edge is the length of material along the inward normal that is in the stock
/// (`material`, before the motion) and that no earlier pass swept. The N + 2 passes before are tested, which
/// is more than a full turn of N teeth. The first revolutions of the motion are not steady: for them only the
/// envelope at the start is known.
///
/// Each chip has the error `tolerance`, and a maximum between samples is missed by their distance. Two kinds
/// of points are not sampled. Points nearer to the axis than a third of the feed per revolution are left out,
/// because a tooth does not pass there at one moment. In a sloped motion, points within a revolution's travel
/// of a sharp edge of the meridian are left out, because the inward normal there runs along the chip of the
/// other side. A chip is searched over 1.2 times the turn's advance and the runout.
///
/// ```
/// use clsmith::cutter::{Meridian, Teeth};
/// use clsmith::engagement::{ToothMotion, ToothSampling, measure_exact_chips};
/// use clsmith::program::record::SpindleDirection;
/// use nalgebra::Point3;
///
/// let profile = Meridian::new(10.0, 0.0, 0.0, 0.0, 20.0)?;
/// let teeth = Teeth::evenly_spaced(2, 0.0).expect("two teeth");
/// let motion = ToothMotion {
///     from: Point3::new(0.0, 0.0, 0.0),
///     to: Point3::new(2.0, 0.0, 0.0),
///     feed_mm_min: 1000.0,
///     rpm: 5000.0,
///     spindle: SpindleDirection::Clockwise,
/// };
/// let fineness = ToothSampling { looks: 120, points: 1, height_mm: 1.0, tolerance_mm: 1e-4 };
/// let chips = measure_exact_chips(&profile, &teeth, &motion, fineness, |point| point.z < 2.0);
/// assert!((chips.largest_mm - 0.1).abs() < 1e-3);
/// # Ok::<(), clsmith::cutter::MeridianError>(())
/// ```
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
    let end = profile.arc_length_at_height_mm(fineness.height_mm);
    let points = fineness.points.max(1);
    for look in 0..=(mill.turns * looks) as u64 {
        let time = look as f64 / looks;
        for (edge, largest) in by_edge.iter_mut().enumerate() {
            for point in 0..points {
                // Exactly at an end of the edge, rounding would decide what is material.
                let part = if points > 1 { f64::from(point) / f64::from(points - 1) } else { 1.0 };
                let length = end * part.clamp(1e-6, 1.0 - 1e-6);
                *largest =
                    largest.max(mill.chip_thickness_mm(edge, time, length, fineness.tolerance_mm, &material));
            }
        }
    }
    ExactChipThickness { largest_mm: by_edge.iter().copied().fold(0.0, f64::max), by_edge_mm: by_edge }
}

/// A motion with the revolution as the unit of time.
struct TrochoidMotion<'a> {
    profile: &'a Meridian,
    teeth: &'a Teeth,
    trail: Vec<f64>,
    lag: f64,
    left: f64,
    from: Point3<f64>,
    /// The tip's travel per revolution, mm.
    advance: Vector3<f64>,
    turns: f64,
    /// The largest radial offset of a tooth, and the difference to the smallest one, mm.
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
            lag: lag_rad_per_mm(profile, teeth.helix_rad),
            left: if motion.spindle == SpindleDirection::Clockwise { 1.0 } else { -1.0 },
            from: motion.from,
            advance: if turning { way / turns } else { Vector3::zeros() },
            turns: if turning { turns } else { 0.0 },
            highest,
            spread: highest - lowest,
        }
    }

    /// Returns the chip of a point of an edge at a time in revolutions, mm.
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
        // The point's angle: it trails the first tooth, turns once a revolution, and lags by the helix.
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
        // The chip cannot be much longer than the turn's advance along the normal plus the runout; the search
        // must also stay away from the axis.
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
        // Add up the pieces with material; where it begins or ends within a piece, bisect.
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

    /// Returns whether a point of the meridian is within one revolution's travel of a sharp edge between
    /// bottom and flank. A corner radius below that travel counts as sharp.
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

    /// Returns whether a point is inside the cutter's envelope at the start.
    fn is_cleared_at_start(&self, place: Point3<f64>) -> bool {
        self.is_in_cutter(place - self.from, self.highest)
    }

    /// Returns whether any tooth that passed before `edge` at `time` swept a point.
    fn is_swept_before(&self, edge: usize, time: f64, place: Point3<f64>) -> bool {
        let count = self.teeth.count();
        let mut ago = 0.0;
        // Go backwards from tooth to tooth; each passed about a pitch angle earlier.
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

    /// Finds the time in revolutions, near a guess, at which a tooth's edge pointed at a point. It is the
    /// fixed point of the equation `trail - 2 pi t + lag z(t) = angle(t)`, where the angle and the height are
    /// those of the point seen from the tip at t.
    fn find_passage_time(&self, tooth: usize, guess: f64, place: Point3<f64>) -> Option<f64> {
        let trail = self.trail.get(tooth)?;
        let mut time = guess;
        for _ in 0..ROUNDS {
            let seen = place - self.tip_at(time);
            let angle = self.left * seen.y.atan2(seen.x);
            let turned = (trail + self.lag * seen.z - angle) / TAU;
            // Angles repeat every turn, so the solution next to the guess is taken.
            let next = turned + (guess - turned).round();
            if (next - time).abs() < SETTLED {
                return Some(next);
            }
            time = next;
        }
        None
    }

    /// Returns the tip at a time in revolutions.
    fn tip_at(&self, time: f64) -> Point3<f64> {
        self.from + self.advance * time
    }

    /// Returns whether the cutter, with its radius increased by an offset, contains a point given from its
    /// tip.
    fn is_in_cutter(&self, seen: Vector3<f64>, offset: f64) -> bool {
        (0.0..=self.profile.height_mm()).contains(&seen.z)
            && seen.x.hypot(seen.y) <= self.profile.radius_at_height_mm(seen.z) + offset
    }
}

/// Finds by bisection where a property that holds at `inside` and not at `outside` ends.
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
