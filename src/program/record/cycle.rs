//! This module reads drilling cycles: `CYCLE/DRILL,...` and the holes after it.

use super::{BadRecord, NumberRole, Record, RecordReading, StatedPitch};
use crate::program::syntax::{FieldKind, StatementField, StatementSyntax, fold_text};
use crate::program::units::{Feed, FeedUnit};

/// The motions of the cycle in the hole.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum CycleKind {
    /// Down at feed and up at rapid (DRILL, CDRILL, CSINK, BRKCHP, DEEP, ...).
    Drill,
    /// Down and up at feed (TAP, BORE, REAM, THREAD, MILL).
    FeedOut,
}

/// A drilling cycle. Distances are relative to the hole's point along the tool axis, in the file's unit, with
/// the printed signs.
#[derive(Debug, Clone, PartialEq)]
pub struct DrillingCycle {
    /// The motions in the hole.
    pub kind: CycleKind,
    /// Whether a thread is cut (TAP and its kin, THREAD), so that the feed is its pitch times the spindle speed.
    pub cuts_thread: bool,
    /// The depth: `FEDTO`, `DEPTH`, or the first number without a word.
    pub depth: Option<f64>,
    /// Whether `depth` came from `FEDTO`. NX prints a coordinate there (negative is down), others print a
    /// depth.
    pub depth_is_fedto: bool,
    /// The clearance: `RAPTO`, `CLEAR`, or the number without a word that stands for it.
    pub clearance: Option<f64>,
    /// The retract height: `RTRCTO` or `RETURN`; `None` for `AUTO`.
    pub retract: Option<f64>,
    /// Whether the record has `RTRCTO,AUTO`, which goes back to the clearance.
    pub retract_is_auto: bool,
    /// Whether the record is NX's `CYCLE/ON,...`: values that it does not give stay as in the cycle in force.
    pub changes: bool,
    /// The feed, if the record has one.
    pub feed: Option<Feed>,
    /// The pitch of the thread, if the record has one: `PITCH,1.5`, `LEAD,1.5`, `TPI,16`.
    pub pitch: Option<StatedPitch>,
    /// How long the tool stays at the depth, if the record says so: `DWELL,0.5`, `DWELL,REV,2`.
    pub dwell: Option<CycleDwell>,
}

/// How long a tool stays at the depth of a hole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CycleDwell {
    /// For so many seconds.
    Seconds(f64),
    /// For so many revolutions of the spindle.
    Revolutions(f64),
}

/// Reads a record of this family.
pub(super) fn read_record(major: &str, syntax: &StatementSyntax<'_>) -> RecordReading {
    if major != "CYCLE" {
        return None;
    }
    let first = syntax.word_at(0).unwrap_or_default();
    Some(match first.as_ref() {
        "OFF" | "NOMORE" => Ok(Record::CycleOff),
        // CYCLE/ON switches the last cycle on again. CLT announces each cycle in this way, SolidWorks with
        // CYCLE/INIT. NX's CYCLE/ON,FEDTO,... changes the cycle in force.
        "ON" if syntax.fields.len() == 1 => Ok(Record::CycleOn),
        "INIT" | "" => Ok(Record::Known),
        "CLEAR" | "RESET" if syntax.count_numbers() == 0 => Ok(Record::Known),
        _ => read_cycle(&first, syntax).map(|cycle| Record::Cycle(Box::new(cycle))),
    })
}

/// A word or a number of the cycle; a word governs the number after it.
enum CycleItem {
    Word(String),
    Number(f64),
}

/// Returns the words and numbers of a cycle in order.
fn collect_cycle_items(syntax: &StatementSyntax<'_>) -> Vec<CycleItem> {
    let words = |field: &StatementField| {
        let text = fold_text(syntax.bytes_at(&field.at));
        text.split(' ').map(|word| CycleItem::Word(word.to_owned())).collect::<Vec<_>>()
    };
    let item = |field: &StatementField| match &field.kind {
        FieldKind::Number(value) => vec![CycleItem::Number(*value)],
        FieldKind::Text => words(field),
        _ => Vec::new(),
    };
    syntax.fields.iter().flat_map(item).collect()
}

/// Returns whether a word names a tapping cycle. Posts name their taps in many ways: TAP, RTAP, RIGIDTAP, TAPRIG,
/// REVTAP, LTAP, BRKTAP.
fn is_tap_name(word: &str) -> bool {
    word.contains("TAP") && !word.contains("TAPER")
}

