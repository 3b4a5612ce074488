//! Motions broken into parts, in the CL text.
//!
//! A line becomes GOTOs in the form of its own; an arc becomes arcs, each announced by the record that announced the whole. The
//! result is read back and compared with the old path: a motion whose parts do not read as it did stays whole and is reported.

use super::motion_pose::{has_turning_axis, interpolate_pose};
use super::split_read_back::{ReadMotions, find_faulty_splits};
use super::split_statements::{SplitForm, SplitMotion, write_split_motion};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::{Program, Record, StatementId, StepId};
use crate::write::ProgramEditor;
use std::fmt;
use std::ops::Range;

/// A program with split motions.
#[derive(Debug)]
pub struct SplitProgram {
    /// The program.
    pub program: Program,
    /// For each motion of the program before: the motions (their indices) that it is now.
    pub parts: Vec<Range<usize>>,
    /// Motions that were to be split and are still whole, by the index they had before, and why.
    pub kept: Vec<(usize, UnsplitReason)>,
}

/// Why a motion is not split.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum UnsplitReason {
    /// A rapid has no feed to change.
    Rapid,
    /// Moves of a drilling cycle stand in no statements of their own.
    Hole,
    /// A spline (NURBS) cannot be broken without computing new knots.
    Spline,
    /// It shares its statement with other points, or is a line of bare numbers.
    SharedStatement,
    /// A point with its contact normal: how the normal turns is not told.
    ContactNormal,
    /// A statement that says more than a point (FROM, GOHOME, GODLTA), or that has nothing before it.
    OtherStatement,
    /// CIRCLE, INDIRV or NURBS stands before it and was not understood.
    UnreadArc,
    /// The tool axis turns, but the statement does not print it.
    UnsaidAxis,
    /// The tool axis turns right over.
    OppositeAxis,
    /// A helix of several turns (`TIMES`), or one that its record has no form for.
    Helix,
    /// TLON,GOBACK: parts after the first would go back again.
    GoBack,
    /// The parts would not read back as the same path.
    NotReadBack,
}

impl UnsplitReason {
    /// Whether the record is of a kind that splitting is for, so that a user should hear of it.
    fn is_surprise(self) -> bool {
        matches!(self, Self::UnsaidAxis | Self::OppositeAxis | Self::Helix | Self::GoBack | Self::NotReadBack)
    }
}

impl fmt::Display for UnsplitReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Rapid => "it is a rapid",
            Self::Hole => "it is part of a drilling cycle",
            Self::Spline => "it is a spline",
            Self::SharedStatement => "it shares its statement with other points",
            Self::ContactNormal => "its statement has a contact normal",
            Self::OtherStatement => "its statement is no plain point",
            Self::UnreadArc => "the arc or spline before it is not understood",
            Self::UnsaidAxis => "its tool axis turns, but its statement does not print it",
            Self::OppositeAxis => "its tool axis turns right over",
            Self::Helix => "it is a helix whose parts the record cannot say",
            Self::GoBack => "it goes backwards from its start direction",
            Self::NotReadBack => "its parts would not read back as the same path",
        })
    }
}

/// Splits motions: pairs of a motion's index and the fractions of its length (between 0 and 1, ascending) where it is split.
///
/// Coordinates of the new points are rounded to the file's decimals, so a point is off its path by half of the last one at
/// most. The statement that ends the motion stays byte for byte, except that a CATIA arc whose last part has half a turn or
/// less loses its `2,INTOF`; MOVARC's angle becomes that of the first part. Everything else is untouched.
///
/// What cannot be split stays whole and is named in [`SplitProgram::kept`]; where that is not to be expected from the kind of motion,
/// a finding says so at the place. Shares outside 0..1 or out of order are left out.
///
/// # Errors
/// When a new statement cannot be read back at all.
pub fn split_motions(
    program: Program,
    step: StepId,
    wanted: &[(usize, Vec<f64>)],
    findings: &mut Vec<Diagnostic>,
) -> Result<SplitProgram, Failure> {
    let before = ReadMotions::from_program(&program);
    let (mut splits, mut kept) = choose_splits(&program, &before.motions, wanted);
    let (written, parts) = loop {
        if splits.is_empty() {
            break (program.clone(), (0..before.motions.len()).map(|index| index..index + 1).collect());
        }
        let mut editor = ProgramEditor::new(program.clone(), step);
        for split in &splits {
            if let Some(motion) = before.motions.get(split.motion) {
                write_split_motion(&mut editor, motion, split)?;
            }
        }
        let written = editor.finish()?;
        let after = ReadMotions::from_program(&written);
        let parts = part_ranges(before.motions.len(), &splits);
        let faults = find_faulty_splits(&before, &after, &splits, &parts);
        if faults.is_empty() {
            break (written, parts);
        }
        kept.extend(faults.iter().map(|motion| (*motion, UnsplitReason::NotReadBack)));
        splits.retain(|split| !faults.contains(&split.motion));
    };
    kept.sort_unstable();
    for (motion, why) in kept.iter().filter(|(_, why)| why.is_surprise()) {
        findings.extend(
            before.motions.get(*motion).map(|motion| describe_unsplit_motion(&program, motion, *why)),
        );
    }
    Ok(SplitProgram { program: written, parts, kept })
}

