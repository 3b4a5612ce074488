//! This module compensates against a model: it lowers the cutter onto the model along each pass.

use super::compensation_job::CompensateZJob;
use super::cutter_lowering::{lower_cutter, project_from_above};
use super::findings::MotionFindings;
use super::leads::{self, MovedPass, PassSurroundings, write_leads};
use super::pass_writer::PassWriter;
use super::report::{CompensateZReport, PassReport, PassReporter};
use super::vertical_passes::find_cutting_runs;
use super::written_passes;
use crate::diagnostic::{Failure, codes};
use crate::number::format_point;
use crate::parameters::FilePath;
use crate::presentation::display_units::{ColumnUnit, DisplayUnits};
use crate::program::Program;
use crate::program::motion::Motion;
use crate::simulation_run::RunWatcher;
use crate::source::read_file_bytes;
use crate::stock::{AirClip, Mesh};
use crate::surface::drop_cutter::{
    BallClearanceField, CutterClearanceField, DropCutter, DropCutterShape, PathDeviation,
};
use crate::transform::StepContext;
use crate::write::ProgramEditor;
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::ops::Range;

/// The number of points at which all written passes together are measured. More points would take minutes.
const MEASURED_POINTS: f64 = 1e6;

/// Points that are higher than this (mm) above the cutter's lowest position are in the air.
const AIR_CLEARANCE: f64 = 0.5;

/// What printing may add to gouge and gap, in the file's unit.
const PRINTED: f64 = 1e-4;

/// A pass while it is compensated.
struct MeshPass {
    run: Range<usize>,
    /// The new points of the tip, for each motion.
    points: Vec<Vec<[f64; 3]>>,
    start: [f64; 3],
}

pub(super) fn compensate_by_mesh(
    job: &CompensateZJob,
    path: &FilePath,
    program: Program,
    motions: &[Motion],
    meant: &[bool],
    context: &mut StepContext<'_>,
) -> Result<(Program, CompensateZReport), Failure> {
    let mm_per_unit = job.file.mm_per_unit();
    let place = MotionFindings { program: &program, motions };
    let tilted = |(motion, meant): (&Motion, &bool)| *meant && (motion.to.axis - Vector3::z()).amax() > 1e-6;
    if let Some(at) = motions.iter().zip(meant).position(tilted) {
        let message = "the cutter can only be lowered along z, but the tool axis has another direction here";
        return Err(place.build_failure(message.to_owned(), at, "tilted", context));
    }
    let mesh = read_mesh(path, mm_per_unit, context)?;
    let cutter = DropCutterShape::new(2.0 * job.radius, job.corner)
        .map_err(|why| context.step_failure(why.to_string(), &["radius"]))?;
    let dropped = DropCutter::new(&mesh, cutter);
    let near = find_contact_motions(job, motions, meant, &dropped);
    let runs = find_cutting_runs(motions, &near, mm_per_unit);
    let count = runs.len();
    let watch = context.watch;
    let make = |run| watch.check_stop().map(|()| make_mesh_pass(job, motions, run, &dropped));
    let made = runs.into_par_iter().map(make).collect::<Result<Vec<Option<MeshPass>>, Failure>>()?;
    let all: Vec<MeshPass> = made.into_iter().flatten().collect();
    let beside = count - all.len();
    if all.is_empty() {
        let message = "nothing of the model lies under the passes; check that it has the coordinates and the unit of the CL file";
        return Err(context.step_failure(message, &["against", "mesh"]));
    }
    let lift = Vector3::z() * if job.centre { job.radius } else { 0.0 };
    let moved: Vec<MovedPass> = all.iter().filter_map(|work| work.moved_pass(lift)).collect();
    let height = |at: Point3<f64>| dropped.drop_at(at.x, at.y).map(|drop| drop.tip_z_mm + lift.z);
    let ends = leads::move_surroundings(
        &PassSurroundings::new(&program, motions, meant, mm_per_unit, job.lift_mm()),
        &moved,
        &height,
    )
    .map_err(|why| place.describe_lead_conflict(why, context))?;
    let writer = PassWriter::new(&program, motions, mm_per_unit);
    for index in ends.keys().copied().chain(all.iter().flat_map(|work| work.run.clone())) {
        writer
            .check_writable(&program, index)
            .map_err(|why| place.describe_unwritable_motion(why, index, context))?;
    }
    let names = PassReporter::new(&program, motions);
    let mut reports: Vec<PassReport> = all
        .iter()
        .map(|work| names.start_report(&work.run, work.points.iter().map(Vec::len).sum()))
        .collect();
    let original = program.clone();
    let mut editor = ProgramEditor::new(program, context.step);
    for work in &all {
        let points =
            work.points.iter().map(|own| own.iter().map(|at| Point3::from(*at) + lift).collect()).collect();
        let place = MotionFindings { program: &original, motions };
        writer
            .write_points(&mut editor, work.run.clone(), points)
            .map_err(|fault| place.describe_write_fault(fault, work.run.start, context))?;
    }
    write_leads(&writer, &mut editor, motions, &ends, &moved, mm_per_unit, &original, context)?;
    let program = editor.finish()?;
    let after: Vec<Motion> = program.motions().collect();
    let place = MotionFindings { program: &original, motions };
    let counts = all.iter().map(|work| (&work.run, work.points.iter().map(Vec::len).sum()));
    let ranges = written_passes::find_written_passes(motions, &after, counts).map_err(|motion| {
        let message = "the program with the new points does not read back with the motions it should have";
        place.build_failure(message.to_owned(), motion, "from here on", context)
    })?;
    prove_mesh_passes(job, &mesh, cutter, &after, &ranges, lift, &all, &mut reports, &place, context)?;
    report_gouging_links(job, &dropped, &after, &ranges, lift, &program, context)?;
    let report = CompensateZReport::new("mesh", (job.radius, job.corner), job.tolerance);
    let report = CompensateZReport { passes: reports, beside, ..report };
    Ok((program, report))
}

