//! This module writes the header: the version of clsmith, the recipe and the input.

use super::CommentLine;
use super::comment_format::{self, WIDTH};
use super::comment_places::CommentPlaces;
use crate::fingerprint::{Digest, RecipeFingerprint, VERSION};
use crate::program::Program;
use crate::transform::Recipe;

/// Returns the lines of the header. Names have no folders and there is no time in it, so the same run writes
/// the same bytes anywhere.
pub(super) fn header_lines(
    program: &Program,
    places: &CommentPlaces,
    recipe: &Recipe,
    print: Option<&RecipeFingerprint>,
) -> Vec<CommentLine> {
    let dialect = program.dialect();
    let room = WIDTH - comment_format::comment_prefix(dialect).len();
    let mut texts = vec![format!("{VERSION} has corrected this file")];
    let mut named = |what: &str, name: &str, hashed: &str, digest: Option<Digest>| {
        texts.push(format!(
            "{what} {}",
            comment_format::shorten_middle(&printable_file_name(name), room.saturating_sub(what.len() + 1))
        ));
        let Some(digest) = digest.map(|digest| digest.to_string()) else { return };
        // The 64 digits do not fit into one line.
        let (first, second) = digest.split_at_checked(digest.len() / 2).unwrap_or_default();
        texts.extend([first, second].map(|half| format!("{hashed} sha256 {half}")));
    };
    // The text tells what the fingerprint covers, so that nobody compares it with the digest of the recipe's
    // text alone.
    named("recipe", recipe.source.name(), "recipe and files", print.map(|print| print.sha256));
    named("input", program.source().name(), "input", Some(Digest::from_bytes(program.source().bytes())));
    let at = places.header_position();
    texts.iter().map(|text| CommentLine { at, text: comment_format::comment_line(dialect, text) }).collect()
}

fn printable_file_name(path: &str) -> String {
    comment_format::to_printable_ascii(path.rsplit(['/', '\\']).next().unwrap_or(path))
}
