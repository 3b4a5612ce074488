//! This module writes hunks: changes with the lines around them.

use super::UnifiedDiffOptions;
use crate::presentation::safe_text::{decode_characters, to_visible_character};
use std::collections::VecDeque;
use std::io::{self, Write};

const RED: &str = "\x1b[31m";
const GREEN: &str = "\x1b[32m";
const CYAN: &str = "\x1b[36m";
const BOLD: &str = "\x1b[1m";
const PLAIN: &str = "\x1b[0m";

/// Collects lines into hunks and writes each as soon as it is complete.
pub(super) struct HunkWriter<'o> {
    out: &'o mut dyn Write,
    name: &'o str,
    options: &'o UnifiedDiffOptions,
    /// The number of lines of both files before the next one.
    at: (usize, usize),
    /// Unchanged lines that may become the context of a change.
    before: VecDeque<Vec<u8>>,
    hunk: Option<Hunk>,
    headed: bool,
}

struct Hunk {
    start: (usize, usize),
    length: (usize, usize),
    body: Vec<u8>,
    /// Unchanged lines since the last change.
    after: Vec<Vec<u8>>,
}

impl<'o> HunkWriter<'o> {
    pub(super) fn new(out: &'o mut dyn Write, name: &'o str, options: &'o UnifiedDiffOptions) -> Self {
        Self { out, name, options, at: (0, 0), before: VecDeque::new(), hunk: None, headed: false }
    }

    /// Adds a line of both files.
    pub(super) fn push_unchanged(&mut self, line: &[u8]) -> io::Result<()> {
        self.at = (self.at.0 + 1, self.at.1 + 1);
        let context = self.options.context;
        match &mut self.hunk {
            Some(hunk) => {
                hunk.after.push(line.to_vec());
                // With at most twice the context between them, the next change still belongs to this hunk.
                if hunk.after.len() > context * 2 {
                    self.write_hunk()?;
                }
            }
            None if context > 0 => {
                // The buffer of the line that drops out is reused for the new line.
                let mut kept = if self.before.len() == context { self.before.pop_front() } else { None }
                    .unwrap_or_default();
                kept.clear();
                kept.extend_from_slice(line);
                self.before.push_back(kept);
            }
            None => {}
        }
        Ok(())
    }

    /// Adds a line of the file that the program does not have.
    pub(super) fn push_removed(&mut self, line: &[u8]) {
        self.push_change(b'-', RED, line, (1, 0));
    }

    /// Adds a line of the program that the file does not have.
    pub(super) fn push_added(&mut self, line: &[u8]) {
        self.push_change(b'+', GREEN, line, (0, 1));
    }

    /// Writes the last hunk.
    pub(super) fn finish(mut self) -> io::Result<()> {
        self.write_hunk()
    }

    fn push_change(&mut self, sign: u8, color: &str, line: &[u8], lines: (usize, usize)) {
        let options = self.options;
        let before = &mut self.before;
        let at = self.at;
        let hunk = self.hunk.get_or_insert_with(|| {
            let context = before.len();
            let mut body = Vec::new();
            before.drain(..).for_each(|line| append_diff_line(&mut body, b' ', "", &line, options));
            Hunk {
                start: (at.0 - context, at.1 - context),
                length: (context, context),
                body,
                after: Vec::new(),
            }
        });
        let joined = hunk.after.len();
        hunk.after.drain(..).for_each(|line| append_diff_line(&mut hunk.body, b' ', "", &line, options));
        append_diff_line(&mut hunk.body, sign, color, line, options);
        hunk.length = (hunk.length.0 + joined + lines.0, hunk.length.1 + joined + lines.1);
        self.at = (at.0 + lines.0, at.1 + lines.1);
    }

    fn write_hunk(&mut self) -> io::Result<()> {
        let Some(mut hunk) = self.hunk.take() else { return Ok(()) };
        let context = self.options.context;
        let trailing = hunk.after.len().min(context);
        for line in hunk.after.iter().take(trailing) {
            append_diff_line(&mut hunk.body, b' ', "", line, self.options);
        }
        let length = (hunk.length.0 + trailing, hunk.length.1 + trailing);
        let first = hunk.after.len().saturating_sub(context);
        self.before = hunk.after.drain(first..).collect();
        self.write_file_names()?;
        let (color, plain) = self.color_codes(CYAN);
        let (old, new) =
            (format_hunk_range(hunk.start.0, length.0), format_hunk_range(hunk.start.1, length.1));
        writeln!(self.out, "{color}@@ -{old} +{new} @@{plain}")?;
        self.out.write_all(&hunk.body)
    }

    fn write_file_names(&mut self) -> io::Result<()> {
        if std::mem::replace(&mut self.headed, true) {
            return Ok(());
        }
        let (color, plain) = self.color_codes(BOLD);
        for (sign, folder) in [("---", "a/"), ("+++", "b/")] {
            let name = format_file_name(folder, self.name);
            writeln!(self.out, "{color}{sign} {name}{plain}")?;
        }
        Ok(())
    }

    fn color_codes(&self, color: &'static str) -> (&'static str, &'static str) {
        if self.options.color { (color, PLAIN) } else { ("", "") }
    }
}

/// Formats `start,length` of a hunk. A range of no lines names the line before it.
fn format_hunk_range(before: usize, length: usize) -> String {
    match length {
        0 => format!("{before},0"),
        1 => format!("{}", before + 1),
        _ => format!("{},{length}", before + 1),
    }
}

/// Returns the name as git writes it: in quotes if it has a character that could end it, and with a tab after
/// it if it has a blank.
fn format_file_name(folder: &str, name: &str) -> String {
    let name = format!("{folder}{}", name.trim_start_matches('/'));
    if name.chars().any(|c| c.is_control() || matches!(c, '"' | '\\')) {
        return format!("\"{}\"", name.escape_default());
    }
    if name.contains(' ') { name + "\t" } else { name }
}

fn append_diff_line(body: &mut Vec<u8>, sign: u8, color: &str, line: &[u8], options: &UnifiedDiffOptions) {
    let color = if options.color { color } else { "" };
    body.extend_from_slice(color.as_bytes());
    body.push(sign);
    let (text, ended) = match line.strip_suffix(b"\n") {
        Some(text) => (text, true),
        None => (line, false),
    };
    if options.display {
        let text = text.strip_suffix(b"\r").unwrap_or(text);
        let shown: String = decode_characters(text).map(|(c, _)| to_visible_character(c, true)).collect();
        body.extend_from_slice(shown.as_bytes());
    } else {
        body.extend_from_slice(text);
    }
    if !color.is_empty() {
        body.extend_from_slice(PLAIN.as_bytes());
    }
    body.push(b'\n');
    if !ended {
        body.extend_from_slice(b"\\ No newline at end of file\n");
    }
}