/// Returns for each motion whether it is meant and touches the model. A motion that is higher at either end
/// than the cutter can be there is a link, a retract or a plunge.
fn find_contact_motions(
    job: &CompensateZJob,
    motions: &[Motion],
    meant: &[bool],
    cutter: &DropCutter,
) -> Vec<bool> {
    let mm_per_unit = job.file.mm_per_unit();
    // If the path was made for a larger ball, its tip is higher on slopes: by at most the difference of the
    // radii times (1 / cos - 1), which the factor 2 covers up to 70 degrees.
    let clearance = AIR_CLEARANCE + 2.0 * job.was.map_or(0.0, |was| (was - job.radius).abs());
    let lift = if job.was_centre { job.was.unwrap_or(0.0) } else { 0.0 };
    let above = |point: Point3<f64>| {
        let at = point * mm_per_unit;
        cutter.drop_at(at.x, at.y).is_some_and(|drop| at.z - lift > drop.tip_z_mm + clearance)
    };
    let touches =
        |(motion, meant): (&Motion, &bool)| *meant && !above(motion.from.point) && !above(motion.to.point);
    motions.iter().zip(meant).map(touches).collect()
}

fn read_mesh(path: &FilePath, mm_per_unit: f64, context: &StepContext<'_>) -> Result<Mesh, Failure> {
    let fail = |why: String| {
        context.step_failure(format!("{} cannot be used: {why}", path.as_str()), &["against", "mesh"])
    };
    let bytes = read_file_bytes(&context.resolve_file(path)).map_err(|error| fail(error.to_string()))?;
    let mesh = Mesh::from_stl(&bytes).map_err(|error| fail(error.to_string()))?;
    if mm_per_unit == 1.0 {
        Ok(mesh)
    } else {
        mesh.scaled(mm_per_unit).map_err(|error| fail(error.to_string()))
    }
}

