//! This module compares a program before and after a change, for a page ([`super::html`]) and for a summary
//! in merge requests ([`to_markdown`]).
//!
//! A caller fills a [`ComparisonSubject`] with programs, recipe, setup and findings, simulates it
//! ([`ComparisonRuns`]) and makes the [`Comparison`] from both. Lengths are in mm and feeds in mm/min, as in
//! a simulation; a reader sees them in the units of [`Comparison::units`]. Without a program before, the
//! comparison describes a single program.

mod compared_files;
mod figure_columns;
mod figures;
mod file_differences;
mod headline;
mod markdown;
mod simulation_runs;
mod verdict;

pub use compared_files::{ComparedFile, ComparedFileRole};
pub use figures::{ComparisonFigures, ComparisonPeak};
pub use file_differences::FileDifferences;
pub use headline::HeadlineFigure;
pub use markdown::to_markdown;
pub use simulation_runs::ComparisonRuns;
pub use verdict::{Verdict, VerdictLevel};

pub(in crate::report) use figure_columns::{build_operation_table, build_whole_table};
pub(in crate::report) use headline::{OperationTimes, choose_headlines, operation_times};
pub(in crate::report) use markdown::build_step_table;

use super::changes::RecipeChanges;
use super::machine_time::{GroupTimer, MachineClock};
use super::motion_measure::{MotionFeedAndTime, measure_motion};
use super::simulation::{MotionRow, SimulationReport};
use super::stats::{LengthUnitOrigin, ResolvedLengthUnit};
use super::table::{ColumnUnit, DisplayUnits};
use super::text_format::{self, format_counted};
use crate::diagnostic::Diagnostic;
use crate::program::motion::{ActiveTool, Motion};
use crate::program::operation::find_operations;
use crate::program::{LengthUnit, Program};
use crate::setup::Setup;
use crate::source::Source;
use crate::transform::{Recipe, TransformReport};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// The inputs of a comparison.
#[derive(Debug, Clone, Copy)]
pub struct ComparisonSubject<'a> {
    /// The program as it was read, or the program of another file. It is `None` if a single program is described.
    pub before: Option<&'a Program>,
    /// The program in its current state. If there is a program `before` of the same source, it is the program that
    /// the steps have made of that one.
    pub program: &'a Program,
    /// The recipe that changed it.
    pub recipe: Option<&'a Recipe>,
    /// The setup in force.
    pub setup: &'a Setup,
    /// The setup files.
    pub setup_files: &'a [Arc<Source>],
    /// The unit of lengths to use for a program that states none.
    pub units: Option<LengthUnit>,
    /// The unit of lengths that a reader sees. With `None`, it is the unit of `program`.
    pub shown_in: Option<LengthUnit>,
    /// The findings of the run.
    pub findings: &'a [Diagnostic],
    /// What steps report about themselves.
    pub reports: &'a [Box<dyn TransformReport>],
    /// The SHA-256 of the recipe and all files on which it depends, in hexadecimal digits, if it was
    /// computed.
    pub print: Option<&'a str>,
}

/// A program with its figures, before and after if there is a program before.
#[derive(Debug)]
pub struct Comparison<'a> {
    /// The inputs.
    pub subject: ComparisonSubject<'a>,
    /// Its simulations.
    pub runs: &'a ComparisonRuns,
    /// Program, recipe and files with names and hashes.
    pub parts: Vec<ComparedFile>,
    /// The changes of the steps. It is `None` without a program before, and between two files.
    pub changes: Option<RecipeChanges>,
    /// The differences between two files.
    pub differences: Option<FileDifferences>,
    /// The operations in the order of the current program. Those that were removed come last.
    pub operations: Vec<ComparisonRow>,
    /// The whole program.
    pub whole: ComparisonRow,
    /// The assumptions, in sentences.
    pub assumptions: Vec<String>,
}

