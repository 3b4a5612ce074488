//! Many files through recipes: what to do, in which order, within which memory, and how to go on after a power cut.
//!
//! [`jobs`] says what is wanted, [`Plan`] which file becomes which output (and refuses before anything runs), [`Shard`]
//! which part of it this machine does, [`Folder`] that nobody else writes there, [`Journal`] what is done already, and
//! [`Batch`] does the rest. Every file leaves a [`Record`]; [`results`] writes them, [`merge`] puts those of shards
//! together. Records say nothing of time, threads or order, so two runs of one batch can be compared byte for byte.

pub mod budget;
mod find;
mod folder;
pub mod jobs;
mod journal;
pub mod merge;
mod name;
mod one;
mod plan;
mod record;
pub mod results;
mod run;
mod shard;
pub mod summary;

pub use folder::{Folder, Locked};
pub use journal::{Done, Journal};
pub use name::Name;
pub use one::changed;
pub use plan::{Plan, Planned, Work, outside};
pub use record::{Changed, Counts, Found, Hashes, Outcome, Record};
pub use run::{Batch, Ran, Watch};
pub use shard::Shard;
