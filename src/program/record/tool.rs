//! This module reads tools: their numbers, shapes and axis.

use super::{BadRecord, NumberRole, Record, RecordReading, path, read_all_numbers, wrong_count};
use crate::program::syntax::{FieldKind, StatementKind, StatementSyntax};

/// The word that described a tool's shape, on which the meaning of its numbers depends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ToolWord {
    /// NX `TLDATA/MILL,D,corner radius,length,taper,tip`.
    TlDataMill,
    /// NX `TLDATA/DRILL[,MILL],D,corner radius,length,point angle,flute length`.
    TlDataDrill,
    /// NX `TLDATA/` of another kind (TURN, WEDM, ...): it is kept, but gives no shape.
    TlDataOther,
    /// `CUTTER/d[,r,e,f,a,b,h]`, the seven parameters of the standard.
    Cutter,
    /// `CUTTER/d` in a comment of Creo: the diameter.
    CreoCutter,
}

/// The shape of a tool as far as the CL data gives it; lengths are in the file's unit.
#[derive(Debug, Clone, PartialEq)]
pub struct ToolData {
    /// The word of the record.
    pub word: ToolWord,
    /// The diameter (for a lathe tool, that of its nose).
    pub diameter: Option<f64>,
    /// The corner radius.
    pub corner_radius: Option<f64>,
    /// The length below the holder.
    pub length: Option<f64>,
    /// The taper of the flank against the axis, degrees.
    pub taper_degrees: Option<f64>,
    /// The angle of the tip, degrees: for a drill the full point angle, for a mill the angle of its bottom
    /// against the plane.
    pub tip_degrees: Option<f64>,
    /// The length of the flutes.
    pub flute_length: Option<f64>,
}

/// A call of a tool by its number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ToolCall {
    /// The number of the tool.
    pub number: u32,
    /// Whether the record loads the tool (`LOAD/TOOL`, `LOADTL`, `TURRET`) or only names it (`TOOLNO`).
    pub loads: bool,
}

/// Reads a record of this family.
pub(super) fn read_record(major: &str, syntax: &StatementSyntax<'_>) -> RecordReading {
    Some(match major {
        "TLDATA" => read_tl_data(syntax),
        "CUTTER" => read_cutter(syntax),
        "LOADTL" => read_tool_call(major, syntax, 0, true),
        "TOOLNO" => read_tool_call(major, syntax, 0, false),
        // This is the form of CATIA's lathe tools: TURRET/1,OSETNO,1,SETOOL,...
        "TURRET" => read_tool_call(major, syntax, 0, true),
        "LOAD" if syntax.word_at(0).as_deref() == Some("TOOL") => read_tool_call(major, syntax, 1, true),
        "TLAXIS" => read_tool_axis(major, syntax),
        "MULTAX" => Ok(Record::MultiAxis(syntax.word_at(0).as_deref() != Some("OFF"))),
        _ => return None,
    })
}

/// Reads the number of a tool in the field `at`.
fn read_tool_call(
    major: &str,
    syntax: &StatementSyntax<'_>,
    at: usize,
    loads: bool,
) -> Result<Record, BadRecord> {
    match syntax.number_at(at) {
        Some(number) if number.fract() == 0.0 && (0.0..1e9).contains(&number) => {
            Ok(Record::ToolCall(ToolCall { number: number as u32, loads }))
        }
        Some(_) => Err(wrong_count(major, syntax, "a whole tool number", 1)),
        // LOADTL/NOMORE and TOOLNO/'name' have a name or a word of a post.
        None => Ok(Record::Known),
    }
}

