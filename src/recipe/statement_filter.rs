//! This module holds `where:` of steps that change statements or whole operations.

use super::motion_filter::{MotionFilter, default_required, deserialize_not_empty};
use super::parameters::{Glob, ToolPattern};
use schemars::JsonSchema;
use serde::Deserialize;

/// Which statements a step applies to. What is given must all fit; of a list, one has to. Kinds of motion and
/// feeds belong to motions, not to statements, so they cannot be asked for here.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StatementFilter {
    /// Names of operations. `*` and `?` are wildcards. Statements before the first operation belong to it.
    #[serde(default, deserialize_with = "deserialize_not_empty")]
    #[schemars(length(min = 1))]
    #[schemars(extend("x-default" = "all"))]
    pub operations: Option<Vec<Glob>>,
    /// Numbers or names of tools. The tool in force after the statement counts, so a LOAD/TOOL belongs to the
    /// tool that it loads.
    #[serde(default, deserialize_with = "deserialize_not_empty")]
    #[schemars(length(min = 1))]
    #[schemars(extend("x-default" = "all"))]
    pub tools: Option<Vec<ToolPattern>>,
    /// Whether it is an error if nothing in the program fits; `false` for recipes that serve programs of
    /// which some have nothing to select.
    #[serde(default = "default_required")]
    pub required: bool,
}

impl Default for StatementFilter {
    fn default() -> Self {
        Self { operations: None, tools: None, required: true }
    }
}

impl StatementFilter {
    /// Returns whether it selects everything.
    pub fn is_everything(&self) -> bool {
        self.operations.is_none() && self.tools.is_none()
    }
}

impl From<&StatementFilter> for MotionFilter {
    fn from(filter: &StatementFilter) -> Self {
        let StatementFilter { operations, tools, required } = filter.clone();
        Self { operations, tools, required, ..Self::default() }
    }
}

/// Which operations a step applies to; all of them when nothing is said. A part of an operation cannot move
/// on its own.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OperationFilter {
    /// Names of operations. `*` and `?` are wildcards.
    #[serde(default, deserialize_with = "deserialize_not_empty")]
    #[schemars(length(min = 1))]
    #[schemars(extend("x-default" = "all"))]
    pub operations: Option<Vec<Glob>>,
    /// Whether it is an error if nothing in the program fits; `false` for recipes that serve programs of
    /// which some have nothing to select.
    #[serde(default = "default_required")]
    pub required: bool,
}

impl Default for OperationFilter {
    fn default() -> Self {
        Self { operations: None, required: true }
    }
}

impl From<&OperationFilter> for MotionFilter {
    fn from(filter: &OperationFilter) -> Self {
        let OperationFilter { operations, required } = filter.clone();
        Self { operations, required, ..Self::default() }
    }
}
