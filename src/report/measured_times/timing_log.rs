//! This module reads logs of timed blocks.

use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::machine::{TimedCorner, TimedStroke};
use crate::source::{Source, Span};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The columns that a log may have.
const COLUMNS: [&str; 6] = ["corner_deg", "feed_mm_min", "lost_s", "length_mm", "seconds", "axis"];

/// Blocks that were timed on a machine.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TimingLog {
    /// Corners.
    pub corners: Vec<TimedCorner>,
    /// Motions at feed from rest to rest.
    pub strokes: Vec<TimedStroke>,
    /// Rapids of single axes from rest to rest, by the name of the axis.
    pub rapids: BTreeMap<String, Vec<TimedStroke>>,
}

/// Reads a log: CSV with a head, `#` before comments. A row with `corner_deg` is a corner with `feed_mm_min` and
/// `lost_s`, one with `axis` a rapid of that axis with `length_mm` (degrees for a rotary axis) and `seconds`, any other a
/// straight motion from rest to rest with `length_mm`, `feed_mm_min` and `seconds`.
///
/// # Errors
/// Returns [`codes::TIMING_LOG`] with the place of what cannot be read.
pub fn read_timing_log(source: &Arc<Source>) -> Result<TimingLog, Failure> {
    let mut log = TimingLog::default();
    let mut head: Option<Vec<String>> = None;
    let mut start = 0;
    for raw in source.bytes().split(|byte| *byte == b'\n') {
        let span = Span::new(start, start + raw.len());
        start += raw.len() + 1;
        let text = String::from_utf8_lossy(raw);
        let text = text.trim().trim_start_matches('\u{feff}');
        if text.is_empty() || text.starts_with('#') {
            continue;
        }
        let cells: Vec<&str> = text.split([',', ';']).map(str::trim).collect();
        match &head {
            None => head = Some(read_head(&cells, source, span)?),
            Some(head) => LogRow { head, cells: &cells, source, span }.add_to(&mut log)?,
        }
    }
    if log == TimingLog::default() {
        let message = format!("{} has no timed blocks", source.name());
        return Err(Diagnostic::new(codes::TIMING_LOG, message).into());
    }
    Ok(log)
}

fn read_head(cells: &[&str], source: &Arc<Source>, span: Span) -> Result<Vec<String>, Failure> {
    let names: Vec<String> = cells.iter().map(|cell| cell.to_lowercase()).collect();
    match names.iter().find(|name| !COLUMNS.contains(&name.as_str())) {
        Some(wrong) => {
            let message = format!("`{wrong}` is no column of a log of timed blocks");
            let finding = Diagnostic::new(codes::TIMING_LOG, message);
            Err(finding.with_label(source, span, format!("the columns are {}", COLUMNS.join(", "))).into())
        }
        None => Ok(names),
    }
}

/// A row with what is needed to say where it is wrong.
struct LogRow<'r> {
    head: &'r [String],
    cells: &'r [&'r str],
    source: &'r Arc<Source>,
    span: Span,
}

impl LogRow<'_> {
    fn text(&self, name: &str) -> Option<&str> {
        let index = self.head.iter().position(|column| column == name)?;
        self.cells.get(index).copied().filter(|cell| !cell.is_empty())
    }

    /// Returns a number above 0.
    fn number(&self, name: &str) -> Result<f64, Failure> {
        let fault = |message: String| {
            let finding = Diagnostic::new(codes::TIMING_LOG, message);
            Failure::from(finding.with_label(self.source, self.span, "in this row"))
        };
        let text = self.text(name).ok_or_else(|| fault(format!("`{name}` is missing")))?;
        let number = text.parse::<f64>().ok().filter(|number| *number > 0.0 && number.is_finite());
        number.ok_or_else(|| fault(format!("`{text}` is no number above 0 ({name})")))
    }

    fn add_to(&self, log: &mut TimingLog) -> Result<(), Failure> {
        if self.text("corner_deg").is_some() {
            log.corners.push(TimedCorner {
                angle_deg: self.number("corner_deg")?,
                feed: self.number("feed_mm_min")?,
                lost_s: self.number("lost_s")?,
            });
            return Ok(());
        }
        let (length, seconds) = (self.number("length_mm")?, self.number("seconds")?);
        match self.text("axis") {
            Some(axis) => {
                let stroke = TimedStroke { length, feed: None, seconds };
                log.rapids.entry(axis.to_owned()).or_default().push(stroke);
            }
            None => {
                log.strokes.push(TimedStroke { length, feed: Some(self.number("feed_mm_min")?), seconds })
            }
        }
        Ok(())
    }
}
