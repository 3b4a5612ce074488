//! This module remembers which feed was in force before a step, for the comment about a FEDRAT that the step
//! has inserted.

use crate::parse;
use crate::program::{NumberRole, Program, Record, Statement, StatementChange, StepId};

/// The last feed of the program so far, as it was before each step.
pub(super) struct FeedsBeforeSteps {
    before: Vec<Option<String>>,
}

impl FeedsBeforeSteps {
    pub(super) fn new(steps: usize) -> Self {
        Self { before: vec![None; steps] }
    }

    /// Returns the feed that was in force here before a step.
    pub(super) fn feed_before_step(&self, step: StepId) -> Option<&str> {
        self.before.get(usize::from(step.0))?.as_deref()
    }

    /// Notes the feed of a statement.
    pub(super) fn pass_statement(&mut self, program: &Program, statement: &Statement) {
        if !matches!(statement.record(), Record::Feed(_)) {
            return;
        }
        let edits = program.edits_of_statement(statement);
        for (step, before) in self.before.iter_mut().enumerate() {
            let earlier =
                edits.iter().rev().find(|edit| usize::from(edit.by.0) < step).map(|edit| edit.after);
            let text = match (statement.change(), earlier) {
                (StatementChange::Deleted(by), _) if usize::from(by.0) < step => None,
                (_, Some(earlier)) => Some(earlier),
                (StatementChange::Untouched, None) => Some(program.statement_text(statement)),
                (_, None) => Some(program.source().slice(statement.origin())).filter(|text| !text.is_empty()),
            };
            if let Some(feed) = text.and_then(|text| printed_feed(statement.record(), text)) {
                *before = Some(feed);
            }
        }
    }
}

/// Returns the feed of a FEDRAT as it is printed.
pub(super) fn printed_feed(record: &Record, text: &[u8]) -> Option<String> {
    let roles = parse::number_roles(record, text);
    let mut numbers = parse::statement_numbers(text).into_iter().zip(roles);
    let ((at, _), _) = numbers.find(|(_, role)| *role == NumberRole::Feed)?;
    text.get(at).map(|number| String::from_utf8_lossy(number).into_owned())
}
