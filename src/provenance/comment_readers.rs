//! This module reads comments of earlier runs: which steps changed a record, and of which recipe.

use super::change_wording;
use super::comment_format::comment_prefix;
use super::comment_places::CommentPlaces;
use crate::program::{Program, ProvenanceComment, Statement, StatementId};

/// Returns the names of the steps that comments of earlier runs tell about a statement, the earliest first. For such a
/// comment itself, it is the step that it tells of. It is empty if no comment tells of the statement.
///
/// ```
/// use clsmith::parse::parse;
/// use clsmith::provenance::read_step_names;
/// use clsmith::source::Source;
///
/// let text = b"$$ clsmith scale_feed: 1200. -> 600.\nFEDRAT/MMPM,600.\nGOTO/0,0,0\n";
/// let program = parse(&Source::new("part.cls", text.to_vec())?, None).program;
/// let [_, feed, goto] = program.statement_ids().collect::<Vec<_>>()[..] else { panic!("three statements") };
/// assert_eq!(read_step_names(&program, feed), ["scale_feed"]);
/// assert!(read_step_names(&program, goto).is_empty());
/// # Ok::<(), clsmith::source::SourceTooLarge>(())
/// ```
pub fn read_step_names(program: &Program, id: StatementId) -> Vec<String> {
    if let Some((name, _)) = read_change(program, program.statement(id)) {
        return vec![name.to_owned()];
    }
    let places = CommentPlaces::from_program(program);
    let place = places.comment_position(id);
    let above: Vec<(StatementId, &Statement)> =
        program.live_statements().take_while(|(found, _)| found.before() < place).collect();
    let own_name = |id: StatementId| {
        let statement = program.statement(id);
        change_wording::record_name(statement.record(), program.statement_text(statement))
    };
    // Comments about a record name it where they do not stand directly before it.
    let is_apart = place != id.before();
    let others: Vec<String> = program
        .live_statements()
        .filter(|(other, _)| places.comment_position(*other) == place && other.before() != place)
        .map(|(other, _)| own_name(other))
        .collect();
    let begins_with =
        |text: &str, name: &str| text.strip_prefix(name).is_some_and(|rest| rest.starts_with(' '));
    let mut names: Vec<String> = above
        .iter()
        .rev()
        .map_while(|(_, statement)| read_change(program, statement))
        .filter(|(_, text)| match is_apart {
            true => begins_with(text, &own_name(id)),
            false => !others.iter().any(|name| begins_with(text, name)),
        })
        .map(|(name, _)| name.to_owned())
        .collect();
    names.reverse();
    names.dedup();
    names
}

/// Returns the names of the recipes in headers of earlier runs, the last run first. Names have no folders.
pub fn read_recipe_names(program: &Program) -> Vec<String> {
    let prefix = format!("{}recipe ", comment_prefix(program.dialect()));
    let headers = program.live_statements().filter_map(|(_, statement)| {
        let text = own_comment(program, statement, ProvenanceComment::Header)?;
        Some(text.strip_prefix(&prefix)?.to_owned())
    });
    let mut names: Vec<String> = headers.filter(|name| !name.starts_with("and files sha256 ")).collect();
    names.reverse();
    names
}

/// Returns the step and the text of a comment about a change.
fn read_change<'p>(program: &'p Program, statement: &Statement) -> Option<(&'p str, &'p str)> {
    let text = own_comment(program, statement, ProvenanceComment::Change)?;
    text.strip_prefix(&comment_prefix(program.dialect()))?.split_once(": ")
}

fn own_comment<'p>(program: &'p Program, statement: &Statement, kind: ProvenanceComment) -> Option<&'p str> {
    let text = program.statement_text(statement);
    if ProvenanceComment::from_text(text) != Some(kind) {
        return None;
    }
    std::str::from_utf8(text).ok().map(str::trim)
}
