//! This module finds the step of a recipe that changed a line of a corrected program, in a thread of its own: reports of runs
//! lie beside the program, recipes are open or lie beside it or above.

use super::documents::SharedState;
use super::outbox::Outbox;
use super::places::{path_to_uri, span_to_json};
use crate::cli::input_files;
use clsmith::editor::{LineChange, ProgramView, StepPlace, StepReference, YamlFileKind, find_step_places};
use clsmith::fingerprint::Digest;
use clsmith::program::ProvenanceComment;
use clsmith::source::Source;
use lsp_server::{ErrorCode, RequestId};
use lsp_types::Position;
use serde_json::{Value, json};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// So many folders above the program are looked into for its recipe.
const MOST_FOLDERS: usize = 6;

/// A report of a run says what it is within its first bytes.
const REPORT_HEAD: usize = 64;

/// A line whose change is looked for.
pub(super) struct StepSearch {
    text: Arc<Source>,
    line: u32,
    /// The program as it was read, and where the line stands in it.
    read: Option<(Arc<ProgramView>, u32)>,
    folder: PathBuf,
    recipes: Vec<OpenRecipe>,
}

/// A recipe that is open in the editor.
struct OpenRecipe {
    uri: String,
    path: PathBuf,
    text: Arc<Source>,
}

/// The steps that were found.
struct FoundSteps {
    uri: String,
    recipe: Arc<Source>,
    steps: Vec<StepPlace>,
    /// Whether the recipe is another one than in the run; `None` if that is not known.
    is_changed: Option<bool>,
}

impl StepSearch {
    /// Takes the texts as they are typed now.
    ///
    /// # Errors
    /// Returns that the program is not open, or no file.
    pub(super) fn take(shared: &SharedState, uri: &str, at: Position) -> Result<Self, String> {
        let state = shared.lock();
        let document = state.documents.get(uri).ok_or_else(|| format!("{uri} is not open"))?;
        let path = document.path.as_ref().ok_or_else(|| format!("{uri} is no file"))?;
        let line = document.read.edited.line_before(at.line);
        let open =
            state.documents.iter().filter(|(_, other)| other.yaml_kind() == Some(YamlFileKind::Recipe));
        let recipes = open.filter_map(|(uri, other)| {
            let text = Arc::clone(other.text.source());
            Some(OpenRecipe { uri: uri.clone(), path: other.path.clone()?, text })
        });
        Ok(Self {
            text: Arc::clone(document.text.source()),
            line: at.line,
            read: document.read.view.clone().zip(line),
            folder: path.parent().unwrap_or(Path::new("")).to_path_buf(),
            recipes: recipes.collect(),
        })
    }

    /// Answers with the places of the steps; with nothing if there are none.
    pub(super) fn answer_declaration(self, id: RequestId, outbox: &Outbox) {
        let found = self.find().map(|found| {
            let ranges = found.steps.iter().map(|step| span_to_json(&found.recipe, step.span));
            ranges.map(|range| json!({ "uri": found.uri, "range": range })).collect()
        });
        outbox.answer(id, &found.unwrap_or(Value::Null));
    }

    /// Answers with the steps and lets the editor show the last of them, or says why there are none.
    pub(super) fn answer_command(self, id: RequestId, shows_documents: bool, outbox: &Outbox) {
        let found = match self.find() {
            Ok(found) => found,
            Err(reason) => return outbox.refuse(id, ErrorCode::RequestFailed, &reason),
        };
        let steps: Vec<Value> = found
            .steps
            .iter()
            .map(|step| {
                let range = span_to_json(&found.recipe, step.span);
                json!({ "number": step.number, "name": step.name, "uri": found.uri, "range": range })
            })
            .collect();
        // What stands in the file now is of the last step that changed it.
        if let (true, Some(range)) = (shows_documents, steps.last().and_then(|step| step.get("range"))) {
            outbox.show_document(&found.uri, range);
        }
        outbox.answer(id, &json!({ "steps": steps, "recipeChanged": found.is_changed }));
    }

