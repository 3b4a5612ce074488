//! This module holds the transforms: what recipe steps do to a program.
//!
//! A transform is one file, one line in the list below, and one test file. It takes the program by value, so
//! a step that fails leaves no half-edited program behind.

mod affine;
mod axis_feed_limits;
mod empty_selection;
mod feed_plan;
mod motion_insertion;
mod motion_selection;
mod recipe_run;
mod setup_check;
mod stale_records;
mod statement_numbers;
mod statement_selection;
mod step_context;
mod step_report;
mod thread_pitches;
mod unchanged_statements;
pub(crate) mod unit_slips;

pub use crate::presentation::display_units::DisplayUnits;
pub use crate::presentation::drawn_limit::{DrawnLimit, LimitedQuantity};
pub use crate::presentation::path_panel::{PanelPath, PanelPathStyle, PathPanel};
pub(crate) use affine::Affine;
pub use feed_plan::FeedPlan;
pub use motion_insertion::MotionInsertion;
pub use motion_selection::MotionSelection;
pub use move_origin::{DirectionSpec, MirrorSpec, MoveOriginTarget, RotationSpec, VectorSpec};
pub use recipe_run::{RecipeOutcome, run_recipe, run_recipe_watched, run_steps};
pub use rewrite::{RewriteRule, RuleFault};
pub(crate) use setup_check::check_result_with_setup;
pub use setup_check::check_with_setup;
pub use statement_selection::{SelectedStatements, StatementSelection};
pub use step_context::StepContext;
pub use step_report::{TransformReport, to_json_value};
pub use unit_slips::find_feeds_above_machine;

use crate::diagnostic::Failure;
use crate::parameters::FilePath;
use crate::program::{Program, StepId};
use crate::recipe::Provenance;
use schemars::JsonSchema;
use serde::Deserialize;

/// A recipe of clsmith's own steps.
pub type Recipe = crate::recipe::Recipe<Step>;

/// The name under which reports list the comments of `provenance:`, which are added after the last step.
pub(crate) const PROVENANCE: &str = "provenance";

impl Recipe {
    /// Returns the names of everything that changes a program, by [`StepId`]: the steps, and then the
    /// comments if the recipe asks for any.
    pub fn step_names(&self) -> Vec<&'static str> {
        let comments = (self.provenance != Provenance::None).then_some(PROVENANCE);
        self.steps.iter().map(Step::name).chain(comments).collect()
    }

    /// Returns the step after the last one, which signs the comments.
    pub fn provenance_step(&self) -> StepId {
        step_id(self.steps.len())
    }
}

fn step_id(index: usize) -> StepId {
    StepId(u16::try_from(index).unwrap_or(u16::MAX))
}

/// The action of a step. The struct of its parameters implements it.
pub trait Transform {
    /// Changes the program.
    ///
    /// # Errors
    /// Returns diagnostics with their places in the recipe and in the CL file, or an interruption. The
    /// program is lost then.
    fn apply(&self, program: Program, context: &mut StepContext<'_>) -> Result<Program, Failure>;

    /// Returns whether some of its parameters are lengths or feeds in the recipe's unit, so that this unit
    /// matters.
    fn measures(&self) -> bool {
        false
    }

    /// Returns the files that it reads besides the program.
    fn reads(&self) -> Vec<&FilePath> {
        Vec::new()
    }

    /// Returns the targets and limits that drawings show as lines. `mm_per_unit` is the recipe's unit.
    fn drawn_limits(&self, mm_per_unit: f64) -> Vec<DrawnLimit> {
        let _ = mm_per_unit;
        Vec::new()
    }
}

/// Writes the list of transforms as modules, as the step enum of recipes and as a table of names. The name of
/// the module is the name of the step in recipes.
macro_rules! transforms {
    ($($access:vis mod $name:ident => $step:ident,)*) => {
        $(
            $access mod $name;
            pub use $name::$step;
        )*

        /// A step of a recipe: its name and its parameters.
        #[derive(Debug, Clone, Deserialize, JsonSchema)]
        #[serde(rename_all = "snake_case")]
        #[non_exhaustive]
        pub enum Step {
            $(
                #[doc = concat!("`", stringify!($name), "`.")]
                $step($step),
            )*
        }

        /// The names of all transforms, in the order of the list.
        pub const NAMES: &[&str] = &[$(stringify!($name)),*];

        impl Step {
            /// Returns the name of the step in a recipe.
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$step(_) => stringify!($name),)*
                }
            }

            /// Returns the action of the step.
            pub fn transform(&self) -> &dyn Transform {
                match self {
                    $(Self::$step(step) => step,)*
                }
            }
        }

        /// Returns the JSON schema of a transform's parameters. Its descriptions are the doc comments.
        pub fn schema_of(name: &str) -> Option<schemars::Schema> {
            match name {
                $(stringify!($name) => Some(schemars::schema_for!($step)),)*
                _ => None,
            }
        }
    };
}

// This is the only list: the module and the type of each transform. CONTRIBUTING.md describes what else a new
// one needs.
transforms! {
    mod scale_feed => ScaleFeed,
    mod clamp_feed => ClampFeed,
    pub mod set_spindle => SetSpindle,
    mod rewrite => Rewrite,
    mod move_origin => MoveOrigin,
    mod convert_units => ConvertUnits,
    pub mod correct_ramp => CorrectRamp,
    pub mod compensate_z => CompensateZ,
    pub mod optimize_feed => OptimizeFeed,
    mod linearize => Linearize,
    pub mod unwind => Unwind,
    pub mod inverse_time => InverseTime,
}
