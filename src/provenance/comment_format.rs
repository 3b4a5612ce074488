//! How a dialect writes a comment, and what may stand in one.

use crate::program::{Dialect, OWN_WORD};

/// Columns of a comment: what readers of CATIA and Creo files take, and all others take, too.
pub const WIDTH: usize = 72;

/// What a comment begins with. G-POST's input has `REMARK` where all others have the standard's `$$`; SolidWorks, CAMWorks and
/// Makino write no comments of their own, and their INSERT and PPRINT may reach the NC program.
fn comment_mark(dialect: Dialect) -> &'static str {
    match dialect {
        Dialect::CreoGpost => "REMARK",
        _ => "$$",
    }
}

/// What every comment of clsmith's begins with.
pub(super) fn comment_prefix(dialect: Dialect) -> String {
    format!("{} {OWN_WORD} ", comment_mark(dialect))
}

/// A comment of one line. Callers make their text fit; what is still too long loses whole parts at its end.
pub(super) fn comment_line(dialect: Dialect, text: &str) -> Vec<u8> {
    let line = format!("{}{}", comment_prefix(dialect), to_printable_ascii(text));
    drop_last_parts(&line).trim_end().as_bytes().to_vec()
}

/// As many parts (`, `) of an ASCII line as fit; of a single one that is too long as many words, for half a number is another.
fn drop_last_parts(line: &str) -> &str {
    let mut kept = line;
    while kept.len() > WIDTH {
        let Some((before, _)) = kept.rsplit_once(", ").or_else(|| kept.rsplit_once(' ')) else { break };
        kept = before;
    }
    kept
}

/// The first text that fits into so many columns, or the last one. `texts` go from the longest to the shortest.
pub(super) fn first_fitting(texts: Vec<String>, room: usize) -> String {
    let last = texts.last().cloned().unwrap_or_default();
    texts.into_iter().find(|text| text.chars().count() <= room).unwrap_or(last)
}

/// What may follow a text, from the longest to the shortest: a note, of `h 0.040 -> 0.065 mm` then `h 0.065 mm` alone, nothing.
pub(super) fn note_variants(note: Option<&str>) -> Vec<String> {
    let Some(note) = note else { return vec![String::new()] };
    let short = note.split_once(' ').zip(note.split_once(" -> "));
    let short = short.map(|((symbol, _), (_, after))| format!(", {symbol} {after}"));
    [Some(format!(", {note}")), short, Some(String::new())].into_iter().flatten().collect()
}

/// Text of the user or of the file as a comment can hold it: the printable characters of ASCII, which stand in every code page,
/// without `$`, which continues lines even in comments of some readers. Everything else becomes `?`.
pub(super) fn to_printable_ascii(text: &str) -> String {
    text.chars().map(|c| if matches!(c, ' '..='~') && c != '$' { c } else { '?' }).collect()
}

/// Text cut in its middle, so that its beginning and its end stay.
pub(super) fn shorten_middle(text: &str, width: usize) -> String {
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
