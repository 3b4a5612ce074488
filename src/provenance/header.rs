//! The header: which clsmith, which recipe, which input.

use super::Line;
use super::form::{self, WIDTH};
use super::place::Places;
use crate::fingerprint::{Digest, RecipePrint, VERSION};
use crate::program::Program;
use crate::transform::Recipe;

/// The header's lines. Names stand without their folders, and no time is told: the same run writes the same bytes anywhere.
pub(super) fn lines(
    program: &Program,
    places: &Places,
    recipe: &Recipe,
    print: Option<&RecipePrint>,
) -> Vec<Line> {
    let dialect = program.dialect();
    let room = WIDTH - form::prefix(dialect).len();
    let mut texts = vec![format!("{VERSION} has corrected this file")];
    let mut named = |what: &str, name: &str, hashed: &str, digest: Option<Digest>| {
        texts.push(format!(
            "{what} {}",
            form::shortened(&file_name(name), room.saturating_sub(what.len() + 1))
        ));
        let Some(digest) = digest.map(|digest| digest.to_string()) else { return };
        // 64 digits are more than fit into a line.
        let (first, second) = digest.split_at_checked(digest.len() / 2).unwrap_or_default();
        texts.extend([first, second].map(|half| format!("{hashed} sha256 {half}")));
    };
    // What the print is of, so that nobody compares it with the digest of the recipe's text alone.
    named("recipe", recipe.source.name(), "recipe and files", print.map(|print| print.sha256));
    named("input", program.source().name(), "input", Some(Digest::of(program.source().bytes())));
    let before = places.header();
    texts.iter().map(|text| Line { before, text: form::line(dialect, text) }).collect()
}

fn file_name(path: &str) -> String {
    form::safe(path.rsplit(['/', '\\']).next().unwrap_or(path))
}
