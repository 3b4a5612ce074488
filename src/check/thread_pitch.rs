//! This module compares feed and speed of taps and threads with each other and with the pitch in the tool's name.

use super::thread_names::find_pitch_mm;
use super::{Lint, LintFindings};
use crate::diagnostic::codes;
use crate::number::format_trimmed_number;
use crate::program::motion::Motion;
use crate::program::record::DrillingCycle;
use crate::program::{Feed, LengthUnit, Record, Statement, StatementId};
use std::collections::HashMap;
use std::sync::Arc;

/// Pitches closer than this share of them are one: feeds are printed with few digits.
const SAME_PITCH: f64 = 0.01;

/// Reports taps and threads whose feed is not the pitch times the speed.
#[derive(Default)]
pub(super) struct ThreadPitchLint {
    /// The thread that was looked at last.
    last: Option<SeenThread>,
    /// The tool in force, by its number or name, and the pitch that its name tells.
    tool: Option<Vec<u8>>,
    named_mm: Option<f64>,
    /// The pitch that a name has told since the last tool change. It may be that of the next tool.
    announced_mm: Option<f64>,
    /// The pitches that tools have cut in holes, in mm.
    cut_mm: HashMap<Option<Vec<u8>>, f64>,
    /// Whether a cycle that taps is in force, and the FEDRAT after it.
    taps: bool,
    inner_feed: Option<(StatementId, Feed)>,
    spindle: Option<StatementId>,
}

/// What governs the pitch of a thread.
#[derive(Debug, Clone, PartialEq)]
struct SeenThread {
    governor: StatementId,
    speed: Option<f64>,
    pitch_mm: f64,
}

impl Lint for ThreadPitchLint {
    fn check_statement(&mut self, id: StatementId, statement: &Statement, found: &mut LintFindings<'_>) {
        match statement.record() {
            Record::Text | Record::Known => self.read_name(found.statement_text(id)),
            Record::OperationStart(_) => {
                let name = crate::program::operation::tool_name(found.program, statement);
                // An operation without a tool's name (Creo, shops' own words) goes on with the tool in force.
                if let Some(name) = name {
                    self.named_mm = find_pitch_mm(&name);
                    self.tool = Some(name.into_bytes());
                    (self.announced_mm, self.last) = (None, None);
                }
            }
            Record::ToolCall(call) => self.change_tool(call.loads, call.number, found.statement_text(id)),
            Record::Cycle(cycle) if !cycle.changes => {
                self.taps = cycle.cuts_thread;
                self.inner_feed = None;
            }
            Record::CycleOff => (self.taps, self.inner_feed) = (false, None),
            Record::Feed(feed) if self.taps => self.inner_feed = Some((id, *feed)),
            Record::Spindle(_) => self.spindle = Some(id),
            _ => {}
        }
    }

    fn check_motion(&mut self, motion: &Motion, found: &mut LintFindings<'_>) {
        if !motion.cuts_thread {
            return;
        }
        let speed = motion.spindle_rpm().filter(|speed| *speed > 0.0);
        let program = found.program;
        let file = found.facts.units.or_else(|| program.feed_length_unit()).unwrap_or(LengthUnit::Mm);
        let pitch_of = |feed: Feed| find_feed_pitch(feed, file, speed);
        let Some(pitch_mm) = motion.feed.and_then(pitch_of) else { return };
        let governor = motion.feed_from.unwrap_or(motion.last_statement());
        let thread = SeenThread { governor, speed, pitch_mm };
        let before = self.last.replace(thread.clone());
        if before.as_ref() == Some(&thread) {
            return;
        }
        let cycle = motion.hole.as_ref().map(|(_, cycle)| cycle);
        let stated_mm = cycle.and_then(|cycle| cycle.pitch?.to_feed()).and_then(pitch_of);
        let own = ThreadOfMotion { thread, stated_mm, cycle };
        let inner = self.inner_feed.take().and_then(|(id, feed)| Some((id, pitch_of(feed)?)));
        if let Some(message) = self.compare_speeds(before, &own) {
            let span = found.statement_span(self.spindle.unwrap_or(governor));
            found.report(codes::THREAD_PITCH_DIFFERS, span, message, "this speed");
        } else if let Some(message) = self.compare_pitches(&own) {
            let span = found.statement_span(governor);
            found.report(codes::THREAD_PITCH_DIFFERS, span, message, "this feed");
        } else if let Some((id, inner_mm)) = inner.filter(|(_, inner)| !is_same_pitch(*inner, pitch_mm)) {
            let message = format!(
                "two feeds with one thread: this FEDRAT makes {} mm per revolution, the cycle {}",
                print_pitch(inner_mm),
                print_pitch(pitch_mm)
            );
            let span = found.statement_span(id);
            found.report(codes::THREAD_PITCH_DIFFERS, span, message, "inside the cycle");
        }
    }
}

