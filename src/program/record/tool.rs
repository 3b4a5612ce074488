//! This module reads tools: their numbers, shapes and axis.

use super::{BadRecord, NumberRole, Record, RecordReading, path, read_all_numbers, structure, wrong_count};
use crate::program::syntax::{FieldKind, StatementKind, StatementSyntax};

/// The word that described a tool's shape, on which the meaning of its numbers depends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ToolWord {
    /// NX `TLDATA/MILL,D,corner radius,length,taper,tip`, of a cutter of seven or ten parameters with the centres of its
    /// corner radii.
    TlDataMill,
    /// NX `TLDATA/DRILL[,MILL],D,corner radius,length,point angle,flute length`.
    TlDataDrill,
    /// NX `TLDATA/TURN`, `GROOVE` or `THREAD`: a lathe tool.
    TlDataTurn,
    /// NX `TLDATA/` of another kind (WEDM, ...): it is kept, but gives no shape.
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
    /// The diameter (for a lathe tool with a CUTTER, that of its nose).
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
    /// The radius of the nose of a lathe tool.
    pub nose_radius: Option<f64>,
    /// The upper corner radius of a T-slot cutter or lollipop.
    pub upper_corner_radius: Option<f64>,
}

/// A call of a tool by its number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ToolCall {
    /// The number of the tool.
    pub number: u32,
    /// Whether the record loads the tool (`LOAD/TOOL`, `LOADTL`, `TURRET`) or only names it (`TOOLNO`).
    pub loads: bool,
    /// The channel of its turret, if the record names one by its place (`TURRET/3,REAR`).
    pub channel: Option<u32>,
}

