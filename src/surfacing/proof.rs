//! The finished passes looked at with other means than those that made them: how deep they go, how far off they stay.

use super::planes::Planes;
use super::track::{Print, Track};
use crate::surface::drop::Space;
use crate::surface::profile::{Chain, check};
use rayon::prelude::*;

/// Between the places looked at, distances may be off by this share of the tolerance.
const SHARE: f64 = 0.05;

/// Samples of a pass at most: a bound on time where the tolerance is very fine.
const MOST_SAMPLES: f64 = 2e6;

/// How far the passes of a program are from the part. All in mm.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Proof {
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

impl Proof {
    /// The worse of both, each for itself.
    fn worse(self, other: Self) -> Self {
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
    pub fn holds(&self, tolerance: f64) -> bool {
        self.gouge + self.bound <= tolerance && self.gap <= tolerance
    }
}

/// What a pass is compared with.
pub(super) struct Pass<'a> {
    pub offset: f64,
    pub track: &'a Track,
    pub ground: Option<&'a Chain>,
}

/// How to look.
pub(super) struct Look<'a> {
    pub planes: &'a Planes,
    pub radius: f64,
    pub tolerance: f64,
    pub print: Print,
    pub space: Option<&'a Space>,
}

impl Look<'_> {
    /// The worst of all passes.
    pub fn over(&self, passes: &[Pass<'_>]) -> Proof {
        let all: Vec<Proof> = passes.par_iter().map(|pass| self.one(pass)).collect();
        all.into_iter().fold(Proof::default(), Proof::worse)
    }

    fn one(&self, pass: &Pass<'_>) -> Proof {
        let in_plane = pass.ground.and_then(|ground| self.in_plane(pass, ground));
        let in_space = self.space.and_then(|space| self.in_space(pass, space));
        [in_plane, in_space].into_iter().flatten().fold(Proof::default(), Proof::worse)
    }

    /// Against the line in the plane, by [`check`].
    fn in_plane(&self, pass: &Pass<'_>, ground: &Chain) -> Option<Proof> {
        let tip = pass.track.flat(self.planes, self.print)?;
        let wanted = SHARE * self.tolerance;
        let least = (tip.length() + ground.length()) / MOST_SAMPLES;
        // As fine as two balls of this radius would need; curvatures of the part may ask for more.
        let mut step = (4.0 * self.radius * wanted).sqrt().min(self.radius / 4.0).max(least);
        let mut verdict = check(ground, &tip, self.radius, step);
        if verdict.bound > wanted && step > least {
            step = (step * (wanted / verdict.bound).sqrt()).max(least);
            verdict = check(ground, &tip, self.radius, step);
        }
        let space = |at: crate::surface::profile::Point| self.planes.point(pass.offset, at.u, at.z);
        Some(Proof {
            gouge: verdict.gouge,
            gouge_at: space(verdict.gouge_at),
            gap: verdict.gap,
            gap_at: space(verdict.gap_at),
            bound: verdict.bound,
        })
    }

    /// Against the mesh, by [`Space::along`].
    fn in_space(&self, pass: &Pass<'_>, space: &Space) -> Option<Proof> {
        let bound = SHARE * self.tolerance / 2.0;
        // Arcs in chords are looked at as far off them as that.
        let points = pass.track.points(self.planes, self.print, pass.offset, bound);
        let found = space.along(&points, (8.0 * self.radius * bound).sqrt())?;
        Some(Proof {
            gouge: (-found.low).max(0.0),
            gouge_at: found.low_at,
            gap: found.high.max(0.0),
            gap_at: found.high_at,
            bound: 2.0 * bound,
        })
    }
}