/// The figures of something before and after.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ComparisonRow {
    /// The name of the operation. It is empty if the file has none.
    pub name: String,
    /// The tools that move in it, by number and name.
    pub tools: Vec<String>,
    /// The figures before. It is `None` if it did not exist.
    pub before: Option<ComparisonFigures>,
    /// The figures after. It is `None` if it was removed.
    pub after: Option<ComparisonFigures>,
}

impl<'a> ComparisonSubject<'a> {
    /// Returns the unit of a program's lengths, and how it is known.
    pub(in crate::report) fn resolve_length_unit(&self, program: &Program) -> ResolvedLengthUnit {
        ResolvedLengthUnit::from_program(program, self.units.filter(|_| program.feed_length_unit().is_none()))
    }

    /// Returns the program before if it is that of another file.
    pub(in crate::report) fn other_file(&self) -> Option<&'a Program> {
        self.before.filter(|before| !Arc::ptr_eq(before.source(), self.program.source()))
    }

    /// Returns whether the program is not written, since an error was found.
    pub fn is_refused(&self) -> bool {
        self.findings.iter().any(Diagnostic::is_error)
    }

    /// Returns the units that a reader sees.
    pub fn display_units(&self) -> DisplayUnits {
        DisplayUnits::of_program(self.resolve_length_unit(self.program).unit, self.shown_in)
    }

    /// Returns the machine's rapid feed in mm/min. Returns `None` if the setup does not state it.
    pub(in crate::report) fn rapid_feed_mm_min(&self) -> Option<f64> {
        self.setup.machine.rapid_feed.map(|feed| feed.get())
    }

    /// Returns the machine's acceleration, with which it changes feeds, in (mm/min)/s. Returns `None` if the
    /// setup does not state it.
    pub(in crate::report) fn acceleration(&self) -> Option<f64> {
        self.setup.machine.max_acceleration.map(|most| most.get())
    }

    /// Returns the motions of a program without its first points, because no path leads to a first point.
    pub(in crate::report) fn motions_after_start(program: &'a Program) -> impl Iterator<Item = Motion> + 'a {
        program.motions().filter(|motion| motion.path != crate::program::geometry::MotionPath::Start)
    }
}

impl<'a> Comparison<'a> {
    /// Returns the units that a reader sees.
    pub fn units(&self) -> DisplayUnits {
        self.subject.display_units()
    }

    /// Makes the comparison of a subject from its simulations.
    pub fn from_runs(subject: ComparisonSubject<'a>, runs: &'a ComparisonRuns) -> Self {
        let differences = subject.other_file().map(|other| FileDifferences::new(other, subject.program));
        let changed = subject.before.filter(|_| differences.is_none());
        let changes = changed.map(|before| {
            let steps = subject.recipe.map(Recipe::step_names).unwrap_or_default();
            RecipeChanges::from_programs(before, subject.program, &steps, subject.units)
        });
        let after = measure_operations(&subject, subject.program, runs.after.as_ref());
        // An unchanged program is simulated only once, so the run of `after` also holds for `before`.
        let unchanged = changes.as_ref().is_some_and(RecipeChanges::is_empty);
        let first = runs.before.as_ref().or(runs.after.as_ref().filter(|_| unchanged));
        let before = subject.before.map(|before| measure_operations(&subject, before, first));
        let (operations, whole) = pair_operations(before, after);
        Self {
            parts: compared_files::hash_compared_files(&subject),
            assumptions: list_assumptions(&subject, &whole, runs),
            changes,
            differences,
            operations,
            whole,
            subject,
            runs,
        }
    }
}

/// The operations of one program, and all of them together.
struct OperationFigures {
    /// The name, the tools and the figures of each operation.
    operations: Vec<(String, Vec<String>, ComparisonFigures)>,
    /// The tools and the figures of the whole program.
    whole: (Vec<String>, ComparisonFigures),
}

impl OperationFigures {
    // A function of its own, which a browser compiles anew and better while the loop over all motions goes on.
    #[inline(never)]
    fn add_motion(
        &mut self,
        (index, operation): (usize, usize),
        moved: &MotionFeedAndTime,
        row: Option<&MotionRow>,
    ) {
        if let Some((_, _, figures)) = self.operations.get_mut(operation) {
            figures.add_motion(index, moved, row);
        }
        self.whole.1.add_motion(index, moved, row);
    }
}

