//! This module writes compensated passes, and the motions around them, into the CL text.

use super::arc_template::{ArcTemplate, find_arc_template};
use super::pass_profile::slope_sine;
use super::vertical_passes::VerticalPass;
use crate::diagnostic::Failure;
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::{Program, Record, StatementId};
use crate::surface::profile::{Chain, ChainPiece, ProfilePlane};
use crate::transform::statement_numbers::{
    copy_statement, delete_keeping_remark, pair_with_indices, round_to_decimals,
};
use crate::write::{FileStyle, ProgramEditor};
use nalgebra::Point3;
use std::f64::consts::PI;
use std::ops::Range;

/// The reason why the statements of a motion cannot be given other points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub(super) enum UnwritableMotion {
    #[error("its point shares a statement with others, or stands in a record that states more than a point")]
    NoGoto,
    #[error("its arc or spline stands in records that cannot be moved")]
    Arc,
}

/// The reason why a motion or a pass was not written.
#[derive(Debug)]
pub(super) enum WriteFault {
    /// Its statements cannot be given other points.
    Unwritable(UnwritableMotion),
    /// An edit failed, for example because a statement does not read back.
    Failed(Failure),
}

impl From<UnwritableMotion> for WriteFault {
    fn from(why: UnwritableMotion) -> Self {
        Self::Unwritable(why)
    }
}

impl From<Failure> for WriteFault {
    fn from(failure: Failure) -> Self {
        Self::Failed(failure)
    }
}

/// Writes points into one program.
pub(super) struct PassWriter<'a> {
    pub(super) motions: &'a [Motion],
    pub(super) mm_per_unit: f64,
    /// The decimals of the file's coordinates, at least four.
    decimals: usize,
    arc: Option<ArcTemplate>,
}

impl<'a> PassWriter<'a> {
    pub(super) fn new(program: &Program, motions: &'a [Motion], mm_per_unit: f64) -> Self {
        // A file may print its own points with two or three decimals, but a compensated path would lose its
        // tolerance to them.
        let decimals = FileStyle::from_program(program).length_decimals.max(4);
        Self { motions, mm_per_unit, decimals, arc: find_arc_template(program) }
    }

    /// Returns whether the file has records that state arcs.
    pub(super) fn has_arcs(&self) -> bool {
        self.arc.is_some()
    }

    /// Checks that a motion's statements can be given other points.
    ///
    /// # Errors
    /// Returns [`UnwritableMotion`] if they cannot.
    pub(super) fn check_writable(&self, program: &Program, index: usize) -> Result<(), UnwritableMotion> {
        let motion = self.motions.get(index).ok_or(UnwritableMotion::NoGoto)?;
        let last = motion.last_statement();
        // A GOTO of several points cannot be split without changing the neighbouring motions.
        let beside = [index.wrapping_sub(1), index + 1];
        let shares =
            |other: &usize| self.motions.get(*other).is_some_and(|other| other.last_statement() == last);
        if beside.iter().any(shares) || motion.hole.is_some() {
            return Err(UnwritableMotion::NoGoto);
        }
        let record = program.statement(last).record();
        match (record, &motion.path) {
            (Record::Goto(_), _) => Ok(()),
            (Record::Points(_), _) if motion.normal.is_some() => Ok(()),
            (Record::DriveArc(_), MotionPath::Arc(_)) => Ok(()),
            (Record::Control(_), MotionPath::Spline(_)) => Ok(()),
            (_, MotionPath::Arc(_) | MotionPath::Spline(_)) => Err(UnwritableMotion::Arc),
            _ => Err(UnwritableMotion::NoGoto),
        }
    }

    pub(super) fn point_numbers(&self, point: Point3<f64>) -> Vec<(usize, f64)> {
        pair_with_indices(
            0,
            <[f64; 3]>::from(
                (point / self.mm_per_unit).coords.map(|value| round_to_decimals(value, self.decimals)),
            ),
        )
    }

