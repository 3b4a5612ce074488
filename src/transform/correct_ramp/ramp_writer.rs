//! This module writes a corrected ramp into the CL text.
//!
//! The statements of the old ramp keep their places with everything between them, and additional points are
//! inserted before them. If the feed decreases during the descent, all points are inserted where it is
//! lowest. The statement of the ramp's end stays byte for byte, unless it ends an arc that changes.

use super::ramp::{NOTHING, Ramp, RampStep};
use super::ramp_search::FoundRamp;
use crate::diagnostic::Failure;
use crate::parse;
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::record::{ArcSense, Circle};
use crate::program::{Program, Record, StatementId};
use crate::transform::statement_numbers::{copy_statement, delete_keeping_remark, pair_with_indices};
use crate::write::ProgramEditor;
use nalgebra::{Point3, Vector3};
use std::f64::consts::TAU;
use std::ops::Range;

/// If the file cannot state an arc, chords replace it that stay this close to it, in mm.
const CHORD: f64 = 0.005;

/// The reason why a ramp's statements cannot be given other points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub(super) enum UnwritableRamp {
    #[error("one of its statements is not a plain GOTO of a single point")]
    NoGoto,
    #[error("one of its points has a contact normal")]
    ContactNormal,
    #[error("one of its statements makes other motions as well")]
    Shared,
    #[error("one of its arcs is announced by a record that cannot be rewritten")]
    Arc,
    #[error("its feed increases or changes its unit during the descent, so no feed is safe for new points")]
    Feed,
    #[error(
        "cutter compensation (CUTCOM) is on, and the control would offset the new points to changing sides"
    )]
    Compensation,
}

/// The reason why a ramp was not written.
#[derive(Debug)]
pub(super) enum RampWriteFault {
    /// Its statements cannot be given other points.
    Unwritable(UnwritableRamp),
    /// An edit failed, for example because a statement does not read back.
    Failed(Failure),
}

impl From<UnwritableRamp> for RampWriteFault {
    fn from(why: UnwritableRamp) -> Self {
        Self::Unwritable(why)
    }
}

impl From<Failure> for RampWriteFault {
    fn from(failure: Failure) -> Self {
        Self::Failed(failure)
    }
}

/// What was written for a ramp.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct WrittenRamp {
    /// The ramp as it should read back. Arcs that the file cannot state are chords here.
    pub ramp: Ramp,
    /// Whether a motion down to its lowered start was inserted before it.
    pub lead: bool,
    /// Whether the statement before it was lowered.
    pub lowered: bool,
}

/// The statements of one motion of a ramp.
#[derive(Debug, Clone, Copy)]
struct RampMotionStatements {
    goto: StatementId,
    arc: Option<StatementId>,
}

/// Checks that a ramp's statements can be given other points.
pub(super) fn check_writable(
    program: &Program,
    motions: &[Motion],
    range: &Range<usize>,
) -> Result<(), UnwritableRamp> {
    find_motion_statements(program, motions, range)?;
    has_single_feed(motions, range).map(|_| ())
}

/// Returns whether a single feed governs the whole ramp. If not, its last feed has to be the lowest.
fn has_single_feed(motions: &[Motion], range: &Range<usize>) -> Result<bool, UnwritableRamp> {
    let all = motions.get(range.clone());
    debug_assert!(all.is_some(), "a ramp consists of motions of the program");
    let all = all.unwrap_or_default();
    let last = all.last().and_then(|motion| motion.feed);
    // A FEDRAT between CIRCLE and its GOTO governs that arc, but not what would be inserted before the
    // CIRCLE.
    let inside = |motion: &Motion| motion.feed_from.is_some_and(|from| from >= motion.statements.first());
    if all.iter().any(inside) {
        return Err(UnwritableRamp::Feed);
    }
    if all.iter().all(|motion| motion.feed == last) {
        return Ok(true);
    }
    let Some(last) = last else { return Err(UnwritableRamp::Feed) };
    let slower =
        |motion: &Motion| motion.feed.is_some_and(|feed| feed.unit == last.unit && feed.value >= last.value);
    if all.iter().all(slower) { Ok(false) } else { Err(UnwritableRamp::Feed) }
}