fn make_mesh_pass(
    job: &CompensateZJob,
    motions: &[Motion],
    run: Range<usize>,
    cutter: &DropCutter,
) -> Option<MeshPass> {
    // Printing takes the rest of the tolerance.
    let tolerance = 0.8 * job.tolerance;
    let seen = project_from_above(motions, &run, job.file.mm_per_unit(), tolerance);
    let lines: Vec<Vec<[f64; 2]>> = seen.into_iter().map(|(_, line)| line).collect();
    let mut points = lower_cutter(cutter, &lines, tolerance)?;
    let start = *points.first()?.first()?;
    // Each motion begins where the previous one ends.
    let mut reached = start;
    for own in &mut points {
        if own.first().is_some_and(|first| is_same_point(first, &reached)) {
            own.remove(0);
        }
        if let Some(last) = own.last() {
            reached = *last;
        }
    }
    Some(MeshPass { run, points, start })
}

fn is_same_point(one: &[f64; 3], other: &[f64; 3]) -> bool {
    one.iter().zip(other).all(|(a, b)| (a - b).abs() <= 1e-9)
}

impl MeshPass {
    fn end_point(&self) -> [f64; 3] {
        self.points.iter().flatten().next_back().copied().unwrap_or(self.start)
    }

    fn moved_pass(&self, lift: Vector3<f64>) -> Option<MovedPass> {
        let (start, end) = (Point3::from(self.start) + lift, Point3::from(self.end_point()) + lift);
        Some(MovedPass { motions: self.run.clone(), start, end })
    }
}

/// Measures the written passes in space and enters gouge and gap in the reports.
#[allow(clippy::too_many_arguments)] // one call, and a struct would only rename them
fn prove_mesh_passes(
    job: &CompensateZJob,
    mesh: &Mesh,
    cutter: DropCutterShape,
    after: &[Motion],
    ranges: &[Range<usize>],
    lift: Vector3<f64>,
    all: &[MeshPass],
    reports: &mut [PassReport],
    place: &MotionFindings<'_>,
    context: &StepContext<'_>,
) -> Result<(), Failure> {
    let mm_per_unit = job.file.mm_per_unit();
    let path = |range: &Range<usize>| -> Vec<[f64; 3]> {
        let written = after.get(range.clone());
        debug_assert!(written.is_some(), "a written pass consists of motions of the program");
        let written = written.unwrap_or_default();
        let start = written.first().map(|motion| motion.from.point);
        let points = start.into_iter().chain(written.iter().map(|motion| motion.to.point));
        points.map(|point| (point * mm_per_unit - lift).coords.into()).collect()
    };
    let paths: Vec<Vec<[f64; 3]>> = ranges.iter().map(path).collect();
    let found = measure_tip_paths(job, mesh, cutter, &paths, context.watch)?;
    let units = DisplayUnits::from_mm(job.file);
    for ((work, found), report) in all.iter().zip(found).zip(reports) {
        let Some(found) = found else { continue };
        report.gouge_mm = found.gouge_mm;
        report.gap_mm = Some(found.gap_mm);
        if found.gouge_mm > job.tolerance + PRINTED * mm_per_unit {
            let message = format!(
                "measured again, this pass gouges the model by {} at {} (mm), which is more than the tolerance of {}",
                units.tell_fixed(ColumnUnit::Length, found.gouge_mm, 4),
                format_point(found.gouge_at_mm, 3),
                units.tell_trimmed(ColumnUnit::Length, job.tolerance, 6)
            );
            return Err(place.build_failure(message, work.run.start, "the pass", context));
        }
    }
    Ok(())
}