    /// Writes a compensated pass over the statements of the old one. Statements between its motions stay.
    /// They come after the new points whose contacts came before them.
    ///
    /// # Errors
    /// Returns [`WriteFault`] if a statement does not read back, or if there is no GOTO to model new ones on.
    pub(super) fn write_pass(
        &self,
        editor: &mut ProgramEditor,
        pass: &VerticalPass,
        path: &Chain,
        (radius, contact): (f64, bool),
    ) -> Result<(), WriteFault> {
        let Some(goto) = self.find_goto(editor.program(), &pass.motions) else {
            return Err(UnwritableMotion::NoGoto.into());
        };
        // Cycles, feeds and comments between the old motions stay where their contact was, so the new path is
        // distributed over the old motions.
        let breaks = self.find_motion_breaks(pass, path, if contact { radius } else { 0.0 });
        let forward = if path.end().u >= path.start().u { 1.0 } else { -1.0 };
        let mut pieces = split_long_arcs(path).into_iter().peekable();
        let mut reached = f64::NEG_INFINITY;
        let count = pass.motions.len();
        for (place, (index, until)) in pass.motions.clone().zip(breaks).enumerate() {
            let Some(motion) = self.motions.get(index) else { continue };
            let mut own: Vec<ChainPiece> = Vec::new();
            while let Some(piece) = pieces.peek() {
                // In an undercut the path runs back a little. The farthest place so far keeps the pieces in
                // their order.
                reached = reached.max(piece.end().u * forward);
                // The last motion takes all the rest, so that no piece is lost to rounding.
                if reached > until + 1e-9 && place + 1 < count {
                    break;
                }
                own.extend(pieces.next());
            }
            self.replace_motion(editor, motion, &own, &pass.plane, goto)?;
        }
        Ok(())
    }

    /// Writes a pass as straight moves to points, with a list for each of its motions. A motion with an empty
    /// list is deleted.
    ///
    /// # Errors
    /// Returns the errors of [`PassWriter::write_pass`].
    pub(super) fn write_points(
        &self,
        editor: &mut ProgramEditor,
        motions: Range<usize>,
        points: Vec<Vec<Point3<f64>>>,
    ) -> Result<(), WriteFault> {
        let Some(goto) = self.find_goto(editor.program(), &motions) else {
            return Err(UnwritableMotion::NoGoto.into());
        };
        for (index, own) in motions.zip(points) {
            let Some(motion) = self.motions.get(index) else { continue };
            let simple = is_line(editor.program(), motion);
            let (put_in, kept) = match own.split_last() {
                Some((last, rest)) if simple => (rest, Some(last)),
                _ => (own.as_slice(), None),
            };
            for point in put_in {
                let text = copy_statement(editor, goto, &self.point_numbers(*point));
                editor.insert_before(motion.statements.first(), &text)?;
            }
            self.keep_end(editor, motion, kept.copied())?;
        }
        Ok(())
    }

    /// Gives a motion's last statement another end, or deletes the motion.
    fn keep_end(
        &self,
        editor: &mut ProgramEditor,
        motion: &Motion,
        end: Option<Point3<f64>>,
    ) -> Result<(), Failure> {
        match end {
            Some(end) => editor.set_numbers(motion.last_statement(), &self.point_numbers(end)),
            None => {
                delete_announcements(editor, motion)?;
                delete_keeping_remark(editor, motion.last_statement())
            }
        }
    }

    /// Finds a GOTO of one point on which new ones are modelled: one of the pass, else the nearest one before
    /// or after it.
    fn find_goto(&self, program: &Program, pass: &Range<usize>) -> Option<StatementId> {
        let is_goto = |index: &usize| {
            self.motions.get(*index).is_some_and(|motion| {
                let found = program.statement(motion.last_statement());
                found.is_live() && matches!(found.record(), Record::Goto(_))
            })
        };
        let own = pass.clone().find(is_goto);
        let before = || (0..pass.start).rev().find(is_goto);
        let after = || (pass.end..self.motions.len()).find(is_goto);
        let index = own.or_else(before).or_else(after)?;
        self.motions.get(index).map(Motion::last_statement)
    }

