//! This module carries out the rules statement by statement, through the program editor.

use super::charset::Charset;
use super::expression::EvaluationError;
use super::reshape::reshape_statement;
use super::rule_matching::{ActiveRule, RuleMatch};
use super::rule_subject::RuleSubject;
use super::spacing_style::{SpacingStyle, is_same_statement};
use super::template::{StatementTemplate, TemplateInputs};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::program::{
    InsertionPoint, Program, ProvenanceComment, Record, Statement, StatementChange, StatementId,
};
use crate::transform::StepContext;
use crate::write::ProgramEditor;

/// The matches of a step, and the data that is needed to apply the rules.
pub(super) struct RewriteRun<'w> {
    rules: &'w [ActiveRule<'w>],
    hits: &'w [RuleMatch],
    charset: Charset,
    context: &'w StepContext<'w>,
}

/// The statements that will be inserted beside one statement.
struct PendingInsertion {
    hit: RuleMatch,
    before: Vec<Vec<u8>>,
    after: Vec<Vec<u8>>,
}

impl<'w> RewriteRun<'w> {
    pub(super) fn new(
        rules: &'w [ActiveRule<'w>],
        hits: &'w [RuleMatch],
        charset: Charset,
        context: &'w StepContext<'_>,
    ) -> Self {
        Self { rules, hits, charset, context }
    }

    /// Rewrites the program.
    ///
    /// # Errors
    /// Returns an error if an expression has no value, or if the result of a rule is no statement.
    pub(super) fn rewrite_program(&self, program: Program) -> Result<Program, Failure> {
        let mut editor = ProgramEditor::new(program, self.context.step);
        let mut look = SpacingStyle::from_program(editor.program(), editor.style().line_end);
        let mut insertions = Vec::new();
        for &hit in self.hits {
            insertions.extend(self.apply_rule(hit, &mut editor, &mut look)?);
        }
        // Only now is it known what stands beside each statement after this step.
        for insertion in insertions {
            self.insert_missing(insertion, &mut editor)?;
        }
        editor.finish()
    }

    /// Replaces or deletes a statement. Returns what will be inserted beside it.
    fn apply_rule(
        &self,
        hit: RuleMatch,
        editor: &mut ProgramEditor,
        look: &mut SpacingStyle,
    ) -> Result<Option<PendingInsertion>, Failure> {
        let program = editor.program();
        let statement = program.statement(hit.statement);
        let Some(active) = self.rules.get(hit.rule) else {
            debug_assert!(false, "rule {} of {} does not exist", hit.rule, self.rules.len());
            return Ok(None);
        };
        let rule = active.rule;
        let text = program.statement_text(statement);
        let subject = RuleSubject::from_text(text);
        let Some(bindings) = active.bind_arguments(&subject) else {
            debug_assert!(false, "the statement is as it was when the rule matched it");
            return Ok(None);
        };
        let (style, charset) = (editor.style(), self.charset);
        let filling =
            TemplateInputs { bindings: &bindings, text, record: statement.record(), style, charset };
        let filled = |template: &StatementTemplate, key: &str| {
            template.fill(&filling).map_err(|trouble| rule_failure(&trouble, hit, key, program, self.context))
        };
        let mut all = |templates: &[StatementTemplate], key: &str| -> Result<Vec<Vec<u8>>, Failure> {
            templates
                .iter()
                .map(|template| Ok(look.apply_spacing(&filled(template, key)?, program)))
                .collect()
        };
        let before = all(&rule.insert_before, "insert_before")?;
        let after = all(&rule.insert_after, "insert_after")?;
        let new = rule.replace.as_ref().map(|template| filled(template, "replace")).transpose()?;
        if let Some(new) = new {
            let text = reshape_statement(program, statement, &new, style, look);
            editor
                .set_text(hit.statement, &text)
                .map_err(|failure| failure.map_findings(|found| self.label_rule(found, hit, &["replace"])))?;
        }
        if rule.delete {
            editor.delete_statement(hit.statement)?;
        }
        Ok(Some(PendingInsertion { hit, before, after }))
    }

    /// Inserts the statements that do not stand there yet.
    fn insert_missing(&self, insertion: PendingInsertion, editor: &mut ProgramEditor) -> Result<(), Failure> {
        let PendingInsertion { hit, before, after } = insertion;
        // A recipe that runs on its own output must not insert the same statements a second time.
        if !is_already_inserted(&before, editor.program(), hit.statement, true) {
            self.insert_texts(&before, hit.statement.before(), hit, "insert_before", editor)?;
        }
        let inserts = !is_already_inserted(&after, editor.program(), hit.statement, false);
        if inserts {
            self.insert_texts(&after, hit.statement.after(), hit, "insert_after", editor)?;
        }
        self.check_point_lines(hit, editor.program(), inserts)
    }

    fn insert_texts(
        &self,
        texts: &[Vec<u8>],
        at: InsertionPoint,
        hit: RuleMatch,
        key: &str,
        editor: &mut ProgramEditor,
    ) -> Result<(), Failure> {
        for (number, text) in texts.iter().enumerate() {
            if let Err(failure) = editor.insert(at, text) {
                let program = editor.program();
                let span = program.statement(hit.statement).origin();
                return Err(failure.map_findings(|mut found| {
                    // The editor knows where it inserted the text, but not for which statement, so the label
                    // is replaced.
                    found.labels.clear();
                    let found = found.with_label(program.source(), span, "beside this statement");
                    self.label_rule(found, hit, &[key, &number.to_string()])
                }));
            }
        }
        Ok(())
    }

    /// Checks that lines of bare numbers stay with the GOTO before them. They have no meaning without it.
    fn check_point_lines(&self, hit: RuleMatch, program: &Program, inserts: bool) -> Result<(), Failure> {
        let is_points = |record: &Record| matches!(record, Record::Goto(_) | Record::Points(_));
        let own = program.statement(hit.statement);
        if !inserts && own.is_live() && is_points(own.record()) {
            return Ok(());
        }
        let Some(next_id) = program.next_live_statement(hit.statement) else { return Ok(()) };
        let next = program.statement(next_id);
        let first = program.statement_text(next).trim_ascii_start().first();
        let is_bare = first.is_some_and(|byte| byte.is_ascii_digit() || b"+-.".contains(byte));
        if !is_points(next.record()) || !is_bare {
            return Ok(());
        }
        let message = "the rule would separate a GOTO from the lines of numbers that continue it";
        let error =
            self.context.statement_failure(message, program, next_id, "these numbers would have no GOTO");
        Err(error.map_findings(|found| self.label_rule(found, hit, &[])))
    }

    fn label_rule(&self, error: Diagnostic, hit: RuleMatch, keys: &[&str]) -> Diagnostic {
        label_rule(error, hit, keys, "by this rule", self.context)
    }
}

