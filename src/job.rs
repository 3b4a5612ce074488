//! This module takes one program through one recipe: it reads it, corrects it, reads the result back and
//! compares. `apply`, `hook`, `watch` and `batch` use it.
//!
//! The input is checked first; an error in it stops the job. The corrected program is read back before anything is
//! written: its changed statements where that is a proof, else the whole text. Record by record it must be what the
//! steps made of it. Then [`check`] looks at it, and each finding that the same statement of the original did not have
//! counts as a finding of this run.

mod defect_guard;
mod dialect_guard;
mod read_back;
mod result_simulation;

pub use defect_guard::{catch_defect, remember_panics};

use crate::check;
use crate::diagnostic::{Diagnostic, DiagnosticCode, Failure, codes};
use crate::fingerprint::RecipeFingerprint;
use crate::program::{Dialect, InsertionPoint, Program, Statement, StatementChange, StatementId};
use crate::provenance;
use crate::recipe::Provenance;
use crate::report::finding_policy::{FindingPolicy, sort_findings};
use crate::report::simulation::SimulationAttempt;
use crate::report::stats::ResolvedLengthUnit;
use crate::setup::Setup;
use crate::simulation_run::{RunPhase, RunWatcher, SilentWatcher};
use crate::source::{Source, Span};
use crate::transform::{self, Recipe, RecipeOutcome, TransformReport, check_result_with_setup};
use read_back::ReadBack;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A recipe with everything that it needs, ready for any number of files.
///
/// ```
/// use clsmith::job::CorrectionJob;
/// use clsmith::report::finding_policy::FindingPolicy;
/// use clsmith::setup::Setup;
/// use clsmith::source::Source;
/// use clsmith::transform::Recipe;
///
/// let text = b"version: 1\nsteps:\n  - scale_feed: { factor: 0.5 }\n";
/// let recipe = Recipe::load(&Source::new("recipe.yaml", text.to_vec())?)?;
/// let (setup, policy) = (Setup::default(), FindingPolicy::default());
/// let job = CorrectionJob::new(&recipe, &setup, &policy);
/// let outcome = job.correct_source(&Source::new("part.cls", b"FEDRAT/MMPM,800.\nGOTO/0,0,0\n".to_vec())?)?;
/// assert_eq!(outcome.program.to_bytes(), b"FEDRAT/MMPM,400.\nGOTO/0,0,0\n");
/// // Nothing comes of a program with an error.
/// assert!(job.correct_source(&Source::new("part.cls", b"GOTO/0,0,O\n".to_vec())?).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[non_exhaustive]
pub struct CorrectionJob<'r> {
    /// The recipe.
    pub recipe: &'r Recipe,
    /// The setup in force.
    pub setup: &'r Setup,
    /// The fingerprint of the recipe, for the header of a recipe with `provenance:`. Without it, the header
    /// only contains the name of the recipe.
    pub print: Option<&'r RecipeFingerprint>,
    /// The policy that decides which findings stop the job.
    pub policy: &'r FindingPolicy,
    /// The dialect, if it is forced.
    pub dialect: Option<Dialect>,
    /// The watcher of steps that take long.
    pub watch: &'r dyn RunWatcher,
}

/// The outcome for a file.
#[derive(Debug)]
pub struct JobOutcome {
    /// The corrected program. It may be written if [`JobOutcome::is_refused`] is false.
    pub program: Program,
    /// The findings, as the policy has left them.
    pub findings: Vec<Diagnostic>,
    /// What steps report about themselves.
    pub reports: Vec<Box<dyn TransformReport>>,
    /// The simulation of the corrected program, where the setup has a stock and the recipe does not forbid it.
    pub simulation: Option<SimulationAttempt>,
}

impl JobOutcome {
    /// Returns whether the program must not be written, since one of the findings is an error.
    pub fn is_refused(&self) -> bool {
        self.findings.iter().any(Diagnostic::is_error)
    }
}

impl<'r> CorrectionJob<'r> {
    /// Makes a job that detects the dialect, has no fingerprint and is watched by nobody.
    pub fn new(recipe: &'r Recipe, setup: &'r Setup, policy: &'r FindingPolicy) -> Self {
        Self { recipe, setup, print: None, policy, dialect: None, watch: &SilentWatcher }
    }

    /// Returns the job with the recipe's fingerprint, which the header of a recipe with `provenance:` tells.
    #[must_use]
    pub fn with_print(mut self, print: impl Into<Option<&'r RecipeFingerprint>>) -> Self {
        self.print = print.into();
        self
    }

    /// Returns the job for programs of one dialect.
    #[must_use]
    pub fn with_dialect(mut self, dialect: impl Into<Option<Dialect>>) -> Self {
        self.dialect = dialect.into();
        self
    }