fn find_motion_statements(
    program: &Program,
    motions: &[Motion],
    range: &Range<usize>,
) -> Result<Vec<RampMotionStatements>, UnwritableRamp> {
    let one = |index: usize| {
        let motion = motions.get(index).ok_or(UnwritableRamp::NoGoto)?;
        let goto = motion.last_statement();
        let live = |id: StatementId| Some(program.statement(id)).filter(|found| found.is_live());
        if !matches!(live(goto).map(|found| found.record()), Some(Record::Goto(_))) {
            return Err(UnwritableRamp::NoGoto);
        }
        if motion.normal.is_some() {
            return Err(UnwritableRamp::ContactNormal);
        }
        let beside = [index.wrapping_sub(1), index + 1];
        let shares = |other: &usize| motions.get(*other).is_some_and(|other| other.last_statement() == goto);
        if beside.iter().any(shares) {
            return Err(UnwritableRamp::Shared);
        }
        let announced = motion.statements.ids().rev().skip(1);
        let mut arcs = announced.filter(|id| {
            live(*id).is_some_and(|found| {
                matches!(
                    found.record(),
                    Record::Circle(_) | Record::MoveArc(_) | Record::StartDirection(_) | Record::Nurbs
                )
            })
        });
        let arc = arcs.next();
        let announcement = arc.and_then(live).map(|found| found.record());
        match (&motion.path, announcement) {
            (MotionPath::Line, None) | (MotionPath::Arc(_), Some(Record::Circle(_) | Record::MoveArc(_))) => {
                Ok(RampMotionStatements { goto, arc })
            }
            _ => Err(UnwritableRamp::Arc),
        }
    };
    range.clone().map(one).collect()
}

/// Writes a corrected ramp.
///
/// # Errors
/// Returns [`RampWriteFault`] if a statement cannot be read back, or if the old statements allow no other
/// points.
pub(super) fn write_ramp(
    editor: &mut ProgramEditor,
    motions: &[Motion],
    found: &FoundRamp,
    new: &Ramp,
    mm_per_unit: f64,
) -> Result<WrittenRamp, RampWriteFault> {
    let mut forms = find_motion_statements(editor.program(), motions, &found.motions)?;
    let one_feed = has_single_feed(motions, &found.motions)?;
    let (Some(first), Some(last)) = (forms.first().copied(), forms.last().copied()) else {
        return Err(UnwritableRamp::NoGoto.into());
    };
    let arc = forms.iter().find_map(|form| form.arc);
    let writer = RampWriter {
        found,
        mm_per_unit,
        goto: first.goto,
        circle: arc.and_then(|arc| find_circle(editor.program(), arc)),
    };
    let new = writer.with_writable_arcs(new);
    // If the feed decreases during the descent, all new points are inserted where it is lowest.
    let place = if one_feed { found.motions.start } else { found.motions.end.saturating_sub(1) };
    if !one_feed {
        for form in forms.drain(..forms.len().saturating_sub(1)) {
            delete_keeping_remark(editor, form.goto)?;
            form.arc.map_or(Ok(()), |arc| editor.delete_statement(arc))?;
        }
    }
    let before = motions.get(place).map_or(first.goto, |motion| motion.statements.first());
    let (lead, lowered) = writer.lower_start(editor, motions, &new, before)?;
    let steps: Vec<(Point3<f64>, RampStep)> =
        new.steps_with_starts().map(|(from, step)| (from, *step)).collect();
    let extra = steps.len().saturating_sub(forms.len());
    let (put_in, rest) = steps.split_at(extra);
    for (_, step) in put_in {
        writer.insert_step(editor, step, before)?;
    }
    // If there are fewer points than before, the last statements are deleted, except the very last one.
    let kept = rest.len().saturating_sub(1);
    for ((_, step), form) in rest.iter().zip(forms.iter().take(kept).chain([&last])) {
        writer.rewrite_step(editor, step, *form)?;
    }
    for form in forms.iter().skip(kept).take(forms.len().saturating_sub(kept + 1)) {
        delete_keeping_remark(editor, form.goto)?;
        form.arc.map_or(Ok(()), |arc| editor.delete_statement(arc))?;
    }
    Ok(WrittenRamp { ramp: new, lead, lowered })
}

