//! This module runs `clsmith batch` and `clsmith merge`.

mod merge;
mod progress;

pub(super) use merge::MergeArgs;

use super::closed_pipe::ignore_closed_pipe;
use super::command_exit::CommandExit;
use super::command_outputs::{CommandOutputs, print_summary};
use super::finding_args::FindingArgs;
use super::input_files::{self, LoadedRecipe, STANDARD};
use super::output_args::JsonArgs;
use super::progress::ProgressArgs;
use super::run_limits::LimitArgs;
use super::terminal;
use crate::cli::stop::Stop;
use bytesize::ByteSize;
use clap::Args;
use clsmith::batch::batch_document::batch_to_json;
use clsmith::batch::batch_results::{self, ResultsHead};
use clsmith::batch::jobs_file::{self, BatchJobs, InputPattern};
use clsmith::batch::{
    BatchOutcome, BatchPlan, BatchRecord, BatchRun as Run, LockedFolder, OutputFolder, PreparedRecipe, Shard,
    summary,
};
use clsmith::diagnostic::{Diagnostic, Failure, codes};
use clsmith::output_files::is_same_file;
use clsmith::program::Dialect;
use clsmith::report::finding_policy::FindingPolicy;
use progress::BatchProgress;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  clsmith batch --recipe recipe.yaml -o done 'programs/**/*.cls'
  clsmith batch jobs.yaml                              recipes, files and output folder from a file
  clsmith batch jobs.yaml --resume                     go on after a power cut; do what is new or changed
  clsmith batch jobs.yaml --memory 2GiB --threads 4    bounds for memory and processors
  clsmith batch jobs.yaml --shard 2/8                  the second of eight machines' parts
  clsmith merge done/results-*-of-8.jsonl -o all.jsonl   the parts' results in one

A jobs file (schema: clsmith schema --jobs); paths are relative to its folder:
  out: done
  jobs:
    - { recipe: slow-entry.yaml, setup: vmc3.yaml, files: ['programs/**/*.cls'] }
    - { recipe: to-inch.yaml, files: ['us/*.ncl'], out: us }

Patterns: * and ? stay in a folder, ** goes through all below, {a,b} is either. Quote them. Outputs keep the
folders below the part in front of the first wildcard. Hidden files count where the pattern names the dot,
links are followed, the output folder is never searched.

An output appears whole or not at all. A file with errors is not written; the others are, and the exit code
is 1. What cannot be right (a pattern without files, two inputs for one output, an output that is an input or
leaves the folder) is refused before anything runs.

As many files run at once as there are threads, and as fit into --memory, which counts for all of them together;
without it, that is half of what is available.

