//! This module holds the part of a batch that a machine processes.

use std::fmt;
use std::str::FromStr;

/// One of several parts of a batch, written `2/8` and counted from 1.
///
/// File k of the list sorted by name belongs to shard `k mod N`. So the sizes of the parts differ by one file
/// at most. Neighbours, which are often alike, are distributed. And every machine that sees the same files
/// makes the same parts, whatever the order on its disk.
///
/// ```
/// use clsmith::batch::Shard;
///
/// let second: Shard = "2/8".parse()?;
/// assert_eq!((second.index(), second.count()), (2, 8));
/// assert!("9/8".parse::<Shard>().is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Shard {
    index: u32,
    count: u32,
}

impl Shard {
    /// Makes part `index` of `count`. Returns `None` unless `1 <= index <= count`.
    pub fn new(index: u32, count: u32) -> Option<Self> {
        (1..=count).contains(&index).then_some(Self { index, count })
    }

    /// Returns the index of the part, from 1.
    pub fn index(self) -> u32 {
        self.index
    }

    /// Returns the number of parts.
    pub fn count(self) -> u32 {
        self.count
    }

    /// Returns whether file `position` (from 0) of the sorted list belongs to this part.
    pub fn contains(self, position: usize) -> bool {
        position as u64 % u64::from(self.count) == u64::from(self.index - 1)
    }

    /// Returns the part as it occurs in file names: `2-of-8`.
    pub fn file_name_part(self) -> String {
        format!("{}-of-{}", self.index, self.count)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

/// The reason why a text names no shard.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BadShard {
    /// It is not two numbers with a slash between them.
    #[error("a shard is written I/N: 1/8 to 8/8")]
    NotTwoNumbers,
    /// The first shard has the number 1.
    #[error("shards count from 1: 1/{count} to {count}/{count}; if the scheduler counts from 0, add 1")]
    CountedFromZero {
        /// The number of shards that the text requests.
        count: u32,
    },
    /// The number is larger than the count, or the count is too large.
    #[error("there is no shard {index} of {count}; shards count from 1")]
    OutOfRange {
        /// The number of the shard.
        index: u32,
        /// The number of shards.
        count: u32,
    },
}

impl FromStr for Shard {
    type Err = BadShard;
    fn from_str(text: &str) -> Result<Self, BadShard> {
        let numbers = text.split_once('/').and_then(|(index, count)| {
            let number = |text: &str| text.trim().parse::<u32>().ok();
            Some((number(index)?, number(count)?))
        });
        match numbers {
            None => Err(BadShard::NotTwoNumbers),
            Some((0, count)) => Err(BadShard::CountedFromZero { count }),
            Some((index, count)) => Self::new(index, count).ok_or(BadShard::OutOfRange { index, count }),
        }
    }
}
