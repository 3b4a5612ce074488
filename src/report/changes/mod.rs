//! This module counts what a recipe has changed in a program, step by step.
//!
//! Each step is credited with its own changes ([`Program::step_edits`]), even if a later step changed the
//! same statements again. The JSON ([`to_json`]) is [`RecipeChanges`] itself, with `"version": 1`. `version`
//! goes up when a reader of the old structure would fail. New keys may be added without that.

mod text;

use crate::program::LengthUnit;
pub use text::{steps_to_text, to_text};

use super::stats::{MotionLengthAndTime, MotionTotals, ResolvedLengthUnit};
use super::table::DisplayUnits;
use crate::program::RecordKind;
use crate::program::geometry::MotionPath;
use crate::program::{Program, StepEdits};
use crate::report::machine_time::{GroupTimer, MachineClock};
use crate::report::motion_measure::measure_motion;
use crate::setup::Setup;
use serde::Serialize;
use std::collections::BTreeMap;

/// The changes that a recipe has made to a program.
///
/// ```
/// use clsmith::parameters::Factor;
/// use clsmith::parse::parse;
/// use clsmith::program::LengthUnit;
/// use clsmith::report::changes::RecipeChanges;
/// use clsmith::setup::Setup;
/// use clsmith::source::Source;
/// use clsmith::transform::{ScaleFeed, run_steps};
///
/// let part = b"FROM/0,0,0\nFEDRAT/MMPM,600.\nGOTO/100,0,0\n";
/// let before = parse(&Source::new("part.cls", part.to_vec())?, None).program;
/// let step = ScaleFeed::new(Factor::new(2.0).expect("2 is above 0"));
/// let after = run_steps(&[&step], LengthUnit::Mm, &Setup::default(), before.clone())?.program;
/// let changes = RecipeChanges::from_programs(&before, &after, &["scale_feed"], None);
/// assert_eq!((changes.steps[0].edited.len(), changes.untouched), (1, 2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct RecipeChanges {
    /// Version of the JSON structure: 1.
    pub version: u32,
    /// The file's name.
    pub file: String,
    /// The unit of the program before.
    #[serde(skip)]
    units_before: LengthUnit,
    /// The unit of the program after.
    #[serde(skip)]
    units_after: LengthUnit,
    /// The unit of lengths, before and after: that of the program after.
    pub units: ResolvedLengthUnit,
    /// The steps in order, including those without a change.
    pub steps: Vec<StepChanges>,
    /// The number of statements that no step touched.
    pub untouched: usize,
    /// Lengths and times before. Rapids have a time once [`RecipeChanges::with_machine`] knows the machine.
    pub before: MotionTotals,
    /// Lengths and times of the program after.
    pub after: MotionTotals,
}

/// The changes of one step, by kind of statement.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct StepChanges {
    /// The step's name in the recipe.
    pub name: String,
    /// Statements that got a new text.
    pub edited: BTreeMap<RecordKind, usize>,
    /// Statements that were inserted.
    pub inserted: BTreeMap<RecordKind, usize>,
    /// Statements that were deleted.
    pub deleted: BTreeMap<RecordKind, usize>,
}

impl StepChanges {
    /// Returns whether the step changed nothing.
    pub fn is_empty(&self) -> bool {
        self.edited.is_empty() && self.inserted.is_empty() && self.deleted.is_empty()
    }
}

impl RecipeChanges {
    /// Counts what each of `steps` has changed. `steps` are the names of the steps in the recipe's order, and
    /// `after` is the program that they made of `before`: each of its changed statements is signed with its
    /// step. A step that signed a change and is not in `steps` is added at the end, without a name. `caller`
    /// is the unit of lengths if neither the program nor its feeds state one; steps find the unit in the same
    /// way.
    pub fn from_programs(
        before: &Program,
        after: &Program,
        steps: &[&str],
        caller: Option<LengthUnit>,
    ) -> Self {
        let told = |program: &Program| {
            ResolvedLengthUnit::from_program(program, caller.filter(|_| program.feed_length_unit().is_none()))
        };
        let (units_before, units) = (told(before), told(after));
        // A step may have changed the unit; numbers that stand side by side must not.
        let as_after = DisplayUnits { values_in: units_before.unit, shown_in: units.unit };
        let (steps, untouched) = count_step_changes(after, steps);
        Self {
            version: 1,
            units_before: units_before.unit,
            units_after: units.unit,
            file: after.source().name().to_owned(),
            units,
            steps,
            untouched,
            before: sum_motions(before, units_before).converted(as_after),
            after: sum_motions(after, units),
        }
    }

