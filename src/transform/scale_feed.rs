//! `scale_feed` multiplies programmed feeds by a factor.

use super::feed_plan::{self, FeedPlan};
use super::thread_pitches::list_feeds_in_threads;
use super::unit_slips::check_factor;
use super::{MotionSelection, StepContext, Transform};
use crate::diagnostic::Failure;
use crate::parameters::Factor;
use crate::program::{Program, Record, RecordKind, Statement, StatementId};
use crate::recipe::MotionFilter;
use crate::write::ProgramEditor;
use schemars::JsonSchema;
use serde::Deserialize;

/// Multiplies programmed feeds by a factor.
///
/// Every feed is scaled in its own unit: mm/min, inch/min, per revolution or inverse time. Feeds of drilling
/// cycles (`CYCLE/...,MMPM,250`) are scaled like others, but rapids are not. With `where`, only the selected
/// motions change: a FEDRAT in the file's own form is inserted before a motion whose feed differs from the
/// one before it, and the programmed feed returns after it.
///
/// The step is not idempotent: a second run multiplies again.
///
/// ```yaml
/// version: 1
/// steps:
///   # Ramps and leads into the material run at half the feed.
///   - scale_feed: { factor: 0.5, where: { motions: [engage] } }
/// ```
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ScaleFeed {
    /// The factor by which feeds are multiplied, above 0. For example, 0.8 makes them a fifth slower.
    #[schemars(extend("x-unit" = "none (times the programmed feed)"))]
    pub factor: Factor,
    /// Which motions are meant; all of them when it is left out.
    #[serde(default)]
    #[schemars(extend("x-default" = "the whole program"))]
    pub r#where: MotionFilter,
}

impl ScaleFeed {
    /// Makes the step for all motions.
    pub fn new(factor: Factor) -> Self {
        Self { factor, r#where: MotionFilter::default() }
    }
}

/// This step halves the feed where the tool enters the material.
///
/// ```
/// use clsmith::parameters::Factor;
/// use clsmith::parse::parse;
/// use clsmith::program::{LengthUnit, MotionClass};
/// use clsmith::recipe::MotionFilter;
/// use clsmith::setup::Setup;
/// use clsmith::source::Source;
/// use clsmith::transform::{ScaleFeed, run_steps};
///
/// let part = b"TOOL PATH/A,TOOL,T\nFEDRAT/MMPM,800.\n\
///     PAINT/COLOR,42\nGOTO/0,0,0\nPAINT/COLOR,31\nGOTO/9,0,0\n";
/// let program = parse(&Source::new("part.cls", part.to_vec())?, None).program;
/// let engages = MotionFilter { motions: Some(vec![MotionClass::Engage]), ..MotionFilter::default() };
/// let step = ScaleFeed { r#where: engages, ..ScaleFeed::new(Factor::new(0.5).expect("0.5 is above 0")) };
/// let text = run_steps(&[&step], LengthUnit::Mm, &Setup::default(), program)?.program.to_bytes();
/// let text = String::from_utf8(text)?;
/// assert!(text.contains("FEDRAT/MMPM,400.\nPAINT/COLOR,42\nGOTO/0,0,0\n"), "{text}");
/// assert!(text.contains("FEDRAT/MMPM,800.\nGOTO/9,0,0\n"), "{text}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
impl Transform for ScaleFeed {
    fn apply(&self, program: Program, context: &mut StepContext<'_>) -> Result<Program, Failure> {
        let factor = self.factor.get();
        check_factor(factor, &["factor"], context);
        let mut selection = MotionSelection::new(&self.r#where, &program, context);
        let plan = FeedPlan::for_selected_motions(&program, &self.r#where, |motion| {
            let feed = motion.feed?.value;
            selection.contains(motion, context).then_some(feed * factor)
        });
        selection.report_if_empty(&program, context);
        let governors = plan.governing_statements();
        let mut editor = ProgramEditor::new(program, context.step);
        plan.write_feeds(&mut editor, &mut context.findings)?;
        if selection.is_everything() {
            // A FEDRAT that no motion uses still sets the machine's feed, so it would be a surprise if it
            // stayed.
            let in_threads = list_feeds_in_threads(editor.program());
            let stated = editor.program().live_statements_of(&[RecordKind::Feed, RecordKind::Cycle]);
            let unused: Vec<(StatementId, f64)> = stated
                .filter(|(id, _)| !governors.contains(id) && !in_threads.contains(id))
                .filter_map(|(id, statement)| Some((id, stated_feed(statement)?)))
                .collect();
            for (id, feed) in unused {
                feed_plan::set_feed(&mut editor, id, feed * factor)?;
            }
        }
        editor.finish()
    }
}

/// Returns the feed that a statement states.
fn stated_feed(statement: &Statement) -> Option<f64> {
    match statement.record() {
        Record::Feed(feed) => Some(feed.value),
        Record::Cycle(cycle) => cycle.feed.map(|feed| feed.value),
        _ => None,
    }
}
