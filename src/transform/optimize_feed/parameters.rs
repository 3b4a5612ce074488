//! This module holds the parameters of `optimize_feed`.

use super::limit::{FeedRules, FeedWindow, SplitRule};
use super::measure::LoadCriterion;
use crate::parameters::{Factor, Fraction, NonNegative, Positive, PositiveCount, describe_length_mm};
use crate::presentation::drawn_limit::{DrawnLimit, LimitedQuantity};
use crate::program::MotionClass;
use crate::recipe::{MotionFilter, deserialize_not_empty};
use crate::simulation_run::{EngagementModel, describe_default_cell, describe_default_layer};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The length of path before and after material that keeps the cutting feed if `margin` is left out, mm.
const MARGIN_MM: f64 = 0.5;

/// Gives every block the feed at which the cutter's load reaches its target, by simulating what the cutter
/// really removes.
///
/// The step needs the stock, the teeth of the tools and a spindle speed in rev/min (see `setup:`), and for
/// forces also a material. It simulates the program and computes feeds in closed form from the load of each
/// piece of path. Neighbouring blocks share a feed where that costs hardly any time, so that few FEDRATs are
/// written; these have the file's own form. The result is simulated again. The step fails if a target is exceeded by more than the
/// uncertainty of the simulation. What the grid cannot resolve lowers the feed and never raises it.
///
/// With `axes: true` no straight motion gets a feed that an axis of the machine cannot follow; one that is programmed higher is
/// lowered. Where the setup knows the machine, the report begins with the time on it, before and after.
///
/// Rapids, drilling cycles and motions that are not selected keep their feeds. A second run changes
/// nothing, unless `min_ratio` or `max_ratio` tie the feeds to the programmed ones.
///
/// ```yaml
/// version: 1
/// units: mm
/// setup:
///   machine: { max_feed: 8000 }
///   stock: { block: { from: [0, -20, -10], to: [60, 20, 0] } }
///   tools:
///     - { match: {}, diameter: 10, flute_length: 20, teeth: 4 }
/// steps:
///   - optimize_feed: { target: 0.05 }
/// ```
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OptimizeFeed {
    /// The load that `target` limits.
    #[serde(default)]
    pub criterion: LoadCriterion,
    /// The allowed load, in the unit of the criterion.
    #[schemars(extend("x-unit" = "the criterion's: mm, mm3/min, N, N m, kW or MPa"))]
    pub target: Positive,
    /// Further limits that hold at the same time. The lowest feed counts.
    #[serde(default, deserialize_with = "deserialize_not_empty")]
    #[schemars(length(min = 1))]
    #[schemars(extend("x-default" = "no further limits"))]
    pub limits: Option<Vec<LoadLimitSpec>>,
    /// Whether the limits of forces, torque, power, deflection and stress are lowered by what the cuts differed from the
    /// material's law with which it was measured: to the limit by 1 + `residual` of the material file.
    #[serde(default)]
    pub fit_error_margin: bool,
    /// Which part of the path counts for the feed of a block.
    #[serde(default)]
    pub window: WindowSpec,
    /// The lowest feed, in the recipe's unit per minute.
    #[schemars(extend("x-unit" = "the recipe's unit per minute", "x-default" = "no lowest feed"))]
    pub min_feed: Option<Positive>,
    /// The highest feed, in the recipe's unit per minute. Without it, the machine's `max_feed` counts; if
    /// both are given, the lower one.
    #[schemars(extend("x-unit" = "the recipe's unit per minute", "x-default" = "the max_feed of the machine"))]
    pub max_feed: Option<Positive>,
    /// The lowest feed as a fraction of the programmed one.
    #[schemars(extend("x-unit" = "none (times the programmed feed)", "x-default" = "no lowest ratio"))]
    pub min_ratio: Option<Factor>,
    /// The highest feed as a fraction of the programmed one.
    #[schemars(extend("x-unit" = "none (times the programmed feed)", "x-default" = "no highest ratio"))]
    pub max_ratio: Option<Factor>,
    /// The feed in air, in the recipe's unit per minute. Without it, air keeps the programmed feed, except in
    /// blocks that come within `margin` of material: these have the cutting feed there.
    #[schemars(extend("x-unit" = "the recipe's unit per minute", "x-default" = "the programmed feed"))]
    pub air_feed: Option<Positive>,
    /// The length of path before and after material that keeps the cutting feed, in the recipe's unit; 0.5 mm
    /// when it is left out.
    #[schemars(extend("x-unit" = "the recipe's unit", "x-default" = describe_length_mm(MARGIN_MM)))]
    pub margin: Option<NonNegative>,
    /// How fast the machine changes its feed along the path, in the recipe's unit per minute and second. Times are
    /// told with it, a feed that it cannot use needs no FEDRAT, and before a slower feed there is path enough to slow
    /// down in. Without it, the machine's value counts.
    #[schemars(extend("x-unit" = "the recipe's unit per minute and second", "x-default" = "that of the machine"))]
    pub max_acceleration: Option<Positive>,
    /// Whether no feed is above what the axes of the setup's machine follow.
    #[serde(default)]
    pub axes: bool,
    /// Splits long blocks whose load varies. Blocks are never split when it is left out.
    #[schemars(extend("x-default" = "no block is split"))]
    pub split: Option<SplitSpec>,
    /// The part of the path time that may be given up so that fewer FEDRATs are written. Among all feeds that take no
    /// more time than that, those with the fewest FEDRATs are chosen. A programmed feed that is lower by no more than
    /// this fraction stays.
    #[serde(default = "default_min_change")]
    #[schemars(extend("x-unit" = "none (a part of the path time)"))]
    pub min_change: Fraction,
    /// Feeds are rounded down to multiples of this, in the recipe's unit per minute; 0 keeps as many decimals
    /// as the file prints.
    #[serde(default = "default_round_down_to")]
    #[schemars(extend("x-unit" = "the recipe's unit per minute"))]
    pub round_down_to: NonNegative,
    /// The model that finds where the cutter is engaged.
    #[serde(default)]
    pub engagement: EngagementSpec,
    /// The distance of the simulation's columns, in the recipe's unit; it follows from the smallest cutter when it is
    /// left out. It is not allowed with `engagement: layers`.
    #[schemars(extend("x-unit" = "the recipe's unit", "x-default" = describe_default_cell()))]
    pub cell: Option<Positive>,
    /// The thickness of the layers, in the recipe's unit; it follows from the smallest cutter when it is left out.
    /// Material thinner than a layer may be missed. It is only allowed with `engagement: layers`.
    #[schemars(extend("x-unit" = "the recipe's unit", "x-default" = describe_default_layer()))]
    pub layer: Option<Positive>,
    /// The classes of motion that may get another feed.
    #[serde(default = "default_motions")]
    #[schemars(length(min = 1))]
    pub motions: Vec<MotionClass>,
    /// Which motions are meant; all of them when it is left out.
    #[serde(default)]
    #[schemars(extend("x-default" = "the whole program"))]
    pub r#where: MotionFilter,
}