    fn find(&self) -> Result<FoundSteps, String> {
        let change = self.find_change()?;
        let mut reason = None;
        let mut candidates = self.list_recipes(&change);
        // The recipe of the run comes before others of its name.
        candidates.sort_by_key(|(_, _, is_changed)| *is_changed == Some(true));
        for (uri, recipe, is_changed) in candidates {
            match find_step_places(&recipe, &change.steps) {
                Ok(steps) if !steps.is_empty() => return Ok(FoundSteps { uri, recipe, steps, is_changed }),
                Ok(_) => reason = reason.or(Some(format!("{} has no such step now", recipe.name()))),
                Err(failure) => {
                    let first = failure.into_findings().into_iter().next().map(|found| found.message);
                    reason = reason.or(first);
                }
            }
        }
        let told: Vec<String> = change.steps.iter().map(describe_step).collect();
        let recipe = change.recipes.first().map_or("a recipe", String::as_str);
        let reason = reason.unwrap_or_else(|| "it was not found beside the program".to_owned());
        Err(format!("{} of {recipe} changed this line: {reason}", told.join(", ")))
    }

    /// Finds what is known of the line: reports are exact, comments come next.
    fn find_change(&self) -> Result<LineChange, String> {
        let mut other_run = None;
        for path in list_reports(&self.folder) {
            let Ok(report) = input_files::read_bytes(&path) else { continue };
            match LineChange::from_report(&self.text, self.line_of_record(), &report) {
                Ok(Some(change)) if !change.steps.is_empty() => return Ok(change),
                Ok(Some(_)) => {}
                Ok(None) => other_run = Some(path),
                // Other files of JSON are no business of ours.
                Err(_) => {}
            }
        }
        if let Some(change) = self.read_comments().filter(|change| !change.steps.is_empty()) {
            return Ok(change);
        }
        let mut reason =
            "no step changed this line, by the comments in the program and the reports of runs (`apply --json`) beside it"
                .to_owned();
        if let Some(path) = other_run {
            reason.push_str(&format!("; the run of {} wrote another text", path.display()));
        }
        Err(reason)
    }

    fn read_comments(&self) -> Option<LineChange> {
        let (view, line) = self.read.as_ref()?;
        LineChange::from_comments(view, *line)
    }

    /// Returns the line of the record that a comment of clsmith tells of: the next one that is no such comment. Any other
    /// line is its own.
    fn line_of_record(&self) -> u32 {
        let is_comment = |line: u32| {
            let bytes = self.text.line_span(line as usize + 1).map(|span| self.text.slice(span));
            bytes.is_some_and(|bytes| ProvenanceComment::from_text(bytes) == Some(ProvenanceComment::Change))
        };
        (self.line..).find(|line| !is_comment(*line)).unwrap_or(self.line)
    }

    /// Returns the recipes that may be meant, as they are typed where they are open.
    fn list_recipes(&self, change: &LineChange) -> Vec<(String, Arc<Source>, Option<bool>)> {
        let is_changed =
            |text: &Source| change.recipe_sha256.map(|digest| digest != Digest::from_bytes(text.bytes()));
        let mut found = Vec::new();
        for name in &change.recipes {
            let name = Path::new(name);
            for open in self.recipes.iter().filter(|open| open.path.ends_with(name)) {
                found.push((open.uri.clone(), Arc::clone(&open.text), is_changed(&open.text)));
            }
            for folder in self.folder.ancestors().take(MOST_FOLDERS) {
                let path = folder.join(name);
                if !path.is_file() || self.recipes.iter().any(|open| open.path == path) {
                    continue;
                }
                if let Ok(text) = input_files::read_bytes(&path) {
                    let is_changed = is_changed(&text);
                    found.push((path_to_uri(&path), text, is_changed));
                }
            }
        }
        found
    }
}

fn describe_step(step: &StepReference) -> String {
    match step {
        StepReference::Number(number) => format!("step {number}"),
        StepReference::Name(name) => format!("`{name}`"),
        _ => "a step".to_owned(),
    }
}

/// Returns the reports of runs in a folder, in the order of their names.
fn list_reports(folder: &Path) -> Vec<PathBuf> {
    let entries = folder.read_dir().into_iter().flatten().flatten();
    let mut found: Vec<PathBuf> = entries
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|end| end.eq_ignore_ascii_case("json")) && path.is_file())
        .filter(|path| {
            let mut head = Vec::new();
            let read = std::fs::File::open(path)
                .and_then(|file| file.take(REPORT_HEAD as u64).read_to_end(&mut head));
            read.is_ok() && String::from_utf8_lossy(&head).contains("\"clsmith run\"")
        })
        .collect();
    found.sort();
    found
}