struct RampWriter<'a> {
    found: &'a FoundRamp,
    mm_per_unit: f64,
    /// The GOTO on which new ones are modelled.
    goto: StatementId,
    /// The CIRCLE on which new ones are modelled.
    circle: Option<(StatementId, Circle)>,
}

impl RampWriter<'_> {
    fn to_file_point(&self, point: Point3<f64>) -> [f64; 3] {
        ((self.found.frame.inverse() * point) / self.mm_per_unit).coords.into()
    }

    /// Returns the ramp with arcs only where the file has a CIRCLE that can state them.
    fn with_writable_arcs(&self, ramp: &Ramp) -> Ramp {
        let mut steps = Vec::with_capacity(ramp.steps.len());
        for (from, step) in ramp.steps_with_starts() {
            let Some(bend) = step.bend else {
                steps.push(*step);
                continue;
            };
            if self.circle_axis_sign(bend.sweep).is_some() {
                steps.push(*step);
                continue;
            }
            let radius = (from.xy() - bend.centre).norm();
            // The sagitta R (1 - cos(sweep / 2)) of a chord gives its widest sweep.
            let widest = 2.0 * (1.0 - (CHORD / radius).min(1.0)).acos();
            let count = (bend.sweep.abs() / widest).ceil().max(1.0);
            for index in 1..=count as usize {
                let fraction = index as f64 / count;
                let spoke = nalgebra::Rotation2::new(bend.sweep * fraction) * (from.xy() - bend.centre);
                let at = bend.centre + spoke;
                steps.push(RampStep::straight_to(Point3::new(
                    at.x,
                    at.y,
                    from.z + (step.to.z - from.z) * fraction,
                )));
            }
            if let Some(last) = steps.last_mut() {
                last.to = step.to;
            }
        }
        Ramp { start: ramp.start, steps }
    }

    /// Returns the sign of a new CIRCLE's axis for a sense of rotation: 1 for the axis of the old CIRCLE, -1
    /// for its opposite. Returns `None` if the file cannot state it.
    fn circle_axis_sign(&self, sweep: f64) -> Option<f64> {
        let (_, circle) = self.circle.as_ref()?;
        let old = self.found.ramp.steps.iter().find_map(|step| step.bend)?;
        match (old.sweep * sweep > 0.0, circle.sense) {
            (true, _) => Some(1.0),
            (false, ArcSense::OfDialect) => Some(-1.0),
            (false, _) => None,
        }
    }

    /// Brings the tool down to a start that is lower than before. If the motion before goes straight down at
    /// feed, it is extended. Otherwise a motion is inserted. Returns whether one was inserted, and whether
    /// the one before was extended.
    fn lower_start(
        &self,
        editor: &mut ProgramEditor,
        motions: &[Motion],
        new: &Ramp,
        before: StatementId,
    ) -> Result<(bool, bool), Failure> {
        if self.found.ramp.start.z - new.start.z <= 1e-9 {
            return Ok((false, false));
        }
        let index = self.found.motions.start.checked_sub(1);
        let above = index.and_then(|index| motions.get(index).map(|motion| (index, motion)));
        let straight = above.filter(|(index, motion)| {
            let displacement = self.found.frame * (motion.to.point - motion.from.point) * self.mm_per_unit;
            let down = displacement.z < 0.0 && displacement.xy().norm() <= NOTHING;
            let alike = self.found.frame * motion.from.axis - Vector3::z();
            down && !motion.rapid
                && motion.hole.is_none()
                && alike.amax() <= 1e-6
                && find_motion_statements(editor.program(), motions, &(*index..index + 1)).is_ok()
        });
        let place = self.to_file_point(new.start);
        match straight {
            Some((_, motion)) => {
                editor.set_numbers(motion.last_statement(), &pair_with_indices(0, place))?;
                Ok((false, true))
            }
            None => {
                let text = copy_statement(editor, self.goto, &pair_with_indices(0, place));
                editor.insert_before(before, &text)?;
                Ok((true, false))
            }
        }
    }

    /// Inserts a new statement, or two for an arc.
    fn insert_step(
        &self,
        editor: &mut ProgramEditor,
        step: &RampStep,
        before: StatementId,
    ) -> Result<(), Failure> {
        if let Some((statement, numbers)) = self.circle_numbers(editor.program(), step) {
            let text = copy_statement(editor, statement, &numbers);
            editor.insert_before(before, &text)?;
        }
        let goto = copy_statement(editor, self.goto, &pair_with_indices(0, self.to_file_point(step.to)));
        editor.insert_before(before, &goto)
    }

    /// Changes the numbers in the statements of an old motion.
    fn rewrite_step(
        &self,
        editor: &mut ProgramEditor,
        step: &RampStep,
        form: RampMotionStatements,
    ) -> Result<(), Failure> {
        let circle = self.circle_numbers(editor.program(), step);
        match (circle, form.arc) {
            (Some((_, numbers)), Some(arc)) if is_circle(editor.program(), arc) => {
                editor.set_numbers(arc, &numbers)?;
            }
            (Some((statement, numbers)), _) => {
                let text = copy_statement(editor, statement, &numbers);
                form.arc.map_or(Ok(()), |arc| editor.delete_statement(arc))?;
                editor.insert_before(form.goto, &text)?;
            }
            (None, arc) => arc.map_or(Ok(()), |arc| editor.delete_statement(arc))?,
        }
        editor.set_numbers(form.goto, &pair_with_indices(0, self.to_file_point(step.to)))
    }

    /// Returns the CIRCLE on which new ones are modelled, with the numbers for a step.
    fn circle_numbers(&self, program: &Program, step: &RampStep) -> Option<(StatementId, Vec<(usize, f64)>)> {
        let bend = step.bend?;
        let (statement, circle) = self.circle.as_ref()?;
        let sense = self.circle_axis_sign(bend.sweep)?;
        let centre = self.to_file_point(Point3::new(bend.centre.x, bend.centre.y, step.to.z));
        let mut numbers = pair_with_indices(0, centre);
        numbers.extend(pair_with_indices(3, <[f64; 3]>::from(circle.axis * sense)));
        if circle.radius.is_some() {
            numbers.push((6, (step.to.xy() - bend.centre).norm() / self.mm_per_unit));
        }
        if circle.times > 1 {
            let turns = (bend.sweep.abs() / TAU - 1e-6).ceil().max(1.0);
            numbers.extend(find_times_number(program, *statement).map(|index| (index, turns)));
        }
        Some((*statement, numbers))
    }
}

fn find_circle(program: &Program, statement: StatementId) -> Option<(StatementId, Circle)> {
    match program.statement(statement).record() {
        Record::Circle(circle) => Some((statement, circle.as_ref().clone())),
        _ => None,
    }
}

fn is_circle(program: &Program, statement: StatementId) -> bool {
    find_circle(program, statement).is_some()
}

/// Returns the index of the number after `TIMES`.
fn find_times_number(program: &Program, statement: StatementId) -> Option<usize> {
    let found = program.statement(statement);
    let syntax = parse::syntax(program.statement_text(found));
    let word = (0..syntax.fields.len()).find(|field| syntax.word_at(*field).as_deref() == Some("TIMES"))?;
    let place = &syntax.fields.get(word + 1)?.at;
    syntax.numbers().iter().position(|(at, _)| at == place)
}