fn measure_operations(
    subject: &ComparisonSubject<'_>,
    program: &Program,
    simulated: Option<&SimulationReport>,
) -> OperationFigures {
    let units = subject.resolve_length_unit(program).unit;
    let rapid = subject.rapid_feed_mm_min();
    let names = find_operations(program).into_iter().map(|operation| operation.name);
    let mut found = OperationFigures {
        operations: names.map(|name| (name, Vec::new(), ComparisonFigures::new(rapid.is_some()))).collect(),
        whole: (Vec::new(), ComparisonFigures::new(rapid.is_some())),
    };
    let mut timer = MachineClock::new(program, units, subject.setup).start_timer();
    let mut timers = vec![timer.clone(); found.operations.len()];
    let mut noted = NotedTools::default();
    for (index, motion) in ComparisonSubject::motions_after_start(program).enumerate() {
        let moved = measure_motion(&motion, units, rapid);
        timer.add_motion(program, &motion, index, (moved.length_mm, moved.feed_mm_min));
        if let Some(timer) = timers.get_mut(motion.operation) {
            timer.add_motion(program, &motion, index, (moved.length_mm, moved.feed_mm_min));
        }
        if let Some(tool) = &motion.tool {
            noted.note_tool(motion.operation, tool, &mut found);
        }
        let row = simulated.and_then(|simulated| simulated.motions.rows.get(index));
        found.add_motion((index, motion.operation), &moved, row);
    }
    let finish = |figures: &mut ComparisonFigures, timer: &GroupTimer| {
        figures.accelerated_seconds = timer.feed_seconds();
        timer.replace_rapid_seconds(&mut figures.rapid_seconds);
        figures.standing_seconds = timer.standing_seconds();
    };
    finish(&mut found.whole.1, &timer);
    for ((.., figures), timer) in found.operations.iter_mut().zip(&timers) {
        finish(figures, timer);
    }
    found
}

/// The tools that are noted already, by name: of an operation, and of the whole program. A program may have as many tools
/// as operations, so nothing is looked for along a list.
#[derive(Default)]
struct NotedTools {
    names: BTreeSet<(Option<usize>, String)>,
    last: Option<(usize, Arc<ActiveTool>)>,
}

impl NotedTools {
    /// Notes the tool of a motion where it is new.
    fn note_tool(&mut self, operation: usize, tool: &Arc<ActiveTool>, found: &mut OperationFigures) {
        // A tool mostly stays for many motions.
        if self.last.as_ref().is_some_and(|(last, known)| *last == operation && Arc::ptr_eq(known, tool)) {
            return;
        }
        self.last = Some((operation, Arc::clone(tool)));
        let name = tool.display_name();
        if let Some((_, tools, _)) = found.operations.get_mut(operation)
            && self.names.insert((Some(operation), name.clone()))
        {
            tools.push(name.clone());
        }
        if self.names.insert((None, name.clone())) {
            found.whole.0.push(name);
        }
    }
}

/// Pairs operations before and after by name; of several with the same name, the first belongs to the first.
/// Returns the rows of operations and the row of the whole program.
fn pair_operations(
    before: Option<OperationFigures>,
    after: OperationFigures,
) -> (Vec<ComparisonRow>, ComparisonRow) {
    let mut old: BTreeMap<String, Vec<(Vec<String>, ComparisonFigures)>> = BTreeMap::new();
    let mut order = Vec::new();
    let mut whole =
        ComparisonRow { tools: after.whole.0, after: Some(after.whole.1), before: None, name: String::new() };
    if let Some(before) = before {
        whole.before = Some(before.whole.1);
        for (name, tools, figures) in before.operations {
            order.push(name.clone());
            old.entry(name).or_default().push((tools, figures));
        }
        // `pop` takes the last one, and of operations with the same name the first must be taken first.
        old.values_mut().for_each(|same| same.reverse());
    }
    let mut rows: Vec<ComparisonRow> = Vec::new();
    for (name, tools, figures) in after.operations {
        let before = old.get_mut(&name).and_then(Vec::pop).map(|(_, figures)| figures);
        rows.push(ComparisonRow { name, tools, before, after: Some(figures) });
    }
    for name in order {
        if let Some((tools, figures)) = old.get_mut(&name).and_then(Vec::pop) {
            rows.push(ComparisonRow { name, tools, before: Some(figures), after: None });
        }
    }
    rows.retain(|row| [&row.before, &row.after].into_iter().flatten().any(|figures| figures.motions > 0));
    (rows, whole)
}