/// A thread with what its cycle states.
struct ThreadOfMotion<'m> {
    thread: SeenThread,
    stated_mm: Option<f64>,
    cycle: Option<&'m Arc<DrillingCycle>>,
}

impl ThreadPitchLint {
    /// Reads a pitch from the text of INSERT, TPRINT and of loads with a name.
    fn read_name(&mut self, text: &[u8]) {
        const NAMES: &[&[u8]] = &[b"INSERT", b"TPRINT", b"LOADTL", b"LOAD", b"TOOLNO", b"TLNAME"];
        let start = text.trim_ascii_start();
        let names_tool =
            |word: &&[u8]| start.get(..word.len()).is_some_and(|own| own.eq_ignore_ascii_case(word));
        if !NAMES.iter().any(names_tool) {
            return;
        }
        if let Some(pitch_mm) = find_pitch_mm(&String::from_utf8_lossy(start)) {
            (self.named_mm, self.announced_mm) = (Some(pitch_mm), Some(pitch_mm));
        }
    }

    /// Takes a tool change. A name may stand in it or before it.
    fn change_tool(&mut self, loads: bool, number: u32, text: &[u8]) {
        let in_text = find_pitch_mm(&String::from_utf8_lossy(text));
        if !loads {
            self.announced_mm = in_text.or(self.announced_mm);
            return;
        }
        let number = number.to_string().into_bytes();
        let is_named = self.tool.as_ref().is_some_and(|tool| tool.iter().any(|byte| !byte.is_ascii_digit()));
        // NX names the tool in TOOL PATH, and loads it by its number behind that.
        if !is_named && self.tool.as_ref() != Some(&number) {
            self.named_mm = self.announced_mm;
            self.tool = Some(number);
            self.last = None;
        }
        self.named_mm = in_text.or(self.named_mm);
        self.announced_mm = None;
    }

    /// Compares with the thread before: its speed may have changed while its feed per minute did not.
    fn compare_speeds(&self, before: Option<SeenThread>, own: &ThreadOfMotion<'_>) -> Option<String> {
        let before = before.filter(|before| before.governor == own.thread.governor)?;
        let differs =
            before.speed != own.thread.speed && !is_same_pitch(before.pitch_mm, own.thread.pitch_mm);
        differs.then(|| {
            format!(
                "the spindle speed changes between these threads, and their feed does not: {} mm per revolution become {}",
                print_pitch(before.pitch_mm),
                print_pitch(own.thread.pitch_mm)
            )
        })
    }

    /// Compares with the pitch that the tool's name tells, the cycle states, or the tool has cut before.
    fn compare_pitches(&mut self, own: &ThreadOfMotion<'_>) -> Option<String> {
        let pitch_mm = own.thread.pitch_mm;
        let differs = |other: &f64| !is_same_pitch(*other, pitch_mm);
        let print = print_pitch;
        let would_fit = |pitch: f64| match own.thread.speed {
            Some(speed) => format!("; at {} rev/min {} mm/min would fit", print(speed), print(pitch * speed)),
            None => String::new(),
        };
        if let Some(named) = self.named_mm.filter(differs) {
            return Some(format!(
                "the tool's name says a pitch of {} mm, but feed and speed make {} mm per revolution{}",
                print(named),
                print(pitch_mm),
                would_fit(named)
            ));
        }
        if let Some(stated) = own.stated_mm.filter(differs) {
            return Some(format!(
                "the cycle states a pitch of {} mm, but feed and speed make {} mm per revolution{}",
                print(stated),
                print(pitch_mm),
                would_fit(stated)
            ));
        }
        own.cycle?;
        let cut = *self.cut_mm.entry(self.tool.clone()).or_insert(pitch_mm);
        differs(&cut).then(|| {
            format!(
                "this tap has cut a pitch of {} mm before, and here feed and speed make {} mm per revolution{}",
                print(cut),
                print(pitch_mm),
                would_fit(cut)
            )
        })
    }
}

/// Returns the pitch in mm that a feed makes; a feed per revolution needs no speed.
fn find_feed_pitch(feed: Feed, file: LengthUnit, speed: Option<f64>) -> Option<f64> {
    let speed = if feed.unit_or_default().is_per_revolution() { 1.0 } else { speed? };
    Some(feed.mm_per_minute(file, Some(speed), None)? / speed).filter(|pitch| *pitch > 0.0)
}

fn is_same_pitch(one: f64, other: f64) -> bool {
    (one - other).abs() <= SAME_PITCH * other
}

fn print_pitch(value: f64) -> String {
    format_trimmed_number(value, 4)
}
