//! This module describes the teeth of a cutter: their number, spacing, helix and runout.

use std::f64::consts::TAU;

/// The most teeth of a cutter.
const MOST: usize = 1000;

/// Pitch angles that differ by less than this fraction of a pitch, and offsets that differ by less than this
/// many mm, count as equal. Such differences are rounding of the file's numbers, far below what a tool
/// grinder can hold.
const SAME: f64 = 1e-9;

/// The teeth of a cutter.
///
/// ```
/// use clsmith::cutter::Teeth;
///
/// let even = Teeth::evenly_spaced(4, 38_f64.to_radians()).expect("four teeth");
/// assert_eq!(even.count(), 4);
/// let pitches = [80.0, 100.0, 80.0, 100.0].map(f64::to_radians).to_vec();
/// let uneven = Teeth::unevenly_spaced(pitches, vec![0.0; 4], 0.0).expect("as many angles as offsets");
/// assert!(even.is_even() && !uneven.is_even());
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Teeth {
    /// The angle in radians between each tooth and the one that cuts before it. The angles sum to a full
    /// turn.
    pitch: Vec<f64>,
    /// The radial offset of each tooth in mm, one for each tooth.
    runout: Vec<f64>,
    /// The helix angle in radians. It is positive if the edge lags behind its tip on the way up.
    pub helix_rad: f64,
    /// By what the state of the edges multiplies all forces; 1 for those of the material's coefficients.
    wear: f64,
    /// How irregular spacing and offsets are. It is stored because the chip formula needs it at every point.
    run: ToothRegularity,
    /// The passes before each tooth, for teeth with runout; see [`Teeth::passes_before`].
    passes: Vec<[f64; 2]>,
}

/// The kinds of teeth for which the chip formula has different shortcuts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ToothRegularity {
    /// The teeth are evenly spaced and all at one radius.
    Even,
    /// The teeth are unevenly spaced and all at one radius.
    Pitch,
    /// The teeth are at different radii; the value is the largest offset in mm.
    Runout(f64),
}

impl Teeth {
    /// Makes evenly spaced teeth without runout, or `None` for no teeth or more than 1000.
    pub fn evenly_spaced(count: u32, helix_rad: f64) -> Option<Self> {
        let count = usize::try_from(count).ok().filter(|count| (1..=MOST).contains(count))?;
        let pitch = vec![TAU / count as f64; count];
        helix_rad.is_finite().then(|| Self {
            pitch,
            runout: vec![0.0; count],
            helix_rad,
            wear: 1.0,
            run: ToothRegularity::Even,
            passes: Vec::new(),
        })
    }

    /// Makes teeth from pitch angles (radians, each the angle to the tooth before; they are scaled to sum to
    /// a full turn) and radial offsets (mm). Returns `None` unless there are equally many of both, from one
    /// to 1000, all angles are positive and all numbers are finite.
    ///
    /// Angles that differ by less than 1e-9 of a pitch, and offsets that differ by less than 1e-9 mm, count
    /// as equal.
    pub fn unevenly_spaced(pitch: Vec<f64>, runout: Vec<f64>, helix_rad: f64) -> Option<Self> {
        let sum: f64 = pitch.iter().sum();
        let fits = (1..=MOST).contains(&pitch.len())
            && pitch.len() == runout.len()
            && pitch.iter().all(|angle| *angle > 0.0)
            && runout.iter().all(|offset| offset.is_finite())
            && sum.is_finite()
            && helix_rad.is_finite();
        if !fits {
            return None;
        }
        // Printed angles are rounded, so they are scaled to close the circle exactly.
        let pitch: Vec<f64> = pitch.iter().map(|angle| angle * TAU / sum).collect();
        let highest = runout.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let lowest = runout.iter().copied().fold(f64::INFINITY, f64::min);
        let even = TAU / pitch.len() as f64;
        let run = if highest - lowest > SAME {
            ToothRegularity::Runout(highest)
        } else if pitch.iter().all(|angle| (angle - even).abs() <= SAME * even) {
            ToothRegularity::Even
        } else {
            ToothRegularity::Pitch
        };
        let passes = if matches!(run, ToothRegularity::Runout(_)) {
            list_earlier_passes(&pitch, &runout)
        } else {
            Vec::new()
        };
        Some(Self { pitch, runout, helix_rad, wear: 1.0, run, passes })
    }

