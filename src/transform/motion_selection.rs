//! This module applies `where:` to the motions of a program.

use super::StepContext;
use super::empty_selection::report_nothing_selected;
use crate::program::motion::Motion;
use crate::program::{LengthUnit, Program, operation};
use crate::recipe::{MotionFacts, MotionFilter};

/// Decides for each motion whether a step means it.
#[derive(Debug)]
pub struct MotionSelection<'w> {
    wanted: &'w MotionFilter,
    everything: bool,
    operations: Vec<String>,
    file: LengthUnit,
    selected: usize,
}

impl<'w> MotionSelection<'w> {
    /// Prepares the selection of a step in a program.
    pub fn new(wanted: &'w MotionFilter, program: &Program, context: &StepContext<'_>) -> Self {
        let everything = wanted.is_everything();
        let operations =
            operation::find_operations(program).into_iter().map(|operation| operation.name).collect();
        Self { wanted, everything, operations, file: context.file_length_unit(program), selected: 0 }
    }

    /// Returns whether the step has no `where`.
    pub fn is_everything(&self) -> bool {
        self.everything
    }

    /// Returns whether the step means a motion.
    pub fn contains(&mut self, motion: &Motion, context: &StepContext<'_>) -> bool {
        let selected = self.everything || self.wanted.matches_motion(&self.motion_facts(motion, context));
        self.selected += usize::from(selected);
        selected
    }

    /// Reports a warning if no motion of the program was meant.
    pub fn report_if_empty(&self, program: &Program, context: &mut StepContext<'_>) {
        if self.selected == 0 && !self.everything {
            report_nothing_selected("motion", self.wanted, program, context);
        }
    }

    fn motion_facts<'a>(&'a self, motion: &'a Motion, context: &StepContext<'_>) -> MotionFacts<'a> {
        let tool = motion.tool.as_deref();
        let feed = if motion.rapid { None } else { context.feed_per_minute(motion, self.file) };
        MotionFacts {
            operation: self.operations.get(motion.operation).map(String::as_str),
            tool_number: tool.and_then(|tool| tool.number),
            tool_name: tool.and_then(|tool| tool.name.as_deref()),
            motion: Some(motion.class),
            feed,
            cuts_thread: motion.cuts_thread,
        }
    }
}
