//! Compensation against a model: the cutter lowered onto it along each pass.

use super::leads::{self, Around, Moved, leads_written};
use super::model::{lowered, seen_from_above};
use super::passes::runs;
use super::proof;
use super::report::{Names, PassReport, Report};
use super::step::Job;
use super::words::Place;
use super::write::Writer;
use crate::diagnostic::{Diagnostic, codes};
use crate::program::Program;
use crate::program::motion::Motion;
use crate::sim::Mesh;
use crate::surface::drop::{Cutter, Deviation, DropCutter, Space, deviation};
use crate::transform::Context;
use crate::values::FilePath;
use crate::write::Editor;
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use std::ops::Range;
use std::path::Path;

/// Places at which written passes are looked at, all together: more would take minutes.
const LOOKS: f64 = 1e6;

/// Points this far above where the cutter would stand (mm) are in the air.
const AIR: f64 = 0.5;

/// What printing may add to gouge and gap, in the file's unit.
const PRINTED: f64 = 1e-4;

/// A pass on its way.
struct Work {
    run: Range<usize>,
    /// The tip's new points, for each motion.
    points: Vec<Vec<[f64; 3]>>,
    start: [f64; 3],
}

pub(super) fn run(
    job: &Job,
    path: &FilePath,
    program: Program,
    motions: &[Motion],
    meant: &[bool],
    context: &mut Context<'_>,
) -> Result<(Program, Report), Box<Diagnostic>> {
    let mm = job.file.in_mm();
    let place = Place { program: &program, motions };
    let tilted = |(motion, meant): (&Motion, &bool)| *meant && (motion.to.axis - Vector3::z()).amax() > 1e-6;
    if let Some(at) = motions.iter().zip(meant).position(tilted) {
        let message = "the cutter is lowered along z, and here the tool axis is another";
        return Err(place.fail(message.to_owned(), at, "tilted", context));
    }
    let mesh = mesh(path, mm, context)?;
    let cutter = Cutter::new(2.0 * job.radius, job.corner)
        .map_err(|why| context.fail(why.to_string(), &["radius"]))?;
    let dropped = DropCutter::new(&mesh, cutter);
    let near = in_contact(job, motions, meant, &dropped);
    let runs = runs(motions, &near, mm);
    let count = runs.len();
    let made: Vec<Option<Work>> = runs.into_par_iter().map(|run| make(job, motions, run, &dropped)).collect();
    let all: Vec<Work> = made.into_iter().flatten().collect();
    let beside = count - all.len();
    if all.is_empty() {
        let message = "nothing of the model lies under the passes; is it in the coordinates and the unit of the CL file?";
        return Err(context.fail(message, &["against", "mesh"]));
    }
    let lift = Vector3::z() * if job.centre { job.radius } else { 0.0 };
    let moved: Vec<Moved> = all.iter().filter_map(|work| work.moved(lift)).collect();
    let height = |at: Point3<f64>| dropped.height(at.x, at.y).map(|drop| drop.tip_z + lift.z);
    let ends = leads::around(&Around::new(&program, motions, meant, mm, job.lift()), &moved, &height)
        .map_err(|why| place.stuck(why, context))?;
    let writer = Writer::new(&program, motions, mm);
    for index in ends.keys().copied().chain(all.iter().flat_map(|work| work.run.clone())) {
        writer.check(&program, index).map_err(|why| place.unwritable(why, index, context))?;
    }
    let names = Names::new(&program, motions);
    let mut reports: Vec<PassReport> =
        all.iter().map(|work| names.pass(&work.run, work.points.iter().map(Vec::len).sum())).collect();
    let original = program.clone();
    let mut editor = Editor::new(program, context.step);
    for work in &all {
        let points =
            work.points.iter().map(|own| own.iter().map(|at| Point3::from(*at) + lift).collect()).collect();
        let written = writer.points(&mut editor, work.run.clone(), points)?;
        let place = Place { program: &original, motions };
        written.map_err(|why| place.unwritable(why, work.run.start, context))?;
    }
    leads_written(&writer, &mut editor, motions, &ends, &moved, mm, &original, context)?;
    let program = editor.finish()?;
    let after: Vec<Motion> = program.motions().collect();
    let place = Place { program: &original, motions };
    let counts = all.iter().map(|work| (&work.run, work.points.iter().map(Vec::len).sum()));
    let ranges = proof::ranges(motions, &after, counts).map_err(|motion| {
        let message = "the program with the new points does not read back with the motions it should have";
        place.fail(message.to_owned(), motion, "from here on", context)
    })?;
    prove(job, &mesh, cutter, &after, &ranges, lift, &all, &mut reports, &place, context)?;
    between(job, &dropped, &after, &ranges, lift, &program, context);
    let report = Report::new("mesh", (job.radius, job.corner), job.tolerance);
    let report = Report { passes: reports, beside, ..report };
    Ok((program, report))
}

