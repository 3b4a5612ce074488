//! This module holds the jobs of a batch, from a jobs file or from a command line.

use crate::diagnostic::{Diagnostic, DiagnosticCode, Failure, codes};
use crate::parameters::FilePath;
use crate::recipe::deserialize_not_empty;
use crate::source::{Source, Span};
use crate::yaml::{LocatedYamlFault, YamlDocument, YamlFaultKind, YamlPathSegment};
use schemars::JsonSchema;
use serde::Deserialize;
use std::ffi::OsString;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

/// The jobs of a batch.
#[derive(Debug, Default)]
pub struct BatchJobs {
    /// The folder at which relative paths start. It is empty for the folder in which clsmith runs.
    pub base: PathBuf,
    /// The output folder, if the file names it.
    pub out: Option<PathBuf>,
    /// The recipes with their files.
    pub jobs: Vec<BatchEntry>,
}

/// A recipe and its files.
#[derive(Debug)]
pub struct BatchEntry {
    /// The path of the recipe, as written.
    pub recipe: PathBuf,
    /// The path of a setup file that overrides the recipe's setup, as written.
    pub setup: Option<PathBuf>,
    /// Patterns for CL files, or their paths.
    pub files: Vec<InputPattern>,
    /// The folder for outputs below the output folder. It is empty for the output folder itself.
    pub below: PathBuf,
    /// The place of the job in the file.
    pub place: Option<JobsFileLocation>,
}

/// A pattern, and the place where it is written.
#[derive(Debug)]
pub struct InputPattern {
    /// The pattern or path.
    pub written: OsString,
    /// Its place, if it is in a file.
    pub place: Option<JobsFileLocation>,
}

/// A place in a jobs file.
#[derive(Debug, Clone)]
pub struct JobsFileLocation {
    /// The jobs file.
    pub source: Arc<Source>,
    /// The place.
    pub span: Span,
}

impl JobsFileLocation {
    /// Makes a finding, at this place if there is one.
    pub(super) fn make_finding(
        place: Option<&Self>,
        code: DiagnosticCode,
        message: String,
        label: &str,
    ) -> Diagnostic {
        let found = Diagnostic::new(code, message);
        match place {
            Some(Self { source, span }) => found.with_label(source, *span, label),
            None => found,
        }
    }
}

/// The jobs of a batch: the recipes, their files, and the folder for outputs.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "clsmith jobs file", rename = "Jobs")]
struct BatchJobsText {
    /// The output folder, relative to this file's folder. `--output` overrides it.
    out: Option<FilePath>,
    /// The jobs.
    #[serde(deserialize_with = "deserialize_some")]
    #[schemars(length(min = 1))]
    jobs: Vec<BatchEntryText>,
}

/// A recipe and its files.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Job")]
struct BatchEntryText {
    /// The recipe, relative to this file's folder.
    recipe: FilePath,
    /// A setup file that overrides the recipe's setup, relative to this file's folder.
    setup: Option<FilePath>,
    /// CL files or patterns for them, relative to this file's folder. `*` and `?` stay within a folder, and
    /// `**` goes through all folders below. Outputs keep the folders below the part before the first
    /// wildcard.
    #[serde(deserialize_with = "deserialize_some")]
    #[schemars(length(min = 1))]
    files: Vec<FilePath>,
    /// A folder for this job's outputs, inside the output folder.
    out: Option<FilePath>,
}

fn deserialize_some<'de, T: Deserialize<'de>, D: serde::Deserializer<'de>>(
    deserializer: D,
) -> Result<Vec<T>, D::Error> {
    Ok(deserialize_not_empty(deserializer)?.unwrap_or_default())
}

/// Returns the JSON schema of a jobs file, for editors.
pub fn jobs_schema() -> serde_json::Value {
    crate::yaml::make_file_schema::<BatchJobsText>("jobs")
}

/// Reads a jobs file. `path` is its own path.
///
/// # Errors
/// Returns all its faults, each at its place.
pub fn load_jobs(source: &Arc<Source>, path: &Path) -> Result<BatchJobs, Failure> {
    let document = YamlDocument::parse(source)?;
    let text: BatchJobsText = document.deserialize_checked(word_jobs_fault)?;
    let at = |path: &[YamlPathSegment<'_>]| {
        let span = document.value_span(path);
        debug_assert!(span.is_some(), "the value was read from this place");
        let span = span.unwrap_or_default();
        Some(JobsFileLocation { source: Arc::clone(source), span })
    };
    let base = path.parent().map(Path::to_path_buf).unwrap_or_default();
    let mut jobs = Vec::with_capacity(text.jobs.len());
    let mut found = Vec::new();
    for (index, job) in text.jobs.into_iter().enumerate() {
        let here = [YamlPathSegment::Key("jobs"), YamlPathSegment::Index(index)];
        let below = PathBuf::from(job.out.as_ref().map_or("", FilePath::as_str));
        if !is_inside_folder(&below) {
            let place = at(&[here[0], here[1], YamlPathSegment::Key("out")]);
            let message =
                format!("a job's `out` is a folder inside the output folder, not `{}`", below.display());
            found.push(JobsFileLocation::make_finding(
                place.as_ref(),
                codes::OUTSIDE_OUTPUT,
                message,
                "leads out of it",
            ));
        }
        let asked = |(number, file): (usize, FilePath)| InputPattern {
            written: file.as_str().into(),
            place: at(&[here[0], here[1], YamlPathSegment::Key("files"), YamlPathSegment::Index(number)]),
        };
        jobs.push(BatchEntry {
            recipe: job.recipe.as_str().into(),
            setup: job.setup.as_ref().map(|file| file.as_str().into()),
            files: job.files.into_iter().enumerate().map(asked).collect(),
            below,
            place: at(&[here[0], here[1], YamlPathSegment::Key("recipe")]),
        });
    }
    let out = text.out.map(|out| out.resolve_beside(path));
    if found.is_empty() { Ok(BatchJobs { base, out, jobs }) } else { Err(found.into()) }
}

fn word_jobs_fault(finding: &LocatedYamlFault<'_>) -> Option<(DiagnosticCode, String, String)> {
    let ([], YamlFaultKind::Type { found, .. }) = (finding.path, finding.kind) else { return None };
    let message = format!("a jobs file is a map of keys (`out:`, `jobs:`), found {found}");
    let help = "A jobs file begins with `jobs:`. A recipe is given with --recipe.";
    Some((codes::WRONG_TYPE, message, help.to_owned()))
}

/// Returns whether a path that is joined to a folder stays inside: it has no root, no drive and no `..`.
pub(super) fn is_inside_folder(path: &Path) -> bool {
    path.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir))
}
