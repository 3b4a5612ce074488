//! This module reads the structure of a program: operations, units, text, marks of motion classes, and words
//! without effect.

use super::{BadRecord, NumberRole, Record, RecordReading, bad_record};
use crate::program::motion_class::MotionClass;
use crate::program::syntax::{StatementKind, StatementSyntax, fold_text};
use crate::program::units::LengthUnit;
use std::ops::Range;

/// The places of an operation's and its tool's names in a statement's text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OperationNames {
    /// The place of the operation's name.
    pub name: Box<Range<usize>>,
    /// The place of the tool's name, if the record has one.
    pub tool: Option<Box<Range<usize>>>,
}

/// A mark in the file that gives the class of the motions that follow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MotionMark {
    /// The class; `None` ends the mark.
    pub class: Option<MotionClass>,
}

/// Reads a record of this family.
pub(super) fn read_record(major: &str, syntax: &StatementSyntax<'_>) -> RecordReading {
    Some(Ok(match major {
        "PAINT" => read_paint(syntax),
        "CHANNEL" | "HEAD" => read_channel(syntax),
        // TURRET/FRONT without a tool; with one, it is a tool change that names its turret.
        "TURRET" if syntax.count_numbers() == 0 => read_channel(syntax),
        "TOOL PATH" if !syntax.fields.is_empty() => read_listed_name(syntax),
        "MOVE_ATTRIB" => read_move_attribute(syntax),
        "END-OF-PATH" => Record::OperationEnd,
        "FEATNO" if syntax.form == StatementKind::Structured => read_feature_start(syntax),
        "END" if syntax.form == StatementKind::Structured => Record::OperationEnd,
        "UNITS" | "UNIT" => return Some(read_units(syntax)),
        "FINI" | "END" => Record::ProgramEnd,
        _ if is_known_word(major) => Record::Known,
        _ if syntax.form == StatementKind::Structured => Record::Comment,
        _ => return None,
    }))
}

/// Reads `TOOL PATH/name,TOOL,tool`.
pub(super) fn read_tool_path(syntax: &StatementSyntax<'_>) -> Record {
    let at = |index: usize| syntax.fields.get(index).map(|field| Box::new(field.at.clone()));
    Record::OperationStart(OperationNames { name: at(0).unwrap_or_default(), tool: at(1) })
}

/// Reads `TOOL PATH/name` whose name holds commas: no tool follows (wire EDM).
fn read_listed_name(syntax: &StatementSyntax<'_>) -> Record {
    let start = syntax.fields.first().map_or(0, |field| field.at.start);
    let end = syntax.fields.last().map_or(start, |field| field.at.end);
    Record::OperationStart(OperationNames { name: Box::new(start..end), tool: None })
}

/// Reads Creo's FEATNO, which starts an operation.
fn read_feature_start(syntax: &StatementSyntax<'_>) -> Record {
    let at = syntax.fields.first().map(|field| field.at.clone()).unwrap_or_default();
    Record::OperationStart(OperationNames { name: Box::new(at), tool: None })
}

/// Reads a comment. `$$ OPERATION NAME : X` (CATIA) starts an operation. The words before the colon are
/// English in every language that was measured, unlike the `Start generation of` line after it.
pub(super) fn read_comment(syntax: &StatementSyntax<'_>) -> Record {
    const MARK: &[u8] = b"$$ OPERATION NAME : ";
    let Some(rest) = syntax.text.strip_prefix(MARK) else { return Record::Comment };
    let length = rest.iter().position(|byte| matches!(byte, b'\r' | b'\n')).unwrap_or(rest.len());
    let name = MARK.len()..MARK.len() + length;
    Record::OperationStart(OperationNames { name: Box::new(name), tool: None })
}

/// Reads a record whose rest is text for people. Some of these texts mark operations or motions.
pub(super) fn read_free_text(syntax: &StatementSyntax<'_>) -> Record {
    let major = syntax.major_word();
    let Some(field) = syntax.fields.first() else { return Record::Text };
    match major.as_ref() {
        "END" => Record::ProgramEnd,
        // Of the known words only those that move nothing come here, with a text that fits no other form.
        word if is_known_word(word) => Record::Known,
        "OPFEATSTART" => {
            Record::OperationStart(OperationNames { name: Box::new(field.at.clone()), tool: None })
        }
        "OPFEATEND" => Record::OperationEnd,
        "PPRINT" => read_makino_motion(&fold_text(syntax.bytes_at(&field.at))),
        _ => Record::Text,
    }
}

/// Reads the labels of motions that Makino FF writes in PPRINT: `MOTION,CUTIN,TYPE,VERTICAL-INFEED`.
fn read_makino_motion(text: &str) -> Record {
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
    Record::Marked(MotionMark { class: Some(class) })
}

/// Reads the colours with which NX marks motion classes (measured from the motions that follow each): 186
/// start and rapid, 211 rapid, 42 engage, 31 cut, 36 step-over, 37 retract.
fn read_paint(syntax: &StatementSyntax<'_>) -> Record {
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
    Record::Marked(MotionMark { class })
}

