//! Compensation against the passes themselves.

use super::clearance::height;
use super::leads::{self, Around, Moved, leads_written};
use super::passes::{Pass, passes};
use super::profile::{self, Ball, Compensated};
use super::report::{Names, PassReport, Report};
use super::step::Job;
use super::words::Place;
use super::write::Writer;
use crate::diagnostic::{Diagnostic, codes};
use crate::program::Program;
use crate::program::motion::Motion;
use crate::surface::profile::{Chain, Piece, Point};
use crate::transform::Context;
use crate::write::Editor;
use nalgebra::Point3;
use rayon::prelude::*;

/// Findings of one kind that are told one by one.
const TOLD: usize = 10;

/// What printing may add to gouge and gap, in the file's unit: both ends of a chord are off by half the fourth decimal.
const PRINTED: f64 = 1e-4;

/// A pass on its way.
struct Work {
    pass: Pass,
    owners: Vec<usize>,
    done: Compensated,
    /// The path as its points will be, tip or centre.
    path: Chain,
}

pub(super) fn run(
    job: &Job,
    program: Program,
    motions: &[Motion],
    meant: &[bool],
    context: &mut Context<'_>,
) -> Result<(Program, Report), Box<Diagnostic>> {
    let mm = job.file.in_mm();
    let place = Place { program: &program, motions };
    let writer = Writer::new(&program, motions, mm);
    let ball = Ball {
        radius: job.radius,
        was: job.was,
        was_centre: job.was_centre,
        centre: job.centre,
        tolerance: job.tolerance,
        arcs: job.arcs && writer.has_arcs(),
    };
    let found = passes(motions, meant, mm).map_err(|why| place.no_pass(why, context))?;
    let made: Vec<_> = found.into_par_iter().map(|pass| make(pass, motions, mm, &ball)).collect();
    let mut all: Vec<Work> = Vec::with_capacity(made.len());
    for made in made {
        all.push(made.map_err(|(motion, why)| place.fault(&why, motion, context))?);
    }
    tell_unreachable(&all, &place, context);
    let moved: Vec<Moved> = all.iter().map(Work::moved).collect();
    let over = |at: Point3<f64>| {
        let exact = all.iter().map(|work| (&work.pass.plane, &work.done.exact));
        height(exact, if ball.centre { ball.radius } else { 0.0 }, at)
    };
    let ends = leads::around(&Around::new(&program, motions, meant, mm, job.lift()), &moved, &over)
        .map_err(|why| place.stuck(why, context))?;
    for index in ends.keys().copied().chain(all.iter().flat_map(|work| work.pass.motions.clone())) {
        writer.check(&program, index).map_err(|why| place.unwritable(why, index, context))?;
    }
    let names = Names::new(&program, motions);
    let mut reports: Vec<PassReport> = all.iter().map(|work| work.report(&names)).collect();
    let original = program.clone();
    let mut editor = Editor::new(program, context.step);
    for work in &all {
        let contact = job.was.is_none();
        let written = writer.pass(&mut editor, &work.pass, &work.path, (job.radius, contact))?;
        let place = Place { program: &original, motions };
        written.map_err(|why| place.unwritable(why, work.pass.motions.start, context))?;
    }
    leads_written(&writer, &mut editor, motions, &ends, &moved, mm, &original, context)?;
    let program = editor.finish()?;
    prove(&program, &original, motions, &all, &ball, mm, &mut reports, context)?;
    let report = Report::new("profile", (job.radius, job.corner), job.tolerance);
    let report = Report { passes: reports, ..report };
    Ok((program, report))
}

fn make(pass: Pass, motions: &[Motion], mm: f64, ball: &Ball) -> Result<Work, (usize, profile::Fault)> {
    let first = pass.motions.start;
    let (path, owners) = profile::chain(motions, &pass, mm, ball.tolerance).map_err(|why| (first, why))?;
    let done = profile::over(&path, ball).map_err(|why| (first, why))?;
    let path = if ball.centre { done.path.tip_to_centre(ball.radius) } else { done.path.clone() };
    Ok(Work { pass, owners, done, path })
}

impl Work {
    fn moved(&self) -> Moved {
        let space = |at: Point| self.pass.plane.space(at);
        Moved {
            motions: self.pass.motions.clone(),
            start: space(self.path.start()),
            end: space(self.path.end()),
        }
    }

    fn report(&self, names: &Names<'_>) -> PassReport {
        PassReport {
            left_mm: self.done.unreachable.iter().map(|part| part.left).fold(0.0, f64::max),
            profile: drawn(&self.done.contact),
            ..names.pass(&self.pass.motions, self.path.pieces().len())
        }
    }
}

