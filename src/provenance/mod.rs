//! What a corrected file says about its run, in comments of its own form: a header, and a line before each changed record.
//!
//! [`add_comments`] comes after the last step and puts comments in through the same gate as steps, signed with a step of its own
//! ([`Recipe::provenance_step`]), so reports, diffs and the read-back count them like any other change. A program that no step
//! changed stays as it is: so a second run that finds nothing to do writes the same bytes. One that does change something puts
//! its lines below those of the runs before it, which stay: header by header and record by record they are the file's history,
//! and each run can be undone in turn. A record's lines stand directly before it, or before the group that no reader must
//! find parted (`place`).

mod change_comments;
mod change_wording;
mod comment_format;
mod comment_places;
mod feeds_before_steps;
mod header_comments;
mod stale_comments;

pub use comment_format::WIDTH;
pub use stale_comments::find_stale_comments;

use crate::diagnostic::Diagnostic;
use crate::fingerprint::RecipeFingerprint;
use crate::program::{Program, StatementChange};
use crate::recipe::Provenance;
use crate::transform::Recipe;
use crate::write::ProgramEditor;
use comment_places::CommentPlaces;

/// A comment and the statement that it stands before (the count of statements for the end).
struct CommentLine {
    before: usize,
    text: Vec<u8>,
}

/// Adds the comments that the recipe asks for to what its steps made of a program. Without a print, the header tells the
/// recipe's name alone.
///
/// # Errors
/// When a comment would not read back as one; that is a fault of clsmith.
pub fn add_comments(
    program: Program,
    recipe: &Recipe,
    print: Option<&RecipeFingerprint>,
) -> Result<Program, Box<Diagnostic>> {
    let changed =
        program.statements().iter().any(|statement| statement.change() != StatementChange::Untouched);
    if recipe.provenance == Provenance::None || !changed {
        return Ok(program);
    }
    let places = CommentPlaces::from_program(&program);
    let mut lines = header_comments::header_lines(&program, &places, recipe, print);
    let mut moved = Vec::new();
    if recipe.provenance == Provenance::Comments {
        let found = change_comments::write_change_comments(&program, &places, recipe);
        lines.extend(found.lines);
        moved = found.moved;
    }
    let mut editor = ProgramEditor::new(program, recipe.provenance_step());
    moved.into_iter().for_each(|index| editor.delete_statement(index));
    for line in lines {
        editor.insert_before(line.before, &line.text)?;
    }
    editor.finish()
}