    /// Returns the job with somebody who watches steps that take long, and may stop them.
    #[must_use]
    pub fn with_watcher(mut self, watch: &'r dyn RunWatcher) -> Self {
        self.watch = watch;
        self
    }
}

impl CorrectionJob<'_> {
    /// Corrects one file.
    ///
    /// The input is checked before any step runs: an error in it stops the job, and its warnings are findings
    /// of the run. A changed program is printed, read back and checked; what is worse in it than in the
    /// original counts as a finding, so no step can break a program and say nothing. What the setup knows against the
    /// result (ramps, feeds, axes of the machine) is told, too. Where the setup has a stock, the result is simulated, and
    /// what that finds is a finding of the run.
    ///
    /// # Errors
    /// Returns all findings, as the policy leaves them, once one of them is an error, and
    /// [`Failure::Interrupted`] when `watch` stopped the job.
    pub fn correct_source(&self, source: &Arc<Source>) -> Result<JobOutcome, Failure> {
        let outcome = self.try_source(source)?;
        if outcome.is_refused() { Err(outcome.findings.into()) } else { Ok(outcome) }
    }

    /// Corrects one file as [`CorrectionJob::correct_source`] does, but keeps a corrected program whose findings refuse
    /// it, so that reports can show why.
    ///
    /// # Errors
    /// Returns all findings if the input or a step stopped the job, so that there is no corrected program, and
    /// [`Failure::Interrupted`] when `watch` stopped it.
    pub fn try_source(&self, source: &Arc<Source>) -> Result<JobOutcome, Failure> {
        self.watch.begin_phase(RunPhase::Reading);
        let (program, found) =
            check::read_and_check_with_vocabulary(source, self.dialect, &self.setup.vocabulary);
        self.watch.check_stop()?;
        // Which findings are known is asked before the steps, since they take the program.
        let known = KnownFindings::new(&program, &found);
        let mut findings = self.policy.apply(found);
        if findings.iter().any(Diagnostic::is_error) {
            return Err(findings.into());
        }
        let RecipeOutcome { program, findings: new, reports, shares } =
            match self.run_steps(source, program, known) {
                Ok(done) => done,
                Err(failure) => return Err(self.apply_policy(failure).after(findings)),
            };
        findings.extend(self.policy.apply(new));
        // A program that is refused already is not simulated: that may take long, and changes nothing.
        let is_refused = findings.iter().any(Diagnostic::is_error);
        let simulation = match is_refused {
            true => None,
            false => result_simulation::simulate_result(&program, self.recipe, self.setup, self.watch)?,
        };
        let simulation = simulation.map(|attempt| attempt.with_known_shares(shares));
        if let Some(simulation) = &simulation {
            let found = result_simulation::find_in_simulation(simulation, &findings);
            findings.extend(self.policy.apply(found));
            sort_findings(&mut findings);
        }
        Ok(JobOutcome { program, findings, reports, simulation })
    }

    /// Runs the steps, adds the comments and checks the result.
    fn run_steps(
        &self,
        source: &Arc<Source>,
        program: Program,
        known: KnownFindings,
    ) -> Result<RecipeOutcome, Failure> {
        let outcome = transform::run_recipe_watched(self.recipe, self.setup, program, self.watch)?;
        let mut new = outcome.findings;
        if self.recipe.provenance != Provenance::Comments {
            new.extend(provenance::find_stale_comments(&outcome.program));
        }
        let program = match provenance::add_comments(outcome.program, self.recipe, self.print) {
            Ok(program) => program,
            Err(failure) => return Err(failure.after(new)),
        };
        self.watch.check_stop()?;
        let unit = ResolvedLengthUnit::from_program(&program, Some(self.recipe.units)).unit;
        let against = check_result_with_setup(&program, self.setup, unit, &new);
        new.extend(against);
        if is_program_changed(&program) {
            self.watch.begin_phase(RunPhase::Checking);
            match find_new_findings(source, &program, known) {
                Ok(worse) => new.extend(worse),
                Err(failure) => return Err(failure.after(new)),
            }
            // Whoever forces a dialect does so for the corrected program too.
            if self.dialect.is_none() {
                new.extend(dialect_guard::find_changed_dialect(&program));
            }
        }
        Ok(RecipeOutcome { program, findings: new, reports: outcome.reports, shares: outcome.shares })
    }

    fn apply_policy(&self, failure: Failure) -> Failure {
        let Failure::Found(found) = failure else { return Failure::Interrupted };
        let stands = self.policy.apply(found.clone());
        // What stopped the job is an error even where its code is allowed: else it would stop without a word.
        Failure::from(if stands.iter().any(Diagnostic::is_error) { stands } else { found })
    }
}

