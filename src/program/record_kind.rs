//! This module holds kinds of statements, coarser than records, by which changes and differences are counted.

use super::Record;

/// The kind of a statement. It is coarser than [`Record`] and the same in every dialect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "simulation", derive(serde::Serialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum RecordKind {
    /// A point: `GOTO`, `FROM`, `GOHOME`, `GODLTA`.
    Point,
    /// An arc: `CIRCLE`, `MOVARC`, CATIA's `TLON`, `INDIRV`.
    Arc,
    /// A spline: `NURBS`, `KNOT`, `CNTRL`.
    Spline,
    /// `RAPID`.
    Rapid,
    /// `FEDRAT`.
    Feed,
    /// `SPINDL`.
    Spindle,
    /// `CUTCOM`.
    Compensation,
    /// A tool's number or shape.
    Tool,
    /// `TLAXIS`, `MULTAX`.
    Axis,
    /// A frame.
    Frame,
    /// A drilling cycle.
    Cycle,
    /// A mark of a motion class.
    Mark,
    /// Operations, units, the end.
    Structure,
    /// Comments, text for people, empty lines.
    Comment,
    /// Everything else.
    Other,
}

impl RecordKind {
    /// Returns the kind of a record.
    pub fn from_record(record: &Record) -> Self {
        match record {
            Record::Goto(_)
            | Record::Points(_)
            | Record::From(_)
            | Record::GoHome(_)
            | Record::GoDelta(_) => Self::Point,
            Record::Circle(_)
            | Record::MoveArc(_)
            | Record::DriveArc(_)
            | Record::AxialArc(_)
            | Record::StartDirection(_) => Self::Arc,
            Record::Nurbs | Record::Knot(_) | Record::Control(_) => Self::Spline,
            Record::Rapid => Self::Rapid,
            Record::Feed(_) | Record::Threading(_) => Self::Feed,
            Record::Spindle(_) | Record::SpindleLimit(_) => Self::Spindle,
            Record::CutterCompensation(_) => Self::Compensation,
            Record::ToolCall(_) | Record::ToolData(_) => Self::Tool,
            Record::ToolAxis(_) | Record::MultiAxis(_) => Self::Axis,
            Record::Frame(_) | Record::FrameMark | Record::MatrixRow(_) => Self::Frame,
            Record::Cycle(_) | Record::CycleOn | Record::CycleOff => Self::Cycle,
            Record::Marked(_) => Self::Mark,
            Record::OperationStart(_)
            | Record::OperationEnd
            | Record::Channel(_)
            | Record::Units(_)
            | Record::ProgramEnd => Self::Structure,
            Record::ByteOrderMark | Record::Blank | Record::Comment | Record::Text => Self::Comment,
            Record::Known | Record::Other | Record::Definition | Record::Unparsed => Self::Other,
        }
    }

    /// Returns the name in reports for one (`point`) or for several (`points`).
    pub fn display_name(self, count: usize) -> &'static str {
        let (one, many) = match self {
            Self::Point => ("point", "points"),
            Self::Arc => ("arc record", "arc records"),
            Self::Spline => ("spline record", "spline records"),
            Self::Rapid => ("RAPID", "RAPID"),
            Self::Feed => ("FEDRAT", "FEDRAT"),
            Self::Spindle => ("SPINDL", "SPINDL"),
            Self::Compensation => ("CUTCOM", "CUTCOM"),
            Self::Tool => ("tool record", "tool records"),
            Self::Axis => ("tool axis", "tool axes"),
            Self::Frame => ("frame record", "frame records"),
            Self::Cycle => ("CYCLE", "CYCLE"),
            Self::Mark => ("motion mark", "motion marks"),
            Self::Structure => ("structure record", "structure records"),
            Self::Comment => ("comment", "comments"),
            Self::Other => ("other record", "other records"),
        };
        if count == 1 { one } else { many }
    }
}
