//! Which recipe a program gets: a file of rules over machine, tool, operation and file name; the first that fits wins.
//!
//! So one hook serves a shop. [`Rules::load`] reads the file, [`Facts::of`] looks into a program, [`Rules::choose`] decides.

mod facts;
mod text;

pub use facts::Facts;
pub use text::schema;

use crate::diagnostic::{Diagnostic, codes};
use crate::source::{Source, Span};
use crate::values::{FilePath, Glob, ToolPattern};
use crate::yaml::{Document, Segment};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A file of rules.
#[derive(Debug)]
pub struct Rules {
    source: Arc<Source>,
    document: Document,
    rules: Vec<Rule>,
    otherwise: Otherwise,
}

/// What a program must be like, and the recipe it then gets.
#[derive(Debug)]
struct Rule {
    when: When,
    job: RecipeAndSetup,
}

/// What a program must be like: all that is given must fit, of each list one.
#[derive(Debug)]
struct When {
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

/// What becomes of a program that no rule fits.
#[derive(Debug)]
enum Otherwise {
    Recipe(RecipeAndSetup),
    Pass,
    Stop,
}

/// What becomes of a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Choice {
    /// It is corrected.
    Recipe {
        /// The recipe, as seen from where clsmith runs.
        recipe: PathBuf,
        /// The setup file that overrides the recipe's, likewise.
        setup: Option<PathBuf>,
        /// What chose it, for people: `rule 2` or `otherwise`.
        by: String,
    },
    /// It goes on as it is.
    Pass,
}

impl Rules {
    /// Reads a file of rules. The recipes that it names are not opened.
    ///
    /// # Errors
    /// Everything that is wrong with the file, each at its place.
    pub fn load(source: &Arc<Source>) -> Result<Self, Vec<Diagnostic>> {
        text::load(source)
    }

    /// What becomes of a program.
    ///
    /// # Errors
    /// [`codes::NO_RULE`] when no rule fits and `otherwise` does not say what to do then, or says `stop`.
    pub fn choose(&self, facts: &Facts) -> Result<Choice, Box<Diagnostic>> {
        for (index, rule) in self.rules.iter().enumerate() {
            if rule.when.fits(facts) {
                return Ok(self.choice(&rule.job, format!("rule {}", index + 1)));
            }
        }
        match &self.otherwise {
            Otherwise::Recipe(job) => Ok(self.choice(job, "otherwise".to_owned())),
            Otherwise::Pass => Ok(Choice::Pass),
            Otherwise::Stop => Err(Box::new(self.nothing_fits(facts))),
        }
    }

    /// Every recipe that a rule may choose, with its setup.
    pub fn all(&self) -> Vec<Choice> {
        let rules = self.rules.iter().enumerate();
        let mut all: Vec<Choice> =
            rules.map(|(index, rule)| self.choice(&rule.job, format!("rule {}", index + 1))).collect();
        if let Otherwise::Recipe(job) = &self.otherwise {
            all.push(self.choice(job, "otherwise".to_owned()));
        }
        all
    }

    fn choice(&self, job: &RecipeAndSetup, by: String) -> Choice {
        let here = Path::new(self.source.name());
        let setup = job.setup.as_ref().map(|setup| setup.beside(here));
        Choice::Recipe { recipe: job.recipe.beside(here), setup, by }
    }

    fn nothing_fits(&self, facts: &Facts) -> Diagnostic {
        let message = format!("no rule fits this program: {facts}");
        let span = self.place("otherwise").or_else(|| self.place("rules")).unwrap_or_default();
        Diagnostic::new(codes::NO_RULE, message).label(&self.source, span, "none of these, then stop")
    }

    fn place(&self, key: &'static str) -> Option<Span> {
        self.document.key_place(&[Segment::Key(key)])
    }
}

impl When {
    fn fits(&self, facts: &Facts) -> bool {
        let any = |globs: &Option<Vec<Glob>>, names: &[String]| {
            globs
                .as_ref()
                .is_none_or(|globs| names.iter().any(|name| globs.iter().any(|glob| glob.matches(name))))
        };
        let tool = self.tool.as_ref().is_none_or(|patterns| {
            facts.tools.iter().any(|(number, name)| {
                patterns.iter().any(|pattern| pattern.matches(*number, name.as_deref()))
            })
        });
        tool && any(&self.machine, &facts.machines)
            && any(&self.operation, &facts.operations)
            && any(&self.file, std::slice::from_ref(&facts.file))
    }
}
