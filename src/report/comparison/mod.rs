//! A program before and after: what a page ([`super::html`]) and a summary for merge requests ([`to_markdown`]) tell.
//!
//! [`Subject`] is what there is, [`Runs`] its simulations, [`Comparison`] what follows from both. Lengths are in mm and feeds in mm/min,
//! whatever the file's unit, as in a simulation. Without `before` one program is told of.

mod figures;
mod header;
mod markdown;
mod runs;

pub use figures::{Figures, Peak};
pub use header::{Part, Recorded};
pub use markdown::to_markdown;
pub use runs::Runs;

pub(in crate::report) use figures::moved;
pub(in crate::report) use markdown::{operation_rows, step_row, whole_rows};

use super::changes::Changes;
use super::simulation::Simulated;
use super::stats::{Units, UnitsFrom};
use super::table::{counted, duration};
use crate::diagnostic::Diagnostic;
use crate::program::motion::Motion;
use crate::program::operation::operations;
use crate::program::{LengthUnit, Program};
use crate::setup::Setup;
use crate::source::Source;
use crate::transform::{Recipe, StepReport};
use std::collections::BTreeMap;
use std::sync::Arc;

/// What there is to tell of.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// The program as it was read; `None` to tell of one program alone.
    pub before: Option<&'a Program>,
    /// The program as it stands. With `before`, it is what steps made of that.
    pub program: &'a Program,
    /// The recipe that changed it.
    pub recipe: Option<&'a Recipe>,
    /// The setup that counts.
    pub setup: &'a Setup,
    /// The setup files.
    pub setup_files: &'a [Arc<Source>],
    /// Unit of lengths of a file that does not tell it.
    pub units: Option<LengthUnit>,
    /// What was found.
    pub findings: &'a [Diagnostic],
    /// What steps say about themselves.
    pub reports: &'a [StepReport],
    /// SHA-256 of the recipe and all files that it depends on, in hexadecimal digits, where it was taken.
    pub print: Option<&'a str>,
}

/// A program and its figures, before and after where there is a before.
#[derive(Debug)]
pub struct Comparison<'a> {
    /// What it tells of.
    pub subject: Subject<'a>,
    /// Its simulations.
    pub runs: &'a Runs,
    /// Program, recipe and files by name and hash.
    pub parts: Vec<Part>,
    /// What the steps changed; `None` without a before.
    pub changes: Option<Changes>,
    /// The operations, in the order of the program as it stands; those that are gone come last.
    pub operations: Vec<Row>,
    /// The whole program.
    pub whole: Row,
    /// What was taken for granted, in sentences.
    pub assumptions: Vec<String>,
}

/// Something before and after.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Row {
    /// Name of the operation; empty where the file has none.
    pub name: String,
    /// Tools that move in it, as people call them.
    pub tools: Vec<String>,
    /// Before; `None` where there was none.
    pub before: Option<Figures>,
    /// After; `None` where it is gone.
    pub after: Option<Figures>,
}

impl<'a> Subject<'a> {
    /// The unit of a program's lengths, and how it is known.
    pub(in crate::report) fn units_of(&self, program: &Program) -> Units {
        Units::of(program, self.units.filter(|_| program.units_of_feeds().is_none()))
    }

    /// The machine's rapid feed, mm/min.
    pub(in crate::report) fn rapid_feed(&self) -> Option<f64> {
        self.setup.machine.rapid_feed.map(|feed| feed.get())
    }

