//! Feed, spindle and cutter compensation.

use super::{BadRecord, Reading, Record, Role, bad, wrong_count};
use crate::program::syntax::{FieldKind, Syntax, folded};
use crate::program::units::{Feed, FeedUnit};

/// Sense of the spindle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpindleDirection {
    /// `CLW`.
    Clockwise,
    /// `CCLW`.
    CounterClockwise,
}

/// Unit of a spindle speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpindleUnit {
    /// `RPM`, also where no unit stands.
    RevolutionsPerMinute,
    /// `SFM`: feet (or, in metric files, metres) of surface per minute.
    SurfaceFeet,
    /// `SMM`: metres of surface per minute.
    SurfaceMetres,
}

/// `SPINDL/`.
#[derive(Debug, Clone, PartialEq)]
pub struct Spindle {
    /// Whether it turns after the record.
    pub on: bool,
    /// Speed in `unit`, where one stands.
    pub speed: Option<f64>,
    /// Unit of the speed.
    pub unit: SpindleUnit,
    /// Sense, where one stands.
    pub direction: Option<SpindleDirection>,
}

impl Spindle {
    /// The spindle in force after this record: what it does not say (`SPINDL/ON`, `SPINDL/CCLW`) stays as it was before.
    pub(crate) fn after(&self, before: Option<&Self>) -> Self {
        let mut spindle = self.clone();
        let Some(before) = before else { return spindle };
        if spindle.speed.is_none() {
            (spindle.speed, spindle.unit) = (before.speed, before.unit);
        }
        spindle.direction = spindle.direction.or(before.direction);
        spindle
    }
}

/// Side of cutter compensation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// `LEFT`.
    Left,
    /// `RIGHT`.
    Right,
}

/// `CUTCOM/`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CutterCompensation {
    /// `CUTCOM/LEFT` or `RIGHT`, perhaps with a plane.
    On(Side),
    /// `CUTCOM/ON`: the side follows (CLT).
    Armed,
    /// `CUTCOM/OFF`.
    Off,
}

pub(super) fn read(major: &str, syntax: &Syntax<'_>) -> Reading {
    Some(match major {
        "FEDRAT" => feed(syntax),
        "SPINDL" => spindle(syntax),
        "CUTCOM" => cutter_compensation(syntax),
        _ => return None,
    })
}

fn feed(syntax: &Syntax<'_>) -> Result<Record, BadRecord> {
    let mut value = None;
    let mut unit = None;
    let mut other = false;
    for field in &syntax.fields {
        match &field.kind {
            FieldKind::Number(number) => value = value.or(Some(*number)),
            FieldKind::Text => {
                let word = folded(syntax.bytes(&field.at));
                match FeedUnit::of_word(&word) {
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
    // FEDRAT/RAPID, FEDRAT/AUTO, FEDRAT/100,FPM and the like belong to a post; they set no feed we know. Beside a unit we know,
    // a further word (FEDRAT/100,MMPM,LOCK) does not make it another feed.
    if other && (value.is_none() || unit.is_none()) {
        return Ok(Record::Known);
    }
    let Some(value) = value else {
        return Err(wrong_count("FEDRAT", syntax, "a number, with or without a unit", 0));
    };
    if value < 0.0 {
        return Err(bad(first_number(syntax), "a feed cannot be negative"));
    }
    Ok(Record::Feed(Feed { value, unit }))
}

fn first_number(syntax: &Syntax<'_>) -> std::ops::Range<usize> {
    syntax.numbers().first().map_or(syntax.word.clone(), |(at, _)| at.clone())
}

/// A word that can only be a mistyped number: `1O00`, `12.3.4`.
fn looks_numeric(word: &str) -> bool {
    word.starts_with(|first: char| first.is_ascii_digit() || matches!(first, '.' | '-' | '+'))
}

fn spindle(syntax: &Syntax<'_>) -> Result<Record, BadRecord> {
    let mut spindle =
        Spindle { on: true, speed: None, unit: SpindleUnit::RevolutionsPerMinute, direction: None };
    for field in &syntax.fields {
        match &field.kind {
            FieldKind::Number(number) => spindle.speed = spindle.speed.or(Some(*number)),
            FieldKind::Text => match folded(syntax.bytes(&field.at)).as_str() {
                "OFF" => spindle.on = false,
                "RPM" => spindle.unit = SpindleUnit::RevolutionsPerMinute,
                "SFM" => spindle.unit = SpindleUnit::SurfaceFeet,
                "SMM" => spindle.unit = SpindleUnit::SurfaceMetres,
                "CLW" => spindle.direction = Some(SpindleDirection::Clockwise),
                "CCLW" => spindle.direction = Some(SpindleDirection::CounterClockwise),
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

fn cutter_compensation(syntax: &Syntax<'_>) -> Result<Record, BadRecord> {
    Ok(Record::CutterCompensation(match syntax.word_at(0).as_deref() {
        Some("LEFT") => CutterCompensation::On(Side::Left),
        Some("RIGHT") => CutterCompensation::On(Side::Right),
        Some("ON") => CutterCompensation::Armed,
        Some("OFF") => CutterCompensation::Off,
        // CUTCOM/ADJUST, CUTCOM/NORMAL, CUTCOM/n and the like are a post's own.
        _ => return Ok(Record::Known),
    }))
}

pub(super) fn roles(record: &Record, syntax: &Syntax<'_>) -> Vec<Role> {
    let surface =
        matches!(record, Record::Spindle(spindle) if spindle.unit != SpindleUnit::RevolutionsPerMinute);
    let first = match record {
        Record::Feed(_) => Role::Feed,
        _ if surface => Role::SurfaceSpeed,
        _ => Role::Plain,
    };
    let count = syntax.numbers().len();
    (0..count).map(|index| if index == 0 { first } else { Role::Plain }).collect()
}
