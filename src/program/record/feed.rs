//! This module reads feeds, spindles and cutter compensation.

use super::{BadRecord, NumberRole, Record, RecordReading, bad_record, wrong_count};
use crate::program::syntax::{FieldKind, StatementSyntax, fold_text};
use crate::program::units::{Feed, FeedUnit};
use std::ops::Range;

/// Metres in a foot.
const METRES_PER_FOOT: f64 = 0.3048;

/// The direction of the spindle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpindleDirection {
    /// Clockwise, seen from the holder down to the work: `CLW`.
    Clockwise,
    /// Counter-clockwise: `CCLW`.
    CounterClockwise,
}

impl SpindleDirection {
    /// Returns 1 for clockwise and -1 for counter-clockwise: the sense of what mirrors with the spindle.
    pub(crate) fn sense(self) -> f64 {
        match self {
            Self::Clockwise => 1.0,
            Self::CounterClockwise => -1.0,
        }
    }
}

/// The unit of a spindle speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum SpindleUnit {
    /// `RPM`, also if no unit is given.
    RevolutionsPerMinute,
    /// `SFM`: feet (in metric files, metres) of surface per minute.
    SurfaceFeet,
    /// `SMM`: metres of surface per minute.
    SurfaceMetres,
}

/// A `SPINDL/` record.
#[derive(Debug, Clone, PartialEq)]
pub struct Spindle {
    /// Whether the spindle turns after the record.
    pub on: bool,
    /// The speed in `unit`, if the record gives one.
    pub speed: Option<f64>,
    /// The unit of the speed.
    pub unit: SpindleUnit,
    /// The direction, if the record gives one.
    pub direction: Option<SpindleDirection>,
    /// The highest speed in rev/min that a surface speed may make, if the record gives one: `MAXRPM`.
    pub max_rpm: Option<f64>,
}

impl Spindle {
    /// Returns the spindle in force after this record. Values that the record does not give (`SPINDL/ON`,
    /// `SPINDL/CCLW`) stay as before.
    pub(crate) fn inherit_from(&self, before: Option<&Self>) -> Self {
        let mut spindle = self.clone();
        let Some(before) = before else { return spindle };
        if spindle.speed.is_none() {
            (spindle.speed, spindle.unit) = (before.speed, before.unit);
        }
        spindle.direction = spindle.direction.or(before.direction);
        spindle.max_rpm = spindle.max_rpm.or(before.max_rpm);
        spindle
    }

    /// Returns the spindle in force after a record that only limits its speed. It turns as before.
    pub(crate) fn limit_speed(before: Option<&Self>, max_rpm: f64) -> Self {
        let unit = SpindleUnit::RevolutionsPerMinute;
        let at_rest = Self { on: false, speed: None, unit, direction: None, max_rpm: None };
        Self { max_rpm: Some(max_rpm), ..before.cloned().unwrap_or(at_rest) }
    }

    /// Returns the surface speed in m/min; `None` for a speed in rev/min.
    pub fn surface_metres(&self) -> Option<f64> {
        match self.unit {
            SpindleUnit::RevolutionsPerMinute => None,
            SpindleUnit::SurfaceMetres => self.speed,
            SpindleUnit::SurfaceFeet => self.speed.map(|feet| feet * METRES_PER_FOOT),
        }
    }
}

/// The side of cutter compensation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CompensationSide {
    /// The tool is to the left of the programmed path: `LEFT`.
    Left,
    /// The tool is to the right of it: `RIGHT`.
    Right,
}

/// A `CUTCOM/` record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CutterCompensation {
    /// `CUTCOM/LEFT` or `RIGHT`, perhaps with a plane.
    On(CompensationSide),
    /// `CUTCOM/ON`: the side follows later (CLT).
    Armed,
    /// `CUTCOM/OFF`: compensation ends.
    Off,
}

