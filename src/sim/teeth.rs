//! Teeth: how many, how far apart, how they wind, how true they run.

use std::f64::consts::TAU;

/// Most teeth of a cutter.
const MOST: usize = 1000;

/// Pitch angles closer than this part of a pitch, and offsets closer than this many mm, are equal: rounding of the file's
/// numbers, far below what a tool grinder holds.
const SAME: f64 = 1e-9;

/// The teeth of a cutter.
#[derive(Debug, Clone, PartialEq)]
pub struct Teeth {
    /// Angle in radians between each tooth and the one that cut before it; they sum to a full turn.
    pitch: Vec<f64>,
    /// Radial offset of each tooth in mm; as many as there are teeth.
    runout: Vec<f64>,
    /// Helix angle in radians: positive where the edge lags behind its tip on the way up.
    pub helix: f64,
    /// How far the spacing and the offsets go from even: told once, since the chip formula asks for it at every point.
    run: ToothRegularity,
    /// With runout, the passes before each tooth; see [`Teeth::passes_before`].
    passes: Vec<[f64; 2]>,
}

/// What the teeth spare the chip formula.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum ToothRegularity {
    /// Even spacing, all at one radius.
    Even,
    /// Uneven spacing, all at one radius.
    Pitch,
    /// Different radii; the largest offset in mm.
    Runout(f64),
}

impl Teeth {
    /// Evenly spaced teeth that run true; `None` for no teeth, or more than 1000.
    pub fn evenly_spaced(count: u32, helix: f64) -> Option<Self> {
        let count = usize::try_from(count).ok().filter(|count| (1..=MOST).contains(count))?;
        let pitch = vec![TAU / count as f64; count];
        helix.is_finite().then(|| Self {
            pitch,
            runout: vec![0.0; count],
            helix,
            run: ToothRegularity::Even,
            passes: Vec::new(),
        })
    }

    /// Teeth with pitch angles (radians, each the angle to the tooth before, scaled to sum to a full turn) and radial offsets (mm).
    /// `None` unless there are as many of both, from one to 1000, all angles positive and all numbers finite.
    ///
    /// Angles that differ by less than 1e-9 of a pitch, and offsets that differ by less than 1e-9 mm, are equal.
    pub fn unevenly_spaced(pitch: Vec<f64>, runout: Vec<f64>, helix: f64) -> Option<Self> {
        let sum: f64 = pitch.iter().sum();
        let fits = (1..=MOST).contains(&pitch.len())
            && pitch.len() == runout.len()
            && pitch.iter().all(|angle| *angle > 0.0)
            && runout.iter().all(|offset| offset.is_finite())
            && sum.is_finite()
            && helix.is_finite();
        if !fits {
            return None;
        }
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
        Some(Self { pitch, runout, helix, run, passes })
    }

    /// Teeth with pitch angles as in [`Teeth::unevenly_spaced`], ground true on a cutter whose axis runs `eccentricity` mm beside the
    /// spindle's: tooth i, at angle a_i behind the first, has the radial offset `eccentricity * cos(a_i - toward)`, where `toward`
    /// (radians) is the angle behind the first tooth to which the cutter is displaced.
    ///
    /// First order in eccentricity / radius (Kline & DeVor 1983, eq. 2). `None` as for [`Teeth::unevenly_spaced`].
    pub fn with_eccentricity(pitch: Vec<f64>, eccentricity: f64, toward: f64, helix: f64) -> Option<Self> {
        let true_running = vec![0.0; pitch.len()];
        let teeth = Self::unevenly_spaced(pitch, true_running, helix)?;
        let runout =
            teeth.trail_angles_rad().into_iter().map(|angle| eccentricity * (angle - toward).cos()).collect();
        Self::unevenly_spaced(teeth.pitch, runout, helix)
    }

    /// How many.
    pub fn count(&self) -> usize {
        self.pitch.len()
    }

    /// Angles to the tooth before, in radians.
    pub fn pitch_angles_rad(&self) -> &[f64] {
        &self.pitch
    }

    /// Radial offsets in mm.
    pub fn runout_offsets_mm(&self) -> &[f64] {
        &self.runout
    }

    /// Angle in radians by which each tooth's tip follows the first tooth's; 0 for the first.
    pub fn trail_angles_rad(&self) -> Vec<f64> {
        let sums = self.pitch.iter().skip(1).scan(0.0, |sum, angle| {
            *sum += angle;
            Some(*sum)
        });
        std::iter::once(0.0).chain(sums).collect()
    }

    /// Whether all teeth are evenly spaced and at one radius.
    pub fn is_even(&self) -> bool {
        self.run == ToothRegularity::Even
    }

    /// What the teeth spare the chip formula.
    pub(super) fn regularity(&self) -> ToothRegularity {
        self.run
    }

    /// The passes before tooth `edge`'s, up to its own one turn ago: how much of a turn ago, and how much further out `edge` is (mm).
    /// Nothing for a tooth that does not exist, nor for teeth at one radius.
    pub(super) fn passes_before(&self, edge: usize) -> &[[f64; 2]] {
        let count = self.count();
        self.passes.get(edge * count..(edge + 1) * count).unwrap_or_default()
    }
}

/// The passes before each tooth, as [`Teeth::passes_before`] gives them, one tooth after the other.
fn list_earlier_passes(pitch: &[f64], runout: &[f64]) -> Vec<[f64; 2]> {
    let count = pitch.len();
    let of_edge = |edge: usize| {
        // Backwards from the edge, once round: each pitch angle, and the tooth that it leads back to.
        let angles = pitch.iter().rev().cycle().skip(count - 1 - edge).take(count);
        let earlier = runout.iter().rev().cycle().skip(count - edge).take(count);
        let own = runout.get(edge).copied().unwrap_or(0.0);
        let mut angle = 0.0;
        angles.zip(earlier).enumerate().map(move |(back, (pitch, offset))| {
            angle += pitch;
            // The last is the tooth itself, exactly a turn ago.
            [if back + 1 == count { 1.0 } else { angle / TAU }, own - offset]
        })
    };
    (0..count).flat_map(of_edge).collect()
}
