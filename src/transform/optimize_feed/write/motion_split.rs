//! This module splits motions into parts, in the CL text.
//!
//! A line becomes GOTOs in its own form. An arc becomes arcs, each announced by the same record as the whole
//! arc. The result is read back and compared with the old path. A motion whose parts do not read back
//! correctly stays whole and is reported.

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
    /// For each motion of the program before, the indices of the motions that it has become.
    pub parts: Vec<Range<usize>>,
    /// The motions that should have been split and are still whole, by their indices before, with the
    /// reasons.
    pub kept: Vec<(usize, UnsplitReason)>,
}

/// The reason why a motion is not split.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum UnsplitReason {
    /// It is a rapid, which has no feed to change.
    Rapid,
    /// It belongs to a drilling cycle, whose motions have no statements of their own.
    Hole,
    /// It is a spline (NURBS). Splitting it would need new knots.
    Spline,
    /// It has its statement in common with other points, or is a line of bare numbers.
    SharedStatement,
    /// It has a contact normal, and nothing says how the normal turns along it.
    ContactNormal,
    /// Its statement states more than a point (FROM, GOHOME, GODLTA), or has nothing before it.
    OtherStatement,
    /// A CIRCLE, INDIRV or NURBS before it was not understood.
    UnreadArc,
    /// Its tool axis turns, but the statement does not print it.
    UnsaidAxis,
    /// Its tool axis is reversed.
    OppositeAxis,
    /// It is a helix of several turns (`TIMES`), or one that its record cannot state.
    Helix,
    /// It has TLON,GOBACK, so parts after the first would go back again.
    GoBack,
    /// Its parts would not read back as the same path.
    NotReadBack,
}

impl UnsplitReason {
    /// Returns whether the record is of a kind that can usually be split, so that the user should be
    /// informed.
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
            Self::OppositeAxis => "its tool axis is reversed",
            Self::Helix => "it is a helix whose parts the record cannot say",
            Self::GoBack => "it runs backwards from its start direction",
            Self::NotReadBack => "its parts would not read back as the same path",
        })
    }
}

/// Splits motions. Each is given by its index and the fractions of its length (between 0 and 1, ascending) at
/// which it is split.
///
/// The coordinates of new points are rounded to the file's decimals, so a point is off its path by at most
/// half of the last decimal. The statement that ends the motion stays byte for byte. The exceptions are a
/// CATIA arc whose last part has half a turn or less, which loses its `2,INTOF`, and MOVARC, whose angle
/// becomes the angle of the first part. Everything else is untouched.
///
/// A motion that cannot be split stays whole and is listed in [`SplitProgram::kept`]. If its kind can usually
/// be split, a finding reports the place. Fractions outside 0..1 or out of order are ignored.
///
/// Returns an error if a new statement cannot be read back.
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

/// Returns the motions that can be split, with the poses of their parts, and those that cannot.
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

/// Returns the form in which the parts of a motion are written.
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
        // INDIRV cannot state a tangent that climbs.
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
    let message = format!("the motion is not split and has a single feed, because {why}");
    Diagnostic::new(codes::NOT_CHANGED, message).with_label(program.source(), place, "left whole")
}
