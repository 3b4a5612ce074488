//! This module holds records: the meaning of a statement, read from its [`StatementSyntax`].
//!
//! There is one file for each family of records. Each family reads its records and gives the role of every
//! number ([`NumberRole`]), so that transforms of geometry and units need no list of records of their own. A
//! record is always well formed; a known word with wrong arguments is a [`BadRecord`].

mod axial_arc;
mod cycle;
mod feed;
mod frame;
mod path;
mod role;
mod shop_word;
mod structure;
mod thread;
mod tool;

pub use axial_arc::AxialArc;
pub use cycle::{CycleDwell, CycleKind, DrillingCycle};
pub use feed::{CompensationSide, CutterCompensation, Spindle, SpindleDirection, SpindleUnit};
pub(crate) use feed::{find_lettered_number, speed_number_index};
pub use frame::{FrameRecord, FrameWord};
pub use path::{ArcSense, Circle, DriveArc, Goto, MoveArc};
pub(crate) use path::{
    add_goto_roles as add_path_roles, goto_roles as path_roles, has_contact_normal, has_tool_axes,
};
pub use role::NumberRole;
pub use structure::{MotionMark, OperationNames, known_words};
pub use thread::{StatedPitch, Threading};
pub(crate) use tool::has_unknown_tool_numbers;
pub use tool::{ToolCall, ToolData, ToolWord};

use super::syntax::{StatementKind, StatementSyntax};
use super::units::{Feed, LengthUnit};
use nalgebra::{Point3, Vector3};
use std::ops::Range;

/// The meaning of a statement. A file has one for each of its statements, so rare records are boxed and a
/// test holds the size.
///
/// ```
/// use clsmith::parse::parse;
/// use clsmith::program::Record;
/// use clsmith::source::Source;
///
/// let program = parse(&Source::new("part.cls", b"LOAD/TOOL,3\nGOTO/1,2,3\n".to_vec())?, None).program;
/// let records: Vec<&Record> = program.statements().iter().map(|statement| statement.record()).collect();
/// assert!(matches!(records[0], Record::ToolCall(call) if call.number == 3));
/// assert!(matches!(records[1], Record::Goto(goto) if goto.point.z == 3.0));
/// # Ok::<(), clsmith::source::SourceTooLarge>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Record {
    /// The UTF-8 byte order mark before the first statement.
    ByteOrderMark,
    /// A statement without content.
    Blank,
    /// `$$ ...` without meaning for the tool path.
    Comment,

    /// `GOTO/` with one point, with or without a tool axis.
    Goto(Goto),
    /// `GOTO/` with several points or with a point, axis and contact normal; also lines of bare numbers that
    /// continue it.
    Points(Box<[f64]>),
    /// `FROM/`: the position of the tool.
    From(Box<Goto>),
    /// `GOHOME`, with or without a point.
    GoHome(Option<Box<Goto>>),
    /// `GODLTA/`: a step from the tool's position (a single number is a step along the tool axis).
    GoDelta(Box<[f64]>),
    /// `CIRCLE/`: the next GOTO is the end of an arc.
    Circle(Box<Circle>),
    /// `MOVARC/`: the next GOTO is the end of a right-hand arc of a given angle.
    MoveArc(Box<MoveArc>),
    /// `INDIRV/`: the direction in which the next drive motion starts.
    StartDirection(Box<Vector3<f64>>),
    /// CATIA's `TLON,GOFWD/(CIRCLE/...),ON,(LINE/...)`: an arc with its end in the record.
    DriveArc(Box<DriveArc>),
    /// CATIA's `HELICAL/...`, and `TLON,GOFWD/(CYLNDR/...)`: an arc or helix about any axis with its end in the
    /// record.
    AxialArc(Box<AxialArc>),
    /// `NURBS/`: a spline follows.
    Nurbs,
    /// `KNOT/`: knots of the spline.
    Knot(Box<[f64]>),
    /// `CNTRL/`: a control point; the tool ends at the last one.
    Control(Box<Point3<f64>>),
    /// `RAPID`: the next motion, and only that one, is a rapid.
    Rapid,

    /// `FEDRAT/`: a feed.
    Feed(Feed),
    /// `SPINDL/`: the spindle's speed and direction.
    Spindle(Box<Spindle>),
    /// `SPINDL/MAXRPM,n`: the highest speed in rev/min that a surface speed may make from here on.
    SpindleLimit(f64),
    /// `PITCH/`, `THREAD/`: a thread is cut, at its pitch times the spindle speed.
    Threading(Threading),
    /// `CUTCOM/`: cutter compensation is switched.
    CutterCompensation(CutterCompensation),

    /// `LOAD/TOOL`, `LOADTL/`, `TURRET/`, `TOOLNO/`: a tool by its number.
    ToolCall(ToolCall),
    /// `TLDATA/`, `CUTTER/`, Creo's `$$-> CUTTER`: the shape of the tool.
    ToolData(Box<ToolData>),
    /// `TLAXIS/`: the tool axis.
    ToolAxis(Box<Vector3<f64>>),
    /// `MULTAX`, `MULTAX/ON`, `MULTAX/OFF`: points have tool axes, or no longer have them.
    MultiAxis(bool),

    /// `MSYS/`, `CSYS/`, `CAMERA/`, `TRANS/`, `ORIGIN/`, `ROTABL/`: a frame, or a shift or turn of it.
    Frame(Box<FrameRecord>),
    /// CATIA's `$$*CATIA0`: a matrix follows in comments.
    FrameMark,
    /// `$$` and four numbers: a row of that matrix, if one is expected.
    MatrixRow(Box<[f64; 4]>),

    /// `CYCLE/DRILL,...`: each following GOTO is a hole.
    Cycle(Box<DrillingCycle>),
    /// `CYCLE/ON`: the last cycle is switched on again.
    CycleOn,
    /// `CYCLE/OFF`: the cycle ends.
    CycleOff,

    /// A word that gives the class of the motions that follow (`PAINT/COLOR`, FF's `PPRINT/MOTION`, CLT's
    /// `MOVE_ATTRIB`).
    Marked(MotionMark),
    /// An operation starts; its name is in the text.
    OperationStart(OperationNames),
    /// An operation ends.
    OperationEnd,
    /// `CHANNEL,n`: what follows is the path of another channel of the machine.
    Channel(u32),
    /// `UNITS/`, `UNIT/`: the unit of lengths.
    Units(LengthUnit),
    /// `FINI`, `END`: the program ends.
    ProgramEnd,
    /// Text for people: `PPRINT`, `PARTNO`, `INSERT`, `TPRINT`, `REMARK`.
    Text,

    /// A known word without effect on the tool path (`COOLNT`, `PAINT/PATH`, `INTOL`, ...).
    Known,
    /// A word that clsmith does not know; it is kept and passed on.
    Other,
    /// A statement of an APT part program.
    Definition,
    /// A text that the grammar refused, or a known word with wrong arguments; it is kept and passed on.
    Unparsed,
}

