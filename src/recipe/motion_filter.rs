//! This module holds `where:`, which states to which part of a program a step applies.

use super::parameters::{Glob, NonNegative, Positive, ToolPattern};
use crate::program::MotionClass;
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::{Deserializer, Error as _};

/// Which part of the program a step applies to. What is given must all fit; of a list, one has to. Empty:
/// everything.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MotionFilter {
    /// Names of operations. `*` and `?` are wildcards.
    #[serde(default, deserialize_with = "deserialize_not_empty")]
    #[schemars(length(min = 1))]
    #[schemars(extend("x-default" = "all"))]
    pub operations: Option<Vec<Glob>>,
    /// Numbers or names of tools.
    #[serde(default, deserialize_with = "deserialize_not_empty")]
    #[schemars(length(min = 1))]
    #[schemars(extend("x-default" = "all"))]
    pub tools: Option<Vec<ToolPattern>>,
    /// Classes of motion.
    #[serde(default, deserialize_with = "deserialize_not_empty")]
    #[schemars(length(min = 1))]
    #[schemars(extend("x-default" = "all"))]
    pub motions: Option<Vec<MotionClass>>,
    /// The range of the programmed feed, in the recipe's unit per minute. Motions without a feed do not
    /// match.
    #[serde(default, deserialize_with = "deserialize_feed_range")]
    #[schemars(extend("x-default" = "any feed, and motions without one"))]
    pub feed: Option<FeedRange>,
    /// `true` for taps and thread passes alone, `false` for all but these. Their feed is the pitch times the
    /// spindle speed, so a step changes it only where `true` asks for it by name.
    #[serde(default)]
    #[schemars(extend("x-default" = "all, of which threads keep their feed"))]
    pub threads: Option<bool>,
    /// Whether it is an error if nothing in the program fits, which is the rule: a step that selects nothing
    /// is most often a name with a slip. `false` for recipes that serve programs of which some have nothing
    /// to select.
    #[serde(default = "default_required")]
    pub required: bool,
}

impl Default for MotionFilter {
    fn default() -> Self {
        Self { operations: None, tools: None, motions: None, feed: None, threads: None, required: true }
    }
}

pub(super) fn default_required() -> bool {
    true
}

/// A range of feeds, including both ends.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FeedRange {
    /// The lowest feed that matches, in the recipe's unit per minute.
    #[schemars(extend("x-unit" = "the recipe's unit per minute", "x-default" = "no lowest feed"))]
    pub min: Option<NonNegative>,
    /// The highest feed that matches, in the recipe's unit per minute.
    #[schemars(extend("x-unit" = "the recipe's unit per minute", "x-default" = "no highest feed"))]
    pub max: Option<Positive>,
}

/// The data of a motion by which a step decides whether it is meant.
#[derive(Debug, Clone, Copy, Default)]
pub struct MotionFacts<'a> {
    /// The name of its operation.
    pub operation: Option<&'a str>,
    /// The number of the tool in the spindle.
    pub tool_number: Option<u32>,
    /// The name of the tool in the spindle.
    pub tool_name: Option<&'a str>,
    /// The class of the motion.
    pub motion: Option<MotionClass>,
    /// The programmed feed, in the recipe's unit per minute. It is `None` for rapids.
    pub feed: Option<f64>,
    /// Whether it taps a hole or cuts a thread.
    pub cuts_thread: bool,
}

impl MotionFilter {
    /// Returns whether it leaves nothing out.
    pub fn is_everything(&self) -> bool {
        self.operations.is_none()
            && self.tools.is_none()
            && self.motions.is_none()
            && self.feed.is_none()
            && self.threads.is_none()
    }

    /// Returns whether a motion is meant. What is asked for but not known does not fit.
    ///
    /// ```
    /// use clsmith::parameters::Glob;
    /// use clsmith::program::MotionClass;
    /// use clsmith::recipe::{MotionFacts, MotionFilter};
    ///
    /// let filter = MotionFilter {
    /// operations: Some(vec![Glob::new("POCKET*")?]),
    /// motions: Some(vec![MotionClass::Engage]),
    /// ..MotionFilter::default()
    /// };
    /// let mut facts = MotionFacts {
    /// operation: Some("POCKET_1"),
    /// tool_number: Some(3),
    /// tool_name: None,
    /// motion: Some(MotionClass::Engage),
    /// feed: Some(600.0),
    /// cuts_thread: false,
    /// };
    /// assert!(filter.matches_motion(&facts));
    /// facts.motion = Some(MotionClass::Cut);
    /// assert!(!filter.matches_motion(&facts));
    /// # Ok::<(), clsmith::parameters::GlobError>(())
    /// ```
    pub fn matches_motion(&self, facts: &MotionFacts<'_>) -> bool {
        self.matches_operation(facts.operation)
            && self.matches_tool(facts.tool_number, facts.tool_name)
            && self.matches_kind(facts.motion, facts.feed)
            && self.threads.is_none_or(|wanted| wanted == facts.cuts_thread)
    }

    /// Returns whether an operation of this name is meant.
    pub fn matches_operation(&self, name: Option<&str>) -> bool {
        is_unset_or_any(&self.operations, |glob| name.is_some_and(|name| glob.matches_name(name)))
    }

    /// Returns whether a tool is meant, by its number and name in the file.
    pub fn matches_tool(&self, number: Option<u32>, name: Option<&str>) -> bool {
        is_unset_or_any(&self.tools, |tool| tool.matches_tool(number, name))
    }

    /// Returns whether a motion of this class and feed is meant, whatever its operation and tool.
    pub fn matches_kind(&self, class: Option<MotionClass>, feed: Option<f64>) -> bool {
        is_unset_or_any(&self.motions, |&wanted| class == Some(wanted))
            && self.feed.is_none_or(|range| feed.is_some_and(|feed| range.contains(feed)))
    }
}

impl From<&MotionFilter> for MotionFilter {
    fn from(filter: &MotionFilter) -> Self {
        filter.clone()
    }
}

fn is_unset_or_any<T>(wanted: &Option<Vec<T>>, fits: impl FnMut(&T) -> bool) -> bool {
    wanted.as_ref().is_none_or(|wanted| wanted.iter().any(fits))
}

impl FeedRange {
    /// Returns whether a feed lies in the range.
    pub fn contains(self, feed: f64) -> bool {
        self.min.is_none_or(|min| feed >= min.get()) && self.max.is_none_or(|max| feed <= max.get())
    }
}

/// Reads a list that must have at least one element if it is given.
pub(crate) fn deserialize_not_empty<'de, T: Deserialize<'de>, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<Vec<T>>, D::Error> {
    let list = Option::<Vec<T>>::deserialize(deserializer)?;
    if list.as_ref().is_some_and(Vec::is_empty) {
        return Err(D::Error::custom("an empty list selects nothing\nRemove the key to select everything."));
    }
    Ok(list)
}

fn deserialize_feed_range<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<FeedRange>, D::Error> {
    let range = Option::<FeedRange>::deserialize(deserializer)?;
    match range {
        Some(FeedRange { min: None, max: None }) => {
            Err(D::Error::custom("neither `min` nor `max` is given\nGive one of them, or both."))
        }
        Some(FeedRange { min: Some(min), max: Some(max) }) if min.get() > max.get() => {
            Err(D::Error::custom(format!("`min` ({min}) is above `max` ({max})\nNo feed fits such a range.")))
        }
        range => Ok(range),
    }
}