/// The motions that are meant and touch the model: one that is higher at either end than the cutter could stand there is a link, a retract or
/// a plunge.
fn in_contact(job: &Job, motions: &[Motion], meant: &[bool], cutter: &DropCutter) -> Vec<bool> {
    let mm = job.file.in_mm();
    // A larger ball than this one stood higher on slopes.
    let room = AIR + 2.0 * job.was.map_or(0.0, |was| (was - job.radius).abs());
    let lift = if job.was_centre { job.was.unwrap_or(0.0) } else { 0.0 };
    let above = |point: Point3<f64>| {
        let at = point * mm;
        cutter.height(at.x, at.y).is_some_and(|drop| at.z - lift > drop.tip_z + room)
    };
    let touches =
        |(motion, meant): (&Motion, &bool)| *meant && !above(motion.from.point) && !above(motion.to.point);
    motions.iter().zip(meant).map(touches).collect()
}

fn mesh(path: &FilePath, mm: f64, context: &Context<'_>) -> Result<Mesh, Box<Diagnostic>> {
    let fail =
        |why: String| context.fail(format!("{} cannot be used: {why}", path.as_str()), &["against", "mesh"]);
    let full = path.beside(Path::new(context.recipe.source.name()));
    let bytes = std::fs::read(full).map_err(|error| fail(error.to_string()))?;
    let mesh = Mesh::from_stl(&bytes).map_err(|error| fail(error.to_string()))?;
    if mm == 1.0 { Ok(mesh) } else { mesh.scaled(mm).map_err(|error| fail(error.to_string())) }
}

fn make(job: &Job, motions: &[Motion], run: Range<usize>, cutter: &DropCutter) -> Option<Work> {
    // Printing has a little of the tolerance.
    let tolerance = 0.8 * job.tolerance;
    let seen = seen_from_above(motions, &run, job.file.in_mm(), tolerance);
    let lines: Vec<Vec<[f64; 2]>> = seen.into_iter().map(|(_, line)| line).collect();
    let mut points = lowered(cutter, &lines, tolerance)?;
    let start = *points.first()?.first()?;
    // Each motion begins where the one before ends.
    let mut reached = start;
    for own in &mut points {
        if own.first().is_some_and(|first| same(first, &reached)) {
            own.remove(0);
        }
        if let Some(last) = own.last() {
            reached = *last;
        }
    }
    Some(Work { run, points, start })
}

fn same(one: &[f64; 3], other: &[f64; 3]) -> bool {
    one.iter().zip(other).all(|(a, b)| (a - b).abs() <= 1e-9)
}

impl Work {
    fn end(&self) -> [f64; 3] {
        self.points.iter().flatten().next_back().copied().unwrap_or(self.start)
    }

    fn moved(&self, lift: Vector3<f64>) -> Option<Moved> {
        let (start, end) = (Point3::from(self.start) + lift, Point3::from(self.end()) + lift);
        Some(Moved { motions: self.run.clone(), start, end })
    }
}

