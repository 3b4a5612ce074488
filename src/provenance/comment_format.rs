//! This module writes comments in the form of a dialect, with the characters that are allowed in them.

use crate::program::{Dialect, OWN_WORD};

/// The columns of a comment. Readers of CATIA and Creo files accept so many, and all others do, too.
pub const WIDTH: usize = 72;

/// Returns the beginning of a comment. G-POST's input has `REMARK` where all others have `$$` of the
/// standard. SolidWorks, CAMWorks and Makino write no comments of their own, and their INSERT and PPRINT may
/// reach the NC program.
fn comment_mark(dialect: Dialect) -> &'static str {
    match dialect {
        Dialect::CreoGpost => "REMARK",
        _ => "$$",
    }
}

/// Returns the beginning of every comment of clsmith.
pub(super) fn comment_prefix(dialect: Dialect) -> String {
    format!("{} {OWN_WORD} ", comment_mark(dialect))
}

/// Makes a comment of one line. Callers make their text fit. A text that is still too long loses whole parts
/// at its end.
pub(super) fn comment_line(dialect: Dialect, text: &str) -> Vec<u8> {
    let line = format!("{}{}", comment_prefix(dialect), to_printable_ascii(text));
    drop_last_parts(&line).trim_end().as_bytes().to_vec()
}

/// Returns as many parts (separated by `, `) of an ASCII line as fit. If the first part alone is too long, as
/// many words are returned, because half a number would be another number.
fn drop_last_parts(line: &str) -> &str {
    let mut kept = line;
    while kept.len() > WIDTH {
        let Some((before, _)) = kept.rsplit_once(", ").or_else(|| kept.rsplit_once(' ')) else { break };
        kept = before;
    }
    kept
}

/// Returns the first text that fits into `width` columns, or the last one. `texts` go from the longest to the
/// shortest.
pub(super) fn first_fitting(texts: Vec<String>, width: usize) -> String {
    let last = texts.last().cloned().unwrap_or_default();
    texts.into_iter().find(|text| text.chars().count() <= width).unwrap_or(last)
}

/// Returns what may follow a text, from the longest to the shortest: a note, its second half (of `h 0.040 ->
/// 0.065 mm` the text `h 0.065 mm`), and nothing.
pub(super) fn note_variants(note: Option<&str>) -> Vec<String> {
    let Some(note) = note else { return vec![String::new()] };
    let short = note.split_once(' ').zip(note.split_once(" -> "));
    let short = short.map(|((symbol, _), (_, after))| format!(", {symbol} {after}"));
    [Some(format!(", {note}")), short, Some(String::new())].into_iter().flatten().collect()
}

/// Returns a text of the user or of the file as a comment can contain it: the printable characters of ASCII,
/// which every code page has, without `$`, which continues lines even in comments for some readers.
/// Everything else becomes `?`.
pub(super) fn to_printable_ascii(text: &str) -> String {
    text.chars().map(|c| if matches!(c, ' '..='~') && c != '$' { c } else { '?' }).collect()
}

/// Shortens a text in its middle, so that its beginning and its end stay.
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