/// Describes how many motions at feed the times leave out.
fn describe_untimed_motions(whole: &ComparisonRow) -> Option<String> {
    let of = |side: &Option<ComparisonFigures>| side.map_or(0, |figures| figures.untimed);
    let (before, after) = (of(&whole.before), of(&whole.after));
    let motions = |number| format_counted(number, "motion", "motions");
    let left_out = match (before, after) {
        (0, 0) => return None,
        _ if before == after || whole.before.is_none() => motions(after),
        _ => format!("{} before and {after} after", motions(before)),
    };
    Some(format!("the time at feed leaves out {left_out} whose feed is not known in mm/min"))
}

fn list_assumptions(
    subject: &ComparisonSubject<'_>,
    whole: &ComparisonRow,
    runs: &ComparisonRuns,
) -> Vec<String> {
    let units = subject.display_units();
    let mut said = Vec::new();
    match subject.resolve_length_unit(subject.program) {
        ResolvedLengthUnit { from: LengthUnitOrigin::Assumed, .. } => {
            said.push("the program does not state its unit of length: millimetres are assumed".to_owned());
        }
        ResolvedLengthUnit { unit, from: LengthUnitOrigin::Feeds } => {
            said.push(format!(
                "the program does not state its unit of length: it is taken from its feeds ({unit})"
            ));
        }
        ResolvedLengthUnit { unit, from: LengthUnitOrigin::Caller } => {
            said.push(format!("the program does not state its unit of length: {unit} was given"));
        }
        ResolvedLengthUnit { from: LengthUnitOrigin::File | LengthUnitOrigin::Shown, .. } => {}
    }
    said.push(match subject.acceleration() {
        _ if subject.setup.machine.dynamics().is_some() => "times are those of the machine, with its corners; places along time \
             in charts are, too, without the time that it stands"
            .to_owned(),
        Some(acceleration) => {
            let feed = ColumnUnit::FeedPerMinute;
            let acceleration = text_format::format_short(units.convert(feed, acceleration));
            let per_minute = feed.symbol(units.shown_in);
            format!(
                "times are without dwells, with feeds that change by {acceleration} ({per_minute})/s at most; places \
                 along time in charts are without acceleration"
            )
        }
        None => "times are without dwells, and without the machine's acceleration".to_owned(),
    });
    if let Some(sentence) = describe_untimed_motions(whole) {
        said.push(sentence);
    }
    if subject.rapid_feed_mm_min().is_none() && subject.setup.machine.chain.is_none() {
        said.push("the machine's rapid feed is not known, so rapids take no time".to_owned());
    }
    for simulated in [&runs.before, &runs.after].into_iter().flatten() {
        let accuracy = &simulated.accuracy;
        said.push(format!(
            "simulated with columns {} apart: boundaries of material are known to {} across z, curves to {}",
            units.tell_trimmed(ColumnUnit::Length, accuracy.cell_mm, 3),
            units.tell_trimmed(ColumnUnit::Length, accuracy.lateral_mm, 3),
            units.tell_trimmed(ColumnUnit::Length, accuracy.chord_mm, 6)
        ));
        if simulated.totals.chip_thickness_bound_mm.is_some() {
            said.push(simulated.describe_chip_certainty(units));
        }
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
