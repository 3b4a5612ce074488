//! This module compensates by contact normals: it moves each point along its own normal.

use super::compensation_job::CompensateZJob;
use super::contact_normals::{BallContact, find_gouges};
use super::findings::MotionFindings;
use super::leads::{self, MovedPass, PassSurroundings, write_leads};
use super::pass_writer::PassWriter;
use super::report::{CompensateZReport, PassReport, PassReporter};
use super::vertical_passes::find_cutting_runs;
use super::written_passes;
use crate::diagnostic::{Failure, codes};
use crate::presentation::display_units::{ColumnUnit, DisplayUnits};
use crate::program::Program;
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::transform::StepContext;
use crate::write::ProgramEditor;
use nalgebra::{Point3, Unit, Vector3};
use std::ops::Range;

pub(super) fn compensate_by_normals(
    job: &CompensateZJob,
    program: Program,
    motions: &[Motion],
    meant: &[bool],
    context: &mut StepContext<'_>,
) -> Result<(Program, CompensateZReport), Failure> {
    let mm_per_unit = job.file.mm_per_unit();
    let place = MotionFindings { program: &program, motions };
    let runs = find_cutting_runs(motions, meant, mm_per_unit);
    let mut contacts: Vec<BallContact> = Vec::new();
    let mut owners: Vec<usize> = Vec::new();
    for index in runs.iter().cloned().flatten() {
        let Some(motion) = motions.get(index) else { continue };
        if !matches!(motion.path, MotionPath::Line) {
            let message =
                "an arc or spline has no contact normals between its ends; compensate it `against: profile`";
            return Err(place.build_failure(message.to_owned(), index, "no straight motion", context));
        }
        let contact = job.find_contact(motion, mm_per_unit).ok_or_else(|| {
            let message =
                "this point has no contact normal (GOTO with nine values), which `against: normals` needs";
            place.build_failure(message.to_owned(), index, "no normal", context)
        })?;
        if contact.normal.dot(&contact.axis) < -1e-6 {
            let message = "the contact normal points away from the tool, into the part, so the ball would touch from below";
            return Err(place.build_failure(message.to_owned(), index, "points down", context));
        }
        contacts.push(contact);
        owners.push(index);
    }
    report_gouges(job, &contacts, &owners, &place, context);
    let new = |contact: &BallContact| {
        if job.centre { contact.ball_centre(job.radius) } else { contact.ball_tip(job.radius) }
    };
    let moved: Vec<MovedPass> = runs
        .iter()
        .filter_map(|run| move_run_ends(job, motions, run, &contacts, &owners, mm_per_unit, &new))
        .collect();
    let ends = leads::move_surroundings(
        &PassSurroundings::new(&program, motions, meant, mm_per_unit, job.lift_mm()),
        &moved,
        &|_| None,
    )
    .map_err(|why| place.describe_lead_conflict(why, context))?;
    let writer = PassWriter::new(&program, motions, mm_per_unit);
    for index in ends.keys().copied().chain(owners.iter().copied()) {
        writer
            .check_writable(&program, index)
            .map_err(|why| place.describe_unwritable_motion(why, index, context))?;
    }
    let names = PassReporter::new(&program, motions);
    let reports = build_reports(job, &runs, (&contacts, &owners), &names);
    let original = program.clone();
    let mut editor = ProgramEditor::new(program, context.step);
    for (contact, index) in contacts.iter().zip(&owners) {
        let Some(motion) = motions.get(*index) else { continue };
        editor.set_numbers(motion.last_statement(), &writer.point_numbers(new(contact)))?;
    }
    write_leads(&writer, &mut editor, motions, &ends, &moved, mm_per_unit, &original, context)?;
    let program = editor.finish()?;
    let after: Vec<Motion> = program.motions().collect();
    let counts = runs.iter().map(|run| (run, run.len()));
    let place = MotionFindings { program: &original, motions };
    let wrong = "the program with the new points does not read back as it should";
    let ranges = written_passes::find_written_passes(motions, &after, counts)
        .map_err(|motion| place.build_failure(wrong.to_owned(), motion, "from here on", context))?;
    for (index, contact) in ranges.into_iter().flatten().zip(&contacts) {
        let read = after.get(index).map(|motion| motion.to.point * mm_per_unit);
        // Printing rounds by half of the fourth decimal in each direction.
        if read.is_none_or(|read| (read - new(contact)).amax() > 1e-4 * mm_per_unit) {
            return Err(place.build_failure(
                wrong.to_owned(),
                index.min(motions.len().saturating_sub(1)),
                "here",
                context,
            ));
        }
    }
    let report = CompensateZReport::new("normals", (job.radius, job.corner), job.tolerance);
    let report = CompensateZReport { passes: reports, ..report };
    Ok((program, report))
}

