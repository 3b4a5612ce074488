//! This module writes the statements of a motion's parts, in the form of the statements of the whole motion.

use crate::diagnostic::Failure;
use crate::parse;
use crate::program::geometry::{MotionPath, Pose};
use crate::program::motion::Motion;
use crate::program::{FieldKind, Program, StatementId};
use crate::transform::statement_numbers::{copy_statement, pair_with_indices, strip_remark};
use crate::write::ProgramEditor;
use nalgebra::Vector3;
use std::f64::consts::PI;
use std::ops::Range;

/// Sweeps that are closer to half a turn than this angle (radians) count as half a turn, which needs no
/// INTOF.
const HALF_TURN: f64 = 1e-4;

/// The form in which a motion that can be split is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SplitForm {
    /// A GOTO.
    Line,
    /// CIRCLE (its statement) and a GOTO.
    Circle(StatementId),
    /// MOVARC (its statement) and GOTO.
    MoveArc(StatementId),
    /// CATIA's INDIRV (its statement) and TLON.
    Drive(StatementId),
}

/// A motion with the points at which it is split: fractions of its length, and the poses there.
#[derive(Debug, Clone)]
pub(super) struct SplitMotion {
    pub motion: usize,
    pub written: SplitForm,
    pub fractions: Vec<f64>,
    pub poses: Vec<Pose>,
}

impl SplitMotion {
    /// Returns start and end of each part as fractions, in order.
    pub(super) fn part_fractions(&self) -> impl Iterator<Item = (f64, f64)> {
        let starts = std::iter::once(0.0).chain(self.fractions.iter().copied());
        starts.zip(self.fractions.iter().copied().chain([1.0]))
    }
}

/// Writes the parts. New statements are inserted before the one that ends the motion, which stays unchanged
/// where possible.
pub(super) fn write_split_motion(
    editor: &mut ProgramEditor,
    motion: &Motion,
    split: &SplitMotion,
) -> Result<(), Failure> {
    match split.written {
        SplitForm::Line => {
            for pose in &split.poses {
                let goto = render_goto(editor, motion, pose);
                editor.insert_before(motion.last_statement(), &goto)?;
            }
            Ok(())
        }
        SplitForm::Circle(circle) => {
            let again = text_without_remark(editor.program(), circle);
            for pose in &split.poses {
                let goto = render_goto(editor, motion, pose);
                editor.insert_before(motion.last_statement(), &goto)?;
                editor.insert_before(motion.last_statement(), &again)?;
            }
            Ok(())
        }
        SplitForm::MoveArc(record) => write_move_arcs(editor, motion, split, record),
        SplitForm::Drive(direction) => write_drive_arcs(editor, motion, split, direction),
    }
}

fn render_goto(editor: &ProgramEditor, motion: &Motion, pose: &Pose) -> Vec<u8> {
    let [x, y, z]: [f64; 3] = pose.point.coords.into();
    let [i, j, k]: [f64; 3] = pose.axis.into();
    // The last three numbers only exist in a GOTO of six values.
    copy_with_numbers(editor, motion.last_statement(), 0, &[x, y, z, i, j, k])
}

/// Writes the parts of a MOVARC. It states its own angle, so the angle of the whole arc is reduced to that of
/// its first part.
fn write_move_arcs(
    editor: &mut ProgramEditor,
    motion: &Motion,
    split: &SplitMotion,
    statement: StatementId,
) -> Result<(), Failure> {
    let angle = find_move_arc_angle(editor.program(), statement);
    let degrees = |(start, end): (f64, f64)| angle.map(|(number, whole)| (number, whole * (end - start)));
    for (pose, part) in split.poses.iter().zip(split.part_fractions().skip(1)) {
        let goto = render_goto(editor, motion, pose);
        let again = match degrees(part) {
            Some((number, degrees)) => copy_with_numbers(editor, statement, number, &[degrees]),
            None => text_without_remark(editor.program(), statement),
        };
        editor.insert_before(motion.last_statement(), &goto)?;
        editor.insert_before(motion.last_statement(), &again)?;
    }
    match split.part_fractions().next().and_then(degrees) {
        Some(first) => editor.set_numbers(statement, &[first]),
        None => Ok(()),
    }
}

