//! Many files through recipes: what to do, in which order, within which memory, and how to go on after a power cut.
//!
//! [`jobs_file`] says what is wanted, [`BatchPlan`] which file becomes which output (and refuses before anything runs), [`Shard`]
//! which part of it this machine does, [`OutputFolder`] that nobody else writes there, [`BatchJournal`] what is done already, and
//! [`BatchRun`] does the rest. Every file leaves a [`BatchRecord`]; [`batch_results`] writes them, [`merge`] puts those of shards
//! together. Records say nothing of time, threads or order, so two runs of one batch can be compared byte for byte.

mod batch_plan;
mod batch_record;
pub mod batch_results;
mod batch_run;
mod file_run;
pub mod jobs_file;
mod journal;
pub mod memory_budget;
pub mod merge;
mod output_folder;
mod path_pattern;
mod portable_path;
mod shard;
pub mod summary;

pub use batch_plan::{BatchPlan, PlannedFile, PreparedRecipe, report_outside_link};
pub use batch_record::{
    BatchFinding, BatchFindingCounts, BatchRecord, FileDigests, FileOutcome, StatementChangeCounts,
};
pub use batch_run::{BatchOutcome, BatchRun, BatchWatcher};
pub use file_run::report_input_changed;
pub use journal::{BatchJournal, JournalEntry};
pub use output_folder::{LockedFolder, OutputFolder};
pub use portable_path::PortablePath;
pub use shard::Shard;