impl CompensateZJob {
    /// Returns the contact at the end of a motion. Returns `None` if the motion has no normal.
    fn find_contact(&self, motion: &Motion, mm_per_unit: f64) -> Option<BallContact> {
        let normal = Unit::try_new(motion.normal?, 1e-9)?;
        let axis = Unit::try_new(motion.to.axis, 1e-9)?;
        let at = motion.to.point * mm_per_unit;
        let was = self.was.unwrap_or(0.0);
        // A path of tips is led back to its contacts by Pc = Ps - R (n - a), one of centres by Pc = C - R n.
        let back: Vector3<f64> = match (self.was, self.was_centre) {
            (None, _) => Vector3::zeros(),
            (Some(_), true) => normal.into_inner() * was,
            (Some(_), false) => (normal.into_inner() - axis.into_inner()) * was,
        };
        Some(BallContact { point: at - back, normal, axis })
    }
}

/// Returns a run with its compensated ends.
fn move_run_ends(
    job: &CompensateZJob,
    motions: &[Motion],
    run: &Range<usize>,
    contacts: &[BallContact],
    owners: &[usize],
    mm_per_unit: f64,
    new: &impl Fn(&BallContact) -> Point3<f64>,
) -> Option<MovedPass> {
    let at = |index: usize| owners.binary_search(&index).ok().and_then(|place| contacts.get(place));
    let (first, last) = (at(run.start)?, at(run.end.checked_sub(1)?)?);
    let before = run.start.checked_sub(1).and_then(|before| motions.get(before));
    // The point before the first contact moves by its own normal. Without a normal it only follows the lift.
    let own = before.and_then(|motion| job.find_contact(motion, mm_per_unit));
    let start = match (own, before) {
        (Some(own), _) => new(&own),
        (None, Some(motion)) => motion.to.point * mm_per_unit + motion.to.axis * job.lift_mm(),
        (None, None) => new(first),
    };
    Some(MovedPass { motions: run.clone(), start, end: new(last) })
}

fn report_gouges(
    job: &CompensateZJob,
    contacts: &[BallContact],
    owners: &[usize],
    place: &MotionFindings<'_>,
    context: &mut StepContext<'_>,
) {
    let found = find_gouges(contacts, job.radius, job.tolerance);
    let units = DisplayUnits::from_mm(job.file);
    for gouge in &found {
        let (Some(motion), Some(neighbour)) = (owners.get(gouge.contact), owners.get(gouge.neighbour)) else {
            continue;
        };
        let message = format!(
            "the ball that touches here cuts {} into another contact point of the path",
            units.tell_fixed(ColumnUnit::Length, gouge.depth_mm, 4)
        );
        let mut finding = place.build_finding(codes::BALL_GOUGES, message, *motion, "touches here", context);
        if let Some(cut) = place.motions.get(*neighbour) {
            let statement = place.program.statement(cut.last_statement());
            finding = finding.with_label(place.program.source(), statement.origin(), "is cut into");
        }
        context.findings.push(finding.with_magnitude(gouge.depth_mm));
    }
}

/// Builds the reports of the runs. The gouge of a run is the deepest cut of one of its balls into another
/// contact point.
fn build_reports(
    job: &CompensateZJob,
    runs: &[Range<usize>],
    (contacts, owners): (&[BallContact], &[usize]),
    names: &PassReporter<'_>,
) -> Vec<PassReport> {
    let mut reports: Vec<PassReport> = runs.iter().map(|run| names.start_report(run, run.len())).collect();
    for gouge in find_gouges(contacts, job.radius, 0.0) {
        let Some(owner) = owners.get(gouge.contact) else { continue };
        // Runs follow each other, so the last one that begins before a motion is the one that may hold it.
        let last = runs.partition_point(|run| run.start <= *owner).checked_sub(1);
        let run = last.filter(|last| runs.get(*last).is_some_and(|run| run.contains(owner)));
        if let Some(report) = run.and_then(|run| reports.get_mut(run)) {
            report.gouge_mm = report.gouge_mm.max(gouge.depth_mm);
        }
    }
    reports
}
