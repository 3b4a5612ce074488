//! What gives a program its structure: operations, units, text, marks of motion classes, and words without effect.

use super::{BadRecord, Reading, Record, Role, bad};
use crate::program::class::MotionClass;
use crate::program::syntax::{Form, Syntax, folded};
use crate::program::units::LengthUnit;
use std::ops::Range;

/// Where an operation's and its tool's names stand in a statement's text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StructureName {
    /// The operation's name.
    pub name: Box<Range<usize>>,
    /// The tool's name, where the record has one.
    pub tool: Option<Box<Range<usize>>>,
}

/// A mark in the file that says what kind of motion follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MarkedMotion {
    /// The class; `None` ends the mark.
    pub class: Option<MotionClass>,
}

pub(super) fn read(major: &str, syntax: &Syntax<'_>) -> Reading {
    Some(Ok(match major {
        "PAINT" => paint(syntax),
        "MOVE_ATTRIB" => move_attribute(syntax),
        "END-OF-PATH" => Record::OperationEnd,
        "FEATNO" if syntax.form == Form::Structured => named_by_fields(syntax),
        "END" if syntax.form == Form::Structured => Record::OperationEnd,
        "UNITS" | "UNIT" => return Some(units(syntax)),
        "FINI" | "END" => Record::ProgramEnd,
        _ if is_known(major) => Record::Known,
        _ if syntax.form == Form::Structured => Record::Comment,
        _ => return None,
    }))
}

/// `TOOL PATH/name,TOOL,tool`.
pub(super) fn tool_path(syntax: &Syntax<'_>) -> Record {
    let at = |index: usize| syntax.fields.get(index).map(|field| Box::new(field.at.clone()));
    Record::OperationStart(StructureName { name: at(0).unwrap_or_default(), tool: at(1) })
}

fn named_by_fields(syntax: &Syntax<'_>) -> Record {
    let at = syntax.fields.first().map(|field| field.at.clone()).unwrap_or_default();
    Record::OperationStart(StructureName { name: Box::new(at), tool: None })
}

/// `$$ OPERATION NAME : X` (CATIA) starts an operation; the words before the colon are English in every language measured,
/// unlike the `Start generation of` line after it.
pub(super) fn comment(syntax: &Syntax<'_>) -> Record {
    const MARK: &[u8] = b"$$ OPERATION NAME : ";
    let Some(rest) = syntax.text.strip_prefix(MARK) else { return Record::Comment };
    let length = rest.iter().position(|byte| matches!(byte, b'\r' | b'\n')).unwrap_or(rest.len());
    let name = MARK.len()..MARK.len() + length;
    Record::OperationStart(StructureName { name: Box::new(name), tool: None })
}

pub(super) fn free_text(syntax: &Syntax<'_>) -> Record {
    let Some(field) = syntax.fields.first() else { return Record::Text };
    match syntax.major().as_str() {
        "OPFEATSTART" => {
            Record::OperationStart(StructureName { name: Box::new(field.at.clone()), tool: None })
        }
        "OPFEATEND" => Record::OperationEnd,
        "PPRINT" => makino_motion(&folded(syntax.bytes(&field.at))),
        _ => Record::Text,
    }
}

/// Makino FF labels its motions in PPRINT: `MOTION,CUTIN,TYPE,VERTICAL-INFEED`.
fn makino_motion(text: &str) -> Record {
    let mut words = text.split(',');
    if words.next() != Some("MOTION") {
        return Record::Text;
    }
    let class = match (words.next(), words.next()) {
        (Some("CUTIN"), Some("TYPE")) => MotionClass::Engage,
        (Some("CUT"), Some("TYPE")) => MotionClass::Cut,
        (Some("PICK"), Some("TYPE")) => MotionClass::StepOver,
        (Some("CUTOUT"), Some("TYPE")) => MotionClass::Retract,
        (Some("RAPID"), Some("TYPE")) => MotionClass::Rapid,
        _ => return Record::Text,
    };
    Record::Marked(MarkedMotion { class: Some(class) })
}

