//! `where:` applied to the motions of one program.

use super::Context;
use crate::diagnostic::codes;
use crate::program::motion::Motion;
use crate::program::{LengthUnit, Program, operation};
use crate::recipe::{Facts, Where};

/// Decides motion by motion whether a step means it.
#[derive(Debug)]
pub struct Selection<'w> {
    wanted: &'w Where,
    everything: bool,
    operations: Vec<String>,
    file: LengthUnit,
    selected: usize,
}

impl<'w> Selection<'w> {
    /// The selection of a step in a program.
    pub fn new(wanted: &'w Where, program: &Program, context: &Context<'_>) -> Self {
        let everything = *wanted == Where::default();
        let operations = operation::operations(program).into_iter().map(|operation| operation.name).collect();
        Self { wanted, everything, operations, file: context.file_units(program), selected: 0 }
    }

    /// Whether the step has no `where` at all.
    pub fn is_everything(&self) -> bool {
        self.everything
    }

    /// Whether a motion is meant.
    pub fn contains(&mut self, motion: &Motion, context: &Context<'_>) -> bool {
        let selected = self.everything || self.wanted.matches(&self.facts(motion, context));
        self.selected += usize::from(selected);
        selected
    }

    /// A warning when nothing was meant.
    pub fn report(&self, context: &mut Context<'_>) {
        if self.selected == 0 && !self.everything {
            let message = "`where` selects no motion of this program";
            let finding = context.at(codes::NOTHING_SELECTED, message, &["where"], "selects nothing");
            context.findings.push(finding);
        }
    }

    fn facts<'a>(&'a self, motion: &'a Motion, context: &Context<'_>) -> Facts<'a> {
        let tool = motion.tool.as_deref();
        let feed = if motion.rapid { None } else { context.feed_per_minute(motion, self.file) };
        Facts {
            operation: self.operations.get(motion.operation).map(String::as_str),
            tool_number: tool.and_then(|tool| tool.number),
            tool_name: tool.and_then(|tool| tool.name.as_deref()),
            motion: Some(motion.class),
            feed,
        }
    }
}
