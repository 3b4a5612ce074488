//! This module decides which rule applies to which statement, before anything is changed.

use super::Rewrite;
use super::bindings::Bindings;
use super::charset::Charset;
use super::expression::EvaluationError;
use super::pattern::StatementPattern;
use super::rule::RewriteRule;
use super::rule_subject::RuleSubject;
use crate::program::{Program, Record, StatementId};
use crate::transform::{StatementSelection, StepContext};

/// A rule, prepared for one file.
pub(super) struct ActiveRule<'r> {
    /// Its index in the recipe.
    pub index: usize,
    /// The rule.
    pub rule: &'r RewriteRule,
    pattern: Option<StatementPattern>,
    fitted: bool,
}

/// A statement and the rule that applies to it.
#[derive(Debug, Clone, Copy)]
pub(super) struct RuleMatch {
    /// The statement.
    pub statement: StatementId,
    /// The rule's index in the recipe.
    pub rule: usize,
}

/// The failure of an `if` that has no value for a statement.
pub(super) struct RuleFailure {
    /// The statement and the rule.
    pub hit: RuleMatch,
    /// The fault.
    pub trouble: EvaluationError,
}

impl<'r> ActiveRule<'r> {
    /// Prepares the rules of a step for a file.
    pub(super) fn activate_rules(step: &'r Rewrite, charset: Charset) -> Vec<Self> {
        let rules = step.rules.iter().enumerate();
        rules
            .map(|(index, rule)| {
                let pattern = rule.r#match.for_charset(charset);
                Self { index, rule, pattern, fitted: false }
            })
            .collect()
    }

    /// Returns whether a statement matched the pattern, whatever its `if` was.
    pub(super) fn has_matched(&self) -> bool {
        self.fitted
    }

    /// Binds the arguments of a statement. Returns `None` if it does not match.
    pub(super) fn bind_arguments<'s>(&'s self, subject: &RuleSubject<'s>) -> Option<Bindings<'s>> {
        self.pattern.as_ref()?.matches(subject)
    }

    fn accepts_subject(&mut self, subject: &RuleSubject<'_>) -> Result<bool, EvaluationError> {
        let Some(bindings) = self.pattern.as_ref().and_then(|pattern| pattern.matches(subject)) else {
            return Ok(false);
        };
        self.fitted = true;
        self.rule.r#if.as_ref().map_or(Ok(true), |condition| condition.0.evaluate_truth(&bindings))
    }
}

/// Finds the statements to which rules apply, in order, each with the first rule that matches.
pub(super) fn find_rule_matches(
    step: &Rewrite,
    rules: &mut [ActiveRule<'_>],
    program: &Program,
    context: &StepContext<'_>,
) -> Result<Vec<RuleMatch>, RuleFailure> {
    let mut selection = StatementSelection::new(&step.r#where, program, context);
    let mut hits = Vec::new();
    for (id, statement) in program.live_statements() {
        if matches!(statement.record(), Record::Blank | Record::ByteOrderMark) {
            continue;
        }
        let text = program.statement_text(statement);
        let may_match =
            |rule: &ActiveRule<'_>| rule.pattern.as_ref().is_some_and(|pattern| pattern.may_match(text));
        // Most statements of a large file are left here, before the grammar or the selection costs time.
        let Some(first) = rules.iter().position(may_match) else { continue };
        if !selection.contains(id) {
            continue;
        }
        let subject = RuleSubject::from_text(text);
        for rule in rules.iter_mut().skip(first) {
            let hit = RuleMatch { statement: id, rule: rule.index };
            if rule.accepts_subject(&subject).map_err(|trouble| RuleFailure { hit, trouble })? {
                hits.push(hit);
                break;
            }
        }
    }
    Ok(hits)
}
