//! This module compensates each pass against its own profile.

use super::compensation_job::CompensateZJob;
use super::findings::MotionFindings;
use super::leads::{self, MovedPass, PassSurroundings, write_leads};
use super::pass_profile::{self, CompensatedPass, CompensatingBall};
use super::pass_writer::PassWriter;
use super::report::{CompensateZReport, PassReport, PassReporter};
use super::tip_clearance::lowest_tip_height_mm;
use super::vertical_passes::{VerticalPass, find_vertical_passes};
use crate::diagnostic::{Failure, codes};
use crate::presentation::display_units::{ColumnUnit, DisplayUnits};
use crate::program::Program;
use crate::program::motion::Motion;
use crate::surface::profile::{Chain, ChainPiece, Point};
use crate::transform::StepContext;
use crate::write::ProgramEditor;
use nalgebra::Point3;
use rayon::prelude::*;

/// What printing may add to gouge and gap, in the file's unit: both ends of a chord are off by half the
/// fourth decimal.
const PRINTED: f64 = 1e-4;

/// A pass while it is compensated.
struct ProfilePass {
    pass: VerticalPass,
    owners: Vec<usize>,
    done: CompensatedPass,
    /// The path as its points will be written: the tip or the centre of the ball.
    path: Chain,
}

pub(super) fn compensate_by_profile(
    job: &CompensateZJob,
    program: Program,
    motions: &[Motion],
    meant: &[bool],
    context: &mut StepContext<'_>,
) -> Result<(Program, CompensateZReport), Failure> {
    let mm_per_unit = job.file.mm_per_unit();
    let place = MotionFindings { program: &program, motions };
    let writer = PassWriter::new(&program, motions, mm_per_unit);
    let ball = make_ball(job, writer.has_arcs());
    let found = find_vertical_passes(motions, meant, mm_per_unit)
        .map_err(|why| place.describe_no_pass(why, context))?;
    let watch = context.watch;
    let make = |pass| watch.check_stop().map(|()| make_profile_pass(pass, motions, mm_per_unit, &ball));
    let made = found.into_par_iter().map(make).collect::<Result<Vec<_>, Failure>>()?;
    let mut all: Vec<ProfilePass> = Vec::with_capacity(made.len());
    for made in made {
        all.push(made.map_err(|(motion, why)| place.describe_pass_fault(&why, motion, context))?);
    }
    report_unreachable(&all, &place, context);
    let moved: Vec<MovedPass> = all.iter().map(ProfilePass::moved_pass).collect();
    let over = |at: Point3<f64>| {
        let exact = all.iter().map(|work| (&work.pass.plane, &work.done.exact));
        lowest_tip_height_mm(exact, if ball.centre { ball.radius } else { 0.0 }, at)
    };
    let ends = leads::move_surroundings(
        &PassSurroundings::new(&program, motions, meant, mm_per_unit, job.lift_mm()),
        &moved,
        &over,
    )
    .map_err(|why| place.describe_lead_conflict(why, context))?;
    // A statement that several points share cannot be changed for one of them, so every motion is checked
    // before the first edit.
    for index in ends.keys().copied().chain(all.iter().flat_map(|work| work.pass.motions.clone())) {
        writer
            .check_writable(&program, index)
            .map_err(|why| place.describe_unwritable_motion(why, index, context))?;
    }
    let names = PassReporter::new(&program, motions);
    let mut reports: Vec<PassReport> = all.iter().map(|work| work.build_report(&names)).collect();
    let original = program.clone();
    let mut editor = ProgramEditor::new(program, context.step);
    for work in &all {
        let contact = job.was.is_none();
        let place = MotionFindings { program: &original, motions };
        writer
            .write_pass(&mut editor, &work.pass, &work.path, (job.radius, contact))
            .map_err(|fault| place.describe_write_fault(fault, work.pass.motions.start, context))?;
    }
    write_leads(&writer, &mut editor, motions, &ends, &moved, mm_per_unit, &original, context)?;
    let program = editor.finish()?;
    prove_profile_passes(&program, &original, motions, &all, &ball, mm_per_unit, &mut reports, context)?;
    let report = CompensateZReport::new("profile", (job.radius, job.corner), job.tolerance);
    let report = CompensateZReport { passes: reports, ..report };
    Ok((program, report))
}

/// Takes what a pass has to know of the ball from the step; arcs are kept where the program has some.
fn make_ball(job: &CompensateZJob, has_arcs: bool) -> CompensatingBall {
    CompensatingBall {
        radius: job.radius,
        was: job.was,
        was_centre: job.was_centre,
        centre: job.centre,
        tolerance: job.tolerance,
        arcs: job.arcs && has_arcs,
    }
}

fn make_profile_pass(
    pass: VerticalPass,
    motions: &[Motion],
    mm_per_unit: f64,
    ball: &CompensatingBall,
) -> Result<ProfilePass, (usize, pass_profile::PassFault)> {
    let first = pass.motions.start;
    let (path, owners) =
        pass_profile::build_chain(motions, &pass, mm_per_unit, ball.tolerance).map_err(|why| (first, why))?;
    let done = pass_profile::compensate_pass(&path, ball).map_err(|why| (first, why))?;
    let path = if ball.centre { done.path.tip_to_centre(ball.radius) } else { done.path.clone() };
    Ok(ProfilePass { pass, owners, done, path })
}

impl ProfilePass {
    fn moved_pass(&self) -> MovedPass {
        let space = |at: Point| self.pass.plane.to_space(at);
        MovedPass {
            motions: self.pass.motions.clone(),
            start: space(self.path.start()),
            end: space(self.path.end()),
        }
    }

