//! This module plans which file becomes which output. It refuses everything that cannot be right before
//! anything runs.

use super::jobs_file::{BatchJobs, InputPattern, JobsFileLocation};
use super::memory_budget;
use super::path_pattern::{self, MatchedFile, NoMatchReason};
use super::{OutputFolder, PortablePath, Shard};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::fingerprint::{Digest, RecipeFingerprint, VERSION};
use crate::output_files::FileSet;
use crate::recipe::Provenance;
use crate::setup::Setup;
use crate::source::Source;
use crate::transform::Recipe;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

/// A recipe with everything that it needs, and digests of it.
#[derive(Debug)]
pub struct PreparedRecipe {
    /// The recipe as the batch names it.
    pub name: PortablePath,
    /// The recipe that was read.
    pub recipe: Recipe,
    /// The setup that applies.
    pub setup: Setup,
    /// The digests of all files that it depends on.
    pub print: RecipeFingerprint,
}

impl PreparedRecipe {
    /// Takes a recipe. `texts` are the files that were read for it and its setup, with the recipe first.
    ///
    /// # Errors
    /// Returns [`codes::UNREADABLE`] for a model or stock file that cannot be read.
    pub fn with_fingerprint(
        name: &Path,
        recipe: Recipe,
        setup: Setup,
        texts: &[Arc<Source>],
    ) -> Result<Self, Failure> {
        let print = RecipeFingerprint::read_files(texts, &recipe, &setup)?;
        Ok(Self { name: PortablePath::from_path(name), recipe, setup, print })
    }

    /// Returns the digest of the recipe's own text.
    pub(super) fn recipe_digest(&self) -> Digest {
        self.print.files.first().map_or(self.print.sha256, |file| file.sha256)
    }

    /// Returns the digest of all other files that the recipe depends on.
    pub(super) fn setup_digest(&self) -> Digest {
        Digest::from_parts(self.print.files.iter().skip(1).map(|file| file.sha256.bytes()))
    }
}

/// A file that will be processed.
#[derive(Debug)]
#[non_exhaustive]
pub struct PlannedFile {
    /// The index of its job.
    pub job: usize,
    /// The path to open.
    pub path: PathBuf,
    /// The path as the batch names it.
    pub input: PortablePath,
    /// The path of the output below the output folder.
    pub output: PathBuf,
    /// The path of the output as a name.
    pub output_name: PortablePath,
    /// Its size in bytes when the batch was planned.
    pub size: u64,
    /// The estimated need of memory, in bytes.
    pub need: u64,
}

/// All files of a batch in the order of their names, and the findings of the search for them.
#[derive(Debug)]
pub struct BatchPlan {
    /// The files.
    pub files: Vec<PlannedFile>,
    /// Warnings about links that lead in a circle.
    pub findings: Vec<Diagnostic>,
}

impl BatchPlan {
    /// Finds the files of all jobs. `read` are other files that the batch reads: recipes, setups and models.
    ///
    /// # Errors
    /// Returns findings about patterns that match nothing, outputs with the same name, and outputs that are
    /// inputs, lead out of the folder or are files of the batch itself. All of them are reported, up to
    /// twenty of a kind.
    pub fn plan_files(
        jobs: &BatchJobs,
        folder: &OutputFolder,
        results: &Path,
        read: &[PathBuf],
    ) -> Result<Self, Failure> {
        let mut plan = Self { files: Vec::new(), findings: Vec::new() };
        let mut wrong = Vec::new();
        let not_in = std::fs::canonicalize(folder.root()).ok();
        let mut loops = BTreeSet::new();
        for (index, job) in jobs.jobs.iter().enumerate() {
            for asked in &job.files {
                match path_pattern::find_files(&jobs.base, &asked.written, not_in.as_deref()) {
                    Ok(found) => {
                        plan.files.extend(
                            found
                                .files
                                .into_iter()
                                .map(|found| plan_file(index, &jobs.base, &job.below, found)),
                        );
                        loops.extend(found.loops);
                    }
                    Err(error) => wrong.push(report_no_match(asked, &error)),
                }
            }
        }
        plan.findings.extend(loops.iter().map(|(link, folder)| {
            let message =
                format!("{} leads back to {}; it is not followed", link.display(), folder.display());
            Diagnostic::new(codes::LINK_LOOP, message)
        }));
        plan.files.sort_by(|a, b| (&a.input, &a.output_name, a.job).cmp(&(&b.input, &b.output_name, b.job)));
        plan.files.dedup_by(|a, b| (&a.input, &a.output_name, a.job) == (&b.input, &b.output_name, b.job));
        wrong.extend(plan.find_output_collisions(jobs));
        wrong.extend(plan.find_overwritten_inputs(folder, read));
        wrong.extend(plan.find_output_links(folder));
        wrong.extend(plan.find_reserved_outputs(folder, results));
        if wrong.is_empty() { Ok(plan) } else { Err(wrong.into()) }
    }

