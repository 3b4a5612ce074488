//! This module finds comments of an earlier run that a run without comments makes untrue.

use super::comment_places::CommentPlaces;
use crate::diagnostic::{Diagnostic, codes};
use crate::program::{Program, ProvenanceComment, RecordKind, Statement, StatementChange};
use std::collections::BTreeSet;

/// Returns a finding if steps have changed records with comments of an earlier run. These comments then name
/// other numbers than the file has. It is for a run that writes no comments of its own.
pub(crate) fn find_stale_comments(program: &Program) -> Option<Diagnostic> {
    let own = |statement: &Statement| {
        ProvenanceComment::from_text(program.statement_text(statement)) == Some(ProvenanceComment::Change)
    };
    // Nearly no program has such comments. Only the words of a shop make something else of a comment.
    let mut comments = program.live_statements_of(&[RecordKind::Comment]);
    if program.vocabulary().is_empty() && !comments.any(|(_, statement)| own(statement)) {
        return None;
    }
    let mut commented = BTreeSet::new();
    let mut last = None;
    for (id, statement) in program.live_statements() {
        if own(statement) {
            last = Some(last.unwrap_or(id));
        } else if last.take().is_some() {
            commented.insert(id.before());
        }
    }
    if commented.is_empty() {
        return None;
    }
    let places = CommentPlaces::from_program(program);
    let changed = |statement: &Statement| statement.change() != StatementChange::Untouched && !own(statement);
    let all = program.numbered_statements();
    let mut hit =
        all.filter(|(id, statement)| changed(statement) && commented.contains(&places.comment_position(*id)));
    let (_, first) = hit.next()?;
    let more = hit.count();
    let message = match more {
        0 => "the comment of an earlier run describes an older state of this record".to_owned(),
        more => {
            format!("the comments of earlier runs describe an older state of this record and of {more} more")
        }
    };
    Some(Diagnostic::new(codes::STALE_COMMENTS, message).with_label(
        program.source(),
        first.origin(),
        "changed again",
    ))
}
