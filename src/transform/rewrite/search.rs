//! Which rule takes which statement, before anything is changed.

use super::Rewrite;
use super::bindings::Bindings;
use super::charset::Charset;
use super::expression::Trouble;
use super::pattern::Pattern;
use super::rule::RewriteRule;
use super::subject::Subject;
use crate::program::{Program, Record};

/// A rule as it is looked for in one file.
pub(super) struct Active<'r> {
    /// Its number in the recipe.
    pub index: usize,
    /// The rule.
    pub rule: &'r RewriteRule,
    pattern: Option<Pattern>,
    fitted: bool,
}

/// A statement and the rule that takes it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hit {
    /// The statement.
    pub statement: usize,
    /// The rule's number in the recipe.
    pub rule: usize,
}

/// An `if` that has no value for a statement.
pub(super) struct Stuck {
    /// The statement and the rule.
    pub hit: Hit,
    /// What is wrong.
    pub trouble: Trouble,
}

impl<'r> Active<'r> {
    /// The rules of a step for a file.
    pub fn all(step: &'r Rewrite, charset: Charset) -> Vec<Self> {
        let rules = step.rules.iter().enumerate();
        rules
            .map(|(index, rule)| {
                let pattern = rule.r#match.in_charset(charset);
                Self { index, rule, pattern, fitted: false }
            })
            .collect()
    }

    /// Whether a statement fitted the pattern, whatever `if` said.
    pub fn has_fitted(&self) -> bool {
        self.fitted
    }

    /// What the pattern binds in a statement.
    pub fn bindings<'s>(&'s self, subject: &Subject<'s>) -> Option<Bindings<'s>> {
        self.pattern.as_ref()?.matches(subject)
    }

    fn takes(&mut self, subject: &Subject<'_>) -> Result<bool, Trouble> {
        let Some(bindings) = self.pattern.as_ref().and_then(|pattern| pattern.matches(subject)) else {
            return Ok(false);
        };
        self.fitted = true;
        self.rule.r#if.as_ref().map_or(Ok(true), |condition| condition.0.truth(&bindings))
    }
}

/// The statements that rules take, in order; each by the first rule that fits.
pub(super) fn hits(step: &Rewrite, rules: &mut [Active<'_>], program: &Program) -> Result<Vec<Hit>, Stuck> {
    let mut region = step.r#where.over(program);
    let mut hits = Vec::new();
    for (index, statement) in program.live() {
        if matches!(statement.record(), Record::Blank | Record::ByteOrderMark) {
            continue;
        }
        let text = program.text(statement);
        let may_match =
            |rule: &Active<'_>| rule.pattern.as_ref().is_some_and(|pattern| pattern.may_match(text));
        // Most statements of a large file end here, before the grammar or the region costs anything.
        let Some(first) = rules.iter().position(may_match) else { continue };
        if !region.contains(index) {
            continue;
        }
        let subject = Subject::of(text);
        for rule in rules.iter_mut().skip(first) {
            let hit = Hit { statement: index, rule: rule.index };
            if rule.takes(&subject).map_err(|trouble| Stuck { hit, trouble })? {
                hits.push(hit);
                break;
            }
        }
    }
    Ok(hits)
}