/// Reads a record of this family.
pub(super) fn read_record(major: &str, syntax: &StatementSyntax<'_>) -> RecordReading {
    Some(match major {
        "FEDRAT" => read_feed(syntax),
        "SPINDL" => read_spindle(syntax),
        "CUTCOM" => read_cutter_compensation(syntax),
        _ => return None,
    })
}

/// Reads a FEDRAT.
fn read_feed(syntax: &StatementSyntax<'_>) -> Result<Record, BadRecord> {
    let mut value = None;
    let mut unit = None;
    let mut other = false;
    for field in &syntax.fields {
        match &field.kind {
            // The first number and the first unit count, whatever their order: dialects print them in both
            // orders.
            FieldKind::Number(number) => value = value.or(Some(*number)),
            FieldKind::Text => {
                let word = fold_text(syntax.bytes_at(&field.at));
                match FeedUnit::from_word(&word) {
                    Some(found) => unit = unit.or(Some(found)),
                    None if looks_numeric(&word) => {
                        return Err(BadRecord {
                            at: field.at.clone(),
                            problem: format!("`{word}` is not a number"),
                            is_number: true,
                        });
                    }
                    None => other = true,
                }
            }
            _ => {}
        }
    }
    // FEDRAT/RAPID, FEDRAT/AUTO, FEDRAT/100,FPM and the like belong to a post and set no feed that is known
    // here. After a known unit, a further word (FEDRAT/100,MMPM,LOCK) does not change the feed.
    if other && (value.is_none() || unit.is_none()) {
        return Ok(Record::Known);
    }
    let Some(value) = value else {
        return Err(wrong_count("FEDRAT", syntax, "a number, with or without a unit", 0));
    };
    if value < 0.0 {
        return Err(bad_record(first_number_range(syntax), "a feed cannot be negative"));
    }
    Ok(Record::Feed(Feed { value, unit }))
}

/// Returns the place of the first number, or that of the word.
fn first_number_range(syntax: &StatementSyntax<'_>) -> Range<usize> {
    syntax.numbers().first().map_or(syntax.word.clone(), |(at, _)| at.clone())
}

/// Finds the number behind a letter, as controls write it: `F300` in a shop's own word for a feed.
pub(crate) fn find_lettered_number(syntax: &StatementSyntax<'_>) -> Option<(Range<usize>, f64)> {
    syntax.fields.iter().filter(|field| field.kind == FieldKind::Text).find_map(|field| {
        let [letter, number @ ..] = syntax.bytes_at(&field.at) else { return None };
        let value = letter.is_ascii_alphabetic().then(|| crate::number::parse_number(number)).flatten()?;
        Some((field.at.start + 1..field.at.end, value))
    })
}

/// Reads a shop's own word for a feed whose number stands behind a letter.
pub(super) fn read_lettered_feed(syntax: &StatementSyntax<'_>) -> Option<Record> {
    let (_, value) = find_lettered_number(syntax).filter(|(_, value)| *value >= 0.0)?;
    let unit = (0..syntax.fields.len()).find_map(|at| FeedUnit::from_word(&syntax.word_at(at)?));
    Some(Record::Feed(Feed { value, unit }))
}

/// Returns whether a word can only be a mistyped number: `1O00`, `12.3.4`.
fn looks_numeric(word: &str) -> bool {
    word.starts_with(|first: char| first.is_ascii_digit() || matches!(first, '.' | '-' | '+'))
}