/// Returns the angle of a MOVARC: the index of its number, and its value in degrees.
fn find_move_arc_angle(program: &Program, statement: StatementId) -> Option<(usize, f64)> {
    let found = program.statement(statement);
    let syntax = parse::syntax(program.statement_text(found));
    let word = (0..syntax.fields.len()).find(|field| syntax.word_at(*field).as_deref() == Some("ANGLE"))?;
    let place = &syntax.fields.get(word + 1)?.at;
    let (number, (_, degrees)) = syntax.numbers().into_iter().enumerate().find(|(_, (at, _))| at == place)?;
    Some((number, degrees))
}

/// Writes the parts of CATIA's arcs. Each part has its own start tangent (INDIRV) and end (in TLON).
/// `2,INTOF` only stays where a part has more than half a turn.
fn write_drive_arcs(
    editor: &mut ProgramEditor,
    motion: &Motion,
    split: &SplitMotion,
    direction: StatementId,
) -> Result<(), Failure> {
    let MotionPath::Arc(arc) = &motion.path else { return Ok(()) };
    let last = motion.last_statement();
    let short = |(start, end): (f64, f64)| (end - start) * arc.sweep <= PI + HALF_TURN;
    let program = editor.program();
    let numbers = parse::statement_numbers(program.statement_text(program.statement(last))).len();
    for ((pose, fraction), part) in split.poses.iter().zip(&split.fractions).zip(split.part_fractions()) {
        let [x, y, z]: [f64; 3] = pose.point.coords.into();
        let mut drive = copy_with_numbers(editor, last, numbers.saturating_sub(3), &[x, y, z]);
        if let Some(intof) = find_intof_range(&drive).filter(|_| short(part)) {
            drive.drain(intof);
        }
        let tangent: [f64; 3] = start_tangent(arc, *fraction).into();
        let indirv = copy_with_numbers(editor, direction, 0, &tangent);
        editor.insert_before(last, &drive)?;
        editor.insert_before(last, &indirv)?;
    }
    let program = editor.program();
    let whole = find_intof_range(program.statement_text(program.statement(last)));
    match whole.filter(|_| split.part_fractions().last().is_some_and(short)) {
        Some(intof) => editor.replace_parts(last, &[(intof, b"")]),
        None => Ok(()),
    }
}

fn start_tangent(arc: &crate::program::geometry::CircularArc, fraction: f64) -> Vector3<f64> {
    // A tangent of -1e-17 in x would be printed as zero with a sign.
    arc.tangent_at(fraction).map(|part| if part.abs() < 1e-9 { 0.0 } else { part })
}

/// Returns the range of `2,INTOF,` and what follows it up to the LINE.
fn find_intof_range(text: &[u8]) -> Option<Range<usize>> {
    let syntax = parse::syntax(text);
    let word = (0..syntax.fields.len()).find(|field| syntax.word_at(*field).as_deref() == Some("INTOF"))?;
    let count = syntax.fields.get(word.checked_sub(1)?)?;
    let line = syntax.fields.get(word + 1)?;
    let fits = matches!((&count.kind, &line.kind), (FieldKind::Number(_), FieldKind::Group(_)));
    fits.then_some(count.at.start..line.at.start)
}

/// Returns the text of a statement in which the numbers from `first` on have new values.
fn copy_with_numbers(
    editor: &ProgramEditor,
    statement: StatementId,
    first: usize,
    values: &[f64],
) -> Vec<u8> {
    copy_statement(editor, statement, &pair_with_indices(first, values.iter().copied()))
}

/// Returns the text of a statement without a comment at its end.
fn text_without_remark(program: &Program, statement: StatementId) -> Vec<u8> {
    strip_remark(program.statement_text(program.statement(statement)))
}
