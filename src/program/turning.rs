//! This module tells turning programs from milling programs, and finds the plane in which a lathe's tool moves.

use super::record::{Threading, ToolData, ToolWord};
use super::{Program, Record, RecordKind, StatementId};
use nalgebra::{Point3, Vector3};

/// The plane in which a lathe's tool moves. One of its axes is that of the spindle, the other one is the radius.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum TurningPlane {
    /// The plane y = 0: the work turns about z, and x is the radius (CATIA, and NX with its work plane ZM-XM).
    Zx,
    /// The plane z = 0: the work turns about x, and y is the radius (NX with its work plane XM-YM).
    Xy,
}

impl TurningPlane {
    /// Returns the radius at which the tool is, with the sign of its side.
    pub fn signed_radius(self, point: Point3<f64>) -> f64 {
        match self {
            Self::Zx => point.x,
            Self::Xy => point.y,
        }
    }

    /// Returns the coordinate across the plane, which is 0 in it.
    pub fn offset(self, point: Point3<f64>) -> f64 {
        match self {
            Self::Zx => point.y,
            Self::Xy => point.z,
        }
    }

    /// Returns the normal of the plane.
    pub fn normal(self) -> Vector3<f64> {
        match self {
            Self::Zx => Vector3::y(),
            Self::Xy => Vector3::z(),
        }
    }
}

/// What the tool in force is, as far as the file tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ToolUse {
    Turns,
    Mills,
    /// A CUTTER with one number is a lathe's nose or a mill.
    Unknown,
}

/// What a tool that nothing describes is, by the other tools of its program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum UndescribedTool {
    /// The program describes a turning tool, or cuts a thread with one.
    Turns,
    /// No tool of the program is described as one that mills.
    MayTurn,
    /// The program mills.
    Mills,
}

impl Program {
    /// Returns what tools are that the program calls and does not describe.
    pub(crate) fn judge_undescribed_tools(&self) -> UndescribedTool {
        let mut judged = UndescribedTool::MayTurn;
        for (_, statement) in self.live_statements_of(&[RecordKind::Tool, RecordKind::Feed]) {
            let tool = match statement.record() {
                Record::Threading(Threading::On(_) | Threading::Pitch(_)) => Some(ToolUse::Turns),
                record => self.find_tool_use(record, self.statement_text(statement)),
            };
            match tool {
                Some(ToolUse::Turns) => return UndescribedTool::Turns,
                Some(ToolUse::Mills) => judged = UndescribedTool::Mills,
                Some(ToolUse::Unknown) | None => {}
            }
        }
        judged
    }

    /// Returns the plane in which a lathe's tool moves, or `None` if the program does not turn. A program turns if it
    /// describes a turning tool or cuts a thread with one, and all points of such tools lie in one plane. Points of
    /// mills, which are driven in a lathe's turret, do not count.
    pub fn turning_plane(&self) -> Option<TurningPlane> {
        let turns = self.judge_undescribed_tools() == UndescribedTool::Turns;
        turns.then(|| self.plane_of_points()).flatten()
    }

    /// Returns whether the program turns: whether it has a [`Program::turning_plane`].
    pub fn is_turning(&self) -> bool {
        self.turning_plane().is_some()
    }

    /// Returns the plane in which all points lie that no mill makes. Where all of them are on x, it is that of z and x.
    pub(crate) fn plane_of_points(&self) -> Option<TurningPlane> {
        let (mut any, mut zx, mut xy) = (false, true, true);
        self.for_each_turned_point(|_, point| {
            any = true;
            zx &= TurningPlane::Zx.offset(point) == 0.0;
            xy &= TurningPlane::Xy.offset(point) == 0.0;
        });
        match (any, zx, xy) {
            (true, true, _) => Some(TurningPlane::Zx),
            (true, false, true) => Some(TurningPlane::Xy),
            _ => None,
        }
    }

    /// Shows the points of GOTOs that no mill makes, with their statements.
    pub(crate) fn for_each_turned_point(&self, mut see: impl FnMut(StatementId, Point3<f64>)) {
        let mut tool = ToolUse::Unknown;
        let mut threads = false;
        for (id, statement) in self.live_statements() {
            match statement.record() {
                Record::Goto(goto) if threads || tool != ToolUse::Mills => see(id, goto.point),
                Record::Threading(Threading::On(_)) => threads = true,
                Record::Threading(Threading::Off) => threads = false,
                record @ (Record::ToolData(_) | Record::ToolCall(_)) => {
                    tool = self.find_tool_use(record, self.statement_text(statement)).unwrap_or(tool);
                }
                _ => {}
            }
        }
    }

    /// Returns what a record tells about the use of its tool.
    fn find_tool_use(&self, record: &Record, text: &[u8]) -> Option<ToolUse> {
        let has = |word: &[u8]| memchr::memmem::find(text, word).is_some();
        match record {
            Record::ToolData(data) => Some(find_use_of_data(data)),
            // TOOLNO/3,TURN,... is a lathe's tool; with a number and a diameter it tells nothing.
            Record::ToolCall(call) if !call.loads && has(b"TURN") => Some(ToolUse::Turns),
            Record::ToolCall(call) if !call.loads && (has(b"MILL") || has(b"DRILL")) => Some(ToolUse::Mills),
            _ => None,
        }
    }
}

fn find_use_of_data(data: &ToolData) -> ToolUse {
    match data.word {
        ToolWord::TlDataTurn => ToolUse::Turns,
        ToolWord::Cutter if data.corner_radius.is_none() => ToolUse::Unknown,
        _ => ToolUse::Mills,
    }
}