Results are JSON Lines, sorted by name, the same whatever the order, threads or shards; names that are no UTF-8
are { \"lossy\": ..., \"hex\": ... }. --json gives the same as one document, with the findings about the
batch itself, also if it is refused. The folder also gets .clsmith-batch.journal, which --resume reads.";

/// Corrects many programs, in parallel within a memory budget
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct BatchArgs {
    /// A jobs file (YAML); with --recipe, programs or patterns for them
    #[arg(required = true, value_name = "JOBS|PATTERN")]
    what: Vec<PathBuf>,
    /// The recipe (YAML) for all programs, instead of a jobs file
    #[arg(long, value_name = "FILE", requires = "output")]
    recipe: Option<PathBuf>,
    /// A setup file. It overrides the recipe's setup
    #[arg(long, value_name = "FILE", requires = "recipe")]
    setup: Option<PathBuf>,
    /// The output folder. It overrides that of a jobs file, and is made if it does not exist
    #[arg(short, long, alias = "out", value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Skip files that are done and unchanged: input, recipe with its files, options, version and output are
    /// compared by content
    #[arg(long)]
    resume: bool,
    /// Do part I of N, counted from 1: every Nth file of the sorted list
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    #[command(flatten)]
    limits: LimitArgs,
    /// Begin no file after one has failed
    #[arg(long)]
    fail_fast: bool,
    /// Where to write the results; by default results.jsonl in the output folder. A shard adds -I-of-N to the
    /// name
    #[arg(long, value_name = "FILE")]
    results: Option<PathBuf>,
    /// Include the seconds for each file in the results, which differ from run to run
    #[arg(long)]
    times: bool,
    #[command(flatten)]
    json: JsonArgs,
    /// The dialect of all programs, instead of finding it from their text
    #[arg(long, value_parser = input_files::dialect_parser(), value_name = "NAME")]
    dialect: Option<Dialect>,
    #[command(flatten)]
    progress: ProgressArgs,
    #[command(flatten)]
    pub(in crate::cli) findings: FindingArgs,
}

/// The size of a thread's stack in bytes. It is that of a main thread, because rare large statements need a
/// deep recursion.
const STACK: usize = 8 << 20;

/// A batch that is planned and checked, before anything runs.
struct PreparedBatch {
    plan: BatchPlan,
    works: Vec<PreparedRecipe>,
    folder: LockedFolder,
    results: PathBuf,
    /// The files that are read, and the results: none of them may be the file of the JSON.
    inputs: Vec<PathBuf>,
    /// The memory for all files together, in bytes.
    memory: u64,
}

impl BatchArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        let usage = |problem: &str| Err(Stop::Usage(problem.to_owned()));
        if self.recipe.is_none() && self.what.len() > 1 {
            return usage("give one jobs file; or a recipe with --recipe, and then programs or patterns");
        }
        if self.results.as_deref() == Some(Path::new(STANDARD)) {
            return usage(
                "results are written to a file, not to standard output; read it when the batch is done",
            );
        }
        let policy = self.findings.build_policy()?;
        let given: Vec<&Path> =
            self.what.iter().chain(&self.recipe).chain(&self.setup).map(PathBuf::as_path).collect();
        self.json.check_file(&given)?;
        let jobs = self.read_jobs().map_err(|failure| self.write_refusal(failure.into(), &given))?;
        let Some(out) = self.output.clone().or_else(|| jobs.out.clone()) else {
            return usage("the jobs file names no output folder (`out:`); give one with -o");
        };
        self.run_jobs(&policy, &jobs, &out).map_err(|stop| self.write_refusal(stop, &given))
    }

    /// Writes the findings that stopped the batch as JSON, if that is wanted. Returns why it stopped.
    fn write_refusal(&self, stop: Stop, inputs: &[&Path]) -> Stop {
        // What files a batch reads is known only once it is planned.
        if !self.json.is_surely_no_input() {
            return stop;
        }
        self.json.write_stopped(inputs, stop, |found| batch_to_json(None, &[], 0, false, found))
    }

    fn run_jobs(&self, policy: &FindingPolicy, jobs: &BatchJobs, out: &Path) -> Result<CommandExit, Stop> {
        let began = Instant::now();
        let ready = self.prepare_batch(jobs, out)?;
        let mut warnings = ready.plan.findings.clone();
        warnings.extend(ready.plan.find_over_budget(self.shard, ready.memory));
        let warnings = policy.apply(warnings);
        if warnings.iter().any(Diagnostic::is_error) {
            return Err(warnings.into());
        }
        let inputs: Vec<&Path> = ready.inputs.iter().map(PathBuf::as_path).collect();
        if self.json.path() == Some(&ready.results) {
            return Err(Stop::Usage(format!("two outputs would go to {}", ready.results.display())));
        }
        self.json.check_file(&inputs)?;
        self.show_findings(&warnings)?;
        // Old results would look like those of this batch if it were killed.
        remove_old_results(&ready.results)?;
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(self.limits.threads().count())
            .stack_size(STACK)
            .build();
        let pool = pool.map_err(io::Error::other)?;
        let outputs = CommandOutputs::default();
        let bars = BatchProgress::new(
            self.progress,
            &self.findings,
            outputs.interrupt(),
            (self.limits.of_batch_file(), self.limits.memory_bytes()),
        );
        outputs.stop_gently(bars.clear_on_ctrl_c())?;
        let options = format!("{policy:?} {:?}", self.dialect);
        let mine = ready.plan.files_of_shard(self.shard);
        bars.begin_files(mine.iter().filter_map(|&index| ready.plan.files.get(index)));
        let batch = Run {
            plan: &ready.plan,
            works: &ready.works,
            policy,
            dialect: self.dialect,
            options: &options,
            folder: &ready.folder,
            pool: &pool,
            memory: ready.memory,
            fail_fast: self.fail_fast,
            resume: self.resume,
            interrupt: outputs.interrupt(),
        };
        let ran = batch.run_batch(&bars);
        bars.clear_bars();
        let ran = ran?;
        if ran.interrupted {
            eprintln!("clsmith batch: stopped; go on with --resume");
            return Err(Stop::Interrupted);
        }
        let head = ResultsHead::new(
            ready.plan.batch_id(&ready.works, &options),
            ready.plan.files.len(),
            self.shard.map(|shard| (shard, mine.len())),
        );
        self.write_results(&ready, &head, &ran, &outputs, (warnings, began))
    }

    /// Returns the jobs of the jobs file or of the command line.
    fn read_jobs(&self) -> Result<BatchJobs, Failure> {
        let Some(recipe) = &self.recipe else {
            let path = self.what.first().map(PathBuf::as_path).unwrap_or(Path::new(""));
            let source = input_files::read_source(path)?;
            return jobs_file::load_jobs(&source, path);
        };
        let asked = |path: &PathBuf| InputPattern { written: path.clone().into_os_string(), place: None };
        let job = jobs_file::BatchEntry {
            recipe: recipe.clone(),
            setup: self.setup.clone(),
            files: self.what.iter().map(asked).collect(),
            below: PathBuf::new(),
            place: None,
        };
        Ok(BatchJobs { base: PathBuf::new(), out: None, jobs: vec![job] })
    }

    fn prepare_batch(&self, jobs: &BatchJobs, out: &Path) -> Result<PreparedBatch, Failure> {
        let mut works = Vec::new();
        let mut read: Vec<PathBuf> = Vec::new();
        let mut wrong = Vec::new();
        if self.recipe.is_none() {
            read.extend(self.what.iter().cloned());
        }
        for job in &jobs.jobs {
            let path = jobs.base.join(&job.recipe);
            let setup = job.setup.as_ref().map(|setup| jobs.base.join(setup));
            let work = input_files::read_recipe(&path, setup.as_deref()).and_then(
                |LoadedRecipe { recipe, setup, texts }| {
                    PreparedRecipe::with_fingerprint(&job.recipe, recipe, setup, &texts)
                },
            );
            read.extend([path].into_iter().chain(setup));
            match work {
                Ok(work) => {
                    read.extend(work.print.files.iter().map(|file| PathBuf::from(&file.path)));
                    works.push(work);
                }
                Err(failure) => wrong.extend(failure.into_findings()),
            }
        }
        let folder = OutputFolder::new(out, self.shard);
        let named = self.results.as_ref().map(|path| folder.shard_results_path(path));
        let results = named.clone().unwrap_or_else(|| folder.results_path());
        match BatchPlan::plan_files(jobs, &folder, &results, &read) {
            Ok(mut plan) if wrong.is_empty() => {
                let given = named.iter().filter(|results| {
                    plan.files
                        .iter()
                        .map(|file| &file.path)
                        .chain(&read)
                        .any(|path| is_same_file(path, results))
                });
                let folder = match given.map(|results| report_results_are_input(results)).next() {
                    None => folder.lock_folder()?,
                    Some(found) => return Err(found.into()),
                };
                plan.reserve_comment_memory(&works);
                let of_files = plan.files.iter().flat_map(|file| [file.path.clone(), out.join(&file.output)]);
                let inputs = read.into_iter().chain(of_files).chain([results.clone()]).collect();
                Ok(PreparedBatch { plan, works, folder, results, inputs, memory: self.memory_bytes() })
            }
            Ok(_) => Err(wrong.into()),
            Err(failure) => Err(failure.after(wrong)),
        }
    }

    /// Writes the results and prints a summary.
    fn write_results(
        &self,
        ready: &PreparedBatch,
        head: &ResultsHead,
        ran: &BatchOutcome,
        outputs: &CommandOutputs,
        (warnings, began): (Vec<Diagnostic>, Instant),
    ) -> Result<CommandExit, Stop> {
        let bytes = batch_results::results_to_bytes(head, &ran.records, self.times);
        let mut found = ran.findings.clone();
        // A batch that is killed here knows its temporary file again when it goes on.
        let outputs = outputs.with_temporaries(ready.folder.temporary_files());
        // The summary is printed even if the results cannot be written.
        match outputs.write_output(&ready.results, |out| out.write_all(&bytes)) {
            Err(Stop::Found { findings, .. }) => found.extend(findings),
            written => written?,
        }
        if !self.progress.quiet {
            let seconds = Some(began.elapsed().as_secs_f64());
            let mut text = summary::summary_to_text(&ran.records, ran.before, seconds);
            let (workers, memory) = (self.limits.threads().count(), ByteSize::b(ready.memory).display().si());
            text.push_str(&format!("\nat most {workers} at once, in {memory}\n"));
            text.push_str(&format!("results: {}\n", ready.results.display()));
            ignore_closed_pipe(print_summary(&text, self.json.is_standard()))?;
        }
        self.show_findings(&found)?;
        let mut all = warnings;
        all.extend(found.iter().cloned());
        let inputs: Vec<&Path> = ready.inputs.iter().map(PathBuf::as_path).collect();
        self.json.write_document(&inputs, || {
            batch_to_json(Some(head), &ran.records, ran.before, self.times, &all)
        })?;
        Ok(if found.is_empty() { exit_for_records(&ran.records) } else { CommandExit::Errors })
    }

    fn show_findings(&self, found: &[Diagnostic]) -> io::Result<()> {
        if found.is_empty() {
            return Ok(());
        }
        let mut err = io::stderr().lock();
        ignore_closed_pipe(self.findings.write_findings(
            &mut err,
            terminal::is_stderr_terminal(),
            found,
            None,
        ))
    }

    /// Returns the memory for all files together, in bytes.
    fn memory_bytes(&self) -> u64 {
        self.limits.memory_bytes().unwrap_or_else(|| available_memory_bytes() / 2)
    }
}

