//! Which part of a batch this machine does.

use std::fmt;
use std::str::FromStr;

/// One of several parts of a batch, written `2/8`: counted from 1.
///
/// File k of the list sorted by name belongs to shard `k mod N`. So the parts are as many files, give or take one;
/// neighbours, which are often alike, are spread; and every machine that sees the same files makes the same parts,
/// whatever order its disk lists them in.
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
    /// Part `index` of `count`; `None` unless `1 <= index <= count`.
    pub fn new(index: u32, count: u32) -> Option<Self> {
        (1..=count).contains(&index).then_some(Self { index, count })
    }

    /// Which part, from 1.
    pub fn index(self) -> u32 {
        self.index
    }

    /// How many parts there are.
    pub fn count(self) -> u32 {
        self.count
    }

    /// Whether file `position` (from 0) of the sorted list belongs to this part.
    pub fn contains(self, position: usize) -> bool {
        position as u64 % u64::from(self.count) == u64::from(self.index - 1)
    }

    /// As part of a file's name: `2-of-8`.
    pub fn file_name_part(self) -> String {
        format!("{}-of-{}", self.index, self.count)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

/// Why a text names no shard.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BadShard {
    /// It is not two numbers with a slash between them.
    #[error("a shard is written I/N: 1/8 to 8/8")]
    NotTwoNumbers,
    /// The first shard has the number 1.
    #[error("shards count from 1: 1/{count} to {count}/{count}; where the scheduler counts from 0, add 1")]
    CountedFromZero {
        /// The number of shards that the text asks for.
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
