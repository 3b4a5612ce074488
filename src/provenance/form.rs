//! How a dialect writes a comment, and what may stand in one.

use crate::program::{Dialect, OWN_WORD};

/// Columns of a comment: what readers of CATIA and Creo files take, and all others take, too.
pub const WIDTH: usize = 72;

/// What a comment begins with. G-POST's input has `REMARK` where all others have the standard's `$$`; SolidWorks, CAMWorks and
/// Makino write no comments of their own, and their INSERT and PPRINT may reach the NC program.
fn mark(dialect: Dialect) -> &'static str {
    match dialect {
        Dialect::CreoGpost => "REMARK",
        _ => "$$",
    }
}

/// What every comment of clsmith's begins with.
pub(super) fn prefix(dialect: Dialect) -> String {
    format!("{} {OWN_WORD} ", mark(dialect))
}

/// A comment of one line, cut to the width.
pub(super) fn line(dialect: Dialect, text: &str) -> Vec<u8> {
    let line = format!("{}{}", prefix(dialect), safe(text));
    line.chars().take(WIDTH).collect::<String>().trim_end().as_bytes().to_vec()
}

/// Text of the user or of the file as a comment can hold it: the printable characters of ASCII, which stand in every code page,
/// without `$`, which continues lines even in comments of some readers. Everything else becomes `?`.
pub(super) fn safe(text: &str) -> String {
    text.chars().map(|c| if matches!(c, ' '..='~') && c != '$' { c } else { '?' }).collect()
}

/// Text cut in its middle, so that its beginning and its end stay.
pub(super) fn shortened(text: &str, width: usize) -> String {
    let count = text.chars().count();
    if count <= width {
        return text.to_owned();
    }
    let kept = width.saturating_sub(3);
    let end = kept / 2;
    let start: String = text.chars().take(kept - end).collect();
    let end: String = text.chars().skip(count - end).collect();
    format!("{start}...{end}")
}
