//! Threads before and after a step: their feed is the pitch times the spindle speed, and no step may part the two unseen.

use super::StepContext;
use crate::diagnostic::{Diagnostic, codes};
use crate::number::format_trimmed_number;
use crate::program::{LengthUnit, Program, Record, RecordKind, StatementId};
use std::collections::BTreeSet;

/// A thread: the statement that governs its feed, and the feed in mm per revolution.
type ThreadPitch = (StatementId, f64);

/// Pitches closer than this share of them are one: feeds are printed with few digits.
const SAME_PITCH: f64 = 5e-3;

/// The threads of a program in order, of each statement that governs their feed the first one. It is empty for a program
/// that cuts none, at the price of one look at each cycle and feed.
pub(super) fn find_thread_pitches(program: &Program) -> Vec<ThreadPitch> {
    let cuts = |record: &Record| match record {
        Record::Cycle(cycle) => cycle.cuts_thread,
        Record::Threading(_) => true,
        _ => false,
    };
    let mut may_cut = program.live_statements_of(&[RecordKind::Cycle, RecordKind::Feed]);
    if !may_cut.any(|(_, statement)| cuts(statement.record())) {
        return Vec::new();
    }
    let file = program.stated_length_unit().or_else(|| program.feed_length_unit()).unwrap_or(LengthUnit::Mm);
    let mut found: Vec<ThreadPitch> = Vec::new();
    for motion in program.motions().filter(|motion| motion.cuts_thread) {
        let Some(speed) = motion.spindle_rpm().filter(|speed| *speed > 0.0) else { continue };
        let feed = motion.feed.and_then(|feed| feed.mm_per_minute(file, Some(speed), None));
        let governor = motion.feed_from.unwrap_or(motion.last_statement());
        if let Some(feed) = feed.filter(|_| found.last().is_none_or(|(last, _)| *last != governor)) {
            found.push((governor, feed / speed));
        }
    }
    found
}

/// Returns the statements of feeds between a cycle that cuts threads and its end, with the cycle. Some exports repeat
/// there what the cycle has already said: pitch times speed.
pub(super) fn list_feeds_in_threads(program: &Program) -> BTreeSet<StatementId> {
    let mut cuts_thread = false;
    let mut found = BTreeSet::new();
    for (id, statement) in program.live_statements() {
        match statement.record() {
            Record::Cycle(cycle) if !cycle.changes => cuts_thread = cycle.cuts_thread,
            Record::CycleOff => cuts_thread = false,
            _ => {}
        }
        if cuts_thread && matches!(statement.record(), Record::Feed(_) | Record::Cycle(_)) {
            found.insert(id);
        }
    }
    found
}

/// Reports the first thread of which a step has changed the pitch. Threads are compared in their order; a step that adds
/// or removes some cannot be judged.
pub(super) fn report_changed_pitches(
    before: &[ThreadPitch],
    program: &Program,
    context: &mut StepContext<'_>,
) {
    if before.is_empty() {
        return;
    }
    let after = find_thread_pitches(program);
    if after.len() != before.len() {
        return;
    }
    let mut changed = before
        .iter()
        .zip(&after)
        .filter(|((_, old), (_, new))| (old - new).abs() > SAME_PITCH * old.abs())
        .map(|((_, old), (id, new))| (*id, *old, *new));
    let Some((id, old, new)) = changed.next() else { return };
    let more = match changed.count() {
        0 => String::new(),
        1 => " (and one more thread)".to_owned(),
        count => format!(" (and {count} more threads)"),
    };
    let print = |pitch: f64| format_trimmed_number(pitch, 4);
    let message = format!(
        "feed and spindle speed of this thread part: {} mm per revolution become {}{more}",
        print(old),
        print(new)
    );
    let span = program.statement(id).origin();
    let finding = Diagnostic::new(codes::THREAD_PITCH_CHANGED, message).with_label(
        program.source(),
        span,
        "this thread",
    );
    let finding = context.label_step(finding, "by this step");
    context.findings.push(finding);
}
