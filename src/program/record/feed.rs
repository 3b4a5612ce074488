//! This module reads feeds, spindles and cutter compensation.

use super::{BadRecord, NumberRole, Record, RecordReading, bad_record, wrong_count};
use crate::program::syntax::{FieldKind, StatementSyntax, fold_text};
use crate::program::units::{Feed, FeedUnit};

/// The direction of the spindle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpindleDirection {
    /// Clockwise, seen from the holder down to the work: `CLW`.
    Clockwise,
    /// Counter-clockwise: `CCLW`.
    CounterClockwise,
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
        spindle
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

/// The cutting of a thread with a turning tool, whose feed is its pitch times the spindle speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Threading {
    /// `PITCH/`: the pitch of the threads that follow, in the file's unit per revolution.
    Pitch(f64),
    /// `THREAD/TURN` and the like: the motions that follow cut a thread.
    On,
    /// `THREAD/OFF`: they no longer do.
    Off,
}

/// Reads a record of this family.
pub(super) fn read_record(major: &str, syntax: &StatementSyntax<'_>) -> RecordReading {
    Some(match major {
        "PITCH" => Ok(match syntax.fields.as_slice() {
            // PITCH/TPI,8 and the like give threads in another way; only their post knows it.
            [field] if field.number_value().is_some_and(|pitch| pitch > 0.0) => {
                Record::Threading(Threading::Pitch(field.number_value().unwrap_or_default()))
            }
            _ => Record::Known,
        }),
        "THREAD" => Ok(Record::Threading(match syntax.word_at(0).as_deref() {
            Some("OFF" | "NOMORE") => Threading::Off,
            _ => Threading::On,
        })),
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
fn first_number_range(syntax: &StatementSyntax<'_>) -> std::ops::Range<usize> {
    syntax.numbers().first().map_or(syntax.word.clone(), |(at, _)| at.clone())
}

/// Returns whether a word can only be a mistyped number: `1O00`, `12.3.4`.
fn looks_numeric(word: &str) -> bool {
    word.starts_with(|first: char| first.is_ascii_digit() || matches!(first, '.' | '-' | '+'))
}

/// Reads a SPINDL.
fn read_spindle(syntax: &StatementSyntax<'_>) -> Result<Record, BadRecord> {
    let mut spindle =
        Spindle { on: true, speed: None, unit: SpindleUnit::RevolutionsPerMinute, direction: None };
    for field in &syntax.fields {
        match &field.kind {
            FieldKind::Number(number) => spindle.speed = spindle.speed.or(Some(*number)),
            FieldKind::Text => match fold_text(syntax.bytes_at(&field.at)).as_ref() {
                "OFF" => spindle.on = false,
                "RPM" => spindle.unit = SpindleUnit::RevolutionsPerMinute,
                "SFM" => spindle.unit = SpindleUnit::SurfaceFeet,
                "SMM" => spindle.unit = SpindleUnit::SurfaceMetres,
                "CLW" => spindle.direction = Some(SpindleDirection::Clockwise),
                "CCLW" => spindle.direction = Some(SpindleDirection::CounterClockwise),
                // The number of SPINDL/ORIENT,90 is an angle, and one behind MAXRPM only limits what a surface
                // speed makes; read as speeds, both would be changed as speeds.
                "ORIENT" => return Ok(Record::Known),
                "MAXRPM" if spindle.speed.is_none() => return Ok(Record::Known),
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
    Ok(Record::Spindle(Box::new(spindle)))
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
    if let Record::Threading(Threading::On) = record {
        return super::role::roles_by_word(syntax, |word| matches!(word, "PITCH" | "LEAD" | "INCR"));
    }
    let surface =
        matches!(record, Record::Spindle(spindle) if spindle.unit != SpindleUnit::RevolutionsPerMinute);
    let first = match record {
        Record::Feed(_) => NumberRole::Feed,
        Record::Threading(Threading::Pitch(_)) => NumberRole::Length,
        _ if surface => NumberRole::SurfaceSpeed,
        _ => NumberRole::Plain,
    };
    let count = syntax.count_numbers();
    (0..count).map(|index| if index == 0 { first } else { NumberRole::Plain }).collect()
}
