//! Balls over profiles.

mod brute;
mod chain;
mod chords;
mod curves;
mod ends;
mod exact;
mod properties;
mod reach;
mod regrind;
