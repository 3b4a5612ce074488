//! Which operations a move applies to.

use crate::diagnostic::codes;
use crate::parameters::Glob;
use crate::program::{Program, StatementId, StatementRange, operation};
use crate::recipe::deserialize_not_empty;
use crate::transform::StepContext;
use schemars::JsonSchema;
use serde::Deserialize;

/// Which operations a step applies to; all of them when nothing is said. A part of an operation cannot move on its own.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MoveScopeSpec {
    /// Names of operations; `*` and `?` are wildcards.
    #[serde(default, deserialize_with = "deserialize_not_empty")]
    #[schemars(length(min = 1))]
    pub operations: Option<Vec<Glob>>,
}

/// The statements of the selected operations.
#[derive(Debug)]
pub struct OperationScope {
    /// In order; `None` is everything.
    chosen: Option<Vec<StatementRange>>,
}

impl OperationScope {
    /// The scope in a program, with a warning when it selects nothing.
    pub fn select_operations(
        wanted: &MoveScopeSpec,
        program: &Program,
        context: &mut StepContext<'_>,
    ) -> Self {
        let Some(names) = &wanted.operations else { return Self { chosen: None } };
        let chosen: Vec<_> = operation::find_operations(program)
            .into_iter()
            .filter(|operation| names.iter().any(|glob| glob.matches_name(&operation.name)))
            .collect();
        if chosen.is_empty() {
            let message = "`where` selects no operation of this program";
            let finding =
                context.step_finding(codes::NOTHING_SELECTED, message, &["where"], "selects nothing");
            context.findings.push(finding);
        }
        Self { chosen: Some(chosen.into_iter().filter_map(|operation| operation.statements).collect()) }
    }

    /// Whether a statement belongs to a selected operation.
    pub fn contains(&self, statement: StatementId) -> bool {
        let Some(chosen) = &self.chosen else { return true };
        let after = chosen.partition_point(|operation| operation.last() < statement);
        chosen.get(after).is_some_and(|operation| operation.contains(statement))
    }

    /// Whether nothing at all is selected.
    pub fn is_empty(&self) -> bool {
        self.chosen.as_ref().is_some_and(Vec::is_empty)
    }
}
