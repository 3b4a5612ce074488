//! Compensation by contact normals: each point moves by its own.

use super::leads::{self, Around, Moved, leads_written};
use super::normals::{Contact, gouges};
use super::passes::runs;
use super::proof;
use super::report::{Names, PassReport, Report};
use super::step::Job;
use super::words::Place;
use super::write::Writer;
use crate::diagnostic::{Diagnostic, codes};
use crate::program::Program;
use crate::program::geometry::Path;
use crate::program::motion::Motion;
use crate::transform::Context;
use crate::write::Editor;
use nalgebra::{Point3, Unit, Vector3};
use std::ops::Range;

/// Gouges that are told one by one.
const TOLD: usize = 10;

pub(super) fn run(
    job: &Job,
    program: Program,
    motions: &[Motion],
    meant: &[bool],
    context: &mut Context<'_>,
) -> Result<(Program, Report), Box<Diagnostic>> {
    let mm = job.file.in_mm();
    let place = Place { program: &program, motions };
    let runs = runs(motions, meant, mm);
    let mut contacts: Vec<Contact> = Vec::new();
    let mut owners: Vec<usize> = Vec::new();
    for index in runs.iter().cloned().flatten() {
        let Some(motion) = motions.get(index) else { continue };
        if !matches!(motion.path, Path::Line) {
            let message = "an arc or spline has no contact normal at each of its points; compensate it `against: profile`";
            return Err(place.fail(message.to_owned(), index, "no straight motion", context));
        }
        let contact = job.contact(motion, mm).ok_or_else(|| {
            let message =
                "this point has no contact normal (GOTO with nine values), which `against: normals` needs";
            place.fail(message.to_owned(), index, "no normal", context)
        })?;
        if contact.normal.dot(&contact.axis) < -1e-6 {
            let message =
                "the contact normal points away from the tool, into the part: the ball would come from below";
            return Err(place.fail(message.to_owned(), index, "points down", context));
        }
        contacts.push(contact);
        owners.push(index);
    }
    tell_gouges(job, &contacts, &owners, &place, context);
    let new =
        |contact: &Contact| if job.centre { contact.centre(job.radius) } else { contact.tip(job.radius) };
    let moved: Vec<Moved> =
        runs.iter().filter_map(|run| moved(job, motions, run, &contacts, &owners, mm, &new)).collect();
    let ends = leads::around(&Around::new(&program, motions, meant, mm, job.lift()), &moved, &|_| None)
        .map_err(|why| place.stuck(why, context))?;
    let writer = Writer::new(&program, motions, mm);
    for index in ends.keys().copied().chain(owners.iter().copied()) {
        writer.check(&program, index).map_err(|why| place.unwritable(why, index, context))?;
    }
    let names = Names::new(&program, motions);
    let reports = reports(job, &runs, (&contacts, &owners), &names);
    let original = program.clone();
    let mut editor = Editor::new(program, context.step);
    for (contact, index) in contacts.iter().zip(&owners) {
        let Some(motion) = motions.get(*index) else { continue };
        editor.set_numbers(motion.last_statement(), &writer.numbers(new(contact)))?;
    }
    leads_written(&writer, &mut editor, motions, &ends, &moved, mm, &original, context)?;
    let program = editor.finish()?;
    let after: Vec<Motion> = program.motions().collect();
    let counts = runs.iter().map(|run| (run, run.len()));
    let place = Place { program: &original, motions };
    let wrong = "the program with the new points does not read back as it should";
    let ranges = proof::ranges(motions, &after, counts)
        .map_err(|motion| place.fail(wrong.to_owned(), motion, "from here on", context))?;
    for (index, contact) in ranges.into_iter().flatten().zip(&contacts) {
        let read = after.get(index).map(|motion| motion.to.point * mm);
        // Half of the fourth decimal in each direction.
        if read.is_none_or(|read| (read - new(contact)).amax() > 1e-4 * mm) {
            return Err(place.fail(
                wrong.to_owned(),
                index.min(motions.len().saturating_sub(1)),
                "here",
                context,
            ));
        }
    }
    let report = Report::new("normals", (job.radius, job.corner), job.tolerance);
    let report = Report { passes: reports, ..report };
    Ok((program, report))
}

