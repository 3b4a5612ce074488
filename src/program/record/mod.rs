//! Records: what a statement means, read from its [`StatementSyntax`].
//!
//! One file per family. Each family reads its records and says, number by number, what role a number plays
//! ([`NumberRole`]), so that geometric and unit transforms need no list of records of their own. A record that stands here is
//! well formed; a known word with wrong arguments is a [`BadRecord`].

mod cycle;
mod feed;
mod frame;
mod path;
mod role;
mod structure;
mod tool;

pub use cycle::{CycleKind, DrillingCycle};
pub use feed::{CompensationSide, CutterCompensation, Spindle, SpindleDirection, SpindleUnit};
pub use frame::{FrameRecord, FrameWord};
pub use path::{ArcSense, Circle, DriveArc, Goto, MoveArc};
pub(crate) use path::{goto_roles as path_roles, has_contact_normal, has_direction, has_tool_axes};
pub use role::NumberRole;
pub use structure::{MotionMark, OperationNames};
pub use tool::{ToolCall, ToolData, ToolWord};

use super::syntax::{StatementKind, StatementSyntax};
use super::units::{Feed, LengthUnit};
use nalgebra::{Point3, Vector3};
use std::ops::Range;

/// What a statement means. Kept small (see the test): a file has a record for each of its statements.
#[derive(Debug, Clone, PartialEq)]
pub enum Record {
    /// The UTF-8 byte order mark in front of the first statement.
    ByteOrderMark,
    /// Nothing.
    Blank,
    /// `$$ ...` with no meaning for the tool path.
    Comment,

    /// `GOTO/` one point, with or without a tool axis.
    Goto(Goto),
    /// `GOTO/` several points or a point with axis and contact normal, and lines of bare numbers that continue it.
    Points(Box<[f64]>),
    /// `FROM/`: where the tool is.
    From(Box<Goto>),
    /// `GOHOME`, with or without a point.
    GoHome(Option<Box<Goto>>),
    /// `GODLTA/`: a step from where the tool is (one number steps along the tool axis).
    GoDelta(Box<[f64]>),
    /// `CIRCLE/`: the next GOTO is the end of an arc.
    Circle(Box<Circle>),
    /// `MOVARC/`: the next GOTO is the end of a right-hand arc of a given angle.
    MoveArc(Box<MoveArc>),
    /// `INDIRV/`: the direction in which the next drive motion starts.
    StartDirection(Box<Vector3<f64>>),
    /// CATIA's `TLON,GOFWD/(CIRCLE/...),ON,(LINE/...)`: an arc with its end in the record.
    DriveArc(Box<DriveArc>),
    /// `NURBS/`: a spline follows.
    Nurbs,
    /// `KNOT/`: knots of the spline.
    Knot(Box<[f64]>),
    /// `CNTRL/`: a control point; the last one is where the tool ends.
    Control(Box<Point3<f64>>),
    /// `RAPID`: the next motion, and only that, is a rapid.
    Rapid,

    /// `FEDRAT/`.
    Feed(Feed),
    /// `SPINDL/`.
    Spindle(Box<Spindle>),
    /// `CUTCOM/`.
    CutterCompensation(CutterCompensation),

    /// `LOAD/TOOL`, `LOADTL/`, `TURRET/`, `TOOLNO/`: a tool by number.
    ToolCall(ToolCall),
    /// `TLDATA/`, `CUTTER/`, Creo's `$$-> CUTTER`: the shape of the tool.
    ToolData(Box<ToolData>),
    /// `TLAXIS/`.
    ToolAxis(Box<Vector3<f64>>),
    /// `MULTAX`, `MULTAX/ON`, `MULTAX/OFF`.
    MultiAxis(bool),

    /// `MSYS/`, `CSYS/`, `CAMERA/`, `TRANS/`, `ORIGIN/`, `ROTABL/`: a frame or a turn of one.
    Frame(Box<FrameRecord>),
    /// CATIA's `$$*CATIA0`: a matrix follows in comments.
    FrameMark,
    /// `$$` and four numbers: a row of that matrix, where one is expected.
    MatrixRow(Box<[f64; 4]>),

    /// `CYCLE/DRILL,...`: each following GOTO is a hole.
    Cycle(Box<DrillingCycle>),
    /// `CYCLE/ON`: the cycle goes on.
    CycleOn,
    /// `CYCLE/OFF`.
    CycleOff,

