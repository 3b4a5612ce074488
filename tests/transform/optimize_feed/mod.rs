//! What `optimize_feed` is made of: feeds from loads, and motions split in the text.

mod acceleration;
mod axes;
mod bending;
mod certified;
mod feeds;
mod layers;
mod plateaus;
mod properties;
mod split;
mod split_files;
mod step;
