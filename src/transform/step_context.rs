//! This module holds what a step knows besides the program: the unit of its parameters, the setup, its place
//! in a recipe, and where it puts findings.

use super::{Recipe, TransformReport};
use crate::diagnostic::{Diagnostic, DiagnosticCode, Failure, codes};
use crate::parameters::FilePath;
use crate::program::motion::Motion;
use crate::program::{LengthUnit, Program, StatementId, StepId};
use crate::setup::Setup;
use crate::simulation_run::{KnownShares, RunWatcher};
use crate::source::Span;
use std::path::{Path, PathBuf};

/// The surroundings of a running step.
#[non_exhaustive]
pub struct StepContext<'r> {
    /// The id of the step.
    pub step: StepId,
    /// The unit of lengths among the step's parameters. Feeds are in this unit per minute.
    pub units: LengthUnit,
    /// The setup in force, in millimetres.
    pub setup: &'r Setup,
    /// The watcher of steps that take long.
    pub watch: &'r dyn RunWatcher,
    /// The findings that do not stop the step.
    pub findings: Vec<Diagnostic>,
    /// What steps report about themselves.
    pub reports: Vec<Box<dyn TransformReport>>,
    /// The shares that steps have certified, for reports about the result.
    pub(crate) shares: KnownShares,
    /// The recipe of the step. It is `None` for a step that was built in Rust, whose findings have no place
    /// in a recipe.
    pub(super) recipe: Option<&'r Recipe>,
}

impl StepContext<'_> {
    /// Makes a finding that points at the step, or at one of its parameters.
    pub fn step_finding(
        &self,
        code: DiagnosticCode,
        message: impl Into<String>,
        keys: &[&str],
        label: &str,
    ) -> Diagnostic {
        self.label_parameter(Diagnostic::new(code, message), keys, label)
    }

    /// Adds a label at the step to a finding, if there is a recipe.
    pub fn label_step(&self, found: Diagnostic, label: &str) -> Diagnostic {
        let Some(recipe) = self.recipe else { return found };
        let place = recipe.step_span(usize::from(self.step.0));
        found.with_label(&recipe.source, place, label)
    }

    /// Adds a label at one of the step's parameters (the keys below its name) to a finding. If the recipe
    /// does not contain it, the label is at the nearest key that it contains.
    pub fn label_parameter(&self, found: Diagnostic, keys: &[&str], label: &str) -> Diagnostic {
        let Some(recipe) = self.recipe else { return found };
        let place = recipe.step_value_span(usize::from(self.step.0), keys);
        found.with_label(&recipe.source, place, label)
    }

    /// Returns the path of a file that the step names, relative to the recipe. Without a recipe, the path is
    /// used unchanged.
    pub fn resolve_file(&self, file: &FilePath) -> PathBuf {
        let named_in = self.recipe.map_or("", |recipe| recipe.source.name());
        file.resolve_beside(Path::new(named_in))
    }

    /// Adds what the step reports about itself.
    pub fn add_report(&mut self, report: impl TransformReport) {
        self.reports.push(Box::new(report));
    }

    /// Makes the failure of a step, at one of its parameters.
    pub fn step_failure(&self, message: impl Into<String>, keys: &[&str]) -> Failure {
        self.step_finding(codes::STEP_FAILED, message, keys, "asked for here").into()
    }

    /// Makes the failure of a step, at a statement of the program and at the step.
    pub fn statement_failure(
        &self,
        message: impl Into<String>,
        program: &Program,
        statement: StatementId,
        label: &str,
    ) -> Failure {
        self.statement_finding(message, program, statement, label).into()
    }

    /// Makes the finding of [`StepContext::statement_failure`], to which a help can be added.
    pub fn statement_finding(
        &self,
        message: impl Into<String>,
        program: &Program,
        statement: StatementId,
        label: &str,
    ) -> Diagnostic {
        self.source_finding(message, program, program.statement(statement).origin(), label)
    }

    /// Makes the finding of a failure, at a place in the source of the program and at the step. It is for
    /// faults that are found after the step has inserted statements, when older ids are not valid any more.
    pub fn source_finding(
        &self,
        message: impl Into<String>,
        program: &Program,
        place: Span,
        label: &str,
    ) -> Diagnostic {
        let diagnostic =
            Diagnostic::new(codes::STEP_FAILED, message).with_label(program.source(), place, label);
        self.label_step(diagnostic, "by this step")
    }

    /// Reports a record that the step leaves unchanged although it should change, at the record and at the
    /// step.
    pub fn report_unchanged(
        &mut self,
        message: impl Into<String>,
        program: &Program,
        statement: StatementId,
    ) {
        let span = program.statement(statement).origin();
        let finding =
            Diagnostic::new(codes::NOT_CHANGED, message).with_label(program.source(), span, "left unchanged");
        self.findings.push(self.label_step(finding, "by this step"));
    }

    /// Returns the unit of the program's lengths: the unit that it states, else the unit of its feeds, else
    /// the unit of the parameters.
    pub fn file_length_unit(&self, program: &Program) -> LengthUnit {
        program.stated_length_unit().or_else(|| program.feed_length_unit()).unwrap_or(self.units)
    }

    /// Returns the feed of a motion in the unit of the parameters per minute. Returns `None` if the feed
    /// needs a spindle speed that is not known.
    pub fn feed_per_minute(&self, motion: &Motion, file: LengthUnit) -> Option<f64> {
        feed_per_minute(motion, file, self.units)
    }
}

/// Returns the feed of a motion of a file in `file` units, in `units` per minute. Returns `None` if the feed
/// needs a spindle speed that is not known.
pub(super) fn feed_per_minute(motion: &Motion, file: LengthUnit, units: LengthUnit) -> Option<f64> {
    let feed = motion.feed?.mm_per_minute(file, motion.spindle_rpm(), Some(motion.length()))?;
    Some(feed / units.mm_per_unit())
}
