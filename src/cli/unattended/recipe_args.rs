//! This module holds the options that choose the recipe of a program.

use crate::cli::input_files;
use clap::Args;
use clsmith::diagnostic::Failure;
use clsmith::program::{Dialect, Program};
use clsmith::recipe_rules::{RecipeChoice, RecipeRuleFacts, RecipeRules};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct RecipeArgs {
    /// The recipe (YAML)
    #[arg(long, value_name = "RECIPE", required_unless_present = "select", conflicts_with = "select")]
    recipe: Option<PathBuf>,
    /// Rules that choose the recipe by machine, tool, operation or file name (`clsmith schema --select`)
    #[arg(long, value_name = "RECIPES")]
    select: Option<PathBuf>,
    /// A setup file. It overrides the recipe's setup. With --select, a rule names it
    #[arg(long, value_name = "FILE", conflicts_with = "select")]
    setup: Option<PathBuf>,
    /// The dialect, instead of finding it from the text
    #[arg(long, value_parser = input_files::dialect_parser(), value_name = "NAME")]
    pub dialect: Option<Dialect>,
}

/// What chooses the recipe of a program.
pub(crate) enum RecipeChooser {
    /// All programs get the same recipe.
    One(RecipeChoice),
    /// The first rule that matches chooses it.
    Rules(RecipeRules),
}

impl RecipeArgs {
    /// Reads the rules, if there are any.
    pub(crate) fn read_chooser(&self) -> Result<RecipeChooser, Failure> {
        if let Some(path) = &self.select {
            let source = input_files::read_source(path)?;
            return RecipeRules::load(&source).map(RecipeChooser::Rules);
        }
        let recipe = self.recipe.clone().unwrap_or_default();
        Ok(RecipeChooser::One(RecipeChoice::Recipe {
            recipe,
            setup: self.setup.clone(),
            by: "--recipe".to_owned(),
        }))
    }

    /// Returns files that are read for every program. No output may be one of them.
    pub(crate) fn input_files(&self) -> impl Iterator<Item = &PathBuf> {
        [&self.recipe, &self.select, &self.setup].into_iter().flatten()
    }
}

impl RecipeChooser {
    /// Decides what happens to a program.
    pub(crate) fn choose_recipe(&self, file: &str, program: &Program) -> Result<RecipeChoice, Failure> {
        match self {
            Self::One(choice) => Ok(choice.clone()),
            Self::Rules(rules) => rules.choose_recipe(&RecipeRuleFacts::from_program(file, program)),
        }
    }

    /// Returns every recipe that may be chosen.
    pub(crate) fn list_choices(&self) -> Vec<RecipeChoice> {
        match self {
            Self::One(choice) => vec![choice.clone()],
            Self::Rules(rules) => rules.list_choices(),
        }
    }
}
