//! This module holds the options that choose the recipe of a program.

use crate::cli::input_files;
use clap::Args;
use clsmith::diagnostic::Failure;
use clsmith::parse::parse_with_vocabulary;
use clsmith::program::{Dialect, ShopVocabulary};
use clsmith::recipe_rules::{RecipeChoice, RecipeRuleFacts, RecipeRules};
use clsmith::source::Source;
use std::path::PathBuf;
use std::sync::Arc;

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
    /// Decides what happens to a program. With a single recipe, the program is not read.
    pub(crate) fn choose_recipe(
        &self,
        file: &str,
        source: &Arc<Source>,
        dialect: Option<Dialect>,
    ) -> Result<RecipeChoice, Failure> {
        let rules = match self {
            Self::One(choice) => return Ok(choice.clone()),
            Self::Rules(rules) => rules,
        };
        // Most setups give no words a meaning, and then all rules see the same facts.
        let mut known: Vec<(Arc<ShopVocabulary>, Arc<RecipeRuleFacts>)> = Vec::new();
        rules.choose_recipe_by(|choice| {
            let words = read_vocabulary(choice);
            if let Some((_, facts)) = known.iter().find(|(seen, _)| *seen == words) {
                return Arc::clone(facts);
            }
            let program = parse_with_vocabulary(source, dialect, &words).program;
            let facts = Arc::new(RecipeRuleFacts::from_program(file, &program));
            known.push((words, Arc::clone(&facts)));
            facts
        })
    }

    /// Returns every recipe that may be chosen.
    pub(crate) fn list_choices(&self) -> Vec<RecipeChoice> {
        match self {
            Self::One(choice) => vec![choice.clone()],
            Self::Rules(rules) => rules.list_choices(),
        }
    }
}

/// Returns the words of the setup that a choice would use. A recipe that cannot be read has none here; it is refused once it
/// is chosen.
fn read_vocabulary(choice: &RecipeChoice) -> Arc<ShopVocabulary> {
    let RecipeChoice::Recipe { recipe, setup, .. } = choice else { return Arc::default() };
    let loaded = input_files::read_recipe(recipe, setup.as_deref());
    loaded.map(|loaded| loaded.setup.vocabulary).unwrap_or_default()
}