/// NX colours mark motion classes (measured over what follows each): 186 start and rapid, 211 rapid, 42 engage, 31 cut,
/// 36 step-over, 37 retract.
fn paint(syntax: &Syntax<'_>) -> Record {
    let (Some("COLOR"), Some(color)) = (syntax.word_at(0).as_deref(), syntax.number_at(1)) else {
        return Record::Known;
    };
    let class = match color as i64 {
        186 => Some(MotionClass::Approach),
        211 => Some(MotionClass::Rapid),
        42 => Some(MotionClass::Engage),
        31 => Some(MotionClass::Cut),
        36 => Some(MotionClass::StepOver),
        37 => Some(MotionClass::Retract),
        _ => None,
    };
    Record::Marked(MarkedMotion { class })
}

/// CLT: `MOVE_ATTRIB/ LEADIN,END_ATTRIB`.
fn move_attribute(syntax: &Syntax<'_>) -> Record {
    let class = match syntax.word_at(0).as_deref() {
        Some("LEADIN") => Some(MotionClass::Engage),
        Some("LEADOUT") => Some(MotionClass::Retract),
        _ => None,
    };
    Record::Marked(MarkedMotion { class })
}

fn units(syntax: &Syntax<'_>) -> Result<Record, BadRecord> {
    match syntax.word_at(0).as_deref() {
        Some("MM" | "MILLIMETERS" | "METRIC") => Ok(Record::Units(LengthUnit::Mm)),
        Some("INCHES" | "INCH" | "IN") => Ok(Record::Units(LengthUnit::Inch)),
        _ => Err(bad(syntax.word.clone(), "the unit is neither MM nor INCHES")),
    }
}

/// Words of the standard and of the measured dialects that do not change the tool path.
fn is_known(major: &str) -> bool {
    const KNOWN: &[&str] = &[
        "AUTOPS",
        "AUXFUN",
        "BOX",
        "BREAK",
        "CHECK",
        "CLAMP",
        "CLEARP",
        "CLRSRF",
        "COOLNT",
        "COUPLE",
        "CSI_SET_EXTENSION_LENGTH",
        "CSI_SET_FLUTE_LENGTH",
        "CUTCOM_GEOMETRY_TYPE",
        "DELAY",
        "DISPLY",
        "FACEMILL",
        "FLUSH",
        "GOCLER",
        "HEAD",
        "INTCOD",
        "INTOL",
        "LEADER",
        "LINTOL",
        "LOAD",
        "LOADTL",
        "MACHIN",
        "MCHTOL",
        "MFGNO",
        "MODE",
        "NOPOST",
        "OFSTNO",
        "OPSKIP",
        "OPSTOP",
        "OUTTOL",
        "OVPLOT",
        "PIVOTZ",
        "PLUNGE",
        "PPFUN",
        "PPWORD",
        "PREFUN",
        "PSIS",
        "RESET",
        "RETRCT",
        "REWIND",
        "SAFETY",
        "SELCTL",
        "SELECT",
        "SEQNO",
        "SET",
        "SETUP",
        "SHIFT",
        "SLOWDN",
        "SMOOTH",
        "STOP",
        "SWITCH",
        "SYN",
        "THREAD",
        "TMARK",
        "TOOL",
        "TRACUT",
        "TRNTYP",
        "TURRET",
        "VERIFY",
        "WCORN",
    ];
    KNOWN.binary_search(&major).is_ok()
}

/// Roles in words without effect: tolerances and boxes are lengths, the rest stays.
pub(super) fn roles(syntax: &Syntax<'_>) -> Vec<Role> {
    let major = syntax.major();
    let numbers = syntax.numbers().len();
    let role = match major.as_str() {
        "BOX"
        | "INTOL"
        | "OUTTOL"
        | "CLEARP"
        | "CSI_SET_EXTENSION_LENGTH"
        | "CSI_SET_FLUTE_LENGTH"
        | "LINTOL" => Role::Length,
        _ => Role::Plain,
    };
    vec![role; numbers]
}

#[cfg(test)]
mod tests {
    #[test]
    fn known_words_are_sorted_for_the_search() {
        for word in ["AUTOPS", "COOLNT", "PPWORD", "WCORN", "TRNTYP"] {
            assert!(super::is_known(word), "{word}");
        }
    }
}
