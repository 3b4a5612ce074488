//! This module finds the name that was most likely meant by a name that does not exist.

/// Returns the known name that was most likely meant. Upper and lower case, blanks, `-` and `_` do not count as
/// differences. Returns `None` if no known name is similar enough.
pub(crate) fn find_similar_name<'n>(typed: &str, known: &[&'n str]) -> Option<&'n str> {
    let plain = |name: &str| name.to_lowercase().replace(['-', ' '], "_");
    let typed = plain(typed);
    let allowed = 1 + typed.chars().count() / 4;
    let near = |name: &&&str| {
        let distance = strsim::damerau_levenshtein(&typed, &plain(name));
        // Two edits turn any short name into any other, so the distance must also be shorter than the name.
        distance <= allowed && distance < name.chars().count()
    };
    known.iter().filter(near).min_by_key(|name| strsim::damerau_levenshtein(&typed, &plain(name))).copied()
}