    /// A word that says what kind of motion follows (`PAINT/COLOR`, FF's `PPRINT/MOTION`, CLT's `MOVE_ATTRIB`).
    Marked(MotionMark),
    /// An operation starts; its name is in the text.
    OperationStart(OperationNames),
    /// An operation ends.
    OperationEnd,
    /// `UNITS/`, `UNIT/`.
    Units(LengthUnit),
    /// `FINI`, `END`: the program ends.
    ProgramEnd,
    /// Text for people: `PPRINT`, `PARTNO`, `INSERT`, `TPRINT`, `REMARK`.
    Text,

    /// A known word without effect on the tool path (`COOLNT`, `PAINT/PATH`, `INTOL`, ...).
    Known,
    /// A word clsmith does not know; kept and passed on.
    Other,
    /// A statement of an APT part program.
    Definition,
    /// What the grammar refused, or a known word with wrong arguments; kept and passed on.
    Unparsed,
}

/// Why a known word cannot be read as its record: which bytes of the statement, and what is wrong there.
#[derive(Debug, Clone, PartialEq)]
pub struct BadRecord {
    /// Place in the statement's text.
    pub at: Range<usize>,
    /// What is wrong, for a person.
    pub problem: String,
    /// Whether a number was expected and something else was found.
    pub is_number: bool,
}

impl Record {
    /// Reads the meaning of a statement.
    ///
    /// # Errors
    /// [`BadRecord`] for a known word whose arguments do not fit. Refused text is no error here: it is [`Record::Unparsed`].
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
        let major = syntax.major_word();
        let families = [
            path::read_record,
            feed::read_record,
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

    /// What each number of a statement is, in the order of [`StatementSyntax::numbers`].
    ///
    /// A number whose role is not known is [`NumberRole::Plain`]; transforms never touch those.
    pub fn number_roles(&self, syntax: &StatementSyntax<'_>) -> Vec<NumberRole> {
        let count = syntax.numbers().len();
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
            Self::Feed(_) | Self::Spindle(_) => feed::number_roles(self, syntax),
            Self::ToolData(_) | Self::ToolAxis(_) | Self::ToolCall(_) => tool::number_roles(self, syntax),
            Self::Frame(_) | Self::MatrixRow(_) => frame::number_roles(self),
            Self::Cycle(_) => cycle::number_roles(syntax),
            Self::Known => structure::number_roles(syntax),
            _ => Vec::new(),
        };
        roles.resize(count, NumberRole::Plain);
        roles
    }

    /// Whether the statement moves the tool, or is the end of a motion that statements before it describe.
    pub fn is_motion(&self) -> bool {
        matches!(
            self,
            Self::Goto(_)
                | Self::Points(_)
                | Self::GoHome(_)
                | Self::GoDelta(_)
                | Self::DriveArc(_)
                | Self::Control(_)
        )
    }
}

/// What a family's reader gives: `None` when the word is not of the family.
type RecordReading = Option<Result<Record, BadRecord>>;

fn bad_record(at: Range<usize>, problem: impl Into<String>) -> BadRecord {
    BadRecord { at, problem: problem.into(), is_number: false }
}

/// All fields as numbers, ignoring one trailing empty field (CLT ends its lists with a comma).
///
/// # Errors
/// The first field that is no number.
fn read_all_numbers(syntax: &StatementSyntax<'_>) -> Result<Vec<f64>, BadRecord> {
    let mut fields = syntax.fields.as_slice();
    if let Some((last, rest)) = fields.split_last()
        && last.kind == super::syntax::FieldKind::Empty
    {
        fields = rest;
    }
    fields.iter().map(|field| read_number(syntax, field)).collect()
}

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

fn wrong_count(major: &str, syntax: &StatementSyntax<'_>, takes: &str, found: usize) -> BadRecord {
    let start = syntax.word.start;
    let end = syntax.fields.last().map_or(syntax.word.end, |field| field.at.end.max(syntax.word.end));
    bad_record(start..end, format!("{major} takes {takes}, this has {found}"))
}

fn point_from_numbers(numbers: &[f64]) -> Option<Point3<f64>> {
    match numbers {
        [x, y, z, ..] => Some(Point3::new(*x, *y, *z)),
        _ => None,
    }
}

fn vector_from_numbers(numbers: &[f64]) -> Option<Vector3<f64>> {
    point_from_numbers(numbers).map(|point| point.coords)
}