/// Reads a cycle: each number is given its meaning by the word before it, or by its position.
fn read_cycle(first: &str, syntax: &StatementSyntax<'_>) -> Result<DrillingCycle, BadRecord> {
    let name = first.split(' ').next().unwrap_or_default();
    let items = collect_cycle_items(syntax);
    // TAP may be an option of the cycle, too: `CYCLE/RIGID,TAP,...`, `CYCLE/DEEP,TAP,...`. A THREAD behind MILL is milled.
    let taps = |item: &CycleItem| matches!(item, CycleItem::Word(word) if is_tap_name(word));
    let cuts_thread = name == "THREAD" || items.iter().any(taps);
    let kind = match name {
        "BORE" | "REAM" | "MILL" | "BORE1" | "BORE2" => CycleKind::FeedOut,
        _ if cuts_thread => CycleKind::FeedOut,
        _ => CycleKind::Drill,
    };
    let mut cycle = DrillingCycle {
        kind,
        cuts_thread,
        depth: None,
        depth_is_fedto: false,
        clearance: None,
        retract: None,
        retract_is_auto: false,
        changes: first == "ON",
        feed: None,
        pitch: None,
        dwell: None,
    };
    let mut dwells = false;
    let mut rapid_to = None;
    let mut bare = Vec::new();
    let mut word = String::new();
    let mut returns_to_clearance = false;
    for item in items {
        let value = match item {
            CycleItem::Word(next) => {
                // CAMWorks names the return plane as controls do: G98 the height before, G99 the clearance.
                returns_to_clearance |= next == "G99";
                cycle.retract_is_auto |= word == "RTRCTO" && next == "AUTO";
                // In DWELL,REV,2 the number counts revolutions.
                dwells = next == "DWELL" || (next == "REV" && word == "DWELL");
                word = next;
                continue;
            }
            CycleItem::Number(value) => value,
        };
        match word.as_str() {
            "FEDTO" => (cycle.depth, cycle.depth_is_fedto) = (Some(value), true),
            "DEPTH" => cycle.depth = Some(value),
            "RAPTO" => rapid_to = Some(value),
            "CLEAR" => cycle.clearance = Some(value),
            "RTRCTO" | "RETURN" => cycle.retract = Some(value),
            unit if FeedUnit::from_word(unit).is_some() && cycle.feed.is_none() => {
                cycle.feed = Some(Feed { value, unit: FeedUnit::from_word(unit) });
                // A number without a word after the feed is the clearance (CLT, ISO), not another feed.
                word = "AFTER-FEED".to_owned();
                continue;
            }
            "PITCH" | "LEAD" | "TPI" => {
                cycle.pitch = cycle.pitch.or(StatedPitch::from_word(Some(&word), value));
            }
            "DWELL" | "REV" if dwells && cycle.dwell.is_none() && value >= 0.0 => {
                let revolutions = word == "REV";
                cycle.dwell = Some(if revolutions {
                    CycleDwell::Revolutions(value)
                } else {
                    CycleDwell::Seconds(value)
                });
            }
            "STEP" | "INCR" | "1STPECK" | "SUBPECK" | "PECKING" | "DWELL" | "REV" | "ORIENT" | "TIMES"
            | "RPM" | "SPINDL" | "TLANGL" => {}
            _ => bare.push(value),
        }
        if !keeps_governing(&word) {
            word = String::new();
        }
    }
    // Forms by position: CATIA depth,clearance; ISO depth,feed,clearance; CLT depth ...
    // feed,clearance,retract,retract.
    let mut bare = bare.into_iter();
    let positional = cycle.depth.is_none();
    cycle.depth = cycle.depth.or_else(|| bare.next());
    if let Some(rapid) = rapid_to {
        match bare.next().filter(|_| positional) {
            // In ISO, RAPTO counts down from the clearance, to which the tool also returns.
            Some(clearance) => {
                cycle.clearance = Some((clearance - rapid).max(0.0));
                cycle.retract = cycle.retract.or(Some(clearance));
            }
            None => cycle.clearance = Some(rapid),
        }
    }
    cycle.clearance = cycle.clearance.or_else(|| bare.next());
    cycle.retract = cycle.retract.or_else(|| bare.next());
    if returns_to_clearance {
        (cycle.retract, cycle.retract_is_auto) = (None, true);
    }
    Ok(cycle)
}

impl DrillingCycle {
    /// Returns the cycle in force after this record, given the one before.
    pub(crate) fn inherit_from(&self, before: Option<&Self>) -> Self {
        let Some(before) = before.filter(|_| self.changes) else { return self.clone() };
        let new_depth = self.depth.is_some();
        let old_retract = before.retract.filter(|_| !self.retract_is_auto);
        Self {
            kind: before.kind,
            cuts_thread: before.cuts_thread,
            depth: self.depth.or(before.depth),
            depth_is_fedto: if new_depth { self.depth_is_fedto } else { before.depth_is_fedto },
            clearance: self.clearance.or(before.clearance),
            retract: self.retract.or(old_retract),
            retract_is_auto: self.retract_is_auto || (self.retract.is_none() && before.retract_is_auto),
            feed: self.feed.or(before.feed),
            pitch: self.pitch.or(before.pitch),
            dwell: self.dwell.or(before.dwell),
            changes: false,
        }
    }
}

/// Returns whether a word governs more than one number. CLT writes two numbers after PECKING.
fn keeps_governing(word: &str) -> bool {
    word == "PECKING"
}

/// Returns the roles of the numbers of a cycle.
pub(super) fn number_roles(syntax: &StatementSyntax<'_>) -> Vec<NumberRole> {
    let mut roles = Vec::new();
    let mut word = String::new();
    for item in collect_cycle_items(syntax) {
        match item {
            CycleItem::Word(next) => word = next,
            CycleItem::Number(_) => {
                roles.push(match word.as_str() {
                    unit if FeedUnit::from_word(unit).is_some() => NumberRole::Feed,
                    // Times, counts, speeds and angles do not depend on the unit of length. Neither do
                    // threads per inch.
                    "DWELL" | "TIMES" | "REV" | "SPINDL" | "RPM" | "TPI" | "TLANGL" | "ORIENT" => {
                        NumberRole::Plain
                    }
                    _ => NumberRole::Length,
                });
                if !keeps_governing(&word) {
                    word = String::new();
                }
            }
        }
    }
    roles
}
