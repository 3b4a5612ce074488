//! Teeth: how many, how far apart, how they wind, how true they run.

use std::f64::consts::TAU;

/// The teeth of a cutter.
#[derive(Debug, Clone, PartialEq)]
pub struct Teeth {
    /// Angle in radians between each tooth and the one that cut before it; they sum to a full turn.
    pitch: Vec<f64>,
    /// Radial offset of each tooth in mm; as many as there are teeth.
    runout: Vec<f64>,
    /// Helix angle in radians.
    pub helix: f64,
}

impl Teeth {
    /// Evenly spaced teeth that run true; `None` for no teeth.
    pub fn even(count: u32, helix: f64) -> Option<Self> {
        let count = usize::try_from(count).ok().filter(|count| (1..=1000).contains(count))?;
        Some(Self { pitch: vec![TAU / count as f64; count], runout: vec![0.0; count], helix })
    }

    /// Teeth with pitch angles (radians, each the angle to the tooth before, scaled to sum to a full turn) and radial offsets (mm).
    /// `None` unless there are as many of both, at least one, all angles positive and all numbers finite.
    pub fn uneven(pitch: Vec<f64>, runout: Vec<f64>, helix: f64) -> Option<Self> {
        let sum: f64 = pitch.iter().sum();
        let fits = !pitch.is_empty()
            && pitch.len() == runout.len()
            && pitch.iter().all(|angle| *angle > 0.0)
            && runout.iter().all(|offset| offset.is_finite())
            && sum.is_finite();
        fits.then(|| Self { pitch: pitch.iter().map(|angle| angle * TAU / sum).collect(), runout, helix })
    }

    /// How many.
    pub fn count(&self) -> usize {
        self.pitch.len()
    }

    /// Angles to the tooth before, in radians.
    pub fn pitch(&self) -> &[f64] {
        &self.pitch
    }

    /// Radial offsets in mm.
    pub fn runout(&self) -> &[f64] {
        &self.runout
    }
}