/// A chain as points, arcs every few degrees.
pub(super) fn drawn(chain: &Chain) -> Vec<(f64, f64)> {
    let start = chain.start();
    let mut points = vec![(start.u, start.z)];
    for piece in chain.pieces() {
        let count = match piece {
            Piece::Line(_) => 1,
            Piece::Arc(arc) => (arc.sweep.abs() / 0.05).ceil().max(1.0) as usize,
        };
        points.extend((1..=count).map(|part| {
            let at = piece.point(part as f64 / count as f64);
            (at.u, at.z)
        }));
    }
    points
}

fn tell_unreachable(all: &[Work], place: &Place<'_>, context: &mut Context<'_>) {
    let mut count = 0;
    for work in all {
        for part in &work.done.unreachable {
            count += 1;
            if count > TOLD {
                continue;
            }
            // A recovered profile has other pieces than the path.
            let owner = work
                .owners
                .get(part.first)
                .copied()
                .filter(|_| work.owners.len() == work.done.contact.pieces().len());
            let motion = owner.unwrap_or(work.pass.motions.start);
            let message = format!(
                "the ball does not reach the profile from u = {:.3} to {:.3} mm along this pass: up to {:.3} mm are left",
                part.from.u, part.to.u, part.left
            );
            context.findings.push(place.finding(
                codes::UNREACHABLE,
                message,
                motion,
                "not reached from here",
                context,
            ));
        }
    }
    if count > TOLD {
        let message = format!("{} more places that the ball does not reach", count - TOLD);
        context.findings.push(Diagnostic::new(codes::UNREACHABLE, message));
    }
}

/// Measures the written passes.
#[allow(clippy::too_many_arguments)] // one call, and a struct would only rename them
fn prove(
    program: &Program,
    original: &Program,
    before: &[Motion],
    all: &[Work],
    ball: &Ball,
    mm: f64,
    reports: &mut [PassReport],
    context: &Context<'_>,
) -> Result<(), Box<Diagnostic>> {
    let after: Vec<Motion> = program.motions().collect();
    let place = Place { program: original, motions: before };
    let ranges =
        super::proof::ranges(before, &after, all.iter().map(|work| (&work.pass.motions, pieces(&work.path))))
            .map_err(|motion| {
                place.fail(
                    "the program with the new points does not read back with the motions it should have"
                        .to_owned(),
                    motion,
                    "from here on",
                    context,
                )
            })?;
    let measured: Vec<_> = all
        .par_iter()
        .zip(&ranges)
        .map(|(work, range)| {
            let written = Pass { motions: range.clone(), plane: work.pass.plane };
            let (path, _) = profile::chain(&after, &written, mm, ball.tolerance)?;
            let tip = profile::tip(&path, ball);
            Ok((profile::look(&work.done.contact, &tip, ball), drawn(&tip)))
        })
        .collect::<Vec<Result<_, profile::Fault>>>();
    for ((work, measured), report) in all.iter().zip(measured).zip(reports) {
        let first = work.pass.motions.start;
        let (verdict, path) = measured.map_err(|why| place.fault(&why, first, context))?;
        report.gouge_mm = verdict.gouge;
        report.gap_mm = Some(verdict.gap);
        report.path = path;
        report.naive = naive(&work.done.contact, ball.radius);
        let allowed = ball.tolerance + PRINTED * mm + verdict.bound;
        if verdict.gouge > allowed || verdict.gap > allowed {
            let message = format!(
                "measured again, this pass gouges by {:.4} mm and leaves a gap of {:.4} mm: more than the tolerance of {} mm",
                verdict.gouge, verdict.gap, ball.tolerance
            );
            return Err(place.fail(message, first, "the pass", context));
        }
    }
    Ok(())
}

fn pieces(path: &Chain) -> usize {
    super::write::halves(path).len()
}

/// Each point moved by the normal of its own piece: what must not be driven, for comparison.
fn naive(contact: &Chain, radius: f64) -> Vec<(f64, f64)> {
    let forward = if contact.end().u >= contact.start().u { 1.0 } else { -1.0 };
    let moved = |piece: &Piece, share: f64| {
        let (at, way) = (piece.point(share), piece.direction(share));
        let length = way.u.hypot(way.z).max(1e-12);
        let (nu, nz) = (-way.z / length * forward, way.u / length * forward);
        (at.u + radius * nu, at.z + radius * (nz - 1.0))
    };
    let of = |piece: &Piece| {
        let count = if matches!(piece, Piece::Arc(_)) { 24 } else { 1 };
        (0..=count).map(|part| moved(piece, part as f64 / count as f64)).collect::<Vec<_>>()
    };
    contact.pieces().iter().flat_map(of).collect()
}
