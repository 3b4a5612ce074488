//! `rewrite` applies rules to statements, which otherwise macros of posts or people by hand would do.

mod bindings;
mod charset;
mod expression;
mod expression_value;
mod pattern;
mod reshape;
mod rewrite_run;
mod rule;
mod rule_fault;
mod rule_matching;
mod rule_subject;
mod rule_text;
mod spacing_style;
mod template;
mod wildcards;

pub use rule::RewriteRule;
pub use rule_fault::RuleFault;

use super::empty_selection::report_nothing_selected;
use super::statement_selection::StatementSelection;
use super::{StepContext, Transform};
use crate::diagnostic::{Failure, codes};
use crate::program::Program;
use crate::recipe::{MotionFilter, StatementFilter};
use charset::Charset;
use rewrite_run::RewriteRun;
use rule_matching::ActiveRule;
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::{Deserializer, Error as _};

/// Replaces, deletes and inserts statements by rules.
///
/// A rule's `match` is a statement as it stands in the file. Spacing, continuation, upper and lower case,
/// comments after the statement and the notation of numbers (`5.` or `5.0000`) do not matter. In it,
///
/// - `$NAME` stands for one argument (number, word, quoted text, group in parentheses) or for a word (`$WORD/ON`); within text
///   it stands for at least one character (`PPRINT TOOL $N`, `LOADTL/T$N`). The same name twice wants equal values; `$_` binds
///   nothing.
/// - `$...NAME`, or `$...`, comes last and stands for all that is left, perhaps nothing: `LOAD/TOOL,$N,$...REST`.
/// - `$$` always is a comment's mark: `$$ Start of $...REST` matches comments as text, `$$-> CUTTER / $D` Creo's records.
///
/// `if` is true or false: `$F > 1000 and not ($U == 'IPM' or $U == 'IPR')`, with + - * / and parentheses. In
/// `replace`, `insert_before` and `insert_after`, `$NAME` is written byte for byte as it stands in the file
/// (`${NAME}` where letters follow), and `${F * 0.8}` is computed and written with the decimals of `$F`, or
/// more where fewer would lose the change.
///
/// The rules are tried in their order on each statement. The first one that matches is applied, and its
/// result is not examined again in this step. If a replacement has the same word and as many arguments, only
/// the arguments that differ are changed, numbers in the file's own decimals and columns. Any other
/// replacement is spaced as the file spaces its statements. The rule is responsible for what a change means
/// for the motions around it (the GOTO that ends an arc, the feed of what follows); `check` examines the
/// result.
///
/// The step is idempotent if a statement does not match any more once it is replaced. Statements are not
/// inserted where they already stand in the same order right beside the matched one, nor beside one that is
/// the same itself. So running the step twice inserts them once.
///
/// ```yaml
/// version: 1
/// steps:
///   - rewrite:
///       rules:
///         - match: "COOLNT/ON"
///           replace: "COOLNT/FLOOD"
/// ```
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rewrite {
    /// Which statements are meant; all of them when it is left out. Use `if` for conditions on feeds.
    #[serde(default)]
    #[schemars(extend("x-default" = "the whole program"))]
    pub r#where: StatementFilter,
    /// The rules, in the order in which they are tried.
    #[serde(deserialize_with = "at_least_one")]
    #[schemars(length(min = 1))]
    pub rules: Vec<RewriteRule>,
}

/// This rule writes the arguments in the order that a post wants.
///
/// ```
/// use clsmith::parse::parse;
/// use clsmith::program::LengthUnit;
/// use clsmith::setup::Setup;
/// use clsmith::source::Source;
/// use clsmith::transform::{Rewrite, RewriteRule, run_steps};
///
/// let rule = RewriteRule::replacing("SPINDL/RPM,$N,CLW", "SPINDL/$N,RPM,CLW").expect("both are statements");
/// let source = Source::new("part.cls", b"SPINDL/RPM,5000,CLW\nGOTO/0,0,0\n".to_vec())?;
/// let program = parse(&source, None).program;
/// let step = Rewrite::new(vec![rule]);
/// let outcome = run_steps(&[&step], LengthUnit::Mm, &Setup::default(), program)?;
/// assert_eq!(outcome.program.to_bytes(), b"SPINDL/5000,RPM,CLW\nGOTO/0,0,0\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
impl Transform for Rewrite {
    fn apply(&self, program: Program, context: &mut StepContext<'_>) -> Result<Program, Failure> {
        let is_ascii = self.rules.iter().all(RewriteRule::is_ascii);
        let charset = if is_ascii { Charset::Utf8 } else { Charset::from_program(&program) };
        let mut rules = ActiveRule::activate_rules(self, charset);
        let hits = match rule_matching::find_rule_matches(self, &mut rules, &program, context) {
            Ok(hits) => hits,
            Err(stuck) => {
                return Err(rewrite_run::rule_failure(&stuck.trouble, stuck.hit, "if", &program, context));
            }
        };
        if hits.is_empty() && self.selects_nothing(&program, context) {
            report_nothing_selected("statement", &MotionFilter::from(&self.r#where), &program, context);
            return Ok(program);
        }
        report_unused_rules(&rules, context);
        if hits.is_empty() {
            return Ok(program);
        }
        RewriteRun::new(&rules, &hits, charset, context).rewrite_program(program)
    }
}

impl Rewrite {
    /// Makes the step with its rules, for the whole program.
    pub fn new(rules: Vec<RewriteRule>) -> Self {
        Self { r#where: StatementFilter::default(), rules }
    }

    fn selects_nothing(&self, program: &Program, context: &StepContext<'_>) -> bool {
        let mut selection = StatementSelection::new(&self.r#where, program, context);
        !self.r#where.is_everything() && !program.live_statements().any(|(id, _)| selection.contains(id))
    }
}

fn report_unused_rules(rules: &[ActiveRule<'_>], context: &mut StepContext<'_>) {
    for rule in rules {
        // A rule whose `if` was never true has matched statements and found nothing to correct, so it is not
        // reported.
        if rule.has_matched() {
            continue;
        }
        let index = rule.index.to_string();
        let message = format!("rule {} of this `rewrite` applies to no statement", rule.index + 1);
        let finding =
            context.step_finding(codes::RULE_UNUSED, message, &["rules", &index, "match"], "matches nothing");
        context.findings.push(finding);
    }
}

fn at_least_one<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<RewriteRule>, D::Error> {
    let rules = Vec::<RewriteRule>::deserialize(deserializer)?;
    if rules.is_empty() {
        return Err(D::Error::custom(
            "an empty list of rules does nothing\nAdd a rule: `- match: …` with `replace: …`.",
        ));
    }
    Ok(rules)
}
