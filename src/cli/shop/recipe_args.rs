//! Options that say which recipe a program gets.

use crate::cli::files;
use clap::Args;
use clsmith::choice::{Choice, Facts, Rules};
use clsmith::diagnostic::Diagnostic;
use clsmith::program::{Dialect, Program};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct RecipeArgs {
    /// The recipe (YAML)
    #[arg(long, value_name = "RECIPE", required_unless_present = "select", conflicts_with = "select")]
    recipe: Option<PathBuf>,
    /// Rules that choose the recipe by machine, tool, operation or file name (`clsmith schema --select`)
    #[arg(long, value_name = "RECIPES")]
    select: Option<PathBuf>,
    /// A setup file; overrides the recipe's setup. With --select, a rule names it
    #[arg(long, value_name = "FILE", conflicts_with = "select")]
    setup: Option<PathBuf>,
    /// The dialect, instead of finding it from the text
    #[arg(long, value_parser = files::dialect, value_name = "NAME")]
    pub dialect: Option<Dialect>,
}

/// Who says which recipe a program gets.
pub enum Chooser {
    /// The same for all.
    One(Choice),
    /// The first rule that fits.
    Rules(Rules),
}

impl RecipeArgs {
    /// Reads the rules, if there are any.
    pub fn chooser(&self) -> Result<Chooser, Vec<Diagnostic>> {
        if let Some(path) = &self.select {
            let source = files::read(path).map_err(|found| vec![*found])?;
            return Rules::load(&source).map(Chooser::Rules);
        }
        let recipe = self.recipe.clone().unwrap_or_default();
        Ok(Chooser::One(Choice::Recipe { recipe, setup: self.setup.clone(), by: "--recipe".to_owned() }))
    }

    /// Files that are read whatever the program: no output may be one of them.
    pub fn files(&self) -> impl Iterator<Item = &PathBuf> {
        [&self.recipe, &self.select, &self.setup].into_iter().flatten()
    }
}

impl Chooser {
    /// What becomes of a program.
    pub fn choose(&self, file: &str, program: &Program) -> Result<Choice, Box<Diagnostic>> {
        match self {
            Self::One(choice) => Ok(choice.clone()),
            Self::Rules(rules) => rules.choose(&Facts::of(file, program)),
        }
    }

    /// Every recipe that may be chosen.
    pub fn all(&self) -> Vec<Choice> {
        match self {
            Self::One(choice) => vec![choice.clone()],
            Self::Rules(rules) => rules.all(),
        }
    }
}
