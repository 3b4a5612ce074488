//! This module writes progress as lines, for logs and other readers that are no terminal.

use super::phase_track::PhaseTrack;
use clsmith::simulation_run::RunPhase;

/// The phase and the tenth of the work that were written last.
#[derive(Debug, Default)]
pub(super) struct ProgressLines {
    last: Option<(RunPhase, u32)>,
}

impl ProgressLines {
    /// Writes a line for a new phase, and for each further tenth of the work.
    pub(super) fn show_line(&mut self, name: &str, track: &PhaseTrack) {
        if let Some(line) = self.next_line(name, track) {
            eprintln!("{line}");
        }
    }

    fn next_line(&mut self, name: &str, track: &PhaseTrack) -> Option<String> {
        let percent = (track.fraction() * 100.0) as u32;
        let now = (track.phase(), percent / 10);
        if self.last == Some(now) {
            return None;
        }
        self.last = Some(now);
        Some(format!("{name}: {}, {percent} %", track.phase().name()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_comes_with_each_phase_and_each_tenth() {
        let (mut lines, mut track) = (ProgressLines::default(), PhaseTrack::new(1));
        track.begin_phase(RunPhase::Reading);
        let mut written: Vec<String> = lines.next_line("part.cls", &track).into_iter().collect();
        track.begin_phase(RunPhase::Simulating);
        for done in 0..=1000 {
            track.report_progress(f64::from(done), 1000.0);
            written.extend(lines.next_line("part.cls", &track));
        }
        assert_eq!(written.first().map(String::as_str), Some("part.cls: reading, 0 %"));
        assert_eq!(written.last().map(String::as_str), Some("part.cls: simulating, 80 %"));
        assert_eq!(written.len(), 10, "{written:?}");
    }
}
