//! This module proves the finished passes by an independent method: it measures how deep they go into the
//! part and how far they stay from it.

use super::pass_planes::PassPlanes;
use super::pass_track::{PassTrack, ProgramRounding};
use super::watched_planes::WatchedPlanes;
use crate::diagnostic::Failure;
use crate::surface::drop_cutter::BallClearanceField;
use crate::surface::profile::{Chain, check_tip_path};
use rayon::prelude::*;

/// The fraction of the tolerance by which distances may be off between samples.
const SHARE: f64 = 0.05;

/// The most samples of a pass, which bounds the time if the tolerance is very fine.
const MOST_SAMPLES: f64 = 2e6;

/// The distances of a program's passes from the part, all in mm.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct SurfaceProof {
    /// The largest depth of the ball in the part; 0 if it never enters it.
    pub gouge_mm: f64,
    /// The tip at which this is so.
    pub gouge_at_mm: [f64; 3],
    /// The largest distance of the ball from touching the part.
    pub gap_mm: f64,
    /// The tip at which this is so.
    pub gap_at_mm: [f64; 3],
    /// By how much the depth may be larger between samples.
    pub bound_mm: f64,
}

impl SurfaceProof {
    /// Returns the worse gouge and the worse gap of two proofs.
    fn worse_of(self, other: Self) -> Self {
        let mut worse = self;
        if other.gouge_mm > worse.gouge_mm {
            (worse.gouge_mm, worse.gouge_at_mm) = (other.gouge_mm, other.gouge_at_mm);
        }
        if other.gap_mm > worse.gap_mm {
            (worse.gap_mm, worse.gap_at_mm) = (other.gap_mm, other.gap_at_mm);
        }
        worse.bound_mm = worse.bound_mm.max(other.bound_mm);
        worse
    }

    /// Returns whether gouge and gap are within a tolerance, including what the samples may miss.
    pub fn is_within(&self, tolerance_mm: f64) -> bool {
        self.gouge_mm + self.bound_mm <= tolerance_mm && self.gap_mm <= tolerance_mm
    }
}

/// A pass and the line that it is compared with.
pub(super) struct ProvedPass<'a> {
    pub offset_mm: f64,
    pub track: &'a PassTrack,
    pub ground: Option<&'a Chain>,
}

/// The data for proving passes.
pub(super) struct PassProver<'a> {
    pub planes: &'a PassPlanes,
    pub radius_mm: f64,
    pub tolerance_mm: f64,
    pub print: ProgramRounding,
    pub space: Option<&'a BallClearanceField>,
}

impl PassProver<'_> {
    /// Returns the worst values of all passes.
    ///
    /// # Errors
    /// Returns what stops the work.
    pub(super) fn prove_all(
        &self,
        passes: &[ProvedPass<'_>],
        work: &WatchedPlanes<'_>,
    ) -> Result<SurfaceProof, Failure> {
        let proved = passes.par_iter().map(|pass| {
            work.check()?;
            Ok(self.prove_pass(pass))
        });
        let all: Vec<SurfaceProof> = proved.collect::<Result<_, Failure>>()?;
        Ok(all.into_iter().fold(SurfaceProof::default(), SurfaceProof::worse_of))
    }

    fn prove_pass(&self, pass: &ProvedPass<'_>) -> SurfaceProof {
        let in_plane = pass.ground.and_then(|ground| self.prove_in_plane(pass, ground));
        let in_space = self.space.and_then(|space| self.prove_in_space(pass, space));
        [in_plane, in_space].into_iter().flatten().fold(SurfaceProof::default(), SurfaceProof::worse_of)
    }

    /// Compares a pass with the line in its plane, by [`check_tip_path`].
    fn prove_in_plane(&self, pass: &ProvedPass<'_>, ground: &Chain) -> Option<SurfaceProof> {
        let tip = pass.track.to_plane_chain(self.planes, self.print)?;
        let wanted = SHARE * self.tolerance_mm;
        let least = (tip.length_mm() + ground.length_mm()) / MOST_SAMPLES;
        // The first step is that of two balls of this radius, 2 step^2 / (8 R) = wanted; curvatures of the
        // part may need a finer one.
        let mut step = (4.0 * self.radius_mm * wanted).sqrt().min(self.radius_mm / 4.0).max(least);
        let mut verdict = check_tip_path(ground, &tip, self.radius_mm, step);
        if verdict.bound_mm > wanted && step > least {
            step = (step * (wanted / verdict.bound_mm).sqrt()).max(least);
            verdict = check_tip_path(ground, &tip, self.radius_mm, step);
        }
        let space = |at: crate::surface::profile::Point| self.planes.point_at(pass.offset_mm, at.u, at.z);
        Some(SurfaceProof {
            gouge_mm: verdict.gouge_mm,
            gouge_at_mm: space(verdict.gouge_at),
            gap_mm: verdict.gap_mm,
            gap_at_mm: space(verdict.gap_at),
            bound_mm: verdict.bound_mm,
        })
    }

    /// Compares a pass with the mesh in space, by [`BallClearanceField::measure_clearance`].
    fn prove_in_space(&self, pass: &ProvedPass<'_>, space: &BallClearanceField) -> Option<SurfaceProof> {
        let bound = SHARE * self.tolerance_mm / 2.0;
        // Half of the error is for the chords of arcs, the other half for the distance of samples, step^2 /
        // (8 R).
        let points = pass.track.sample_points(self.planes, self.print, pass.offset_mm, bound);
        let found = space.measure_clearance(&points, (8.0 * self.radius_mm * bound).sqrt())?;
        Some(SurfaceProof {
            gouge_mm: (-found.low_mm).max(0.0),
            gouge_at_mm: found.low_at_mm,
            gap_mm: found.high_mm.max(0.0),
            gap_at_mm: found.high_at_mm,
            bound_mm: 2.0 * bound,
        })
    }
}
