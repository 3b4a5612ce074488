//! This module holds the time of a program on its machine by its parts.

use crate::machine::ProgramTime;
use crate::report::text_format::{format_counted, format_duration, format_fixed};
use serde::Serialize;

/// The time of a program on its machine, in s.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MachineTimeParts {
    /// Everything together.
    pub seconds: f64,
    /// Lengths by feeds.
    pub at_feed: f64,
    /// What corners cost.
    pub corners: f64,
    /// What starting and stopping cost.
    pub start_stop: f64,
    /// What changes of the feed cost.
    pub feed_steps: f64,
    /// Rapids.
    pub rapids: f64,
    /// The number of tool changes.
    pub tool_changes: usize,
    /// Their time.
    pub tool_change: f64,
    /// How often the spindle starts.
    pub spindle_starts: usize,
    /// The time of that.
    pub spindle_start: f64,
    /// Dwells that the program states.
    pub dwell: f64,
}

impl MachineTimeParts {
    pub(in crate::report) fn from_time(time: &ProgramTime) -> Self {
        Self {
            seconds: time.total(),
            at_feed: time.feed.feed,
            corners: time.feed.corners,
            start_stop: time.feed.start_stop,
            feed_steps: time.feed.feed_steps,
            rapids: time.rapid,
            tool_changes: time.tool_changes,
            tool_change: time.tool_change,
            spindle_starts: time.spindle_starts,
            spindle_start: time.spindle_start,
            dwell: time.dwell,
        }
    }

    /// Returns the parts in a sentence; those that take no time are left out.
    pub(in crate::report) fn to_sentence(self) -> String {
        let parts = [
            (self.at_feed, "at feed".to_owned()),
            (self.corners, "at corners".to_owned()),
            (self.start_stop, "starting and stopping".to_owned()),
            (self.feed_steps, "changing feeds".to_owned()),
            (self.rapids, "at rapid".to_owned()),
            (
                self.tool_change,
                format!("for {}", format_counted(self.tool_changes, "tool change", "tool changes")),
            ),
            (
                self.spindle_start,
                format!("for {}", format_counted(self.spindle_starts, "spindle start", "spindle starts")),
            ),
            (self.dwell, "dwelling".to_owned()),
        ];
        let told = parts.into_iter().filter(|(seconds, _)| *seconds > 0.0);
        let told: Vec<String> =
            told.map(|(seconds, what)| format!("{} s {what}", format_fixed(seconds, 1))).collect();
        let parts = if told.is_empty() { String::new() } else { format!(": {}", told.join(", ")) };
        format!("time on the machine {}{parts}", format_duration(self.seconds))
    }
}
