//! This module finds the steps of a recipe that changed a line of a corrected program: by the report of the run, or by the
//! comments that the run has left in the program.

use super::program_view::ProgramView;
use crate::diagnostic::Failure;
use crate::fingerprint::Digest;
use crate::provenance::{read_recipe_names, read_step_names};
use crate::source::{Source, Span};
use crate::transform::Recipe;
use crate::undo::UndoData;
use std::sync::Arc;

/// A step as a report or a comment names it.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum StepReference {
    /// Its number in the recipe, from 1.
    Number(usize),
    /// Its name. A recipe may have several steps of one name, and then any of them may be meant.
    Name(String),
}

/// What is known about the change of a line.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct LineChange {
    /// The steps, the earliest first. It is empty if no step changed the line.
    pub steps: Vec<StepReference>,
    /// The recipes that may have these steps, the likeliest first: paths as they were opened, or bare names.
    pub recipes: Vec<String>,
    /// The digest of the recipe as it was in the run, if it is known.
    pub recipe_sha256: Option<Digest>,
}

/// A step in the text of a recipe.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct StepPlace {
    /// Its number, from 1.
    pub number: usize,
    /// Its name.
    pub name: &'static str,
    /// The place of its name.
    pub span: Span,
}

impl LineChange {
    /// Finds the steps that changed a line, counted from 0, by the report of the run (`apply --json`). Returns `None` if
    /// the text is not byte for byte the one that the run wrote.
    ///
    /// # Errors
    /// Returns what is wrong with the report.
    pub fn from_report(text: &Source, line: u32, report: &Arc<Source>) -> Result<Option<Self>, Failure> {
        let data = UndoData::read_report(report)?;
        let Some(span) = text.line_span(line as usize + 1) else { return Ok(None) };
        if Digest::from_bytes(text.bytes()) != data.output.sha256 {
            return Ok(None);
        }
        // The line's end belongs to it, so that a line that was emptied is found, too.
        let steps = data.undo.steps_in(span.start as usize..span.end as usize + 1);
        let recipe = data.recipe_files.first();
        Ok(Some(Self {
            steps: steps.into_iter().map(|number| StepReference::Number(usize::from(number))).collect(),
            recipes: recipe.map(|file| file.path.clone()).into_iter().collect(),
            recipe_sha256: recipe.map(|file| file.sha256),
        }))
    }

    /// Finds the steps that changed a line, counted from 0, by the comments in the program. `None` past the last line.
    pub fn from_comments(view: &ProgramView, line: u32) -> Option<Self> {
        let id = view.statement_on_line(line)?;
        let names = read_step_names(view.program(), id);
        Some(Self {
            steps: names.into_iter().map(StepReference::Name).collect(),
            recipes: read_recipe_names(view.program()),
            recipe_sha256: None,
        })
    }
}

/// Finds steps in the text of a recipe. A step that it does not have is left out.
///
/// # Errors
/// Returns what is wrong with the recipe.
pub fn find_step_places(recipe: &Arc<Source>, wanted: &[StepReference]) -> Result<Vec<StepPlace>, Failure> {
    let recipe = Recipe::load(recipe)?;
    let is_wanted = |number: usize, name: &str| {
        wanted.iter().any(|one| match one {
            StepReference::Number(wanted) => *wanted == number,
            StepReference::Name(wanted) => wanted == name,
        })
    };
    let steps = recipe.steps.iter().enumerate().map(|(index, step)| (index + 1, step.name()));
    let places = steps.filter(|(number, name)| is_wanted(*number, name)).map(|(number, name)| StepPlace {
        number,
        name,
        span: recipe.step_span(number - 1),
    });
    Ok(places.collect())
}