    /// Reserves memory for the comments of recipes that ask for them. `works` are the recipes of the jobs, in
    /// their order.
    pub fn reserve_comment_memory(&mut self, works: &[PreparedRecipe]) {
        let asks =
            |job: usize| works.get(job).is_some_and(|work| work.recipe.provenance == Provenance::Comments);
        for file in self.files.iter_mut().filter(|file| asks(file.job)) {
            file.need =
                file.need.saturating_add(memory_budget::estimate_comment_memory_bytes(&file.path, file.size));
        }
    }

    /// Returns the positions of the files that a shard processes. Without a shard these are all files.
    pub fn files_of_shard(&self, shard: Option<Shard>) -> Vec<usize> {
        (0..self.files.len()).filter(|&index| shard.is_none_or(|shard| shard.contains(index))).collect()
    }

    /// Reports files of a shard that may need more than `memory` bytes. Each of them runs alone.
    pub fn find_over_budget(&self, shard: Option<Shard>, memory: u64) -> Vec<Diagnostic> {
        let mb = |bytes: u64| bytes.div_ceil(1_000_000);
        let files = self.files_of_shard(shard).into_iter().filter_map(|index| self.files.get(index));
        files
            .filter(|file| file.need > memory)
            .map(|file| {
                let message = format!(
                    "{} may need {} MB of memory, more than the {} MB of the batch: it runs alone",
                    file.input,
                    mb(file.need),
                    mb(memory)
                );
                let found = Diagnostic::new(codes::OVER_BUDGET, message);
                match memory {
                    0 => found.with_help(
                        "this system does not tell its memory; `--memory` says what the batch may have",
                    ),
                    _ => found,
                }
            })
            .collect()
    }

    /// Returns the id of the batch, which depends on its files, outputs, recipes, options and the version of
    /// clsmith. Shards of the same batch have the same id. The content of CL files does not count.
    pub fn batch_id(&self, works: &[PreparedRecipe], options: &str) -> Digest {
        let mut parts = vec![VERSION.as_bytes(), options.as_bytes()];
        for file in &self.files {
            let print = works.get(file.job).map_or(&[][..], |work| work.print.sha256.bytes());
            parts.extend([file.input.bytes(), file.output_name.bytes(), print]);
        }
        Digest::from_parts(parts)
    }

    /// Finds pairs of inputs with the same output, and outputs that are a folder of another output.
    fn find_output_collisions(&self, jobs: &BatchJobs) -> Vec<Diagnostic> {
        let mut outputs: BTreeMap<Vec<u8>, &PlannedFile> = BTreeMap::new();
        let mut wrong = Vec::new();
        for file in &self.files {
            if let Some(other) = outputs.insert(file.output_name.fold_case(), file) {
                let recipes = if other.input == file.input {
                    let recipe = |file: &PlannedFile| {
                        jobs.jobs.get(file.job).map_or(String::new(), |job| job.recipe.display().to_string())
                    };
                    format!("{} by {} and by {}", file.input, recipe(other), recipe(file))
                } else {
                    format!("{} and {}", other.input, file.input)
                };
                wrong.push(Diagnostic::new(
                    codes::OUTPUTS_COLLIDE,
                    match other.output_name == file.output_name {
                        true => format!("{recipes} would both be written to {}", file.output_name),
                        false => format!(
                            "{recipes} would be written to {} and {}, which are one file on many disks",
                            other.output_name, file.output_name
                        ),
                    },
                ));
            }
        }
        for file in &self.files {
            let folders =
                file.output.ancestors().skip(1).map(|folder| PortablePath::from_path(folder).fold_case());
            if let Some(other) = folders.filter_map(|folder| outputs.get(&folder)).next() {
                let message = format!(
                    "the output of {} is {}, which is a folder for the output of {}",
                    other.input, other.output_name, file.input
                );
                wrong.push(Diagnostic::new(codes::OUTPUTS_COLLIDE, message));
            }
        }
        wrong
    }