/// Returns whether the statements to be inserted already stand before or behind a statement, or are the same
/// as the statement itself.
fn is_already_inserted(wanted: &[Vec<u8>], program: &Program, statement: StatementId, before: bool) -> bool {
    let with_own = wanted.iter().any(|text| ProvenanceComment::from_text(text).is_some());
    let wanted: Vec<RuleSubject<'_>> = wanted.iter().map(|text| RuleSubject::from_text(text)).collect();
    if wanted.is_empty() {
        return true;
    }
    let own = program.statement(statement);
    if own.is_live() {
        let own = RuleSubject::from_text(program.statement_text(own));
        if wanted.iter().any(|wanted| is_same_statement(wanted, &own)) {
            return true;
        }
    }
    let mut found = find_neighbours(program, statement, before, wanted.len(), with_own);
    if before {
        found.reverse();
    }
    wanted.len() == found.len()
        && wanted.iter().zip(&found).all(|(wanted, found)| is_same_statement(wanted, found))
}

/// Returns at most `count` statements before or behind one, with the nearest first. Comments of clsmith's own
/// runs are skipped, because they stand between a statement and what an earlier run inserted beside it.
/// `with_own` is for rules that write such a comment themselves.
fn find_neighbours(
    program: &Program,
    statement: StatementId,
    before: bool,
    count: usize,
    with_own: bool,
) -> Vec<RuleSubject<'_>> {
    let subject = |statement: &Statement| RuleSubject::from_text(program.statement_text(statement));
    let is_own = |other: &Statement| ProvenanceComment::from_text(program.statement_text(other)).is_some();
    let counts = |other: &&Statement| other.is_live() && (with_own || !is_own(other));
    match before {
        true => program
            .statements_before(statement)
            .iter()
            .rev()
            .filter(counts)
            .take(count)
            .map(subject)
            .collect(),
        false => program.statements_after(statement).iter().filter(counts).take(count).map(subject).collect(),
    }
}

fn label_rule(
    error: Diagnostic,
    hit: RuleMatch,
    keys: &[&str],
    label: &str,
    context: &StepContext<'_>,
) -> Diagnostic {
    let rule = hit.rule.to_string();
    let path = [&["rules", rule.as_str()], keys].concat();
    context.label_parameter(error, &path, label)
}

/// Builds the failure of a rule that cannot be applied to a statement, with labels at the text of the rule
/// and at the argument.
pub(super) fn rule_failure(
    trouble: &EvaluationError,
    hit: RuleMatch,
    key: &str,
    program: &Program,
    context: &StepContext<'_>,
) -> Failure {
    let statement = program.statement(hit.statement);
    let mut span = statement.origin();
    if let Some(at) = &trouble.at
        && statement.change() == StatementChange::Untouched
    {
        span = span.sub_span(at.start, at.end);
    }
    let message = format!("rule {} of this `rewrite` cannot be applied: {}", hit.rule + 1, trouble.message);
    let error = Diagnostic::new(codes::STEP_FAILED, message).with_label(program.source(), span, "on this");
    label_rule(error, hit, &[key], "asked for here", context).into()
}
