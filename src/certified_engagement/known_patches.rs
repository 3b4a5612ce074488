//! This module keeps the patches into which a search has divided the cutter's surface, for the next block: near places of
//! a program are divided alike. So most patches are dropped at the first test.

use super::surface_patch::SurfacePatch;

/// After so many searches the surface is divided anew, since halves are never joined again.
const MOST_USES: usize = 24;

/// A patch of which a search needed no more: nothing of it was above the threshold, or all of it was covered.
#[derive(Debug, Clone)]
struct KnownPatch {
    element: usize,
    range: [f64; 2],
    /// The directions, counted from the heading.
    from_heading: [f64; 2],
    times: [f64; 2],
}

/// The patches of a search, which together are the whole surface at all times.
#[derive(Debug, Clone, Default)]
pub(super) struct KnownPatches {
    cutter: usize,
    /// Up to which height the surface was divided, mm.
    farthest: f64,
    patches: Vec<KnownPatch>,
    /// How many patches the search examined that divided the surface from its beginning.
    searched: usize,
    uses: usize,
}

impl KnownPatches {
    /// Notes a patch that is done with.
    pub(super) fn add(&mut self, patch: &SurfacePatch, heading: f64) {
        self.patches.push(KnownPatch {
            element: patch.element,
            range: patch.range,
            from_heading: patch.angles.map(|angle| angle - heading),
            times: patch.times,
        });
    }

    /// Starts the list of a search from what the search before has left. Returns the patches that it begins with; `None`
    /// if the surface is to be divided anew.
    pub(super) fn take_patches(
        &mut self,
        cutter: usize,
        farthest: f64,
        heading: f64,
    ) -> Option<Vec<SurfacePatch>> {
        let is_known = self.cutter == cutter
            && self.farthest == farthest
            && self.uses < MOST_USES
            && !self.patches.is_empty();
        let known = std::mem::take(&mut self.patches);
        if !is_known {
            *self = Self { cutter, farthest, ..Self::default() };
            return None;
        }
        self.uses += 1;
        let patch = |known: KnownPatch| SurfacePatch {
            element: known.element,
            range: known.range,
            angles: known.from_heading.map(|angle| angle + heading),
            depths: [0.0, f64::INFINITY],
            times: known.times,
            need: known.times,
            upper: f64::INFINITY,
            candidates: None,
        };
        Some(known.into_iter().map(patch).collect())
    }

    /// Notes how many patches a search has examined. One that needed more than a search from the beginning is not gone on
    /// from.
    pub(super) fn finish(&mut self, examined: usize, is_complete: bool) {
        if self.uses == 0 {
            self.searched = examined;
        }
        if !is_complete || examined > self.searched {
            self.patches.clear();
        }
    }
}