    fn find_overwritten_inputs(&self, folder: &OutputFolder, read: &[PathBuf]) -> Vec<Diagnostic> {
        let mut inputs = FileSet::default();
        self.files.iter().map(|file| &file.path).chain(read).for_each(|path| inputs.insert(path));
        let hit = self.files.iter().filter(|file| inputs.contains(&folder.root().join(&file.output)));
        hit.map(|file| {
            let message = format!(
                "writing the output of {} to {} would overwrite an input",
                file.input,
                folder.root().join(&file.output).display()
            );
            Diagnostic::new(codes::OUTPUT_IS_INPUT, message)
        })
        .collect()
    }

    /// Finds links in the output folder. Files that are written through them would be elsewhere.
    fn find_output_links(&self, folder: &OutputFolder) -> Vec<Diagnostic> {
        let mut seen = BTreeSet::new();
        let mut wrong = Vec::new();
        for file in &self.files {
            let fresh = file.output.ancestors().filter(|path| !path.as_os_str().is_empty());
            for path in fresh.take_while(|path| seen.insert(path.to_path_buf())) {
                if folder.is_link(path) {
                    wrong.push(report_outside_link(&folder.root().join(path)));
                }
            }
        }
        wrong
    }

    /// Finds outputs with the names of the batch's own files.
    fn find_reserved_outputs(&self, folder: &OutputFolder, results: &Path) -> Vec<Diagnostic> {
        let mut ours = FileSet::default();
        let own = folder.reserved_paths();
        own.iter().map(PathBuf::as_path).chain([results]).for_each(|path| ours.insert(path));
        // If the folder does not exist yet, only the spelling of paths can be compared.
        let absolute = |path: &Path| std::path::absolute(path).ok();
        let spelt: BTreeSet<PathBuf> =
            own.iter().map(PathBuf::as_path).chain([results]).filter_map(absolute).collect();
        let hit = self.files.iter().filter(|file| {
            let path = folder.root().join(&file.output);
            ours.contains(&path) || absolute(&path).is_some_and(|path| spelt.contains(&path))
        });
        hit.map(|file| {
            let message = format!(
                "the output of {} is {}, which is a file of the batch itself",
                file.input, file.output_name
            );
            Diagnostic::new(codes::OUTPUTS_COLLIDE, message)
        })
        .collect()
    }
}

/// Reports an output that a link would take out of its folder.
pub fn report_outside_link(link: &Path) -> Diagnostic {
    let message =
        format!("{} is a link; what is written there would leave the output folder", link.display());
    Diagnostic::new(codes::OUTSIDE_OUTPUT, message)
}

fn plan_file(job: usize, base: &Path, below: &Path, found: MatchedFile) -> PlannedFile {
    let plain =
        |path: &Path| path.components().filter(|part| *part != Component::CurDir).collect::<PathBuf>();
    let path = base.join(&found.path);
    let output = plain(&below.join(found.below));
    let size = std::fs::metadata(&path).map_or(0, |there| there.len());
    PlannedFile {
        job,
        size,
        need: memory_budget::estimate_file_memory_bytes(&path, size),
        path,
        input: PortablePath::from_path(&plain(&found.path)),
        output_name: PortablePath::from_path(&output),
        output,
    }
}

fn report_no_match(asked: &InputPattern, error: &NoMatchReason) -> Diagnostic {
    let written = asked.written.to_string_lossy();
    let place = asked.place.as_ref();
    let nothing = |message: String, label: &str| {
        JobsFileLocation::make_finding(place, codes::NOTHING_MATCHES, message, label)
    };
    match error {
        NoMatchReason::Nothing if written.contains(['*', '?', '[', '{']) => {
            nothing(format!("no file matches `{written}`"), "matches nothing")
        }
        NoMatchReason::Nothing => nothing(format!("there is no file {written}"), "no such file"),
        NoMatchReason::Folder => nothing(format!("{written} is a folder"), "a folder").with_help(format!(
            "For the files in it, write '{}/**/*.cls'.",
            written.trim_end_matches(std::path::is_separator)
        )),
        NoMatchReason::Bad(why) => nothing(format!("`{written}` is no pattern: {why}"), "no pattern"),
        NoMatchReason::Unreadable(path, error) => JobsFileLocation::make_finding(
            place,
            codes::UNREADABLE,
            format!("{} cannot be read: {error}", path.display()),
            "searched because of this",
        ),
    }
}
