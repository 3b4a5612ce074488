//! `where:` for statements: the operations and tools they stand under.

use crate::parameters::{Glob, ToolPattern};
use crate::program::motion::Motions;
use crate::program::operation::{self, Operation};
use crate::program::{Program, StatementId};
use schemars::JsonSchema;
use serde::Deserialize;

/// Where in the program a rule applies. What is given must all fit; of a list, one has to. Kinds of motion and feeds belong to
/// motions, not to statements, so they cannot be asked for here; a feed is asked for by `if`.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RewriteRegionSpec {
    /// Names of operations; `*` and `?` are wildcards. What stands before the first operation belongs to it.
    #[serde(default, deserialize_with = "crate::recipe::deserialize_not_empty")]
    #[schemars(length(min = 1))]
    operations: Option<Vec<Glob>>,
    /// Numbers or names of tools: the tool in force behind the statement, so a LOAD/TOOL belongs to the tool that it loads.
    #[serde(default, deserialize_with = "crate::recipe::deserialize_not_empty")]
    #[schemars(length(min = 1))]
    tools: Option<Vec<ToolPattern>>,
}

impl RewriteRegionSpec {
    /// Whether it leaves anything out.
    pub(super) fn is_everything(&self) -> bool {
        self.operations.is_none() && self.tools.is_none()
    }

    /// The region in a program, to be asked for statements in their order.
    pub(super) fn start_cursor<'p>(&'p self, program: &'p Program) -> RewriteRegionCursor<'p> {
        let operations = match self.operations {
            Some(_) => operation::find_operations(program),
            None => Vec::new(),
        };
        RewriteRegionCursor { region: self, operations, operation: 0, motions: program.motions(), read: None }
    }
}

/// A region on its way through a program.
pub(super) struct RewriteRegionCursor<'p> {
    region: &'p RewriteRegionSpec,
    operations: Vec<Operation>,
    operation: usize,
    motions: Motions<'p>,
    /// The last statement that the motions have read.
    read: Option<StatementId>,
}

impl RewriteRegionCursor<'_> {
    /// Whether a statement stands in the region. Statements are asked for in order, each at most once.
    pub fn contains(&mut self, id: StatementId) -> bool {
        self.is_in_operations(id) && self.is_under_tools(id)
    }

    fn is_in_operations(&mut self, id: StatementId) -> bool {
        let Some(wanted) = &self.region.operations else { return true };
        while self.operations.get(self.operation).is_some_and(|operation| ends_before(operation, id)) {
            self.operation += 1;
        }
        let name = self.operations.get(self.operation).map(|operation| operation.name.as_str());
        name.is_some_and(|name| wanted.iter().any(|glob| glob.matches_name(name)))
    }

    fn is_under_tools(&mut self, id: StatementId) -> bool {
        let Some(wanted) = &self.region.tools else { return true };
        while self.read.is_none_or(|read| read < id) {
            let Some(read) = self.motions.read_statement() else { break };
            self.read = Some(read);
        }
        let Some(tool) = self.motions.state().tool.as_deref() else { return false };
        wanted.iter().any(|pattern| pattern.matches_tool(tool.number, tool.name.as_deref()))
    }
}

fn ends_before(operation: &Operation, id: StatementId) -> bool {
    operation.statements.is_none_or(|statements| statements.last() < id)
}
