//! This module collects the earlier steps that are near the cutter of a search.

use super::step_search::StepSearch;
use std::rc::Rc;

/// The steps near the whole cutter, in lists of those that reach below some heights. The last one has no
/// limit. Lists are made when they are needed.
pub(super) struct NearSteps {
    pub caps: [f64; 4],
    pub lists: [Option<Rc<[u32]>>; 4],
}

impl StepSearch<'_> {
    /// Returns the steps that may touch what of the cutter is below a height.
    pub(super) fn near_steps(&mut self, highest: f64) -> Rc<[u32]> {
        let NearSteps { caps, lists } = &mut self.near_steps;
        let pairs = caps.iter().zip(lists.iter_mut());
        let found = pairs.filter(|(cap, _)| **cap > highest).map(|(cap, list)| (*cap, list)).next();
        let Some((cap, list)) = found else { return Rc::from([]) };
        if let Some(known) = list {
            return known.clone();
        }
        let mut bounds = self.step.bounds(self.contour, self.program.stock_top());
        bounds[1].z = bounds[1].z.min(cap);
        let mut found = Vec::new();
        self.program.find_steps(&bounds, [self.before, self.own_first], &mut found);
        let found: Rc<[u32]> = found.into();
        *list = Some(found.clone());
        found
    }

    /// Returns the steps that may touch any of the cutter.
    pub(super) fn all_near_steps(&mut self) -> Rc<[u32]> {
        self.near_steps(f64::MAX)
    }
}