/// A limit in addition to the target.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoadLimitSpec {
    /// The load that it limits.
    pub criterion: LoadCriterion,
    /// The allowed load, in the unit of the criterion.
    #[schemars(extend("x-unit" = "the criterion's: mm, mm3/min, N, N m, kW or MPa"))]
    pub target: Positive,
}

/// Which part of the path counts for the feed of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WindowSpec {
    /// All of the block, so the target is never exceeded.
    #[default]
    Block,
    /// The half of the block before its end point and the first half of the next block, as in the paper.
    /// Feeds are smoother, but the first half of a block runs at the feed of the block before it.
    HalfBlocks,
}

/// The model that finds where the cutter is engaged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EngagementSpec {
    /// The motions themselves: an interval that holds the largest chip of every block, whatever is thinner than a grid, and
    /// bounds of the other loads from all that may be engaged. Cutters that are narrower above their widest place are taken
    /// from columns.
    #[default]
    Certified,
    /// Columns of material along z, for every cutter and axis, with shank and holder: an estimate that is blind below
    /// the width of a column.
    #[serde(alias = "dexels")]
    Columns,
    /// The exact chips of flat end mills in layers across z, in three axes and in five axes up to 80 degrees
    /// from z. Directions and fractions are not rounded to a grid. Another tool stops the step; shank and
    /// holder are not checked.
    Layers,
}

