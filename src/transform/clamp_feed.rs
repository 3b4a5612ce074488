//! `clamp_feed` keeps programmed feeds within limits.
//!
//! A limit holds as printed: the new feed is rounded to the allowed side of the limit.

use super::axis_feed_limits::list_axis_feed_limits;
use super::feed_plan::{FeedPlan, decimals_of_feed, printed_decimals};
use super::unit_slips::{check_mildest_factor, choose_milder_factor};
use super::{DrawnLimit, LimitedQuantity, MotionSelection, StepContext, Transform};
use crate::diagnostic::Failure;
use crate::parameters::Positive;
use crate::program::motion::Motion;
use crate::program::{FeedUnit, Program};
use crate::recipe::MotionFilter;
use crate::write::ProgramEditor;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;

/// Keeps programmed feeds between a lowest and a highest feed.
///
/// The limits are in the recipe's unit per minute. A feed per revolution is compared at the spindle speed in
/// force, an inverse-time feed over the length of its motion. Both are written back in their own unit. Where
/// the spindle speed is not known, the feed stays and is reported. Without `max`, the highest feed is the
/// `max_feed` of the machine in the setup. Rapids are not touched.
///
/// With `axes: true` the feed of each straight motion is also no higher than the axes of the machine follow: where a rotary axis has
/// to turn far on a short way, the control would slow down without a word. `min` counts before that.
///
/// A changed feed is rounded to the allowed side of the limit. The step is idempotent: a second run changes
/// nothing.
///
/// ```yaml
/// version: 1
/// units: mm
/// steps:
///   - clamp_feed: { min: 50, max: 600 }
/// ```
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ClampFeed {
    /// The lowest feed, in the recipe's unit per minute.
    #[schemars(extend("x-unit" = "the recipe's unit per minute", "x-default" = "no lowest feed"))]
    pub min: Option<Positive>,
    /// The highest feed, in the recipe's unit per minute. Without it, the machine's `max_feed` from the setup
    /// counts.
    #[schemars(extend("x-unit" = "the recipe's unit per minute", "x-default" = "the max_feed of the machine"))]
    pub max: Option<Positive>,
    /// Whether no feed is above what the axes of the setup's machine follow.
    #[serde(default)]
    pub axes: bool,
    /// Which motions are meant; all of them when it is left out.
    #[serde(default)]
    #[schemars(extend("x-default" = "the whole program"))]
    pub r#where: MotionFilter,
}

/// This step lets no feed below 100 and none above 6000, in the unit that [`run_steps`](super::run_steps)
/// is told.
///
/// ```
/// use clsmith::parameters::Positive;
/// use clsmith::parse::parse;
/// use clsmith::program::LengthUnit;
/// use clsmith::setup::Setup;
/// use clsmith::source::Source;
/// use clsmith::transform::{ClampFeed, run_steps};
///
/// let step = ClampFeed { min: Positive::new(100.0), max: Positive::new(6000.0), ..ClampFeed::default() };
/// let program = parse(&Source::new("part.cls", b"FEDRAT/MMPM,9000.\nGOTO/0,0,0\n".to_vec())?, None).program;
/// let outcome = run_steps(&[&step], LengthUnit::Mm, &Setup::default(), program)?;
/// assert_eq!(outcome.program.to_bytes(), b"FEDRAT/MMPM,6000.\nGOTO/0,0,0\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
impl Transform for ClampFeed {
    fn measures(&self) -> bool {
        true
    }

    fn drawn_limits(&self, mm_per_unit: f64) -> Vec<DrawnLimit> {
        let limit = |feed: Option<Positive>, name| {
            feed.map(|feed| DrawnLimit::new(LimitedQuantity::Feed, feed.get() * mm_per_unit, name))
        };
        limit(self.min, "min of clamp_feed").into_iter().chain(limit(self.max, "max of clamp_feed")).collect()
    }

