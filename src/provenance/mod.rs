//! What a corrected file says about its run, in comments of its own form: a header, and a line before each changed record.
//!
//! [`add`] comes after the last step and puts comments in through the same gate as steps, signed with a step of its own
//! ([`Recipe::provenance_step`]), so reports, diffs and the read-back count them like any other change. A program that no step
//! changed stays as it is: so a second run that finds nothing to do writes the same bytes. One that does change something puts
//! its lines below those of the runs before it, which stay: header by header and record by record they are the file's history,
//! and each run can be undone in turn. A record's lines stand directly before it, or before the group that no reader must
//! find parted (`place`).

mod changes;
mod feeds;
mod form;
mod header;
mod place;
mod stale;
mod words;

pub use form::WIDTH;
pub use stale::stale;

use crate::diagnostic::Diagnostic;
use crate::fingerprint::RecipePrint;
use crate::program::{Change, Program};
use crate::recipe::Provenance;
use crate::transform::Recipe;
use crate::write::Editor;
use place::Places;

/// A comment and the statement that it stands before (the count of statements for the end).
struct Line {
    before: usize,
    text: Vec<u8>,
}

/// Adds the comments that the recipe asks for to what its steps made of a program. Without a print, the header tells the
/// recipe's name alone.
///
/// # Errors
/// When a comment would not read back as one; that is a fault of clsmith.
pub fn add(
    program: Program,
    recipe: &Recipe,
    print: Option<&RecipePrint>,
) -> Result<Program, Box<Diagnostic>> {
    let changed = program.statements().iter().any(|statement| statement.change() != Change::Untouched);
    if recipe.provenance == Provenance::None || !changed {
        return Ok(program);
    }
    let places = Places::of(&program);
    let mut lines = header::lines(&program, &places, recipe, print);
    let mut moved = Vec::new();
    if recipe.provenance == Provenance::Comments {
        let found = changes::lines(&program, &places, recipe);
        lines.extend(found.lines);
        moved = found.moved;
    }
    let mut editor = Editor::new(program, recipe.provenance_step());
    moved.into_iter().for_each(|index| editor.delete(index));
    for line in lines {
        editor.insert_before(line.before, &line.text)?;
    }
    editor.finish()
}
