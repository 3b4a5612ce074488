//! This module inserts comments into the corrected program that tell what was done: a header, and a line
//! before each changed record.
//!
//! [`add_comments`] runs after the last step. It inserts comments through the same gate as the steps and
//! signs them with a step of their own ([`Recipe::provenance_step`]), so reports, diffs and the read-back
//! count them like any other change.
//!
//! A program that no step has changed gets no comment, so a second run that finds nothing to do writes the
//! same bytes. A run that changes something puts its lines below those of earlier runs. Earlier lines stay,
//! and no program reads numbers from them: together they are the history of the file, and each run can be
//! undone in turn.
//!
//! A record's lines stand directly before it, or before the group that a reader takes in one piece
//! (`comment_places`): what announces a motion and the motion itself, CATIA's matrix and AUTOPS, Makino's
//! labels, and points that continue a GOTO. The lines of a record in the head of an NX operation come after
//! that head, beside NX's own comment, and name the record. Consecutive records that one step inserted or
//! deleted have a single line.
//!
//! A line has at most 72 columns of ASCII without `$`, in every dialect, because the narrowest reader accepts
//! that in every code page. G-POST gets `REMARK`, all others `$$`. INSERT and PPRINT might reach the NC
//! program.

mod change_comments;
mod change_wording;
mod comment_format;
mod comment_places;
mod comment_readers;
mod feeds_before_steps;
mod header_comments;
mod stale_comments;

pub use comment_format::WIDTH;
pub use comment_readers::{read_recipe_names, read_step_names};
pub(crate) use stale_comments::find_stale_comments;

use crate::diagnostic::Failure;
use crate::fingerprint::RecipeFingerprint;
use crate::program::{InsertionPoint, Program, StatementChange};
use crate::recipe::Provenance;
use crate::transform::Recipe;
use crate::write::ProgramEditor;
use comment_places::CommentPlaces;

/// A comment and the place where it is inserted.
struct CommentLine {
    at: InsertionPoint,
    text: Vec<u8>,
}

/// Adds the comments that the recipe asks for to the program that its steps have made. Without a fingerprint,
/// the header only contains the name of the recipe.
///
/// ```
/// use clsmith::parse::parse;
/// use clsmith::provenance::add_comments;
/// use clsmith::setup::Setup;
/// use clsmith::source::Source;
/// use clsmith::transform::{Recipe, run_recipe};
///
/// let text = b"version: 1\nprovenance: comments\nsteps:\n  - scale_feed: { factor: 0.5 }\n";
/// let recipe = Recipe::load(&Source::new("recipe.yaml", text.to_vec())?)?;
/// let part = Source::new("part.cls", b"FEDRAT/MMPM,1200.\nGOTO/0,0,0\n".to_vec())?;
/// let program = run_recipe(&recipe, &Setup::default(), parse(&part, None).program)?.program;
/// let text = String::from_utf8(add_comments(program, &recipe, None)?.to_bytes())?;
/// assert!(text.contains("$$ clsmith scale_feed: 1200. -> 600.\nFEDRAT/MMPM,600.\n"), "{text}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Returns an error if a comment would not read back as one, which would be a fault of clsmith.
pub fn add_comments(
    program: Program,
    recipe: &Recipe,
    print: Option<&RecipeFingerprint>,
) -> Result<Program, Failure> {
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
    for id in moved {
        editor.delete_statement(id)?;
    }
    for line in lines {
        editor.insert(line.at, &line.text)?;
    }
    editor.finish()
}
