//! This module tells what stands behind lines in the margin of an editor: the feed where another one comes into effect,
//! and the time of each operation.

use super::program_view::ProgramView;
use crate::number::format_trimmed_number;
use crate::presentation::text_format::format_duration;
use crate::program::motion::Motion;
use std::ops::Range;

/// A word behind a line.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct LineHint {
    /// The line, counted from 0.
    pub line: u32,
    /// The text: `1200 MMPM`, `rapid`, `3 min 20 s`.
    pub text: String,
}

impl ProgramView {
    /// Returns the hints of some lines, in order.
    pub fn line_hints(&self, lines: Range<u32>) -> Vec<LineHint> {
        let mut found = self.feed_hints(&lines);
        for (operation, sums) in self.operations() {
            let Some(line) = operation.start.map(|start| self.line_of_statement(start)) else { continue };
            if lines.contains(&line) && sums.seconds > 0.0 {
                found.push(LineHint { line, text: format_duration(sums.seconds) });
            }
        }
        found.sort_by_key(|hint| hint.line);
        found
    }

    fn feed_hints(&self, lines: &Range<u32>) -> Vec<LineHint> {
        let Some(first) = self.statement_on_line(lines.start) else { return Vec::new() };
        let mut found = Vec::new();
        let (_, mut motions) = self.motions_before(first);
        let mut before: Option<String> = None;
        while let Some(motion) = motions.next() {
            let last = motion.last_statement();
            let effect = describe_effect(&motion);
            if last >= first {
                let line = self.line_of_statement(last);
                if line >= lines.end {
                    break;
                }
                if effect.is_some() && effect != before {
                    found.extend(effect.clone().map(|text| LineHint { line, text }));
                }
            }
            before = effect.or(before);
            motions.give_back(motion);
        }
        found
    }
}

/// Returns how a motion is made, or `None` if no feed is known.
fn describe_effect(motion: &Motion) -> Option<String> {
    if motion.rapid {
        return Some("rapid".to_owned());
    }
    let feed = motion.feed?;
    Some(format!("{} {}", format_trimmed_number(feed.value, 4), feed.unit_or_default().word()))
}
