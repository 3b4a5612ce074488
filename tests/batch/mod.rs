//! Batches: their parts without the command.

mod budget;
mod jobs;
mod names;
mod results;