/// Measures the written passes in space.
#[allow(clippy::too_many_arguments)] // one call, and a struct would only rename them
fn prove(
    job: &Job,
    mesh: &Mesh,
    cutter: Cutter,
    after: &[Motion],
    ranges: &[Range<usize>],
    lift: Vector3<f64>,
    all: &[Work],
    reports: &mut [PassReport],
    place: &Place<'_>,
    context: &Context<'_>,
) -> Result<(), Box<Diagnostic>> {
    let mm = job.file.in_mm();
    let path = |range: &Range<usize>| -> Vec<[f64; 3]> {
        let written = after.get(range.clone()).unwrap_or_default();
        let start = written.first().map(|motion| motion.from.point);
        let points = start.into_iter().chain(written.iter().map(|motion| motion.to.point));
        points.map(|point| (point * mm - lift).coords.into()).collect()
    };
    let paths: Vec<Vec<[f64; 3]>> = ranges.iter().map(path).collect();
    let found = look(job, mesh, cutter, &paths);
    for ((work, found), report) in all.iter().zip(found).zip(reports) {
        let Some(found) = found else { continue };
        report.gouge_mm = found.gouge;
        report.gap_mm = Some(found.gap);
        if found.gouge > job.tolerance + PRINTED * mm {
            let message = format!(
                "measured again, this pass gouges the model by {:.4} mm at ({:.3}, {:.3}, {:.3}): more than the tolerance of {} mm",
                found.gouge, found.gouge_at[0], found.gouge_at[1], found.gouge_at[2], job.tolerance
            );
            return Err(place.fail(message, work.run.start, "the pass", context));
        }
    }
    Ok(())
}

/// Looks at paths in space by other means than they were made.
fn look(job: &Job, mesh: &Mesh, cutter: Cutter, paths: &[Vec<[f64; 3]>]) -> Vec<Option<Deviation>> {
    if job.corner == job.radius {
        // Between two places, a ball passes what is free at both by no more than a tenth of the tolerance.
        let error = job.tolerance / 10.0;
        let step = (8.0 * job.radius * error).sqrt();
        let space = Space::new(mesh, job.radius);
        let one = |path: &Vec<[f64; 3]>| {
            let seen = space.along(path, step)?;
            let (gouge, gap) = ((-seen.low).max(0.0), seen.high.max(0.0));
            Some(Deviation { gouge, gouge_at: seen.low_at, gap, gap_at: seen.high_at, error })
        };
        return paths.par_iter().map(one).collect();
    }
    let length: f64 = paths.iter().flat_map(|path| path.windows(2)).map(distance).sum();
    let resolution = job.tolerance.max(length / LOOKS);
    paths.par_iter().map(|path| deviation(mesh, cutter, path, resolution)).collect()
}

fn distance(pair: &[[f64; 3]]) -> f64 {
    match pair {
        [a, b] => (Vector3::from(*b) - Vector3::from(*a)).norm(),
        _ => 0.0,
    }
}

/// Motions between passes that go through the model.
fn between(
    job: &Job,
    cutter: &DropCutter,
    after: &[Motion],
    ranges: &[Range<usize>],
    lift: Vector3<f64>,
    program: &Program,
    context: &mut Context<'_>,
) {
    let mm = job.file.in_mm();
    let place = Place { program, motions: after };
    let operations: Vec<usize> =
        ranges.iter().filter_map(|range| after.get(range.start)).map(|motion| motion.operation).collect();
    for (index, motion) in after.iter().enumerate() {
        if !operations.contains(&motion.operation) || ranges.iter().any(|range| range.contains(&index)) {
            continue;
        }
        let points = motion.path.samples(motion.from.point, motion.to.point);
        let deepest =
            points.windows(2).map(|pair| deepest(job, cutter, pair, mm, lift.z)).fold(0.0, f64::max);
        if deepest > job.tolerance + PRINTED * mm {
            let message = format!("between passes, the tool goes {deepest:.3} mm into the model here");
            context.findings.push(place.finding(codes::BALL_GOUGES, message, index, "ends here", context));
        }
    }
}

/// How far below the lowest height a straight move goes, looked at every eighth of the cutter's radius.
fn deepest(job: &Job, cutter: &DropCutter, pair: &[Point3<f64>], mm: f64, lift: f64) -> f64 {
    let [from, to] = pair else { return 0.0 };
    let (from, to) = (from * mm, to * mm);
    let count = ((to - from).xy().norm() / (job.radius / 8.0)).ceil().clamp(1.0, 1e5) as usize;
    let below = |part: usize| {
        let at = from + (to - from) * (part as f64 / count as f64);
        cutter.height(at.x, at.y).map_or(0.0, |drop| drop.tip_z + lift - at.z)
    };
    (0..=count).map(below).fold(0.0, f64::max)
}
