//! This module processes many files with recipes: what to do, in which order, within which memory, and how to
//! continue after a power cut.
//!
//! [`jobs_file`] holds what is requested. [`BatchPlan`] decides which file becomes which output, and refuses
//! faults before anything runs: no two outputs coincide, and no output is an input. After that, only the
//! content of a file can make it fail, and then only this file fails. [`Shard`] is the part for this machine,
//! [`OutputFolder`] makes sure that nobody else writes there, `BatchJournal` knows what is done, and
//! [`BatchRun`] does the rest.
//!
//! Every file leaves a [`BatchRecord`]. [`batch_results`] writes the records, and [`merge`] merges those of
//! several shards. Records contain nothing about time, threads or order, so two runs of the same batch can be
//! compared byte for byte.
//!
//! The journal claims nothing that is not on the disk: a line follows its output. A resumed run only relies
//! on it after the digests of input, recipe with its files, options, version and output agree. So the journal
//! needs no sync, may be damaged anywhere, and journals of other shards count as well.
//!
//! Files run inside one pool of threads, which their steps use too, so the number of threads is that of the
//! whole batch. Files that wait for memory wait outside the pool. A shard takes every nth file of the sorted
//! list, and no hash is involved. So the sizes of shards differ by one file at most, and they are the same
//! wherever the files are the same, which the batch's id in the results proves.

pub mod batch_document;
mod batch_plan;
mod batch_record;
pub mod batch_results;
mod batch_run;
mod file_run;
pub mod jobs_file;
mod journal;
pub mod memory_budget;
pub mod merge;
mod older_output;
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
pub(crate) use journal::{BatchJournal, JournalEntry};
pub use older_output::set_older_output_aside;
pub use output_folder::{LockedFolder, OutputFolder};
pub use portable_path::PortablePath;
pub use shard::{BadShard, Shard};
