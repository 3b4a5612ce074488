//! The time at feed of a program or a part of it, so that every output tells the same.

use super::path_time::{TimedSegment, path_time_s};
use crate::program::motion::{ActiveTool, Motion};
use crate::program::{Program, StatementId};
use crate::transform::optimize_feed::measure::has_machine_stop;
use std::sync::Arc;

/// Adds motions up to their time at feed with the machine's acceleration. Where the acceleration is not known it
/// keeps nothing and knows no time.
#[derive(Debug, Clone)]
pub(crate) struct PathTimer {
    acceleration: Option<f64>,
    path: Vec<TimedSegment>,
    /// The last statement and the tool of the motion at feed before, unless a rapid came after it.
    before: Option<(StatementId, Option<Arc<ActiveTool>>)>,
}

impl PathTimer {
    /// Begins with nothing. `acceleration` is how fast feeds may change, (mm/min)/s.
    pub(crate) fn new(acceleration: Option<f64>) -> Self {
        Self { acceleration, path: Vec::new(), before: None }
    }

    /// Adds a motion with its length in mm and its feed in mm/min where that is known. Rapids, tool changes and
    /// stops end chains of motions at feed.
    pub(crate) fn add_motion(&mut self, program: &Program, motion: &Motion, length: f64, feed: Option<f64>) {
        if self.acceleration.is_none() {
            return;
        }
        if motion.rapid {
            self.before = None;
            return;
        }
        let Some(feed) = feed else { return };
        let last = motion.last_statement();
        let goes_on = self.before.as_ref().is_some_and(|(before, tool)| {
            is_same_tool(tool.as_ref(), motion.tool.as_ref()) && !has_machine_stop(program, *before, last)
        });
        self.path.push(TimedSegment { length, feed, breaks_chain: !goes_on });
        self.before = Some((last, motion.tool.clone()));
    }

    /// Returns the time in seconds; `None` where the acceleration is not known.
    pub(crate) fn seconds(&self) -> Option<f64> {
        self.acceleration.map(|acceleration| path_time_s(&self.path, Some(acceleration)))
    }
}

fn is_same_tool(one: Option<&Arc<ActiveTool>>, other: Option<&Arc<ActiveTool>>) -> bool {
    match (one, other) {
        (Some(a), Some(b)) => Arc::ptr_eq(a, b) || (a.number, &a.name) == (b.number, &b.name),
        (None, None) => true,
        _ => false,
    }
}
