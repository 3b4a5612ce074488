//! The parameters of `optimize_feed`.

use super::limit::{FeedRules, FeedWindow, SplitRule};
use super::measure::LoadCriterion;
use crate::parameters::{Factor, Fraction, NonNegative, Positive, PositiveCount};
use crate::program::MotionClass;
use crate::recipe::{MotionFilter, deserialize_not_empty};
use crate::simulation_run::EngagementModel;
use schemars::JsonSchema;
use serde::Deserialize;

/// Gives every block the feed at which the cutter's load is at its target, by simulating what it really cuts.
///
/// Needs the stock, the teeth of the tools and a spindle speed in rev/min (see `setup:`); for forces a material, too. The program is
/// simulated, feeds follow in closed form from the load of each piece of path, acceleration lowers what cannot be reached, FEDRATs
/// are written in the file's own form, and the result is simulated again: the step fails when a target is passed by more than
/// the simulation's own uncertainty. What the grid cannot know lowers the feed, never raises it.
///
/// Rapids, drilling cycles and motions that are not selected keep their feeds. A second run changes nothing beyond
/// `default_min_change`, unless `min_ratio` or `max_ratio` tie the feeds to the programmed ones.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OptimizeFeed {
    /// What `target` is about.
    #[serde(default)]
    pub criterion: LoadCriterion,
    /// The load that is allowed, in the criterion's unit.
    pub target: Positive,
    /// Further limits that hold at the same time; the lowest feed counts.
    #[serde(default, deserialize_with = "deserialize_not_empty")]
    #[schemars(length(min = 1))]
    pub limits: Option<Vec<LoadLimitSpec>>,
    /// Which part of the path counts for a block.
    #[serde(default)]
    pub window: WindowSpec,
    /// Lowest feed, in the recipe's unit per minute.
    pub min_feed: Option<Positive>,
    /// Highest feed, in the recipe's unit per minute; else the machine's `max_feed`. The lower of the two counts.
    pub max_feed: Option<Positive>,
    /// Lowest feed as a share of the programmed one.
    pub min_ratio: Option<Factor>,
    /// Highest feed as a share of the programmed one.
    pub max_ratio: Option<Factor>,
    /// Feed where nothing is cut, in the recipe's unit per minute; without it, air keeps the programmed feed, but for blocks that come
    /// within `margin` of material: those take the cutting feed there.
    pub air_feed: Option<Positive>,
    /// Path before and after material that keeps the cutting feed, in the recipe's unit; 0.5 mm when left out.
    pub margin: Option<NonNegative>,
    /// Largest change of feed along the path, in the recipe's unit per minute and second; else the machine's.
    pub max_acceleration: Option<Positive>,
    /// Breaks long blocks whose load varies; never when left out.
    pub split: Option<SplitSpec>,
    /// Smaller changes, as a share, keep the feed in force.
    #[serde(default = "default_min_change")]
    pub min_change: Fraction,
    /// Feeds are rounded down to multiples of this, in the recipe's unit per minute; 0 for as many decimals as the file prints.
    #[serde(default = "default_round_down_to")]
    pub round_down_to: NonNegative,
    /// What tells where the cutter is engaged.
    #[serde(default)]
    pub engagement: EngagementSpec,
    /// Distance of the simulation's columns, in the recipe's unit; else a fortieth of the smallest cutter's diameter. Only with
    /// `engagement: dexels`.
    pub cell: Option<Positive>,
    /// Thickness of the layers, in the recipe's unit; else a fortieth of the smallest cutter's diameter. Material lower than a layer may
    /// be missed. Only with `engagement: layers`.
    pub layer: Option<Positive>,
    /// Classes of motion that may get another feed.
    #[serde(default = "default_motions")]
    #[schemars(length(min = 1))]
    pub motions: Vec<MotionClass>,
    /// Which motions; all when it is left out.
    #[serde(default)]
    pub r#where: MotionFilter,
}

/// A limit beside the target.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoadLimitSpec {
    /// What it limits.
    pub criterion: LoadCriterion,
    /// The load that is allowed, in the criterion's unit.
    pub target: Positive,
}

/// Which part of the path counts for a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WindowSpec {
    /// All of the block: the target is never passed.
    #[default]
    Block,
    /// The half of the block before its end point and the half of the block after it, as in the paper: smoother, but the first half of a
    /// block runs at the feed of the block before.
    HalfBlocks,
}

