//! The finished passes looked at with other means than those that made them: how deep they go, how far off they stay.

use super::pass_planes::PassPlanes;
use super::pass_track::{PassTrack, ProgramRounding};
use crate::surface::drop_cutter::BallClearanceField;
use crate::surface::profile::{Chain, check_tip_path};
use rayon::prelude::*;

/// Between the places looked at, distances may be off by this share of the tolerance.
const SHARE: f64 = 0.05;

/// Samples of a pass at most: a bound on time where the tolerance is very fine.
const MOST_SAMPLES: f64 = 2e6;

/// How far the passes of a program are from the part. All in mm.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SurfaceProof {
    /// How deep the ball goes into the part at most; 0 when it never does.
    pub gouge: f64,
    /// The tip where that is.
    pub gouge_at: [f64; 3],
    /// How far the ball is from touching the part at most.
    pub gap: f64,
    /// The tip where that is.
    pub gap_at: [f64; 3],
    /// How much deeper it may be between the places that were looked at.
    pub bound: f64,
}

impl SurfaceProof {
    /// The worse of both, each for itself.
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

    /// Whether both are within a tolerance, what the check may miss included.
    pub fn is_within(&self, tolerance: f64) -> bool {
        self.gouge + self.bound <= tolerance && self.gap <= tolerance
    }
}

/// What a pass is compared with.
pub(super) struct ProvedPass<'a> {
    pub offset: f64,
    pub track: &'a PassTrack,
    pub ground: Option<&'a Chain>,
}

/// How to look.
pub(super) struct PassProver<'a> {
    pub planes: &'a PassPlanes,
    pub radius: f64,
    pub tolerance: f64,
    pub print: ProgramRounding,
    pub space: Option<&'a BallClearanceField>,
}

impl PassProver<'_> {
    /// The worst of all passes.
    pub fn prove_all(&self, passes: &[ProvedPass<'_>]) -> SurfaceProof {
        let all: Vec<SurfaceProof> = passes.par_iter().map(|pass| self.prove_pass(pass)).collect();
        all.into_iter().fold(SurfaceProof::default(), SurfaceProof::worse_of)
    }

    fn prove_pass(&self, pass: &ProvedPass<'_>) -> SurfaceProof {
        let in_plane = pass.ground.and_then(|ground| self.prove_in_plane(pass, ground));
        let in_space = self.space.and_then(|space| self.prove_in_space(pass, space));
        [in_plane, in_space].into_iter().flatten().fold(SurfaceProof::default(), SurfaceProof::worse_of)
    }

    /// Against the line in the plane, by [`check_tip_path`].
    fn prove_in_plane(&self, pass: &ProvedPass<'_>, ground: &Chain) -> Option<SurfaceProof> {
        let tip = pass.track.to_plane_chain(self.planes, self.print)?;
        let wanted = SHARE * self.tolerance;
        let least = (tip.length_mm() + ground.length_mm()) / MOST_SAMPLES;
        // As fine as two balls of this radius would need; curvatures of the part may ask for more.
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

    /// Against the mesh, by [`BallClearanceField::measure_clearance`].
    fn prove_in_space(&self, pass: &ProvedPass<'_>, space: &BallClearanceField) -> Option<SurfaceProof> {
        let bound = SHARE * self.tolerance / 2.0;
        // Arcs in chords are looked at as far off them as that.
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