    fn apply(&self, program: Program, context: &mut StepContext<'_>) -> Result<Program, Failure> {
        let units = context.units.mm_per_unit();
        let machine = context.setup.machine.max_feed.map(|feed| feed.get() / units);
        let min = self.min.map_or(0.0, Positive::get);
        let max = self.max.map(Positive::get).or(machine).unwrap_or(f64::INFINITY);
        let follow = if self.axes { list_axis_feed_limits(&program, context)? } else { BTreeMap::new() };
        if self.min.is_none() && max.is_infinite() && !self.axes {
            return Err(context.step_failure(
                "neither `min` nor `max` is given, and the machine of the setup has no highest feed; add `max: 3000` \
                 to this step, or `machine: { max_feed: 10000 }` to the setup",
                &[],
            ));
        }
        if min > max {
            return Err(context.step_failure(
                format!("the lowest feed {min} is above the highest feed {max}; set `min` to {max} or less"),
                &["min"],
            ));
        }
        let file = context.file_length_unit(&program);
        let mut selection = MotionSelection::new(&self.r#where, &program, context);
        let (mut unknown, mut unbounded) = (Vec::new(), Vec::new());
        let (mut slower, mut faster, mut kept) = (None, None, false);
        let plan = FeedPlan::for_selected_motions(&program, &self.r#where, |motion| {
            let feed = motion.feed?.value;
            if !selection.contains(motion, context) {
                return None;
            }
            let Some(actual) = context.feed_per_minute(motion, file).filter(|actual| *actual > 0.0) else {
                unknown.extend(motion.feed_from.filter(|statement| unknown.last() != Some(statement)));
                return None;
            };
            let decimals = motion.feed_from.map_or(0, |statement| decimals_of_feed(&program, statement));
            // Where the surface speed is constant, the spindle is faster at the smaller diameter, and so is the feed.
            let fastest = actual * find_speed_rise(motion);
            if fastest > max && !fastest.is_finite() {
                unbounded.extend(motion.feed_from.filter(|statement| unbounded.last() != Some(statement)));
                return None;
            }
            let actual = if fastest > max { fastest } else { actual };
            if let Some(most) = follow.get(&motion.last_statement()).map(|most| (most / units).max(min))
                && most < max
            {
                // Axes limit single motions by their nature, so that is no slip.
                kept = true;
                return clamp_to_limits(feed, actual, (min, most), decimals);
            }
            match actual {
                _ if actual > max => slower = choose_milder_factor(slower, max / actual),
                _ if actual < min => faster = choose_milder_factor(faster, min / actual),
                _ => kept = true,
            }
            clamp_to_limits(feed, actual, (min, max), decimals)
        });
        // A limit is there to catch single feeds that are far away; where it catches all of them, it is a slip.
        if !kept {
            check_mildest_factor(slower.filter(|_| faster.is_none()), "feed", &["max"], context);
            check_mildest_factor(faster.filter(|_| slower.is_none()), "feed", &["min"], context);
        }
        selection.report_if_empty(&program, context);
        for statement in unknown {
            let message = "this feed cannot be compared with the limits: it is zero, or it is per revolution and no spindle speed in rev/min is known";
            context.report_unchanged(message, &program, statement);
        }
        for statement in unbounded {
            let message = "at constant surface speed the spindle has no highest speed towards the axis, so no feed per revolution keeps the limit here";
            context.report_unchanged(message, &program, statement);
        }
        let mut editor = ProgramEditor::new(program, context.step);
        plan.write_feeds(&mut editor, &mut context.findings)?;
        editor.finish()
    }
}

/// Returns how much faster than on average the spindle turns at the smallest diameter of a motion: 1 for feeds per
/// minute and for a constant spindle speed, infinite for a motion to the axis.
fn find_speed_rise(motion: &Motion) -> f64 {
    let per_turn = motion.feed.and_then(|feed| feed.unit).is_some_and(FeedUnit::is_per_revolution);
    match motion.surface_rpm {
        Some(surface) if per_turn => surface.highest / surface.mean,
        _ => 1.0,
    }
}

/// A limit may be exceeded by this fraction, because equal numbers differ by that much after arithmetic.
const NOISE: f64 = 1e-9;

/// Returns the feed that keeps the limits and is printed exactly. Returns `None` if the programmed feed
/// already keeps them.
///
/// `actual` is the feed in the limits' unit. When the units differ, a limit falls between two printed feeds
/// (0.25 mm/rev, 500 mm/min at 3000 rev/min). Then the lower one is taken at the highest limit and the upper
/// one at the lowest limit. So no limit is exceeded, and a second run finds nothing to change.
fn clamp_to_limits(feed: f64, actual: f64, (min, max): (f64, f64), decimals: usize) -> Option<f64> {
    let rate = actual / feed;
    let (too_low, too_high) = (min * (1.0 - NOISE), max * (1.0 + NOISE));
    if (too_low..=too_high).contains(&actual) {
        return None;
    }
    let limit = if actual > max { max } else { min } / rate;
    let power = 10f64.powi(printed_decimals(limit, decimals));
    let nearest = (limit * power).round();
    let passes = |steps: f64| steps / power * rate > too_high || steps / power * rate < too_low;
    // The nearest printed feed may lie on the wrong side of the limit; then the next one inside is taken.
    let inside = if actual > max { nearest - 1.0 } else { nearest + 1.0 };
    let steps = match passes(nearest) {
        false => nearest,
        // When the limits are so close together that no printed feed lies between them, the highest counts.
        true if inside / power * rate > too_high => nearest - 1.0,
        true => inside,
    };
    let wanted = steps / power;
    (wanted != feed).then_some(wanted)
}