/// The rule by which blocks are split. Lengths are in the recipe's unit.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SplitSpec {
    /// Only blocks longer than this are split.
    #[schemars(extend("x-unit" = "the recipe's unit"))]
    pub above: Positive,
    /// No part becomes shorter than this.
    #[schemars(extend("x-unit" = "the recipe's unit"))]
    pub shortest: Positive,
    /// A block gets at most so many parts.
    #[schemars(extend("x-unit" = "parts"))]
    pub at_most: PositiveCount,
}

fn default_min_change() -> Fraction {
    Fraction::HALF_PERCENT
}

fn default_round_down_to() -> NonNegative {
    NonNegative::ONE
}

fn default_motions() -> Vec<MotionClass> {
    vec![MotionClass::Cut, MotionClass::Engage, MotionClass::StepOver]
}

impl OptimizeFeed {
    /// Makes the step with a target for the chip thickness, in the unit of its parameters. All other
    /// parameters have their defaults.
    pub fn new(target: Positive) -> Self {
        Self {
            criterion: LoadCriterion::default(),
            target,
            limits: None,
            fit_error_margin: false,
            window: WindowSpec::default(),
            min_feed: None,
            max_feed: None,
            min_ratio: None,
            max_ratio: None,
            air_feed: None,
            margin: None,
            max_acceleration: None,
            axes: false,
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

    /// Returns the limits as drawings show them: those of loads, and those of the feed.
    pub(super) fn limits_for_drawings(&self, mm_per_unit: f64) -> Vec<DrawnLimit> {
        let quantity = |criterion| match criterion {
            LoadCriterion::ChipThickness => LimitedQuantity::Chip,
            LoadCriterion::RemovalRate => LimitedQuantity::Removal,
            LoadCriterion::Force => LimitedQuantity::Force,
            LoadCriterion::Torque => LimitedQuantity::Torque,
            LoadCriterion::Power => LimitedQuantity::Power,
            LoadCriterion::Deflection => LimitedQuantity::Deflection,
            LoadCriterion::BendingStress => LimitedQuantity::BendingStress,
        };
        let loads =
            self.limits_in_mm(mm_per_unit).into_iter().enumerate().map(|(index, (criterion, value))| {
                let name = if index == 0 { "target of optimize_feed" } else { "limit of optimize_feed" };
                DrawnLimit::new(quantity(criterion), value, name)
            });
        let feeds =
            [(self.min_feed, "min_feed of optimize_feed"), (self.max_feed, "max_feed of optimize_feed")];
        let feeds = feeds.into_iter().filter_map(|(feed, name)| {
            Some(DrawnLimit::new(LimitedQuantity::Feed, feed?.get() * mm_per_unit, name))
        });
        loads.chain(feeds).collect()
    }

    /// Returns all limits in millimetres, with the target first.
    pub(super) fn limits_in_mm(&self, mm_per_unit: f64) -> Vec<(LoadCriterion, f64)> {
        let in_mm = |limit: &LoadLimitSpec| {
            (limit.criterion, limit.target.get() * limit.criterion.unit_factor(mm_per_unit))
        };
        let first = LoadLimitSpec { criterion: self.criterion, target: self.target };
        std::iter::once(&first).chain(self.limits.iter().flatten()).map(in_mm).collect()
    }

    /// Returns the engagement model in millimetres. Returns the key of a parameter as an error if the model
    /// does not use it.
    pub(super) fn engagement_model(&self, mm_per_unit: f64) -> Result<EngagementModel, &'static str> {
        match self.engagement {
            EngagementSpec::Certified | EngagementSpec::Columns if self.layer.is_some() => Err("layer"),
            EngagementSpec::Certified => Ok(EngagementModel::Certified),
            EngagementSpec::Columns => Ok(EngagementModel::Dexels),
            EngagementSpec::Layers if self.cell.is_some() => Err("cell"),
            EngagementSpec::Layers => {
                Ok(EngagementModel::Layers { thickness: self.layer.map(|layer| layer.get() * mm_per_unit) })
            }
        }
    }

    /// Returns the rules for feeds in millimetres. Returns `None` if neither the step nor the machine has a
    /// highest feed.
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
            margin: self.margin.map_or(MARGIN_MM, |margin| margin.get() * mm_per_unit),
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
