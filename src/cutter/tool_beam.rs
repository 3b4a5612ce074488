//! This module holds a tool as a beam that is clamped at its holder: how far it bends under forces across its axis, and the
//! stress that they make.
//!
//! The beam is one of steps, each a cylinder, after Euler and Bernoulli: no shear, no give of clamp, holder and spindle. The
//! virtual force of 1 N at a height a gives the deflection there for a force at a height b,
//! `integral from max(a, b) to the clamp of (s - a)(s - b) / (E I) ds`, in closed form for each step (for instance Gere and
//! Goodno, Mechanics of Materials, ch. 9); the stress at a step is `M d / (2 I)`. A fluted part bends like a cylinder of
//! about 80 % of its diameter (Kops and Vo, CIRP Annals 39 (1990), 93-96).

use super::Meridian;
use std::f64::consts::PI;

/// The diameter of the cylinder that bends like a fluted part, by the diameter of that: Kops and Vo found about 80 % for mills
/// of two and of four flutes, by strain gauges and finite elements.
pub const FLUTE_DIAMETER_FACTOR: f64 = 0.8;

/// The most steps that stand for the flutes of a tapered mill.
const TAPER_STEPS: u32 = 32;
/// Lengths in mm that differ by less are equal.
const LENGTH_TOLERANCE_MM: f64 = 1e-6;

/// A tool as a beam from its tip up to its clamp.
///
/// ```
/// use clsmith::cutter::{BeamStep, ToolBeam};
///
/// let bar = BeamStep { from_mm: 0.0, to_mm: 50.0, diameter_mm: 10.0 };
/// let beam = ToolBeam::new(vec![bar], 580.0).expect("one step from the tip");
/// // F L^3 / (3 E I) for 100 N at the tip.
/// let inertia = std::f64::consts::PI * 10.0_f64.powi(4) / 64.0;
/// let known = 100.0 * 50.0_f64.powi(3) / (3.0 * 580e3 * inertia);
/// assert!((100.0 * beam.deflection_mm_per_n(0.0, 0.0) / known - 1.0).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ToolBeam {
    steps: Vec<BeamStep>,
    youngs_modulus_mpa: f64,
}

/// A part of a beam with one diameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamStep {
    /// The height above the tip at which it begins, mm.
    pub from_mm: f64,
    /// The height at which it ends, mm.
    pub to_mm: f64,
    /// The diameter of the cylinder that bends like it, mm.
    pub diameter_mm: f64,
}

impl BeamStep {
    /// Returns the second moment of area, mm4.
    fn inertia_mm4(&self) -> f64 {
        PI * self.diameter_mm.powi(4) / 64.0
    }

    /// Returns by what a bending moment in N mm is divided for the stress in MPa, mm3.
    fn section_modulus_mm3(&self) -> f64 {
        PI * self.diameter_mm.powi(3) / 32.0
    }
}

/// The forces on a tool across its axis, ahead and to the left, as its beam needs them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BeamForces {
    /// Their sum, N.
    pub force_n: [f64; 2],
    /// The sum of each times the height at which it acts, N mm.
    pub moment_n_mm: [f64; 2],
    /// The deflection of the tip, mm: the sum of each times [`ToolBeam::deflection_mm_per_n`].
    pub deflection_mm: [f64; 2],
}

impl BeamForces {
    /// Adds a force at a height above the tip, where `give` is the tip's deflection for 1 N there.
    #[inline]
    pub(crate) fn add_force(&mut self, [ahead, left]: [f64; 2], height_mm: f64, give_mm_per_n: f64) {
        self.force_n[0] += ahead;
        self.force_n[1] += left;
        self.moment_n_mm[0] += ahead * height_mm;
        self.moment_n_mm[1] += left * height_mm;
        self.deflection_mm[0] += ahead * give_mm_per_n;
        self.deflection_mm[1] += left * give_mm_per_n;
    }
}

impl ToolBeam {
    /// Makes a beam of steps from the tip up to the clamp, for a Young's modulus in GPa. Returns `None` if the steps do not
    /// follow each other from the tip on, or a number is not above 0.
    pub fn new(steps: Vec<BeamStep>, youngs_modulus_gpa: f64) -> Option<Self> {
        let mut end = 0.0;
        for step in &steps {
            let is_next = (step.from_mm - end).abs() <= LENGTH_TOLERANCE_MM && step.to_mm > step.from_mm;
            if !is_next || step.diameter_mm.is_nan() || step.diameter_mm <= 0.0 {
                return None;
            }
            end = step.to_mm;
        }
        let is_beam = !steps.is_empty() && youngs_modulus_gpa > 0.0;
        is_beam.then_some(Self { steps, youngs_modulus_mpa: youngs_modulus_gpa * 1e3 })
    }

