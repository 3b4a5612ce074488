//! Lines as `patch` sees them.

/// The lines of a text, each with its LF; the last one perhaps without.
pub(super) fn split(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    text.split_inclusive(|byte| *byte == b'\n')
}
