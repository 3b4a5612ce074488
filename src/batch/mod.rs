//! Many files through recipes: what to do, in which order, within which memory, and how to go on after a
//! power cut.
//!
//! [`jobs_file`] says what is wanted. [`BatchPlan`] settles which file becomes which output, and refuses
//! before anything runs: no two outputs meet, and no output is an input. Only the content of a file can make
//! that file fail, and then it fails alone. [`Shard`] says which part this machine does, [`OutputFolder`]
//! makes sure that nobody else writes there, `BatchJournal` knows what is done, and [`BatchRun`] does the
//! rest.
//!
//! Every file leaves a [`BatchRecord`]; [`batch_results`] writes the records, and [`merge`] puts those of
//! several shards together. Records say nothing about time, threads or order, so two runs of one batch can be
//! compared byte for byte.
//!
//! The journal promises nothing that is not on the disk: a line follows its output, and a resumed run
//! believes it only after the digests of input, recipe with its files, options, version and output agree. So
//! the journal needs no sync, may be torn anywhere, and journals of other shards count as well.
//!
//! Files run inside one pool of threads, which their steps use too, so the number of threads is that of the
//! whole batch. Files that wait for memory wait outside the pool. A shard takes every nth file of the sorted
//! list, not a hash: shards are even to one file, and they are the same wherever the files are the same,
//! which the batch's id in the results proves.

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
pub(crate) use journal::{BatchJournal, JournalEntry};
pub use output_folder::{LockedFolder, OutputFolder};
pub use portable_path::PortablePath;
pub use shard::{BadShard, Shard};
