//! This module decides which recipe a program gets. A file has rules over machine, tool, operation and file
//! name, and the first rule that matches counts.
//!
//! So a single hook serves a whole shop. [`RecipeRules::load`] reads the file,
//! [`RecipeRuleFacts::from_program`] reads the facts of a program, and [`RecipeRules::choose_recipe`]
//! decides.

mod rule_facts;
mod rules_text;

pub use rule_facts::RecipeRuleFacts;
pub use rules_text::rules_schema;

use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::parameters::{FilePath, Glob, ToolPattern};
use crate::source::{Source, Span};
use crate::yaml::{YamlDocument, YamlPathSegment};
use std::borrow::Borrow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A file of rules.
///
/// ```
/// use clsmith::parse::parse;
/// use clsmith::recipe_rules::{RecipeChoice, RecipeRuleFacts, RecipeRules};
/// use clsmith::source::Source;
///
/// let rules = b"rules:\n  - when: { tool: [3] }\n    recipe: ball.yaml\notherwise: pass\n";
/// let rules = RecipeRules::load(&Source::new("rules.yaml", rules.to_vec())?)?;
/// let program = parse(&Source::new("part.cls", b"LOAD/TOOL,3\nGOTO/0,0,0\n".to_vec())?, None).program;
/// let choice = rules.choose_recipe(&RecipeRuleFacts::from_program("part.cls", &program))?;
/// assert!(matches!(choice, RecipeChoice::Recipe { recipe, .. } if recipe.ends_with("ball.yaml")));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct RecipeRules {
    source: Arc<Source>,
    document: YamlDocument,
    rules: Vec<RecipeRule>,
    otherwise: RecipeFallback,
}

/// The conditions on a program, and the recipe that it gets then.
#[derive(Debug)]
struct RecipeRule {
    when: RecipeRuleCondition,
    job: RecipeAndSetup,
}

/// The conditions on a program. All of them must match, and at least one element of each list.
#[derive(Debug)]
struct RecipeRuleCondition {
    machine: Option<Vec<Glob>>,
    tool: Option<Vec<ToolPattern>>,
    operation: Option<Vec<Glob>>,
    file: Option<Vec<Glob>>,
}

/// The files that a rule names, as they are written.
#[derive(Debug)]
struct RecipeAndSetup {
    recipe: FilePath,
    setup: Option<FilePath>,
}

/// What happens to a program that no rule matches.
#[derive(Debug)]
enum RecipeFallback {
    Recipe(RecipeAndSetup),
    Pass,
    Stop,
}

/// What happens to a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum RecipeChoice {
    /// It is corrected.
    Recipe {
        /// The recipe, as seen from where clsmith runs.
        recipe: PathBuf,
        /// The setup file that overrides the recipe's, likewise.
        setup: Option<PathBuf>,
        /// The rule that chose it, named for people: `rule 2` or `otherwise`.
        by: String,
    },
    /// It passes unchanged.
    Pass,
}

impl RecipeRules {
    /// Reads a file of rules. The recipes that it names are not opened.
    ///
    /// # Errors
    /// Returns all faults of the file, each at its place.
    pub fn load(source: &Arc<Source>) -> Result<Self, Failure> {
        rules_text::load_rules(source)
    }

    /// Decides what happens to a program.
    ///
    /// # Errors
    /// Returns [`codes::NO_RULE`] if no rule matches and `otherwise` is missing or `stop`.
    pub fn choose_recipe(&self, facts: &RecipeRuleFacts) -> Result<RecipeChoice, Failure> {
        self.choose_recipe_by(|_| facts)
    }

    fn fall_back(&self, facts: &RecipeRuleFacts) -> Result<RecipeChoice, Failure> {
        match &self.otherwise {
            RecipeFallback::Recipe(job) => Ok(self.make_choice(job, "otherwise".to_owned())),
            RecipeFallback::Pass => Ok(RecipeChoice::Pass),
            RecipeFallback::Stop => Err(self.report_no_rule(facts).into()),
        }
    }

    /// Decides what happens to a program whose facts depend on what chooses: a setup may give a shop's own words a meaning.
    /// `facts_under` reads the facts as a rule's recipe and setup would.
    ///
    /// # Errors
    /// Returns [`codes::NO_RULE`] if no rule matches and `otherwise` is missing or `stop`.
    pub fn choose_recipe_by<F: Borrow<RecipeRuleFacts>>(
        &self,
        mut facts_under: impl FnMut(&RecipeChoice) -> F,
    ) -> Result<RecipeChoice, Failure> {
        let mut last = None;
        for (index, rule) in self.rules.iter().enumerate() {
            let choice = self.make_choice(&rule.job, format!("rule {}", index + 1));
            let facts = facts_under(&choice);
            if rule.when.matches_facts(facts.borrow()) {
                return Ok(choice);
            }
            last = Some(facts);
        }
        self.fall_back(last.as_ref().map(Borrow::borrow).unwrap_or(&RecipeRuleFacts::default()))
    }

    /// Returns every recipe that a rule may choose, with its setup.
    pub fn list_choices(&self) -> Vec<RecipeChoice> {
        let rules = self.rules.iter().enumerate();
        let mut all: Vec<RecipeChoice> =
            rules.map(|(index, rule)| self.make_choice(&rule.job, format!("rule {}", index + 1))).collect();
        if let RecipeFallback::Recipe(job) = &self.otherwise {
            all.push(self.make_choice(job, "otherwise".to_owned()));
        }
        all
    }

    fn make_choice(&self, job: &RecipeAndSetup, by: String) -> RecipeChoice {
        let here = Path::new(self.source.name());
        let setup = job.setup.as_ref().map(|setup| setup.resolve_beside(here));
        RecipeChoice::Recipe { recipe: job.recipe.resolve_beside(here), setup, by }
    }

    fn report_no_rule(&self, facts: &RecipeRuleFacts) -> Diagnostic {
        let message = format!("no rule matches this program: {facts}");
        let span = self.key_span("otherwise").or_else(|| self.key_span("rules"));
        debug_assert!(span.is_some(), "a file of rules has the key `rules`");
        let span = span.unwrap_or_default();
        Diagnostic::new(codes::NO_RULE, message).with_label(&self.source, span, "none of these, then stop")
    }

    fn key_span(&self, key: &'static str) -> Option<Span> {
        self.document.key_span(&[YamlPathSegment::Key(key)])
    }
}

impl RecipeRuleCondition {
    fn matches_facts(&self, facts: &RecipeRuleFacts) -> bool {
        let any = |globs: &Option<Vec<Glob>>, names: &[String]| {
            globs
                .as_ref()
                .is_none_or(|globs| names.iter().any(|name| globs.iter().any(|glob| glob.matches_name(name))))
        };
        let tool = self.tool.as_ref().is_none_or(|patterns| {
            facts.tools.iter().any(|(number, name)| {
                patterns.iter().any(|pattern| pattern.matches_tool(*number, name.as_deref()))
            })
        });
        tool && any(&self.machine, &facts.machines)
            && any(&self.operation, &facts.operations)
            && any(&self.file, std::slice::from_ref(&facts.file))
    }
}