/// The motions that can be split, with the poses of their parts, and those that cannot.
fn choose_splits(
    program: &Program,
    motions: &[Motion],
    wanted: &[(usize, Vec<f64>)],
) -> (Vec<SplitMotion>, Vec<(usize, UnsplitReason)>) {
    let (mut splits, mut kept): (Vec<SplitMotion>, _) = (Vec::new(), Vec::new());
    let mut wanted: Vec<&(usize, Vec<f64>)> = wanted.iter().collect();
    wanted.sort_by_key(|(index, _)| *index);
    wanted.dedup_by_key(|(index, _)| *index);
    for (index, fractions) in wanted {
        let Some(motion) = motions.get(*index) else { continue };
        let mut last = 0.0;
        let inside = |fraction: &f64| {
            let fits = *fraction > last && *fraction < 1.0;
            last = if fits { *fraction } else { last };
            fits
        };
        let fractions: Vec<f64> = fractions.iter().copied().filter(inside).collect();
        if fractions.is_empty() {
            continue;
        }
        let beside = [index.wrapping_sub(1), index + 1];
        let shared = beside.into_iter().filter_map(|other| motions.get(other));
        let shared = shared.map(Motion::last_statement).any(|last| last == motion.last_statement());
        let split = find_split_form(program, motion, shared).and_then(|written| {
            let poses: Option<Vec<_>> =
                fractions.iter().map(|fraction| interpolate_pose(motion, *fraction)).collect();
            Ok(SplitMotion {
                motion: *index,
                written,
                fractions,
                poses: poses.ok_or(UnsplitReason::OppositeAxis)?,
            })
        });
        match split {
            Ok(split) => splits.push(split),
            Err(why) => kept.push((*index, why)),
        }
    }
    (splits, kept)
}

/// How a motion is written, if its parts can be written alike.
fn find_split_form(program: &Program, motion: &Motion, shared: bool) -> Result<SplitForm, UnsplitReason> {
    let last = motion.last_statement();
    let record = program.statement(last).record();
    match (record, &motion.path) {
        _ if motion.hole.is_some() => return Err(UnsplitReason::Hole),
        _ if motion.rapid => return Err(UnsplitReason::Rapid),
        _ if motion.normal.is_some() => return Err(UnsplitReason::ContactNormal),
        (_, MotionPath::Spline(_)) => return Err(UnsplitReason::Spline),
        (_, MotionPath::Start) => return Err(UnsplitReason::OtherStatement),
        (Record::Points(_), _) => return Err(UnsplitReason::SharedStatement),
        (Record::Control(_), _) => return Err(UnsplitReason::UnreadArc),
        _ if shared => return Err(UnsplitReason::SharedStatement),
        (Record::Goto(goto), _) if goto.axis.is_none() && has_turning_axis(motion) => {
            return Err(UnsplitReason::UnsaidAxis);
        }
        (Record::DriveArc(_), _) if has_turning_axis(motion) => {
            return Err(UnsplitReason::UnsaidAxis);
        }
        (Record::Goto(_) | Record::DriveArc(_), _) => {}
        _ => return Err(UnsplitReason::OtherStatement),
    }
    let announced = motion.statements.ids().rev().skip(1).filter_map(|id| {
        let found = program.statement(id);
        found.is_live().then(|| (id, found.record()))
    });
    let arc = announced.clone().find(|(_, record)| {
        matches!(record, Record::Circle(_) | Record::MoveArc(_) | Record::StartDirection(_))
    });
    match (&motion.path, record, arc) {
        (MotionPath::Line, Record::Goto(_), None) if announced.clone().next().is_none() => {
            Ok(SplitForm::Line)
        }
        (MotionPath::Arc(_), Record::Goto(_), Some((_, Record::Circle(circle)))) if circle.times > 1 => {
            Err(UnsplitReason::Helix)
        }
        (MotionPath::Arc(_), Record::Goto(_), Some((at, Record::Circle(_)))) => Ok(SplitForm::Circle(at)),
        (MotionPath::Arc(_), Record::Goto(_), Some((at, Record::MoveArc(_)))) => Ok(SplitForm::MoveArc(at)),
        (MotionPath::Arc(_), Record::DriveArc(_), _) if has_goback(program, last) => {
            Err(UnsplitReason::GoBack)
        }
        // INDIRV has no form for a tangent that climbs.
        (MotionPath::Arc(arc), Record::DriveArc(_), _) if arc.rise.abs() > 1e-3 => Err(UnsplitReason::Helix),
        (MotionPath::Arc(_), Record::DriveArc(_), Some((at, Record::StartDirection(_)))) => {
            Ok(SplitForm::Drive(at))
        }
        _ => Err(UnsplitReason::UnreadArc),
    }
}

fn has_goback(program: &Program, statement: StatementId) -> bool {
    crate::write::statement_syntax(program, statement).major_word() == "TLON,GOBACK"
}

fn part_ranges(count: usize, splits: &[SplitMotion]) -> Vec<Range<usize>> {
    let mut splits = splits.iter().peekable();
    let mut start = 0;
    (0..count)
        .map(|index| {
            let parts =
                splits.next_if(|split| split.motion == index).map_or(1, |split| split.poses.len() + 1);
            start += parts;
            start - parts..start
        })
        .collect()
}

fn describe_unsplit_motion(program: &Program, motion: &Motion, why: UnsplitReason) -> Diagnostic {
    let place = program.statement(motion.last_statement()).origin();
    let message = format!("the motion is not split, so that one feed holds for all of it: {why}");
    Diagnostic::new(codes::NOT_CHANGED, message).with_label(program.source(), place, "left whole")
}
