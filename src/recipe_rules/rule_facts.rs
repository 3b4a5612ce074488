//! This module reads the facts of a program that rules refer to.

use crate::parse;
use crate::program::operation::{decode_text, find_operations};
use crate::program::{Program, Record, StatementField};
use std::fmt;

/// The number of names of each kind that a message lists.
const MOST_SHOWN: usize = 4;

/// The facts of a program that rules refer to. Names that are not UTF-8 are read as Latin-1. In the name of
/// the file, such bytes become `?`.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct RecipeRuleFacts {
    /// The name of the file, without its folder.
    pub file: String,
    /// Every `MACHIN/` record: its first field, and all its fields without blanks (`UNCX01` and `UNCX01,1`).
    pub machines: Vec<String>,
    /// Number and name of every tool that moves.
    pub tools: Vec<(Option<u32>, Option<String>)>,
    /// The names of all operations.
    pub operations: Vec<String>,
}

impl RecipeRuleFacts {
    /// Reads the facts of a program. `file` is the name of its file, without the folder.
    pub fn from_program(file: impl Into<String>, program: &Program) -> Self {
        let mut facts = Self { file: file.into(), ..Self::default() };
        for (_, statement) in program.live_statements() {
            if *statement.record() == Record::Known {
                facts.add_machine(program.statement_text(statement));
            }
        }
        for operation in find_operations(program) {
            if !operation.name.is_empty() && !facts.operations.contains(&operation.name) {
                facts.operations.push(operation.name);
            }
        }
        let mut last = None;
        for tool in program.motions().filter_map(|motion| motion.tool) {
            if last.as_ref().is_some_and(|last| std::sync::Arc::ptr_eq(last, &tool)) {
                continue;
            }
            let known = (tool.number, tool.name.clone());
            if !facts.tools.contains(&known) {
                facts.tools.push(known);
            }
            last = Some(tool);
        }
        facts
    }

    fn add_machine(&mut self, statement: &[u8]) {
        let syntax = parse::syntax(statement);
        if syntax.major_word() != "MACHIN" {
            return;
        }
        let field = |field: &StatementField| decode_text(syntax.bytes_at(&field.at).trim_ascii());
        let fields: Vec<String> = syntax.fields.iter().map(field).collect();
        for name in fields.first().cloned().into_iter().chain([fields.join(",")]) {
            if !name.is_empty() && !self.machines.contains(&name) {
                self.machines.push(name);
            }
        }
    }
}

impl fmt::Display for RecipeRuleFacts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let tools: Vec<String> = self
            .tools
            .iter()
            .map(|tool| match tool {
                (Some(number), Some(name)) => format!("{number} ({name})"),
                (Some(number), None) => number.to_string(),
                (None, Some(name)) => name.clone(),
                (None, None) => "without a name".to_owned(),
            })
            .collect();
        write!(f, "file {}", self.file)?;
        for (kind, names) in
            [("machine", &self.machines), ("tools", &tools), ("operations", &self.operations)]
        {
            let shown = names.get(..MOST_SHOWN.min(names.len())).unwrap_or_default().join(", ");
            let more = names.len().saturating_sub(MOST_SHOWN);
            match (names.len(), more) {
                (0, _) => write!(f, "; {kind}: not stated")?,
                (_, 0) => write!(f, "; {kind}: {shown}")?,
                _ => write!(f, "; {kind}: {shown} and {more} more")?,
            }
        }
        Ok(())
    }
}