/// Removes old results, and finds out before the work whether new ones can be written.
fn remove_old_results(results: &Path) -> Result<(), Diagnostic> {
    let unwritable = |why: &str| {
        let message = format!("the results {} cannot be written: {why}", results.display());
        Diagnostic::new(codes::UNWRITABLE, message)
    };
    let folder = results.parent().filter(|folder| !folder.as_os_str().is_empty());
    if folder.is_some_and(|folder| !folder.is_dir()) {
        return Err(unwritable("there is no such folder"));
    }
    match std::fs::remove_file(results) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(unwritable(&error.to_string())),
        _ => Ok(()),
    }
}

fn report_results_are_input(results: &Path) -> Diagnostic {
    let message = format!("writing the results to {} would overwrite an input", results.display());
    Diagnostic::new(codes::OUTPUT_IS_INPUT, message)
}

/// Returns the available memory of the machine, or of the container if that is less. Where the system does not tell it, as
/// in one without `/proc`, it is none, and each file is worked on alone.
fn available_memory_bytes() -> u64 {
    let mut system = sysinfo::System::new();
    system.refresh_memory();
    if system.total_memory() == 0 {
        return 0;
    }
    let of_machine = system.available_memory();
    match system.cgroup_limits() {
        // The cache of files that were read does not count, because the container releases it when memory is
        // needed.
        Some(limits) => of_machine.min(limits.total_memory.saturating_sub(limits.rss)),
        None => of_machine,
    }
}

/// Returns the exit code of a batch, which tells whether every file was written.
fn exit_for_records(records: &[BatchRecord]) -> CommandExit {
    let done = records.iter().all(|record| record.outcome.is_written());
    if done { CommandExit::Done } else { CommandExit::Errors }
}