/// What tells where the cutter is engaged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EngagementSpec {
    /// Columns of material along z: every cutter, every axis, shank and holder.
    #[default]
    Dexels,
    /// The exact chips of flat end mills in layers across z, in three and five axes up to 80 degrees from z: directions and shares are not
    /// rounded to a grid. Another tool stops the step; shank and holder are not looked at.
    Layers,
}

/// When blocks are broken into parts; lengths in the recipe's unit.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SplitSpec {
    /// Only blocks longer than this.
    pub above: Positive,
    /// No part is shorter than this.
    pub shortest: Positive,
    /// Most parts of one block.
    pub at_most: PositiveCount,
}

fn default_min_change() -> Fraction {
    Fraction::TWENTIETH
}

fn default_round_down_to() -> NonNegative {
    NonNegative::ONE
}

fn default_motions() -> Vec<MotionClass> {
    vec![MotionClass::Cut, MotionClass::Engage, MotionClass::StepOver]
}

impl OptimizeFeed {
    /// The step with a target for the chip thickness, in the unit of its parameters; everything else as a recipe leaves it out.
    pub fn new(target: Positive) -> Self {
        Self {
            criterion: LoadCriterion::default(),
            target,
            limits: None,
            window: WindowSpec::default(),
            min_feed: None,
            max_feed: None,
            min_ratio: None,
            max_ratio: None,
            air_feed: None,
            margin: None,
            max_acceleration: None,
            split: None,
            min_change: default_min_change(),
            round_down_to: default_round_down_to(),
            engagement: EngagementSpec::default(),
            cell: None,
            layer: None,
            motions: default_motions(),
            r#where: MotionFilter::default(),
        }
    }

    /// All limits, the target first, in millimetres.
    pub(super) fn limits_in_mm(&self, mm_per_unit: f64) -> Vec<(LoadCriterion, f64)> {
        let in_mm = |limit: &LoadLimitSpec| {
            let unit = match limit.criterion {
                LoadCriterion::ChipThickness => mm_per_unit,
                LoadCriterion::RemovalRate => mm_per_unit * mm_per_unit * mm_per_unit,
                LoadCriterion::Force | LoadCriterion::Torque | LoadCriterion::Power => 1.0,
            };
            (limit.criterion, limit.target.get() * unit)
        };
        let first = LoadLimitSpec { criterion: self.criterion, target: self.target };
        std::iter::once(&first).chain(self.limits.iter().flatten()).map(in_mm).collect()
    }

    /// What engagement is found with, in millimetres; the parameter that has no meaning with it, if one is given.
    pub(super) fn engagement_model(&self, mm_per_unit: f64) -> Result<EngagementModel, &'static str> {
        match self.engagement {
            EngagementSpec::Dexels if self.layer.is_some() => Err("layer"),
            EngagementSpec::Dexels => Ok(EngagementModel::Dexels),
            EngagementSpec::Layers if self.cell.is_some() => Err("cell"),
            EngagementSpec::Layers => {
                Ok(EngagementModel::Layers { thickness: self.layer.map(|layer| layer.get() * mm_per_unit) })
            }
        }
    }

    /// The rules for feeds, in millimetres; `None` when neither step nor machine says a highest feed.
    pub(super) fn feed_rules(
        &self,
        mm_per_unit: f64,
        machine: &crate::setup::MachineLimits,
    ) -> Option<FeedRules> {
        let feed = |feed: Option<Positive>| feed.map(|feed| feed.get() * mm_per_unit);
        let highest = [feed(self.max_feed), machine.max_feed.map(Positive::get)];
        let max_feed = highest.into_iter().flatten().reduce(f64::min)?;
        Some(FeedRules {
            window: match self.window {
                WindowSpec::Block => FeedWindow::Block,
                WindowSpec::HalfBlocks => FeedWindow::HalfBlocks,
            },
            min_feed: feed(self.min_feed).unwrap_or(0.0),
            max_feed,
            min_ratio: self.min_ratio.map(Factor::get),
            max_ratio: self.max_ratio.map(Factor::get),
            air_feed: feed(self.air_feed).map(|air| air.min(max_feed)),
            margin: self.margin.map_or(0.5, |margin| margin.get() * mm_per_unit),
            max_acceleration: feed(self.max_acceleration).or(machine.max_acceleration.map(Positive::get)),
            split: self.split.map(|split| SplitRule {
                above: split.above.get() * mm_per_unit,
                shortest: split.shortest.get() * mm_per_unit,
                at_most: split.at_most.get() as usize,
            }),
            min_change: self.min_change.get(),
            round_down_to: self.round_down_to.get() * mm_per_unit,
        })
    }
}
