//! This module sums up the motions at each programmed feed.

use super::totals::MotionLengthAndTime;
use crate::program::{Feed, FeedUnit};
use std::collections::BTreeMap;

/// If there are more feeds than this, feeds within a step of 5 % have a common row, because an optimized
/// program has a feed for every move.
const MOST_ROWS: usize = 200;

/// The size of that step.
const STEP: f64 = 1.05;

/// The motions at one programmed feed, or at feeds within 5 % when there are more than 200.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedRow {
    /// The word of the unit (`MMPM`, `IPR`, ...); `null` if the file names none (units per minute).
    pub unit: Option<&'static str>,
    /// Lowest programmed value in the row.
    pub min: f64,
    /// The highest programmed value in the row. It equals `min` unless several feeds have a common row.
    pub max: f64,
    /// The number of motions.
    pub motions: usize,
    /// Their length in the file's unit.
    pub length: f64,
    /// Their time in s; `null` if it is not known for one of them.
    pub seconds: Option<f64>,
}

/// Collects rows.
#[derive(Debug, Default)]
pub(super) struct FeedRowCollector {
    rows: BTreeMap<(u8, u64), FeedRow>,
    coarse: bool,
}

impl FeedRowCollector {
    pub(super) fn add_motion(&mut self, feed: Feed, motion: &MotionLengthAndTime) {
        self.merge_row(
            unit_rank(feed.unit),
            FeedRow {
                unit: feed.unit.map(FeedUnit::word),
                min: feed.value,
                max: feed.value,
                motions: 1,
                length: motion.length,
                seconds: motion.seconds.ok(),
            },
        );
        if !self.coarse && self.rows.len() > MOST_ROWS {
            self.coarse = true;
            for ((unit, _), row) in std::mem::take(&mut self.rows) {
                self.merge_row(unit, row);
            }
        }
    }

    /// Returns rows by unit and value.
    pub(super) fn into_rows(self) -> Vec<FeedRow> {
        self.rows.into_values().collect()
    }

    fn merge_row(&mut self, unit: u8, row: FeedRow) {
        let key = match self.coarse && row.min > 0.0 {
            // Feeds are not negative, so their bits sort like their values. The number of a step is negative
            // for feeds below 1, so an offset makes it positive.
            true => ((row.min.ln() / STEP.ln()).floor() + 1e6) as u64,
            false => row.min.to_bits(),
        };
        self.rows
            .entry((unit, key))
            .and_modify(|sum| {
                sum.min = sum.min.min(row.min);
                sum.max = sum.max.max(row.max);
                sum.motions += row.motions;
                sum.length += row.length;
                sum.seconds = sum.seconds.zip(row.seconds).map(|(a, b)| a + b);
            })
            .or_insert(row);
    }
}

fn unit_rank(unit: Option<FeedUnit>) -> u8 {
    match unit {
        None => 0,
        Some(FeedUnit::PerMinute) => 1,
        Some(FeedUnit::MmPerMinute) => 2,
        Some(FeedUnit::InchPerMinute) => 3,
        Some(FeedUnit::PerRevolution) => 4,
        Some(FeedUnit::MmPerRevolution) => 5,
        Some(FeedUnit::InchPerRevolution) => 6,
        Some(FeedUnit::InverseTime) => 7,
    }
}