/// Measures paths in space by another method than the one that made them.
fn measure_tip_paths(
    job: &CompensateZJob,
    mesh: &Mesh,
    cutter: DropCutterShape,
    paths: &[Vec<[f64; 3]>],
    watch: &dyn RunWatcher,
) -> Result<Vec<Option<PathDeviation>>, Failure> {
    if job.corner == job.radius {
        // A ball that is free at two points d apart can dip between them into a sharp edge by the sagitta d^2
        // / (8 R). The step below keeps that to a tenth of the tolerance.
        let error = job.tolerance / 10.0;
        let step = (8.0 * job.radius * error).sqrt();
        let space = BallClearanceField::new(mesh, job.radius);
        let one = |path: &Vec<[f64; 3]>| {
            let seen = space.measure_clearance(path, step)?;
            let (gouge, gap) = ((-seen.low_mm).max(0.0), seen.high_mm.max(0.0));
            Some(PathDeviation {
                gouge_mm: gouge,
                gouge_at_mm: seen.low_at_mm,
                gap_mm: gap,
                gap_at_mm: seen.high_at_mm,
                error_mm: error,
            })
        };
        return paths.par_iter().map(|path| watch.check_stop().map(|()| one(path))).collect();
    }
    // Of a way that goes far away, no more than this is over the model.
    let far = AirClip::around_from_above(mesh.bounds(), 2.0 * job.radius).far_mm();
    let length: f64 =
        paths.iter().flat_map(|path| path.windows(2)).map(|pair| segment_length(pair).min(far)).sum();
    let resolution = job.tolerance.max(length / MEASURED_POINTS);
    // The mesh is sorted once for all passes.
    let field = CutterClearanceField::new(mesh, cutter);
    let step = field.widest_step_mm(job.tolerance / 10.0).max(resolution);
    let measure = |path: &Vec<[f64; 3]>| field.measure_path(path, step, resolution);
    paths.par_iter().map(|path| watch.check_stop().map(|()| measure(path))).collect()
}

fn segment_length(pair: &[[f64; 3]]) -> f64 {
    match pair {
        [a, b] => (Vector3::from(*b) - Vector3::from(*a)).norm(),
        _ => 0.0,
    }
}

/// Reports motions between passes that go through the model.
fn report_gouging_links(
    job: &CompensateZJob,
    cutter: &DropCutter,
    after: &[Motion],
    ranges: &[Range<usize>],
    lift: Vector3<f64>,
    program: &Program,
    context: &mut StepContext<'_>,
) -> Result<(), Failure> {
    let mm_per_unit = job.file.mm_per_unit();
    let place = MotionFindings { program, motions: after };
    let operations: BTreeSet<usize> =
        ranges.iter().filter_map(|range| after.get(range.start)).map(|motion| motion.operation).collect();
    for (index, motion) in after.iter().enumerate() {
        // Passes follow each other, so the last one that begins before a motion is the one that may hold it.
        let begun = ranges.partition_point(|range| range.start <= index);
        let in_pass = begun.checked_sub(1).and_then(|last| ranges.get(last));
        if !operations.contains(&motion.operation) || in_pass.is_some_and(|range| range.contains(&index)) {
            continue;
        }
        context.watch.check_stop()?;
        let points = motion.path.sample_points(motion.from.point, motion.to.point);
        let deepest = points
            .windows(2)
            .map(|pair| deepest_gouge_mm(job, cutter, pair, mm_per_unit, lift.z))
            .fold(0.0, f64::max);
        if deepest > job.tolerance + PRINTED * mm_per_unit {
            let deepest = DisplayUnits::from_mm(job.file).tell_fixed(ColumnUnit::Length, deepest, 3);
            let message = format!("between passes, the tool goes {deepest} into the model here");
            context.findings.push(place.build_finding(
                codes::BALL_GOUGES,
                message,
                index,
                "ends here",
                context,
            ));
        }
    }
    Ok(())
}

/// Returns how far a straight move goes below the lowest allowed height. It is measured at every eighth of
/// the cutter's radius.
fn deepest_gouge_mm(
    job: &CompensateZJob,
    cutter: &DropCutter,
    pair: &[Point3<f64>],
    mm_per_unit: f64,
    lift: f64,
) -> f64 {
    let [from, to] = pair else { return 0.0 };
    let (from, to) = (from * mm_per_unit, to * mm_per_unit);
    let count = ((to - from).xy().norm() / (job.radius / 8.0)).ceil().max(1.0);
    let below = |part: f64| {
        let at = from + (to - from) * (part / count);
        cutter.drop_at(at.x, at.y).map_or(0.0, |drop| drop.tip_z_mm + lift - at.z)
    };
    let near = cutter.surroundings().near_steps(from.coords.into(), to.coords.into(), count);
    let (mut deepest, mut part) = (below(0.0).max(0.0), near[0]);
    while part <= count {
        deepest = deepest.max(below(part));
        part = AirClip::step_behind(part, near, count);
    }
    deepest
}