    /// Makes teeth with the pitch angles of [`Teeth::unevenly_spaced`] on a cutter that is ground without
    /// runout but whose axis is `eccentricity_mm` beside the spindle's. Tooth i, at the angle a_i behind the
    /// first, then has the radial offset `eccentricity_mm * cos(a_i - toward_rad)`, where `toward_rad` is the
    /// direction of the displacement as an angle behind the first tooth.
    ///
    /// The offsets are of first order in eccentricity / radius (Kline and DeVor 1983, eq. 2). Returns `None`
    /// in the same cases as [`Teeth::unevenly_spaced`].
    pub fn with_eccentricity(
        pitch: Vec<f64>,
        eccentricity_mm: f64,
        toward_rad: f64,
        helix_rad: f64,
    ) -> Option<Self> {
        let true_running = vec![0.0; pitch.len()];
        let teeth = Self::unevenly_spaced(pitch, true_running, helix_rad)?;
        let runout = teeth
            .trail_angles_rad()
            .into_iter()
            .map(|angle| eccentricity_mm * (angle - toward_rad).cos())
            .collect();
        Self::unevenly_spaced(teeth.pitch, runout, helix_rad)
    }

    /// Returns the teeth with forces that are `factor` times those of the material's coefficients, for edges that are
    /// blunter or sharper than those with which they were measured. Other factors than positive ones change nothing.
    #[must_use]
    pub fn with_wear_factor(mut self, factor: f64) -> Self {
        if factor > 0.0 && factor.is_finite() {
            self.wear = factor;
        }
        self
    }

    /// Returns by what the state of the edges multiplies all forces.
    pub fn wear_factor(&self) -> f64 {
        self.wear
    }

    /// Returns the number of teeth.
    pub fn count(&self) -> usize {
        self.pitch.len()
    }

    /// Returns the angle from each tooth to the tooth before it, radians.
    pub fn pitch_angles_rad(&self) -> &[f64] {
        &self.pitch
    }

    /// Returns the radial offset of each tooth, mm.
    pub fn runout_offsets_mm(&self) -> &[f64] {
        &self.runout
    }

    /// Returns the angle by which each tooth's tip follows the first tooth's, radians; 0 for the first.
    pub fn trail_angles_rad(&self) -> Vec<f64> {
        let sums = self.pitch.iter().skip(1).scan(0.0, |sum, angle| {
            *sum += angle;
            Some(*sum)
        });
        std::iter::once(0.0).chain(sums).collect()
    }

    /// Returns whether all teeth are evenly spaced and at one radius.
    pub fn is_even(&self) -> bool {
        self.run == ToothRegularity::Even
    }

    /// Returns whether chips are proportional to the advance, which runout makes them not.
    pub(crate) fn has_smooth_chips(&self) -> bool {
        !matches!(self.run, ToothRegularity::Runout(_))
    }

    /// Returns which shortcut the chip formula can take.
    pub(crate) fn regularity(&self) -> ToothRegularity {
        self.run
    }

    /// Returns the passes before the pass of tooth `edge`, up to its own pass one turn earlier. Each has two
    /// values: the time since that pass as a fraction of a turn, and by how much `edge` is further out than
    /// that tooth, mm. The list is empty for a tooth that does not exist and for teeth at one radius.
    pub(crate) fn passes_before(&self, edge: usize) -> &[[f64; 2]] {
        let count = self.count();
        self.passes.get(edge * count..(edge + 1) * count).unwrap_or_default()
    }
}

/// Lists the passes before each tooth as [`Teeth::passes_before`] returns them, one tooth after the other.
fn list_earlier_passes(pitch: &[f64], runout: &[f64]) -> Vec<[f64; 2]> {
    let count = pitch.len();
    let of_edge = |edge: usize| {
        // Go backwards from the edge once around: each pitch angle, and the tooth to which it leads back.
        let angles = pitch.iter().rev().cycle().skip(count - 1 - edge).take(count);
        let earlier = runout.iter().rev().cycle().skip(count - edge).take(count);
        let own = runout.get(edge).copied().unwrap_or(0.0);
        let mut angle = 0.0;
        angles.zip(earlier).enumerate().map(move |(back, (pitch, offset))| {
            angle += pitch;
            // The last pass is the tooth's own, exactly one turn ago.
            [if back + 1 == count { 1.0 } else { angle / TAU }, own - offset]
        })
    };
    (0..count).flat_map(of_edge).collect()
}