    /// Returns for each motion how far the tip has come along the pass, in the path's direction, when the
    /// contact reaches the end of the motion. The tip lags behind the contact by R sin(slope).
    fn find_motion_breaks(&self, pass: &VerticalPass, path: &Chain, radius: f64) -> Vec<f64> {
        let forward = if path.end().u >= path.start().u { 1.0 } else { -1.0 };
        let flat = |point: Point3<f64>| pass.plane.to_plane(point * self.mm_per_unit);
        let all = self.motions.get(pass.motions.clone());
        debug_assert!(all.is_some(), "a pass consists of motions of the program");
        let all = all.unwrap_or_default();
        let mut reached = f64::NEG_INFINITY;
        let mut breaks = Vec::with_capacity(all.len());
        for (index, motion) in all.iter().enumerate() {
            let (from, at) = (flat(motion.from.point), flat(motion.to.point));
            let to = all.get(index + 1).map_or(at, |next| flat(next.to.point));
            // At the end of the pass there is no next side, so the slope of the last side counts fully.
            let lean = if to == at { slope_sine(from, at, at) * 2.0 } else { slope_sine(from, at, to) };
            reached = reached.max((at.u - radius * lean) * forward);
            breaks.push(reached);
        }
        breaks
    }

    /// Replaces a motion by pieces of the new path.
    fn replace_motion(
        &self,
        editor: &mut ProgramEditor,
        motion: &Motion,
        pieces: &[ChainPiece],
        plane: &ProfilePlane,
        goto: StatementId,
    ) -> Result<(), Failure> {
        let simple = is_line(editor.program(), motion);
        let (put_in, kept) = match pieces.split_last() {
            Some((ChainPiece::Line(line), rest)) if simple => (rest, Some(line.to)),
            _ => (pieces, None),
        };
        for piece in put_in {
            self.insert_piece(editor, piece, plane, goto, motion.statements.first())?;
        }
        self.keep_end(editor, motion, kept.map(|end| plane.to_space(end)))
    }

    fn insert_piece(
        &self,
        editor: &mut ProgramEditor,
        piece: &ChainPiece,
        plane: &ProfilePlane,
        goto: StatementId,
        before: StatementId,
    ) -> Result<(), Failure> {
        if let (ChainPiece::Arc(arc), Some(template)) = (piece, &self.arc)
            && !template.insert_arc(editor, arc, plane, self.mm_per_unit, before)?
        {
            return Ok(());
        }
        let text = copy_statement(editor, goto, &self.point_numbers(plane.to_space(piece.end())));
        editor.insert_before(before, &text)
    }
}

/// Returns whether a motion is a line that a single GOTO states.
fn is_line(program: &Program, motion: &Motion) -> bool {
    let record = program.statement(motion.last_statement()).record();
    matches!(motion.path, MotionPath::Line) && matches!(record, Record::Goto(_))
}

/// Returns the pieces of a path, with every arc of more than half a turn split in two.
pub(super) fn split_long_arcs(path: &Chain) -> Vec<ChainPiece> {
    let split = |piece: &ChainPiece| match piece {
        ChainPiece::Arc(arc) if arc.sweep_rad.abs() > PI => {
            vec![piece.sub_piece(0.0, 0.5), piece.sub_piece(0.5, 1.0)]
        }
        _ => vec![*piece],
    };
    path.pieces().iter().flat_map(split).collect()
}

/// Deletes the records that announce an arc or a spline.
///
/// # Errors
/// Returns the errors of [`ProgramEditor::delete_statement`].
pub(super) fn delete_announcements(editor: &mut ProgramEditor, motion: &Motion) -> Result<(), Failure> {
    for id in motion.statements.ids().rev().skip(1) {
        let found = editor.program().statement(id);
        if found.is_live() && is_motion_record(found.record()) && *found.record() != Record::Rapid {
            editor.delete_statement(id)?;
        }
    }
    Ok(())
}

pub(super) fn is_motion_record(record: &Record) -> bool {
    matches!(
        record,
        Record::Goto(_)
            | Record::Circle(_)
            | Record::MoveArc(_)
            | Record::StartDirection(_)
            | Record::DriveArc(_)
            | Record::Nurbs
            | Record::Knot(_)
            | Record::Control(_)
            | Record::Rapid
    )
}
