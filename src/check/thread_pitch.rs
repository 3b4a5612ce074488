//! This module compares feed and speed of taps with the pitch in the tool's name.

use super::{Lint, LintFindings};
use crate::diagnostic::codes;
use crate::number::format_trimmed_number;
use crate::program::motion::Motion;
use crate::program::{LengthUnit, StatementId};

/// Pitches closer than this share of them are one: feeds are printed with few digits.
const SAME_PITCH: f64 = 0.01;

/// Reports taps and threads whose feed is not the pitch of their tool times the speed.
#[derive(Default)]
pub(super) struct ThreadPitchLint {
    /// The statement that governs the feed of the last thread that was looked at.
    governor: Option<StatementId>,
}

impl Lint for ThreadPitchLint {
    fn check_motion(&mut self, motion: &Motion, found: &mut LintFindings<'_>) {
        let (true, Some(governor)) = (motion.cuts_thread, motion.feed_from) else { return };
        if self.governor.replace(governor) == Some(governor) {
            return;
        }
        let named =
            motion.tool.as_deref().and_then(|tool| tool.name.as_deref()).and_then(find_metric_pitch_mm);
        let speed = motion.spindle_rpm().filter(|speed| *speed > 0.0);
        let (Some(named_mm), Some(speed), Some(feed)) = (named, speed, motion.feed) else { return };
        let program = found.program;
        let file = found.facts.units.or_else(|| program.feed_length_unit()).unwrap_or(LengthUnit::Mm);
        let Some(feed_mm_min) = feed.mm_per_minute(file, Some(speed), None) else { return };
        let pitch_mm = feed_mm_min / speed;
        if (pitch_mm - named_mm).abs() <= SAME_PITCH * named_mm {
            return;
        }
        let print = |value: f64| format_trimmed_number(value, 4);
        let message = format!(
            "the tool's name says a pitch of {} mm, but feed and speed make {} mm per revolution; at {} rev/min \
             {} mm/min would fit",
            print(named_mm),
            print(pitch_mm),
            print(speed),
            print(named_mm * speed)
        );
        let span = found.statement_span(governor);
        found.report(codes::THREAD_PITCH_DIFFERS, span, message, "this feed");
    }
}

/// Returns the pitch in a name with a metric thread, such as `TAP M10x1.5` or `M8 X 1,25 HSS`, in mm. A name
/// without a pitch (`M8`) may mean a fine thread, so nothing is read from it.
fn find_metric_pitch_mm(name: &str) -> Option<f64> {
    let text = name.to_ascii_uppercase().replace(',', ".");
    let bytes = text.as_bytes();
    let starts = text.match_indices('M').filter(|(at, _)| {
        // `EM10X1` is an end mill.
        !at.checked_sub(1).and_then(|before| bytes.get(before)).is_some_and(u8::is_ascii_alphanumeric)
    });
    starts.filter_map(|(at, _)| read_thread_size(text.get(at + 1..)?)).next()
}

/// Reads diameter, `X` and pitch, and returns the pitch where the two are those of a thread.
fn read_thread_size(text: &str) -> Option<f64> {
    let (diameter, rest) = read_decimal(text)?;
    let rest = rest.trim_start().strip_prefix(['X', '*'])?;
    let (pitch, _) = read_decimal(rest.trim_start())?;
    // The finest thread of ISO 261 has a pitch of 0.2, the coarsest of 8; none is a third of its diameter.
    ((0.2..=8.0).contains(&pitch) && pitch * 3.0 < diameter).then_some(pitch)
}

/// Reads a plain decimal number, and returns what follows it.
fn read_decimal(text: &str) -> Option<(f64, &str)> {
    let end = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
    let (number, rest) = text.split_at_checked(end)?;
    Some((number.parse().ok()?, rest))
}

#[cfg(test)]
mod tests {
    use super::find_metric_pitch_mm;

    #[test]
    fn pitches_are_read_from_names_of_metric_threads_only() {
        let cases = [
            ("TAP M10x1.5", Some(1.5)),
            ("M8 X 1,25 HSS", Some(1.25)),
            ("TAP_M10X1.5", Some(1.5)),
            ("T1 Tap M 6*1", None),
            ("M6*1", Some(1.0)),
            ("M8", None),
            ("EM10X1", None),
            ("M10X75", None),
            ("MILL 10 X 1", None),
            ("M1.2.3X1", None),
        ];
        for (name, pitch) in cases {
            assert_eq!(find_metric_pitch_mm(name), pitch, "{name}");
        }
    }
}
