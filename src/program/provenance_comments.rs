//! This module recognizes comments that clsmith itself has written into a file (`provenance:`), for later
//! runs.

/// A kind of comment that clsmith has written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ProvenanceComment {
    /// A line of the header: version, recipe, input.
    Header,
    /// A line `clsmith scale_feed: ...`, which tells what a step did to the record that follows.
    Change,
}

/// The word with which such a comment begins, after the file's comment mark.
pub(crate) const OWN_WORD: &str = "clsmith";

impl ProvenanceComment {
    /// Returns the kind of a statement's text, or `None` if it is not such a comment.
    pub fn from_text(text: &[u8]) -> Option<Self> {
        let text = text.trim_ascii_start();
        let text = text.strip_prefix(b"$$").or_else(|| text.strip_prefix(b"REMARK"))?;
        let rest = text.strip_prefix(b" ")?.strip_prefix(OWN_WORD.as_bytes())?.strip_prefix(b" ")?;
        let word = rest.iter().take_while(|byte| byte.is_ascii_lowercase() || **byte == b'_').count();
        match rest.get(word..) {
            Some([b':', ..]) if word > 0 => Some(Self::Change),
            _ => Some(Self::Header),
        }
    }
}