    /// Adds the times that depend on the machine, where the setup says what it can: with its acceleration, and at rapid.
    /// The programs are those that were compared.
    #[must_use]
    pub fn with_machine(mut self, before: &Program, after: &Program, setup: &Setup) -> Self {
        let told =
            [(&mut self.before, before, self.units_before), (&mut self.after, after, self.units_after)];
        for (totals, program, unit) in told {
            let clock = MachineClock::new(program, unit, setup);
            let timer = time_motions(program, unit, &clock);
            totals.accelerated_seconds = timer.feed_seconds();
            totals.rapid_seconds = time_at_rapid(program, unit, setup);
            timer.replace_rapid_seconds(&mut totals.rapid_seconds);
            totals.standing_seconds = timer.standing_seconds();
        }
        self
    }

    /// Converts all lengths to the unit that a reader wants to see; `None` leaves them in the program's unit.
    #[must_use]
    pub fn shown_in(mut self, unit: Option<LengthUnit>) -> Self {
        if let Some((units, shown)) = self.units.show_in(unit) {
            self.units = shown;
            (self.before, self.after) = (self.before.converted(units), self.after.converted(units));
        }
        self
    }

    /// Returns whether no step changed anything.
    pub fn is_empty(&self) -> bool {
        self.steps.iter().all(StepChanges::is_empty)
    }
}

/// Returns the changes of each of `steps`, and the number of statements that no step touched; see
/// [`RecipeChanges::from_programs`].
pub fn count_step_changes(after: &Program, steps: &[&str]) -> (Vec<StepChanges>, usize) {
    let named = |name: &&str| StepChanges { name: (*name).to_owned(), ..StepChanges::default() };
    let mut found: Vec<StepChanges> = steps.iter().map(named).collect();
    for edits in after.step_edits() {
        let index = usize::from(edits.step.0);
        if found.len() <= index {
            found.resize(index + 1, StepChanges::default());
        }
        if let Some(step) = found.get_mut(index) {
            let StepEdits { edited, inserted, deleted, .. } = edits;
            *step = StepChanges { name: std::mem::take(&mut step.name), edited, inserted, deleted };
        }
    }
    let untouched = after.statements().iter().filter(|statement| statement.edited_by().is_none()).count();
    (found, untouched)
}

fn sum_motions(program: &Program, units: ResolvedLengthUnit) -> MotionTotals {
    let mut totals = MotionTotals::default();
    program
        .motions()
        .for_each(|motion| totals.add_motion(&MotionLengthAndTime::from_motion(&motion, units.unit, None)));
    totals
}

fn time_motions(program: &Program, unit: LengthUnit, clock: &MachineClock) -> GroupTimer {
    let mut timer = clock.start_timer();
    for (number, motion) in program.motions().filter(|motion| motion.path != MotionPath::Start).enumerate() {
        let moved = measure_motion(&motion, unit, None);
        timer.add_motion(program, &motion, number, (moved.length_mm, moved.feed_mm_min));
    }
    timer
}

/// Returns the time at the machine's rapid feed in seconds, if the setup says that feed.
fn time_at_rapid(program: &Program, unit: LengthUnit, setup: &Setup) -> Option<f64> {
    let rapid_mm_min = setup.machine.rapid_feed?.get();
    let rapids = program.motions().filter(|motion| motion.rapid && motion.path != MotionPath::Start);
    let length_mm: f64 = rapids.map(|motion| motion.length() * unit.mm_per_unit()).sum();
    Some(length_mm / rapid_mm_min * 60.0)
}

/// Returns the changes as a JSON document, indented and with a line end.
pub fn to_json(changes: &RecipeChanges) -> String {
    super::to_json_text(changes)
}