    /// Returns the steps that stand for the flutes of a mill, up to a clamp. `factor` is the diameter of the cylinder that
    /// bends like the flutes, by theirs. A taper is a stair inside it; what is below the flank counts as thick as its lower
    /// end, and a cutter that narrows upwards as thin as there.
    pub fn flute_steps(profile: &Meridian, factor: f64, clamp_mm: f64) -> Vec<BeamStep> {
        let end = profile.height_mm().min(clamp_mm);
        let step = |from_mm: f64, to_mm: f64, radius_mm: f64| BeamStep {
            from_mm,
            to_mm,
            diameter_mm: 2.0 * radius_mm * factor,
        };
        if profile.top().is_some() || profile.taper_rad() == 0.0 {
            let radius_mm =
                if profile.top().is_some() { profile.upper_radius_mm() } else { profile.radius_mm() };
            return vec![step(0.0, end, radius_mm.min(profile.radius_mm()))];
        }
        let [_, flank_mm] = profile.flank_start();
        let begin = flank_mm.clamp(0.0, end);
        let size = (end - begin) / f64::from(TAPER_STEPS);
        let mut steps = Vec::new();
        for number in 0..TAPER_STEPS {
            let low = begin + size * f64::from(number);
            // A cone on its tip has no thickness there.
            let thin = profile.radius_at_height_mm(low);
            let radius_mm = if thin > 0.0 { thin } else { profile.radius_at_height_mm(low + size / 2.0) };
            if number == 0 && begin > 0.0 {
                steps.push(step(0.0, begin, radius_mm));
            }
            steps.push(step(low, low + size, radius_mm));
        }
        steps
    }

    /// Returns the steps, from the tip up to the clamp.
    pub fn steps(&self) -> &[BeamStep] {
        &self.steps
    }

    /// Returns the length from the tip to the clamp, mm.
    pub fn stick_out_mm(&self) -> f64 {
        self.steps.last().map_or(0.0, |step| step.to_mm)
    }

    /// Returns how far the beam bends at a height above the tip under a force of 1 N at another one, mm. The lower the force
    /// acts, the farther.
    pub fn deflection_mm_per_n(&self, at_mm: f64, force_at_mm: f64) -> f64 {
        let lowest = at_mm.max(force_at_mm);
        let (sum, product) = (at_mm + force_at_mm, at_mm * force_at_mm);
        let part = |step: &BeamStep| {
            let from = step.from_mm.max(lowest);
            if from >= step.to_mm {
                return 0.0;
            }
            let upto = |s: f64| s * (product + s * (s / 3.0 - sum / 2.0));
            (upto(step.to_mm) - upto(from)) / step.inertia_mm4()
        };
        self.steps.iter().map(part).sum::<f64>() / self.youngs_modulus_mpa
    }

    /// Returns the heights in mm at which the stress may be largest, the clamp among them, each with what the bending moment
    /// in N mm is divided by for the stress in MPa.
    pub fn stress_places(&self) -> impl Iterator<Item = [f64; 2]> {
        self.steps.iter().flat_map(|step| {
            let modulus = step.section_modulus_mm3();
            [[step.from_mm, modulus], [step.to_mm, modulus]].into_iter().filter(|[height, _]| *height > 0.0)
        })
    }

    /// Returns the largest bending stress in MPa above the height in mm up to which forces act.
    pub fn largest_stress_mpa(&self, forces: &BeamForces, highest_mm: f64) -> f64 {
        let at = |height: f64, modulus: f64| {
            let ([ahead, left], [about_left, about_ahead]) = (forces.force_n, forces.moment_n_mm);
            (ahead * height - about_left).hypot(left * height - about_ahead) / modulus
        };
        let of_step = |step: &BeamStep| {
            let modulus = step.section_modulus_mm3();
            let from = step.from_mm.max(highest_mm);
            if from > step.to_mm { 0.0 } else { at(from, modulus).max(at(step.to_mm, modulus)) }
        };
        self.steps.iter().map(of_step).fold(0.0, f64::max)
    }
}