impl Job {
    /// The contact that a motion ends at; `None` without a normal.
    fn contact(&self, motion: &Motion, mm: f64) -> Option<Contact> {
        let normal = Unit::try_new(motion.normal?, 1e-9)?;
        let axis = Unit::try_new(motion.to.axis, 1e-9)?;
        let at = motion.to.point * mm;
        let was = self.was.unwrap_or(0.0);
        let back: Vector3<f64> = match (self.was, self.was_centre) {
            (None, _) => Vector3::zeros(),
            (Some(_), true) => normal.into_inner() * was,
            (Some(_), false) => (normal.into_inner() - axis.into_inner()) * was,
        };
        Some(Contact { point: at - back, normal, axis })
    }
}

/// A run's ends as they are to be.
fn moved(
    job: &Job,
    motions: &[Motion],
    run: &Range<usize>,
    contacts: &[Contact],
    owners: &[usize],
    mm: f64,
    new: &impl Fn(&Contact) -> Point3<f64>,
) -> Option<Moved> {
    let at = |index: usize| owners.binary_search(&index).ok().and_then(|place| contacts.get(place));
    let (first, last) = (at(run.start)?, at(run.end.checked_sub(1)?)?);
    let before = run.start.checked_sub(1).and_then(|before| motions.get(before));
    // The point before the first contact moves by its own normal, if it has one, and else not at all.
    let own = before.and_then(|motion| job.contact(motion, mm));
    let start = match (own, before) {
        (Some(own), _) => new(&own),
        (None, Some(motion)) => motion.to.point * mm + motion.to.axis * job.lift(),
        (None, None) => new(first),
    };
    Some(Moved { motions: run.clone(), start, end: new(last) })
}

fn tell_gouges(
    job: &Job,
    contacts: &[Contact],
    owners: &[usize],
    place: &Place<'_>,
    context: &mut Context<'_>,
) {
    let found = gouges(contacts, job.radius, job.tolerance);
    for gouge in found.iter().take(TOLD) {
        let (Some(motion), Some(neighbour)) = (owners.get(gouge.contact), owners.get(gouge.neighbour)) else {
            continue;
        };
        let message = format!(
            "the ball that touches here cuts {:.4} mm into another contact point of the path",
            gouge.depth
        );
        let mut finding = place.finding(codes::BALL_GOUGES, message, *motion, "touches here", context);
        let statement =
            place.motions.get(*neighbour).and_then(|motion| place.program.statement(motion.last_statement()));
        if let Some(statement) = statement {
            finding = finding.label(place.program.source(), statement.origin(), "is cut into");
        }
        context.findings.push(finding);
    }
    if found.len() > TOLD {
        let message = format!("{} more balls cut into other contact points", found.len() - TOLD);
        context.findings.push(Diagnostic::new(codes::BALL_GOUGES, message));
    }
}

/// The reports of runs: of their balls, the deepest gouge of a contact point.
fn reports(
    job: &Job,
    runs: &[Range<usize>],
    (contacts, owners): (&[Contact], &[usize]),
    names: &Names<'_>,
) -> Vec<PassReport> {
    let all = gouges(contacts, job.radius, 0.0);
    let deepest = |run: &Range<usize>| {
        let own =
            all.iter().filter(|gouge| owners.get(gouge.contact).is_some_and(|owner| run.contains(owner)));
        own.map(|gouge| gouge.depth).fold(0.0, f64::max)
    };
    runs.iter().map(|run| PassReport { gouge_mm: deepest(run), ..names.pass(run, run.len()) }).collect()
}