/// Reads NX's TLDATA.
fn read_tl_data(syntax: &StatementSyntax<'_>) -> Result<Record, BadRecord> {
    let words = syntax.fields.iter().take_while(|field| matches!(field.kind, FieldKind::Text)).count();
    let rest: Option<Vec<f64>> = syntax.fields.iter().skip(words).map(|field| field.number_value()).collect();
    let word = match (syntax.word_at(0).as_deref(), &rest) {
        (Some("MILL"), Some(rest)) if rest.len() >= 3 => ToolWord::TlDataMill,
        (Some("DRILL"), Some(rest)) if rest.len() >= 3 => ToolWord::TlDataDrill,
        (Some("MILL" | "DRILL"), Some(rest)) => {
            return Err(wrong_count(
                "TLDATA",
                syntax,
                "a diameter, a corner radius and a length at least",
                rest.len(),
            ));
        }
        _ => ToolWord::TlDataOther,
    };
    let rest = rest.unwrap_or_default();
    let at = |index: usize| rest.get(index).copied();
    let known = word != ToolWord::TlDataOther;
    let drill = word == ToolWord::TlDataDrill;
    Ok(Record::ToolData(Box::new(ToolData {
        word,
        diameter: at(0).filter(|_| known),
        corner_radius: at(1).filter(|_| known),
        length: at(2).filter(|_| known),
        taper_degrees: at(3).filter(|_| word == ToolWord::TlDataMill),
        tip_degrees: if drill { at(3) } else { at(4).filter(|_| known) },
        flute_length: at(4).filter(|_| drill),
    })))
}

/// Reads a CUTTER.
fn read_cutter(syntax: &StatementSyntax<'_>) -> Result<Record, BadRecord> {
    // CUTTER/OPTION,... and the like give no shape.
    if syntax.word_at(0).is_some_and(|word| !word.starts_with(|first: char| first.is_ascii_digit())) {
        return Ok(Record::Known);
    }
    let numbers = read_all_numbers(syntax)?;
    let at = |index: usize| numbers.get(index).copied();
    if at(0).is_none() {
        return Err(wrong_count("CUTTER", syntax, "a diameter, or seven numbers", 0));
    }
    let word = if syntax.form == StatementKind::Structured { ToolWord::CreoCutter } else { ToolWord::Cutter };
    Ok(Record::ToolData(Box::new(ToolData {
        word,
        diameter: at(0),
        corner_radius: at(1),
        length: at(6),
        taper_degrees: at(5),
        // The standard's alpha is the angle of the bottom against the plane: 31 for a drill of 118 degrees.
        tip_degrees: at(4),
        flute_length: None,
    })))
}

/// Reads a TLAXIS.
fn read_tool_axis(major: &str, syntax: &StatementSyntax<'_>) -> Result<Record, BadRecord> {
    // TLAXIS/NORMPS and TLAXIS/OFF are words of part programs and posts.
    if syntax.word_at(0).is_some_and(|word| word.starts_with(|first: char| first.is_ascii_alphabetic())) {
        return Ok(Record::Known);
    }
    match path::read_vector(major, syntax)? {
        axis if super::has_direction(&axis) => Ok(Record::ToolAxis(Box::new(axis))),
        _ => Err(super::bad_record(path::vector_range(syntax, 0), "the tool axis has no direction")),
    }
}

/// Returns the roles of the numbers of this family.
pub(super) fn number_roles(record: &Record, syntax: &StatementSyntax<'_>) -> Vec<NumberRole> {
    let count = syntax.count_numbers();
    match record {
        Record::ToolAxis(_) => {
            vec![NumberRole::Direction(0), NumberRole::Direction(1), NumberRole::Direction(2)]
        }
        Record::ToolData(data) => (0..count).map(|index| tool_number_role(data.word, index)).collect(),
        // TOOLNO/2,10.0 (CATIA) has the number and the diameter; its long forms mix angles, feeds and
        // lengths.
        Record::ToolCall(call) if !call.loads && count == 2 => vec![NumberRole::Plain, NumberRole::Length],
        // The length of the tool, and the place of its tip in a lathe's turret.
        Record::ToolCall(call) if call.loads => {
            let is_length = |word: &str| matches!(word, "LENGTH" | "SETOOL" | "XOFF" | "YOFF" | "ZOFF");
            super::role::roles_by_word(syntax, is_length)
        }
        _ => vec![NumberRole::Plain; count],
    }
}

/// Returns the role of a number in a tool's shape.
fn tool_number_role(word: ToolWord, index: usize) -> NumberRole {
    let length = match word {
        ToolWord::TlDataMill => index <= 2,
        ToolWord::TlDataDrill => index != 3,
        ToolWord::Cutter => matches!(index, 0..=3 | 6),
        ToolWord::CreoCutter => true,
        ToolWord::TlDataOther => false,
    };
    if length { NumberRole::Length } else { NumberRole::Plain }
}