/// Reads a SPINDL.
fn read_spindle(syntax: &StatementSyntax<'_>) -> Result<Record, BadRecord> {
    let mut spindle = Spindle {
        on: true,
        speed: None,
        unit: SpindleUnit::RevolutionsPerMinute,
        direction: None,
        max_rpm: None,
    };
    let mut limits = false;
    let mut switched = false;
    for field in &syntax.fields {
        match &field.kind {
            FieldKind::Number(number) if limits => {
                spindle.max_rpm = Some(*number).filter(|max| *max > 0.0);
                limits = false;
            }
            FieldKind::Number(number) => spindle.speed = spindle.speed.or(Some(*number)),
            FieldKind::Text => match fold_text(syntax.bytes_at(&field.at)).as_ref() {
                "OFF" => (spindle.on, switched) = (false, true),
                "ON" => switched = true,
                "RPM" => spindle.unit = SpindleUnit::RevolutionsPerMinute,
                "SFM" => spindle.unit = SpindleUnit::SurfaceFeet,
                "SMM" => spindle.unit = SpindleUnit::SurfaceMetres,
                "CLW" => spindle.direction = Some(SpindleDirection::Clockwise),
                "CCLW" => spindle.direction = Some(SpindleDirection::CounterClockwise),
                // The number of SPINDL/ORIENT,90 is an angle; read as a speed, it would be changed as one.
                "ORIENT" => return Ok(Record::Known),
                // The number behind MAXRPM limits what a surface speed makes, and is no speed itself.
                "MAXRPM" => limits = true,
                word if looks_numeric(word) => {
                    return Err(BadRecord {
                        at: field.at.clone(),
                        problem: format!("`{word}` is not a number"),
                        is_number: true,
                    });
                }
                _ => {}
            },
            _ => {}
        }
    }
    match spindle.max_rpm {
        Some(max_rpm) if spindle.speed.is_none() && spindle.direction.is_none() && !switched => {
            Ok(Record::SpindleLimit(max_rpm))
        }
        _ => Ok(Record::Spindle(Box::new(spindle))),
    }
}

/// Returns the index of the speed among the numbers of a SPINDL: the first one that is no limit.
pub(crate) fn speed_number_index(syntax: &StatementSyntax<'_>) -> Option<usize> {
    let (mut limits, mut index) = (false, 0);
    for field in &syntax.fields {
        match &field.kind {
            FieldKind::Text => limits |= fold_text(syntax.bytes_at(&field.at)) == "MAXRPM",
            FieldKind::Number(_) if !limits => return Some(index),
            FieldKind::Number(_) => (limits, index) = (false, index + 1),
            _ => {}
        }
    }
    None
}

/// Reads a CUTCOM.
fn read_cutter_compensation(syntax: &StatementSyntax<'_>) -> Result<Record, BadRecord> {
    Ok(Record::CutterCompensation(match syntax.word_at(0).as_deref() {
        Some("LEFT") => CutterCompensation::On(CompensationSide::Left),
        Some("RIGHT") => CutterCompensation::On(CompensationSide::Right),
        Some("ON") => CutterCompensation::Armed,
        Some("OFF") => CutterCompensation::Off,
        // CUTCOM/ADJUST, CUTCOM/NORMAL, CUTCOM/n and the like belong to a post.
        _ => return Ok(Record::Known),
    }))
}

/// Returns the roles of the numbers of a feed or a spindle.
pub(super) fn number_roles(record: &Record, syntax: &StatementSyntax<'_>) -> Vec<NumberRole> {
    if let Record::CutterCompensation(_) = record {
        return super::role::roles_by_word(syntax, |word| word == "OFFSET");
    }
    let surface =
        matches!(record, Record::Spindle(spindle) if spindle.unit != SpindleUnit::RevolutionsPerMinute);
    let (index, role) = match record {
        Record::Feed(_) => (Some(0), NumberRole::Feed),
        _ if surface => (speed_number_index(syntax), NumberRole::SurfaceSpeed),
        _ => (None, NumberRole::Plain),
    };
    let mut roles = match record {
        // The radius at which a lathe's surface speed begins: SPINDL/SMM,150,CLW,RADIUS,40.
        Record::Spindle(_) => super::role::roles_by_word(syntax, |word| word == "RADIUS"),
        _ => vec![NumberRole::Plain; syntax.count_numbers()],
    };
    if let Some(main) = index.and_then(|index| roles.get_mut(index)) {
        *main = role;
    }
    roles
}
