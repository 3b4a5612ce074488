//! What a step knows besides the program: the recipe around it, the setup, and where to put findings.

use super::{Recipe, StepReport};
use crate::diagnostic::{Diagnostic, DiagnosticCode, codes};
use crate::program::motion::Motion;
use crate::program::{LengthUnit, Program, StepId};
use crate::setup::Setup;
use crate::simulation_run::RunWatcher;

/// The surroundings of a running step.
pub struct StepContext<'r> {
    /// The step.
    pub step: StepId,
    /// The recipe it stands in.
    pub recipe: &'r Recipe,
    /// The setup that counts, in millimetres.
    pub setup: &'r Setup,
    /// Who watches steps that take long.
    pub watch: &'r dyn RunWatcher,
    /// Findings that do not stop the step.
    pub findings: Vec<Diagnostic>,
    /// What steps have to say about themselves.
    pub reports: Vec<StepReport>,
}

impl StepContext<'_> {
    /// A finding that points at the step, or at one of its parameters.
    pub fn step_finding(
        &self,
        code: DiagnosticCode,
        message: impl Into<String>,
        keys: &[&str],
        label: &str,
    ) -> Diagnostic {
        let place = self.recipe.step_value_span(usize::from(self.step.0), keys);
        Diagnostic::new(code, message).with_label(&self.recipe.source, place, label)
    }

    /// Why the step cannot go on, at one of its parameters.
    pub fn step_failure(&self, message: impl Into<String>, keys: &[&str]) -> Box<Diagnostic> {
        Box::new(self.step_finding(codes::STEP_FAILED, message, keys, "asked for here"))
    }

    /// Why the step cannot go on, at a statement of the program and at the step.
    pub fn statement_failure(
        &self,
        message: impl Into<String>,
        program: &Program,
        statement: usize,
        label: &str,
    ) -> Box<Diagnostic> {
        let span = program.statement(statement).map(crate::program::Statement::origin).unwrap_or_default();
        let diagnostic =
            Diagnostic::new(codes::STEP_FAILED, message).with_label(program.source(), span, label);
        let step = self.recipe.step_span(usize::from(self.step.0));
        Box::new(diagnostic.with_label(&self.recipe.source, step, "by this step"))
    }

    /// A record that the step leaves as it is although it should change, at the record and at the step.
    pub fn report_unchanged(&mut self, message: impl Into<String>, program: &Program, statement: usize) {
        let span = program.statement(statement).map(crate::program::Statement::origin).unwrap_or_default();
        let step = self.recipe.step_span(usize::from(self.step.0));
        self.findings.push(
            Diagnostic::new(codes::NOT_CHANGED, message)
                .with_label(program.source(), span, "left as it is")
                .with_label(&self.recipe.source, step, "by this step"),
        );
    }

    /// The unit of the program's lengths: what it says, what its feeds are in, else the recipe's.
    pub fn file_length_unit(&self, program: &Program) -> LengthUnit {
        program.stated_length_unit().or_else(|| program.feed_length_unit()).unwrap_or(self.recipe.units)
    }

    /// The feed of a motion in the recipe's unit per minute; `None` when the spindle speed it needs is not known.
    pub fn feed_per_minute(&self, motion: &Motion, file: LengthUnit) -> Option<f64> {
        let feed = motion.feed?.mm_per_minute(file, motion.spindle_rpm(), Some(motion.length()))?;
        Some(feed / self.recipe.units.mm_per_unit())
    }
}
