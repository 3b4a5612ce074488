//! Which part of a batch this machine does.

use std::fmt;
use std::str::FromStr;

/// One of several parts of a batch, written `2/8`: counted from 1.
///
/// File k of the list sorted by name belongs to shard `k mod N`. So the parts are as many files, give or take one;
/// neighbours, which are often alike, are spread; and every machine that sees the same files makes the same parts,
/// whatever order its disk lists them in.
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

impl FromStr for Shard {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(index, count)| {
            let number = |text: &str| text.trim().parse::<u32>().ok();
            Some((number(index)?, number(count)?))
        });
        match numbers {
            None => Err("a shard is written I/N: 1/8 to 8/8".into()),
            Some((0, count)) => Err(format!(
                "shards count from 1: 1/{count} to {count}/{count}; where the scheduler counts from 0, add 1"
            )),
            Some((index, count)) => Self::new(index, count)
                .ok_or_else(|| format!("there is no shard {index} of {count}; shards count from 1")),
        }
    }
}