/// Reads a word with numbers behind a comma, in place of a slash. Words of the standard do not have that form, so
/// only those that are known to have it mean something.
pub(super) fn read_comma_record(major: &str, syntax: &StatementSyntax<'_>) -> Record {
    match major {
        "CHANNEL" => read_channel(syntax),
        _ => Record::Other,
    }
}

/// The channels of turrets that are named by their place. Files number their channels from 1.
const NAMED_TURRETS: &[(&str, u32)] = &[("FRONT", 1), ("REAR", 2)];

/// Returns the channel of the turret that a statement names by its place.
pub(super) fn find_named_turret(syntax: &StatementSyntax<'_>) -> Option<u32> {
    (0..syntax.fields.len()).find_map(|at| {
        let word = syntax.word_at(at)?;
        NAMED_TURRETS.iter().find(|(name, _)| *name == word).map(|(_, channel)| *channel)
    })
}

/// Reads the number of a channel, or the place of its turret; anything else is passed on.
pub(super) fn read_channel(syntax: &StatementSyntax<'_>) -> Record {
    if let Some(channel) = find_named_turret(syntax) {
        return Record::Channel(channel);
    }
    match syntax.number_at(0) {
        Some(channel)
            if channel.fract() == 0.0 && (0.0..1e6).contains(&channel) && syntax.fields.len() == 1 =>
        {
            Record::Channel(channel as u32)
        }
        _ => Record::Known,
    }
}

/// Reads the marks of CLT: `MOVE_ATTRIB/ LEADIN,END_ATTRIB`.
fn read_move_attribute(syntax: &StatementSyntax<'_>) -> Record {
    let class = match syntax.word_at(0).as_deref() {
        Some("LEADIN") => Some(MotionClass::Engage),
        Some("LEADOUT") => Some(MotionClass::Retract),
        _ => None,
    };
    Record::Marked(MotionMark { class })
}

/// Reads the unit of lengths.
fn read_units(syntax: &StatementSyntax<'_>) -> Result<Record, BadRecord> {
    match syntax.word_at(0).as_deref() {
        Some("MM" | "MILLIM" | "MILLIMETER" | "MILLIMETERS" | "METRIC") => Ok(Record::Units(LengthUnit::Mm)),
        Some("INCHES" | "INCH" | "IN") => Ok(Record::Units(LengthUnit::Inch)),
        _ => Err(bad_record(syntax.word.clone(), "the unit is neither MM nor INCHES")),
    }
}

/// The words of the standard and of the measured dialects that are known to have no effect on the tool path, sorted.
const KNOWN: &[&str] = &[
    "ARCSLP",
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
    "TMARK",
    "TOOL",
    "TRACUT",
    "TRNTYP",
    "TURRET",
    "VERIFY",
    "WCORN",
];

/// Returns whether a word is known to have no effect on the tool path.
fn is_known_word(major: &str) -> bool {
    KNOWN.binary_search(&major).is_ok()
}

/// Returns the words that are known to have no effect on the tool path, sorted.
pub fn known_words() -> &'static [&'static str] {
    KNOWN
}

/// Returns the roles of numbers in words without effect: tolerances and boxes are lengths, all others are
/// plain.
pub(super) fn number_roles(syntax: &StatementSyntax<'_>) -> Vec<NumberRole> {
    let major = syntax.major_word();
    let numbers = syntax.count_numbers();
    if major == "PSIS" {
        // A plane without its word is its normal and its distance.
        return match (syntax.fields.len(), numbers) {
            (4, 4) => [0, 1, 2].map(NumberRole::Direction).into_iter().chain([NumberRole::Length]).collect(),
            _ => super::axial_arc::nested_roles(syntax, &syntax.fields),
        };
    }
    let role = match major.as_ref() {
        // A plane is its normal and its distance; anything else is a height.
        "CLRSRF" | "CLEARP" | "RETRCT" | "SAFETY" if numbers == 4 => {
            return vec![NumberRole::Plain, NumberRole::Plain, NumberRole::Plain, NumberRole::Length];
        }
        // A slope by its rise (MOVARC's posts) and heights; a CUTCOM's OFFSET is a length, its ADJUST a register.
        "ARCSLP" | "CLRSRF" | "RETRCT" | "SAFETY" => NumberRole::Length,
        "CUTCOM" => return super::role::roles_by_word(syntax, |word| word == "OFFSET"),
        "SELECT" | "SELCTL" => return super::role::roles_by_word(syntax, |word| word == "LENGTH"),
        "BOX"
        | "INTOL"
        | "OUTTOL"
        | "CLEARP"
        | "CSI_SET_EXTENSION_LENGTH"
        | "CSI_SET_FLUTE_LENGTH"
        | "LINTOL" => NumberRole::Length,
        _ => NumberRole::Plain,
    };
    vec![role; numbers]
}

#[cfg(test)]
mod tests {
    #[test]
    fn known_words_are_sorted_for_the_search() {
        assert!(super::KNOWN.is_sorted());
        for word in ["AUTOPS", "COOLNT", "PPWORD", "WCORN", "TRNTYP"] {
            assert!(super::is_known_word(word), "{word}");
        }
    }
}
