//! This module holds how long a statement may be. What counts is the statement alone: neither what stands behind it nor
//! how plainly it is written.

use super::columns::lines_with_starts;

/// The most bytes of a statement that is read. The longest measured line has 124 characters; one statement of 160,000
/// points has 4 MB.
const MOST_BYTES: usize = 16 << 20;

/// The most fields of a statement that is read, as [`count_field_ends`] counts them. pest needs about 500 bytes for each,
/// so without a limit a large file of one line would use up all memory.
const MOST_FIELDS: usize = 1 << 20;

/// Returns whether a text is short enough to be read as one statement. What is longer is refused (CL0001).
pub(super) fn is_readable_length(text: &[u8]) -> bool {
    // A field has at least a byte.
    text.len() <= MOST_FIELDS || text.len() <= MOST_BYTES && count_field_ends(text) <= MOST_FIELDS
}

/// Returns the end of the last line up to which a text is short enough; 0 if its first line is too long.
pub(super) fn find_readable_end(text: &[u8]) -> usize {
    let (mut end, mut fields) = (0, 0);
    for (start, line) in lines_with_starts(text) {
        fields += count_field_ends(line);
        let is_readable =
            start + line.len() <= MOST_FIELDS || start + line.len() <= MOST_BYTES && fields <= MOST_FIELDS;
        if !is_readable {
            break;
        }
        end = start + line.len();
    }
    end
}

/// Returns how many fields may end in a text: every comma, slash and parenthesis ends one, and so does every row of
/// blanks and line ends.
fn count_field_ends(text: &[u8]) -> usize {
    let is_blank = |byte: u8| matches!(byte, b' ' | b'\t' | b'\n' | b'\r');
    let mut was_blank = false;
    let mut count = 0;
    for byte in text {
        let blank = is_blank(*byte);
        count += usize::from(matches!(byte, b',' | b'/' | b'(' | b')') || blank && !was_blank);
        was_blank = blank;
    }
    count
}