/// The reason why a known word cannot be read as its record, and the bytes of the statement where this is so.
#[derive(Debug, Clone, PartialEq)]
pub struct BadRecord {
    /// The place in the statement's text.
    pub at: Range<usize>,
    /// A description of the problem for people.
    pub problem: String,
    /// Whether a number was expected and something else was found.
    pub is_number: bool,
}

impl Record {
    /// Reads the meaning of a statement.
    ///
    /// # Errors
    /// Returns a [`BadRecord`] for a known word whose arguments do not fit. Refused text is not an error
    /// here; it is [`Record::Unparsed`].
    pub fn read(syntax: &StatementSyntax<'_>) -> Result<Self, BadRecord> {
        match syntax.form {
            StatementKind::Blank => return Ok(Self::Blank),
            StatementKind::Comment => return Ok(structure::read_comment(syntax)),
            StatementKind::FrameMark => return Ok(Self::FrameMark),
            StatementKind::MatrixRow => return Ok(frame::read_matrix_row(syntax)),
            StatementKind::Definition => return Ok(Self::Definition),
            StatementKind::Refused => return Ok(Self::Unparsed),
            StatementKind::OperationStart => return Ok(structure::read_tool_path(syntax)),
            StatementKind::FreeText => return Ok(structure::read_free_text(syntax)),
            StatementKind::Numbers => return path::read_points_line(syntax),
            StatementKind::Structured | StatementKind::Words => {}
        }
        let separator = syntax.text.get(syntax.word.end..).unwrap_or_default().trim_ascii_start().first();
        if separator == Some(&b',') {
            return Ok(structure::read_comma_record(&syntax.major_word(), syntax));
        }
        // A word belongs to at most one family, so the first one that reads it decides.
        let major = syntax.major_word();
        let families = [
            path::read_record,
            feed::read_record,
            thread::read_record,
            tool::read_record,
            frame::read_record,
            cycle::read_record,
            structure::read_record,
        ];
        for family in families {
            if let Some(record) = family(&major, syntax) {
                return record;
            }
        }
        Ok(Self::Other)
    }

