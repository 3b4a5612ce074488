//! This module proves the finished passes by an independent method: it measures how deep they go into the
//! part and how far they stay from it.

use super::pass_planes::PassPlanes;
use super::pass_track::{PassTrack, ProgramRounding};
use crate::surface::drop_cutter::BallClearanceField;
use crate::surface::profile::{Chain, check_tip_path};
use rayon::prelude::*;

/// The fraction of the tolerance by which distances may be off between samples.
const SHARE: f64 = 0.05;

/// The most samples of a pass, which bounds the time if the tolerance is very fine.
const MOST_SAMPLES: f64 = 2e6;

/// The distances of a program's passes from the part, all in mm.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SurfaceProof {
    /// The largest depth of the ball in the part; 0 if it never enters it.
    pub gouge: f64,
    /// The tip at which this is so.
    pub gouge_at: [f64; 3],
    /// The largest distance of the ball from touching the part.
    pub gap: f64,
    /// The tip at which this is so.
    pub gap_at: [f64; 3],
    /// By how much the depth may be larger between samples.
    pub bound: f64,
}

impl SurfaceProof {
    /// Returns the worse gouge and the worse gap of two proofs.
    fn worse_of(self, other: Self) -> Self {
        let mut worse = self;
        if other.gouge > worse.gouge {
            (worse.gouge, worse.gouge_at) = (other.gouge, other.gouge_at);
        }
        if other.gap > worse.gap {
            (worse.gap, worse.gap_at) = (other.gap, other.gap_at);
        }
        worse.bound = worse.bound.max(other.bound);
        worse
    }

    /// Returns whether gouge and gap are within a tolerance, including what the samples may miss.
    pub fn is_within(&self, tolerance: f64) -> bool {
        self.gouge + self.bound <= tolerance && self.gap <= tolerance
    }
}

/// A pass and the line that it is compared with.
pub(super) struct ProvedPass<'a> {
    pub offset: f64,
    pub track: &'a PassTrack,
    pub ground: Option<&'a Chain>,
}

/// The data for proving passes.
pub(super) struct PassProver<'a> {
    pub planes: &'a PassPlanes,
    pub radius: f64,
    pub tolerance: f64,
    pub print: ProgramRounding,
    pub space: Option<&'a BallClearanceField>,
}

impl PassProver<'_> {
    /// Returns the worst values of all passes.
    pub fn prove_all(&self, passes: &[ProvedPass<'_>]) -> SurfaceProof {
        let all: Vec<SurfaceProof> = passes.par_iter().map(|pass| self.prove_pass(pass)).collect();
        all.into_iter().fold(SurfaceProof::default(), SurfaceProof::worse_of)
    }

    fn prove_pass(&self, pass: &ProvedPass<'_>) -> SurfaceProof {
        let in_plane = pass.ground.and_then(|ground| self.prove_in_plane(pass, ground));
        let in_space = self.space.and_then(|space| self.prove_in_space(pass, space));
        [in_plane, in_space].into_iter().flatten().fold(SurfaceProof::default(), SurfaceProof::worse_of)
    }

    /// Compares a pass with the line in its plane, by [`check_tip_path`].
    fn prove_in_plane(&self, pass: &ProvedPass<'_>, ground: &Chain) -> Option<SurfaceProof> {
        let tip = pass.track.to_plane_chain(self.planes, self.print)?;
        let wanted = SHARE * self.tolerance;
        let least = (tip.length_mm() + ground.length_mm()) / MOST_SAMPLES;
        // The first step is that of two balls of this radius, 2 step^2 / (8 R) = wanted; curvatures of the
        // part may need a finer one.
        let mut step = (4.0 * self.radius * wanted).sqrt().min(self.radius / 4.0).max(least);
        let mut verdict = check_tip_path(ground, &tip, self.radius, step);
        if verdict.bound > wanted && step > least {
            step = (step * (wanted / verdict.bound).sqrt()).max(least);
            verdict = check_tip_path(ground, &tip, self.radius, step);
        }
        let space = |at: crate::surface::profile::Point| self.planes.point_at(pass.offset, at.u, at.z);
        Some(SurfaceProof {
            gouge: verdict.gouge,
            gouge_at: space(verdict.gouge_at),
            gap: verdict.gap,
            gap_at: space(verdict.gap_at),
            bound: verdict.bound,
        })
    }

    /// Compares a pass with the mesh in space, by [`BallClearanceField::measure_clearance`].
    fn prove_in_space(&self, pass: &ProvedPass<'_>, space: &BallClearanceField) -> Option<SurfaceProof> {
        let bound = SHARE * self.tolerance / 2.0;
        // Half of the error is for the chords of arcs, the other half for the distance of samples, step^2 /
        // (8 R).
        let points = pass.track.sample_points(self.planes, self.print, pass.offset, bound);
        let found = space.measure_clearance(&points, (8.0 * self.radius * bound).sqrt())?;
        Some(SurfaceProof {
            gouge: (-found.low).max(0.0),
            gouge_at: found.low_at,
            gap: found.high.max(0.0),
            gap_at: found.high_at,
            bound: 2.0 * bound,
        })
    }
}