    /// The motions of a program that go somewhere: all but first points, which come from nowhere.
    pub(in crate::report) fn motions(program: &'a Program) -> impl Iterator<Item = Motion> + 'a {
        program.motions().filter(|motion| motion.path != crate::program::geometry::Path::Start)
    }
}

impl<'a> Comparison<'a> {
    /// Brings everything together.
    pub fn of(subject: Subject<'a>, runs: &'a Runs) -> Self {
        let changes = subject.before.map(|before| {
            let steps = subject.recipe.map(Recipe::step_names).unwrap_or_default();
            Changes::of(before, subject.program, &steps, subject.units)
        });
        let after = table(&subject, subject.program, runs.after.as_ref());
        // What nobody changed was simulated once.
        let unchanged = changes.as_ref().is_some_and(Changes::is_empty);
        let first = runs.before.as_ref().or(runs.after.as_ref().filter(|_| unchanged));
        let before = subject.before.map(|before| table(&subject, before, first));
        let (operations, whole) = joined(before, after);
        Self {
            parts: header::parts(&subject),
            assumptions: assumptions(&subject, &whole, runs),
            changes,
            operations,
            whole,
            subject,
            runs,
        }
    }
}

/// The operations of one program, and all of them together.
struct Table {
    operations: Vec<(String, Vec<String>, Figures)>,
    whole: (Vec<String>, Figures),
}

fn table(subject: &Subject<'_>, program: &Program, simulated: Option<&Simulated>) -> Table {
    let units = subject.units_of(program).unit;
    let rapid = subject.rapid_feed();
    let names = operations(program).into_iter().map(|operation| operation.name);
    let mut found = Table {
        operations: names.map(|name| (name, Vec::new(), Figures::new(rapid.is_some()))).collect(),
        whole: (Vec::new(), Figures::new(rapid.is_some())),
    };
    for (index, motion) in Subject::motions(program).enumerate() {
        let moved = moved(&motion, units, rapid);
        let row = simulated.and_then(|simulated| simulated.motions.rows.get(index));
        let tool = motion.tool.as_ref().map(|tool| tool.called());
        let note = |tools: &mut Vec<String>| {
            if let Some(tool) = tool.as_ref().filter(|tool| !tools.contains(tool)) {
                tools.push(tool.clone());
            }
        };
        if let Some((_, tools, figures)) = found.operations.get_mut(motion.operation) {
            note(tools);
            figures.add(index, &moved, row);
        }
        note(&mut found.whole.0);
        found.whole.1.add(index, &moved, row);
    }
    found
}

/// Operations of one name belong together in their order.
fn joined(before: Option<Table>, after: Table) -> (Vec<Row>, Row) {
    let mut old: BTreeMap<String, Vec<(Vec<String>, Figures)>> = BTreeMap::new();
    let mut order = Vec::new();
    let mut whole =
        Row { tools: after.whole.0, after: Some(after.whole.1), before: None, name: String::new() };
    if let Some(before) = before {
        whole.before = Some(before.whole.1);
        for (name, tools, figures) in before.operations {
            order.push(name.clone());
            old.entry(name).or_default().push((tools, figures));
        }
        // The first of a name is taken first.
        old.values_mut().for_each(|same| same.reverse());
    }
    let mut rows: Vec<Row> = Vec::new();
    for (name, tools, figures) in after.operations {
        let before = old.get_mut(&name).and_then(Vec::pop).map(|(_, figures)| figures);
        rows.push(Row { name, tools, before, after: Some(figures) });
    }
    for name in order {
        if let Some((tools, figures)) = old.get_mut(&name).and_then(Vec::pop) {
            rows.push(Row { name, tools, before: Some(figures), after: None });
        }
    }
    rows.retain(|row| [&row.before, &row.after].into_iter().flatten().any(|figures| figures.motions > 0));
    (rows, whole)
}

/// How many motions at feed the times leave out.
fn untimed(whole: &Row) -> Option<String> {
    let of = |side: &Option<Figures>| side.map_or(0, |figures| figures.untimed);
    let (before, after) = (of(&whole.before), of(&whole.after));
    let motions = |number| counted(number, "motion", "motions");
    let left_out = match (before, after) {
        (0, 0) => return None,
        _ if before == after || whole.before.is_none() => motions(after),
        _ => format!("{} before and {after} after", motions(before)),
    };
    Some(format!("the time at feed leaves out {left_out} whose feed is not known in mm/min"))
}

/// What the machine's acceleration makes of the time at feed and rapid, where the setup says it.
fn accelerated(runs: &Runs) -> Option<String> {
    let of = |simulated: &Option<Simulated>| simulated.as_ref().and_then(|one| one.accelerated_seconds);
    let after = duration(of(&runs.after)?);
    Some(match of(&runs.before) {
        Some(before) => format!("with it the program takes {} before and {after} after", duration(before)),
        None => format!("with it the program takes {after}"),
    })
}

fn assumptions(subject: &Subject<'_>, whole: &Row, runs: &Runs) -> Vec<String> {
    let mut said = Vec::new();
    match subject.units_of(subject.program) {
        Units { from: UnitsFrom::Assumed, .. } => {
            said.push("the program does not say its unit of length: millimetres are taken".to_owned());
        }
        Units { unit, from: UnitsFrom::Feeds } => {
            said.push(format!("the program does not say its unit of length: taken from its feeds ({unit})"));
        }
        Units { unit, from: UnitsFrom::Caller } => {
            said.push(format!("the program does not say its unit of length: {unit}, as it was told"));
        }
        Units { from: UnitsFrom::File, .. } => {}
    }
    said.push("times are without dwells, and without the machine's acceleration".to_owned());
    said.extend(accelerated(runs));
    if let Some(sentence) = untimed(whole) {
        said.push(sentence);
    }
    if subject.rapid_feed().is_none() {
        said.push("the machine's rapid feed is not known, so rapids take no time".to_owned());
    }
    for simulated in [&runs.before, &runs.after].into_iter().flatten() {
        let accuracy = &simulated.accuracy;
        said.push(format!(
            "simulated with columns {} mm apart: borders of material are known to {} mm across z, curves to {} mm",
            super::table::short(accuracy.cell_mm),
            super::table::short(accuracy.lateral_mm),
            accuracy.chord_mm
        ));
        said.extend(simulated.assumptions.iter().cloned());
    }
    said.extend(runs.assumptions.iter().cloned());
    let mut seen = Vec::new();
    said.retain(|sentence| {
        let new = !seen.contains(sentence);
        seen.push(sentence.clone());
        new
    });
    said
}