/// Finds what is wrong in the corrected text and was not in the original. The places are in the corrected
/// text.
fn find_new_findings(
    source: &Arc<Source>,
    program: &Program,
    mut known: KnownFindings,
) -> Result<Vec<Diagnostic>, Failure> {
    if read_back::read_changed_statements(program) == ReadBack::Proven && has_only_known(program, &known) {
        return Ok(Vec::new());
    }
    let name = format!("{} (corrected)", source.name());
    let corrected_source = Source::new(name, program.to_bytes())
        .map_err(|too_large| Diagnostic::new(codes::TOO_LARGE, too_large.to_string()))?;
    let (corrected, found) = check::read_and_check_with_vocabulary(
        &corrected_source,
        Some(program.dialect()),
        program.vocabulary(),
    );
    if let Some(differs) = find_first_difference(program, &corrected) {
        let end = corrected_source.bytes().len();
        let statement = corrected.statement_behind(differs).map(|id| corrected.statement(id));
        let span = statement.map_or(Span::new(end, end), Statement::origin);
        let message = "the corrected program does not read back as what the steps made";
        let finding = Diagnostic::new(codes::UNREADABLE_EDIT, message);
        return Ok(vec![finding.with_label(&corrected_source, span, "from here")]);
    }
    // Statement by statement the corrected text is the program: so each of its findings has a place in the
    // original.
    let origins: Vec<StatementOrigin> =
        program.live_statements().map(|(_, statement)| StatementOrigin::from_statement(statement)).collect();
    let is_new = |found: &Diagnostic| {
        let statement = find_statement_of_finding(&corrected, found);
        !known.take_known(found, statement.and_then(|id| origins.get(id.index())).copied())
    };
    Ok(found.into_iter().filter(is_new).collect())
}

/// Returns whether a check of the program finds nothing that the original did not have. Lints that look at nothing that
/// changed find what they found. The places of what the others find are in the original, so a new finding is made by the
/// check of the corrected text.
fn has_only_known(program: &Program, known: &KnownFindings) -> bool {
    let found = check::check_changed_parts(program);
    let mut left = known.clone();
    found.iter().all(|found| {
        let statement = find_statement_of_finding(program, found);
        let origin = statement.map(|id| StatementOrigin::from_statement(program.statement(id)));
        left.take_known(found, origin)
    })
}

/// The findings of the original, counted by code and statement. Messages do not tell them apart: a changed
/// number in one makes no new finding.
#[derive(Debug, Clone)]
struct KnownFindings(BTreeMap<(DiagnosticCode, Option<StatementOrigin>), usize>);

impl KnownFindings {
    fn new(original: &Program, found: &[Diagnostic]) -> Self {
        let mut counts = BTreeMap::new();
        for found in found {
            let statement = find_statement_of_finding(original, found);
            let origin = statement.map(|id| StatementOrigin::from_statement(original.statement(id)));
            *counts.entry((found.code, origin)).or_default() += 1;
        }
        Self(counts)
    }

    /// Returns whether the original has such a finding that no finding before has taken.
    fn take_known(&mut self, found: &Diagnostic, origin: Option<StatementOrigin>) -> bool {
        match self.0.get_mut(&(found.code, origin)) {
            Some(count) if *count > 0 => {
                *count -= 1;
                true
            }
            _ => false,
        }
    }
}

/// The origin of a statement: its place in the original, and whether it was there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct StatementOrigin {
    start: u32,
    inserted: bool,
}

impl StatementOrigin {
    fn from_statement(statement: &Statement) -> Self {
        let inserted = matches!(statement.change(), StatementChange::Inserted(_));
        Self { start: statement.origin().start, inserted }
    }
}

/// Returns the first statement whose meaning in the text read back differs from the program's. It proves the
/// writer.
fn find_first_difference(program: &Program, read_back: &Program) -> Option<InsertionPoint> {
    let mut live = program.live_statements();
    for (id, statement) in read_back.numbered_statements() {
        if live.next().is_none_or(|(_, before)| before.record() != statement.record()) {
            return Some(id.before());
        }
    }
    live.next().map(|_| read_back.end())
}

/// Returns the statement of a finding in a freshly read program. Returns `None` if the finding is about the
/// whole file.
fn find_statement_of_finding(program: &Program, found: &Diagnostic) -> Option<StatementId> {
    program.statement_at_offset(found.labels.first()?.span.start)
}

/// Returns whether any statement differs from the source.
pub fn is_program_changed(program: &Program) -> bool {
    program.statements().iter().any(|statement| statement.change() != StatementChange::Untouched)
}