/// Reads a record of this family.
pub(super) fn read_record(major: &str, syntax: &StatementSyntax<'_>) -> RecordReading {
    Some(match major {
        "TLDATA" => read_tl_data(syntax),
        "CUTTER" => read_cutter(syntax),
        "LOADTL" => read_tool_call(major, syntax, 0, true),
        "TOOLNO" => read_tool_call(major, syntax, 0, false),
        // This is the form of CATIA's lathe tools: TURRET/1,OSETNO,1,SETOOL,...
        "TURRET" if syntax.count_numbers() == 0 => return None,
        // A turret that is named by its place has the tool behind it: TURRET/FRONT,3.
        "TURRET" => {
            let first = syntax.fields.iter().position(|field| field.number_value().is_some()).unwrap_or(0);
            let at = if structure::find_named_turret(syntax).is_some() { first } else { 0 };
            read_tool_call(major, syntax, at, true)
        }
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
            let channel = if major == "TURRET" { structure::find_named_turret(syntax) } else { None };
            Ok(Record::ToolCall(ToolCall { number: number as u32, loads, channel }))
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
        (Some("TURN" | "GROOVE" | "THREAD"), _) => ToolWord::TlDataTurn,
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
    let known = matches!(word, ToolWord::TlDataMill | ToolWord::TlDataDrill);
    // Ten parameters: behind the angles the centre of the lower corner (r, z), the upper radius and its centre.
    let upper = match rest.as_slice() {
        [_, _, _, _, _, _, _, radius, _, height] if word == ToolWord::TlDataMill && *height > 0.0 => {
            Some((*radius, *height + *radius))
        }
        _ => None,
    };
    let drill = word == ToolWord::TlDataDrill;
    Ok(Record::ToolData(Box::new(ToolData {
        word,
        diameter: at(0).filter(|_| known),
        corner_radius: at(1).filter(|_| known),
        length: at(2).filter(|_| known),
        taper_degrees: at(3).filter(|_| word == ToolWord::TlDataMill),
        tip_degrees: if drill { at(3) } else { at(4).filter(|_| known) },
        flute_length: at(4).filter(|_| drill).or(upper.map(|(_, top)| top)),
        nose_radius: LatheToolForm::from_syntax(syntax).and_then(|form| form.nose_radius(&rest)),
        upper_corner_radius: upper.map(|(radius, _)| radius),
    })))
}

/// The forms of TLDATA for lathe tools whose numbers are documented. Any other count of numbers is another form.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum LatheToolForm {
    /// Orientation, type of work, spindle axis, nose diameter, holder width, lead and heel angle, holder height,
    /// orientation angle.
    Turn,
    /// Orientation, type of work, tracking side, spindle axis, insert width, left and right corner radius, depth, lead
    /// and insert angle, holder height and width.
    Groove,
    /// Orientation, type of work, spindle axis, depth, holder width, relief and heel angle, holder height.
    Thread,
}

impl LatheToolForm {
    fn from_syntax(syntax: &StatementSyntax<'_>) -> Option<Self> {
        match (syntax.word_at(0).as_deref(), syntax.count_numbers(), syntax.fields.len()) {
            (Some("TURN"), 9, 10) => Some(Self::Turn),
            (Some("GROOVE"), 12, 13) => Some(Self::Groove),
            (Some("THREAD"), 8, 9) => Some(Self::Thread),
            _ => None,
        }
    }

    fn nose_radius(self, numbers: &[f64]) -> Option<f64> {
        match (self, numbers) {
            (Self::Turn, [_, _, _, diameter, ..]) => Some(diameter / 2.0),
            (Self::Groove, [_, _, _, _, _, left, right, ..]) if left == right => Some(*left),
            _ => None,
        }
    }

    /// Returns whether a number is a length. The others are codes and angles.
    fn is_length(self, index: usize) -> bool {
        match self {
            Self::Turn => matches!(index, 3 | 4 | 7),
            Self::Groove => matches!(index, 4..=7 | 10 | 11),
            Self::Thread => matches!(index, 3 | 4 | 7),
        }
    }
}

impl ToolWord {
    /// Returns whether a tool's description tells nothing of a milling cutter.
    pub(crate) fn is_no_mill(self) -> bool {
        matches!(self, Self::TlDataTurn | Self::TlDataOther)
    }
}

/// Returns whether a TLDATA has numbers whose meaning is not known.
pub(crate) fn has_unknown_tool_numbers(data: &ToolData, syntax: &StatementSyntax<'_>) -> bool {
    match data.word {
        ToolWord::TlDataOther => true,
        ToolWord::TlDataTurn => LatheToolForm::from_syntax(syntax).is_none(),
        _ => false,
    }
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
        nose_radius: None,
        upper_corner_radius: None,
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
        Record::ToolData(data) if data.word == ToolWord::TlDataTurn => {
            let form = LatheToolForm::from_syntax(syntax);
            let is_length = |index| form.is_some_and(|form| form.is_length(index));
            let role = |index| if is_length(index) { NumberRole::Length } else { NumberRole::Plain };
            (0..count).map(role).collect()
        }
        Record::ToolData(data) => (0..count).map(|index| tool_number_role(data.word, index)).collect(),
        // TOOLNO/2,10.0 (CATIA) has the number and the diameter; its long forms mix angles, feeds and
        // lengths.
        Record::ToolCall(call) if !call.loads && count == 2 => vec![NumberRole::Plain, NumberRole::Length],
        // The post of ISO 4343 has tool, pocket, length and offset.
        Record::ToolCall(call) if call.loads && is_positional_load(syntax) => {
            vec![NumberRole::Plain, NumberRole::Plain, NumberRole::Length, NumberRole::Plain]
        }
        // The length of the tool, and the place of its tip in a lathe's turret.
        Record::ToolCall(call) if call.loads => {
            let is_length = |word: &str| matches!(word, "LENGTH" | "SETOOL" | "XOFF" | "YOFF" | "ZOFF");
            super::role::roles_by_word(syntax, is_length)
        }
        _ => vec![NumberRole::Plain; count],
    }
}

/// Returns whether a statement is `LOADTL/tool, pocket, length, offset`.
fn is_positional_load(syntax: &StatementSyntax<'_>) -> bool {
    syntax.major_word() == "LOADTL" && syntax.fields.len() == 4 && syntax.count_numbers() == 4
}

/// Returns the role of a number in a tool's shape.
fn tool_number_role(word: ToolWord, index: usize) -> NumberRole {
    let length = match word {
        // The taper and the angle of the tip are not; the centres and the upper radius behind them are.
        ToolWord::TlDataMill => !matches!(index, 3 | 4),
        ToolWord::TlDataDrill => index != 3,
        ToolWord::Cutter => matches!(index, 0..=3 | 6),
        ToolWord::CreoCutter => true,
        ToolWord::TlDataTurn | ToolWord::TlDataOther => false,
    };
    if length { NumberRole::Length } else { NumberRole::Plain }
}