    fn build_report(&self, names: &PassReporter<'_>) -> PassReport {
        PassReport {
            left_mm: self.done.unreachable.iter().map(|part| part.left_mm).fold(0.0, f64::max),
            profile: to_drawing_points(&self.done.contact),
            ..names.start_report(&self.pass.motions, self.path.pieces().len())
        }
    }
}

/// Returns a chain as points for a drawing, with points every few degrees on arcs.
pub(super) fn to_drawing_points(chain: &Chain) -> Vec<(f64, f64)> {
    let start = chain.start();
    let mut points = vec![(start.u, start.z)];
    for piece in chain.pieces() {
        let count = match piece {
            ChainPiece::Line(_) => 1,
            ChainPiece::Arc(arc) => (arc.sweep_rad.abs() / 0.05).ceil().max(1.0) as usize,
        };
        points.extend((1..=count).map(|part| {
            let at = piece.point_at(part as f64 / count as f64);
            (at.u, at.z)
        }));
    }
    points
}

fn report_unreachable(all: &[ProfilePass], place: &MotionFindings<'_>, context: &mut StepContext<'_>) {
    let units = DisplayUnits::from_mm(context.file_length_unit(place.program));
    let length = |mm: f64| units.tell_fixed(ColumnUnit::Length, mm, 3);
    for work in all {
        for part in &work.done.unreachable {
            // A recovered profile has other pieces than the path.
            let owner = work
                .owners
                .get(part.first)
                .copied()
                .filter(|_| work.owners.len() == work.done.contact.pieces().len());
            let motion = owner.unwrap_or(work.pass.motions.start);
            let message = format!(
                "the ball does not reach the profile from u = {} to {} along this pass: up to {} are left",
                length(part.from.u),
                length(part.to.u),
                length(part.left_mm)
            );
            let label = "not reached from here";
            let finding = place.build_finding(codes::UNREACHABLE, message, motion, label, context);
            context.findings.push(finding.with_magnitude(part.left_mm));
        }
    }
}

/// Measures the written passes and enters the results in the reports.
#[allow(clippy::too_many_arguments)] // one call, and a struct would only rename them
fn prove_profile_passes(
    program: &Program,
    original: &Program,
    before: &[Motion],
    all: &[ProfilePass],
    ball: &CompensatingBall,
    mm_per_unit: f64,
    reports: &mut [PassReport],
    context: &StepContext<'_>,
) -> Result<(), Failure> {
    let after: Vec<Motion> = program.motions().collect();
    let place = MotionFindings { program: original, motions: before };
    let ranges = super::written_passes::find_written_passes(
        before,
        &after,
        all.iter().map(|work| (&work.pass.motions, count_written_pieces(&work.path))),
    )
    .map_err(|motion| {
        place.build_failure(
            "the program with the new points does not read back with the motions it should have".to_owned(),
            motion,
            "from here on",
            context,
        )
    })?;
    let measured: Vec<_> = all
        .par_iter()
        .zip(&ranges)
        .map(|(work, range)| {
            let written = VerticalPass { motions: range.clone(), plane: work.pass.plane };
            let (path, _) = pass_profile::build_chain(&after, &written, mm_per_unit, ball.tolerance)?;
            let tip = pass_profile::tip_chain(&path, ball);
            Ok((pass_profile::measure_tip_chain(&work.done.contact, &tip, ball), to_drawing_points(&tip)))
        })
        .collect::<Vec<Result<_, pass_profile::PassFault>>>();
    let units = DisplayUnits::from_mm(context.file_length_unit(program));
    for ((work, measured), report) in all.iter().zip(measured).zip(reports) {
        let first = work.pass.motions.start;
        let (verdict, path) = measured.map_err(|why| place.describe_pass_fault(&why, first, context))?;
        report.gouge_mm = verdict.gouge_mm;
        report.gap_mm = Some(verdict.gap_mm);
        report.path = path;
        report.naive = naive_offset_points(&work.done.contact, ball.radius);
        // Besides the tolerance, printing moves points, and the measurement itself is only exact up to its
        // bound.
        let allowed = ball.tolerance + PRINTED * mm_per_unit + verdict.bound_mm;
        if verdict.gouge_mm > allowed || verdict.gap_mm > allowed {
            let message = format!(
                "measured again, this pass gouges by {} and leaves a gap of {}, which is more than the tolerance of {}",
                units.tell_fixed(ColumnUnit::Length, verdict.gouge_mm, 4),
                units.tell_fixed(ColumnUnit::Length, verdict.gap_mm, 4),
                units.tell_trimmed(ColumnUnit::Length, ball.tolerance, 6)
            );
            return Err(place.build_failure(message, first, "the pass", context));
        }
    }
    Ok(())
}

fn count_written_pieces(path: &Chain) -> usize {
    super::pass_writer::split_long_arcs(path).len()
}

/// Returns the path that moving each point by the normal of its own piece would give. It is drawn for
/// comparison and must not be driven, for it crosses itself in concave vertices.
fn naive_offset_points(contact: &Chain, radius: f64) -> Vec<(f64, f64)> {
    let forward = if contact.end().u >= contact.start().u { 1.0 } else { -1.0 };
    let moved = |piece: &ChainPiece, fraction: f64| {
        let (at, tangent) = (piece.point_at(fraction), piece.direction_at(fraction));
        let length = tangent.u.hypot(tangent.z).max(1e-12);
        let (nu, nz) = (-tangent.z / length * forward, tangent.u / length * forward);
        (at.u + radius * nu, at.z + radius * (nz - 1.0))
    };
    let of = |piece: &ChainPiece| {
        let count = if matches!(piece, ChainPiece::Arc(_)) { 24 } else { 1 };
        (0..=count).map(|part| moved(piece, part as f64 / count as f64)).collect::<Vec<_>>()
    };
    contact.pieces().iter().flat_map(of).collect()
}