    /// Returns the role of each number of a statement, in the order of [`StatementSyntax::numbers`].
    ///
    /// A number whose role is not known is [`NumberRole::Plain`]; transforms never change such numbers.
    pub fn number_roles(&self, syntax: &StatementSyntax<'_>) -> Vec<NumberRole> {
        let count = syntax.count_numbers();
        let mut roles = match self {
            Self::Goto(_)
            | Self::Points(_)
            | Self::From(_)
            | Self::GoHome(_)
            | Self::GoDelta(_)
            | Self::Circle(_)
            | Self::MoveArc(_)
            | Self::StartDirection(_)
            | Self::DriveArc(_)
            | Self::Knot(_)
            | Self::Control(_) => path::number_roles(self, syntax),
            Self::AxialArc(_) => axial_arc::number_roles(syntax),
            Self::Threading(threading) => thread::number_roles(threading, syntax),
            Self::Feed(_) | Self::Spindle(_) | Self::CutterCompensation(_) => {
                feed::number_roles(self, syntax)
            }
            Self::ToolData(_) | Self::ToolAxis(_) | Self::ToolCall(_) => tool::number_roles(self, syntax),
            Self::Frame(_) | Self::MatrixRow(_) => frame::number_roles(self),
            Self::Cycle(_) => cycle::number_roles(syntax),
            Self::Known => structure::number_roles(syntax),
            _ => Vec::new(),
        };
        roles.resize(count, NumberRole::Plain);
        roles
    }

    /// Returns whether the statement moves the tool, or ends a motion that statements before it describe.
    pub fn is_motion(&self) -> bool {
        matches!(
            self,
            Self::Goto(_)
                | Self::Points(_)
                | Self::GoHome(_)
                | Self::GoDelta(_)
                | Self::DriveArc(_)
                | Self::AxialArc(_)
                | Self::Control(_)
        )
    }
}

/// The result of a family's reader; `None` if the word does not belong to the family.
type RecordReading = Option<Result<Record, BadRecord>>;

/// Makes a bad record at a place.
fn bad_record(at: Range<usize>, problem: impl Into<String>) -> BadRecord {
    BadRecord { at, problem: problem.into(), is_number: false }
}

/// Reads all fields as numbers. One empty field at the end is ignored, since CLT ends its lists with a comma.
///
/// # Errors
/// Returns the first field that is not a number.
fn read_all_numbers(syntax: &StatementSyntax<'_>) -> Result<Vec<f64>, BadRecord> {
    let mut fields = syntax.fields.as_slice();
    if let Some((last, rest)) = fields.split_last()
        && last.kind == super::syntax::FieldKind::Empty
    {
        fields = rest;
    }
    fields.iter().map(|field| read_number(syntax, field)).collect()
}

/// Reads a field as a number.
fn read_number(
    syntax: &StatementSyntax<'_>,
    field: &super::syntax::StatementField,
) -> Result<f64, BadRecord> {
    field.number_value().ok_or_else(|| {
        let text = String::from_utf8_lossy(syntax.bytes_at(&field.at)).into_owned();
        let problem =
            if text.is_empty() { "a number is missing".into() } else { format!("`{text}` is not a number") };
        BadRecord { at: field.at.clone(), problem, is_number: true }
    })
}

/// Makes a bad record for a wrong number of arguments.
fn wrong_count(major: &str, syntax: &StatementSyntax<'_>, takes: &str, found: usize) -> BadRecord {
    let start = syntax.word.start;
    let end = syntax.fields.last().map_or(syntax.word.end, |field| field.at.end.max(syntax.word.end));
    bad_record(start..end, format!("{major} takes {takes}, this has {found}"))
}

/// Returns the point of the first three numbers.
fn point_from_numbers(numbers: &[f64]) -> Option<Point3<f64>> {
    match numbers {
        [x, y, z, ..] => Some(Point3::new(*x, *y, *z)),
        _ => None,
    }
}

/// Returns the vector of the first three numbers.
fn vector_from_numbers(numbers: &[f64]) -> Option<Vector3<f64>> {
    point_from_numbers(numbers).map(|point| point.coords)
}

/// Returns whether a printed vector is long enough to have a direction.
pub(crate) fn has_direction(vector: &Vector3<f64>) -> bool {
    let length = vector.norm();
    length > 1e-6 && length.is_finite()
}

/// Reads all fields of a nested record as numbers.
fn read_group_numbers(
    syntax: &StatementSyntax<'_>,
    group: &super::syntax::FieldGroup,
) -> Result<Vec<f64>, BadRecord> {
    group.fields.iter().map(|field| read_number(syntax, field)).collect()
}
